"""``actuator-select robot``."""

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options

if TYPE_CHECKING:
    from actuator_select.selection.robot_sheet import RobotSheet


@click.group("robot")
def command() -> None:
    """Look at a robot before any drive is chosen."""


@command.command("show")
@click.argument("study", metavar="STUDY")
@options.set_option
@options.plot_option("Draw the robot")
@click.option("--open", "opens", is_flag=True, help="Open the picture in the viewer of this computer.")
@options.format_option("table", "json", "csv")
def show(study: str, overrides: tuple[str, ...], plot: Path | None, opens: bool, output_format: str) -> None:
    """Show a robot: rope lengths, forces on the frame, cable speeds, and what to mind.

    \b
    Examples:
        actuator-select robot show cpr8 --plot cpr8.svg
        actuator-select robot show hall.toml --open
        actuator-select robot show hall.toml --set workspace.points=[15,11,7] --format csv

    Lengths and speeds are over all positions and orientations of the study; forces are those of standing still, over
    the poses that can be held. CSV gives a row per cable.
    """
    from actuator_select.selection.robot_record import COLUMNS, cable_row, robot_record
    from actuator_select.selection.robot_sheet import robot_sheet
    from actuator_select.study import load_study, parse_overrides

    if opens and plot is None:
        plot = Path(f"{Path(study).stem}.svg")
    draw = options.plot_writer(plot)
    loaded = load_study(study, parse_overrides(overrides))
    with console.progress("Looking at the robot") as progress:
        sheet = robot_sheet(loaded, progress)
    if plot is not None:
        from actuator_select.report.robot_figure import robot_figure

        draw(robot_figure(sheet.study))
        if opens and click.launch(str(plot)) != 0:
            console.warn(f"no viewer could be started; open {plot} yourself")
    if output_format == "json":
        console.emit_json(robot_record(sheet))
    elif output_format == "csv":
        console.emit_csv(COLUMNS, [cable_row(cable) for cable in sheet.cables])
    else:
        print_robot(sheet)
        typed = [word for one in overrides for word in ("--set", one)]
        console.say(f"Next: {shlex.join(['actuator-select', 'rank', study, *typed])}")


def print_robot(sheet: "RobotSheet") -> None:
    """Print what the robot is, the table of cables, frame points with several cables, and warnings."""
    from actuator_select.selection.robot_record import DISTRIBUTION, robot_items

    click.echo(f"Robot of study {sheet.study.name}")
    for name, text in robot_items(sheet).items():
        click.echo(f"  {name:<12}{text}")
    header = ["cable", "on the frame [m]", "on the platform [m]", "length [m]", "speed [m/s]", "largest force [N]"]
    header += ["its direction", "with the platform at [m]"]
    several = len(sheet.study.loads) > 1
    bounded = any(cable.tension_bound is not None for cable in sheet.cables)
    elastic = any(cable.unstretched is not None for cable in sheet.cables)
    rows = [
        [
            str(cable.number),
            _vector(cable.frame_anchor),
            _vector(cable.platform_anchor),
            f"{cable.shortest:.3f} … {cable.longest:.3f}",
            f"{cable.speed:.3g}",
            _force(cable.largest.force),
            _vector(cable.largest.direction, 2),
            _vector(cable.largest.position) + (f", {cable.largest.load}" if several and cable.largest.load else ""),
            *([_force(cable.tension_bound)] if bounded else []),
            *(["–" if cable.unstretched is None else "{:.3f} … {:.3f}".format(*cable.unstretched)] if elastic else []),
        ]
        for cable in sheet.cables
    ]
    console.emit_table(
        [*header, *(["at most [N]"] if bounded else []), *(["unstretched [m]"] if elastic else [])],
        rows,
        right=(0, 3, 4, 5, 8, 9) if bounded else (0, 3, 4, 5, 8),
    )
    click.echo(
        "Largest force: on the frame, towards the platform, standing still where that can be held; tensions by the\n"
        f"{DISTRIBUTION[sheet.study.tension_model]}.\n"
        "Motion comes on top; a frame that bears the greatest tensions allowed bears it."
    )
    _print_shared_points(sheet, header[6:8])
    for warning in sheet.warnings:
        console.warn(warning.text)


def _print_shared_points(sheet: "RobotSheet", where: list[str]) -> None:
    """Print the frame points that several cables share; `where` heads the last two columns."""
    shared = [point for point in sheet.frame_points if len(point.cables) > 1]
    if shared:
        console.emit_table(
            ["cables", "frame point they share [m]", "largest force together [N]", *where],
            [
                [
                    " and ".join(str(number) for number in point.cables),
                    _vector(point.anchor),
                    _force(point.largest.force),
                    _vector(point.largest.direction, 2),
                    _vector(point.largest.position),
                ]
                for point in shared
            ],
            right=(2,),
        )


def _vector(vector: tuple[float, float, float] | None, digits: int = 3) -> str:
    return "–" if vector is None else ", ".join(f"{one:.{digits}f}" for one in vector)


def _force(force: float | None) -> str:
    return "–" if force is None else f"{force:.4g}" if force < 1e4 else f"{force:.0f}"  # noqa: PLR2004 - whole newtons
