"""Pictures of where a robot can work, and of how that depends on what was varied."""

from collections.abc import Sequence
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from actuator_select.model.arrays import FloatArray
from actuator_select.report.style import BLUE, house_style, new_figure
from actuator_select.report.workspace_figures import workspace_panels
from actuator_select.selection.sweeps import Sweep, SweepPoint
from actuator_select.selection.workspaces import WorkspaceResult

if TYPE_CHECKING:
    from matplotlib.artist import Artist

WIDTH = 7.5  # inches
OUTSIDE, INSIDE, APART = 0, 1, 2
FILLS = ("#F3DDD0", "#A9CBE3", "#D8D8D8")  # outside, inside, set apart: light, so that lines stand out on them
LINES = "#31506B"
MANY = 8  # values of a key; two keys with more are drawn as a map
MOST_LINES = 12  # that a legend names
DASHES = ("-", "--", "-.", ":")
_MEASURES = {"": "feasible share", "m": "length, estimated", "m2": "area, estimated", "m3": "volume, estimated"}


@house_style
def workspace_map(result: WorkspaceResult) -> Figure:
    """Draw a workspace: a filled map where the grid is planar, else positions in 3-D.

    Parameters
    ----------
    result : WorkspaceResult
        Any workspace.

    Returns
    -------
    Figure
        A map shows the cells of the grid and, where they are finite, lines of equal margin.
    """
    points = result.study.table.workspace.points
    drawn = [axis for axis in range(3) if points[axis] > 1]
    if len(drawn) != 2:  # noqa: PLR2004 - a plane
        return workspace_panels(result.study, [(workspace_title(result), result.feasible)], served="feasible")
    first, second = drawn
    grid = (points[first], points[second])
    edges = [_edges(result.study.positions[:, axis], float(result.study.cell_size[axis])) for axis in drawn]
    width, height = (float(edge[-1] - edge[0]) for edge in edges)
    figure = new_figure(WIDTH, float(np.clip(WIDTH * height / width, 1.6, 7.0)) + 1.0)
    axes = figure.subplots()
    states = np.where(result.apart, APART, np.where(result.feasible, INSIDE, OUTSIDE)).reshape(grid)
    axes.pcolormesh(*edges, states.T, cmap=ListedColormap(FILLS), vmin=-0.5, vmax=2.5, rasterized=True)
    _margin_lines(axes, result, edges, grid)
    anchors = result.study.robot.frame_anchors[:, drawn]
    axes.scatter(anchors[:, 0], anchors[:, 1], marker="^", s=18, color="black", zorder=3, clip_on=False)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{'xyz'[first]} [m]")
    axes.set_ylabel(f"{'xyz'[second]} [m]")
    axes.set_title(workspace_title(result), fontsize=9.0)
    handles: list[Artist] = [
        Patch(color=FILLS[INSIDE], label="feasible"),
        Patch(color=FILLS[OUTSIDE], label="not feasible"),
    ]
    if result.too_near_poses:
        handles.append(Patch(color=FILLS[APART], label="nearer to an anchor than judged"))
    handles.append(Line2D([], [], linestyle="", marker="^", color="black", markersize=5, label="frame anchors"))
    handles.append(Line2D([], [], color=LINES, linewidth=0.8, label=f"margin [{result.margin_unit}]"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def workspace_title(result: WorkspaceResult) -> str:
    """``qi-a: dynamic-feasible workspace, 2820 of 3276 positions, about 112.8 m²``."""
    title = f"{result.study.name}: {result.kind.value} workspace, {result.feasible_poses} of {result.poses} positions"
    if result.measure is not None and result.unit is not None:
        title += f", about {result.measure:.4g} {superscript(result.unit)}"
    return title


def superscript(unit: str) -> str:
    """``m²`` for ``m2``."""
    return unit.replace("2", "²").replace("3", "³")


def _edges(positions: FloatArray, cell: float) -> FloatArray:
    levels = np.unique(positions)
    return np.append(levels - cell / 2.0, levels[-1] + cell / 2.0)


def _margin_lines(axes: Axes, result: WorkspaceResult, edges: Sequence[FloatArray], grid: tuple[int, int]) -> None:
    """Lines of equal margin inside the workspace, where margins are finite."""
    margin = np.where(result.feasible & np.isfinite(result.margin), result.margin, np.nan).reshape(grid)
    if np.isnan(margin).all() or min(grid) < 3 or np.nanmax(margin) <= 0.0:  # noqa: PLR2004 - a line needs three
        return
    centres = [(edge[:-1] + edge[1:]) / 2.0 for edge in edges]
    levels = MaxNLocator(5).tick_values(0.0, float(np.nanmax(margin)))
    lines = axes.contour(*centres, np.ma.masked_invalid(margin.T), levels=levels, colors=LINES, linewidths=0.7)
    axes.clabel(lines, fmt=lambda value: f"{value:g} {result.margin_unit}", fontsize=6.5)


@house_style
def sweep_figure(sweep: Sweep) -> Figure:
    """Draw a sweep: area, volume or share over the first key.

    Parameters
    ----------
    sweep : Sweep
        Of one key or more.

    Returns
    -------
    Figure
        A line per value of the second key, or a map where both have many values; of three keys and more, a line per
        combination of the further ones.
    """
    measured = sweep.points[0].measure is not None
    values = np.array([_shown(point, measured=measured) for point in sweep.points])
    unit = superscript(sweep.points[0].measure_unit or "")
    name = f"{_MEASURES[sweep.points[0].measure_unit or '']} [{unit or '%'}]"
    first, further = sweep.axes[0], sweep.axes[1:]
    order = np.argsort(first.values)
    along, table = np.array(first.values)[order], values.reshape(len(order), -1)[order]
    labels = [
        ", ".join(f"{axis.key} = {value:g}" for axis, value in zip(further, one, strict=True))
        for one in product(*(axis.values for axis in further))
    ]
    figure = new_figure(WIDTH, 4.2)
    axes = figure.subplots()
    axes.set_xlabel(first.key)
    axes.set_title(f"{sweep.study.name}: {sweep.kind.value} workspace, {sweep.tension_model.value}", fontsize=9.0)
    if len(further) == 1 and (len(labels) > MOST_LINES or min(len(order), len(labels)) > MANY):
        across = np.argsort(further[0].values)
        heights = np.array(further[0].values)[across]
        shaded = axes.pcolormesh(along, heights, table.T[across], shading="nearest", rasterized=True)
        axes.set_ylabel(further[0].key)
        figure.colorbar(shaded, ax=axes, label=name)
        return figure
    axes.set_ylabel(name)
    shades = colormaps["viridis"](np.linspace(0.0, 0.9, max(len(labels), 2)))
    for column, label in enumerate(labels):
        colour = BLUE if len(labels) == 1 else shades[column]
        dash = DASHES[column % len(DASHES)]
        axes.plot(along, table[:, column], color=colour, linestyle=dash, marker="o", markersize=2.5, label=label)
    axes.grid(visible=True, color="#E2E2E2", linewidth=0.6)
    if further and len(labels) <= MOST_LINES:
        figure.legend(loc="outside lower center", ncols=3)
    return figure


def _shown(point: SweepPoint, *, measured: bool) -> float:
    value = point.measure if measured else point.feasible_percent
    return float("nan") if value is None else value
