"""Minimax tension of every pose: rank first, then hyperplane shifting, compiled where that pays."""

from collections.abc import Callable
from dataclasses import dataclass
from math import comb

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets, minimax_by_numpy
from actuator_select.model.tension import BALANCE_TOLERANCE, RANK_TOLERANCE

KERNEL_PAYS_FROM = 200_000  # normals; below, NumPy is done before a compiler is loaded
CELLS_AT_ONCE = 1 << 20  # (pose, column, row) cells in one chunk

RankTest = Callable[[FloatArray], BoolArray]
Minimax = Callable[[FloatArray, WrenchSets, IntArray, FloatArray, ColumnBounds], tuple[FloatArray, FloatArray]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Holding:
    """What holding the required wrenches takes at q poses, for G sets of wrenches each.

    Attributes
    ----------
    minimax_tension : (q, G) array
        t*, the least uniform upper bound of the cable tensions; infinite where the pose is infeasible. [N]
    margin : (q, G) array
        Least distance to a facet of the available wrenches, moments divided by the characteristic length. Where the
        rank is short it is never above 0, because what is required lies on the border of what can be exerted, and
        -infinite where something is required that cannot be exerted at all. [N]
    rank : (q,) array
        Of the columns.
    """

    minimax_tension: FloatArray
    margin: FloatArray
    rank: IntArray


def hold_wrenches(
    columns: FloatArray,
    wrenches: WrenchSets,
    which: IntArray,
    shift: FloatArray,
    bounds: ColumnBounds,
    *,
    poses_in_all: int = 0,
) -> Holding:
    """Find the minimax tension and the margin at every pose.

    Parameters
    ----------
    columns : (q, n, M) array
        Structure matrix: a column per cable, and one per counterbalance whose tension is controlled. Moment rows are
        to be divided by a length that makes them comparable with forces.
    wrenches : WrenchSets
        What is required, scaled alike.
    which : (q,) array
        Index of every pose's sets in `wrenches`.
    shift : (q, n) array
        Wrench that counterbalances of constant tension supply.
    bounds : ColumnBounds
        Of the M tensions.
    poses_in_all : int
        Poses of the whole job where these are a part of it; decides whether the compiled kernel pays.

    Returns
    -------
    Holding
        Exact for every rank; a wrench that is not in the range of the columns cannot be held by any tension.
    """
    poses, rows, count = columns.shape
    sets = wrenches.centre.shape[1]
    holding = Holding(
        minimax_tension=np.full((poses, sets), np.inf),
        margin=np.full((poses, sets), -np.inf),
        rank=np.zeros(poses, dtype=np.int64),
    )
    work = max(poses, poses_in_all) * comb(count, min(rows, count) - 1 if count else 0)
    minimax, surely_of_full_rank = _tools(work)
    step = max(1, CELLS_AT_ONCE // max(1, rows * count))
    for start in range(0, poses, step):
        _hold_chunk(
            columns, wrenches, which, shift, bounds, minimax, surely_of_full_rank, holding, slice(start, start + step)
        )
    return holding


def _hold_chunk(  # noqa: PLR0913, PLR0917 - one step of `hold_wrenches`
    columns: FloatArray,
    wrenches: WrenchSets,
    which: IntArray,
    shift: FloatArray,
    bounds: ColumnBounds,
    minimax: Minimax,
    surely_of_full_rank: RankTest | None,
    holding: Holding,
    chunk: slice,
) -> None:
    some, index, supplied = columns[chunk], which[chunk], shift[chunk]
    rows = some.shape[1]
    rank = np.full(len(some), rows, dtype=np.int64)
    doubtful = np.flatnonzero(~surely_of_full_rank(some)) if surely_of_full_rank is not None else np.arange(len(some))
    rank[doubtful], left = structure_rank(some[doubtful])
    holding.rank[chunk] = rank
    full = np.flatnonzero(rank == rows)
    if len(full):
        place = full + chunk.start
        holding.minimax_tension[place], holding.margin[place] = minimax(
            some[full], wrenches, index[full], supplied[full], bounds
        )
    for value in np.unique(rank[rank < rows]):
        at = np.flatnonzero(rank == value)
        bases = left[np.searchsorted(doubtful, at)]
        place = at + chunk.start
        holding.minimax_tension[place], holding.margin[place] = _hold_short(
            some[at], wrenches, index[at], supplied[at], bounds, bases, int(value), minimax
        )


def structure_rank(columns: FloatArray) -> tuple[IntArray, FloatArray]:
    """Rank of (q, n, M) structure matrices, (q,), and their left singular vectors, (q, n, n), largest first."""
    left, sigma, _ = np.linalg.svd(columns, full_matrices=True)
    rank = (sigma > RANK_TOLERANCE * sigma[:, :1]).sum(axis=-1, dtype=np.int64)
    rank[sigma[:, 0] == 0.0] = 0
    return rank, left


def _hold_short(  # noqa: PLR0913, PLR0917 - one step of `hold_wrenches`
    columns: FloatArray,
    wrenches: WrenchSets,
    which: IntArray,
    shift: FloatArray,
    bounds: ColumnBounds,
    left: FloatArray,
    rank: int,
    minimax: Minimax,
) -> tuple[FloatArray, FloatArray]:
    """As `hold_wrenches` where the rank is short: within the range, if all that is required lies in it."""
    own, beyond = left[:, :, :rank], left[:, :, rank:]
    size = wrenches.magnitude(which) + np.linalg.norm(shift, axis=1)[:, None]
    outside = wrenches.projected(beyond, which)
    centre = outside.centre - np.einsum("qn,qnr->qr", shift, beyond)[:, None]
    unheld = np.linalg.norm(centre, axis=-1) + np.linalg.norm(outside.segments, axis=-1).sum(axis=-1)
    unheld += np.linalg.norm(outside.balls, axis=(-2, -1)).sum(axis=-1)
    balanced = unheld <= BALANCE_TOLERANCE * size
    if rank == 0:
        least = np.full(balanced.shape, float(np.max(bounds.lower[bounds.shared], initial=0.0)))
        margin = np.zeros(balanced.shape)
    else:
        inside = wrenches.projected(own, which)
        columns_inside = np.einsum("qnm,qnr->qrm", columns, own)
        shift_inside = np.einsum("qn,qnr->qr", shift, own)
        least, margin = minimax(columns_inside, inside, np.arange(len(which)), shift_inside, bounds)
    return np.where(balanced, least, np.inf), np.where(balanced, np.minimum(margin, 0.0), -np.inf)


def _tools(normals: int) -> tuple[Minimax, RankTest | None]:
    """Choose the compiled kernel, with its quick test of the rank, where it pays and exists."""
    if normals < KERNEL_PAYS_FROM:
        return minimax_by_numpy, None
    try:
        from actuator_select.model.hyperplane_kernel import minimax, surely_of_full_rank
    except (ImportError, RuntimeError):  # not installed, or no folder to keep its code in
        return minimax_by_numpy, None
    return minimax, surely_of_full_rank
