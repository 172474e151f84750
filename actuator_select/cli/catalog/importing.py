"""``actuator-select catalog import``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.session import opened, warn_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from actuator_select.database import ImportReport
    from actuator_select.database.queries import Row
    from actuator_select.selection import Finding

_SHOWN_FINDINGS = 20  # of more only the number is told


def _show_mapping(context: click.Context, _: click.Parameter, name: str | None) -> None:
    """Write a mapping that comes with the program, and end."""
    if name is None or context.resilient_parsing:
        return
    from actuator_select.database.mapping import find_shipped

    click.echo(find_shipped(name).read_text(encoding="utf-8"), nl=False)
    context.exit()


@click.command("import")
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option("--kind", metavar="KIND", help="Kind of the rows; by default the file's name or header tells.")
@click.option("--mapping", metavar="NAME|FILE.toml", help="What foreign columns and units mean; see below.")
@click.option(
    "--show-mapping",
    metavar="NAME",
    is_eager=True,
    expose_value=False,
    callback=_show_mapping,
    help="Write a mapping that comes with the program, to change a copy of it, and exit.",
)
@click.option("--source", metavar="ID", help="Source of every row; a row of sources that exists.")
@click.option("--sheet", metavar="NAME", help="Sheet of a workbook; by default the sheets that are named after kinds.")
@click.option("--dry-run", is_flag=True, help="Check everything and write nothing.")
@click.option("--update", is_flag=True, help="Change rows that exist; columns that the file leaves out stay.")
@click.option("--replace", is_flag=True, help="Let the kinds of the file hold exactly its rows; others are removed.")
@options.database_option
def import_file(
    file: Path,
    kind: str | None,
    mapping: str | None,
    source: str | None,
    sheet: str | None,
    dry_run: bool,
    update: bool,
    replace: bool,
    database: str | None,
) -> None:
    """Take in a file: all of it, or nothing and a list of every bad cell.

    FILE is CSV (UTF-8, commas between cells), an XLSX workbook with a sheet for each kind, JSON, or a folder that
    `catalog export` wrote. The header names columns; `actuator-select catalog fields KIND` lists them with their units
    and ranges, `actuator-select catalog export KIND` writes a file to start from. Write decimals with a point and
    efficiencies in per cent; leave a cell empty where the figure is unknown; write unlimited where there is no limit.
    Every row names its source, so import sources.csv first. A row that the catalogue has already, equal, is passed
    over; a different one is refused unless --update or --replace is given.

    \b
    A file my-motors.csv could read:
        id,rated_power_w,rated_speed_rpm,rated_torque_nm,rotor_inertia_g_cm2,source_id,source_location
        acme-m1,150,3000,0.48,120,acme-catalogue-2024,page 12

    Somebody else's list needs a mapping: a TOML file that says which foreign column fills which of ours, in which
    unit. mgdb-motors, mgdb-gearboxes and mgdb-compatibility come with the program, for the layout of
    github.com/ekrimsk/MGDB; the README describes how to write one, for example:

    \b
        kind = "motors"
        [csv]
        delimiter = ";"
        decimal = ","
        [columns]
        "Type" = { field = "id", prefix = "acme-", make_id = true }
        "Torque" = { field = "rated_torque_nm", unit = "mNm", missing = ["n/a"] }
        "Inertia" = { field = "rotor_inertia_g_cm2", unit = "oz-in-s²" }
        "Colour" = { ignore = true }
        [constants]
        manufacturer = "Acme"

    \b
    Examples:
        actuator-select catalog import sources.csv
        actuator-select catalog import my-motors.csv --kind motors --dry-run
        actuator-select catalog import my-motors.csv --kind motors --update
        actuator-select catalog import parts.xlsx
        actuator-select catalog import acme.csv --mapping acme.toml --source acme-catalogue-2024
        actuator-select catalog import maxon_motors.csv --mapping mgdb-motors --source mgdb
        actuator-select catalog import my-catalogue --replace          (a folder that `catalog export` wrote)
    """
    if update and replace:
        raise click.UsageError("--replace changes rows as --update does; state one of them")
    findings = _Findings()
    with opened(database) as catalogue, console.progress("Reading") as progress:
        reports = catalogue.import_file(
            file,
            kind,
            mapping=mapping,
            source=source,
            sheet=sheet,
            dry_run=dry_run,
            update=update,
            replace=replace,
            progress=progress,
            on_rows=findings.check,
        )
    for report in reports:
        _tell(file, report)
    if reports and not dry_run:
        console.say(f"Next: actuator-select catalog list {reports[-1].kind}")
    warn_of(findings.first)
    if findings.count > len(findings.first):
        console.warn(f"{findings.count} findings in all; actuator-select catalog check lists them")


class _Findings:
    """What the imported rows say against themselves: the first few, and how many there are."""

    def __init__(self) -> None:
        self.first: list[Finding] = []
        self.count = 0

    def check(self, kind: str, rows: "Sequence[Row]") -> None:
        """Check a portion of rows.

        Rules about groups compare within the portion only: memory stays flat, and the catalogue's other rows may yet be
        changed by the same import. `catalog check` compares with all of them.
        """
        from actuator_select.selection import check_rows

        found = check_rows(kind, rows)
        self.count += len(found)
        self.first += found[: _SHOWN_FINDINGS - len(self.first)]


def _tell(file: Path, report: "ImportReport") -> None:
    done = f"{report.added} added, {report.updated} changed, {report.unchanged} already there"
    if report.removed:
        done += f", {report.removed} removed"
    if report.dry_run:
        console.say(f"Dry run of {file}: {report.kind} would be {done}. Nothing was written.")
    else:
        console.say(f"Imported {file}: {report.kind}: {done}.")
    for notice in report.notices:
        console.warn(notice)
