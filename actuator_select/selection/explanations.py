"""Why the shipped rows' figures stand as they do where a plausibility rule doubts them: ``catalog/findings.toml``."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from actuator_select._resources import shipped_dir

FILE = "findings.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """What is known about some findings of one rule.

    Attributes
    ----------
    rule, kind : str
        The rule, and the kind of the rows.
    ids : tuple of str
        The rows.
    text : str
        The explanation, in one paragraph.
    """

    rule: str
    kind: str
    ids: tuple[str, ...]
    text: str


@cache
def explanations() -> tuple[Explanation, ...]:
    """Read every explanation that is shipped, in the order of the file."""
    return tuple(
        Explanation(rule=entry["rule"], kind=entry["kind"], ids=tuple(entry["ids"]), text=_one_line(entry["text"]))
        for entry in _table()["explanation"]
    )


def dc_motors_text() -> str:
    """What is known about the deviations of the DC motors that are recomputed."""
    return _one_line(_table()["dc_motors"]["text"])


def explanation_of(rule: str, kind: str, row: Mapping[str, Any]) -> str | None:
    """Explanation of one finding.

    Parameters
    ----------
    rule, kind : str
        The rule, and the kind of the row.
    row : mapping
        The row. Only one that is as shipped has an explanation: an edited figure is another figure.

    Returns
    -------
    str or None
        The text; None where there is none.
    """
    return _by_finding().get((rule, kind, str(row["id"]))) if row.get("origin") == "shipped" else None


@cache
def _table() -> dict[str, Any]:
    return tomllib.loads((shipped_dir("catalog") / FILE).read_text(encoding="utf-8"))


def _one_line(text: str) -> str:
    return " ".join(text.split())


@cache
def _by_finding() -> dict[tuple[str, str, str], str]:
    return {(one.rule, one.kind, row_id): one.text for one in explanations() for row_id in one.ids}
