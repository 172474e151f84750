"""Which tensions of one counterbalance make a pose feasible: an exact interval per pose, found once for all."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.demand import BOUND_TOLERANCE, Progress
from actuator_select.model.dynamics import RequiredWrench, wrench_scale, wrench_sets
from actuator_select.model.feasibility import structure_rank
from actuator_select.model.hyperplanes import (
    COLUMN_TOLERANCE,
    WRENCH_TOLERANCE,
    WrenchSets,
    facet_normals,
    in_hyperplane,
)
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionSet
from actuator_select.model.robot import CableRobot
from actuator_select.model.supports import counterbalance_columns
from actuator_select.model.tension import BALANCE_TOLERANCE

POSES_AT_ONCE = 1 << 14


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportInterval:
    """Feasible tensions of one counterbalance at P positions; what follows for any choice of it are comparisons.

    Attributes
    ----------
    lower, upper : (P,) array
        Ends of the interval, NaN where no tension is feasible. A rope only pulls: what lies below zero is of use as
        a reserve alone. [N]
    """

    lower: FloatArray
    upper: FloatArray

    @property
    def exists(self) -> BoolArray:
        """Positions that some tension of the rope makes feasible, (P,)."""
        exists: BoolArray = self.upper >= 0.0  # false for NaN
        return exists

    def feasible_at(self, tension: float) -> BoolArray:
        """Positions that are feasible with the rope at this tension [N], (P,)."""
        return self.feasible_within(tension, tension)

    def feasible_within(self, least: float, greatest: float) -> BoolArray:
        """Positions that are feasible with the rope at some tension of a range that is controlled [N], (P,)."""
        slack = BOUND_TOLERANCE * max(abs(least), abs(greatest))
        feasible: BoolArray = (self.lower <= greatest + slack) & (self.upper >= least - slack)
        return feasible

    def covering(self) -> tuple[float, float] | None:
        """Narrowest controlled range that makes every position feasible [N]; None where there is none.

        Where one tension does for all, both ends are the least such.
        """
        if not self.exists.all():
            return None
        need = max(0.0, float(self.lower.max()))
        return min(need, float(self.upper.min())), need


def support_interval(  # noqa: PLR0913 - as `compute_demand`
    robot: CableRobot,
    positions: FloatArray,
    orientations: FloatArray,
    wrenches: Sequence[Sequence[RequiredWrench]],
    motion: MotionSet,
    *,
    rope: int = 0,
    rows: tuple[int, ...] | None = None,
    progress: Progress | None = None,
) -> SupportInterval:
    """Find the feasible tensions of one counterbalance at every position.

    Parameters
    ----------
    robot : CableRobot
        Its other counterbalances keep their tensions, or their ranges.
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        The interval holds at all of them. [rad]
    wrenches : sequence of sequence of RequiredWrench
        For every orientation, of every load; the interval holds for every load.
    motion : MotionSet
        Accelerations.
    rope : int
        Index of the counterbalance.
    rows : tuple of int, optional
        Rows of the wrench; the robot's own by default.
    progress : callable, optional
        Called with (poses done, poses).

    Returns
    -------
    SupportInterval
        Exact for any rank: what the rope has to balance beyond the range of the cables fixes its tension.

    Notes
    -----
    Of the rope's column c and tension T, the wrenches w - T c have to lie within what the cables exert. Each facet of
    that states one inequality in T: n·w + reach - T n·c ≤ Σ(n·W)⁺ t_max - Σ(n·W)⁻ t_min.

    References
    ----------
    Eqs. 18-21 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387, for any redundancy and sets of wrenches.
    """
    used = robot.wrench_rows if rows is None else rows
    sets = wrench_sets(robot, used, wrenches, motion)
    each = np.repeat(positions, len(orientations), axis=0)
    which = np.tile(np.arange(len(orientations)), len(positions))
    lower, upper = np.empty(len(each)), np.empty(len(each))
    for start in range(0, len(each), POSES_AT_ONCE):
        part = slice(start, start + POSES_AT_ONCE)
        lower[part], upper[part] = _poses(robot, used, each[part], orientations, which[part], sets, rope)
        if progress is not None:
            progress(min(part.stop, len(each)), len(each))
    low = lower.reshape(len(positions), -1).max(axis=1)  # NaN passes through
    high = upper.reshape(len(positions), -1).min(axis=1)
    size = np.maximum(np.abs(low), np.abs(high))
    slack = BOUND_TOLERANCE * np.where(np.isfinite(size), size, 0.0)
    empty = ~(low <= high + slack) | np.isposinf(low) | np.isneginf(high)
    return SupportInterval(lower=np.where(empty, np.nan, low), upper=np.where(empty, np.nan, np.maximum(low, high)))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Columns:
    """What acts at q poses in r rows: columns (q, r, M) with bounds (M,), the rope's (q, r), and a shift (q, r)."""

    columns: FloatArray
    least: FloatArray
    most: FloatArray
    rope: FloatArray
    shift: FloatArray

    def along(self, basis: FloatArray, poses: IntArray) -> "_Columns":
        """Components along (p, n, r) orthonormal bases of the chosen poses."""
        return _Columns(
            columns=np.einsum("pnm,pnr->prm", self.columns[poses], basis),
            least=self.least,
            most=self.most,
            rope=np.einsum("pn,pnr->pr", self.rope[poses], basis),
            shift=np.einsum("pn,pnr->pr", self.shift[poses], basis),
        )


def _poses(
    robot: CableRobot,
    rows: tuple[int, ...],
    positions: FloatArray,
    orientations: FloatArray,
    which: IntArray,
    sets: WrenchSets,
    rope: int,
) -> tuple[FloatArray, FloatArray]:
    """Ends of the interval at q poses, over all sets of wrenches; (q,)."""
    scale = wrench_scale(robot, rows)[:, None]
    geometry = cable_geometry(robot, positions, orientations[which])
    ropes = counterbalance_columns(robot, positions, orientations[which], rows) * scale
    others = [index for index in range(len(robot.counterbalances)) if index != rope]
    fixed = [index for index in others if not robot.counterbalances[index].is_controlled]
    free = [index for index in others if robot.counterbalances[index].is_controlled]
    ends = np.array([[one.tension_min, one.tension_max] for one in robot.counterbalances])
    acting = _Columns(
        columns=np.concatenate([geometry.structure_matrix[:, rows] * scale, ropes[..., free]], axis=2),
        least=np.concatenate([robot.bounds.tension_min, ends[free, 0]]),
        most=np.concatenate([robot.bounds.tension_max, ends[free, 1]]),
        rope=ropes[..., rope],
        shift=ropes[..., fixed] @ ends[fixed, 0],
    )
    rank, left = structure_rank(acting.columns)
    lower, upper = np.full(len(positions), np.nan), np.full(len(positions), np.nan)
    for value in np.unique(rank):
        at = np.flatnonzero(rank == value)
        basis = left[at][:, :, :value]
        low, high = _within(acting.along(basis, at), sets.projected(basis, which[at]))
        if value < len(rows):
            beyond = left[at][:, :, value:]
            size = sets.magnitude(which[at]).max(axis=1) + np.linalg.norm(acting.shift[at], axis=1)
            fixed_low, fixed_high = _beyond(acting.along(beyond, at), sets.projected(beyond, which[at]), size)
            low, high = np.maximum(low, fixed_low), np.minimum(high, fixed_high)
        lower[at], upper[at] = low, high
    unreachable = (geometry.lengths > robot.bounds.length_max * (1.0 + BOUND_TOLERANCE)).any(axis=1)
    unreachable |= (geometry.lengths <= 0.0).any(axis=1)
    return np.where(unreachable, np.nan, lower), np.where(unreachable, np.nan, upper)


def _within(acting: _Columns, sets: WrenchSets) -> tuple[FloatArray, FloatArray]:
    """Interval from the facets of what columns of full rank exert, (q,); empty where the ends cross."""
    poses, rank, _ = acting.columns.shape
    lower, upper = np.full(poses, -np.inf), np.full(poses, np.inf)
    if rank == 0:
        return lower, upper
    index = np.arange(poses)
    centre = sets.centre - acting.shift[:, None]
    size = sets.magnitude(index).max(axis=1) + np.linalg.norm(acting.shift, axis=1)
    rope_size = np.linalg.norm(acting.rope, axis=1)
    for normal, _ in facet_normals(acting.columns):
        pulls = in_hyperplane(np.einsum("qr,qrm->qm", normal, acting.columns), acting.columns)
        along = np.einsum("qr,qr->q", normal, acting.rope)
        middle, reach = np.einsum("qr,qgr->qg", normal, centre), sets.reach(normal, index)
        for sign in (1.0, -1.0):
            with_it, against = np.maximum(sign * pulls, 0.0), np.maximum(-sign * pulls, 0.0)
            most = (with_it * np.where(with_it > 0.0, acting.most, 0.0)).sum(axis=1) - against @ acting.least
            excess = (sign * middle + reach).max(axis=1) - most  # T n·c has to make up for it
            component = sign * along
            bears = np.abs(component) > COLUMN_TOLERANCE * rope_size
            end = np.divide(excess, component, out=np.zeros(poses), where=bears)
            np.maximum(lower, np.where(bears & (component > 0.0), end, -np.inf), out=lower)
            np.minimum(upper, np.where(bears & (component < 0.0), end, np.inf), out=upper)
            lower[~bears & (excess > WRENCH_TOLERANCE * size)] = np.inf
    return lower, upper


def _beyond(acting: _Columns, sets: WrenchSets, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Interval from what no cable balances: one tension, or any where nothing is asked there; empty ends cross.

    `size`, (q,), is that of all wrenches at hand, to tell what is rounding.
    """
    spread = np.linalg.norm(sets.segments, axis=-1).sum(axis=-1) + np.linalg.norm(sets.balls, axis=(-2, -1)).sum(
        axis=-1
    )
    centre = sets.centre - acting.shift[:, None]
    square = np.einsum("qr,qr->q", acting.rope, acting.rope)
    bears = square > COLUMN_TOLERANCE**2
    tension = np.einsum("qgr,qr->qg", centre, acting.rope) / np.where(bears, square, 1.0)[:, None]
    first = np.where(bears, tension[:, 0], 0.0)
    left_over = np.linalg.norm(centre - first[:, None, None] * acting.rope[:, None], axis=-1) + spread
    holds = (left_over <= BALANCE_TOLERANCE * size[:, None]).all(axis=1)
    lower = np.where(holds, np.where(bears, first, -np.inf), np.inf)
    upper = np.where(holds, np.where(bears, first, np.inf), -np.inf)
    return lower, upper
