"""``actuator-select catalog show``."""

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import UNKNOWN, printed
from actuator_select.cli.catalog.session import finding_record, findings_of, opened, warn_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from actuator_select.database import Catalogue
    from actuator_select.database.fields import Field
    from actuator_select.selection import Finding

_MOST_FITS = 5  # compatibilities that are listed
_LEAST_ROOM = 40  # characters for a value, however narrow the terminal


@click.command("show")
@click.argument("row_id", metavar="ID")
@click.option("--kind", metavar="KIND", help="Kind of the row, where several kinds have the id.")
@click.option("--all", "every", is_flag=True, help="List unknown columns too.")
@options.plot_option("Draw torque against speed: of a motor, a gearbox, or an actuator at its drum")
@options.format_option("table", "json")
@options.database_option
def show(
    row_id: str, kind: str | None, every: bool, plot: Path | None, output_format: str, database: str | None
) -> None:
    """Show everything that is known of one row: figures, source, plausibility findings, what uses it, its parts.

    ID is the row's id; an actuator's name does as well. – stands for a figure that the calculations need, or that one
    expects, and that is unknown. --plot draws what the row states and nothing else: limits that it does not state are
    named in the figure, not guessed.

    \b
    Examples:
        actuator-select catalog show "Actuator 4"
        actuator-select catalog show filipovic-kevac-2018-motor-4 --plot motor.svg
        actuator-select catalog show "Actuator 1" --plot drum.png
        actuator-select catalog show filipovic-kevac-2018-motor-4 --format json
    """
    draw = options.plot_writer(plot)
    with opened(database) as catalogue:
        found, joined = catalogue.part(row_id, kind)
        rows = _with_parts(catalogue, found, joined)
        sources = {str(row["source_id"]): None for _, _, row in rows if row.get("source_id") is not None}
        known_sources = {source_id: catalogue.source(source_id) for source_id in sources}
        uses = _uses(catalogue, found, str(joined["id"]))
        fits = catalogue.fits(str(joined["id"]), found)
        findings = [finding for _, part_kind, row in rows for finding in findings_of(catalogue, part_kind, [row])]
    if plot is not None:
        from actuator_select.report.part_figures import part_figure
        from actuator_select.selection.part_characteristics import characteristics

        draw(part_figure(characteristics(found, joined)))
    if output_format == "json":
        _emit_json(found, rows, list(known_sources.values()), findings)
        return
    for role, part_kind, row in rows:
        _emit_row(role, part_kind, row, known_sources, every=every)
    for text in uses:
        _emit_line("used by", text)
    for text in _fits(found, fits):
        _emit_line("fits", text)
    warn_of(findings)
    if findings:
        console.say("`actuator-select catalog check` holds all rows against these rules.")


def _emit_json(
    kind: str,
    rows: "Sequence[tuple[str, str, dict[str, Any]]]",
    sources: "Sequence[dict[str, Any]]",
    findings: "Sequence[Finding]",
) -> None:
    (_, _, own), *parts = rows
    console.emit_json(
        {
            "kind": kind,
            "row": console.plain(own),
            "parts": {role: console.plain(row) for role, _, row in parts},
            "sources": [console.plain(source) for source in sources],
            "findings": [finding_record(finding) for finding in findings],
        }
    )


def _with_parts(catalogue: "Catalogue", kind: str, joined: dict[str, Any]) -> list[tuple[str, str, dict[str, Any]]]:
    """Rows to show, own row first: role, kind, values."""
    from actuator_select.database.kinds import ROLES, find_kind

    own = {name: value for name, value in joined.items() if "." not in name}
    rows = [(find_kind(kind).singular, kind, own)]
    if kind == "actuators":
        rows += [
            (role, part.name, catalogue.part(str(joined[f"{role}_id"]), part.name)[1])
            for role, part in ROLES.items()
            if joined[f"{role}_id"] is not None
        ]
    return rows


def _uses(catalogue: "Catalogue", kind: str, row_id: str) -> list[str]:
    """What refers to a row: the actuators that contain a part, or how many rows cite a source."""
    from actuator_select.database.kinds import KINDS

    if not any(field.references == kind for other in KINDS.values() for field in other.references):
        return []
    uses = catalogue.uses(row_id, kind)
    if kind != "sources":
        return [f"{use.kind.singular} {use.row_id} ({use.name})" for use in uses] or ["no actuator"]
    counts = {name: sum(use.kind.name == name for use in uses) for name in KINDS}
    return [f"{count} {KINDS[name].singular if count == 1 else name}" for name, count in counts.items() if count] or [
        "no row"
    ]


def _fits(kind: str, rows: "Sequence[dict[str, Any]]") -> list[str]:
    """Which gearboxes fit a motor, or which motors a gearbox, as the first compatibilities say."""
    other, column = ("gearboxes", "gearbox_pattern") if kind == "motors" else ("motors", "motor_pattern")
    texts = [f"{other} {row[column]} (compatibility {row['id']})" for row in rows[:_MOST_FITS]]
    left = len(rows) - _MOST_FITS
    more = f"and {left} more; actuator-select catalog list compatibilities has all"
    return [*texts, more] if left > 0 else texts


def _emit_row(
    role: str, kind: str, row: dict[str, Any], sources: "Mapping[str, dict[str, Any]]", *, every: bool
) -> None:
    from actuator_select.database.groups import GROUPS, MISSED, NOT_MISSED
    from actuator_select.database.kinds import find_kind

    missed = set(MISSED.get(kind, ())) - NOT_MISSED.get(str(row.get("electrical_convention")), frozenset())
    click.echo(f"{role} {row['id']}")
    hidden = 0
    for title, names in GROUPS[kind].items():
        shown = [name for name in names if every or row[name] is not None or name in missed]
        hidden += len(names) - len(shown)
        if shown:
            click.echo(f"  {title}")
        for name in shown:
            field = find_kind(kind).field(name)
            _emit_line(field.label.partition(" [")[0], _value(field, row[name]), indent=4)
        if "source_id" in shown and row["source_id"] is not None:
            source = sources[str(row["source_id"])]
            _emit_line("document", _citation(source), indent=4)
            if link := _link(row, source):
                _emit_line("link", link, indent=4)
    if hidden:
        click.echo(f"  and {hidden} more columns unknown (--all lists them)")
    click.echo()


def _value(field: "Field", value: object) -> str:
    """A value with its unit, and what it means where that is easily mistaken."""
    from actuator_select.database.conventions import explained
    from actuator_select.database.groups import MEANINGS

    if value is None:
        return UNKNOWN
    if isinstance(value, str):
        meaning = explained(field.name, value)
        return f"{value}: {meaning}" if meaning else value
    text = f"{printed(value)} {field.unit}".rstrip() if value != float("inf") else printed(value)
    meaning = MEANINGS.get(field.name, "")
    return f"{text} ({meaning})" if meaning else text


def _citation(source: dict[str, Any]) -> str:
    page = source["page"]
    if page is not None and page[0].isdigit():
        page = f"p. {page}"
    parts = (source["authors"], source["document"], source["publisher"], page, source["date"])
    return ", ".join(str(part) for part in parts if part is not None)


def _link(row: dict[str, Any], source: dict[str, Any]) -> str | None:
    """Where the figures can be looked up: the row's own address, else its document's."""
    if "://" in str(row["source_location"]):
        return None  # printed as the row's location already
    doi = None if source["doi"] is None else f"https://doi.org/{source['doi']}"
    return source["url"] or doi


def _emit_line(label: str, text: str, indent: int = 0) -> None:
    """Print a label and what belongs to it; a terminal gets lines that fit, with links whole.

    A text keeps its lines, indented; other control characters, such as one that reverses a line, are escaped.
    """
    from actuator_select.database.cells import ascii_controls

    width = console.terminal_width()
    start = f"{' ' * indent}{label:<34}"
    lines = [ascii_controls(line) for line in text.replace("\r\n", "\n").split("\n")]
    if width is not None:
        room = max(width - len(start) - 1, _LEAST_ROOM)
        lines = [
            piece
            for line in lines
            for piece in textwrap.wrap(line, room, break_long_words=False, break_on_hyphens=False) or [""]
        ]
    for number, line in enumerate(lines):
        click.echo(f"{start if number == 0 else ' ' * len(start)} {line}".rstrip())
