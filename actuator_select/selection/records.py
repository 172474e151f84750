"""Results as plain records, for JSON and whoever reads it: the public contract of ``--format json``."""

from math import isfinite
from typing import Any

from actuator_select.model.exceedance import Exceedance
from actuator_select.selection.assumptions import Assumed
from actuator_select.selection.part_limits import Exceeded
from actuator_select.selection.results import CheckVerdict, RankedActuator, Selection
from actuator_select.selection.simulation import UNITS, Simulation


def selection_record(selection: Selection, *, only_meeting: bool = False) -> dict[str, Any]:
    """Ranking as nested dicts and lists of strings, numbers and None; no NaN, no infinity.

    Parameters
    ----------
    selection : Selection
        The ranking.
    only_meeting : bool
        Leave out the actuators that do not meet the requirement.

    Returns
    -------
    dict
        ``study``, ``tension_model``, ``motion_set``, ``catalogue``, ``poses``, ``attainable_percent``,
        ``required_percent``, ``warnings``, ``actuators`` (best first) and more.
    """
    study = selection.study
    return {
        "study": study.name,
        "tension_model": study.tension_model.value,
        "motion_set": study.motion.kind.value,
        "catalogue": {"fingerprint": selection.fingerprint, "where": selection.where},
        "poses": selection.poses,
        "too_near_poses": len(study.positions) - selection.poses,
        "attainable_poses": selection.attainable_poses,
        "attainable_percent": round(selection.attainable_percent, 2),
        "robot_falls_short": selection.robot_falls_short,
        "unattainable_places": list(selection.unattainable_places),
        "required_percent": selection.required_percent,
        "warnings": [{"code": one.code, "poses": one.poses, "text": one.text} for one in selection.warnings],
        "actuators": [
            _actuator_record(actuator, selection.poses) for actuator in selection.shown(only_meeting=only_meeting)
        ],
    }


def _actuator_record(actuator: RankedActuator, poses: int) -> dict[str, Any]:
    return {
        "id": actuator.id,
        "name": actuator.name,
        "feasible_percent": round(actuator.feasible_percent, 2),
        "feasible_poses": actuator.feasible_poses,
        "feasible_is_upper_bound": actuator.is_upper_bound,
        "feasible_poses_exact": actuator.exact_poses,
        "connected_percent": None if actuator.connected_percent is None else round(actuator.connected_percent, 2),
        "must_serve_missed": list(actuator.missed),
        "poses": poses,
        "verdict": actuator.verdict.value,
        "checks": {check.value: _check_record(verdict) for check, verdict in actuator.checks.items()},
        "assumptions": [_assumption_record(one) for one in actuator.assumptions],
        "left_out": list(actuator.left_out),
        "exceeded_part_limits": [_exceeded_record(one) for one in actuator.exceeded],
    }


def _assumption_record(assumed: Assumed) -> dict[str, Any]:
    return {
        "figure": assumed.figure,
        "column": assumed.column,
        "value": assumed.value,
        "unit": assumed.unit,
        "key": assumed.key or None,
        "text": assumed.text,
    }


def _exceeded_record(exceeded: Exceeded) -> dict[str, Any]:
    return {
        "column": exceeded.column,
        "limit": exceeded.limit,
        "demand": exceeded.demand,
        "unit": exceeded.unit,
        "poses": exceeded.positions,
        "text": exceeded.text,
    }


def _check_record(verdict: CheckVerdict) -> dict[str, Any]:
    return {
        "state": verdict.state.value,
        "poses": verdict.poses,
        "worst_utilisation": _finite(verdict.worst_utilisation),
        "margin": _finite(verdict.margin),
        "worst_position_m": list(verdict.worst_position) if verdict.worst_position else None,
        "missing": list(verdict.missing),
        "reason": verdict.reason or None,
    }


def _exceedance_record(exceedance: Exceedance) -> dict[str, Any]:
    return {
        "actuator": exceedance.actuator,
        "check": exceedance.check.value,
        "from_s": exceedance.start,
        "to_s": exceedance.stop,
        "worst": exceedance.worst,
        "limit": exceedance.limit,
    }


def simulation_record(run: Simulation) -> dict[str, Any]:
    """Simulation as nested dicts and lists: limits, peaks per cable with their times, exceedances, pushing cables.

    Parameters
    ----------
    run : Simulation
        The simulated move.

    Returns
    -------
    dict
        Quantities at the shaft behind the gearbox; None where a figure is unknown. Checks that do not apply to the
        actuator stand under ``not_applicable`` alone.
    """
    return {
        "study": run.study.name,
        "actuator": {"id": run.candidates.ids[0], "name": run.candidates.names[0]},
        "tension_model": run.study.tension_model.value,
        "duration_s": run.duration,
        "assumptions": [_assumption_record(one) for one in run.candidates.assumed[0]],
        "left_out": list(run.candidates.left_out[0]),
        "units": {check.value: UNITS[check] for check in run.checks},
        "limits": {check.value: _finite(run.limits[check]) for check in run.checks},
        "peaks": {
            check.value: [
                {"actuator": cable + 1, "peak": _finite(peak), "time_s": _finite(time)}
                for cable, (peak, time) in enumerate(zip(run.peaks[check], run.peak_times[check], strict=True))
            ]
            for check in run.checks
        },
        "torque_test": run.history.torque_test.value,
        "exceedances": [_exceedance_record(one) for one in run.exceedances],
        "load_and_rotor_torque_exceedances": [_exceedance_record(one) for one in run.together],
        "not_held": [{"from_s": start, "to_s": stop} for start, stop in run.unheld],
        "not_evaluated": {check.value: list(missing) for check, missing in run.missing.items()},
        "not_applicable": {check.value: reason for check, reason in run.not_applicable.items()},
        "negative_tension_cables": run.pushing,
        "rank_deficient": bool(run.history.rank_deficient.any()),
        "unbalanced_wrench": bool(run.history.unbalanced.any()),
        "infeasible": bool(run.history.infeasible.any()),
    }


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None
