"""``actuator-select catalog show``."""

from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import printed
from actuator_select.cli.catalog.session import finding_record, opened, warn_of

if TYPE_CHECKING:
    from actuator_select.database import Catalogue


@click.command("show")
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
                "findings": [finding_record(finding) for finding in findings],
            }
        )
        return
    for role, part_kind, row in rows:
        _emit_row(f"{role} {row['id']}", part_kind, row)
    for source in known_sources:
        click.echo(f"Source {source['id']}: {_citation(source)}")
    warn_of(findings)


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


def _emit_row(title: str, kind: str, row: dict[str, Any]) -> None:
    from actuator_select.database.kinds import find_kind

    known = [
        (field.label, printed(row[field.name])) for field in find_kind(kind).columns if row[field.name] is not None
    ]
    console.emit_table(["column", "value"], known, title=title)
