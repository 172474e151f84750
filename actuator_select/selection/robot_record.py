"""A robot sheet as a record for JSON and CSV, and in words."""

from collections.abc import Sequence

import numpy as np

from actuator_select.model.robot import CableRobot, Counterbalance, Freedom
from actuator_select.model.tension import TensionModel
from actuator_select.selection.robot_sheet import CableSheet, FrameForce, RobotSheet
from actuator_select.selection.wording import count_of

DISTRIBUTION = {
    TensionModel.PSEUDO_INVERSE: "pseudo-inverse",
    TensionModel.WRENCH_FEASIBLE: "closed form about the middle of least and minimax tension (Pott 2009)",
    TensionModel.FORCE_ONLY: "closed form about the middle of least and minimax tension (Pott 2009), forces only",
}
FREEDOM_WORDS = {
    Freedom.POINT_IN_PLANE: "2T, a point in the {plane} plane",
    Freedom.POINT: "3T, a point",
    Freedom.PLANAR: "1R2T, moves and turns in the {plane} plane",
    Freedom.SPATIAL: "3R3T, moves and turns freely",
}
COLUMNS = (
    "cable",
    *(f"{end}_{axis}_m" for end in ("frame", "platform") for axis in "xyz"),
    "shortest_m",
    "longest_m",
    "unstretched_shortest_m",
    "unstretched_longest_m",
    "largest_force_n",
    *(f"force_direction_{axis}" for axis in "xyz"),
    *(f"at_{axis}_m" for axis in "xyz"),
    "load",
    "tension_max_n",
    "speed_max_m_per_s",
)


def cable_row(cable: CableSheet) -> list[object]:
    """Values of one cable, in the order of `COLUMNS`; None where there is none."""
    largest, nowhere = cable.largest, (None, None, None)
    return [
        cable.number,
        *cable.frame_anchor,
        *cable.platform_anchor,
        cable.shortest,
        cable.longest,
        *(cable.unstretched or (None, None)),
        largest.force,
        *(largest.direction or nowhere),
        *(largest.position or nowhere),
        largest.load,
        cable.tension_bound,
        cable.speed,
    ]


def robot_record(sheet: RobotSheet) -> dict[str, object]:
    """JSON record of a robot sheet; units in the keys."""
    study, robot = sheet.study, sheet.study.robot
    return {
        "study": study.name,
        "degrees_of_freedom": robot.freedom.value,
        "cables": robot.cables,
        "redundancy": robot.redundancy,
        "platform": {
            "mass_kg": robot.platform.mass,
            "centre_of_gravity_m": robot.platform.centre_of_gravity.tolist(),
        },
        "loads": [
            {
                "title": load.title,
                "mass_kg": load.body.mass,
                "centre_of_gravity_m": load.body.centre_of_gravity.tolist(),
                "force_from_n": load.force_lower.tolist(),
                "force_to_n": load.force_upper.tolist(),
                "moment_from_n_m": load.moment_lower.tolist(),
                "moment_to_n_m": load.moment_upper.tolist(),
            }
            for load in study.loads
        ],
        "counterbalances": [
            {
                "segments": [
                    {"frame_anchor_m": frame, "platform_anchor_m": platform}
                    for frame, platform in zip(one.frame_anchors.tolist(), one.platform_anchors.tolist(), strict=True)
                ],
                "tension_min_n": one.tension_min,
                "tension_max_n": one.tension_max,
            }
            for one in robot.counterbalances
        ],
        "region_m": study.region.tolist(),
        "tension_model": study.tension_model.value,
        "distribution": DISTRIBUTION[study.tension_model],
        "poses": sheet.positions,
        "attainable_poses": sheet.attainable,
        "attainable_percent": round(100.0 * sheet.attainable / sheet.positions, 2),
        "held_at_rest_poses": sheet.held_at_rest,
        "singular_poses": sheet.singular,
        "least_rank": sheet.least_rank,
        "per_cable": [
            {
                "cable": cable.number,
                "frame_anchor_m": list(cable.frame_anchor),
                "platform_anchor_m": list(cable.platform_anchor),
                "shortest_m": cable.shortest,
                "longest_m": cable.longest,
                "unstretched_m": None if cable.unstretched is None else list(cable.unstretched),
                "tension_max_n": cable.tension_bound,
                "speed_max_m_per_s": cable.speed,
            }
            | _force_record(cable.largest)
            for cable in sheet.cables
        ],
        "frame_points": [
            {"anchor_m": list(point.anchor), "cables": list(point.cables)} | _force_record(point.largest)
            for point in sheet.frame_points
        ],
        "warnings": [{"code": one.code, "poses": one.poses, "text": one.text} for one in sheet.warnings],
    }


def _force_record(largest: FrameForce) -> dict[str, object]:
    return {
        "largest_force_n": largest.force,
        "force_direction": largest.direction,
        "at_position_m": largest.position,
        "load": largest.load,
    }


def robot_items(sheet: RobotSheet) -> dict[str, str]:
    """What stands above the table of cables, item by item."""
    study, robot = sheet.study, sheet.study.robot
    beyond = robot.redundancy
    compared = "as many as" if beyond == 0 else f"{abs(beyond)} {'more' if beyond > 0 else 'fewer'} than"
    items = {
        "freedom": FREEDOM_WORDS[robot.freedom].format(plane=robot.plane.value),
        "cables": f"{robot.cables}, redundancy {beyond} ({compared} the {robot.degrees_of_freedom} equations)",
    }
    if robot.platform.mass > 0.0:
        centre = _vector(robot.platform.centre_of_gravity)
        items["platform"] = f"{robot.platform.mass:g} kg, centre of gravity {centre} m"
    items["loads"] = "; ".join(
        f"{load.title}: {load.body.mass:g} kg{_pushed('N', load.force_lower, load.force_upper)}"
        f"{_pushed('N m', load.moment_lower, load.moment_upper)}"
        for load in study.loads
    )
    for number, rope in enumerate(robot.counterbalances, start=1):
        items[f"rope {number}"] = _rope_words(rope)
    items |= {
        "tensions": f"{_tension_words(robot)}; {study.tension_model.value}",
        "box": ", ".join(
            f"{axis} {low:g} to {high:g} m" for axis, (low, high) in zip("xyz", study.region, strict=True)
        ),
        "rank": f"full ({sheet.least_rank}) at every position"
        if not sheet.singular
        else f"short at {count_of(sheet.singular, sheet.positions)} positions, down to {sheet.least_rank}",
        "at rest": f"held at {count_of(sheet.held_at_rest, sheet.positions)} positions",
        "attainable": f"{count_of(sheet.attainable, sheet.positions)} positions, by any drive, over the motion set",
    }
    return items


def _tension_words(robot: CableRobot) -> str:
    low, high = robot.bounds.tension_min, robot.bounds.tension_max
    if np.isinf(high).all():
        return f"from {_range(low)} N, no upper bound"
    return f"from {_range(low)} to {_range(high)} N"


def _range(values: Sequence[float] | np.ndarray) -> str:
    low, high = float(np.min(values)), float(np.max(values))
    return f"{low:g}" if low == high else f"{low:g} … {high:g}"


def _rope_words(rope: Counterbalance) -> str:
    tension = f"{rope.tension_min:g} N"
    if rope.is_controlled:
        tension = f"{rope.tension_min:g} to {rope.tension_max:g} N, controlled"
    segments = len(rope.frame_anchors)
    return f"counterbalance, {segments} segment{'' if segments == 1 else 's'}, tension {tension}"


def _pushed(unit: str, lower: np.ndarray, upper: np.ndarray) -> str:
    if not (lower.any() or upper.any()):
        return ""
    each = (f"{a:g}" if a == b else f"{a:g}…{b:g}" for a, b in zip(lower, upper, strict=True))
    return f", pushed by ({', '.join(each)}) {unit}"


def _vector(vector: Sequence[float] | np.ndarray) -> str:
    return f"({', '.join(f'{one:g}' for one in vector)})"
