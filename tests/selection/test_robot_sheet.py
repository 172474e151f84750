"""The robot sheet against statics by hand, and its warnings."""

import numpy as np
import pytest

from actuator_select.selection.robot_record import COLUMNS, cable_row, robot_items, robot_record
from actuator_select.selection.robot_sheet import RobotSheet, robot_sheet
from actuator_select.study import load_study, parse_study, template_text

TWO_CABLES = """
name = "two"
[robot]
degrees_of_freedom = "2T"
[[robot.cable]]
frame_anchor_m = [-3.0, 0.0, 4.0]
platform_anchor_m = [0.0, 0.0, 0.0]
[[robot.cable]]
frame_anchor_m = [3.0, 0.0, 4.0]
platform_anchor_m = [0.0, 0.0, 0.0]
[cables]
tension_min_n = 0.0
[[payload]]
title = "empty"
mass_kg = 2.0
[[payload]]
title = "full"
mass_kg = 10.0
[workspace]
box_m = [[-1.5, 1.5], [0.0, 0.0], [0.0, 0.0]]
points = [3, 1, 1]
[motion]
set = "list"
[[motion.case]]
velocity_m_per_s = [1.0, 0.0, 0.0]
"""


def sheet_of(text: str) -> RobotSheet:
    return robot_sheet(parse_study(text, place="test"))


def codes(sheet: RobotSheet) -> set[str]:
    return {one.code for one in sheet.warnings}


def test_forces_lengths_and_speeds_are_those_of_statics_by_hand() -> None:
    sheet = sheet_of(TWO_CABLES)
    left, right = sheet.cables
    # At x = -1.5 the left cable takes (3 + 1.5)/6 of the weight as its vertical part.
    length = np.hypot(1.5, 4.0)
    assert left.largest.force == pytest.approx(10.0 * 9.81 * 0.75 * length / 4.0)
    assert left.largest.position == (-1.5, 0.0, 0.0)
    assert left.largest.load == "full"
    assert left.largest.direction == pytest.approx((1.5 / length, 0.0, -4.0 / length))
    assert (left.shortest, left.longest) == pytest.approx((length, np.hypot(4.5, 4.0)))
    assert right.largest.force == pytest.approx(left.largest.force)
    assert right.speed == pytest.approx(4.5 / np.hypot(4.5, 4.0))
    assert left.tension_bound is None
    assert (sheet.attainable, sheet.held_at_rest, sheet.singular) == (3, 3, 0)


def test_cables_of_one_frame_point_are_added_as_vectors() -> None:
    sheet = sheet_of(template_text("hall", "suspended-8"))
    assert [point.cables for point in sheet.frame_points] == [(1, 2), (3, 4), (5, 6), (7, 8)]
    for point in sheet.frame_points:
        single = [sheet.cables[number - 1].largest.force for number in point.cables]
        assert None not in single
        assert max(single) < point.largest.force <= sum(single)


def test_the_frame_and_the_weight_balance() -> None:
    text = template_text("hall", "suspended-8")
    box = "box_m = [[0.5, 0.5], [0.3, 0.3], [1.0, 1.0]]"
    lines = [box if line.startswith("box_m") else line for line in text.splitlines()]
    lines = ["points = [1, 1, 1]" if line.startswith("points") else line for line in lines]
    sheet = sheet_of("\n".join(lines))
    forces = [np.array(one.largest.direction) * one.largest.force for one in sheet.frame_points]
    assert np.sum(forces, axis=0) == pytest.approx([0.0, 0.0, -300.0 * 9.81], abs=1e-6)


def test_the_case_study_is_warned_of() -> None:
    sheet = robot_sheet(load_study("cpr8"))
    assert {"similar_anchors", "rank_deficient", "negative_tension_at_rest", "short_cable"} <= codes(sheet)
    assert sheet.singular == sheet.positions == 216
    assert sheet.least_rank == 5
    assert "short at 216/216" in robot_items(sheet)["rank"]


def test_a_robot_with_similar_anchors_seen_from_the_side_is_warned_of() -> None:
    corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
    cables = "".join(
        f"[[robot.cable]]\nframe_anchor_m = [{10.0 * x}, {2.5 * y}, {2.5 * up}]\n"
        f"platform_anchor_m = [{0.25 * x}, {-0.25 * y}, {-0.25 * up}]\n"  # crossed along y and z alike
        for up in (1.0, -1.0)
        for x, y in corners
    )
    head, _, rest = TWO_CABLES.partition("[[robot.cable]]")
    sheet = sheet_of(head.replace("2T", "3R3T") + cables + rest[rest.index("[cables]") :])
    assert sheet.singular == sheet.positions
    assert [one.text[:12] for one in sheet.warnings if one.code == "similar_anchors"] == ["Seen along x"]


def test_a_hanging_robot_is_told_from_one_held_from_below() -> None:
    assert "suspended" in codes(sheet_of(template_text("a", "suspended-8")))
    assert codes(sheet_of(template_text("a", "constrained-8"))) == set()


def test_too_few_cables_are_a_result_with_its_reason() -> None:
    sheet = sheet_of(TWO_CABLES.replace('"2T"', '"3R3T"'))
    assert {"too_few_cables", "rank_deficient"} <= codes(sheet)
    nothing = sheet_of(TWO_CABLES.replace("tension_min_n = 0.0", "tension_min_n = 0.0\ntension_max_n = 1.0"))
    assert nothing.held_at_rest == 0
    assert "not_held_at_rest" in codes(nothing)
    assert nothing.cables[0].largest.force is None
    assert robot_record(nothing)["attainable_percent"] == 0.0


def test_a_row_has_a_value_for_every_column() -> None:
    sheet = sheet_of(TWO_CABLES)
    assert [len(cable_row(cable)) for cable in sheet.cables] == [len(COLUMNS)] * 2
