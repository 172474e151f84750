"""Minimax tensions and margins against linear programs, and what has to hold for any robot."""

from collections import Counter
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from actuator_select.model import feasibility
from actuator_select.model.feasibility import Holding, hold_wrenches
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets, minimax_by_numpy
from tests.reference.linear_programs import (
    Limits,
    Problem,
    ball_minimax_tension,
    is_border,
    minimax_tension,
    random_problem,
    vertices,
)

CASES_PER_PROBLEM = 8  # four poses, two sets of wrenches at each
# HiGHS may leave every row and bound 1e-10 N short. Duality turns that into at most 1e-10 N times the tension that one
# newton at the platform takes, up to some hundreds, in a τ of 1 to 1000 N. Its last step is a solved vertex, so that
# it is mostly at 1e-12.
SOLVER = 1e-9  # relative
ROUNDING = 1e-9  # relative, of what two ways of the same arithmetic may differ by
EXCUSED = 0.01  # most of the cases that may lie on a border


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


def on_border(problem: Problem, pose: int, which: int) -> bool:
    corners = vertices(problem.centre[pose, which], problem.segments[pose, which])
    return is_border(problem.columns[pose], corners, problem.shift[pose], problem.limits)


@dataclass(slots=True)
class Tally:
    """Outcome of a comparison."""

    cases: int = 0
    feasible: int = 0
    deficient: int = 0
    border: int = 0
    differing: list[tuple[object, ...]] = field(default_factory=list)
    deviation: float = 0.0
    seen: Counter[tuple[str, str, bool]] = field(default_factory=Counter)


def compare(seeds: range) -> Tally:
    """Verdicts that differ are excused where the linear programs' own verdict hangs on `BORDER` of the forces."""
    tally = Tally()
    for seed in seeds:
        problem = random_problem(seed)
        holding = hold(problem)
        for pose, which in np.ndindex(holding.minimax_tension.shape):
            mine = holding.minimax_tension[pose, which]
            corners = vertices(problem.centre[pose, which], problem.segments[pose, which])
            theirs = minimax_tension(problem.columns[pose], corners, problem.shift[pose], problem.limits)
            tally.cases += 1
            tally.feasible += bool(np.isfinite(theirs))
            tally.deficient += bool(holding.rank[pose] < problem.columns.shape[1])
            tally.seen[problem.freedom, problem.layouts[pose], bool(np.isfinite(theirs))] += 1
            if np.isfinite(mine) != np.isfinite(theirs):
                if on_border(problem, pose, which):
                    tally.border += 1
                else:
                    tally.differing.append((seed, pose, which, mine, theirs))
            elif np.isfinite(mine) and mine != theirs:
                tally.deviation = max(tally.deviation, abs(mine - theirs) / max(mine, theirs))
    return tally


def check(tally: Tally) -> None:
    print(tally)  # noqa: T201 - shown by pytest -s, and where the test fails
    assert tally.differing == []
    assert tally.border <= EXCUSED * tally.cases
    assert tally.deviation <= SOLVER
    # The cases are worth their name: both verdicts, short ranks, and every layout of every robot.
    assert 0.25 < tally.feasible / tally.cases < 0.75
    assert tally.deficient > 0.2 * tally.cases
    assert len({(freedom, layout) for freedom, layout, _ in tally.seen}) == 24


def test_2000_random_cases_agree_with_linear_programs() -> None:
    check(compare(range(2000 // CASES_PER_PROBLEM)))


@pytest.mark.slow
def test_20000_random_cases_agree_with_linear_programs() -> None:
    check(compare(range(1_000_000, 1_000_000 + 20_000 // CASES_PER_PROBLEM)))


def test_a_wrench_on_a_facet_counts_as_border_and_one_beside_it_does_not() -> None:
    columns, shift = np.array([[-1.0, 1.0]]), np.zeros(1)
    limits = Limits(lower=np.zeros(2), upper=np.full(2, 100.0), shared=np.array([True, True]))
    found = [is_border(columns, np.array([[force]]), shift, limits) for force in (100.0, 100.0 + 1e-6, 100.0 - 1e-6)]
    assert found == [True, False, False]


def test_the_compiled_kernel_equals_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = pytest.importorskip("actuator_select.model.hyperplane_kernel")
    border = cases = 0
    for seed in range(150):
        problem = random_problem(seed)
        poses, sets, rows = problem.centre.shape
        generator = np.random.default_rng(seed)
        balls = generator.uniform(-1.0, 1.0, (poses, sets, int(seed % 3), rows, 3))
        holdings = []
        for minimax in (minimax_by_numpy, kernel.minimax):
            monkeypatch.setattr(feasibility, "_tools", lambda _, minimax=minimax: (minimax, None))
            holdings.append(hold(problem, balls))
        by_numpy, compiled = holdings
        cases += poses * sets
        differ = np.isfinite(by_numpy.minimax_tension) != np.isfinite(compiled.minimax_tension)
        for pose, which in np.argwhere(differ):
            # On the border is what has hardly any margin, with or without balls.
            size = np.linalg.norm(problem.centre[pose, which]) + np.linalg.norm(problem.shift[pose])
            assert abs(by_numpy.margin[pose, which]) <= ROUNDING * size
            border += 1
        both = np.isfinite(by_numpy.minimax_tension) & ~differ
        assert compiled.minimax_tension[both] == pytest.approx(by_numpy.minimax_tension[both], rel=1e-12)
        bounded = np.isfinite(by_numpy.margin)
        assert np.array_equal(bounded, np.isfinite(compiled.margin))
        scale = np.abs(by_numpy.margin[bounded]).max(initial=1.0) + np.abs(problem.centre).max()
        assert compiled.margin[bounded] == pytest.approx(by_numpy.margin[bounded], abs=1e-12 * scale)
    assert border <= EXCUSED * cases


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


def with_bounds(problem: Problem, lower: float, upper: float) -> Problem:
    ones = np.ones(len(problem.limits.lower))
    return replace(problem, limits=Limits(lower=lower * ones, upper=upper * ones, shared=problem.limits.shared))


def test_a_pose_is_feasible_exactly_if_its_margin_is_not_negative() -> None:
    seen = Counter[bool]()
    for problem in drawn(100):
        holding = hold(problem)
        size = np.linalg.norm(problem.centre, axis=-1) + np.linalg.norm(problem.shift, axis=-1)[:, None]
        clear = np.abs(holding.margin) > ROUNDING * size
        assert np.array_equal(np.isfinite(holding.minimax_tension)[clear], holding.margin[clear] > 0.0)
        seen.update((holding.margin[clear] > 0.0).tolist())
    assert min(seen[True], seen[False]) > 100


def test_scaling_all_forces_scales_tension_and_margin() -> None:
    for problem in drawn(60):
        limits = problem.limits
        scaled = replace(
            problem,
            centre=7.0 * problem.centre,
            segments=7.0 * problem.segments,
            shift=7.0 * problem.shift,
            limits=Limits(lower=7.0 * limits.lower, upper=7.0 * limits.upper, shared=limits.shared),
        )
        one, seven = hold(problem), hold(scaled)
        assert seven.minimax_tension == pytest.approx(7.0 * one.minimax_tension, rel=ROUNDING)
        assert seven.margin == pytest.approx(7.0 * one.margin, rel=ROUNDING, abs=1e-9)


def test_a_larger_upper_bound_never_lowers_the_margin_nor_raises_the_tension() -> None:
    for problem in drawn(60):
        limits = problem.limits
        wider = replace(problem, limits=Limits(lower=limits.lower, upper=1.3 * limits.upper, shared=limits.shared))
        before, after = hold(problem), hold(wider)
        assert np.all((after.margin >= before.margin) | np.isclose(after.margin, before.margin, rtol=0.0, atol=1e-9))
        assert np.all(after.minimax_tension <= before.minimax_tension * (1.0 + ROUNDING))


def test_another_cable_never_raises_the_tension_where_cables_may_go_slack() -> None:
    for problem in drawn(60):
        more = with_bounds(problem, 0.0, 200.0)
        less = replace(
            more,
            columns=more.columns[..., 1:],
            limits=Limits(lower=more.limits.lower[1:], upper=more.limits.upper[1:], shared=more.limits.shared[1:]),
        )
        if less.columns.shape[2] and less.limits.shared.any():
            assert np.all(hold(more).minimax_tension <= hold(less).minimax_tension * (1.0 + ROUNDING))


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


def test_tension_and_margin_of_a_set_are_those_of_its_worst_vertex() -> None:
    for problem in drawn(60):
        holding = hold(problem)
        for pose, which in np.ndindex(holding.margin.shape):
            corners = vertices(problem.centre[pose, which], problem.segments[pose, which])
            single = replace(
                problem,
                columns=problem.columns[pose, None],
                shift=problem.shift[pose, None],
                centre=corners[None],
                segments=np.zeros((1, len(corners), 0, corners.shape[1])),
            )
            each = hold(single)
            assert holding.minimax_tension[pose, which] == pytest.approx(each.minimax_tension.max(), rel=ROUNDING)
            assert holding.margin[pose, which] == pytest.approx(each.margin.min(), rel=ROUNDING, abs=1e-9)


@pytest.mark.parametrize("freedom", ["2T", "3T", "1R2T"])
def test_the_margin_is_the_radius_of_the_largest_ball_of_wrenches_that_may_be_added(freedom: str) -> None:
    tried = 0
    for problem in drawn(40, freedom=freedom, full=True):
        problem = with_bounds(problem, 1.0, 150.0)  # noqa: PLW2901
        rows = problem.centre.shape[2]
        margin = hold(problem).margin
        unit = np.eye(rows, 3)
        for factor, fits in ((1.0 - 1e-6, True), (1.0 + 1e-6, False)):
            radius = np.where(margin > 1e-3, margin * factor, 0.0)
            finite = np.isfinite(hold(problem, radius[..., None, None, None] * unit).minimax_tension)
            assert np.all(finite[margin > 1e-3] == fits)
        tried += int((margin > 1e-3).sum())
    assert tried > 50


@pytest.mark.parametrize("freedom", ["2T", "3T", "1R2T", "3R3T"])
def test_the_tension_over_a_ball_is_what_linear_programs_climb_to(freedom: str) -> None:
    generator = np.random.default_rng(8)
    starts = generator.normal(size=(25, 3))
    starts /= np.linalg.norm(starts, axis=1, keepdims=True)
    tried = 0
    for problem in drawn(10, freedom=freedom, full=True):
        poses, sets, rows = problem.centre.shape
        balls = generator.uniform(-4.0, 4.0, (poses, sets, 1, rows, 3))
        points = replace(problem, segments=np.zeros((poses, sets, 0, rows)))
        tensions = hold(points, balls).minimax_tension
        for pose in np.flatnonzero(np.isfinite(tensions[:, 0])):
            sampled, climbed = ball_minimax_tension(
                problem.columns[pose],
                problem.centre[pose, 0] - problem.shift[pose],
                balls[pose, 0, 0],
                problem.limits,
                starts,
            )
            assert sampled <= tensions[pose, 0] * (1.0 + SOLVER)
            assert tensions[pose, 0] == pytest.approx(climbed, rel=SOLVER)
            tried += 1
    assert tried > 5


def test_the_tension_over_a_ball_lies_between_those_over_the_boxes_inside_and_around_it() -> None:
    for problem in drawn(20, freedom="3R3T", full=True):
        poses, sets, rows = problem.centre.shape
        forces = np.broadcast_to(10.0 * np.eye(rows, 3), (poses, sets, 1, rows, 3))
        around = np.broadcast_to(10.0 * np.eye(3, rows), (poses, sets, 3, rows))
        ball = hold(replace(problem, segments=np.zeros((poses, sets, 0, rows))), forces).minimax_tension
        outer = hold(replace(problem, segments=around)).minimax_tension
        inner = hold(replace(problem, segments=around / np.sqrt(3.0))).minimax_tension
        assert np.all(inner <= ball * (1.0 + ROUNDING))
        assert np.all(ball <= outer * (1.0 + ROUNDING))


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
