"""Pictures of the drive: its torque-speed plane with what is asked of it, and its histories over a move."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from actuator_select.model.actuation import ROUNDING, Check, voltage_limit
from actuator_select.model.arrays import FloatArray
from actuator_select.model.trajectory import TorqueTest
from actuator_select.report.style import BLUE, CABLE_COLOURS, GREY, ORANGE, RED, house_style, new_figure
from actuator_select.selection import Simulation
from actuator_select.selection.dossier import ActuatorDetail
from actuator_select.selection.simulation import UNITS
from actuator_select.units import rad_per_s, rpm

ROOM = 1.3  # of the axes around limits and cloud
MOST_STRETCH = 4.0  # of an axis, for a short limit beyond everything else; a higher one is told in the legend alone


@house_style
def torque_speed_plane(detail: ActuatorDetail) -> Figure:
    """Torque and speed at the motor in four quadrants: its limits and a sample of the demand.

    Rated torque up to rated speed bounds what is continuous, peak torque up to the greatest speed what is short, each
    where it is known; the voltage line stands where the motor's figures are DC.

    Parameters
    ----------
    detail : ActuatorDetail
        One actuator with its cloud.

    Returns
    -------
    Figure
        Winding in is positive.
    """
    figure = new_figure(6.6, 3.5)
    axes = figure.subplots()
    motor, cloud = detail.figures, detail.cloud
    speed = rpm(cloud.speed)
    axes.scatter(
        speed, cloud.total_torque, s=3, color=ORANGE, alpha=0.35, linewidths=0.0, rasterized=True, label="_total"
    )
    axes.scatter(speed, cloud.load_torque, s=3, color=BLUE, alpha=0.5, linewidths=0.0, rasterized=True, label="_load")
    torque, fastest = float(motor.motor_torque[0]), rpm(float(motor.motor_speed[0]))
    peak, greatest = detail.peak_torque, rpm(detail.greatest_speed)
    height = _extent([cloud.total_torque, cloud.load_torque], torque, peak)
    width = _extent([speed], fastest, greatest)
    axes.set_xlim(-width, width)
    axes.set_ylim(-height, height)
    handles = [
        *_box(axes, (fastest, torque), ("rated speed", "rated torque"), BLUE, "-"),
        *_box(axes, (greatest, peak), ("greatest speed", "peak torque"), RED, "-."),
        *_voltage_lines(axes, detail),
        Line2D([], [], color=BLUE, marker="o", linestyle="", markersize=3, label="load torque"),
        Line2D([], [], color=ORANGE, marker="o", linestyle="", markersize=3, label="load and rotor acceleration"),
    ]
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_xlabel("motor speed, winding in positive [rpm]")
    axes.set_ylabel("motor torque [N m]")
    _name_quadrants(axes, width, height)
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2)
    return figure


def plane_caption(detail: ActuatorDetail) -> str:
    """What bounds the points of a torque-speed plane, in words."""
    text = "Blue points belong inside the blue lines (rated torque and speed, continuous)"
    if detail.why_no_voltage:
        text += f"; the motor's electrical figures are {detail.why_no_voltage}, so that no voltage line bounds it"
    elif np.isfinite(voltage_limit(detail.figures)[0]):
        text += ", orange points between the dashed lines (voltage)"
    if not np.isnan([detail.peak_torque, detail.greatest_speed]).all():
        text += ". Dash-dotted: the maker's limits for a short time (peak torque, greatest speed)"
    return f"{text}."


def _extent(clouds: Sequence[FloatArray], rated: float, short: float) -> float:
    """Half an axis: what is asked and the rated limit, and the short limit unless that would flatten the rest."""
    asked = [float(np.max(np.abs(one[np.isfinite(one)]), initial=0.0)) for one in clouds]
    within = max(*asked, rated if np.isfinite(rated) else 0.0, 1e-9)
    return ROOM * (short if within < short <= MOST_STRETCH * within else within)


def _box(axes: Axes, limits: tuple[float, float], names: tuple[str, str], colour: str, dash: str) -> list[Line2D]:
    """Draw a limit of speed and of torque, each where it is known; the legend's handle tells the figures."""
    speed, torque = limits
    if not np.isfinite(limits).any():
        return []
    wide, high = (min(one, end) for one, end in zip(np.nan_to_num(limits, nan=np.inf), _ends(axes), strict=True))
    style: dict[str, Any] = {"color": colour, "linestyle": dash, "linewidth": 1.4}
    for sign in (-1.0, 1.0):
        if torque <= _ends(axes)[1]:
            axes.plot([-wide, wide], [sign * torque, sign * torque], **style)
        if speed <= _ends(axes)[0]:
            axes.plot([sign * speed, sign * speed], [-high, high], **style)
    told = [
        f"{name} {value:.4g} {unit}"
        for name, value, unit in ((names[1], torque, "N m"), (names[0], speed, "rpm"))
        if np.isfinite(value)
    ]
    return [Line2D([], [], **style, label=", ".join(told))]


def _ends(axes: Axes) -> tuple[float, float]:
    """Upper ends of both axes."""
    return axes.get_xlim()[1], axes.get_ylim()[1]


def _name_quadrants(axes: Axes, width: float, height: float) -> None:
    """Say in each corner what the motor does there."""
    for x, y, text in (
        (1, 1, "winding in, driving"),
        (-1, 1, "winding out, braking"),
        (-1, -1, "winding out, driving"),
        (1, -1, "winding in, braking"),
    ):
        axes.text(
            0.98 * x * width,
            0.97 * y * height,
            text,
            ha="right" if x > 0 else "left",
            va="top" if y > 0 else "bottom",
            fontsize=7.5,
            color=GREY,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8},
        )


def _voltage_lines(axes: Axes, detail: ActuatorDetail) -> list[Line2D]:
    """Torque that ±U leaves at every speed: m = C_m/R_r (±U - C_e ω) - B ω, from eq. 21; none unless U is DC."""
    motor = detail.figures
    gain = float(motor.torque_constant[0] / motor.resistance[0])
    voltage, back_emf = float(voltage_limit(motor)[0]), float(motor.back_emf_constant[0])
    friction = float(motor.friction[0])
    if not np.isfinite([gain, voltage, back_emf, friction]).all():
        return []
    speed = np.linspace(-1.0, 1.0, 2) * rad_per_s(_ends(axes)[0])
    for sign in (1.0, -1.0):
        torque = gain * (sign * voltage - back_emf * speed) - friction * speed
        axes.plot(rpm(speed), torque, color=RED, linestyle="--", linewidth=1.4)
    return [Line2D([], [], color=RED, linewidth=1.4, linestyle="--", label=f"full voltage, {voltage:g} V")]


@house_style
def simulation_figure(run: Simulation) -> Figure:
    """Shaft speed, torque, acceleration and motor voltage over a move, limits drawn in, as figure 6 of the paper.

    Parameters
    ----------
    run : Simulation
        The move.

    Returns
    -------
    Figure
        A panel over time for each check that applies to the actuator.
    """
    figure = new_figure(7.2, 0.4 + 1.5 * len(run.checks))
    panels = figure.subplots(len(run.checks), 1, sharex=True)
    names = {
        Check.SPEED: "shaft speed",
        Check.TORQUE: "load torque" if run.history.torque_test is TorqueTest.LOAD else "torque,\nload and rotor",
        Check.ACCELERATION: "shaft acceleration",
        Check.VOLTAGE: "motor voltage",
    }
    for axes, check in zip(panels, run.checks, strict=True):
        _history(axes, run, check)
        axes.set_ylabel(f"{names[check]}\n[{UNITS[check]}]")
    panels[-1].set_xlabel("time [s]")
    curves = [Line2D([], [], **_line(cable), label=f"actuator {cable + 1}") for cable in range(run.study.robot.cables)]
    limit = Line2D([], [], color="black", linestyle="--", linewidth=1.4, label="limit")
    figure.legend(handles=[*curves, limit], loc="outside lower center", ncols=5)
    return figure


def _line(cable: int) -> dict[str, Any]:
    """Colour and dash of a cable's curve; every set of colours has a dash of its own."""
    count = len(CABLE_COLOURS)
    dashes = ("-", (0, (4, 1.5)), (0, (1, 1)), "-.")
    dash = dashes[(cable // 4) % len(dashes)]
    return {"color": CABLE_COLOURS[cable % count], "linestyle": dash, "linewidth": 1.2}


def _history(axes: Axes, run: Simulation, check: Check) -> None:
    times, values = run.history.times, run.history.of(check)
    limit = run.limits[check]
    for cable in range(values.shape[1]):
        axes.plot(times, values[:, cable], **_line(cable))
    if np.isfinite(limit):
        largest = np.nanmax(np.abs(values), initial=0.0)
        # A limit far above everything would flatten the curves: say it instead.
        if limit <= 3.0 * largest:
            for sign in (1.0, -1.0):
                axes.axhline(sign * limit, color="black", linestyle="--", linewidth=1.4)
            over = np.abs(values) > limit * (1.0 + ROUNDING)
            axes.fill_between(
                times,
                0.0,
                1.0,
                where=over.any(axis=1),
                transform=axes.get_xaxis_transform(),
                color=RED,
                alpha=0.10,
                linewidth=0.0,
            )
        else:
            axes.text(
                0.995,
                0.96,
                f"limit ±{limit:.4g} {UNITS[check]}, beyond this panel",
                transform=axes.transAxes,
                ha="right",
                va="top",
                fontsize=7.5,
                color=RED,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
            )
    elif np.isnan(values).all():
        axes.text(0.5, 0.5, "not evaluated: a figure is unknown", transform=axes.transAxes, ha="center", va="center")
    for corner in run.move.profile.corners[1:-1]:
        axes.axvline(corner, color=GREY, linewidth=0.5, linestyle=":")
    axes.axhline(0.0, color="black", linewidth=0.5)
    axes.margins(x=0.0)
