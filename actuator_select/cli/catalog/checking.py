"""``actuator-select catalog check``."""

from math import isfinite
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import UNKNOWN
from actuator_select.cli.catalog.session import finding_record, finding_sentence, opened

if TYPE_CHECKING:
    from actuator_select.database import Catalogue


@click.command("check")
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
        console.emit_json({"findings": [finding_record(finding) for finding in findings]})
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


def _used_parts(catalogue: "Catalogue") -> set[tuple[str, str]]:
    from actuator_select.database.kinds import ROLES

    rows = catalogue.rows("actuators")
    return {(part.name, str(row[f"{role}_id"])) for row in rows for role, part in ROLES.items()}
