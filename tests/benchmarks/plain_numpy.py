"""Baseline: a plain chunked NumPy evaluation of the same closed forms, float64, extremes over motions precomputed."""

import numpy as np

from actuator_select.model.actuation import shaft_characteristics
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand

CELLS_AT_ONCE = 4_000_000  # (actuator, position, cable) cells in one chunk


def counts(demand: Demand, actuators: ActuatorSet, check: str) -> IntArray:
    """Positions that each actuator passes, every cell evaluated; the velocity ball, the acceleration box."""
    poses, cables = demand.lengths.shape
    limits = {
        "speed": (demand.speed, actuators.motor_speed / actuators.ratio * actuators.drum_radius),
        "torque": (
            demand.force,
            actuators.motor_torque * actuators.ratio * actuators.efficiency / actuators.drum_radius,
        ),
        "acceleration": (
            demand.acceleration,
            actuators.motor_torque / (actuators.rotor_inertia * actuators.ratio) * actuators.drum_radius,
        ),
    }
    result = np.zeros(len(actuators), dtype=np.int64)
    step = max(1, CELLS_AT_ONCE // (poses * cables))
    for start in range(0, len(actuators), step):
        chunk = slice(start, start + step)
        if check == "voltage":
            holds = (
                worst_voltage(demand, actuators.take(np.arange(len(actuators))[chunk]))
                <= actuators.voltage[chunk, None, None]
            )
        else:
            values, limit = limits[check]
            holds = values <= limit[chunk, None, None]
        result[chunk] = holds.all(axis=2).sum(axis=1)
    return result


def worst_voltage(demand: Demand, actuators: ActuatorSet) -> FloatArray:
    """Largest |u| of every actuator, pose and cable; the formulas as they stand in the design."""
    shaft = shaft_characteristics(actuators)
    gain, damping, load = (
        values[:, None, None] for values in (shaft.inertia_gain, shaft.damping_gain, shaft.load_gain)
    )
    radius = actuators.drum_radius[:, None, None]
    motion, tensions = demand.motion, demand.tensions
    if tensions is None:
        raise ValueError("the formulas are those of the pseudo-inverse")
    box = np.zeros((len(actuators), *demand.lengths.shape))
    for axis in range(3):
        box += (
            np.abs(gain / radius * demand.directions[..., axis] + load * radius * tensions.per_acceleration[..., axis])
            * motion.acceleration_upper[axis]
        )
    swing = gain / (radius * demand.lengths)
    rate = np.minimum(motion.speed, damping / (2.0 * radius * swing))
    static = load * radius * tensions.static
    upper = damping * motion.speed / radius + static + box
    lower = damping * rate / radius + swing * (motion.speed**2 - rate**2) - static + box
    return np.maximum(upper, lower)
