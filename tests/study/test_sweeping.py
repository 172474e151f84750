"""Ranges of a sweep as they are typed."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from actuator_select.errors import InvalidStudy
from actuator_select.study import parse_study, template_text
from actuator_select.study.sweeping import combinations, parse_sweep


@pytest.mark.parametrize(
    ("typed", "values"),
    [
        ("k=0:20:5", (0, 5, 10, 15, 20)),
        ("k=0:1:0.1", (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)),
        ("k=0:1:0.3", (0.0, 0.3, 0.6, 0.9)),
        ("k=5:1:-2", (5, 3, 1)),
        ("k=2:2:1", (2,)),
        ("k=[1, 2.5,4]", (1, 2.5, 4)),
        ("k=1,2", (1, 2)),
        ("k=7", (7,)),
        ("k=1e3:3e3:1e3", (1000.0, 2000.0, 3000.0)),
    ],
)
def test_ranges_include_their_stop_and_whole_numbers_stay_whole(typed: str, values: tuple[float, ...]) -> None:
    (axis,) = parse_sweep([typed])
    assert axis.values == values
    assert [type(value) for value in axis.values] == [type(value) for value in values]


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        (["k"], "no KEY=RANGE"),
        (["=1:2:1"], "no KEY=RANGE"),
        (["k=1:2"], "not three numbers"),
        (["k=1:2:0"], "a step of zero"),
        (["k=1:2:-1"], "away from the stop"),
        (["k=a:b:c"], "not three numbers"),
        (["k="], "not numbers"),
        (["k=[1,true]"], "not numbers"),
        (["k=[1,nan]"], "not numbers"),
        (["k=0:inf:1"], "not three numbers"),
        (["k=0:1e9:1"], "more than 100,000"),
        (["k=0:999:1", "j=0:999:1"], "1,000,000 combinations"),
        (["k=1:2:1", "k=3:4:1"], "given twice"),
        ([], "no key"),
    ],
)
def test_what_is_no_range_is_named(typed: list[str], said: str) -> None:
    with pytest.raises(InvalidStudy) as error:
        parse_sweep(typed)
    assert said in str(error.value)


@given(st.text(max_size=30))
def test_any_text_is_a_range_or_a_clear_error(text: str) -> None:
    with suppress(InvalidStudy):
        (axis,) = parse_sweep([text])
        assert axis.key
        assert axis.values


def test_the_last_key_varies_fastest() -> None:
    axes = parse_sweep(["a=1,2", "b=3,4"])
    assert [list(one.values()) for one in combinations(axes)] == [[1, 3], [1, 4], [2, 3], [2, 4]]


def test_an_entry_of_a_list_left_at_its_default_can_be_set() -> None:
    study = parse_study(template_text("x"), place="x.toml", overrides={"payload.force_n[2]": -5.0})
    assert study.table.payload[0].force_n == (0.0, 0.0, -5.0)
    with pytest.raises(InvalidStudy, match="leads nowhere"):
        parse_study(template_text("x"), place="x.toml", overrides={"payload.force_n[3]": -5.0})


def test_of_several_tables_a_key_has_to_name_one() -> None:
    two = template_text("x").replace("[workspace]", '[[payload]]\ntitle = "empty"\nmass_kg = 1.0\n\n[workspace]', 1)
    study = parse_study(two, place="x.toml", overrides={"payload[1].mass_kg": 2.0})
    assert study.table.payload[1].mass_kg == 2.0
    with pytest.raises(InvalidStudy, match="leads nowhere"):
        parse_study(two, place="x.toml", overrides={"payload.mass_kg": 2.0})
