"""Where positions are served: maps of planar grids, points or surfaces of spatial ones, several side by side."""

from collections.abc import Sequence
from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.report.grids import APART, FULL_WIDTH, MISSED, NEVER, cell_edges, is_flat, marker, paint, sliced
from actuator_select.report.style import BLUE, GREY, RED, house_style, new_figure
from actuator_select.study import Study

if TYPE_CHECKING:
    from matplotlib.artist import Artist

PANELS_PER_ROW = 3
MAPS_PER_ROW = 2
MANY_MAPS = 4  # more stand three in a row, so that high ones keep to a page
TITLE_WIDTH = 40  # characters of a panel's title in one line
MAP_TITLE_WIDTH = 62
TITLE_HEIGHT = 0.25  # inches, of one line
DENSE = 1500  # positions; more points than this hide each other, and the served cells' surface is drawn
SHADES = (0.62, 0.82, 1.0)  # of faces across x, y, z


@house_style
def workspace_panels(
    study: Study,
    panels: Sequence[tuple[str, BoolArray]],
    attainable: BoolArray | None = None,
    *,
    apart: BoolArray | None = None,
    served: str = "served",
) -> Figure:
    """Served positions, one panel each, as figures 4, 5 and 8 of Filipović & Kevac 2018.

    Parameters
    ----------
    study : Study
        Positions, frame anchors and region.
    panels : sequence of (str, (P,) array of bool)
        Title, and where the panel's actuator serves.
    attainable : (P,) array of bool, optional
        Where any drive could serve; other positions are drawn as such.
    apart : (P,) array of bool, optional
        Positions that are not judged, because they are too near to an anchor.
    served : str
        What the legend calls the served positions.

    Returns
    -------
    Figure
        Maps where the grid lies in a plane, two in a row or three if many; else up to three in 3-D, of points or,
        where the grid is dense, of the surface of the served cells.
    """
    everywhere = np.ones(len(study.positions), dtype=np.bool_)
    attainable = everywhere if attainable is None else attainable
    apart = ~everywhere if apart is None else apart
    if is_flat(study):
        return _maps(study, panels, attainable, apart, served)
    return _spatial(study, panels, attainable, apart, served)


def _maps(
    study: Study, panels: Sequence[tuple[str, BoolArray]], attainable: BoolArray, apart: BoolArray, served: str
) -> Figure:
    axis, _ = sliced(study)
    first, second = (other for other in range(3) if other != axis)
    edges = [cell_edges(study, other) for other in (first, second)]
    width, height = (float(edge[-1] - edge[0]) for edge in edges)
    many = len(panels) > MANY_MAPS
    columns = min(PANELS_PER_ROW if many else MAPS_PER_ROW, len(panels))
    rows = -(-len(panels) // columns)
    titles = [fill(title, TITLE_WIDTH if many else MAP_TITLE_WIDTH) for title, _ in panels]
    tall = FULL_WIDTH / columns * float(np.clip(height / width, 0.15, 1.2)) + TITLE_HEIGHT * (
        1 + max(title.count("\n") for title in titles)
    )
    figure = new_figure(FULL_WIDTH, rows * tall + 0.7)
    drawn = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    states = (~attainable & ~apart, apart)
    for axes, title, (_, feasible) in zip(drawn.ravel(), titles, panels, strict=False):
        for cells, colour in (
            (feasible, BLUE),
            (~feasible & attainable & ~apart, MISSED),
            (states[0], NEVER),
            (states[1], APART),
        ):
            paint(axes, edges, np.take(cells.reshape(study.table.workspace.points), 0, axis=axis), colour)
        axes.set_title(title, fontsize=8.0)
        axes.set_aspect("equal")
        axes.tick_params(labelsize=7)
    for axes in drawn.ravel()[len(panels) :]:
        axes.set_visible(False)
    for axes in drawn[-1]:
        axes.set_xlabel(f"{'xyz'[first]} [m]")
    for axes in drawn[:, 0]:
        axes.set_ylabel(f"{'xyz'[second]} [m]")
    handles = [Patch(color=BLUE, label=served), Patch(color=MISSED, label=f"not {served}")]
    handles += [Patch(color=NEVER, label="no drive could")] if states[0].any() else []
    handles += [Patch(color=APART, label="set apart: too near to an anchor")] if apart.any() else []
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _spatial(
    study: Study, panels: Sequence[tuple[str, BoolArray]], attainable: BoolArray, apart: BoolArray, served: str
) -> Figure:
    columns = min(PANELS_PER_ROW, len(panels))
    rows = -(-len(panels) // columns)
    # A lone panel needs the width of its legend, and has the room to be large.
    figure = new_figure(max(2.5 * columns, 5.4), 2.6 * rows + 0.3) if len(panels) > 1 else new_figure(6.2, 4.4)
    dense = len(study.positions) > DENSE
    for index, (title, feasible) in enumerate(panels, start=1):
        axes = figure.add_subplot(rows, columns, index, projection="3d")
        if not isinstance(axes, Axes3D):  # pragma: no cover - matplotlib returns what was asked for
            raise TypeError(type(axes))
        if dense:
            _surface(axes, study, feasible, BLUE)
            _surface(axes, study, apart, APART)
        else:
            _points(axes, study, feasible, attainable, apart)
        _dress(axes, study, large=len(panels) == 1)
        axes.set_title(title if len(panels) == 1 else fill(title, TITLE_WIDTH), fontsize=8.5)
    handles: list[Artist] = [Patch(color=BLUE, label=served) if dense else marker("o", BLUE, served)]
    if dense:
        handles.append(Line2D([], [], color=GREY, linewidth=0.8, label=f"box; the rest of it is not {served}"))
    else:
        handles.append(marker("x", RED, f"not {served}"))
        handles += [] if (attainable | apart).all() else [marker(".", GREY, "no drive could")]
    handles += [marker("s", APART, "set apart: too near to an anchor")] if apart.any() else []
    handles.append(marker("^", "black", "frame anchors"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles) if columns > 1 else 4)
    return figure


def _points(axes: Axes3D, study: Study, feasible: BoolArray, attainable: BoolArray, apart: BoolArray) -> None:
    size = float(np.clip(3000.0 / len(study.positions), 2.0, 18.0))
    judged = ~feasible & ~apart
    for cells, shape, scale, colour in (
        (judged & ~attainable, ".", 0.5, GREY),
        (judged & attainable, "x", 0.6, RED),
        (apart, "s", 0.8, APART),
        (feasible, "o", 1.0, BLUE),
    ):
        width = 0.6 if shape == "x" else 0.0
        points = study.positions[cells]
        axes.scatter(
            *points.T, marker=shape, s=scale * size, color=colour, linewidths=width, depthshade=False, rasterized=True
        )


def _surface(axes: Axes3D, study: Study, cells: BoolArray, colour: str) -> None:
    """Faces between the cells that are meant and the others."""
    grid = cells.reshape(study.table.workspace.points)
    edges = [cell_edges(study, axis) for axis in range(3)]
    padded = np.pad(grid, 1)
    faces, colours = [], []
    for axis, shade in enumerate(SHADES):
        others = [other for other in range(3) if other != axis]
        for side in (0, 1):
            beyond = np.roll(padded, 1 - 2 * side, axis=axis)[1:-1, 1:-1, 1:-1]
            found = np.argwhere(grid & ~beyond)
            corners = np.empty((len(found), 4, 3))
            corners[:, :, axis] = edges[axis][found[:, axis] + side][:, np.newaxis]
            for other, steps in zip(others, ((0, 1, 1, 0), (0, 0, 1, 1)), strict=True):
                corners[:, :, other] = edges[other][found[:, [other]] + np.array(steps)]
            faces.append(corners)
            colours += [np.tile(shade * np.array(to_rgb(colour)), (len(found), 1))]
    if cells.any():
        shown = Poly3DCollection(np.concatenate(faces), facecolors=np.concatenate(colours), linewidths=0.1)
        shown.set_edgecolor(np.concatenate(colours))
        axes.add_collection3d(shown)


def _dress(axes: Axes3D, study: Study, *, large: bool) -> None:
    """Anchors, box, and axes of equal scale with few ticks."""
    axes.scatter(*study.robot.frame_anchors.T, marker="^", s=12, color="black", depthshade=False)
    _box(axes, study.region)
    pad, ticks = (0.0, -2.0) if large else (-6.0, -3.0)
    axes.set_xlabel("x [m]", labelpad=pad, fontsize=8.0)
    axes.set_ylabel("y [m]", labelpad=pad, fontsize=8.0)
    axes.set_zlabel("z [m]", labelpad=pad + (0.0 if large else 1.0), fontsize=8.0)
    axes.tick_params(labelsize=7.0 if large else 6.0, pad=ticks)
    extent = np.vstack([study.positions, study.robot.frame_anchors])
    low, high = extent.min(axis=0), extent.max(axis=0)
    # No axis so thin that its labels touch.
    thin = np.maximum(high - low, 0.15 * float((high - low).max()))
    middle = (low + high) / 2.0
    low, high = middle - thin / 2.0, middle + thin / 2.0
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    for axis, length in zip((axes.xaxis, axes.yaxis, axes.zaxis), high - low, strict=True):
        axis.get_major_locator().set_params(nbins=max(2, round(5 * length / float((high - low).max()))))
    axes.set_box_aspect(high - low, zoom=0.9 if large else 0.84)
    axes.patch.set_visible(False)  # it would hide the label of the axes to the left
    axes.view_init(elev=22.0, azim=-58.0)


def _box(axes: Axes3D, region: FloatArray) -> None:
    corners = np.array(np.meshgrid(*region, indexing="ij")).reshape(3, -1).T
    for first in range(8):
        for second in range(first + 1, 8):
            if (first ^ second).bit_count() == 1:
                axes.plot(*np.vstack([corners[first], corners[second]]).T, color=GREY, linewidth=0.6)
