"""The use case: a study and a catalogue become ranked actuators with their verdicts, and what to mind about them."""

from collections.abc import Sequence

from actuator_select.database import Catalogue
from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.actuation import Check
from actuator_select.model.demand import Progress
from actuator_select.model.evaluation import evaluate_actuators
from actuator_select.model.ranking import State, meets_share, ranking_order, verdicts
from actuator_select.selection.assumptions import assumption_keys, why_no_voltage
from actuator_select.selection.candidates import Candidates, find_candidates
from actuator_select.selection.cautions import demand_warnings
from actuator_select.selection.part_limits import exceeded_part_limits
from actuator_select.selection.places import (
    EXACT,
    MissedPlaces,
    connected_percents,
    counted_positions,
    exact_counts,
    missed_places,
    study_demand,
)
from actuator_select.selection.results import CheckVerdict, RankedActuator, Selection, StudyEvaluation
from actuator_select.study import Study


def evaluate(
    study: Study, catalogue: Catalogue, *, where: str = "", progress: Progress | None = None
) -> StudyEvaluation:
    """Hold the catalogue's actuators against a study.

    Parameters
    ----------
    study : Study
        Robot, motion and checks.
    catalogue : Catalogue
        Where the candidates are.
    where : str, optional
        Condition on the candidates, beside the study's own.
    progress : callable, optional
        Called with (work done, work).

    Returns
    -------
    StudyEvaluation
        Arrays, and a DataFrame by ``.frame()``.

    Raises
    ------
    NoCandidates
        If no actuator is left.

    Examples
    --------
    >>> with open_catalogue() as catalogue:
    ...     result = evaluate(load_study("cpr8"), catalogue)
    >>> result.evaluation.demand.force.shape  # worst cable force, poses × cables
    (216, 8)
    """
    return evaluate_candidates(study, find_candidates(study, catalogue, where), progress)


def evaluate_candidates(study: Study, candidates: Candidates, progress: Progress | None = None) -> StudyEvaluation:
    """As `evaluate`, for candidates at hand."""
    counted = counted_positions(study)
    demand = study_demand(study, study.positions[counted], progress)
    evaluation = evaluate_actuators(demand, candidates.actuators, study.checks, progress)
    return StudyEvaluation(study=study, candidates=candidates, evaluation=evaluation, counted=counted)


def rank(
    study: Study,
    catalogue: Catalogue,
    *,
    where: str = "",
    require: float | None = None,
    progress: Progress | None = None,
) -> Selection:
    """Rank the catalogue's actuators by the share of the positions that they can serve.

    Parameters
    ----------
    study : Study
        Robot, motion and checks.
    catalogue : Catalogue
        Where the candidates are.
    where : str, optional
        Condition on the candidates, beside the study's own, such as ``"rated_power_w <= 100"``.
    require : float, optional
        Required share of the positions; the study's own by default. [%]
    progress : callable, optional
        Called with (work done, work).

    Returns
    -------
    Selection
        Ordered by verdict, feasible share, fewest checks not evaluated, smallest worst utilisation.

    Raises
    ------
    NoCandidates
        If no actuator is left.
    InvalidInput
        If `require` is not from 0 to 100.

    References
    ----------
    CPR-ACM, section 4 of Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.

    Examples
    --------
    >>> with open_catalogue() as catalogue:
    ...     selection = rank(load_study("cpr8"), catalogue)
    >>> [(actuator.name, actuator.feasible_poses) for actuator in selection.ranked][:2]
    [('Actuator 1', 200), ('Actuator 3', 184)]
    """
    return rank_result(
        evaluate(study, catalogue, where=where, progress=progress),
        require=require,
        fingerprint=catalogue.fingerprint(),
        where=where,
    )


def rank_result(result: StudyEvaluation, *, require: float | None, fingerprint: str, where: str = "") -> Selection:
    """Rank what has been evaluated; parameters as for `rank`."""
    required = result.study.table.requirement.feasible_percent if require is None else require
    if not 0.0 <= required <= 100.0:  # noqa: PLR2004 - per cent; NaN fails too
        problem = Problem(place="--require", value=f"{required:g}", expected="a number from 0 to 100 [%]")
        raise InvalidInput("the requirement does not hold", [problem])
    missed = missed_places(result.study, result.evaluation.actuators)
    return Selection(
        result=result,
        required_percent=required,
        ranked=_ranked(result, required, missed),
        warnings=demand_warnings(
            result.evaluation.demand,
            apart=len(result.study.positions) - result.poses,
            moments_left_out=result.study.robot.leaves_out_moments,
        ),
        fingerprint=fingerprint,
        where=where,
        unattainable_places=missed[0].for_any_drive if missed else (),
    )


def _ranked(result: StudyEvaluation, required: float, missed: Sequence[MissedPlaces]) -> tuple[RankedActuator, ...]:
    """Every actuator with its verdicts, best first."""
    evaluation = result.evaluation
    verdict = verdicts(evaluation, required, [one.served for one in missed])
    order = ranking_order(evaluation, verdict)
    missing = {check: result.candidates.missing(check, result.study.tension_model) for check in evaluation.checks}
    exceeded = exceeded_part_limits(result.candidates.rows, evaluation.actuators, evaluation.demand)
    exact = exact_counts(result.study, evaluation, order[:EXACT])
    connected = connected_percents(result.study, evaluation, result.counted, order[:EXACT])
    return tuple(
        RankedActuator(
            index=int(index),
            id=result.candidates.ids[index],
            name=result.candidates.names[index],
            verdict=verdict[index],
            feasible_poses=int(evaluation.positions[index]),
            feasible_percent=100.0 * float(evaluation.positions[index]) / result.poses,
            checks={check: _check_verdict(result, check, int(index), required, missing) for check in Check},
            exact_poses=exact.get(int(index)),
            connected_percent=connected.get(int(index)),
            missed=missed[index].titles,
            assumptions=result.candidates.assumed[index],
            left_out=result.candidates.left_out[index],
            exceeded=exceeded[index],
        )
        for index in order
    )


def _check_verdict(
    result: StudyEvaluation, check: Check, index: int, required: float, missing: dict[Check, list[tuple[str, ...]]]
) -> CheckVerdict:
    count = result.evaluation.checks.get(check)
    if count is None:
        return CheckVerdict(state=State.NOT_APPLICABLE)
    if not count.applicable[index]:
        return CheckVerdict(state=State.NOT_APPLICABLE, reason=why_no_voltage(result.candidates.rows[index]))
    if not count.evaluated[index]:
        keys = assumption_keys(result.candidates.rows[index])
        lacking = missing[check][index]
        return CheckVerdict(
            state=State.NOT_EVALUATED,
            missing=lacking,
            assumable={figure: keys[figure] for figure in lacking if figure in keys},
        )
    positions = count.positions[index]
    enough = bool(meets_share(positions, result.poses, required))
    where = None
    if count.worst_position[index] >= 0:
        x, y, z = (float(value) for value in result.evaluation.demand.positions[count.worst_position[index]])
        where = (x, y, z)
    return CheckVerdict(
        state=State.PASSED if enough else State.FAILED,
        poses=int(positions),
        worst_utilisation=float(count.worst_utilisation[index]),
        worst_position=where,
    )
