"""Compiled hyperplane shifting, for many poses: `hyperplanes.minimax_by_numpy`, pose by pose on every core.

Loaded only when `feasibility` asks for it: importing it costs seconds the first time and a fraction of a second later,
because the compiled code is kept in the user's cache folder.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np

from actuator_select._resources import writable_cache_dir
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.hyperplanes import COLUMN_TOLERANCE, WRENCH_TOLERANCE, ColumnBounds, WrenchSets

os.environ.setdefault("NUMBA_CACHE_DIR", str(writable_cache_dir("kernels")))
from numba import njit  # reads its cache folder when it is imported

SURE_PIVOT = 1e-6  # least pivot over greatest; beyond it no singular value is near the rank tolerance of 1e-9


def minimax(
    columns: FloatArray, wrenches: WrenchSets, which: IntArray, shift: FloatArray, bounds: ColumnBounds
) -> tuple[FloatArray, FloatArray]:
    """As `hyperplanes.minimax_by_numpy`, on every core.

    Parameters
    ----------
    columns, wrenches, which, shift, bounds
        As there.

    Returns
    -------
    (q, G) array
        t*. [N]
    (q, G) array
        Margin. [N]
    """
    poses, sets = len(columns), wrenches.centre.shape[1]
    least, margin = np.empty((poses, sets)), np.empty((poses, sets))
    magnitude = wrenches.magnitude(np.arange(len(wrenches.centre)))
    # One contiguous column after the other.
    table = np.ascontiguousarray(columns.swapaxes(1, 2))
    norms = np.linalg.norm(table, axis=2)
    centre, segments, balls = map(np.ascontiguousarray, (wrenches.centre, wrenches.segments, wrenches.balls))
    shared = np.ascontiguousarray(bounds.shared)

    def work(part: slice) -> None:
        _shift(
            table[part],
            norms[part],
            centre,
            segments,
            balls,
            magnitude,
            np.ascontiguousarray(which[part], dtype=np.int64),
            np.ascontiguousarray(shift[part]),
            bounds.lower,
            bounds.upper,
            shared,
            least[part],
            margin[part],
        )

    _on_every_core(work, poses)
    return least, margin


def surely_of_full_rank(columns: FloatArray) -> BoolArray:
    """Tell the (q, n, M) matrices whose pivots leave no doubt about their full row rank, (q,)."""
    result = np.zeros(len(columns), dtype=np.bool_)
    table = np.ascontiguousarray(columns.swapaxes(1, 2))

    def work(part: slice) -> None:
        _pivots(table[part], SURE_PIVOT, result[part])

    _on_every_core(work, len(columns))
    return result


def _on_every_core(work: Callable[[slice], None], count: int) -> None:
    workers = os.cpu_count() or 1
    edges = np.linspace(0, count, workers + 1).astype(int)
    parts = [slice(start, stop) for start, stop in pairwise(edges) if stop > start]
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(work, parts))


@njit(cache=True, nogil=True)
def _pivots(table, least, sure):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202, C901, PLR0912
    """Column-pivoted Gram-Schmidt; `sure` where the last pivot is not small beside the first."""
    poses, count, rank = table.shape
    left = np.empty((count, rank))
    for pose in range(poses):
        sure[pose] = False
        if count < rank:
            continue
        left[:] = table[pose]
        first = 0.0
        for step in range(rank):
            best, largest = -1, 0.0
            for column in range(count):
                square = 0.0
                for row in range(rank):
                    square += left[column, row] ** 2
                if square > largest:
                    best, largest = column, square
            pivot = np.sqrt(largest)
            if step == 0:
                first = pivot
            if pivot <= least * first:
                break
            if step == rank - 1:
                sure[pose] = True
                break
            for column in range(count):
                if column == best:
                    continue
                product = 0.0
                for row in range(rank):
                    product += left[column, row] * left[best, row]
                product /= largest
                for row in range(rank):
                    left[column, row] -= product * left[best, row]
            left[best] = 0.0


@njit(cache=True, nogil=True)
def _reduce(basis, level, rank, vector, mirror):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
    """Basis of one level less the direction of `vector`, into the next level; see `hyperplanes._without`.

    Returns how much of the vector was left.
    """
    size = rank - level
    norm = 0.0
    for i in range(size):
        value = 0.0
        for k in range(rank):
            value += basis[level, i, k] * vector[k]
        mirror[i] = value
        norm += value * value
    norm = np.sqrt(norm)
    mirror[0] += norm if mirror[0] >= 0.0 else -norm
    square = 0.0
    for i in range(size):
        square += mirror[i] * mirror[i]
    scale = 2.0 / square if square > 0.0 else 0.0
    for k in range(rank):
        row = 0.0
        for i in range(size):
            row += mirror[i] * basis[level, i, k]
        row *= scale
        for i in range(1, size):
            basis[level + 1, i - 1, k] = basis[level, i, k] - mirror[i] * row
    return norm


@njit(cache=True, nogil=True)
def _level(excess, weights, caps, count, tolerance):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202, C901
    """Least τ with Σ weights · min(τ, caps) ≥ excess; see `hyperplanes._level`."""
    floor = 0.0
    while True:
        if excess <= tolerance:
            return floor
        total = 0.0
        for column in range(count):
            if weights[column] > 0.0 and caps[column] > floor:
                total += weights[column]
        if total <= 0.0:
            return np.inf
        level = excess / total
        highest = floor
        for column in range(count):
            if weights[column] > 0.0 and floor < caps[column] < level * (1.0 - WRENCH_TOLERANCE):
                highest = max(highest, caps[column])
        if highest == floor:
            return max(level, floor)
        for column in range(count):
            if weights[column] > 0.0 and floor < caps[column] < level * (1.0 - WRENCH_TOLERANCE):
                excess -= weights[column] * caps[column]
        floor = highest


@njit(cache=True, nogil=True)
def _shift(  # type: ignore[no-untyped-def]  # noqa: ANN202, C901, PLR0912, PLR0913, PLR0915, PLR0917 - a kernel takes plain arrays
    table,  # noqa: ANN001
    norms,  # noqa: ANN001
    centre,  # noqa: ANN001
    segments,  # noqa: ANN001
    balls,  # noqa: ANN001
    magnitude,  # noqa: ANN001
    which,  # noqa: ANN001
    shift,  # noqa: ANN001
    lower,  # noqa: ANN001
    upper,  # noqa: ANN001
    shared,  # noqa: ANN001
    least,  # noqa: ANN001
    margin,  # noqa: ANN001
):
    poses, count, rank = table.shape
    sets, spans, rounds = centre.shape[1], segments.shape[2], balls.shape[2]
    basis = np.zeros((rank, rank, rank))
    basis[0] = np.eye(rank)
    following = np.zeros(rank, dtype=np.int64)
    independent = np.ones(rank, dtype=np.bool_)
    mirror, weights = np.empty(rank), np.empty(count)
    pulls = np.empty(count)
    sizes = np.empty(sets)
    total, has, fixed, least_pull = np.empty(2), np.empty(2), np.empty(2), np.empty(2)
    start, lowest = 0.0, np.inf
    for column in range(count):
        if shared[column]:
            start, lowest = max(start, lower[column]), min(lowest, upper[column])
    for pose in range(poses):
        index = which[pose]
        base = 0.0
        for row in range(rank):
            base += shift[pose, row] ** 2
        base = np.sqrt(base)
        for column in range(count):
            base += norms[pose, column] * lower[column]
        for one in range(sets):
            sizes[one] = (magnitude[index, one] + base) * WRENCH_TOLERANCE
            least[pose, one], margin[pose, one] = start, np.inf
        level = 0
        following[0] = 0
        while level >= 0:
            missing = rank - 1 - level
            if missing > 0:
                column = following[level]
                if column > count - missing:
                    level -= 1
                    continue
                following[level] = column + 1
                left = _reduce(basis, level, rank, table[pose, column], mirror)
                independent[level + 1] = independent[level] and left > COLUMN_TOLERANCE * norms[pose, column]
                following[level + 1] = column + 1
                level += 1
                continue
            normal = basis[level, 0]
            bounds_margin = independent[level]
            level -= 1
            # Sums over the columns that pull along the normal, and over those that pull against it.
            total[:], has[:], fixed[:], least_pull[:] = 0.0, 0.0, 0.0, 0.0
            for column in range(count):
                pull = 0.0
                for row in range(rank):
                    pull += normal[row] * table[pose, column, row]
                size = abs(pull)
                if size <= COLUMN_TOLERANCE * norms[pose, column]:
                    pulls[column] = 0.0
                    continue
                pulls[column] = pull
                side = 0 if pull > 0.0 else 1
                least_pull[side] += size * lower[column]
                if shared[column]:
                    total[side] += size
                    has[side] += size * upper[column]
                else:
                    fixed[side] += size * upper[column]
            supplied = 0.0
            for row in range(rank):
                supplied += normal[row] * shift[pose, row]
            for one in range(sets):
                middle = -supplied
                for row in range(rank):
                    middle += normal[row] * centre[index, one, row]
                reach = 0.0
                for span in range(spans):
                    product = 0.0
                    for row in range(rank):
                        product += normal[row] * segments[index, one, span, row]
                    reach += abs(product)
                for ball in range(rounds):
                    square = 0.0
                    for axis in range(3):
                        product = 0.0
                        for row in range(rank):
                            product += normal[row] * balls[index, one, ball, row, axis]
                        square += product * product
                    reach += np.sqrt(square)
                for side in range(2):
                    sign = 1.0 - 2.0 * side
                    excess = sign * middle + reach + least_pull[1 - side] - fixed[side]
                    if bounds_margin:
                        margin[pose, one] = min(margin[pose, one], has[side] - excess)
                    found = least[pose, one]
                    if excess <= sizes[one] or found == np.inf:
                        continue
                    if found <= lowest and excess <= found * total[side]:
                        continue
                    for column in range(count):
                        pull = sign * pulls[column]
                        weights[column] = pull if pull > 0.0 and shared[column] else 0.0
                    least[pose, one] = max(found, _level(excess, weights, upper, count, sizes[one]))
