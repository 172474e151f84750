"""Parts that tests add to a catalogue: real motors of every convention, and assemblies of them."""

from actuator_select import Catalogue

# The five actuators of Table 1 as printed; a shipped catalogue holds others beside them.
PRINTED = "id in (" + ", ".join(f"'filipovic-kevac-2018-{number}'" for number in range(1, 6)) + ")"
SOURCE = {"source_id": "filipovic-kevac-2018"}
WINCH = "filipovic-kevac-2018-winch"
# Yaskawa SGMAH-02A and the like: an AC servo in its maker's terms.
SERVO = {
    "motor_type": "pmsm_servo",
    "electrical_convention": "ac_rms_phase",
    "rated_power_w": 200,
    "rated_speed_rpm": 5000,
    "rated_torque_nm": 0.637,
    "peak_torque_nm": 1.91,
    "max_speed_rpm": 6000,
    "torque_constant_nm_per_a": 0.327,
    "rotor_inertia_g_cm2": 106,
}
# A DC motor that states neither friction nor back-EMF constant, as datasheets do.
DC = {
    "motor_type": "bldc",
    "electrical_convention": "dc_phase_to_phase",
    "nominal_voltage_v": 60,
    "rated_speed_rpm": 5000,
    "rated_torque_nm": 0.637,
    "terminal_resistance_ohm": 0.369,
    "torque_constant_nm_per_a": 0.095,
    "speed_constant_rpm_per_v": 100.5,
    "rotor_inertia_g_cm2": 106,
}
TWIN_MOTORS = {  # maxon's figures
    "maxon-236662": {
        "motor_type": "dc_brushed",
        "electrical_convention": "dc_terminal",
        "rated_power_w": 20,
        "nominal_voltage_v": 24,
        "no_load_speed_rpm": 6460,
        "no_load_current_a": 0.0428,
        "rated_speed_rpm": 5060,
        "rated_torque_nm": 0.0455,
        "rated_current_a": 1.33,
        "terminal_resistance_ohm": 3.99,
        "torque_constant_nm_per_a": 0.0352,
        "speed_constant_rpm_per_v": 271,
        "rotor_inertia_g_cm2": 45.3,
    },
    "maxon-DCX22L01EBSL596": {
        "motor_type": "dc_brushed",
        "electrical_convention": "dc_terminal",
        "nominal_voltage_v": 18,
        "rated_speed_rpm": 4770,
        "rated_torque_nm": 0.03,
        "rated_current_a": 1.02,
        "terminal_resistance_ohm": 3.01,
        "torque_constant_nm_per_a": 0.0299,
        "speed_constant_rpm_per_v": 320,
        "rotor_inertia_g_cm2": 9.26,
    },
}


def add_drive(
    catalogue: Catalogue,
    name: str,
    motor: dict[str, object],
    *,
    gearbox: dict[str, object] | None = None,
    **own: object,
) -> None:
    """A motor on a gearbox of ratio 30 with the case study's drum; `gearbox` and `own` add figures to these rows."""
    catalogue.add("motors", SOURCE | {"id": f"{name}-motor"} | motor)
    catalogue.add("gearboxes", SOURCE | {"id": f"{name}-gearbox", "ratio": 30} | (gearbox or {}))
    parts = {"motor_id": f"{name}-motor", "gearbox_id": f"{name}-gearbox", "winch_id": WINCH}
    catalogue.add("actuators", SOURCE | {"id": name, "name": name} | parts | own)


def add_twins(catalogue: Catalogue) -> list[str]:
    """Actuators 4 and 5 of Table 1 with the real motors that their figures identify; their ids. Shipped ones stay."""
    there = {row["id"] for row in catalogue.rows("actuators")}
    ids = []
    for number, (motor, figures) in zip("45", TWIN_MOTORS.items(), strict=True):
        printed = f"filipovic-kevac-2018-{number}"
        ids.append(f"{printed}-{motor}")
        if ids[-1] in there:
            continue
        row = catalogue.part(printed)[1]
        catalogue.add("motors", SOURCE | {"id": f"twin-{motor}"} | figures)
        catalogue.add(
            "actuators",
            SOURCE
            | {key: row[key] for key in ("gearbox_id", "winch_id", "efficiency_percent")}
            | {
                "id": ids[-1],
                "name": f"Actuator {number} ({motor.replace('-', ' ', 1)})",
                "motor_id": f"twin-{motor}",
            },
        )
    return ids
