"""``actuator-select catalog``."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog_add import add

if TYPE_CHECKING:
    from actuator_select.database import Catalogue
    from actuator_select.database.queries import Column
    from actuator_select.selection import Finding

UNKNOWN = "–"
_PRINTED_LENGTH = 10  # characters; a longer number is rounded in tables for people

kind_argument = click.argument("kind", metavar="KIND")


@contextmanager
def opened(database: str | None) -> "Iterator[Catalogue]":
    """Open the catalogue and tell what opening it did."""
    from actuator_select.database import open_catalogue

    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        yield catalogue


@click.group("catalog")
def command() -> None:
    """Query, extend and check the catalogue of motors, gearboxes, winches, ropes and actuators.

    An actuator is a named assembly of a motor, a gearbox (or none) and a winch. Every figure has its unit in the
    column's name (rated_torque_nm: N m) and every row the source that states it. Unknown, unlimited and zero differ:
    an empty cell is unknown, the word unlimited says that there is no limit.

    \b
    Examples:
        actuator-select catalog list actuators --where "rated_power_w >= 50" --sort rated_torque_nm
        actuator-select catalog show "Actuator 4"
        actuator-select catalog fields motors
        actuator-select catalog import motors.csv --dry-run
        actuator-select catalog check
    """


def finding_sentence(finding: "Finding") -> str:
    """Which row a finding is about, and the finding."""
    name = "" if finding.name == finding.id else f" ({finding.name})"
    return f"{finding.kind} {finding.id}{name}: {finding.text}"


def warn_of(findings: "Sequence[Finding]") -> None:
    """Warn of rows that do not agree with themselves."""
    for finding in findings:
        console.warn(finding_sentence(finding))


@command.command("list")
@kind_argument
@options.where_option
@click.option(
    "--sort",
    default="",
    metavar="COLUMNS",
    help="Sort by these columns, a minus begins with the greatest: -mass_kg,id.",
)
@click.option("--columns", default="", metavar="COLUMNS", help="Show these columns, e.g. id,rated_torque_nm.")
@click.option("--limit", type=click.IntRange(min=1), metavar="N", help="Show the first N rows only.")
@options.format_option("table", "csv", "json")
@options.database_option
def list_rows(
    kind: str, where: str, sort: str, columns: str, limit: int | None, output_format: str, database: str | None
) -> None:
    """List rows of one KIND: sources, motors, gearboxes, winches, ropes or actuators.

    Actuators can be filtered, sorted and shown by the columns of their parts: motor.rated_power_w, gearbox.ratio,
    winch.drum_radius_mm. The bare name does where it is unique. CSV and JSON give every column.

    \b
    Conditions:
        rated_power_w >= 50 and not motor_type = 'bldc'
        rated_torque_nm between 0.1 and 0.5
        manufacturer in ('maxon', 'Faulhaber') or part_number contains 'flat'
        peak_torque_nm is unlimited          (also: is known, is unknown)

    \b
    Examples:
        actuator-select catalog list actuators --where "rated_power_w >= 50" --sort rated_torque_nm
        actuator-select catalog list motors --columns id,rated_torque_nm,mass_kg --limit 10
        actuator-select catalog list gearboxes --format csv
    """
    from actuator_select.database.cells import write_value
    from actuator_select.database.csv_table import write_csv
    from actuator_select.database.kinds import find_kind
    from actuator_select.database.queries import columns_of

    found = find_kind(kind)
    every = columns_of(found)
    chosen = _chosen_columns(columns, every)
    with opened(database) as catalogue:
        rows = catalogue.rows(found.name, where=where, sort=sort)
        shown = rows if limit is None else rows[:limit]
        if output_format == "json":
            cells = [{column.name: row[column.name] for column in chosen or every} for row in shown]
            record = {"fingerprint": catalogue.fingerprint()}
            console.emit_json({"kind": found.name, "catalogue": record, "rows": [console.plain(row) for row in cells]})
    if output_format == "csv":
        names = [column.name for column in chosen or every]
        click.echo(write_csv(names, ([write_value(row[name]) for name in names] for row in shown)), nl=False)
    elif output_format == "table":
        _emit_rows(chosen or [column for column in every if column.name in found.shown], shown)
        of = "" if len(shown) == len(rows) else f" of {len(rows)}"
        console.say(f"{len(shown)}{of} {found.singular if len(rows) == 1 else found.name}")


@command.command("show")
@click.argument("row_id", metavar="ID")
@click.option("--kind", metavar="KIND", help="Kind of the row, where several kinds have the id.")
@options.format_option("table", "json")
@options.database_option
def show(row_id: str, kind: str | None, output_format: str, database: str | None) -> None:
    """Show everything that is known of one row: figures, source, plausibility findings, and an actuator's parts.

    ID is the row's id; an actuator's name does as well.

    \b
    Examples:
        actuator-select catalog show "Actuator 4"
        actuator-select catalog show filipovic-kevac-2018-motor-4 --format json
    """
    from actuator_select.selection import check_rows

    with opened(database) as catalogue:
        found, _ = catalogue.part(row_id, kind)
        rows = _with_parts(catalogue, row_id, found)
        sources = {str(row["source_id"]): None for _, _, row in rows if row.get("source_id") is not None}
        known_sources = [catalogue.source(source_id) for source_id in sources]
    findings = [finding for _, part_kind, row in rows for finding in check_rows(part_kind, [row])]
    if output_format == "json":
        (_, _, own), *parts = rows
        console.emit_json(
            {
                "kind": found,
                "row": console.plain(own),
                "parts": {role: console.plain(row) for role, _, row in parts},
                "sources": [console.plain(source) for source in known_sources],
                "findings": [_finding_record(finding) for finding in findings],
            }
        )
        return
    for role, part_kind, row in rows:
        _emit_row(f"{role} {row['id']}", part_kind, row)
    for source in known_sources:
        click.echo(f"Source {source['id']}: {_citation(source)}")
    warn_of(findings)


@command.command("import")
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


@command.command("export")
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


@command.command("check")
@click.argument("kind", required=False, metavar="[KIND]")
@options.format_option("table", "json")
@options.database_option
def check(kind: str | None, output_format: str, database: str | None) -> None:
    """Check that every row agrees with itself: power = torque × speed, back-EMF = torque constant, and so on.

    A finding is a warning: the figure may be right and the rule too simple. The exit status is 0 also with findings.
    KIND actuators checks the parts that actuators are made of.

    \b
    Examples:
        actuator-select catalog check
        actuator-select catalog check motors --format json
    """
    from actuator_select.database.kinds import find_kind
    from actuator_select.selection import check_catalogue

    found = None if kind is None else find_kind(kind).name
    with opened(database) as catalogue:
        findings = check_catalogue(catalogue, None if found == "actuators" else found)
        if found == "actuators":
            used = _used_parts(catalogue)
            findings = [finding for finding in findings if (finding.kind, finding.id) in used]
    if output_format == "json":
        console.emit_json({"findings": [_finding_record(finding) for finding in findings]})
        return
    if findings:
        header = ["row", "column", "stated", "expected", "unit", "deviation", "rule"]
        rows = [
            [
                finding.id,
                finding.quantity,
                f"{finding.stated:.4g}",
                f"{finding.expected:.4g}",
                finding.unit,
                f"{100.0 * finding.deviation:+.0f} %" if isfinite(finding.deviation) else UNKNOWN,
                finding.rule,
            ]
            for finding in findings
        ]
        console.emit_table(header, rows, right=(2, 3, 5))
        for finding in findings:
            click.echo(finding_sentence(finding))
    console.say(f"{len(findings)} finding{'' if len(findings) == 1 else 's'}")


@command.command("fields")
@kind_argument
@options.format_option("table", "json")
def fields(kind: str, output_format: str) -> None:
    """List the columns of one KIND: name, what may stand there, unit, meaning.

    \b
    Example:
        actuator-select catalog fields motors
    """
    from actuator_select.database.kinds import find_kind

    found = find_kind(kind)
    if output_format == "json":
        records = [
            {
                "name": field.name,
                "type": field.type,
                "unit": field.unit,
                "expected": field.expected,
                "required": field.required,
                "description": field.description,
                "aliases": list(field.aliases),
            }
            for field in found.fields
        ]
        console.emit_json({"kind": found.name, "fields": records})
        return
    rows = [
        [field.name, field.expected, "required" if field.required else "", field.description] for field in found.fields
    ]
    console.emit_table(["column", "what may stand there", "", "meaning"], rows, title=found.description)
    if found.name == "actuators":
        console.say("Conditions also take the parts' columns, such as motor.rated_power_w: see catalog fields motors.")


command.add_command(add)


def _chosen_columns(names: str, every: "Sequence[Column]") -> "list[Column]":
    if not names.strip():
        return []
    from actuator_select.database.where import find_columns

    return find_columns(names, every)


def _emit_rows(columns: "Sequence[Column]", rows: Sequence[dict[str, Any]]) -> None:
    header = [_header(column) for column in columns]
    right = [index for index, column in enumerate(columns) if not column.field.is_text]
    console.emit_table(header, [[_printed(row[column.name]) for column in columns] for row in rows], right=right)


def _emit_row(title: str, kind: str, row: dict[str, Any]) -> None:
    from actuator_select.database.kinds import find_kind

    known = [
        (field.label, _printed(row[field.name])) for field in find_kind(kind).columns if row[field.name] is not None
    ]
    console.emit_table(["column", "value"], known, title=title)


def _header(column: "Column") -> str:
    part = column.name.rpartition(".")[0]
    return f"{part} {column.field.label}" if part else column.field.label


def _printed(value: Any) -> str:  # noqa: ANN401 - any value of the catalogue
    from actuator_select.database.cells import write_value

    text = UNKNOWN if value is None else write_value(value)
    return f"{value:.6g}" if isinstance(value, float) and len(text) > _PRINTED_LENGTH else text


def _with_parts(catalogue: "Catalogue", row_id: str, kind: str) -> list[tuple[str, str, dict[str, Any]]]:
    """Rows to show, own row first: role, kind, values."""
    from actuator_select.database.kinds import ROLES, find_kind

    _, row = catalogue.part(row_id, kind)
    own = {name: value for name, value in row.items() if "." not in name}
    rows = [(find_kind(kind).singular, kind, own)]
    if kind == "actuators":
        rows += [
            (role, part.name, catalogue.part(str(row[f"{role}_id"]), part.name)[1])
            for role, part in ROLES.items()
            if row[f"{role}_id"] is not None
        ]
    return rows


def _citation(source: dict[str, Any]) -> str:
    page = None if source["page"] is None else f"p. {source['page']}"
    parts = (source["authors"], source["document"], source["publisher"], page, source["date"], source["url"])
    return ", ".join(str(part) for part in parts if part is not None)


def _finding_record(finding: "Finding") -> dict[str, Any]:
    from dataclasses import asdict

    record = asdict(finding)
    return record | {"deviation": finding.deviation if isfinite(finding.deviation) else None}


def _used_parts(catalogue: "Catalogue") -> set[tuple[str, str]]:
    from actuator_select.database.kinds import ROLES

    rows = catalogue.rows("actuators")
    return {(part.name, str(row[f"{role}_id"])) for row in rows for role, part in ROLES.items()}
