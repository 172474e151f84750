"""Limits that the catalogue states and that no check rests on yet: results say so."""

from collections.abc import Iterator

import pytest

from actuator_select import Catalogue, load_study, open_catalogue, rank
from actuator_select.selection.wording import unchecked_limits
from tests.selection.parts import DC, SOURCE, WINCH, add_drive

EFFICIENCY = {"efficiency_percent": 60}


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


def test_the_limits_that_are_named_as_unchecked_change_no_result(own: Catalogue) -> None:
    """A limit that begins to be checked has to leave the list of `unchecked_limits`."""
    add_drive(own, "without", DC, **EFFICIENCY)
    add_drive(
        own,
        "with",
        DC | {"peak_torque_nm": 0.637, "max_speed_rpm": 1, "thermal_time_constant_winding_s": 1},
        gearbox={
            "max_continuous_torque_nm": 1e-3,
            "max_intermittent_torque_nm": 1e-3,
            "max_continuous_input_speed_rpm": 1,
            "max_intermittent_input_speed_rpm": 1,
        },
        **EFFICIENCY,
    )
    own.add("winches", SOURCE | {"id": "weak", "drum_radius_mm": 80, "max_tension_n": 1})
    own.add(
        "actuators",
        SOURCE
        | {"id": "winch", "name": "winch", "motor_id": "with-motor", "gearbox_id": "with-gearbox", "winch_id": "weak"}
        | EFFICIENCY,
    )
    assert own.part(WINCH)[1]["drum_radius_mm"] == 80.0
    one, *others = rank(load_study("cpr8"), own, where="id in ('without', 'with', 'winch')").ranked
    assert one.feasible_poses > 0
    assert [other.feasible_poses for other in others] == [one.feasible_poses] * 2
    assert [other.checks for other in others] == [one.checks] * 2


def test_what_a_gearbox_bears_is_named_where_an_actuator_has_one() -> None:
    geared, direct = {"id": "a", "gearbox_id": "g"}, {"id": "b", "gearbox_id": None}
    assert unchecked_limits([direct, geared]) == unchecked_limits([geared])
    assert "gearbox" in unchecked_limits([geared])
    assert "gearbox" not in unchecked_limits([direct])
