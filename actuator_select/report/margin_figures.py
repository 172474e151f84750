"""Slices of a figure over the workspace: how far from its border every position is, and what tension it takes."""

from collections.abc import Sequence
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.report.style import BLUE, house_style, new_figure
from actuator_select.report.workspace_figures import FULL_WIDTH, NEVER, TITLE_WIDTH, cell_edges, sliced
from actuator_select.study import Study

MAPS_PER_ROW = 2
HIGHEST_SHOWN = 98.0  # per cent of the values that colours tell apart; a singularity's neighbours are far beyond


@house_style
def margin_slices(study: Study, margin: FloatArray) -> Figure:
    """Distance of the required wrenches from the border of what the cables can exert, slice by slice.

    Parameters
    ----------
    study : Study
        The grid.
    margin : (P,) array
        Negative where infeasible; NaN at positions set apart. [N]

    Returns
    -------
    Figure
        Zero is where the colours change.
    """
    finite = margin[np.isfinite(margin)]
    reach = float(np.percentile(np.abs(finite), HIGHEST_SHOWN)) if len(finite) else 1.0
    norm = TwoSlopeNorm(vcenter=0.0, vmin=-max(reach, 1e-9), vmax=max(reach, 1e-9))
    bounded = np.where(np.isneginf(margin), -reach, np.where(np.isposinf(margin), reach, margin))
    return _slices(study, bounded, norm, "RdYlBu", "margin [N]")


@house_style
def tension_slices(study: Study, tension: FloatArray) -> Figure:
    """Minimax tension, slice by slice: the least limit on all cable tensions with which a position can be held.

    Parameters
    ----------
    study : Study
        The grid.
    tension : (P,) array
        Infinite where infeasible, NaN at positions set apart. [N]

    Returns
    -------
    Figure
        Grey where no tension would do.
    """
    finite = tension[np.isfinite(tension)]
    highest = float(np.percentile(finite, HIGHEST_SHOWN)) if len(finite) else 1.0
    norm = Normalize(vmin=float(finite.min()) if len(finite) else 0.0, vmax=max(highest, 1e-9))
    return _slices(study, tension, norm, "viridis", "minimax tension [N]")


@house_style
def value_slices(study: Study, values: FloatArray, label: str) -> Figure:
    """Any figure, (P,), slice by slice; grey where it is infinite, white where it is NaN."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    return _slices(study, values, Normalize(vmin=low, vmax=max(high, low + 1e-9)), "viridis", label)


def _slices(study: Study, values: FloatArray, norm: Normalize, colours: str, label: str) -> Figure:
    axis, levels = sliced(study)
    first, second = (other for other in range(3) if other != axis)
    grid = study.table.workspace.points
    cut = np.take(values.reshape(grid), levels, axis=axis)
    heights = np.unique(study.positions[:, axis])
    edges = [cell_edges(study.region[other], grid[other]) for other in (first, second)]
    width, height = (float(edge[-1] - edge[0]) for edge in edges)
    tall = (FULL_WIDTH - 1.2) / len(levels) * height / width
    figure = new_figure(FULL_WIDTH, float(np.clip(tall, 1.0, 4.0)) + 1.0)
    panels = figure.subplots(1, len(levels), squeeze=False, sharex=True, sharey=True)[0]
    for column, level in enumerate(levels):
        axes: Axes = panels[column]
        plane = np.take(cut, column, axis=axis)
        _mesh(axes, edges, plane, norm, colours)
        if len(levels) > 1:
            axes.set_title(f"{'xyz'[axis]} = {heights[level]:.2f} m", fontsize=8.5)
        axes.set_xlabel(f"{'xyz'[first]} [m]")
    panels[0].set_ylabel(f"{'xyz'[second]} [m]")
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=list(panels), extend="both", shrink=0.9, pad=0.01)
    bar.set_label(label, fontsize=8)
    bar.ax.tick_params(labelsize=7)
    if np.isinf(values).any():
        figure.legend(handles=[Patch(color=NEVER, label="no tensions hold")], loc="outside lower center")
    return figure


def _mesh(axes: Axes, edges: Sequence[FloatArray], plane: FloatArray, norm: Normalize, colours: str) -> None:
    never = np.ma.masked_where(~np.isinf(plane), np.ones_like(plane))
    axes.pcolormesh(*edges, never.T, cmap=ListedColormap([NEVER]), rasterized=True)
    axes.pcolormesh(*edges, np.ma.masked_invalid(plane).T, norm=norm, cmap=colours, rasterized=True)
    axes.set_aspect("equal")
    axes.tick_params(labelsize=7)


@house_style
def planar_maps(study: Study, maps: Sequence[tuple[str, BoolArray]]) -> Figure:
    """Feasible positions of a planar grid, one map each, as figures 5, 7 and 8 of Qi et al. 2020, arXiv:2012.12387.

    Parameters
    ----------
    study : Study
        Its grid has a single position along one axis.
    maps : sequence of (str, (P,) array of bool)
        Title, and where the required wrenches can be held.

    Returns
    -------
    Figure
        Two maps in a row.
    """
    axis, _ = sliced(study)
    first, second = (other for other in range(3) if other != axis)
    grid = study.table.workspace.points
    edges = [cell_edges(study.region[other], grid[other]) for other in (first, second)]
    width, height = (float(edge[-1] - edge[0]) for edge in edges)
    columns = min(MAPS_PER_ROW, len(maps))
    rows = -(-len(maps) // columns)
    tall = FULL_WIDTH / columns * float(np.clip(height / width, 0.15, 1.2)) + 0.55
    figure = new_figure(FULL_WIDTH, rows * tall + 0.5)
    panels = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes, (title, feasible) in zip(panels.ravel(), maps, strict=False):
        shown = np.take(feasible.reshape(grid), 0, axis=axis).astype(np.float64)
        axes.pcolormesh(*edges, shown.T, cmap=ListedColormap([NEVER, BLUE]), vmin=0.0, vmax=1.0, rasterized=True)
        axes.set_title(fill(title, TITLE_WIDTH), fontsize=8.5)
        axes.set_aspect("equal")
        axes.tick_params(labelsize=7)
    for axes in panels.ravel()[len(maps) :]:
        axes.set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel(f"{'xyz'[first]} [m]")
    for axes in panels[:, 0]:
        axes.set_ylabel(f"{'xyz'[second]} [m]")
    figure.legend(
        handles=[Patch(color=BLUE, label="held"), Patch(color=NEVER, label="not held")],
        loc="outside lower center",
        ncols=2,
    )
    return figure
