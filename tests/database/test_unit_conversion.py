"""Units as people spell them, converted to the columns' units."""

import re
from contextlib import suppress
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from actuator_select.database.fields import Field
from actuator_select.database.kinds import GEARBOXES, MOTORS, ROPES
from actuator_select.database.unit_conversion import UnitRefused, conversion

TORQUE = MOTORS.field("rated_torque_nm")
INERTIA = MOTORS.field("rotor_inertia_g_cm2")
SPEED = MOTORS.field("max_speed_rpm")
KV = MOTORS.field("speed_constant_rpm_per_v")
KE = MOTORS.field("back_emf_constant_v_s_per_rad")
POWER = MOTORS.field("rated_power_w")
MASS = MOTORS.field("mass_kg")
TEMPERATURE = MOTORS.field("max_winding_temperature_c")
THERMAL = MOTORS.field("thermal_resistance_winding_housing_k_per_w")
BACKLASH = GEARBOXES.field("backlash_arcmin")
EFFICIENCY = GEARBOXES.field("max_efficiency_percent")
POUND, OUNCE, INCH, GRAVITY = 0.45359237, 0.028349523125, 0.0254, 9.80665  # international definitions


@pytest.mark.parametrize(
    ("unit", "field", "given", "expected"),
    [
        ("mNm", TORQUE, "1.2", 0.0012),
        ("N cm", TORQUE, "3", 0.03),
        ("kgf cm", TORQUE, "1", 0.0980665),
        ("g cm2", INERTIA, "0.3", 0.3),
        ("kg m^2", INERTIA, "1.2e-5", 120.0),
        ("kgcm²", INERTIA, "0.7", 700.0),
        ("V/krpm", KE, "10", 0.0954929658551372),
        ("V/(1000 rpm)", KE, "10", 0.0954929658551372),
        ("V s", KE, "0.1", 0.1),
        ("1/min/V", KV, "100", 100.0),
        ("lb", MASS, "2", 0.90718474),
        ("g", MASS, "230", 0.23),
        ("deg", BACKLASH, "0.8", 48.0),
        ("°F", TEMPERATURE, "311", 155.0),
        ("K", TEMPERATURE, "428.15", 155.0),
        ("°C/W", THERMAL, "2.5", 2.5),
        ("1", EFFICIENCY, "0.81", 81.0),
        ("in", MOTORS.field("length_mm"), "1.5", 38.1),
        ("H", MOTORS.field("terminal_inductance_mh"), "0.00035", 0.35),
        ("min", MOTORS.field("thermal_time_constant_motor_s"), "12", 720.0),
        ("Vs/rad", KE, "0.1", 0.1),
        ("mVs/rad", KE, "12", 0.012),
        ("V/1000min⁻¹", KE, "10", 0.0954929658551372),
        ("V/1000 min⁻¹", KE, "10", 0.0954929658551372),
        ("kgm²", INERTIA, "1.2e-5", 120.0),
        ("10⁻⁷kgm²", INERTIA, "3.5", 3.5),
        ("10⁻⁷ kg m²", INERTIA, "3.5", 3.5),
        ("10^-7 kgm²", INERTIA, "3.5", 3.5),
        ("10⁻⁴ kg·m²", INERTIA, "3.5", 3500.0),
        ("1e-7kgm²", INERTIA, "3.5", 3.5),
        ("kgmm²", INERTIA, "2", 20.0),
        ("gmm²", INERTIA, "250", 2.5),
        ("lbm", MASS, "2", 0.90718474),
        ("V/kRPM", KE, "10", 0.0954929658551372),
        ("V/1000min-1", KE, "10", 0.0954929658551372),
        ("kp cm", TORQUE, "1", 0.0980665),
        ("KG", MASS, "2", 2.0),
        ("C/W", THERMAL, "2.5", 2.5),
        ("Watt", POWER, "3", 3.0),
        ("KW", POWER, "3", 3000.0),
        ("HP", POWER, "1", 745.69987158227),
        ("mOhm", MOTORS.field("terminal_resistance_ohm"), "250", 0.25),
    ],
)
def test_a_figure_is_converted_exactly(unit: str, field: Field, given: str, expected: float) -> None:
    assert conversion(unit, field).apply(given) == expected


@pytest.mark.parametrize(
    ("unit", "field", "factor"),
    [
        ("oz-in", TORQUE, OUNCE * GRAVITY * INCH),
        ("ozf·in", TORQUE, OUNCE * GRAVITY * INCH),
        ("in-lb", TORQUE, POUND * GRAVITY * INCH),
        ("lb ft", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("OZ-IN", TORQUE, OUNCE * GRAVITY * INCH),
        ("LB-FT", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("ft lbs", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("ft. lbs", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("foot pounds", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("in-lbs", TORQUE, POUND * GRAVITY * INCH),
        ("lbs-in", TORQUE, POUND * GRAVITY * INCH),
        ("ft-lbs", TORQUE, POUND * GRAVITY * 12.0 * INCH),
        ("oz-in²", INERTIA, OUNCE * INCH**2 * 1e7),
        ("oz-in-s²", INERTIA, OUNCE * GRAVITY * INCH * 1e7),
        ("lb in^2", INERTIA, POUND * INCH**2 * 1e7),
        ("rad/s", SPEED, 30.0 / 3.141592653589793),
        ("rps", SPEED, 60.0),
        ("rev/s", SPEED, 60.0),
        ("V/(rev/s)", KE, 0.15915494309189535),
        ("oz-in/A", MOTORS.field("torque_constant_nm_per_a"), OUNCE * GRAVITY * INCH),
    ],
)
def test_imperial_and_angular_units_have_their_defined_factors(unit: str, field: Field, factor: float) -> None:
    assert conversion(unit, field).apply("1") == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "field"),
    [("Nm", TORQUE), ("N·m", TORQUE), ("N-m", TORQUE), ("newton*meter", TORQUE), ("g·cm²", INERTIA), ("gcm2", INERTIA),
     ("rpm/V", KV), ("min⁻¹/V", KV), ("V·s/rad", KE), ("%", EFFICIENCY), ("°C", TEMPERATURE)],
)  # fmt: skip
def test_other_spellings_of_the_own_unit_change_nothing(unit: str, field: Field) -> None:
    assert conversion(unit, field).changes_nothing


@pytest.mark.parametrize(
    ("unit", "field", "words"),
    [
        ("kg", TORQUE, "it does not measure what N m measures; check which column"),
        ("kg cm", TORQUE, "does not measure what N m measures; write kgf cm$"),
        ("oz", ROPES.field("breaking_force_n"), "write ozf$"),
        ("", TORQUE, "is no unit; write that of the foreign figures, such as N m"),
        ("gr", MASS, "write g for gram or grain"),
        ("gr cm²", INERTIA, "write g for gram or grain"),
        ("Mm", MOTORS.field("length_mm"), "write mm, or 1000 km"),
        ("ton", MASS, "write t for 1000 kg, or short_ton"),
        ("M", MOTORS.field("length_mm"), "does not measure what mm measures"),
        ("C", MOTORS.field("rated_current_a"), "does not measure what A measures"),
        ("rpm/V", KE, "reciprocal = true"),
        ("Hz", SPEED, "whether revolutions or radians"),
        ("1/s", SPEED, "does not say of which angle"),
        ("%", BACKLASH, "does not say of which angle"),
        ("deg", EFFICIENCY, "is an angle"),
        ("furlongs per elephant", SPEED, "no known unit|cannot be read"),
        ("__import__('os')", MASS, "no known unit|cannot be read"),
        ("0 kg", MASS, "nothing to measure with"),
        ("nan", MASS, "nothing to measure with"),
        ("1e999999 kg", MASS, "nothing to measure with"),
        ("EUR", GEARBOXES.field("price"), "no known unit"),
    ],
)
def test_a_unit_that_does_not_fit_is_refused(unit: str, field: Field, words: str) -> None:
    with pytest.raises(UnitRefused, match=words):
        conversion(unit, field)


RECOMMENDED = {
    "mNm": TORQUE, "g cm²": INERTIA, "oz-in": TORQUE, "lb": MASS, "V s/rad": KE,
    "rpm/V": KV, "rad/(s V)": KV, "rev/(s V)": KV,
    "rpm": SPEED, "rad/s": SPEED, "rev/s": SPEED,
    "arcmin": BACKLASH, "deg": BACKLASH, "rad": BACKLASH,
    "°C": TEMPERATURE, "°F": TEMPERATURE, "K": TEMPERATURE,
}  # fmt: skip


@pytest.mark.parametrize(
    ("unit", "field"),
    [("Hz", SPEED), ("1/s", SPEED), ("1/(s V)", KV), ("%", BACKLASH), ("smoots", MASS), ("0 kg", MASS), ("(", MASS),
     ("kg", TEMPERATURE)],
)  # fmt: skip
def test_every_unit_that_a_message_recommends_is_taken(unit: str, field: Field) -> None:
    with pytest.raises(UnitRefused) as refused:
        conversion(unit, field)
    (words,) = re.findall(r"write (?:it as )?(.+?)(?: in its place)?(?: \(.* unit registry\))?$", str(refused.value))
    for one in re.split(", | or ", words):
        assert conversion(one, RECOMMENDED[one]).factor > 0


def test_figures_beyond_all_exponents_are_zero_or_infinite() -> None:
    rule = conversion("mNm", TORQUE)
    assert (rule.apply("1e9999999999999999999"), rule.apply("1e-9999999999999999999")) == (inf, 0.0)


def test_one_over_a_figure_is_its_reciprocal() -> None:
    rule = conversion("rpm/V", KE, reciprocal=True)
    assert rule.apply("100") == 0.0954929658551372
    with pytest.raises(UnitRefused, match="one over it does not measure"):
        conversion("V s/rad", KE, reciprocal=True)


@given(st.decimals(min_value="0.001", max_value="100000", places=3))
def test_a_thousandth_moves_the_point_and_nothing_else(number: object) -> None:
    assert conversion("mNm", TORQUE).apply(str(number)) == float(f"{number}e-3")
    assert conversion("N m", TORQUE).apply(str(number)) == float(str(number))


@given(st.text(max_size=12))
def test_no_unit_is_a_fault_of_the_program(unit: str) -> None:
    for field in (TORQUE, EFFICIENCY):
        with suppress(UnitRefused):
            assert conversion(unit, field).factor > 0
