"""New study files: every template works as it stands, at other sizes, and with all its examples taken in."""

import re
from pathlib import Path

import numpy as np
import pytest

from actuator_select.errors import InvalidInput, UnknownName
from actuator_select.model.robot import Freedom
from actuator_select.model.tension import TensionModel
from actuator_select.selection.selection import study_demand
from actuator_select.study import TEMPLATES, Study, TemplateOptions, parse_study, template_text

FAMILIES = [name for name in TEMPLATES if name != "anchors"]
HEADER = "cable,frame_x_m,frame_y_m,frame_z_m,platform_x_m,platform_y_m,platform_z_m\n"
SIZED = [
    ("suspended-8", TemplateOptions(hall=(15.0, 11.0, 5.0), platform=(1.0, 1.0, 1.0), mass=300.0)),
    ("suspended-8", TemplateOptions(hall=(20.0, 20.0, 20.0), mass=4000.0)),
    ("constrained-8", TemplateOptions(hall=(15.0, 11.0, 5.0), platform=(1.0, 1.0, 1.0), mass=300.0, speed=2.0)),
    ("planar-4", TemplateOptions(hall=(28.0, 1.0, 5.7), platform=(1.9, 1.0, 0.45), mass=300.0)),
    ("cpr8", TemplateOptions(hall=(10.0, 10.0, 10.0), platform=(1.0, 1.0, 1.0))),
    ("camera-4", TemplateOptions(hall=(100.0, 60.0, 20.0), mass=20.0, speed=8.0)),
]


def attainable_share(study: Study) -> float:
    return float(study_demand(study).attainable_positions.mean())


@pytest.mark.parametrize("template", FAMILIES)
def test_every_template_works_as_it_stands(template: str) -> None:
    study = parse_study(template_text('my "robot"', template), place="new")
    assert study.name == 'my "robot"'
    assert attainable_share(study) > 0.95


@pytest.mark.parametrize(("template", "options"), SIZED)
def test_a_template_suits_the_size_that_is_asked_for(template: str, options: TemplateOptions) -> None:
    study = parse_study(template_text("new", template, options), place="new")
    assert attainable_share(study) > 0.9
    assert study.loads[0].body.mass == (options.mass or TEMPLATES[template].mass)
    assert study.motion.speed == (options.speed or TEMPLATES[template].speed)


@pytest.mark.parametrize("template", FAMILIES)
def test_the_commented_examples_are_keys_of_a_study(template: str) -> None:
    text = re.sub(r"^#(?=\S)", "", template_text("new", template), flags=re.MULTILINE)
    study = parse_study(text, place="new")
    assert [load.title for load in study.loads] == ["full", "empty"]
    assert [one.title for one in study.table.requirement.must_serve] == ["Home", "Work area"]
    assert study.table.workspace.home_m is not None
    assert study.robot.bounds.length_min.min() > 0.0


@pytest.mark.parametrize("template", FAMILIES)
def test_new_studies_let_no_cable_push_and_state_their_tensions(template: str) -> None:
    study = parse_study(template_text("new", template), place="new")
    assert study.tension_model is (TensionModel.FORCE_ONLY if template == "cpr8" else TensionModel.WRENCH_FEASIBLE)
    assert study.motion.acceleration_shape.value == "ball"
    share = study.robot.bounds.tension_min / study.robot.bounds.tension_max
    assert ((share >= 0.01) & (share <= 0.05)).all()


def test_cables_that_pull_against_each_other_get_more_tension_than_hanging_ones() -> None:
    options = TemplateOptions(hall=(15.0, 11.0, 5.0), platform=(1.0, 1.0, 1.0), mass=300.0)
    hung, held = (
        parse_study(template_text("new", name, options), place="new") for name in ("suspended-8", "constrained-8")
    )
    assert held.robot.bounds.tension_max[0] > hung.robot.bounds.tension_max[0]


@pytest.mark.parametrize("configuration", ["a", "b", "c", "d"])
def test_the_planar_template_takes_a_counterbalance(configuration: str) -> None:
    text = template_text("new", "planar-4").replace('configuration = "none"', f'configuration = "{configuration}"')
    study = parse_study(text.replace("# t5_n", "t5_n"), place="new")
    assert len(study.robot.counterbalances) == 1


def test_anchors_are_copied_exactly(tmp_path: Path) -> None:
    file = tmp_path / "anchors.csv"
    anchors = [(0.1, 0.0, 3.0), (4.0, 0.0, 3.0), (4.0, 5.123456789, 3.0), (0.0, 5.0, 3.0)]
    file.write_text(HEADER + "".join(f"{i},{x},{y},{z},0,0,0\n" for i, (x, y, z) in enumerate(anchors)), "utf-8")
    study = parse_study(template_text("new", "anchors", TemplateOptions(anchors=file, mass=2.0)), place="new")
    assert np.array_equal(study.robot.frame_anchors, anchors)
    assert study.robot.freedom is Freedom.POINT
    assert attainable_share(study) == 1.0


def test_anchors_in_a_vertical_plane_make_a_planar_robot(tmp_path: Path) -> None:
    file = tmp_path / "anchors.csv"
    rows = ["1,-5,0,2,-0.5,0,-0.2", "2,5,0,2,0.5,0,-0.2", "3,5,0,-2,0.5,0,0.2", "4,-5,0,-2,-0.5,0,0.2"]
    file.write_text(HEADER + "\n".join(rows), "utf-8")
    study = parse_study(template_text("new", "anchors", TemplateOptions(anchors=file)), place="new")
    assert study.robot.freedom is Freedom.PLANAR
    assert study.table.workspace.points[1] == 1
    assert attainable_share(study) > 0.95


def test_a_robot_that_holds_nothing_is_written_and_says_so(tmp_path: Path) -> None:
    file = tmp_path / "anchors.csv"
    file.write_text(HEADER + "1,0,0,3,0,0,0\n2,4,0,3,0,0,0.1\n", "utf-8")
    text = template_text("new", "anchors", TemplateOptions(anchors=file))
    assert "No box was found" in text
    assert attainable_share(parse_study(text, place="new")) == 0.0


@pytest.mark.parametrize(
    ("template", "options", "message"),
    [
        ("suspended-8", TemplateOptions(hall=(15.0, 11.0)), "--hall: 15,11, expected length, width and height"),
        ("suspended-8", TemplateOptions(hall=(15.0, 11.0, -5.0)), "--hall: 15,11,-5"),
        ("suspended-8", TemplateOptions(platform=(1.0, 20.0, 1.0)), "smaller than the hall"),
        ("camera-4", TemplateOptions(platform=(1.0, 1.0, 1.0)), "no --platform with the template camera-4"),
        ("six-six", TemplateOptions(mass=float("nan")), "--mass: nan"),
        ("six-six", TemplateOptions(mass=1e9), "--mass: 1e+09"),
        ("cpr8", TemplateOptions(platform=(2.1, 2.1, 2.1)), "diagonal fits"),
        ("camera-4", TemplateOptions(anchors=Path("a.csv")), "--anchors: a.csv"),
    ],
)
def test_an_option_that_does_not_suit_is_refused(template: str, options: TemplateOptions, message: str) -> None:
    with pytest.raises(InvalidInput, match=re.escape(message)):
        template_text("new", template, options)


def test_an_unknown_template_is_refused_with_the_known_ones() -> None:
    with pytest.raises(UnknownName, match="did you mean 'planar-4'"):
        template_text("new", "planar4")
