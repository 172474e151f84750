"""What users do: evaluate, rank and simulate actuators, and check the catalogue's figures."""

from actuator_select.model.exceedance import Exceedance
from actuator_select.selection.catalogue_check import CatalogueCheck, review_catalogue
from actuator_select.selection.cautions import Warned
from actuator_select.selection.elastic import ElasticLengths, elastic_lengths
from actuator_select.selection.plausibility import Finding, check_rows
from actuator_select.selection.records import selection_record
from actuator_select.selection.results import CheckVerdict, RankedActuator, Selection, StudyEvaluation
from actuator_select.selection.robot_sheet import RobotSheet, robot_sheet
from actuator_select.selection.selection import evaluate, rank
from actuator_select.selection.simulation import Simulation, simulate
from actuator_select.selection.support_intervals import RopeTensions, rope_tensions
from actuator_select.selection.sweeps import Sweep, sweep_workspace
from actuator_select.selection.workspaces import WorkspaceResult, evaluate_workspace, workspace_record

__all__ = [
    "CatalogueCheck",
    "CheckVerdict",
    "ElasticLengths",
    "Exceedance",
    "Finding",
    "RankedActuator",
    "RobotSheet",
    "RopeTensions",
    "Selection",
    "Simulation",
    "StudyEvaluation",
    "Sweep",
    "Warned",
    "WorkspaceResult",
    "check_rows",
    "elastic_lengths",
    "evaluate",
    "evaluate_workspace",
    "rank",
    "review_catalogue",
    "robot_sheet",
    "rope_tensions",
    "selection_record",
    "simulate",
    "sweep_workspace",
    "workspace_record",
]
