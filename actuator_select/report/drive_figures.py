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
    standstill = _standstill(detail)
    continuous = standstill if np.isfinite(standstill) else torque
    height = _extent([cloud.total_torque, cloud.load_torque], continuous, peak)
    width = _extent([speed], fastest, greatest)
    axes.set_xlim(-width, width)
    axes.set_ylim(-height, height)
    handles = [
        *_box(axes, (fastest, torque), ("rated speed", "rated torque"), BLUE, "-"),
        *_box(axes, (np.nan, standstill), ("", "standstill torque, continuous near zero speed:"), BLUE, ":"),
        *_box(axes, (greatest, peak), ("greatest speed", "peak torque"), RED, "-."),
        *_voltage_lines(axes, detail),
        *_point_handles(detail),
    ]
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_xlabel("motor speed, winding in positive [rpm]")
    axes.set_ylabel("motor torque [N m]")
    _name_quadrants(axes, width, height)
    if handles:
        axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2)
    return figure


def _point_handles(detail: ActuatorDetail) -> list[Line2D]:
    """Legend of the points that there are."""
    cloud = detail.cloud
    style: dict[str, Any] = {"marker": "o", "linestyle": "", "markersize": 3}
    handles = [] if cloud.is_empty else [Line2D([], [], color=BLUE, label="load torque", **style)]
    if _has_total(detail):
        handles.append(Line2D([], [], color=ORANGE, label="load and rotor acceleration", **style))
    return handles


def _has_total(detail: ActuatorDetail) -> bool:
    return bool(np.isfinite(detail.cloud.speed + detail.cloud.total_torque).any())


def _standstill(detail: ActuatorDetail) -> float:
    """Standstill torque of an AC servo whose rated torque is unknown, else NaN. [N m]"""
    is_servo = bool(detail.why_no_voltage)
    return detail.standstill_torque if is_servo and np.isnan(detail.figures.motor_torque[0]) else np.nan


def plane_caption(detail: ActuatorDetail) -> str:
    """What is drawn in a torque-speed plane, in words: points, what bounds them, and why something is not there."""
    text = [_demand_words(detail) if detail.cloud.is_empty else "", _continuous_words(detail)]
    if np.isfinite(_standstill(detail)):
        text.append("Dotted: the standstill torque, which holds continuously near zero speed")
    if detail.why_no_voltage:
        text.append(f"The motor's electrical figures are {detail.why_no_voltage}, so that no voltage line bounds it")
    elif _is_bounded_by_voltage(detail):
        inside = "Orange points belong between the dashed lines (voltage)" if _has_total(detail) else "Dashed: voltage"
        text.append(inside)
    if np.isfinite([detail.peak_torque, detail.greatest_speed]).any():
        names = ("peak torque", detail.peak_torque), ("greatest speed", detail.greatest_speed)
        short = ", ".join(name for name, value in names if np.isfinite(value))
        text.append(f"Dash-dotted: the maker's limits for a short time ({short})")
    return "".join(f"{one}. " for one in text if one).rstrip()


def _demand_words(detail: ActuatorDetail) -> str:
    """Why there are no points."""
    motor = detail.figures
    figures = {"ratio": motor.ratio, "efficiency": motor.efficiency, "drum radius": motor.drum_radius}
    unknown = [name for name, value in figures.items() if np.isnan(value[0])]
    if not unknown:
        return "No points are drawn, because no drive could hold the platform at any pose"
    verb = "is" if len(unknown) == 1 else "are"
    return (
        "No points are drawn: the torque demand cannot be put at the motor, because "
        f"{' and '.join(unknown)} {verb} not known"
    )


def _continuous_words(detail: ActuatorDetail) -> str:
    """What the blue lines are, as far as there are any, and what belongs between them."""
    motor = detail.figures
    known = {"torque": np.isfinite(motor.motor_torque[0]), "speed": np.isfinite(motor.motor_speed[0])}
    names = " and ".join(name for name, there in known.items() if there)
    if not names:
        return "No rated torque or speed is stated as a number, so that no blue line is drawn"
    lines = f"(rated {names}, continuous)"
    if detail.cloud.is_empty:
        return f"Blue lines: rated {names}, continuous"
    return f"Blue points belong {'inside' if all(known.values()) else 'between'} the blue lines {lines}"


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


def _is_bounded_by_voltage(detail: ActuatorDetail) -> bool:
    """Whether all that the voltage line needs is known."""
    motor = detail.figures
    needed = (motor.torque_constant, motor.resistance, voltage_limit(motor), motor.back_emf_constant, motor.friction)
    return bool(np.isfinite([one[0] for one in needed]).all())


def _voltage_lines(axes: Axes, detail: ActuatorDetail) -> list[Line2D]:
    """Torque that ±U leaves at every speed: m = C_m/R_r (±U - C_e ω) - B ω, from eq. 21; none unless U is DC."""
    if not _is_bounded_by_voltage(detail):
        return []
    motor = detail.figures
    gain = float(motor.torque_constant[0] / motor.resistance[0])
    voltage, back_emf = float(voltage_limit(motor)[0]), float(motor.back_emf_constant[0])
    friction = float(motor.friction[0])
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
