"""The use case: which tension of a counterbalance rope suits, everywhere and at each position?"""

from dataclasses import dataclass

import numpy as np

from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.arrays import FloatArray
from actuator_select.model.demand import Progress
from actuator_select.model.support_interval import SupportInterval, support_interval
from actuator_select.model.tension import TensionModel, balanced_rows
from actuator_select.model.workspace import OrientationRule, WorkspaceKind, judge_positions, what_is_asked
from actuator_select.selection.workspaces import rounded
from actuator_select.study import Study

STEPS = 10  # of the tension, in tables


@dataclass(frozen=True, slots=True, kw_only=True)
class RopeTensions:
    """Feasible tensions of one counterbalance over the positions of a study.

    Attributes
    ----------
    study : Study
        What was asked.
    rope : int
        Index of the counterbalance.
    kind : WorkspaceKind
        What has to be possible.
    over : OrientationRule
        At which orientations.
    tension_model : TensionModel
        How the cables share the load.
    positions : (P, 3) array
        Positions judged: those of the grid but for those too near to an anchor. [m]
    interval : SupportInterval
        At each of them. [N]
    """

    study: Study
    rope: int
    kind: WorkspaceKind
    over: OrientationRule
    tension_model: TensionModel
    positions: FloatArray
    interval: SupportInterval

    @property
    def best(self) -> tuple[float, int]:
        """The least constant tension that makes most positions feasible, and how many these are. [N]"""
        exists = self.interval.exists
        if not exists.any():
            return 0.0, 0
        lower, upper = np.maximum(self.interval.lower[exists], 0.0), self.interval.upper[exists]
        starts = np.unique(lower)  # the count only grows where an interval begins
        begun = np.searchsorted(np.sort(lower), starts, side="right")
        counts = begun - np.searchsorted(np.sort(upper), starts, side="left")
        return float(starts[counts.argmax()]), int(counts.max())

    @property
    def levels(self) -> FloatArray:
        """Round tensions from zero to where every position that can be served has begun to be. [N]"""
        ends = np.concatenate([self.interval.lower, self.interval.upper])
        ends = ends[np.isfinite(ends) & (ends > 0.0)]
        starts = self.interval.lower[np.isfinite(self.interval.lower) & (self.interval.lower > 0.0)]
        most = float(starts.max()) if len(starts) else float(ends.max()) if len(ends) else 1.0
        step = most / STEPS
        unit = 10.0 ** np.floor(np.log10(step))
        step = unit * next(factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * unit >= step * (1.0 - 1e-9))
        levels: FloatArray = np.arange(int(np.ceil(most / step)) + 1) * step
        return levels


def rope_tensions(
    study: Study,
    *,
    rope: int = 0,
    kind: WorkspaceKind = WorkspaceKind.DYNAMIC,
    over: OrientationRule = OrientationRule.TOTAL,
    tension_model: TensionModel | None = None,
    progress: Progress | None = None,
) -> RopeTensions:
    """Find the feasible tensions of a counterbalance, whatever tension the study gives it.

    Parameters
    ----------
    study : Study
        With a counterbalance.
    rope : int
        Index of the counterbalance; the others keep their tensions.
    kind : WorkspaceKind
        Static, wrench-feasible or dynamic-feasible.
    over : OrientationRule
        Constant or total: of tensions that suit some orientation there is no single interval.
    tension_model : TensionModel, optional
        The study's own by default.
    progress : callable, optional
        Called with (poses done, poses).

    Returns
    -------
    RopeTensions
        Found once; any constant tension or controlled range is then a comparison.

    Raises
    ------
    InvalidInput
        If the question has no such answer.
    """
    model = study.tension_model if tension_model is None else tension_model
    _refuse(study, rope, kind, over, model)
    robot = study.robot
    reach = judge_positions(
        robot,
        study.positions,
        study.orientations,
        study.wrenches,
        study.motion,
        kind=WorkspaceKind.REACHABLE,
        over=over,
    )
    orientations = over.considered(study.orientations)
    wrenches, motion = what_is_asked(kind, study.wrenches[: len(orientations)], study.motion)
    positions = study.positions[~reach.apart]
    interval = support_interval(
        robot,
        positions,
        orientations,
        wrenches,
        motion,
        rope=rope,
        rows=balanced_rows(robot, model),
        progress=progress,
    )
    return RopeTensions(
        study=study, rope=rope, kind=kind, over=over, tension_model=model, positions=positions, interval=interval
    )


def rope_record(found: RopeTensions) -> dict[str, object]:
    """Feasible tensions in numbers, fit for strict JSON."""
    interval = found.interval
    covering, (tension, count) = interval.covering(), found.best
    return {
        "study": found.study.name,
        "kind": found.kind.value,
        "orientations": found.over.value,
        "tension_model": found.tension_model.value,
        "counterbalance": found.rope + 1,
        "poses": len(found.positions),
        "feasible_poses_at_some_tension": int(interval.exists.sum()),
        "best_constant_tension_n": rounded(tension),
        "best_constant_feasible_poses": count,
        "covering_range_n": None if covering is None else [rounded(end) for end in covering],
        "shares": [
            {
                "tension_n": rounded(float(level)),
                "feasible_poses_constant": int(interval.feasible_at(float(level)).sum()),
                "feasible_poses_controlled_from_0": int(interval.feasible_within(0.0, float(level)).sum()),
            }
            for level in found.levels
        ],
    }


def _refuse(study: Study, rope: int, kind: WorkspaceKind, over: OrientationRule, model: TensionModel) -> None:
    ropes = len(study.robot.counterbalances)
    problems = []
    if not 0 <= rope < ropes:
        problems.append(
            Problem(
                place="--counterbalance",
                value=f"{rope + 1}, where the robot has {ropes or 'no'} counterbalance{'' if ropes == 1 else 's'}",
                expected=f"a number from 1 to {ropes}" if ropes else "a robot with a counterbalance",
                remedy="" if ropes else "add [[robot.counterbalance]] with its segments, or a builder that has one",
            )
        )
    if not kind.rests_on_tensions:
        problems.append(
            Problem(place="--kind", value=kind.value, expected="static, wrench-feasible or dynamic-feasible")
        )
    if over is OrientationRule.INCLUSION:
        problems.append(
            Problem(
                place="--orientations",
                value=over.value,
                expected="constant or total, for which the feasible tensions are one interval",
            )
        )
    if model.lets_cables_push:
        problems.append(Problem(place="--tension-model", value=model.value, expected="wrench_feasible or force_only"))
    if problems:
        raise InvalidInput("the tensions of the counterbalance cannot be found so", problems)
