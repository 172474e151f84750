"""Asking for a row question by question, from nothing or from what it says now."""

import sys
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import click

from actuator_select.cli import console
from actuator_select.errors import InvalidRows, Problem, UnknownName

if TYPE_CHECKING:
    from actuator_select.database import Catalogue
    from actuator_select.database.fields import Field, Kind

NEW_SOURCE = "new"
EMPTIED = "-"
_SOURCE_PREFIX = "source."

Values = dict[str, object]
_Outcome = TypeVar("_Outcome")
_Written_co = TypeVar("_Written_co", covariant=True)


class _Write(Protocol[_Written_co]):
    """What writes the values of a row and of its new source."""

    def __call__(self, values: Values, *, source: Values | None, dry_run: bool) -> _Written_co: ...


def write_fields(fields: tuple[str, ...], write: _Write[_Outcome], *, dry_run: bool = False) -> _Outcome:
    """Write what FIELD=VALUE arguments say of the row and of its new source.

    Raises
    ------
    InvalidRows
        With everything that is wrong: arguments that say no value, and what the catalogue has against the others.
    """
    values, source, problems = _split_fields(fields)
    if not problems:
        return write(values, source=source, dry_run=dry_run)
    told = {written.partition("=")[0] for written in fields if "=" not in written}
    try:
        write(values, source=source, dry_run=True)
    except InvalidRows as error:
        # What a column lacks because its argument says no value needs no second telling.
        problems += [problem for problem in error.problems if problem.place not in told]
    raise InvalidRows("nothing was written", problems)


def _split_fields(fields: tuple[str, ...]) -> tuple[Values, Values | None, list[Problem]]:
    """Values of the row and, if any was given, of its new source, and what is wrong with the arguments."""
    from actuator_select.database.cells import quoted

    values: Values = {}
    source: Values = {}
    problems = []
    for written in fields:
        name, equals, value = written.partition("=")
        target = source if name.startswith(_SOURCE_PREFIX) else values
        name = name.removeprefix(_SOURCE_PREFIX)
        if not equals:
            problems.append(Problem(place=quoted(written), value="no value", expected="FIELD=VALUE"))
            continue
        if name in target:
            problems.append(Problem(place=name, value=quoted(value), expected="each field once"))
        target[name] = value
    return values, source or None, problems


def interview(
    catalogue: "Catalogue",
    kind: "Kind",
    write: Callable[[Values, Values | None], _Outcome],
    present: Mapping[str, Any] | None = None,
) -> _Outcome:
    """Ask for every field and write the answers; ask again for what the whole row shows to be wrong.

    With the values of a row that is `present`, only those that the answers change are written, and not its id.
    A question that is repeated offers the last answer.
    """
    fields = [field for field in kind.fields if present is None or field.name != "id"]
    before = {field.name: None if present is None else present[field.name] for field in fields}
    answers: Values = dict(before)
    source: Values | None = None
    asked = {field.name for field in fields}
    while True:
        for field in fields:
            if field.name in asked:
                answers[field.name] = _ask(catalogue, kind, field, answers[field.name], before[field.name])
        if answers.get("source_id") == NEW_SOURCE and (source is None or "source_id" in asked):
            source = _ask_source(catalogue, source or {})
        values = {name: value for name, value in answers.items() if present is None or value != before[name]}
        is_new = values.get("source_id") == NEW_SOURCE
        if is_new:
            del values["source_id"]
        try:
            return write(values, source if is_new else None)
        except InvalidRows as error:
            click.echo(f"Error: {error}", err=True)
            asked = {field.name for field in fields} & _places(error)
            if not asked:
                raise
            console.say(f"Once more; Enter keeps what stands in brackets, {EMPTIED} empties it.")


def _places(error: InvalidRows) -> set[str]:
    """Columns that problems concern; anything about a new source leads back to its question."""
    return {"source_id" if problem.place.startswith(_SOURCE_PREFIX) else problem.place for problem in error.problems}


def _ask_source(catalogue: "Catalogue", last: Values) -> Values:
    from actuator_select.database.kinds import SOURCES

    console.say("The new source:")
    answers = {
        field.name: _ask(catalogue, SOURCES, field, last.get(field.name), derived=field.name == "id")
        for field in SOURCES.fields
    }
    return {name: answer for name, answer in answers.items() if answer is not None}


def _ask(
    catalogue: "Catalogue",
    kind: "Kind",
    field: "Field",
    offered: Any = None,  # noqa: ANN401 - any value of the catalogue
    present: Any = None,  # noqa: ANN401 - any value of the catalogue
    *,
    derived: bool = False,
) -> object:
    """Ask until the answer can stand in the field; Enter takes what is `offered`."""
    from actuator_select.database.cells import Refused, read_value, write_value

    default = write_value(offered)
    while True:
        text = _answer(_question(field, derived=derived), default)
        if default not in {"", text} and text.strip() == EMPTIED:
            text = ""
        try:
            value = read_value(field, text)
        except Refused as refused:
            console.say(f"  {refused.at(field.name, text)}")
            continue
        if value is None and field.required and not derived:
            console.say(f"  {field.name} has to be filled in: {field.expected}")
        elif isinstance(value, str) and value != present and (objection := _objection(catalogue, kind, field, value)):
            console.say(f"  {objection}")
        else:
            return value


def _question(field: "Field", *, derived: bool) -> str:
    expected = field.expected
    if field.name == "source_id":
        expected = f"{expected}, or {NEW_SOURCE} for a new one"
    need = "required" if field.required and not derived else "may be empty"
    return f"{field.name} – {field.description} ({expected}; {need})"


def _answer(question: str, default: str) -> str:
    try:
        answer: str = click.prompt(question, default=default, show_default=bool(default), err=True)
    except click.Abort:
        if sys.stdin.isatty():
            raise
        raise InvalidRows(
            "the answers end before the row is complete; nothing was written. Give FIELD=VALUE pairs, or answer "
            "every question"
        ) from None
    return answer


def _objection(catalogue: "Catalogue", kind: "Kind", field: "Field", value: str) -> str:
    """Say what the catalogue has against a text; empty if nothing."""
    if field.name == "source_id" and value == NEW_SOURCE:
        return ""
    if field.references:
        return "" if _exists(catalogue, field.references, value) else _unknown(catalogue, field.references, value)
    if (field.name == "id" or field.unique) and _exists(catalogue, kind.name, value):
        return f"{kind.singular} {value!r} exists already; choose another {field.name}"
    return ""


def _exists(catalogue: "Catalogue", kind: str, row_id: str) -> bool:
    return not _unknown(catalogue, kind, row_id)


def _unknown(catalogue: "Catalogue", kind: str, row_id: str) -> str:
    try:
        catalogue.part(row_id, kind)
    except UnknownName as error:
        return str(error)
    return ""
