"""Pictures of the drive: what bounds the torque-speed plane of motors of every convention."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from actuator_select import Catalogue, load_study, open_catalogue, rank, render_report, simulate
from actuator_select.report.drive_figures import plane_caption, simulation_figure, torque_speed_plane
from actuator_select.selection.dossier import ActuatorDetail, build_dossier
from tests.selection.parts import DC, SERVO, add_drive

WHERE = "id in ('servo', 'dc')"


@pytest.fixture(scope="module")
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        add_drive(opened, "servo", SERVO, efficiency_percent=60)
        add_drive(opened, "dc", DC, efficiency_percent=60)
        yield opened


@pytest.fixture(scope="module")
def details(own: Catalogue) -> dict[str, ActuatorDetail]:
    dossier = build_dossier(rank(load_study("cpr8"), own, where=WHERE), own)
    return {detail.actuator.id: detail for detail in dossier.details}


def lines(figure: Figure) -> dict[str, list[np.ndarray]]:
    """Lines of a plane by their dash: points of each, and none of the axes through the origin."""
    found: dict[str, list[np.ndarray]] = {"-": [], "--": [], "-.": [], ":": []}
    for line in figure.axes[0].lines:
        if line.get_linewidth() > 1.0:
            found[line.get_linestyle()].append(line.get_xydata())
    return found


def labels(figure: Figure) -> list[str]:
    return [text.get_text() for text in figure.axes[0].get_legend().get_texts()]


def test_a_servos_plane_is_bounded_by_rated_and_peak_figures_and_not_by_a_voltage(
    details: dict[str, ActuatorDetail],
) -> None:
    figure = torque_speed_plane(details["servo"])
    drawn = lines(figure)
    assert drawn["--"] == []
    rated, short = (np.abs(np.vstack(drawn[dash])).max(axis=0) for dash in ("-", "-."))
    assert rated == pytest.approx([5000.0, 0.637])
    assert short == pytest.approx([6000.0, 1.91])
    assert labels(figure)[:2] == [
        "rated torque 0.637 N m, rated speed 5000 rpm",
        "peak torque 1.91 N m, greatest speed 6000 rpm",
    ]
    assert "so that no voltage line bounds it" in plane_caption(details["servo"])
    assert "Dash-dotted" in plane_caption(details["servo"])


def test_a_dc_motors_plane_has_its_voltage_line_and_peaks_where_they_are_known(
    details: dict[str, ActuatorDetail],
) -> None:
    drawn = lines(torque_speed_plane(details["dc"]))
    assert len(drawn["--"]) == 2
    assert drawn["-."] == []
    assert "Dash-dotted" not in plane_caption(details["dc"])
    peaked = replace(details["dc"], peak_torque=1.2)
    assert np.abs(np.vstack(lines(torque_speed_plane(peaked))["-."])).max(axis=0)[1] == pytest.approx(1.2)
    assert "peak torque 1.2 N m" in labels(torque_speed_plane(peaked))


def test_a_peak_far_beyond_everything_is_told_and_does_not_flatten_the_rest(
    details: dict[str, ActuatorDetail],
) -> None:
    figure = torque_speed_plane(replace(details["dc"], peak_torque=50.0))
    assert figure.axes[0].get_ylim()[1] < 2.0
    assert "peak torque 50 N m" in labels(figure)


@pytest.mark.parametrize("unknown", ["motor_torque", "motor_speed", "efficiency", "rotor_inertia"])
def test_a_plane_is_drawn_whatever_is_unknown(details: dict[str, ActuatorDetail], unknown: str) -> None:
    detail = details["servo"]
    figures = replace(detail.figures, **{unknown: np.array([np.nan])})
    nothing = replace(detail, figures=figures, peak_torque=np.nan, greatest_speed=np.inf)
    drawn = lines(torque_speed_plane(nothing))
    assert len(drawn["-"]) == (2 if unknown.startswith("motor") else 4)
    assert drawn["-."] == []


def test_a_servos_move_has_a_panel_less(own: Catalogue) -> None:
    line = {"start": (0.5, 0.5, -0.5), "stop": (2.5, 0.5, -0.5)}
    study = load_study("cpr8")
    panels = {one: simulation_figure(simulate(study, own, one, **line)).axes for one in ("servo", "dc")}
    assert (len(panels["servo"]), len(panels["dc"])) == (3, 4)
    assert not any("voltage" in axes.get_ylabel() for axes in panels["servo"])


def test_the_report_says_what_was_assumed_and_what_does_not_apply(own: Catalogue) -> None:
    page = render_report(rank(load_study("cpr8"), own, where=WHERE), own)
    assumed = page[page.index("<h2>What was assumed</h2>") :]
    friction = "iscous friction 0 N m s/rad (assumptions.viscous_friction_nm_s_per_rad)"
    assert f"V{friction}, for dc.</li>" in assumed
    assert f"Assumed: v{friction}." in page[page.index("Parts and sources") :]
    assert "dc *" in page
    assert "servo *" not in page
    assert "servo: voltage not applicable, because its electrical figures are rms phase values" in page
    stated = render_report(rank(load_study("cpr8"), own, where="id = 'servo'"), own)
    assert "The catalogue does not state these figures" not in stated
    assert "Left out, because neither catalogue nor study states it: inertia of gearbox and drum, for servo." in stated


def unknown(detail: ActuatorDetail, *figures: str) -> ActuatorDetail:
    """The same actuator without these figures."""
    nothing = dict.fromkeys(figures, np.array([np.nan]))
    return replace(detail, figures=replace(detail.figures, **nothing))


def test_a_caption_speaks_of_the_lines_that_are_drawn_alone(details: dict[str, ActuatorDetail]) -> None:
    servo = details["servo"]
    assert "inside the blue lines (rated torque and speed, continuous)" in plane_caption(servo)
    assert "between the blue lines (rated speed, continuous)" in plane_caption(unknown(servo, "motor_torque"))
    assert "between the blue lines (rated torque, continuous)" in plane_caption(unknown(servo, "motor_speed"))
    neither = plane_caption(unknown(servo, "motor_torque", "motor_speed"))
    assert "no blue line is drawn" in neither
    assert "Blue points" not in neither
    peak = plane_caption(replace(servo, greatest_speed=np.nan))
    assert "(peak torque)" in peak


def test_without_an_efficiency_the_plane_says_why_it_has_no_points(own: Catalogue) -> None:
    same = {name: value for name, value in own.part("servo")[1].items() if "." not in name and name != "origin"}
    if not [row for row in own.rows("actuators") if row["id"] == "lossless"]:
        own.add("actuators", same | {"id": "lossless", "name": "lossless", "efficiency_percent": None})
    selection = rank(load_study("cpr8"), own, where="id = 'lossless'")
    (detail,) = build_dossier(selection, own).details
    assert detail.cloud.is_empty
    caption = plane_caption(detail)
    assert "cannot be put at the motor, because efficiency is not known" in caption
    assert "Blue points" not in caption
    assert "Blue lines: rated torque and speed" in caption
    assert not {"load torque", "load and rotor acceleration"} & set(labels(torque_speed_plane(detail)))
    assert "A random sample" not in render_report(selection, own)


def test_a_servo_without_rated_torque_shows_its_standstill_torque_as_such(details: dict[str, ActuatorDetail]) -> None:
    known = replace(details["servo"], standstill_torque=0.8)
    assert not [one for one in labels(torque_speed_plane(known)) if "standstill" in one]
    without = unknown(known, "motor_torque")
    figure = torque_speed_plane(without)
    assert "standstill torque, continuous near zero speed: 0.8 N m" in labels(figure)
    dotted = [line for line in figure.axes[0].lines if line.get_linestyle() == ":"]
    assert sorted(line.get_ydata()[0] for line in dotted) == [-0.8, 0.8]
    assert "Dotted: the standstill torque" in plane_caption(without)
    assert "Dotted" not in plane_caption(unknown(replace(details["dc"], standstill_torque=0.8), "motor_torque"))


def test_the_torque_panel_of_a_move_says_which_torque_it_shows(own: Catalogue) -> None:
    line = {"start": (0.5, 0.5, -0.5), "stop": (2.5, 0.5, -0.5)}
    names = {}
    for model in ("pseudo_inverse", "force_only"):
        run = simulate(load_study("cpr8", {"tension.model": model}), own, "dc", **line)
        names[model] = " ".join(simulation_figure(run).axes[1].get_ylabel().split())
    assert names == {"pseudo_inverse": "load torque [N m]", "force_only": "torque, load and rotor [N m]"}
