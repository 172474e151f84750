"""The rules of the plausibility check, each one comparison of a stated figure with what other figures give.

The rules of direct current hold for terminal voltage and line current, those of alternating current for line-to-line
rms voltage and rms phase current. Each is skipped for rows that state the other convention.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from statistics import median
from types import MappingProxyType

from actuator_select.model.actuation import speed_at_voltage, stall_torque
from actuator_select.selection.electrical import (
    ALTERNATING_CURRENT,
    DIRECT_CURRENT,
    MOTOR_TERMINALS,
    UNSTATED,
    Row,
    back_emf_constant,
)
from actuator_select.units import rad_per_s, rpm, rpm_per_v

TOLERANCE = 0.10  # relative; datasheet rounding and tolerances stay within it
RATIO_TOLERANCE = 0.05  # relative; makers round the ratio by which they call a gearbox by less
WELL_BELOW = 0.5  # rated over stall torque; thermal ratings of motors with windings stay below half
SMALLEST_GROUP = 3  # rows; a median of fewer says nothing about one of them

DC_CONSTANTS = DIRECT_CURRENT | UNSTATED
"""Conventions of the DC rules."""

MOTOR_LINE = MOTOR_TERMINALS | UNSTATED
"""Conventions under which the rated point stands on the motor's own line; built-in electronics limit it earlier."""


def _apart(deviation: float) -> bool:
    return abs(deviation) > TOLERANCE


def _below(deviation: float) -> bool:
    return deviation < 0.0


def _well_below(deviation: float) -> bool:
    return deviation < -TOLERANCE


def _well_above(deviation: float) -> bool:
    return deviation > TOLERANCE


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """Compare column `quantity` with `expected(row)`, where every needed column is known.

    Attributes
    ----------
    name, quantity, unit : str
        Of the rule, of the column, of the column's figure.
    needs : tuple of str
        Columns that have to be known.
    expected : callable
        From a row to the figure; None where it cannot be told.
    because : str
        How the expectation comes about, for the sentence.
    doubtful : callable
        From stated/expected - 1 to whether that is a finding.
    conventions : frozenset or None
        Values of ``electrical_convention`` that the rule holds for; None for all.
    group : str
        Column by whose value rows are compared with each other; empty for rules about one row.
    typical : callable
        From the rows of a group to the factor, typical of them, by which `expected` is multiplied.
    """

    name: str
    quantity: str
    unit: str
    needs: tuple[str, ...]
    expected: Callable[[Row], float | None]
    because: str
    doubtful: Callable[[float], bool] = _apart
    conventions: frozenset[str | None] | None = None
    group: str = ""
    typical: Callable[[Sequence[Row]], float] = lambda _: 1.0


def _known(row: Row, column: str) -> float:
    """Figure, or zero where it is unknown; for terms that only sharpen an expectation."""
    value = row.get(column)
    return 0.0 if value is None else float(value)


def _rated_current(row: Row) -> float:
    return float(row["rated_torque_nm"] / row["torque_constant_nm_per_a"]) + _known(row, "no_load_current_a")


def _no_load_speed(row: Row) -> float | None:
    back_emf = back_emf_constant(row)
    if back_emf is None:
        return None
    loss = _known(row, "terminal_resistance_ohm"), _known(row, "no_load_current_a")
    return rpm(speed_at_voltage(float(row["nominal_voltage_v"]), back_emf, *loss))


def _loaded_speed(row: Row) -> float | None:
    back_emf, stated = back_emf_constant(row), row.get("rated_current_a")
    current = _rated_current(row) if stated is None else float(stated)
    if back_emf is None:
        return None
    speed = speed_at_voltage(float(row["nominal_voltage_v"]), back_emf, float(row["terminal_resistance_ohm"]), current)
    return rpm(max(0.0, speed))


def _stall_torque(row: Row) -> float:
    columns = ("torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm")
    return stall_torque(*(float(row[column]) for column in columns))


def _unsaturated_peak_torque(row: Row) -> float | None:
    """Peak current × continuous torque per continuous current, at standstill or else at the rated point. [N m]"""
    for point in ("standstill", "rated"):
        torque, current = row.get(f"{point}_torque_nm"), row.get(f"{point}_current_a")
        if torque is not None and current is not None:
            return float(row["peak_current_a"] * torque / current)
    return None


MOTOR_RULES = (
    Rule(
        name="rated_power",
        quantity="rated_power_w",
        unit="W",
        needs=("rated_torque_nm", "rated_speed_rpm"),
        expected=lambda row: float(row["rated_torque_nm"] * rad_per_s(row["rated_speed_rpm"])),
        because="rated torque × rated speed",
    ),
    Rule(
        name="rated_current",
        quantity="rated_current_a",
        unit="A",
        needs=("rated_torque_nm", "torque_constant_nm_per_a"),
        expected=_rated_current,
        because="rated torque / torque constant, with the no-load current where known",
    ),
    Rule(
        name="peak_torque_above_rated_torque",
        quantity="peak_torque_nm",
        unit="N m",
        needs=("rated_torque_nm",),
        expected=lambda row: float(row["rated_torque_nm"]),
        because="at least the rated torque",
        doubtful=_below,
    ),
    Rule(
        name="standstill_torque_above_rated_torque",
        quantity="standstill_torque_nm",
        unit="N m",
        needs=("rated_torque_nm",),
        expected=lambda row: float(row["rated_torque_nm"]),
        because="at least the rated torque, since losses grow with speed",
        doubtful=_well_below,
    ),
)

DIRECT_CURRENT_RULES = (
    Rule(
        name="back_emf_constant",
        quantity="back_emf_constant_v_s_per_rad",
        unit="V s/rad",
        needs=("torque_constant_nm_per_a",),
        expected=lambda row: float(row["torque_constant_nm_per_a"]),
        because="the torque constant, which is the same in SI units",
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="speed_constant",
        quantity="speed_constant_rpm_per_v",
        unit="rpm/V",
        needs=("torque_constant_nm_per_a",),
        expected=lambda row: rpm_per_v(float(row["torque_constant_nm_per_a"])),
        because="1 / torque constant",
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="no_load_speed",
        quantity="no_load_speed_rpm",
        unit="rpm",
        needs=("nominal_voltage_v",),
        expected=_no_load_speed,
        because="(voltage - resistance × no-load current) / back-EMF constant",
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="stall_torque",
        quantity="stall_torque_nm",
        unit="N m",
        needs=("torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm"),
        expected=_stall_torque,
        because="torque constant × voltage / resistance",
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="stall_current",
        quantity="stall_current_a",
        unit="A",
        needs=("nominal_voltage_v", "terminal_resistance_ohm"),
        expected=lambda row: float(row["nominal_voltage_v"] / row["terminal_resistance_ohm"]),
        because="voltage / resistance",
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="rated_torque_below_stall_torque",
        quantity="rated_torque_nm",
        unit="N m",
        needs=("torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm"),
        expected=_stall_torque,
        because="torque constant × voltage / resistance, the stall torque, of which a continuous torque is a fraction; "
        "the stall torque may stand in the wrong column",
        doubtful=lambda deviation: deviation > WELL_BELOW - 1.0,
        conventions=DC_CONSTANTS,
    ),
    Rule(
        name="rated_speed",
        quantity="rated_speed_rpm",
        unit="rpm",
        needs=("rated_torque_nm", "torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm"),
        expected=_loaded_speed,
        because="the speed that the nominal voltage leaves at rated torque",
        conventions=MOTOR_LINE,
    ),
)

ALTERNATING_CURRENT_RULES = (
    Rule(
        name="line_to_line_back_emf_constant",
        quantity="back_emf_constant_v_s_per_rad",
        unit="V s/rad",
        needs=("torque_constant_nm_per_a",),
        expected=lambda row: float(row["torque_constant_nm_per_a"]) / sqrt(3.0),
        because="torque constant / √3, for line-to-line rms voltage and rms phase current",
        conventions=ALTERNATING_CURRENT,
    ),
    Rule(
        name="standstill_current",
        quantity="standstill_current_a",
        unit="A",
        needs=("standstill_torque_nm", "torque_constant_nm_per_a"),
        expected=lambda row: float(row["standstill_torque_nm"] / row["torque_constant_nm_per_a"]),
        because="standstill torque / torque constant",
        conventions=ALTERNATING_CURRENT,
    ),
    Rule(
        name="peak_torque_per_current",
        quantity="peak_torque_nm",
        unit="N m",
        needs=("peak_current_a",),
        expected=_unsaturated_peak_torque,
        because="peak current × continuous torque per current, which saturation lowers and nothing raises",
        doubtful=_well_above,
        conventions=ALTERNATING_CURRENT,
    ),
)

GEARBOX_RULES = (
    Rule(
        name="exact_ratio",
        quantity="ratio",
        unit="1",
        needs=("ratio_nominal",),
        expected=lambda row: float(row["ratio_nominal"]),
        because="the nominal ratio",
        doubtful=lambda deviation: abs(deviation) > RATIO_TOLERANCE,
    ),
    Rule(
        name="intermittent_torque_above_continuous_torque",
        quantity="max_intermittent_torque_nm",
        unit="N m",
        needs=("max_continuous_torque_nm",),
        expected=lambda row: float(row["max_continuous_torque_nm"]),
        because="at least the continuous torque",
        doubtful=_below,
    ),
    Rule(
        name="emergency_torque_above_intermittent_torque",
        quantity="emergency_stop_torque_nm",
        unit="N m",
        needs=("max_intermittent_torque_nm",),
        expected=lambda row: float(row["max_intermittent_torque_nm"]),
        because="at least the intermittent torque",
        doubtful=_below,
    ),
    Rule(
        name="emergency_torque_above_continuous_torque",
        quantity="emergency_stop_torque_nm",
        unit="N m",
        needs=("max_continuous_torque_nm",),
        expected=lambda row: float(row["max_continuous_torque_nm"]),
        because="at least the continuous torque",
        doubtful=_below,
    ),
    Rule(
        name="efficiency_within_maximum",
        quantity="efficiency_percent",
        unit="%",
        needs=("max_efficiency_percent",),
        expected=lambda row: float(row["max_efficiency_percent"]),
        because="at most the maximum efficiency",
        doubtful=lambda deviation: deviation > 0.0,
    ),
)

WINCH_RULES = (
    Rule(
        name="drum_diameter",
        quantity="drum_diameter_mm",
        unit="mm",
        needs=("drum_radius_mm",),
        expected=lambda row: 2.0 * row["drum_radius_mm"],
        because="twice the drum radius",
    ),
)

ROPE_RULES = (
    Rule(
        name="breaking_force_of_construction",
        quantity="breaking_force_n",
        unit="N",
        needs=("diameter_mm",),
        expected=lambda row: float(row["diameter_mm"]) ** 2,
        because="diameter² × the median of breaking force / diameter² over the ropes of this construction",
        group="construction",
        typical=lambda rows: median(row["breaking_force_n"] / row["diameter_mm"] ** 2 for row in rows),
    ),
)

RULES: Mapping[str, tuple[Rule, ...]] = MappingProxyType(
    {
        "motors": (*MOTOR_RULES, *DIRECT_CURRENT_RULES, *ALTERNATING_CURRENT_RULES),
        "gearboxes": GEARBOX_RULES,
        "winches": WINCH_RULES,
        "ropes": ROPE_RULES,
    }
)
