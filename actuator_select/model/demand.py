"""The demand: what each pose asks of each cable, whatever drives it. Computed once for all actuators."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.dynamics import RequiredWrench
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionKind, MotionSet
from actuator_select.model.robot import CableRobot
from actuator_select.model.tension import pseudo_inverse_tensions, unbalanced

NEGATIVE_TENSION_TOLERANCE = 1e-9  # relative to the largest static tension of the pose
CELLS_AT_ONCE = 1 << 22  # (pose, cable, velocity sample) cells in one chunk: 32 MiB of scratch
LEAST_CELLS = 128  # of a pose and cable; its geometry and factorisation need about as much

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Demand of P positions at O orientations each, on m cables; Q = P·O poses, orientation varying fastest.

    Winding in is positive: cable speed u·v, cable acceleration u·a - (‖v‖² - (u·v)²)/l.

    Attributes
    ----------
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        Angles ψ, θ, φ. [rad]
    motion : MotionSet
        What every pose has to do.
    lengths : (Q, m) array
        [m]
    directions : (Q, m, 3) array
        Unit vectors u from platform to frame.
    static_tension : (Q, m) array
        At rest. [N]
    tension_per_acceleration : (Q, m, 3) array
        [kg]
    speed_in, speed_out : (Q, m) array
        Greatest cable speed winding in and winding out over the motion set. [m/s]
    speed : (Q, m) array
        The greater of the two. [m/s]
    force : (Q, m) array
        Worst magnitude of the tension over the motion set. [N]
    acceleration : (Q, m) array
        Worst magnitude of the cable's acceleration over the motion set. [m/s²]
    rank : (Q,) array
        Rank of the structure matrix.
    rank_deficient, negative_at_rest, negative_in_motion, unbalanced : (Q,) array of bool
        What the tension model glosses over: a structure matrix short of rank, a cable that has to push at rest or
        somewhere in the motion set, and a required wrench that the tensions do not balance.
    """

    positions: FloatArray
    orientations: FloatArray
    motion: MotionSet
    lengths: FloatArray
    directions: FloatArray
    static_tension: FloatArray
    tension_per_acceleration: FloatArray
    speed_in: FloatArray
    speed_out: FloatArray
    speed: FloatArray
    force: FloatArray
    acceleration: FloatArray
    rank: IntArray
    rank_deficient: BoolArray
    negative_at_rest: BoolArray
    negative_in_motion: BoolArray
    unbalanced: BoolArray

    def by_position(self, values: FloatArray) -> FloatArray:
        """Rearrange (Q, m, ...) to (P, O·m, ...): all that one position asks, over its orientations."""
        return values.reshape(len(self.positions), -1, *values.shape[2:])

    def positions_with(self, poses: BoolArray) -> int:
        """Count the positions where `poses`, (Q,), holds at one orientation or more."""
        return int(poses.reshape(len(self.positions), -1).any(axis=1).sum())


def compute_demand(
    robot: CableRobot,
    positions: FloatArray,
    orientations: FloatArray,
    wrench: RequiredWrench,
    motion: MotionSet,
    progress: Progress | None = None,
) -> Demand:
    """Work out the demand under the pseudo-inverse tension model.

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        Every position is taken at every orientation. [rad]
    wrench : RequiredWrench
        What the cables must supply together.
    motion : MotionSet
        Velocities and accelerations.
    progress : callable, optional
        Called with (poses done, poses).

    Returns
    -------
    Demand
        Over all P·O poses.

    References
    ----------
    Eqs. 1-29 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F, their worst cases in closed form.
    """
    each_position = np.repeat(positions, len(orientations), axis=0)
    each_orientation = np.tile(orientations, (len(positions), 1))
    poses = len(each_position)
    parts: list[dict[str, np.ndarray]] = []
    step = max(1, CELLS_AT_ONCE // (robot.cables * max(LEAST_CELLS, len(motion.velocities))))
    for start in range(0, poses, step):
        chunk = slice(start, start + step)
        parts.append(_chunk(robot, each_position[chunk], each_orientation[chunk], wrench, motion))
        if progress is not None:
            progress(min(start + step, poses), poses)
    arrays = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    static, least = arrays["static_tension"], arrays.pop("least_tension")
    tolerance = NEGATIVE_TENSION_TOLERANCE * np.abs(static).max(axis=1, keepdims=True)
    return Demand(
        positions=positions,
        orientations=orientations,
        motion=motion,
        negative_at_rest=(static < -tolerance).any(axis=1),
        negative_in_motion=(least < -tolerance).any(axis=1),
        rank_deficient=arrays["rank"] < robot.degrees_of_freedom,
        **arrays,
    )


def _chunk(
    robot: CableRobot, positions: FloatArray, orientations: FloatArray, wrench: RequiredWrench, motion: MotionSet
) -> dict[str, np.ndarray]:
    geometry = cable_geometry(robot, positions, orientations)
    tensions = pseudo_inverse_tensions(geometry.structure_matrix, wrench)
    centre, reach = motion.acceleration_centre, motion.acceleration_reach
    middle_force = tensions.static + tensions.per_acceleration @ centre
    force_reach = np.abs(tensions.per_acceleration) @ reach
    speed_in, speed_out, least_centripetal, most_centripetal = _velocity_extremes(
        geometry.directions, geometry.lengths, motion
    )
    middle_acceleration = geometry.directions @ centre
    acceleration_reach = np.abs(geometry.directions) @ reach
    # A cable of no length has no direction: nothing can be said of it, and no actuator passes there.
    undefined = np.where(geometry.lengths > 0.0, 0.0, np.inf)
    return {
        "lengths": geometry.lengths,
        "directions": geometry.directions,
        "static_tension": tensions.static,
        "tension_per_acceleration": tensions.per_acceleration,
        "speed_in": speed_in,
        "speed_out": speed_out,
        "speed": np.maximum(speed_in, speed_out) + undefined,
        "force": np.abs(middle_force) + force_reach + undefined,
        "least_tension": middle_force - force_reach,
        "acceleration": np.maximum(
            acceleration_reach + middle_acceleration - least_centripetal,
            acceleration_reach - middle_acceleration + most_centripetal,
        )
        + undefined,
        "rank": tensions.rank,
        "unbalanced": unbalanced(tensions, wrench, motion.acceleration_lower, motion.acceleration_upper),
    }


def _velocity_extremes(
    directions: FloatArray, lengths: FloatArray, motion: MotionSet
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Greatest u·v, greatest -u·v, least and greatest centripetal term over the velocities, each (Q, m)."""
    nothing = np.zeros_like(lengths)
    scale = centripetal_scale(lengths, motion)
    if motion.kind is MotionKind.INDEPENDENT:
        speed = motion.speed * np.linalg.norm(directions, axis=-1)
        return speed, speed, nothing, scale * motion.speed**2
    rates = cable_speeds(directions, motion)
    speed_in, speed_out = rates.max(axis=-1), -rates.min(axis=-1)
    if not motion.centripetal:
        return speed_in, speed_out, nothing, nothing
    across = (motion.velocities**2).sum(axis=1) - rates**2
    return speed_in, speed_out, scale * across.min(axis=-1), scale * across.max(axis=-1)


def cable_speeds(directions: FloatArray, motion: MotionSet) -> FloatArray:
    """Cable speed u·v of every sampled velocity, (Q, m, S). [m/s]."""
    rates: FloatArray = directions.reshape(-1, 3) @ motion.velocities.T
    return rates.reshape(*directions.shape[:-1], -1)


def centripetal_scale(lengths: FloatArray, motion: MotionSet) -> FloatArray:
    """1/l where the motion set counts the centripetal term, 0 where it leaves it out; shape of `lengths`. [1/m]"""
    if not motion.centripetal:
        return np.zeros_like(lengths)
    return np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0.0)
