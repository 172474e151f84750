"""Tensions of trajectories: they balance, they keep their bounds wherever that is possible, they do not jump."""

from dataclasses import replace

import numpy as np
import pytest

from actuator_select.model.distribution import Distribution, distribute
from actuator_select.model.robot import CableRobot, Freedom
from actuator_select.model.tension import TensionModel
from tests.model.test_joint import FREEDOMS, Case, a_case
from tests.reference.moving_platform import structure

COUNT = 60
PROGRAMS = ["wrench_feasible", "force_only"]


def bounded(case: Case, most: float) -> CableRobot:
    bounds = replace(case.robot.bounds, tension_max=np.full(case.robot.cables, most))
    return replace(case.robot, bounds=bounds, counterbalances=())


def tensions(robot: CableRobot, model: TensionModel, case: Case, positions: np.ndarray) -> Distribution:
    wrenches = np.tile(case.wrenches[0][0].static, (len(positions), 1))
    return distribute(robot, model, positions, np.zeros(3), wrenches)


def left_over(robot: CableRobot, case: Case, positions: np.ndarray, tension: np.ndarray, rows: list[int]) -> np.ndarray:
    """Largest component of the wrench that tensions do not supply, (S,)."""
    supplied = [
        structure(robot.frame_anchors, position, robot.platform_anchors) @ one
        for position, one in zip(positions, tension, strict=True)
    ]
    return np.abs(np.array(supplied) - case.wrenches[0][0].static)[:, rows].max(axis=1)


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("model", [TensionModel(one) for one in PROGRAMS])
@pytest.mark.parametrize("most", [75.0, 150.0, np.inf])
def test_tensions_balance_within_bounds_wherever_some_do(freedom: Freedom, model: TensionModel, most: float) -> None:
    feasible_instants = 0
    for seed in range(4):
        case = a_case(freedom, seed, count=COUNT)
        robot = bounded(case, most)
        found = tensions(robot, model, case, case.positions)
        feasible = np.isfinite(found.minimax_tension)
        feasible_instants += int(feasible.sum())
        assert np.array_equal(np.isnan(found.tension).any(axis=1), ~feasible)
        tension = found.tension[feasible]
        rows = list(robot.translation_rows if model is TensionModel.FORCE_ONLY else robot.wrench_rows)
        size = np.linalg.norm(case.wrenches[0][0].static) + tension.max(axis=1)
        assert (left_over(robot, case, case.positions[feasible], tension, rows) <= 1e-9 * size).all()
        slack = 1e-9 * size[:, None]
        assert (tension >= robot.bounds.tension_min - slack).all()
        assert (tension <= robot.bounds.tension_max + slack).all()
    assert feasible_instants > 0


def test_tensions_of_the_pseudo_inverse_are_those_of_least_norm() -> None:
    case = a_case(Freedom.SPATIAL, 2, count=COUNT)
    found = tensions(case.robot, TensionModel.PSEUDO_INVERSE, case, case.positions)
    for position, tension in zip(case.positions, found.tension, strict=True):
        whole = structure(case.robot.frame_anchors, position, case.robot.platform_anchors)
        assert tension == pytest.approx(np.linalg.pinv(whole) @ case.wrenches[0][0].static, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_tensions_do_not_jump_along_a_line(freedom: Freedom) -> None:
    case = a_case(freedom, 2)
    robot = bounded(case, 400.0)
    line = np.linspace(0.0, 1.0, 2001)[:, None] * (case.positions[1] - case.positions[0]) + case.positions[0]
    found = tensions(robot, TensionModel.WRENCH_FEASIBLE, case, line)
    assert np.isfinite(found.minimax_tension).all()
    steps = np.abs(np.diff(found.tension, axis=0)).max(axis=1)
    assert steps.max() <= 0.02 * found.tension.max()
