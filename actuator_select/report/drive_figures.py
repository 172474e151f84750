"""Pictures of the drive: its torque-speed plane with what is asked of it, and its histories over a move."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from actuator_select.model.actuation import ROUNDING, Check
from actuator_select.report.style import BLUE, CABLE_COLOURS, GREY, ORANGE, RED, house_style, new_figure
from actuator_select.selection import Simulation
from actuator_select.selection.dossier import ActuatorDetail
from actuator_select.selection.simulation import UNITS
from actuator_select.units import rpm

ROOM = 1.3  # of the axes around limits and cloud


@house_style
def torque_speed_plane(detail: ActuatorDetail) -> Figure:
    """Torque and speed at the motor in four quadrants: rated limits, voltage line and a sample of the demand.

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
    if np.isfinite([torque, fastest]).all():
        axes.plot(
            fastest * np.array([-1, 1, 1, -1, -1]), torque * np.array([-1, -1, 1, 1, -1]), color=BLUE, linewidth=1.4
        )
    _voltage_lines(axes, detail)
    finite = np.isfinite(cloud.total_torque)
    reach = np.max(np.abs(cloud.total_torque[finite]), initial=0.0)
    height = ROOM * float(np.nanmax([reach, np.max(np.abs(cloud.load_torque), initial=0.0), torque, 1e-9]))
    width = ROOM * float(np.nanmax([np.max(np.abs(speed), initial=0.0), fastest, 1e-9]))
    axes.set_xlim(-width, width)
    axes.set_ylim(-height, height)
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_xlabel("motor speed, winding in positive [rpm]")
    axes.set_ylabel("motor torque [N m]")
    _name_quadrants(axes, width, height)
    axes.legend(
        handles=[
            Line2D([], [], color=BLUE, linewidth=1.4, label="rated torque and rated speed (limits of blue)"),
            Line2D([], [], color=RED, linewidth=1.4, linestyle="--", label="full voltage (limit of orange)"),
            Line2D([], [], color=BLUE, marker="o", linestyle="", markersize=3, label="load torque"),
            Line2D([], [], color=ORANGE, marker="o", linestyle="", markersize=3, label="load and rotor acceleration"),
        ],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.17),
        ncols=2,
    )
    return figure


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


def _voltage_lines(axes: Axes, detail: ActuatorDetail) -> None:
    """Torque that ±U leaves at every speed: m = C_m/R_r (±U - C_e ω) - B ω, from eq. 21."""
    motor = detail.figures
    gain = float(motor.torque_constant[0] / motor.resistance[0])
    voltage, back_emf = float(motor.voltage[0]), float(motor.back_emf_constant[0])
    friction = float(motor.friction[0])
    if not np.isfinite([gain, voltage, back_emf, friction]).all():
        return
    fastest = np.max(np.abs(detail.cloud.speed), initial=0.0)
    speed = np.linspace(-2.0, 2.0, 2) * max(fastest, float(motor.motor_speed[0]))
    for sign in (1.0, -1.0):
        torque = gain * (sign * voltage - back_emf * speed) - friction * speed
        axes.plot(rpm(speed), torque, color=RED, linestyle="--", linewidth=1.4)


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
        Four panels over time.
    """
    figure = new_figure(7.2, 6.4)
    panels = figure.subplots(4, 1, sharex=True)
    names = {
        Check.SPEED: "shaft speed",
        Check.TORQUE: "load torque",
        Check.ACCELERATION: "shaft acceleration",
        Check.VOLTAGE: "motor voltage",
    }
    for axes, (check, name) in zip(panels, names.items(), strict=True):
        _history(axes, run, check)
        axes.set_ylabel(f"{name}\n[{UNITS[check]}]")
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
