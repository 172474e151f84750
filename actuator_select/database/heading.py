"""What the columns of a table mean: which of ours each one fills, and how its cells are read."""

from collections.abc import Iterable, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import TYPE_CHECKING

from actuator_select.database.cells import Reader, Refused, Value, quoted, read_value, reader_of
from actuator_select.database.fields import Field, Kind
from actuator_select.database.suggestions import suggestion
from actuator_select.database.tables import Table
from actuator_select.errors import Problem

if TYPE_CHECKING:
    from actuator_select.database.mapping import Mapping as ColumnMapping


@dataclass(frozen=True, slots=True, kw_only=True)
class Constant:
    """A value that stands in every row, and where that was said."""

    field: Field
    value: Value
    place: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """What the columns of a table mean.

    Attributes
    ----------
    table : Table
        The table.
    kind : Kind
        Of its rows.
    readers : tuple of (int, str, callable)
        Index of a cell, our column that it fills, and what reads it.
    constants : tuple of Constant
        What stands in every row.
    mapping : Mapping or None
        What said so.
    spelt : mapping of str to int
        Index of the cell that fills one of our columns.
    written : frozenset of str
        Our columns that every row fills or leaves empty.
    """

    table: Table
    kind: Kind
    readers: tuple[tuple[int, str, Reader], ...]
    constants: tuple[Constant, ...] = ()
    mapping: "ColumnMapping | None" = None
    spelt: Mapping[str, int] = field(init=False)
    written: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "spelt", {name: index for index, name, _ in self.readers})
        names = {*self.spelt, *(one.field.name for one in self.constants)}
        if self.mapping is not None and self.mapping.id_from:
            names.add("id")
        object.__setattr__(self, "written", frozenset(names))

    def place(self, number: int, column: str) -> str:
        """Place of what fills one of our columns in a line, for messages."""
        if column in self.spelt:
            return self.table.cell_place(number, self.spelt[column])
        constant = next((one for one in self.constants if one.field.name == column), None)
        return f"{self.table.line_place(number)}, {column}" if constant is None else constant.place


def read_heading(
    kind: Kind, table: Table, mapping: "ColumnMapping | None" = None, source: str | None = None
) -> tuple[Heading, list[Problem]]:
    """Find out what the columns of a table mean.

    Parameters
    ----------
    kind : Kind
        Of its rows.
    table : Table
        The table.
    mapping : Mapping, optional
        What says so; names of our columns mean themselves by default.
    source : str, optional
        Source of every row.

    Returns
    -------
    Heading, list of Problem
        What was understood, and what was not.
    """
    constants, problems = _constants(kind, mapping, source)
    if mapping is None or not mapping.columns:
        targets, more = _own_columns(kind, table, mapping)
        names = set(table.spellings(kind))
    else:
        targets, more = _mapped_columns(kind, table, mapping)
        names = set(mapping.columns)
    if not targets and (lower := _names_below(table, names)) is not None:
        more, table = [lower], replace(table, read_lines=lambda: iter(()))  # its rows would be refused one by one
    problems += more
    taken = {field.name for _, field, _ in targets}
    problems += [
        Problem(
            place=one.place,
            value=quoted(one.value),
            expected=f"a field that no column of {table.name} fills",
            remedy="drop one of the two",
        )
        for one in constants
        if one.field.name in taken
    ]
    adapt = table.adapt or (lambda _, read: read)
    readers = tuple((index, field.name, adapt(field, read)) for index, field, read in targets)
    return Heading(table=table, kind=kind, readers=readers, constants=constants, mapping=mapping), [
        *table.problems,
        *problems,
    ]


def _names_below(table: Table, names: AbstractSet[str]) -> Problem | None:
    """Objection to a title that stands above the names of the columns."""
    for number, cells in islice(table.read_lines(), _SEARCHED_LINES):
        if len(names & {str(cell).strip() for cell in cells}) >= _ENOUGH_NAMES:
            return Problem(
                place=table.header_place,
                value=quoted(table.header[0]),
                expected=f"the names of the columns, which stand in {table.unit_of_lines} {number}",
                remedy=f"remove the {table.unit_of_lines}s above them",
            )
    return None


_SEARCHED_LINES = 10  # below the first; titles are shorter
_ENOUGH_NAMES = 2  # of columns, in one line
_Targets = list[tuple[int, Field, Reader]]


def _constants(
    kind: Kind, mapping: "ColumnMapping | None", source: str | None
) -> tuple[tuple[Constant, ...], list[Problem]]:
    stated: Iterable[tuple[str, object, str]] = ()
    if mapping is not None:
        stated = ((name, value, f"{mapping.name}, constants.{name}") for name, value in mapping.constants.items())
    if source is not None and "source_id" in kind.spellings:
        stated = (*(one for one in stated if one[0] != "source_id"), ("source_id", source, "--source"))
    constants, problems = [], []
    for name, value, place in stated:
        field = kind.spellings[name]
        try:
            constants.append(Constant(field=field, value=read_value(field, value), place=place))
        except Refused as refused:
            problems.append(refused.at(place, value))
    return tuple(constants), problems


def _own_columns(kind: Kind, table: Table, mapping: "ColumnMapping | None") -> tuple[_Targets, list[Problem]]:
    spellings = table.spellings(kind)
    targets: _Targets = []
    problems = []
    met = set()
    for index, name in enumerate(table.header):
        field = spellings.get(name)
        if field is None:
            expected = f"a column of {kind.name}"
            remedy = suggestion(name, list(spellings), f"catalog fields {kind.name}")
            problems.append(Problem(place=table.header_place, value=quoted(name), expected=expected, remedy=remedy))
        elif field.name in met:
            remedy = f"it is {field.name} again"
            problems.append(
                Problem(place=table.header_place, value=quoted(name), expected="each column once", remedy=remedy)
            )
        else:
            met.add(field.name)
            targets.append((index, field, reader_of(field) if mapping is None else _plain_translator(field, mapping)))
    return targets, problems


def _plain_translator(field: Field, mapping: "ColumnMapping") -> Reader:
    from actuator_select.database.mapping import Filling
    from actuator_select.database.translation import translator

    return translator(field, Filling(field=field.name, unit=None if field.is_text else field.unit), mapping)


def _mapped_columns(kind: Kind, table: Table, mapping: "ColumnMapping") -> tuple[_Targets, list[Problem]]:
    from actuator_select.database.translation import translator

    spellings = kind.spellings
    targets: _Targets = []
    problems = []
    for index, name in enumerate(table.header):
        if name not in mapping.columns:
            if not mapping.ignore_others:
                problems.append(_unmapped(table, name, mapping))
            continue
        if table.header.index(name) != index:
            problems.append(Problem(place=table.header_place, value=quoted(name), expected="each column once"))
            continue
        for filling in mapping.columns[name]:
            if not filling.ignore:
                field = spellings[filling.field]
                targets.append((index, field, translator(field, filling, mapping)))
    absent = [name for name in mapping.columns if name not in table.header]
    if mapping.ignore_others or not targets:
        # A misspelt column would otherwise be passed over unseen.
        problems += [
            Problem(
                place=table.header_place,
                value=f"there is no column {name!r}",
                expected=f"the columns that {mapping.name} names",
                remedy="is it spelt as in the file, and is the delimiter right?",
            )
            for name in absent
        ]
    return targets, problems


def _unmapped(table: Table, name: str, mapping: "ColumnMapping") -> Problem:
    return Problem(
        place=table.header_place,
        value=quoted(name),
        expected=f"a column that the mapping {mapping.name} names",
        remedy=f'say there what it fills, or pass it over with "{name}" = {{ ignore = true }}{mapping.copy_hint}',
    )
