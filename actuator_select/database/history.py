"""Writing rows: every addition, change and removal goes through here, and is recorded with its time and cause.

Recorded are the columns that users fill. Whether a row counts as shipped or as the user's follows from its content and
from what the program ships; where that alone changes, as when an upgrade no longer ships an edited row, nothing is
recorded.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime

import sqlalchemy as sa

from actuator_select.database import queries
from actuator_select.database.cells import Value, write_value
from actuator_select.database.content import row_digest
from actuator_select.database.fields import Kind


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One thing that happened to a row.

    Attributes
    ----------
    changed_at : str
        When, UTC, such as ``2026-11-22T14:05:31Z``.
    changed_by : str
        By what, such as ``catalog import motors.csv``.
    action : str
        ``added``, ``changed`` or ``removed``.
    kind, row_id : str
        The row.
    field : str or None
        Column; None where the whole row was added.
    old, new : str or None
        Values as texts that read back; None is unknown.
    """

    changed_at: str
    changed_by: str
    action: str
    kind: str
    row_id: str
    field: str | None = None
    old: str | None = None
    new: str | None = None


def add_rows(
    connection: sa.Connection, kind: Kind, rows: Sequence[queries.Row], *, by: str, origin: str | None = None
) -> None:
    """Write new rows; an absent column is unknown.

    `by` says by what, `origin` whether they are ``shipped`` or the ``user``'s; it is told by their content by default.
    """
    now = _now()
    queries.insert_rows(connection, kind, _with_origin(connection, kind, rows, origin))
    _record(
        connection,
        (Change(changed_at=now, changed_by=by, action="added", kind=kind.name, row_id=str(row["id"])) for row in rows),
    )


def change_rows(
    connection: sa.Connection,
    kind: Kind,
    rows: Sequence[queries.Row],
    *,
    by: str,
    origin: str | None = None,
    before: Mapping[str, queries.Row] | None = None,
) -> None:
    """Replace the rows that have these ids, and record every filled column that differs; `by` and `origin` as above.

    `before` has what the rows said, by id, where the catalogue does not say it any more.
    """
    if before is None:
        before = queries.fetch_own_rows(connection, kind, [str(row["id"]) for row in rows])
    queries.update_rows(connection, kind, _with_origin(connection, kind, rows, origin))
    now = _now()
    _record(
        connection,
        (
            Change(
                changed_at=now,
                changed_by=by,
                action="changed",
                kind=kind.name,
                row_id=str(row["id"]),
                field=field.name,
                old=_text(before[str(row["id"])][field.name]),
                new=_text(row.get(field.name)),
            )
            for row in rows
            for field in kind.fields
            if before[str(row["id"])][field.name] != row.get(field.name)
        ),
    )


def remove_rows(connection: sa.Connection, kind: Kind, ids: Sequence[str], *, by: str) -> None:
    """Remove the rows that have these ids, and record what they said, so that nothing is lost."""
    before = queries.fetch_own_rows(connection, kind, ids)
    queries.delete_rows(connection, kind, ids)
    now = _now()
    _record(
        connection,
        (
            Change(
                changed_at=now,
                changed_by=by,
                action="removed",
                kind=kind.name,
                row_id=row_id,
                field=field.name,
                old=_text(row[field.name]),
            )
            for row_id, row in before.items()
            for field in kind.fields
            if row[field.name] is not None
        ),
    )


def _with_origin(
    connection: sa.Connection, kind: Kind, rows: Sequence[queries.Row], origin: str | None
) -> list[queries.Row]:
    """Rows with their origin: as stated, else ``shipped`` for a row that equals what was shipped."""
    if origin is not None:
        return [row | {"origin": origin} for row in rows]
    ledger = queries.fetch_ledger(connection)
    known = [ledger.get((kind.name, str(row["id"]))) for row in rows]
    shipped = [one is not None and one == row_digest(kind, row) for one, row in zip(known, rows, strict=True)]
    return [row | {"origin": "shipped" if is_so else "user"} for row, is_so in zip(rows, shipped, strict=True)]


def _record(connection: sa.Connection, changes: Iterable[Change]) -> None:
    queries.insert_changes(connection, [asdict(change) for change in changes])


def _text(value: Value) -> str | None:
    return None if value is None else write_value(value)


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
