"""``actuator-select report``."""

import shlex
from datetime import datetime
from pathlib import Path

import click

from actuator_select.cli import console, options
from actuator_select.cli.rank import print_ranking


@click.command("report")
@click.argument("study", metavar="STUDY")
@click.option(
    "--output",
    type=click.Path(path_type=Path),
    metavar="FILE.html",
    help="Where to write the report; STUDY.html in the current folder by default.",
)
@options.set_option
@options.where_option
@click.option(
    "--require", type=click.FloatRange(0.0, 100.0), metavar="PERCENT", help="Required share of the workspace."
)
@click.option("--project", default="", help="Project, for the title block.")
@click.option("--author", default="", help="Author, for the title block.")
@click.option("--revision", default="", help="Revision, for the title block.")
@options.no_limit_option
@options.database_option
def command(
    study: str,
    output: Path | None,
    overrides: tuple[str, ...],
    where: str,
    require: float | None,
    project: str,
    author: str,
    revision: str,
    no_limit: bool,
    database: str | None,
) -> None:
    """Write the design report, one self-contained HTML file.

    Prints the ranking, then the path of the report. A study with `candidates.kind = "none"` gets a report on where its
    robot can work.

    \b
    Example:
        actuator-select report cpr8 --output cpr8.html --project "Camera robot" --author "M. Muster"
    """
    from actuator_select._resources import refuse_no_folder, replace_atomically
    from actuator_select.database import open_catalogue
    from actuator_select.report import ReportDetails, render_report, render_workspace_report
    from actuator_select.selection import rank
    from actuator_select.study import load_study, parse_overrides

    loaded = load_study(study, parse_overrides(overrides), limit=not no_limit)
    path = output if output is not None else Path(f"{Path(study).stem}.html")
    refuse_no_folder(path)
    details = ReportDetails(
        generated_at=datetime.now().astimezone(),
        project=project,
        author=author,
        revision=revision,
        command=_command_line(),
    )
    if loaded.table.candidates.kind == "none":
        with console.progress("Evaluating") as progress:
            page = render_workspace_report(loaded, details, progress)
        replace_atomically(path, page)
        click.echo(f"Report: {path.resolve()}")
        return
    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        with console.progress("Evaluating") as progress:
            selection = rank(loaded, catalogue, where=where, require=require, progress=progress)
        console.say("Drawing the report …")
        page = render_report(selection, catalogue, details)
    replace_atomically(path, page)
    print_ranking(selection, only_meeting=False)
    click.echo(f"Report: {path.resolve()}")


def _command_line() -> str:
    """The command as it was typed, without the folders of this machine."""
    arguments = click.get_current_context().find_root().obj or ()
    return shlex.join(["actuator-select", *arguments])
