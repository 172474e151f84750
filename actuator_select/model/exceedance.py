"""When a driven move exceeds a limit, and by how much: peaks and crossings found between the instants too."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.actuation import ROUNDING, Check
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.trajectory import DriveHistory, DrivenMove, shaft_limits

ZOOMS = 3  # rounds of looking closer at every local maximum
ZOOM = 16  # times closer in each
NEAR = 0.95  # of a limit or of a curve's largest; lower maxima between dense instants decide nothing
FLAT = 1e-9  # of a curve's largest; smaller differences are rounding
TIME_TOLERANCE = 1e-9  # s, of a crossing


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


def with_peaks(driven: DrivenMove, history: DriveHistory) -> DriveHistory:
    """Add instants around the local maxima of every magnitude, ever closer to them.

    Parameters
    ----------
    driven : DrivenMove
        The move.
    history : DriveHistory
        At instants dense enough to show every maximum.

    Returns
    -------
    DriveHistory
        At those instants and more, in the order of time.
    """
    limits = shaft_limits(driven.actuator)
    for _ in range(ZOOMS):
        at = _local_maxima(history, limits)
        times, phases = history.times, history.phases
        before, after = np.maximum(at - 1, 0), np.minimum(at + 1, len(times) - 1)
        low = np.where(phases[before] == phases[at], times[before], times[at])
        high = np.where(phases[after] == phases[at], times[after], times[at])
        share = np.linspace(0.0, 1.0, 2 * ZOOM + 1)[1:-1]
        closer = (low + (high - low) * share[:, None]).ravel()
        instants = np.unique(
            np.column_stack(
                [np.concatenate([phases, np.tile(phases[at], len(share))]), np.concatenate([times, closer])]
            ),
            axis=0,
        )
        history = driven.history(instants[:, 1], instants[:, 0].astype(np.int64))
    return history


def _local_maxima(history: DriveHistory, limits: dict[Check, float]) -> IntArray:
    """Indices of the local maxima that decide something: near a limit, or near the largest of their curve."""
    found = np.zeros(len(history.times), dtype=np.bool_)
    same = (history.phases[1:] == history.phases[:-1])[:, None]
    for check in Check:
        values = np.nan_to_num(np.abs(history.of(check)))  # infeasible instants have no value
        edge = np.ones((1, values.shape[1]), dtype=np.bool_)
        # A rise within rounding is none: a cable along the move has flat histories, all of whose points would count.
        flat = FLAT * values.max(axis=0)
        above_before = np.vstack([edge, (values[1:] > values[:-1] + flat) | ~same])
        no_less_than_after = np.vstack([(values[:-1] >= values[1:]) | ~same, edge])
        decides = (values >= NEAR * limits[check]) | (values >= NEAR * values.max(axis=0))
        found |= (above_before & no_less_than_after & decides).any(axis=1)
    return np.flatnonzero(found)


def peaks(history: DriveHistory, check: Check) -> tuple[FloatArray, FloatArray]:
    """Largest magnitude per cable and when, two (m,) arrays; NaN where a figure is unknown."""
    values = np.abs(history.of(check))
    if np.isnan(values).all(axis=0).any():
        unknown = np.full(values.shape[1], np.nan)
        return unknown, unknown
    at = np.nanargmax(values, axis=0)  # infeasible instants have none
    return values[at, np.arange(values.shape[1])], history.times[at]


def exceedances(driven: DrivenMove, history: DriveHistory) -> tuple[Exceedance, ...]:
    """Stretches of time in which an actuator is over a limit that is known.

    Parameters
    ----------
    driven : DrivenMove
        The move.
    history : DriveHistory
        As `with_peaks` returns it.

    Returns
    -------
    tuple of Exceedance
        In the order of time.
    """
    limits = shaft_limits(driven.actuator)
    found = []
    for check in Check:
        over = np.abs(history.of(check)) > limits[check] * (1.0 + ROUNDING)  # comparisons with NaN are False
        for cable in np.flatnonzero(over.any(axis=0)):
            found += _stretches(driven, history, check, int(cable), over[:, cable], limits[check])
    return tuple(sorted(found, key=lambda one: (one.start, one.actuator, one.check)))


def _stretches(
    driven: DrivenMove, history: DriveHistory, check: Check, cable: int, over: BoolArray, limit: float
) -> list[Exceedance]:
    values = np.abs(history.of(check)[:, cable])
    edges = np.flatnonzero(np.diff(np.concatenate([[False], over, [False]]).astype(np.int8)))
    return [
        Exceedance(
            actuator=cable + 1,
            check=check,
            start=_crossing(driven, history, check, cable, limit, int(first) - 1),
            stop=_crossing(driven, history, check, cable, limit, int(behind) - 1),
            worst=float(np.nanmax(values[first:behind])),
            limit=limit,
        )
        for first, behind in zip(edges[::2], edges[1::2], strict=True)
    ]


def _crossing(driven: DrivenMove, history: DriveHistory, check: Check, cable: int, limit: float, left: int) -> float:
    """When the limit is crossed between an instant and the next; a jump at a corner crosses it at the corner."""
    from scipy.optimize import brentq

    if left < 0:
        return float(history.times[0])
    if left + 1 >= len(history.times):
        return float(history.times[-1])
    phase, start, stop = history.phases[left], history.times[left], history.times[left + 1]
    if history.phases[left + 1] != phase:
        return float(stop)

    def excess(time: float) -> float:
        here = driven.history(np.array([time]), np.array([phase]))
        return float(np.abs(here.of(check)[0, cable])) - limit

    before, after = excess(start), excess(stop)
    if np.isnan(before) or np.isnan(after):  # on one side no tensions hold the platform, so that nothing is crossed
        return float(start if np.isnan(after) else stop)
    if before * after > 0.0:  # both ends on one side but for rounding
        return float(start)
    return float(brentq(excess, start, stop, xtol=TIME_TOLERANCE))
