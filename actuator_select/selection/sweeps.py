"""The use case: how does the workspace depend on keys of the study?"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from actuator_select.errors import InvalidStudy
from actuator_select.model.demand import Progress
from actuator_select.model.tension import TensionModel
from actuator_select.model.workspace import OrientationRule, WorkspaceKind
from actuator_select.selection.workspaces import evaluate_workspace, rounded
from actuator_select.study import Study
from actuator_select.study.loading import study_builder
from actuator_select.study.sweeping import SweepAxis, combinations

COLUMNS = (
    "poses",
    "feasible_poses",
    "feasible_percent",
    "measure",
    "measure_unit",
    "measure_least",
    "measure_most",
    "singular_poses",
    "too_near_poses",
    "connected_percent",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepPoint:
    """The workspace at one combination of values; fields as of `WorkspaceResult`."""

    values: tuple[int | float, ...]
    poses: int
    feasible_poses: int
    feasible_percent: float | None
    measure: float | None
    measure_unit: str | None
    measure_least: float | None
    measure_most: float | None
    singular_poses: int
    too_near_poses: int
    connected_percent: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """Workspaces over all combinations of values.

    Attributes
    ----------
    study : Study
        At the first combination.
    axes : tuple of SweepAxis
        Keys and values.
    kind : WorkspaceKind
        What has to be possible.
    over : OrientationRule
        At which orientations.
    tension_model : TensionModel
        How the cables share the load.
    points : tuple of SweepPoint
        The last key varies fastest.
    """

    study: Study
    axes: tuple[SweepAxis, ...]
    kind: WorkspaceKind
    over: OrientationRule
    tension_model: TensionModel
    points: tuple[SweepPoint, ...]

    @property
    def best(self) -> SweepPoint:
        """The first point of the greatest measure, or of the greatest share where there is no measure."""
        return max(self.points, key=lambda point: (point.measure or 0.0, point.feasible_percent or 0.0))


def sweep_workspace(  # noqa: PLR0913 - as `evaluate_workspace`, and the sweep
    study: str | Path,
    axes: Sequence[SweepAxis],
    *,
    overrides: Mapping[str, object] | None = None,
    kind: WorkspaceKind = WorkspaceKind.DYNAMIC,
    over: OrientationRule = OrientationRule.TOTAL,
    tension_model: TensionModel | None = None,
    limit: bool = True,
    progress: Progress | None = None,
) -> Sweep:
    """Find the workspace at every combination of values.

    Parameters
    ----------
    study : str or Path
        Name of a built-in study, or a TOML file.
    axes : sequence of SweepAxis
        Keys and values.
    overrides : mapping of str to object, optional
        Keys that are changed at every combination.
    kind, over, tension_model
        As for `evaluate_workspace`.
    limit : bool
        As for `load_study`.
    progress : callable, optional
        Called with (combinations done, combinations).

    Returns
    -------
    Sweep
        Counts and measures; the positions of each workspace are not kept.

    Raises
    ------
    InvalidStudy
        If the study does not hold at a combination, named. Those of the ranges' ends are looked at before any work.
    """
    build = study_builder(study, overrides, limit=limit)
    return sweep_built(build, axes, kind=kind, over=over, tension_model=tension_model, progress=progress)


def sweep_built(
    build: Callable[[Mapping[str, object]], Study],
    axes: Sequence[SweepAxis],
    *,
    kind: WorkspaceKind = WorkspaceKind.DYNAMIC,
    over: OrientationRule = OrientationRule.TOTAL,
    tension_model: TensionModel | None = None,
    progress: Progress | None = None,
) -> Sweep:
    """As `sweep_workspace`, with what builds the study from changed keys at hand."""
    ends = product(*({axis.values[0], axis.values[-1]} for axis in axes))
    for values in ends:
        _built(build, dict(zip((axis.key for axis in axes), values, strict=True)))
    every = list(combinations(axes))
    points = []
    first: Study | None = None
    for done, changed in enumerate(every, start=1):
        here = _built(build, changed)
        first = here if first is None else first
        points.append(_point(here, tuple(changed[axis.key] for axis in axes), kind, over, tension_model))
        if progress is not None:
            progress(done, len(every))
    if first is None:
        raise InvalidStudy("the study cannot be swept so")
    return Sweep(
        study=first,
        axes=tuple(axes),
        kind=kind,
        over=over,
        tension_model=first.tension_model if tension_model is None else tension_model,
        points=tuple(points),
    )


def sweep_record(sweep: Sweep) -> dict[str, object]:
    """A sweep, fit for strict JSON."""
    return {
        "study": sweep.study.name,
        "kind": sweep.kind.value,
        "orientations": sweep.over.value,
        "tension_model": sweep.tension_model.value,
        "keys": {axis.key: list(axis.values) for axis in sweep.axes},
        "best": _point_record(sweep, sweep.best),
        "points": [_point_record(sweep, point) for point in sweep.points],
    }


def _point_record(sweep: Sweep, point: SweepPoint) -> dict[str, object]:
    values = dict(zip((axis.key for axis in sweep.axes), point.values, strict=True))
    return {"values": values} | {name: getattr(point, name) for name in COLUMNS}


def _built(build: Callable[[Mapping[str, object]], Study], changed: Mapping[str, object]) -> Study:
    try:
        return build(changed)
    except InvalidStudy as error:
        where = ", ".join(f"{key}={value}" for key, value in changed.items())
        raise InvalidStudy(f"the study does not hold at {where}", error.problems) from error


def _point(
    study: Study,
    values: tuple[int | float, ...],
    kind: WorkspaceKind,
    over: OrientationRule,
    tension_model: TensionModel | None,
) -> SweepPoint:
    found = evaluate_workspace(study, kind=kind, over=over, tension_model=tension_model, explain=False)
    least, most = (None, None) if found.interval is None else found.interval
    return SweepPoint(
        values=values,
        poses=found.poses,
        feasible_poses=found.feasible_poses,
        feasible_percent=rounded(found.feasible_percent),
        measure=rounded(found.measure),
        measure_unit=found.unit,
        measure_least=rounded(least),
        measure_most=rounded(most),
        singular_poses=found.singular_poses,
        too_near_poses=found.too_near_poses,
        connected_percent=rounded(found.connected_percent),
    )
