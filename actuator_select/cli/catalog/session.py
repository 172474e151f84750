"""What every catalogue command does: open the catalogue, and say what to mind about its rows."""

from contextlib import contextmanager
from math import isfinite
from typing import TYPE_CHECKING, Any

from actuator_select.cli import console

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from actuator_select.database import Catalogue
    from actuator_select.database.queries import Row
    from actuator_select.selection import Finding


@contextmanager
def opened(database: str | None) -> "Iterator[Catalogue]":
    """Open the catalogue and tell what opening it did."""
    from actuator_select.database import open_catalogue

    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        yield catalogue


def findings_of(catalogue: "Catalogue", kind: str, rows: "Sequence[Row]") -> "list[Finding]":
    """What some rows of a kind say against themselves, or against all rows that the catalogue has of their group.

    The rows need not be written yet; the catalogue is read only for a kind that has rules about groups.
    """
    from actuator_select.selection import check_rows
    from actuator_select.selection.plausibility_rules import RULES

    grouped = [rule for rule in RULES.get(kind, ()) if rule.group]
    if not rows or not grouped:
        return check_rows(kind, rows)
    ids = {row["id"] for row in rows}
    compared = {"id", *(name for rule in grouped for name in (rule.group, rule.quantity, *rule.needs))}
    others = [row for row in catalogue.rows(kind, columns=",".join(sorted(compared))) if row["id"] not in ids]
    return check_rows(kind, rows, among=[*others, *rows])


def finding_sentence(finding: "Finding") -> str:
    """Which row a finding is about, and the finding."""
    from actuator_select.database.cells import ascii_controls

    name = "" if finding.name == finding.id else f" ({ascii_controls(finding.name)})"
    return f"{finding.kind} {finding.id}{name}: {finding.text}"


def warn_of(findings: "Sequence[Finding]") -> None:
    """Warn of rows that do not agree with themselves, with the explanation where one ships."""
    for finding in findings:
        console.warn(finding_sentence(finding))
        if finding.explanation:
            console.say(f"  Why: {' '.join(finding.explanation.split())}")


def finding_record(finding: "Finding") -> dict[str, Any]:
    """A finding for JSON."""
    from dataclasses import asdict

    record = asdict(finding)
    return record | {"deviation": finding.deviation if isfinite(finding.deviation) else None}
