"""Sheets of XLSX workbooks as tables: the values that the spreadsheet program shows, read row by row."""

import re
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import date, datetime, time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from actuator_select.database.cells import Reader, Refused, Value
from actuator_select.database.fields import Field
from actuator_select.database.suggestions import first_of
from actuator_select.database.tables import Line, Table
from actuator_select.database.workbook_text import unescape_text
from actuator_select.errors import InvalidRows, Problem

if TYPE_CHECKING:
    from openpyxl.worksheet._read_only import ReadOnlyWorksheet

_MERGED = re.compile(rb'<(?:\w+:)?mergeCell\s[^>]*?ref=["\']([A-Z]+\d+:[A-Z]+(\d+))["\']')
_LONGEST_TAG = 200  # bytes; a tag may lie across two blocks
_BLOCK = 1 << 20  # bytes that are looked at together
_BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, SyntaxError, KeyError, ValueError, TypeError, AttributeError)
# What openpyxl raises of a damaged file, or of a chart sheet without a chart.


@dataclass(frozen=True, slots=True)
class FailedCell:
    """A cell whose formula has no value.

    Attributes
    ----------
    shown : str
        What stands there: an error such as ``#DIV/0!``, or the formula.
    remedy : str
        What to do.
    """

    shown: str
    remedy: str

    def __str__(self) -> str:
        return self.shown


@contextmanager
def xlsx_tables(path: Path) -> Iterator[list[Table]]:
    """Open a workbook while its sheets are read.

    Parameters
    ----------
    path : Path
        The file.

    Yields
    ------
    list of Table
        Sheets that hold anything, in their order.

    Raises
    ------
    InvalidRows
        If it cannot be read.
    """
    from openpyxl import load_workbook
    from openpyxl.utils.exceptions import InvalidFileException

    try:
        shown = load_workbook(path, read_only=True, data_only=True)
        # Only a workbook with formulas is read twice, to tell an empty cell from one that was never calculated.
        formulas = load_workbook(path, read_only=True) if _has_formulas(path) else None
    except OSError as error:
        raise InvalidRows(f"cannot read {path}: {error.strerror or error}; check the name of the file") from error
    except (InvalidFileException, *_BROKEN) as error:
        raise InvalidRows(f"{path.name} is no XLSX workbook ({error}); save it again as .xlsx or CSV") from error
    try:
        tables = [
            _table(path, sheet, None if formulas is None else formulas[sheet.title]) for sheet in shown.worksheets
        ]
        yield [table for table in tables if table is not None]
    finally:
        shown.close()
        if formulas is not None:
            formulas.close()


def _table(path: Path, sheet: "ReadOnlyWorksheet", formulas: "ReadOnlyWorksheet | None") -> Table | None:
    length = sheet.max_row or 0
    for one in (sheet, formulas):
        if one is not None:
            one.reset_dimensions()  # other programs state them wrongly, and rows would be cut off
    first = next(_rows(sheet, formulas), None)
    if first is None:
        return None
    number, cells = first
    header = tuple("" if cell is None else str(cell).strip() for cell in cells)
    return Table(
        name=f"{path.name}, sheet {sheet.title}",
        title=sheet.title,
        header=header,
        read_lines=partial(_below, sheet, formulas, number, len(header)),
        length=max(0, length - number),
        numbered_from=number,
        unit_of_lines="row",
        cell_name=_cell_name,
        adapt=_adapt,
        problems=_merged_below(path, sheet, number),
        on_torn="empty the cells on the right of the named columns, or name theirs in the header",
    )


def _rows(sheet: "ReadOnlyWorksheet", formulas: "ReadOnlyWorksheet | None") -> Iterator[tuple[int, list[object]]]:
    """Numbers and cells of the rows that are not empty, without the empty cells at their end."""
    below = iter(()) if formulas is None else _values(formulas)
    for number, values in enumerate(_values(sheet), start=1):
        written: Sequence[Any] = next(below, ())
        end = len(values)
        while end and values[end - 1] is None and (end > len(written) or written[end - 1] is None):
            end -= 1
        if not end:
            continue
        cells: list[object] = list(values[:end])
        for index, value in enumerate(cells):
            if type(value) not in {float, int}:
                cells[index] = _plain(value, written[index] if index < len(written) else None)
        yield number, cells


def _values(sheet: Any) -> Iterator[tuple[Any, ...]]:  # noqa: ANN401 - its stubs leave out what it inherits
    try:
        yield from sheet.iter_rows(values_only=True)
    except _BROKEN as error:
        raise InvalidRows(f"the sheet {sheet.title} cannot be read ({error}); save the workbook again") from error


def _below(sheet: "ReadOnlyWorksheet", formulas: "ReadOnlyWorksheet | None", header: int, width: int) -> Iterator[Line]:
    for number, cells in _rows(sheet, formulas):
        if number > header:
            yield number, cells + [None] * (width - len(cells))


def _plain(value: object, formula: object) -> object:
    from openpyxl.cell.cell import ERROR_CODES

    if value is None and isinstance(formula, str) and formula.startswith("="):
        return FailedCell(formula, "the formula was never calculated: open the file, save it, and import it again")
    if isinstance(value, str) and value in ERROR_CODES:
        return FailedCell(value, "mend the formula, or leave the cell empty if the figure is unknown")
    if isinstance(value, datetime) and value.time() == time():
        return value.date()
    return unescape_text(value) if isinstance(value, str) else value


def _adapt(field: Field, read: Reader) -> Reader:
    def read_cell(value: object) -> Value:
        if isinstance(value, FailedCell):
            raise Refused(field.expected, value.remedy)
        if isinstance(value, date | time) and not field.is_text:
            raise Refused(field.expected, "the spreadsheet made a date of it; format the cell as a number and mend it")
        return read(_text_of(value) if field.is_text else value)

    return read_cell


def _text_of(value: object) -> object:
    """What stands for a text in a cell that a spreadsheet program made a number or a date of."""
    if isinstance(value, bool):
        return value
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    if isinstance(value, int | float):
        return str(value)
    return value.isoformat() if isinstance(value, date | time) else value


def _cell_name(number: int, index: int) -> str:
    from openpyxl.utils import get_column_letter

    return f"cell {get_column_letter(index + 1)}{number}"


def _merged_below(path: Path, sheet: Any, header: int) -> tuple[Problem, ...]:  # noqa: ANN401 - its stubs leave that out
    """Objection to merged cells, of which only the first holds what all of them show."""
    found: dict[str, None] = {}
    end = b""
    try:
        with sheet._get_source() as source:  # noqa: SLF001 - read row by row it has no other way to its merged cells
            while block := source.read(_BLOCK):
                met = _MERGED.findall(end + block)
                found |= {one.decode(): None for one, last_row in met if int(last_row) > header}
                end = block[-_LONGEST_TAG:]
    except _BROKEN as error:
        raise InvalidRows(f"the sheet {sheet.title} cannot be read ({error}); save the workbook again") from error
    if not found:
        return ()
    return (
        Problem(
            place=f"{path.name}, sheet {sheet.title}",
            value=f"merged cells {first_of(list(found))}",
            expected="every cell for itself below the header, because of merged cells only the first holds a value",
            remedy="unmerge them and fill every cell",
        ),
    )


def _has_formulas(path: Path) -> bool:
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            if name.startswith("xl/worksheets/") and name.endswith(".xml"):
                with archive.open(name) as sheet:
                    end = b""
                    while block := sheet.read(_BLOCK):
                        if b"<f>" in end + block or b"<f " in end + block:
                            return True
                        end = block[-2:]
    return False
