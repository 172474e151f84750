"""New study files: a commented text per family of robots, with a box and tensions that suit its size."""

import re
from collections.abc import Iterator
from importlib import resources
from itertools import product

import numpy as np
import tomlkit

from actuator_select.errors import UnknownName, did_you_mean
from actuator_select.model.arrays import FloatArray
from actuator_select.model.demand import compute_demand
from actuator_select.model.kinematics import position_grid
from actuator_select.study.loading import parse_study
from actuator_select.study.schema import LARGE
from actuator_select.study.template_families import (
    GRAVITY,
    TEMPLATES,
    Draft,
    Template,
    TemplateOptions,
    draft_robot,
    refuse_options,
    toml_number,
    toml_vector,
)

DEFAULT_TEMPLATE = "camera-4"
LEAST_TENSION = 0.02  # of the greatest; 1 to 5 % is usual
SHRUNK = ((0.8, 0.7, 0.6, 0.5), (0.4, 0.3, 0.2, 0.1))  # of the room in plan; small ones only after larger tensions
STRONGER = (1.0, 2.0, 4.0)  # times the template's own tension, tried where no box can be held
PROBE = (5, 5, 5)  # positions along each axis at which a box is tried
MOST_POINTS, LEAST_POINTS = 9, 5  # of the grid along the longest and the shortest axis
COMMENT_COLUMN = 37

_FOLDER = resources.files("actuator_select") / "studies" / "templates"


def template_text(name: str, template: str = DEFAULT_TEMPLATE, options: TemplateOptions | None = None) -> str:
    """Text of a commented study file to start from, which works as it stands.

    Parameters
    ----------
    name : str
        Name of the new study.
    template : str
        One of `TEMPLATES`.
    options : TemplateOptions, optional
        Sizes, mass and speed.

    Returns
    -------
    str
        TOML. Its box is the largest of a few that the robot can hold everywhere under the tension model.

    Raises
    ------
    UnknownName
        If there is no such template.
    InvalidInput
        Naming every option that does not suit it.
    """
    if template not in TEMPLATES:
        raise UnknownName(f"no template {template!r}; {did_you_mean(template, list(TEMPLATES))}")
    given = options or TemplateOptions()
    own = TEMPLATES[template]
    refuse_options(template, own, given)
    mass = own.mass if given.mass is None else given.mass
    draft = draft_robot(template, own, given, mass)
    last = ""
    for words, box in _attempts(own, given, draft, mass):
        last = _filled(template, own, name, words, draft, box)
        if _holds(last, box):
            return last
    return last.replace(
        _BOX_NOTE, "No box was found that the robot can hold all of; `robot show` says what is the matter."
    )


_BOX_NOTE = "Of the room that the frame leaves, a part that this robot can hold."


def _sideways(draft: Draft, force: float) -> str:
    """A force [N] along each horizontal axis on which the robot moves, as a TOML list."""
    moves = np.ptp(draft.room, axis=1)[:2] > 0.0
    return f"[{', '.join([toml_number(force if one else 0.0) for one in moves] + ['0.0'])}]"


def _attempts(
    own: Template, given: TemplateOptions, draft: Draft, mass: float
) -> Iterator[tuple[dict[str, str], FloatArray]]:
    """Tensions and boxes to try, the usual tension and the largest box first."""
    speed = own.speed if given.speed is None else given.speed
    ramp = float(f"{max(speed / own.acceleration, 0.1):.2g}")
    for shares, stronger in product(SHRUNK, STRONGER):
        greatest = min(LARGE, float(f"{stronger * own.strength * mass * GRAVITY:.2g}"))
        note = (
            own.tension_note
            if stronger == 1.0
            else f"{stronger * own.strength:g} times the weight, which this shape takes"
        )
        words = {
            "TENSION_MIN": toml_number(LEAST_TENSION * greatest),
            "TENSION_MAX": toml_number(greatest),
            "TENSION_NOTE": note,
            "MASS": toml_number(mass),
            "EMPTY": toml_number(mass / 3.0),
            "REACH": _sideways(draft, 0.02 * mass * GRAVITY),
            "SPEED": toml_number(speed),
            "HALF_SPEED": toml_number(speed / 2.0),
            "RAMP": toml_number(ramp),
            "TWICE_RAMP": toml_number(2.0 * ramp),
            "ACCELERATION": toml_number(speed / ramp),
            "CABLE_SPEED": toml_number(2.0 * speed),
        }
        for share in shares:
            middle = draft.room.mean(axis=1, keepdims=True)
            box = middle + (draft.room - middle) * np.array([[share], [share], [1.0]])
            yield words, np.round(box, 3)


def _filled(template: str, own: Template, name: str, words: dict[str, str], draft: Draft, box: FloatArray) -> str:
    middle, extent = box.mean(axis=1), box[:, 1] - box[:, 0]
    points = [1 if one == 0.0 else max(LEAST_POINTS, round(MOST_POINTS * one / extent.max())) for one in extent]
    inner = np.column_stack([middle - extent / 4.0, middle + extent / 4.0])
    long = int(extent.argmax())
    ends = np.repeat(middle[None], 2, axis=0)
    ends[:, long] = box[long]
    marks = (
        draft.words
        | words
        | {
            "NAME": tomlkit.string(name).as_string(),
            "DESCRIPTION": tomlkit.string(own.description).as_string(),
            "BOX_NOTE": _BOX_NOTE,
            "BOX": "[" + ", ".join(toml_vector(one) for one in box) + "]",
            "INNER_BOX": "[" + ", ".join(toml_vector(one) for one in inner) + "]",
            "POINTS": str(points),
            "HOME": toml_vector(middle),
            "FROM": toml_vector(ends[0]),
            "TO": toml_vector(ends[1]),
            "LENGTH_MIN": toml_number(0.02 * float(draft.size.max())),
            "LENGTH_MAX": toml_number(2.0 * float(np.linalg.norm(draft.size))),
            "GRAVITY_ARM": "0.0" if not draft.turns else "-0.05",
            "TURNING": _TURNING if draft.turns else "",
            "TENSION_MODEL": _HUNG if template == "cpr8" else _HELD,
        }
    )
    robot = _read(template).rstrip().replace("@CABLES@", marks.get("CABLES", ""))
    text = _read("common").replace("@ROBOT@", robot.replace("@COUNTERBALANCE@", _counterbalance(draft, words)))
    return _aligned(re.sub("@([A-Z_0-9]+)@", lambda mark: marks[mark[1]], text))


_TURNING = """\
#angular_speed_max_rad_per_s = 0.1 # the platform turns as well, with the same ramps; payloads then need inertia_kg_m2
"""
_HELD = """\
model = "wrench_feasible" # cables pull, never push, and balance every force and moment within their tensions"""
_HUNG = """\
# All eight cable lines of an upright carrier meet in one vertical line, about which no cable can turn it: against all
# six equations ("wrench_feasible") this robot holds nothing while it accelerates. It hangs, and may turn a little.
model = "force_only" # cables pull, never push, and balance the forces; moments are left to the hanging load"""


def _counterbalance(draft: Draft, words: dict[str, str]) -> str:
    """Commented example of a counterweight above the middle."""
    tension = toml_number(0.1 * float(words["MASS"]) * GRAVITY)
    return f"""\
# Ropes beside the cables, over pulleys on frame and platform, take a part of the weight off the winches.
#[[robot.counterbalance]]
#tension_n = {tension} # a counterweight; or tension_range_n = [0.0, {tension}] of a rope that is controlled
#[[robot.counterbalance.segment]]
#frame_anchor_m = {toml_vector(draft.top)}
#platform_anchor_m = [0.0, 0.0, 0.0]"""


def _holds(text: str, box: FloatArray) -> bool:
    """Whether all of a box can be held over the whole motion set."""
    study = parse_study(text, place="the template")
    points = tuple(1 if low == high else count for (low, high), count in zip(box, PROBE, strict=True))
    probe = position_grid(box, (points[0], points[1], points[2]))
    demand = compute_demand(
        study.robot, probe, study.orientations, study.wrenches, study.motion, tension_model=study.tension_model
    )
    return bool(demand.attainable_positions.all())


def _aligned(text: str) -> str:
    """Put the comments behind values into one column."""
    return re.sub(
        r"^(#?[\w.\"]+ = .*?\S|# t5\w+ = .*?\S) +(# .*)$",
        lambda line: f"{line[1]:<{COMMENT_COLUMN - 1}} {line[2]}",
        text,
        flags=re.MULTILINE,
    )


def _read(template: str) -> str:
    return (_FOLDER / f"{template}.toml.txt").read_text(encoding="utf-8")
