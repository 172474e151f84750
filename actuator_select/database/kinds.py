"""The attribute tables: every column of every kind of row, with its unit, its range and its meaning."""

from types import MappingProxyType

from actuator_select.database.fields import Field, Kind, Order
from actuator_select.errors import UnknownName, did_you_mean

_DATE_PATTERN = r"\d{4}(-(0[1-9]|1[0-2])(-(0[1-9]|[12]\d|3[01]))?)?"
_DATE_FORM = "a date as 2018, 2018-12 or 2018-12-31"


def _above_zero(
    name: str, unit: str, description: str, *, aliases: tuple[str, ...] = (), may_be_unlimited: bool = False
) -> Field:
    return Field(
        name=name,
        type="float",
        unit=unit,
        description=description,
        exclusive_minimum=0.0,
        aliases=aliases,
        may_be_unlimited=may_be_unlimited,
    )


def _from_zero(name: str, unit: str, description: str) -> Field:
    return Field(name=name, type="float", unit=unit, description=description, minimum=0.0)


def _percent(name: str, description: str, *aliases: str) -> Field:
    # No part has an efficiency of 1 % or less: such a figure is a fraction (1 = 100 %).
    return Field(
        name=name,
        type="float",
        unit="%",
        description=description,
        exclusive_minimum=1.0,
        maximum=100.0,
        aliases=aliases,
    )


def _count(name: str, description: str, maximum: int) -> Field:
    return Field(name=name, type="int", description=description, minimum=1, maximum=maximum)


def _text(name: str, description: str, *aliases: str) -> Field:
    return Field(name=name, type="str", description=description, aliases=aliases)


def _choice(name: str, description: str, *choices: str) -> Field:
    return Field(name=name, type="str", description=description, choices=choices)


def _date(name: str, description: str) -> Field:
    return Field(name=name, type="str", description=description, pattern=_DATE_PATTERN, form=_DATE_FORM)


def _reference(name: str, kind: str, description: str, *, required: bool = True) -> Field:
    return Field(name=name, type="str", description=description, references=kind, required=required)


_ID = Field(
    name="id",
    type="str",
    required=True,
    pattern=r"[A-Za-z0-9][A-Za-z0-9._+-]{0,99}",
    form="up to 100 letters, digits and . _ + -, beginning with a letter or digit",
    description="Name of the row that never changes; unique within its kind",
)

_IDENTITY = (
    _ID,
    _text("manufacturer", "Who makes it", "project_or_manufacturer"),
    _text("series", "The maker's series"),
    _text("part_number", "The maker's part number"),
    _text("description", "What it is, in a few words"),
)

_PRICE = (
    _from_zero("price", "", "Price as quoted, in price_currency"),
    Field(
        name="price_currency",
        type="str",
        pattern="[A-Z]{3}",
        form="a currency code of three capitals such as EUR",
        description="Currency of the price",
    ),
    _text("price_basis", "What the price is for: quantity, tax"),
    _date("price_date", "When the price was quoted"),
)

_PROVENANCE = (
    _text("provenance", "Of what kind the document is, such as manufacturer_datasheet"),
    _choice("check_status", "Outcome of the check when the figures were read", "pass", "flag", "not_checkable"),
    _text("check_notes", "What that check found"),
    _text("notes", "What else a reader has to know"),
    _reference("source_id", "sources", "Document that states the figures"),
    _text("source_location", "Page, table or URL of exactly these figures", "source_url"),
    _text("source_file", "File from which they were read, where that is another one"),
    _date("source_date", "Date of that page or edition, where the source covers several"),
    _date("accessed_date", "When it was read"),
)

SOURCES = Kind(
    name="sources",
    singular="source",
    description="A document that states figures of parts",
    fields=(
        _ID,
        Field(name="document", type="str", required=True, description="Title of the document"),
        _text("authors", "Who wrote it"),
        _text("publisher", "Who published it, with series, volume and issue"),
        _text("page", "Page, table or section"),
        Field(
            name="url",
            type="str",
            pattern=r"[A-Za-z][A-Za-z0-9+.-]*://\S+",
            form="an address such as https://example.org/motors.pdf",
            description="Where the document is",
        ),
        Field(
            name="doi",
            type="str",
            pattern=r"10\.\d{4,9}/\S+",
            form="a DOI such as 10.22190/FUACR1802071F",
            description="Digital object identifier",
        ),
        _date("date", "Date of the document or edition"),
        _date("accessed_date", "When it was read"),
        _text("provenance", "Of what kind the document is, such as journal_article or manufacturer_datasheet"),
        _text("notes", "What else a reader has to know"),
    ),
    shown=("id", "document", "date", "publisher", "page", "doi", "url"),
    any_of=(("page", "url", "doi"), ("date", "accessed_date")),
)

MOTORS = Kind(
    name="motors",
    singular="motor",
    description="An electric motor, as its datasheet states it",
    fields=(
        *_IDENTITY,
        _choice("motor_type", "Construction", "dc_brushed", "bldc", "bldc_torque", "pmsm_servo", "pmsm_direct_drive"),
        _text("supply", "What feeds it, such as DC or a servo drive's class"),
        _choice(
            "electrical_convention",
            "What voltage, current, resistance and constants are measured between and whether they are DC or rms",
            "dc_terminal",
            "dc_phase_to_phase",
            "dc_controller",
            "ac_rms_phase",
        ),
        _choice(
            "figures_at",
            "Shaft that torque, speed, constants and inertia are stated for; empty is the motor's own shaft",
            "motor_shaft",
            "output_shaft",
        ),
        _above_zero("rated_power_w", "W", "Rated mechanical power at the shaft"),
        _above_zero("nominal_voltage_v", "V", "Voltage that the figures hold for, and the limit of the voltage check"),
        _above_zero("no_load_speed_rpm", "rpm", "Speed at nominal voltage without load"),
        _from_zero("no_load_current_a", "A", "Current at nominal voltage without load"),
        _above_zero("rated_speed_rpm", "rpm", "Speed at the rated point", aliases=("nominal_speed_rpm",)),
        _above_zero("rated_torque_nm", "N m", "Continuous torque at rated speed", aliases=("nominal_torque_nm",)),
        _above_zero("rated_current_a", "A", "Current at the rated point", aliases=("nominal_current_a",)),
        _above_zero("standstill_torque_nm", "N m", "Continuous torque near zero speed, a thermal limit"),
        _above_zero("standstill_current_a", "A", "Continuous current near zero speed, a thermal limit"),
        _above_zero("stall_torque_nm", "N m", "Torque of the blocked shaft at full nominal voltage (DC)"),
        _above_zero("stall_current_a", "A", "Current of the blocked shaft at full nominal voltage (DC)"),
        _above_zero("peak_torque_nm", "N m", "The maker's limit of short torque", may_be_unlimited=True),
        _above_zero("peak_current_a", "A", "The maker's limit of short current", may_be_unlimited=True),
        _above_zero("max_speed_rpm", "rpm", "The maker's limit of speed", may_be_unlimited=True),
        _above_zero("terminal_resistance_ohm", "Ω", "Resistance between two terminals"),
        _above_zero("terminal_inductance_mh", "mH", "Inductance between two terminals"),
        _above_zero("torque_constant_nm_per_a", "N m/A", "Torque per current"),
        _above_zero("back_emf_constant_v_s_per_rad", "V s/rad", "Induced voltage per speed"),
        _above_zero("speed_constant_rpm_per_v", "rpm/V", "Speed per induced voltage"),
        _from_zero("viscous_friction_nm_s_per_rad", "N m s/rad", "Friction torque per speed at the shaft"),
        _from_zero("rotor_inertia_g_cm2", "g cm²", "Moment of inertia of the rotor"),
        _percent("max_efficiency_percent", "Best efficiency", "max_efficiency_pct"),
        _count("pole_pairs", "Number of pole pairs", 1000),
        _above_zero("thermal_resistance_winding_housing_k_per_w", "K/W", "Winding to housing"),
        _above_zero("thermal_resistance_housing_ambient_k_per_w", "K/W", "Housing to ambient air"),
        _above_zero("thermal_resistance_winding_ambient_k_per_w", "K/W", "Winding to ambient air, where lumped"),
        _above_zero("thermal_time_constant_winding_s", "s", "Thermal time constant of the winding"),
        _above_zero("thermal_time_constant_motor_s", "s", "Thermal time constant of the motor"),
        _above_zero("max_winding_temperature_c", "°C", "Permissible temperature of the winding"),
        _above_zero("mass_kg", "kg", "Mass"),
        _above_zero("diameter_mm", "mm", "Outer diameter"),
        _above_zero("length_mm", "mm", "Length without the shaft"),
        *_PRICE,
        *_PROVENANCE,
    ),
    shown=(
        "id",
        "rated_power_w",
        "nominal_voltage_v",
        "rated_speed_rpm",
        "rated_torque_nm",
        "standstill_torque_nm",
        "peak_torque_nm",
        "rotor_inertia_g_cm2",
        "mass_kg",
        "max_speed_rpm",
        "manufacturer",
        "part_number",
    ),
    orders=(
        Order(greater="peak_torque_nm", lesser="rated_torque_nm"),
        Order(greater="peak_current_a", lesser="rated_current_a"),
    ),
)

GEARBOXES = Kind(
    name="gearboxes",
    singular="gearbox",
    description="A gearbox between motor and drum",
    fields=(
        *_IDENTITY,
        _text("gear_type", "Construction, such as planetary or strain_wave"),
        _text("version", "The maker's version"),
        _count("stages", "Number of stages", 100),
        _above_zero("ratio", "", "Input speed over output speed"),
        _text("ratio_exact", "The ratio as the fraction printed, such as 37125/361"),
        _above_zero("ratio_nominal", "", "The ratio as rounded by the maker"),
        _percent("efficiency_percent", "Efficiency that the calculations use"),
        _percent("max_efficiency_percent", "Best efficiency", "max_efficiency_pct"),
        _above_zero("max_continuous_torque_nm", "N m", "At the output, continuously", may_be_unlimited=True),
        _above_zero("max_intermittent_torque_nm", "N m", "At the output, for short", may_be_unlimited=True),
        _above_zero("emergency_stop_torque_nm", "N m", "At the output, in an emergency", may_be_unlimited=True),
        _above_zero("nominal_input_speed_rpm", "rpm", "Input speed that the continuous torque holds for"),
        _above_zero("max_continuous_input_speed_rpm", "rpm", "Input speed, continuously", may_be_unlimited=True),
        _above_zero("max_intermittent_input_speed_rpm", "rpm", "Input speed, for short", may_be_unlimited=True),
        _above_zero("max_transmittable_power_continuous_w", "W", "Power, continuously", may_be_unlimited=True),
        _from_zero("backlash_arcmin", "arcmin", "Backlash at the output"),
        _text("backlash_as_printed", "Backlash in the maker's words"),
        _from_zero("inertia_input_g_cm2", "g cm²", "Moment of inertia seen from the input"),
        _above_zero("mass_kg", "kg", "Mass"),
        _above_zero("diameter_mm", "mm", "Outer diameter"),
        _above_zero("length_mm", "mm", "Length without the shafts"),
        *_PRICE,
        *_PROVENANCE,
    ),
    shown=(
        "id",
        "ratio",
        "efficiency_percent",
        "max_efficiency_percent",
        "max_continuous_torque_nm",
        "max_intermittent_torque_nm",
        "max_continuous_input_speed_rpm",
        "inertia_input_g_cm2",
        "backlash_arcmin",
        "mass_kg",
        "manufacturer",
        "part_number",
    ),
    # Not the input speeds: a real datasheet (maxon 166954) allows less for short than continuously.
    orders=(Order(greater="max_intermittent_torque_nm", lesser="max_continuous_torque_nm"),),
)

WINCHES = Kind(
    name="winches",
    singular="winch",
    description="A drum, or a winch around it",
    fields=(
        _ID,
        _choice("winch_type", "Whether it is a drum alone", "winch", "drum"),
        _text("manufacturer", "Who makes it, or the project that uses it", "project_or_manufacturer"),
        _text("name", "What it is called"),
        _above_zero("drum_radius_mm", "mm", "Radius to the centre of the cable"),
        _above_zero("drum_diameter_mm", "mm", "Diameter to the centre of the cable"),
        _above_zero("drum_length_mm", "mm", "Length that takes up cable"),
        _above_zero("groove_pitch_mm", "mm", "Travel per turn"),
        _above_zero("turns", "", "Turns that the drum holds"),
        _above_zero("cable_capacity_m", "m", "Cable that the drum holds"),
        _text("rope_type", "Rope that it is made for"),
        _above_zero("rope_diameter_mm", "mm", "Diameter of that rope"),
        _above_zero("gear_ratio", "", "Ratio of its own gear or belt, motor speed over drum speed"),
        _text("gearbox", "Its own gearbox, as described"),
        _text("motor", "Its own motor, as described"),
        _from_zero("drum_inertia_kg_m2", "kg m²", "Moment of inertia of the drum"),
        _from_zero("winch_inertia_kg_m2", "kg m²", "Moment of inertia of the whole"),
        _choice("winch_inertia_at", "Shaft that winch_inertia_kg_m2 is seen from", "drum_shaft", "motor_shaft"),
        _text("winch_inertia_basis", "What that inertia holds and from where it is seen"),
        _above_zero("mass_kg", "kg", "Mass"),
        _above_zero("max_tension_n", "N", "Cable tension that it bears", may_be_unlimited=True),
        _above_zero("max_cable_speed_m_per_s", "m/s", "Cable speed that it bears", may_be_unlimited=True),
        _above_zero("guide_pulley_radius_mm", "mm", "Radius of its guide pulley"),
        _text("mechanical_advantage", "Reeving, as described"),
        *_PRICE,
        *_PROVENANCE,
    ),
    shown=("id", "name", "drum_radius_mm", "drum_length_mm", "drum_inertia_kg_m2", "max_tension_n", "manufacturer"),
)


def _glob(name: str, kind: str) -> Field:
    return Field(
        name=name,
        type="str",
        required=True,
        pattern=r"[A-Za-z0-9*][A-Za-z0-9._+*-]{0,99}",
        form=f"an id of {kind}, in which * stands for any characters",
        description=f"Which {kind}",
        aliases=(name.removesuffix("_pattern"),),
    )


COMPATIBILITIES = Kind(
    name="compatibilities",
    singular="compatibility",
    description="Motors and gearboxes that fit together, as a maker states it",
    fields=(_ID, _glob("motor_pattern", "motors"), _glob("gearbox_pattern", "gearboxes"), *_PROVENANCE),
    shown=("id", "motor_pattern", "gearbox_pattern", "source_id"),
)

ROPES = Kind(
    name="ropes",
    singular="rope",
    description="A rope or cable by the metre",
    fields=(
        _ID,
        _text("manufacturer", "Who makes or sells it, or the standard", "project_or_manufacturer"),
        _text("name", "What it is called"),
        _text("construction", "Strands, material, grade, coating", "rope_type"),
        _above_zero("diameter_mm", "mm", "Nominal diameter", aliases=("rope_diameter_mm",)),
        _above_zero("breaking_force_n", "N", "Minimum breaking force", aliases=("rope_breaking_force_n",)),
        _above_zero("mass_kg_per_m", "kg/m", "Mass per length", aliases=("rope_mass_kg_per_m",)),
        *_PRICE,
        *_PROVENANCE,
    ),
    shown=("id", "diameter_mm", "breaking_force_n", "mass_kg_per_m", "construction", "manufacturer", "name"),
)

ACTUATORS = Kind(
    name="actuators",
    singular="actuator",
    description="A named assembly of a motor, a gearbox or none, and a winch",
    fields=(
        _ID,
        Field(name="name", type="str", required=True, unique=True, description="What people call it"),
        _reference("motor_id", "motors", "Its motor"),
        _reference("gearbox_id", "gearboxes", "Its gearbox; empty for a drum on the motor's shaft", required=False),
        _reference("winch_id", "winches", "Its drum or winch"),
        _percent("efficiency_percent", "Of the whole assembly, where the source gives only that"),
        *_PRICE,
        *_PROVENANCE,
    ),
    shown=(
        "id",
        "name",
        "motor.rated_power_w",
        "motor.nominal_voltage_v",
        "motor.rated_speed_rpm",
        "motor.rated_torque_nm",
        "gearbox.ratio",
        "efficiency_percent",
        "winch.drum_radius_mm",
    ),
)

KINDS = MappingProxyType(
    {kind.name: kind for kind in (SOURCES, MOTORS, GEARBOXES, COMPATIBILITIES, WINCHES, ROPES, ACTUATORS)}
)
"""Every kind, in an order in which references point backwards."""

ROLES = MappingProxyType({"motor": MOTORS, "gearbox": GEARBOXES, "winch": WINCHES})
"""Kinds that an actuator joins, by the first half of its joined column names."""


def find_kind(name: str) -> Kind:
    """Kind by its plural or singular name.

    Parameters
    ----------
    name : str
        Such as ``motors`` or ``motor``.

    Returns
    -------
    Kind
        Its description.

    Raises
    ------
    UnknownName
        If there is no such kind.
    """
    for kind in KINDS.values():
        if name in {kind.name, kind.singular}:
            return kind
    raise UnknownName(f"the catalogue has no kind {name!r}; {did_you_mean(name, list(KINDS))}")
