"""From cells to records: what somebody wrote about each row, and what cannot be taken of it."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from actuator_select.database.cells import Refused, Value, quoted, read_value
from actuator_select.database.fields import Kind
from actuator_select.database.heading import Heading, read_heading
from actuator_select.database.suggestions import suggestion
from actuator_select.database.tables import ABSENT, Table
from actuator_select.errors import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """What somebody wrote about one row.

    Attributes
    ----------
    place : str
        File and line; empty for a row that is typed in.
    header : str
        File and line of the column names; empty for a row that is typed in.
    at : callable
        Place of one column, for messages.
    written : collection of str
        Columns that could be written: those of the table.
    given : mapping of str to value
        The values, without those that were refused.
    refused : collection of str
        Columns in which something was written that cannot be taken.
    mapping : str
        Name of the mapping that says what the columns fill; empty where they are the catalogue's own.
    id_from : str
        What the mapping makes the id of; empty where it is written.
    """

    place: str
    header: str
    at: Callable[[str], str]
    written: Collection[str]
    given: Mapping[str, Value]
    refused: Collection[str] = ()
    mapping: str = ""
    id_from: str = ""


def iter_records(heading: Heading) -> Iterator[tuple[int, Record | None, list[Problem]]]:
    """Read a table line by line.

    Parameters
    ----------
    heading : Heading
        What its columns mean.

    Yields
    ------
    int, Record or None, list of Problem
        Number of the line, the row without refused cells (None where the line is torn), and what is wrong with it.

    Raises
    ------
    InvalidRows
        Where the file cannot be read on.
    """
    table, readers = heading.table, heading.readers
    mapping = heading.mapping.name if heading.mapping is not None and heading.mapping.columns else ""
    width, header = len(table.header), table.header_place
    constants = {one.field.name: one.value for one in heading.constants}
    for number, cells in table.read_lines():
        if len(cells) != width:
            yield number, None, [_torn(table, number, len(cells))]
            continue
        given = dict(constants)
        problems: list[Problem] = []
        refused: list[str] = []
        for index, name, read in readers:
            cell = cells[index]
            if cell == "":
                given[name] = None
            elif cell is not ABSENT:
                try:
                    given[name] = read(cell)
                except Refused as objection:
                    problems.append(objection.at(table.cell_place(number, index), cell))
                    refused.append(name)
        if heading.mapping is not None and heading.mapping.id_from:
            _make_id(heading.mapping.id_from, given, refused)
        yield (
            number,
            Record(
                place=table.line_place(number),
                header=header,
                at=partial(heading.place, number),
                written=heading.written,
                given=given,
                refused=refused,
                mapping=mapping,
                id_from="" if heading.mapping is None else heading.mapping.id_from,
            ),
            problems,
        )


def read_records(kind: Kind, table: Table) -> tuple[list[Record], list[Problem]]:
    """Check the header and every cell of a small table.

    Parameters
    ----------
    kind : Kind
        Of its rows.
    table : Table
        The table.

    Returns
    -------
    list of Record, list of Problem
        The rows, without refused cells, and what is wrong.
    """
    heading, problems = read_heading(kind, table)
    records = []
    for _, record, more in iter_records(heading):
        problems += more
        if record is not None:
            records.append(record)
    return records, problems


def read_record(kind: Kind, values: Mapping[str, object], prefix: str = "") -> tuple[Record, list[Problem]]:
    """Check the values of one row that is typed in.

    Parameters
    ----------
    kind : Kind
        Of the row.
    values : mapping of str to object
        Numbers or texts by column name.
    prefix : str, optional
        What stands before the column names in messages.

    Returns
    -------
    Record, list of Problem
        The row, without refused values, and what is wrong.
    """
    spellings = kind.spellings
    spelt = {spellings[name].name: name for name in reversed(list(values)) if name in spellings}
    problems = []
    given: dict[str, Value] = {}
    for name, value in values.items():
        if name in spellings and spelt[spellings[name].name] != name:
            # The first one stands, and the second is objected to.
            remedy = f"it is {spellings[name].name} again"
            problems.append(
                Problem(place=f"{prefix}{name}", value=quoted(value), expected="each column once", remedy=remedy)
            )
            continue
        if name not in spellings:
            expected = f"a column of {kind.name}"
            remedy = suggestion(name, list(spellings), f"catalog fields {kind.name}")
            problems.append(Problem(place=f"{prefix}{name}", value=quoted(value), expected=expected, remedy=remedy))
            continue
        try:
            given[spellings[name].name] = read_value(spellings[name], value)
        except Refused as refused:
            problems.append(refused.at(f"{prefix}{spelt[spellings[name].name]}", value))

    def at(column: str) -> str:
        return f"{prefix}{spelt.get(column, column)}"

    return Record(place=prefix, header="", at=at, written=spelt, given=given, refused=set(spelt) - set(given)), problems


def _make_id(template: str, given: dict[str, Value], refused: list[str]) -> None:
    from actuator_select.database.translation import id_from

    made = id_from(template, given)
    if made:
        given["id"] = made
    else:
        refused.append("id")  # the columns that it is made of are objected to


def _torn(table: Table, number: int, cells: int) -> Problem:
    return Problem(
        place=table.line_place(number),
        value=f"{cells} cells",
        expected=f"{len(table.header)} cells, as many as the header",
        remedy=table.on_torn,
    )


def places_of(records: Iterable[Record], column: str) -> Iterator[tuple[int, str, Record]]:
    """Index, text and record where a record fills a column with a text."""
    for index, record in enumerate(records):
        value = record.given.get(column)
        if isinstance(value, str):
            yield index, value, record
