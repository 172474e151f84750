"""What the catalogue does not state: assumptions that the study names, and what electrical figures hold for."""

import json
from collections.abc import Iterator
from math import isnan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from actuator_select import Catalogue, load_study, open_catalogue, rank, render_report, simulate
from actuator_select.model.actuation import Check
from actuator_select.selection import selection_record
from actuator_select.selection.candidates import from_rows
from actuator_select.selection.dossier import build_dossier
from actuator_select.selection.records import simulation_record
from actuator_select.selection.wording import assumption_notes, check_notes, marked, some_of, unknown_words
from actuator_select.study import Study
from actuator_select.study.schema import AssumptionsTable
from tests.selection.parts import DC, SERVO, add_drive

EFFICIENCY = {"efficiency_percent": 60}
FRICTION = "assumptions.viscous_friction_nm_s_per_rad"
SHARE = "assumptions.gearbox_efficiency_of_maximum"
ALL_ASSUMED = {
    "assumptions.rotor_inertia_g_cm2": 500.0,
    FRICTION: 0.0,
    "assumptions.gearbox_efficiency_percent": 70.0,
    "assumptions.gearbox_efficiency_of_maximum": 0.9,
}
ROW = {
    "id": "x",
    "name": "x",
    "gearbox_id": "g",
    "gearbox.ratio": 30.0,
    "motor.rated_torque_nm": 0.5,
    "motor.electrical_convention": "dc_terminal",
}
STATED = {
    "efficiency_percent": 55.0,
    "gearbox.efficiency_percent": 65.0,
    "gearbox.max_efficiency_percent": 75.0,
    "motor.viscous_friction_nm_s_per_rad": 1e-5,
    "motor.rotor_inertia_g_cm2": 33.0,
}


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


def without_assumptions(**overrides: object) -> Study:
    from actuator_select.study import parse_study

    text = load_study("cpr8").text
    start = text.index("[assumptions]")
    text = text[:start] + text[text.index("[requirement]") :]
    return parse_study(text, place="cpr8", overrides={key.replace("__", "."): one for key, one in overrides.items()})


@pytest.mark.parametrize(
    ("stated", "efficiency", "key"),
    [
        (STATED, 0.55, None),
        ({"gearbox.efficiency_percent": 65.0, "gearbox.max_efficiency_percent": 75.0}, 0.65, None),
        ({"gearbox.max_efficiency_percent": 75.0}, 0.9 * 0.75, "assumptions.gearbox_efficiency_of_maximum"),
        ({}, 0.7, "assumptions.gearbox_efficiency_percent"),
        ({"gearbox_id": None}, 1.0, None),
    ],
)
def test_the_efficiency_is_the_assemblys_then_the_gearboxes_then_what_is_assumed(
    stated: dict[str, object], efficiency: float, key: str | None
) -> None:
    assumptions = AssumptionsTable(gearbox_efficiency_percent=70.0, gearbox_efficiency_of_maximum=0.9)
    found = from_rows([ROW | stated], assumptions)
    assert found.actuators.efficiency[0] == pytest.approx(efficiency, rel=1e-15)
    assert [one.key for one in found.assumed[0]] == ([key] if key else [])
    if key:
        assert found.assumed[0][0].value == pytest.approx(100.0 * efficiency)


def test_a_greatest_efficiency_is_never_used_alone_nor_replaced_by_a_guess() -> None:
    row = ROW | {"gearbox.max_efficiency_percent": 75.0}
    for assumptions in (None, AssumptionsTable(gearbox_efficiency_percent=90.0)):
        found = from_rows([row], assumptions)
        assert isnan(found.actuators.efficiency[0])
        assert found.assumed == ((),)


@given(
    st.sets(st.sampled_from(sorted(STATED))),
    st.floats(0.0, 1e5),
    st.floats(0.0, 1.0),
    st.floats(1.0, 100.0, exclude_min=True),
    st.floats(0.01, 1.0),
)
def test_an_assumption_never_changes_a_figure_that_is_known(
    stated: set[str], inertia: float, friction: float, efficiency: float, factor: float
) -> None:
    row = ROW | {key: STATED[key] for key in stated}
    assumptions = AssumptionsTable(
        rotor_inertia_g_cm2=inertia,
        viscous_friction_nm_s_per_rad=friction,
        gearbox_efficiency_percent=efficiency,
        gearbox_efficiency_of_maximum=factor,
    )
    plain, assumed = from_rows([row]), from_rows([row], assumptions)
    taken = {one.figure for one in assumed.assumed[0]}
    for name in ("rotor_inertia", "friction", "efficiency", "motor_torque", "motor_speed", "voltage", "resistance"):
        before, after = getattr(plain.actuators, name)[0], getattr(assumed.actuators, name)[0]
        assert (name in taken) == (isnan(before) and not isnan(after))
        if not isnan(before):
            assert before == after
    assert plain.assumed == ((),)
    assert isnan(assumed.actuators.motor_speed[0])  # a limit is never assumed
    assert isnan(assumed.actuators.resistance[0])  # nor a constant


@pytest.mark.parametrize(
    ("convention", "construction", "direct_current", "listed"),
    [
        ("dc_terminal", "pmsm_servo", 1.0, False),
        ("dc_phase_to_phase", None, 1.0, False),
        ("ac_rms_phase", "dc_brushed", 0.0, False),
        ("dc_controller", "bldc", 0.0, False),
        (None, "dc_brushed", 1.0, False),
        (None, "pmsm_servo", np.nan, False),
        (None, "pmsm_direct_drive", np.nan, False),
        (None, "bldc", 1.0, True),
        (None, "bldc_torque", 1.0, True),
        (None, None, 1.0, True),
    ],
)
def test_the_convention_says_whether_the_figures_are_direct_current(
    convention: str | None, construction: str | None, direct_current: float, *, listed: bool
) -> None:
    found = from_rows([ROW | {"motor.electrical_convention": convention, "motor.motor_type": construction}])
    assert found.actuators.direct_current[0] == pytest.approx(direct_current, nan_ok=True)
    assert [one.column for one in found.assumed[0]] == (["motor.electrical_convention"] if listed else [])


def test_a_speed_constant_is_a_back_emf_constant_in_other_units() -> None:
    both = {"motor.speed_constant_rpm_per_v": 271.0}
    assert from_rows([ROW | both]).actuators.back_emf_constant[0] == pytest.approx(60.0 / (2.0 * pi * 271.0))
    both["motor.back_emf_constant_v_s_per_rad"] = 0.04
    assert from_rows([ROW | both]).actuators.back_emf_constant[0] == 0.04
    assert from_rows([ROW | both]).assumed == ((),)


def test_an_ac_servo_is_ranked_by_its_other_checks_and_says_so(own: Catalogue) -> None:
    add_drive(own, "servo", SERVO, **EFFICIENCY)
    selection = rank(without_assumptions(), own, where="id = 'servo'")
    servo = selection.ranked[0]
    assert servo.verdict == "meets"
    assert (servo.feasible_poses, servo.is_upper_bound, servo.assumptions) == (216, False, ())
    assert servo.checks[Check.VOLTAGE].state == "not_applicable"
    assert check_notes(selection.ranked) == [
        "servo: voltage not applicable, because its electrical figures are rms phase values of a servo amplifier."
    ]
    voltage = selection_record(selection)["actuators"][0]["checks"]["voltage"]
    assert voltage["state"] == "not_applicable"
    assert (voltage["poses"], voltage["missing"]) == (None, [])
    assert voltage["reason"] == "rms phase values of a servo amplifier"
    assert selection.frame().loc["servo", "voltage_state"] == "not_applicable"


@pytest.mark.parametrize("model", ["pseudo_inverse", "force_only"])
def test_models_places_and_connections_of_a_servo_are_those_without_the_voltage_check(
    own: Catalogue, model: str
) -> None:
    add_drive(own, "servo", SERVO | {"rated_torque_nm": 0.25}, **EFFICIENCY)
    asked = {
        "tension__model": model,
        "requirement__must_serve": [{"title": "middle", "position_m": [1.6, 1.1, -1.1]}],
        "workspace__home_m": [1.6, 1.1, -1.1],
    }
    found = [
        build_dossier(rank(without_assumptions(**asked, **more), own, where="id = 'servo'"), own)
        for more in ({}, {"checks__apply": ["speed", "torque", "acceleration"]})
    ]
    servo, without = (one.selection.ranked[0] for one in found)
    assert 0 < servo.feasible_poses < 216
    for name in ("verdict", "feasible_poses", "exact_poses", "connected_percent", "missed"):
        assert getattr(servo, name) == getattr(without, name)
    assert (servo.exact_poses is None) == (model == "pseudo_inverse")
    assert servo.connected_percent is not None
    assert found[0].models == found[1].models
    assert found[0].details[0].feasible.tolist() == found[1].details[0].feasible.tolist()


def test_a_servo_without_a_convention_is_not_evaluated_and_says_what_is_missing(own: Catalogue) -> None:
    add_drive(own, "servo", DC | {"motor_type": "pmsm_servo", "electrical_convention": None}, **EFFICIENCY)
    servo = rank(load_study("cpr8"), own, where="id = 'servo'").ranked[0]
    assert servo.verdict == "undecided"
    assert servo.checks[Check.VOLTAGE].state == "not_evaluated"
    assert servo.checks[Check.VOLTAGE].missing == ("electrical_convention",)


def test_without_the_table_nothing_is_assumed_and_the_key_that_helps_is_named(own: Catalogue) -> None:
    add_drive(own, "dc", DC | {"rotor_inertia_g_cm2": None}, gearbox={"max_efficiency_percent": 75})
    ranked = rank(without_assumptions(), own, where="id = 'dc'").ranked
    assert ranked[0].verdict == "undecided"
    assert ranked[0].assumptions == ()
    assert ranked[0].checks[Check.VOLTAGE].missing == ("friction", "rotor_inertia", "efficiency")
    notes = check_notes(ranked)
    assert notes[1] == (
        "dc: acceleration not evaluated, rotor inertia unknown: state it, or assumptions.rotor_inertia_g_cm2."
    )
    assert all(key in notes[2] for key in (FRICTION, SHARE, "assumptions.rotor_inertia_g_cm2"))


@pytest.mark.parametrize(
    ("gearbox", "key", "other"),
    [
        ({"max_efficiency_percent": 75}, SHARE, "assumptions.gearbox_efficiency_percent"),
        ({}, "assumptions.gearbox_efficiency_percent", SHARE),
    ],
)
def test_only_the_key_that_works_for_this_gearbox_is_named(
    own: Catalogue, gearbox: dict[str, object], key: str, other: str
) -> None:
    add_drive(own, "dc", DC, gearbox=gearbox)
    ranked = rank(without_assumptions(), own, where="id = 'dc'").ranked
    assert ranked[0].checks[Check.TORQUE].missing == ("efficiency",)
    (note,) = [note for note in check_notes(ranked) if "torque not evaluated" in note]
    assert note == f"dc: torque not evaluated, efficiency unknown: state it, or {key}."
    assert not any(other in note for note in check_notes(ranked))
    run = simulate(without_assumptions(), own, "dc", start=(0.5, 0.5, -0.5), stop=(2.5, 0.5, -0.5))
    assert key in unknown_words(run.missing[Check.TORQUE], run.assumable)
    assert other not in unknown_words(run.missing[Check.TORQUE], run.assumable)
    # The key that is named does help.
    study = without_assumptions(**{key.replace(".", "__"): 0.9 if key == SHARE else 70.0})
    assert rank(study, own, where="id = 'dc'").ranked[0].checks[Check.TORQUE].missing == ()


@pytest.mark.parametrize(
    ("checks", "model", "listed"),
    [
        (["speed"], "pseudo_inverse", []),
        (["speed", "torque"], "pseudo_inverse", ["efficiency"]),
        (["acceleration"], "pseudo_inverse", ["rotor_inertia"]),
        (["acceleration"], "wrench_feasible", ["rotor_inertia", "efficiency"]),
        (["voltage"], "pseudo_inverse", ["rotor_inertia", "friction", "efficiency", "direct_current"]),
    ],
)
def test_nothing_is_assumed_that_no_check_of_the_study_needs(
    own: Catalogue, checks: list[str], model: str, listed: list[str]
) -> None:
    add_drive(own, "dc", DC | {"electrical_convention": None, "rotor_inertia_g_cm2": None})
    study = load_study("cpr8", ALL_ASSUMED | {"checks.apply": checks, "tension.model": model})
    (dc,) = rank(study, own, where="id = 'dc'").ranked
    assert [one.figure for one in dc.assumptions] == listed
    assert all(dc.checks[Check(check)].missing == () for check in checks)
    assert marked(dc) == ("dc *" if listed else "dc")


def test_a_move_in_a_report_keeps_the_assumptions_that_its_own_limits_need_and_lists_them(own: Catalogue) -> None:
    add_drive(own, "dc", DC | {"rotor_inertia_g_cm2": None}, **EFFICIENCY)
    study = load_study("cpr8", ALL_ASSUMED | {"checks.apply": ["speed", "torque"], "variant": []})
    selection = rank(study, own, where="id = 'dc'")
    assert selection.ranked[0].assumptions == ()
    (_, run), *_ = build_dossier(selection, own).moves
    assert run.missing == {}
    page = " ".join(render_report(selection, own).split())
    assert "not evaluated" not in page
    assert f"Assumed: viscous friction 0 N m s/rad ({FRICTION})." in page


def test_every_assumption_is_listed_for_the_actuator_and_for_people(own: Catalogue) -> None:
    for name in "abcde":
        add_drive(own, name, DC | {"rotor_inertia_g_cm2": None}, gearbox={"max_efficiency_percent": 70 + ord(name) % 5})
    add_drive(own, "full", DC | {"viscous_friction_nm_s_per_rad": 1e-6}, **EFFICIENCY)
    selection = rank(load_study("cpr8", ALL_ASSUMED), own, where="id in ('a', 'b', 'c', 'd', 'e', 'full')")
    by_id = {one.id: one for one in selection.ranked}
    assert by_id["full"].assumptions == ()
    assert {one.key for one in by_id["a"].assumptions} == set(ALL_ASSUMED) - {"assumptions.gearbox_efficiency_percent"}
    notes = assumption_notes(selection.ranked)
    assert len(notes) == 3
    assert any("0.9 × the greatest that is stated, 63 to 66.6 %" in note for note in notes)
    assert all(note.endswith("and 2 more.") for note in notes)
    record = json.loads(json.dumps(selection_record(selection), allow_nan=False))
    listed = {one["id"]: one["assumptions"] for one in record["actuators"]}
    assert listed["full"] == []
    assert listed["a"][0] == {
        "figure": "rotor_inertia",
        "column": "motor.rotor_inertia_g_cm2",
        "value": 500.0,
        "unit": "g cm²",
        "key": "assumptions.rotor_inertia_g_cm2",
        "text": "rotor inertia 500 g cm²",
    }
    assumed = {part.id: [one.figure for one in part.assumed] for part in build_dossier(selection, own).parts}
    assert assumed["a-motor"] == ["rotor_inertia", "friction"]
    assert assumed["a-gearbox"] == ["efficiency"]
    assert assumed["full-motor"] == []


def test_names_are_counted_where_they_are_many() -> None:
    assert some_of(["a", "b", "c", "d"]) == "a, b, c, d"
    assert some_of(["a", "b", "c", "d", "e"]) == "a, b, c and 2 more"
    assert some_of(["a", "b", "c", "d", "e"], 5) == "all 5 actuators"


def test_a_variant_may_assume_something_else(own: Catalogue) -> None:
    add_drive(own, "dc", DC, **EFFICIENCY)
    variant = {"title": "friction", "set": {FRICTION: 1e-2}}
    study = load_study("cpr8", {"variant": [variant]})
    dossier = build_dossier(rank(study, own, where="id = 'dc'"), own)
    changed = dossier.variants[0].selection.ranked[0]
    assert [one.value for one in changed.assumptions] == [1e-2]
    assert changed.feasible_poses < dossier.selection.ranked[0].feasible_poses


def test_the_simulation_of_an_ac_servo_has_no_voltage(own: Catalogue) -> None:
    add_drive(own, "servo", SERVO | {"nominal_voltage_v": 1, "terminal_resistance_ohm": 5}, **EFFICIENCY)
    line = {"start": (0.5, 0.5, -0.5), "stop": (2.5, 0.5, -0.5)}
    run = simulate(load_study("cpr8"), own, "servo", **line)
    assert Check.VOLTAGE not in run.checks
    assert isnan(run.limits[Check.VOLTAGE])
    assert np.isnan(run.history.voltage).all()
    assert (run.missing, run.exceedances) == ({}, ())
    assert [name for name in run.frame().columns if "voltage" in name] == []
    record = json.loads(json.dumps(simulation_record(run), allow_nan=False))
    assert set(record["peaks"]) == set(record["limits"]) == {"speed", "torque", "acceleration"}
    assert record["not_applicable"] == {"voltage": "rms phase values of a servo amplifier"}


def test_a_simulation_takes_the_studys_assumptions_and_lists_them(own: Catalogue) -> None:
    add_drive(own, "dc", DC, **EFFICIENCY)
    line = {"start": (0.5, 0.5, -0.5), "stop": (2.5, 0.5, -0.5)}
    assert Check.VOLTAGE in simulate(without_assumptions(), own, "dc", **line).missing
    run = simulate(load_study("cpr8"), own, "dc", **line)
    assert run.missing == {}
    assert run.peaks[Check.VOLTAGE].max() > 0.0
    assert [one["key"] for one in simulation_record(run)["assumptions"]] == [FRICTION]
