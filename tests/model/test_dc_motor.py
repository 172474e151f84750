"""Stall torque and speed of a DC motor at a voltage: the ends of eq. 21's line."""

import numpy as np
import pytest

from actuator_select.model.actuation import shaft_characteristics, speed_at_voltage, stall_torque
from actuator_select.model.components import ActuatorSet
from actuator_select.units import rpm, rpm_per_v, v_s_per_rad

# maxon A-max 32, 236662: stall torque 0.212 N m, no-load speed 6460 rpm as printed.
VOLTAGE, RESISTANCE, CONSTANT, SPEED_CONSTANT, NO_LOAD_CURRENT = 24.0, 3.99, 0.0352, 271.0, 0.0428


def test_the_ends_of_a_datasheets_line_are_those_that_it_prints() -> None:
    assert stall_torque(CONSTANT, VOLTAGE, RESISTANCE) == pytest.approx(0.212, abs=5e-4)
    speed = speed_at_voltage(VOLTAGE, v_s_per_rad(SPEED_CONSTANT), RESISTANCE, NO_LOAD_CURRENT)
    assert rpm(speed) == pytest.approx(6460.0, abs=5.0)


def test_the_ends_of_the_line_solve_the_actuator_equation() -> None:
    figures = {
        "voltage": VOLTAGE,
        "resistance": RESISTANCE,
        "torque_constant": CONSTANT,
        "back_emf_constant": CONSTANT,
        "friction": 0.0,
        "rotor_inertia": 0.0,
        "ratio": 1.0,
        "efficiency": 1.0,
    }
    shaft = shaft_characteristics(ActuatorSet.from_figures([figures]))
    assert shaft.load_gain[0] * stall_torque(CONSTANT, VOLTAGE, RESISTANCE) == pytest.approx(VOLTAGE)
    assert shaft.damping_gain[0] * speed_at_voltage(VOLTAGE, CONSTANT) == pytest.approx(VOLTAGE)


def test_arrays_are_taken_like_numbers() -> None:
    constants = np.array([0.03, CONSTANT])
    assert stall_torque(constants, np.full(2, VOLTAGE), np.full(2, RESISTANCE))[1] == pytest.approx(0.2117, abs=1e-4)
    assert speed_at_voltage(np.full(2, VOLTAGE), constants)[1] == pytest.approx(VOLTAGE / CONSTANT)


@pytest.mark.parametrize("constant", [1e-3, 1.0, 271.0])
def test_a_speed_constant_and_a_back_emf_constant_are_each_others_reciprocal(constant: float) -> None:
    assert rpm_per_v(v_s_per_rad(constant)) == pytest.approx(constant, rel=1e-14)
