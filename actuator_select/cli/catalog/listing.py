"""``actuator-select catalog list`` and ``catalog fields``."""

from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import fitting, folded, printed, shortened
from actuator_select.cli.catalog.session import findings_of, opened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from actuator_select.database import Catalogue
    from actuator_select.database.fields import Kind
    from actuator_select.database.queries import Column

UNBOUNDED = 100_000  # characters in a line that nobody has to see on a screen
MARK = "!"
MOST_ROWS = 500  # of a table for people, where --limit does not say otherwise


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
@click.option(
    "--limit",
    type=click.IntRange(min=1, max=1_000_000_000),
    metavar="N",
    help=f"Show the first N rows only; a table shows {MOST_ROWS} by default, CSV and JSON all.",
)
@options.format_option("table", "csv", "json")
@options.database_option
def list_rows(
    kind: str, where: str, sort: str, columns: str, limit: int | None, output_format: str, database: str | None
) -> None:
    """List rows of one KIND: sources, motors, gearboxes, compatibilities, winches, ropes or actuators.

    Actuators can be filtered, sorted and shown by the columns of their parts: motor.rated_power_w, gearbox.ratio,
    winch.drum_radius_mm. The bare name does where it is unique. A terminal shows the most important columns that fit,
    long texts cut; a pipe gets them whole. A table ends after 500 rows unless --limit says otherwise. CSV and JSON give
    every row and column. – is unknown, ! a row to look at.

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
        actuator-select catalog list motors --where "peak_torque_nm >= 3 and mass_kg < 4" --sort -peak_torque_nm
        actuator-select catalog list gearboxes --format csv
    """
    from actuator_select.database.expressions import chosen_columns
    from actuator_select.database.kinds import find_kind
    from actuator_select.database.queries import columns_of

    found = find_kind(kind)
    every = columns_of(found)
    chosen = chosen_columns(found, columns)
    with opened(database) as catalogue:
        if output_format != "table":
            for piece in catalogue.list_pieces(output_format, found.name, where, sort, columns, limit):
                click.echo(piece, nl=False)
            return
        most = MOST_ROWS if limit is None else limit
        rows = catalogue.rows(found.name, where, sort, columns, most)
        total = len(rows) if len(rows) < most else catalogue.count(found.name, where)
        marks = [] if chosen else _marks(catalogue, found, rows)
    by_name = {column.name: column for column in every}
    _emit_rows(chosen or [by_name[name] for name in found.shown], rows, marks, fit=not chosen)
    _say_count(found, len(rows), total)


def _say_count(kind: "Kind", shown: int, found: int) -> None:
    noun = kind.singular if found == 1 else kind.name
    if shown == found:
        console.say(f"{found} {noun}")
    else:
        console.say(f"{shown} of {found} {noun}; a greater --limit shows more, --where chooses, --format csv gives all")


@click.command("fields")
@click.argument("kind", metavar="KIND")
@options.format_option("table", "json")
def fields(kind: str, output_format: str) -> None:
    """List the columns of one KIND: name, what may stand there, unit, meaning, name in OPC 40400-1, conventions.

    \b
    Examples:
        actuator-select catalog fields motors
        actuator-select catalog fields gearboxes --format json
    """
    from actuator_select.database.conventions import CONVENTIONS
    from actuator_select.database.kinds import find_kind
    from actuator_select.database.opc import opc_name

    found = find_kind(kind)
    opc = {field.name: name for field in found.fields if (name := opc_name(found, field.name)) != field.name}
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
                "opc_name": opc.get(field.name),
                "conventions": dict(CONVENTIONS.get(field.name, {})),
            }
            for field in found.fields
        ]
        console.emit_json({"kind": found.name, "fields": records})
        return
    header = ["column", "what may stand there", "", "meaning"]
    rows = [
        [field.name, field.expected, "required" if field.required else "", field.description] for field in found.fields
    ]
    if opc:
        header.append("OPC 40400-1")
        rows = [[*row, opc.get(row[0], "")] for row in rows]
    console.emit_table(header, rows, title=found.description)
    for field in found.fields:
        if words := CONVENTIONS.get(field.name):
            click.echo(f"{field.name}:")
            for choice, meaning in words.items():
                click.echo(f"  {choice:<18}{meaning}")
    if found.name == "actuators":
        console.say("Conditions also take the parts' columns, such as motor.rated_power_w: see catalog fields motors.")


def _marks(catalogue: "Catalogue", kind: "Kind", rows: "Sequence[dict[str, Any]]") -> list[str]:
    """A mark for every row that disagrees with itself, or whose parts do, or that was flagged when it was read."""
    from actuator_select.database.kinds import ACTUATORS, ROLES

    def doubtful(part: str, some: "Sequence[dict[str, Any]]") -> set[str]:
        flagged = {row["id"] for row in some if row["check_status"] == "flag"}
        return flagged | {finding.id for finding in findings_of(catalogue, part, some)}

    if "check_status" not in {field.name for field in kind.fields}:
        return [""] * len(rows)
    doubts = doubtful(kind.name, rows)
    if kind is ACTUATORS:
        for role, part in ROLES.items():
            # By id, because actuators share parts.
            parts = {
                row[f"{role}_id"]: {field.name: row[f"{role}.{field.name}"] for field in part.columns}
                for row in rows
                if row[f"{role}_id"] is not None
            }
            found = doubtful(part.name, list(parts.values()))
            doubts |= {row["id"] for row in rows if row[f"{role}_id"] in found}
    return [MARK if row["id"] in doubts else "" for row in rows]


def _emit_rows(
    columns: "Sequence[Column]", rows: "Sequence[dict[str, Any]]", marks: "Sequence[str]" = (), *, fit: bool = False
) -> None:
    """Print rows; with `fit`, no more columns than a terminal has room for."""
    marked = any(marks)
    headers = [_header(column) for column in columns]
    cells = [[printed(row[column.name]) for column in columns] for row in rows]
    width = console.terminal_width()
    left_out = 0
    if width is not None:
        cells = [
            [text if column.name == "id" else shortened(text) for column, text in zip(columns, row, strict=True)]
            for row in cells
        ]
        count, folds = fitting(headers, cells, width - (len(MARK) + 2 if marked else 0))
        count = count if fit else len(columns)
        left_out = len(columns) - count
        headers, cells = headers[:count], [row[:count] for row in cells]
        if folds:
            contents = [max((len(row[index]) for row in cells), default=0) for index in range(count)]
            headers = [folded(label, content) for label, content in zip(headers, contents, strict=True)]
    right = [index for index, column in enumerate(columns[: len(headers)]) if not column.field.is_text]
    if marked:
        headers = [*headers, ""]
        cells = [[*row, mark] for row, mark in zip(cells, marks, strict=True)]
    console.emit_table(headers, cells, right=right, piped_width=UNBOUNDED)
    if marked:
        click.echo(
            f"{MARK} its figures disagree with each other, or were flagged when they were read; "
            "`actuator-select catalog show ID` says why"
        )
    if left_out:
        names = ", ".join(column.name for column in columns[len(columns) - left_out :])
        click.echo(f"Not shown for want of room: {names}; --columns chooses.")


def _header(column: "Column") -> str:
    part = column.name.rpartition(".")[0]
    return f"{part} {column.field.label}" if part else column.field.label
