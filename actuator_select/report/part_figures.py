"""Pictures of single parts: torque over speed, as far as their figures state it."""

import textwrap
from math import ceil
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from actuator_select.report.style import BLUE, GREEN, GREY, ORANGE, RED, house_style, new_figure
from actuator_select.selection.part_sketch import Characteristics, Duty, Limit
from actuator_select.selection.plausibility import figure as four_digits

ROOM = 1.12  # of the axes around the greatest figure
TEXT_WIDTH = 105  # characters of a line below the axes
WIDTH, HEIGHT = 6.8, 3.7  # of the axes, inches
ENTRY_HEIGHT, LINE_HEIGHT = 0.17, 0.14  # of a line of the legend and of a remark, inches
COLOURS = {Duty.CONTINUOUS: BLUE, Duty.SHORT: ORANGE, Duty.PART: GREEN, Duty.EMERGENCY: RED}
DASHES: tuple[Literal["-", "--", "-.", ":"], ...] = ("-", "--", "-.", ":")


@house_style
def part_figure(part: Characteristics) -> Figure:
    """Draw load over speed of a part.

    Parameters
    ----------
    part : Characteristics
        What its row states.

    Returns
    -------
    Figure
        Every limit with its figure and unit in the legend; below it, what is not stated and what to know.
    """
    remarks = [f"not stated: {'; '.join(part.missing)}"] if part.missing else []
    lines = [
        line for one in (*remarks, *part.notes) for line in textwrap.wrap(one, TEXT_WIDTH, subsequent_indent="   ")
    ]
    entries = len(part.regions) + len(part.slopes) + len(part.limits) + len(part.marks)
    below = ENTRY_HEIGHT * (ceil(entries / 2) + len(part.slopes)) + LINE_HEIGHT * len(lines) + 0.15
    figure = new_figure(WIDTH, HEIGHT + below)
    axes, words = figure.subplots(2, 1, height_ratios=[HEIGHT, below])
    axes.set_title(part.title, loc="left")
    axes.set_xlabel(f"{part.speed_name} [{part.speed_unit}]")
    axes.set_ylabel(f"{part.load_name} [{part.load_unit}]")
    if not _set_axes(axes, part):
        axes.text(0.5, 0.5, "no figure to draw is stated", transform=axes.transAxes, ha="center", va="center")
    words.set_axis_off()
    if handles := _draw(axes, part):
        words.legend(handles=handles, loc="upper left", ncols=2, borderaxespad=0.0, borderpad=0.0)
    words.text(0.0, 0.0, "\n".join(lines), transform=words.transAxes, va="bottom", fontsize=7.5, color="#444444")
    return figure


def _set_axes(axes: Axes, part: Characteristics) -> bool:
    """Make room for all that is drawn; whether there is anything."""
    speeds = [corner[0] for region in part.regions for corner in region.corners]
    speeds += [slope.speed for slope in part.slopes] + [mark.speed for mark in part.marks]
    speeds += [limit.value for limit in part.limits if not limit.of_load]
    loads = [corner[1] for region in part.regions for corner in region.corners]
    loads += [slope.load for slope in part.slopes] + [mark.load for mark in part.marks]
    loads += [limit.value for limit in part.limits if limit.of_load]
    widest, highest = max(speeds, default=0.0), max(loads, default=0.0)
    axes.set_xlim(0.0, ROOM * widest if widest > 0.0 else 1.0)
    axes.set_ylim(0.0, ROOM * highest if highest > 0.0 else 1.0)
    # An axis of which no figure is known has no scale.
    if widest <= 0.0:
        axes.set_xticks([])
    if highest <= 0.0:
        axes.set_yticks([])
    return widest > 0.0 or highest > 0.0


def _draw(axes: Axes, part: Characteristics) -> list[Patch | Line2D]:
    """Draw everything; handles for the legend, each with its figure."""
    handles: list[Patch | Line2D] = []
    for region in part.regions:
        colour = COLOURS[region.duty]
        # White first, so that what holds continuously does not mix with what holds for short.
        for face, alpha in (("white", 1.0), (colour, 0.16)):
            axes.add_patch(Polygon(region.corners, closed=True, facecolor=face, alpha=alpha, edgecolor="none"))
        handles.append(Patch(facecolor=colour, alpha=0.25, label=region.name))
    for slope in part.slopes:
        dash = DASHES[1] if slope.printed else DASHES[0]
        axes.plot([0.0, slope.speed], [slope.load, 0.0], color=RED, linestyle=dash, linewidth=1.5, clip_on=False)
        ends = f"{four_digits(slope.load)} {part.load_unit} to {four_digits(slope.speed)} {part.speed_unit}"
        handles.append(Line2D([], [], color=RED, linestyle=dash, linewidth=1.5, label=f"{slope.name},\n{ends}"))
    styles: dict[tuple[Duty, bool], int] = {}
    for limit in part.limits:
        number = styles.setdefault((limit.duty, limit.of_load), 0)
        styles[limit.duty, limit.of_load] += 1
        handles.append(_draw_limit(axes, part, limit, DASHES[(number + (0 if limit.of_load else 2)) % len(DASHES)]))
    for mark in part.marks:
        axes.plot(mark.speed, mark.load, color="black", marker="o", markersize=5, linestyle="none", clip_on=False)
        at = f"{four_digits(mark.speed)} {part.speed_unit}, {four_digits(mark.load)} {part.load_unit}"
        handles.append(Line2D([], [], color="black", marker="o", linestyle="none", label=f"{mark.name}, {at}"))
    if part.limits or part.slopes:
        axes.grid(color=GREY, alpha=0.2, linewidth=0.5)
    return handles


def _draw_limit(axes: Axes, part: Characteristics, limit: Limit, dash: Literal["-", "--", "-.", ":"]) -> Line2D:
    colour = COLOURS[limit.duty]
    if limit.of_load:
        axes.axhline(limit.value, color=colour, linestyle=dash, linewidth=1.3)
    else:
        axes.axvline(limit.value, color=colour, linestyle=dash, linewidth=1.3)
    unit = part.load_unit if limit.of_load else part.speed_unit
    return Line2D(
        [], [], color=colour, linestyle=dash, linewidth=1.3, label=f"{limit.name}, {four_digits(limit.value)} {unit}"
    )
