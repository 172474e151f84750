"""Rows as CSV, JSON and XLSX files that read back exactly, made piece by piece."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import isinf
from pathlib import Path
from types import MappingProxyType

from actuator_select.database.cells import UNLIMITED, Value, write_value
from actuator_select.database.csv_table import write_csv
from actuator_select.database.fields import Field, Kind
from actuator_select.database.opc import opc_name
from actuator_select.errors import OutputNotWritable

JSON_FORMAT, JSON_FORMAT_VERSION = "actuator-select catalogue", 1
FILE_FORMATS = MappingProxyType({".csv": "csv", ".xlsx": "xlsx", ".json": "json"})
"""Formats of exported files, by the ending of the name."""

_ROWS_PER_PIECE = 500

KindRows = tuple[Kind, Iterable[Mapping[str, Value]]]


def csv_pieces(names: Sequence[str], rows: Iterable[Mapping[str, Value]]) -> Iterator[str]:
    """Rows as CSV, first the header.

    Parameters
    ----------
    names : sequence of str
        Columns to write.
    rows : iterable of mapping
        Values by column.

    Yields
    ------
    str
        Piece of the file.
    """
    yield write_csv(names, ())
    records = ([write_value(row[name]) for name in names] for row in rows)
    while first := next(records, None):
        yield write_csv(first, islice(records, _ROWS_PER_PIECE - 1))


def json_pieces(kinds: Sequence[KindRows], fingerprint: str) -> Iterator[str]:
    """Rows as one strict JSON object, a list for each kind.

    Parameters
    ----------
    kinds : sequence of (Kind, iterable of mapping)
        Kinds with their rows, values by column.
    fingerprint : str
        Of the catalogue that the rows are from.

    Yields
    ------
    str
        Piece of the file. Keys are the names of OPC 40400-1 where it has one. A figure with such a name is an object
        of ``Value`` and ``EngineeringUnits`` (empty for pure numbers), any other a plain number; an unlimited figure
        is the word; unknown ones are left out.
    """
    head = {"format": JSON_FORMAT, "format_version": JSON_FORMAT_VERSION, "fingerprint": fingerprint}
    yield json.dumps(head, indent=2)[:-2]
    for kind, rows in kinds:
        yield f',\n  "{kind.name}": ['
        between = "\n"
        for row in rows:
            yield f"{between}    {json.dumps(json_record(kind, row), ensure_ascii=False, allow_nan=False)}"
            between = ",\n"
        yield "]" if between == "\n" else "\n  ]"
    yield "\n}\n"


def list_json_pieces(kind: Kind, rows: Iterable[Mapping[str, Value]], fingerprint: str) -> Iterator[str]:
    """Rows of a list as one strict JSON object, under the catalogue's own column names.

    Parameters
    ----------
    kind : Kind
        Of the rows.
    rows : iterable of mapping
        Values by column; an unlimited figure becomes the word, an unknown one null.
    fingerprint : str
        Of the catalogue that the rows are from.

    Yields
    ------
    str
        Piece of the text.
    """
    head = {"kind": kind.name, "catalogue": {"fingerprint": fingerprint}}
    yield json.dumps(head, indent=2)[:-2] + ',\n  "rows": ['
    between = "\n"
    for row in rows:
        record = {name: _plain(value) for name, value in row.items()}
        text = json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False)
        yield f"{between}    " + text.replace("\n", "\n    ")
        between = ",\n"
    yield "]\n}\n" if between == "\n" else "\n  ]\n}\n"


def json_record(kind: Kind, row: Mapping[str, Value]) -> dict[str, object]:
    """One row of a JSON file: what is known of it, by its names there."""
    return {
        opc_name(kind, field.name): _json_value(kind, field, value)
        for field in kind.fields
        if (value := row[field.name]) is not None
    }


def _json_value(kind: Kind, field: Field, value: Value) -> object:
    plain = _plain(value)
    if field.is_text or opc_name(kind, field.name) == field.name:
        return plain
    return {"Value": plain, "EngineeringUnits": field.unit}


def _plain(value: Value) -> Value:
    return UNLIMITED if isinstance(value, float) and isinf(value) else value


def make_folder(folder: Path) -> None:
    """Make a folder where it is missing; OutputNotWritable where that cannot be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputNotWritable(
            f"cannot make the folder {folder}: {error.strerror or error}; choose another"
        ) from error
