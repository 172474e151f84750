"""``key=value``: change any key of a study without editing its file."""

import re
from collections.abc import Mapping, MutableMapping, Sequence
from itertools import pairwise
from typing import Any

import tomlkit
from pydantic import BaseModel
from tomlkit.exceptions import TOMLKitError

from actuator_select.errors import InvalidStudy, Problem
from actuator_select.study.problems import default_of

# A key that stands for another one and takes its place.
_REPLACES = {
    "workspace.box_m": "workspace.region",
    "robot.t5_n": "robot.t5_range_n",
    "robot.t5_range_n": "robot.t5_n",
    "workspace.orientation_grid_deg": "workspace.orientations_rad",
    "workspace.orientations_rad": "workspace.orientation_grid_deg",
}
_BARE_WORD = re.compile(r"[A-Za-z_][\w.-]*")
_KEY_PART = re.compile(r"([A-Za-z0-9_-]+)((?:\[\d+\])*)")


def parse_overrides(assignments: Sequence[str]) -> dict[str, object]:
    """Read assignments as they stand on a command line.

    Parameters
    ----------
    assignments : sequence of str
        Each ``key=value``; the key is dotted (``robot.cable[0].frame_anchor_m``), the value is TOML. A bare word is
        taken as text, so that shells need no second pair of quotes.

    Returns
    -------
    dict of str to object
        Key to value, later assignments over earlier ones.

    Raises
    ------
    InvalidStudy
        For every assignment that cannot be read.
    """
    values: dict[str, object] = {}
    problems = []
    for assignment in assignments:
        key, _, text = assignment.partition("=")
        value = _toml_value(text.strip())
        if key.strip() and value is not None:
            values[key.strip()] = value
        else:
            problems.append(
                Problem(
                    place="--set",
                    value=repr(assignment),
                    expected="KEY=VALUE with a TOML value",
                    remedy="write for example workspace.points=[11,11,11] or requirement.feasible_percent=95",
                )
            )
    if problems:
        raise InvalidStudy("the study cannot be changed so", problems)
    return values


def _toml_value(text: str) -> object | None:
    """Value of a piece of TOML, or None where it is not one value."""
    try:
        content = tomlkit.parse(f"value = {text}").unwrap()
    except TOMLKitError:
        return text if _BARE_WORD.fullmatch(text) else None
    return content["value"] if len(content) == 1 else None


def apply_overrides(document: MutableMapping[str, Any], overrides: Mapping[str, object]) -> None:
    """Set keys of a study in place; in a parsed study file comments and order stay.

    Parameters
    ----------
    document : mutable mapping
        The study, plain or as tomlkit parsed it.
    overrides : mapping of str to object
        Dotted key to value. A table that is missing is made, an unknown key is left for the study's validation; in a
        list with a single table, that table is meant.

    Raises
    ------
    InvalidStudy
        Where a key leads through a value that is no table, or past the end of a list.
    """
    for key, value in overrides.items():
        steps = _steps(key)
        container: Any = document
        try:
            for depth, (step, following) in enumerate(pairwise(steps)):
                if isinstance(following, str) and isinstance(step, str) and step not in container:
                    container[step] = tomlkit.table() if isinstance(document, tomlkit.TOMLDocument) else {}
                if isinstance(following, int):
                    _default_list(container, steps[: depth + 1])
                container = container[step]
                if isinstance(following, str) and isinstance(container, list) and len(container) == 1:
                    container = container[0]  # of a single [[payload]], payload.mass_kg says which is meant
            container[steps[-1]] = value
        except (KeyError, IndexError, TypeError, TOMLKitError) as error:
            raise InvalidStudy(
                "the study cannot be changed so",
                [
                    Problem(
                        place=key,
                        value="leads nowhere",
                        expected="a key of the study, such as motion.speed_max_m_per_s or payload[0].mass_kg",
                        remedy="`actuator-select study show` prints the study with its keys",
                    )
                ],
            ) from error
    for key, replaced in _REPLACES.items():
        if key in overrides and replaced not in overrides:
            table, _, name = replaced.partition(".")
            document[table].pop(name, None)


def _default_list(container: Any, path: Sequence[str | int]) -> None:  # noqa: ANN401 - plain or as tomlkit parsed it
    """Write a list out that the study leaves at its default, so that one of its entries can be set."""
    name = path[-1]
    if not isinstance(container, MutableMapping) or name in container or not isinstance(name, str):
        return
    default = default_of(path)
    if isinstance(default, tuple) and default and not isinstance(default[0], BaseModel):
        container[name] = list(default)


def _steps(key: str) -> list[str | int]:
    steps: list[str | int] = []
    for part in key.split("."):
        match = _KEY_PART.fullmatch(part)
        if match is None:
            raise InvalidStudy(
                "the study cannot be changed so",
                [
                    Problem(
                        place="--set", value=repr(key), expected="a dotted key such as robot.cable[0].frame_anchor_m"
                    )
                ],
            )
        steps.append(match[1])
        steps.extend(int(index) for index in re.findall(r"\d+", match[2]))
    return steps
