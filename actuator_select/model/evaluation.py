"""Hold every actuator against the demand: how many positions pass each limit, and all of them together.

The limits are those of eqs. 30, 32, 33 and 34 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F, taken at the drum
(`actuation`), each at its worst case over the motion set.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from actuator_select.model.actuation import (
    FIGURES_NEEDED,
    ROUNDING,
    Check,
    VoltageLine,
    cable_acceleration_limit,
    cable_force_limit,
    cable_speed_limit,
    is_applicable,
    torque_line,
    utilisation,
    voltage_line,
)
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, Progress
from actuator_select.model.tension import TensionModel
from actuator_select.model.voltage import voltage_demand
from actuator_select.model.voltage_count import VoltageCounter

STATED_AS = {"direct_current": "electrical_convention"}
CELLS_AT_ONCE = 1 << 25  # (actuator, position) pairs in one chunk: 32 MiB of verdicts


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckCount:
    """One check over C actuators.

    Attributes
    ----------
    applicable : (C,) array of bool
        False where the check says nothing about this actuator, whatever its figures.
    evaluated : (C,) array of bool
        False where the check does not apply, or a figure that it needs is unknown.
    positions : (C,) array
        Positions at which this limit alone holds at every orientation; -1 where not evaluated.
    worst_utilisation : (C,) array
        Largest demand over limit at the positions that some drive could serve; infinite if there are none, NaN where
        not evaluated.
    worst_position : (C,) array
        Index of the position where that is; -1 where there is none.
    """

    applicable: BoolArray
    evaluated: BoolArray
    positions: IntArray
    worst_utilisation: FloatArray
    worst_position: IntArray

    @property
    def is_open(self) -> BoolArray:
        """Actuators that the check applies to and whose figures do not allow it, (C,)."""
        return self.applicable & ~self.evaluated


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluation:
    """C actuators held against one demand.

    Attributes
    ----------
    demand : Demand
        At P positions.
    actuators : ActuatorSet
        The C actuators.
    checks : mapping of Check to CheckCount
        The checks that were asked for.
    positions : (C,) array
        Positions at which every evaluated check holds in every case; an open check and one that does not apply exclude
        none. Under a model with bounded tensions this is the
        safe rule: one constant limit for all cables, the least that speed and acceleration leave, so that
        the true count is no smaller.
    """

    demand: Demand
    actuators: ActuatorSet
    checks: Mapping[Check, CheckCount]
    positions: IntArray

    @property
    def open_checks(self) -> IntArray:
        """Number of checks that apply and could not be evaluated, (C,)."""
        return self._number(lambda count: count.is_open)

    @property
    def decided(self) -> BoolArray:
        """Actuators with an evaluated check and no open one, (C,): their positions are not only an upper bound."""
        decided: BoolArray = (self.open_checks == 0) & (self._number(lambda count: count.evaluated) > 0)
        return decided

    def _number(self, which: Callable[[CheckCount], BoolArray]) -> IntArray:
        number = np.zeros(len(self.actuators), dtype=np.int64)
        for count in self.checks.values():
            number += which(count)
        return number


def needed_figures(check: Check, model: TensionModel) -> tuple[str, ...]:
    """Figures of an actuator that `check` needs under a tension model."""
    if check is Check.ACCELERATION and not model.lets_cables_push:  # of load and rotor together
        return tuple(dict.fromkeys(FIGURES_NEEDED[Check.TORQUE] + FIGURES_NEEDED[check]))
    return FIGURES_NEEDED[check]


def missing_figures(actuators: ActuatorSet, check: Check, model: TensionModel) -> list[tuple[str, ...]]:
    """Figures that `check` needs under a tension model and an actuator lacks, one tuple per actuator.

    Empty where the check does not apply. Unknown `direct_current` is called by what has to be stated,
    ``electrical_convention``.
    """
    applies = is_applicable(actuators, check)
    unknown = {
        STATED_AS.get(name, name): np.isnan(getattr(actuators, name)) & applies for name in needed_figures(check, model)
    }
    return [tuple(name for name, missing in unknown.items() if missing[index]) for index in range(len(actuators))]


def evaluate_actuators(
    demand: Demand, actuators: ActuatorSet, checks: Sequence[Check], progress: Progress | None = None
) -> Evaluation:
    """Count the positions that each actuator can serve.

    Parameters
    ----------
    demand : Demand
        What the poses ask.
    actuators : ActuatorSet
        C actuators.
    checks : sequence of Check
        Limits to hold them to.
    progress : callable, optional
        Called with (positions done, positions).

    Returns
    -------
    Evaluation
        Counts over positions; memory does not grow with C times P.
    """
    lines = {check: line(actuators) for check, line in coupled_limits(demand).items() if check in checks}
    scalar = [_scalar_check(demand, actuators, check) for check in checks if check not in lines]
    counts = {one.check: one.count(is_applicable(actuators, one.check)) for one in scalar}
    rows = voltage_demand(demand) if lines else None
    counters = {check: VoltageCounter(rows, line, ROUNDING) for check, line in lines.items() if rows is not None}
    positions, attainable = len(demand.positions), demand.attainable_positions
    order = next((counter.order for counter in counters.values()), np.arange(positions))
    joint = np.zeros(len(actuators), dtype=np.int64)
    step = max(1, CELLS_AT_ONCE // max(1, len(actuators)))
    for start in range(0, positions, step):
        chunk = order[start : start + step]
        passes = np.broadcast_to(attainable[chunk], (len(actuators), len(chunk))).copy()
        for one in scalar:
            passes &= one.passes(chunk)
        for counter in counters.values():
            counter.add(chunk, passes)
        joint += passes.sum(axis=1)
        if progress is not None:
            progress(start + len(chunk), positions)
    for check, counter in counters.items():
        counts[check] = CheckCount(
            applicable=is_applicable(actuators, check),
            evaluated=counter.evaluated,
            positions=counter.alone,
            worst_utilisation=counter.worst_utilisation,
            worst_position=counter.worst_position,
        )
    return Evaluation(
        demand=demand, actuators=actuators, checks={check: counts[check] for check in checks}, positions=joint
    )


def position_utilisation(demand: Demand, actuators: ActuatorSet, checks: Sequence[Check]) -> dict[Check, FloatArray]:
    """Demand over limit at every position, for the few actuators that are shown.

    Parameters
    ----------
    demand : Demand
        At P positions.
    actuators : ActuatorSet
        C actuators.
    checks : sequence of Check
        Limits.

    Returns
    -------
    dict of Check to (C, P) array
        Greatest utilisation over cables and orientations; NaN where a figure is unknown or the check does not apply.
    """
    result: dict[Check, FloatArray] = {}
    lines = {check: line for check, line in coupled_limits(demand).items() if check in checks}
    rows = voltage_demand(demand) if lines else None
    for check in checks:
        if rows is not None and check in lines:
            result[check] = rows.utilisation(lines[check](actuators))
        else:
            scalar = _scalar_check(demand, actuators, check)
            result[check] = utilisation(scalar.demand, scalar.limit[:, None])
    return result


def coupled_limits(demand: Demand) -> dict[Check, Callable[[ActuatorSet], VoltageLine]]:
    """Checks whose limit falls with cable speed and acceleration, with what makes them a line at the drum.

    Under the pseudo-inverse eqs. 32 and 33 are tested apart, as published. Under a model with bounded tensions the
    acceleration check is of their sum: the torque for the load and for the rotor together.
    """
    if demand.tensions is not None:
        return {Check.VOLTAGE: voltage_line}
    return {Check.ACCELERATION: torque_line, Check.VOLTAGE: voltage_line}


@dataclass(frozen=True, slots=True, kw_only=True)
class _ScalarCheck:
    """A limit that compares one number per position with one number per actuator."""

    check: Check
    demand: FloatArray  # (P,), the worst over cables and orientations
    limit: FloatArray  # (C,), NaN unknown

    def passes(self, positions: IntArray) -> BoolArray:
        """Where the limit holds, (C, p); an unknown limit excludes nothing."""
        limit = np.where(np.isnan(self.limit), np.inf, self.limit * (1.0 + ROUNDING))
        demand = self.demand[positions]
        holds: BoolArray = demand <= limit[:, None]
        return holds & np.isfinite(demand)

    def count(self, applicable: BoolArray) -> CheckCount:
        evaluated = ~np.isnan(self.limit)
        finite = np.sort(self.demand[np.isfinite(self.demand)])
        positions = np.searchsorted(finite, self.limit * (1.0 + ROUNDING), side="right")
        reachable = np.where(np.isfinite(self.demand), self.demand, -np.inf)
        worst = int(reachable.argmax())
        found = bool(np.isfinite(reachable[worst]))
        return CheckCount(
            applicable=applicable,
            evaluated=evaluated,
            positions=np.where(evaluated, positions, -1),
            worst_utilisation=utilisation(self.demand[worst], self.limit),
            worst_position=np.where(evaluated & found, worst, -1),
        )


def _scalar_check(demand: Demand, actuators: ActuatorSet, check: Check) -> _ScalarCheck:
    values, limit = {
        Check.SPEED: (demand.speed, cable_speed_limit),
        Check.TORQUE: (demand.force, cable_force_limit),
        Check.ACCELERATION: (demand.acceleration, cable_acceleration_limit),
    }[check]
    return _ScalarCheck(check=check, demand=demand.by_position(values).max(axis=1), limit=limit(actuators))
