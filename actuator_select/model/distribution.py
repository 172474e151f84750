"""One tension per cable at given instants, for trajectories and pictures: a named choice among all that balance.

Under the pseudo-inverse it is the published one. Else it is the closed form [1] about the middle between the least
tension and the minimax tension of the instant; a cable that would leave its bounds is set to the bound, and the others
share what is left. Few instants near the border of what is feasible are not solved so (below 1 % of random poses of
eight cables in space); there a linear program finds the tensions whose greatest distance from the middle is least, so
that tensions may jump where one takes over from the other.

References
----------
.. [1] A. Pott, T. Bruckmann, L. Mikelsons, "Closed-form force distribution for parallel wire robots", Computational
   Kinematics, 2009, doi:10.1007/978-3-642-01947-0_4.
"""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.dynamics import wrench_scale
from actuator_select.model.feasibility import hold_wrenches, structure_rank
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets
from actuator_select.model.kinematics import CableGeometry, cable_geometry
from actuator_select.model.robot import CableRobot
from actuator_select.model.supports import Support, support_wrenches
from actuator_select.model.tension import BALANCE_TOLERANCE, TensionModel, balanced_rows, pseudo_inverse

BOUND_TOLERANCE = 1e-9  # relative to the largest tension; a smaller excess is rounding
PROGRAM_TOLERANCE = 1e-10  # the least that HiGHS allows, of tensions near 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Distribution:
    """Tensions at S instants.

    Attributes
    ----------
    geometry : CableGeometry
        Of the cables at the S poses.
    tension : (S, m) array
        NaN at instants that are infeasible. [N]
    minimax_tension : (S,) array
        Least uniform limit that would do; NaN under the pseudo-inverse, infinite where infeasible. [N]
    rank_deficient : (S,) array of bool
        Where the rank of the structure matrix is less than the equations that the model balances.
    unbalanced : (S,) array of bool
        Where the pseudo-inverse leaves part of the wrench unbalanced.
    """

    geometry: CableGeometry
    tension: FloatArray
    minimax_tension: FloatArray
    rank_deficient: BoolArray
    unbalanced: BoolArray


def distribute(
    robot: CableRobot, model: TensionModel, positions: FloatArray, orientations: FloatArray, wrenches: FloatArray
) -> Distribution:
    """Find the tensions that supply given wrenches.

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    model : TensionModel
        Rule of distribution.
    positions : (S, 3) array
        [m]
    orientations : (S, 3) or (3,) array
        [rad]
    wrenches : (S, 6) array
        Required, about the platform's origin. [N, N m]

    Returns
    -------
    Distribution
        At the S instants.
    """
    rows = balanced_rows(robot, model)
    angles = np.broadcast_to(orientations, (len(positions), 3))
    geometry = cable_geometry(robot, positions, angles)
    structure = geometry.structure_matrix[:, rows]
    support = support_wrenches(robot, positions, angles, rows)
    wanted = wrenches[:, rows] - support.constant
    if model is TensionModel.PSEUDO_INVERSE:
        inverse = pseudo_inverse(structure)
        left = np.einsum("sij,sj->si", inverse.residual_maker, wanted)
        tolerance = BALANCE_TOLERANCE * np.linalg.norm(wrenches[:, rows], axis=1, keepdims=True)
        return Distribution(
            geometry=geometry,
            tension=np.einsum("smn,sn->sm", inverse.matrix, wanted),
            minimax_tension=np.full(len(positions), np.nan),
            rank_deficient=inverse.rank < len(rows),
            unbalanced=np.asarray((np.abs(left) > tolerance).any(axis=1), dtype=np.bool_),
        )
    scale = wrench_scale(robot, rows)
    columns = np.concatenate([structure, support.controlled], axis=2) * scale[:, None]
    return _about_the_middle(robot, geometry, columns, wanted * scale, support)


def _about_the_middle(
    robot: CableRobot, geometry: CableGeometry, columns: FloatArray, wanted: FloatArray, support: Support
) -> Distribution:
    instants, rows, count = columns.shape
    bounds = robot.bounds
    lower, upper = (
        np.concatenate([bounds.tension_min, support.lower]),
        np.concatenate([bounds.tension_max, support.upper]),
    )
    shared = np.arange(count) < robot.cables
    empty = np.zeros((instants, 1, 0, rows))
    holding = hold_wrenches(
        columns,
        WrenchSets(centre=wanted[:, None], segments=empty, balls=np.zeros((instants, 1, 0, rows, 3))),
        np.arange(instants),
        np.zeros_like(wanted),
        ColumnBounds(lower=lower, upper=upper, shared=shared),
    )
    least = holding.minimax_tension[:, 0]
    feasible = np.isfinite(least)
    highest = np.where(shared, np.minimum(upper, np.where(feasible, least, 0.0)[:, None]), upper)
    middle = (lower + highest) / 2.0
    tension = np.full((instants, count), np.nan)
    tension[feasible] = closed_form(columns[feasible], wanted[feasible], lower, upper, middle[feasible])
    for instant in np.flatnonzero(feasible & ~_is_solved(columns, wanted, lower, upper, tension)):
        tension[instant] = _by_program(columns[instant], wanted[instant], lower, upper, middle[instant])
    rank = holding.rank if count == robot.cables else structure_rank(columns[:, :, : robot.cables])[0]
    return Distribution(
        geometry=geometry,
        tension=tension[:, : robot.cables],
        minimax_tension=least,
        rank_deficient=rank < rows,
        unbalanced=np.zeros(instants, dtype=np.bool_),
    )


def _is_solved(
    columns: FloatArray, wrench: FloatArray, lower: FloatArray, upper: FloatArray, tension: FloatArray
) -> BoolArray:
    """Whether tensions supply the wrench within their bounds, (S,)."""
    largest = np.abs(tension).max(axis=1)
    left = np.linalg.norm(wrench - np.einsum("snm,sm->sn", columns, tension), axis=1)
    size = np.linalg.norm(wrench, axis=1) + largest
    beyond = np.maximum(lower - tension, tension - upper).max(axis=1)
    solved: BoolArray = (left <= BALANCE_TOLERANCE * size) & (beyond <= BOUND_TOLERANCE * largest)
    return solved


def _by_program(
    columns: FloatArray, wrench: FloatArray, lower: FloatArray, upper: FloatArray, middle: FloatArray
) -> FloatArray:
    """Tensions of one instant whose greatest distance from `middle` is least, (M,); NaN where rounding forbids them."""
    from scipy.optimize import linprog

    count = len(middle)
    scale = max(float(np.abs(middle).max()), float(np.linalg.norm(wrench)))
    if scale == 0.0:
        return np.zeros(count)
    away = np.block([[np.eye(count), -np.ones((count, 1))], [-np.eye(count), -np.ones((count, 1))]])
    solved = linprog(
        np.append(np.zeros(count), 1.0),
        A_ub=away,
        b_ub=np.concatenate([middle, -middle]) / scale,
        A_eq=np.hstack([columns, np.zeros((len(columns), 1))]),
        b_eq=wrench / scale,
        bounds=[
            *zip(lower / scale, (None if np.isinf(one) else one / scale for one in upper), strict=True),
            (0.0, None),
        ],
        method="highs",
        options={"primal_feasibility_tolerance": PROGRAM_TOLERANCE, "dual_feasibility_tolerance": PROGRAM_TOLERANCE},
    )
    return np.full(count, np.nan) if solved.x is None else np.asarray(solved.x[:count] * scale)


def closed_form(
    columns: FloatArray, wrench: FloatArray, lower: FloatArray, upper: FloatArray, middle: FloatArray
) -> FloatArray:
    """Tensions nearest to `middle` that supply a wrench; those beyond a bound are set to it, the worst one first.

    Parameters
    ----------
    columns : (S, n, M) array
        Structure matrix.
    wrench : (S, n) array
        Required.
    lower, upper : (M,) array
        Bounds. [N]
    middle : (S, M) array
        Where the tensions should be. [N]

    Returns
    -------
    (S, M) array
        Within the bounds wherever setting cables to their bounds leaves enough others to balance the wrench. [N]
    """
    instants, _, count = columns.shape
    held = np.zeros((instants, count), dtype=np.bool_)
    tension = np.array(middle, dtype=np.float64)
    active = np.arange(instants)
    for _ in range(count):
        free = ~held[active]
        left = wrench[active] - np.einsum("snm,sm->sn", columns[active], tension[active])
        movable = columns[active] * free[:, None]
        tension[active] += np.einsum("smn,sn->sm", np.linalg.pinv(movable, rtol=BALANCE_TOLERANCE), left) * free
        slack = BOUND_TOLERANCE * np.abs(tension[active]).max(axis=1, keepdims=True)
        beyond = np.maximum(lower - tension[active], tension[active] - upper) * free
        worst = beyond.argmax(axis=1)
        moving = beyond[np.arange(len(active)), worst] > slack[:, 0]
        # Fewer free cables than equations could not balance anything any more.
        moving &= free.sum(axis=1) > columns.shape[1]
        active, worst = active[moving], worst[moving]
        if not len(active):
            break
        held[active, worst] = True
        tension[active] = np.where(held[active], tension[active], middle[active])
        tension[active, worst] = np.clip(tension[active, worst], lower[worst], upper[worst])
    return tension
