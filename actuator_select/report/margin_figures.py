"""Slices of a figure over the workspace: how far from its border every position is, and what tension it takes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from actuator_select.model.arrays import FloatArray
from actuator_select.report.grids import APART, FULL_WIDTH, NEVER, cell_edges, paint, sliced
from actuator_select.report.style import house_style, new_figure
from actuator_select.study import Study

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
    finite = _shown(study, margin)
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
        Light grey where no tension would do, dark where positions are set apart.
    """
    finite = _shown(study, tension)
    highest = float(np.percentile(finite, HIGHEST_SHOWN)) if len(finite) else 1.0
    norm = Normalize(vmin=float(finite.min()) if len(finite) else 0.0, vmax=max(highest, 1e-9))
    return _slices(study, tension, norm, "viridis", "minimax tension [N]")


@house_style
def value_slices(study: Study, values: FloatArray, label: str) -> Figure:
    """Any figure, (P,), slice by slice; light grey where it is infinite, dark where it is NaN."""
    finite = _shown(study, values)
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    return _slices(study, values, Normalize(vmin=low, vmax=max(high, low + 1e-9)), "viridis", label)


def _shown(study: Study, values: FloatArray) -> FloatArray:
    """Finite values in the slices that are drawn; colours that tell those apart suffice."""
    axis, levels = sliced(study)
    cut = np.take(values.reshape(study.table.workspace.points), levels, axis=axis)
    return cut[np.isfinite(cut)]


def _slices(study: Study, values: FloatArray, norm: Normalize, colours: str, label: str) -> Figure:
    axis, levels = sliced(study)
    first, second = (other for other in range(3) if other != axis)
    grid = study.table.workspace.points
    cut = np.take(values.reshape(grid), levels, axis=axis)
    heights = np.unique(study.positions[:, axis])
    edges = [cell_edges(study, other) for other in (first, second)]
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
    handles = [Patch(color=NEVER, label="no tensions hold")] if np.isinf(cut).any() else []
    handles += [Patch(color=APART, label="set apart: too near to an anchor")] if np.isnan(cut).any() else []
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=2)
    return figure


def _mesh(axes: Axes, edges: Sequence[FloatArray], plane: FloatArray, norm: Normalize, colours: str) -> None:
    paint(axes, edges, np.isinf(plane), NEVER)
    paint(axes, edges, np.isnan(plane), APART)
    axes.pcolormesh(*edges, np.ma.masked_invalid(plane).T, norm=norm, cmap=colours, rasterized=True)
    axes.set_aspect("equal")
    axes.tick_params(labelsize=7)
