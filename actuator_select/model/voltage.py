"""The voltage limit, eq. 34, at its worst over the motion set: the one check that couples speed, force and inertia.

Divided by S R_w, eq. 21 reads: force + reflected_mass · s + damping · v. Over the ball of velocities and the box of
accelerations its largest and smallest value have a closed form; over sampled velocities they are a maximum over the
samples, because the accelerations enter on their own.
"""

from dataclasses import dataclass, replace

import numpy as np

from actuator_select.model.actuation import VoltageLine, utilisation
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.cable_motion import swing_scale
from actuator_select.model.demand import Demand
from actuator_select.model.motion import MotionKind, SetShape, extent

SWING_TOLERANCE = 1e-12  # of V² - (u·v)², relative to V²; less is rounding of a direction's length
CELLS_AT_ONCE = 1 << 17  # (actuator, position, cable, sample) cells in one chunk: its scratch stays in the cache


@dataclass(frozen=True, slots=True, kw_only=True)
class VoltageDemand:
    """What P positions ask of the voltage, on k = O·m cables each (every cable at every orientation).

    Attributes
    ----------
    force, acceleration : (P, k) array
        Tension [N] and cable acceleration [m/s²] at the centre of the box of accelerations.
    force_reach, acceleration_reach : (P, k, 3) array
        Their change with the platform's acceleration, from the centre of its set to the face, per axis. [N, m/s²]
    force_extra, acceleration_extra : (P, k) array
        What else they may change by, independently of that. [N, m/s²]
    shape : SetShape
        Of the set of accelerations: of a box the axes add up, of a ball the norm counts.
    straight : bool
        Whether velocity and acceleration have the same direction.
    speed_in, speed_out : (P, k) array
        Greatest cable speed winding in and out. [m/s]
    speed : float
        Radius of the ball of velocities. [m/s]
    inverse_length : (P, k) array
        1/l, or 0 where the swing term is left out or counted in `acceleration_extra`. [1/m]
    least_swing : (P, k) array
        Swing term at the cable's greatest speed: above 0 where a cable leads out of the plane of a planar robot, so
        that no velocity has its direction. [m/s²]
    directions : (P, k, 3) array or None
        Cable directions along the axes on which the platform moves, where velocities are sampled and the centripetal
        term counts, or have the direction of the acceleration; None where extremes suffice.
    velocities : (S, 3) array
        The samples. [m/s]
    """

    force: FloatArray
    acceleration: FloatArray
    force_reach: FloatArray
    acceleration_reach: FloatArray
    force_extra: FloatArray
    acceleration_extra: FloatArray
    shape: SetShape
    straight: bool
    speed_in: FloatArray
    speed_out: FloatArray
    speed: float
    inverse_length: FloatArray
    least_swing: FloatArray
    directions: FloatArray | None
    velocities: FloatArray

    def worst(self, line: VoltageLine) -> FloatArray:
        """Largest |u|/(S R_w) over motions, cables and orientations, (C, P). [N]"""
        positions, cables = self.force.shape
        samples = max(1, len(self.velocities)) if self.directions is not None else 1
        result = np.empty((len(line.damping), positions))
        step = max(1, CELLS_AT_ONCE // (max(1, len(line.damping)) * cables * samples))
        for start in range(0, positions, step):
            chunk = slice(start, start + step)
            result[:, chunk] = self._worst(line, chunk)
        return result

    def _worst(self, line: VoltageLine, chunk: slice) -> FloatArray:
        mass = line.reflected_mass[:, None, None]
        middle = self.force[chunk] + mass * self.acceleration[chunk]
        extra = self.force_extra[chunk] + mass * self.acceleration_extra[chunk]
        reach = np.zeros_like(middle)
        for axis in range(3):
            change = self.force_reach[chunk, :, axis] + mass * self.acceleration_reach[chunk, :, axis]
            reach += np.abs(change) if self.shape is SetShape.BOX else change**2
        if self.shape is SetShape.BALL:
            reach = np.sqrt(reach)
        up, down = self._velocity_terms(line, chunk)
        found = np.maximum(up + middle, down - middle) + reach
        if self.straight:  # neither of the two bounds is below the other everywhere
            found = np.minimum(found, self._along_lines(line, middle, chunk))
        return np.asarray((found + extra).max(axis=-1), dtype=np.float64)

    def _along_lines(self, line: VoltageLine, middle: FloatArray, chunk: slice) -> FloatArray:
        """Greatest magnitude where v = V e and a = ±A e for any direction e; the swing term at its worst, (C, p, k)."""
        if self.directions is None:  # pragma: no cover - built together with `straight`
            raise ValueError("straight-line moves need the cables' directions")
        mass, damping = line.reflected_mass[:, None, None], line.damping[:, None, None]
        plus, minus = np.zeros_like(middle), np.zeros_like(middle)
        for axis in range(3):
            fast = damping * self.speed * self.directions[chunk, :, axis]
            change = self.force_reach[chunk, :, axis] + mass * self.acceleration_reach[chunk, :, axis]
            plus += (fast + change) ** 2
            minus += (fast - change) ** 2
        reach = np.sqrt(np.maximum(plus, minus))
        swing = mass * self.speed**2 * self.inverse_length[chunk]
        turning = self.speed_in[chunk] - self.speed * np.linalg.norm(self.directions[chunk], axis=-1)
        worst: FloatArray = reach + damping * np.maximum(0.0, turning) + np.maximum(middle, swing - middle)
        return worst

    def _velocity_terms(self, line: VoltageLine, chunk: slice) -> tuple[FloatArray, FloatArray]:
        """Greatest of ±(damping · v - reflected_mass · centripetal), each (C, p, k)."""
        mass, damping = line.reflected_mass[:, None, None], line.damping[:, None, None]
        if self.directions is not None and len(self.velocities):
            speeds = self.directions[chunk] @ self.velocities.T
            across = (self.velocities**2).sum(axis=1) - speeds**2
            terms = damping[..., None] * speeds - mass[..., None] * (across * self.inverse_length[chunk, :, None])
            return terms.max(axis=-1), -terms.min(axis=-1)
        up = damping * self.speed_in[chunk] - mass * self.least_swing[chunk]
        down = damping * self.speed_out[chunk] + mass * self.least_swing[chunk]
        # Winding out at u·v = -s: damping s + mass (V² - s²)/l is largest at s = damping l/(2 mass) if the cable's
        # greatest speed is beyond that.
        inverse_length = self.inverse_length[chunk]
        inside = damping < 2.0 * mass * self.speed_out[chunk] * inverse_length
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
            force_extra=self.force_extra[positions],
            acceleration_extra=self.acceleration_extra[positions],
            speed_in=self.speed_in[positions],
            speed_out=self.speed_out[positions],
            inverse_length=self.inverse_length[positions],
            least_swing=self.least_swing[positions],
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
        At P positions with E cases each, on m cables.

    Returns
    -------
    VoltageDemand
        With k = E·m under the pseudo-inverse. Under a model with bounded tensions k = 2·E·m: every cable once at the
        pose's minimax tension, which bounds it from above, and once at its least tension.
    """
    undefined = np.where(demand.lengths > 0.0, 0.0, np.inf)
    parts = [_linear(demand)] if demand.tensions is not None else [_bounded(demand, demand.force)]
    if demand.tensions is None:
        parts.append(_bounded(demand, np.broadcast_to(demand.tension_min, demand.force.shape)))
    gathered = {name: np.concatenate([part[name] for part in parts], axis=1) for name in parts[0]}
    gathered["force"] = gathered["force"] + np.tile(demand.by_position(undefined), len(parts))
    for name in ("speed_in", "speed_out"):  # the force says it; infinities of both would cancel
        gathered[name] = np.where(np.isfinite(gathered[name]), gathered[name], 0.0)
    motion = demand.motion
    sampled = motion.kind is MotionKind.SAMPLED and motion.centripetal
    straight = motion.kind is MotionKind.STRAIGHT and demand.tensions is not None
    directions = np.concatenate([demand.by_position(demand.free_directions)] * len(parts), axis=1)
    fastest = motion.speed_bound**2
    across = fastest - gathered["speed_out"] ** 2
    across = np.where(across > SWING_TOLERANCE * fastest, across, 0.0)
    return VoltageDemand(
        shape=motion.acceleration_shape if demand.tensions is not None else SetShape.BOX,
        straight=straight,
        speed=motion.speed_bound,
        directions=directions if sampled or straight else None,
        velocities=motion.velocities * np.isin(np.arange(3), demand.free_axes) if sampled else motion.velocities[:0],
        least_swing=gathered["inverse_length"] * across,
        **gathered,
    )


def _linear(demand: Demand) -> dict[str, FloatArray]:
    """Under the pseudo-inverse: force and cable acceleration change together with the platform's acceleration."""
    motion, tensions = demand.motion, demand.tensions
    if tensions is None:  # pragma: no cover - the caller asked
        raise ValueError("tensions that are not linear")
    reach = np.zeros(3) if motion.kind is MotionKind.LISTED else motion.acceleration_reach
    alone = _reach_of_acceleration(demand)
    scale, middle, extra = _swing(demand)
    fields = {
        "force": tensions.middle,
        "acceleration": middle,
        "force_reach": tensions.per_acceleration * reach,
        "acceleration_reach": demand.free_directions * reach,
        "force_extra": tensions.other_reach,
        "acceleration_extra": np.maximum(0.0, extra - alone),
        "speed_in": demand.speed_in,
        "speed_out": demand.speed_out,
        "inverse_length": scale,
    }
    return {name: demand.by_position(values) for name, values in fields.items()}


def _bounded(demand: Demand, force: FloatArray) -> dict[str, FloatArray]:
    """At a constant tension: the whole range of the cable's acceleration is independent of it."""
    nothing = np.zeros((*demand.lengths.shape, 3))
    scale, middle, extra = _swing(demand)
    fields = {
        "force": force,
        "acceleration": middle,
        "force_reach": nothing,
        "acceleration_reach": nothing,
        "force_extra": nothing[..., 0],
        "acceleration_extra": extra,
        "speed_in": demand.speed_in,
        "speed_out": demand.speed_out,
        "inverse_length": scale,
    }
    return {name: demand.by_position(values) for name, values in fields.items()}


def _reach_of_acceleration(demand: Demand) -> FloatArray:
    motion = demand.motion
    if motion.kind is MotionKind.LISTED:
        return np.zeros_like(demand.lengths)
    return extent(demand.free_directions, motion.acceleration_reach, motion.acceleration_shape)


def _swing(demand: Demand) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Swing coefficient, middle and half range of the cable's acceleration, each (Q, m).

    Over a ball of velocities of a platform that does not turn the swing term is (V² - v²)/l, coupled with the cable's
    speed, and stays apart; else its range is taken as independent: a safe bound.
    """
    motion = demand.motion
    if motion.turns or motion.kind is MotionKind.LISTED or motion.velocity_shape is SetShape.BOX:
        middle = demand.acceleration_middle - (demand.swing_min + demand.swing_max) / 2.0
        extra = demand.acceleration_reach + (demand.swing_max - demand.swing_min) / 2.0
        return np.zeros_like(demand.lengths), middle, extra
    return swing_scale(demand.lengths, motion), demand.acceleration_middle, demand.acceleration_reach


@dataclass(frozen=True, slots=True, kw_only=True)
class VoltageTally:
    """Running counts of C actuators, updated in place as positions come in.

    Attributes
    ----------
    limit : (C,) array
        Cable force that the full voltage holds at standstill, with the rounding that is forgiven. [N]
    alone : (C,) array
        Positions at which the limit holds.
    worst : (C,) array
        Largest demand so far. [N]
    worst_position : (C,) array
        Where that is, as an index into the positions last added.
    """

    limit: FloatArray
    alone: IntArray
    worst: FloatArray
    worst_position: IntArray
