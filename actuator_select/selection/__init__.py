"""What users do: evaluate, rank and simulate actuators, and check the catalogue's figures."""

from actuator_select.model.exceedance import Exceedance
from actuator_select.selection.cautions import Warned
from actuator_select.selection.plausibility import Finding, check_catalogue, check_rows
from actuator_select.selection.records import selection_record
from actuator_select.selection.selection import (
    CheckVerdict,
    RankedActuator,
    Selection,
    StudyEvaluation,
    evaluate,
    rank,
)
from actuator_select.selection.simulation import Simulation, simulate
from actuator_select.selection.sweeps import Sweep, sweep_workspace
from actuator_select.selection.workspaces import WorkspaceResult, evaluate_workspace, workspace_record

__all__ = [
    "CheckVerdict",
    "Exceedance",
    "Finding",
    "RankedActuator",
    "Selection",
    "Simulation",
    "StudyEvaluation",
    "Sweep",
    "Warned",
    "WorkspaceResult",
    "check_catalogue",
    "check_rows",
    "evaluate",
    "evaluate_workspace",
    "rank",
    "selection_record",
    "simulate",
    "sweep_workspace",
    "workspace_record",
]
