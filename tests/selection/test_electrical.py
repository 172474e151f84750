"""What the catalogue's electrical conventions mean, and the back-EMF constant of a row."""

import pytest

from actuator_select.database.kinds import MOTORS
from actuator_select.selection.electrical import (
    ALTERNATING_CURRENT,
    DIRECT_CURRENT,
    MOTOR_TERMINALS,
    NO_TERMINAL_VOLTAGE,
    back_emf_constant,
)


def test_every_convention_of_the_catalogue_is_either_direct_or_alternating_current() -> None:
    choices = set(MOTORS.field("electrical_convention").choices)
    assert choices == DIRECT_CURRENT | ALTERNATING_CURRENT
    assert not DIRECT_CURRENT & ALTERNATING_CURRENT


def test_a_convention_either_gives_the_voltage_at_the_motors_terminals_or_says_why_not() -> None:
    assert set(NO_TERMINAL_VOLTAGE) == (DIRECT_CURRENT | ALTERNATING_CURRENT) - MOTOR_TERMINALS


@pytest.mark.parametrize("role", ["", "motor."])
def test_a_stated_back_emf_constant_goes_before_the_speed_constant(role: str) -> None:
    row = {f"{role}speed_constant_rpm_per_v": 60.0}
    assert back_emf_constant({}, role) is None
    assert back_emf_constant(row, role) == pytest.approx(1.0 / 6.283185307179586)
    assert back_emf_constant(row | {f"{role}back_emf_constant_v_s_per_rad": 0.2}, role) == 0.2
