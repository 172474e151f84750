"""Single values: what is understood, what is refused and how the refusal reads."""

from collections.abc import Callable
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from actuator_select.database.cells import Refused, quoted, read_value, reader_of, write_value
from actuator_select.database.fields import Field
from actuator_select.database.kinds import ACTUATORS, GEARBOXES, MOTORS, SOURCES, WINCHES

POWER = MOTORS.field("rated_power_w")
PEAK = MOTORS.field("peak_torque_nm")
FRICTION = MOTORS.field("viscous_friction_nm_s_per_rad")
EFFICIENCY = ACTUATORS.field("efficiency_percent")
STAGES = GEARBOXES.field("stages")
DATE = SOURCES.field("date")
TEXT = MOTORS.field("notes")


@pytest.mark.parametrize(
    ("field", "written", "value"),
    [
        (POWER, " 12.5 ", 12.5),
        (POWER, 12, 12.0),
        (POWER, np.float64(2.5), 2.5),
        (POWER, np.int64(3), 3.0),
        (POWER, "", None),
        (POWER, "  ", None),
        (POWER, None, None),
        (PEAK, "unlimited", inf),
        (PEAK, "Unlimited", inf),
        (PEAK, inf, inf),
        (FRICTION, "0", 0.0),
        (FRICTION, "-0.0", 0.0),
        (STAGES, "3", 3),
        (STAGES, 3.0, 3),
        (TEXT, " kept as it is ", " kept as it is "),
        (TEXT, "unlimited", "unlimited"),
        (DATE, "2018-07", "2018-07"),
    ],
)
def test_a_value_is_read(field: Field, written: object, value: object) -> None:
    read = read_value(field, written)
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize(
    ("field", "written", "remedy"),
    [
        (EFFICIENCY, "0.94", "a fraction was given, write 94"),
        (EFFICIENCY, "1", "a fraction was given, write 100"),
        (POWER, "12,5", "a decimal comma was given, write 12.5 with a point"),
        (POWER, "12 W", "a unit was given, write 12 in W"),
        (POWER, "1_000", "leave it empty if it is unknown"),
        (POWER, "0x10", "leave it empty if it is unknown"),
        (POWER, "５", "leave it empty if it is unknown"),
        (POWER, "1e300", "no part has such a figure; check the unit"),
        (POWER, "1e-300", "no part has such a figure; check the unit"),
        (TEXT, "a\x1b[31m", r"remove the character '\x1b'"),
        (EFFICIENCY, "94 %", "a per cent sign was given, write 94 in %"),
        (POWER, "nan", "leave it empty if it is unknown"),
        (POWER, nan, "NaN is no figure; leave it empty if it is unknown"),
        (POWER, "n/a", "leave it empty if it is unknown"),
        (POWER, "0", "leave it empty if it is unknown"),
        (PEAK, "inf", "write unlimited"),
        (PEAK, "1e999", "this is more than a number can hold"),
        (PEAK, 10**400, "this is more than a number can hold"),
        (POWER, "unlimited", "this figure cannot be unlimited; leave it empty if it is unknown"),
        (PEAK, -inf, "this figure cannot be unlimited; leave it empty if it is unknown"),
        (POWER, True, "write a number"),
        (STAGES, "2.0", "write a whole number without a point"),
        (STAGES, 2.5, "write a whole number"),
        (MOTORS.field("motor_type"), "BLDC", "write bldc"),
        (WINCHES.field("id"), " drum", "remove the spaces around it"),
        (TEXT, "a\x00b", r"remove the character '\x00'"),
        (TEXT, "\ud800", r"remove the character '\ud800'"),
        (TEXT, 3, "write it as a text: '3'"),
        (DATE, "2018-13", ""),
        (DATE, "12.7.2018", ""),
        (EFFICIENCY, "120", ""),
    ],
)
def test_a_refusal_says_what_to_do(field: Field, written: object, remedy: str) -> None:
    with pytest.raises(Refused) as refused:
        read_value(field, written)
    assert refused.value.remedy == remedy
    assert refused.value.expected


def test_a_refusal_gives_the_range_and_the_unit() -> None:
    with pytest.raises(Refused) as refused:
        read_value(POWER, "-3")
    assert str(refused.value.at("motors.csv, line 12, rated_power_w", "-3")) == (
        "motors.csv, line 12, rated_power_w: '-3', expected a number more than 0 [W]"
    )


@given(st.floats(1e-12, 1e12) | st.sampled_from([0.0, inf]))
def test_a_number_is_written_so_that_it_reads_back_exactly(number: float) -> None:
    field = Field(name="x", type="float", description="any", minimum=0.0, may_be_unlimited=True)
    assert read_value(field, write_value(number)) == number


@given(st.text())
def test_a_text_is_kept_or_refused(text: str) -> None:
    try:
        read = read_value(TEXT, text)
    except Refused:
        assert any(char < " " or char == "\x7f" or "\ud800" <= char <= "\udfff" for char in text)
    else:
        assert read == (text if text.strip() else None)


@given(st.text())
def test_no_text_in_place_of_a_number_is_a_fault(text: str) -> None:
    try:
        value = read_value(PEAK, text)
    except Refused:
        return
    assert value is None or (isinstance(value, float) and value > 0.0)


def test_a_repeated_value_cannot_garble_the_terminal() -> None:
    assert quoted("a\x1b[31m\n" + "x" * 100) == r"'a\x1b[31m\n" + "x" * 49 + "…'"


@given(
    st.sampled_from(
        [POWER, PEAK, FRICTION, EFFICIENCY, STAGES, DATE, TEXT, MOTORS.field("motor_type"), MOTORS.field("id")]
    ),
    st.one_of(
        st.text(),
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.floats().map(repr),
        st.integers().map(str),
        st.sampled_from(
            ["", " ", "1", "100", "1e12", "1e-12", "unlimited", "bldc", "BLDC", "2018-07", " a", "a\n", "12\n"]
        ),
    ),
)
def test_the_fast_reader_does_what_the_careful_one_does(field: Field, value: object) -> None:
    def outcome(read: Callable[[object], object]) -> object:
        try:
            found = read(value)
        except Refused as refused:
            return refused.expected, refused.remedy
        return type(found), found

    assert outcome(reader_of(field)) == outcome(lambda one: read_value(field, one))
