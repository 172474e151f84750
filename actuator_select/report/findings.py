"""The findings over a catalogue as a Markdown document."""

from collections.abc import Sequence

from actuator_select.selection.catalogue_check import CatalogueCheck, FindingGroup
from actuator_select.selection.nominal_line import LineFigure
from actuator_select.selection.plausibility import figure, percent

COMMAND = "actuator-select catalog check --format markdown --database :memory: > catalog/FINDINGS.md"
"""What writes the document over the shipped rows, whatever the user's own catalogue holds."""

INTRODUCTION = (
    "A finding is a figure that disagrees with others of its row or with rows of its group. It is a warning: "
    "the figure stands in the catalogue as its source prints it."
)

RECOMPUTED = (
    "What resistance, torque constant and no-load current give, with voltage, back-EMF constant and rated torque, "
    "against what is printed. A printed figure but the voltage may be off by half a unit of its last digit. Calculated "
    "sheets are left out."
)

NOT_EXPLAINED = "**Not explained.**"


def render_findings(check: CatalogueCheck, dc_motors_text: str, command: str = COMMAND) -> str:
    """Write what the check found, rule by rule, and the DC motors recomputed.

    Parameters
    ----------
    check : CatalogueCheck
        The check.
    dc_motors_text : str
        What is known about the deviations of the DC motors.
    command : str
        What makes the document; the shipped one's by default.

    Returns
    -------
    str
        Markdown that ends in one newline.
    """
    lines = [
        "# Findings of the plausibility check",
        "",
        f"Made by `{command}`; the explanations stand in `catalog/findings.toml`.",
        "",
        f"Checked: {check.checked_text}.",
        f"Findings: {len(check.findings)}, of which {len(check.unexplained)} are not explained.",
        INTRODUCTION,
    ]
    for group in check.groups:
        lines += ["", *_group_lines(group)]
    if check.line_figures:
        lines += ["", *_line_figure_lines(check.line_figures, dc_motors_text)]
    return "\n".join(lines) + "\n"


def _group_lines(group: FindingGroup) -> list[str]:
    rule = group.rule
    unit = "" if rule.unit == "1" else f" [{rule.unit}]"
    rows = [[f"`{one.id}`", figure(one.stated), figure(one.expected), percent(one.deviation)] for one in group.findings]
    return [
        f"## {group.kind}: {rule.name}",
        "",
        f"`{rule.quantity}`, expected: {rule.because}.",
        "",
        group.explanation or NOT_EXPLAINED,
        "",
        *_table(["row", f"stated{unit}", f"expected{unit}", "deviation"], rows),
    ]


def _line_figure_lines(figures: Sequence[LineFigure], text: str) -> list[str]:
    rows = [
        [
            f"`{one.id}`",
            f"`{one.quantity}`",
            f"{one.stated:.5g}",
            f"{one.expected:.5g}",
            f"{one.expected_range[0]:.5g} … {one.expected_range[1]:.5g}",
            percent(one.deviation),
            "yes" if one.agrees else "no",
        ]
        for one in figures
    ]
    agreeing = sum(one.agrees for one in figures)
    return [
        "## DC motors recomputed",
        "",
        RECOMPUTED,
        f"{agreeing} of {len(figures)} figures agree within rounding.",
        "",
        text,
        "",
        *_table(["motor", "figure", "stated", "expected", "range", "deviation", "within rounding"], rows),
    ]


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    lines = [header, ["---"] * len(header), *rows]
    return [f"| {' | '.join(line)} |" for line in lines]
