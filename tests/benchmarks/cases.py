"""Seeded problems for the benchmarks."""

from dataclasses import replace

import numpy as np

from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, LinearTensions, compute_demand
from actuator_select.model.dynamics import required_wrench
from actuator_select.model.families import cpr8, cpr8_region
from actuator_select.model.kinematics import position_grid
from actuator_select.model.motion import independent_motion
from tests.benchmarks.plain_numpy import worst_voltage

FRAME, CARRIER = np.array([3.2, 2.2, 2.2]), np.array([0.224, 0.154, 0.140])


def large_demand(points: tuple[int, int, int]) -> Demand:
    """The case study on a finer grid."""
    return compute_demand(
        cpr8(FRAME, CARRIER),
        position_grid(cpr8_region(FRAME, CARRIER), points),
        np.zeros((1, 3)),
        [[required_wrench(2.0, 9.81)]],
        independent_motion(1.3, 1.82, 1.82, centripetal=True),
    )


def synthetic_actuators(demand: Demand, count: int, seed: int = 2018) -> ActuatorSet:
    """Random actuators, each check of which passes at 20 to 80 % of the positions.

    Motor, gear and drum are drawn at random; the limits are then set to random quantiles of what the positions ask.
    """
    generator = np.random.default_rng(seed)

    def spread(low: float, high: float) -> FloatArray:
        return np.exp(generator.uniform(np.log(low), np.log(high), count))

    def quantiles(values: FloatArray) -> FloatArray:
        return np.quantile(values, generator.uniform(0.2, 0.8, count))

    constant, ratio, radius = spread(0.03, 0.12), spread(15.0, 35.0), spread(0.06, 0.1)
    efficiency, resistance = spread(0.5, 0.9), spread(0.3, 4.0)
    torque = quantiles(demand.force.max(axis=1)) * radius / (ratio * efficiency)
    inertia = torque * radius / (quantiles(demand.acceleration.max(axis=1)) * ratio)
    draft = ActuatorSet(
        motor_speed=quantiles(demand.speed.max(axis=1)) * ratio / radius,
        motor_torque=torque,
        voltage=np.ones(count),
        back_emf_constant=constant,
        torque_constant=constant,
        resistance=resistance,
        friction=np.zeros(count),
        rotor_inertia=inertia,
        ratio=ratio,
        efficiency=efficiency,
        drum_radius=radius,
    )
    return ActuatorSet(
        **{name: getattr(draft, name) for name in ActuatorSet.__slots__ if name != "voltage"},
        voltage=_voltages(demand, draft, generator),
    )


def _voltages(demand: Demand, draft: ActuatorSet, generator: np.random.Generator) -> FloatArray:
    """A voltage per actuator that a random 20 to 80 % of a sample of the positions stay within."""
    sample = generator.choice(len(demand.positions), size=min(500, len(demand.positions)), replace=False)
    small = _at(demand, sample)
    asked = worst_voltage(small, draft).max(axis=2)
    share = generator.uniform(0.2, 0.8, len(draft))
    return np.array([np.quantile(one, part) for one, part in zip(asked, share, strict=True)])


def _at(demand: Demand, poses: IntArray) -> Demand:
    """The demand of some poses, where every position is one pose."""
    if demand.tensions is None:
        raise ValueError("the benchmarks take the pseudo-inverse")
    tensions = {name: getattr(demand.tensions, name)[poses] for name in LinearTensions.__slots__}
    by_pose = {
        name: getattr(demand, name)[poses]
        for name in Demand.__slots__
        if isinstance(getattr(demand, name), np.ndarray) and name not in {"orientations", "tension_min"}
    }
    return replace(demand, tensions=LinearTensions(**tensions), **by_pose)
