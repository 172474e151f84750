"""A DC motor recomputed from R, kT, I0: does it give its own no-load speed, stall torque and rated point?

A plausibility rule allows 10 %. Here a printed figure stands for the interval that its rounding leaves open, and what
follows from R, kT, I0 and kE at the nominal voltage, which is exact, is the interval over all of theirs: the figures
agree where the intervals meet.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from math import floor, log10

from actuator_select.model.actuation import speed_at_voltage, stall_torque
from actuator_select.selection.electrical import Row, back_emf_constant
from actuator_select.selection.plausibility_rules import MOTOR_LINE
from actuator_select.units import rpm, v_s_per_rad

LEAST_DIGITS = 3  # significant digits that a printed figure has at least: 1.2 Ω is 1.20 Ω

CALCULATED = "manufacturer_calculation"
"""Provenance of sheets that print what the maker computed from R and kT; that they reproduce it says nothing."""

Interval = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class LineFigure:
    """One printed figure of a DC motor, against what its constants give.

    Attributes
    ----------
    id, quantity, unit : str
        The motor, the column, the column's unit.
    stated, expected : float
        The figure as printed and as computed from the printed constants, in `unit`.
    stated_range, expected_range : (float, float)
        The same with every printed figure but the voltage anywhere within its rounding.
    """

    id: str
    quantity: str
    unit: str
    stated: float
    expected: float
    stated_range: Interval
    expected_range: Interval

    @property
    def deviation(self) -> float:
        """stated/expected - 1."""
        return self.stated / self.expected - 1.0

    @property
    def agrees(self) -> bool:
        """Whether rounding alone can explain the difference."""
        return self.stated_range[0] <= self.expected_range[1] and self.expected_range[0] <= self.stated_range[1]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Equation:
    quantity: str
    unit: str
    needs: tuple[str, ...]
    value: Callable[..., float]


_VOLTAGE, _RESISTANCE = "nominal_voltage_v", "terminal_resistance_ohm"
_TORQUE_CONSTANT, _NO_LOAD_CURRENT = "torque_constant_nm_per_a", "no_load_current_a"
_TORQUE, _BACK_EMF = "rated_torque_nm", "back_emf"


def _no_load_speed(voltage: float, resistance: float, no_load_current: float, back_emf: float) -> float:
    return rpm(speed_at_voltage(voltage, back_emf, resistance, no_load_current))


def _rated_current(torque: float, torque_constant: float, no_load_current: float) -> float:
    return torque / torque_constant + no_load_current


def _rated_speed(
    voltage: float,
    resistance: float,
    torque: float,
    torque_constant: float,
    no_load_current: float,
    back_emf: float,
) -> float:
    current = _rated_current(torque, torque_constant, no_load_current)
    return rpm(speed_at_voltage(voltage, back_emf, resistance, current))


EQUATIONS = (
    _Equation(
        quantity="no_load_speed_rpm",
        unit="rpm",
        needs=(_VOLTAGE, _RESISTANCE, _NO_LOAD_CURRENT, _BACK_EMF),
        value=_no_load_speed,
    ),
    _Equation(
        quantity="stall_torque_nm",
        unit="N m",
        needs=(_TORQUE_CONSTANT, _VOLTAGE, _RESISTANCE),
        value=stall_torque,
    ),
    _Equation(
        quantity="rated_speed_rpm",
        unit="rpm",
        needs=(_VOLTAGE, _RESISTANCE, _TORQUE, _TORQUE_CONSTANT, _NO_LOAD_CURRENT, _BACK_EMF),
        value=_rated_speed,
    ),
    _Equation(
        quantity="rated_current_a",
        unit="A",
        needs=(_TORQUE, _TORQUE_CONSTANT, _NO_LOAD_CURRENT),
        value=_rated_current,
    ),
)
"""Every figure stands once in its equation, so that the extremes lie at corners of the intervals."""

COLUMNS = tuple(dict.fromkeys(name for one in EQUATIONS for name in (one.quantity, *one.needs) if name != _BACK_EMF))
"""Of the catalogue: what the equations compare and need, but for the back-EMF constant, which has two columns."""


def measured_dc_motors(rows: Sequence[Row]) -> list[Row]:
    """DC motors that state R, kT and I0, without calculated sheets.

    Parameters
    ----------
    rows : sequence of mapping
        Motors of the catalogue.

    Returns
    -------
    list of mapping
        Those that `recompute` can say something about.
    """
    constants = (_RESISTANCE, _TORQUE_CONSTANT, _NO_LOAD_CURRENT)
    return [
        row
        for row in rows
        if row.get("electrical_convention") in MOTOR_LINE
        and row.get("provenance") != CALCULATED
        and all(row.get(column) is not None for column in constants)
    ]


def recompute(row: Row) -> list[LineFigure]:
    """No-load speed, stall torque and rated point of a DC motor from its constants.

    Parameters
    ----------
    row : mapping
        A motor with DC figures.

    Returns
    -------
    list of LineFigure
        For every figure that is stated and can be computed.
    """
    # Other columns may hold what no rounding can be told of, such as an unlimited peak torque.
    known = {column: float(row[column]) for column in COLUMNS if row.get(column) is not None}
    printed = {
        # The nominal voltage is the condition that the sheet's figures are stated at, not one of its measurements.
        column: (value, value) if column == _VOLTAGE else rounding_interval(value)
        for column, value in known.items()
    }
    back_emf = back_emf_constant(row)
    if back_emf is not None:
        known[_BACK_EMF], printed[_BACK_EMF] = back_emf, _back_emf_interval(row)
    figures = []
    for equation in EQUATIONS:
        if any(name not in known for name in (equation.quantity, *equation.needs)):
            continue
        corners = [equation.value(*corner) for corner in product(*(printed[name] for name in equation.needs))]
        figures.append(
            LineFigure(
                id=str(row["id"]),
                quantity=equation.quantity,
                unit=equation.unit,
                stated=known[equation.quantity],
                expected=equation.value(*(known[name] for name in equation.needs)),
                stated_range=printed[equation.quantity],
                expected_range=(min(corners), max(corners)),
            )
        )
    return figures


def _back_emf_interval(row: Row) -> Interval:
    """Interval of the back-EMF constant, as stated or from the speed constant, one of which is known."""
    stated = row.get("back_emf_constant_v_s_per_rad")
    if stated is not None:
        return rounding_interval(float(stated))
    low, high = rounding_interval(float(row["speed_constant_rpm_per_v"]))
    return (v_s_per_rad(high), v_s_per_rad(low))


def rounding_interval(value: float) -> Interval:
    """Interval that a printed figure stands for: half a unit of its last significant digit to either side.

    Parameters
    ----------
    value : float
        The figure as printed, so that the shortest decimal that gives it is what was printed. Zeros at the end of a
        whole number are taken as rounding, at least `LEAST_DIGITS` digits as significant.

    Returns
    -------
    float, float
        Lower and upper end.
    """
    if value == 0.0:
        return (0.0, 0.0)
    exponent = floor(log10(abs(value)))
    digits = len(f"{value:.15g}".split("e", maxsplit=1)[0].replace(".", "").replace("-", "").strip("0"))
    half = 0.5 * 10.0 ** (exponent - max(digits, LEAST_DIGITS) + 1)
    return (value - half, value + half)
