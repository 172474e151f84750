"""What the platform has to do at every pose: sets of velocities and accelerations."""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import FloatArray

SPEED_TOLERANCE = 1e-9  # relative; keeps samples that lie on the speed limit but for rounding


class MotionKind(StrEnum):
    """How the set is described."""

    INDEPENDENT = "independent"
    STRAIGHT = "straight"
    SAMPLED = "sampled"
    LISTED = "list"
    REST = "rest"


class SetShape(StrEnum):
    """A ball bounds the magnitude, a box every component."""

    BALL = "ball"
    BOX = "box"


def extent(vectors: FloatArray, size: FloatArray, shape: SetShape) -> FloatArray:
    """Largest dot product of (..., 3) vectors with a box of half edges `size`, (3,), or a ball of radius `size[0]`."""
    if shape is SetShape.BALL:
        return np.asarray(np.linalg.norm(vectors, axis=-1) * size[0], dtype=np.float64)
    return np.asarray(np.abs(vectors) @ size, dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionSet:
    """Velocities and accelerations that have to be possible at every pose.

    Attributes
    ----------
    kind : MotionKind
        `INDEPENDENT`: every velocity with every acceleration; `STRAIGHT`: velocity and acceleration along one line,
        in any direction, from rest over the ramp and the cruise to rest; `SAMPLED`: the listed velocities with every
        acceleration of the box; `LISTED`: each of the listed motions; `REST`: none.
    speed : float
        Greatest speed V of the platform, or of every component where `velocity_shape` is a box. [m/s]
    velocity_shape : SetShape
        Of the set of velocities, where they are not sampled.
    velocities : (S, 3) array
        The samples; for other kinds an array without rows. [m/s]
    acceleration_lower, acceleration_upper : (3,) array
        Corners of the box of accelerations. Sampled accelerations form a grid, and what the limits test is convex in
        the acceleration, so that the box has the same worst case as its sampled corners. [m/s²]
    acceleration_shape : SetShape
        A ball has the box's half edge as its radius.
    centripetal : bool
        Whether the cable's acceleration has its term (‖v‖² - (u·v)²)/l.
    angular_speed, angular_acceleration : float
        Greatest of a platform that turns, shaped as the linear ones. [rad/s, rad/s²]
    listed : (L, 4, 3) array
        Velocity, acceleration, angular velocity, angular acceleration of each listed motion.
    """

    kind: MotionKind
    speed: float
    velocities: FloatArray
    acceleration_lower: FloatArray
    acceleration_upper: FloatArray
    centripetal: bool
    velocity_shape: SetShape = SetShape.BALL
    acceleration_shape: SetShape = SetShape.BOX
    angular_speed: float = 0.0
    angular_acceleration: float = 0.0
    listed: FloatArray = field(default_factory=lambda: np.zeros((0, 4, 3)))

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

    @property
    def turns(self) -> bool:
        """Whether the platform turns."""
        return self.angular_speed > 0.0 or self.angular_acceleration > 0.0

    @property
    def speed_bound(self) -> float:
        """Greatest magnitude of the velocity. [m/s]"""
        return self.speed * (np.sqrt(3.0) if self.velocity_shape is SetShape.BOX else 1.0)

    @property
    def angular_speed_bound(self) -> float:
        """Greatest magnitude of the angular velocity of a platform that turns about three axes. [rad/s]"""
        return self.angular_speed * (np.sqrt(3.0) if self.velocity_shape is SetShape.BOX else 1.0)

    @property
    def cases(self) -> int:
        """Sets that a pose has to hold one by one: the listed motions, else a single one."""
        return len(self.listed) if self.kind is MotionKind.LISTED else 1

    def at_rest(self) -> "MotionSet":
        """The same without any motion."""
        return rest(centripetal=self.centripetal)


def rest(*, centripetal: bool = True) -> MotionSet:
    """No motion at all: what it takes to stand still."""
    return MotionSet(
        kind=MotionKind.REST,
        speed=0.0,
        velocities=np.empty((0, 3)),
        acceleration_lower=np.zeros(3),
        acceleration_upper=np.zeros(3),
        centripetal=centripetal,
    )


def listed_motion(listed: FloatArray, *, centripetal: bool) -> MotionSet:
    """Each of the given motions.

    Parameters
    ----------
    listed : (L, 4, 3) array
        Velocity, acceleration, angular velocity, angular acceleration. [m/s, m/s², rad/s, rad/s²]
    centripetal : bool
        As in `MotionSet`.

    Returns
    -------
    MotionSet
        With L cases.
    """
    speeds = np.linalg.norm(listed, axis=-1)
    fastest = np.abs(listed[:, 1]).max(axis=0)
    return MotionSet(
        kind=MotionKind.LISTED,
        speed=float(speeds[:, 0].max()),
        velocities=np.empty((0, 3)),
        acceleration_lower=-fastest,
        acceleration_upper=fastest,
        centripetal=centripetal,
        angular_speed=float(speeds[:, 2].max()),
        angular_acceleration=float(speeds[:, 3].max()),
        listed=listed,
    )


def independent_motion(  # noqa: PLR0913 - one figure each
    speed: float,
    acceleration_time: float,
    deceleration_time: float,
    *,
    centripetal: bool,
    kind: MotionKind = MotionKind.INDEPENDENT,
    velocity_shape: SetShape = SetShape.BALL,
    acceleration_shape: SetShape = SetShape.BOX,
    angular_speed: float = 0.0,
) -> MotionSet:
    """Velocities up to the greatest speed, and the accelerations that a trapezoidal profile reaches.

    Parameters
    ----------
    speed : float
        V. [m/s]
    acceleration_time, deceleration_time : float
        Ramp times from rest to V and back; the shorter one gives the greatest acceleration V/t. [s]
    centripetal : bool
        As in `MotionSet`.
    kind : MotionKind
        `INDEPENDENT` or `STRAIGHT`.
    velocity_shape, acceleration_shape : SetShape
        Whether V and V/t bound magnitudes or components.
    angular_speed : float
        Ω, reached in the same times. [rad/s]

    Returns
    -------
    MotionSet
        Exact form of eqs. 23-29 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F, where accelerations are a box.
    """
    ramp = min(acceleration_time, deceleration_time)
    acceleration = np.full(3, speed / ramp)
    return MotionSet(
        kind=kind,
        speed=speed,
        velocities=np.empty((0, 3)),
        acceleration_lower=-acceleration,
        acceleration_upper=acceleration,
        centripetal=centripetal,
        velocity_shape=velocity_shape,
        acceleration_shape=acceleration_shape,
        angular_speed=angular_speed,
        angular_acceleration=angular_speed / ramp,
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
