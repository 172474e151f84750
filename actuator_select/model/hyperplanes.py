"""Which wrenches a set of cables can exert: wrench feasibility by hyperplane shifting, exact for any rank.

The wrenches that tensions between bounds exert form a zonotope. Each of its facets is parallel to r - 1 independent
columns of the structure matrix (r its rank), so that a set of required wrenches is feasible exactly if, for every unit
normal n of such columns and both its signs, the set's support in the direction n does not exceed the zonotope's [1, 2].
A normal of *nearly* dependent columns states a necessary condition like any other; only a missing one would err.

References
----------
.. [1] S. Bouchard, C. Gosselin, B. Moore, "On the ability of a cable-driven robot to generate a prescribed set of
   wrenches", ASME Journal of Mechanisms and Robotics 2(1), 2010, doi:10.1115/1.4000558.
.. [2] M. Gouttefarde, S. Krut, "Characterization of parallel manipulator available wrench set facets", Advances in
   Robot Kinematics, 2010, doi:10.1007/978-90-481-9262-5_51.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray

COLUMN_TOLERANCE = 1e-11  # of n · column, relative to the column's norm; what is smaller lies in the hyperplane
WRENCH_TOLERANCE = 1e-10  # relative to the wrenches at hand; a smaller excess is rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class ColumnBounds:
    """Bounds of the tensions of M columns.

    Attributes
    ----------
    lower, upper : (M,) array
        [N]
    shared : (M,) array of bool
        True for the cables, which have one further upper bound in common, the one that is minimised; False for
        counterbalances.
    """

    lower: FloatArray
    upper: FloatArray
    shared: BoolArray


@dataclass(frozen=True, slots=True, kw_only=True)
class WrenchSets:
    """G sets of required wrenches at each of D orientations, w = centre ± segments + balls · unit ball.

    Attributes
    ----------
    centre : (D, G, n) array
        [N, N m]
    segments : (D, G, S, n) array
        Half the segments that are added to the centre (Minkowski sum).
    balls : (D, G, B, n, 3) array
        Linear images of the unit ball that are added.
    """

    centre: FloatArray
    segments: FloatArray
    balls: FloatArray

    def reach(self, normals: FloatArray, which: IntArray) -> FloatArray:
        """How far the sets extend from their centres in the directions `normals`, (q, n); (q, G)."""
        reach: FloatArray = np.abs(np.einsum("qgsn,qn->qgs", self.segments[which], normals)).sum(axis=-1)
        reach += np.linalg.norm(np.einsum("qgbnk,qn->qgbk", self.balls[which], normals), axis=-1).sum(axis=-1)
        return reach

    def magnitude(self, which: IntArray) -> FloatArray:
        """Largest norm in the sets, at most, (q, G)."""
        norms = np.linalg.norm(self.centre, axis=-1) + np.linalg.norm(self.segments, axis=-1).sum(axis=-1)
        norms = norms + np.linalg.norm(self.balls, axis=(-2, -1)).sum(axis=-1)
        result: FloatArray = norms[which]
        return result

    def projected(self, bases: FloatArray, which: IntArray) -> "WrenchSets":
        """Components along (q, n, r) orthonormal bases, one set of sets per pose."""
        return WrenchSets(
            centre=np.einsum("qgn,qnr->qgr", self.centre[which], bases),
            segments=np.einsum("qgsn,qnr->qgsr", self.segments[which], bases),
            balls=np.einsum("qgbnk,qnr->qgbrk", self.balls[which], bases),
        )


def facet_normals(columns: FloatArray) -> Iterator[tuple[FloatArray, BoolArray]]:
    """Unit normals of every r - 1 of M columns, over poses at once.

    Parameters
    ----------
    columns : (q, r, M) array
        Of full row rank.

    Yields
    ------
    (q, r) array
        One of the two normals. The columns are taken one after the other out of an orthonormal basis of what is
        orthogonal to those before, so that sets with a common beginning share its work.
    (q,) array of bool
        False where the columns are dependent, so that the normal is one of many and which one is left to rounding.
    """
    poses, rank, count = columns.shape
    basis = np.broadcast_to(np.eye(rank), (poses, rank, rank))
    yield from _descend(columns, basis, np.ones(poses, dtype=np.bool_), 0, count)


def _descend(
    columns: FloatArray, basis: FloatArray, independent: BoolArray, start: int, count: int
) -> Iterator[tuple[FloatArray, BoolArray]]:
    left = basis.shape[1] - 1
    if left == 0:
        yield basis[:, 0], independent
        return
    for column in range(start, count - left + 1):
        vector = columns[:, :, column]
        along = np.einsum("qdr,qr->qd", basis, vector)
        new = np.linalg.norm(along, axis=1) > COLUMN_TOLERANCE * np.linalg.norm(vector, axis=1)
        yield from _descend(columns, _without(basis, along), independent & new, column + 1, count)


def _without(basis: FloatArray, along: FloatArray) -> FloatArray:
    """Basis (q, d, r) less the direction of components `along`, (q, d), by a Householder reflection; (q, d - 1, r).

    Where the components are zero, any direction may go: the first goes.
    """
    mirror = along.copy()
    mirror[:, 0] += np.copysign(np.linalg.norm(mirror, axis=1), mirror[:, 0])
    square = np.einsum("qd,qd->q", mirror, mirror)
    scale = np.divide(2.0, square, out=np.zeros_like(square), where=square > 0.0)
    row = np.einsum("qd,qdr->qr", mirror, basis)
    rest: FloatArray = basis[:, 1:] - (scale[:, None] * mirror[:, 1:])[..., None] * row[:, None]
    return rest


def in_hyperplane(components: FloatArray, columns: FloatArray) -> FloatArray:
    """Components n · column, (q, M), with those that are rounding set to zero."""
    small = COLUMN_TOLERANCE * np.linalg.norm(columns, axis=1)
    return np.where(np.abs(components) > small, components, 0.0)


def minimax_by_numpy(
    columns: FloatArray, wrenches: WrenchSets, which: IntArray, shift: FloatArray, bounds: ColumnBounds
) -> tuple[FloatArray, FloatArray]:
    """Least uniform upper bound of the cable tensions under which the required wrenches are feasible, and the margin.

    The definition that the compiled kernel has to agree with.

    Parameters
    ----------
    columns : (q, r, M) array
        Structure matrix of full row rank, its rows scaled alike.
    wrenches : WrenchSets
        What is required.
    which : (q,) array
        Index of every pose's sets.
    shift : (q, r) array
        Wrench that is supplied by others and goes off what is required.
    bounds : ColumnBounds
        Of the tensions.

    Returns
    -------
    (q, G) array
        t*; infinite where no bound would do. [N]
    (q, G) array
        Least distance from the required wrenches to a facet of what tensions within their bounds exert, negative
        where they reach beyond; infinite where no facet bounds it. [N]
    """
    centre = wrenches.centre[which] - shift[:, None]
    size = wrenches.magnitude(which) + np.linalg.norm(shift, axis=1)[:, None]
    size = size + (np.linalg.norm(columns, axis=1) @ bounds.lower)[:, None]
    shape = centre.shape[:2]
    least = np.full(shape, float(np.max(bounds.lower[bounds.shared], initial=0.0)))
    margin = np.full(shape, np.inf)
    for normal, independent in facet_normals(columns):
        pulls = in_hyperplane(np.einsum("qr,qrm->qm", normal, columns), columns)
        middle = np.einsum("qr,qgr->qg", normal, centre)
        reach = wrenches.reach(normal, which)
        for sign in (1.0, -1.0):
            with_it, against = np.maximum(sign * pulls, 0.0), np.maximum(-sign * pulls, 0.0)
            needed = sign * middle + reach + (against @ bounds.lower)[:, None]
            own = _most(np.where(bounds.shared, 0.0, with_it), bounds.upper)
            excess = needed - own[:, None]
            shared = np.where(bounds.shared, with_it, 0.0)
            np.maximum(least, _level(excess, shared, bounds.upper, size), out=least)
            # A normal of dependent columns need not be a facet's; from outside it may lie further off than any facet.
            slack = _most(shared, bounds.upper)[:, None] - excess
            np.minimum(margin, np.where(independent[:, None], slack, np.inf), out=margin)
    return least, margin


def _most(pulls: FloatArray, upper: FloatArray) -> FloatArray:
    """Σ pulls · upper, (q,), where a pull of zero is nothing, however large its bound."""
    most: FloatArray = (pulls * np.where(pulls > 0.0, upper, 0.0)).sum(axis=1)
    return most


def _level(excess: FloatArray, shared: FloatArray, caps: FloatArray, size: FloatArray) -> FloatArray:
    """Least level τ with Σ shared · min(τ, cap) ≥ excess, (q, G); infinite where none is enough."""
    remaining, weights = excess.copy(), np.broadcast_to(shared[:, None], (*excess.shape, shared.shape[1])).copy()
    floor = np.zeros_like(excess)
    with np.errstate(divide="ignore", invalid="ignore"):
        while True:
            total = weights.sum(axis=-1)
            level = np.where(
                remaining <= WRENCH_TOLERANCE * size, 0.0, np.where(total > 0.0, remaining / total, np.inf)
            )
            capped = (weights > 0.0) & (caps < level[..., None] * (1.0 - WRENCH_TOLERANCE))
            if not capped.any():
                return np.maximum(level, floor)
            held = np.where(capped, caps, 0.0)
            remaining = remaining - (weights * held).sum(axis=-1)
            floor = np.maximum(floor, held.max(axis=-1))
            weights[capped] = 0.0
