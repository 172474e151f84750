"""The tables, derived from the attribute tables. A change here needs a new migration; a test says so."""

from typing import Any

import sqlalchemy as sa

from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import KINDS

SCHEMA_REVISION = "0002"
"""Alembic's head. Stated here so that opening an up-to-date database need not import Alembic; a test compares."""

ID_LENGTH = 100  # characters, as the pattern of ids allows
LARGEST_FLOAT = "1.7976931348623157e308"  # a check against it refuses infinity in every database

metadata = sa.MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
        "ck": "ck_%(table_name)s_%(constraint_name)s",
        "ix": "ix_%(table_name)s_%(column_0_name)s",
    }
)


def _column(field: Field) -> sa.Column[Any]:
    column_type: sa.types.TypeEngine[Any]
    if field.type == "float":
        column_type = sa.Double()
    elif field.type == "int":
        column_type = sa.Integer()
    else:
        # Keys have a length because some databases index no text without one.
        keyed = field.name == "id" or field.references or field.choices or field.unique
        column_type = sa.String(ID_LENGTH if not field.unique else 2 * ID_LENGTH) if keyed else sa.Text()
    references = [sa.ForeignKey(f"{field.references}.id")] if field.references else []
    return sa.Column(field.name, column_type, *references, primary_key=field.name == "id", nullable=not field.required)


def _field_check(field: Field) -> str:
    """SQL of what one column may hold; empty where it may hold anything."""
    if field.choices:
        return f"{field.name} IN ({', '.join(repr(choice) for choice in field.choices)})"
    if field.is_text:
        return f"{field.name} <> ''" if field.required else ""
    conditions = []
    if field.minimum is not None:
        conditions.append(f"{field.name} >= {field.minimum:g}")
    if field.exclusive_minimum is not None:
        conditions.append(f"{field.name} > {field.exclusive_minimum:g}")
    if field.maximum is not None:
        conditions.append(f"{field.name} <= {field.maximum:g}")
    elif not field.may_be_unlimited:
        conditions.append(f"{field.name} <= {LARGEST_FLOAT}")
    return " AND ".join(conditions)


def _table(kind: Kind) -> sa.Table:
    checks = [
        sa.CheckConstraint(condition, name=field.name) for field in kind.columns if (condition := _field_check(field))
    ]
    checks += [
        sa.CheckConstraint(f"{order.greater} >= {order.lesser}", name=f"{order.greater}_order") for order in kind.orders
    ]
    checks += [
        sa.CheckConstraint(" OR ".join(f"{name} IS NOT NULL" for name in group), name="_or_".join(group))
        for group in kind.any_of
    ]
    unique = [sa.UniqueConstraint(field.name) for field in kind.fields if field.unique]
    return sa.Table(kind.name, metadata, *(_column(field) for field in kind.columns), *unique, *checks)


TABLES = {kind.name: _table(kind) for kind in KINDS.values()}

SHIPPED_ROWS = sa.Table(
    "shipped_rows",
    metadata,
    sa.Column("kind", sa.String(20), primary_key=True),
    sa.Column("id", sa.String(ID_LENGTH), primary_key=True),
    sa.Column("digest", sa.String(64), nullable=False),
    comment="Content of every shipped row as it was shipped, to tell edited rows from untouched ones",
)

STATE = sa.Table(
    "catalogue_state",
    metadata,
    sa.Column("name", sa.String(40), primary_key=True),
    sa.Column("value", sa.Text(), nullable=False),
)

CHANGES = sa.Table(
    "changes",
    metadata,
    sa.Column("number", sa.Integer(), primary_key=True, autoincrement=True),
    sa.Column("changed_at", sa.String(20), nullable=False),
    sa.Column("changed_by", sa.Text(), nullable=False),
    sa.Column("action", sa.String(20), nullable=False),
    sa.Column("kind", sa.String(20), nullable=False),
    sa.Column("row_id", sa.String(ID_LENGTH), nullable=False),
    sa.Column("field", sa.String(60)),
    sa.Column("old", sa.Text()),
    sa.Column("new", sa.Text()),
    sa.Index("ix_changes_row_id", "row_id"),
    sa.CheckConstraint("action IN ('added', 'changed', 'removed')", name="action"),
    comment="What happened to every row: when, by what, old and new value",
)
