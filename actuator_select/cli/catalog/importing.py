"""``actuator-select catalog import``."""

from pathlib import Path

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.session import opened, warn_of


@click.command("import")
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE.csv")
@click.option("--kind", metavar="KIND", help="Kind of the rows; by default the file's name or header tells.")
@click.option("--dry-run", is_flag=True, help="Check everything and write nothing.")
@click.option("--update", is_flag=True, help="Change rows that exist; columns that the file leaves out stay.")
@options.database_option
def import_file(file: Path, kind: str | None, dry_run: bool, update: bool, database: str | None) -> None:
    """Take in a CSV file: all of it, or nothing and a list of every bad cell.

    The file is UTF-8 with commas between cells and a header of column names; `actuator-select catalog fields KIND`
    lists them with their units and ranges, `actuator-select catalog export KIND` writes a file to start from. Write
    decimals with a point and efficiencies in per cent; leave a cell empty where the figure is unknown; write
    unlimited where there is no limit. Every row names its source, so import sources.csv first. A row that the
    catalogue has already, equal, is passed over; a different one is refused unless --update is given.

    \b
    A file my-motors.csv could read:
        id,rated_power_w,rated_speed_rpm,rated_torque_nm,rotor_inertia_g_cm2,source_id,source_location
        acme-m1,150,3000,0.48,120,acme-catalogue-2024,page 12

    \b
    Examples:
        actuator-select catalog import sources.csv
        actuator-select catalog import my-motors.csv --kind motors --dry-run
        actuator-select catalog import my-motors.csv --kind motors --update
    """
    from actuator_select.selection import check_rows

    with opened(database) as catalogue, console.progress("Reading") as progress:
        report = catalogue.import_csv(file, kind, dry_run=dry_run, update=update, progress=progress)
    # Said at once: what has been written is written, whatever interrupts the checks that follow.
    done = f"{report.added} added, {report.updated} changed, {report.unchanged} already there"
    if dry_run:
        console.say(f"Dry run of {file}: {report.kind} would be {done}. Nothing was written.")
    else:
        console.say(f"Imported {file}: {report.kind}: {done}.")
        console.say(f"Next: actuator-select catalog list {report.kind}")
    warn_of(check_rows(report.kind, report.rows))
