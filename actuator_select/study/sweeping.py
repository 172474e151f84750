"""``key=start:stop:step``: vary keys of a study over ranges."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import isfinite, prod

import tomlkit
from tomlkit.exceptions import TOMLKitError

from actuator_select.errors import InvalidStudy, Problem

MOST_COMBINATIONS = 100_000
STEP_TOLERANCE = 1e-9  # of a step; keeps a stop that is reached but for rounding
DIGITS = 12  # significant ones of a value, so that 3 steps of 0.1 are 0.3

Number = int | float


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepAxis:
    """One key and the values that it takes.

    Attributes
    ----------
    key : str
        Dotted key of the study.
    values : tuple of int or float
        In the unit of the key.
    """

    key: str
    values: tuple[Number, ...]


def parse_sweep(assignments: Sequence[str]) -> tuple[SweepAxis, ...]:
    """Read ranges as they stand on a command line.

    Parameters
    ----------
    assignments : sequence of str
        Each ``key=start:stop:step``, the stop included where a step meets it, ``key=[v1, v2]``, or ``key=v1,v2``.

    Returns
    -------
    tuple of SweepAxis
        In the order given.

    Raises
    ------
    InvalidStudy
        For every range that cannot be read, a key given twice, and more than `MOST_COMBINATIONS`.
    """
    axes: list[SweepAxis] = []
    problems: list[Problem] = []
    for assignment in assignments:
        key, equals, text = assignment.partition("=")
        values = _values(text.strip()) if equals and key.strip() else "no KEY=RANGE"
        if isinstance(values, str):
            problems.append(
                Problem(
                    place=key.strip() or "the sweep",
                    value=f"{assignment!r} ({values})",
                    expected="KEY=START:STOP:STEP or KEY=[V1, V2, ...] with finite numbers",
                    remedy="write for example robot.w_p_m=0:20:1 or payload.mass_kg=[10,20,50]",
                )
            )
        elif any(axis.key == key.strip() for axis in axes):
            problems.append(Problem(place=key.strip(), value="is given twice", expected="every key once"))
        else:
            axes.append(SweepAxis(key=key.strip(), values=values))
    total = prod(len(axis.values) for axis in axes)
    if not problems and not axes:
        problems.append(Problem(place="the sweep", value="no key", expected="KEY=RANGE, once or more"))
    if total > MOST_COMBINATIONS:
        problems.append(
            Problem(
                place="the sweep",
                value=f"{total:,} combinations",
                expected=f"at most {MOST_COMBINATIONS:,}",
                remedy="take larger steps",
            )
        )
    if problems:
        raise InvalidStudy("the study cannot be swept so", problems)
    return tuple(axes)


def combinations(axes: Sequence[SweepAxis]) -> Iterator[dict[str, Number]]:
    """Overrides of every combination; the last key varies fastest."""
    for values in product(*(axis.values for axis in axes)):
        yield dict(zip((axis.key for axis in axes), values, strict=True))


def _values(text: str) -> tuple[Number, ...] | str:
    """Values of a range or a list, or what is wrong with it."""
    if ":" in text:
        ends = _numbers(text.split(":"))
        return "not three numbers" if ends is None or len(ends) != 3 else _steps(*ends)  # noqa: PLR2004 - start:stop:step
    listed = _numbers(text.removeprefix("[").removesuffix("]").rstrip(", ").split(","))
    return "not numbers" if listed is None else listed


def _numbers(words: Sequence[str]) -> tuple[Number, ...] | None:
    """Read numbers as TOML does, so that a whole one stays whole; None where one is none."""
    numbers: list[Number] = []
    for word in words:
        try:
            value = tomlkit.parse(f"value = {word.strip()}").unwrap()["value"]
        except TOMLKitError:
            return None
        if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
            return None
        numbers.append(value)
    return tuple(numbers)


def _steps(start: Number, stop: Number, step: Number) -> tuple[Number, ...] | str:
    if step == 0.0:
        return "a step of zero"
    count = (stop - start) / step + STEP_TOLERANCE
    if count < 0.0:
        return "the step leads away from the stop"
    if count >= MOST_COMBINATIONS:
        return f"{count:,.0f} steps, more than {MOST_COMBINATIONS:,}"
    whole = all(isinstance(number, int) for number in (start, stop, step))
    values = (start + index * step for index in range(int(count) + 1))
    return tuple(int(value) if whole else float(f"{value:.{DIGITS}g}") for value in values)
