"""Which row somebody means."""

from collections.abc import Sequence
from fnmatch import fnmatchcase

import sqlalchemy as sa

from actuator_select.database import queries
from actuator_select.database.fields import Kind
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.suggestions import suggestion
from actuator_select.errors import UnknownName


def locate(
    connection: sa.Connection, row_id: str, kind: str | None = None, also: Sequence[str] = ()
) -> tuple[Kind, str]:
    """Find a row by what somebody calls it.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        The catalogue.
    row_id : str
        The id; for actuators the name as well.
    kind : str, optional
        Where to look; everywhere by default.
    also : sequence of str, optional
        More names that the message may suggest.

    Returns
    -------
    Kind, str
        Its kind and id.

    Raises
    ------
    UnknownName
        If there is none, or several kinds have it.
    """
    kinds = list(KINDS.values()) if kind is None else [find_kind(kind)]
    names = [(one, queries.fetch_names(connection, one)) for one in kinds]
    found = [(one, known[row_id]) for one, known in names if row_id in known]
    if len(found) == 1:
        return found[0]
    if found:
        among = ", ".join(one.name for one, _ in found)
        raise UnknownName(f"{row_id!r} is in {among}; state which with --kind")
    where = "the catalogue" if kind is None else kinds[0].name
    known_names = dict.fromkeys([*(name for _, known in names for name in known), *also])
    command = f"catalog list {'KIND' if kind is None else kinds[0].name}"
    raise UnknownName(f"there is no {row_id!r} in {where}; {suggestion(row_id, list(known_names), command)}")


def locate_ever(connection: sa.Connection, row_id: str, kind: str | None = None) -> list[tuple[Kind, str]]:
    """Find a row by what somebody calls it, else the rows that once had this name; parameters and errors as above."""
    found = None if kind is None else find_kind(kind)
    try:
        return [locate(connection, row_id, kind, queries.fetch_past_names(connection, found))]
    except UnknownName:
        if rows := queries.fetch_past_holders(connection, row_id, found):
            return rows
        raise


def matches(pattern: str, row_id: str) -> bool:
    """Whether an id is what a compatibility's pattern speaks of; ``*`` stands for any characters."""
    return fnmatchcase(row_id, pattern)  # its other wildcards cannot stand in a pattern of the catalogue
