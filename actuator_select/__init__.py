"""Rank motors, gearboxes and winches for cable-driven robots by the share of the workspace that they can serve.

The commands of ``actuator-select`` use these functions and nothing more:

>>> from datetime import datetime
>>> from actuator_select import ReportDetails, load_study, open_catalogue, rank, render_report, simulate
>>> study = load_study("cpr8")
>>> with open_catalogue() as catalogue:
...     selection = rank(study, catalogue)
...     page = render_report(selection, catalogue, ReportDetails(generated_at=datetime.now()))
>>> table = selection.frame()                              # a DataFrame
>>> force = selection.result.evaluation.demand.force      # an array, poses × cables [N]
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from actuator_select._version import __version__

if TYPE_CHECKING:
    from actuator_select.database import Catalogue, open_catalogue
    from actuator_select.errors import ActuatorSelectError
    from actuator_select.model.workspace import WorkspaceKind
    from actuator_select.report import ReportDetails, render_report, render_workspace_report
    from actuator_select.selection import (
        Selection,
        Simulation,
        StudyEvaluation,
        WorkspaceResult,
        elastic_lengths,
        evaluate,
        evaluate_workspace,
        rank,
        robot_sheet,
        rope_tensions,
        simulate,
        sweep_workspace,
    )
    from actuator_select.study import Study, SweepAxis, load_study

__all__ = [
    "ActuatorSelectError",
    "Catalogue",
    "ReportDetails",
    "Selection",
    "Simulation",
    "Study",
    "StudyEvaluation",
    "SweepAxis",
    "WorkspaceKind",
    "WorkspaceResult",
    "__version__",
    "elastic_lengths",
    "evaluate",
    "evaluate_workspace",
    "load_study",
    "open_catalogue",
    "rank",
    "render_report",
    "render_workspace_report",
    "robot_sheet",
    "rope_tensions",
    "simulate",
    "sweep_workspace",
]

_HOMES = {
    "ActuatorSelectError": "errors",
    "Catalogue": "database",
    "ReportDetails": "report",
    "Selection": "selection",
    "Simulation": "selection",
    "Study": "study",
    "StudyEvaluation": "selection",
    "SweepAxis": "study",
    "WorkspaceKind": "model.workspace",
    "WorkspaceResult": "selection",
    "elastic_lengths": "selection",
    "evaluate": "selection",
    "evaluate_workspace": "selection",
    "load_study": "study",
    "open_catalogue": "database",
    "rank": "selection",
    "render_report": "report",
    "render_workspace_report": "report",
    "robot_sheet": "selection",
    "rope_tensions": "selection",
    "simulate": "selection",
    "sweep_workspace": "selection",
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - any public name
    """Import a public name when it is first used, so that ``actuator-select --help`` answers at once."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
