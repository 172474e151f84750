"""How fast and with what acceleration every cable winds over a motion set: closed forms, worst cases only."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.kinematics import CableGeometry
from actuator_select.model.motion import MotionKind, MotionSet, SetShape, extent
from actuator_select.model.robot import CableRobot


@dataclass(frozen=True, slots=True, kw_only=True)
class CableMotion:
    """Extremes of cable speed and acceleration at q poses for L cases of the motion set, winding in positive.

    The cable's acceleration is linear + turning - swing: along the cable from the platform's acceleration, from its
    turning, and from the cable's own swinging about its frame anchor.

    Attributes
    ----------
    speed_in, speed_out : (q, L, m) array
        Greatest cable speed winding in and out. [m/s]
    middle : (q, L, m) array
        Cable acceleration at the middle of its range, but for the swing term. [m/s²]
    reach : (q, L, m) array
        Half that range. [m/s²]
    least_swing, most_swing : (q, L, m) array
        Range of the swing term. [m/s²]
    """

    speed_in: FloatArray
    speed_out: FloatArray
    middle: FloatArray
    reach: FloatArray
    least_swing: FloatArray
    most_swing: FloatArray

    @property
    def acceleration_in(self) -> FloatArray:
        """Greatest acceleration winding in, (q, L, m). [m/s²]"""
        return self.middle + self.reach - self.least_swing

    @property
    def acceleration_out(self) -> FloatArray:
        """Greatest acceleration winding out, (q, L, m). [m/s²]"""
        return self.reach - self.middle + self.most_swing


def cable_motion(robot: CableRobot, geometry: CableGeometry, motion: MotionSet) -> CableMotion:
    """Worst cases over the motion set.

    Parameters
    ----------
    robot : CableRobot
        With m cables; its freedom says how the platform may move.
    geometry : CableGeometry
        At q poses.
    motion : MotionSet
        Velocities and accelerations.

    Returns
    -------
    CableMotion
        Exact where the platform does not turn, but for the acceleration winding out of straight moves; that, and all
        of a platform that turns, is a safe bound: the sum of the worst cases of the terms.
    """
    along = geometry.directions * _mask(robot.free_axes)
    about = geometry.structure_matrix[:, 3:].swapaxes(-1, -2) * _mask(robot.turning_axes)
    inverse_length = swing_scale(geometry.lengths, motion)
    if motion.kind is MotionKind.LISTED:
        return _listed(geometry, along, about, inverse_length, motion)
    if motion.kind is MotionKind.SAMPLED:
        speeds = _sampled(robot, along, inverse_length, motion)
    else:
        speeds = _largest(robot, geometry, along, about, inverse_length, motion)
    speed_in, speed_out, least_swing, most_swing = speeds
    middle = along @ motion.acceleration_centre
    reach = extent(along, motion.acceleration_reach, motion.acceleration_shape)
    if motion.turns:
        reach = reach + extent(about, np.full(3, motion.angular_acceleration), motion.acceleration_shape)
        least, most = _turning(robot, geometry, motion)
        middle, reach = middle + (least + most) / 2.0, reach + (most - least) / 2.0
    return CableMotion(
        speed_in=speed_in[:, None],
        speed_out=speed_out[:, None],
        middle=middle[:, None],
        reach=reach[:, None],
        least_swing=least_swing[:, None],
        most_swing=most_swing[:, None],
    )


def swing_scale(lengths: FloatArray, motion: MotionSet) -> FloatArray:
    """1/l where the motion set counts the centripetal term, 0 where it leaves it out; shape of `lengths`. [1/m]"""
    if not motion.centripetal:
        return np.zeros_like(lengths)
    return np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0.0)


def _mask(axes: tuple[int, ...]) -> FloatArray:
    mask = np.zeros(3)
    mask[list(axes)] = 1.0
    return mask


def _largest(
    robot: CableRobot,
    geometry: CableGeometry,
    along: FloatArray,
    about: FloatArray,
    inverse_length: FloatArray,
    motion: MotionSet,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    speed = extent(along, np.full(3, motion.speed), motion.velocity_shape)
    anchor_speed = np.full_like(speed, motion.speed_bound)
    if motion.turns:
        speed = speed + extent(about, np.full(3, motion.angular_speed), motion.velocity_shape)
        anchor_speed = anchor_speed + motion.angular_speed_bound * np.linalg.norm(robot.platform_anchors, axis=1)
    nothing = np.zeros_like(speed)
    if motion.velocity_shape is SetShape.BOX and not motion.turns:
        return speed, speed, nothing, inverse_length * _across_at_corners(robot, along) * motion.speed**2
    return speed, speed, nothing, inverse_length * anchor_speed**2 * (geometry.lengths > 0.0)


def _across_at_corners(robot: CableRobot, along: FloatArray) -> FloatArray:
    """Greatest ‖v‖² - (u·v)² of the box |v_j| ≤ 1, (q, m): convex in v, and so largest at a corner."""
    corners = np.array(list(product((-1.0, 1.0), repeat=3))) * _mask(robot.free_axes)
    across: FloatArray = ((corners**2).sum(axis=1) - (along @ corners.T) ** 2).max(axis=-1)
    return across


def _turning(robot: CableRobot, geometry: CableGeometry, motion: MotionSet) -> tuple[FloatArray, FloatArray]:
    """Least and greatest of u·(ω × (ω × R b)), each (q, m): eigenvalues of a quadratic form in ω."""
    if not motion.centripetal:
        return np.zeros_like(geometry.lengths), np.zeros_like(geometry.lengths)
    inwards = np.einsum("qmk,qmk->qm", geometry.directions, geometry.arms)  # u · R b
    square = motion.angular_speed_bound**2
    if len(robot.turning_axes) == 1:
        across = geometry.arms * _mask(robot.free_axes)
        inwards = np.einsum("qmk,qmk->qm", geometry.directions, across)
        return np.minimum(0.0, -inwards) * motion.angular_speed**2, np.maximum(0.0, -inwards) * motion.angular_speed**2
    arm = np.linalg.norm(geometry.arms, axis=-1)
    return -square * (arm + inwards) / 2.0, square * (arm - inwards) / 2.0


def cable_speeds(directions: FloatArray, motion: MotionSet) -> FloatArray:
    """Cable speed u·v of every sampled velocity, (q, m, S). [m/s]."""
    rates: FloatArray = directions.reshape(-1, 3) @ motion.velocities.T
    return rates.reshape(*directions.shape[:-1], -1)


def _sampled(
    robot: CableRobot, along: FloatArray, inverse_length: FloatArray, motion: MotionSet
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    rates = cable_speeds(along, motion)
    speed_in, speed_out = rates.max(axis=-1), -rates.min(axis=-1)
    if not motion.centripetal:
        nothing = np.zeros_like(speed_in)
        return speed_in, speed_out, nothing, nothing
    across = ((motion.velocities * _mask(robot.free_axes)) ** 2).sum(axis=1) - rates**2
    return speed_in, speed_out, inverse_length * across.min(axis=-1), inverse_length * across.max(axis=-1)


def _listed(
    geometry: CableGeometry, along: FloatArray, about: FloatArray, inverse_length: FloatArray, motion: MotionSet
) -> CableMotion:
    velocity, acceleration, spin, spin_rate = np.moveaxis(motion.listed, 1, 0)
    rate = np.einsum("qmk,lk->qlm", along, velocity) + np.einsum("qmk,lk->qlm", about, spin)
    middle = np.einsum("qmk,lk->qlm", along, acceleration) + np.einsum("qmk,lk->qlm", about, spin_rate)
    swing = np.zeros_like(rate)
    if motion.centripetal:
        spun = np.cross(spin[None, :, None], geometry.arms[:, None])  # ω × R b, (q, L, m, 3)
        inwards = np.einsum("qmk,qlmk->qlm", geometry.directions, np.cross(spin[None, :, None], spun))
        middle = middle + inwards
        anchor_speed = velocity[None, :, None] + spun
        swing = ((anchor_speed**2).sum(axis=-1) - rate**2) * inverse_length[:, None]
    return CableMotion(
        speed_in=rate, speed_out=-rate, middle=middle, reach=np.zeros_like(rate), least_swing=swing, most_swing=swing
    )
