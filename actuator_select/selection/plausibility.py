"""Does a row agree with itself? Named rules that compare a stated figure with what the row's other figures give.

A finding is a warning, never a refusal: the figure may be right and the rule's simple model wrong. What the findings
over the shipped rows mean is explained in ``catalog/findings.toml``.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

from actuator_select.selection.electrical import Row
from actuator_select.selection.explanations import explanation_of
from actuator_select.selection.plausibility_rules import RULES, SMALLEST_GROUP, Rule


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One disagreement within one row, or of one row with its group.

    Attributes
    ----------
    rule : str
        Name of the rule.
    kind, id, name : str
        The row.
    quantity : str
        Column whose figure is in doubt.
    stated, expected : float
        The figure and what the other figures give, in `unit`.
    deviation : float
        stated/expected - 1.
    unit : str
        Of both.
    text : str
        The finding in a sentence.
    explanation : str or None
        Why the figure stands as it does, for rows that are as shipped; None where nobody explained it.
    """

    rule: str
    kind: str
    id: str
    name: str
    quantity: str
    stated: float
    expected: float
    deviation: float
    unit: str
    text: str
    explanation: str | None = None


WHOLE_FROM = 9999.5  # figures from here on round to five digits, which .4g writes as a power of ten


def figure(value: float) -> str:
    """Number with four significant digits, never as a power of ten where it is large."""
    return f"{value:.0f}" if abs(value) >= WHOLE_FROM else f"{value:.4g}"


def percent(deviation: float) -> str:
    """Deviation in per cent with its sign; a dash where there is none, as from zero."""
    return f"{100.0 * deviation:+.1f} %" if isfinite(deviation) else "–"


def check_rows(kind: str, rows: Sequence[Row], among: Sequence[Row] | None = None) -> list[Finding]:
    """Apply every rule to every row.

    Parameters
    ----------
    kind : str
        ``"motors"``, ``"gearboxes"``, ``"winches"``, ``"ropes"``; other kinds have no rules.
    rows : sequence of mapping
        Catalogue rows.
    among : sequence of mapping, optional
        Rows that the rules about groups compare with; `rows` themselves by default, of which few make no group.

    Returns
    -------
    list of Finding
        Row by row.
    """
    rules = RULES.get(kind, ())
    typical = {rule.name: _typical(rule, rows if among is None else among) for rule in rules if rule.group}
    return [
        finding
        for row in rows
        for rule in rules
        if (finding := _apply(rule, kind, row, typical.get(rule.name))) is not None
    ]


def _applies(rule: Rule, row: Row) -> bool:
    known = all(row.get(column) is not None for column in (rule.quantity, *rule.needs))
    return known and (rule.conventions is None or row.get("electrical_convention") in rule.conventions)


def _typical(rule: Rule, rows: Sequence[Row]) -> dict[object, float]:
    """What is typical of every group that is large enough, by the group's value."""
    groups: defaultdict[object, list[Row]] = defaultdict(list)
    for row in rows:
        if _applies(rule, row) and row.get(rule.group) is not None:
            groups[row[rule.group]].append(row)
    return {value: rule.typical(members) for value, members in groups.items() if len(members) >= SMALLEST_GROUP}


def _apply(rule: Rule, kind: str, row: Row, typical: Mapping[object, float] | None) -> Finding | None:
    if not _applies(rule, row):
        return None
    factor = 1.0 if typical is None else typical.get(row.get(rule.group))
    expected = rule.expected(row)
    if factor is None or expected is None:
        return None
    stated, expected = float(row[rule.quantity]), expected * factor
    if not (isfinite(stated) and isfinite(expected)):
        return None
    deviation = stated / expected - 1.0 if expected else float("inf")
    if not rule.doubtful(deviation):
        return None
    name = row.get("part_number") or row.get("name") or row.get("description") or row["id"]
    compared = f"{rule.quantity} is {figure(stated)} {rule.unit}, but {figure(expected)} {rule.unit}"
    by = f"{100.0 * deviation:+.0f} %" if isfinite(deviation) else "from zero"
    return Finding(
        rule=rule.name,
        kind=kind,
        id=str(row["id"]),
        name=str(name),
        quantity=rule.quantity,
        stated=stated,
        expected=expected,
        deviation=deviation,
        unit=rule.unit,
        text=f"{compared} follows from {rule.because} ({by})",
        explanation=explanation_of(rule.name, kind, row),
    )
