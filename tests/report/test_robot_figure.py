"""A picture of every family, flat or in 3-D."""

import re

import pytest
from mpl_toolkits.mplot3d.axes3d import Axes3D

from actuator_select.report.robot_figure import robot_figure
from actuator_select.report.style import image_bytes
from actuator_select.study import TEMPLATES, parse_study, template_text

FAMILIES = [name for name in TEMPLATES if name != "anchors"]


@pytest.mark.parametrize("template", FAMILIES)
def test_every_family_is_drawn_with_its_counterbalances(template: str) -> None:
    text = re.sub(r"^#(?=\S)", "", template_text("new", template), flags=re.MULTILINE)
    figure = robot_figure(parse_study(text, place="new"))
    assert image_bytes(figure, "svg").startswith(b"<?xml")
    assert isinstance(figure.axes[0], Axes3D) == (template != "planar-4")


@pytest.mark.parametrize("configuration", ["a", "d"])
def test_the_planar_robot_shows_its_rope(configuration: str) -> None:
    text = template_text("new", "planar-4").replace('configuration = "none"', f'configuration = "{configuration}"')
    figure = robot_figure(parse_study(text.replace("# t5_n", "t5_n"), place="new"))
    assert "counterbalance" in [one.get_text() for one in figure.legends[0].get_texts()]


def test_every_cable_is_numbered_and_lengths_are_to_scale() -> None:
    figure = robot_figure(parse_study(template_text("new", "suspended-8"), place="new"))
    axes = figure.axes[0]
    assert isinstance(axes, Axes3D)
    assert {one.get_text() for one in axes.texts} == {str(number) for number in range(1, 9)}
    assert axes.get_xlabel() == "x [m]"
