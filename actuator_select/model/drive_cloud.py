"""Operating points of one drive over a demand, for the torque-speed plane."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from actuator_select.model.actuation import torque_ratio
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.cable_motion import swing_scale
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand
from actuator_select.model.motion import MotionKind, SetShape

SEED = 20180703  # the sample is the same at every run
SPEEDS = 9  # cable speeds from the greatest out to the greatest in
MOST_COVERED = 20_000  # points of the positions that are covered; beyond, a random part of them


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveCloud:
    """S operating points at the motor's shaft, winding in positive.

    Attributes
    ----------
    speed : (S,) array
        [rad/s]
    load_torque : (S,) array
        Of the cable's tension, as the torque limit of eq. 32 counts it; where tensions are bounded, of the minimax
        tension of the pose. NaN at poses that no drive could hold. [N m]
    total_torque : (S,) array
        With the rotor's acceleration, as the voltage limit of eq. 34 counts it. [N m]
    """

    speed: FloatArray
    load_torque: FloatArray
    total_torque: FloatArray

    @property
    def is_empty(self) -> bool:
        """Whether no point has both a speed and a load torque."""
        return not np.isfinite(self.speed + self.load_torque).any()


def drive_cloud(demand: Demand, actuator: ActuatorSet, points: int, positions: IntArray) -> DriveCloud:
    """Sample what all poses, cables and extreme motions ask of one drive.

    Parameters
    ----------
    demand : Demand
        At P positions, Q poses, on m cables.
    actuator : ActuatorSet
        A single one.
    points : int
        Random points, over all poses, cables, velocities and corners of the box of accelerations.
    positions : (n,) array
        Positions that are covered completely, beside the random points: the critical ones.

    Returns
    -------
    DriveCloud
        The same at every run; NaN where a figure is unknown.
    """
    poses, cables = demand.lengths.shape
    corners = np.array(
        list(product(*zip(demand.motion.acceleration_lower, demand.motion.acceleration_upper, strict=True)))
    )
    if demand.motion.acceleration_shape is SetShape.BALL:
        corners = corners / np.sqrt(3.0)  # on the ball, where the box's corners point
    generator = np.random.default_rng(SEED)
    choices = max(1, len(demand.motion.velocities)) if demand.motion.kind is MotionKind.SAMPLED else 2 * SPEEDS
    cases = poses // len(demand.positions)
    covered = (np.asarray(positions, dtype=np.int64)[:, None] * cases + np.arange(cases)).ravel()
    shape = (len(covered), cables, choices, len(corners))
    total = int(np.prod(shape))
    flat = np.arange(total) if total <= MOST_COVERED else generator.choice(total, size=MOST_COVERED, replace=False)
    every = np.column_stack(np.unravel_index(flat, shape)) if total else np.empty((0, 4), dtype=np.int64)
    every[:, 0] = covered[every[:, 0]]
    drawn = np.column_stack(
        [generator.integers(count, size=points) for count in (poses, cables, choices, len(corners))]
    )
    pose, cable, choice, corner = np.vstack([every, drawn]).T
    share = np.concatenate([np.linspace(-1.0, 1.0, SPEEDS)[every[:, 2] % SPEEDS], generator.uniform(-1.0, 1.0, points)])
    speed, centripetal = _motions(demand, pose, cable, choice, share)
    acceleration = (demand.free_directions[pose, cable] * corners[corner]).sum(axis=1) - centripetal
    if demand.tensions is None:
        tension = np.where(demand.attainable[pose], demand.force[pose, cable], np.nan)
    else:
        per_acceleration = demand.tensions.per_acceleration[pose, cable]
        tension = demand.tensions.static[pose, cable] + (per_acceleration * corners[corner]).sum(axis=1)
    ratio, radius = float(actuator.ratio[0]), float(actuator.drum_radius[0])
    load = tension * radius / float(torque_ratio(actuator)[0])
    return DriveCloud(
        speed=speed / radius * ratio,
        load_torque=load,
        total_torque=load + float(actuator.rotor_inertia[0]) * ratio * acceleration / radius,
    )


def _motions(
    demand: Demand, pose: IntArray, cable: IntArray, choice: IntArray, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Cable speed and centripetal term of the chosen velocity, each (S,).

    Of the ball, what matters to a cable is its own speed, a share of the greatest, and whether the rest of the
    greatest speed goes across it.
    """
    motion = demand.motion
    scale = swing_scale(demand.lengths, motion)[pose, cable]
    if motion.kind is MotionKind.SAMPLED:
        velocity = motion.velocities[choice] * np.isin(np.arange(3), demand.free_axes)
        speed = (demand.free_directions[pose, cable] * velocity).sum(axis=1)
        return speed, ((velocity**2).sum(axis=1) - speed**2) * scale
    speed = motion.speed * share
    across = np.where(choice < SPEEDS, motion.speed**2 - speed**2, 0.0)
    return speed, across * scale
