"""Foreign units to the units of the catalogue's columns, by pint, as people spell them.

Numbers are computed as decimals and rounded to 15 significant digits, so that 1.2 mNm is 0.0012 N m and the same cell
gives the same figure everywhere. A figure in the column's own unit is not touched at all.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from decimal import Context, Decimal
from functools import lru_cache
from math import inf, isinf
from typing import TYPE_CHECKING, Any

from actuator_select.database.fields import Field

if TYPE_CHECKING:
    import pint

_PRECISE = Context(prec=40)
_ROUNDED = Context(prec=15)  # significant digits; every decimal of 15 digits survives a float
_LEAST, _GREATEST = Decimal("1e-30"), Decimal("1e30")  # factors inside a unit, such as the 1000 of V/(1000 rpm)
_DEFINITIONS = (
    "Nm = newton * meter",
    "oz_in = force_ounce * inch",
    "lb_in = force_pound * inch",
    "lb_ft = force_pound * foot",
    "Nms = newton * meter * second",
    "Vs = volt * second",
    "rev = revolution",
    "lbm = pound",
    "gcm = gram * centimeter",
    "kgcm = kilogram * centimeter",
    "kp = force_kilogram",
)
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_SPELLINGS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # Powers first, because "oz in" is a torque and "oz in²" a moment of inertia.
    (r"[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+", lambda power: f"**{power[0].translate(_SUPERSCRIPTS)}"),
    (r"\^", "**"),
    # A number right before a unit is a factor of it: 10⁻⁷kgm², V/1000min⁻¹.
    (r"(?<![\w.])(\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)(?![eE][-+]?\d)(?=[A-Za-zµμΩ(])", r"\1*"),
    (r"[·⋅∙×•]", "*"),
    # Capitals, and words that makers write with one.
    (
        r"(?<![A-Za-z])(?:Watts?|Volts?|Amp(?:ere)?s?|Inch(?:es)?|Ounces?|Pounds?|Grams?|OZF?|LB[FS]?|IN|FT)(?![A-Za-z])",
        lambda word: word[0].lower(),
    ),
    (r"\b(?:KG|Kg)(?![a-z])", "kg"),
    (r"\bK[Ww]\b", "kW"),
    (r"\bHP\b", "hp"),
    (r"\b(foot|ft|lb|oz|in)\.(?=[\s-]|$)", r"\1"),
    (r"\bfoot[-\s]?pounds?\b", "ft lb"),
    (r"\binch[-\s]?pounds?\b", "in lb"),
    (r"\bkpcm\b", "kp cm"),
    (r"\bkgfcm\b", "kgf cm"),
    (r"(?<=\bm)Ohms?\b", "ohm"),
    # A coulomb per watt is no figure of a motor.
    (r"^C(?=\s*/\s*W\b)", "°C"),
    (r"µ|μ", "µ"),
    (r"Ω|Ω|\bOhms?\b", "ohm"),
    # What is said of revolutions: 1/min alone is no angular speed to pint.
    (r"\b(?:1/min|min(?:\*\*)?-1|r/min|revs?/min|U/min|RPM)(?!\w)", "rpm"),
    (r"\bkRPM\b", "krpm"),
    (r"\b(?:1000|1,000|1e3)\s*\*?\s*rpm\b", "krpm"),
    (r"\brps\b", "(revolution/second)"),
    (r"(?:°|\bdeg)\s?([CF])(?=\s*/)", r"delta_deg\1"),
    (r"°\s?([CF])\b", r"deg\1"),
    (r"°", "deg"),
    (r"\b(?:ozf?)[-\s.*]?in\b(?!\*\*|\d)", "oz_in"),
    (r"\b(?:lb[fs]?[-\s.*]?in|in[-\s.*]?lb[fs]?)\b(?!\*\*|\d)", "lb_in"),
    (r"\b(?:lb[fs]?[-\s.*]?ft|ft[-\s.*]?lb[fs]?)\b(?!\*\*|\d)", "lb_ft"),
    (r"\bozf\b", "force_ounce"),
    (r"\bN[-\s.*]?cm\b", "(newton*centimeter)"),
    (r"\bN[-\s.*]?mm\b", "(newton*millimeter)"),
    (r"([A-Za-zµ])([23])\b", r"\1**\2"),
    (r"([A-Za-zµ)])-([123])\b", r"\1**-\2"),
    (r"(?<=[A-Za-z0-9)])[-.](?=[A-Za-z(])", "*"),
    (r"\s*(\*\*|\*|/|\(|\))\s*", r"\1"),
    (r"\s+", "*"),
)
_SEPARATE_POWERS = (
    ("kgm**2", "kilogram*meter**2"),
    ("kgcm**2", "kilogram*centimeter**2"),
    ("kgmm**2", "kilogram*millimeter**2"),
    ("gcm**2", "gram*centimeter**2"),
    ("gmm**2", "gram*millimeter**2"),
)
# What pint reads otherwise than the one who wrote it, most likely, and what to write for either.
_DOUBTFUL = {
    "gr": "g for gram or grain",
    "gm": "g",
    "ton": "t for 1000 kg, or short_ton or long_ton",
    "tons": "t for 1000 kg, or short_ton or long_ton",
    "u": "g, or kg",
    "a": "A for ampere, or year",
    "d": "day",
    "Mm": "mm, or 1000 km",
    "Mg": "mg, or t for 1000 kg",
    "Ms": "ms, or 1e6 s",
    "MH": "mH",
    "MNm": "mNm, or 1e6 N m",
    "MA": "mA",
    "MV": "mV",
    "PS": "metric_horsepower, or hp for 745.7 W",
}
_WORD = re.compile(r"[^\W\d]+")
_ANGLE = re.compile(r"rpm|rad|rev|deg(?![CF])|turn|arc|grad")
# Units of columns that say nothing without an angle, and what may be written for them.
_WITH_ANGLE = {"rpm": "rpm, rad/s or rev/s", "rpm/V": "rpm/V, rad/(s V) or rev/(s V)", "arcmin": "arcmin, deg or rad"}
_COMMON = "write it as mNm, g cm², oz-in, rpm/V, lb or V s/rad"
_PURE = {"", "%"}


class UnitRefused(ValueError):
    """A unit that is not known or does not fit the column; its words say which and what to do."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Conversion:
    """From a foreign unit to a column's: y = factor·x + offset, or y = 1/(factor·x).

    Attributes
    ----------
    factor, offset : Decimal
        As above.
    reciprocal : bool
        Whether the foreign figure is the other way round, such as V/krpm for rpm/V.
    """

    factor: Decimal
    offset: Decimal = Decimal(0)
    reciprocal: bool = False

    @property
    def changes_nothing(self) -> bool:
        """Whether the foreign unit is the column's own."""
        return self.factor == 1 and self.offset == 0 and not self.reciprocal

    def apply(self, number: str) -> float:
        """Convert a number as written; what is beyond all floats becomes infinite, as does one over zero."""
        if isinf(float(number)) or (self.reciprocal and float(number) == 0.0):
            return inf
        # No decimal has the exponent that a cell can have; what a float makes zero of is zero.
        scaled = _PRECISE.multiply(self.factor, Decimal(number) if float(number) else Decimal(0))
        result = _PRECISE.divide(Decimal(1), scaled) if self.reciprocal else _PRECISE.add(scaled, self.offset)
        return float(_ROUNDED.plus(result)) + 0.0


def conversion(unit: str, field: Field, *, reciprocal: bool = False) -> Conversion:
    """How figures in a foreign unit become figures of a column.

    Parameters
    ----------
    unit : str
        As people write it: ``mNm``, ``oz-in``, ``g cm²``, ``rpm/V``, ``lb``.
    field : Field
        The column.
    reciprocal : bool
        Whether one over the foreign figure is meant.

    Returns
    -------
    Conversion
        The rule.

    Raises
    ------
    UnitRefused
        If the unit is not known, or measures something else than the column.
    """
    if unit.strip() == field.unit and not reciprocal:
        return Conversion(factor=Decimal(1))
    doubtful = next((word for word in _WORD.findall(unit) if word in _DOUBTFUL), None)
    if doubtful is not None:
        raise UnitRefused(f"does not say clearly what {doubtful} is; write {_DOUBTFUL[doubtful]}")
    if not unit.strip() and field.unit not in _PURE:
        raise UnitRefused(f"is no unit; write that of the foreign figures, such as {field.unit}")
    given, wanted = _quantity(unit), _quantity(field.unit)
    magnitude = Decimal(given.magnitude)
    if not magnitude.is_finite() or not _LEAST < magnitude < _GREATEST:
        raise UnitRefused(f"is nothing to measure with; {_COMMON}")
    if field.unit == "°C":
        return _temperature(unit, field)
    factor = _factor(1 / given if reciprocal else given, wanted, unit, field, reciprocal=reciprocal)
    _check_angle(unit, field)
    return Conversion(factor=1 / factor if reciprocal else factor, reciprocal=reciprocal)


def spelt_for_pint(unit: str) -> str:
    """A unit as pint reads it."""
    text = unit.strip()
    for pattern, replacement in _SPELLINGS:
        text = re.sub(pattern, replacement, text)
    for joined, apart in _SEPARATE_POWERS:
        text = re.sub(rf"\b{re.escape(joined)}(?!\d)", apart, text)
    return "percent" if text == "%" else text or "dimensionless"


@lru_cache(maxsize=1)
def _registry() -> "pint.UnitRegistry[Any]":
    """Pint's units; they take half a second to build and are built when the first unit is looked up."""
    import pint

    registry: pint.UnitRegistry[Any] = pint.UnitRegistry(non_int_type=Decimal)
    for definition in _DEFINITIONS:
        registry.define(definition)
    return registry


def _quantity(unit: str) -> Any:  # noqa: ANN401 - pint's quantities have no simple type
    import pint

    try:
        # A factor may be part of a unit, as in V/(1000 rpm).
        if _is_temperature(unit):
            return _registry().Quantity(Decimal(1), "delta_degC")
        parsed: Any = _registry().parse_expression(spelt_for_pint(unit))
        units = getattr(parsed, "units", "dimensionless")
        quantity = _registry().Quantity(Decimal(getattr(parsed, "magnitude", parsed)), units)
        quantity.to_base_units()  # refuses what only a logarithm converts, such as dBm
    except pint.PintError as error:
        raise UnitRefused(f"is no known unit; {_COMMON}") from error
    except Exception as error:  # whatever pint's parser of expressions runs into
        raise UnitRefused(f"cannot be read as a unit; {_COMMON}") from error
    return quantity


def _factor(given: Any, wanted: Any, unit: str, field: Field, *, reciprocal: bool = False) -> Decimal:  # noqa: ANN401
    import pint

    try:
        ratio = (given / wanted).to("dimensionless")
    except pint.DimensionalityError as error:
        own = field.unit or "a pure number"
        remedy = "check which column the figure belongs to"
        if not reciprocal and (1 / given).dimensionality == wanted.dimensionality:
            remedy = "it is the other way round: state reciprocal = true, or take the column that is meant"
        elif not reciprocal and (with_force := _with_force(given, wanted, unit)) is not None:
            remedy = f"write {with_force}"
        said = "one over it" if reciprocal else "it"
        raise UnitRefused(f"cannot stand here: {said} does not measure what {own} measures; {remedy}") from error
    return Decimal(ratio.magnitude)


def _with_force(given: Any, wanted: Any, unit: str) -> str | None:  # noqa: ANN401
    """The unit with forces in place of masses, where that is what the column measures: kgf cm for kg cm."""
    if (given * _registry().Quantity(Decimal(1), "meter/second**2")).dimensionality != wanted.dimensionality:
        return None
    return re.sub(r"(?i:(?<![a-z])(kg|g|oz|lb)s?(?![a-z]))", lambda mass: f"{mass[1].lower()}f", unit.strip())


def _check_angle(unit: str, field: Field) -> None:
    """Refuse what pint, to which an angle is a number, would take: 1/s for rpm, or an angle for an efficiency."""
    text = spelt_for_pint(unit)
    if re.search(r"\b[kM]?Hz\b|hertz", text):
        raise UnitRefused("does not say whether revolutions or radians are counted; write rev/s or rad/s in its place")
    has_angle = _ANGLE.search(text) is not None
    if field.unit in _WITH_ANGLE and not has_angle:
        raise UnitRefused(f"does not say of which angle; write {_WITH_ANGLE[field.unit]}")
    if field.unit in _PURE and has_angle:
        raise UnitRefused(f"is an angle, the column's {field.unit or 'a pure number'} is not; check the column")


def _is_temperature(unit: str) -> bool:
    return spelt_for_pint(unit) in {"degC", "degF", "K", "kelvin", "celsius", "fahrenheit"}


def _temperature(unit: str, field: Field) -> Conversion:
    if not _is_temperature(unit):
        raise UnitRefused(f"is no temperature, the column is in {field.unit}; write °C, °F or K")
    zero, one = (
        Decimal(_registry().Quantity(Decimal(number), spelt_for_pint(unit)).to("degC").magnitude) for number in (0, 1)
    )
    return Conversion(factor=_ROUNDED.plus(one - zero), offset=zero)
