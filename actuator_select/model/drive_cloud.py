"""Operating points of one drive over a demand, for the torque-speed plane."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from actuator_select.model.actuation import torque_ratio
from actuator_select.model.arrays import FloatArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, centripetal_scale

SEED = 20180703  # the sample is the same at every run


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveCloud:
    """A sample of S operating points at the motor's shaft, winding in positive.

    Attributes
    ----------
    speed : (S,) array
        [rad/s]
    load_torque : (S,) array
        Of the cable's tension, as the torque limit of eq. 32 counts it. [N m]
    total_torque : (S,) array
        With the rotor's acceleration, as the voltage limit of eq. 34 counts it. [N m]
    """

    speed: FloatArray
    load_torque: FloatArray
    total_torque: FloatArray


def drive_cloud(demand: Demand, actuator: ActuatorSet, points: int) -> DriveCloud:
    """Sample what all poses, cables and extreme motions ask of one drive.

    Parameters
    ----------
    demand : Demand
        At Q poses on m cables.
    actuator : ActuatorSet
        A single one.
    points : int
        Sample size, at most.

    Returns
    -------
    DriveCloud
        Drawn at random over poses, cables, velocities on the speed limit or at rest, and corners of the box of
        accelerations; NaN where a figure is unknown.
    """
    motion = demand.motion
    signs = np.array(list(product((-1.0, 0.0, 1.0), repeat=3)))
    norms = np.linalg.norm(signs, axis=1)
    ball = motion.speed * np.divide(signs, norms[:, None], out=np.zeros_like(signs), where=norms[:, None] > 0.0)
    velocities = motion.velocities if len(motion.velocities) else ball
    corners = np.array(list(product(*zip(motion.acceleration_lower, motion.acceleration_upper, strict=True))))
    poses, cables = demand.lengths.shape
    generator = np.random.default_rng(SEED)
    size = min(points, poses * cables * len(velocities) * len(corners))
    pose, cable = generator.integers(poses, size=size), generator.integers(cables, size=size)
    velocity = velocities[generator.integers(len(velocities), size=size)]
    acceleration = corners[generator.integers(len(corners), size=size)]
    direction = demand.directions[pose, cable]
    rate = (direction * velocity).sum(axis=1)
    swing = ((velocity**2).sum(axis=1) - rate**2) * centripetal_scale(demand.lengths, motion)[pose, cable]
    winding = (direction * acceleration).sum(axis=1) - swing
    tension = demand.static_tension[pose, cable] + (demand.tension_per_acceleration[pose, cable] * acceleration).sum(
        axis=1
    )
    ratio, radius = float(actuator.ratio[0]), float(actuator.drum_radius[0])
    load = tension * radius / float(torque_ratio(actuator)[0])
    return DriveCloud(
        speed=rate / radius * ratio,
        load_torque=load,
        total_torque=load + float(actuator.rotor_inertia[0]) * ratio * winding / radius,
    )
