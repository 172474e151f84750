"""The report on a robot's workspace: complete, escaped, with the numbers of `evaluate_workspace`."""

import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from mpl_toolkits.mplot3d.axes3d import Axes3D

from actuator_select import ReportDetails, load_study, render_workspace_report
from actuator_select.report.grids import cell_edges
from actuator_select.report.sweep_figures import key_label, sweep_figure
from actuator_select.report.workspace_panels import workspace_panels
from actuator_select.selection.sweeps import sweep_built
from actuator_select.selection.workspaces import evaluate_workspace
from actuator_select.study import TEMPLATES, Study, parse_study, template_text
from actuator_select.study.loading import text_builder
from actuator_select.study.sweeping import parse_sweep

DETAILS = ReportDetails(generated_at=datetime(2026, 11, 22, 12, 0, tzinfo=UTC), project="Hall <two>", author="A & B")
FAMILIES = [name for name in TEMPLATES if name != "anchors"]
SECTIONS = (
    "What the share is of",
    "What is not modelled",
    "The robot",
    "Where it can work",
    "What the answer owes to the tension model",
    "Robot and study",
    "To repeat this report",
)


def without_drives(template: str, **changes: str) -> Study:
    """A template as a study of its robot alone; changes replace whole lines by their key."""
    text = template_text("new", template)
    for key, line in changes.items():
        text = re.sub(rf"(?m)^#?{key} = .*$", line, text)
    return parse_study(re.sub(r'(?m)^kind = "actuators"', 'kind = "none"', text), place="new")


def words(page: str) -> str:
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL)).split())


@pytest.mark.parametrize("template", FAMILIES)
def test_every_family_gets_a_whole_report_with_the_workspaces_numbers(template: str) -> None:
    study = without_drives(template)
    page = render_workspace_report(study, DETAILS)
    own = evaluate_workspace(study)
    assert all(f"<h2>{section}</h2>" in page for section in SECTIONS)
    assert f"{own.feasible_poses}/{own.poses}" in words(page)
    assert own.measure is not None
    assert f"{own.measure:.4g}" in words(page)
    assert "Hall &lt;two&gt;" in page
    assert "A &amp; B" in page
    images = re.findall(r"<img[^>]*>", page)
    assert len(images) >= 4  # robot, map, margin, tension
    assert all("data:image/" in one and re.search(r'alt="[^"]{10,}"', one) for one in images)
    assert len(page.encode()) < 2_500_000


def test_a_robot_that_holds_nothing_gets_a_report_that_says_so() -> None:
    study = without_drives("suspended-8", tension_max_n="tension_max_n = 300.0", tension_min_n="tension_min_n = 200.0")
    page = words(render_workspace_report(study, DETAILS))
    assert "No position can be held." in page


def test_positions_set_apart_are_said_to_be_and_drawn_as_such() -> None:
    study = load_study("qi-a", {"cables.length_min_m": 1.3})
    own = evaluate_workspace(study)
    assert own.too_near_poses > 0
    bare = without_drives("planar-4", length_min_m="length_min_m = 2.6")
    near = evaluate_workspace(bare).too_near_poses
    assert near > 0
    page = words(render_workspace_report(bare, DETAILS))
    assert f"{near} positions nearer to an anchor than the least cable length are set apart" in page
    figure = workspace_panels(study, [("all", own.feasible)], apart=own.apart)
    assert any("set apart" in one.get_text() for one in figure.legends[0].get_texts())


def test_planar_grids_are_maps_and_spatial_ones_stand_in_space() -> None:
    for template in ("planar-4", "suspended-8"):
        study = without_drives(template)
        figure = workspace_panels(study, [("one", evaluate_workspace(study).feasible)] * 2)
        assert isinstance(figure.axes[0], Axes3D) == (template == "suspended-8")


def test_cells_lie_around_nodes_and_between_the_ends_of_midpoints() -> None:
    study = load_study("qi-a")
    assert cell_edges(study, 0)[[0, -1]] == pytest.approx([-12.6, 12.6])
    halved = load_study("qi-a", {"workspace.grid": "midpoints"})
    assert cell_edges(halved, 0)[[0, -1]] == pytest.approx([-12.5, 12.5])


def test_sweeps_name_keys_with_units_and_positions_on_the_right() -> None:
    assert key_label("robot.w_p_m") == "robot.w_p [m]"
    assert key_label("payload.force_n[1]") == "payload.force_y [N]"
    assert key_label("payload.moment_n_m[2]") == "payload.moment_z [N m]"
    assert key_label("motion.speed_max_m_per_s") == "motion.speed_max [m/s]"
    study = load_study("qi-a")
    keys = ["robot.w_p_m=0:20:10", "robot.t5_n=1000:2000:1000", "robot.mass_kg=[300.0]"]
    sweep = sweep_built(
        text_builder(study.text, "qi-a", {"workspace.points": [21, 1, 6]}, limit=True), parse_sweep(keys)
    )
    figure = sweep_figure(sweep)
    assert [one.get_text() for one in figure.legends[0].get_texts()] == ["robot.t5 = 1000 N", "robot.t5 = 2000 N"]
    assert "robot.mass = 300 kg" in figure.axes[0].get_title()
    assert [one.get_ylabel() for one in figure.axes[0].child_axes] == ["positions"]


def test_the_margin_is_explained_as_the_tension_model_has_it() -> None:
    assert "Moments are divided by" in render_workspace_report(without_drives("planar-4"), DETAILS)
    assert "Forces only." in render_workspace_report(without_drives("camera-4"), DETAILS)


@pytest.mark.parametrize(("name", "count"), [("qi-a", "2820/3276 (86.1 %)"), ("hamedi", "3675/43706 (8.4 %)")])
def test_the_finished_reports_have_their_counts_and_all_their_sections(name: str, count: str) -> None:
    finished = (Path(__file__).parents[2] / "reports" / f"{name}.html").read_text(encoding="utf-8")
    own = evaluate_workspace(load_study(name))
    assert count == f"{own.feasible_poses}/{own.poses} ({own.feasible_percent:.1f} %)"
    assert count in finished
    study = load_study(name)
    assert all(f"<h2>{section}</h2>" in finished for section in (*SECTIONS, "What the workspace depends on", "Notes"))
    assert finished.count("<img") >= 5 + len(study.table.sweep)
    assert all(f"<h3>{one.title}</h3>" in finished for one in (*study.table.sweep, *study.table.note))
    assert len(finished.encode()) < 2_500_000


@pytest.mark.parametrize(("count", "columns"), [(2, 2), (4, 2), (8, 3)])
def test_many_maps_stand_three_in_a_row(count: int, columns: int) -> None:
    study = load_study("qi-a")
    served = np.ones(len(study.positions), dtype=np.bool_)
    figure = workspace_panels(study, [(f"Actuator {number}", served) for number in range(count)])
    assert figure.axes[0].get_subplotspec().get_gridspec().ncols == columns
