"""What an import has met and will meet, kept in a temporary table, so that memory stays flat however long the file."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum

import sqlalchemy as sa

from actuator_select.database.fields import Kind
from actuator_select.database.queries import batches
from actuator_select.database.schema import ID_LENGTH, TABLES

_SEEN = sa.Table(
    "import_seen",
    sa.MetaData(),
    sa.Column("purpose", sa.String(10), primary_key=True),
    sa.Column("kind", sa.String(20), primary_key=True),
    sa.Column("field", sa.String(60), primary_key=True),
    sa.Column("value", sa.String(2 * ID_LENGTH), primary_key=True),
    sa.Column("said", sa.Text(), nullable=False),
    prefixes=["TEMPORARY"],
)


class Purpose(StrEnum):
    """What is remembered for values of a field."""

    PLACE = "place"
    """Values that may stand only once, and where they stood first."""

    COMING = "coming"
    """Ids of the file's rows, and what the rows say in the field."""

    FORMER = "former"
    """Ids of rows that gave up what they held in a unique field, and what that was."""


class Seen:
    """Memory of one import."""

    def __init__(self, connection: sa.Connection) -> None:
        self._connection = connection

    def recall(self, purpose: Purpose, kind: Kind, field: str, values: Iterable[str]) -> dict[str, str]:
        """What was noted of those of `values` of which something was noted."""
        query = sa.select(_SEEN.c.value, _SEEN.c.said).where(*_about(purpose, kind, field))
        return {
            value: said
            for batch in batches(values)
            for value, said in self._connection.execute(query.where(_SEEN.c.value.in_(batch)))
        }

    def note(self, purpose: Purpose, kind: Kind, field: str, said: Mapping[str, str]) -> None:
        """Note something of values of which nothing was noted before."""
        if said:
            about = {"purpose": purpose.value, "kind": kind.name, "field": field}
            self._connection.execute(
                _SEEN.insert(), [about | {"value": value, "said": text} for value, text in said.items()]
            )

    def other_ids(self, purpose: Purpose, kind: Kind) -> list[str]:
        """Ids of the catalogue's rows of a kind of which nothing was noted."""
        met = sa.select(_SEEN.c.value).where(*_about(purpose, kind, "id"))
        ids = TABLES[kind.name].c.id
        return [str(value) for value in self._connection.scalars(sa.select(ids).where(ids.not_in(met)).order_by(ids))]


def _about(purpose: Purpose, kind: Kind, field: str) -> tuple[sa.ColumnElement[bool], ...]:
    return _SEEN.c.purpose == purpose.value, _SEEN.c.kind == kind.name, _SEEN.c.field == field


@contextmanager
def remembering(connection: sa.Connection) -> Iterator[Seen]:
    """Memory for one import, inside its transaction; it is empty when the import ends.

    The table itself stays until the connection is closed: to drop it would end the transaction on MySQL.
    """
    connection.execute(sa.schema.CreateTable(_SEEN, if_not_exists=True))
    # Undoing a transaction does not remove it everywhere, and may bring back what another import noted.
    connection.execute(_SEEN.delete())
    yield Seen(connection)
    connection.execute(_SEEN.delete())
