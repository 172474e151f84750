"""Which positions of a study count, which have to be served, and how many the exact test adds."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.actuation import ROUNDING, Check, is_applicable, torque_line, voltage_line
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, Progress, compute_demand
from actuator_select.model.evaluation import Evaluation, position_utilisation
from actuator_select.model.grid_measure import connected_positions
from actuator_select.model.joint import DriveLines, can_be_tested, exact_positions
from actuator_select.model.kinematics import too_near
from actuator_select.study import Study

EXACT = 8  # best actuators that the exact joint test is made for
CORNERS = np.array(np.meshgrid([0, 1], [0, 1], [0, 1], indexing="ij")).reshape(3, -1).T


def counted_positions(study: Study) -> IntArray:
    """Indices of the positions that count: all but those nearer to an anchor than `cables.length_min_m`.

    Raises
    ------
    InvalidInput
        If none is left.
    """
    counted = np.flatnonzero(~too_near(study.robot, study.positions, study.orientations))
    if not len(counted):
        problem = Problem(
            place="cables.length_min_m",
            value="every position of the workspace is nearer to an anchor",
            expected="a length that some positions keep [m]",
        )
        raise InvalidInput("no position is left to serve", [problem])
    return counted


def study_demand(study: Study, positions: FloatArray | None = None, progress: Progress | None = None) -> Demand:
    """What a study asks, whatever drives the robot; at its own positions unless others are given, (P, 3). [m]"""
    return compute_demand(
        study.robot,
        study.positions if positions is None else positions,
        study.orientations,
        study.wrenches,
        study.motion,
        tension_model=study.tension_model,
        progress=progress,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class MissedPlaces:
    """Places of `requirement.must_serve` that one actuator does not serve.

    Attributes
    ----------
    served : bool or None
        Whether it serves all of them; None where an unknown figure leaves it open.
    titles : tuple of str
        Of those that it does not serve, or is not known to.
    for_any_drive : tuple of str
        Of those that no drive could serve.
    """

    served: bool | None
    titles: tuple[str, ...]
    for_any_drive: tuple[str, ...] = ()


def missed_places(study: Study, actuators: ActuatorSet) -> list[MissedPlaces]:
    """Hold every actuator against the places that have to be served.

    Parameters
    ----------
    study : Study
        With `requirement.must_serve`.
    actuators : ActuatorSet
        C actuators.

    Returns
    -------
    list of MissedPlaces
        One per actuator. A box is served if its corners, its centre and the grid positions inside it are.
    """
    places = study.table.requirement.must_serve
    if not places:
        return [MissedPlaces(served=True, titles=())] * len(actuators)
    served = np.ones((len(actuators), len(places)), dtype=np.bool_)
    known = served.copy()
    attainable: list[bool] = []
    for index, place in enumerate(places):
        positions = (
            np.array([place.position_m])
            if place.position_m is not None
            else _inside(study, np.array(place.box_m, dtype=np.float64))
        )
        demand = study_demand(study, positions)
        utilisation = np.stack(list(position_utilisation(demand, actuators, study.checks).values()))
        unknown = np.isnan(utilisation) & np.stack([is_applicable(actuators, one) for one in study.checks])[:, :, None]
        served[:, index] = (np.nan_to_num(utilisation) <= 1.0 + ROUNDING).all(axis=(0, 2))
        attainable.append(bool(demand.attainable_positions.all()))
        served[:, index] &= attainable[-1]
        known[:, index] = ~unknown.any(axis=(0, 2))
    titles = [place.title or f"place {number}" for number, place in enumerate(places, start=1)]
    beyond = tuple(title for title, holds in zip(titles, attainable, strict=True) if not holds)
    return [
        MissedPlaces(
            served=False if not one.all() else None if not sure.all() else True,
            titles=tuple(
                title for title, holds, certain in zip(titles, one, sure, strict=True) if not holds or not certain
            ),
            for_any_drive=beyond,
        )
        for one, sure in zip(served, known, strict=True)
    ]


def _inside(study: Study, box: FloatArray) -> FloatArray:
    grid = study.positions
    inside = ((grid >= box[:, 0]) & (grid <= box[:, 1])).all(axis=1)
    corners = np.where(CORNERS, box[:, 1], box[:, 0])
    return np.vstack([corners, box.mean(axis=1), grid[inside]])


def position_verdicts(evaluation: Evaluation, index: int, checks: Iterable[Check]) -> BoolArray:
    """Where every evaluated check of one actuator holds and some drive could serve, of the positions that count."""
    known = [check for check in checks if evaluation.checks[check].evaluated[index]]
    used = position_utilisation(evaluation.demand, evaluation.actuators.take([index]), known)
    holds = [values[0] <= 1.0 + ROUNDING for values in used.values()]
    return np.asarray(np.logical_and.reduce([evaluation.demand.attainable_positions, *holds]), dtype=np.bool_)


def connected_share(study: Study, feasible: BoolArray) -> float | None:
    """Share of feasible positions of the grid, (P,), that is connected to the home position; None without one. [%]"""
    table = study.table.workspace
    if table.home_m is None:
        return None
    total = int(feasible.sum())
    if not total:
        return 0.0
    home = int(((study.positions - np.array(table.home_m)) ** 2).sum(axis=1).argmin())
    return 100.0 * connected_positions(feasible, table.points, home) / total


def connected_percents(
    study: Study, evaluation: Evaluation, counted: IntArray, indices: Iterable[int]
) -> dict[int, float]:
    """Share of an actuator's feasible positions that is connected to the home position, for a few. [%]

    Parameters
    ----------
    study : Study
        With or without `workspace.home_m`.
    evaluation : Evaluation
        At the positions that count.
    counted : (n,) array
        Their indices.
    indices : iterable of int
        Actuators.

    Returns
    -------
    dict of int to float
        Empty without a home position; without the actuators whose positions are not known, because a figure is missing.
    """
    if study.table.workspace.home_m is None:
        return {}
    shares = {}
    for index in indices:
        if not evaluation.decided[index]:
            continue
        feasible = np.zeros(len(study.positions), dtype=np.bool_)
        feasible[counted] = position_verdicts(evaluation, int(index), study.checks)
        if (share := connected_share(study, feasible)) is not None:
            shares[int(index)] = share
    return shares


def exact_counts(study: Study, evaluation: Evaluation, indices: Iterable[int]) -> dict[int, int]:
    """Positions by the exact joint test, for the few actuators whose limits are known and the test can decide.

    Parameters
    ----------
    study : Study
        What was asked.
    evaluation : Evaluation
        By the safe rule.
    indices : iterable of int
        Actuators.

    Returns
    -------
    dict of int to int
        Actuator to positions.
    """
    demand = evaluation.demand
    if not can_be_tested(study.robot, study.motion, study.tension_model):
        return {}
    counts = {}
    for index in indices:
        if not evaluation.decided[index]:
            continue
        actuator = evaluation.actuators.take([int(index)])
        checks = [check for check in study.checks if evaluation.checks[check].evaluated[index]]
        used = position_utilisation(demand, actuator, checks)
        holds = {check: values[0] <= 1.0 + ROUNDING for check, values in used.items()}
        attainable = demand.attainable_positions
        safe = np.logical_and.reduce([attainable, *holds.values()])
        alone = [holds[check] for check in (Check.SPEED, Check.TORQUE) if check in holds]
        exact = exact_positions(
            study.robot,
            demand,
            study.wrenches,
            drive_lines(actuator, checks),
            safe=safe,
            possible=np.logical_and.reduce([attainable, *alone]),
        )
        if exact is not None:
            counts[int(index)] = int(exact.sum())
    return counts


def drive_lines(actuator: ActuatorSet, checks: Iterable[Check]) -> DriveLines:
    """Lines of a single drive that the checks ask for; torque without the rotor unless acceleration is tested."""
    applied = set(checks)
    torque = torque_line(actuator) if applied & {Check.TORQUE, Check.ACCELERATION} else None
    lines = DriveLines.of(torque, voltage_line(actuator) if Check.VOLTAGE in applied else None)
    return lines if Check.ACCELERATION in applied else lines.without_rotor_torque()
