"""``actuator-select study``."""

from pathlib import Path

import click

from actuator_select.cli import console, options


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
@click.option("--force", is_flag=True, help="Replace an existing file.")
def new(file: Path, force: bool) -> None:
    """Write a commented study file to start from.

    It describes a small four-cable camera robot with explicit anchors and works as it stands.
    """
    from actuator_select._resources import replace_atomically
    from actuator_select.errors import OutputNotWritable
    from actuator_select.study import parse_study, starter_text

    if file.exists() and not force:
        raise OutputNotWritable(f"{file} exists already; choose another name, or replace it with --force")
    name = file.stem
    text = starter_text(name)
    parse_study(text, place=str(file))
    replace_atomically(file, text)
    click.echo(f"Wrote {file}. Edit it, then: actuator-select rank {file}")
