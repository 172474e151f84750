"""The rows that come with the program: brought into a database, refreshed when a newer program ships others.

A row that the user edited, deleted or made is never touched.
"""

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import sqlalchemy as sa

from actuator_select._resources import shipped_dir
from actuator_select._version import __version__
from actuator_select.database import history, queries
from actuator_select.database.cells import check_row
from actuator_select.database.content import row_digest
from actuator_select.database.csv_table import read_csv
from actuator_select.database.fields import Kind
from actuator_select.database.ingest import refuse
from actuator_select.database.kinds import KINDS
from actuator_select.database.records import read_records

DIGEST_STATE = "shipped_digest"
_BY = f"rows shipped with actuator-select {__version__}"

ShippedRows = Mapping[str, Mapping[str, queries.Row]]
"""Rows by kind and id."""

Ledger = dict[tuple[str, str], str]
"""Digest of every shipped row as it was shipped, by kind and id."""


def shipped_files() -> dict[str, Path]:
    """CSV files of the shipped rows, by kind."""
    folder = shipped_dir("catalog")
    return {kind: folder / f"{kind}.csv" for kind in KINDS}


def shipped_digest() -> str:
    """SHA-256 of the shipped files, which says without reading them whether a database is up to date."""
    digest = hashlib.sha256()
    for path in shipped_files().values():
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def read_shipped() -> ShippedRows:
    """Read and check the shipped rows."""
    rows: dict[str, dict[str, queries.Row]] = {}
    for kind, path in zip(KINDS.values(), shipped_files().values(), strict=True):
        records, problems = read_records(kind, read_csv(path))
        complete = [{one.name: record.given.get(one.name) for one in kind.fields} for record in records]
        for record, row in zip(records, complete, strict=True):
            problems += [refused.at(record.at(column), row.get(column)) for column, refused in check_row(kind, row)]
        refuse(f"the shipped {path.name} is faulty; install actuator-select again", problems)
        rows[kind.name] = {str(row["id"]): row | {"origin": "shipped"} for row in complete}
    return rows


def refresh(connection: sa.Connection) -> tuple[str, ...]:
    """Bring the shipped rows of a database up to date, in the caller's transaction.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        In a transaction that writes.

    Returns
    -------
    tuple of str
        What was done and what was left alone, for the user.
    """
    first = queries.fetch_state(connection, DIGEST_STATE) is None
    shipped = read_shipped()
    ledger = queries.fetch_ledger(connection)
    outcome = _Outcome()
    for kind in KINDS.values():
        _bring_in(connection, kind, shipped[kind.name], ledger, outcome)
    for kind in reversed(list(KINDS.values())):
        _take_out(connection, kind, shipped[kind.name], ledger, outcome)
    queries.replace_ledger(connection, ledger)
    queries.replace_state(connection, DIGEST_STATE, shipped_digest())
    return outcome.notices(first=first)


@dataclass(frozen=True, slots=True)
class _Outcome:
    """Which rows were written, and which were left alone and why."""

    added: list[str] = field(default_factory=list)
    renewed: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    edited: list[str] = field(default_factory=list)
    orphaned: list[str] = field(default_factory=list)
    deleted: list[str] = field(default_factory=list)
    own: list[str] = field(default_factory=list)
    blocked: list[str] = field(default_factory=list)
    needed: list[str] = field(default_factory=list)

    def notices(self, *, first: bool) -> tuple[str, ...]:
        """Sentences for the user; the first filling goes without saying."""
        done = [
            f"{len(rows)} {verb}"
            for rows, verb in ((self.added, "added"), (self.renewed, "renewed"), (self.removed, "removed"))
            if rows
        ]
        told = [f"The shipped catalogue rows were refreshed: {', '.join(done)}."] if done and not first else []
        reasons = (
            (self.edited, "kept as edited, although the program ships other figures"),
            (self.orphaned, "no longer shipped, but kept because they were edited"),
            (self.needed, "no longer shipped, but kept because other rows refer to them"),
            (self.deleted, "not brought back, because they were deleted"),
            (self.own, "kept as you made them, although the program now ships rows with these ids"),
            (self.blocked, "not taken over, because their name is taken or a row that they refer to is missing"),
        )
        told += [f"Catalogue rows {reason}: {', '.join(rows)}." for rows, reason in reasons if rows]
        return tuple(told)


def _bring_in(
    connection: sa.Connection, kind: Kind, shipped: Mapping[str, queries.Row], ledger: Ledger, outcome: _Outcome
) -> None:
    """Add new rows and renew the ones that nobody edited."""
    present = queries.fetch_own_rows(connection, kind)
    is_possible = _possibility(connection, kind, present)
    added, renewed = [], []
    for row_id, row in shipped.items():
        key, digest = (kind.name, row_id), row_digest(kind, row)
        before = present.get(row_id)
        known = None if before is None else row_digest(kind, before)
        name = f"{kind.singular} {row_id}"
        if before is None and key in ledger:
            outcome.deleted.append(name)
        elif known not in {None, digest, ledger.get(key)}:
            (outcome.edited if key in ledger else outcome.own).append(name)
            if key not in ledger:
                continue
        elif known != digest and not is_possible(row):
            outcome.blocked.append(name)
            continue
        elif before is None:
            added.append(row)
            outcome.added.append(name)
        elif before != row:
            renewed.append(row)
            outcome.renewed.append(name)
        ledger[key] = digest
    history.add_rows(connection, kind, added, by=_BY, origin="shipped")
    history.change_rows(connection, kind, renewed, by=_BY, origin="shipped")


def _possibility(
    connection: sa.Connection, kind: Kind, present: Mapping[str, queries.Row]
) -> Callable[[queries.Row], bool]:
    """Whether a row could be written: what it refers to exists and its name is free."""
    known = {one.name: set(queries.fetch_values(connection, KINDS[one.references], "id")) for one in kind.references}
    unique = [one.name for one in kind.fields if one.unique]
    holders = {name: {row[name]: row_id for row_id, row in present.items()} for name in unique}

    def is_possible(row: queries.Row) -> bool:
        refers = all(row[name] is None or row[name] in ids for name, ids in known.items())
        return refers and all(holders[name].get(row[name], row["id"]) == row["id"] for name in unique)

    return is_possible


def _take_out(
    connection: sa.Connection, kind: Kind, shipped: Mapping[str, queries.Row], ledger: Ledger, outcome: _Outcome
) -> None:
    """Remove the rows that are no longer shipped, unless they were edited or are referred to."""
    gone = [row_id for (name, row_id) in ledger if name == kind.name and row_id not in shipped]
    if not gone:
        return
    present = queries.fetch_own_rows(connection, kind, gone)
    referenced = {use.used_id for use in queries.fetch_uses(connection, kind, gone)}
    removed, orphaned = [], []
    for row_id in gone:
        name, before = f"{kind.singular} {row_id}", present.get(row_id)
        if before is None:
            pass
        elif row_digest(kind, before) != ledger[kind.name, row_id]:
            orphaned.append(before | {"origin": "user"})
            outcome.orphaned.append(name)
        elif row_id in referenced:
            outcome.needed.append(name)
            continue
        else:
            removed.append(row_id)
            outcome.removed.append(name)
        del ledger[kind.name, row_id]
    history.remove_rows(connection, kind, removed, by=_BY)
    history.change_rows(connection, kind, orphaned, by=_BY, origin="user")
