"""Pictures of the workspace: how much of it each actuator serves, where, and what stops it elsewhere."""

from collections.abc import Sequence
from textwrap import fill, shorten

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm, ListedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from actuator_select.model.actuation import ROUNDING
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.report.style import BLUE, CHECK_COLOURS, GREY, RED, house_style, new_figure
from actuator_select.selection import RankedActuator, Selection
from actuator_select.selection.dossier import ActuatorDetail
from actuator_select.selection.wording import share
from actuator_select.study import Study

PANELS_PER_ROW = 3
TITLE_WIDTH = 40  # characters of a panel's title in one line
NAME_WIDTH = 40  # characters of an actuator's name beside its bar
FULL_WIDTH = 7.5  # inches
LEVELS = 4  # slices of one actuator
MOST_POINTS = 8000  # of one 3-D panel
MOST_CROSSES = 400  # cells of one slice; beyond, the border is drawn
UTILISATION_SHOWN = 2.0  # colours saturate there
NEVER = "#C9CED2"  # where no drive could serve


@house_style
def share_bars(selection: Selection, actuators: Sequence[RankedActuator]) -> Figure:
    """Feasible share of every actuator beside the requirement, as figure 9 of Filipović & Kevac 2018."""
    figure = new_figure(7.2, 0.9 + 0.34 * len(actuators))
    axes = figure.subplots()
    names = [actuator.name for actuator in actuators]
    shares = [actuator.feasible_percent for actuator in actuators]
    colours = {"meets": BLUE, "undecided": "#9DB9CE", "fails": GREY}
    rows = np.arange(len(actuators))
    axes.barh(rows, shares, color=[colours[actuator.verdict.value] for actuator in actuators], height=0.65)
    for row, actuator in enumerate(actuators):
        axes.text(
            actuator.feasible_percent + 1.0,
            row,
            share(actuator, selection.poses),
            va="center",
            fontsize=8,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8},
        )
    axes.axvline(selection.required_percent, color=RED, linestyle="--", linewidth=1.2)
    axes.text(
        selection.required_percent,
        -0.75,
        f"required {selection.required_percent:g} %",
        color=RED,
        ha="center",
        va="bottom",
        fontsize=8,
    )
    axes.set_yticks(rows, [shorten(name, NAME_WIDTH, placeholder="…") for name in names])
    axes.set_xlim(0.0, 118.0)
    axes.set_xticks(range(0, 101, 20))
    axes.set_ylim(len(actuators) - 0.4, -0.8)
    axes.set_xlabel("feasible share of the workspace [%]")
    return figure


@house_style
def workspace_panels(
    study: Study,
    panels: Sequence[tuple[str, BoolArray]],
    attainable: BoolArray | None = None,
    *,
    served: str = "served",
) -> Figure:
    """Feasible and infeasible positions in 3-D, one panel each, as figures 4, 5 and 8 of Filipović & Kevac 2018.

    Parameters
    ----------
    study : Study
        Positions, frame anchors and region.
    panels : sequence of (str, (P,) array of bool)
        Title, and where the panel's actuator serves.
    attainable : (P,) array of bool, optional
        Where any drive could serve; other positions are drawn as such.
    served : str
        What the legend calls these positions.

    Returns
    -------
    Figure
        Up to three panels in a row.
    """
    columns = min(PANELS_PER_ROW, len(panels))
    rows = -(-len(panels) // columns)
    # A lone panel needs the width of its legend, and has the room to be large.
    figure = new_figure(2.9 * columns, 2.75 * rows + 0.3) if len(panels) > 1 else new_figure(6.2, 4.6)
    for index, (title, feasible) in enumerate(panels, start=1):
        axes = figure.add_subplot(rows, columns, index, projection="3d")
        if not isinstance(axes, Axes3D):  # pragma: no cover - matplotlib returns what was asked for
            raise TypeError(type(axes))
        _workspace(axes, study, feasible, np.ones_like(feasible) if attainable is None else attainable)
        axes.set_title(fill(title, TITLE_WIDTH), fontsize=8.5)
    figure.legend(
        handles=[
            Patch(color=BLUE, label=served),
            Patch(facecolor="none", edgecolor=RED, label=f"not {served} (small crosses)"),
            *([] if attainable is None or attainable.all() else [Patch(color=GREY, label="no drive could (dots)")]),
            Patch(color="black", label="frame anchors (triangles)"),
        ],
        loc="outside lower center",
        ncols=4,
    )
    return figure


def _workspace(axes: Axes3D, study: Study, feasible: BoolArray, attainable: BoolArray) -> None:
    # More points than this would hide each other; every n-th shows the shape as well.
    step = -(-len(study.positions) // MOST_POINTS)
    positions, feasible, attainable = study.positions[::step], feasible[::step], attainable[::step]
    size = float(np.clip(3000.0 / len(positions), 1.0, 18.0))
    served, missed, never = positions[feasible], positions[~feasible & attainable], positions[~feasible & ~attainable]
    axes.scatter(*never.T, marker=".", s=0.5 * size, color=GREY, linewidths=0.0, depthshade=False, rasterized=True)
    axes.scatter(*missed.T, marker="x", s=0.6 * size, color=RED, linewidths=0.6, depthshade=False, rasterized=True)
    axes.scatter(
        *served.T, marker="o", s=size, color=BLUE, alpha=0.75, linewidths=0.0, depthshade=False, rasterized=True
    )
    axes.scatter(*study.robot.frame_anchors.T, marker="^", s=12, color="black", depthshade=False)
    _box(axes, study.region)
    axes.set_xlabel("x [m]", labelpad=-4)
    axes.set_ylabel("y [m]", labelpad=-4)
    axes.set_zlabel("z [m]", labelpad=-5)
    axes.locator_params(nbins=5)
    axes.tick_params(labelsize=6.5, pad=-2)
    extent = np.vstack([positions, study.robot.frame_anchors])
    low, high = extent.min(axis=0), np.maximum(extent.max(axis=0), extent.min(axis=0) + 1e-3)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=0.86)
    axes.view_init(elev=22.0, azim=-58.0)


def _box(axes: Axes3D, region: FloatArray) -> None:
    corners = np.array(np.meshgrid(*region, indexing="ij")).reshape(3, -1).T
    for first in range(8):
        for second in range(first + 1, 8):
            if (first ^ second).bit_count() == 1:
                axes.plot(*np.vstack([corners[first], corners[second]]).T, color=GREY, linewidth=0.6)


@house_style
def slice_panels(study: Study, detail: ActuatorDetail) -> Figure:
    """Slices through the workspace: above, what is closest to its limit; below, how close.

    Parameters
    ----------
    study : Study
        The grid.
    detail : ActuatorDetail
        One actuator.

    Returns
    -------
    Figure
        Two rows, one column per slice.
    """
    axis, levels = sliced(study)
    first, second = (other for other in range(3) if other != axis)
    grid = study.table.workspace.points
    utilisation = np.take(detail.utilisation.reshape(grid), levels, axis=axis)  # infinite where no drive could serve
    critical = np.take(detail.critical.reshape(grid), levels, axis=axis)
    heights = np.unique(study.positions[:, axis])
    edges = [cell_edges(study.region[other], grid[other]) for other in (first, second)]
    width, height = (float(edge[-1] - edge[0]) for edge in edges)
    panel = 1.7 * np.clip(height / width, 0.4, 1.6)
    # One slice alone stands beside its twin, not above it.
    rows = 1 if len(levels) == 1 else 2
    figure = new_figure(FULL_WIDTH, rows * panel * (2.0 if rows == 1 else 1.0) + 1.2)
    panels = np.reshape(
        figure.subplots(rows, 2 * len(levels) // rows, squeeze=False, sharex=True, sharey=True), (2, len(levels))
    )
    colours = [CHECK_COLOURS[check] for check in detail.checks]
    shaded = None
    for column, level in enumerate(levels):
        values, which = np.take(utilisation, column, axis=axis), np.take(critical, column, axis=axis)
        shaded = _slice(panels[:, column], edges, values, which, colours)
        panels[0, column].set_title(f"{'xyz'[axis]} = {heights[level]:.2f} m", fontsize=8.5)
        panels[1, column].set_xlabel(f"{'xyz'[first]} [m]")
    for row in range(2):
        panels[row, 0].set_ylabel(f"{'xyz'[second]} [m]")
    if shaded is not None:
        bar = figure.colorbar(shaded, ax=list(panels[1]), extend="max", shrink=0.9, pad=0.01)
        bar.set_label("demand / limit", fontsize=8)
        bar.ax.tick_params(labelsize=7)
    dense = _is_dense(np.take(utilisation, 0, axis=axis))
    not_served = "black line: the limit" if dense else "×  not served"
    figure.legend(
        handles=[Patch(color=CHECK_COLOURS[check], label=f"{check.value} is closest") for check in detail.checks]
        + ([] if detail.attainable.all() else [Patch(color=NEVER, label="no drive could serve")])
        + [Patch(facecolor="white", edgecolor="black", label=not_served)],
        loc="outside lower center",
        ncols=3,
    )
    return figure


def _slice(
    pair: NDArray[np.object_], edges: Sequence[FloatArray], values: FloatArray, which: IntArray, colours: list[str]
) -> QuadMesh:
    """Draw one slice twice: the closest check, and the utilisation, which is returned for the colour bar."""
    upper, lower = pair
    never = np.ma.masked_where(np.isfinite(values), np.ones_like(values))
    for axes in pair:
        axes.pcolormesh(*edges, never.T, cmap=ListedColormap([NEVER]), rasterized=True)
    finite = np.ma.masked_where(~np.isfinite(values), values)
    upper.pcolormesh(
        *edges,
        np.ma.masked_where(~np.isfinite(values), which).T,
        cmap=ListedColormap(colours),
        norm=BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)),
        rasterized=True,
    )
    norm = TwoSlopeNorm(vcenter=1.0, vmin=0.0, vmax=UTILISATION_SHOWN)
    shaded: QuadMesh = lower.pcolormesh(*edges, finite.T, cmap="RdYlBu_r", norm=norm, rasterized=True)
    for axes in pair:
        _mark_limit(axes, edges, values)
        axes.set_aspect("equal")
        axes.tick_params(labelsize=7)
    return shaded


def sliced(study: Study) -> tuple[int, list[int]]:
    """Axis that is cut, and the grid levels shown: a planar grid across its plane, others at several heights."""
    points = study.table.workspace.points
    planar = [axis for axis in range(3) if points[axis] == 1]
    axis = planar[-1] if planar else 2
    count = min(LEVELS, points[axis])
    return axis, sorted({round(level) for level in np.linspace(0, points[axis] - 1, count)})


def cell_edges(interval: FloatArray, points: int) -> FloatArray:
    """Cell edges around the grid points of one axis."""
    low, high = interval
    if points == 1:
        return np.array([low, high]) if high > low else np.array([low - 0.05, low + 0.05])
    half = (high - low) / (points - 1) / 2.0
    return np.linspace(low - half, high + half, points + 1)


def _mark_limit(axes: Axes, edges: Sequence[FloatArray], values: FloatArray) -> None:
    """Mark the cells over a limit, so that they show without colours; where there are many, their border."""
    centres = [(edge[:-1] + edge[1:]) / 2.0 for edge in edges]
    x, y = np.meshgrid(*centres, indexing="ij")
    over = (values > 1.0 + ROUNDING) & np.isfinite(values)
    if _is_dense(values):
        axes.contour(x, y, over.astype(np.float64), levels=[0.5], colors="black", linewidths=1.0)
        return
    size = float(np.clip(400.0 / max(values.size, 1), 1.0, 16.0))
    axes.scatter(x[over], y[over], marker="x", s=size, color="black", linewidths=0.6, rasterized=True)


def _is_dense(values: FloatArray) -> bool:
    return values.size > MOST_CROSSES and min(values.shape) > 1
