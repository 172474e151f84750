"""The voltage limit, eq. 34, at its worst over the motion set: the one check that couples speed, force and inertia.

Divided by S R_w, eq. 21 reads: force + reflected_mass · s + damping · v. Over the ball of velocities and the box of
accelerations its largest and smallest value have a closed form; over sampled velocities they are a maximum over the
samples, because the accelerations enter on their own.
"""

from dataclasses import dataclass, replace

import numpy as np

from actuator_select.model.actuation import VoltageLine, utilisation
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.demand import Demand, centripetal_scale
from actuator_select.model.motion import MotionKind

CELLS_AT_ONCE = 1 << 17  # (actuator, position, cable, sample) cells in one chunk: its scratch stays in the cache


@dataclass(frozen=True, slots=True, kw_only=True)
class VoltageDemand:
    """What P positions ask of the voltage, on k = O·m cables each (every cable at every orientation).

    Attributes
    ----------
    force, acceleration : (P, k) array
        Tension [N] and cable acceleration [m/s²] at the centre of the box of accelerations.
    force_reach, acceleration_reach : (P, k, 3) array
        Their change from the centre to the box's face, per axis. [N, m/s²]
    speed_in, speed_out : (P, k) array
        Greatest cable speed winding in and out. [m/s]
    speed : float
        Radius of the ball of velocities. [m/s]
    inverse_length : (P, k) array
        1/l, or 0 where the centripetal term is left out. [1/m]
    directions : (P, k, 3) array or None
        Cable directions, where velocities are sampled and the centripetal term counts; None where extremes suffice.
    velocities : (S, 3) array
        The samples. [m/s]
    """

    force: FloatArray
    acceleration: FloatArray
    force_reach: FloatArray
    acceleration_reach: FloatArray
    speed_in: FloatArray
    speed_out: FloatArray
    speed: float
    inverse_length: FloatArray
    directions: FloatArray | None
    velocities: FloatArray

    def worst(self, line: VoltageLine) -> FloatArray:
        """Largest |u|/(S R_w) over motions, cables and orientations, (C, P). [N]"""
        positions, cables = self.force.shape
        samples = 1 if self.directions is None else len(self.velocities)
        result = np.empty((len(line.damping), positions))
        step = max(1, CELLS_AT_ONCE // (max(1, len(line.damping)) * cables * samples))
        for start in range(0, positions, step):
            chunk = slice(start, start + step)
            result[:, chunk] = self._worst(line, chunk)
        return result

    def _worst(self, line: VoltageLine, chunk: slice) -> FloatArray:
        mass = line.reflected_mass[:, None, None]
        middle = self.force[chunk] + mass * self.acceleration[chunk]
        reach = np.zeros_like(middle)
        for axis in range(3):
            reach += np.abs(self.force_reach[chunk, :, axis] + mass * self.acceleration_reach[chunk, :, axis])
        up, down = self._velocity_terms(line, chunk)
        worst: FloatArray = (np.maximum(up + middle, down - middle) + reach).max(axis=-1)
        return worst

    def _velocity_terms(self, line: VoltageLine, chunk: slice) -> tuple[FloatArray, FloatArray]:
        """Greatest of ±(damping · v - reflected_mass · centripetal), each (C, p, k)."""
        mass, damping = line.reflected_mass[:, None, None], line.damping[:, None, None]
        if self.directions is not None:
            speeds = self.directions[chunk] @ self.velocities.T
            across = (self.velocities**2).sum(axis=1) - speeds**2
            terms = damping[..., None] * speeds - mass[..., None] * (across * self.inverse_length[chunk, :, None])
            return terms.max(axis=-1), -terms.min(axis=-1)
        up = damping * self.speed_in[chunk]
        down = damping * self.speed_out[chunk]
        # Winding out at u·v = -s: damping s + mass (V² - s²)/l is largest at s = damping l/(2 mass) if that is below V.
        inverse_length = self.inverse_length[chunk]
        inside = damping < 2.0 * mass * self.speed * inverse_length
        if inside.any():
            with np.errstate(divide="ignore", invalid="ignore"):
                peak = mass * self.speed**2 * inverse_length + damping**2 / (4.0 * mass * inverse_length)
            down = np.where(inside, peak, down)
        return up, down

    def take(self, positions: IntArray) -> "VoltageDemand":
        """Demand of the positions at these indices, in this order."""
        return replace(
            self,
            force=self.force[positions],
            acceleration=self.acceleration[positions],
            force_reach=self.force_reach[positions],
            acceleration_reach=self.acceleration_reach[positions],
            speed_in=self.speed_in[positions],
            speed_out=self.speed_out[positions],
            inverse_length=self.inverse_length[positions],
            directions=None if self.directions is None else self.directions[positions],
        )

    def utilisation(self, line: VoltageLine) -> FloatArray:
        """Largest |u|/U at every position, (C, P); NaN where a figure is unknown."""
        return utilisation(self.worst(line), line.force_limit[:, None])


def voltage_demand(demand: Demand) -> VoltageDemand:
    """Gather what the voltage limit needs, position by position.

    Parameters
    ----------
    demand : Demand
        At P positions and O orientations, on m cables.

    Returns
    -------
    VoltageDemand
        With k = O·m.
    """
    motion = demand.motion
    centre, reach = motion.acceleration_centre, motion.acceleration_reach
    undefined = np.where(demand.lengths > 0.0, 0.0, np.inf)
    force = demand.static_tension + demand.tension_per_acceleration @ centre + undefined
    scale = centripetal_scale(demand.lengths, motion)
    sampled = motion.kind is MotionKind.SAMPLED and motion.centripetal
    return VoltageDemand(
        force=demand.by_position(force),
        acceleration=demand.by_position(demand.directions @ centre),
        force_reach=demand.by_position(demand.tension_per_acceleration * reach),
        acceleration_reach=demand.by_position(demand.directions * reach),
        speed_in=demand.by_position(demand.speed_in),
        speed_out=demand.by_position(demand.speed_out),
        speed=motion.speed,
        inverse_length=demand.by_position(scale),
        directions=demand.by_position(demand.directions) if sampled else None,
        velocities=motion.velocities,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class VoltageTally:
    """Running counts of C actuators, updated in place as positions come in.

    Attributes
    ----------
    limit : (C,) array
        Cable force that the full voltage holds at standstill, with the rounding that is forgiven. [N]
    alone, joint : (C,) array
        Positions at which the voltage limit holds; the same where the other checks hold too.
    worst : (C,) array
        Largest demand so far. [N]
    worst_position : (C,) array
        Where that is, as an index into the positions last added.
    """

    limit: FloatArray
    alone: IntArray
    joint: IntArray
    worst: FloatArray
    worst_position: IntArray
