"""From pydantic's errors to messages with key path, value, expectation, unit and remedy."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from actuator_select.errors import Problem, did_you_mean
from actuator_select.study.schema import StudyTable

_UNITS = {
    "gearbox_efficiency_percent": "per cent",  # with bounds of its own
    "_nm_s_per_rad": "N m s/rad",
    "_g_cm2": "g cm²",
    "_rad_per_s2": "rad/s²",
    "_rad_per_s": "rad/s",
    "_m_per_s2": "m/s²",
    "_m_per_s": "m/s",
    "_kg_m2": "kg m²",
    "_n_m": "N m",
    "_percent": "per cent, 0 to 100",
    "_rad": "rad",
    "_deg": "deg",
    "_kg": "kg",
    "_n": "N",
    "_m": "m",
    "_s": "s",
}

_EXPECTED = {
    "missing": "this key",
    "extra_forbidden": "no such key",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "string_type": "text in quotes",
    "string_too_short": "text that is not empty",
    "string_unicode": "text of Unicode characters",
    "finite_number": "a finite number",
    "tuple_type": "a list in brackets",
    "model_type": "a table",
    "dict_type": "a table",
}


def study_problems(error: ValidationError, content: Mapping[str, object]) -> list[Problem]:
    """Translate every problem that the validation of a study found.

    Parameters
    ----------
    error : ValidationError
        Of `StudyTable`.
    content : mapping
        What was validated.

    Returns
    -------
    list of Problem
        In the order of the schema.
    """
    found = error.errors(include_url=False)
    if isinstance(content.get("payload"), dict):  # a single table, written without an index
        for details in found:
            if details["loc"][:2] == ("payload", 0):
                details["loc"] = ("payload", *details["loc"][2:])
    found = _without_alternatives(found)
    places = [details["loc"] for details in found]
    return [
        _problem(details)
        for details in found
        # A list whose entries are wrong is also counted as too short: the entries tell enough.
        if details["type"] != "too_short"
        or not any(
            len(place) > len(details["loc"]) and place[: len(details["loc"])] == details["loc"] for place in places
        )
    ]


def _without_alternatives(found: list[ErrorDetails]) -> list[ErrorDetails]:
    """Of a value that may be a number or a list, the problems of what was written."""
    kept = []
    for details in found:
        written = details["input"]
        if details["type"] == "tuple_type" and any(_is_alternative(step) for step in details["loc"]):
            continue  # a number was written
        if details["type"] == "float_type" and isinstance(written, list | tuple):
            continue  # a list was written
        details["loc"] = tuple(step for step in details["loc"] if not _is_alternative(step))
        kept.append(details)
    return kept


def _is_alternative(step: str | int) -> bool:
    """Whether a step of a location names one of several types, as pydantic writes them, instead of a key."""
    return isinstance(step, str) and ("[" in step or "-" in step)


def _problem(details: ErrorDetails) -> Problem:
    kind, location = details["type"], details["loc"]
    unit = _unit(location)
    if kind == "missing":
        return Problem(
            place=_path(location), value="is missing", expected=f"a value{_in(unit)}", remedy="add the key to the study"
        )
    if kind == "extra_forbidden":
        known = _known_keys(location[:-1])
        return Problem(
            place=_path(location),
            value="is not a key of a study",
            expected="one that the study knows",
            remedy=did_you_mean(str(location[-1]), known),
        )
    return Problem(place=_path(location), value=_shown(details["input"]), expected=_expectation(details) + _in(unit))


def _expectation(details: ErrorDetails) -> str:
    kind, context = details["type"], details.get("ctx", {})
    if kind in _EXPECTED:
        return _EXPECTED[kind]
    bounds = {
        "greater_than": ("gt", "more than"),
        "greater_than_equal": ("ge", "at least"),
        "less_than_equal": ("le", "at most"),
    }
    if kind in bounds:
        key, words = bounds[kind]
        return f"{words} {context[key]:g}"
    if kind == "literal_error":
        return f"one of {context['expected']}"
    if kind in ("too_short", "too_long"):
        wanted = context.get("min_length", context.get("max_length"))
        return f"{'at least ' if kind == 'too_short' else 'at most '}{wanted} entries"
    if kind == "value_error":
        return str(context["error"])
    return details["msg"][:1].lower() + details["msg"][1:]


def _path(location: Sequence[str | int]) -> str:
    path = ""
    for step in location:
        path += f"[{step}]" if isinstance(step, int) else f".{step}" if path else step
    return path or "the study"


def _shown(value: object) -> str:
    if isinstance(value, dict):
        return "the table as it stands"
    try:
        return json.dumps(value, ensure_ascii=False)
    except TypeError:
        return str(value)


def _unit(location: Sequence[str | int]) -> str:
    for step in reversed(location):
        if isinstance(step, str):
            return next((unit for suffix, unit in _UNITS.items() if step.endswith(suffix)), "")
    return ""


def _in(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def _known_keys(location: Sequence[str | int]) -> list[str]:
    """Keys of the table at `location`."""
    model: type[BaseModel] = StudyTable
    for step in location:
        if isinstance(step, str):
            found = _table_type(model.model_fields[step].annotation)
            if found is None:
                return []
            model = found
    return list(model.model_fields)


def default_of(path: Sequence[str | int]) -> object:
    """Default of the key at `path`, or None where it has none or the study knows no such key."""
    model: type[BaseModel] | None = StudyTable
    *tables, key = [step for step in path if isinstance(step, str)]
    for step in tables:
        field = model.model_fields.get(step) if model is not None else None
        model = _table_type(field.annotation) if field is not None else None
    field = model.model_fields.get(key) if model is not None else None
    return field.default if field is not None and not field.is_required() else None


def _table_type(annotation: Any) -> type[BaseModel] | None:  # noqa: ANN401 - an annotation can be anything
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for argument in get_args(annotation) if (found := _table_type(argument))), None)
