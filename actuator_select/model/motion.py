"""What the platform has to do at every pose: sets of velocities and accelerations, taken independently."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import FloatArray

SPEED_TOLERANCE = 1e-9  # relative; keeps samples that lie on the speed limit but for rounding


class MotionKind(StrEnum):
    """How the set is described."""

    INDEPENDENT = "independent"
    SAMPLED = "sampled"


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionSet:
    """Every velocity of a set together with every acceleration of a box.

    Attributes
    ----------
    kind : MotionKind
        `INDEPENDENT`: the ball ‖v‖ ≤ `speed`; `SAMPLED`: the listed velocities.
    speed : float
        Greatest speed V of the platform. [m/s]
    velocities : (S, 3) array
        The samples; for the ball an array without rows. [m/s]
    acceleration_lower, acceleration_upper : (3,) array
        Corners of the box of accelerations. Sampled accelerations form a grid, and what the limits test is convex in
        the acceleration, so that the box has the same worst case as its sampled corners. [m/s²]
    centripetal : bool
        Whether the cable's acceleration has its term (‖v‖² - (u·v)²)/l.
    """

    kind: MotionKind
    speed: float
    velocities: FloatArray
    acceleration_lower: FloatArray
    acceleration_upper: FloatArray
    centripetal: bool

    @property
    def acceleration_centre(self) -> FloatArray:
        """Centre of the box of accelerations, (3,). [m/s²]"""
        centre: FloatArray = (self.acceleration_lower + self.acceleration_upper) / 2.0
        return centre

    @property
    def acceleration_reach(self) -> FloatArray:
        """Half the box's edges, (3,). [m/s²]"""
        reach: FloatArray = (self.acceleration_upper - self.acceleration_lower) / 2.0
        return reach


def independent_motion(
    speed: float, acceleration_time: float, deceleration_time: float, *, centripetal: bool
) -> MotionSet:
    """Ball of velocities times the box of accelerations that a trapezoidal profile reaches on every axis.

    Parameters
    ----------
    speed : float
        V. [m/s]
    acceleration_time, deceleration_time : float
        Ramp times from rest to V and back; the shorter one gives |a_j| ≤ V/t. [s]
    centripetal : bool
        As in `MotionSet`.

    Returns
    -------
    MotionSet
        Exact form of eqs. 23-29 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    acceleration = np.full(3, speed / min(acceleration_time, deceleration_time))
    return MotionSet(
        kind=MotionKind.INDEPENDENT,
        speed=speed,
        velocities=np.empty((0, 3)),
        acceleration_lower=-acceleration,
        acceleration_upper=acceleration,
        centripetal=centripetal,
    )


def sampled_motion(
    speed: float,
    acceleration_time: float,
    deceleration_time: float,
    *,
    velocity_intervals: int,
    acceleration_levels: tuple[float, ...],
    centripetal: bool,
) -> MotionSet:
    """Sampled velocities and accelerations of the paper's loops.

    Parameters
    ----------
    speed, acceleration_time, deceleration_time : float
        As for `independent_motion`. [m/s, s, s]
    velocity_intervals : int
        N: every axis takes -V, -V + 2V/N, ..., V; samples faster than V are dropped (eqs. 23-26 in [1]).
    acceleration_levels : tuple of float
        Accelerations of every axis, as multiples of V/t_acc (positive) and V/t_dec (negative); eqs. 27-29 in [1].
    centripetal : bool
        As in `MotionSet`.

    Returns
    -------
    MotionSet
        With the samples listed.

    References
    ----------
    .. [1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    axis = np.linspace(-speed, speed, velocity_intervals + 1)
    velocities = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    velocities = velocities[np.linalg.norm(velocities, axis=1) <= speed * (1.0 + SPEED_TOLERANCE)]
    levels = np.array(acceleration_levels)
    accelerations = np.where(levels >= 0.0, levels * speed / acceleration_time, levels * speed / deceleration_time)
    return MotionSet(
        kind=MotionKind.SAMPLED,
        speed=speed,
        velocities=velocities,
        acceleration_lower=np.full(3, accelerations.min()),
        acceleration_upper=np.full(3, accelerations.max()),
        centripetal=centripetal,
    )
