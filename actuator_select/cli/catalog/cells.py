"""How a value of the catalogue is printed for people."""

from typing import Any

UNKNOWN = "–"
_PRINTED_LENGTH = 10  # characters; a longer number is rounded in tables for people


def printed(value: Any) -> str:  # noqa: ANN401 - any value of the catalogue
    """A value as text, rounded where it is long; an unknown one as a dash."""
    from actuator_select.database.cells import write_value

    text = UNKNOWN if value is None else write_value(value)
    return f"{value:.6g}" if isinstance(value, float) and len(text) > _PRINTED_LENGTH else text


def exact(value: Any) -> str:  # noqa: ANN401 - any value of the catalogue
    """A value as text with all its digits, so that two different ones never look the same."""
    from actuator_select.database.cells import write_value

    return UNKNOWN if value is None else write_value(value)
