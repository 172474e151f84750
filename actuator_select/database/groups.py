"""How the columns of a row are grouped for people, and which of them a reader misses where they are unknown."""

from types import MappingProxyType

_PRICE = ("price", "price_currency", "price_basis", "price_date")
_SOURCE = (
    "source_id",
    "source_location",
    "source_file",
    "source_date",
    "accessed_date",
    "provenance",
    "check_status",
    "check_notes",
    "notes",
)
_IDENTITY = ("id", "manufacturer", "series", "part_number", "description")
_END = {"price": _PRICE, "source": _SOURCE}

GROUPS = MappingProxyType(
    {
        "sources": {
            "what it is": ("id", "document", "authors", "publisher", "page", "date", "origin"),
            "where it is": ("url", "doi", "accessed_date", "provenance", "notes"),
        },
        "motors": {
            "what it is": (*_IDENTITY, "motor_type", "supply", "electrical_convention", "figures_at", "origin"),
            "rated figures": (
                "rated_power_w",
                "nominal_voltage_v",
                "rated_speed_rpm",
                "rated_torque_nm",
                "rated_current_a",
                "no_load_speed_rpm",
                "no_load_current_a",
                "max_efficiency_percent",
            ),
            "limits": (
                "standstill_torque_nm",
                "standstill_current_a",
                "stall_torque_nm",
                "stall_current_a",
                "peak_torque_nm",
                "peak_current_a",
                "max_speed_rpm",
            ),
            "constants": (
                "terminal_resistance_ohm",
                "terminal_inductance_mh",
                "torque_constant_nm_per_a",
                "back_emf_constant_v_s_per_rad",
                "speed_constant_rpm_per_v",
                "viscous_friction_nm_s_per_rad",
                "rotor_inertia_g_cm2",
                "pole_pairs",
            ),
            "thermal": (
                "thermal_resistance_winding_housing_k_per_w",
                "thermal_resistance_housing_ambient_k_per_w",
                "thermal_resistance_winding_ambient_k_per_w",
                "thermal_time_constant_winding_s",
                "thermal_time_constant_motor_s",
                "max_winding_temperature_c",
            ),
            "dimensions": ("mass_kg", "diameter_mm", "length_mm"),
            **_END,
        },
        "gearboxes": {
            "what it is": (*_IDENTITY, "gear_type", "version", "stages", "origin"),
            "ratio and losses": (
                "ratio",
                "ratio_exact",
                "ratio_nominal",
                "efficiency_percent",
                "max_efficiency_percent",
                "inertia_input_g_cm2",
                "backlash_arcmin",
                "backlash_as_printed",
            ),
            "limits": (
                "max_continuous_torque_nm",
                "max_intermittent_torque_nm",
                "emergency_stop_torque_nm",
                "nominal_input_speed_rpm",
                "max_continuous_input_speed_rpm",
                "max_intermittent_input_speed_rpm",
                "max_transmittable_power_continuous_w",
            ),
            "dimensions": ("mass_kg", "diameter_mm", "length_mm"),
            **_END,
        },
        "compatibilities": {
            "what it is": ("id", "motor_pattern", "gearbox_pattern", "origin"),
            "source": _SOURCE,
        },
        "winches": {
            "what it is": ("id", "manufacturer", "name", "winch_type", "motor", "gearbox", "gear_ratio", "origin"),
            "drum and cable": (
                "drum_radius_mm",
                "drum_diameter_mm",
                "drum_length_mm",
                "groove_pitch_mm",
                "turns",
                "cable_capacity_m",
                "rope_type",
                "rope_diameter_mm",
                "guide_pulley_radius_mm",
                "mechanical_advantage",
            ),
            "limits": ("max_tension_n", "max_cable_speed_m_per_s"),
            "inertia and mass": (
                "drum_inertia_kg_m2",
                "winch_inertia_kg_m2",
                "winch_inertia_at",
                "winch_inertia_basis",
                "mass_kg",
            ),
            **_END,
        },
        "ropes": {
            "what it is": ("id", "manufacturer", "name", "construction", "origin"),
            "figures": ("diameter_mm", "breaking_force_n", "mass_kg_per_m"),
            **_END,
        },
        "actuators": {
            "what it is": ("id", "name", "motor_id", "gearbox_id", "winch_id", "efficiency_percent", "origin"),
            **_END,
        },
    }
)
"""Columns by kind and title; every column stands in one group."""

MISSED = MappingProxyType(
    {
        "motors": frozenset(
            {
                "manufacturer",
                "electrical_convention",
                "rated_power_w",
                "nominal_voltage_v",
                "rated_speed_rpm",
                "rated_torque_nm",
                "standstill_torque_nm",
                "peak_torque_nm",
                "max_speed_rpm",
                "terminal_resistance_ohm",
                "torque_constant_nm_per_a",
                "back_emf_constant_v_s_per_rad",
                "rotor_inertia_g_cm2",
                "mass_kg",
            }
        ),
        "gearboxes": frozenset(
            {
                "manufacturer",
                "ratio",
                "efficiency_percent",
                "inertia_input_g_cm2",
                "max_continuous_torque_nm",
                "max_intermittent_torque_nm",
                "max_continuous_input_speed_rpm",
                "mass_kg",
            }
        ),
        "winches": frozenset({"drum_radius_mm", "drum_inertia_kg_m2", "max_tension_n", "max_cable_speed_m_per_s"}),
        "ropes": frozenset({"diameter_mm", "breaking_force_n", "mass_kg_per_m"}),
        "actuators": frozenset({"gearbox_id", "efficiency_percent"}),
    }
)
"""Columns that the calculations need or that people expect: shown as unknown rather than left out."""

NOT_MISSED = MappingProxyType(
    {
        "ac_rms_phase": frozenset(
            {"nominal_voltage_v", "terminal_resistance_ohm", "back_emf_constant_v_s_per_rad", "no_load_speed_rpm"}
        ),
        "dc_terminal": frozenset({"standstill_torque_nm"}),
        "dc_phase_to_phase": frozenset({"standstill_torque_nm"}),
        "dc_controller": frozenset({"standstill_torque_nm"}),
    }
)
"""Columns that nobody misses of a motor with this electrical convention."""

MEANINGS = MappingProxyType(
    {
        "standstill_torque_nm": "continuous, near zero speed",
        "standstill_current_a": "continuous, near zero speed",
        "stall_torque_nm": "shaft blocked at full voltage, never continuous",
        "stall_current_a": "shaft blocked at full voltage, never continuous",
        "rated_torque_nm": "continuous, at rated speed",
        "peak_torque_nm": "for short",
        "peak_current_a": "for short",
        "max_speed_rpm": "the maker's limit",
        "efficiency_percent": "what the calculations use",
        "max_efficiency_percent": "the maker's best value",
        "max_continuous_torque_nm": "at the output",
        "max_intermittent_torque_nm": "at the output, for short",
        "emergency_stop_torque_nm": "at the output, in an emergency",
        "inertia_input_g_cm2": "seen from the input",
    }
)
"""What a figure means, where its name alone is taken for another."""
