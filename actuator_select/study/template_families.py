"""Families of robots that a new study can start from: their own figures, the options that they take, their anchors."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from actuator_select.errors import InvalidInput, Problem
from actuator_select.model.arrays import FloatArray
from actuator_select.model.families import cpr8_region
from actuator_select.model.robot import Plane
from actuator_select.study.building import read_anchors
from actuator_select.study.schema import LARGE

GRAVITY = 9.81  # m/s²
LEAST_FIGURE, MOST_FIGURE = 1e-3, 1e5  # of an option, in its unit; tensions and lengths stay within a study's figures
FLAT = 1e-9  # m; anchors nearer to one plane than this lie in it
PLANES = {0: Plane.YZ, 1: Plane.XZ, 2: Plane.XY}  # by their normal


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
class Template:
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
class Draft:
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

TEMPLATES: dict[str, Template] = {
    "camera-4": Template(
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
    "planar-4": Template(
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
    "six-six": Template(
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
    "suspended-8": Template(
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
    "constrained-8": Template(
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
    "cpr8": Template(
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
    "anchors": Template(
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


def refuse_options(template: str, own: Template, given: TemplateOptions) -> None:
    """Refuse options that do not suit a template.

    Raises
    ------
    InvalidInput
        Naming every one of them.
    """
    problems = [*_bad_sizes(template, own, given), *_bad_numbers(own, given)]
    if (template == "anchors") != (given.anchors is not None):
        problems.append(
            Problem(
                place="--anchors",
                value=str(given.anchors) if given.anchors else "is missing",
                expected="a CSV file with the template anchors, and with no other",
            )
        )
    problems = problems or _bad_fit(template, own, given)
    if problems:
        raise InvalidInput(f"the template {template} cannot be made so", problems)


def _bad_sizes(template: str, own: Template, given: TemplateOptions) -> Iterator[Problem]:
    for option, value, default in (("hall", given.hall, own.hall), ("platform", given.platform, own.platform)):
        if value is None:
            continue
        if default is None:
            yield _problem(option, value, f"no --{option} with the template {template}, which has none")
        elif len(value) != 3 or not all(LEAST_FIGURE <= one <= MOST_FIGURE for one in value):  # noqa: PLR2004 - three edges
            yield _problem(
                option, value, f"length, width and height, each from {LEAST_FIGURE:g} to {MOST_FIGURE:g} [m]"
            )


def _bad_numbers(own: Template, given: TemplateOptions) -> Iterator[Problem]:
    heaviest = float(f"{0.99 * LARGE / (own.strength * GRAVITY):.2g}")  # beyond, its tensions are no study's figures
    for option, number, most, unit in (
        ("mass", given.mass, heaviest, "kg"),
        ("speed", given.speed, MOST_FIGURE, "m/s"),
    ):
        if number is not None and not LEAST_FIGURE <= number <= most:  # NaN fails too
            yield _problem(option, (number,), f"a number from {LEAST_FIGURE:g} to {most:g} [{unit}]")


def _bad_fit(template: str, own: Template, given: TemplateOptions) -> list[Problem]:
    if own.hall is None or own.platform is None:
        return []
    hall, platform = given.hall or own.hall, given.platform or own.platform
    axes = (0, 2) if template == "planar-4" else (0, 1, 2)
    if any(platform[axis] >= hall[axis] for axis in axes):
        expected = f"a platform smaller than the hall, {_shown(hall)} m, on every axis"
        return [_problem("platform", platform, expected)]
    if template == "cpr8":
        room = cpr8_region(np.array(hall), np.array(platform))
        if (room[:, 0] >= room[:, 1]).any():
            expected = f"a carrier whose diagonal fits into the hall, {_shown(hall)} m"
            return [_problem("platform", platform, expected)]
    return []


def _problem(option: str, value: tuple[float, ...], expected: str) -> Problem:
    return Problem(place=f"--{option}", value=_shown(value), expected=expected)


def _shown(value: tuple[float, ...]) -> str:
    return ",".join(f"{one:g}" for one in value)


def draft_robot(template: str, own: Template, given: TemplateOptions, mass: float) -> Draft:
    """Lay out a template's robot with the sizes given; `mass` in kg."""
    if template == "anchors":
        return _from_anchors(given.anchors or Path())
    hall = np.array(given.hall or own.hall or (2.0 * R_BASE, 2.0 * R_BASE, 0.0))
    platform = np.array(given.platform or own.platform or (0.0, 0.0, 0.0))
    room = own.room(hall, platform)
    words = {"HALL": toml_vector(hall), "PLATFORM": toml_vector(platform)}
    draft = Draft(room=room, words=words, top=np.array([0.0, 0.0, hall[2]]), size=hall)
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
        words |= {key: toml_number(value) for key, value in figures.items()}
    if template == "six-six":
        words |= {"R_BASE": toml_number(R_BASE), "R_END": toml_number(R_END)}
    return draft


def _from_anchors(path: Path) -> Draft:
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
    return Draft(
        room=room,
        words={"CABLES": _cables(anchors) + "\n@COUNTERBALANCE@", "FREEDOM": freedom, "SOURCE": path.name},
        top=np.array([*middle[:2], frame[:, 2].max()]),
        turns=turns,
        size=np.maximum(np.ptp(frame, axis=0), 0.0),
    )


def _cables(anchors: FloatArray) -> str:
    return "\n".join(
        f"[[robot.cable]]\nframe_anchor_m = {_exact(one[:3])}\nplatform_anchor_m = {_exact(one[3:])}" for one in anchors
    )


def _exact(vector: FloatArray) -> str:
    return "[" + ", ".join(repr(float(one)) for one in vector) + "]"


def toml_vector(vector: FloatArray) -> str:
    """TOML of a vector, its figures as by `toml_number`."""
    return "[" + ", ".join(toml_number(float(one)) for one in vector) + "]"


def toml_number(value: float) -> str:
    """TOML of a length or another figure, to a thousandth or four digits, as a float."""
    text = repr(round(float(value), 3)) if abs(value) >= 1.0 else repr(float(f"{value:.4g}"))
    return "0.0" if text == "-0.0" else text
