"""Shafts that figures are stated for, motors and gearboxes that fit together, and the history of every row."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add two columns and two tables."""
    _add_choice("motors", "figures_at", "motor_shaft", "output_shaft")
    _add_choice("winches", "winch_inertia_at", "drum_shaft", "motor_shaft")
    op.create_table(
        "compatibilities",
        sa.Column("id", sa.String(100), nullable=False),
        sa.Column("motor_pattern", sa.Text(), nullable=False),
        sa.Column("gearbox_pattern", sa.Text(), nullable=False),
        sa.Column("provenance", sa.Text(), nullable=True),
        sa.Column("check_status", sa.String(100), nullable=True),
        sa.Column("check_notes", sa.Text(), nullable=True),
        sa.Column("notes", sa.Text(), nullable=True),
        sa.Column("source_id", sa.String(100), nullable=False),
        sa.Column("source_location", sa.Text(), nullable=True),
        sa.Column("source_file", sa.Text(), nullable=True),
        sa.Column("source_date", sa.Text(), nullable=True),
        sa.Column("accessed_date", sa.Text(), nullable=True),
        sa.Column("origin", sa.String(100), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_compatibilities")),
        sa.ForeignKeyConstraint(["source_id"], ["sources.id"], name=op.f("fk_compatibilities_source_id")),
        sa.CheckConstraint("id <> ''", name=op.f("ck_compatibilities_id")),
        sa.CheckConstraint("motor_pattern <> ''", name=op.f("ck_compatibilities_motor_pattern")),
        sa.CheckConstraint("gearbox_pattern <> ''", name=op.f("ck_compatibilities_gearbox_pattern")),
        sa.CheckConstraint(
            "check_status IN ('pass', 'flag', 'not_checkable')", name=op.f("ck_compatibilities_check_status")
        ),
        sa.CheckConstraint("source_id <> ''", name=op.f("ck_compatibilities_source_id")),
        sa.CheckConstraint("origin IN ('shipped', 'user')", name=op.f("ck_compatibilities_origin")),
    )
    op.create_table(
        "changes",
        sa.Column("number", sa.Integer(), autoincrement=True, nullable=False),
        sa.Column("changed_at", sa.String(20), nullable=False),
        sa.Column("changed_by", sa.Text(), nullable=False),
        sa.Column("action", sa.String(20), nullable=False),
        sa.Column("kind", sa.String(20), nullable=False),
        sa.Column("row_id", sa.String(100), nullable=False),
        sa.Column("field", sa.String(60), nullable=True),
        sa.Column("old", sa.Text(), nullable=True),
        sa.Column("new", sa.Text(), nullable=True),
        sa.PrimaryKeyConstraint("number", name=op.f("pk_changes")),
        sa.CheckConstraint("action IN ('added', 'changed', 'removed')", name=op.f("ck_changes_action")),
        comment="What happened to every row: when, by what, old and new value",
    )
    op.create_index(op.f("ix_changes_row_id"), "changes", ["row_id"])


def downgrade() -> None:
    """Take them away; what the new columns and tables held is lost."""
    op.drop_table("changes")
    op.drop_table("compatibilities")
    op.drop_column("winches", "winch_inertia_at")
    op.drop_column("motors", "figures_at")


def _add_choice(table: str, name: str, *choices: str) -> None:
    # As part of the column, because SQLite adds no constraint to a table that exists.
    listed = ", ".join(f"'{choice}'" for choice in choices)
    check = sa.CheckConstraint(f"{name} IN ({listed})", name=op.f(f"ck_{table}_{name}"))
    op.add_column(table, sa.Column(name, sa.String(100), check, nullable=True))
