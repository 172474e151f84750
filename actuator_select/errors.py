"""Errors that tell a user what to do: every one is an `ActuatorSelectError` and the builtin it stands for."""

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches


class ActuatorSelectError(Exception):
    """The question cannot be posed as it stands. Every error meant for the user descends from this one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Problem:
    """One thing that is wrong with an input.

    Attributes
    ----------
    place : str
        Where: a key path, or file, line and column.
    value : str
        What stands there, as written.
    expected : str
        What may stand there, with its unit.
    remedy : str
        What to do; may be empty where `expected` says it all.
    """

    place: str
    value: str
    expected: str
    remedy: str = ""

    def __str__(self) -> str:
        text = f"{self.place}: {self.value}, expected {self.expected}"
        return f"{text}; {self.remedy}" if self.remedy else text


class InvalidInput(ActuatorSelectError, ValueError):
    """Input with one or more problems, all of them listed.

    Attributes
    ----------
    problems : tuple of Problem
        Every problem that was found, in the order of the input.
    """

    def __init__(self, heading: str, problems: Sequence[Problem] = ()) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join([heading, *(f"  {problem}" for problem in self.problems)]))


class InvalidStudy(InvalidInput):
    """A study file that does not describe a study."""


class InvalidRows(InvalidInput):
    """Catalogue rows that cannot be taken in."""


class RowInUse(ActuatorSelectError, ValueError):
    """A catalogue row that cannot be removed, because other rows refer to it."""


class InvalidExpression(InvalidInput):
    """A ``--where`` or ``--sort`` expression that does not parse or names no column.

    Attributes
    ----------
    position : int
        Index of the offending token in the expression.
    """

    def __init__(self, expression: str, position: int, message: str) -> None:
        self.position = position
        super().__init__(f"{message}\n  {expression}\n  {' ' * position}^")


class UnknownName(ActuatorSelectError, LookupError):
    """A study, part, column or command word that does not exist."""


class CatalogueUnavailable(ActuatorSelectError, OSError):
    """The database cannot be opened, read or written."""


class OutputNotWritable(ActuatorSelectError, OSError):
    """A result could not be written where it was asked for."""


class NoCandidates(ActuatorSelectError, LookupError):
    """No actuator is left to evaluate."""


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """Suggest the known words nearest to `word`, or list them all when none is near.

    Parameters
    ----------
    word : str
        What was written.
    known : sequence of str
        What could have been written.

    Returns
    -------
    str
        A clause for the end of a message.
    """
    near = get_close_matches(word, known, n=3)
    if near:
        return f"did you mean {' or '.join(repr(name) for name in near)}?"
    return f"known are {', '.join(known)}" if known else "there are none"
