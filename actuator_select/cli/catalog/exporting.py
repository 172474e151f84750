"""``actuator-select catalog export``."""

from pathlib import Path

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.session import opened


@click.command("export")
@click.argument("kind", required=False, metavar="[KIND]")
@click.option(
    "--output", type=click.Path(path_type=Path), metavar="PATH", help="A file for one kind, a folder for all kinds."
)
@options.database_option
def export(kind: str | None, output: Path | None, database: str | None) -> None:
    """Write rows as CSV that `catalog import` reads back exactly.

    \b
    Examples:
        actuator-select catalog export motors > motors.csv
        actuator-select catalog export motors --output motors.csv
        actuator-select catalog export --output my-catalogue        (a folder with a file of every kind)
    """
    from actuator_select._resources import replace_atomically
    from actuator_select.database.kinds import find_kind

    if kind is None and output is None:
        raise click.UsageError("name a KIND, or a folder for all kinds with --output FOLDER")
    found = None if kind is None else find_kind(kind)
    with opened(database) as catalogue:
        if found is None and output is not None:
            files = catalogue.export_folder(output)
            console.say(f"Wrote {', '.join(str(file) for file in files)}")
            return
        text = catalogue.export_csv(found.name) if found is not None else ""
    if output is None:
        click.echo(text, nl=False)
    elif found is not None:
        file = output / f"{found.name}.csv" if output.is_dir() else output
        replace_atomically(file, text)
        console.say(f"Wrote {file}")
