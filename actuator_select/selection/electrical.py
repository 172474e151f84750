"""What a motor's electrical figures mean: for which conventions which equation holds, and its back-EMF constant."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from actuator_select.units import v_s_per_rad

Row = Mapping[str, Any]

MOTOR_TERMINALS = frozenset({"dc_terminal", "dc_phase_to_phase"})
"""DC values between the motor's own terminals: eqs. 21 and 34 hold, and the rated point stands on the motor's line."""

DIRECT_CURRENT = MOTOR_TERMINALS | {"dc_controller"}
"""DC values: the constants agree with each other, but built-in electronics limit voltage and current themselves."""

ALTERNATING_CURRENT = frozenset({"ac_rms_phase"})
"""Line-to-line rms voltage and rms phase current."""

UNSTATED: frozenset[None] = frozenset({None})
"""Rows that state none; the papers' motors and most users' are DC motors."""

NO_TERMINAL_VOLTAGE: Mapping[str, str] = MappingProxyType(
    {
        "ac_rms_phase": "rms phase values of a servo amplifier",
        "dc_controller": "values in front of built-in electronics",
    }
)
"""Conventions under which eq. 34 says nothing about the motor, with what their figures are."""


def back_emf_constant(row: Row, role: str = "") -> float | None:
    """Back-EMF constant of a motor, as stated or from its speed constant; None where neither is known. [V s/rad]

    Parameters
    ----------
    row : mapping
        A motor, or with ``role="motor."`` a row that joins one.
    role : str
        First part of the column names.
    """
    stated, speed_constant = row.get(f"{role}back_emf_constant_v_s_per_rad"), row.get(f"{role}speed_constant_rpm_per_v")
    if stated is not None:
        return float(stated)
    return None if speed_constant is None else v_s_per_rad(float(speed_constant))
