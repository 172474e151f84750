"""Counterbalances: ropes that carry a part of the load at a tension that no winch of the robot sets."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.kinematics import segment_geometry
from actuator_select.model.robot import CableRobot


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """Wrenches of the counterbalances at q poses, in n rows.

    Attributes
    ----------
    constant : (q, n) array
        Of all ropes of constant tension together. [N, N m]
    controlled : (q, n, c) array
        Per unit of tension, of each of c ropes whose tension is controlled. [-, m]
    lower, upper : (c,) array
        Bounds of these tensions. [N]
    """

    constant: FloatArray
    controlled: FloatArray
    lower: FloatArray
    upper: FloatArray


def counterbalance_columns(
    robot: CableRobot, positions: FloatArray, orientations: FloatArray, rows: tuple[int, ...]
) -> FloatArray:
    """Wrench of every counterbalance per unit of its tension, all its segments together, (q, n, k). [-, m]"""
    columns = [
        segment_geometry(one.frame_anchors, one.platform_anchors, positions, orientations).structure_matrix.sum(axis=-1)
        for one in robot.counterbalances
    ]
    return np.stack(columns, axis=-1)[:, rows] if columns else np.zeros((len(positions), len(rows), 0))


def support_wrenches(
    robot: CableRobot, positions: FloatArray, orientations: FloatArray, rows: tuple[int, ...]
) -> Support:
    """Wrenches that the counterbalances supply.

    Parameters
    ----------
    robot : CableRobot
        With its counterbalances.
    positions : (q, 3) array
        [m]
    orientations : (q, 3) array
        [rad]
    rows : tuple of int
        Rows of the wrench.

    Returns
    -------
    Support
        Unscaled.

    References
    ----------
    Eqs. 4-6 and 14-17 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    columns = counterbalance_columns(robot, positions, orientations, rows)
    controlled = np.array([one.is_controlled for one in robot.counterbalances], dtype=np.bool_)
    lower = np.array([one.tension_min for one in robot.counterbalances], dtype=np.float64)
    upper = np.array([one.tension_max for one in robot.counterbalances], dtype=np.float64)
    return Support(
        constant=columns[..., ~controlled] @ lower[~controlled],
        controlled=columns[..., controlled],
        lower=lower[controlled],
        upper=upper[controlled],
    )
