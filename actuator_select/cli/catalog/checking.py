"""``actuator-select catalog check``."""

from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import UNKNOWN
from actuator_select.cli.catalog.session import finding_record, finding_sentence, opened

if TYPE_CHECKING:
    from actuator_select.database import Catalogue
    from actuator_select.selection import CatalogueCheck

TEXT_WIDTH = 116  # characters of a line of explanation; the table is about as wide
INDENT = "    "


@click.command("check")
@click.argument("kind", required=False, metavar="[KIND]")
@options.format_option("table", "json", "markdown")
@options.database_option
def check(kind: str | None, output_format: str, database: str | None) -> None:
    """Check that every row agrees with itself: power = torque × speed, back-EMF = torque constant, and so on.

    A finding is a warning: the figure may be right and the rule too simple. The exit status is 0 also with findings.
    Findings about shipped rows are explained, as long as nobody edited the row. KIND is motor, gearbox, winch or rope
    (there are no rules for other rows), or actuator for the parts that actuators are made of.

    \b
    Examples:
        actuator-select catalog check
        actuator-select catalog check motors --format json
        actuator-select catalog check --format markdown > findings.md
    """
    from actuator_select.database.kinds import find_kind
    from actuator_select.selection import review_catalogue

    found = None if kind is None else find_kind(kind).name
    with opened(database) as catalogue:
        if found == "actuators":
            result = review_catalogue(catalogue, only=_used_parts(catalogue))
        else:
            result = review_catalogue(catalogue, found)
    if output_format == "json":
        console.emit_json(
            {"checked": dict(result.checked), "findings": [finding_record(finding) for finding in result.findings]}
        )
    elif output_format == "markdown":
        from actuator_select.report.findings import render_findings
        from actuator_select.selection.explanations import dc_motors_text

        click.echo(render_findings(result, dc_motors_text(), _command(found, database)), nl=False)
    else:
        _emit_findings(result)
    console.say(_summary(result))


def _command(kind: str | None, database: str | None) -> str:
    """What writes the document again."""
    from shlex import quote

    from actuator_select.database.connection import database_url, shown
    from actuator_select.report.findings import COMMAND

    if kind is None and database == ":memory:":
        return COMMAND
    which = "" if database is None else f" --database {quote(shown(database_url(database)))}"
    return f"actuator-select catalog check{'' if kind is None else f' {kind}'} --format markdown{which}"


def _emit_findings(result: "CatalogueCheck") -> None:
    """One line for each finding with the number of its explanation, then the explanations."""
    from actuator_select.selection.plausibility import figure, percent

    numbers: dict[tuple[str, str | None], str] = {}
    for group in result.groups:
        if group.explanation is not None:
            numbers[group.rule.name, group.explanation] = f"[{len(numbers) + 1}]"
    if result.findings:
        header = ["row", "column", "stated", "expected", "unit", "deviation", "note"]
        rows = [
            [
                finding.id,
                finding.quantity,
                figure(finding.stated),
                figure(finding.expected),
                finding.unit,
                percent(finding.deviation),
                numbers.get((finding.rule, finding.explanation), UNKNOWN),
            ]
            for group in result.groups
            for finding in group.findings
        ]
        console.emit_table(header, rows, right=(2, 3, 5, 6))
    for group in result.groups:
        if group.explanation is not None:
            number = numbers[group.rule.name, group.explanation]
            _emit_paragraph(f"{number} {group.rule.name}, expected: {group.rule.because}.", "")
            _emit_paragraph(group.explanation, INDENT)
    for finding in result.unexplained:
        click.echo(finding_sentence(finding))


def _emit_paragraph(text: str, first: str) -> None:
    click.echo(click.wrap_text(text, width=TEXT_WIDTH, initial_indent=first, subsequent_indent=INDENT))


def _summary(result: "CatalogueCheck") -> str:
    total, unexplained = len(result.findings), len(result.unexplained)
    found = f"{total} finding{'' if total == 1 else 's'}"
    split = f": {total - unexplained} explained, {unexplained} not explained" if total else ""
    return f"Checked {result.checked_text}.\n{found}{split}."


def _used_parts(catalogue: "Catalogue") -> set[tuple[str, str]]:
    from actuator_select.database.kinds import ROLES

    rows = catalogue.rows("actuators")
    return {(part.name, str(row[f"{role}_id"])) for row in rows for role, part in ROLES.items()}
