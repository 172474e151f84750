"""Does a row agree with itself? Named rules that compare a stated figure with what the row's other figures give.

A finding is a warning, never a refusal: the figure may be right and the rule's simple model wrong. The DC rules hold
for direct-current figures only (terminal voltage, line current) and are skipped for rows that state another convention.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from actuator_select.database import Catalogue
from actuator_select.units import rad_per_s, rpm

TOLERANCE = 0.10  # relative; datasheet rounding and tolerances stay within it
WELL_BELOW = 0.5  # rated over stall torque; thermal ratings of motors with windings stay below half

Row = Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One disagreement within one row.

    Attributes
    ----------
    rule : str
        Name of the rule.
    kind, id, name : str
        The row.
    quantity : str
        Column whose figure is in doubt.
    stated, expected : float
        The figure and what the other figures give, in `unit`.
    deviation : float
        stated/expected - 1.
    unit : str
        Of both.
    text : str
        The finding in a sentence.
    """

    rule: str
    kind: str
    id: str
    name: str
    quantity: str
    stated: float
    expected: float
    deviation: float
    unit: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """Compare column `quantity` with `expected(row)`, where every needed column is known.

    Attributes
    ----------
    name, quantity, unit : str
        Of the rule, of the column, of the column's figure.
    needs : tuple of str
        Columns that `expected` reads.
    expected : callable
        From a row to the figure.
    because : str
        How the expectation comes about, for the sentence.
    doubtful : callable
        From stated/expected - 1 to whether that is a finding.
    direct_current : bool
        Whether the rule holds for DC figures only.
    """

    name: str
    quantity: str
    unit: str
    needs: tuple[str, ...]
    expected: Callable[[Row], float]
    because: str
    doubtful: Callable[[float], bool] = lambda deviation: abs(deviation) > TOLERANCE
    direct_current: bool = False


def _known(row: Row, column: str, *, otherwise: float) -> float:
    value = row.get(column)
    return otherwise if value is None else float(value)


def _loaded_speed(row: Row) -> float:
    current = row["rated_torque_nm"] / row["torque_constant_nm_per_a"]
    voltage = row["nominal_voltage_v"] - row["terminal_resistance_ohm"] * current
    return rpm(max(0.0, float(voltage)) / float(row["back_emf_constant_v_s_per_rad"]))


def _stall_torque(row: Row) -> float:
    return float(row["torque_constant_nm_per_a"] * row["nominal_voltage_v"] / row["terminal_resistance_ohm"])


MOTOR_RULES = (
    Rule(
        name="rated_power",
        quantity="rated_power_w",
        unit="W",
        needs=("rated_torque_nm", "rated_speed_rpm"),
        expected=lambda row: row["rated_torque_nm"] * rad_per_s(row["rated_speed_rpm"]),
        because="rated torque × rated speed",
    ),
    Rule(
        name="back_emf_constant",
        quantity="back_emf_constant_v_s_per_rad",
        unit="V s/rad",
        needs=("torque_constant_nm_per_a",),
        expected=lambda row: float(row["torque_constant_nm_per_a"]),
        because="the torque constant, which is the same in SI units",
        direct_current=True,
    ),
    Rule(
        name="speed_constant",
        quantity="speed_constant_rpm_per_v",
        unit="rpm/V",
        needs=("torque_constant_nm_per_a",),
        expected=lambda row: rpm(1.0 / row["torque_constant_nm_per_a"]),
        because="1 / torque constant",
        direct_current=True,
    ),
    Rule(
        name="no_load_speed",
        quantity="no_load_speed_rpm",
        unit="rpm",
        needs=("nominal_voltage_v", "back_emf_constant_v_s_per_rad"),
        expected=lambda row: rpm(row["nominal_voltage_v"] / row["back_emf_constant_v_s_per_rad"]),
        because="voltage / back-EMF constant",
        direct_current=True,
    ),
    Rule(
        name="stall_torque",
        quantity="stall_torque_nm",
        unit="N m",
        needs=("torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm"),
        expected=_stall_torque,
        because="torque constant × voltage / resistance",
        direct_current=True,
    ),
    Rule(
        name="stall_current",
        quantity="stall_current_a",
        unit="A",
        needs=("nominal_voltage_v", "terminal_resistance_ohm"),
        expected=lambda row: float(row["nominal_voltage_v"] / row["terminal_resistance_ohm"]),
        because="voltage / resistance",
        direct_current=True,
    ),
    Rule(
        name="rated_current",
        quantity="rated_current_a",
        unit="A",
        needs=("rated_torque_nm", "torque_constant_nm_per_a"),
        expected=lambda row: (
            row["rated_torque_nm"] / row["torque_constant_nm_per_a"] + _known(row, "no_load_current_a", otherwise=0.0)
        ),
        because="rated torque / torque constant, with the no-load current where known",
    ),
    Rule(
        name="rated_torque_below_stall_torque",
        quantity="rated_torque_nm",
        unit="N m",
        needs=("torque_constant_nm_per_a", "nominal_voltage_v", "terminal_resistance_ohm"),
        expected=_stall_torque,
        because="torque constant × voltage / resistance, the stall torque, of which a continuous torque is a fraction: "
        "is the stall torque in the wrong column?",
        doubtful=lambda deviation: deviation > WELL_BELOW - 1.0,
        direct_current=True,
    ),
    Rule(
        name="rated_speed_within_voltage",
        quantity="rated_speed_rpm",
        unit="rpm",
        needs=(
            "rated_torque_nm",
            "torque_constant_nm_per_a",
            "nominal_voltage_v",
            "terminal_resistance_ohm",
            "back_emf_constant_v_s_per_rad",
        ),
        expected=_loaded_speed,
        because="the speed that the nominal voltage leaves at rated torque",
        doubtful=lambda deviation: deviation > TOLERANCE,
        direct_current=True,
    ),
    Rule(
        name="peak_torque_above_rated_torque",
        quantity="peak_torque_nm",
        unit="N m",
        needs=("rated_torque_nm",),
        expected=lambda row: float(row["rated_torque_nm"]),
        because="at least the rated torque",
        doubtful=lambda deviation: deviation < 0.0,
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
    ),
    Rule(
        name="intermittent_torque_above_continuous_torque",
        quantity="max_intermittent_torque_nm",
        unit="N m",
        needs=("max_continuous_torque_nm",),
        expected=lambda row: float(row["max_continuous_torque_nm"]),
        because="at least the continuous torque",
        doubtful=lambda deviation: deviation < 0.0,
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

RULES: dict[str, tuple[Rule, ...]] = {"motors": MOTOR_RULES, "gearboxes": GEARBOX_RULES, "winches": WINCH_RULES}


def check_rows(kind: str, rows: Sequence[Row]) -> list[Finding]:
    """Apply every rule to every row.

    Parameters
    ----------
    kind : str
        ``"motors"``, ``"gearboxes"``, ``"winches"``; other kinds have no rules.
    rows : sequence of mapping
        Catalogue rows.

    Returns
    -------
    list of Finding
        Row by row.
    """
    return [finding for row in rows for rule in RULES.get(kind, ()) if (finding := _apply(rule, kind, row)) is not None]


def check_catalogue(catalogue: Catalogue, kind: str | None = None) -> list[Finding]:
    """Apply every rule to the whole catalogue or to one kind.

    Parameters
    ----------
    catalogue : Catalogue
        The catalogue.
    kind : str, optional
        One kind only.

    Returns
    -------
    list of Finding
        Kind by kind, row by row.
    """
    kinds = RULES if kind is None else {kind: RULES.get(kind, ())}
    return [finding for one in kinds for finding in check_rows(one, catalogue.rows(one))]


def _apply(rule: Rule, kind: str, row: Row) -> Finding | None:
    stated = row.get(rule.quantity)
    if stated is None or any(row.get(column) is None for column in rule.needs):
        return None
    if rule.direct_current and str(row.get("electrical_convention") or "").startswith("ac"):
        return None
    expected = rule.expected(row)
    if not (isfinite(stated) and isfinite(expected)):
        return None
    deviation = stated / expected - 1.0 if expected else float("inf")
    if not rule.doubtful(deviation):
        return None
    name = row.get("part_number") or row.get("name") or row.get("description") or row["id"]
    by = f"{100.0 * deviation:+.0f} %" if isfinite(deviation) else "from zero"
    return Finding(
        rule=rule.name,
        kind=kind,
        id=str(row["id"]),
        name=str(name),
        quantity=rule.quantity,
        stated=float(stated),
        expected=expected,
        deviation=deviation,
        unit=rule.unit,
        text=f"{rule.quantity} is {stated:.4g} {rule.unit}, but {expected:.4g} {rule.unit} follows from {rule.because} "
        f"({by})",
    )
