"""The same study under every tension model, at rest and in motion: what an answer owes to its model."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from actuator_select.model.actuation import Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.evaluation import evaluate_actuators
from actuator_select.model.tension import TensionModel
from actuator_select.selection.places import counted_positions, exact_counts, study_demand
from actuator_select.study import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelCount:
    """Positions under one tension model.

    Attributes
    ----------
    model : TensionModel
        How the cables share the load.
    moving : bool
        Over the study's motion set; else at rest.
    attainable : int
        Positions that a drive without limits could serve.
    by_torque : tuple of int
        Per actuator, positions at which its torque alone suffices; -1 where a figure is unknown.
    feasible : tuple of int
        Per actuator, positions at which all of the study's checks hold; -1 where an applicable one was not evaluated.
    exact : tuple of int or None
        The same by the exact joint test, where it was made.
    """

    model: TensionModel
    moving: bool
    attainable: int
    by_torque: tuple[int, ...]
    feasible: tuple[int, ...]
    exact: tuple[int | None, ...]


def compare_models(study: Study, actuators: ActuatorSet) -> tuple[ModelCount, ...]:
    """Count the positions under every tension model that the study can be put to.

    Parameters
    ----------
    study : Study
        Its own model is among them.
    actuators : ActuatorSet
        The few that are compared.

    Returns
    -------
    tuple of ModelCount
        For every model at rest and in motion.
    """
    return tuple(
        _count(replace(study, tension_model=model, motion=motion), actuators, moving=moving)
        for model in models_of(study)
        for moving, motion in ((False, study.motion.at_rest()), (True, study.motion))
        if moving is False or study.motion.kind is not motion.at_rest().kind
    )


def models_of(study: Study) -> Sequence[TensionModel]:
    """Tension models that a study can be put to; the pseudo-inverse cannot set a counterbalance's tension."""
    controlled = any(rope.is_controlled for rope in study.robot.counterbalances)
    return [model for model in TensionModel if not (controlled and model.lets_cables_push)]


def _count(study: Study, actuators: ActuatorSet, *, moving: bool) -> ModelCount:
    demand = study_demand(study, study.positions[counted_positions(study)])
    attainable = int(demand.attainable_positions.sum())
    if not len(actuators):
        return ModelCount(
            model=study.tension_model, moving=moving, attainable=attainable, by_torque=(), feasible=(), exact=()
        )
    torque = evaluate_actuators(demand, actuators, [Check.TORQUE])
    known = torque.checks[Check.TORQUE].evaluated
    evaluation = evaluate_actuators(demand, actuators, study.checks)
    exact = exact_counts(study, evaluation, range(len(actuators)))
    return ModelCount(
        model=study.tension_model,
        moving=moving,
        attainable=attainable,
        by_torque=tuple(np.where(known, torque.positions, -1).tolist()),
        feasible=tuple(np.where(evaluation.decided, evaluation.positions, -1).tolist()),
        exact=tuple(exact.get(index) for index in range(len(actuators))),
    )
