"""All that a report on a robot shows, without any actuator: where it can work, and what that depends on."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Progress
from actuator_select.model.support_interval import SupportInterval, support_interval
from actuator_select.model.tension import balanced_rows
from actuator_select.model.workspace import OrientationRule, WorkspaceKind
from actuator_select.selection.models import ModelCount, compare_models
from actuator_select.selection.places import counted_positions, study_demand
from actuator_select.selection.robot_sheet import RobotSheet, robot_sheet
from actuator_select.selection.sweeps import Sweep, sweep_built
from actuator_select.selection.workspaces import WorkspaceResult, evaluate_workspace
from actuator_select.study import Study, Variant
from actuator_select.study.loading import text_builder
from actuator_select.study.sweeping import parse_sweep


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkspaceDossier:
    """A study's robot and where it can work.

    Attributes
    ----------
    study : Study
        What was asked.
    sheet : RobotSheet
        Anchors, lengths, tensions.
    own : WorkspaceResult
        The workspace that the study asks for: dynamic-feasible, at every orientation.
    kinds : tuple of WorkspaceResult
        Other kinds of workspace.
    over : tuple of WorkspaceResult
        At the first, at some and at every orientation; empty where there is only one.
    models : tuple of ModelCount
        Under every tension model.
    tension : (P,) array or None
        Minimax tension, infinite where infeasible, NaN at positions set apart; None under the pseudo-inverse. [N]
    variants : tuple of (Variant, WorkspaceResult)
        In the study's order.
    sweeps : tuple of (str, str, Sweep)
        Title, note and counts of the study's sweeps.
    interval : SupportInterval or None
        Feasible tensions of the counterbalance, where there is exactly one.
    """

    study: Study
    sheet: RobotSheet
    own: WorkspaceResult
    kinds: tuple[WorkspaceResult, ...]
    over: tuple[WorkspaceResult, ...]
    models: tuple[ModelCount, ...]
    tension: FloatArray | None
    variants: tuple[tuple[Variant, WorkspaceResult], ...]
    sweeps: tuple[tuple[str, str, Sweep], ...]
    interval: SupportInterval | None


def build_workspace_dossier(study: Study, progress: Progress | None = None) -> WorkspaceDossier:
    """Work out what a report on the robot shows.

    Parameters
    ----------
    study : Study
        With its variants and sweeps.
    progress : callable, optional
        Called with (sweep points done, sweep points).

    Returns
    -------
    WorkspaceDossier
        Needs no catalogue.
    """
    own = evaluate_workspace(study)
    return WorkspaceDossier(
        study=study,
        sheet=robot_sheet(study),
        own=own,
        kinds=_kinds(study, own),
        over=tuple(evaluate_workspace(study, over=rule) for rule in OrientationRule if len(study.orientations) > 1),
        models=compare_models(study, ActuatorSet.from_figures([])),
        tension=minimax_tension(study),
        variants=tuple((one, evaluate_workspace(one.study)) for one in study.variants),
        sweeps=study_sweeps(study, progress),
        interval=_interval(study),
    )


def study_sweeps(study: Study, progress: Progress | None = None) -> tuple[tuple[str, str, Sweep], ...]:
    """Title, note and counts of the sweeps that a study asks of its report."""
    return tuple(
        (
            one.title,
            one.note,
            sweep_built(
                text_builder(study.text, study.place, one.set, limit=False), parse_sweep(one.keys), progress=progress
            ),
        )
        for one in study.table.sweep
    )


def _kinds(study: Study, own: WorkspaceResult) -> tuple[WorkspaceResult, ...]:
    bounded_speed = bool(np.isfinite(study.robot.bounds.speed_max).any())
    asked = [kind for kind in WorkspaceKind if kind is not WorkspaceKind.TWIST or bounded_speed]
    return tuple(own if kind is own.kind else evaluate_workspace(study, kind=kind, explain=False) for kind in asked)


def minimax_tension(study: Study) -> FloatArray | None:
    """Minimax tension at every position, in its hardest case, (P,); None under the pseudo-inverse. [N]"""
    if study.tension_model.lets_cables_push:
        return None
    counted = counted_positions(study)
    demand = study_demand(study, study.positions[counted])
    result = np.full(len(study.positions), np.nan)
    result[counted] = demand.by_position(demand.force).max(axis=1)
    return result


def _interval(study: Study) -> SupportInterval | None:
    if len(study.robot.counterbalances) != 1 or study.tension_model.lets_cables_push:
        return None
    rows = balanced_rows(study.robot, study.tension_model)
    return support_interval(study.robot, study.positions, study.orientations, study.wrenches, study.motion, rows=rows)
