"""Every SQL statement of the program but those of an import's temporary table (`seen`)."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sqlalchemy as sa

from actuator_select.database.cells import Value
from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import ACTUATORS, KINDS, ROLES
from actuator_select.database.schema import CHANGES, SHIPPED_ROWS, STATE, TABLES

Row = dict[str, Value]

_IDS_PER_QUERY = 500  # stays below the number of parameters that any database takes
_ROWS_PER_FETCH = 1000  # rows in memory at once where all are gone through


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column that a query can show, compare and sort by.

    Attributes
    ----------
    name : str
        As it appears in results, such as ``id`` or ``motor.rated_power_w``.
    part : str
        What it belongs to, such as ``motor``; it may stand before the name with a dot.
    field : Field
        What it holds.
    expression : sqlalchemy column
        Where it is.
    """

    name: str
    part: str
    field: Field
    expression: sa.Column[Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """That one row refers to another.

    Attributes
    ----------
    used_id : str
        The row that is used.
    kind : Kind
        Of the row that uses it.
    field : Field
        Column that refers to it.
    row_id, name : str
        The row that uses it: its id, and its name where names are unique, else the id again.
    """

    used_id: str
    kind: Kind
    field: Field
    row_id: str
    name: str


def columns_of(kind: Kind) -> tuple[Column, ...]:
    """Columns of a kind, own columns first; those of actuators include their parts'."""
    columns = [
        Column(name=field.name, part=kind.singular, field=field, expression=TABLES[kind.name].c[field.name])
        for field in kind.columns
    ]
    if kind is ACTUATORS:
        for role, part in ROLES.items():
            table = TABLES[part.name]
            columns += [
                Column(name=f"{role}.{field.name}", part=role, field=field, expression=table.c[field.name])
                for field in part.columns
            ]
    return tuple(columns)


def fetch_rows(
    connection: sa.Connection,
    kind: Kind,
    condition: sa.ColumnElement[bool] | None = None,
    order: Sequence[sa.ColumnElement[Any]] = (),
    columns: Sequence[Column] = (),
    limit: int | None = None,
) -> list[Row]:
    """Rows that meet `condition`, in `order` and then by id, or the first `limit` of them; by default every column."""
    return list(stream_rows(connection, kind, condition, order, columns, limit))


def stream_rows(
    connection: sa.Connection,
    kind: Kind,
    condition: sa.ColumnElement[bool] | None = None,
    order: Sequence[sa.ColumnElement[Any]] = (),
    columns: Sequence[Column] = (),
    limit: int | None = None,
) -> Iterator[Row]:
    """Rows as of `fetch_rows`, which need not fit into memory together."""
    columns = columns or columns_of(kind)
    query = sa.select(*(column.expression.label(column.name) for column in columns)).select_from(_source(kind))
    if condition is not None:
        query = query.where(condition)
    query = query.order_by(*order, TABLES[kind.name].c.id).limit(limit)
    names = [column.name for column in columns]
    for values in connection.execution_options(yield_per=_ROWS_PER_FETCH).execute(query):
        yield dict(zip(names, values, strict=True))


def fetch_row(connection: sa.Connection, kind: Kind, row_id: str) -> Row:
    """The row that has this id, with its parts' columns."""
    return fetch_rows(connection, kind, TABLES[kind.name].c.id == row_id)[0]


def fetch_own_rows(connection: sa.Connection, kind: Kind, ids: Iterable[str] | None = None) -> dict[str, Row]:
    """Rows without their parts' columns, by id: all, or those of `ids` that exist."""
    table = TABLES[kind.name]
    query = sa.select(*(table.c[field.name] for field in kind.columns)).order_by(table.c.id)
    parts = [query] if ids is None else [query.where(table.c.id.in_(batch)) for batch in batches(ids)]
    names = [field.name for field in kind.columns]
    found = (dict(zip(names, values, strict=True)) for part in parts for values in connection.execute(part))
    return {str(row["id"]): row for row in found}


def fetch_cells(connection: sa.Connection, kind: Kind, ids: Sequence[str]) -> set[tuple[Value, ...]]:
    """Rows of some hundred `ids` as tuples of what users fill, in the order of the columns; the id comes first."""
    table = TABLES[kind.name]
    query = sa.select(*(table.c[field.name] for field in kind.fields)).where(table.c.id.in_(ids))
    return set(map(tuple, connection.execute(query)))


def stream_own_rows(
    connection: sa.Connection, kind: Kind, condition: sa.ColumnElement[bool] | None = None
) -> Iterator[Row]:
    """Rows without their parts' columns, by id, which need not fit into memory together."""
    table = TABLES[kind.name]
    query = sa.select(*(table.c[field.name] for field in kind.columns)).order_by(table.c.id)
    if condition is not None:
        query = query.select_from(_source(kind)).where(condition)
    names = [field.name for field in kind.columns]
    for values in connection.execution_options(yield_per=_ROWS_PER_FETCH).execute(query):
        yield dict(zip(names, values, strict=True))


def fetch_values(connection: sa.Connection, kind: Kind, column: str) -> dict[str, str]:
    """Texts of one column by id, in the order of the ids."""
    table = TABLES[kind.name]
    query = sa.select(table.c.id, table.c[column]).order_by(table.c.id)
    return {str(row_id): value for row_id, value in connection.execute(query)}


def fetch_holders(connection: sa.Connection, kind: Kind, column: str, values: Iterable[str]) -> dict[str, str]:
    """Ids of the rows that hold those of `values` that some row holds."""
    table = TABLES[kind.name]
    query = sa.select(table.c[column], table.c.id)
    found = (row for batch in batches(values) for row in connection.execute(query.where(table.c[column].in_(batch))))
    return {str(value): str(row_id) for value, row_id in found}


def batches(values: Iterable[str]) -> list[list[str]]:
    """Different values, in portions that one statement takes."""
    wanted = sorted(set(values))
    return [wanted[start : start + _IDS_PER_QUERY] for start in range(0, len(wanted), _IDS_PER_QUERY)]


def fetch_names(connection: sa.Connection, kind: Kind) -> dict[str, str]:
    """Ids by what people may call a row: its id, or a name that only it has."""
    names = {row_id: row_id for row_id in fetch_values(connection, kind, "id")}
    for field in kind.fields:
        if field.unique:
            names = {name: row_id for row_id, name in fetch_values(connection, kind, field.name).items()} | names
    return names


def count_rows(connection: sa.Connection, kind: Kind, condition: sa.ColumnElement[bool] | None = None) -> int:
    """Number of rows of a kind: all, or those that meet `condition`."""
    query = sa.select(sa.func.count())
    query = (
        query.select_from(TABLES[kind.name]) if condition is None else query.select_from(_source(kind)).where(condition)
    )
    return int(connection.scalar(query) or 0)


def insert_rows(connection: sa.Connection, kind: Kind, rows: Sequence[Mapping[str, Value]]) -> None:
    """Add rows; an absent column is unknown."""
    if rows:
        connection.execute(
            TABLES[kind.name].insert(), [{field.name: row.get(field.name) for field in kind.columns} for row in rows]
        )


def update_rows(connection: sa.Connection, kind: Kind, rows: Sequence[Mapping[str, Value]]) -> None:
    """Replace the rows that have these ids."""
    if rows:
        table = TABLES[kind.name]
        statement = table.update().where(table.c.id == sa.bindparam("row_id"))
        values = [{field.name: row.get(field.name) for field in kind.columns} for row in rows]
        connection.execute(statement, [value | {"row_id": value["id"]} for value in values])


def update_texts(connection: sa.Connection, kind: Kind, column: str, texts: Mapping[str, str]) -> None:
    """Set one column of the rows that have these ids."""
    if texts:
        table = TABLES[kind.name]
        statement = table.update().where(table.c.id == sa.bindparam("row_id")).values({column: sa.bindparam("text")})
        connection.execute(statement, [{"row_id": row_id, "text": text} for row_id, text in texts.items()])


def delete_rows(connection: sa.Connection, kind: Kind, ids: Sequence[str]) -> None:
    """Remove the rows that have these ids."""
    if ids:
        table = TABLES[kind.name]
        connection.execute(table.delete().where(table.c.id == sa.bindparam("row_id")), [{"row_id": i} for i in ids])


def fetch_uses(connection: sa.Connection, kind: Kind, ids: Iterable[str]) -> list[Use]:
    """By what those rows of a kind are used that have these ids, by the users' kind and id."""
    referring = [(user, field) for user in KINDS.values() for field in user.references if field.references == kind.name]
    uses = []
    for batch in batches(ids):
        for user, field in referring:
            table = TABLES[user.name]
            name = next((table.c[one.name] for one in user.fields if one.unique), table.c.id)
            query = sa.select(table.c[field.name], table.c.id, name.label("name"))
            found = connection.execute(query.where(table.c[field.name].in_(batch)).order_by(table.c.id))
            uses += [
                Use(used_id=used, kind=user, field=field, row_id=row_id, name=name) for used, row_id, name in found
            ]
    return uses


def fetch_ledger(connection: sa.Connection) -> dict[tuple[str, str], str]:
    """Digest of every shipped row as shipped, by kind and id."""
    query = sa.select(SHIPPED_ROWS.c.kind, SHIPPED_ROWS.c.id, SHIPPED_ROWS.c.digest)
    return {(kind, row_id): digest for kind, row_id, digest in connection.execute(query)}


def replace_ledger(connection: sa.Connection, ledger: Mapping[tuple[str, str], str]) -> None:
    """State anew what was shipped."""
    connection.execute(SHIPPED_ROWS.delete())
    if ledger:
        entries = [{"kind": kind, "id": row_id, "digest": digest} for (kind, row_id), digest in ledger.items()]
        connection.execute(SHIPPED_ROWS.insert(), entries)


def insert_changes(connection: sa.Connection, changes: Sequence[Mapping[str, str | None]]) -> None:
    """Record what happened to rows; keys are the columns of the history."""
    if changes:
        connection.execute(CHANGES.insert(), list(changes))


def fetch_changes(connection: sa.Connection, row_id: str, kind: Kind | None = None) -> list[dict[str, Any]]:
    """History of the rows that have or had this id, oldest first."""
    columns = [column for column in CHANGES.columns if column.name != "number"]
    query = sa.select(*columns).where(CHANGES.c.row_id == row_id).order_by(CHANGES.c.number)
    if kind is not None:
        query = query.where(CHANGES.c.kind == kind.name)
    return [dict(row) for row in connection.execute(query).mappings()]


def fetch_past_names(connection: sa.Connection, kind: Kind | None = None) -> list[str]:
    """Ids of all rows that something happened to, and names that they gave up, also of rows that are gone."""
    ids, names = sa.select(CHANGES.c.row_id), sa.select(CHANGES.c.old).where(_is_name(), CHANGES.c.old.is_not(None))
    if kind is not None:
        ids, names = (query.where(CHANGES.c.kind == kind.name) for query in (ids, names))
    return sorted(map(str, connection.scalars(sa.union(ids, names))))


def fetch_past_holders(connection: sa.Connection, name: str, kind: Kind | None = None) -> list[tuple[Kind, str]]:
    """Kinds and ids of the rows that were renamed from or to a name, or removed under it; the first one first."""
    query = sa.select(CHANGES.c.kind, CHANGES.c.row_id).where(
        _is_name(), sa.or_(CHANGES.c.old == name, CHANGES.c.new == name)
    )
    if kind is not None:
        query = query.where(CHANGES.c.kind == kind.name)
    query = query.group_by(CHANGES.c.kind, CHANGES.c.row_id).order_by(sa.func.min(CHANGES.c.number))
    return [(KINDS[kind_name], row_id) for kind_name, row_id in connection.execute(query)]


def fetch_state(connection: sa.Connection, name: str) -> str | None:
    """A remark that the program left in the database."""
    return connection.scalar(sa.select(STATE.c.value).where(STATE.c.name == name))


def replace_state(connection: sa.Connection, name: str, value: str) -> None:
    """Leave a remark in the database."""
    connection.execute(STATE.delete().where(STATE.c.name == name))
    connection.execute(STATE.insert(), {"name": name, "value": value})


def _is_name() -> sa.ColumnElement[bool]:
    """Whether a change is of a column whose values name rows."""
    named = [(kind.name, field.name) for kind in KINDS.values() for field in kind.fields if field.unique]
    return sa.or_(*(sa.and_(CHANGES.c.kind == kind, CHANGES.c.field == field) for kind, field in named))


def _source(kind: Kind) -> sa.FromClause:
    table: sa.FromClause = TABLES[kind.name]
    if kind is not ACTUATORS:
        return table
    own = TABLES[kind.name].c
    for role, part in ROLES.items():
        other = TABLES[part.name]
        table = table.outerjoin(other, own[f"{role}_id"] == other.c.id)
    return table
