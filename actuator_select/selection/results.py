"""What a ranking says: verdicts of checks and of actuators, the evaluation that they rest on, and the whole."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.evaluation import Evaluation
from actuator_select.model.ranking import State, Verdict, meets_share
from actuator_select.selection.assumptions import Assumed
from actuator_select.selection.candidates import Candidates
from actuator_select.selection.cautions import Warned
from actuator_select.selection.part_limits import Exceeded
from actuator_select.study import Study

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckVerdict:
    """One check of one actuator.

    Attributes
    ----------
    state : State
        `PASSED` when this limit alone leaves the required share of the positions.
    poses : int or None
        Positions at which this limit alone holds; None where it was not evaluated.
    worst_utilisation : float or None
        Largest demand over limit.
    margin : float or None
        What is left of the limit at the worst, as a share of it; negative where it is exceeded.
    worst_position : tuple of float or None
        Where that is. [m]
    missing : tuple of str
        Figures that are unknown.
    assumable : mapping of str to str
        Those of them that the study may assume of this actuator, with the key that does so.
    reason : str
        Why a check that the study asks for does not apply to this actuator; else empty.
    """

    state: State
    poses: int | None = None
    worst_utilisation: float | None = None
    worst_position: tuple[float, float, float] | None = None
    missing: tuple[str, ...] = ()
    assumable: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""

    @property
    def margin(self) -> float | None:
        """1 - worst utilisation."""
        return None if self.worst_utilisation is None else 1.0 - self.worst_utilisation


@dataclass(frozen=True, slots=True, kw_only=True)
class RankedActuator:
    """One actuator's place in the ranking.

    Attributes
    ----------
    index : int
        Index into the candidates.
    id, name : str
        Of the catalogue row.
    verdict : Verdict
        Against the requirement.
    feasible_poses : int
        Positions at which every check holds at every orientation and with every load; where a check was not
        evaluated, at most so many. Under a model with bounded tensions by the safe rule: at least so many.
    feasible_percent : float
        The same as a share of all positions.
    checks : dict of Check to CheckVerdict
        All four; `NOT_APPLICABLE` where the study does not ask for a check, or it says nothing about this actuator.
    exact_poses : int or None
        Positions by the exact joint test; None where it was not made.
    connected_percent : float or None
        Share of these positions that is connected to the home position; None where it was not looked for. [%]
    missed : tuple of str
        Places of `requirement.must_serve` that are not served, or not known to be.
    assumptions : tuple of Assumed
        What was taken for figures that the catalogue does not state.
    left_out : tuple of str
        What the inertia leaves out, because neither catalogue nor study states it.
    exceeded : tuple of Exceeded
        Stated limits of gearbox and winch beyond which the demand is; no check and no verdict holds them.
    """

    index: int
    id: str
    name: str
    verdict: Verdict
    feasible_poses: int
    feasible_percent: float
    checks: dict[Check, CheckVerdict]
    exact_poses: int | None = None
    connected_percent: float | None = None
    missed: tuple[str, ...] = ()
    assumptions: tuple[Assumed, ...] = ()
    left_out: tuple[str, ...] = ()
    exceeded: tuple[Exceeded, ...] = ()

    @property
    def is_upper_bound(self) -> bool:
        """Whether a check was not evaluated, or none applies, so that the share is known from above only."""
        return self.limiting_check is None or any(
            verdict.state is State.NOT_EVALUATED for verdict in self.checks.values()
        )

    @property
    def limiting_check(self) -> Check | None:
        """The evaluated check that leaves the fewest positions; at a tie, the one exceeded most."""
        evaluated = [
            (verdict.poses, -verdict.worst_utilisation, check)
            for check, verdict in self.checks.items()
            if verdict.poses is not None and verdict.worst_utilisation is not None
        ]
        return min(evaluated)[2] if evaluated else None


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyEvaluation:
    """Candidates held against a study.

    Attributes
    ----------
    study : Study
        What was asked.
    candidates : Candidates
        Who was asked.
    evaluation : Evaluation
        Arrays: the demand of every pose and cable, the counts of every actuator.
    counted : (n,) array
        Indices of the study's positions that count: all but those too near to an anchor.
    """

    study: Study
    candidates: Candidates
    evaluation: Evaluation
    counted: IntArray

    @property
    def poses(self) -> int:
        """Positions that count."""
        return len(self.counted)

    def spread(self, values: FloatArray, fill: float = np.nan) -> FloatArray:
        """Values of the positions that count, (n,), at all positions of the study, (P,); `fill` elsewhere."""
        result = np.full(len(self.study.positions), fill)
        result[self.counted] = values
        return result

    def frame(self) -> "pd.DataFrame":
        """Counts as a table: one row per actuator, positions in total, jointly feasible, and per check."""
        import pandas as pd

        columns: dict[str, object] = {
            "name": self.candidates.names,
            "poses": self.poses,
            "feasible_poses": self.evaluation.positions,
        }
        for check, count in self.evaluation.checks.items():
            columns[f"{check.value}_poses"] = np.where(count.evaluated, count.positions, np.nan)
            columns[f"{check.value}_worst_utilisation"] = count.worst_utilisation
        return pd.DataFrame(columns, index=pd.Index(self.candidates.ids, name="id"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Selection:
    """A ranking.

    Attributes
    ----------
    result : StudyEvaluation
        Study, candidates and arrays.
    required_percent : float
        Share of the positions that an actuator has to serve.
    ranked : tuple of RankedActuator
        Best first.
    warnings : tuple of Warned
        What the percentages rest on.
    fingerprint : str
        Of the catalogue's content.
    where : str
        Condition on the candidates beside the study's own.
    unattainable_places : tuple of str
        Places of `requirement.must_serve` that no drive could serve.
    """

    result: StudyEvaluation
    required_percent: float
    ranked: tuple[RankedActuator, ...]
    warnings: tuple[Warned, ...]
    fingerprint: str
    where: str = ""
    unattainable_places: tuple[str, ...] = ()

    @property
    def study(self) -> Study:
        """What was asked."""
        return self.result.study

    @property
    def poses(self) -> int:
        """Positions that count."""
        return self.result.poses

    @property
    def attainable_poses(self) -> int:
        """Positions that a drive without limits could serve."""
        return int(self.result.evaluation.demand.attainable_positions.sum())

    @property
    def attainable_percent(self) -> float:
        """The same as a share of the positions that count."""
        return 100.0 * self.attainable_poses / self.poses

    @property
    def robot_falls_short(self) -> bool:
        """Whether no drive at all could meet the requirement, so that the robot has to change."""
        enough = meets_share(np.array(self.attainable_poses), self.poses, self.required_percent)
        return not enough or bool(self.unattainable_places)

    def shown(self, *, only_meeting: bool = False) -> tuple[RankedActuator, ...]:
        """Actuators, best first; only those that meet the requirement if so asked."""
        return tuple(actuator for actuator in self.ranked if not only_meeting or actuator.verdict is Verdict.MEETS)

    def frame(self) -> "pd.DataFrame":
        """Ranking as a table: one row per actuator, best first, with the state and the counts of every check."""
        table = self.result.frame().loc[[actuator.id for actuator in self.ranked]]
        table.insert(1, "verdict", [actuator.verdict.value for actuator in self.ranked])
        table.insert(2, "feasible_percent", [actuator.feasible_percent for actuator in self.ranked])
        for check in self.study.checks:
            before = list(table.columns).index(f"{check.value}_poses")
            table.insert(before, f"{check.value}_state", [one.checks[check].state.value for one in self.ranked])
        return table
