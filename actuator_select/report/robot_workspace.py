"""A picture of where a robot can work."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from actuator_select.model.arrays import FloatArray
from actuator_select.report.grids import APART as APART_COLOUR
from actuator_select.report.grids import FULL_WIDTH, cell_edges, is_flat
from actuator_select.report.style import house_style, new_figure
from actuator_select.report.workspace_panels import workspace_panels
from actuator_select.selection.workspaces import WorkspaceResult

if TYPE_CHECKING:
    from matplotlib.artist import Artist

OUTSIDE, INSIDE, APART = 0, 1, 2
FILLS = ("#F3DDD0", "#A9CBE3", APART_COLOUR)  # outside, inside: light, so that lines stand out; set apart
LINES = "#31506B"


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
    if not is_flat(result.study):
        panels = [(workspace_title(result), result.feasible)]
        return workspace_panels(result.study, panels, apart=result.apart, served="feasible")
    first, second = drawn
    grid = (points[first], points[second])
    edges = [cell_edges(result.study, axis) for axis in drawn]
    anchors = result.study.robot.frame_anchors[:, drawn]
    width, height = (float(np.ptp(np.append(edge, one))) for edge, one in zip(edges, anchors.T, strict=True))
    figure = new_figure(FULL_WIDTH, float(np.clip(FULL_WIDTH * height / width, 1.6, 7.0)) + 1.0)
    axes = figure.subplots()
    states = np.where(result.apart, APART, np.where(result.feasible, INSIDE, OUTSIDE)).reshape(grid)
    axes.pcolormesh(*edges, states.T, cmap=ListedColormap(FILLS), vmin=-0.5, vmax=2.5, rasterized=True)
    lines = _margin_lines(axes, result, edges, grid)
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
        handles.append(Patch(color=FILLS[APART], label="set apart: too near to an anchor"))
    handles.append(Line2D([], [], linestyle="", marker="^", color="black", markersize=5, label="frame anchors"))
    if lines:
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


def _margin_lines(axes: Axes, result: WorkspaceResult, edges: Sequence[FloatArray], grid: tuple[int, int]) -> bool:
    """Lines of equal margin inside the workspace, where margins are finite; whether there are any."""
    margin = np.where(result.feasible & np.isfinite(result.margin), result.margin, np.nan).reshape(grid)
    if np.isnan(margin).all() or min(grid) < 3 or np.nanmax(margin) <= 0.0:  # noqa: PLR2004 - a line needs three
        return False
    centres = [(edge[:-1] + edge[1:]) / 2.0 for edge in edges]
    levels = MaxNLocator(5).tick_values(0.0, float(np.nanmax(margin)))
    lines = axes.contour(*centres, np.ma.masked_invalid(margin.T), levels=levels, colors=LINES, linewidths=0.7)
    axes.clabel(lines, fmt=lambda value: f"{value:g} {result.margin_unit}", fontsize=6.5)
    return True
