"""Pictures of how a workspace depends on what was varied."""

from collections.abc import Sequence
from itertools import product
from math import isclose

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from actuator_select.model.arrays import FloatArray
from actuator_select.report.grids import FULL_WIDTH
from actuator_select.report.robot_workspace import superscript
from actuator_select.report.style import BLUE, house_style, new_figure
from actuator_select.selection.sweeps import Sweep, SweepPoint
from actuator_select.study.sweeping import SweepAxis

COMPACT = (3.65, 2.75)  # width and height of one of many, inches
HEIGHT = 4.2  # inches
MANY = 8  # values of a key; two keys with more are drawn as a map
MOST_LINES = 12  # that a legend names
LEGEND_WIDTH = 100  # characters of one row of a legend over the full width
DASHES = ("-", "--", "-.", ":")
MEASURES = {"": "feasible share", "m": "length, estimated", "m2": "area, estimated", "m3": "volume, estimated"}
AXES = ("x", "y", "z")
SUFFIXES = {
    "_rad_per_s2": "rad/s²",
    "_rad_per_s": "rad/s",
    "_m_per_s2": "m/s²",
    "_m_per_s": "m/s",
    "_kg_m2": "kg m²",
    "_n_m": "N m",
    "_percent": "%",
    "_deg": "°",
    "_rad": "rad",
    "_kg": "kg",
    "_m": "m",
    "_n": "N",
    "_s": "s",
}
VECTORS = {"force", "moment", "force_reach", "moment_reach", "centre_of_gravity"}


@house_style
def sweep_figure(sweep: Sweep, *, compact: bool = False) -> Figure:
    """Draw a sweep: area, volume or share over the first key.

    Parameters
    ----------
    sweep : Sweep
        Of one key or more.
    compact : bool
        Half a page wide, without a title: for reports with many of them.

    Returns
    -------
    Figure
        A line per value of the second key, or a map where both have many values; of three keys and more, a line per
        combination of the further ones. Keys with a single value stand in the title; positions on the right.
    """
    measured = sweep.points[0].measure is not None
    values = np.array([_value(point, measured=measured) for point in sweep.points])
    unit = superscript(sweep.points[0].measure_unit or "")
    name = f"{MEASURES[sweep.points[0].measure_unit or '']} [{unit or '%'}]"
    first, further = sweep.axes[0], sweep.axes[1:]
    order = np.argsort(first.values)
    along, table = np.array(first.values)[order], values.reshape(len(order), -1)[order]
    varied = [axis for axis in further if len(axis.values) > 1]
    labels = [
        ", ".join(_setting(axis, value) for axis, value in zip(varied, one, strict=True))
        for one in product(*(axis.values for axis in varied))
    ]
    figure = new_figure(*(COMPACT if compact else (FULL_WIDTH, HEIGHT)))
    axes = figure.subplots()
    axes.set_xlabel(key_label(first.key))
    if not compact:
        fixed = "".join(f", {_setting(axis, axis.values[0])}" for axis in further if len(axis.values) == 1)
        about = f"{sweep.study.name}: {sweep.kind.value} workspace, {sweep.tension_model.value}{fixed}"
        axes.set_title(about, fontsize=9.0)
    if len(varied) == 1 and (len(labels) > MOST_LINES or min(len(order), len(labels)) > MANY):
        _map(figure, axes, along, varied[0], table, name)
        return figure
    axes.set_ylabel(name)
    _lines(axes, along, table, labels, compact=compact)
    _count_positions(axes, sweep)
    if varied and len(labels) <= MOST_LINES:
        room = LEGEND_WIDTH // (2 if compact else 1)
        columns = max(1, min(len(labels), room // (max(map(len, labels)) + 6)))
        figure.legend(loc="outside lower center", ncols=columns, fontsize=7.5 if compact else 8.0)
    return figure


def key_label(key: str) -> str:
    """``robot.w_p [m]`` for ``robot.w_p_m``, ``payload.force_y [N]`` for ``payload.force_n[1]``."""
    stem, bracket, index = key.partition("[")
    for suffix, unit in SUFFIXES.items():
        if not stem.endswith(suffix):
            continue
        name = stem.removesuffix(suffix)
        component = index.rstrip("]")
        if name.rsplit(".", 1)[-1] in VECTORS and component in {"0", "1", "2"}:
            return f"{name}_{AXES[int(component)]} [{unit}]"
        return f"{name}{bracket}{index} [{unit}]"
    return key


def _setting(axis: SweepAxis, value: float) -> str:
    """``robot.t5 = 3000 N``."""
    name, bracket, unit = key_label(axis.key).partition(" [")
    return f"{name} = {value:g}{' ' if bracket and unit != '°]' else ''}{unit.removesuffix(']')}"


def _map(figure: Figure, axes: Axes, along: FloatArray, second: SweepAxis, table: FloatArray, name: str) -> None:
    across = np.argsort(second.values)
    heights = np.array(second.values)[across]
    shaded = axes.pcolormesh(along, heights, table.T[across], shading="nearest", rasterized=True)
    axes.set_ylabel(key_label(second.key))
    figure.colorbar(shaded, ax=axes, label=name)


def _lines(axes: Axes, along: FloatArray, table: FloatArray, labels: Sequence[str], *, compact: bool) -> None:
    shades = colormaps["viridis"](np.linspace(0.0, 0.9, max(len(labels), 2)))
    for column, label in enumerate(labels):
        colour = BLUE if len(labels) == 1 else shades[column]
        dash = DASHES[column % len(DASHES)]
        axes.plot(along, table[:, column], color=colour, linestyle=dash, marker="o", markersize=2.5, label=label)
    axes.grid(visible=True, color="#E2E2E2", linewidth=0.6)
    axes.locator_params(axis="x", nbins=4 if compact else 7)


def _count_positions(axes: Axes, sweep: Sweep) -> None:
    """Positions on the right, where every one stands for as much."""
    cells = [point.measure / point.feasible_poses for point in sweep.points if point.measure]
    if not cells or not all(isclose(cell, cells[0], rel_tol=1e-9) for cell in cells):
        return
    cell = cells[0]

    def count(size: FloatArray) -> FloatArray:
        return size / cell

    def size(count: FloatArray) -> FloatArray:
        return count * cell

    right = axes.secondary_yaxis("right", functions=(count, size))  # type: ignore[arg-type]  # stubs ask for less
    right.set_ylabel("positions")


def _value(point: SweepPoint, *, measured: bool) -> float:
    value = point.measure if measured else point.feasible_percent
    return float("nan") if value is None else value
