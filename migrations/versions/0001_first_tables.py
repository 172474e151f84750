"""The first tables: sources, motors, gearboxes, winches, ropes, actuators, and what the program remembers."""

from collections.abc import Sequence

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None

LARGEST_FLOAT = "1.7976931348623157e308"

Described = tuple["sa.Column[object]", str]
"""A column and the condition that its values meet."""


def upgrade() -> None:
    """Make the tables."""
    op.create_table(
        "catalogue_state",
        sa.Column("name", sa.String(40), nullable=False),
        sa.Column("value", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("name", name=op.f("pk_catalogue_state")),
    )
    op.create_table(
        "shipped_rows",
        sa.Column("kind", sa.String(20), nullable=False),
        sa.Column("id", sa.String(100), nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.PrimaryKeyConstraint("kind", "id", name=op.f("pk_shipped_rows")),
        comment="Content of every shipped row as it was shipped, to tell edited rows from untouched ones",
    )
    _make_sources()
    _make_motors()
    _make_gearboxes()
    _make_winches()
    _make_ropes()
    _make_actuators()


def downgrade() -> None:
    """Drop the tables."""
    for table in ("actuators", "ropes", "winches", "gearboxes", "motors", "sources", "shipped_rows", "catalogue_state"):
        op.drop_table(table)


def _make(table: str, columns: Sequence[Described], *constraints: sa.Constraint, **references: str) -> None:
    op.create_table(
        table,
        *(column for column, _ in columns),
        sa.PrimaryKeyConstraint("id", name=op.f(f"pk_{table}")),
        *(
            sa.ForeignKeyConstraint([name], [f"{other}.id"], name=op.f(f"fk_{table}_{name}"))
            for name, other in references.items()
        ),
        *(
            sa.CheckConstraint(condition, name=op.f(f"ck_{table}_{column.name}"))
            for column, condition in columns
            if condition
        ),
        *constraints,
    )


def _text(name: str) -> Described:
    return sa.Column(name, sa.Text(), nullable=True), ""


def _required_text(name: str) -> Described:
    return sa.Column(name, sa.Text(), nullable=False), f"{name} <> ''"


def _key(name: str) -> Described:
    return sa.Column(name, sa.String(100), nullable=False), f"{name} <> ''"


def _choice(name: str, *choices: str, nullable: bool = True) -> Described:
    listed = ", ".join(f"'{choice}'" for choice in choices)
    return sa.Column(name, sa.String(100), nullable=nullable), f"{name} IN ({listed})"


def _count(name: str, maximum: int) -> Described:
    return sa.Column(name, sa.Integer(), nullable=True), f"{name} >= 1 AND {name} <= {maximum}"


def _above_zero(name: str) -> Described:
    return sa.Column(name, sa.Double(), nullable=True), f"{name} > 0 AND {name} <= {LARGEST_FLOAT}"


def _above_zero_or_unlimited(name: str) -> Described:
    return sa.Column(name, sa.Double(), nullable=True), f"{name} > 0"


def _from_zero(name: str) -> Described:
    return sa.Column(name, sa.Double(), nullable=True), f"{name} >= 0 AND {name} <= {LARGEST_FLOAT}"


def _percent(name: str) -> Described:
    return sa.Column(name, sa.Double(), nullable=True), f"{name} > 1 AND {name} <= 100"


def _price() -> tuple[Described, ...]:
    return (_from_zero("price"), _text("price_currency"), _text("price_basis"), _text("price_date"))


def _provenance() -> tuple[Described, ...]:
    return (
        _text("provenance"),
        _choice("check_status", "pass", "flag", "not_checkable"),
        _text("check_notes"),
        _text("notes"),
        _key("source_id"),
        _text("source_location"),
        _text("source_file"),
        _text("source_date"),
        _text("accessed_date"),
        _choice("origin", "shipped", "user", nullable=False),
    )


def _make_sources() -> None:
    _make(
        "sources",
        (
            _key("id"),
            _required_text("document"),
            _text("authors"),
            _text("publisher"),
            _text("page"),
            _text("url"),
            _text("doi"),
            _text("date"),
            _text("accessed_date"),
            _text("provenance"),
            _text("notes"),
            _choice("origin", "shipped", "user", nullable=False),
        ),
        sa.CheckConstraint(
            "page IS NOT NULL OR url IS NOT NULL OR doi IS NOT NULL", name=op.f("ck_sources_page_or_url_or_doi")
        ),
        sa.CheckConstraint(
            "date IS NOT NULL OR accessed_date IS NOT NULL", name=op.f("ck_sources_date_or_accessed_date")
        ),
    )


def _make_motors() -> None:
    _make(
        "motors",
        (
            _key("id"),
            _text("manufacturer"),
            _text("series"),
            _text("part_number"),
            _text("description"),
            _choice("motor_type", "dc_brushed", "bldc", "bldc_torque", "pmsm_servo", "pmsm_direct_drive"),
            _text("supply"),
            _choice("electrical_convention", "dc_terminal", "dc_phase_to_phase", "dc_controller", "ac_rms_phase"),
            _above_zero("rated_power_w"),
            _above_zero("nominal_voltage_v"),
            _above_zero("no_load_speed_rpm"),
            _from_zero("no_load_current_a"),
            _above_zero("rated_speed_rpm"),
            _above_zero("rated_torque_nm"),
            _above_zero("rated_current_a"),
            _above_zero("standstill_torque_nm"),
            _above_zero("standstill_current_a"),
            _above_zero("stall_torque_nm"),
            _above_zero("stall_current_a"),
            _above_zero_or_unlimited("peak_torque_nm"),
            _above_zero_or_unlimited("peak_current_a"),
            _above_zero_or_unlimited("max_speed_rpm"),
            _above_zero("terminal_resistance_ohm"),
            _above_zero("terminal_inductance_mh"),
            _above_zero("torque_constant_nm_per_a"),
            _above_zero("back_emf_constant_v_s_per_rad"),
            _above_zero("speed_constant_rpm_per_v"),
            _from_zero("viscous_friction_nm_s_per_rad"),
            _from_zero("rotor_inertia_g_cm2"),
            _percent("max_efficiency_percent"),
            _count("pole_pairs", 1000),
            _above_zero("thermal_resistance_winding_housing_k_per_w"),
            _above_zero("thermal_resistance_housing_ambient_k_per_w"),
            _above_zero("thermal_resistance_winding_ambient_k_per_w"),
            _above_zero("thermal_time_constant_winding_s"),
            _above_zero("thermal_time_constant_motor_s"),
            _above_zero("max_winding_temperature_c"),
            _above_zero("mass_kg"),
            _above_zero("diameter_mm"),
            _above_zero("length_mm"),
            *_price(),
            *_provenance(),
        ),
        sa.CheckConstraint("peak_torque_nm >= rated_torque_nm", name=op.f("ck_motors_peak_torque_nm_order")),
        sa.CheckConstraint("peak_current_a >= rated_current_a", name=op.f("ck_motors_peak_current_a_order")),
        source_id="sources",
    )


def _make_gearboxes() -> None:
    _make(
        "gearboxes",
        (
            _key("id"),
            _text("manufacturer"),
            _text("series"),
            _text("part_number"),
            _text("description"),
            _text("gear_type"),
            _text("version"),
            _count("stages", 100),
            _above_zero("ratio"),
            _text("ratio_exact"),
            _above_zero("ratio_nominal"),
            _percent("efficiency_percent"),
            _percent("max_efficiency_percent"),
            _above_zero_or_unlimited("max_continuous_torque_nm"),
            _above_zero_or_unlimited("max_intermittent_torque_nm"),
            _above_zero_or_unlimited("emergency_stop_torque_nm"),
            _above_zero("nominal_input_speed_rpm"),
            _above_zero_or_unlimited("max_continuous_input_speed_rpm"),
            _above_zero_or_unlimited("max_intermittent_input_speed_rpm"),
            _above_zero_or_unlimited("max_transmittable_power_continuous_w"),
            _from_zero("backlash_arcmin"),
            _text("backlash_as_printed"),
            _from_zero("inertia_input_g_cm2"),
            _above_zero("mass_kg"),
            _above_zero("diameter_mm"),
            _above_zero("length_mm"),
            *_price(),
            *_provenance(),
        ),
        sa.CheckConstraint(
            "max_intermittent_torque_nm >= max_continuous_torque_nm",
            name=op.f("ck_gearboxes_max_intermittent_torque_nm_order"),
        ),
        source_id="sources",
    )


def _make_winches() -> None:
    _make(
        "winches",
        (
            _key("id"),
            _choice("winch_type", "winch", "drum"),
            _text("manufacturer"),
            _text("name"),
            _above_zero("drum_radius_mm"),
            _above_zero("drum_diameter_mm"),
            _above_zero("drum_length_mm"),
            _above_zero("groove_pitch_mm"),
            _above_zero("turns"),
            _above_zero("cable_capacity_m"),
            _text("rope_type"),
            _above_zero("rope_diameter_mm"),
            _above_zero("gear_ratio"),
            _text("gearbox"),
            _text("motor"),
            _from_zero("drum_inertia_kg_m2"),
            _from_zero("winch_inertia_kg_m2"),
            _text("winch_inertia_basis"),
            _above_zero("mass_kg"),
            _above_zero_or_unlimited("max_tension_n"),
            _above_zero_or_unlimited("max_cable_speed_m_per_s"),
            _above_zero("guide_pulley_radius_mm"),
            _text("mechanical_advantage"),
            *_price(),
            *_provenance(),
        ),
        source_id="sources",
    )


def _make_ropes() -> None:
    _make(
        "ropes",
        (
            _key("id"),
            _text("manufacturer"),
            _text("name"),
            _text("construction"),
            _above_zero("diameter_mm"),
            _above_zero("breaking_force_n"),
            _above_zero("mass_kg_per_m"),
            *_price(),
            *_provenance(),
        ),
        source_id="sources",
    )


def _make_actuators() -> None:
    _make(
        "actuators",
        (
            _key("id"),
            (sa.Column("name", sa.String(200), nullable=False), "name <> ''"),
            _key("motor_id"),
            (sa.Column("gearbox_id", sa.String(100), nullable=True), ""),
            _key("winch_id"),
            _percent("efficiency_percent"),
            *_price(),
            *_provenance(),
        ),
        sa.UniqueConstraint("name", name=op.f("uq_actuators_name")),
        motor_id="motors",
        gearbox_id="gearboxes",
        winch_id="winches",
        source_id="sources",
    )
