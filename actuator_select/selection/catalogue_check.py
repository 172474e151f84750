"""The plausibility check of a whole catalogue, with what is known about its findings."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from actuator_select.database import Catalogue
from actuator_select.database.kinds import KINDS
from actuator_select.selection.nominal_line import LineFigure, measured_dc_motors, recompute
from actuator_select.selection.plausibility import Finding, check_rows
from actuator_select.selection.plausibility_rules import RULES, Rule


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingGroup:
    """Findings of one rule that have the same explanation.

    Attributes
    ----------
    kind : str
        Kind of the rows.
    rule : Rule
        The rule.
    explanation : str or None
        Why the figures stand as they do; None where nobody explained it.
    findings : tuple of Finding
        Row by row.
    """

    kind: str
    rule: Rule
    explanation: str | None
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CatalogueCheck:
    """What the check of a catalogue found.

    Attributes
    ----------
    checked : mapping of str to int
        Rows that were checked, by kind.
    findings : tuple of Finding
        Kind by kind, row by row.
    line_figures : tuple of LineFigure
        DC motors recomputed from R, kT and I0.
    """

    checked: Mapping[str, int]
    findings: tuple[Finding, ...]
    line_figures: tuple[LineFigure, ...]

    @property
    def checked_text(self) -> str:
        """How many rows of which kind were checked, in words."""
        return ", ".join(
            f"{count} {KINDS[kind].singular if count == 1 else kind}" for kind, count in self.checked.items()
        )

    @property
    def unexplained(self) -> tuple[Finding, ...]:
        """Findings that nobody explained."""
        return tuple(finding for finding in self.findings if finding.explanation is None)

    @property
    def groups(self) -> tuple[FindingGroup, ...]:
        """Findings by rule and explanation, in the order of their first rows, unexplained ones first."""
        members: dict[tuple[str, str, str | None], list[Finding]] = {}
        for finding in sorted(self.findings, key=lambda one: one.explanation is not None):
            members.setdefault((finding.kind, finding.rule, finding.explanation), []).append(finding)
        return tuple(
            FindingGroup(
                kind=kind,
                rule=next(one for one in RULES[kind] if one.name == rule),
                explanation=explanation,
                findings=tuple(findings),
            )
            for (kind, rule, explanation), findings in members.items()
        )


def review_catalogue(
    catalogue: Catalogue, kind: str | None = None, only: Collection[tuple[str, str]] | None = None
) -> CatalogueCheck:
    """Check the whole catalogue, one kind, or some rows.

    Parameters
    ----------
    catalogue : Catalogue
        The catalogue.
    kind : str, optional
        One kind only.
    only : collection of (kind, id), optional
        These rows only; rules about groups compare them with all rows.

    Returns
    -------
    CatalogueCheck
        Findings and counts.
    """
    checked, findings, line_figures = {}, [], []
    for one in RULES if kind is None else [kind]:
        everything = catalogue.rows(one)
        rows = [row for row in everything if only is None or (one, str(row["id"])) in only]
        checked[one] = len(rows)
        findings += check_rows(one, rows, among=everything)
        if one == "motors":
            line_figures = [figure for row in measured_dc_motors(rows) for figure in recompute(row)]
    return CatalogueCheck(checked=checked, findings=tuple(findings), line_figures=tuple(line_figures))
