"""``actuator-select workspace`` and ``actuator-select sweep``: contract and bad input."""

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select.cli import main

Run = Callable[..., tuple[int, str, str]]

HANGING = """
name = "hanging"
[[robot.cable]]
frame_anchor_m = [0.0, 0.0, 2.0]
platform_anchor_m = [0.0, 0.0, 0.0]
[[robot.cable]]
frame_anchor_m = [3.0, 0.0, 2.0]
platform_anchor_m = [0.0, 0.0, 0.0]
[robot]
degrees_of_freedom = "2T"
mass_kg = 2.0
[cables]
tension_min_n = 1.0
tension_max_n = 60.0
[workspace]
box_m = [[-0.5, 3.5], [0.0, 0.0], [0.0, 1.9]]
points = [9, 1, 8]
[motion]
set = "independent"
speed_max_m_per_s = 1.0
acceleration_time_s = 1.0
deceleration_time_s = 1.0
"""


@pytest.fixture
def run(capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run the program in a folder with a small study."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "hanging.toml").write_text(HANGING, encoding="utf-8")

    def call(*arguments: str) -> tuple[int, str, str]:
        status = main(list(arguments))
        out, err = capfd.readouterr()
        return status, out, err

    return call


def test_the_table_says_what_the_share_is_of_and_what_comes_next(run: Run) -> None:
    status, out, err = run("workspace", "hanging.toml", "--set", "workspace.home_m=[1.5,0,1]")
    assert status == 0
    for text in ("9 × 1 × 8 positions", "wrench_feasible", "/72 (", "m²", "area, estimated", "connected to home"):
        assert text in out
    assert out.index("wrench_feasible") < out.index("/72 (")
    assert "Next: actuator-select rank hanging.toml --set" in err


@pytest.mark.parametrize("kind", ["reachable", "static", "wrench-feasible", "dynamic-feasible", "twist-feasible"])
@pytest.mark.parametrize("orientations", ["constant", "inclusion", "total"])
def test_json_stands_alone_for_every_kind(run: Run, kind: str, orientations: str) -> None:
    status, out, _ = run(
        *("workspace", "hanging.toml", "--kind", kind, "--orientations", orientations, "--format", "json"),
        *("--set", "cables.speed_max_m_per_s=0.95"),
    )
    record = json.loads(out, parse_constant=pytest.fail)
    assert status == 0
    assert (record["kind"], record["orientations"], record["poses"]) == (kind, orientations, 72)
    assert record["measure_interval"][0] <= record["measure_interval"][1]


def test_names_of_kinds_and_models_may_be_shortened_and_joined_either_way(run: Run) -> None:
    _, out, _ = run(
        *("workspace", "hanging.toml", "--kind", "wrench", "--tension-model", "pseudo-inverse", "--format", "json")
    )
    record = json.loads(out)
    assert (record["kind"], record["tension_model"]) == ("wrench-feasible", "pseudo_inverse")
    assert any("least norm" in warning for warning in record["warnings"])


def test_csv_has_a_row_per_position(run: Run) -> None:
    _, table, _ = run("workspace", "hanging.toml", "--format", "csv")
    _, record, _ = run("workspace", "hanging.toml", "--format", "json")
    rows = list(csv.DictReader(io.StringIO(table)))
    assert list(rows[0]) == ["x_m", "y_m", "z_m", "feasible", "margin_n", "tension_n", "apart"]
    assert len(rows) == 72
    assert sum(row["feasible"] == "1" for row in rows) == json.loads(record)["feasible_poses"]
    assert all(float(row["margin_n"]) >= 0.0 for row in rows if row["feasible"] == "1")


@pytest.mark.parametrize("points", ["[9,1,8]", "[4,1,1]", "[1,1,1]"])
def test_a_plot_is_written_for_every_kind_of_grid(run: Run, points: str, tmp_path: Path) -> None:
    status, _, err = run("workspace", "hanging.toml", "--set", f"workspace.points={points}", "--plot", "w.svg")
    assert status == 0, err
    assert (tmp_path / "w.svg").read_text(encoding="utf-8").startswith("<?xml")


def test_a_spatial_workspace_is_drawn_and_published_tensions_are_bounded(run: Run, tmp_path: Path) -> None:
    status, out, _ = run(
        "workspace", "cpr8", "--kind", "static", "--tension-model", "wrench_feasible", "--plot", "w.png"
    )
    assert status == 0
    assert "68/216" in out
    assert (tmp_path / "w.png").stat().st_size > 10_000


def test_that_nothing_is_feasible_is_a_result_with_its_reason(run: Run) -> None:
    status, out, _ = run("workspace", "hanging.toml", "--set", "cables.tension_max_n=2")
    assert status == 0
    assert "0/72 (0.0 %)" in out
    assert "cables.tension_max_n is too small" in out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("workspace", "hanging.toml", "--kind", "twist-feasible"), "cables.speed_max_m_per_s"),
        (("workspace", "hanging.toml", "--kind", "flying"), "is not one of"),
        (("workspace", "hanging.toml", "--plot", "w.bmp"), "expected a name that ends in"),
        (("workspace", "hanging.toml", "--counterbalance-interval"), "no counterbalance"),
        (("workspace", "hanging.toml", "--set", "workspace.points=[1000,1000,1000]"), "single point along y"),
        (("workspace", "cpr8", "--set", "workspace.points=[1000,1000,1000]"), "--no-limit"),
        (("sweep", "hanging.toml", "robot.mass=1:3:1"), "robot.mass"),
        (("sweep", "hanging.toml", "robot.mass_kg=1:3"), "START:STOP:STEP"),
        (("sweep", "hanging.toml", "robot.mass_kg=1:1000000:0.1"), "100,000"),
        (("sweep", "hanging.toml"), "Missing argument"),
        (("sweep", "nowhere.toml", "robot.mass_kg=1:2:1"), "no study"),
    ],
)
def test_bad_input_is_refused_with_the_remedy(run: Run, arguments: tuple[str, ...], said: str) -> None:
    status, out, err = run(*arguments)
    assert status == 2
    assert said in err
    assert not out


def test_without_limit_large_grids_are_taken(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("actuator_select.study.refusals.MOST_CABLE_POSES", 10)
    assert run("workspace", "hanging.toml")[0] == 2
    assert run("workspace", "hanging.toml", "--no-limit")[0] == 0
    assert run("sweep", "hanging.toml", "robot.mass_kg=1:2:1")[0] == 2
    assert run("sweep", "hanging.toml", "robot.mass_kg=1:2:1", "--no-limit")[0] == 0


def test_a_sweep_prints_a_row_per_combination_and_the_best(run: Run) -> None:
    status, out, err = run("sweep", "hanging.toml", "robot.mass_kg=1:3:1", "cables.tension_max_n=[40,80]")
    assert status == 0
    assert sum("/72" in line for line in out.splitlines()) == 6
    assert "Most is feasible at robot.mass_kg = 1, cables.tension_max_n = 80" in out
    following = err.split("Next: actuator-select ")[1].split()
    assert following[-4:] == ["--set", "robot.mass_kg=1", "--set", "cables.tension_max_n=80"]
    assert run(*following)[0] == 0


def test_a_sweep_gives_csv_json_and_a_plot(run: Run, tmp_path: Path) -> None:
    _, table, _ = run("sweep", "hanging.toml", "robot.mass_kg=1:3:1", "--format", "csv", "--plot", "line.svg")
    rows = list(csv.DictReader(io.StringIO(table)))
    assert [row["robot.mass_kg"] for row in rows] == ["1", "2", "3"]
    counts = [int(row["feasible_poses"]) for row in rows]
    assert counts == sorted(counts, reverse=True)
    _, text, _ = run(
        *("sweep", "hanging.toml", "robot.mass_kg=1:9:1", "cables.tension_max_n=90:10:-10", "--kind", "static"),
        *("--format", "json", "--plot", "map.svg"),
    )
    record = json.loads(text, parse_constant=pytest.fail)
    assert len(record["points"]) == 81
    assert record["kind"] == "static"
    for name in ("line.svg", "map.svg"):
        assert (tmp_path / name).read_text(encoding="utf-8").startswith("<?xml")


ROPE = (
    "robot.counterbalance=[{tension_n=5.0, segment=[{frame_anchor_m=[1.5,0.0,4.0], platform_anchor_m=[0.0,0.0,0.0]}]}]"
)


def test_tensions_of_a_counterbalance_in_every_format(run: Run) -> None:
    asked = ("workspace", "hanging.toml", "--set", ROPE, "--counterbalance-interval")
    status, out, _ = run(*asked)
    assert status == 0
    assert "The best constant tension is" in out
    _, table, _ = run(*asked, "--format", "csv")
    rows = list(csv.DictReader(io.StringIO(table)))
    assert len(rows) == 72
    _, text, _ = run(*asked, "--format", "json")
    record = json.loads(text, parse_constant=pytest.fail)
    some = [row for row in rows if row["tension_greatest_n"] and float(row["tension_greatest_n"]) >= 0.0]
    assert record["feasible_poses_at_some_tension"] == len(some) > 0
    assert run(*asked, "--plot", "x.svg")[0] == 2
