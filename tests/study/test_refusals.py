"""Questions that cannot be posed are refused with place, value, expectation, unit and remedy."""

from pathlib import Path

import pytest

from actuator_select.errors import InvalidStudy
from actuator_select.study import load_study, parse_study, template_text

HALL = template_text("hall", "suspended-8")
CAMERA = template_text("camera")
PLANAR = template_text("planar", "planar-4")
HEADER = "cable,frame_x_m,frame_y_m,frame_z_m,platform_x_m,platform_y_m,platform_z_m\n"


def refused(text: str, **overrides: object) -> str:
    keys = {key.replace("__", "."): value for key, value in overrides.items()}
    with pytest.raises(InvalidStudy) as error:
        parse_study(text, place="study.toml", overrides=keys)
    return str(error.value)


def test_a_home_off_the_grid_is_refused() -> None:
    assert "workspace.home_m: [100.0, 0.0, 0.0], expected a position in the box" in refused(
        HALL, workspace__home_m=[100.0, 0.0, 0.0]
    )


def test_what_leaves_the_plane_of_a_planar_robot_is_refused() -> None:
    assert "extends along y" in refused(
        PLANAR, workspace__box_m=[[-1.0, 1.0], [0.0, 1.0], [0.0, 0.5]], workspace__points=[3, 3, 3]
    )
    assert "payload[0].force_n: pushes along y" in refused(PLANAR, payload__force_n=[0.0, 5.0, 0.0])
    assert "turns about y only" in refused(PLANAR, workspace__orientations_rad=[[0.1, 0.0, 0.0]])
    assert "leaves the plane" in refused(CAMERA, robot__degrees_of_freedom="2T")


def test_a_turn_about_the_normal_of_the_plane_is_taken() -> None:
    study = parse_study(PLANAR, place="x.toml", overrides={"workspace.orientations_rad": [[0.0, 0.05, 0.0]]})
    assert study.orientations.tolist() == [[0.0, 0.05, 0.0]]


def test_a_point_does_not_turn() -> None:
    assert "a point does not turn [rad/s]" in refused(CAMERA, motion__angular_speed_max_rad_per_s=1.0)


def test_a_number_or_a_list_is_blamed_for_what_was_written() -> None:
    for value, expected in (
        (-1.0, "cables.tension_min_n: -1.0, expected at least 0 [N]"),
        ("a", 'cables.tension_min_n: "a", expected a number [N]'),
        ([1.0, -2.0], "cables.tension_min_n[1]: -2.0, expected at least 0 [N]"),
    ):
        message = refused(HALL, cables__tension_min_n=value)
        assert expected in message
        assert "constrained" not in message
        assert message.count("\n") == 1


def test_bounds_that_cross_name_the_cable() -> None:
    message = refused(HALL, cables__tension_min_n=[1.0, 2.0, 9.0, 1.0, 1.0, 1.0, 1.0, 1.0], cables__tension_max_n=5.0)
    assert "cables.tension_min_n: 9 of cable 3, expected at most its tension_max_n, 5 [N]" in message


def test_the_same_cable_twice_is_refused() -> None:
    study = {"robot.cable": [{"frame_anchor_m": [0.0, 0.0, 2.0], "platform_anchor_m": [0.0, 0.0, 0.0]}] * 2}
    assert "both anchors coincide with those of robot.cable[0]" in refused(
        CAMERA, **{key.replace(".", "__"): value for key, value in study.items()}
    )


def test_many_cables_are_refused_by_the_time_they_would_take() -> None:
    with pytest.raises(InvalidStudy, match=r"some \d+ h and"):
        load_study("cogiro", {"workspace.points": [99, 99, 101], "payload.mass_kg": 1.0, **_doubled()})


def _doubled() -> dict[str, object]:
    """Three times the cables of the CoGiRo, the further ones elsewhere."""
    cables = load_study("cogiro").table.robot.cable or ()
    return {
        "robot.cable": [
            {
                "frame_anchor_m": [x + shift, y, z],
                "platform_anchor_m": list(cable.platform_anchor_m),
            }
            for shift in (0.0, 0.1, 0.2)
            for cable in cables
            for x, y, z in [cable.frame_anchor_m]
        ]
    }


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("1,0,0,2,0,0,0\n1,3,0,2,0,0,0\n", "cable '1' stands in line 2 already"),
        ("1,0,0,2,0,0,0,7\n", "8 cells, expected 7, one per column"),
        ("1,0,0\n", "frame_z_m: is missing, expected a number"),
        ("1,0,0,1e30,0,0,0\n", "frame_z_m: '1e30', expected a number from -1e+06 to 1e+06 [m]"),
        ("1,0,0,x,0,0,0\n", "frame_z_m: 'x'"),
    ],
)
def test_bad_anchors_of_a_csv_file_are_named_with_file_and_line(tmp_path: Path, rows: str, said: str) -> None:
    (tmp_path / "anchors.csv").write_text(HEADER + rows, encoding="utf-8")
    text = _with_csv()
    with pytest.raises(InvalidStudy) as error:
        parse_study(text, place=str(tmp_path / "study.toml"))
    assert said in str(error.value)
    assert f"{tmp_path / 'anchors.csv'}, line " in str(error.value)


def test_a_csv_file_with_semicolons_says_what_separates_columns(tmp_path: Path) -> None:
    (tmp_path / "anchors.csv").write_text((HEADER + "1,0,0,2,0,0,0\n").replace(",", ";"), encoding="utf-8")
    with pytest.raises(InvalidStudy, match=r"separate columns with commas"):
        parse_study(_with_csv(), place=str(tmp_path / "study.toml"))


def _with_csv() -> str:
    import tomlkit

    document = tomlkit.parse(CAMERA)
    document["robot"] = {"anchors_csv": "anchors.csv"}
    return tomlkit.dumps(document)


def test_moves_loads_and_motions_that_leave_the_plane_are_refused() -> None:
    cases = (
        ({"move": [{"title": "out", "from_m": [0.0, 1.0, 0.0], "to_m": [0.5, 1.0, 0.0]}]}, "move[0]: leaves the plane"),
        ({"payload.moment_n_m": [0.0, 0.0, 5.0]}, "payload[0].moment_n_m: turns about x and z"),
        ({"robot.centre_of_gravity_m": [0.0, 0.3, 0.0]}, "robot.centre_of_gravity_m: lies off the plane"),
        (
            {"motion.set": "list", "motion.case": [{"velocity_m_per_s": [0.0, 3.0, 0.0]}]},
            "motion.case[0]: moves along y",
        ),
        (
            {"motion.set": "list", "motion.case": [{"angular_velocity_rad_per_s": [1.0, 0.0, 0.0]}]},
            "motion.case[0]: turns",
        ),
    )
    for changes, said in cases:
        assert said in refused(PLANAR, **{key.replace(".", "__"): value for key, value in changes.items()})


def test_moves_need_a_speed() -> None:
    with pytest.raises(InvalidStudy, match=r"motion\.speed_max_m_per_s: is missing"):
        load_study("qi-a", {"move": [{"title": "m", "from_m": [0.0, 0.0, 0.0], "to_m": [1.0, 0.0, 0.0]}]})


def test_a_column_that_stands_twice_is_refused(tmp_path: Path) -> None:
    text = HEADER.replace("\n", ",frame_x_m\n") + "1,-2,-2,3,0,0,0,9\n"
    (tmp_path / "anchors.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InvalidStudy, match="column frame_x_m twice, expected every column once"):
        parse_study(_with_csv(), place=str(tmp_path / "study.toml"))
