"""From records to rows of the database: all or nothing, and every objection at once."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sqlalchemy as sa

from actuator_select.database import history, queries
from actuator_select.database.cells import check_row, quoted, write_value
from actuator_select.database.content import row_digest
from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import KINDS
from actuator_select.database.records import Record, places_of
from actuator_select.database.seen import Purpose, Seen
from actuator_select.database.suggestions import suggestion
from actuator_select.errors import InvalidRows, Problem

_COMPARED_NAMES = 50_000  # pairs; comparing them takes about a second


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What taking records in means for the database.

    Attributes
    ----------
    added, updated : tuple of rows
        Complete rows to be written.
    unchanged : int
        How many rows are there already, equal.
    before : mapping of str to row
        What the rows that are updated said before, by id.
    giving_up : mapping of str to mapping of str to str
        By unique column: ids of rows that hold what a planned row is to hold, and get something else in the same
        import, with what they hold.
    """

    added: tuple[queries.Row, ...]
    updated: tuple[queries.Row, ...]
    unchanged: int
    before: Mapping[str, queries.Row]
    giving_up: Mapping[str, Mapping[str, str]]


def plan_rows(
    connection: sa.Connection,
    kind: Kind,
    records: Sequence[Record],
    *,
    update: bool,
    replace: bool = False,
    seen: Seen | None = None,
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
    replace : bool
        Whether they may be changed, and columns that were left out become unknown.
    seen : Seen, optional
        What the same import has met before; without it `records` are all there are.

    Returns
    -------
    Plan, list of Problem
        What to write if there is no problem.
    """
    repeated = _repeated(kind, "id", records, seen)
    problems = list(repeated.values())
    existing = _own_rows(connection, kind, records, seen)
    blank: queries.Row = dict.fromkeys((field.name for field in kind.fields), None)
    added: list[queries.Row] = []
    updated: list[queries.Row] = []
    for index, record in enumerate(records):
        row_id = record.given.get("id")
        before = existing.get(row_id) if isinstance(row_id, str) and index not in repeated else None
        row = (blank if before is None or replace else before) | dict(record.given)
        if before is None:
            added.append(row)
        elif row_digest(kind, row) != row_digest(kind, before):
            updated.append(row)
            if not (update or replace):
                problems.append(_exists(kind, record, row, before))
        problems += _row_problems(kind, record, row)
    for field in kind.references:
        problems += _unknown_references(connection, field, records, seen)
    objections, giving_up = _unique_fields(connection, kind, records, replace=replace, seen=seen)
    plan = Plan(
        added=tuple(added),
        updated=tuple(updated),
        unchanged=len(records) - len(added) - len(updated),
        before=existing,
        giving_up=giving_up,
    )
    return plan, [*problems, *objections]


def refuse(heading: str, problems: Sequence[Problem]) -> None:
    """Raise `InvalidRows` if there are problems, each told once and in the order of the lines."""
    if problems:
        raise InvalidRows(heading, in_order(problems))


def in_order(problems: Sequence[Problem]) -> list[Problem]:
    """Problems of one table, each once and in the order of the lines."""
    return sorted(dict.fromkeys(problems), key=_line)


def write_plan(connection: sa.Connection, kind: Kind, plan: Plan, *, by: str, seen: Seen | None = None) -> None:
    """Write what was planned; `by` says by what, for the history, `seen` is what the plan was made with."""
    for column, held in plan.giving_up.items():
        # Until their own turn comes they hold what nobody can write: a control character and their id.
        queries.update_texts(connection, kind, column, {row_id: f"\x1f{row_id}" for row_id in held})
        if seen is not None:
            seen.note(Purpose.FORMER, kind, column, held)
    history.add_rows(connection, kind, plan.added, by=by)
    history.change_rows(connection, kind, plan.updated, by=by, before=plan.before)


def _own_rows(
    connection: sa.Connection, kind: Kind, records: Sequence[Record], seen: Seen | None
) -> dict[str, queries.Row]:
    """Rows of the catalogue that have the records' ids, as they were before the import."""
    rows = queries.fetch_own_rows(connection, kind, [row_id for _, row_id, _ in places_of(records, "id")])
    if seen is not None:
        for field in kind.unique:
            for row_id, former in seen.recall(Purpose.FORMER, kind, field.name, rows).items():
                rows[row_id][field.name] = former
    return rows


def _row_problems(kind: Kind, record: Record, row: queries.Row) -> list[Problem]:
    problems = []
    for column, refused in check_row(kind, row):
        group = next((names for names in kind.any_of if column in names), (column,))
        if any(name in record.refused for name in group):
            continue
        if record.header and kind.field(column).required and column not in record.written:
            # Told once, not for every line.
            value, remedy = f"there is no column {column!r}", _how_to_fill(column, record)
            problems.append(Problem(place=record.header, value=value, expected=refused.expected, remedy=remedy))
        else:
            problems.append(refused.at(record.at(column), row.get(column)))
    return problems


def _how_to_part(column: str, record: Record) -> str:
    if column != "id" or not record.id_from:
        return "remove or rename one"
    return (
        f"the id is made as {record.id_from}, with a hyphen for what an id cannot hold, such as *: remove one row "
        "if both say the same, or import one by the catalogue's own columns with another id"
    )


def _how_to_fill(column: str, record: Record) -> str:
    how = f"let {record.mapping} fill it" if record.mapping else "add the column"
    if column != "source_id":
        return how
    new = "`actuator-select catalog add sources id=ID …` adds a source"
    return f"state --source ID for all rows; {new}" if record.mapping else f"{how}, or state --source ID; {new}"


def _line(problem: Problem) -> int:
    found = re.search(r", (?:line |row |cell [A-Z]+)(\d+)", problem.place)
    return int(found[1]) if found else 0


def _repeated(kind: Kind, column: str, records: Sequence[Record], seen: Seen | None) -> dict[int, Problem]:
    """Objections to values that stood before, by the index of the record that repeats them."""
    values = (value for _, value, _ in places_of(records, column))
    met = {} if seen is None else seen.recall(Purpose.PLACE, kind, column, values)
    new: dict[str, str] = {}
    problems = {}
    for index, value, record in places_of(records, column):
        if (first := met.get(value) or new.get(value)) is not None:
            expected = f"another {column} than {first}"
            problems[index] = Problem(
                place=record.at(column), value=quoted(value), expected=expected, remedy=_how_to_part(column, record)
            )
        else:
            new[value] = record.place
    if seen is not None:
        seen.note(Purpose.PLACE, kind, column, new)
    return problems


def _unique_fields(
    connection: sa.Connection, kind: Kind, records: Sequence[Record], *, replace: bool, seen: Seen | None
) -> tuple[list[Problem], dict[str, dict[str, str]]]:
    """Objections to what two rows would hold, and by field the rows that give up what they hold, with that."""
    problems: list[Problem] = []
    giving_up = {}
    for field in kind.unique:
        twice = _repeated(kind, field.name, records, seen)
        found = [one for one in places_of(records, field.name) if one[0] not in twice]
        holders = queries.fetch_holders(connection, kind, field.name, (value for _, value, _ in found))
        coming = {} if seen is None else seen.recall(Purpose.COMING, kind, field.name, holders.values())
        if replace:
            # Rows that do not come are removed; where they are not yet, something else was objected to.
            holders = {value: holder for value, holder in holders.items() if holder in coming}
        giving_up[field.name] = {
            holder: value for value, holder in holders.items() if coming.get(holder, value) != value
        }
        taken = _taken(kind, field.name, found, holders, giving_up[field.name])
        problems += [*twice.values(), *taken]
    return problems, giving_up


def _taken(
    kind: Kind,
    column: str,
    found: Sequence[tuple[int, str, Record]],
    holders: Mapping[str, str],
    giving_up: Mapping[str, str],
) -> list[Problem]:
    """Objections to what other rows hold and do not give up."""
    return [
        Problem(
            place=record.at(column),
            value=quoted(value),
            expected=f"another {column} than {kind.singular} {holders[value]!r} of the catalogue",
            remedy="choose another",
        )
        for _, value, record in found
        if holders.get(value) not in {None, record.given.get("id"), *giving_up}
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


def _unknown_references(
    connection: sa.Connection, field: Field, records: Sequence[Record], seen: Seen | None
) -> list[Problem]:
    other = KINDS[field.references]
    wanted = {value for _, value, _ in places_of(records, field.name)}
    missing = wanted - set(queries.fetch_holders(connection, other, "id", wanted))
    if seen is not None:
        # Once anything is refused rows are no longer written, but they are known to come.
        missing -= set(seen.recall(Purpose.PLACE, other, "id", missing))
    if not missing:
        return []
    remedies = _remedies(connection, sorted(missing), other)
    return [
        Problem(place=record.at(field.name), value=quoted(value), expected=field.expected, remedy=remedies[value])
        for _, value, record in places_of(records, field.name)
        if value in missing
    ]


def _remedies(connection: sa.Connection, missing: Sequence[str], other: Kind) -> dict[str, str]:
    """What to do for every missing id; near names only for a few, because comparing many with many takes minutes."""
    command = f"catalog list {other.name}"
    few = len(missing) * queries.count_rows(connection, other) <= _COMPARED_NAMES
    known = list(queries.fetch_values(connection, other, "id")) if few else []
    rest = f"(import {other.name}.csv first, or add the {other.singular})"
    lists = f"`actuator-select {command}` lists what there is"
    return {value: f"{suggestion(value, known, command) if few else lists} {rest}" for value in missing}
