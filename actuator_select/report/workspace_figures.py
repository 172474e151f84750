"""Pictures of the workspace: how much of it each actuator serves, where, and what stops it elsewhere."""

from collections.abc import Sequence
from textwrap import shorten

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm, ListedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from actuator_select.model.actuation import ROUNDING
from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.report.grids import APART, FULL_WIDTH, NEVER, cell_edges, marker, paint, sliced
from actuator_select.report.style import BLUE, CHECK_COLOURS, GREY, RED, house_style, new_figure
from actuator_select.selection import RankedActuator, Selection
from actuator_select.selection.dossier import ActuatorDetail
from actuator_select.selection.wording import share
from actuator_select.study import Study

NAME_WIDTH = 40  # characters of an actuator's name beside its bar
MOST_CROSSES = 400  # cells of one slice; beyond, the border is drawn
UTILISATION_SHOWN = 2.0  # colours saturate there


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
    edges = [cell_edges(study, other) for other in (first, second)]
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
    mark = (
        Line2D([], [], color="black", linewidth=1.0, label="the limit") if dense else marker("x", "black", "not served")
    )
    apart = np.isnan(detail.utilisation)
    figure.legend(
        handles=[Patch(color=CHECK_COLOURS[check], label=f"{check.value} is closest") for check in detail.checks]
        + ([] if (detail.attainable | apart).all() else [Patch(color=NEVER, label="no drive could serve")])
        + ([Patch(color=APART, label="set apart: too near to an anchor")] if apart.any() else [])
        + [mark],
        loc="outside lower center",
        ncols=3,
    )
    return figure


def _slice(
    pair: NDArray[np.object_], edges: Sequence[FloatArray], values: FloatArray, which: IntArray, colours: list[str]
) -> QuadMesh:
    """Draw one slice twice: the closest check, and the utilisation, which is returned for the colour bar."""
    upper, lower = pair
    for axes in pair:
        paint(axes, edges, np.isinf(values), NEVER)
        paint(axes, edges, np.isnan(values), APART)
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
