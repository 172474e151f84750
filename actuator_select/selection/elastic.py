"""Elastic cables: how much rope has to be let out at every pose of a study at rest."""

from dataclasses import dataclass

import numpy as np

from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.redundancy_one import (
    interval_at_rest,
    stiffest_tensions,
    tensions_for_unstretched_lengths,
    unstretched_lengths,
)
from actuator_select.study import Study


@dataclass(frozen=True, slots=True, kw_only=True)
class ElasticLengths:
    """Cables of Q poses, loads varying fastest, then orientations, then positions.

    Attributes
    ----------
    lengths : (Q, m) array
        Stretched. [m]
    tensions : (Q, m) array
        Stiffest within the bounds; NaN where the pose is infeasible. [N]
    unstretched : (Q, m) array
        Lengths without tension; NaN where the pose is infeasible. [m]
    feasible : (Q,) array of bool
        Whether tensions within their bounds hold the load with unstretched lengths within theirs.
    """

    lengths: FloatArray
    tensions: FloatArray
    unstretched: FloatArray
    feasible: BoolArray


def elastic_lengths(
    study: Study, least: float | FloatArray = 0.0, greatest: float | FloatArray = np.inf
) -> ElasticLengths:
    """Unstretched lengths of a study at rest, its cables as stiff as their bounds let them be.

    Parameters
    ----------
    study : Study
        Of a robot with one cable more than degrees of freedom, ``cables.axial_stiffness_n`` given; without it the
        cables do not stretch. Counterbalances have constant tensions.
    least, greatest : float or (m,) array
        Bounds of the unstretched lengths. [m]

    Returns
    -------
    ElasticLengths
        At every pose, motion left out.

    Raises
    ------
    InvalidInput
        If the robot has another redundancy, or a counterbalance of controlled tension.

    References
    ----------
    Eqs. 21 and 22 in Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387.
    """
    robot = study.robot
    _refuse_other_robots(study)
    count = len(study.orientations) * len(study.loads)
    positions = np.repeat(study.positions, count, axis=0)
    orientations = np.tile(np.repeat(study.orientations, len(study.loads), axis=0), (len(study.positions), 1))
    wrenches = [wrench for loads in study.wrenches for wrench in loads] * len(study.positions)
    lengths = cable_geometry(robot, positions, orientations).lengths
    stiffness = robot.bounds.axial_stiffness
    ends = [np.broadcast_to(np.asarray(end, dtype=np.float64), (robot.cables,)) for end in (least, greatest)]
    lower, upper = tensions_for_unstretched_lengths(lengths, stiffness, *ends)
    bounds = np.maximum(lower, robot.bounds.tension_min), np.minimum(upper, robot.bounds.tension_max)
    interval = interval_at_rest(robot, positions, orientations, wrenches, bounds)
    tensions = stiffest_tensions(interval)
    return ElasticLengths(
        lengths=lengths,
        tensions=tensions,
        unstretched=unstretched_lengths(lengths, tensions, stiffness),
        feasible=interval.feasible,
    )


def _refuse_other_robots(study: Study) -> None:
    robot = study.robot
    problems = []
    if robot.redundancy != 1:
        problems.append(
            Problem(
                place="robot",
                value=f"{robot.cables} cables and {robot.degrees_of_freedom} degrees of freedom",
                expected="one cable more than degrees of freedom, so that the tensions lie on a line",
            )
        )
    if any(one.is_controlled for one in robot.counterbalances):
        problems.append(
            Problem(
                place="robot",
                value="a counterbalance of controlled tension",
                expected="a counterbalance of constant tension [N]",
                remedy="state one tension of the range",
            )
        )
    if problems:
        raise InvalidInput(f"no unstretched lengths for the study {study.name!r}", problems)
