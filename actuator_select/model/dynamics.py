"""What the platform's motion and its loads ask of the cables together: the required wrench."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.hyperplanes import WrenchSets
from actuator_select.model.kinematics import rotation_matrix
from actuator_select.model.motion import MotionKind, MotionSet, SetShape
from actuator_select.model.robot import CableRobot, Freedom, RigidBody


def _zeros(*shape: int) -> FloatArray:
    return np.zeros(shape)


@dataclass(frozen=True, slots=True, kw_only=True)
class Load:
    """What the platform carries, and what pushes it.

    Attributes
    ----------
    title : str
        For people.
    body : RigidBody
        Mass beside the platform's own.
    force_lower, force_upper : (3,) array
        External force on the platform, world frame: any value of the box. [N]
    moment_lower, moment_upper : (3,) array
        External moment about the platform's origin, world frame. [N m]
    """

    title: str
    body: RigidBody
    force_lower: FloatArray = field(default_factory=lambda: _zeros(3))
    force_upper: FloatArray = field(default_factory=lambda: _zeros(3))
    moment_lower: FloatArray = field(default_factory=lambda: _zeros(3))
    moment_upper: FloatArray = field(default_factory=lambda: _zeros(3))


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiredWrench:
    """Wrench that the cables must supply at one orientation, about the platform's origin: force [N], moment [N m].

    w = static ± external_reach + per_acceleration · a + per_angular_acceleration · α + velocity terms.

    Attributes
    ----------
    static : (6,) array
        At rest, external loads at the centre of their box.
    per_acceleration : (6, 3) array
        Per unit of the origin's acceleration. [kg, kg m]
    per_angular_acceleration : (6, 3) array
        [kg m, kg m²]
    external_reach : (6,) array
        Half the box of external loads.
    first_moment : (3,) array
        Mass times centre of gravity, world frame; its rotation asks for a centrifugal force. [kg m]
    inertia : (3, 3) array
        About the platform's origin, world frame. [kg m²]
    """

    static: FloatArray
    per_acceleration: FloatArray
    per_angular_acceleration: FloatArray = field(default_factory=lambda: _zeros(6, 3))
    external_reach: FloatArray = field(default_factory=lambda: _zeros(6))
    first_moment: FloatArray = field(default_factory=lambda: _zeros(3))
    inertia: FloatArray = field(default_factory=lambda: _zeros(3, 3))

    def of_rotation(self, angular_velocity: FloatArray) -> FloatArray:
        """Wrench of turning at ω: [ω × (ω × m c), ω × (I ω)], (6,)."""
        centrifugal = np.cross(angular_velocity, np.cross(angular_velocity, self.first_moment))
        gyroscopic = np.cross(angular_velocity, self.inertia @ angular_velocity)
        return np.concatenate([centrifugal, gyroscopic])


def required_wrench(mass: float, gravity: float) -> RequiredWrench:
    """Wrench of a load that translates: F = m (a - gravity vector), no moments.

    Eq. 31 in [1] prints m (z̈ - g); with z up, as in its figures, gravity has to be *added* for a load that hangs.

    Parameters
    ----------
    mass : float
        Mass of carrier and load, its centre at the platform's origin. [kg]
    gravity : float
        Gravitational acceleration, acting along -z. [m/s²]

    Returns
    -------
    RequiredWrench
        Affine in the acceleration.

    References
    ----------
    .. [1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    body = RigidBody(mass=mass)
    return platform_wrench([body], gravity, np.zeros(3))


def platform_wrench(
    bodies: Sequence[RigidBody], gravity: float, orientation: FloatArray, load: Load | None = None
) -> RequiredWrench:
    """Newton and Euler about the platform's origin, for the platform and what it carries.

    Parameters
    ----------
    bodies : sequence of RigidBody
        The platform, and what moves with it.
    gravity : float
        Along -z. [m/s²]
    orientation : (3,) array
        Angles ψ, θ, φ. [rad]
    load : Load, optional
        Adds its body and its external loads.

    Returns
    -------
    RequiredWrench
        External loads go off what is required.

    References
    ----------
    Eq. 15 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387, for any centre of gravity.
    """
    rotation = rotation_matrix(orientation)
    mass, first_moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for body in (*bodies, load.body) if load is not None else bodies:
        arm = rotation @ body.centre_of_gravity
        mass += body.mass
        first_moment += body.mass * arm
        inertia += rotation @ body.inertia @ rotation.T + body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    cross = np.array(
        [
            [0.0, -first_moment[2], first_moment[1]],
            [first_moment[2], 0.0, -first_moment[0]],
            [-first_moment[1], first_moment[0], 0.0],
        ]
    )
    upwards = np.array([0.0, 0.0, gravity])  # standing still asks for what accelerating upwards by g would
    static = np.concatenate([mass * upwards, cross @ upwards])
    reach = np.zeros(6)
    if load is not None:
        lower = np.concatenate([load.force_lower, load.moment_lower])
        upper = np.concatenate([load.force_upper, load.moment_upper])
        static -= (lower + upper) / 2.0
        reach = (upper - lower) / 2.0
    return RequiredWrench(
        static=static,
        per_acceleration=np.vstack([mass * np.eye(3), cross]),
        per_angular_acceleration=np.vstack([-cross, inertia]),
        external_reach=reach,
        first_moment=first_moment,
        inertia=inertia,
    )


def wrench_scale(robot: CableRobot, rows: Sequence[int]) -> FloatArray:
    """Factors of wrench rows that make moments comparable with forces, (n,): 1, or 1/characteristic length. [-, 1/m]"""
    return np.array([1.0 if row < 3 else 1.0 / robot.characteristic_length for row in rows])  # noqa: PLR2004 - forces first


def wrench_sets(
    robot: CableRobot, rows: Sequence[int], wrenches: Sequence[Sequence[RequiredWrench]], motion: MotionSet
) -> WrenchSets:
    """Sets of required wrenches over the motion set, scaled by `wrench_scale`.

    Parameters
    ----------
    robot : CableRobot
        Its freedom says about which axes the platform turns.
    rows : sequence of int
        The n rows of the wrench that have to be balanced.
    wrenches : sequence of sequence of RequiredWrench
        For each of D orientations, of each of K loads.
    motion : MotionSet
        Accelerations, or a list of motions, each of which is a set of its own.

    Returns
    -------
    WrenchSets
        With G = K, or K times the listed motions (which vary fastest). Of a turning spatial robot, centrifugal and
        gyroscopic wrenches are enclosed by balls: a safe bound. All else is exact.
    """
    one = [[_parts(robot, wrench, motion) for wrench in each] for each in wrenches]
    scale = wrench_scale(robot, rows)
    pick = list(rows)
    centre = np.array([[part for each in parts for part in each[0]] for parts in one])[..., pick] * scale
    repeat = centre.shape[1] // len(wrenches[0])
    segments = np.array([[each[1] for each in parts for _ in range(repeat)] for parts in one])[..., pick] * scale
    balls = np.array([[each[2] for each in parts for _ in range(repeat)] for parts in one])[..., pick, :]
    used_segments = np.flatnonzero(np.abs(segments).sum(axis=(0, 1, 3)))
    used_balls = np.flatnonzero(np.abs(balls).sum(axis=(0, 1, 3, 4)))
    return WrenchSets(
        centre=np.ascontiguousarray(centre),
        segments=np.ascontiguousarray(segments[:, :, used_segments]),
        balls=np.ascontiguousarray(balls[:, :, used_balls] * scale[:, None]),
    )


def _parts(robot: CableRobot, wrench: RequiredWrench, motion: MotionSet) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Centres (L, 6), segments (S, 6) and balls (B, 6, 3) of one load at one orientation."""
    external = np.diag(wrench.external_reach)
    if motion.kind is MotionKind.LISTED:
        centres = [
            wrench.static
            + wrench.per_acceleration @ acceleration
            + wrench.per_angular_acceleration @ angular_acceleration
            + wrench.of_rotation(angular_velocity)
            for _, acceleration, angular_velocity, angular_acceleration in motion.listed
        ]
        return np.array(centres), external, np.zeros((0, 6, 3))
    centre = wrench.static + wrench.per_acceleration @ motion.acceleration_centre
    boxes, balls = [external], []
    linear = wrench.per_acceleration * motion.acceleration_reach
    angular = wrench.per_angular_acceleration * motion.angular_acceleration
    if robot.freedom is Freedom.PLANAR:
        normal = robot.plane_normal
        turning = wrench.of_rotation(np.eye(3)[normal] * motion.angular_speed)
        centre = centre + turning / 2.0
        boxes += [turning[None] / 2.0, angular.T[[normal]]]
    elif motion.angular_speed > 0.0 or motion.angular_acceleration > 0.0:
        balls += _rotation_balls(wrench, motion.angular_speed_bound)
        if motion.acceleration_shape is SetShape.BOX:
            boxes.append(angular.T)
        else:
            balls.append(angular)
    if motion.acceleration_shape is SetShape.BOX:
        boxes.append(linear.T)
    else:
        balls.append(linear)
    return centre[None], np.vstack(boxes), np.array(balls).reshape(-1, 6, 3)


def _rotation_balls(wrench: RequiredWrench, angular_speed: float) -> list[FloatArray]:
    """Balls, each (6, 3), around the centrifugal force and the gyroscopic moment of turning at up to `angular_speed`.

    ‖ω × (ω × m c)‖ ≤ Ω² m ‖c‖ and ‖ω × (I ω)‖ ≤ Ω² (λ_max - λ_min)/2, λ the principal moments of inertia.
    """
    moments = np.linalg.eigvalsh(wrench.inertia)
    force, moment = np.zeros((6, 3)), np.zeros((6, 3))
    force[:3] = angular_speed**2 * float(np.linalg.norm(wrench.first_moment)) * np.eye(3)
    moment[3:] = angular_speed**2 * float(moments[-1] - moments[0]) / 2.0 * np.eye(3)
    return [force, moment]
