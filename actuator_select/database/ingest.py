"""From cells to checked rows: all or nothing, and every objection at once."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath

import sqlalchemy as sa

from actuator_select.database import history, queries
from actuator_select.database.cells import Refused, Value, check_row, quoted, read_value, write_value
from actuator_select.database.content import row_digest
from actuator_select.database.csv_table import CsvTable
from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.errors import InvalidRows, Problem, UnknownName, did_you_mean

Progress = Callable[[int, int], None]

_LINES_PER_REPORT = 100  # of progress
_LISTED_NAMES = 12  # more names than these are not listed in a message


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """What somebody wrote about one row.

    Attributes
    ----------
    place : str
        What stands before a column's name in messages: file and line.
    header : str
        File and line of the column names; empty for a row that is typed in.
    spelt : mapping of str to str
        The columns that were written, and how they are spelt.
    given : mapping of str to value
        Their values, without those that were refused.
    """

    place: str
    header: str
    spelt: Mapping[str, str]
    given: Mapping[str, Value]

    def at(self, column: str) -> str:
        """Place of one column, for messages."""
        return f"{self.place}{self.spelt.get(column, column)}"

    def was_refused(self, column: str) -> bool:
        """Whether something was written there that cannot be taken."""
        return column in self.spelt and column not in self.given


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What taking records in means for the database.

    Attributes
    ----------
    added, updated : tuple of rows
        Complete rows to be written.
    unchanged : int
        How many rows are there already, equal.
    """

    added: tuple[queries.Row, ...]
    updated: tuple[queries.Row, ...]
    unchanged: int


def find_kind_of(table: CsvTable, kind: str | None) -> Kind:
    """Kind of the rows in a CSV file: as stated, else by the file's name, else by its header.

    Parameters
    ----------
    table : CsvTable
        The file.
    kind : str or None
        As stated.

    Returns
    -------
    Kind
        The kind.

    Raises
    ------
    UnknownName
        If no such kind exists or none can be told.
    """
    if kind is not None:
        return find_kind(kind)
    stem = PurePath(table.name).stem.casefold()
    named = [one for one in KINDS.values() if stem in {one.name, one.singular}]
    fitting = named or [one for one in KINDS.values() if set(table.header) <= set(one.spellings)]
    if len(fitting) != 1:
        among = fitting or KINDS.values()
        raise UnknownName(
            f"cannot tell whether {table.name} holds {' or '.join(one.name for one in among)}; state it with --kind"
        )
    return fitting[0]


def read_records(kind: Kind, table: CsvTable, progress: Progress | None = None) -> tuple[list[Record], list[Problem]]:
    """Check the header and every cell of a CSV file.

    Parameters
    ----------
    kind : Kind
        Of its rows.
    table : CsvTable
        The file.
    progress : callable, optional
        Told (done, total) lines.

    Returns
    -------
    list of Record, list of Problem
        The rows, without refused cells, and what is wrong.
    """
    fields, problems = _read_header(kind, table)
    spelt = {field.name: name for field, name in zip(fields, table.header, strict=True) if field}
    records = []
    for done, (number, cells) in enumerate(table.lines, start=1):
        pairs = [(field, cell) for field, cell in zip(fields, cells, strict=True) if field]
        record = Record(place=f"{table.name}, line {number}, ", header=f"{table.name}, line 1", spelt=spelt, given={})
        record, refused = _fill(record, pairs)
        records.append(record)
        problems += refused
        if progress is not None and (done % _LINES_PER_REPORT == 0 or done == len(table.lines)):
            progress(done, len(table.lines))
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
    pairs, problems = [], []
    for name, value in values.items():
        if name in spellings:
            pairs.append((spellings[name], value))
        else:
            problems.append(
                Problem(
                    place=f"{prefix}{name}",
                    value=quoted(value),
                    expected=f"a column of {kind.name}",
                    remedy=_suggestion(name, list(spellings), f"catalog fields {kind.name}"),
                )
            )
    spelt = {spellings[name].name: name for name in values if name in spellings}
    record, refused = _fill(Record(place=prefix, header="", spelt=spelt, given={}), pairs)
    return record, problems + refused


def plan_rows(
    connection: sa.Connection, kind: Kind, records: Sequence[Record], *, update: bool
) -> tuple[Plan, list[Problem]]:
    """Compare records with the database.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        In the transaction that will write the rows.
    kind : Kind
        Of the rows.
    records : sequence of Record
        What was written.
    update : bool
        Whether rows that exist may be changed; their columns that were left out keep their values.

    Returns
    -------
    Plan, list of Problem
        What to write if there is no problem.
    """
    problems = _repeated(records, "id")
    existing = queries.fetch_own_rows(
        connection, kind, [str(record.given["id"]) for record in records if _has_id(record)]
    )
    added: list[queries.Row] = []
    updated: list[queries.Row] = []
    for record in records:
        before = existing.get(str(record.given.get("id")))
        blank: queries.Row = {field.name: None for field in kind.fields}
        row = (blank if before is None else before) | dict(record.given)
        changed = before is None or row_digest(kind, row) != row_digest(kind, before)
        if changed:
            (added if before is None else updated).append(row)
        if changed and before is not None and not update:
            problems.append(_exists(kind, record, row, before))
        problems += _row_problems(kind, record, row)
    problems += _check_references(connection, kind, records)
    for field in kind.fields:
        if field.unique:
            problems += _repeated(records, field.name) + _taken(connection, kind, field.name, records)
    return Plan(
        added=tuple(added), updated=tuple(updated), unchanged=len(records) - len(added) - len(updated)
    ), problems


def refuse(heading: str, problems: Sequence[Problem]) -> None:
    """Raise `InvalidRows` if there are problems, each told once and in the order of the lines."""
    if problems:
        raise InvalidRows(heading, sorted(dict.fromkeys(problems), key=_line))


def write_plan(connection: sa.Connection, kind: Kind, plan: Plan, *, by: str) -> None:
    """Write what was planned; `by` says by what, for the history."""
    history.add_rows(connection, kind, plan.added, by=by)
    history.change_rows(connection, kind, plan.updated, by=by)


def _fill(record: Record, pairs: Sequence[tuple[Field, object]]) -> tuple[Record, list[Problem]]:
    given: dict[str, Value] = {}
    problems = []
    for field, value in pairs:
        try:
            given[field.name] = read_value(field, value)
        except Refused as refused:
            problems.append(refused.at(record.at(field.name), value))
    return replace(record, given=given), problems


def _row_problems(kind: Kind, record: Record, row: queries.Row) -> list[Problem]:
    problems = []
    for column, refused in check_row(kind, row):
        group = next((names for names in kind.any_of if column in names), (column,))
        if any(record.was_refused(name) for name in group):
            continue
        if record.header and kind.field(column).required and column not in record.spelt:
            # Told once, not for every line.
            value, remedy = f"there is no column {column!r}", "add the column"
            problems.append(Problem(place=record.header, value=value, expected=refused.expected, remedy=remedy))
        else:
            problems.append(refused.at(record.at(column), row.get(column)))
    return problems


def _line(problem: Problem) -> int:
    found = re.search(r", line (\d+)", problem.place)
    return int(found[1]) if found else 0


def _has_id(record: Record) -> bool:
    return record.given.get("id") is not None


def _read_header(kind: Kind, table: CsvTable) -> tuple[list[Field | None], list[Problem]]:
    spellings = kind.spellings
    fields: list[Field | None] = []
    problems = []
    place = f"{table.name}, line 1"
    for name in table.header:
        field = spellings.get(name)
        if field is None:
            expected = f"a column of {kind.name}"
            remedy = _suggestion(name, list(spellings), f"catalog fields {kind.name}")
            problems.append(Problem(place=place, value=quoted(name), expected=expected, remedy=remedy))
        elif field in fields:
            problems.append(
                Problem(
                    place=place, value=quoted(name), expected="each column once", remedy=f"it is {field.name} again"
                )
            )
            field = None
        fields.append(field)
    return fields, problems


def _repeated(records: Sequence[Record], column: str) -> list[Problem]:
    first: dict[Value, str] = {}
    problems = []
    for record in records:
        value = record.given.get(column)
        if value is None:
            continue
        if value in first:
            expected = f"another {column} than {first[value]}"
            problems.append(
                Problem(place=record.at(column), value=quoted(value), expected=expected, remedy="remove or rename one")
            )
        first.setdefault(value, record.place.removesuffix(", "))
    return problems


def _taken(connection: sa.Connection, kind: Kind, column: str, records: Sequence[Record]) -> list[Problem]:
    holders = {value: row_id for row_id, value in queries.fetch_values(connection, kind, column).items()}
    return [
        Problem(
            place=record.at(column),
            value=quoted(value),
            expected=f"another {column} than {kind.singular} {holders[value]!r} of the catalogue",
            remedy="choose another",
        )
        for record in records
        if isinstance(value := record.given.get(column), str)
        and holders.get(value) not in {None, record.given.get("id")}
    ]


def _exists(kind: Kind, record: Record, row: queries.Row, before: queries.Row) -> Problem:
    differing = [field.name for field in kind.fields if row.get(field.name) != before.get(field.name)]
    column = differing[0]
    others = f" and {len(differing) - 1} more" if len(differing) > 1 else ""
    return Problem(
        place=record.at("id"),
        value=quoted(row["id"]),
        expected=f"an id that the catalogue does not have, or an equal row ({column} is "
        f"{quoted(write_value(before.get(column)))} there and {quoted(write_value(row.get(column)))} here{others})",
        remedy="choose another id, or change the row of the catalogue with --update",
    )


def _check_references(connection: sa.Connection, kind: Kind, records: Sequence[Record]) -> list[Problem]:
    problems = []
    for field in kind.references:
        wanted = {value for record in records if isinstance(value := record.given.get(field.name), str)}
        other = KINDS[field.references]
        missing = wanted - set(queries.fetch_own_rows(connection, other, wanted))
        if not missing:
            continue
        known = list(queries.fetch_values(connection, other, "id"))
        remedies = {value: _remedy(value, other, known) for value in missing}
        problems += [
            Problem(place=record.at(field.name), value=quoted(value), expected=field.expected, remedy=remedies[value])
            for record in records
            if isinstance(value := record.given.get(field.name), str) and value in missing
        ]
    return problems


def _remedy(value: str, other: Kind, known: Sequence[str]) -> str:
    hint = _suggestion(value, known, f"catalog list {other.name}")
    return f"{hint} (import {other.name}.csv first, or add the {other.singular})"


def _suggestion(word: str, known: Sequence[str], command: str) -> str:
    """Near names, or all where they are few, or the command that lists them."""
    hint = did_you_mean(word, known)
    too_many = len(known) > _LISTED_NAMES and hint.startswith("known are")
    return f"`actuator-select {command}` lists what there is" if too_many else hint
