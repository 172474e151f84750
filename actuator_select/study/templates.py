"""New study files: a commented text per family of robots, with a box and tensions that suit its size."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from importlib import resources
from itertools import product
from pathlib import Path

import numpy as np
import tomlkit

from actuator_select.errors import InvalidInput, Problem, UnknownName, did_you_mean
from actuator_select.model.arrays import FloatArray
from actuator_select.model.demand import compute_demand
from actuator_select.model.families import cpr8_region
from actuator_select.model.kinematics import position_grid
from actuator_select.model.robot import Plane
from actuator_select.study.building import read_anchors
from actuator_select.study.loading import parse_study
from actuator_select.study.schema import LARGE

GRAVITY = 9.81  # m/s²
LEAST_TENSION = 0.02  # of the greatest; 1 to 5 % is usual
SHRUNK = ((0.8, 0.7, 0.6, 0.5), (0.4, 0.3, 0.2, 0.1))  # of the room in plan; small ones only after larger tensions
STRONGER = (1.0, 2.0, 4.0)  # times the template's own tension, tried where no box can be held
PROBE = (5, 5, 5)  # positions along each axis at which a box is tried
MOST_POINTS, LEAST_POINTS = 9, 5  # of the grid along the longest and the shortest axis
COMMENT_COLUMN = 37
FLAT = 1e-9  # m; anchors nearer to one plane than this lie in it
PLANES = {0: Plane.YZ, 1: Plane.XZ, 2: Plane.XY}  # by their normal

_FOLDER = resources.files("actuator_select") / "studies" / "templates"


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateOptions:
    """What a user may say of a new robot; None takes the template's own.

    Attributes
    ----------
    hall, platform : (3,) tuple of float, optional
        Length, width and height of the frame and of the platform; a planar robot has no use for the widths. [m]
    mass : float, optional
        Platform and load together. [kg]
    speed : float, optional
        Greatest speed of the platform. [m/s]
    anchors : Path, optional
        CSV file of explicit anchors.
    """

    hall: tuple[float, ...] | None = None
    platform: tuple[float, ...] | None = None
    mass: float | None = None
    speed: float | None = None
    anchors: Path | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Template:
    """A family and its own figures; [m], [kg], [m/s], [m/s²], tension in weights."""

    description: str
    hall: tuple[float, float, float] | None
    platform: tuple[float, float, float] | None
    mass: float
    speed: float
    acceleration: float
    strength: float
    tension_note: str
    room: Callable[[FloatArray, FloatArray], FloatArray]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Draft:
    """A robot on its way into a text.

    Attributes
    ----------
    room : (3, 2) array
        Where the platform has room; the box is a part of it. [m]
    words : dict of str to str
        TOML for the marks of the robot's own text.
    top : (3,) array
        Where the frame could carry a counterbalance. [m]
    turns : bool
        Whether the cables control the platform's rotation.
    """

    room: FloatArray
    words: dict[str, str]
    top: FloatArray
    turns: bool = True
    size: FloatArray = field(default_factory=lambda: np.ones(3))


def _free(hall: FloatArray, platform: FloatArray, low: float, high: float) -> FloatArray:
    """Room of a platform in a hall whose middle is x = y = 0; heights as shares of what the platform leaves free."""
    half = (hall - platform) / 2.0
    free = hall[2] - platform[2]
    heights = platform[2] / 2.0 + free * np.array([low, high])
    return np.array([[-half[0], half[0]], [-half[1], half[1]], heights])


def _camera_room(hall: FloatArray, platform: FloatArray) -> FloatArray:  # noqa: ARG001 - a point
    return np.array([[0.0, hall[0]], [0.0, hall[1]], [0.1 * hall[2], 0.8 * hall[2]]])


def _planar_room(hall: FloatArray, platform: FloatArray) -> FloatArray:
    half = (hall - platform) / 2.0
    return np.array([[-half[0], half[0]], [0.0, 0.0], [-0.7 * half[2], 0.5 * half[2]]])


def _cpr8_room(frame: FloatArray, carrier: FloatArray) -> FloatArray:
    region = cpr8_region(frame, carrier)
    region[2, 1] -= 0.3 * (region[2, 1] - region[2, 0])
    return region


R_BASE, R_END = 6.0, 2.0  # of the template six-six [m]

TEMPLATES: dict[str, _Template] = {
    "camera-4": _Template(
        description="A camera on four cables",
        hall=(3.0, 2.0, 2.0),
        platform=None,
        mass=2.0,
        speed=1.0,
        acceleration=1.0,
        strength=3.0,
        tension_note="three times the weight; the nearer the platform to the anchors' height, the more it takes",
        room=_camera_room,
    ),
    "planar-4": _Template(
        description="A platform on four cables in a vertical plane",
        hall=(10.0, 1.0, 4.0),
        platform=(1.0, 0.5, 0.4),
        mass=100.0,
        speed=0.5,
        acceleration=0.5,
        strength=5.0,
        tension_note="five times the weight; the lower cables pull down what the upper ones carry",
        room=_planar_room,
    ),
    "six-six": _Template(
        description="A platform hung on six cables",
        hall=None,
        platform=None,
        mass=1000.0,
        speed=0.5,
        acceleration=0.3,
        strength=2.0,
        tension_note="twice the weight",
        room=lambda hall, platform: np.array([[-R_BASE / 2, R_BASE / 2], [-R_BASE / 2, R_BASE / 2], [-8.0, -4.0]]),  # noqa: ARG005
    ),
    "suspended-8": _Template(
        description="A platform hung on eight cables in a hall",
        hall=(15.0, 11.0, 5.0),
        platform=(1.0, 1.0, 1.0),
        mass=300.0,
        speed=0.5,
        acceleration=0.5,
        strength=3.0,
        tension_note="three times the weight; the nearer the platform to the pulleys' height, the more it takes",
        room=lambda hall, platform: _free(hall, platform, 0.02, 0.65),
    ),
    "constrained-8": _Template(
        description="A platform held by eight cables from above and below in a hall",
        hall=(6.0, 5.0, 4.0),
        platform=(0.5, 0.5, 0.5),
        mass=50.0,
        speed=1.0,
        acceleration=1.0,
        strength=6.0,
        tension_note="six times the weight: upper and lower cables pull against each other",
        room=lambda hall, platform: _free(hall, platform, 0.15, 0.8),
    ),
    "cpr8": _Template(
        description="A box hung by its eight vertices",
        hall=(3.2, 2.2, 2.2),
        platform=(0.224, 0.154, 0.14),
        mass=2.0,
        speed=1.0,
        acceleration=0.5,
        strength=3.0,
        tension_note="three times the weight",
        room=_cpr8_room,
    ),
    "anchors": _Template(
        description="A robot with given anchors",
        hall=None,
        platform=None,
        mass=100.0,
        speed=0.5,
        acceleration=0.5,
        strength=5.0,
        tension_note="five times the weight; state what your cables and drives bear",
        room=lambda hall, platform: np.zeros((3, 2)),  # noqa: ARG005 - from the anchors
    ),
}
DEFAULT_TEMPLATE = "camera-4"


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
    _refuse_options(template, own, given)
    mass = own.mass if given.mass is None else given.mass
    draft = _draft(template, own, given, mass)
    last = ""
    for words, box in _attempts(own, given, draft, mass):
        last = _filled(template, own, name, words, draft, box)
        if _holds(last, box):
            return last
    return last.replace(
        _BOX_NOTE, "No box was found that the robot can hold all of; `robot show` says what is the matter."
    )


_BOX_NOTE = "Of the room that the frame leaves, a part that this robot can hold."


def _refuse_options(template: str, own: _Template, given: TemplateOptions) -> None:
    problems = []
    for option, value, default in (("hall", given.hall, own.hall), ("platform", given.platform, own.platform)):
        if value is None:
            continue
        if default is None:
            problems.append(_problem(option, value, f"no --{option} with the template {template}, which has none"))
        elif len(value) != 3 or not all(1e-3 <= one <= LARGE for one in value):  # noqa: PLR2004 - length, width, height
            problems.append(_problem(option, value, "length, width and height, each at least 0.001 [m]"))
    for option, number, unit in (("mass", given.mass, "kg"), ("speed", given.speed, "m/s")):
        if number is not None and not 1e-3 <= number <= LARGE:  # noqa: PLR2004 - NaN fails too
            problems.append(_problem(option, (number,), f"a number from 0.001 to {LARGE:g} [{unit}]"))
    if (template == "anchors") != (given.anchors is not None):
        problems.append(
            Problem(
                place="--anchors",
                value=str(given.anchors) if given.anchors else "is missing",
                expected="a CSV file with the template anchors, and with no other",
            )
        )
    if not problems and own.hall and own.platform:
        hall, platform = given.hall or own.hall, given.platform or own.platform
        axes = (0, 2) if template == "planar-4" else (0, 1, 2)
        if any(platform[axis] >= hall[axis] for axis in axes):
            problems.append(
                _problem("platform", platform, f"a platform smaller than the hall, {_shown(hall)} m, on every axis")
            )
        elif template == "cpr8":
            room = cpr8_region(np.array(hall), np.array(platform))
            if (room[:, 0] >= room[:, 1]).any():
                problems.append(
                    _problem("platform", platform, f"a carrier whose diagonal fits into the hall, {_shown(hall)} m")
                )
    if problems:
        raise InvalidInput(f"the template {template} cannot be made so", problems)


def _problem(option: str, value: tuple[float, ...], expected: str) -> Problem:
    return Problem(place=f"--{option}", value=_shown(value), expected=expected)


def _shown(value: tuple[float, ...]) -> str:
    return ",".join(f"{one:g}" for one in value)


def _draft(template: str, own: _Template, given: TemplateOptions, mass: float) -> _Draft:
    if template == "anchors":
        return _from_anchors(given.anchors or Path(), own)
    hall = np.array(given.hall or own.hall or (2.0 * R_BASE, 2.0 * R_BASE, 0.0))
    platform = np.array(given.platform or own.platform or (0.0, 0.0, 0.0))
    room = own.room(hall, platform)
    words = {"HALL": _vector(hall), "PLATFORM": _vector(platform)}
    draft = _Draft(room=room, words=words, top=np.array([0.0, 0.0, hall[2]]), size=hall)
    if template == "camera-4":
        corners = [(0.0, 0.0), (hall[0], 0.0), (hall[0], hall[1]), (0.0, hall[1])]
        anchors = np.array([[x, y, hall[2], 0.0, 0.0, 0.0] for x, y in corners])
        top = np.array([hall[0] / 2.0, hall[1] / 2.0, 1.5 * hall[2]])
        words |= {"CABLES": _cables(anchors) + "\n@COUNTERBALANCE@"}
        return replace(draft, top=top, turns=False)
    if template == "planar-4":
        figures = {
            "WIDTH": hall[0],
            "HEIGHT": hall[2],
            "BODY_WIDTH": platform[0],
            "HALF_BODY_WIDTH": platform[0] / 2.0,
            "BODY_HEIGHT": platform[2],
            "PULLEY": 0.45 * hall[0],
            "PULLEY_HEIGHT": 0.55 * hall[2],
            "T5": mass * GRAVITY,
            "T5_MAX": 4.0 * mass * GRAVITY,
        }
        words |= {key: _number(value) for key, value in figures.items()}
    if template == "six-six":
        words |= {"R_BASE": _number(R_BASE), "R_END": _number(R_END)}
    return draft


def _from_anchors(path: Path, own: _Template) -> _Draft:
    anchors = read_anchors(path, "the template anchors")
    frame, platform = anchors[:, :3], anchors[:, 3:]
    low, high = frame.min(axis=0), frame.max(axis=0)
    body = np.abs(platform).max(axis=0)
    flat = [axis for axis in range(3) if high[axis] - low[axis] < FLAT and np.ptp(platform[:, axis]) < FLAT]
    turns = bool(platform.any())
    freedom, height = "", float((high - low)[:2].max()) or 1.0
    if len(flat) == 1 and flat[0] != 2:  # noqa: PLR2004 - a robot whose anchors lie at one height hangs
        freedom = f'degrees_of_freedom = "{"1R2T" if turns else "2T"}"\nplane = "{PLANES[flat[0]].value}"\n'
    if high[2] - low[2] < FLAT:
        low, high = low - np.array([0.0, 0.0, 0.6 * height]), high - np.array([0.0, 0.0, 0.2 * height])
    room = np.column_stack([low + body, high - body])
    middle = room.mean(axis=1)
    room = np.column_stack([np.minimum(room[:, 0], middle), np.maximum(room[:, 1], middle)])
    room[2] = middle[2] + 0.6 * (room[2] - middle[2])
    return _Draft(
        room=room,
        words={"CABLES": _cables(anchors) + "\n@COUNTERBALANCE@", "FREEDOM": freedom, "SOURCE": path.name},
        top=np.array([*middle[:2], frame[:, 2].max()]),
        turns=turns,
        size=np.maximum(np.ptp(frame, axis=0), 0.0),
    )


def _attempts(
    own: _Template, given: TemplateOptions, draft: _Draft, mass: float
) -> Iterator[tuple[dict[str, str], FloatArray]]:
    """Tensions and boxes to try, the usual tension and the largest box first."""
    speed = own.speed if given.speed is None else given.speed
    ramp = float(f"{max(speed / own.acceleration, 0.1):.2g}")
    for shares, stronger in product(SHRUNK, STRONGER):
        greatest = float(f"{stronger * own.strength * mass * GRAVITY:.2g}")
        note = (
            own.tension_note
            if stronger == 1.0
            else f"{stronger * own.strength:g} times the weight, which this shape takes"
        )
        words = {
            "TENSION_MIN": _number(LEAST_TENSION * greatest),
            "TENSION_MAX": _number(greatest),
            "TENSION_NOTE": note,
            "MASS": _number(mass),
            "EMPTY": _number(mass / 3.0),
            "FORCE": _number(0.02 * mass * GRAVITY),
            "SPEED": _number(speed),
            "HALF_SPEED": _number(speed / 2.0),
            "RAMP": _number(ramp),
            "TWICE_RAMP": _number(2.0 * ramp),
            "ACCELERATION": _number(speed / ramp),
            "CABLE_SPEED": _number(2.0 * speed),
        }
        for share in shares:
            middle = draft.room.mean(axis=1, keepdims=True)
            box = middle + (draft.room - middle) * np.array([[share], [share], [1.0]])
            yield words, np.round(box, 3)


def _filled(template: str, own: _Template, name: str, words: dict[str, str], draft: _Draft, box: FloatArray) -> str:
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
            "BOX": "[" + ", ".join(_vector(one) for one in box) + "]",
            "INNER_BOX": "[" + ", ".join(_vector(one) for one in inner) + "]",
            "POINTS": str(points),
            "HOME": _vector(middle),
            "FROM": _vector(ends[0]),
            "TO": _vector(ends[1]),
            "LENGTH_MIN": _number(0.02 * float(draft.size.max())),
            "LENGTH_MAX": _number(2.0 * float(np.linalg.norm(draft.size))),
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


def _counterbalance(draft: _Draft, words: dict[str, str]) -> str:
    """Commented example of a counterweight above the middle."""
    tension = _number(0.1 * float(words["MASS"]) * GRAVITY)
    return f"""\
# Ropes beside the cables, over pulleys on frame and platform, take a part of the weight off the winches.
#[[robot.counterbalance]]
#tension_n = {tension} # a counterweight; or tension_range_n = [0.0, {tension}] of a rope that is controlled
#[[robot.counterbalance.segment]]
#frame_anchor_m = {_vector(draft.top)}
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


def _cables(anchors: FloatArray) -> str:
    return "\n".join(
        f"[[robot.cable]]\nframe_anchor_m = {_exact(one[:3])}\nplatform_anchor_m = {_exact(one[3:])}" for one in anchors
    )


def _exact(vector: FloatArray) -> str:
    return "[" + ", ".join(repr(float(one)) for one in vector) + "]"


def _vector(vector: FloatArray) -> str:
    return "[" + ", ".join(_number(float(one)) for one in vector) + "]"


def _number(value: float) -> str:
    """TOML of a length or another figure, to a thousandth or four digits, as a float."""
    text = repr(round(float(value), 3)) if abs(value) >= 1.0 else repr(float(f"{value:.4g}"))
    return "0.0" if text == "-0.0" else text


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
