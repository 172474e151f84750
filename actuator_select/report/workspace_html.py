"""A robot and where it can work, as one self-contained HTML page; no actuators are needed."""

from typing import Any

import numpy as np

from actuator_select.model.demand import Progress
from actuator_select.report.html import (
    ReportDetails,
    environment,
    image,
    library_versions,
    margin_words,
    sweep_pictures,
)
from actuator_select.report.margin_figures import margin_slices, tension_slices, value_slices
from actuator_select.report.robot_figure import robot_figure
from actuator_select.report.robot_workspace import workspace_map
from actuator_select.report.workspace_panels import workspace_panels
from actuator_select.selection import wording
from actuator_select.selection.robot_record import DISTRIBUTION, robot_items
from actuator_select.selection.workspace_dossier import WorkspaceDossier, build_workspace_dossier
from actuator_select.selection.workspaces import workspace_basis, workspace_words
from actuator_select.study import Study


def render_workspace_report(
    study: Study, details: ReportDetails | None = None, progress: Progress | None = None
) -> str:
    """Render the report on a robot's workspace.

    Parameters
    ----------
    study : Study
        With its variants, sweeps and notes.
    details : ReportDetails, optional
        Title block, date and command; the present time alone by default.
    progress : callable, optional
        Called with (sweep points done, sweep points).

    Returns
    -------
    str
        HTML without references to other files or to the network.
    """
    dossier = build_workspace_dossier(study, progress)
    return (
        environment()
        .get_template("workspace.html")
        .render(
            dossier=dossier,
            study=study,
            sheet=dossier.sheet,
            own=dossier.own,
            items=robot_items(dossier.sheet),
            basis=workspace_basis(dossier.own),
            distribution=DISTRIBUTION[study.tension_model],
            details=ReportDetails() if details is None else details,
            words=wording,
            describe=workspace_words,
            warnings=_warnings(dossier),
            margin_note=margin_words(study),
            images=_images(dossier),
            sweeps=sweep_pictures(dossier.sweeps),
            versions=library_versions(),
        )
    )


def _warnings(dossier: WorkspaceDossier) -> list[str]:
    """Of the workspace and of the robot, each once; the longer of two that begin alike."""
    every = list(dict.fromkeys([*dossier.own.warnings, *(warning.text for warning in dossier.sheet.warnings)]))
    return [text for text in every if not any(one != text and one.startswith(text.rstrip(".")) for one in every)]


def _images(dossier: WorkspaceDossier) -> dict[str, Any]:
    study = dossier.study
    alike = [
        (f"{one.title}: {result.feasible_poses} of {result.poses}", result.feasible)
        for one, result in dossier.variants
        if len(result.feasible) == len(study.positions)
    ]
    return {
        "robot": image(robot_figure(study), "png"),
        "map": image(workspace_map(dossier.own), "png"),
        "margin": image(margin_slices(study, np.where(dossier.own.apart, np.nan, dossier.own.margin)), "svg")
        if np.isfinite(dossier.own.margin).any()
        else None,
        "tension": image(tension_slices(study, dossier.tension), "svg")
        if dossier.tension is not None and np.isfinite(dossier.tension).any()
        else None,
        "variants": image(workspace_panels(study, alike, apart=dossier.own.apart, served="feasible"), "png")
        if alike
        else None,
        "interval": [
            image(value_slices(study, values, label), "svg")
            for values, label in (
                # A rope pulls; below zero the interval is of no use to anybody.
                (np.maximum(dossier.interval.lower, 0.0), "least tension of the rope [N]"),
                (dossier.interval.upper, "greatest tension of the rope [N]"),
            )
        ]
        if dossier.interval is not None
        else [],
    }
