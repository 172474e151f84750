"""``actuator-select catalog export``."""

from pathlib import Path

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.session import opened


@click.command("export")
@click.argument("kind", required=False, metavar="[KIND]")
@click.option(
    "--format",
    "file_format",
    type=click.Choice(("csv", "xlsx", "json")),
    help="What to write; by default what the ending of --output says, else CSV.",
)
@click.option(
    "--output", type=click.Path(path_type=Path), metavar="PATH", help="A file; for all kinds as CSV, a folder."
)
@options.where_option
@options.database_option
def export(kind: str | None, file_format: str | None, output: Path | None, where: str, database: str | None) -> None:
    """Write rows to files that read back exactly: CSV, an XLSX workbook, or JSON.

    Without KIND everything is written: as CSV a folder with a file for each kind, as XLSX a workbook with a sheet for
    each, as JSON one object. An unknown figure is an empty cell (JSON: left out), an unlimited one the word unlimited.
    Names in JSON are those of OPC 40400-1 where it has one (`actuator-select catalog fields KIND` lists them).

    \b
    Examples:
        actuator-select catalog export motors > motors.csv
        actuator-select catalog export motors --where "rated_power_w >= 50" --output motors.xlsx
        actuator-select catalog export --output catalogue.xlsx
        actuator-select catalog export --output catalogue.json
        actuator-select catalog export --output my-catalogue        (a folder with a CSV file of every kind)
    """
    from actuator_select.database.export import FILE_FORMATS
    from actuator_select.database.kinds import find_kind

    found = None if kind is None else find_kind(kind).name
    by_ending = None if output is None or output.is_dir() else FILE_FORMATS.get(output.suffix.lower())
    chosen = file_format or by_ending or "csv"
    _refuse(found, chosen, output, where)
    with opened(database) as catalogue:
        if output is None:
            for piece in catalogue.export_pieces(chosen, found, where):
                click.echo(piece, nl=False)
        elif found is None and chosen == "csv":
            console.say(f"Wrote {', '.join(str(file) for file in catalogue.export_folder(output))}")
        else:
            file = output / f"{found or 'catalogue'}.{chosen}" if output.is_dir() else output
            catalogue.export_file(file, chosen, found, where)
            console.say(f"Wrote {file}")


def _refuse(kind: str | None, file_format: str, output: Path | None, where: str) -> None:
    """Refuse what no file can be made of."""
    if kind is None and where:
        raise click.UsageError("--where is over the columns of one kind; name a KIND")
    if output is None and file_format == "xlsx":
        raise click.UsageError("an XLSX file does not go to the terminal; name one with --output FILE.xlsx")
    if kind is None and file_format == "csv":
        if output is None:
            raise click.UsageError("name a KIND, or a folder for all kinds with --output FOLDER")
        if output.suffix.lower() == ".csv" and not output.is_dir():
            raise click.UsageError(
                f"{output} can hold one kind as CSV; name a KIND, a folder, or a file that ends in .xlsx or .json"
            )
