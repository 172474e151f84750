"""The scalar loops against the published and the independently computed numbers of cpr8.json."""

import json
import math
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from tests.reference.move_cpr8 import simulate, top_edge
from tests.reference.scalar_cpr8 import (
    CHECKS,
    PAPER_CHECKS,
    TABLE_1,
    Actuator,
    Case,
    acceleration_samples,
    count_poses,
    count_poses_each,
    largest_share,
    motion_samples,
    passes,
    pose_at,
    pose_grid,
    sample_pose,
    structure_rank,
    tensions_at,
    unbalanced,
    utilisation,
    velocity_samples,
    worst_utilisation,
)
from tests.reference.search_cpr8 import count_poses_exactly, exact_extremes, exact_utilisation

REFERENCE: dict[str, Any] = json.loads((Path(__file__).parent / "cpr8.json").read_text(encoding="utf-8"))
PUBLISHED, COMPUTED = REFERENCE["published"], REFERENCE["computed"]

LEVEL = Case()
TURNED = replace(LEVEL, orientation=(0.5, 0.5, 0.5))
CASES = {"0_rad": LEVEL, "0.5_rad": TURNED}
AT_REST = (0.0,)
BOTH_SIGNS = "accelerations {-V/t, V/t} per axis"
FROM_ZERO = "accelerations {0, V/t} per axis (the reading of the study cpr8-published)"
LEVELS = {BOTH_SIGNS: (-1.0, 1.0), FROM_ZERO: (0.0, 1.0)}
VOLTS_TO_ONE = 500.0  # SLSQP breaks off unless the objective is of the order of one
# The cheapest and the most selective first: the counts do not depend on the order, their time does.
EXACT_CHECKS = ("torque", "voltage", "acceleration", "speed")


def _printed(value: float, digits: int) -> float:
    """The rounding of the reference file's own figures, so that they are compared as they are printed."""
    return pytest.approx(value, rel=0.0, abs=0.5000001 * 10.0**-digits)


def test_the_default_case_is_the_published_study() -> None:
    study = REFERENCE["study"]
    assert list(LEVEL.frame) == study["frame_m"]
    assert list(LEVEL.carrier) == study["carrier_m"]
    assert study["mass_kg"] == LEVEL.mass
    assert study["gravity_m_per_s2"] == LEVEL.gravity
    assert study["speed_max_m_per_s"] == LEVEL.speed
    assert study["acceleration_time_s"] == LEVEL.acceleration_time
    assert study["deceleration_time_s"] == LEVEL.deceleration_time


def test_the_samples_are_those_of_the_study() -> None:
    assert len(pose_grid(LEVEL)) == 216
    assert len(velocity_samples(LEVEL)) == 123
    assert motion_samples(LEVEL) == 123 * 8


def test_the_grid_reaches_both_ends_of_the_geometric_workspace() -> None:
    margin = math.sqrt(0.112**2 + 0.077**2 + 0.07**2)
    grid = pose_grid(LEVEL)
    assert grid[0] == pytest.approx((margin, margin, margin - 2.2))
    assert grid[-1] == pytest.approx((3.2 - margin, 2.2 - margin, -margin))


def test_each_published_percentage_is_a_count_out_of_216() -> None:
    for percent, count in PUBLISHED["percentages_are_counts_of_216"].items():
        digits = len(percent.partition(".")[2])
        assert float(percent) == round(100.0 * count / 216, digits)


@pytest.mark.parametrize("reading", LEVELS)
def test_speed_torque_and_acceleration_give_the_computed_counts(reading: str) -> None:
    level = replace(LEVEL, centripetal=False, acceleration_levels=LEVELS[reading])
    turned = replace(level, orientation=TURNED.orientation)
    expected = COMPUTED["speed_torque_acceleration_tests_only"][reading]
    assert count_poses_each(level, TABLE_1, PAPER_CHECKS) == expected["0_rad"]
    assert count_poses(turned, TABLE_1[0], PAPER_CHECKS) == expected["0.5_rad_actuator_1"]


def test_the_published_table_is_reproduced_for_actuators_1_to_4() -> None:
    level = replace(LEVEL, centripetal=False, acceleration_levels=LEVELS[FROM_ZERO])
    turned = replace(level, orientation=TURNED.orientation)
    counts = count_poses_each(level, TABLE_1[:4], PAPER_CHECKS)
    percents = [round(100.0 * count / 216, 2) for count in counts]
    assert percents == [PUBLISHED["feasible_percent"][str(number)] for number in (1, 2, 3, 4)]
    turned_percent = 100.0 * count_poses(turned, TABLE_1[0], PAPER_CHECKS) / 216
    assert round(turned_percent, 1) == PUBLISHED["feasible_percent_actuator_1_at_0.5_rad"]


def test_actuator_5_holds_4_poses_at_rest_and_16_only_with_another_efficiency() -> None:
    resting = replace(LEVEL, acceleration_levels=AT_REST)
    better = replace(TABLE_1[4], efficiency=0.85)
    assert TABLE_1[4].limit("torque") == pytest.approx(0.546)
    assert count_poses_each(resting, [TABLE_1[4], better], ("torque",)) == [4, 16]


def test_all_four_sampled_tests_give_the_computed_counts() -> None:
    expected = COMPUTED["all_tests_sampled_velocities_box_corner_accelerations_no_centripetal_term"]
    level = replace(LEVEL, centripetal=False)
    assert count_poses_each(level, TABLE_1, CHECKS) == expected["0_rad"]
    turned = replace(level, orientation=TURNED.orientation)
    assert count_poses(turned, TABLE_1[0], CHECKS) == expected["0.5_rad_actuator_1"]


@pytest.mark.parametrize(
    ("label", "centripetal"), [("with_centripetal_term (the study cpr8)", True), ("without_centripetal_term", False)]
)
def test_the_exact_worst_case_gives_the_computed_counts(*, label: str, centripetal: bool) -> None:
    expected = COMPUTED["all_tests_exact_over_velocity_ball_and_acceleration_box"][label]
    level, turned = replace(LEVEL, centripetal=centripetal), replace(TURNED, centripetal=centripetal)
    assert [count_poses_exactly(level, actuator, EXACT_CHECKS) for actuator in TABLE_1] == expected["0_rad"]
    assert count_poses_exactly(turned, TABLE_1[0], EXACT_CHECKS) == expected["0.5_rad_actuator_1"]


def test_the_exact_acceleration_test_alone_gives_the_computed_count() -> None:
    expected = COMPUTED["all_tests_exact_over_velocity_ball_and_acceleration_box"]
    count = expected["with_centripetal_term (the study cpr8)"]["acceleration_test_alone_actuator_1_0_rad"]
    assert count_poses_exactly(LEVEL, TABLE_1[0], ("acceleration",)) == count


@pytest.mark.parametrize("name", CASES)
def test_the_simulated_move_has_the_computed_peaks(name: str) -> None:
    expected, actuator = COMPUTED["trajectory_top_edge"][name], TABLE_1[0]
    start, end = top_edge(CASES[name])
    instants = simulate(CASES[name], actuator, start, end)
    flat = simulate(replace(CASES[name], centripetal=False), actuator, start, end)
    assert instants[-1].time == _printed(4.046335, 6)
    assert instants[-1].position == pytest.approx(end)
    assert max(abs(torque) for i in instants for torque in i.torques) == _printed(expected["max_abs_torque_nm"], 5)
    assert max(abs(u) for i in instants for u in i.voltages) == _printed(expected["max_abs_voltage_v"], 3)
    without = expected["max_abs_voltage_v_without_centripetal_term"]
    assert max(abs(u) for i in flat for u in i.voltages) == _printed(without, 3)
    fastest = max(abs(speed) for i in instants for speed in i.speeds)
    assert fastest == _printed(expected["max_abs_speed_rad_per_s"], 3)


@pytest.mark.parametrize("name", CASES)
def test_the_simulated_move_exceeds_the_limits_that_the_paper_reports(name: str) -> None:
    expected, actuator = COMPUTED["trajectory_top_edge"][name], TABLE_1[0]
    instants = simulate(CASES[name], actuator, *top_edge(CASES[name]))

    def over(attribute: str, limit: float) -> list[int]:
        worst = [max(abs(getattr(i, attribute)[cable]) for i in instants) for cable in range(8)]
        return [cable + 1 for cable, value in enumerate(worst) if value > limit]

    assert over("torques", actuator.limit("torque")) == expected.get("over_torque", [])
    assert over("speeds", actuator.limit("speed")) == []
    assert over("voltages", actuator.limit("voltage")) == []


def test_the_shaft_speeds_and_accelerations_are_derivatives_along_the_move() -> None:
    instants = simulate(TURNED, TABLE_1[0], *top_edge(TURNED), steps=400)
    radius = TABLE_1[0].radius_m
    before, here, after = instants[199:202]  # inside the first phase
    step = after.time - here.time
    lengths = [pose_at(TURNED, instant.position).lengths for instant in (before, here, after)]
    for cable in range(8):
        last, now, following = (row[cable] for row in lengths)
        speed = -(following - last) / (2.0 * step * radius)
        acceleration = -(following - 2.0 * now + last) / (step**2 * radius)
        assert here.speeds[cable] == pytest.approx(speed, rel=1e-4)
        assert here.accelerations[cable] == pytest.approx(acceleration, rel=1e-3)


@pytest.mark.parametrize("name", CASES)
def test_the_pseudo_inverse_pushes_at_as_many_poses_as_computed(name: str) -> None:
    poses = [pose_at(CASES[name], position) for position in pose_grid(CASES[name])]
    pushing = sum(min(tensions_at(CASES[name], pose, (0.0, 0.0, 0.0))) < -1e-9 for pose in poses)
    assert pushing == COMPUTED["poses_with_a_negative_pseudo_inverse_tension_at_rest"][name]


@pytest.mark.parametrize("name", CASES)
def test_the_structure_matrix_has_the_computed_rank_at_every_pose(name: str) -> None:
    ranks = {structure_rank(CASES[name], position) for position in pose_grid(CASES[name])}
    assert ranks == {COMPUTED["structure_matrix_rank"][name]}


def test_at_zero_orientation_gravity_is_balanced_and_no_corner_acceleration_is() -> None:
    resting, left_over = [], []
    for position in pose_grid(LEVEL):
        pose = pose_at(LEVEL, position)
        resting.append(max(map(abs, unbalanced(LEVEL, pose, (0.0, 0.0, 0.0)))))
        left_over.extend(unbalanced(LEVEL, pose, corner) for corner in acceleration_samples(LEVEL))
    assert max(resting) < 1e-12
    assert min(max(map(abs, residual)) for residual in left_over) > 1e-6
    assert max(abs(residual[5]) for residual in left_over) == _printed(0.253, 3)  # yaw, as in pseudo_inverse_balance


@pytest.mark.parametrize(
    ("torque_nm", "label"),
    [
        (0.0455, "torque_test_only_0_rad_at_0.0455"),
        (20.0 / (5060.0 * math.pi / 30.0), "torque_test_only_0_rad_at_20_W_over_speed_0.0377"),
    ],
)
def test_actuator_4_with_a_rated_torque_gives_the_computed_counts(torque_nm: float, label: str) -> None:
    expected = COMPUTED["actuator_4_with_its_rated_torque"][label]
    rated = replace(TABLE_1[3], torque_nm=torque_nm)
    resting = replace(LEVEL, acceleration_levels=AT_REST)
    assert count_poses(resting, rated, ("torque",)) == expected["at_rest"]
    assert count_poses(LEVEL, rated, ("torque",)) == expected[BOTH_SIGNS]


def test_early_exit_agrees_with_the_full_utilisation() -> None:
    for position, actuator, check in product(pose_grid(LEVEL)[::43], TABLE_1, CHECKS):
        assert passes(LEVEL, actuator, check, position) == (utilisation(LEVEL, actuator, check, position) <= 1.0)


def test_the_worst_utilisation_is_that_of_the_worst_pose() -> None:
    small = replace(LEVEL, grid_points=2)
    worst = max(utilisation(small, TABLE_1[1], "voltage", position) for position in pose_grid(small))
    assert worst_utilisation(small, TABLE_1[1], "voltage") == worst
    assert worst > utilisation(small, TABLE_1[1], "voltage", (1.6, 1.1, -1.1))


@pytest.mark.parametrize("check", CHECKS)
def test_no_sample_exceeds_the_exact_worst_case(check: str) -> None:
    for position, case in product(((0.2, 0.3, -0.4), (1.6, 1.1, -1.1), (3.0, 2.0, -2.0)), CASES.values()):
        sampled = largest_share(case, sample_pose(case, position), TABLE_1[0], check)
        exact = exact_utilisation(case, TABLE_1[0], check, position)
        assert sampled <= exact * (1.0 + 1e-9)
        assert sampled > 0.9 * exact


def _climbed(case: Case, actuator: Actuator, cable: int, sign: float) -> float:
    """The greatest sign × voltage found by a general-purpose optimiser over velocity and acceleration together."""
    position = (0.25, 0.25, -0.25)
    pose = pose_at(case, position)
    u, length = np.array(pose.directions[cable]), pose.lengths[cable]
    radius, top = actuator.radius_m, case.speed / case.acceleration_time

    def lost(state: np.ndarray) -> float:
        v, a = state[:3] * case.speed, state[3:] * top
        turning = (u @ a - (v @ v - (u @ v) ** 2) / length) / radius
        torque = tensions_at(case, pose, tuple(a))[cable] * radius
        volts = actuator.inertial * turning + actuator.damping * (u @ v) / radius + actuator.geometric * torque
        return -sign * volts / VOLTS_TO_ONE

    ball = {"type": "ineq", "fun": lambda state: 1.0 - state[:3] @ state[:3]}
    starts = np.random.default_rng(7).uniform(-0.5, 0.5, (6, 6))
    bounds = [(-1.0, 1.0)] * 6
    runs = [minimize(lost, s, method="SLSQP", bounds=bounds, constraints=ball, tol=1e-10) for s in starts]
    assert all(run.success for run in runs)
    return -VOLTS_TO_ONE * min(run.fun for run in runs)


@pytest.mark.parametrize("speed", [1.3, 12.0])  # at 12 m/s the lower extreme lies off the cable's direction
def test_the_search_agrees_with_a_general_purpose_optimiser(speed: float) -> None:
    case, actuator = replace(TURNED, speed=speed), TABLE_1[0]
    extremes = exact_extremes(case, actuator, "voltage", (0.25, 0.25, -0.25))
    for cable in (0, 4):  # the two that end near this corner
        assert -_climbed(case, actuator, cable, -1.0) == pytest.approx(extremes[cable][0], rel=1e-6)
        assert _climbed(case, actuator, cable, 1.0) == pytest.approx(extremes[cable][1], rel=1e-6)
