"""Torque over speed of single parts: what is drawn is stated by the row, and what is not stated is named."""

from math import inf, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.errors import InvalidInput
from actuator_select.report.part_figures import part_figure
from actuator_select.report.style import image_bytes
from actuator_select.selection.part_characteristics import characteristics
from actuator_select.selection.part_sketch import Characteristics, Duty
from actuator_select.selection.plausibility import figure as four_digits

SERVO = {
    "id": "servo",
    "electrical_convention": "ac_rms_phase",
    "rated_torque_nm": 2.0,
    "rated_speed_rpm": 3000.0,
    "standstill_torque_nm": 2.5,
    "peak_torque_nm": 7.0,
    "max_speed_rpm": 5000.0,
    "torque_constant_nm_per_a": 0.5,
    "nominal_voltage_v": 230.0,
    "terminal_resistance_ohm": 1.0,
    "back_emf_constant_v_s_per_rad": 0.3,
}
DC = {
    "id": "dc",
    "electrical_convention": "dc_terminal",
    "nominal_voltage_v": 24.0,
    "terminal_resistance_ohm": 4.0,
    "torque_constant_nm_per_a": 0.035,
    "back_emf_constant_v_s_per_rad": 0.035,
    "no_load_current_a": 0.04,
    "rated_torque_nm": 0.0455,
    "rated_speed_rpm": 5060.0,
}


def words(figure: Figure) -> str:
    return " ".join(" ".join(one.get_text() for one in figure.findobj(Text)).split())


def limits(part: Characteristics) -> dict[str, float]:
    return {limit.name: limit.value for limit in part.limits}


def test_the_voltage_line_of_a_dc_motor_runs_from_stall_torque_to_no_load_speed() -> None:
    part = characteristics("motors", DC)
    (line,) = part.slopes
    assert line.load == pytest.approx(0.035 * 24.0 / 4.0)
    assert line.speed == pytest.approx(24.0 / 0.035 * 30.0 / pi)
    assert not line.printed
    figure = part_figure(part)
    (drawn,) = [one for one in figure.axes[0].get_lines() if len(one.get_xdata()) == 2 and one.get_color() == "#D55E00"]
    assert np.asarray(drawn.get_xdata()).tolist() == [0.0, line.speed]
    assert drawn.get_linestyle() == "-"
    assert "0.21 N m to 6548 rpm" in words(figure)
    assert "rated point, 5060 rpm, 0.0455 N m" in words(figure)


def test_what_is_continuous_stays_below_rated_torque_voltage_line_and_maximum_speed() -> None:
    part = characteristics("motors", DC | {"max_speed_rpm": 6000.0, "peak_torque_nm": 0.1})
    (line,) = part.slopes
    for region, torque in zip(part.regions, (0.1, 0.0455), strict=True):
        for speed, load in region.corners:
            assert load <= torque
            assert speed <= 6000.0
            assert load <= line.load * (1.0 - speed / line.speed) + 1e-12
        assert (6000.0, 0.0) in region.corners
    assert limits(part) == {"rated torque": 0.0455, "peak torque": 0.1, "maximum speed": 6000.0}


def test_printed_ends_are_dashed_and_said_to_be_printed() -> None:
    row = {name: value for name, value in DC.items() if name != "terminal_resistance_ohm"}
    part = characteristics("motors", row | {"stall_torque_nm": 0.2})
    (line,) = part.slopes
    assert (line.load, line.printed) == (0.2, True)
    figure = part_figure(part)
    assert "stall torque as printed" in words(figure)
    assert "--" in {one.get_linestyle() for one in figure.axes[0].findobj(Line2D) if one.get_color() == "#D55E00"}


def test_without_constants_there_is_no_voltage_line_and_the_figure_says_why() -> None:
    row = {name: value for name, value in DC.items() if name != "back_emf_constant_v_s_per_rad"}
    part = characteristics("motors", row)
    assert part.slopes == ()
    assert "not stated: peak torque; maximum speed; for a voltage line: back-EMF constant, no-load speed" in words(
        part_figure(part)
    )


def test_the_speed_constant_is_the_back_emf_constant_in_other_units() -> None:
    row = DC | {"back_emf_constant_v_s_per_rad": None, "speed_constant_rpm_per_v": 271.0}
    (line,) = characteristics("motors", row).slopes
    assert line.speed == pytest.approx(24.0 * 271.0)
    assert not line.printed


def test_an_ac_servo_has_standstill_rated_and_peak_but_no_voltage_line() -> None:
    part = characteristics("motors", SERVO)
    assert part.slopes == ()
    short, continuous = part.regions
    assert continuous.corners == ((0.0, 0.0), (0.0, 2.5), (3000.0, 2.0), (3000.0, 0.0))
    assert short.corners == ((0.0, 0.0), (0.0, 7.0), (5000.0, 7.0), (5000.0, 0.0))
    text = words(part_figure(part))
    for said in ("peak torque, 7 N m", "standstill torque, continuous, 2.5 N m", "maximum speed, 5000 rpm"):
        assert said in text
    assert "no voltage line, because" in text


def test_an_ac_servo_without_standstill_torque_is_continuous_up_to_its_rated_point() -> None:
    part = characteristics("motors", SERVO | {"standstill_torque_nm": None, "peak_torque_nm": None})
    assert [region.corners[2] for region in part.regions] == [(3000.0, 2.0)]
    assert part.missing == ("peak torque", "standstill torque")


def test_unlimited_is_a_note_and_not_a_line() -> None:
    part = characteristics("motors", SERVO | {"max_speed_rpm": inf})
    assert "maximum speed" not in limits(part)
    assert "maximum speed: unlimited" in part.notes


def test_a_motor_with_hardly_any_figure_gets_an_empty_figure_that_lists_what_is_missing() -> None:
    part = characteristics("motors", {"id": "bare"})
    assert (part.regions, part.slopes, part.limits, part.marks) == ((), (), (), ())
    text = words(part_figure(part))
    assert "no figure to draw is stated" in text
    for name in ("rated torque", "rated speed", "peak torque", "maximum speed", "resistance"):
        assert name in text


def test_a_gearbox_has_output_torques_over_input_speeds() -> None:
    row = {
        "id": "g",
        "ratio": 10.0,
        "max_continuous_torque_nm": 81.0,
        "max_intermittent_torque_nm": 126.0,
        "nominal_input_speed_rpm": 3100.0,
        "max_intermittent_input_speed_rpm": 7500.0,
    }
    part = characteristics("gearboxes", row)
    assert [region.corners[2] for region in part.regions] == [(7500.0, 126.0), (3100.0, 81.0)]
    assert part.missing == ("emergency stop torque", "continuous input speed")
    assert (part.speed_name, part.load_unit) == ("input speed", "N m")


@pytest.fixture
def catalogue(tmp_path: Path) -> Any:  # noqa: ANN401 - a generator of catalogues
    with open_catalogue(tmp_path / "c.db") as opened:
        yield opened


def test_an_actuator_is_seen_at_its_drum(catalogue: Catalogue) -> None:
    _, row = catalogue.part("Actuator 1")
    part = characteristics("actuators", row)
    ratio, efficiency, radius = 30.0, 0.6, 0.08
    (mark,) = part.marks
    assert mark.load == pytest.approx(0.6 * ratio * efficiency / radius)
    assert mark.speed == pytest.approx(4700.0 * pi / 30.0 * radius / ratio)
    (line,) = part.slopes
    assert line.load * line.speed == pytest.approx((0.095 * 48 / 0.369) * (48 / 0.0945) * efficiency)
    assert (part.speed_unit, part.load_unit) == ("m/s", "N")


def test_without_an_efficiency_nothing_that_needs_it_is_drawn(catalogue: Catalogue) -> None:
    _, row = catalogue.part("Actuator 1")
    part = characteristics(
        "actuators",
        row | {"efficiency_percent": None, "gearbox.max_continuous_torque_nm": 40.0, "winch.max_tension_n": 900.0},
    )
    assert (part.regions, part.slopes, part.marks) == ((), (), ())
    assert {name for name in limits(part) if name.startswith("motor")} == {"motor: rated speed"}
    assert limits(part)["gearbox: continuous torque"] == pytest.approx(40.0 / 0.08)
    assert limits(part)["winch: greatest tension"] == 900.0
    assert "not stated: efficiency (no cable force of the motor is drawn)" in words(part_figure(part))


def test_of_ratio_efficiency_and_radius_only_those_that_are_known_are_named(catalogue: Catalogue) -> None:
    _, row = catalogue.part("Actuator 1")
    assert "ratio 30, efficiency 0.6, drum radius 80 mm" in characteristics("actuators", row).notes
    bare = row | {"gearbox.ratio": None, "winch.drum_radius_mm": None}
    part = characteristics("actuators", bare)
    assert "efficiency 0.6" in part.notes
    assert "nan" not in words(part_figure(part))
    none = characteristics("actuators", bare | {"efficiency_percent": None})
    assert not [note for note in none.notes if "efficiency" in note]


@pytest.mark.parametrize(
    ("value", "text"),
    [(9999.4, "9999"), (9999.7, "10000"), (-9999.7, "-10000"), (123456.0, "123456"), (0.21174, "0.2117")],
)
def test_four_digits_are_never_a_power_of_ten_where_the_figure_is_large(value: float, text: str) -> None:
    assert four_digits(value) == text


def test_a_figure_that_rounds_to_five_digits_stands_in_the_legend_as_a_whole_number() -> None:
    assert "peak torque, 10000 N m" in words(part_figure(characteristics("motors", DC | {"peak_torque_nm": 9999.7})))


def test_a_winch_says_what_can_be_drawn() -> None:
    with pytest.raises(InvalidInput, match=r"w is one of winches.*motors, gearboxes and actuators can be drawn"):
        characteristics("winches", {"id": "w"})


def test_the_figure_is_the_same_at_every_run() -> None:
    part = characteristics("motors", SERVO)
    assert image_bytes(part_figure(part), "svg") == image_bytes(part_figure(part), "svg")


def test_every_duty_has_a_colour() -> None:
    from actuator_select.report.part_figures import COLOURS

    assert set(COLOURS) == set(Duty)


def test_what_is_continuous_at_rated_torque_ends_at_a_rated_speed_below_the_line_and_a_far_one_is_noted() -> None:
    note = "rated point below the line of the cold motor"
    cold = characteristics("motors", DC).slopes[0].speed_at(0.0455)
    for share, noted in ((0.99, False), (0.96, False), (0.94, True), (0.5, True)):
        part = characteristics("motors", DC | {"rated_speed_rpm": share * cold, "max_speed_rpm": 6000.0})
        (region,) = part.regions
        assert max(speed for speed, load in region.corners if load == 0.0455) == pytest.approx(share * cold)
        assert (note in part.notes) is noted
        for speed, load in region.corners:
            assert load <= part.slopes[0].load * (1.0 - speed / part.slopes[0].speed) + 1e-12
    above = characteristics("motors", DC | {"rated_speed_rpm": 1.1 * cold})
    assert max(speed for speed, load in above.regions[0].corners if load == 0.0455) == pytest.approx(cold)
    assert note not in above.notes


def test_a_printed_line_without_a_voltage_is_not_called_a_voltage_line() -> None:
    row = {"id": "p", "electrical_convention": "dc_terminal", "stall_torque_nm": 1.4, "no_load_speed_rpm": 3702.0}
    (line,) = characteristics("motors", row).slopes
    assert line.name == "stall torque and no-load speed as printed, voltage not stated"
    (known,) = characteristics("motors", row | {"nominal_voltage_v": 24.0}).slopes
    assert known.name.startswith("voltage line at 24 V")


def test_a_servos_straight_edge_is_said_to_be_one_where_both_its_ends_are_known() -> None:
    note = "straight between standstill and rated point"
    assert note in characteristics("motors", SERVO).notes
    for unknown in ("standstill_torque_nm", "rated_torque_nm", "rated_speed_rpm"):
        assert note not in characteristics("motors", SERVO | {unknown: None}).notes


def test_a_speed_that_is_both_rated_and_greatest_has_one_label() -> None:
    same = characteristics("motors", SERVO | {"max_speed_rpm": 3000.0, "rated_torque_nm": None})
    assert {name for name in limits(same) if "speed" in name} == {"maximum and rated speed"}
    apart = characteristics("motors", SERVO | {"rated_torque_nm": None})
    assert {name for name in limits(apart) if "speed" in name} == {"maximum speed", "rated speed"}


def test_at_a_drum_too_a_speed_that_is_both_rated_and_greatest_has_one_label(catalogue: Catalogue) -> None:
    _, row = catalogue.part("Actuator 1")
    same = {"motor.max_speed_rpm": row["motor.rated_speed_rpm"], "efficiency_percent": None}
    part = characteristics("actuators", row | same)
    assert [name for name in limits(part) if "speed" in name and "motor" in name] == ["motor: maximum and rated speed"]
