"""DC motors recomputed from their own constants."""

from collections import defaultdict
from math import inf

import pytest

from actuator_select import Catalogue
from actuator_select.selection.nominal_line import LineFigure, measured_dc_motors, recompute, rounding_interval

FIGURES = ("no_load_speed_rpm", "stall_torque_nm", "rated_speed_rpm", "rated_current_a")

# Deviation of the printed figure in per cent, and whether rounding explains it; None where no figure is printed.
EXPECTED = {
    "maxon-236662": ((0.0, True), (0.1, True), (0.0, True), (-0.4, True)),
    "maxon-DCX22L01EBSL596": ((-0.1, True), (-0.4, True), (-0.2, True), (0.1, True)),
    "maxon-323772": ((-0.7, False), (0.2, True), (-10.0, False), (-10.6, False)),
    "maxon-244879": ((-0.9, False), (0.0, True), (-12.2, False), (-11.9, False)),
    "faulhaber-3564K012B-sheet": ((0.5, False), (0.2, True), None, (6.7, False)),
    "faulhaber-3564K024B-sheet": ((0.1, True), (-7.8, False), None, (5.2, False)),
    "faulhaber-3564K036B-sheet": ((0.1, False), (-0.1, True), None, (5.6, False)),
    "faulhaber-3564K048B-sheet": ((-0.5, False), (-0.7, False), None, (4.8, False)),
}


@pytest.fixture(scope="module")
def recomputed(catalogue: Catalogue) -> dict[str, dict[str, LineFigure]]:
    figures: defaultdict[str, dict[str, LineFigure]] = defaultdict(dict)
    for row in measured_dc_motors(catalogue.rows("motors")):
        for figure in recompute(row):
            figures[figure.id][figure.quantity] = figure
    return dict(figures)


def test_the_dc_motors_that_can_be_recomputed_are_these_eight(recomputed: dict[str, dict[str, LineFigure]]) -> None:
    assert set(recomputed) == set(EXPECTED)


@pytest.mark.parametrize("motor", EXPECTED)
def test_a_dc_motor_gives_its_own_line_but_for_the_listed_deviations(
    recomputed: dict[str, dict[str, LineFigure]], motor: str
) -> None:
    for quantity, expected in zip(FIGURES, EXPECTED[motor], strict=True):
        figure = recomputed[motor].get(quantity)
        if expected is None:
            assert figure is None
        else:
            assert figure is not None
            assert 100.0 * figure.deviation == pytest.approx(expected[0], abs=0.06)
            assert figure.agrees is expected[1], quantity


@pytest.mark.parametrize(
    ("value", "half"),
    [
        (24.0, 0.05),
        (5060.0, 5.0),
        (11550.0, 5.0),
        (0.03, 5e-5),
        (1.2, 0.005),
        (0.014524, 5e-7),
        (100.0, 0.5),
        (0.0, 0.0),
    ],
)
def test_a_printed_figure_is_half_a_unit_of_its_last_digit_wide(value: float, half: float) -> None:
    assert rounding_interval(value) == pytest.approx((value - half, value + half), rel=1e-12, abs=1e-15)


def test_constants_without_rounding_errors_agree_and_a_figure_outside_its_rounding_does_not() -> None:
    row = {
        "id": "m",
        "nominal_voltage_v": 24.0,
        "terminal_resistance_ohm": 2.0,
        "torque_constant_nm_per_a": 0.05,
        "back_emf_constant_v_s_per_rad": 0.05,
        "no_load_current_a": 0.1,
        "rated_torque_nm": 0.1,
        "stall_torque_nm": 0.6,
        "rated_current_a": 2.1,
        "rated_speed_rpm": 3781.0,  # (24 - 2 · 2.1) / 0.05 rad/s
    }
    assert [figure.agrees for figure in recompute(row)] == [True, True, True]
    off = {figure.quantity: figure.agrees for figure in recompute(row | {"stall_torque_nm": 0.61})}
    assert off == {"stall_torque_nm": False, "rated_speed_rpm": True, "rated_current_a": True}


def test_an_unlimited_figure_that_no_equation_needs_does_not_stop_the_recomputation() -> None:
    row = {
        "id": "m",
        "nominal_voltage_v": 24.0,
        "terminal_resistance_ohm": 2.0,
        "torque_constant_nm_per_a": 0.05,
        "no_load_current_a": 0.1,
        "stall_torque_nm": 0.6,
    }
    assert recompute(row | {"peak_torque_nm": inf, "max_speed_rpm": inf}) == recompute(row)
    assert [figure.quantity for figure in recompute(row)] == ["stall_torque_nm"]


def test_the_back_emf_constant_of_a_speed_constant_is_as_wide_as_the_speed_constants_rounding() -> None:
    row = {
        "id": "m",
        "nominal_voltage_v": 24.0,
        "terminal_resistance_ohm": 2.0,
        "no_load_current_a": 0.0,
        "speed_constant_rpm_per_v": 250.0,
        "no_load_speed_rpm": 6000.0,
    }
    (figure,) = recompute(row)
    assert figure.expected == pytest.approx(6000.0)
    assert figure.expected_range == pytest.approx((24.0 * 249.5, 24.0 * 250.5))
