"""JSON catalogues as tables: a list of rows for each kind, as ``catalog export`` writes them."""

import json
from collections.abc import Iterator, Sequence
from functools import partial
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from actuator_select.database.cells import UNLIMITED, Reader, Refused, Value, is_number, quoted, reader_of
from actuator_select.database.export import JSON_FORMAT, JSON_FORMAT_VERSION
from actuator_select.database.fields import Field
from actuator_select.database.kinds import KINDS
from actuator_select.database.tables import ABSENT, Line, Table, kind_named
from actuator_select.errors import InvalidRows, did_you_mean

if TYPE_CHECKING:
    from actuator_select.database.unit_conversion import Conversion

_MOST_DIGITS = 400  # a float has at most 309 before the point
_NOT_LISTS = {"format", "format_version", "fingerprint"}


def json_tables(path: Path) -> list[Table]:
    """Read a JSON file, which is held in memory whole, unlike the other formats.

    Parameters
    ----------
    path : Path
        ``{"format": "actuator-select catalogue", "format_version": 1, "motors": [{…}], …}``, or a list of rows.

    Returns
    -------
    list of Table
        One for each list; names of OPC 40400-1 are known beside the catalogue's.

    Raises
    ------
    InvalidRows
        If it cannot be read, or is something else.
    """
    content = _read(path)
    if isinstance(content, list):
        content = {path.stem: content}
    if not isinstance(content, dict):
        raise InvalidRows(f'{path.name} is no catalogue; expected {{"motors": [{{…}}], …}} or a list of rows')
    if content.get("format", JSON_FORMAT) != JSON_FORMAT:
        raise InvalidRows(f"{path.name} states the format {content['format']!r}, expected {JSON_FORMAT!r}")
    if content.get("format_version", JSON_FORMAT_VERSION) != JSON_FORMAT_VERSION:
        version = content["format_version"]
        raise InvalidRows(
            f"{path.name} states format_version {version!r}, expected {JSON_FORMAT_VERSION}; a newer actuator-select "
            "may read it"
        )
    lists = {key: rows for key, rows in content.items() if key not in _NOT_LISTS}
    for key, rows in lists.items():
        if len(lists) > 1 and kind_named(key) is None:
            raise InvalidRows(f"{path.name}: {key!r} is no kind of row; {did_you_mean(key, list(KINDS))}")
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise InvalidRows(f'{path.name}: {key!r} is no list of rows; expected [{{"id": …}}, …]')
    return [_table(path.name, key, rows) for key, rows in lists.items()]


def _read(path: Path) -> Any:  # noqa: ANN401 - any JSON
    try:
        return json.loads(
            path.read_bytes(), object_pairs_hook=_without_repetition, parse_constant=_refuse_constant, parse_int=_whole
        )
    except OSError as error:
        raise InvalidRows(f"cannot read {path}: {error.strerror or error}; check the name of the file") from error
    except RecursionError as error:
        raise InvalidRows(f"{path.name} is nested too deeply for a catalogue") from error
    except ValueError as error:  # also of bytes that are no UTF-8
        raise InvalidRows(f"{path.name} is no JSON: {error}") from error


def _whole(digits: str) -> int:
    if len(digits) > _MOST_DIGITS:
        raise ValueError(f"a number of {len(digits)} digits is more than a number can hold")
    return int(digits)


def _without_repetition(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"{next(name for name in names if names.count(name) > 1)!r} stands twice in one object")
    return found


def _refuse_constant(word: str) -> None:
    raise ValueError(f'{word} is no figure; write null if it is unknown, "unlimited" if there is no limit')


def _table(name: str, key: str, rows: Sequence[dict[str, object]]) -> Table:
    keys = list(dict.fromkeys(one for row in rows for one in row))
    return Table(
        name=f"{name}, {key}",
        title=key,
        header=tuple(keys),
        read_lines=partial(_lines, rows, keys),
        length=len(rows),
        numbered_from=0,
        unit_of_lines="row",
        adapt=_adapt,
        knows_opc=True,
    )


def _lines(rows: Sequence[dict[str, object]], keys: Sequence[str]) -> Iterator[Line]:
    for number, row in enumerate(rows, start=1):
        yield number, [row.get(one, ABSENT) for one in keys]


def _adapt(field: Field, read: Reader) -> Reader:
    """Read a figure also with its unit: ``{"Value": 5060, "EngineeringUnits": "rpm"}``."""

    def read_cell(cell: object) -> Value:
        return _with_unit(field, cell, read) if isinstance(cell, dict) else read(cell)

    return read_cell


def _with_unit(field: Field, cell: dict[str, object], read: Reader) -> Value:
    """A figure in the unit that stands beside it, which a mapping's does not change again."""
    value, unit = cell.get("Value"), cell.get("EngineeringUnits")
    if field.is_text or set(cell) != {"Value", "EngineeringUnits"} or not isinstance(unit, str):
        raise Refused(field.expected, 'write it plainly, or as {"Value": 5060, "EngineeringUnits": "rpm"}')
    rule = _rule(field, unit)
    if isinstance(value, bool | int | float):
        number = None if isinstance(value, bool) else repr(value)
    else:
        number = value.strip() if isinstance(value, str) and is_number(value.strip()) else None
    if number is not None:
        converted = number if rule is None else rule.apply(number)
        if converted == inf:
            raise Refused(field.expected, "this is more than a number can hold")
        return reader_of(field)(converted)
    if value is None or value == "" or (isinstance(value, str) and value.strip().casefold() == UNLIMITED):
        return reader_of(field)(value)
    figure = read(value)  # a word of a mapping for an unknown or an unlimited figure has no unit
    if figure is None or figure == inf:
        return figure
    raise Refused(field.expected, f"a figure with a unit is a number, such as 5060, or the word {UNLIMITED}")


def _rule(field: Field, unit: str) -> "Conversion | None":
    from actuator_select.database.unit_conversion import UnitRefused, conversion

    if unit.strip() == field.unit:
        return None
    try:
        rule = conversion(unit, field)
    except UnitRefused as refused:
        raise Refused(field.expected, f"the unit {quoted(unit)} {refused}") from refused
    return None if rule.changes_nothing else rule
