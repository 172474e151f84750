"""A selection as one self-contained HTML page."""

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from importlib.metadata import version
from typing import Any

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup
from matplotlib.figure import Figure

from actuator_select.database import Catalogue
from actuator_select.model.ranking import State, Verdict
from actuator_select.model.tension import TensionModel
from actuator_select.report.drive_figures import plane_caption, simulation_figure, torque_speed_plane
from actuator_select.report.margin_figures import margin_slices, tension_slices
from actuator_select.report.robot_figure import robot_figure
from actuator_select.report.style import data_uri
from actuator_select.report.sweep_figures import sweep_figure
from actuator_select.report.workspace_figures import share_bars, slice_panels
from actuator_select.report.workspace_panels import workspace_panels
from actuator_select.selection import RankedActuator, Selection, move_wording, part_wording, wording
from actuator_select.selection.dossier import Dossier, build_dossier
from actuator_select.selection.plausibility import figure as four_digits
from actuator_select.selection.sweeps import Sweep
from actuator_select.selection.workspace_dossier import study_sweeps
from actuator_select.selection.workspaces import reasons_why_nothing_holds
from actuator_select.study import Study

SHORTLIST = 3
LARGEST_FORCE = 1e7  # N; figures from here on, such as of singular poses, are written with an exponent
PLANES = 3  # actuators whose torque-speed plane and slices are drawn
MANY_SWEEPS = 4  # more are drawn half as wide, two beside each other
LIBRARIES = ("numpy", "scipy", "sqlalchemy", "pandas", "matplotlib")


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportDetails:
    """What a report says about itself.

    Attributes
    ----------
    generated_at : datetime
        Printed as the report's date.
    project, author, revision : str
        Title block; left out where empty.
    command : str
        Command line that makes the report again.
    """

    generated_at: datetime = field(default_factory=lambda: datetime.now().astimezone())
    project: str = ""
    author: str = ""
    revision: str = ""
    command: str = ""


def render_report(selection: Selection, catalogue: Catalogue, details: ReportDetails | None = None) -> str:
    """Render the design report.

    Parameters
    ----------
    selection : Selection
        The ranking to report.
    catalogue : Catalogue
        Where its actuators came from; names the sources.
    details : ReportDetails, optional
        Title block, date and command; the present time alone by default.

    Returns
    -------
    str
        HTML without references to other files or to the network; everything that comes from the catalogue or the
        study is escaped.

    Examples
    --------
    >>> with open_catalogue() as catalogue:
    ...     selection = rank(load_study("cpr8"), catalogue)
    ...     page = render_report(selection, catalogue, ReportDetails(generated_at=datetime.now()))
    >>> page[:15]
    '<!doctype html>'
    """
    dossier = build_dossier(selection, catalogue)
    return (
        environment()
        .get_template("report.html")
        .render(
            dossier=dossier,
            selection=selection,
            study=selection.study,
            details=ReportDetails() if details is None else details,
            words=wording,
            moves=move_wording,
            shortlist=shortlist(selection),
            pushing=_pushing(selection),
            assumed=wording.assumption_notes(dossier.shown),
            left_out=part_wording.left_out_note(dossier.shown),
            exceeded=part_wording.exceeded_notes(dossier.shown),
            unchecked=wording.unchecked_limits(
                [selection.result.candidates.rows[actuator.index] for actuator in dossier.shown]
            ),
            compared=_compared(selection),
            detailed=best_words(len(dossier.details), len(selection.ranked)),
            drawn=best_words(min(PLANES, len(dossier.details)), len(selection.ranked)),
            reasons=reasons_why_nothing_holds(selection.study, selection.attainable_poses),
            apart=len(selection.study.positions) - selection.poses,
            margin_note=margin_words(selection.study),
            State=State,
            Verdict=Verdict,
            images=_images(dossier),
            sweeps=sweep_pictures(study_sweeps(selection.study)),
            versions=library_versions(),
            sources=_sources(dossier),
        )
    )


def environment() -> Environment:
    """Templates of all reports; everything that they fill in is escaped."""
    templates = Environment(
        loader=PackageLoader("actuator_select.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters["figure"] = _figure_value
    templates.filters["digits"] = _digits
    templates.filters["plain_zero"] = _plain_zero
    templates.filters["unit"] = lambda unit: str(unit).replace("2", "²").replace("3", "³")
    return templates


def sweep_pictures(sweeps: Sequence[tuple[str, str, Sweep]]) -> list[tuple[str, str, Markup]]:
    """Title, note and picture of every sweep."""
    compact = len(sweeps) > MANY_SWEEPS
    return [(title, note, image(sweep_figure(result, compact=compact), "svg")) for title, note, result in sweeps]


def margin_words(study: Study) -> str:
    """What a margin is, as the study's tension model and freedom have it."""
    text = (
        "Margin: the least distance, in newtons, from what is asked to the border of what tensions within their bounds "
        "can exert; zero where it can just be held, negative where it cannot."
    )
    if study.tension_model is TensionModel.FORCE_ONLY or study.robot.degrees_of_freedom == len(study.robot.free_axes):
        return f"{text} Forces only."
    return (
        f"{text} Moments are divided by the robot's characteristic length, {study.robot.characteristic_length:.4g} m."
    )


def _digits(value: float) -> str:
    """Four significant digits, without an exponent in the range of forces."""
    return four_digits(value) if abs(value) < LARGEST_FORCE else f"{value:.4g}"


def _plain_zero(value: float) -> str:
    """A length to a tenth of a millimetre; never a zero with a sign."""
    return f"{round(value, 4) + 0.0:.4f}"


def best_words(some: int, total: int) -> str:
    """Which actuators are shown, where not all of them are; else empty."""
    if some >= total:
        return ""
    return f"Shown: the best {some if some > 1 else 'one'} of {total} actuators."


def _pushing(selection: Selection) -> int:
    """Positions where a cable has to push at rest."""
    return sum(warning.poses for warning in selection.warnings if warning.code == "negative_tension_at_rest")


def shortlist(selection: Selection) -> tuple[RankedActuator, ...]:
    """Actuators that meet the requirement; where none does, the best that there are."""
    meeting = tuple(actuator for actuator in selection.ranked if actuator.verdict is Verdict.MEETS)
    return (meeting or selection.ranked)[:SHORTLIST]


def _compared(selection: Selection) -> tuple[RankedActuator, ...]:
    """Actuators that the study gives published percentages of, in its order."""
    published = selection.study.table.published
    ranked = {actuator.id: actuator for actuator in selection.ranked}
    return tuple(ranked[one] for one in (published.feasible_percent if published else ()) if one in ranked)


def _images(dossier: Dossier) -> dict[str, Any]:
    study = dossier.selection.study
    leading = dossier.details[0]
    apart = dossier.selection.result.spread(np.zeros(dossier.selection.poses), 1.0) > 0.0
    panels = [
        (f"{detail.actuator.name}: {wording.share(detail.actuator, dossier.selection.poses)}", detail.feasible)
        for detail in dossier.details
    ]
    turned = [
        (result.variant.title, result.feasible)
        for result in dossier.variants
        if "workspace.orientations_rad" in result.variant.keys and len(result.feasible) == len(study.positions)
    ]
    return {
        "robot": image(robot_figure(study), "png"),
        **_holding_images(dossier),
        "bars": image(share_bars(dossier.selection, [detail.actuator for detail in dossier.details]), "svg"),
        "workspaces": image(workspace_panels(study, panels, leading.attainable, apart=apart), "png"),
        "variants": image(workspace_panels(study, turned, apart=apart), "png") if turned else None,
        "slices": [
            (detail, image(slice_panels(study, detail), "svg")) for detail in dossier.details[:PLANES] if detail.checks
        ],
        "planes": [
            (detail, image(torque_speed_plane(detail), "svg"), plane_caption(detail))
            for detail in dossier.details[:PLANES]
        ],
        "moves": [image(simulation_figure(run), "svg") for _, run in dossier.moves],
        "leading": leading.actuator.name,
    }


def _holding_images(dossier: Dossier) -> dict[str, Any]:
    """What it takes to hold the platform, whatever drives it; nothing under a model that lets cables push."""
    result = dossier.selection.result
    demand = result.evaluation.demand
    if demand.tensions is not None or not demand.attainable.any():
        return {"margin": None, "tension": None}
    tension = result.spread(demand.by_position(demand.force).max(axis=1))
    margin = result.spread(demand.by_position(demand.margin).min(axis=1))
    return {
        "margin": image(margin_slices(result.study, margin), "svg"),
        "tension": image(tension_slices(result.study, tension), "svg"),
    }


def image(figure: Figure, image_format: str) -> Markup:
    """Picture that stands in a page by itself."""
    return Markup(data_uri(figure, image_format))  # noqa: S704 - base64 of our own picture


def library_versions() -> dict[str, str]:
    """What a report was made with."""
    return {
        "actuator-select": version("actuator-select"),
        "Python": platform.python_version(),
        **{name: version(name) for name in LIBRARIES},
    }


def _sources(dossier: Dossier) -> list[Mapping[str, Any]]:
    """Documents behind the parts, each once."""
    return list({str(part.source["id"]): part.source for part in dossier.parts}.values())


def _figure_value(value: object) -> str:
    """A catalogue figure as people write it."""
    if isinstance(value, float):
        return "unlimited" if value == float("inf") else f"{value:.10g}"
    return str(value)
