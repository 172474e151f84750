"""Study files: what is taken, what is refused, and how the refusal reads."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from actuator_select.errors import ActuatorSelectError, InvalidStudy, UnknownName
from actuator_select.model.actuation import Check
from actuator_select.model.motion import MotionKind
from actuator_select.model.robot import Freedom
from actuator_select.model.tension import TensionModel
from actuator_select.study import (
    TEMPLATES,
    builtin_studies,
    load_study,
    parse_overrides,
    parse_study,
    schema,
    study_text,
    template_text,
)

SAMPLED = {
    "set": "sampled",
    "speed_max_m_per_s": 1.3,
    "acceleration_time_s": 1.8,
    "deceleration_time_s": 1.8,
}


def test_the_case_study_is_the_papers() -> None:
    study = load_study("cpr8")
    assert study.positions.shape == (216, 3)
    assert study.robot.cables == 8
    assert study.checks == tuple(Check)
    assert study.motion.acceleration_upper == pytest.approx(np.full(3, 1.3 / 1.82))
    assert len(load_study("cpr8-published").motion.velocities) == 123


@pytest.mark.parametrize("name", builtin_studies())
def test_every_builtin_study_says_what_it_is(name: str) -> None:
    study = load_study(name)
    assert study.name == name
    assert study.table.description


def test_the_readme_names_every_key_of_a_study() -> None:
    readme = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    keys = readme.split("## Study files")[1].split("## Catalogue")[0]
    tables = [one for one in vars(schema).values() if isinstance(one, type) and issubclass(one, schema.Table)]
    names = {name for table in tables if table is not schema.StudyTable for name in table.model_fields}
    assert [name for name in sorted(names) if not re.search(rf"\b{name}\b", keys)] == []
    assert all(f"`{word}`" in keys for word in (*schema.BUILDER_KEYS, *MotionKind, *TensionModel, *Freedom))


def test_the_starter_study_works_as_it_stands() -> None:
    study = parse_study(template_text('my "robot"'), place="starter")
    assert study.name == 'my "robot"'
    assert study.robot.cables == 4


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("motion.speed_max_m_per_s", -1.0, "motion.speed_max_m_per_s: -1.0, expected at least 1e-06 [m/s]"),
        ("motion.acceleration_time_s", 0, "motion.acceleration_time_s: 0, expected at least 1e-06 [s]"),
        ("payload.mass_kg", float("nan"), "payload.mass_kg: NaN, expected a finite number [kg]"),
        ("payload.mass_kg", float("inf"), "payload.mass_kg: Infinity, expected a finite number [kg]"),
        ("payload.mass_kg", "2", 'payload.mass_kg: "2", expected a number [kg]'),
        ("payload.mass_kg", True, "payload.mass_kg: true, expected a number [kg]"),
        ("workspace.points", [0, 6, 6], "workspace.points[0]: 0, expected at least 1"),
        ("workspace.points", [6, 6], "workspace.points[2]: is missing"),
        ("workspace.points", [6.5, 6, 6], "workspace.points[0]: 6.5, expected a whole number"),
        ("workspace.orientations_rad", [], "workspace.orientations_rad: [], expected at least 1 entries [rad]"),
        ("workspace.box_m", [[1, 0], [0, 1], [0, 1]], "x runs from 1.0 to 0.0 m"),
        ("workspace.box_m", [[1, 1], [0, 1], [0, 1]], "a single point along x"),
        ("motion.speed_max_m_per_s", 1e200, "motion.speed_max_m_per_s: 1e+200, expected at most 1e+06 [m/s]"),
        ("variant[1].set", {"motion.centripedal": False}, "motion.centripedal: is not a key of a study"),
        ("variant[1].set", {"candidates.where": "ratio > 3"}, "variant[1].set: 'candidates.where', expected a key of"),
        ("robot.carrier_m", [3.0, 3.0, 3.0], "a carrier whose diagonal (5.196 m) fits into the frame"),
        ("robot.builder", "cpr9", "robot.builder: \"cpr9\", expected one of 'cpr8'"),
        ("checks.apply", ["speed", "power"], "checks.apply[1]: \"power\", expected one of 'speed'"),
        ("checks.apply", ["speed", "speed"], "every check once"),
        ("checks.apply", [], "checks.apply: [], expected at least 1"),
        ("requirement.feasible_percent", 120, "requirement.feasible_percent: 120, expected at most 100 [per cent"),
        (
            "workspace.points",
            [1000, 1000, 1000],
            "are 1,000,000,000 poses, some 4 h and 2,560.0 GB of memory, expected at most 1,000,000 with 8 cables",
        ),
        ("motion", SAMPLED | {"velocity_intervals": 1}, "motion.velocity_intervals: 1, expected at least 2"),
        ("motion", SAMPLED | {"velocity_intervals": 30000}, "motion.velocity_intervals: 30000, expected at most 60"),
        ("motion.velocity_intervals", 6, 'expected set = "sampled" where velocity_intervals is given'),
        ("motion.sped_max_m_per_s", 1.0, "did you mean 'speed_max_m_per_s'"),
        ("gravity", 9.81, "did you mean 'gravity_m_per_s2'"),
        (
            "assumptions.gearbox_efficiency_of_maximum",
            1.1,
            "assumptions.gearbox_efficiency_of_maximum: 1.1, expected at most 1",
        ),
        (
            "assumptions.gearbox_efficiency_of_maximum",
            0.0,
            "gearbox_efficiency_of_maximum: 0.0, expected at least 1e-06",
        ),
        (
            "assumptions.gearbox_efficiency_percent",
            101,
            "assumptions.gearbox_efficiency_percent: 101, expected more than 1 and at most 100 [per cent]",
        ),
        (
            "assumptions.gearbox_efficiency_percent",
            0.7,
            "gearbox_efficiency_percent: 0.7, expected more than 1 and at most 100; a fraction was given, write 70",
        ),
        ("assumptions.gearbox_efficiency_percent", 0.0, "expected more than 1 and at most 100 [per cent]"),
        ("assumptions.gearbox_inertia_g_cm2", -1.0, "gearbox_inertia_g_cm2: -1.0, expected at least 0 [g cm²]"),
        ("assumptions.drum_inertia_kg_m2", -1.0, "drum_inertia_kg_m2: -1.0, expected at least 0 [kg m²]"),
        (
            "assumptions.viscous_friction_nm_s_per_rad",
            -1.0,
            "assumptions.viscous_friction_nm_s_per_rad: -1.0, expected at least 0 [N m s/rad]",
        ),
        ("assumptions.rotor_inertia_g_cm2", -1.0, "assumptions.rotor_inertia_g_cm2: -1.0, expected at least 0 [g cm²]"),
        ("assumptions.rated_torque_nm", 1.0, "assumptions.rated_torque_nm: is not a key of a study"),
    ],
)
def test_a_bad_value_is_named_with_key_value_expectation_and_unit(key: str, value: object, expected: str) -> None:
    with pytest.raises(InvalidStudy) as caught:
        load_study("cpr8", {key: value})
    assert expected in str(caught.value)


def test_every_problem_is_reported_at_once() -> None:
    with pytest.raises(InvalidStudy) as caught:
        load_study("cpr8", {"payload.mass_kg": -1, "motion.deceleration_time_s": 0, "extra": 1})
    assert len(caught.value.problems) == 3


@pytest.mark.parametrize("key", ["name", "robot", "payload", "workspace", "motion"])
def test_a_missing_key_is_named(key: str) -> None:
    text = "\n".join(line for line in study_text("cpr8").splitlines() if not line.startswith(f"{key} ="))
    if key != "name":
        text = re.sub(rf"^\[{key}\]\n([^\[\n].*\n|\n)*", "", text, flags=re.MULTILINE)
        assert f"[{key}]" not in text
    with pytest.raises(InvalidStudy, match=f"{key}: is missing"):
        parse_study(text, place="study")


def test_an_unknown_study_is_refused_with_a_suggestion() -> None:
    with pytest.raises(UnknownName, match="did you mean 'cpr8'"):
        load_study("cpr9")


def test_a_file_that_is_not_toml_is_refused_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "broken.toml"
    file.write_text('name = "x"\nrobot = [1,\n', encoding="utf-8")
    with pytest.raises(InvalidStudy, match="not valid TOML"):
        load_study(file)
    file.write_bytes("\ufeff".encode() + study_text("cpr8").encode())
    assert load_study(file).name == "cpr8"
    file.write_bytes(b'name = "\xff"\n')
    with pytest.raises(InvalidStudy, match="not UTF-8"):
        load_study(file)


def test_explicit_cables_need_a_box() -> None:
    text = template_text("robot").replace("\nbox_m = ", '\nregion = "builder"  # ')
    with pytest.raises(InvalidStudy, match="box_m"):
        parse_study(text, place="robot")


def test_a_box_replaces_the_builders_region() -> None:
    study = load_study(
        "cpr8", {"workspace.box_m": [[1.0, 2.0], [0.5, 0.5], [-1.0, -0.5]], "workspace.points": [2, 1, 3]}
    )
    assert study.positions.shape == (6, 3)
    assert study.positions[:, 1].tolist() == [0.5] * 6


def test_overrides_are_toml_values_and_bare_words() -> None:
    assert parse_overrides(
        ["workspace.points=[11, 11, 11]", "motion.speed_max_m_per_s=0.8", "motion.set=sampled", 'name="a b"']
    ) == {
        "workspace.points": [11, 11, 11],
        "motion.speed_max_m_per_s": 0.8,
        "motion.set": "sampled",
        "name": "a b",
    }


@pytest.mark.parametrize("assignment", ["workspace.points", "=3", "a=", "a=[1", "a=1\nb=2", "a=two words"])
def test_an_override_that_is_no_assignment_is_refused(assignment: str) -> None:
    with pytest.raises(InvalidStudy, match="--set"):
        parse_overrides([assignment])


@pytest.mark.parametrize("key", ["name.first", "robot.cable[0].frame_anchor_m", "workspace.points[7]", "a..b", "a b"])
def test_an_override_that_leads_nowhere_is_refused(key: str) -> None:
    with pytest.raises(InvalidStudy):
        load_study("cpr8", {key: 1})


def test_an_override_reaches_into_lists() -> None:
    study = load_study("cpr8", {"workspace.points[2]": 3, "move[0].title": "first"})
    assert study.table.workspace.points == (6, 6, 3)
    assert study.table.move[0].title == "first"


def test_the_text_of_an_overridden_study_gives_the_same_study() -> None:
    study = load_study("cpr8", {"payload.mass_kg": 3.5, "candidates.where": "ratio > 3"})
    again = parse_study(study.text, place="again")
    assert again.table == study.table
    assert "# both ends included" in study.text


@given(
    key=st.sampled_from(["payload.mass_kg", "workspace.points", "motion.set", "tension", "move", "name", "new.key[3]"]),
    value=st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
        lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
        max_leaves=5,
    ).filter(lambda value: value is not None),
)
def test_any_value_anywhere_gives_a_study_or_a_clear_error(key: str, value: object) -> None:
    try:
        study = load_study("cpr8", {key: value})
    except ActuatorSelectError as error:
        assert str(error)  # noqa: PT017 - either outcome is right
    else:
        assert len(study.positions) > 0


def test_a_grid_position_in_an_anchor_is_refused_unless_a_least_length_is_stated() -> None:
    robot, text = load_study("cpr8").robot, study_text("cpr8")
    end = robot.frame_anchors[2] - robot.platform_anchors[2]
    box = [[float(value), float(value) + 0.5] for value in end]
    corner = {"workspace.box_m": box, "workspace.points": [2, 2, 2]}
    with pytest.raises(InvalidStudy, match="cable 3 has no length and so no direction"):
        parse_study(text, place="corner", overrides=corner)
    stated = parse_study(text, place="corner", overrides=corner | {"cables": {"length_min_m": 0.05}})
    assert len(stated.positions) == 8


def test_assumptions_are_set_like_any_key_and_are_none_by_default() -> None:
    assert not load_study("cpr8-published").table.assumptions.model_fields_set
    assert load_study("cpr8").table.assumptions.viscous_friction_nm_s_per_rad == 0.0
    given = parse_overrides(["assumptions.rotor_inertia_g_cm2=120", "assumptions.gearbox_efficiency_of_maximum=0.8"])
    assumptions = load_study("cpr8-published", given).table.assumptions
    assert (assumptions.rotor_inertia_g_cm2, assumptions.gearbox_efficiency_of_maximum) == (120.0, 0.8)
    assert assumptions.gearbox_efficiency_percent is None


@pytest.mark.parametrize("template", [name for name in TEMPLATES if name != "anchors"])
def test_new_studies_name_what_they_assume(template: str) -> None:
    assumptions = parse_study(template_text("new", template), place="new").table.assumptions
    assert assumptions.model_dump(exclude_none=True) == {
        "viscous_friction_nm_s_per_rad": 0.0,
        "gearbox_efficiency_of_maximum": 0.9,
    }
