"""``actuator-select catalog add``: from the command line, or question by question."""

import sys
from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.errors import InvalidRows, Problem, UnknownName

if TYPE_CHECKING:
    from actuator_select.database import Catalogue
    from actuator_select.database.fields import Field, Kind

NEW_SOURCE = "new"
_SOURCE_PREFIX = "source."


@click.command("add")
@click.argument("kind", metavar="KIND")
@click.argument("fields", nargs=-1, metavar="[FIELD=VALUE]...")
@options.database_option
def add(kind: str, fields: tuple[str, ...], database: str | None) -> None:
    """Add one row: FIELD=VALUE on the command line, or without fields, question by question.

    KIND is source, motor, gearbox, winch, rope or actuator. Units are those of the field's name; `actuator-select
    catalog fields KIND` lists all fields with their ranges. What is left out or empty is unknown. Every row names its
    source: source_id=… for one that the catalogue has, or source.document=… with source.url=… (or source.page=…,
    source.doi=…) and source.date=… for a new one.

    \b
    Examples:
        actuator-select catalog add motor
        actuator-select catalog add motor id=acme-m1 rated_power_w=150 rated_speed_rpm=3000 rated_torque_nm=0.48 \\
            source.document="Acme catalogue" source.url=https://acme.example/m.pdf source.date=2024
        actuator-select catalog add actuator id=mine name="My actuator" motor_id=acme-m1 \\
            winch_id=filipovic-kevac-2018-winch source_id=acme-catalogue-2024
    """
    from actuator_select.database import open_catalogue
    from actuator_select.database.kinds import find_kind
    from actuator_select.selection import check_rows

    found = find_kind(kind)
    values, source = _split(fields)
    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        row = catalogue.add(found.name, values, source) if fields else _interview(catalogue, found)
    for finding in check_rows(found.name, [row]):
        console.warn(f"{finding.kind} {finding.id}: {finding.text}")
    console.say(f"Added {found.singular} {row['id']}.")
    console.say(f"Next: actuator-select catalog show {row['id']} --kind {found.name}")


def _split(fields: tuple[str, ...]) -> tuple[dict[str, object], dict[str, object] | None]:
    """Values of the row and, if any was given, of its new source."""
    values: dict[str, object] = {}
    source: dict[str, object] = {}
    problems = []
    for written in fields:
        name, equals, value = written.partition("=")
        target = source if name.startswith(_SOURCE_PREFIX) else values
        name = name.removeprefix(_SOURCE_PREFIX)
        if not equals:
            problems.append(Problem(place=f"'{written}'", value="no value", expected="FIELD=VALUE"))
        elif name in target:
            problems.append(Problem(place=name, value=f"'{value}'", expected="each field once"))
        target[name] = value
    if problems:
        raise InvalidRows("nothing was added", problems)
    return values, source or None


def _interview(catalogue: "Catalogue", kind: "Kind") -> dict[str, Any]:
    """Ask for every field; ask again for what the whole row shows to be wrong."""
    console.say(f"{kind.description}. Press Enter where a figure is unknown, Ctrl-C to stop; nothing is half-added.")
    values: dict[str, object] = {}
    source: dict[str, object] | None = None
    asked = [field.name for field in kind.fields]
    while True:
        for field in kind.fields:
            if field.name in asked:
                values[field.name] = _ask(catalogue, kind, field)
        if values.get("source_id") == NEW_SOURCE and (source is None or "source_id" in asked):
            source = _ask_source(catalogue)
        try:
            return catalogue.add(kind.name, values, source if values.get("source_id") == NEW_SOURCE else None)
        except InvalidRows as error:
            click.echo(f"Error: {error}", err=True)
            asked = [field.name for field in kind.fields if field.name in _places(error)]
            if not asked:
                raise


def _places(error: InvalidRows) -> set[str]:
    """Columns that problems concern; anything about a new source leads back to its question."""
    return {"source_id" if problem.place.startswith(_SOURCE_PREFIX) else problem.place for problem in error.problems}


def _ask_source(catalogue: "Catalogue") -> dict[str, object]:
    from actuator_select.database.kinds import SOURCES

    console.say("The new source:")
    answers = {field.name: _ask(catalogue, SOURCES, field, derived=field.name == "id") for field in SOURCES.fields}
    return {name: answer for name, answer in answers.items() if answer is not None}


def _ask(catalogue: "Catalogue", kind: "Kind", field: "Field", *, derived: bool = False) -> object:
    """Ask until the answer can stand in the field."""
    from actuator_select.database.cells import Refused, read_value

    while True:
        text = _answer(_question(field, derived=derived))
        try:
            value = read_value(field, text)
        except Refused as refused:
            console.say(f"  {refused.at(field.name, text)}")
            continue
        if value is None and field.required and not derived:
            console.say(f"  {field.name} has to be filled in: {field.expected}")
        elif isinstance(value, str) and (objection := _objection(catalogue, kind, field, value)):
            console.say(f"  {objection}")
        else:
            return value


def _question(field: "Field", *, derived: bool) -> str:
    expected = field.expected
    if field.name == "source_id":
        expected = f"{expected}, or {NEW_SOURCE} for a new one"
    need = "required" if field.required and not derived else "may be empty"
    return f"{field.name} – {field.description} ({expected}; {need})"


def _answer(question: str) -> str:
    try:
        answer: str = click.prompt(question, default="", show_default=False, err=True)
    except click.Abort:
        if sys.stdin.isatty():
            raise
        raise InvalidRows(
            "the answers end before the row is complete; nothing was added. Give FIELD=VALUE pairs, or answer "
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
