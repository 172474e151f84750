"""Limits of gearboxes and winches that no check holds yet, held against the demand: what would be exceeded is named.

They do not enter a verdict. The torque at the gearbox's output is that of the cable alone, without the drum's inertia.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from actuator_select.model.actuation import ROUNDING
from actuator_select.model.arrays import FloatArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand
from actuator_select.units import rpm

Row = Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Exceeded:
    """One stated limit of a part that the demand exceeds.

    Attributes
    ----------
    column : str
        Of the catalogue, such as ``gearbox.max_intermittent_torque_nm``.
    limit, demand : float
        What the part states and what is asked of it at the worst position that some drive could serve, in `unit`.
    unit : str
        Of both.
    positions : int
        Positions at which it is exceeded.
    """

    column: str
    limit: float
    demand: float
    unit: str
    positions: int

    @property
    def text(self) -> str:
        """For people, such as ``gearbox.max_intermittent_torque_nm 35 N m, where up to 169 N m are asked for``."""
        return f"{self.column} {self.limit:.4g} {self.unit}, where up to {self.demand:.4g} {self.unit} are asked for"


@dataclass(frozen=True, slots=True, kw_only=True)
class _PartLimit:
    """How a stated limit is compared: per unit of the cable's force or speed, by the actuator."""

    columns: tuple[str, ...]  # the first that is stated counts
    unit: str
    of_force: bool
    per_unit: Callable[[ActuatorSet], FloatArray]


def _ones(actuators: ActuatorSet) -> FloatArray:
    return np.ones(len(actuators))


PART_LIMITS = (
    _PartLimit(
        columns=(
            "gearbox.max_intermittent_torque_nm",
            "gearbox.max_continuous_torque_nm",
            "gearbox.emergency_stop_torque_nm",
        ),
        unit="N m",
        of_force=True,
        per_unit=lambda actuators: actuators.drum_radius,
    ),
    _PartLimit(
        columns=(
            "gearbox.max_intermittent_input_speed_rpm",
            "gearbox.max_continuous_input_speed_rpm",
        ),
        unit="rpm",
        of_force=False,
        per_unit=lambda actuators: rpm(1.0) * actuators.ratio / actuators.drum_radius,
    ),
    _PartLimit(columns=("winch.max_tension_n",), unit="N", of_force=True, per_unit=_ones),
    _PartLimit(columns=("winch.max_cable_speed_m_per_s",), unit="m/s", of_force=False, per_unit=_ones),
)


def exceeded_part_limits(
    rows: Sequence[Row], actuators: ActuatorSet, demand: Demand
) -> tuple[tuple[Exceeded, ...], ...]:
    """Stated limits of gearboxes and winches that the demand exceeds.

    Parameters
    ----------
    rows : sequence of mapping
        C catalogue rows with their joined columns.
    actuators : ActuatorSet
        The same, in SI units.
    demand : Demand
        At P positions.

    Returns
    -------
    tuple of tuple of Exceeded
        One per actuator, empty where nothing is exceeded or stated.
    """
    worst = {of_force: _sorted_worst(demand, of_force=of_force) for of_force in (True, False)}
    found: list[list[Exceeded]] = [[] for _ in rows]
    for limit in PART_LIMITS:
        per_unit, ordered = limit.per_unit(actuators), worst[limit.of_force]
        if not len(ordered):
            continue
        for index, row in enumerate(rows):
            column = next((one for one in limit.columns if row.get(one) is not None), None)
            if column is None or not np.isfinite(per_unit[index]):
                continue
            stated = float(row[column])
            share = float(per_unit[index])
            if column.endswith("torque_nm") and row.get("winch.gear_ratio") is not None:
                share /= float(row["winch.gear_ratio"])  # the winch's own gear comes behind the gearbox
            allowed = stated / share * (1.0 + ROUNDING)
            beyond = len(ordered) - int(np.searchsorted(ordered, allowed, side="right"))
            if beyond:
                found[index].append(
                    Exceeded(
                        column=column,
                        limit=stated,
                        demand=float(ordered[-1]) * share,
                        unit=limit.unit,
                        positions=beyond,
                    )
                )
    return tuple(tuple(one) for one in found)


def _sorted_worst(demand: Demand, *, of_force: bool) -> FloatArray:
    """Greatest cable force [N] or speed [m/s] of every position that some drive could serve, ascending."""
    values = demand.by_position(demand.force if of_force else demand.speed).max(axis=1)
    served: FloatArray = np.sort(values[np.isfinite(values) & demand.attainable_positions])
    return served
