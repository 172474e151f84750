"""One actuator along one straight line: histories, peaks, and what exceeds which limit, when, by how much."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from actuator_select.database import Catalogue
from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray
from actuator_select.model.evaluation import ROUNDING
from actuator_select.model.trajectory import (
    DriveHistory,
    LineMove,
    drive_history,
    instants,
    shaft_limits,
    trapezoidal_profile,
)
from actuator_select.selection.candidates import Candidates, find_actuator
from actuator_select.study import Study

if TYPE_CHECKING:
    import pandas as pd

INSTANTS_PER_PHASE = 401  # for curves
ZOOM = 101  # instants between two neighbours of a peak, for its height
NEGATIVE_TENSION_TOLERANCE = 1e-9  # relative to the largest tension of the move

UNITS = {Check.SPEED: "rad/s", Check.TORQUE: "N m", Check.ACCELERATION: "rad/s²", Check.VOLTAGE: "V"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Exceedance:
    """One actuator over one limit for one stretch of time.

    Attributes
    ----------
    actuator : int
        Cable number, from 1.
    check : Check
        The limit.
    start, stop : float
        When. [s]
    worst, limit : float
        Largest magnitude in the stretch, and the limit, at the shaft behind the gearbox.
    """

    actuator: int
    check: Check
    start: float
    stop: float
    worst: float
    limit: float


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
        At the shaft behind the gearbox; NaN where unknown. [rad/s, N m, rad/s², V]
    peaks, peak_times : dict of Check to (m,) array
        Largest magnitude per cable over the whole move, and when; not only over the instants of `history`.
    exceedances : tuple of Exceedance
        In the order of time.
    """

    study: Study
    candidates: Candidates
    move: LineMove
    history: DriveHistory
    limits: dict[Check, float]
    peaks: dict[Check, FloatArray]
    peak_times: dict[Check, FloatArray]
    exceedances: tuple[Exceedance, ...]

    @property
    def duration(self) -> float:
        """Of the move. [s]"""
        return float(self.move.profile.corners[-1])

    @property
    def pushing(self) -> list[int]:
        """Cables, from 1, whose tension becomes negative."""
        tension = self.history.tension
        tolerance = NEGATIVE_TENSION_TOLERANCE * np.abs(tension).max()
        return [int(cable) + 1 for cable in np.flatnonzero((tension < -tolerance).any(axis=0))]

    def frame(self) -> "pd.DataFrame":
        """Histories as a table: time, and per actuator speed, acceleration, torque, voltage and tension."""
        import pandas as pd

        columns = {"time_s": self.history.times}
        for index in range(self.history.tension.shape[1]):
            number = index + 1
            columns[f"speed_{number}_rad_per_s"] = self.history.speed[:, index]
            columns[f"acceleration_{number}_rad_per_s2"] = self.history.acceleration[:, index]
            columns[f"torque_{number}_nm"] = self.history.torque[:, index]
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
    return simulate_candidate(study, find_actuator(catalogue, actuator), start, stop, orientation)


def simulate_candidate(
    study: Study, candidate: Candidates, start: Sequence[float], stop: Sequence[float], orientation: Sequence[float]
) -> Simulation:
    """As `simulate`, for an actuator at hand."""
    move = _line_move(study, start, stop, orientation)
    actuator = candidate.actuators
    times, phases = instants(move.profile, INSTANTS_PER_PHASE)
    history = drive_history(study.robot, study.wrench, move, actuator, times, phases)
    if not np.isfinite(history.tension).all() or not np.isfinite(history.acceleration).all():
        problem = Problem(
            place="--from/--to",
            value="the line passes through a frame anchor",
            expected="a line that keeps off the anchors",
        )
        raise InvalidInput("the move cannot be simulated", [problem])
    limits = shaft_limits(actuator)
    peaks, peak_times = {}, {}
    for check in Check:
        peaks[check], peak_times[check] = _refined_peaks(study, move, candidate, history, check)
    exceedances = sorted(
        (
            one
            for check in Check
            for one in _exceedances(history, check, limits[check], peaks[check], peak_times[check])
        ),
        key=lambda one: (one.start, one.actuator, one.check),
    )
    return Simulation(
        study=study,
        candidates=candidate,
        move=move,
        history=history,
        limits=limits,
        peaks=peaks,
        peak_times=peak_times,
        exceedances=tuple(exceedances),
    )


def _line_move(study: Study, start: Sequence[float], stop: Sequence[float], orientation: Sequence[float]) -> LineMove:
    ends = np.array([start, stop], dtype=np.float64)
    angles = np.array(orientation, dtype=np.float64)
    if not (np.isfinite(ends).all() and np.isfinite(angles).all()):
        raise InvalidInput(
            "the move cannot be simulated",
            [Problem(place="the line", value="a coordinate is not finite", expected="finite numbers [m], [rad]")],
        )
    distance = float(np.linalg.norm(ends[1] - ends[0]))
    if distance == 0.0:
        raise InvalidInput(
            "the move cannot be simulated",
            [Problem(place="--to", value="equals --from", expected="another position [m]")],
        )
    motion = study.table.motion
    profile = trapezoidal_profile(
        distance, motion.speed_max_m_per_s, motion.acceleration_time_s, motion.deceleration_time_s
    )
    return LineMove(start=ends[0], stop=ends[1], orientation=angles, profile=profile, centripetal=motion.centripetal)


def _refined_peaks(
    study: Study, move: LineMove, candidate: Candidates, history: DriveHistory, check: Check
) -> tuple[FloatArray, FloatArray]:
    """Largest magnitude per cable and its time, looked at again between the instants beside it."""
    values = np.abs(history.of(check))
    if np.isnan(values).any():
        unknown = np.full(values.shape[1], np.nan)
        return unknown, unknown
    cables = np.arange(values.shape[1])
    at = values.argmax(axis=0)
    last = len(history.times) - 1
    peak_phase = history.phases[at]
    before, after = np.maximum(at - 1, 0), np.minimum(at + 1, last)
    before = np.where(history.phases[before] == peak_phase, before, at)
    after = np.where(history.phases[after] == peak_phase, after, at)
    times = np.linspace(history.times[before], history.times[after], ZOOM)  # (ZOOM, m)
    zoomed = drive_history(
        study.robot, study.wrench, move, candidate.actuators, times.ravel(), np.tile(peak_phase, ZOOM)
    )
    near = np.abs(zoomed.of(check)).reshape(ZOOM, len(cables), len(cables))[:, cables, cables]
    best = near.argmax(axis=0)
    return near[best, cables], times[best, cables]


def _exceedances(
    history: DriveHistory, check: Check, limit: float, peaks: FloatArray, peak_times: FloatArray
) -> list[Exceedance]:
    values = np.abs(history.of(check))
    if np.isnan(limit) or np.isnan(values).any():
        return []
    found = []
    over = values > limit * (1.0 + ROUNDING)
    for cable in np.flatnonzero(over.any(axis=0)):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], over[:, cable], [False]]).astype(np.int8)))
        for first, behind in zip(edges[::2], edges[1::2], strict=True):
            start = _crossing(history.times, values[:, cable], limit, first - 1, first)
            stop = _crossing(history.times, values[:, cable], limit, behind - 1, behind)
            inside = start <= peak_times[cable] <= stop
            worst = peaks[cable] if inside else values[first:behind, cable].max()
            found.append(
                Exceedance(
                    actuator=int(cable) + 1, check=check, start=start, stop=stop, worst=float(worst), limit=limit
                )
            )
    return found


def _crossing(times: FloatArray, values: FloatArray, limit: float, left: int, right: int) -> float:
    """When the limit is crossed between two neighbouring instants; at the ends of the move, the end."""
    if left < 0:
        return float(times[0])
    if right >= len(times):
        return float(times[-1])
    share = (limit - values[left]) / (values[right] - values[left])
    return float(times[left] + share * (times[right] - times[left]))
