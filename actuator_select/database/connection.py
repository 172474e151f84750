"""Reaching a database: its address, its transactions, its upkeep on opening, and what can be wrong with it."""

import os
import re
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from actuator_select._resources import user_data_dir
from actuator_select.database import migration, shipped
from actuator_select.database.queries import fetch_state
from actuator_select.errors import CatalogueUnavailable, InvalidRows

ENVIRONMENT_VARIABLE = "ACTUATOR_SELECT_DATABASE"
BUSY_TIMEOUT = 5.0  # seconds to wait for another program's write to end
_MEMORY = {"", ":memory:"}

_CAUSES = (
    ("locked", "another program is reading or writing it; wait until it is done, or close it"),
    ("readonly", "it cannot be written; change its permissions, or choose another with --database"),
    ("read-only", "it cannot be written; change its permissions, or choose another with --database"),
    ("not a database", "the file is not an SQLite database; choose another with --database"),
    ("malformed", "the file is damaged; restore it from a copy, or choose another with --database"),
    ("unable to open", "the file cannot be opened; check that it is a file that you may read"),
    ("full", "the disk is full; make room and repeat"),
)


def database_url(url: str | Path | None) -> sa.URL:
    """Address of the catalogue.

    Parameters
    ----------
    url : str or Path or None
        A file, an SQLAlchemy URL or ``":memory:"``; None is the environment variable
        ``ACTUATOR_SELECT_DATABASE``, else the file in the user's data folder.

    Returns
    -------
    sqlalchemy.URL
        Its URL.

    Raises
    ------
    CatalogueUnavailable
        If it is no URL.
    """
    if url is None or url == "":
        url = os.environ.get(ENVIRONMENT_VARIABLE) or user_data_dir() / "catalogue.db"
    if isinstance(url, str) and "://" in url:
        try:
            return sa.make_url(url)
        except sa.exc.ArgumentError as error:
            raise CatalogueUnavailable(
                f"{_without_password(url)!r} is no database URL; write a file name, or a URL such as sqlite:///parts.db"
            ) from error
    memory = str(url) in _MEMORY
    return sa.URL.create("sqlite", database=":memory:" if memory else str(Path(url).expanduser()))


def make_engine(url: sa.URL) -> sa.Engine:
    """Engine with foreign keys on and honest transactions, in which DDL takes part.

    Parameters
    ----------
    url : sqlalchemy.URL
        Of the database; of the folders only the user's data folder is made.

    Returns
    -------
    sqlalchemy.Engine
        Not yet connected.

    Raises
    ------
    CatalogueUnavailable
        If the folder cannot be made or the driver is missing.
    """
    sqlite = url.get_backend_name() == "sqlite" if _is_known(url) else False
    options: dict[str, Any] = {}
    if sqlite:
        options["connect_args"] = {} if "timeout" in url.query else {"timeout": BUSY_TIMEOUT}
        if url.database is None or url.database in _MEMORY:
            # Every connection to ":memory:" is a database of its own, so there may be only one.
            options["poolclass"] = sa.StaticPool
            options["connect_args"]["check_same_thread"] = False
        elif not url.database.startswith("file:"):
            _make_folder(Path(url.database).parent)
    try:
        engine = sa.create_engine(url, **options)
    except (ImportError, sa.exc.ArgumentError, TypeError) as error:
        raise CatalogueUnavailable(
            f"cannot use the database {shown(url)}: {error}; install the driver that the URL names, or use a file"
        ) from error
    if sqlite:
        sa.event.listen(engine, "connect", _set_up_sqlite)
        sa.event.listen(engine, "begin", _begin_sqlite)
    return engine


@contextmanager
def reading(engine: sa.Engine) -> Iterator[sa.Connection]:
    """Transaction that reads; what is wrong with the database becomes a `CatalogueUnavailable`."""
    with explaining(engine), engine.connect() as connection, connection.begin():
        yield connection


@contextmanager
def writing(engine: sa.Engine, *, keep: bool = True) -> Iterator[sa.Connection]:
    """Transaction that writes, all or nothing; no other program can write between its reads and writes.

    `keep` says whether what was written stays; a trial is undone.
    """
    with explaining(engine), engine.connect() as connection:
        connection.execution_options(writing=True)
        with connection.begin() as transaction:
            yield connection
            if not keep:
                transaction.rollback()


@contextmanager
def explaining(engine: sa.Engine) -> Iterator[None]:
    """Turn a database's error into one that says what to do."""
    try:
        yield
    except sa.exc.IntegrityError as error:
        raise InvalidRows(f"the database refuses the rows: {error.orig}; nothing was written") from error
    except sa.exc.DBAPIError as error:
        raise unavailable(shown(engine.url), str(error.orig)) from error


def unavailable(name: str, message: str) -> CatalogueUnavailable:
    """Error that explains a database's own `message`."""
    return CatalogueUnavailable(f"the catalogue {name} {_cause(message)}")


def prepare(engine: sa.Engine) -> tuple[str, ...]:
    """Migrate and fill the database where it needs it, in one transaction.

    Parameters
    ----------
    engine : sqlalchemy.Engine
        The database.

    Returns
    -------
    tuple of str
        What the user should know.

    Raises
    ------
    CatalogueUnavailable
        If it is not a catalogue, is newer than the program, or cannot be read or written.
    """
    with reading(engine) as connection:
        revision = revision_of(connection, shown(engine.url))
        if revision == migration.SCHEMA_REVISION and _is_filled(connection):
            return ()
    try:
        with writing(engine) as connection:
            # Another process may have done it while this one waited for its turn.
            revision = revision_of(connection, shown(engine.url))
            if revision != migration.SCHEMA_REVISION:
                migration.upgrade(connection, revision, shown(engine.url))
            notices = () if _is_filled(connection) else shipped.refresh(connection)
    except CatalogueUnavailable:
        if revision != migration.SCHEMA_REVISION:
            raise
        return (f"The catalogue {shown(engine.url)} cannot be written now; its shipped rows are of another version.",)
    made = revision is None and engine.url.database not in _MEMORY
    return (f"Made the catalogue {shown(engine.url)}.", *notices) if made else notices


def revision_of(connection: sa.Connection, name: str) -> str | None:
    """Revision of a database that messages call `name`, None for an empty one."""
    tables = set(sa.inspect(connection).get_table_names())
    return migration.current_revision(connection, tables, name)


def shown(url: sa.URL) -> str:
    """Name of a database in messages, without its password."""
    if url.get_backend_name() == "sqlite" and url.database and not url.query:
        return url.database
    return url.render_as_string(hide_password=True)


def _is_filled(connection: sa.Connection) -> bool:
    return fetch_state(connection, shipped.DIGEST_STATE) == shipped.shipped_digest()


def _is_known(url: sa.URL) -> bool:
    try:
        url.get_dialect()
    except sa.exc.ArgumentError as error:
        raise CatalogueUnavailable(
            f"{shown(url)} names no kind of database that can be used; write a file name, or a URL such as "
            "sqlite:///parts.db"
        ) from error
    except ImportError:
        return False
    return True


def _make_folder(folder: Path) -> None:
    """Make the user's data folder; a folder that the user names has to exist, because it may be a slip."""
    if folder.is_dir():
        return
    if folder != user_data_dir():
        raise CatalogueUnavailable(
            f"there is no folder {folder} for the catalogue; make it, or name another file with --database or "
            f"{ENVIRONMENT_VARIABLE}"
        )
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CatalogueUnavailable(
            f"cannot make the folder {folder} of the catalogue: {error.strerror or error}; choose another file with "
            f"--database or {ENVIRONMENT_VARIABLE}"
        ) from error


def _set_up_sqlite(connection: sqlite3.Connection, _record: object) -> None:
    # SQLAlchemy's recipe for transactions that hold DDL and SELECT, too: the driver begins none by itself.
    connection.isolation_level = None
    connection.execute("PRAGMA foreign_keys = ON")
    # The built-in lower() knows ASCII only, so that "contains" would find no 'Stöber' for 'STÖBER'.
    connection.create_function("lower", 1, _lower, deterministic=True)


def _lower(value: str | float | bytes | None) -> str | float | bytes | None:
    return value.lower() if isinstance(value, str) else value


def _begin_sqlite(connection: sa.Connection) -> None:
    immediate = connection.get_execution_options().get("writing", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if immediate else "BEGIN")


def _cause(message: str) -> str:
    for words, cause in _CAUSES:
        if words in message.casefold():
            return f"is unavailable ({message}): {cause}"
    return f"is unavailable: {message.strip()}; choose another with --database or {ENVIRONMENT_VARIABLE}"


def _without_password(text: str) -> str:
    return re.sub(r":[^:@/]*@", ":***@", text)
