"""All that a report shows beyond the ranking: where and why actuators fail, variants, moves, parts and sources."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from actuator_select.database import Catalogue
from actuator_select.model.actuation import ROUNDING, Check
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.drive_cloud import DriveCloud, drive_cloud
from actuator_select.model.evaluation import position_utilisation
from actuator_select.model.ranking import Verdict, required_positions
from actuator_select.selection.assumptions import Assumed, why_no_voltage
from actuator_select.selection.candidates import from_rows, study_candidates
from actuator_select.selection.models import ModelCount, compare_models
from actuator_select.selection.plausibility import Finding, check_rows
from actuator_select.selection.results import RankedActuator, Selection
from actuator_select.selection.selection import evaluate_candidates, rank_result
from actuator_select.selection.simulation import Simulation, simulate_candidate
from actuator_select.study import Study, Variant
from actuator_select.units import rad_per_s, rpm

SHOWN = 100  # actuators that are listed and explained; a longer ranking belongs in CSV
DETAILED = 8  # actuators that get pictures
CLOUD_POINTS = 5000
PART_KINDS = {"motor": "motors", "gearbox": "gearboxes", "winch": "winches"}

# The motor figure that each limit is made of, and its unit.
LIMIT_FIGURES: dict[Check, tuple[str, str]] = {
    Check.SPEED: ("rated speed", "rpm"),
    Check.TORQUE: ("rated torque", "N m"),
    Check.ACCELERATION: ("rated torque at this rotor inertia", "N m"),
    Check.VOLTAGE: ("nominal voltage", "V"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Need:
    """What one limit would have to be for the required share of the positions, the other limits apart.

    Attributes
    ----------
    check : Check
        The limit.
    poses : int
        Positions that it allows now.
    figure, unit : str
        The motor figure behind it.
    stated, needed : float
        That figure now, and the least that would do.
    """

    check: Check
    poses: int
    figure: str
    unit: str
    stated: float
    needed: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorDetail:
    """Where one actuator stands at each of the study's P positions; NaN, -1 and False at those set apart.

    Attributes
    ----------
    actuator : RankedActuator
        Its place in the ranking.
    utilisation : (P,) array
        Largest demand over limit of all evaluated checks.
    critical : (P,) array
        Index into `checks` of the check that gives it.
    checks : tuple of Check
        The evaluated checks.
    feasible : (P,) array of bool
        Where every evaluated check holds.
    attainable : (P,) array of bool
        Where some drive could serve.
    cloud : DriveCloud
        Operating points at the motor.
    figures : ActuatorSet
        The actuator itself.
    peak_torque, greatest_speed : float
        The maker's limits of the motor for a short time; NaN unknown, infinite unlimited. [N m, rad/s]
    standstill_torque : float
        Continuous near zero speed, as makers of servos state it; NaN unknown. [N m]
    why_no_voltage : str
        What the motor's electrical figures are, where the voltage check does not apply to them.
    """

    actuator: RankedActuator
    utilisation: FloatArray
    critical: IntArray
    checks: tuple[Check, ...]
    feasible: BoolArray
    attainable: BoolArray
    cloud: DriveCloud
    figures: ActuatorSet
    peak_torque: float
    greatest_speed: float
    standstill_torque: float
    why_no_voltage: str


@dataclass(frozen=True, slots=True, kw_only=True)
class VariantResult:
    """The study with some keys changed, ranked.

    Attributes
    ----------
    variant : Variant
        What was changed.
    selection : Selection
        Its ranking.
    feasible : (P,) array of bool
        Where the study's best actuator serves in this variant.
    """

    variant: Variant
    selection: Selection
    feasible: BoolArray

    def actuator(self, index: int) -> RankedActuator:
        """The candidate of this index."""
        return next(actuator for actuator in self.selection.ranked if actuator.index == index)


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """One catalogue row that the ranking used.

    Attributes
    ----------
    kind, id : str
        The row.
    figures : mapping of str to object
        Its known columns.
    source : mapping of str to object
        The document that states them.
    findings : tuple of Finding
        Its plausibility findings.
    assumed : tuple of Assumed
        What was taken for figures that it does not state.
    """

    kind: str
    id: str
    figures: Mapping[str, Any]
    source: Mapping[str, Any]
    findings: tuple[Finding, ...]
    assumed: tuple[Assumed, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Dossier:
    """A selection and everything that explains it.

    Attributes
    ----------
    selection : Selection
        The ranking.
    shown : tuple of RankedActuator
        The best `SHOWN`, best first.
    details : tuple of ActuatorDetail
        The best `DETAILED` of them.
    needs : tuple of (RankedActuator, tuple of Need)
        For every shown actuator that fails: the limits that keep it from the requirement.
    variants : tuple of VariantResult
        In the study's order.
    models : tuple of ModelCount
        The study under every tension model, for the detailed actuators.
    moves : tuple of (str, Simulation)
        Titles and simulations of the study's moves with the best actuator.
    parts : tuple of Part
        Catalogue rows behind the shown actuators.
    """

    selection: Selection
    shown: tuple[RankedActuator, ...]
    details: tuple[ActuatorDetail, ...]
    needs: tuple[tuple[RankedActuator, tuple[Need, ...]], ...]
    variants: tuple[VariantResult, ...]
    models: tuple[ModelCount, ...]
    moves: tuple[tuple[str, Simulation], ...]
    parts: tuple[Part, ...]

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Plausibility findings of all parts."""
        return tuple(finding for part in self.parts for finding in part.findings)


def build_dossier(selection: Selection, catalogue: Catalogue) -> Dossier:
    """Work out what explains a ranking.

    Parameters
    ----------
    selection : Selection
        The ranking.
    catalogue : Catalogue
        Where its actuators came from.

    Returns
    -------
    Dossier
        Figures for the shown actuators, arrays for the detailed ones.
    """
    shown = selection.ranked[:SHOWN]
    return Dossier(
        selection=selection,
        shown=shown,
        details=tuple(_detail(selection, actuator) for actuator in shown[:DETAILED]),
        needs=_needs(selection, [actuator for actuator in shown if actuator.verdict is Verdict.FAILS]),
        variants=tuple(_variant(selection, one) for one in selection.study.variants),
        models=compare_models(
            selection.study,
            selection.result.evaluation.actuators.take([actuator.index for actuator in shown[:DETAILED]]),
        ),
        moves=_moves(selection),
        parts=_parts(selection, shown, catalogue),
    )


def feasible_positions(selection: Selection, index: int) -> BoolArray:
    """Where every evaluated check of one candidate holds, at the positions that count, (n,)."""
    utilisation, _, _ = _worst(selection, index)
    attainable = selection.result.evaluation.demand.attainable_positions
    return np.asarray((utilisation <= 1.0 + ROUNDING) & attainable, dtype=np.bool_)


def _worst(selection: Selection, index: int) -> tuple[FloatArray, IntArray, tuple[Check, ...]]:
    """Largest utilisation at every position, which check gives it, and the evaluated checks."""
    evaluation = selection.result.evaluation
    checks = tuple(check for check, count in evaluation.checks.items() if count.evaluated[index])
    if not checks:
        attainable = evaluation.demand.attainable_positions
        return np.where(attainable, 0.0, np.inf), np.full(selection.poses, -1, dtype=np.int64), ()
    values = position_utilisation(evaluation.demand, evaluation.actuators.take([index]), checks)
    stacked = np.stack([values[check][0] for check in checks])
    return stacked.max(axis=0), stacked.argmax(axis=0), checks


def _detail(selection: Selection, actuator: RankedActuator) -> ActuatorDetail:
    utilisation, critical, checks = _worst(selection, actuator.index)
    evaluation = selection.result.evaluation
    figures = evaluation.actuators.take([actuator.index])
    worst = np.array([evaluation.checks[check].worst_position[actuator.index] for check in checks], dtype=np.int64)
    result, attainable = selection.result, evaluation.demand.attainable_positions
    row = result.candidates.rows[actuator.index]
    feasible = (utilisation <= 1.0 + ROUNDING) & attainable
    return ActuatorDetail(
        actuator=actuator,
        utilisation=result.spread(np.where(attainable, utilisation, np.inf)),
        critical=result.spread(critical.astype(np.float64), -1.0).astype(np.int64),
        checks=checks,
        feasible=result.spread(feasible.astype(np.float64), 0.0) > 0.0,
        attainable=result.spread(attainable.astype(np.float64), 0.0) > 0.0,
        cloud=drive_cloud(evaluation.demand, figures, CLOUD_POINTS, np.unique(worst[worst >= 0])),
        figures=figures,
        peak_torque=_known(row.get("motor.peak_torque_nm")),
        greatest_speed=rad_per_s(_known(row.get("motor.max_speed_rpm"))),
        standstill_torque=_known(row.get("motor.standstill_torque_nm")),
        why_no_voltage=why_no_voltage(row),
    )


def _known(value: float | None) -> float:
    return np.nan if value is None else float(value)


def _needs(selection: Selection, failing: list[RankedActuator]) -> tuple[tuple[RankedActuator, tuple[Need, ...]], ...]:
    evaluation = selection.result.evaluation
    enough = required_positions(selection.poses, selection.required_percent)
    figures = evaluation.actuators.take([actuator.index for actuator in failing])
    stated = {
        Check.SPEED: rpm(figures.motor_speed),
        Check.TORQUE: figures.motor_torque,
        Check.ACCELERATION: figures.motor_torque,
        Check.VOLTAGE: figures.voltage,
    }
    needs: list[list[Need]] = [[] for _ in failing]
    for check in evaluation.checks:
        short = [
            row
            for row, actuator in enumerate(failing)
            if (poses := actuator.checks[check].poses) is not None and poses < enough
        ]
        utilisation = position_utilisation(evaluation.demand, figures.take(short), [check])[check]
        # Every limit is proportional to its figure, so the utilisation to be brought down to 1 scales it.
        reached = np.sort(utilisation, axis=1)[:, enough - 1]
        for row, factor in zip(short, reached, strict=True):
            figure, unit = LIMIT_FIGURES[check]
            now = float(stated[check][row])
            needs[row].append(
                Need(
                    check=check,
                    poses=int(evaluation.checks[check].positions[failing[row].index]),
                    figure=figure,
                    unit=unit,
                    stated=now,
                    needed=now * float(factor),
                )
            )
    return tuple((actuator, tuple(found)) for actuator, found in zip(failing, needs, strict=True))


def _variant(selection: Selection, variant: Variant) -> VariantResult:
    rows = selection.result.candidates.rows
    ranked = rank_result(
        evaluate_candidates(variant.study, study_candidates(variant.study, rows)),
        require=selection.required_percent,
        fingerprint=selection.fingerprint,
        where=selection.where,
    )
    feasible = feasible_positions(ranked, selection.ranked[0].index)
    return VariantResult(
        variant=variant, selection=ranked, feasible=ranked.result.spread(feasible.astype(np.float64), 0.0) > 0.0
    )


def _moves(selection: Selection) -> tuple[tuple[str, Simulation], ...]:
    study: Study = selection.study
    # A move shows every limit, those that the study does not check among them.
    single = from_rows([selection.result.candidates.rows[selection.ranked[0].index]], study.table.assumptions)
    return tuple(
        (
            one.title,
            simulate_candidate(study, single, one.from_m, one.to_m, one.orientation_rad, place=f"move[{index}]"),
        )
        for index, one in enumerate(study.table.move)
    )


def _parts(selection: Selection, actuators: tuple[RankedActuator, ...], catalogue: Catalogue) -> tuple[Part, ...]:
    parts: dict[tuple[str, str], Part] = {}
    taken: dict[tuple[str, str], dict[Assumed, None]] = {}
    for actuator in actuators:
        row = selection.result.candidates.rows[actuator.index]
        own = {name: value for name, value in row.items() if "." not in name}
        rows: list[tuple[str, Mapping[str, Any], tuple[Assumed, ...]]] = [("actuators", own, ())]
        for role, kind in PART_KINDS.items():
            if row.get(f"{role}_id") is not None:
                joined = {name.split(".", 1)[1]: value for name, value in row.items() if name.startswith(f"{role}.")}
                assumed = tuple(one for one in actuator.assumptions if one.column.startswith(f"{role}."))
                rows.append((kind, {"id": row[f"{role}_id"], **joined}, assumed))
        for kind, figures, assumed in rows:
            key = (kind, str(figures["id"]))
            taken.setdefault(key, {}).update(dict.fromkeys(assumed))
            if key not in parts:
                parts[key] = Part(
                    kind=kind,
                    id=key[1],
                    figures={name: value for name, value in figures.items() if value is not None},
                    source=catalogue.source(str(figures["source_id"])),
                    findings=tuple(check_rows(kind, [figures])),
                    assumed=(),
                )
    return tuple(replace(part, assumed=tuple(taken[key])) for key, part in parts.items())
