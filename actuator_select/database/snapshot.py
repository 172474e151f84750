"""Opening somebody else's catalogue for reading: it is never changed, made, migrated or filled."""

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import cast

import sqlalchemy as sa

from actuator_select.database import migration
from actuator_select.database.connection import (
    BUSY_TIMEOUT,
    database_url,
    make_engine,
    reading,
    revision_of,
    shown,
    unavailable,
    writing,
)
from actuator_select.database.reader import ReadableCatalogue
from actuator_select.errors import CatalogueUnavailable


def open_for_reading(url: str | Path) -> ReadableCatalogue:
    """Open a catalogue without touching it.

    Parameters
    ----------
    url : str or Path
        A file or an SQLAlchemy URL. An SQLite file is copied into memory, and the copy is migrated where it is of an
        older program.

    Returns
    -------
    ReadableCatalogue
        To be closed, or used in a ``with`` statement.

    Raises
    ------
    CatalogueUnavailable
        If there is none, it cannot be read, is of another program or a newer one; or it is older and no SQLite file.
    """
    address = database_url(url)
    copied = _can_be_copied(address)
    engine = make_engine(database_url(":memory:") if copied else address)
    try:
        notices = _fill_copy(engine, address) if copied else _refuse_other_revision(engine)
    except BaseException:
        engine.dispose()
        raise
    return ReadableCatalogue(engine, notices)


def _can_be_copied(address: sa.URL) -> bool:
    return address.drivername.partition("+")[0] == "sqlite"


def _fill_copy(engine: sa.Engine, address: sa.URL) -> tuple[str, ...]:
    """Copy a file into the engine's memory, migrate it there, and tell of it."""
    name = shown(address)
    try:
        _copy_file(engine, address)
    except sqlite3.Error as error:
        raise unavailable(name, str(error)) from error
    with writing(engine) as connection:
        revision = revision_of(connection, name)
        if revision is None:
            raise _no_catalogue(name)
        if revision == migration.SCHEMA_REVISION:
            return ()
        migration.upgrade(connection, revision, name)
    return (f"The catalogue {name} is of an older program (revision {revision}); only a copy in memory was migrated.",)


def _copy_file(engine: sa.Engine, address: sa.URL) -> None:
    with (
        closing(sqlite3.connect(_read_only(address), timeout=BUSY_TIMEOUT, uri=True)) as source,
        closing(engine.raw_connection()) as copy,
    ):
        # `backup` would wait for ever for another program's write; a transaction waits for some seconds.
        source.execute("BEGIN")
        source.execute("SELECT count(*) FROM sqlite_master")
        source.backup(cast("sqlite3.Connection", copy.driver_connection))


def _read_only(address: sa.URL) -> str:
    """SQLite's own address of the file, which opens it for reading alone."""
    file = address.database or ""
    if file.startswith("file:"):
        return f"{file}?mode=ro"
    path = Path(file)
    if not path.is_file():
        raise CatalogueUnavailable(
            f"there is no catalogue file {file or ':memory:'}; name one, or write a URL such as sqlite:///parts.db"
        )
    return f"{path.absolute().as_uri()}?mode=ro"


def _refuse_other_revision(engine: sa.Engine) -> tuple[str, ...]:
    """Refuse a database that would have to be migrated where it stands."""
    name = shown(engine.url)
    with reading(engine) as connection:
        revision = revision_of(connection, name)
    if revision is None:
        raise _no_catalogue(name)
    if revision != migration.SCHEMA_REVISION:
        raise CatalogueUnavailable(
            f"the catalogue {name} has revision {revision!r}, expected {migration.SCHEMA_REVISION!r}; it is not "
            "migrated by reading it: open it with its own program's version, or migrate it with `actuator-select "
            "catalog check --database URL` of this one"
        )
    return ()


def _no_catalogue(name: str) -> CatalogueUnavailable:
    return CatalogueUnavailable(f"{name} is an empty database and no catalogue; name another")
