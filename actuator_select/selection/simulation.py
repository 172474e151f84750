"""One actuator along one straight line: histories, peaks, and what exceeds which limit, when, by how much."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from actuator_select.database import Catalogue
from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.actuation import Check, is_applicable
from actuator_select.model.arrays import FloatArray
from actuator_select.model.exceedance import Exceedance, exceedances, peaks, with_peaks
from actuator_select.model.kinematics import LEAST_CABLE_LENGTH, least_cable_lengths
from actuator_select.model.tension import TensionModel
from actuator_select.model.trajectory import (
    DriveHistory,
    DrivenMove,
    LineMove,
    TorqueTest,
    instants,
    shaft_limits,
    torque_test,
    trapezoidal_profile,
)
from actuator_select.selection.assumptions import assumption_keys, why_no_voltage
from actuator_select.selection.candidates import Candidates, find_actuator
from actuator_select.study import Study
from actuator_select.study.refusals import line_problems

if TYPE_CHECKING:
    import pandas as pd

INSTANTS_PER_PHASE = 401  # for curves
NEGATIVE_TENSION_TOLERANCE = 1e-9  # relative to the largest tension of the move

UNITS = {Check.SPEED: "rad/s", Check.TORQUE: "N m", Check.ACCELERATION: "rad/s²", Check.VOLTAGE: "V"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Simulation:
    """A simulated move.

    Attributes
    ----------
    study : Study
        Robot and payload.
    candidates : Candidates
        The one actuator.
    move : LineMove
        The motion.
    history : DriveHistory
        Over time, per cable.
    limits : dict of Check to float
        At the shaft behind the gearbox; NaN where unknown or not applicable. [rad/s, N m, rad/s², V]
    peaks, peak_times : dict of Check to (m,) array
        Largest magnitude per cable over the whole move, and when; not only over the instants of `history`.
    exceedances : tuple of Exceedance
        In the order of time.
    together : tuple of Exceedance
        Where load and rotor torque together exceed the torque limit, in the order of time; of these, only where the
        torque test is of the load alone.
    """

    study: Study
    candidates: Candidates
    move: LineMove
    history: DriveHistory
    limits: dict[Check, float]
    peaks: dict[Check, FloatArray]
    peak_times: dict[Check, FloatArray]
    exceedances: tuple[Exceedance, ...]
    together: tuple[Exceedance, ...]

    @property
    def duration(self) -> float:
        """Of the move. [s]"""
        return float(self.move.profile.corners[-1])

    @property
    def checks(self) -> tuple[Check, ...]:
        """Checks that apply to this actuator."""
        return tuple(check for check in Check if is_applicable(self.candidates.actuators, check)[0])

    @property
    def not_applicable(self) -> dict[Check, str]:
        """Checks that do not apply to this actuator, with the reason."""
        return {check: why_no_voltage(self.candidates.rows[0]) for check in Check if check not in self.checks}

    @property
    def missing(self) -> dict[Check, tuple[str, ...]]:
        """Checks that could not be evaluated, with the figures that they lack."""
        lacking = {check: self.candidates.missing(check, TensionModel.PSEUDO_INVERSE)[0] for check in Check}
        if self.history.torque_test is TorqueTest.LOAD_AND_ROTOR:
            # What rankings call the acceleration check under such a model is the torque check here.
            lacking[Check.TORQUE] = self.candidates.missing(Check.ACCELERATION, self.study.tension_model)[0]
        return {check: figures for check, figures in lacking.items() if figures}

    @property
    def assumable(self) -> dict[str, str]:
        """Figures that the study may assume of this actuator where they are unknown, with the key that does so."""
        return assumption_keys(self.candidates.rows[0])

    @property
    def unheld(self) -> tuple[tuple[float, float], ...]:
        """Stretches of time in which no tensions within their bounds hold the platform, by the instants. [s]"""
        infeasible, times = self.history.infeasible, self.history.times
        edges = np.flatnonzero(np.diff(np.concatenate([[False], infeasible, [False]]).astype(np.int8)))
        return tuple(
            (float(times[first]), float(times[behind - 1]))
            for first, behind in zip(edges[::2], edges[1::2], strict=True)
        )

    @property
    def glossed_over(self) -> list[str]:
        """What the tension model glosses over during the move, for people."""
        shares = (
            (self.history.rank_deficient, "the structure matrix is short of rank"),
            (self.history.unbalanced, "the pseudo-inverse leaves part of the required wrench unbalanced"),
        )
        found = [
            f"during {'all' if where.all() else 'part'} of this move {what}." for where, what in shares if where.any()
        ]
        least = least_cable_lengths(self.study.robot, self.move.start, self.move.stop, self.move.orientation)
        if (least < self.study.robot.bounds.length_min).any():
            found.append(
                "this move comes nearer to an anchor than cables.length_min_m; rankings set such positions apart."
            )
        return found

    @property
    def pushing(self) -> list[int]:
        """Cables, from 1, whose tension becomes negative."""
        tension = self.history.tension
        tolerance = NEGATIVE_TENSION_TOLERANCE * np.nanmax(np.abs(tension), initial=0.0)
        return [int(cable) + 1 for cable in np.flatnonzero((tension < -tolerance).any(axis=0))]

    def frame(self) -> "pd.DataFrame":
        """Histories as a table: time, and what every actuator does and meets.

        Speed, acceleration, torque of the load and of load and rotor, voltage if it applies, tension.
        """
        import pandas as pd

        columns = {"time_s": self.history.times}
        for index in range(self.history.tension.shape[1]):
            number = index + 1
            columns[f"speed_{number}_rad_per_s"] = self.history.speed[:, index]
            columns[f"acceleration_{number}_rad_per_s2"] = self.history.acceleration[:, index]
            columns[f"torque_{number}_nm"] = self.history.torque[:, index]
            columns[f"total_torque_{number}_nm"] = self.history.total_torque[:, index]
            if Check.VOLTAGE in self.checks:
                columns[f"voltage_{number}_v"] = self.history.voltage[:, index]
            columns[f"tension_{number}_n"] = self.history.tension[:, index]
        return pd.DataFrame(columns)


def simulate(
    study: Study,
    catalogue: Catalogue,
    actuator: str,
    *,
    start: Sequence[float],
    stop: Sequence[float],
    orientation: Sequence[float] = (0.0, 0.0, 0.0),
) -> Simulation:
    """Drive one actuator type along a straight line with a trapezoidal speed profile.

    The move carries the first load of the study, external forces and moments in the middle of their range.

    Parameters
    ----------
    study : Study
        Robot, payload, greatest speed and ramp times.
    catalogue : Catalogue
        Where the actuator is.
    actuator : str
        Its id or name.
    start, stop : sequence of three float
        Ends of the line. [m]
    orientation : sequence of three float
        Angles ψ, θ, φ, constant over the move. [rad]

    Returns
    -------
    Simulation
        Arrays, and a DataFrame by ``.frame()``.

    Raises
    ------
    UnknownName
        If there is no such actuator.
    InvalidInput
        If the line has no length or passes through an anchor.

    References
    ----------
    Section 3.1.3 and figure 6 of Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.

    Examples
    --------
    >>> ends = {"start": (0.153, 0.153, -0.153), "stop": (3.047, 0.153, -0.153)}
    >>> with open_catalogue() as catalogue:
    ...     run = simulate(load_study("cpr8"), catalogue, "Actuator 1", **ends, orientation=(0.5, 0.5, 0.5))
    >>> sorted({exceedance.actuator for exceedance in run.exceedances if exceedance.check == "torque"})
    [1, 3, 8]
    """
    candidate = find_actuator(catalogue, actuator, study.table.assumptions)
    return simulate_candidate(study, candidate, start, stop, orientation)


def simulate_candidate(
    study: Study,
    candidate: Candidates,
    start: Sequence[float],
    stop: Sequence[float],
    orientation: Sequence[float],
    *,
    place: str = "--from/--to",
) -> Simulation:
    """As `simulate`, for an actuator at hand; `place` names the line in messages."""
    move = _line_move(study, start, stop, orientation, place)
    driven = DrivenMove(
        robot=study.robot,
        wrench=study.wrench(move.orientation),
        tension_model=study.tension_model,
        move=move,
        actuator=candidate.actuators,
        torque_test=torque_test(study.tension_model),
    )
    if least_cable_lengths(study.robot, move.start, move.stop, move.orientation).min() < LEAST_CABLE_LENGTH:
        problem = Problem(
            place=place,
            value="the line touches a frame anchor, where a cable has no direction",
            expected="a line that keeps off the anchors [m]",
        )
        raise InvalidInput("the move cannot be simulated", [problem])
    history = driven.history(*instants(move.profile, INSTANTS_PER_PHASE))
    closer = with_peaks(driven, history)
    found = {check: peaks(closer, check) for check in Check}
    return Simulation(
        study=study,
        candidates=candidate,
        move=move,
        history=history,
        limits=shaft_limits(candidate.actuators),
        peaks={check: height for check, (height, _) in found.items()},
        peak_times={check: time for check, (_, time) in found.items()},
        exceedances=exceedances(driven, closer),
        together=_together(driven) if driven.torque_test is TorqueTest.LOAD else (),
    )


def _together(driven: DrivenMove) -> tuple[Exceedance, ...]:
    """Where the sum of eqs. 32 and 33 exceeds the torque limit, though they test its parts apart."""
    summed = replace(driven, torque_test=TorqueTest.LOAD_AND_ROTOR)
    closer = with_peaks(summed, summed.history(*instants(summed.move.profile, INSTANTS_PER_PHASE)))
    return tuple(one for one in exceedances(summed, closer) if one.check is Check.TORQUE)


def _line_move(
    study: Study, start: Sequence[float], stop: Sequence[float], orientation: Sequence[float], place: str
) -> LineMove:
    ends = np.array([start, stop], dtype=np.float64)
    angles = np.array(orientation, dtype=np.float64)
    if not (np.isfinite(ends).all() and np.isfinite(angles).all()):
        raise InvalidInput(
            "the move cannot be simulated",
            [Problem(place=place, value="a coordinate is not finite", expected="finite numbers [m], [rad]")],
        )
    distance = float(np.linalg.norm(ends[1] - ends[0]))
    if distance == 0.0:
        raise InvalidInput(
            "the move cannot be simulated",
            [Problem(place=place, value="start and end are the same", expected="another position [m]")],
        )
    if problems := line_problems(study, ends, orientation, place):
        raise InvalidInput("the move cannot be simulated", problems)
    motion = study.table.motion
    if motion.speed_max_m_per_s is None or motion.acceleration_time_s is None or motion.deceleration_time_s is None:
        raise InvalidInput(
            "the move cannot be simulated",
            [
                Problem(
                    place="motion",
                    value="has no speed profile",
                    expected="speed_max_m_per_s, acceleration_time_s and deceleration_time_s [m/s, s, s]",
                )
            ],
        )
    profile = trapezoidal_profile(
        distance, motion.speed_max_m_per_s, motion.acceleration_time_s, motion.deceleration_time_s
    )
    return LineMove(start=ends[0], stop=ends[1], orientation=angles, profile=profile, centripetal=motion.centripetal)
