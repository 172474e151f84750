"""Single values: from what somebody wrote to what the database holds, and back."""

import json
import re
from collections.abc import Callable, Mapping
from math import inf, isinf, isnan
from numbers import Real
from typing import TypeAlias

from actuator_select.database.fields import Field, Kind
from actuator_select.errors import Problem

UNLIMITED = "unlimited"
LARGEST_FIGURE, SMALLEST_FIGURE = 1e12, 1e-12  # in any datasheet unit; beyond them arithmetic would overflow

Value: TypeAlias = float | int | str | None
"""None is unknown, an infinite float unlimited."""

Reader: TypeAlias = Callable[[object], Value]
"""What makes a value of what stands in a cell, or raises `Refused`."""

_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+([eE][+-]?\d+)?")
_THOUSANDS = re.compile(r"[+-]?[0-9]{1,3}(?:(?:,[0-9]{3})+\.[0-9]*|(?:,[0-9]{3}){2,}|(?:\.[0-9]{3})+,[0-9]*)")
_WHOLE = re.compile(r"[+-]?[0-9]{1,18}")
_NUMBER = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
_QUANTITY = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(?:[^\W\d_]|[%°])[^0-9]*")
_DATE_AND_TIME = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}[T ][0-9]")
_DAYS = re.compile(r"[0-9]{5}(\.[0-9]+)?")  # since 1900, as spreadsheets count
_NO_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff]")  # they garble terminals and files
_TOO_LARGE = "this is more than a number can hold"
_LONG_NUMBER = 1e15  # whole numbers from here on are written with an exponent
_QUOTED_LENGTH = 60  # characters of a value that a message repeats


class Refused(ValueError):
    """A value that a field does not take; caught where its place is known.

    Attributes
    ----------
    expected : str
        What may stand there.
    remedy : str
        What to do; may be empty.
    """

    def __init__(self, expected: str, remedy: str = "") -> None:
        self.expected = expected
        self.remedy = remedy
        super().__init__(expected)

    def at(self, place: str, value: object) -> Problem:
        """Say where it stands."""
        return Problem(place=place, value=quoted(value), expected=self.expected, remedy=self.remedy)


def quoted(value: object) -> str:
    """Repeat a value in a message, shortened and without line breaks."""
    if value is None or value == "":
        return "empty"
    if isinstance(value, bool | list | dict):
        value = json.dumps(value, ensure_ascii=False)  # only JSON and spreadsheets have these
    text = ascii_controls(str(value))
    return f"'{text[:_QUOTED_LENGTH]}…'" if len(text) > _QUOTED_LENGTH else f"'{text}'"


def ascii_controls(text: str) -> str:
    """Replace control characters, which would garble a terminal, by their escapes."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


def is_number(text: str) -> bool:
    """Whether a text is a number as this program reads numbers: digits, a point, an exponent."""
    return _NUMBER.fullmatch(text) is not None


def read_value(field: Field, value: object) -> Value:
    """Check one value, or read it from its text.

    Parameters
    ----------
    field : Field
        What the value is for.
    value : object
        A text as written in a cell, a number, or None. Empty is unknown.

    Returns
    -------
    float, int, str or None
        As the database holds it.

    Raises
    ------
    Refused
        If it may not stand there.
    """
    if value is None or (isinstance(value, str) and not value.strip()):
        return None
    if field.is_text:
        return _read_text(field, value)
    number = _read_number(field, value) if isinstance(value, str) else _as_number(field, value)
    _check_range(field, number)
    return number


def reader_of(field: Field) -> Reader:
    """Reader of one field, for many cells.

    Parameters
    ----------
    field : Field
        What the values are for.

    Returns
    -------
    callable
        Does what `read_value` does with this field. What is plainly right, as nearly every cell is, it knows at once;
        everything else it leaves to `read_value`.
    """
    if not field.is_text:
        return _number_reader(field)
    matches = re.compile(field.pattern).fullmatch if field.pattern else None
    choices = frozenset(field.choices)

    def read_text(value: object) -> Value:
        if type(value) is str and value.isprintable() and not value.isspace():
            if choices:
                if value in choices:
                    return value
            elif value and (matches is None or matches(value)):
                return value
        return read_value(field, value)

    return read_text


def _number_reader(field: Field) -> Reader:
    convert, matches = (int, _WHOLE.fullmatch) if field.type == "int" else (float, _NUMBER.fullmatch)
    # Strictly between these every number may stand; the limits themselves are left to the careful way.
    low = max(SMALLEST_FIGURE, field.minimum or 0.0, field.exclusive_minimum or 0.0)
    high = LARGEST_FIGURE if field.maximum is None else field.maximum

    def read_number(value: object) -> Value:
        if type(value) is str and matches(value):
            number = convert(value)
            if low < number < high:
                return number
        return read_value(field, value)

    return read_number


def write_value(value: Value) -> str:
    """Write a value as a cell that reads back as the same value."""
    if value is None:
        return ""
    if isinstance(value, float):
        return UNLIMITED if isinf(value) else _shortest(value)
    return str(value)


def check_row(kind: Kind, row: Mapping[str, Value]) -> list[tuple[str, Refused]]:
    """Check what concerns several columns, and what is missing.

    Parameters
    ----------
    kind : Kind
        Of the row.
    row : mapping of str to value
        Values by column; an absent column is unknown.

    Returns
    -------
    list of (str, Refused)
        Column and objection.
    """
    refusals = [
        (field.name, Refused(field.expected, "this column has to be filled in every row"))
        for field in kind.required
        if row.get(field.name) is None
    ]
    refusals += [
        (group[0], Refused(f"at least one of {', '.join(group)}", "fill one of these columns"))
        for group in kind.any_of
        if all(row.get(name) is None for name in group)
    ]
    for order in kind.orders:
        greater, lesser = row.get(order.greater), row.get(order.lesser)
        if isinstance(greater, float) and isinstance(lesser, float) and greater < lesser:
            expected = f"at least {order.lesser} = {write_value(lesser)} [{kind.field(order.greater).unit}]"
            refusals.append((order.greater, Refused(expected, "check both figures in the source")))
    return refusals


def _shortest(value: float) -> str:
    return str(int(value)) if value.is_integer() and abs(value) < _LONG_NUMBER else repr(value)


def _read_text(field: Field, value: object) -> str:
    if not isinstance(value, str):
        raise Refused(field.expected, f"write it as a text: '{value}'")
    if unfit := _NO_TEXT.search(value):
        raise Refused("a text", f"remove the character {unfit.group()!a}")
    if field.choices and value not in field.choices:
        near = value.strip().casefold()
        raise Refused(field.expected, f"write {near}" if near in field.choices else "")
    if field.pattern and not re.fullmatch(field.pattern, value):
        stripped = value.strip()
        spaces_only = stripped != value and re.fullmatch(field.pattern, stripped)
        remedy = "remove the spaces around it" if spaces_only else ""
        if "date" in field.name.split("_"):
            remedy = remedy or _date_remedy(value)
        raise Refused(field.expected, remedy)
    return value


def _date_remedy(text: str) -> str:
    if _DATE_AND_TIME.match(text):
        return f"write {text[:10]} without the time"
    return "a spreadsheet counts days so; format the cell as a date or type it" if _DAYS.fullmatch(text) else ""


def _read_number(field: Field, text: str) -> float | int:
    text = text.strip()
    if text.casefold() == UNLIMITED:
        return inf
    if field.type == "int" and _WHOLE.fullmatch(text):
        return int(text)
    if field.type == "float" and _NUMBER.fullmatch(text):
        number = float(text)
        if isinf(number):
            raise Refused(field.expected, _TOO_LARGE)
        return number + 0.0
    raise Refused(field.expected, _remedy(field, text))


def _remedy(field: Field, text: str) -> str:
    if _THOUSANDS.fullmatch(text):
        has_decimal_comma = -1 < text.find(".") < text.find(",")
        plain = text.replace(".", "").replace(",", ".") if has_decimal_comma else text.replace(",", "")
        return f"thousands are separated, write {plain}"
    if _DECIMAL_COMMA.fullmatch(text):
        return f"a decimal comma was given, write {text.replace(',', '.')} with a point"
    word = text.casefold().lstrip("+-")
    if word in {"inf", "infinity", "∞"}:
        return f"write {UNLIMITED}" if field.may_be_unlimited else "leave it empty if it is unknown"
    if word in {"nan", "none", "null", "unknown", "n/a", "na", "-", "", "–", "?"}:  # lstrip leaves "" of "-"
        return "leave it empty if it is unknown"
    if quantity := _QUANTITY.fullmatch(text):
        given = "a per cent sign" if text.rstrip().endswith("%") else "a unit"
        return f"{given} was given, write {quantity[1]}" + (f" in {field.unit}" if field.unit else "")
    return "write a whole number without a point" if _NUMBER.fullmatch(text) else "leave it empty if it is unknown"


def _as_number(field: Field, value: object) -> float | int:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise Refused(field.expected, "write a number")
    try:
        number = float(value)
    except OverflowError:
        raise Refused(field.expected, _TOO_LARGE) from None
    if isnan(number):
        raise Refused(field.expected, "NaN is no figure; leave it empty if it is unknown")
    if field.type == "int" and not isinf(number):
        if not number.is_integer():
            raise Refused(field.expected, "write a whole number")
        return int(number)
    return number + 0.0  # makes 0.0 of -0.0, which not every database tells apart


def _check_range(field: Field, number: float) -> None:
    if isinf(number):
        if not field.may_be_unlimited or number < 0.0:
            raise Refused(field.expected, "this figure cannot be unlimited; leave it empty if it is unknown")
        return
    too_small = (field.minimum is not None and number < field.minimum) or (
        field.exclusive_minimum is not None and number <= field.exclusive_minimum
    )
    if too_small and field.unit == "%" and 0.0 < number <= 1.0:
        raise Refused(field.expected, f"a fraction was given, write {_shortest(round(100.0 * number, 10))}")
    if abs(number) > LARGEST_FIGURE or 0.0 < abs(number) < SMALLEST_FIGURE:
        raise Refused(field.expected, "no part has such a figure; check the unit")
    if too_small or (field.maximum is not None and number > field.maximum):
        raise Refused(field.expected, "leave it empty if it is unknown" if number == 0.0 and too_small else "")
