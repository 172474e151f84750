"""What all pictures of a grid share: its slices and cells, and one colour for each state of a position."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.study import Study

FULL_WIDTH = 7.5  # inches
LEVELS = 4  # slices through a spatial grid
HALF_CELL = 0.05  # of an axis with a single level and no extent [m]
NEVER = "#C9CED2"  # where no drive could serve, and no tensions hold
APART = "#5A5148"  # nearer to an anchor than is judged
MISSED = "#F3CDB5"  # not served, in flat maps: light, so that it stands out from the served ones in grey prints too


def sliced(study: Study) -> tuple[int, list[int]]:
    """Axis that is cut, and the grid levels shown: a planar grid across its plane, others at several heights."""
    points = study.table.workspace.points
    planar = [axis for axis in range(3) if points[axis] == 1]
    axis = planar[-1] if planar else 2
    count = min(LEVELS, points[axis])
    return axis, sorted({round(level) for level in np.linspace(0, points[axis] - 1, count)})


def is_flat(study: Study) -> bool:
    """Whether the grid lies in a plane."""
    return sum(count > 1 for count in study.table.workspace.points) == 2  # noqa: PLR2004 - a plane


def cell_edges(study: Study, axis: int) -> FloatArray:
    """Edges of the cells around the grid's levels along one axis. [m]"""
    levels = np.unique(study.positions[:, axis])
    if len(levels) == 1:
        low, high = study.region[axis]
        return np.array([low, high]) if high > low else levels[0] + np.array([-HALF_CELL, HALF_CELL])
    half = (levels[-1] - levels[0]) / (len(levels) - 1) / 2.0
    return np.append(levels - half, levels[-1] + half)


def paint(axes: Axes, edges: Sequence[FloatArray], cells: BoolArray, colour: str) -> None:
    """Fill cells of a slice with one colour."""
    if cells.any():
        shown = np.ma.masked_where(~cells, np.ones(cells.shape))
        axes.pcolormesh(*edges, shown.T, cmap=ListedColormap([colour]), rasterized=True)


def marker(shape: str, colour: str, label: str) -> Line2D:
    """Legend entry of a marker."""
    return Line2D([], [], linestyle="", marker=shape, color=colour, markersize=4.5, label=label)
