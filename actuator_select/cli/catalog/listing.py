"""``actuator-select catalog list`` and ``catalog fields``."""

from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import printed
from actuator_select.cli.catalog.session import opened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from actuator_select.database.queries import Column


@click.command("list")
@click.argument("kind", metavar="KIND")
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


@click.command("fields")
@click.argument("kind", metavar="KIND")
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


def _chosen_columns(names: str, every: "Sequence[Column]") -> "list[Column]":
    if not names.strip():
        return []
    from actuator_select.database.where import find_columns

    return find_columns(names, every)


def _emit_rows(columns: "Sequence[Column]", rows: "Sequence[dict[str, Any]]") -> None:
    header = [_header(column) for column in columns]
    right = [index for index, column in enumerate(columns) if not column.field.is_text]
    console.emit_table(header, [[printed(row[column.name]) for column in columns] for row in rows], right=right)


def _header(column: "Column") -> str:
    part = column.name.rpartition(".")[0]
    return f"{part} {column.field.label}" if part else column.field.label
