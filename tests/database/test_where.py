"""The language of ``--where`` and ``--sort``."""

from collections.abc import Callable
from math import inf

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from actuator_select.database import Catalogue
from actuator_select.errors import InvalidExpression


def numbers(catalogue: Catalogue, where: str = "", sort: str = "") -> str:
    """Last digits of the names of the actuators that a condition keeps, such as ``"125"``."""
    return "".join(str(row["name"])[-1] for row in catalogue.rows("actuators", where, sort))


def refusal(catalogue: Catalogue, where: str = "", sort: str = "") -> InvalidExpression:
    with pytest.raises(InvalidExpression) as error:
        catalogue.rows("actuators", where, sort)
    return error.value


@pytest.mark.parametrize(
    ("where", "kept"),
    [
        ("", "12345"),
        ("  ", "12345"),
        ("rated_power_w >= 50", "123"),
        ("50 <= rated_power_w", "123"),
        ("motor.rated_power_w = 1e2", "2"),
        ("rated_power_w == +100.0", "2"),
        ("MOTOR.Rated_Power_W <> 100 AND ratio != 26", "14"),
        ("motor.nominal_torque_nm between 0.1 and 0.319", "234"),
        ("name in ('Actuator 1', \"Actuator 3\")", "13"),
        ("ratio not in (30, 26)", "2"),
        ("name contains 'TOR 4'", "4"),
        ("notes contains '%'", ""),
        ("name = 'it''s'", ""),
        ("not rated_power_w > 20", "45"),
        ("not not rated_power_w > 20", "123"),
        ("rated_power_w = 10 or rated_power_w = 300 and ratio = 26", "5"),
        ("(rated_power_w = 10 or rated_power_w = 300) and ratio = 26", "5"),
        ("(rated_power_w = 10 or rated_power_w = 300) and not ratio = 26", "1"),
        ("rated_power_w = 300 or rated_power_w = 10 and ratio = 30", "1"),
        ("back_emf_constant_v_s_per_rad > torque_constant_nm_per_a", "2"),
        ("efficiency_percent = 60", "1"),
        ("actuator.efficiency_percent = 60", "1"),
        ("gearbox.efficiency_percent is unknown", "12345"),
        ("viscous_friction_nm_s_per_rad = 0", "12345"),
        ("viscous_friction_nm_s_per_rad is known", "12345"),
        ("peak_torque_nm is unlimited", ""),
        ("mass_kg > 0 or mass_kg <= 0", None),
        ("motor.mass_kg > 0 or motor.mass_kg <= 0 or not motor.mass_kg = 1", ""),
        ("rated_power_w\n>\t50", "12"),
    ],
)
def test_a_condition_keeps_the_rows_that_meet_it(catalogue: Catalogue, where: str, kept: str | None) -> None:
    if kept is None:
        assert "ambiguous" in str(refusal(catalogue, where))
    else:
        assert numbers(catalogue, where) == kept


def test_unlimited_is_more_than_any_number_and_unknown_meets_no_comparison(catalogue: Catalogue) -> None:
    for row_id, limit in (("free", inf), ("slow", 100.0), ("silent", None)):
        catalogue.add("motors", {"id": row_id, "max_speed_rpm": limit, "source_id": "filipovic-kevac-2018"})

    def ids(where: str) -> list[object]:
        return [row["id"] for row in catalogue.rows("motors", f"({where}) and origin = 'user'")]

    assert ids("max_speed_rpm > 1e300") == ["free"]
    assert ids("max_speed_rpm is unlimited") == ["free"]
    assert ids("max_speed_rpm <= 100") == ["slow"]
    assert ids("not max_speed_rpm <= 100") == ["free"]
    assert ids("max_speed_rpm is unknown") == ["silent"]
    assert ids("motor.max_speed_rpm is known") == ["free", "slow"]


def test_contains_knows_the_capitals_of_other_alphabets(catalogue: Catalogue) -> None:
    catalogue.add("motors", {"id": "m", "manufacturer": "Stöber 100%_", "source_id": "filipovic-kevac-2018"})
    assert [row["id"] for row in catalogue.rows("motors", "manufacturer contains 'STÖBER 100%_'")] == ["m"]
    assert catalogue.rows("motors", "manufacturer contains 'St_ber'") == []


@pytest.mark.parametrize(
    ("where", "pointed", "words"),
    [
        ("rated_powr_w > 3", "rated_powr_w", "did you mean 'rated_power_w'"),
        ("rated_power_w > 3 and wheels = 4", "wheels", "there is no column wheels"),
        ("manufacturer = 'maxon'", "manufacturer", "motor.manufacturer, gearbox.manufacturer, winch.manufacturer"),
        ("rated_power_w > '3'", "'3'", "motor.rated_power_w is a number [W]"),
        ("name = 3", "3", "write '3' in quotes"),
        ("name in ('a', 3)", "3", "write '3' in quotes"),
        ("name = ratio", "ratio", "cannot be compared"),
        ("name = Fast", "Fast", "a text stands in quotes"),
        ("ratio contains 'a'", "ratio", "'contains' searches texts"),
        ("ratio is unlimited", "unlimited", "cannot be unlimited"),
        ("ratio > nan", "nan", "write 'is unknown'"),
        ("ratio = NULL", "NULL", "write 'is unknown'"),
        ("ratio < inf", "inf", "write 'is unlimited'"),
        ("ratio < 1e999", "1e999", "more than a number can hold"),
        ("1 < ratio < 3", "< 3", "comparisons cannot be chained"),
        ("ratio > 0,5", ",5", "write decimals with a point"),
        ("ratio > 5mm", "5mm", "without its unit"),
        ("name = 'abc", "'abc", "has no closing '"),
        ("3 = 3", "3 = 3", "needs a column"),
        ("ratio >", "", "the expression ends here; expected a column"),
        ("(ratio > 3", "", "expected )"),
        ("ratio > 3)", ")", "is not expected here"),
        ("and", "and", "is not expected here"),
        ("ratio; DROP TABLE motors", ";", "';' has no meaning here"),
        ("ratio > 3 -- comment", "-", "is not expected here"),
        ("(" * 100 + "ratio > 3" + ")" * 100, "(" * 60, "are too many"),
        (" or ".join(["ratio = 3"] * 1000), None, "are too many"),
        ("x" * 50_000, None, "longer than"),
    ],
)
def test_an_error_points_at_the_word(catalogue: Catalogue, where: str, pointed: str | None, words: str) -> None:
    error = refusal(catalogue, where)
    assert words in str(error)
    if pointed is not None:
        assert where[error.position :].startswith(pointed)
        assert str(error).splitlines()[-1].index("^") == error.position + 2


@pytest.mark.parametrize(
    ("sort", "order"),
    [
        ("", "12345"),
        ("-rated_torque_nm", "12435"),
        ("rated_power_w", "54321"),
        ("ratio, -rated_power_w", "23514"),
        ("-motor.mass_kg, -name", "54321"),
    ],
)
def test_rows_are_sorted(catalogue: Catalogue, sort: str, order: str) -> None:
    assert numbers(catalogue, sort=sort) == order


@pytest.mark.parametrize("sort", ["mass_kg", "-mass_kg"])
def test_unknown_comes_last_in_either_direction(catalogue: Catalogue, sort: str) -> None:
    catalogue.add("motors", {"id": "zz", "mass_kg": 1, "source_id": "filipovic-kevac-2018"})
    assert catalogue.rows("motors", sort=sort)[0]["id"] == "zz"


@pytest.mark.parametrize(
    ("sort", "words"), [("weight", "there is no column"), ("name desc", "expected a comma"), (",", "comma")]
)
def test_a_sort_order_that_cannot_be_understood_is_explained(catalogue: Catalogue, sort: str, words: str) -> None:
    assert words in str(refusal(catalogue, sort=sort))


COMPARISONS: dict[str, Callable[[float, float], bool]] = {
    "=": lambda left, right: left == right,
    "<>": lambda left, right: left != right,
    "<": lambda left, right: left < right,
    "<=": lambda left, right: left <= right,
    ">": lambda left, right: left > right,
    ">=": lambda left, right: left >= right,
}


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    st.sampled_from(list(COMPARISONS)),
    st.sampled_from([300.0, 100.0, 50.0, 20.0, 10.0]) | st.floats(allow_nan=False, allow_infinity=False),
)
def test_comparisons_agree_with_pythons(catalogue: Catalogue, operator: str, figure: float) -> None:
    powers = [300.0, 100.0, 50.0, 20.0, 10.0]
    rows = catalogue.rows("actuators", f"rated_power_w {operator} {figure!r}")
    assert [row["motor.rated_power_w"] for row in rows] == [
        power for power in powers if COMPARISONS[operator](power, figure)
    ]


WORDS = [
    "ratio",
    "name",
    "and",
    "or",
    "not",
    "(",
    ")",
    "=",
    "<",
    "in",
    "between",
    "is",
    "unknown",
    "'a'",
    "3",
    ",",
    "-",
]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(st.text(max_size=40) | st.lists(st.sampled_from(WORDS), max_size=12).map(" ".join))
def test_no_expression_is_a_fault_of_the_program(catalogue: Catalogue, expression: str) -> None:
    for where, sort in ((expression, ""), ("", expression)):
        try:
            catalogue.rows("actuators", where, sort)
        except InvalidExpression as error:
            assert 0 <= error.position <= len(expression)  # noqa: PT017 - most texts are refused, some are not


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters="\x00")))
def test_any_text_can_be_looked_for(catalogue: Catalogue, text: str) -> None:
    quoted = text.replace("'", "''")
    assert catalogue.rows("actuators", f"name <> '{quoted}'")
    catalogue.rows("actuators", f"name contains '{quoted}'")
