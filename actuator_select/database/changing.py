"""Adding, editing, copying and removing single rows, in the caller's transaction."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import sqlalchemy as sa

from actuator_select.database import history, queries
from actuator_select.database.cells import quoted
from actuator_select.database.comparing import Difference, differences
from actuator_select.database.fields import Kind
from actuator_select.database.ingest import Plan, plan_rows, refuse, write_plan
from actuator_select.database.kinds import KINDS
from actuator_select.database.naming import locate
from actuator_select.database.records import Record, read_record
from actuator_select.database.suggestions import first_of
from actuator_select.errors import Problem, RowInUse

Given = Mapping[str, object]
"""Numbers or texts by column name, as somebody wrote them."""

_NOT_COPIED = {"check_status", "check_notes"}  # they speak of the original's figures


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """What an edit did to a row, or would do.

    Attributes
    ----------
    kind : str
        Kind of the row.
    row : dict
        The row as it is then, with its parts' columns.
    differences : tuple of Difference
        Columns that changed; empty if the row had these values already.
    """

    kind: str
    row: queries.Row
    differences: tuple[Difference, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Removal:
    """A row that was removed, or would be.

    Attributes
    ----------
    kind : str
        Its kind.
    row : dict
        The row as it was, with its parts' columns.
    is_of_the_program : bool
        Whether the program ships a row of this id; it does not bring it back by itself.
    """

    kind: str
    row: queries.Row
    is_of_the_program: bool


def add_row(connection: sa.Connection, kind: Kind, values: Given, source: Given | None) -> str:
    """Add a row, and the source of its figures where `source` describes a new one.

    Returns
    -------
    str
        Its id.

    Raises
    ------
    InvalidRows
        With everything that is wrong.
    """
    record, plan, problems = _take(connection, kind, values, source, by="catalog add")
    if not problems and not plan.added:
        problems = [_is_there(str(record.given["id"]), "the catalogue has this very row already")]
    refuse(f"the {kind.singular} was not added", problems)
    write_plan(connection, kind, plan, by="catalog add")
    return str(record.given["id"])


def edit_row(
    connection: sa.Connection, row_id: str, values: Given, kind: str | None = None, source: Given | None = None
) -> Edit:
    """Change columns of one row; parameters and errors as of `Catalogue.edit`."""
    found, own_id = locate(connection, row_id, kind)
    before = queries.fetch_own_rows(connection, found, [own_id])[own_id]
    own = _only_id(values, own_id, f"the id never changes; copy the row: catalog copy {own_id} --as NEW, and remove it")
    rest = {name: value for name, value in values.items() if name != "id"}
    _, plan, problems = _take(connection, found, {"id": own_id, **rest}, source, update=True, by="catalog edit")
    refuse(f"{found.singular} {own_id!r} was not changed", [*own, *problems])
    write_plan(connection, found, plan, by="catalog edit")
    after = queries.fetch_own_rows(connection, found, [own_id])[own_id]
    row = queries.fetch_row(connection, found, own_id)
    return Edit(kind=found.name, row=row, differences=differences(found, before, after))


def copy_row(
    connection: sa.Connection,
    row_id: str,
    new_id: str,
    values: Given,
    kind: str | None = None,
    source: Given | None = None,
) -> tuple[Kind, str]:
    """Add a row that starts from another one; parameters and errors as of `Catalogue.copy`.

    Returns
    -------
    Kind, str
        Kind and id of the original.
    """
    found, own_id = locate(connection, row_id, kind)
    original = queries.fetch_own_rows(connection, found, [own_id])[own_id]
    own = _only_id(values, new_id, "state it once: --as is the id of the new row")
    written = {found.spellings[name].name for name in values if name in found.spellings} | {"id"}
    if source is not None:
        written.add("source_id")
    start: dict[str, object] = {
        field.name: new_id if field.unique else original[field.name]
        for field in found.fields
        if field.name not in _NOT_COPIED | written
    }
    rest = {name: value for name, value in values.items() if name != "id"}
    by = f"catalog copy, copied from {own_id}"
    is_there = bool(queries.fetch_own_rows(connection, found, [new_id]))
    if is_there:
        own.append(_is_there(new_id, "choose another with --as"))
    # Where the id is taken, that has been said; the rest is then checked as a change of the row that has it.
    values = {"id": new_id, **start, **rest}
    _, plan, problems = _take(connection, found, values, source, update=is_there, by=by)
    refuse(f"{found.singular} {own_id!r} was not copied", [*own, *problems])
    write_plan(connection, found, plan, by=by)
    return found, own_id


def remove_row(connection: sa.Connection, row_id: str, kind: str | None = None) -> Removal:
    """Remove one row; parameters and errors as of `Catalogue.remove`."""
    found, own_id = locate(connection, row_id, kind)
    if uses := queries.fetch_uses(connection, found, [own_id]):
        raise RowInUse(_in_use(found, own_id, uses))
    row = queries.fetch_row(connection, found, own_id)
    history.remove_rows(connection, found, [own_id], by="catalog remove")
    is_of_the_program = (found.name, own_id) in queries.fetch_ledger(connection)
    return Removal(kind=found.name, row=row, is_of_the_program=is_of_the_program)


def _take(
    connection: sa.Connection, kind: Kind, values: Given, source: Given | None, *, by: str, update: bool = False
) -> tuple[Record, Plan, list[Problem]]:
    """Check a row, and write the new source of its figures so that the row can refer to it."""
    problems: list[Problem] = []
    if source is not None:
        problems += _source_objections(kind, values, source)
        new_source = {"id": _derived_id(source), **source}
        values = {**values, "source_id": new_source["id"]} if not problems else values
        record, refused = read_record(KINDS["sources"], new_source, "source.")
        plan, more = plan_rows(connection, KINDS["sources"], [record], update=False)
        problems += [*refused, *more]
        if not problems:
            write_plan(connection, KINDS["sources"], plan, by=by)
    record, refused = read_record(kind, values)
    plan, more = plan_rows(connection, kind, [record], update=update)
    # A source that is refused cannot be referred to either; that needs no telling.
    is_told = bool(problems)
    problems += [one for one in (*refused, *more) if not is_told or one.place != "source_id"]
    return record, plan, problems


def _source_objections(kind: Kind, values: Given, source: Given) -> list[Problem]:
    first = next(iter(source), "document")
    if "source_id" not in kind.spellings:
        expected, remedy = f"no source.… for a row of {kind.name}", f"write {first}=… itself"
        return [Problem(place=f"source.{first}", value=quoted(source.get(first)), expected=expected, remedy=remedy)]
    if "source_id" in values:
        expected, remedy = "no source_id beside source.…", "leave out one of them"
        return [Problem(place="source_id", value=quoted(values["source_id"]), expected=expected, remedy=remedy)]
    return []


def _derived_id(source: Given) -> str:
    """Id for a source that was described without one, from its title and date."""
    words = f"{source.get('document') or ''} {source.get('date') or ''}".lower()
    return "-".join(re.findall("[a-z0-9]+", words))[:60].strip("-") or "source"


def _only_id(values: Given, own_id: str, remedy: str) -> list[Problem]:
    if "id" not in values or values["id"] == own_id:
        return []
    return [Problem(place="id", value=quoted(values["id"]), expected=f"no other id than {own_id!r}", remedy=remedy)]


def _is_there(row_id: str, remedy: str) -> Problem:
    return Problem(place="id", value=quoted(row_id), expected="an id that the catalogue does not have", remedy=remedy)


def _in_use(kind: Kind, row_id: str, uses: Sequence[queries.Use]) -> str:
    lines = [f"{kind.singular} {row_id!r} was not removed, because it is in use:"]
    for (other, field), group in groupby(uses, key=lambda use: (use.kind, use.field)):
        users = [use.row_id for use in group]
        one = len(users) == 1
        verb = "name" if field.references == "sources" else "use"
        role = field.name.removesuffix("_id")
        who = f"{other.singular} {users[0]} {verb}s" if one else f"{len(users)} rows of {other.name} {verb}"
        names = "" if one else f": {first_of(users)}"
        lines.append(f"  {who} it as {'its' if one else 'their'} {role}{names}")
    first = uses[0]
    lines.append(
        f"Let them refer to another {kind.singular} or remove them first, such as: "
        f"actuator-select catalog edit {first.row_id} --kind {first.kind.name} {first.field.name}=…"
    )
    return "\n".join(lines)
