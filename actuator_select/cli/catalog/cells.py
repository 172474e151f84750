"""How values of the catalogue are printed for people: numbers, headers, and what fits into a terminal."""

from collections.abc import Sequence
from typing import Any

UNKNOWN = "–"
_PRINTED_LENGTH = 10  # characters; a longer number is rounded in tables for people
_LONGEST_TEXT = 36  # characters of a text in a table; ids are never shortened
_BETWEEN = 3  # characters between columns


def printed(value: Any) -> str:  # noqa: ANN401 - any value of the catalogue
    """A value as text, rounded where it is long, its control characters escaped; an unknown one as a dash."""
    text = exact(value)
    return f"{value:.6g}" if isinstance(value, float) and len(text) > _PRINTED_LENGTH else text


def exact(value: Any) -> str:  # noqa: ANN401 - any value of the catalogue
    """A value as text with all its digits, so that two different ones never look the same; no control characters."""
    from actuator_select.database.cells import ascii_controls, write_value

    return UNKNOWN if value is None else ascii_controls(write_value(value))


def shortened(text: str) -> str:
    """A text on one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST_TEXT else f"{line[: _LONGEST_TEXT - 1]}…"


def folded(label: str, width: int) -> str:
    """A header over several lines, no wider than its longest word or than `width`, its unit unbroken."""
    words, bracket, unit = label.partition(" [")
    lines: list[str] = []
    tokens = [*words.split(), *([f"[{unit}"] if bracket else [])]
    width = max(width, *map(len, tokens))
    for token in tokens:
        if lines and len(lines[-1]) + 1 + len(token) <= width:
            lines[-1] += f" {token}"
        else:
            lines.append(token)
    return "\n".join(lines)


def fitting(headers: Sequence[str], rows: Sequence[Sequence[str]], room: int, *, least: int = 1) -> tuple[int, bool]:
    """How many leading columns fit beside each other.

    Parameters
    ----------
    headers : sequence of str
        Labels of the columns.
    rows : sequence of sequence of str
        Cells.
    room : int
        Characters in a line.
    least : int
        Columns that are shown in any case.

    Returns
    -------
    int, bool
        Number of columns, and whether their headers have to be folded for it.
    """
    contents = [max((len(row[column]) for row in rows), default=0) for column in range(len(headers))]
    plain = sum(max(content, len(label)) + _BETWEEN for content, label in zip(contents, headers, strict=True))
    if plain <= room:
        return len(headers), False
    used = 0
    for column, (content, label) in enumerate(zip(contents, headers, strict=True)):
        used += max(content, *map(len, folded(label, content).splitlines())) + _BETWEEN
        if used > room and column >= least:
            return column, True
    return len(headers), True
