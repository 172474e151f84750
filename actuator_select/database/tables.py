"""What every format is read as: a table with a name, a header and numbered lines of cells that come one by one."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from actuator_select.database.cells import Reader
from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import KINDS
from actuator_select.database.opc import opc_name
from actuator_select.errors import Problem, UnknownName

Line: TypeAlias = tuple[int, Sequence[object]]
"""Number of a line, and its cells."""

_NAMES_OF_KEYS = {"key", "id", "motor", "gearbox", "source_id", "motor_pattern", "gearbox_pattern"}

ABSENT = object()
"""Stands in place of a cell where a line says nothing of a column, which is not the same as an empty cell."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Rows as somebody wrote them.

    Attributes
    ----------
    name : str
        Of the file, with its sheet or list, for messages: ``motors.csv``.
    title : str
        What may tell the kind of its rows: ``motors``.
    header : tuple of str
        Names of the columns.
    read_lines : callable
        Begins anew to read the lines below the header, one by one. It raises `InvalidRows` where it cannot go on.
    length : int
        Number of lines, about, for progress.
    numbered_from : int
        Number of the line that holds the header; lines below have greater ones.
    unit_of_lines : str
        What a line is called: ``line`` or ``row``.
    cell_name : callable or None
        Says what a cell is called in the file, from its line and the index of its column: ``cell B7``.
    adapt : callable or None
        Makes a reader of texts and numbers read what stands in the format's cells besides, such as dates.
    on_torn : str
        What to do with a line that has fewer or more cells than the header.
    knows_opc : bool
        Whether columns may also have their names of OPC 40400-1.
    problems : tuple of Problem
        What is wrong with the file as a whole although its lines can be read.
    notices : callable or None
        Says what to mind, once the lines have been read.
    """

    name: str
    title: str
    header: tuple[str, ...]
    read_lines: Callable[[], Iterator[Line]]
    length: int
    numbered_from: int = 1
    unit_of_lines: str = "line"
    cell_name: Callable[[int, int], str] | None = None
    adapt: Callable[[Field, Reader], Reader] | None = None
    on_torn: str = ""
    knows_opc: bool = False
    problems: tuple[Problem, ...] = field(default=())
    notices: Callable[[], tuple[str, ...]] | None = None

    @property
    def header_place(self) -> str:
        """Place of the names of the columns, for messages."""
        return self.line_place(self.numbered_from) if self.numbered_from else self.name

    def line_place(self, number: int) -> str:
        """Place of a line, for messages."""
        return f"{self.name}, {self.unit_of_lines} {number}"

    def cell_place(self, number: int, index: int) -> str:
        """Place of a cell, for messages."""
        place = self.line_place(number) if self.cell_name is None else f"{self.name}, {self.cell_name(number, index)}"
        name = self.header[index]
        return f"{place}, column {name}" if name.isdecimal() else f"{place}, {name}"

    def spellings(self, kind: Kind) -> dict[str, Field]:
        """Columns of a kind by what they may be called in this table."""
        if not self.knows_opc:
            return kind.spellings
        return {opc_name(kind, field.name): field for field in kind.fields} | kind.spellings


def kind_named(title: str) -> str | None:
    """Kind that a file, a sheet or a list is named after; None if after none."""
    title = title.strip().casefold()
    return next((kind.name for kind in KINDS.values() if title in {kind.name, kind.singular}), None)


def kind_of(table: Table) -> str:
    """Kind of the rows of a table, told by its name, else by its header.

    Raises
    ------
    UnknownName
        If none can be told.
    """
    if named := kind_named(table.title):
        return named
    fitting = [one.name for one in KINDS.values() if set(table.header) <= set(table.spellings(one))]
    if len(fitting) != 1:
        raise UnknownName(
            f"cannot tell whether {table.name} holds {' or '.join(fitting or KINDS)}; state it with --kind"
        )
    return fitting[0]


def one_to_many(table: Table) -> Table:
    """Turn lines of a key and any number of others into pairs.

    Parameters
    ----------
    table : Table
        Its lines may differ in length; empty cells are passed over.

    Returns
    -------
    Table
        With the columns ``1`` and ``2``: the key, and one of the others.
    """
    alone: set[int] = set()

    def read_lines() -> Iterator[Line]:
        for number, (key, *others) in table.read_lines():
            found = [other for other in others if other not in {None, ""}]
            if not found:
                alone.add(number)
            yield from ((number, (key, other)) for other in found)

    def notices() -> tuple[str, ...]:
        count = f"{len(alone)} {table.unit_of_lines}{'s' if len(alone) > 1 else ''}"
        return (f"passed over: {count} of {table.name} with a key and nothing that belongs to it",) if alone else ()

    problems = (*table.problems, *_names_among_pairs(table))
    return replace(table, header=("1", "2"), read_lines=read_lines, problems=problems, notices=notices)


def _names_among_pairs(table: Table) -> Iterator[Problem]:
    """Objection to a first line that names columns, as other files of the same people do."""
    number, cells = next(table.read_lines(), (0, ()))
    name = next((cell for cell in cells if str(cell).strip().casefold() in _NAMES_OF_KEYS), None)
    if name is not None:
        yield Problem(
            place=table.line_place(number),
            value=f"the name of a column, '{name}'",
            expected="a key and those that belong to it, from the first line on",
            remedy="take the mapping for such a file, or remove the line of names",
        )
