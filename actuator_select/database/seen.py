"""What an import has met so far, kept in a temporary table, so that memory stays flat however long the file is."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

import sqlalchemy as sa

from actuator_select.database.fields import Kind
from actuator_select.database.queries import batches
from actuator_select.database.schema import ID_LENGTH, TABLES

_SEEN = sa.Table(
    "import_seen",
    sa.MetaData(),
    sa.Column("kind", sa.String(20), primary_key=True),
    sa.Column("field", sa.String(60), primary_key=True),
    sa.Column("value", sa.String(2 * ID_LENGTH), primary_key=True),
    sa.Column("place", sa.Text(), nullable=False),
    prefixes=["TEMPORARY"],
)


class Seen:
    """Values that may stand only once, and where they stood first."""

    def __init__(self, connection: sa.Connection) -> None:
        self._connection = connection

    def places(self, kind: Kind, field: str, values: Iterable[str]) -> dict[str, str]:
        """Where those of `values` stand that have been met in this field."""
        query = sa.select(_SEEN.c.value, _SEEN.c.place).where(_SEEN.c.kind == kind.name, _SEEN.c.field == field)
        return {
            value: place
            for batch in batches(values)
            for value, place in self._connection.execute(query.where(_SEEN.c.value.in_(batch)))
        }

    def note(self, kind: Kind, field: str, places: Mapping[str, str]) -> None:
        """Remember values that were not met before, with their places."""
        if places:
            entries = [{"kind": kind.name, "field": field, "value": one, "place": at} for one, at in places.items()]
            self._connection.execute(_SEEN.insert(), entries)

    def other_ids(self, kind: Kind, field: str) -> list[str]:
        """Ids of the catalogue's rows of a kind that were not met in this field."""
        met = sa.select(_SEEN.c.value).where(_SEEN.c.kind == kind.name, _SEEN.c.field == field)
        ids = TABLES[kind.name].c.id
        return [str(value) for value in self._connection.scalars(sa.select(ids).where(ids.not_in(met)).order_by(ids))]


@contextmanager
def remembering(connection: sa.Connection) -> Iterator[Seen]:
    """Memory for one import, inside its transaction; it goes when the import ends."""
    # A connection that was used before may still hold the table where undoing a transaction does not remove it.
    connection.execute(sa.schema.DropTable(_SEEN, if_exists=True))
    connection.execute(sa.schema.CreateTable(_SEEN))
    yield Seen(connection)
    connection.execute(sa.schema.DropTable(_SEEN))
