"""Counting the positions that keep the voltage limit, by the compiled kernel where that pays, by NumPy elsewhere."""

from collections.abc import Callable

import numpy as np

from actuator_select.model.actuation import VoltageLine, utilisation
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.motion import SetShape
from actuator_select.model.voltage import VoltageDemand, VoltageTally

KERNEL_PAYS_FROM = 60_000_000  # (actuator, position, cable) cells; below, NumPy is done before a compiler is loaded

Kernel = Callable[[VoltageDemand, VoltageLine, BoolArray, VoltageTally], None]


class VoltageCounter:
    """Counts the positions within a limit that falls with speed and acceleration, alone and with the other checks.

    Parameters
    ----------
    rows : VoltageDemand
        At P positions.
    line : VoltageLine
        Of C actuators; those with an unknown figure are left out and keep -1 and NaN.
    rounding : float
        Relative excess over the limit that is forgiven.

    Attributes
    ----------
    order : (P,) array
        Order in which positions are best added: the demanding ones first, so that the largest demand is known early
        and most of the others are decided by a bound.
    """

    def __init__(self, rows: VoltageDemand, line: VoltageLine, rounding: float) -> None:
        self._rows = rows
        self._actuators = len(line.damping)
        self._known = np.flatnonzero(~np.isnan(line.force_limit + line.damping + line.reflected_mass))
        self._line = line.take(self._known)
        count = len(self._known)
        self._tally = VoltageTally(
            limit=self._line.force_limit * (1.0 + rounding),
            alone=np.zeros(count, dtype=np.int64),
            worst=np.full(count, -np.inf),
            worst_position=np.full(count, -1, dtype=np.int64),
        )
        self._worst_position = np.full(count, -1, dtype=np.int64)
        self._count_chunk = _kernel(rows, count)
        typical = self._line.take(np.array([_median_index(self._line.reflected_mass)])) if count else None
        self.order: IntArray = np.arange(len(rows.force)) if typical is None else np.argsort(-rows.worst(typical)[0])

    def add(self, positions: IntArray, passes: BoolArray) -> None:
        """Count the positions at these indices.

        Parameters
        ----------
        positions : (p,) array
            Each position once over all calls.
        passes : (C, p) array of bool
            Where the other checks hold; updated in place to where this limit holds too.
        """
        if len(self._known) == 0:
            return
        self._tally.worst_position.fill(-1)
        everyone = len(self._known) == self._actuators
        own = passes if everyone else passes[self._known]
        self._count_chunk(self._rows.take(positions), self._line, own, self._tally)
        if not everyone:
            passes[self._known] = own
        moved = self._tally.worst_position >= 0
        self._worst_position[moved] = positions[self._tally.worst_position[moved]]

    def _spread(self, counts: IntArray) -> IntArray:
        result = np.full(self._actuators, -1, dtype=np.int64)
        result[self._known] = counts
        return result

    @property
    def evaluated(self) -> BoolArray:
        """Actuators whose every figure is known, (C,)."""
        known = np.zeros(self._actuators, dtype=np.bool_)
        known[self._known] = True
        return known

    @property
    def alone(self) -> IntArray:
        """Positions within the voltage limit, (C,)."""
        return self._spread(self._tally.alone)

    @property
    def worst_utilisation(self) -> FloatArray:
        """Largest |u|/U, (C,)."""
        result = np.full(self._actuators, np.nan)
        worst = np.where(np.isneginf(self._tally.worst), np.inf, self._tally.worst)  # no position could be served
        result[self._known] = utilisation(worst, self._line.force_limit)
        return result

    @property
    def worst_position(self) -> IntArray:
        """Index of the position where that is, (C,)."""
        return self._spread(self._worst_position)


def _median_index(values: FloatArray) -> int:
    return int(np.argsort(values)[len(values) // 2])


def _kernel(rows: VoltageDemand, actuators: int) -> Kernel:
    """Choose the compiled counter where it pays and exists; it knows boxes of accelerations, no samples, no lines."""
    coupled = rows.shape is SetShape.BALL and bool(rows.force_reach.any())
    if rows.directions is not None or coupled or actuators * rows.force.size < KERNEL_PAYS_FROM:
        return count_with_numpy
    try:
        from actuator_select.model.voltage_kernel import count
    except (ImportError, RuntimeError):  # not installed, or no folder to keep its code in
        return count_with_numpy
    return count


def count_with_numpy(rows: VoltageDemand, line: VoltageLine, passes: BoolArray, tally: VoltageTally) -> None:
    """Evaluate every cell; the definition that the compiled counter has to agree with.

    Parameters
    ----------
    rows : VoltageDemand
        At p positions.
    line : VoltageLine
        Of C actuators, every figure known.
    passes : (C, p) array of bool
        Where the other checks hold; updated in place.
    tally : VoltageTally
        Updated in place.
    """
    demand = rows.worst(line)
    holds = (demand <= tally.limit[:, None]) & np.isfinite(demand)
    tally.alone[:] += holds.sum(axis=1)
    passes &= holds
    demand = np.where(np.isfinite(demand), demand, -np.inf)  # what no drive could serve is nobody's worst
    where = demand.argmax(axis=1)
    largest = demand[np.arange(len(demand)), where]
    moved = largest > tally.worst
    tally.worst[moved] = largest[moved]
    tally.worst_position[moved] = where[moved]
