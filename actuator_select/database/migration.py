"""Bringing a database's tables to the version that this program knows. Alembic is imported only when there is work."""

from typing import TYPE_CHECKING

import sqlalchemy as sa

from actuator_select._resources import shipped_dir
from actuator_select.database.schema import SCHEMA_REVISION
from actuator_select.errors import CatalogueUnavailable

if TYPE_CHECKING:
    from alembic.config import Config

__all__ = ["SCHEMA_REVISION", "current_revision", "downgrade", "upgrade"]

_VERSION_TABLE = sa.table("alembic_version", sa.column("version_num"))


def current_revision(connection: sa.Connection, tables: set[str], shown: str) -> str | None:
    """Revision of a database.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        The database.
    tables : set of str
        Names of its tables.
    shown : str
        Its name in messages.

    Returns
    -------
    str or None
        None for an empty database.

    Raises
    ------
    CatalogueUnavailable
        If the tables are of another program.
    """
    if not tables:
        return None
    if _VERSION_TABLE.name not in tables:
        raise CatalogueUnavailable(
            f"{shown} is a database of another program: it has the tables {', '.join(sorted(tables)[:5])} and no "
            "version; choose another with --database"
        )
    return connection.scalar(sa.select(_VERSION_TABLE.c.version_num))


def upgrade(connection: sa.Connection, revision: str | None, shown: str) -> None:
    """Migrate to the newest revision, in the caller's transaction.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        In a transaction that writes.
    revision : str or None
        What the database has now.
    shown : str
        Its name in messages.

    Raises
    ------
    CatalogueUnavailable
        If a newer program made the database.
    """
    from alembic import command
    from alembic.script import ScriptDirectory

    config = _config(connection)
    known = {script.revision for script in ScriptDirectory.from_config(config).walk_revisions()}
    if revision is not None and revision not in known:
        raise CatalogueUnavailable(
            f"the catalogue {shown} has revision {revision!r}, which this program does not know: a newer program or "
            "another one made it; update actuator-select, or choose another database with --database"
        )
    command.upgrade(config, "head")


def downgrade(connection: sa.Connection, revision: str) -> None:
    """Migrate back to `revision`, ``"base"`` for none, in the caller's transaction."""
    from alembic import command

    command.downgrade(_config(connection), revision)


def _config(connection: sa.Connection) -> "Config":
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(shipped_dir("migrations")).replace("%", "%%"))
    config.attributes["connection"] = connection
    return config
