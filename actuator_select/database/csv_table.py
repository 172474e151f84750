"""CSV files: bytes to numbered lines of cells, and cells to text that reads back exactly."""

import codecs
import csv
import io
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import BinaryIO

from actuator_select.database.cells import quoted
from actuator_select.database.tables import Line, Table
from actuator_select.errors import InvalidRows, Problem

_LARGEST_CELL = 1_000_000  # characters; beyond it a quotation mark is missing rather than a note long
_SIGNS = {",": "comma", ";": "semicolon", "\t": "tabulator"}
_NEEDS_QUOTES = re.compile(r'[",\r\n]|^\s|\s$')
_BLOCK = 1 << 20  # bytes that are looked at together

SEMICOLONS = (
    'replace the semicolons by commas, or import it with a mapping that states [csv] delimiter = ";" (--mapping)'
)
"""What to do with a file whose cells are separated by semicolons."""
_TABS = SEMICOLONS.replace("semicolons", "tabs").replace('";"', '"\\t"')
_MAGIC = {
    b"SQLite format 3\0": "an SQLite database; export it first if it is a catalogue (catalog export --database)",
    b"PK\x03\x04": "a workbook or an archive; a workbook's name ends in .xlsx, an archive has to be unpacked first",
    b"\xd0\xcf\x11\xe0": "an old workbook; save it as .xlsx or 'CSV UTF-8'",
    b"%PDF": "a PDF document; type its tables into a CSV file",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class CsvFormat:
    """How a CSV file is written.

    Attributes
    ----------
    delimiter : str or None
        What separates cells; None is a comma, and a semicolon is noticed and objected to.
    encoding : str
        As Python calls it; ``utf-8-sig`` is UTF-8 with or without a byte order mark.
    header : bool
        Whether the first line names the columns; where it does not, they are called 1, 2, 3 and so on.
    """

    delimiter: str | None = None
    encoding: str = "utf-8-sig"
    header: bool = True


def read_csv(path: Path, form: CsvFormat | None = None) -> Table:
    """Read the header of a CSV file, and look over the rest.

    Parameters
    ----------
    path : Path
        The file.
    form : CsvFormat, optional
        How it is written; UTF-8 with commas and a header by default.

    Returns
    -------
    Table
        Header and lines; blank lines are left out.

    Raises
    ------
    InvalidRows
        If it cannot be read, is in another encoding, or is empty.
    """
    form = form or CsvFormat()
    try:
        opened = _opener(path)
        length = _look_over(opened, path.name, form.encoding)
    except OSError as error:
        raise InvalidRows(f"cannot read {path}: {error.strerror or error}; check the name of the file") from error
    first = next(_records(opened, path.name, form, form.delimiter or ","), None)
    if first is None:
        raise InvalidRows(
            f"{path.name} is empty; its first line names the columns, `actuator-select catalog fields KIND` lists them"
        )
    number, cells = first
    delimiter, problems = form.delimiter or ",", []
    if form.delimiter is None and len(cells) == 1 and ";" in cells[0]:
        delimiter = ";"
        problems.append(_problem(path.name, number, f"'{cells[0]}'", "cells separated by commas", SEMICOLONS))
        number, cells = next(_records(opened, path.name, form, delimiter))
    elif form.delimiter is None and len(cells) == 1 and "\t" in cells[0]:
        delimiter = "\t"
        problems.append(_problem(path.name, number, quoted(cells[0]), "cells separated by commas", _TABS))
        number, cells = next(_records(opened, path.name, form, delimiter))
    below = partial(_below, partial(_records, opened, path.name, form, delimiter), number if form.header else 0)
    sign = _SIGNS.get(delimiter, delimiter)
    return Table(
        name=path.name,
        title=path.stem,
        header=tuple(cell.strip() for cell in cells) if form.header else tuple(map(str, range(1, len(cells) + 1))),
        read_lines=below,
        length=length - (number if form.header else 0),
        numbered_from=number if form.header else 0,
        on_torn=f"is a {sign} missing or too many? A cell that holds a {sign} stands in double quotes",
        problems=tuple(problems),
    )


def write_csv(header: Sequence[str], records: Iterable[Sequence[str]]) -> str:
    """Write cells as CSV text, each quoted where a reader could change it otherwise."""
    return "".join(",".join(_cell(cell) for cell in record) + "\n" for record in (header, *records))


def _cell(text: str) -> str:
    # Not csv.writer: before Python 3.13 it leaves a carriage return unquoted, which reads back as a line's end.
    return '"' + text.replace('"', '""') + '"' if _NEEDS_QUOTES.search(text) else text


def _opener(path: Path) -> Callable[[], BinaryIO]:
    """How to open the file again and again; what is no file, such as a pipe, can be read only once."""
    if path.exists() and not path.is_file() and not path.is_dir():
        return partial(io.BytesIO, path.read_bytes())
    return lambda: path.open("rb")


def _look_over(opened: Callable[[], BinaryIO], name: str, encoding: str) -> int:
    """Number of lines of a file that is in the stated encoding throughout."""
    decoder = codecs.getincrementaldecoder(encoding)()
    lines = seen = 0
    block = b""
    with opened() as file:
        while following := file.read(_BLOCK):
            if not seen and (what := next((what for begin, what in _MAGIC.items() if following.startswith(begin)), "")):
                raise InvalidRows(f"{name} is no CSV file but {what}")
            if not seen and encoding.startswith("utf-8") and following.startswith((b"\xff\xfe", b"\xfe\xff")):
                raise InvalidRows(f"{name} is UTF-16, expected UTF-8; save it again as 'CSV UTF-8'")
            _try(decoder, following, name, encoding, (seen, lines))
            lines += following.count(b"\n")
            seen += len(following)
            block = following
    _try(decoder, b"", name, encoding, (seen, lines))
    return lines + (bool(block) and not block.endswith(b"\n"))


def _try(decoder: codecs.IncrementalDecoder, block: bytes, name: str, encoding: str, before: tuple[int, int]) -> None:
    """Decode the next block of a file, before which there are so many bytes and lines."""
    pending = len(decoder.getstate()[0])
    try:
        decoder.decode(block, final=not block)
    except UnicodeDecodeError as error:
        at = before[0] - pending + error.start
        line = before[1] + error.object[: error.start].count(b"\n") + 1
        utf_8 = encoding.startswith("utf-8")
        if utf_8 and b"\0" in error.object:
            raise InvalidRows(f"{name} is no text but a binary file; save the table as 'CSV UTF-8'") from error
        remedy = (
            "save it again as 'CSV UTF-8', or convert it with `iconv -f WINDOWS-1252 -t UTF-8`"
            if utf_8
            else "state its encoding in the mapping's [csv]"
        )
        raise InvalidRows(
            f"{name} is not {'UTF-8' if utf_8 else encoding}: byte {at} (line {line}) is "
            f"0x{error.object[error.start]:02X}; {remedy}"
        ) from error


def _records(
    opened: Callable[[], BinaryIO], name: str, form: CsvFormat, delimiter: str
) -> Iterator[tuple[int, list[str]]]:
    """Records that are not blank, and the numbers of the lines on which they begin."""
    previous_limit = csv.field_size_limit(_LARGEST_CELL)
    begin = 1
    try:
        with io.TextIOWrapper(opened(), encoding=form.encoding, newline="") as text:
            reader = csv.reader(text, delimiter=delimiter, strict=True)
            for cells in reader:
                if cells:
                    yield begin, cells
                begin = reader.line_num + 1
    except csv.Error as error:
        remedy = "does every cell that opens with a double quote close with one?"
        raise InvalidRows(f"{name} cannot be read", [_problem(name, begin, str(error), "CSV", remedy)]) from error
    finally:
        csv.field_size_limit(previous_limit)


def _below(records: Callable[[], Iterator[tuple[int, list[str]]]], header: int) -> Iterator[Line]:
    return (record for record in records() if record[0] > header)


def _problem(name: str, line: int, value: str, expected: str, remedy: str) -> Problem:
    return Problem(place=f"{name}, line {line}", value=value, expected=expected, remedy=remedy)
