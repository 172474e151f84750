"""Rows as an XLSX workbook, a sheet for each kind, written row by row."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, BinaryIO

from actuator_select.database.cells import UNLIMITED, Value, quoted, write_value
from actuator_select.database.export import KindRows
from actuator_select.database.fields import Field, Kind
from actuator_select.database.workbook_text import escape_text
from actuator_select.errors import InvalidRows, Problem

if TYPE_CHECKING:
    from openpyxl.cell.cell import Cell
    from openpyxl.worksheet._write_only import WriteOnlyWorksheet

LARGEST_CELL = 32_767  # UTF-16 units in a cell of XLSX; openpyxl would cut off the rest
_SURELY_FITS = LARGEST_CELL // 2  # characters, of at most two units each
MOST_ROWS = 1_048_575  # of a sheet, below its header
_TEXT_FORMAT = "@"  # a text that is edited in a spreadsheet stays one
_WIDTHS = {"id": 30.0, "name": 30.0, "description": 40.0, "document": 50.0, "notes": 50.0}  # in characters
_OTHER_WIDTHS = {True: 20.0, False: 14.0}  # texts, figures


def write_workbook(file: BinaryIO, kinds: Sequence[KindRows]) -> None:
    """Write a workbook: a sheet named by each kind, the header of column names frozen.

    Numbers are exact, texts are texts whatever they look like, unknown figures empty cells, unlimited ones the word.

    Parameters
    ----------
    file : binary file
        To write to.
    kinds : sequence of (Kind, iterable of mapping)
        Kinds with their rows, values by column.

    Raises
    ------
    InvalidRows
        If a text is longer than a cell or a kind longer than a sheet.
    """
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    book.properties.creator = "actuator-select"
    try:
        for kind, rows in kinds:
            _fill(book.create_sheet(kind.name), kind, rows)
    except BaseException:
        for sheet in book.worksheets:  # each holds a temporary file open
            if not sheet.closed:
                sheet.close()
        raise
    book.save(file)


def _fill(sheet: "WriteOnlyWorksheet", kind: Kind, rows: Iterable[Mapping[str, Value]]) -> None:
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.styles import Font
    from openpyxl.utils import get_column_letter

    sheet.freeze_panes = "B2"
    for number, field in enumerate(kind.fields, start=1):
        column = sheet.column_dimensions[get_column_letter(number)]  # type: ignore[attr-defined]
        column.width = max(_WIDTHS.get(field.name, _OTHER_WIDTHS[field.is_text]), len(field.name) + 2.0)
        if field.is_text:
            column.number_format = _TEXT_FORMAT
    header = [WriteOnlyCell(sheet, value=field.name) for field in kind.fields]
    for cell in header:
        cell.font = Font(bold=True)
    sheet.append(header)
    cells = [WriteOnlyCell(sheet) for _ in kind.fields]  # written at once, and used again for the next row
    for cell, field in zip(cells, kind.fields, strict=True):
        if field.is_text:
            cell.number_format = _TEXT_FORMAT
    for number, row in enumerate(rows):
        if number == MOST_ROWS:
            raise InvalidRows(f"{kind.name} are more than the {MOST_ROWS} that a sheet holds; export CSV or JSON")
        sheet.append([_filled(cell, kind, field, row) for cell, field in zip(cells, kind.fields, strict=True)])


def _filled(cell: "Cell", kind: Kind, field: Field, row: Mapping[str, Value]) -> "Cell | None":
    """Put a row's value into the cell of its column; None where it is unknown."""
    value = row[field.name]
    if value is None:
        return None
    text = escape_text(value) if isinstance(value, str) else write_value(value)
    if len(text) > _SURELY_FITS and len(text.encode("utf-16-le")) > 2 * LARGEST_CELL:
        place = f"{kind.singular} {row['id']}, {field.name}"
        expected = f"at most {LARGEST_CELL} characters, which is all that a cell of an XLSX file holds"
        problem = Problem(place=place, value=quoted(value), expected=expected, remedy="export CSV or JSON")
        raise InvalidRows("the XLSX file was not written", [problem])
    cell.value = text
    # Stated, not guessed: '=1+1' and '#N/A' are texts. A number is given by its digits, since openpyxl rounds floats.
    cell.data_type = "s" if isinstance(value, str) or text == UNLIMITED else "n"
    return cell
