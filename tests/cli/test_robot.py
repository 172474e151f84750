"""``robot show`` and ``study new`` from the command line."""

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., tuple[int, str, str]]


def test_the_first_five_minutes(run: Run, tmp_path: Path) -> None:
    hall = ["--template", "suspended-8", "--hall", "15,11,5", "--platform", "1,1,1", "--mass", "300"]
    status, out, _ = run("study", "new", "hall.toml", *hall)
    assert status == 0
    assert out.strip() == (
        "Wrote hall.toml. Next: actuator-select robot show hall.toml --plot hall.svg, "
        "then actuator-select rank hall.toml"
    )
    status, out, err = run("robot", "show", "hall.toml", "--plot", "hall.svg")
    assert status == 0
    assert "270/270 (100.0 %) positions, by any drive" in out
    assert "3R3T" in out
    assert "frame point they share" in out
    assert "Next: actuator-select rank hall.toml" in err
    assert (tmp_path / "hall.svg").read_text(encoding="utf-8").startswith("<?xml")
    assert run("rank", "hall.toml")[0] == 0


def test_json_stands_alone_and_has_units_in_its_keys(run: Run) -> None:
    status, out, _ = run("robot", "show", "cpr8", "--format", "json", "--set", "workspace.points=[3,3,3]")
    record = json.loads(out, parse_constant=pytest.fail)
    assert status == 0
    assert record["poses"] == record["singular_poses"] == 27
    assert len(record["per_cable"]) == 8
    assert set(record["per_cable"][0]) == {
        "cable",
        "frame_anchor_m",
        "platform_anchor_m",
        "shortest_m",
        "longest_m",
        "unstretched_m",
        "tension_max_n",
        "speed_max_m_per_s",
        "largest_force_n",
        "force_direction",
        "at_position_m",
        "load",
    }
    assert "similar_anchors" in [one["code"] for one in record["warnings"]]


def test_csv_has_a_row_per_cable(run: Run) -> None:
    status, out, _ = run("robot", "show", "cpr8", "--format", "csv")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert status == 0
    assert [row["cable"] for row in rows] == [str(number) for number in range(1, 9)]
    assert float(rows[0]["shortest_m"]) < float(rows[0]["longest_m"])


@pytest.mark.parametrize("image_format", ["png", "pdf"])
def test_pictures_in_other_formats(run: Run, tmp_path: Path, image_format: str) -> None:
    assert run("robot", "show", "cpr8", "--plot", f"robot.{image_format}", "--format", "json")[0] == 0
    assert (tmp_path / f"robot.{image_format}").stat().st_size > 1000


def test_a_new_study_from_anchors(run: Run, tmp_path: Path) -> None:
    header = "cable,frame_x_m,frame_y_m,frame_z_m,platform_x_m,platform_y_m,platform_z_m\n"
    rows = "1,0,0,3,0,0,0\n2,4,0,3,0,0,0\n3,2,4,3,0,0,0\n"
    (tmp_path / "a.csv").write_text(header + rows, encoding="utf-8")
    assert run("study", "new", "mine.toml", "--template", "anchors", "--anchors", "a.csv", "--mass", "5")[0] == 0
    status, out, err = run("robot", "show", "mine.toml")
    assert status == 0
    assert "3T, a point" in out
    assert "leads upwards" in err
    (tmp_path / "a.csv").write_text(header + "1,0,zero,3,0,0,0\n", encoding="utf-8")
    status, _, err = run("study", "new", "mine.toml", "--force", "--template", "anchors", "--anchors", "a.csv")
    assert status == 2
    assert "a.csv, line 2, frame_y_m: 'zero', expected a number from -1e+06 to 1e+06 [m]" in err
