"""Robots with one cable more than degrees of freedom: their tensions lie on a line, an interval of it is allowed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.dynamics import RequiredWrench, wrench_scale
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.robot import CableRobot
from actuator_select.model.supports import support_wrenches
from actuator_select.model.tension import RANK_TOLERANCE

NULL_TOLERANCE = 1e-12  # of the unit null vector; a cable whose entry is smaller keeps its tension along the line
BOUND_TOLERANCE = 1e-9  # of the bounds, relative to the largest tension at hand; less is rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class NullInterval:
    """Tensions t = W⁺ w + α n of q poses with n rows and m = n + 1 cables.

    Attributes
    ----------
    particular : (q, m) array
        W⁺ w, the tensions of least Euclidean norm. [N]
    null_vector : (q, m) array
        n, of unit length; its sign is arbitrary. [-]
    lower, upper : (q,) array
        Interval of α that the bounds of all cables leave; empty where lower > upper. [N]
    feasible : (q,) array of bool
        Whether the interval holds a value. False where the rank is short, of which the line says nothing.
    of_full_rank : (q,) array of bool
        Whether the columns span all n rows.
    """

    particular: FloatArray
    null_vector: FloatArray
    lower: FloatArray
    upper: FloatArray
    feasible: BoolArray
    of_full_rank: BoolArray

    def tensions(self, along: FloatArray) -> FloatArray:
        """Tensions at α = `along`, (q,) [N], as a (q, m) array. [N]"""
        return self.particular + along[:, None] * self.null_vector


def null_interval(columns: FloatArray, required: FloatArray, lower: FloatArray, upper: FloatArray) -> NullInterval:
    """Find all tensions within their bounds that hold a wrench.

    Parameters
    ----------
    columns : (q, n, n + 1) array
        Structure matrix W. Moment rows are best divided by a length that makes them comparable with forces.
    required : (q, n) array
        w, what the cables have to supply beside the counterbalances, scaled alike; u of the reference.
    lower, upper : (n + 1,) or (q, n + 1) array
        Bounds of the tensions; infinite where there is none. [N]

    Returns
    -------
    NullInterval
        Exact at every pose of full rank.

    References
    ----------
    Eqs. 17 and 18 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    poses, rows, cables = columns.shape
    if cables != rows + 1:
        raise ValueError(f"{columns.shape=}, expected one column more than rows")
    left, sigma, right = np.linalg.svd(columns, full_matrices=True)
    of_full_rank = sigma[:, -1] > RANK_TOLERANCE * sigma[:, 0]
    inverse = np.divide(1.0, sigma, out=np.zeros_like(sigma), where=of_full_rank[:, None])
    along_left = np.einsum("qnr,qn->qr", left, required)
    particular = np.einsum("qrm,qr->qm", right[:, :rows], inverse * along_left)  # (J_l^T)⁺ u in eq. 18
    null_vector = right[:, rows]
    low, high = (np.broadcast_to(bound, (poses, cables)) for bound in (lower, upper))
    ends = _ends(particular, null_vector, low, high)
    rounding = BOUND_TOLERANCE * np.abs(particular).max(axis=1)
    return NullInterval(
        particular=particular,
        null_vector=null_vector,
        lower=ends[0],
        upper=ends[1],
        feasible=of_full_rank & (ends[0] <= ends[1] + rounding),
        of_full_rank=of_full_rank,
    )


def _ends(
    particular: FloatArray, null_vector: FloatArray, lower: FloatArray, upper: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Interval of α of every pose, each end (q,)."""
    moves = np.abs(null_vector) > NULL_TOLERANCE
    slope = np.where(moves, null_vector, 1.0)
    from_lower, from_upper = (lower - particular) / slope, (upper - particular) / slope
    # A cable that stays as it is allows every α or none.
    rounding = BOUND_TOLERANCE * np.abs(particular).max(axis=1, keepdims=True)
    holds = (particular >= lower - rounding) & (particular <= upper + rounding)
    rises = slope > 0.0
    least = np.where(moves, np.where(rises, from_lower, from_upper), np.where(holds, -np.inf, np.inf))
    most = np.where(moves, np.where(rises, from_upper, from_lower), np.where(holds, np.inf, -np.inf))
    return least.max(axis=1), most.min(axis=1)


def stiffest_tensions(interval: NullInterval) -> FloatArray:
    """Tensions of the largest Euclidean norm within the bounds.

    ‖W⁺ w + α n‖² is convex in α, so that the largest stands at an end of the interval, and the better end is exact.
    Eqs. 20 and 21 as printed set one cable at a time to its greatest tension. An end of the interval is of that kind
    while all entries of the null vector have one sign; where they differ, tensions may end at a least tension instead,
    and the printed equations miss it, or find no tension where there is one.

    Parameters
    ----------
    interval : NullInterval
        Of q poses.

    Returns
    -------
    (q, m) array
        NaN where the pose is infeasible, and where no bound ends the line: stiffness then has no largest value. [N]

    References
    ----------
    Eqs. 20 and 21 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    bounded = interval.feasible & np.isfinite(interval.lower) & np.isfinite(interval.upper)
    ends = [interval.tensions(np.where(bounded, end, np.nan)) for end in (interval.lower, interval.upper)]
    first_is_stiffer = np.linalg.norm(ends[0], axis=1) > np.linalg.norm(ends[1], axis=1)
    return np.where(first_is_stiffer[:, None], *ends)


def interval_at_rest(
    robot: CableRobot,
    positions: FloatArray,
    orientations: FloatArray,
    wrenches: Sequence[RequiredWrench],
    bounds: tuple[FloatArray, FloatArray] | None = None,
) -> NullInterval:
    """`null_interval` of a robot that stands still.

    Parameters
    ----------
    robot : CableRobot
        Of redundancy 1, with counterbalances of constant tension if any.
    positions : (q, 3) array
        [m]
    orientations : (q, 3) array
        [rad]
    wrenches : sequence of RequiredWrench
        At each of the q poses; external loads at the middle of their box.
    bounds : tuple of (m,) or (q, m) array, optional
        Least and greatest tensions instead of the robot's. [N]

    Returns
    -------
    NullInterval
        At the q poses.
    """
    rows = robot.wrench_rows
    support = support_wrenches(robot, positions, orientations, rows)
    if len(support.lower):
        raise ValueError("a controlled counterbalance adds a column; state a constant tension")
    scale = wrench_scale(robot, rows)
    structure = cable_geometry(robot, positions, orientations).structure_matrix[:, rows]
    required = np.array([wrench.static[list(rows)] for wrench in wrenches]) - support.constant  # eq. 17
    lower, upper = (robot.bounds.tension_min, robot.bounds.tension_max) if bounds is None else bounds
    return null_interval(structure * scale[:, None], required * scale, lower, upper)


def unstretched_lengths(lengths: FloatArray, tensions: FloatArray, axial_stiffness: FloatArray) -> FloatArray:
    """Length l0 = l EA/(T + EA) of a cable that tension T stretches to l.

    Parameters
    ----------
    lengths : (q, m) array
        Of the straight, stretched cables. [m]
    tensions : (q, m) array
        [N]
    axial_stiffness : (m,) array
        EA; infinite for a cable that does not stretch. [N]

    Returns
    -------
    (q, m) array
        [m]

    References
    ----------
    Eq. 22 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    return np.asarray(lengths / (1.0 + tensions / axial_stiffness), dtype=np.float64)


def tensions_for_unstretched_lengths(
    lengths: FloatArray, axial_stiffness: FloatArray, least: FloatArray, greatest: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Tensions between which l0_min ≤ l EA/(T + EA) ≤ l0_max holds: eq. 22 as bounds of the tension.

    l0 falls with the tension, so that bounds of l0 are bounds of T, and eq. 22 is eq. 21 with narrower ones.

    Parameters
    ----------
    lengths : (q, m) array
        [m]
    axial_stiffness : (m,) array
        [N]
    least, greatest : (m,) array
        l0_min and l0_max; 0 and infinite where there is no bound. [m]

    Returns
    -------
    tuple of (q, m) array
        Least and greatest tension; an empty interval where a cable that does not stretch has a length out of its
        bounds. [N]

    References
    ----------
    Eq. 22 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    stretches = np.isfinite(axial_stiffness)
    stiffness = np.where(stretches, axial_stiffness, 1.0)
    with np.errstate(divide="ignore"):
        lower, upper = stiffness * (lengths / greatest - 1.0), stiffness * (lengths / least - 1.0)
    holds = (lower <= 0.0) & (upper >= 0.0)  # of a cable that does not stretch: any tension does, or none
    lower = np.where(stretches, lower, np.where(holds, -np.inf, np.inf))
    upper = np.where(stretches, upper, np.where(holds, np.inf, -np.inf))
    return lower, upper
