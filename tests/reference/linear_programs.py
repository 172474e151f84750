"""Minimax tension from its definition, one linear program per vertex; and random robots to try it on.

Nothing here comes from the package. A set of required wrenches is feasible exactly if all its vertices are, because
the tensions of vertices mix as the vertices do; for the same reason its minimax tension is the largest of theirs.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.optimize import linprog

OPTIMAL, INFEASIBLE, UNCLEAR = 0, 2, 4  # statuses of linprog
TOLERANCES = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}  # the least HiGHS allows
BORDER = 1e-9  # by which bounds move to find out whether a verdict hangs on rounding, relative to the forces
GRAVITY = 9.81  # [m/s²]
SAMPLE_DRAWS = 1000  # of one pose; the rejection below never takes more than a few
RANK_GAP = (1e-12, 1e-3)  # ratios of singular values between these are neither rank-deficient nor clearly not

FREEDOMS = {"2T": (0, 2), "3T": (0, 1, 2), "1R2T": (0, 2, 4), "3R3T": (0, 1, 2, 3, 4, 5)}
LAYOUTS = ("general", "suspended", "concurrent", "copies", "coplanar", "duplicate")


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Bounds of M tensions: own ones, and which of them the common bound τ holds for."""

    lower: np.ndarray
    upper: np.ndarray
    shared: np.ndarray

    def moved(self, outwards: float) -> "Limits":
        """The same with every bound further out. [N]"""
        return Limits(lower=self.lower - outwards, upper=self.upper + outwards, shared=self.shared)


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """q poses, G sets of wrenches at each: centre ± segments, shapes (q, G, n) and (q, G, S, n)."""

    freedom: str
    layouts: tuple[str, ...]
    columns: np.ndarray
    shift: np.ndarray
    limits: Limits
    centre: np.ndarray
    segments: np.ndarray


def _solve(columns: np.ndarray, wrench: np.ndarray, limits: Limits, *, minimise: bool) -> tuple[float, np.ndarray]:
    """Least τ, infinite if there is none, and its derivative with respect to the wrench.

    Variables are the tensions and, to minimise, τ. Presolve takes columns that are dependent but for rounding for
    independent ones and then calls the program infeasible, so that this verdict is asked for again without it: tensions
    that HiGHS finds prove themselves.
    """
    rows, count = columns.shape
    own = [(low, None if np.isinf(high) else high) for low, high in zip(limits.lower, limits.upper, strict=True)]
    problem = {"c": np.zeros(count), "A_eq": columns, "b_eq": wrench, "bounds": own}
    if minimise:
        least = max([0.0, *limits.lower[limits.shared]])
        below = np.hstack([np.eye(count)[limits.shared], -np.ones((int(limits.shared.sum()), 1))])
        problem = {
            "c": np.append(np.zeros(count), 1.0),
            "A_eq": np.hstack([columns, np.zeros((rows, 1))]),
            "b_eq": wrench,
            "A_ub": below,
            "b_ub": np.zeros(len(below)),
            "bounds": [*own, (least, None)],
        }
    result = linprog(**problem, method="highs", options=TOLERANCES)
    if result.status in (INFEASIBLE, UNCLEAR):
        result = linprog(**problem, method="highs", options=TOLERANCES | {"presolve": False})
    if result.status == INFEASIBLE:
        return np.inf, np.zeros(rows)
    if result.status != OPTIMAL:
        raise ArithmeticError(f"linprog: {result.message}")
    return float(result.fun), result.eqlin.marginals


def vertices(centre: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Wrenches centre ± segments, all signs; segments of no length are left out."""
    some = segments[np.any(segments != 0.0, axis=1)]
    return np.array([centre + np.array(signs) @ some for signs in product((-1.0, 1.0), repeat=len(some))])


def minimax_tension(columns: np.ndarray, wrenches: np.ndarray, shift: np.ndarray, limits: Limits) -> float:
    """Least τ under which each of the (K, n) wrenches is feasible. [N]"""
    largest = 0.0
    for wrench in wrenches:
        least, _ = _solve(columns, wrench - shift, limits, minimise=True)
        if np.isinf(least):
            return np.inf
        largest = max(largest, least)
    return largest


def is_feasible(columns: np.ndarray, wrenches: np.ndarray, shift: np.ndarray, limits: Limits) -> bool:
    """Whether tensions within the limits exert every one of the (K, n) wrenches."""
    return all(np.isfinite(_solve(columns, wrench - shift, limits, minimise=False)[0]) for wrench in wrenches)


def is_border(columns: np.ndarray, wrenches: np.ndarray, shift: np.ndarray, limits: Limits) -> bool:
    """Whether the verdict differs between bounds moved outwards and inwards by `BORDER` of the largest force.

    Bounds move rather than wrenches, so that where the rank is short nothing leaves the range.
    """
    finite = limits.upper[np.isfinite(limits.upper)]
    by = BORDER * max(np.abs(wrenches).max(), np.abs(shift).max(), limits.lower.max(), finite.max(initial=0.0))
    verdicts = [is_feasible(columns, wrenches, shift, limits.moved(outwards)) for outwards in (by, -by)]
    return verdicts[0] != verdicts[1]


def ball_minimax_tension(
    columns: np.ndarray, centre: np.ndarray, ball: np.ndarray, limits: Limits, starts: np.ndarray
) -> tuple[float, float]:
    """Largest least τ over centre + ball · directions, at the directions `starts` and after following the slope.

    The least τ is convex and piecewise linear in the wrench, so that stepping to the point of the ball that lies
    furthest along its derivative never lowers it and ends at a local maximum.
    """
    sampled = refined = 0.0
    for start in starts:
        direction, level = start, -np.inf
        while True:
            reached, slope = _solve(columns, centre + ball @ direction, limits, minimise=True)
            if level == -np.inf:
                sampled = max(sampled, reached)
            along = ball.T @ slope
            if reached <= level * (1.0 + 1e-12) or not np.any(along):
                break
            level, direction = reached, along / np.linalg.norm(along)
        refined = max(refined, level, reached)
    return sampled, refined


def random_rotation(generator: np.random.Generator, freedom: str) -> np.ndarray:
    """Orientation of a platform: none, any about y, or any."""
    if freedom in ("2T", "3T"):
        return np.eye(3)
    axis = np.array([0.0, 1.0, 0.0]) if freedom == "1R2T" else generator.normal(size=3)
    axis /= np.linalg.norm(axis)
    angle = generator.uniform(-0.6, 0.6)
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) - np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def _anchors(generator: np.random.Generator, freedom: str, layout: str, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frame anchors and platform anchors, both relative to the platform's reference point, world axes."""
    planar = np.array([1.0, 0.0, 1.0]) if freedom in ("2T", "1R2T") else np.ones(3)
    turn = random_rotation(generator, freedom)
    position = generator.uniform(-1.0, 1.0, 3) * planar
    platform = generator.uniform(-0.4, 0.4, (count, 3)) * planar * (0.0 if freedom in ("2T", "3T") else 1.0)
    frame = generator.uniform(-3.0, 3.0, (count, 3)) * planar
    if layout == "suspended":
        frame[:, 2] = 2.5  # one ceiling
    if layout == "copies":  # lines through one point, or parallel ones
        platform[:, 2] = 0.0
        frame = generator.choice([1.0, 3.0, 6.0]) * platform + np.array([0.0, 0.0, 2.5])
        return frame - position, platform
    placed = platform @ turn.T
    reach = frame - position
    if layout == "concurrent":  # every line meets one axis; in a plane, one point
        meeting = np.zeros((count, 3)) if freedom == "1R2T" else generator.uniform(-1.0, 1.0, (count, 1)) * [0, 0, 1]
        reach = placed + generator.choice([-3.0, 2.0, 5.0], (count, 1)) * (meeting + np.array([0.1, 0.0, 0.2]) - placed)
    if layout == "coplanar":  # a plane through the point; for robots in a plane, a line
        normal = generator.normal(size=3) * planar
        normal /= np.linalg.norm(normal)
        reach, placed = reach - np.outer(reach @ normal, normal), placed - np.outer(placed @ normal, normal)
    if layout == "duplicate" and count > 1:
        reach[-1], placed[-1] = reach[0], placed[0]
    return reach, placed


def _columns(generator: np.random.Generator, freedom: str, layout: str, count: int) -> np.ndarray:
    """Structure matrix whose rank cannot be mistaken; moments are divided by a length."""
    rows = list(FREEDOMS[freedom])
    for _ in range(SAMPLE_DRAWS):
        reach, placed = _anchors(generator, freedom, layout, count)
        lengths = np.linalg.norm(reach - placed, axis=1, keepdims=True)
        if lengths.min() < 1e-2:
            continue
        directions = (reach - placed) / lengths
        moments = np.cross(placed, directions) / 0.25
        columns = np.hstack([directions, moments]).T[rows]
        sigma = np.linalg.svd(columns, compute_uv=False)
        if not np.any((sigma > RANK_GAP[0] * sigma[0]) & (sigma < RANK_GAP[1] * sigma[0])):
            return columns
    raise RuntimeError(f"no clear rank in {SAMPLE_DRAWS} draws of {layout} {freedom}")


def _limits(generator: np.random.Generator, cables: int, balances: int) -> Limits:
    lower = generator.choice([0.0, 0.0, 5.0]) * np.ones(cables)
    if generator.random() < 0.25:
        lower = generator.uniform(0.0, 10.0, cables)
    upper = {
        "infinite": np.full(cables, np.inf),
        "uniform": np.full(cables, generator.uniform(80.0, 400.0)),
        "differing": generator.uniform(50.0, 400.0, cables),
        "some": np.where(generator.random(cables) < 0.5, np.inf, generator.uniform(50.0, 300.0, cables)),
    }[generator.choice(["infinite", "uniform", "differing", "some"])]
    low = generator.uniform(0.0, 20.0, balances)
    spread = np.inf if generator.random() < 0.1 else generator.uniform(5.0, 60.0, balances)
    return Limits(
        lower=np.append(lower, low),
        upper=np.append(upper, low + spread),
        shared=np.arange(cables + balances) < cables,
    )


def _wrenches(
    generator: np.random.Generator, freedom: str, columns: np.ndarray, shift: np.ndarray, limits: Limits
) -> tuple[np.ndarray, np.ndarray]:
    """Centre and segments, padded to a row per freedom, of a single wrench, accelerations or external wrenches."""
    rows, count = columns.shape
    mass = generator.uniform(2.0, 20.0)
    short = np.linalg.matrix_rank(columns, tol=1e-9) < rows
    inside = generator.random() < (0.75 if short else 0.4)  # of the range
    high = np.minimum(limits.upper, generator.choice([30.0, 150.0]))
    centre = columns @ generator.uniform(limits.lower, np.maximum(high, limits.lower)) + shift
    if not inside:
        centre = np.where(np.array(FREEDOMS[freedom]) == 2, mass * GRAVITY, 0.0)
    segments = np.zeros((rows, rows))
    sort = generator.choice(["single", "single", "accelerations", "external"])
    if sort == "single":
        return centre, segments
    if inside:
        many = 1 if short else 2
        segments[:many] = generator.uniform(-3.0, 3.0, (many, count)) @ columns.T
    elif sort == "accelerations":
        forces = np.array(FREEDOMS[freedom]) < 3
        segments[forces, forces] = mass * generator.uniform(0.1, 2.0, int(forces.sum()))
    else:
        some = np.arange(rows) < (rows if generator.random() < 0.15 else 3)
        segments[some, some] = generator.uniform(0.5, 5.0, int(some.sum()))
    return centre, segments


def random_problem(seed: int, poses: int = 4, sets: int = 2) -> Problem:
    """Draw a freedom, a number of cables, bounds and counterbalances; at every pose new anchors and wrenches."""
    generator = np.random.default_rng(seed)
    freedom = str(generator.choice(list(FREEDOMS)))
    rows = len(FREEDOMS[freedom])
    cables = max(1, rows + int(generator.choice([-2, -1, 0, 1, 2, 3, 4], p=[0.04, 0.06, 0.2, 0.3, 0.2, 0.1, 0.1])))
    controlled, constant = (int(number) for number in generator.choice(3, size=2, p=[0.65, 0.25, 0.1]))
    limits = _limits(generator, cables, controlled)
    layouts = tuple(str(layout) for layout in generator.choice(LAYOUTS, p=[0.4, 0.2, 0.1, 0.1, 0.1, 0.1], size=poses))
    columns, shift, centre, segments = [], [], [], []
    for layout in layouts:
        pose = _columns(generator, freedom, layout, cables + controlled)
        supplied = np.zeros(rows)
        if constant:
            supplied = _columns(generator, freedom, "general", constant) @ generator.uniform(5.0, 60.0, constant)
        drawn = [_wrenches(generator, freedom, pose, supplied, limits) for _ in range(sets)]
        columns.append(pose)
        shift.append(supplied)
        centre.append([one for one, _ in drawn])
        segments.append([one for _, one in drawn])
    return Problem(
        freedom=freedom,
        layouts=layouts,
        columns=np.array(columns),
        shift=np.array(shift),
        limits=limits,
        centre=np.array(centre),
        segments=np.array(segments),
    )
