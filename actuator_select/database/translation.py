"""Foreign cells to our values, as a mapping says."""

import hashlib
import re
from collections.abc import Callable, Mapping
from functools import partial
from math import inf, isinf

from actuator_select.database.cells import Reader, Refused, Value, is_number, quoted, reader_of, write_value
from actuator_select.database.fields import Field
from actuator_select.database.mapping import PLACEHOLDER, Filling
from actuator_select.database.mapping import Mapping as ColumnMapping
from actuator_select.database.schema import ID_LENGTH
from actuator_select.database.unit_conversion import Conversion, conversion

_ZERO = re.compile(r"[+-]?[0.]+([eE].*)?")
_DIGEST_LENGTH = 8  # hexadecimal digits that keep shortened ids apart


def translator(field: Field, filling: Filling, mapping: ColumnMapping) -> Reader:
    """Reader of a foreign column's cells.

    Parameters
    ----------
    field : Field
        Our column.
    filling : Filling
        How it is filled.
    mapping : Mapping
        The whole mapping, for the words and the decimal sign of all columns.

    Returns
    -------
    callable
        Makes our value of a cell, or raises `Refused`.
    """
    missing = frozenset(word.casefold() for word in (*mapping.missing, *filling.missing))
    unlimited = frozenset(word.casefold() for word in filling.unlimited)
    read = _text_translator(field, filling) if field.is_text else _number_translator(field, filling, mapping)
    if filling.values:
        read = partial(_translate_word, field, filling.values, mapping)

    def read_cell(cell: object) -> Value:
        if cell is None:
            return None
        word = str(cell).strip().casefold()
        if not word or word in missing:
            return None
        return inf if word in unlimited else read(cell)

    return read_cell


def made_id(text: str, *, with_wildcards: bool = False) -> str:
    """An id that is as near to a text as an id can be.

    Parameters
    ----------
    text : str
        Any text with at least one letter or digit.
    with_wildcards : bool
        Whether ``*`` stays, because a pattern of ids is meant.

    Returns
    -------
    str
        Every run of characters that an id cannot hold is a hyphen; what is too long ends in a digest of the whole.
    """
    kept = r"[^A-Za-z0-9._+*-]+" if with_wildcards else r"[^A-Za-z0-9._+-]+"
    made = re.sub(kept, "-", text.strip()).lstrip("._+-")
    if len(made) <= ID_LENGTH:
        return made
    digest = hashlib.sha256(text.encode(errors="replace")).hexdigest()[:_DIGEST_LENGTH]
    return f"{made[: ID_LENGTH - _DIGEST_LENGTH - 1]}-{digest}"


def id_from(template: str, given: Mapping[str, Value]) -> str | None:
    """Id made of other columns of a row; None where one of them is missing."""
    missing = False

    def fill(match: re.Match[str]) -> str:
        nonlocal missing
        value = given.get(match[1])
        missing = missing or value is None
        return str(value)

    text = PLACEHOLDER.sub(fill, template)
    return None if missing else made_id(text)


def _translate_word(field: Field, values: Mapping[str, str], mapping: ColumnMapping, cell: object) -> Value:
    word = str(cell).strip()
    if word not in values:
        # It does not name our column: of a cell that fills several this is told once.
        remedy = f"say in the values of {mapping.name} what it means{mapping.copy_hint}"
        raise Refused(f"one of {', '.join(values)}", remedy)
    return reader_of(field)(values[word])


def _text_translator(field: Field, filling: Filling) -> Reader:
    plain = reader_of(field)
    with_wildcards = field.name.endswith("_pattern")

    def read_text(cell: object) -> Value:
        if not isinstance(cell, str):
            return plain(cell)
        text = f"{filling.prefix}{cell}"
        if filling.make_id:
            text = made_id(text, with_wildcards=with_wildcards)
        try:
            return plain(text)
        except Refused as refused:
            if text == cell:
                raise
            raise _explained(refused, f"the mapping made {quoted(text)} of {quoted(cell)}") from refused

    return read_text


def _number_translator(field: Field, filling: Filling, mapping: ColumnMapping) -> Reader:
    plain = reader_of(field)
    unit = filling.unit or ""
    rule = conversion(unit, field, reciprocal=filling.reciprocal) if filling.unit is not None else None
    point: Callable[[Field, str], str] = _with_point if mapping.csv.decimal == "," else _as_it_is

    def read_number(cell: object) -> Value:
        if isinstance(cell, str):
            text = point(field, cell.strip())
        elif isinstance(cell, int | float) and not isinstance(cell, bool):
            text = repr(cell)
        else:
            return plain(cell)
        if not is_number(text):
            return plain(text if isinstance(cell, str) else cell)
        if filling.zero_is_unknown and _ZERO.fullmatch(text):
            return None
        if rule is None or rule.changes_nothing:
            return plain(text)
        return _convert(field, rule, text, unit, plain)

    return read_number


def _convert(field: Field, rule: Conversion, text: str, unit: str, plain: Reader) -> Value:
    number = rule.apply(text)
    if isinf(number):
        raise Refused(field.expected, f"{text} {unit} is no figure; leave it empty if it is unknown")
    try:
        return plain(str(int(number)) if field.type == "int" and number.is_integer() else repr(number))
    except Refused as refused:
        told = f"{text} {unit} was given, which is {write_value(number)} {field.unit}"
        raise _explained(refused, told.rstrip()) from refused


def _explained(refused: Refused, told: str) -> Refused:
    return Refused(refused.expected, f"{refused.remedy}; {told}" if refused.remedy else told)


def _as_it_is(_: Field, text: str) -> str:
    return text


def _with_point(field: Field, text: str) -> str:
    if "." in text:
        raise Refused(field.expected, "a point was given although the mapping states a decimal comma")
    return text.replace(",", ".", 1)
