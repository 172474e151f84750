"""Which positions of a study count, which have to be served, and what the ranking says of them."""

import json
from collections.abc import Iterator

import numpy as np
import pytest

from actuator_select import Catalogue, load_study, open_catalogue, rank, simulate
from actuator_select.errors import InvalidInput, InvalidStudy
from actuator_select.model.grid_measure import connected_positions
from actuator_select.selection import selection_record
from actuator_select.selection.records import simulation_record
from actuator_select.selection.workspaces import evaluate_workspace
from actuator_select.study import Study
from tests.selection.parts import PRINTED
from tests.selection.test_selection import add_actuator

ONE = "name = 'Actuator 1'"
HELD = {"tension.model": "force_only"}


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


def study(**overrides: object) -> Study:
    return load_study("cpr8", overrides=HELD | {key.replace("__", "."): value for key, value in overrides.items()})


def test_positions_near_an_anchor_are_set_apart_everywhere_alike(catalogue: Catalogue) -> None:
    near = study(cables__length_min_m=0.5)
    anchors, placed = near.robot.frame_anchors, near.robot.platform_anchors
    lengths = np.linalg.norm(near.positions[:, None] + placed - anchors, axis=2)
    apart = int((lengths < 0.5).any(axis=1).sum())
    assert 0 < apart < 216
    record = selection_record(rank(near, catalogue, where=ONE))
    assert (record["poses"], record["too_near_poses"]) == (216 - apart, apart)
    assert record["actuators"][0]["poses"] == 216 - apart
    found = evaluate_workspace(near)
    assert (found.poses, found.too_near_poses) == (216 - apart, apart)
    with pytest.raises(InvalidInput, match="length_min_m"):
        rank(study(cables__length_min_m=50.0), catalogue, where=ONE)


MIDDLE = {"title": "middle", "position_m": [1.6, 1.1, -1.1]}
CORNER = {"title": "corner", "box_m": [[0.16, 0.3], [0.16, 0.3], [-0.3, -0.16]]}


def test_places_that_have_to_be_served_decide_the_verdict(own: Catalogue) -> None:
    add_actuator(own, "unknown", nominal_voltage_v=None)
    where = "name in ('Actuator 1', 'unknown')"
    easy = {"requirement__feasible_percent": 10.0}
    for places, verdicts in (
        ([MIDDLE], {"Actuator 1": "meets", "unknown": "undecided"}),
        ([MIDDLE, CORNER], {"Actuator 1": "fails", "unknown": "fails"}),
    ):
        ranked = rank(study(**easy, requirement__must_serve=places), own, where=where).ranked
        assert {one.name: one.verdict.value for one in ranked} == verdicts
        missed = {one.name: one.missed for one in ranked}
        assert ("corner" in missed["Actuator 1"]) == (CORNER in places)
        assert "middle" not in missed["Actuator 1"]
        assert "middle" in missed["unknown"]


def test_what_no_drive_attains_is_the_robots_fault(catalogue: Catalogue) -> None:
    selection = rank(study(), catalogue, where=ONE)
    assert selection.attainable_percent == pytest.approx(100.0 * 144 / 216)  # as published numbers have it
    assert selection.robot_falls_short
    assert not rank(study(), catalogue, where=ONE, require=66.0).robot_falls_short


def test_a_pose_counts_only_if_it_holds_with_every_load(catalogue: Catalogue) -> None:
    def served(*masses: float) -> int:
        loads = [{"title": f"{mass} kg", "mass_kg": mass} for mass in masses]
        return rank(study(payload=loads), catalogue, where=ONE).ranked[0].feasible_poses

    light, heavy, both = served(0.5), served(4.0), served(0.5, 4.0)
    assert both <= min(light, heavy)
    assert served(4.0, 0.5) == both
    assert served(4.0, 4.0) == heavy


def test_only_neighbours_along_the_axes_connect() -> None:
    grid = np.array([[1, 1, 0, 1], [0, 1, 0, 1], [1, 0, 1, 1]], dtype=bool)  # y down, z across
    count = {index: connected_positions(grid.ravel(), (1, 3, 4), index) for index in (0, 2, 3, 8)}
    assert count == {0: 3, 2: 0, 3: 4, 8: 1}


def test_the_connected_share_is_of_what_the_actuator_serves(catalogue: Catalogue) -> None:
    one = rank(study(workspace__home_m=[1.6, 1.1, -1.1]), catalogue, where=ONE).ranked[0]
    assert one.connected_percent is not None
    assert 0.0 < one.connected_percent <= 100.0
    away = rank(study(workspace__home_m=[0.16, 0.16, -0.16]), catalogue, where=ONE).ranked[0]
    assert away.connected_percent == 0.0
    assert rank(study(), catalogue, where=ONE).ranked[0].connected_percent is None


def test_the_record_has_what_places_add(catalogue: Catalogue) -> None:
    record = json.loads(json.dumps(selection_record(rank(study(), catalogue, where=PRINTED)), allow_nan=False))
    assert {"attainable_poses", "attainable_percent", "robot_falls_short", "too_near_poses"} <= set(record)
    for one in record["actuators"]:
        assert one["feasible_poses"] <= one["feasible_poses_exact"] <= record["attainable_poses"]
        assert one["connected_percent"] is None
        assert one["must_serve_missed"] == []


@pytest.mark.parametrize("model", ["wrench_feasible", "force_only"])
def test_a_move_through_what_cannot_be_held_says_so(catalogue: Catalogue, model: str) -> None:
    asked = load_study("cpr8", overrides={"tension.model": model})
    run = simulate(asked, catalogue, "Actuator 5", start=[1.6, 1.1, -1.1], stop=[1.6, 1.1, -0.2])
    record = json.loads(json.dumps(simulation_record(run), allow_nan=False))
    assert record["infeasible"] is bool(run.history.infeasible.any())
    assert np.array_equal(np.isnan(run.history.tension).any(axis=1), run.history.infeasible)
    assert run.pushing == []


def test_a_limit_exceeded_up_to_where_nothing_holds_any_more_ends_there(own: Catalogue) -> None:
    add_actuator(own, "weak", rated_torque_nm=1e-4)
    asked = load_study("cpr8", overrides={"tension.model": "force_only", "cables.tension_max_n": 20.0})
    run = simulate(asked, own, "weak", start=[1.6, 1.1, -1.1], stop=[1.6, 1.1, -0.16])
    assert 0 < run.history.infeasible.sum() < len(run.history.times)
    over = [one for one in run.exceedances if one.check == "torque"]
    assert over
    assert all(one.start < one.stop <= run.duration for one in over)


def test_places_with_the_same_title_are_refused() -> None:
    twice = [{"title": "corner", "position_m": [0.5, 0.5, -0.5]}] * 2
    with pytest.raises(InvalidStudy, match="every title of"):
        load_study("cpr8", {"requirement.must_serve": twice})
