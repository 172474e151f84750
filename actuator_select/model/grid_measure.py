"""Area or volume of what a grid of positions shows, and how much of it hangs together: estimates, called so."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """Length, area or volume of the feasible positions, by the number of axes with more than one point.

    Attributes
    ----------
    value : float
        Positions times cell. [m, m² or m³]
    inner, outer : float
        Of the cells that are surely inside as far as the grid tells, and of these with the cells on the border.
    dimension : int
        1, 2 or 3.
    """

    value: float
    inner: float
    outer: float
    dimension: int

    @property
    def unit(self) -> str:
        """``m``, ``m2`` or ``m3``."""
        return "m" if self.dimension == 1 else f"m{self.dimension}"


def measure_of(
    feasible: BoolArray, points: tuple[int, int, int], cell_size: FloatArray, *, midpoints: bool
) -> Measure | None:
    """Measure the feasible positions of a regular grid.

    Parameters
    ----------
    feasible : (P,) array of bool
        z varies fastest.
    points : tuple of int
        Of the grid, along each axis.
    cell_size : (3,) array
        Distance of neighbouring positions. [m]
    midpoints : bool
        The positions are the midpoints of cells. Surely inside is then a feasible cell all of whose neighbours,
        diagonal ones included, are feasible; on the border, any other feasible cell or neighbour of one. Of nodes,
        surely inside is a cell between nodes that are all feasible; on the border, one with a feasible corner.

    Returns
    -------
    Measure or None
        None of a single position. The value of nodes gives every node a whole cell, those on the faces of the box
        too, so that it may exceed the box, and `outer` with it.
    """
    grid = _grid(feasible, points)
    if not grid.ndim:
        return None
    cell = float(np.prod(cell_size[np.array(points) > 1]))
    if midpoints:
        from scipy import ndimage

        block = np.ones((3,) * grid.ndim, dtype=np.bool_)
        inner = ndimage.binary_erosion(grid, block, border_value=1)
        outer = ndimage.binary_dilation(grid, block)
    else:
        inner = outer = grid
        for axis in range(grid.ndim):
            first, second = slice(None, -1), slice(1, None)
            inner = _along(inner, axis, first) & _along(inner, axis, second)
            outer = _along(outer, axis, first) | _along(outer, axis, second)
    counts = (int(each.sum()) for each in (grid, inner, outer))
    value, least, most = (count * cell for count in counts)
    return Measure(value=value, inner=least, outer=most, dimension=grid.ndim)


def connected_positions(feasible: BoolArray, points: tuple[int, int, int], home: int) -> int:
    """Count the feasible positions that steps to feasible neighbours along the axes join to a home position.

    Parameters
    ----------
    feasible : (P,) array of bool
        z varies fastest.
    points : tuple of int
        Of the grid.
    home : int
        Index of the home position.

    Returns
    -------
    int
        Home itself included; 0 where home is infeasible.
    """
    if not feasible[home]:
        return 0
    from scipy import ndimage

    labels, _ = ndimage.label(feasible.reshape(points))
    flat = np.asarray(labels).reshape(-1)
    return int((flat == flat[home]).sum())


def _grid(feasible: BoolArray, points: tuple[int, int, int]) -> BoolArray:
    return feasible.reshape([count for count in points if count > 1])


def _along(grid: BoolArray, axis: int, part: slice) -> BoolArray:
    index: list[slice] = [slice(None)] * grid.ndim
    index[axis] = part
    return grid[tuple(index)]
