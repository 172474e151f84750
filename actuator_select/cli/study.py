"""``actuator-select study``."""

import shlex
from pathlib import Path

import click

from actuator_select.cli import console, options
from actuator_select.cli.simulate import Vector


@click.group("study")
def command() -> None:
    """List, show and start study files.

    A study says what the robot is, what it has to do, and what counts as good enough.
    """


@command.command("list")
@options.format_option("table", "json")
def list_studies(output_format: str) -> None:
    """List the built-in studies."""
    from actuator_select.study import builtin_studies, load_study

    studies = [load_study(name) for name in builtin_studies()]
    if output_format == "json":
        console.emit_json([{"name": study.name, "description": study.table.description.strip()} for study in studies])
        return
    console.emit_table(["study", "about"], [[study.name, study.table.description.strip()] for study in studies])


@command.command("show")
@click.argument("study", metavar="STUDY")
@options.set_option
def show(study: str, overrides: tuple[str, ...]) -> None:
    """Print a study file, with overrides if there are any, after checking it.

    The output is a study file itself: `actuator-select study show cpr8 > my-robot.toml`.
    """
    from actuator_select.study import load_study, parse_overrides

    click.echo(load_study(study, parse_overrides(overrides)).text, nl=False)


@command.command("new")
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE.toml")
@click.option(
    "--template",
    default="camera-4",
    show_default=True,
    metavar="NAME",
    help="Family: camera-4, planar-4, six-six, suspended-8, constrained-8, cpr8, or anchors (with --anchors).",
)
@click.option("--hall", type=Vector(), help="Length, width and height of the frame [m].")
@click.option("--platform", type=Vector(), help="Length, width and height of the platform [m].")
@click.option("--mass", type=float, metavar="KG", help="Mass of platform and load together [kg].")
@click.option("--speed", type=float, metavar="M_PER_S", help="Greatest speed of the platform [m/s].")
@click.option(
    "--anchors",
    type=click.Path(path_type=Path),
    metavar="FILE.csv",
    help="Anchors to copy into the study, with the columns cable, frame_x_m, frame_y_m, frame_z_m, platform_x_m, "
    "platform_y_m, platform_z_m.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def new(
    file: Path,
    template: str,
    hall: tuple[float, ...] | None,
    platform: tuple[float, ...] | None,
    mass: float | None,
    speed: float | None,
    anchors: Path | None,
    force: bool,
) -> None:
    """Write a commented study file to start from; it works as it stands.

    \b
    Examples:
        actuator-select study new my-robot.toml
        actuator-select study new hall.toml --template suspended-8 --hall 15,11,5 --platform 1,1,1 --mass 300
        actuator-select study new mine.toml --template anchors --anchors anchors.csv --mass 40

    The box to work in is a part of the frame that the robot can hold with the tensions stated.
    """
    from actuator_select._resources import replace_atomically
    from actuator_select.errors import OutputNotWritable
    from actuator_select.study import TemplateOptions, parse_study, template_text

    if file.exists() and not force:
        raise OutputNotWritable(f"{file} exists already; choose another name, or replace it with --force")
    options = TemplateOptions(hall=hall, platform=platform, mass=mass, speed=speed, anchors=anchors)
    text = template_text(file.stem, template, options)
    parse_study(text, place=str(file))
    replace_atomically(file, text)
    shown = shlex.quote(str(file))
    picture = shlex.quote(str(file.with_suffix(".svg")))
    click.echo(
        f"Wrote {file}. Next: actuator-select robot show {shown} --plot {picture}, then actuator-select rank {shown}"
    )
