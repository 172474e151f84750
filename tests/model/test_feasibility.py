"""Minimax tensions and margins against linear programs, and what has to hold for any robot."""

import numpy as np
import pytest

from actuator_select.model.feasibility import Holding, hold_wrenches
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets
from tests.reference.linear_programs import Limits, Problem


def hold(problem: Problem, balls: np.ndarray | None = None) -> Holding:
    poses, sets, rows = problem.centre.shape
    if balls is None:
        balls = np.zeros((poses, sets, 0, rows, 3))
    return hold_wrenches(
        problem.columns,
        WrenchSets(centre=problem.centre, segments=problem.segments, balls=balls),
        np.arange(poses),
        problem.shift,
        bounds_of(problem),
    )


def bounds_of(problem: Problem) -> ColumnBounds:
    limits = problem.limits
    return ColumnBounds(lower=limits.lower, upper=limits.upper, shared=limits.shared)


def test_a_counterbalance_without_an_upper_bound_holds_whatever_lies_along_it() -> None:
    columns = np.array([[[1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]]) / np.array([np.sqrt(2.0), np.sqrt(2.0), 1.0])
    problem = Problem(
        freedom="2T",
        layouts=("general",),
        columns=columns,
        shift=np.zeros((1, 2)),
        limits=Limits(lower=np.zeros(3), upper=np.array([50.0, 50.0, np.inf]), shared=np.array([True, True, False])),
        centre=np.array([[[0.0, 1000.0], [10.0, 1000.0]]]),
        segments=np.zeros((1, 2, 0, 2)),
    )
    holding = hold(problem)
    assert holding.minimax_tension[0] == pytest.approx([0.0, 10.0 * np.sqrt(2.0)])
    assert holding.margin[0] == pytest.approx([50.0 / np.sqrt(2.0), 50.0 / np.sqrt(2.0) - 10.0])
