"""Workspaces and sweeps of studies: counts, records, reasons."""

import json
from pathlib import Path

import numpy as np
import pytest

from actuator_select.errors import InvalidInput, InvalidStudy
from actuator_select.model.tension import TensionModel
from actuator_select.model.workspace import OrientationRule, WorkspaceKind
from actuator_select.selection.support_intervals import rope_record, rope_tensions
from actuator_select.selection.sweeps import sweep_record, sweep_workspace
from actuator_select.selection.workspaces import evaluate_workspace, workspace_basis, workspace_record
from actuator_select.study import Study, parse_study
from actuator_select.study.sweeping import parse_sweep

PLANAR = """
name = "planar"
[robot]
builder = "planar-4"
configuration = "a"
w_m = 6.0
h_m = 3.0
w_b_m = 0.6
h_1_m = 0.1
h_bu_m = 0.1
w_p_m = 1.0
h_p_m = 1.6
h_bp_m = 0.2
w_bp_m = 0.2
t5_n = 30.0
mass_kg = 10.0
[cables]
tension_min_n = 2.0
tension_max_n = 300.0
[workspace]
box_m = [[-2.5, 2.5], [0.0, 0.0], [-1.3, 1.3]]
points = [11, 1, 9]
home_m = [0.0, 0.0, 0.0]
[motion]
set = "independent"
speed_max_m_per_s = 1.0
acceleration_time_s = 0.5
deceleration_time_s = 0.5
"""

KEYS = {
    "poses",
    "feasible_poses",
    "feasible_percent",
    "measure",
    "measure_unit",
    "measure_interval",
    "singular_poses",
    "too_near_poses",
    "connected_percent",
    "kind",
    "orientations",
    "tension_model",
    "largest_tension_n",
    "study",
    "reasons",
    "warnings",
}


def planar(**overrides: object) -> Study:
    keys = {key.replace("__", "."): value for key, value in overrides.items()}
    return parse_study(PLANAR, place="planar.toml", overrides=keys)


def test_the_record_is_strict_json_with_every_key() -> None:
    record = workspace_record(evaluate_workspace(planar()))
    assert set(record) == KEYS
    again = json.loads(json.dumps(record, allow_nan=False))
    assert again["kind"] == "dynamic-feasible"
    assert again["orientations"] == "total"
    assert again["measure_unit"] == "m2"
    assert again["poses"] == 99
    assert again["measure"] == pytest.approx(again["feasible_poses"] * 0.5 * 0.325)
    assert again["feasible_percent"] == pytest.approx(100.0 * again["feasible_poses"] / 99, abs=1e-4)
    assert 0 < again["feasible_poses"] < 99


def test_the_share_connected_to_home_is_of_the_feasible() -> None:
    found = evaluate_workspace(planar(), kind=WorkspaceKind.STATIC)
    assert found.connected_percent == 100.0
    away = evaluate_workspace(planar(workspace__home_m=[2.5, 0.0, 1.3]), kind=WorkspaceKind.STATIC)
    assert not away.feasible[-1]
    assert away.connected_percent == 0.0


def test_positions_near_an_anchor_leave_the_total() -> None:
    lengths = {"cables__length_min_m": 1.0}
    for kind in (WorkspaceKind.STATIC, WorkspaceKind.REACHABLE):
        found = evaluate_workspace(planar(**lengths), kind=kind)
        assert found.too_near_poses == found.apart.sum() > 0
        assert found.poses == 99 - found.too_near_poses
        assert not found.feasible[found.apart].any()
        assert any("length_min_m" in warning for warning in found.warnings)
    assert found.feasible_percent == 100.0


def test_a_single_position_has_no_measure() -> None:
    found = evaluate_workspace(planar(workspace__points=[1, 1, 1]))
    assert (found.measure, found.unit, found.interval, found.poses) == (None, None, None, 1)


def test_a_speed_limit_is_needed_where_speeds_decide() -> None:
    with pytest.raises(InvalidInput, match=r"speed_max_m_per_s.*m/s"):
        evaluate_workspace(planar(), kind=WorkspaceKind.TWIST)
    slow = planar(cables__speed_max_m_per_s=1.41, motion__velocity_set="box")
    found = evaluate_workspace(slow, kind=WorkspaceKind.TWIST)
    assert found.margin_unit == "m/s"
    assert 0 < found.feasible_poses < found.poses


@pytest.mark.parametrize(
    ("overrides", "reason"),
    [
        ({"cables__length_max_m": 0.5}, "longer than cables.length_max_m"),
        ({"cables__tension_max_n": 10.0}, "tension_max_n is too small"),
        ({"motion__speed_max_m_per_s": 90.0}, "the motion set asks for too much"),
        (
            {"workspace__box_m": [[-2.5, 2.5], [0.0, 0.0], [4.0, 5.0]], "workspace__home_m": [0.0, 0.0, 4.5]},
            "outside of what",
        ),
        ({"cables__length_min_m": 20.0}, "nearer to an anchor"),
    ],
)
def test_that_nothing_is_feasible_comes_with_its_reason(overrides: dict[str, object], reason: str) -> None:
    found = evaluate_workspace(planar(**overrides))
    assert found.feasible_poses == 0
    assert any(reason in one for one in found.reasons), found.reasons
    json.dumps(workspace_record(found), allow_nan=False)


def test_too_few_cables_are_named_as_the_reason() -> None:
    cables = "\n".join(
        f"[[robot.cable]]\nframe_anchor_m = {frame}\nplatform_anchor_m = {own}"
        for frame, own in (
            ([0.0, 0.0, 3.0], [0.1, 0.0, 0.0]),
            ([4.0, 0.0, 3.0], [0.0, 0.1, 0.0]),
            ([0.0, 4.0, 3.0], [0.0, 0.0, 0.1]),
        )
    )
    text = f"""name = "three"
{cables}
[cables]
tension_min_n = 1.0
[payload]
mass_kg = 5.0
[workspace]
box_m = [[1.0, 1.5], [1.0, 1.5], [1.0, 1.5]]
points = [2, 2, 2]
[motion]
set = "rest"
"""
    found = evaluate_workspace(parse_study(text, place="three.toml"))
    assert found.feasible_poses == 0
    assert found.singular_poses == 8
    assert "3 cables cannot balance 6 equations" in found.reasons[0]
    assert not found.feasible.any()


def test_other_tension_models_and_orientations_say_so() -> None:
    study = planar(workspace__orientations_rad=[[0.0, 0.0, 0.0], [0.0, 0.2, 0.0]])
    counts = {}
    for rule in OrientationRule:
        found = evaluate_workspace(study, over=rule, kind=WorkspaceKind.STATIC)
        counts[rule] = found.feasible_poses
        assert workspace_record(found)["orientations"] == rule.value
    assert counts[OrientationRule.TOTAL] <= counts[OrientationRule.CONSTANT] <= counts[OrientationRule.INCLUSION]
    published = evaluate_workspace(study, tension_model=TensionModel.PSEUDO_INVERSE)
    assert any("least norm" in warning for warning in published.warnings)
    assert "least norm" in workspace_basis(published)["tensions"]
    exact = evaluate_workspace(study)
    assert (published.feasible <= exact.feasible).all()


def test_a_sweep_counts_what_single_workspaces_count(tmp_path: Path) -> None:
    file = tmp_path / "planar.toml"
    file.write_text(PLANAR, encoding="utf-8")
    sweep = sweep_workspace(file, parse_sweep(["robot.t5_n=0:60:30", "robot.w_p_m=[0.5, 2]"]))
    assert [point.values for point in sweep.points] == [(0, 0.5), (0, 2), (30, 0.5), (30, 2), (60, 0.5), (60, 2)]
    for point in sweep.points:
        alone = evaluate_workspace(planar(robot__t5_n=float(point.values[0]), robot__w_p_m=float(point.values[1])))
        assert point.feasible_poses == alone.feasible_poses
        assert point.measure == pytest.approx(alone.measure)
    record = json.loads(json.dumps(sweep_record(sweep), allow_nan=False))
    assert record["keys"] == {"robot.t5_n": [0, 30, 60], "robot.w_p_m": [0.5, 2]}
    assert record["best"]["feasible_poses"] == max(point.feasible_poses for point in sweep.points)
    assert record["points"][0]["values"] == {"robot.t5_n": 0, "robot.w_p_m": 0.5}


def test_a_sweep_takes_list_entries_even_those_left_at_their_default(tmp_path: Path) -> None:
    file = tmp_path / "planar.toml"
    file.write_text(PLANAR, encoding="utf-8")
    pushed = sweep_workspace(file, parse_sweep(["payload.force_n[2]=0:-2000:-1000"]))
    counts = [point.feasible_poses for point in pushed.points]
    assert counts[0] > counts[1] >= counts[2]
    active = sweep_workspace(
        file, parse_sweep(["robot.t5_range_n[1]=0:60:20"]), overrides={"robot.t5_range_n": [0.0, 10.0]}
    )
    shares = [point.feasible_poses for point in active.points]
    assert shares == sorted(shares)


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("robot.w_q_m=0:2:1", "did you mean"),
        ("robot.cable[7].frame_anchor_m[0]=0:2:1", "leads nowhere"),
        ("robot.w_m=-1:2:1", "robot.w_m=-1"),
        ("name=1:2:1", "text in quotes"),
    ],
)
def test_a_sweep_over_what_is_no_number_of_the_study_is_refused(tmp_path: Path, word: str, said: str) -> None:
    file = tmp_path / "planar.toml"
    file.write_text(PLANAR, encoding="utf-8")
    with pytest.raises(InvalidStudy) as error:
        sweep_workspace(file, parse_sweep([word]))
    assert said in str(error.value)


def test_the_best_constant_tension_of_a_rope_serves_most() -> None:
    study = planar()
    found = rope_tensions(study)
    tension, count = found.best
    assert count == found.interval.feasible_at(tension).sum()
    assert count == max(found.interval.feasible_at(float(level)).sum() for level in np.linspace(0.0, 400.0, 801))
    assert evaluate_workspace(planar(robot__t5_n=tension)).feasible_poses == count
    json.dumps(rope_record(found), allow_nan=False)


def test_intervals_of_a_rope_need_a_rope_and_one_interval() -> None:
    for choices, said in (
        ({"rope": 1}, "--counterbalance: 2"),
        ({"over": OrientationRule.INCLUSION}, "one interval"),
        ({"kind": WorkspaceKind.REACHABLE}, "--kind"),
        ({"tension_model": TensionModel.PSEUDO_INVERSE}, "wrench_feasible or force_only"),
    ):
        with pytest.raises(InvalidInput, match=said):
            rope_tensions(planar(), **choices)
