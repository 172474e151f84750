"""Compiled counting of the voltage limit, for problems of many actuators and many positions.

At one position the largest demand H(m) + damping · speed is convex in the reflected mass m, being a maximum of linear
functions of it. Tabulated at a few masses, its chords bound it from above and its extended chords from below; only
where limit or running maximum lie between the two bounds is a position evaluated cable by cable.

Loaded only when `voltage_count.VoltageCounter` asks for it: importing it costs seconds the first time and a fraction
of a second later, because the compiled code is kept in the user's cache folder.
"""

import os
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np

from actuator_select._resources import writable_cache_dir
from actuator_select.model.actuation import VoltageLine
from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.voltage import VoltageDemand, VoltageTally

os.environ.setdefault("NUMBA_CACHE_DIR", str(writable_cache_dir("kernels")))
from numba import njit  # reads its cache folder when it is imported

KNOTS = 48  # masses at which the bounds are tabulated; more are tighter and cost as many evaluations per position
KNOT_SPACING = 1e-6  # relative to the greatest mass; far above rounding, far below what bounds need
SMALLEST_MASS = 1e-9  # kg; keeps the spacing above zero where every rotor is without inertia
DOUBT = 1e-9  # relative; a lower bound rejects only where it exceeds the limit by more than its own rounding
POSITIONS_AT_ONCE = 512  # positions whose bounds stay in a core's cache while all actuators pass over them


def count(rows: VoltageDemand, line: VoltageLine, passes: BoolArray, tally: VoltageTally) -> None:
    """As `voltage_count.count_with_numpy`, on every core.

    Parameters
    ----------
    rows, line, passes, tally
        As there; velocities not sampled with the centripetal term.
    """
    table = _pack(rows)
    rates = np.maximum(rows.speed_in, rows.speed_out).max(axis=1), rows.speed_in.min(axis=1)
    knots = _knots(line.reflected_mass)
    interval = np.clip(np.searchsorted(knots, line.reflected_mass, side="right") - 1, 0, len(knots) - 2)
    upper, lower = np.empty((len(knots), len(table))), np.empty((len(knots), len(table)))
    workers = os.cpu_count() or 1

    def tabulate(part: slice) -> None:
        _tabulate(table[part], knots, rows.speed, upper[:, part], lower[:, part])

    def work(part: slice) -> None:
        _count(
            table,
            upper,
            lower,
            *rates,
            knots,
            rows.speed,
            line.reflected_mass[part],
            line.damping[part],
            interval[part],
            passes[part],
            tally.limit[part],
            tally.alone[part],
            tally.worst[part],
            tally.worst_position[part],
        )

    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(tabulate, _parts(len(table), workers)))
        list(pool.map(work, _parts(len(tally.limit), workers)))


def _parts(count: int, workers: int) -> list[slice]:
    edges = np.linspace(0, count, workers + 1).astype(int)
    return [slice(start, stop) for start, stop in pairwise(edges) if stop > start]


def _knots(masses: FloatArray) -> FloatArray:
    """Masses for the table: at least two, the least and the greatest among them, none close to another.

    Between masses that differ by rounding alone, a chord's slope would be rounding noise over almost nothing.
    """
    spacing = KNOT_SPACING * max(float(masses.max()), SMALLEST_MASS)
    least, greatest = float(masses.min()), float(masses.max())
    inner = np.unique(np.round(np.quantile(masses, np.linspace(0.0, 1.0, KNOTS)) / spacing)) * spacing
    inner = inner[(inner > least + spacing) & (inner < greatest - spacing)]
    return np.concatenate([[least], inner, [max(greatest, least + spacing)]])


def _pack(rows: VoltageDemand) -> FloatArray:
    """One contiguous block per position, (P, 15, k)."""
    length = np.divide(
        1.0, rows.inverse_length, out=np.zeros_like(rows.inverse_length), where=rows.inverse_length > 0.0
    )
    return np.stack(
        [
            rows.force,
            rows.acceleration,
            *np.moveaxis(rows.force_reach, -1, 0),
            *np.moveaxis(rows.acceleration_reach, -1, 0),
            rows.speed_in,
            rows.speed_out,
            rows.inverse_length,
            length,
            rows.force_extra,
            rows.acceleration_extra,
            rows.least_swing,
        ],
        axis=1,
    )


@njit(cache=True, nogil=True)
def _worst(row, speed, mass, damping):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
    """Largest demand of one position on one actuator: `VoltageDemand.worst`, cable by cable."""
    worst = -np.inf
    scale = mass * speed * speed
    quarter = damping * damping / (4.0 * mass) if mass > 0.0 else 0.0
    for cable in range(row.shape[1]):
        reach = (
            abs(row[2, cable] + mass * row[5, cable])
            + abs(row[3, cable] + mass * row[6, cable])
            + abs(row[4, cable] + mass * row[7, cable])
            + row[12, cable]
            + mass * row[13, cable]
        )
        middle = row[0, cable] + mass * row[1, cable]
        up = damping * row[8, cable] - mass * row[14, cable] + middle
        edge = damping * row[9, cable] + mass * row[14, cable]
        peak = scale * row[10, cable] + quarter * row[11, cable]
        down = (peak if damping < 2.0 * mass * row[9, cable] * row[10, cable] else edge) - middle
        worst = max(worst, reach + max(up, down))
    return worst


@njit(cache=True, nogil=True)
def _tabulate(table, knots, speed, upper, lower):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
    """Demand without the damping term at every knot: of both sides (above), of winding in alone (below)."""
    for position in range(len(table)):
        row = table[position]
        for knot in range(len(knots)):
            mass = knots[knot]
            both, winding_in = -np.inf, -np.inf
            for cable in range(row.shape[1]):
                reach = (
                    abs(row[2, cable] + mass * row[5, cable])
                    + abs(row[3, cable] + mass * row[6, cable])
                    + abs(row[4, cable] + mass * row[7, cable])
                    + row[12, cable]
                    + mass * row[13, cable]
                )
                middle = row[0, cable] + mass * row[1, cable]
                winding_in = max(winding_in, middle + reach - mass * row[14, cable])
                both = max(both, reach - middle + mass * speed * speed * row[10, cable])
            upper[knot, position] = max(both, winding_in)
            lower[knot, position] = winding_in


@njit(cache=True, nogil=True)
def _count(  # type: ignore[no-untyped-def]  # noqa: ANN202, C901, PLR0913, PLR0917 - a kernel takes plain arrays
    table,  # noqa: ANN001
    upper,  # noqa: ANN001
    lower,  # noqa: ANN001
    fastest,  # noqa: ANN001
    slowest,  # noqa: ANN001
    knots,  # noqa: ANN001
    speed,  # noqa: ANN001
    masses,  # noqa: ANN001
    dampings,  # noqa: ANN001
    interval,  # noqa: ANN001
    passes,  # noqa: ANN001
    limits,  # noqa: ANN001
    alone,  # noqa: ANN001
    worst,  # noqa: ANN001
    where,  # noqa: ANN001
):
    last = len(knots) - 1
    for start in range(0, len(table), POSITIONS_AT_ONCE):
        stop = min(start + POSITIONS_AT_ONCE, len(table))
        for actuator in range(len(limits)):
            mass, damping, limit, below = masses[actuator], dampings[actuator], limits[actuator], interval[actuator]
            share = (mass - knots[below]) / (knots[below + 1] - knots[below])
            # Extended chords of the neighbouring intervals; at the table's ends the chord that is missing counts 0.
            before, after = max(below - 1, 0), min(below + 2, last)
            left = (mass - knots[below]) / (knots[below] - knots[before]) if before < below else 0.0
            right = (knots[below + 1] - mass) / (knots[after] - knots[below + 1]) if after > below + 1 else 0.0
            largest, holding = worst[actuator], 0
            for position in range(start, stop):
                base = upper[below, position]
                above = damping * fastest[position] + base + share * (upper[below + 1, position] - base)
                if above <= largest:
                    if above <= limit and above < np.inf:
                        holding += 1
                        continue
                    beneath = -np.inf
                    if before < below:
                        beneath = lower[below, position] + left * (lower[below, position] - lower[before, position])
                    if after > below + 1:
                        beneath = max(
                            beneath,
                            lower[below + 1, position] - right * (lower[after, position] - lower[below + 1, position]),
                        )
                    if beneath + damping * slowest[position] > limit + DOUBT * abs(above):
                        passes[actuator, position] = False
                        continue
                demand = _worst(table[position], speed, mass, damping)
                if largest < demand < np.inf:  # what no drive could serve is nobody's worst
                    largest = demand
                    where[actuator] = position
                if demand <= limit and demand < np.inf:
                    holding += 1
                else:
                    passes[actuator, position] = False
            worst[actuator] = largest
            alone[actuator] += holding
