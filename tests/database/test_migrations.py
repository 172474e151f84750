"""Migrations: complete, reversible, and the same as the tables that the program uses."""

from collections.abc import Iterator

import pytest
import sqlalchemy as sa
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory

from actuator_select._resources import shipped_dir
from actuator_select.database import migration
from actuator_select.database.connection import database_url, make_engine, reading, writing
from actuator_select.database.schema import SCHEMA_REVISION, metadata

TABLES = [
    "actuators",
    "catalogue_state",
    "changes",
    "compatibilities",
    "gearboxes",
    "motors",
    "ropes",
    "shipped_rows",
    "sources",
    "winches",
]

ROPES = """\
CREATE TABLE ropes (
    id VARCHAR(100) NOT NULL,
    manufacturer TEXT,
    name TEXT,
    construction TEXT,
    diameter_mm DOUBLE,
    breaking_force_n DOUBLE,
    mass_kg_per_m DOUBLE,
    price DOUBLE,
    price_currency TEXT,
    price_basis TEXT,
    price_date TEXT,
    provenance TEXT,
    check_status VARCHAR(100),
    check_notes TEXT,
    notes TEXT,
    source_id VARCHAR(100) NOT NULL,
    source_location TEXT,
    source_file TEXT,
    source_date TEXT,
    accessed_date TEXT,
    origin VARCHAR(100) NOT NULL,
    CONSTRAINT pk_ropes PRIMARY KEY (id),
    CONSTRAINT fk_ropes_source_id FOREIGN KEY(source_id) REFERENCES sources (id),
    CONSTRAINT ck_ropes_id CHECK (id <> ''),
    CONSTRAINT ck_ropes_diameter_mm CHECK (diameter_mm > 0 AND diameter_mm <= 1.7976931348623157e308),
    CONSTRAINT ck_ropes_breaking_force_n CHECK (breaking_force_n > 0 AND breaking_force_n <= 1.7976931348623157e308),
    CONSTRAINT ck_ropes_mass_kg_per_m CHECK (mass_kg_per_m > 0 AND mass_kg_per_m <= 1.7976931348623157e308),
    CONSTRAINT ck_ropes_price CHECK (price >= 0 AND price <= 1.7976931348623157e308),
    CONSTRAINT ck_ropes_check_status CHECK (check_status IN ('pass', 'flag', 'not_checkable')),
    CONSTRAINT ck_ropes_source_id CHECK (source_id <> ''),
    CONSTRAINT ck_ropes_origin CHECK (origin IN ('shipped', 'user'))
)"""


@pytest.fixture
def engine() -> Iterator[sa.Engine]:
    made = make_engine(database_url(":memory:"))
    yield made
    made.dispose()


@pytest.fixture
def migrated(engine: sa.Engine) -> sa.Engine:
    with writing(engine) as connection:
        migration.upgrade(connection, None, "test")
    return engine


def test_upgrading_from_empty_makes_every_table(migrated: sa.Engine) -> None:
    with reading(migrated) as connection:
        assert sorted(sa.inspect(connection).get_table_names()) == sorted([*TABLES, "alembic_version"])


def test_downgrading_leaves_nothing(migrated: sa.Engine) -> None:
    with writing(migrated) as connection:
        migration.downgrade(connection, "base")
    with reading(migrated) as connection:
        assert sa.inspect(connection).get_table_names() == ["alembic_version"]


def test_the_tables_are_as_released(migrated: sa.Engine) -> None:
    with reading(migrated) as connection:
        released = connection.scalar(sa.text("SELECT sql FROM sqlite_master WHERE name = 'ropes'"))
    assert str(released).split() == ROPES.split()


def test_the_program_and_the_migrations_agree_on_columns(migrated: sa.Engine) -> None:
    with reading(migrated) as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, metadata) == []


@pytest.mark.parametrize("table", TABLES)
def test_the_program_and_the_migrations_agree_on_every_constraint(migrated: sa.Engine, table: str) -> None:
    # Alembic's own comparison does not see CHECK constraints.
    modelled = make_engine(database_url(":memory:"))
    with writing(modelled) as connection:
        metadata.create_all(connection)
    with reading(migrated) as ours, reading(modelled) as theirs:
        assert _constraints(ours, table) == _constraints(theirs, table)
    modelled.dispose()


def test_the_stated_revision_is_the_newest() -> None:
    assert ScriptDirectory(str(shipped_dir("migrations"))).get_current_head() == SCHEMA_REVISION


def test_a_migration_that_is_interrupted_leaves_nothing(engine: sa.Engine) -> None:
    def migrate_and_stop() -> None:
        with writing(engine) as connection:
            migration.upgrade(connection, None, "test")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        migrate_and_stop()
    with reading(engine) as connection:
        assert sa.inspect(connection).get_table_names() == []


def _constraints(connection: sa.Connection, table: str) -> dict[str, object]:
    inspector = sa.inspect(connection)
    return {
        "check": sorted((str(one["name"]), one["sqltext"]) for one in inspector.get_check_constraints(table)),
        "foreign": sorted(map(str, inspector.get_foreign_keys(table))),
        "unique": inspector.get_unique_constraints(table),
        "primary": inspector.get_pk_constraint(table),
        "columns": sorted((one["name"], str(one["type"]), one["nullable"]) for one in inspector.get_columns(table)),
        "indexes": inspector.get_indexes(table),
    }
