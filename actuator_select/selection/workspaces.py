"""The use case: where can this robot work? No actuators are needed."""

from dataclasses import dataclass, replace

import numpy as np

from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.demand import BOUND_TOLERANCE, Progress
from actuator_select.model.grid_measure import Measure, measure_of
from actuator_select.model.tension import TensionModel, balanced_rows
from actuator_select.model.workspace import OrientationRule, PositionVerdicts, WorkspaceKind, judge_positions
from actuator_select.selection.places import connected_share
from actuator_select.selection.wording import basis, motion_words
from actuator_select.study import Study

POSITIONS_ASKED_WHY = 500  # how many positions are tried again with less asked, where none is feasible

ASKED = {
    WorkspaceKind.REACHABLE: "every cable within its bounds of length, nothing else",
    WorkspaceKind.STATIC: "to hold platform and load at rest, external loads at the centre of their box",
    WorkspaceKind.WRENCH: "to hold platform and load against the whole box of external loads, no acceleration",
    WorkspaceKind.DYNAMIC: "to hold platform and load against the box of external loads and every acceleration",
    WorkspaceKind.TWIST: "every cable's speed within cables.speed_max_m_per_s; no tensions are looked at",
}
TENSIONS = {
    TensionModel.WRENCH_FEASIBLE: "some tensions within their bounds balance all forces and moments",
    TensionModel.FORCE_ONLY: "some tensions within their bounds balance the forces; moments are left out",
    TensionModel.PSEUDO_INVERSE: "the tensions of least norm balance all, and stay within their bounds",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkspaceResult:
    """The workspace of a study.

    Attributes
    ----------
    study : Study
        What was asked.
    kind : WorkspaceKind
        What has to be possible.
    over : OrientationRule
        At which orientations.
    tension_model : TensionModel
        How the cables share the load.
    feasible : (P,) array of bool
        Positions of the workspace.
    apart : (P,) array of bool
        Positions nearer to an anchor than the least cable length, which are not judged.
    margin : (P,) array
        Distance from the border of what is possible, negative beyond it. [`margin_unit`]
    tension : (P,) array
        Minimax tension; under the pseudo-inverse the largest magnitude of a tension. Infinite where infeasible, NaN of
        kinds that do not rest on tensions. [N]
    poses : int
        Positions judged: those of the grid but for those set apart.
    feasible_poses : int
        Of these, those of the workspace.
    singular_poses : int
        Positions whose structure matrix is short of rank at a considered orientation.
    too_near_poses : int
        Positions set apart.
    measured : Measure or None
        Length, area or volume, an estimate; None of a single position.
    connected_percent : float or None
        Share of the feasible positions that is connected to the home position, None without one. [%]
    reasons : tuple of str
        Why nothing is feasible; empty where something is.
    warnings : tuple of str
        What to mind.
    """

    study: Study
    kind: WorkspaceKind
    over: OrientationRule
    tension_model: TensionModel
    feasible: BoolArray
    apart: BoolArray
    margin: FloatArray
    tension: FloatArray
    poses: int
    feasible_poses: int
    singular_poses: int
    too_near_poses: int
    measured: Measure | None
    connected_percent: float | None
    reasons: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def feasible_percent(self) -> float | None:
        """Feasible share of the judged positions; None where all are set apart. [%]"""
        return 100.0 * self.feasible_poses / self.poses if self.poses else None

    @property
    def measure(self) -> float | None:
        """Length, area or volume, an estimate. [m, m², m³]"""
        return None if self.measured is None else self.measured.value

    @property
    def unit(self) -> str | None:
        """``m``, ``m2`` or ``m3``."""
        return None if self.measured is None else self.measured.unit

    @property
    def interval(self) -> tuple[float, float] | None:
        """The measure from the cells surely inside to these and those on the border."""
        return None if self.measured is None else (self.measured.inner, self.measured.outer)

    @property
    def largest_tension(self) -> float | None:
        """Largest tension over the feasible positions; None where there are none, or tensions do not decide. [N]"""
        values = self.tension[self.feasible]
        return float(values.max()) if len(values) and np.isfinite(values).all() else None

    @property
    def margin_unit(self) -> str:
        """Unit of the margins."""
        return {WorkspaceKind.REACHABLE: "m", WorkspaceKind.TWIST: "m/s"}.get(self.kind, "N")


def evaluate_workspace(
    study: Study,
    *,
    kind: WorkspaceKind = WorkspaceKind.DYNAMIC,
    over: OrientationRule = OrientationRule.TOTAL,
    tension_model: TensionModel | None = None,
    explain: bool = True,
    progress: Progress | None = None,
) -> WorkspaceResult:
    """Find the workspace of a study's robot.

    Parameters
    ----------
    study : Study
        Robot, loads, motion and grid.
    kind : WorkspaceKind
        What has to be possible at a position; see `judge_positions`.
    over : OrientationRule
        At which of the study's orientations.
    tension_model : TensionModel, optional
        The study's own by default.
    explain : bool
        Look for reasons where nothing is feasible.
    progress : callable, optional
        Called with (positions done, positions).

    Returns
    -------
    WorkspaceResult
        That nothing is feasible is a result, with its reasons.

    Raises
    ------
    InvalidInput
        If the kind is twist-feasible and no cable's speed is bounded.

    Examples
    --------
    >>> result = evaluate_workspace(load_study("cpr8"), kind=WorkspaceKind.STATIC)
    >>> result.tension_model.value, result.feasible_poses, result.poses
    ('pseudo_inverse', 44, 216)
    """
    if kind is WorkspaceKind.TWIST and not np.isfinite(study.robot.bounds.speed_max).any():
        problem = Problem(
            place="cables.speed_max_m_per_s",
            value="is missing",
            expected="the greatest cable speed, which the twist-feasible workspace asks for [m/s]",
            remedy="add it to the study, or --set cables.speed_max_m_per_s=2",
        )
        raise InvalidInput("the workspace cannot be found so", [problem])
    model = study.tension_model if tension_model is None else tension_model
    verdicts = _judge(study, kind, over, model, progress=progress)
    poses, feasible_poses = int((~verdicts.apart).sum()), int(verdicts.feasible.sum())
    table = study.table.workspace
    measured = measure_of(verdicts.feasible, table.points, study.cell_size, midpoints=table.grid == "midpoints")
    return WorkspaceResult(
        study=study,
        kind=kind,
        over=over,
        tension_model=model,
        feasible=verdicts.feasible,
        apart=verdicts.apart,
        margin=verdicts.margin,
        tension=verdicts.tension,
        poses=poses,
        feasible_poses=feasible_poses,
        singular_poses=int(verdicts.short_of_rank.sum()),
        too_near_poses=int(verdicts.apart.sum()),
        measured=measured,
        connected_percent=connected_share(study, verdicts.feasible),
        reasons=_reasons(study, kind, over, model, verdicts) if explain and not feasible_poses else (),
        warnings=(*_warnings(study, kind, over, model, verdicts), *_measure_warnings(measured)),
    )


def reasons_why_nothing_holds(study: Study, attainable: int) -> tuple[str, ...]:
    """Why no drive could serve any position of a study; empty where some could be served."""
    return () if attainable else evaluate_workspace(study).reasons


def workspace_record(result: WorkspaceResult) -> dict[str, object]:
    """Counts, measure and reasons of a workspace, fit for strict JSON."""
    percent, connected = result.feasible_percent, result.connected_percent
    return {
        "study": result.study.name,
        "kind": result.kind.value,
        "orientations": result.over.value,
        "tension_model": result.tension_model.value,
        "poses": result.poses,
        "feasible_poses": result.feasible_poses,
        "feasible_percent": None if percent is None else round(percent, 4),
        "measure": rounded(result.measure),
        "measure_unit": result.unit,
        "measure_interval": None if result.interval is None else [rounded(end) for end in result.interval],
        "largest_tension_n": rounded(result.largest_tension),
        "singular_poses": result.singular_poses,
        "too_near_poses": result.too_near_poses,
        "connected_percent": None if connected is None else round(connected, 4),
        "reasons": list(result.reasons),
        "warnings": list(result.warnings),
    }


def workspace_words(result: WorkspaceResult) -> str:
    """Size of a workspace with its interval, ``112.8 m² (111.2 to 114.5)``; a dash for a single position."""
    if result.measure is None or result.unit is None or result.interval is None:
        return "–"
    least, most = result.interval
    return f"{result.measure:.4g} {unit_words(result.unit)} ({least:.4g} to {most:.4g})"


def workspace_basis(result: WorkspaceResult) -> dict[str, str]:
    """What the share is of, item by item.

    Parameters
    ----------
    result : WorkspaceResult
        Any workspace.

    Returns
    -------
    dict of str to str
        Name of the item to its description, with units.
    """
    study, table = result.study, result.study.table.workspace
    said = basis(study)
    ends = "midpoints of equal cells" if table.grid == "midpoints" else "nodes, both ends included"
    rule = {
        OrientationRule.CONSTANT: "the first of them only",
        OrientationRule.INCLUSION: "a position has to hold at one of them",
        OrientationRule.TOTAL: "a position has to hold at every one of them",
    }[result.over]
    angles = said["orientations"].split(", at all of which")[0]
    items = {
        "box": said["box"],
        "grid": f"{' × '.join(str(count) for count in table.points)} positions, {ends}",
        "orientations": f"{angles}; {rule}" if len(study.orientations) > 1 else angles,
        "asked": ASKED[result.kind],
    }
    if result.kind.rests_on_tensions:
        items["loads"] = said["load"]
        items["tensions"] = f"{result.tension_model.value}: {TENSIONS[result.tension_model]}"
    if result.kind in (WorkspaceKind.DYNAMIC, WorkspaceKind.TWIST):
        items["motion set"] = motion_words(study)
    return items


def unit_words(unit: str) -> str:
    """``m²`` of ``m2``."""
    return unit.replace("2", "²").replace("3", "³")


def rounded(value: float | None) -> float | None:
    """A number without the digits that summing left in it."""
    return None if value is None else float(f"{value:.10g}")


def _judge(
    study: Study,
    kind: WorkspaceKind,
    over: OrientationRule,
    model: TensionModel,
    *,
    positions: FloatArray | None = None,
    progress: Progress | None = None,
) -> PositionVerdicts:
    return judge_positions(
        study.robot,
        study.positions if positions is None else positions,
        study.orientations,
        study.wrenches,
        study.motion,
        kind=kind,
        over=over,
        tension_model=model,
        progress=progress,
    )


def _reasons(
    study: Study, kind: WorkspaceKind, over: OrientationRule, model: TensionModel, verdicts: PositionVerdicts
) -> tuple[str, ...]:
    """Why nothing is feasible, from the plainest reason to what was found by asking for less."""
    robot, judged = study.robot, ~verdicts.apart
    if not judged.any():
        return ("Every position is nearer to an anchor than cables.length_min_m.",)
    if verdicts.unreachable[judged].all():
        return ("At every position a cable would be longer than cables.length_max_m.",)
    if kind is WorkspaceKind.TWIST:
        return ("At every position a cable would have to wind faster than cables.speed_max_m_per_s.",)
    if kind is WorkspaceKind.REACHABLE:
        return ("At every position a cable is out of its bounds of length.",)
    reasons = []
    equations = len(balanced_rows(robot, model))
    if robot.cables < equations:
        reasons.append(
            f"{robot.cables} cable{'s' if robot.cables > 1 else ''} cannot balance {equations} equations, but for "
            f"loads that happen to lie in the "
            f"range of the structure matrix: add cables, or state fewer degrees of freedom."
        )
    if verdicts.short_of_rank[judged].all():
        reasons.append(
            f"The structure matrix is short of rank at every position: some force or moment (of {equations}) cannot be "
            f"exerted at all."
        )
    reasons += _asking_for_less(study, kind, over, model, verdicts)
    return tuple(reasons)


def _asking_for_less(
    study: Study, kind: WorkspaceKind, over: OrientationRule, model: TensionModel, verdicts: PositionVerdicts
) -> list[str]:
    """What would have to give way, tried on some of the positions."""
    positions = study.positions[~verdicts.apart]
    positions = positions[:: -(-len(positions) // POSITIONS_ASKED_WHY)]
    tried = f"of {len(positions)} positions tried"
    robot = study.robot
    free = replace(study, robot=replace(robot, bounds=replace(robot.bounds, tension_max=np.full(robot.cables, np.inf))))
    found: list[str] = []

    def count(changed: Study, asked: WorkspaceKind) -> int:
        return int(_judge(changed, asked, over, model, positions=positions).feasible.sum())

    if kind is WorkspaceKind.DYNAMIC and (held := count(study, WorkspaceKind.WRENCH)):
        return [f"At rest {held} {tried} hold: the motion set asks for too much."]
    if kind is not WorkspaceKind.STATIC and (held := count(study, WorkspaceKind.STATIC)):
        return [f"With external loads at the centre of their box {held} {tried} hold: the box asks for too much."]
    if np.isfinite(robot.bounds.tension_max).any() and (held := count(free, kind)):
        return [f"With no upper bound of the tension {held} {tried} would hold: cables.tension_max_n is too small."]
    if robot.bounds.tension_min.any():
        slack = replace(free.robot.bounds, tension_min=np.zeros(robot.cables))
        if held := count(replace(free, robot=replace(robot, bounds=slack)), kind):
            found.append(f"With tensions from 0 {held} {tried} would hold: cables.tension_min_n is too large.")
    if not found:
        if model.lets_cables_push:
            found.append(
                f"At none {tried} do the tensions of least norm balance what is asked without one below its bound; "
                f"other tensions might: --tension-model wrench_feasible."
            )
        else:
            found.append(
                f"No tensions of pulling cables balance what is asked at any {tried}, however strong the cables are: "
                f"the anchors have to change, or the platform is outside of what they span."
            )
    return found


def _warnings(
    study: Study, kind: WorkspaceKind, over: OrientationRule, model: TensionModel, verdicts: PositionVerdicts
) -> tuple[str, ...]:
    total = len(verdicts.apart)
    found = []
    if kind.rests_on_tensions and (short := int(verdicts.short_of_rank.sum())):
        found.append(f"At {short} of {total} positions the structure matrix is short of rank.")
    if near := int(verdicts.apart.sum()):
        found.append(
            f"{near} of {total} positions are nearer to an anchor than cables.length_min_m; they are not judged, "
            f"and left out of the count."
        )
    if kind.rests_on_tensions and model.lets_cables_push:
        found.append(
            "Under pseudo_inverse a position counts where the tensions of least norm balance what is asked within "
            "their bounds; other tensions might hold more positions: --tension-model wrench_feasible."
        )
    if kind.rests_on_tensions and study.table.cables.tension_min_n is None:
        found.append("cables.tension_min_n is not stated: 0 N was taken, at which a cable is slack.")
    if kind.rests_on_tensions and study.table.cables.tension_max_n is None:
        found.append("cables.tension_max_n is not stated: the cables may pull without limit.")
    if over is OrientationRule.CONSTANT and len(study.orientations) > 1:
        found.append(f"Only the first of {len(study.orientations)} orientations was considered.")
    return tuple(found)


def _measure_warnings(measured: Measure | None) -> list[str]:
    return [] if measured is None else measure_warnings(measured.value, measured.outer)


def measure_warnings(value: float, most: float) -> list[str]:
    """What to mind of a measure that exceeds its own interval."""
    if value <= most * (1.0 + BOUND_TOLERANCE):
        return []
    what = "those on the faces of the box too, and so exceeds its own interval"
    return [f"The measure gives every node a whole cell, {what}: refine the grid, or --set workspace.grid=midpoints."]
