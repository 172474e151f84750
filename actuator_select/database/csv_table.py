"""CSV files: bytes to numbered lines of cells, and cells to text that reads back exactly."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from actuator_select.errors import InvalidRows, Problem

_LARGEST_CELL = 1_000_000  # characters; beyond it a quotation mark is missing rather than a note long
_NEEDS_QUOTES = re.compile(r'[",\r\n]|^\s|\s$')


@dataclass(frozen=True, slots=True, kw_only=True)
class CsvTable:
    """A CSV file in memory.

    Attributes
    ----------
    name : str
        Name of the file, for messages.
    header : tuple of str
        Its first line.
    lines : tuple of (int, tuple of str)
        Number of the line on which a record begins, and its cells; as many as `header`.
    """

    name: str
    header: tuple[str, ...]
    lines: tuple[tuple[int, tuple[str, ...]], ...]


def read_csv(path: Path) -> CsvTable:
    """Read a CSV file, UTF-8 with or without a byte order mark.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    CsvTable
        Header and records; blank lines are left out.

    Raises
    ------
    InvalidRows
        If it cannot be read, is not UTF-8, is empty, or lines have a wrong number of cells.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InvalidRows(f"cannot read {path}: {error.strerror or error}; check the name of the file") from error
    return parse_csv(_decode(data, path.name), path.name)


def parse_csv(text: str, name: str) -> CsvTable:
    """Split CSV text into numbered lines of cells.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Name of the file, for messages.

    Returns
    -------
    CsvTable
        Header and records.

    Raises
    ------
    InvalidRows
        If it is empty or lines have a wrong number of cells.
    """
    lines = _split(text, name)
    if not lines:
        raise InvalidRows(
            f"{name} is empty; its first line names the columns, `actuator-select catalog fields KIND` lists them"
        )
    (_, header), *records = lines
    if len(header) == 1 and ";" in header[0]:
        raise _one_problem(name, 1, header[0], "cells separated by commas", "replace the semicolons by commas")
    problems = [
        Problem(
            place=f"{name}, line {number}",
            value=f"{len(cells)} cells",
            expected=f"{len(header)} cells, as many as the header",
            remedy="is a comma missing or too many? A cell that holds a comma stands in double quotes",
        )
        for number, cells in records
        if len(cells) != len(header)
    ]
    if problems:
        raise InvalidRows(f"{name} cannot be read", problems)
    return CsvTable(name=name, header=tuple(cell.strip() for cell in header), lines=tuple(records))


def write_csv(header: Sequence[str], records: Iterable[Sequence[str]]) -> str:
    """Write cells as CSV text, each quoted where a reader could change it otherwise."""
    return "".join(",".join(_cell(cell) for cell in record) + "\n" for record in (header, *records))


def _cell(text: str) -> str:
    # Not csv.writer: before Python 3.13 it leaves a carriage return unquoted, which reads back as a line's end.
    return '"' + text.replace('"', '""') + '"' if _NEEDS_QUOTES.search(text) else text


def _decode(data: bytes, name: str) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise InvalidRows(f"{name} is UTF-16, expected UTF-8; save it again as 'CSV UTF-8'")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise InvalidRows(
            f"{name} is not UTF-8: byte {error.start} (line {line}) is 0x{data[error.start]:02X}; save it again as "
            "'CSV UTF-8', or convert it with `iconv -f WINDOWS-1252 -t UTF-8`"
        ) from error


def _split(text: str, name: str) -> list[tuple[int, tuple[str, ...]]]:
    previous_limit = csv.field_size_limit(_LARGEST_CELL)
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    lines = []
    begin = 1
    try:
        for cells in reader:
            if cells:
                lines.append((begin, tuple(cells)))
            begin = reader.line_num + 1
    except csv.Error as error:
        raise _one_problem(
            name, begin, str(error), "CSV", "does every cell that opens with a double quote close with one?"
        ) from error
    finally:
        csv.field_size_limit(previous_limit)
    return lines


def _one_problem(name: str, line: int, value: str, expected: str, remedy: str) -> InvalidRows:
    problem = Problem(place=f"{name}, line {line}", value=value, expected=expected, remedy=remedy)
    return InvalidRows(f"{name} cannot be read", [problem])
