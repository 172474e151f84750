"""Alembic's environment: the program hands over its connection; a developer's `alembic` command opens one."""

import sqlalchemy as sa
from alembic import context

from actuator_select.database.connection import database_url, make_engine, writing
from actuator_select.database.schema import metadata


def _run(connection: sa.Connection) -> None:
    context.configure(connection=connection, target_metadata=metadata, render_as_batch=True)
    with context.begin_transaction():
        context.run_migrations()


connection = context.config.attributes.get("connection")
if connection is not None:
    _run(connection)
else:
    engine = make_engine(database_url(None))
    with writing(engine) as own_connection:
        _run(own_connection)
    engine.dispose()
