"""Numbers of the case study: published in [1], or computed independently; `tests/reference/cpr8.json` says which.

[1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from actuator_select import Catalogue, Selection, Simulation, load_study, open_catalogue, rank, render_report, simulate
from actuator_select.model.actuation import Check
from actuator_select.model.evaluation import evaluate_actuators
from actuator_select.selection.candidates import find_candidates
from actuator_select.study import Study
from tests.selection.parts import PRINTED, add_twins

REFERENCE = json.loads((Path(__file__).parent / "reference" / "cpr8.json").read_text(encoding="utf-8"))
PUBLISHED, COMPUTED = REFERENCE["published"], REFERENCE["computed"]
SAMPLED_TESTS = COMPUTED["speed_torque_acceleration_tests_only"]
TURNED = {"workspace.orientations_rad": [[0.5, 0.5, 0.5]]}
BOTH_SIGNS = {"motion.acceleration_levels": [-1.0, 1.0]}
ALL_CHECKS = {"checks.apply": ["speed", "torque", "acceleration", "voltage"]}
NO_CENTRIPETAL = {"motion.centripetal": False}
MARGIN = float(np.linalg.norm([0.224, 0.154, 0.140])) / 2.0  # d_e
START, STOP = (MARGIN, MARGIN, -MARGIN), (3.2 - MARGIN, MARGIN, -MARGIN)


def ranked(catalogue: Catalogue, study: str, *overrides: Mapping[str, Any]) -> Selection:
    changes = {key: value for one in overrides for key, value in one.items()}
    return rank(load_study(study, changes), catalogue)


def counts(selection: Selection) -> list[int]:
    """Feasible positions of actuators 1 to 5."""
    by_name = {actuator.name: actuator.feasible_poses for actuator in selection.ranked}
    return [by_name[f"Actuator {number}"] for number in range(1, 6)]


def warned(selection: Selection) -> dict[str, int]:
    return {warning.code: warning.poses for warning in selection.warnings}


def test_the_study_is_the_one_of_the_reference(catalogue: Catalogue) -> None:
    study, reference = load_study("cpr8"), REFERENCE["study"]
    assert list(study.table.robot.frame_m or ()) == reference["frame_m"]
    assert list(study.table.robot.carrier_m or ()) == reference["carrier_m"]
    assert study.table.payload[0].mass_kg == reference["mass_kg"]
    assert study.table.gravity_m_per_s2 == reference["gravity_m_per_s2"]
    assert study.table.motion.speed_max_m_per_s == reference["speed_max_m_per_s"]
    assert study.table.motion.acceleration_time_s == reference["acceleration_time_s"]
    assert study.table.motion.deceleration_time_s == reference["deceleration_time_s"]
    assert len(catalogue.rows("actuators", where=PRINTED)) == 5


def test_the_published_reading_gives_table_2_but_for_actuator_5(catalogue: Catalogue) -> None:
    found = counts(ranked(catalogue, "cpr8-published"))
    assert found == SAMPLED_TESTS["accelerations {0, V/t} per axis (the reading of the study cpr8-published)"]["0_rad"]
    percent = [round(100.0 * count / 216, 2) for count in found[:4]]
    assert percent == [PUBLISHED["feasible_percent"][str(number)] for number in range(1, 5)]


def test_the_published_reading_gives_figure_5(catalogue: Catalogue) -> None:
    found = counts(ranked(catalogue, "cpr8-published", TURNED))[0]
    key = "accelerations {0, V/t} per axis (the reading of the study cpr8-published)"
    assert found == SAMPLED_TESTS[key]["0.5_rad_actuator_1"]
    assert round(100.0 * found / 216, 1) == PUBLISHED["feasible_percent_actuator_1_at_0.5_rad"]


def test_accelerations_of_both_signs(catalogue: Catalogue) -> None:
    expected = SAMPLED_TESTS["accelerations {-V/t, V/t} per axis"]
    assert counts(ranked(catalogue, "cpr8-published", BOTH_SIGNS)) == expected["0_rad"]
    assert counts(ranked(catalogue, "cpr8-published", BOTH_SIGNS, TURNED))[0] == expected["0.5_rad_actuator_1"]


def test_all_four_tests_over_the_samples(catalogue: Catalogue) -> None:
    expected = COMPUTED["all_tests_sampled_velocities_box_corner_accelerations_no_centripetal_term"]
    assert counts(ranked(catalogue, "cpr8-published", BOTH_SIGNS, ALL_CHECKS)) == expected["0_rad"]
    turned = ranked(catalogue, "cpr8-published", BOTH_SIGNS, ALL_CHECKS, TURNED)
    assert counts(turned)[0] == expected["0.5_rad_actuator_1"]


def test_all_four_tests_exactly(catalogue: Catalogue) -> None:
    expected = COMPUTED["all_tests_exact_over_velocity_ball_and_acceleration_box"]
    exact = expected["with_centripetal_term (the study cpr8)"]
    selection = ranked(catalogue, "cpr8")
    assert counts(selection) == exact["0_rad"]
    first = selection.ranked[0]
    assert first.name == "Actuator 1"
    assert first.checks[Check.ACCELERATION].poses == exact["acceleration_test_alone_actuator_1_0_rad"]
    assert counts(ranked(catalogue, "cpr8", TURNED))[0] == exact["0.5_rad_actuator_1"]
    flat = expected["without_centripetal_term"]
    assert counts(ranked(catalogue, "cpr8", NO_CENTRIPETAL)) == flat["0_rad"]
    assert counts(ranked(catalogue, "cpr8", NO_CENTRIPETAL, TURNED))[0] == flat["0.5_rad_actuator_1"]


def test_poses_where_cables_push_or_the_rank_is_short(catalogue: Catalogue) -> None:
    pushing = COMPUTED["poses_with_a_negative_pseudo_inverse_tension_at_rest"]
    rank_of = COMPUTED["structure_matrix_rank"]
    for changes, key in (({}, "0_rad"), (TURNED, "0.5_rad")):
        selection = ranked(catalogue, "cpr8", changes)
        assert warned(selection)["negative_tension_at_rest"] == pushing[key]
        assert set(selection.result.evaluation.demand.rank.tolist()) == {rank_of[key]}
    assert warned(ranked(catalogue, "cpr8"))["rank_deficient"] == 216
    assert "rank_deficient" not in warned(ranked(catalogue, "cpr8", TURNED))


def test_upright_gravity_is_balanced_and_every_horizontal_acceleration_is_not(catalogue: Catalogue) -> None:
    study = load_study("cpr8")
    assert warned(rank(study, catalogue))["unbalanced_wrench"] == 216
    assert "unbalanced_wrench" not in warned(ranked(catalogue, "cpr8", TURNED))
    residual = _residual(study)
    assert np.abs(residual[..., 0]).max() < 1e-12
    corners = np.array(np.meshgrid(*[[-1.0, 1.0]] * 3)).reshape(3, -1) * (1.3 / 1.82)
    yaw = np.abs(residual[:, 5, 1:] @ corners)
    assert (np.abs(residual[..., 1:] @ corners).max(axis=1) > 1e-6).all()
    assert yaw.max() == pytest.approx(0.253, abs=5e-4)


def _residual(study: Study) -> np.ndarray:
    from actuator_select.model.kinematics import cable_geometry
    from actuator_select.model.tension import pseudo_inverse

    geometry = cable_geometry(study.robot, study.positions, study.orientations[0])
    wrench = study.wrench(study.orientations[0])
    columns = np.column_stack([wrench.static, wrench.per_acceleration])
    return np.asarray(pseudo_inverse(geometry.structure_matrix).residual_maker @ columns)


def test_actuator_4_with_the_nominal_torque_of_its_motor(catalogue: Catalogue) -> None:
    expected = COMPUTED["actuator_4_with_its_rated_torque"]
    at_rest, moving = (
        {"motion.speed_max_m_per_s": 1e-6, **NO_CENTRIPETAL},
        {},
    )
    for torque, key in (
        (0.0455, "torque_test_only_0_rad_at_0.0455"),
        (20.0 / (5060.0 * np.pi / 30.0), "torque_test_only_0_rad_at_20_W_over_speed_0.0377"),
    ):
        for changes, motion in ((at_rest, "at_rest"), (moving, "accelerations {-V/t, V/t} per axis")):
            study = load_study("cpr8", changes)
            candidates = find_candidates(study, catalogue, "name = 'Actuator 4'")
            corrected = replace(candidates.actuators, motor_torque=np.array([torque]))
            demand = ranked(catalogue, "cpr8", changes).result.evaluation.demand
            assert evaluate_actuators(demand, corrected, [Check.TORQUE]).positions.tolist() == [expected[key][motion]]


@pytest.mark.parametrize(("angle", "key"), [(0.0, "0_rad"), (0.5, "0.5_rad")])
def test_the_move_of_figure_6(catalogue: Catalogue, angle: float, key: str) -> None:
    expected = COMPUTED["trajectory_top_edge"][key]
    run = simulate(load_study("cpr8"), catalogue, "Actuator 1", start=START, stop=STOP, orientation=[angle] * 3)
    assert run.duration == pytest.approx(4.046335, abs=2e-6)
    assert largest(run, Check.TORQUE) == pytest.approx(expected["max_abs_torque_nm"], abs=6e-6)
    assert largest(run, Check.VOLTAGE) == pytest.approx(expected["max_abs_voltage_v"], abs=6e-4)
    assert largest(run, Check.SPEED) == pytest.approx(expected["max_abs_speed_rad_per_s"], abs=6e-4)
    over = {check: sorted({one.actuator for one in run.exceedances if one.check is check}) for check in Check}
    assert over[Check.TORQUE] == expected.get("over_torque", [])
    assert not over[Check.SPEED]
    assert not over[Check.VOLTAGE]
    flat = simulate(
        load_study("cpr8", NO_CENTRIPETAL), catalogue, "Actuator 1", start=START, stop=STOP, orientation=[angle] * 3
    )
    assert largest(flat, Check.VOLTAGE) == pytest.approx(
        expected["max_abs_voltage_v_without_centripetal_term"], abs=6e-4
    )


def largest(run: Simulation, check: Check) -> float:
    return float(run.peaks[check].max())


@pytest.fixture
def with_twins() -> Iterator[tuple[Catalogue, list[str]]]:
    """The catalogue with the real motors of actuators 4 and 5 beside the printed rows, and the ids of these twins."""
    with open_catalogue(":memory:") as own:
        yield own, add_twins(own)


def test_the_twin_of_actuator_4_holds_the_torque_of_its_real_motor(with_twins: tuple[Catalogue, list[str]]) -> None:
    catalogue, (twin, _) = with_twins
    expected = COMPUTED["actuator_4_with_its_rated_torque"]["torque_test_only_0_rad_at_0.0455"]
    motion = {"candidates.where": f"id = '{twin}'", "checks.apply": ["torque"]}
    moving = "accelerations {-V/t, V/t} per axis"
    assert ranked(catalogue, "cpr8-published", motion, BOTH_SIGNS).ranked[0].feasible_poses == expected[moving] == 68
    at_rest = {"motion": {"set": "rest"}}
    assert ranked(catalogue, "cpr8-published", motion, at_rest).ranked[0].feasible_poses == expected["at_rest"]


def test_the_published_study_ranks_the_printed_rows_alone(with_twins: tuple[Catalogue, list[str]]) -> None:
    catalogue, twins = with_twins
    selection = ranked(catalogue, "cpr8-published")
    assert sorted(one.id[-1] for one in selection.ranked) == list("12345")
    assert counts(selection) == [216, 208, 184, 188, 0]
    everything = {one.id for one in ranked(catalogue, "cpr8").ranked}
    assert everything >= {*twins, *(one.id for one in selection.ranked)}


def test_twins_stand_beside_the_printed_rows_and_not_in_the_comparison(
    with_twins: tuple[Catalogue, list[str]],
) -> None:
    catalogue, twins = with_twins
    selection = rank(load_study("cpr8"), catalogue, where="id contains 'filipovic-kevac-2018'")
    by_id = {one.id: one for one in selection.ranked}
    assert by_id[twins[0]].verdict == by_id[twins[1]].verdict == "fails"
    assert [one.key for one in by_id[twins[0]].assumptions] == ["assumptions.viscous_friction_nm_s_per_rad"]
    assert by_id["filipovic-kevac-2018-4"].assumptions == ()
    page = render_report(selection, catalogue)
    section = page[page.index("The same study, read otherwise") : page.index("<h2>Parts and sources")]
    compared, others = section.split("Actuators that the publication does not have")
    assert re.findall(r'<th class="name">(.*?)</th>', compared) == [f"Actuator {number}" for number in range(1, 6)]
    assert re.findall(r"([\d.]+) %</td>", compared[compared.index("Published:") :]) == [
        f"{percent:g}" for percent in PUBLISHED["feasible_percent"].values()
    ]
    assert "Actuator 4 (maxon 236662)" in others
    assert "Published:" not in others
    assert "Printed actuators and real parts" in page
