"""Names in messages: what to suggest for a word that is not known, and the first of many."""

from collections.abc import Sequence

from actuator_select.errors import did_you_mean

_LISTED_NAMES = 12  # more names than these are not listed in a message
_NAMED_ROWS = 3  # more are counted


def first_of(names: Sequence[str]) -> str:
    """The first few of many names, and how many more there are."""
    others = len(names) - _NAMED_ROWS
    return ", ".join(names[:_NAMED_ROWS]) + (f" and {others} more" if others > 0 else "")


def suggestion(word: str, known: Sequence[str], command: str) -> str:
    """Near names, or all where they are few, or the command that lists them."""
    hint = did_you_mean(word, known)
    too_many = len(known) > _LISTED_NAMES and hint.startswith("known are")
    return f"`actuator-select {command}` lists what there is" if too_many else hint
