"""Minimax tensions and margins against linear programs, and what has to hold for any robot."""

from dataclasses import replace

import numpy as np
import pytest

from actuator_select.model.feasibility import Holding, hold_wrenches
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets
from tests.reference.linear_programs import Limits, Problem, random_problem

ROUNDING = 1e-9  # relative, of what two ways of the same arithmetic may differ by


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


def drawn(count: int, **wanted: object) -> list[Problem]:
    """Random problems with given properties: a freedom, or only full rank."""
    found: list[Problem] = []
    seed = 500_000
    while len(found) < count:
        problem = random_problem(seed)
        seed += 1
        full = (np.linalg.matrix_rank(problem.columns, tol=1e-6) == problem.columns.shape[1]).all()
        if wanted.get("freedom", problem.freedom) == problem.freedom and (full or not wanted.get("full")):
            found.append(problem)
    return found


@pytest.mark.parametrize("freedom", ["3T", "3R3T"])
def test_turning_the_world_leaves_tension_margin_and_rank_unchanged(freedom: str) -> None:
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    for problem in drawn(30, freedom=freedom):
        both = turn if freedom == "3T" else np.kron(np.eye(2), turn)
        turned = replace(
            problem,
            columns=both @ problem.columns,
            shift=problem.shift @ both.T,
            centre=problem.centre @ both.T,
            segments=problem.segments @ both.T,
        )
        before, after = hold(problem), hold(turned)
        assert np.array_equal(before.rank, after.rank)
        assert after.minimax_tension == pytest.approx(before.minimax_tension, rel=ROUNDING)
        assert after.margin == pytest.approx(before.margin, rel=ROUNDING, abs=1e-9)


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
