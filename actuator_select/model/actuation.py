"""From a cable to the motor's terminals: the actuator equation and the limits it has to respect.

Every limit is put at the drum, so that actuators of any radius and ratio are held against the same demand.
The equations are those of [1].

References
----------
.. [1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.units import Quantity


class Check(StrEnum):
    """The limits of eqs. 30, 32, 33 and 34."""

    SPEED = "speed"
    TORQUE = "torque"
    ACCELERATION = "acceleration"
    VOLTAGE = "voltage"


ROUNDING = 1e-12  # relative; a demand that exceeds its limit by less is rounding, and passes

FIGURES_NEEDED: dict[Check, tuple[str, ...]] = {
    Check.SPEED: ("motor_speed", "ratio", "drum_radius"),
    Check.TORQUE: ("motor_torque", "ratio", "efficiency", "drum_radius"),
    Check.ACCELERATION: ("motor_torque", "rotor_inertia", "ratio", "drum_radius"),
    Check.VOLTAGE: (
        "direct_current",
        "voltage",
        "back_emf_constant",
        "torque_constant",
        "resistance",
        "friction",
        "rotor_inertia",
        "ratio",
        "efficiency",
        "drum_radius",
    ),
}


def is_applicable(actuators: ActuatorSet, check: Check) -> BoolArray:
    """Tell to which actuators a check applies, (C,): eq. 34 to those whose electrical figures are DC, or unknown."""
    if check is Check.VOLTAGE:
        return np.asarray(actuators.direct_current != 0.0, dtype=np.bool_)
    return np.ones(len(actuators), dtype=np.bool_)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftCharacteristics:
    """Coefficients of u = G φ̈ + L φ̇ + S M at the shaft behind the gearbox.

    Attributes
    ----------
    inertia_gain : (C,) array
        G. [V s²/rad]
    damping_gain : (C,) array
        L. [V s/rad]
    load_gain : (C,) array
        S. [V/(N m)]
    inertia : (C,) array
        J_r, the rotor's inertia at this shaft as eq. 22 has it, the efficiency included. [kg m²]
    """

    inertia_gain: FloatArray
    damping_gain: FloatArray
    load_gain: FloatArray
    inertia: FloatArray


def stall_torque(torque_constant: Quantity, voltage: Quantity, resistance: Quantity) -> Quantity:
    """C_m U/R_r, torque of the blocked shaft at a voltage, from eq. 21 at rest. [N m]

    Parameters
    ----------
    torque_constant, voltage, resistance : float or array
        Of a DC motor, between its terminals. [N m/A, V, Ω]
    """
    return torque_constant * voltage / resistance


def speed_at_voltage(
    voltage: Quantity, back_emf_constant: Quantity, resistance: Quantity | float = 0.0, current: Quantity | float = 0.0
) -> Quantity:
    """(U - R_r I)/C_e, steady speed of the motor while it takes a current; by default that of a motor without losses.

    Parameters
    ----------
    voltage, back_emf_constant : float or array
        Of a DC motor, between its terminals. [V, V s/rad]
    resistance, current : float or array
        What the voltage drops over; the no-load current gives the no-load speed. [Ω, A]

    Returns
    -------
    float or array
        Negative where the drop exceeds the voltage. [rad/s]
    """
    return (voltage - resistance * current) / back_emf_constant


def torque_ratio(actuators: ActuatorSet) -> FloatArray:
    """N_M = N_V ξ, shaft torque per motor torque, (C,)."""
    return actuators.ratio * actuators.efficiency


def shaft_inertia(actuators: ActuatorSet) -> FloatArray:
    """J_r, the rotor's inertia behind the gearbox as eq. 22 has it, the efficiency included, (C,). [kg m²]"""
    return actuators.rotor_inertia * actuators.ratio * torque_ratio(actuators)


def shaft_characteristics(actuators: ActuatorSet) -> ShaftCharacteristics:
    """Coefficients of eq. 21.

    Parameters
    ----------
    actuators : ActuatorSet
        C actuators.

    Returns
    -------
    ShaftCharacteristics
        NaN where a figure is unknown.
    """
    torque_gain = torque_ratio(actuators)
    speed_times_torque = actuators.ratio * torque_gain
    back_emf = actuators.back_emf_constant * actuators.ratio  # C_E
    torque_constant = actuators.torque_constant * torque_gain  # C_M
    inertia = shaft_inertia(actuators)
    load_gain = actuators.resistance / torque_constant  # S, eq. 22
    return ShaftCharacteristics(
        inertia_gain=inertia * load_gain,  # G, eq. 22
        damping_gain=actuators.friction * speed_times_torque * load_gain + back_emf,  # L, eq. 22
        load_gain=load_gain,
        inertia=inertia,
    )


def cable_speed_limit(actuators: ActuatorSet) -> FloatArray:
    """Greatest cable speed, (C,), eq. 30. [m/s]"""
    return actuators.motor_speed / actuators.ratio * actuators.drum_radius


def cable_force_limit(actuators: ActuatorSet) -> FloatArray:
    """Greatest cable force by torque, (C,), eq. 32. [N]"""
    return actuators.motor_torque * torque_ratio(actuators) / actuators.drum_radius


def cable_acceleration_limit(actuators: ActuatorSet) -> FloatArray:
    """Greatest cable acceleration, (C,), eq. 33; unlimited for a rotor without inertia. [m/s²]

    The efficiency cancels: M_mot N_M / J_r = M_mot / (J_M N_V).
    """
    inertia = actuators.rotor_inertia * actuators.ratio
    with np.errstate(divide="ignore"):
        return actuators.motor_torque / inertia * actuators.drum_radius


def voltage_limit(actuators: ActuatorSet) -> FloatArray:
    """Greatest terminal voltage, (C,), eq. 34; NaN where unknown, and where the figures are not known to be DC. [V]"""
    return np.where(actuators.direct_current == 1.0, actuators.voltage, np.nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class VoltageLine:
    """A limit that falls with speed and acceleration: force + reflected_mass · s + damping · v within ±force_limit.

    Eq. 34 put at the drum, or without damping the sum of eqs. 32 and 33.

    Attributes
    ----------
    reflected_mass : (C,) array
        G/(S R_w²) = J_r/R_w². [kg]
    damping : (C,) array
        L/(S R_w²). [N s/m]
    force_limit : (C,) array
        U/(S R_w), the cable force that the full voltage holds at standstill; or M_mot N_M/R_w. [N]
    """

    reflected_mass: FloatArray
    damping: FloatArray
    force_limit: FloatArray

    def take(self, indices: IntArray) -> "VoltageLine":
        """Actuators at `indices`, in that order."""
        return VoltageLine(
            reflected_mass=self.reflected_mass[indices],
            damping=self.damping[indices],
            force_limit=self.force_limit[indices],
        )


def voltage_line(actuators: ActuatorSet) -> VoltageLine:
    """Eqs. 21 and 34 divided by S R_w.

    Parameters
    ----------
    actuators : ActuatorSet
        C actuators.

    Returns
    -------
    VoltageLine
        NaN where a figure is unknown or the voltage has no limit that is known to be DC.
    """
    shaft = shaft_characteristics(actuators)
    radius = actuators.drum_radius
    return VoltageLine(
        reflected_mass=shaft.inertia / radius**2,
        damping=shaft.damping_gain / (shaft.load_gain * radius**2),
        force_limit=voltage_limit(actuators) / (shaft.load_gain * radius),
    )


def torque_line(actuators: ActuatorSet) -> VoltageLine:
    """Torque for the load and for the rotor's acceleration together, put at the drum: force + reflected_mass · s.

    Parameters
    ----------
    actuators : ActuatorSet
        C actuators.

    Returns
    -------
    VoltageLine
        Without damping; its force limit is that of eq. 32, its reflected mass that of eq. 33. NaN where unknown.
    """
    mass = shaft_inertia(actuators) / actuators.drum_radius**2
    limit = cable_force_limit(actuators)
    return VoltageLine(reflected_mass=mass, damping=np.where(np.isnan(mass + limit), np.nan, 0.0), force_limit=limit)


def utilisation(demand: FloatArray, limit: FloatArray) -> FloatArray:
    """Demand over limit, broadcast.

    Parameters
    ----------
    demand : array
        Not negative; infinite where it is undefined, which exceeds any limit.
    limit : array
        In the same unit; NaN unknown, infinite unlimited.

    Returns
    -------
    array
        0 for no demand, infinite for an undefined one or a limit of zero, NaN for an unknown limit.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = demand / limit
    ratio = np.where(np.isinf(demand), np.inf, np.where(demand == 0.0, 0.0, ratio))
    return np.where(np.isnan(limit), np.nan, ratio)
