"""Where a robot can work: reachable, static, wrench-feasible, dynamic-feasible and twist-feasible workspaces.

References
----------
.. [1] R. Verhoeven, "Analysis of the workspace of tendon-based Stewart platforms", dissertation, Universität
   Duisburg-Essen, 2004.
.. [2] P. Bosscher, A. T. Riechel, I. Ebert-Uphoff, "Wrench-feasible workspace generation for cable-driven robots",
   IEEE Transactions on Robotics 22(5), 2006, 890-902, doi:10.1109/TRO.2006.878967.
.. [3] G. Barrette, C. M. Gosselin, "Determination of the dynamic workspace of cable-driven planar parallel
   mechanisms", ASME Journal of Mechanical Design 127(2), 2005, 242-248, doi:10.1115/1.1830045.
.. [4] S. Lessanibahri, M. Gouttefarde, S. Caro, P. Cardou, "Twist feasibility analysis of cable-driven parallel
   robots", Cable-Driven Parallel Robots, 2018, 128-139, doi:10.1007/978-3-319-61431-1_12.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.cable_motion import cable_motion
from actuator_select.model.demand import BOUND_TOLERANCE, Demand, Progress, compute_demand
from actuator_select.model.dynamics import RequiredWrench, wrench_scale
from actuator_select.model.feasibility import structure_rank
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionSet
from actuator_select.model.robot import CableRobot
from actuator_select.model.tension import TensionModel

CABLE_POSES_AT_ONCE = 1 << 18  # poses times cables in one chunk; their demand takes some 80 MB


class WorkspaceKind(StrEnum):
    """What has to be possible at a pose."""

    REACHABLE = "reachable"
    STATIC = "static"
    WRENCH = "wrench-feasible"
    DYNAMIC = "dynamic-feasible"
    TWIST = "twist-feasible"

    @property
    def rests_on_tensions(self) -> bool:
        """Whether tensions decide, and not lengths or speeds alone."""
        return self not in (WorkspaceKind.REACHABLE, WorkspaceKind.TWIST)


class OrientationRule(StrEnum):
    """At which of the listed orientations a position has to hold."""

    CONSTANT = "constant"
    INCLUSION = "inclusion"
    TOTAL = "total"

    def considered(self, orientations: FloatArray) -> FloatArray:
        """Rows of the (O, 3) orientations that matter: the first only where it is constant. [rad]"""
        return orientations[:1] if self is OrientationRule.CONSTANT else orientations


@dataclass(frozen=True, slots=True, kw_only=True)
class PositionVerdicts:
    """Verdicts on P positions.

    Attributes
    ----------
    feasible : (P,) array of bool
        Whether the position belongs to the workspace.
    apart : (P,) array of bool
        Nearer to an anchor than the least cable length: no verdict, never feasible.
    margin : (P,) array
        How far from the border of what is possible, negative beyond it: of the wrench (moments divided by the robot's
        characteristic length), or under the pseudo-inverse of the tension to its bound [N]; of the cable length where
        `kind` is reachable [m]; of the cable speed where it is twist-feasible [m/s].
    tension : (P,) array
        Least common limit of the cable tensions with which the position is held in its hardest case (inclusion: at
        its easiest orientation); under the pseudo-inverse the largest magnitude of a tension. Infinite where
        infeasible, NaN of kinds that do not rest on tensions. [N]
    short_of_rank : (P,) array of bool
        The structure matrix is short of rank at one of the considered orientations.
    unreachable : (P,) array of bool
        A cable is beyond its greatest length at every (inclusion) or at one (else) of the considered orientations.
    """

    feasible: BoolArray
    apart: BoolArray
    margin: FloatArray
    tension: FloatArray
    short_of_rank: BoolArray
    unreachable: BoolArray


@dataclass(frozen=True, slots=True, kw_only=True)
class _PoseVerdicts:
    """Verdicts on q positions at O orientations each, (q, O) arrays; fields as of `PositionVerdicts`."""

    feasible: BoolArray
    near: BoolArray
    margin: FloatArray
    tension: FloatArray
    short_of_rank: BoolArray
    unreachable: BoolArray


def judge_positions(  # noqa: PLR0913 - as `compute_demand`, and three choices
    robot: CableRobot,
    positions: FloatArray,
    orientations: FloatArray,
    wrenches: Sequence[Sequence[RequiredWrench]],
    motion: MotionSet,
    *,
    kind: WorkspaceKind = WorkspaceKind.DYNAMIC,
    over: OrientationRule = OrientationRule.TOTAL,
    tension_model: TensionModel = TensionModel.WRENCH_FEASIBLE,
    progress: Progress | None = None,
) -> PositionVerdicts:
    """Tell which positions belong to a workspace.

    Parameters
    ----------
    robot : CableRobot
        With the bounds of its m cables.
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        [rad]
    wrenches : sequence of sequence of RequiredWrench
        For each orientation, of each load; every load has to hold.
    motion : MotionSet
        Velocities and accelerations; those kinds that stand still do not look at it.
    kind : WorkspaceKind
        `REACHABLE`: every cable within its bounds of length. `STATIC`: besides, bounded tensions hold the platform and
        its load at rest, external loads at the centre of their box [1]. `WRENCH`: the same for every external load of
        the box, without acceleration [2]. `DYNAMIC`: for every acceleration of the motion set as well [3]. `TWIST`:
        every cable's speed within its bound, over the motion set [4].
    over : OrientationRule
        `CONSTANT`: at the first listed orientation; `INCLUSION`: at some orientation; `TOTAL`: at every orientation.
    tension_model : TensionModel
        Under `PSEUDO_INVERSE` a pose holds where the tensions of that one rule balance every required wrench and stay
        within their bounds, although others might.
    progress : callable, optional
        Called with (positions done, positions).

    Returns
    -------
    PositionVerdicts
        Nothing else of the poses is kept, so that memory does not grow with the demand of all.
    """
    considered = over.considered(orientations)
    wrenches, motion = what_is_asked(kind, wrenches[: len(considered)], motion)
    cases = len(considered) * len(wrenches[0]) * motion.cases
    step = max(1, CABLE_POSES_AT_ONCE // (robot.cables * cases))
    parts = []
    for start in range(0, len(positions), step):
        some = positions[start : start + step]
        if kind.rests_on_tensions:
            demand = compute_demand(robot, some, considered, wrenches, motion, tension_model=tension_model)
            poses = _by_tensions(robot, demand, len(considered))
        else:
            poses = _by_geometry(robot, some, considered, motion, kind)
        parts.append(_over_orientations(poses, over))
        if progress is not None:
            progress(min(start + step, len(positions)), len(positions))
    return PositionVerdicts(
        feasible=np.concatenate([part.feasible for part in parts]),
        apart=np.concatenate([part.apart for part in parts]),
        margin=np.concatenate([part.margin for part in parts]),
        tension=np.concatenate([part.tension for part in parts]),
        short_of_rank=np.concatenate([part.short_of_rank for part in parts]),
        unreachable=np.concatenate([part.unreachable for part in parts]),
    )


def what_is_asked(
    kind: WorkspaceKind, wrenches: Sequence[Sequence[RequiredWrench]], motion: MotionSet
) -> tuple[Sequence[Sequence[RequiredWrench]], MotionSet]:
    """Loads and motion that a kind of workspace looks at: at rest but for those that ask for motion."""
    if kind is WorkspaceKind.STATIC:
        calm = [[replace(one, external_reach=np.zeros(6)) for one in loads] for loads in wrenches]
        return calm, motion.at_rest()
    if kind is WorkspaceKind.WRENCH:
        return wrenches, motion.at_rest()
    return wrenches, motion


def _by_tensions(robot: CableRobot, demand: Demand, orientations: int) -> _PoseVerdicts:
    shape = (len(demand.positions), orientations, -1)
    if demand.tension_model is TensionModel.PSEUDO_INVERSE:
        feasible, margin = _within_bounds(robot, demand)
    else:
        feasible, margin = demand.attainable, np.where(demand.attainable, np.maximum(demand.margin, 0.0), demand.margin)
    margin = np.where(demand.unreachable, -np.inf, margin)
    return _PoseVerdicts(
        feasible=_every(feasible.reshape(shape), 2),
        near=_some(_too_near(robot, demand.lengths).reshape(shape), 2),
        margin=margin.reshape(shape).min(axis=2),
        tension=np.where(feasible, demand.force.max(axis=1), np.inf).reshape(shape).max(axis=2),
        short_of_rank=_some(demand.rank_deficient.reshape(shape), 2),
        unreachable=_some(demand.unreachable.reshape(shape), 2),
    )


def _within_bounds(robot: CableRobot, demand: Demand) -> tuple[BoolArray, FloatArray]:
    """Whether the pseudo-inverse's own tensions balance every wrench within their bounds, and by how much; (Q,)."""
    if demand.tensions is None:  # pragma: no cover - the pseudo-inverse always has them
        raise TypeError(demand.tension_model)
    middle = demand.tensions.middle
    with np.errstate(invalid="ignore"):  # a cable of no length has an infinite reach
        reach = demand.force - np.abs(middle)
        slack = np.minimum(middle - reach - robot.bounds.tension_min, robot.bounds.tension_max - middle - reach)
    margin = np.where(np.isfinite(demand.force), slack, -np.inf).min(axis=1)
    balanced = demand.attainable & ~demand.unbalanced
    feasible = balanced & (margin >= -BOUND_TOLERANCE * demand.force.max(axis=1))
    margin = np.where(feasible, np.maximum(margin, 0.0), margin)
    return feasible, np.where(balanced, margin, -np.inf)


def _by_geometry(
    robot: CableRobot, positions: FloatArray, orientations: FloatArray, motion: MotionSet, kind: WorkspaceKind
) -> _PoseVerdicts:
    shape = (len(positions), len(orientations))
    each = np.repeat(positions, len(orientations), axis=0)
    geometry = cable_geometry(robot, each, np.tile(orientations, (len(positions), 1)))
    bounds, rows = robot.bounds, list(robot.wrench_rows)
    scaled = geometry.structure_matrix[:, rows] * wrench_scale(robot, rows)[:, None]
    unreachable = _too_long(robot, geometry.lengths)
    if kind is WorkspaceKind.REACHABLE:
        margin = np.minimum(bounds.length_max - geometry.lengths, geometry.lengths - bounds.length_min).min(axis=1)
        feasible = ~unreachable
    else:
        winding = cable_motion(robot, geometry, motion)
        speed = np.maximum(winding.speed_in, winding.speed_out).max(axis=1)
        speed[geometry.lengths <= 0.0] = np.inf  # a cable of no length has no direction
        margin = np.where(unreachable, -np.inf, (bounds.speed_max - speed).min(axis=1))
        feasible = ~unreachable & _every(speed <= bounds.speed_max * (1.0 + BOUND_TOLERANCE), 1)
    return _PoseVerdicts(
        feasible=feasible.reshape(shape),
        near=_too_near(robot, geometry.lengths).reshape(shape),
        margin=margin.reshape(shape),
        tension=np.full(shape, np.nan),
        short_of_rank=(structure_rank(scaled)[0] < len(rows)).reshape(shape),
        unreachable=unreachable.reshape(shape),
    )


def _too_near(robot: CableRobot, lengths: FloatArray) -> BoolArray:
    return _some(lengths < robot.bounds.length_min * (1.0 - BOUND_TOLERANCE), 1)


def _too_long(robot: CableRobot, lengths: FloatArray) -> BoolArray:
    return _some(lengths > robot.bounds.length_max * (1.0 + BOUND_TOLERANCE), 1)


def _some(values: BoolArray, axis: int) -> BoolArray:
    return np.asarray(values.any(axis=axis), dtype=np.bool_)


def _every(values: BoolArray, axis: int) -> BoolArray:
    return np.asarray(values.all(axis=axis), dtype=np.bool_)


def _over_orientations(poses: _PoseVerdicts, over: OrientationRule) -> PositionVerdicts:
    """Join the orientations of each position; a pose too near to an anchor is no choice under inclusion."""
    if over is OrientationRule.INCLUSION:
        apart = _every(poses.near, 1)
        margin = np.where(poses.near, -np.inf, poses.margin).max(axis=1)
        tension = np.where(poses.near, np.inf, poses.tension).min(axis=1)
        feasible = _some(poses.feasible & ~poses.near, 1)
        unreachable = _every(poses.unreachable, 1)
    else:
        apart = _some(poses.near, 1)
        margin = poses.margin.min(axis=1)
        tension = poses.tension.max(axis=1)
        feasible = _every(poses.feasible, 1) & ~apart
        unreachable = _some(poses.unreachable, 1)
    return PositionVerdicts(
        feasible=feasible,
        apart=apart,
        margin=margin,
        tension=tension,
        short_of_rank=_some(poses.short_of_rank, 1) & ~apart,
        unreachable=unreachable & ~apart,
    )
