"""Questions that cannot be posed: too large, or about a robot that cannot be."""

from collections.abc import Sequence
from math import comb, prod
from typing import TYPE_CHECKING

import numpy as np

from actuator_select.errors import InvalidStudy, Problem
from actuator_select.model.arrays import FloatArray
from actuator_select.model.kinematics import LEAST_CABLE_LENGTH, rotation_matrix
from actuator_select.model.robot import CableRobot, Freedom
from actuator_select.model.tension import TensionModel
from actuator_select.study.schema import StudyTable

if TYPE_CHECKING:
    from actuator_select.study.loading import Study

MOST_CABLE_POSES = 8_000_000  # poses times cables
MOST_SECONDS = 3600.0
BYTES_PER_CABLE_POSE = 320  # of the demand, measured
SECONDS_PER_CABLE_POSE = 2e-6  # of geometry and motion, measured on two cores
SECONDS_PER_NORMAL = 3e-7  # of hyperplane shifting, measured on two cores


def refuse_too_many_poses(table: StudyTable, robot: CableRobot, orientations: int, place: str) -> None:
    """Refuse questions that take very much time or memory, with an estimate of both.

    Raises
    ------
    InvalidStudy
        Beyond `MOST_CABLE_POSES` or `MOST_SECONDS`.
    """
    workspace, loads = table.workspace, len(table.payload)
    poses = prod(workspace.points) * orientations * loads * max(1, len(table.motion.case))
    most = MOST_CABLE_POSES // robot.cables
    seconds = poses * (SECONDS_PER_CABLE_POSE * robot.cables + SECONDS_PER_NORMAL * _normals(table, robot))
    if poses <= most and seconds <= MOST_SECONDS:
        return
    loaded = f" with {loads} loads" if loads > 1 else ""
    memory = poses * robot.cables * BYTES_PER_CABLE_POSE / 1e9
    problem = Problem(
        place="workspace.points",
        value=f"{list(workspace.points)} at {orientations} orientations{loaded} are {poses:,} poses, some "
        f"{_time(seconds)} and {memory:,.1f} GB of memory",
        expected=f"at most {most:,} with {robot.cables} cables, and {_time(MOST_SECONDS)}",
        remedy="take a coarser grid, or parts of the workspace one after the other with box_m; "
        "--no-limit goes ahead all the same",
    )
    raise InvalidStudy(f"{place} does not hold", [problem])


def _normals(table: StudyTable, robot: CableRobot) -> int:
    """Hyperplanes of one pose, by which the time of a tension model with bounded tensions goes."""
    model = TensionModel(table.tension.model)
    if model.lets_cables_push:
        return 0
    equations = len(robot.translation_rows if model is TensionModel.FORCE_ONLY else robot.wrench_rows)
    columns = robot.cables + sum(rope.is_controlled for rope in robot.counterbalances)
    return comb(columns, min(equations, columns) - 1)


def _time(seconds: float) -> str:
    if seconds < 120.0:  # noqa: PLR2004 - two minutes
        return f"{seconds:.0f} s"
    minutes = seconds / 60.0
    return f"{minutes:.0f} min" if minutes < 120.0 else f"{minutes / 60.0:,.0f} h"  # noqa: PLR2004 - two hours


def refuse_what_cannot_be(study: "Study", place: str) -> None:
    """Refuse a robot with the same cable twice, one without anything to hold, and poses at which a cable has no length.

    Raises
    ------
    InvalidStudy
        Naming cables and position.
    """
    problems = [
        *_rope_without_rule(study),
        *_home_off_the_grid(study),
        *_out_of_the_plane(study),
        *_turning_in_vain(study),
        *_same_cable_twice(study),
        *_nothing_to_hold(study),
        *_cables_without_length(study),
    ]
    if problems:
        raise InvalidStudy(f"{place} does not hold", problems)


def _rope_without_rule(study: "Study") -> list[Problem]:
    controlled = any(rope.is_controlled for rope in study.robot.counterbalances)
    if not (controlled and study.tension_model.lets_cables_push):
        return []
    return [
        Problem(
            place="tension.model",
            value=f'"{study.tension_model.value}" with a counterbalance whose tension is controlled',
            expected='"wrench_feasible" or "force_only", which choose that tension; or one constant tension [N]',
        )
    ]


def _home_off_the_grid(study: "Study") -> list[Problem]:
    home = study.table.workspace.home_m
    if home is None:
        return []
    slack = study.cell_size / 2.0 + LEAST_CABLE_LENGTH
    outside = (np.array(home) < study.region[:, 0] - slack) | (np.array(home) > study.region[:, 1] + slack)
    if not outside.any():
        return []
    box = [[float(low), float(high)] for low, high in study.region]
    return [Problem(place="workspace.home_m", value=str(list(home)), expected=f"a position in the box, {box} [m]")]


def _out_of_the_plane(study: "Study") -> list[Problem]:
    """What a planar robot cannot have: cables, positions, loads or turns that leave its plane."""
    robot = study.robot
    if robot.freedom not in (Freedom.POINT_IN_PLANE, Freedom.PLANAR):
        return []
    normal, plane = robot.plane_normal, robot.plane.value
    axis = "xyz"[normal]
    expected = f"everything in one plane, {plane}, where degrees_of_freedom is {robot.freedom.value}"
    problems = []
    if study.region[normal, 1] > study.region[normal, 0]:
        problems.append(Problem(place="workspace.box_m", value=f"extends along {axis}", expected=expected))
    off = robot.frame_anchors[:, normal] - robot.platform_anchors[:, normal] - study.region[normal, 0]
    ropes = [one.frame_anchors[:, normal] - one.platform_anchors[:, normal] for one in robot.counterbalances]
    span = LEAST_CABLE_LENGTH * max(1.0, float(np.abs(robot.frame_anchors).max()))
    problems += [
        Problem(
            place=f"robot.cable[{cable}]",
            value=f"leaves the plane by {off[cable]:g} m along {axis}",
            expected=expected,
            remedy='other planes: plane = "xy" or "yz"; 3T or 3R3T for a robot in space',
        )
        for cable in np.flatnonzero(np.abs(off) > span)
    ]
    for index, rope in enumerate(ropes):
        if np.abs(rope - study.region[normal, 0]).max() > span:
            problems.append(
                Problem(place=f"robot.counterbalance[{index}]", value="leaves the plane", expected=expected)
            )
    return problems + _out_of_the_plane_in_use(study, expected)


def _out_of_the_plane_in_use(study: "Study", expected: str) -> list[Problem]:
    """Loads, motions and moves that leave the plane of a planar robot."""
    robot, normal = study.robot, study.robot.plane_normal
    axis, problems = "xyz"[normal], []
    for index, load in enumerate(study.loads):
        if load.force_lower[normal] or load.force_upper[normal]:
            problems.append(Problem(place=f"payload[{index}].force_n", value=f"pushes along {axis}", expected=expected))
        if load.body.centre_of_gravity[normal]:
            place = f"payload[{index}].centre_of_gravity_m"
            problems.append(Problem(place=place, value=f"lies off the plane along {axis}", expected=expected))
    if robot.platform.centre_of_gravity[normal]:
        place = "robot.centre_of_gravity_m"
        problems.append(Problem(place=place, value=f"lies off the plane along {axis}", expected=expected))
    problems += [
        Problem(place=f"motion.case[{case}]", value=f"moves along {axis}", expected=expected)
        for case in np.flatnonzero(study.motion.listed[:, :2, normal].any(axis=1))
    ]
    for index, move in enumerate(study.table.move):
        problems += line_problems(study, np.array([move.from_m, move.to_m]), move.orientation_rad, f"move[{index}]")
    return problems


def line_problems(study: "Study", ends: FloatArray, orientation: Sequence[float], place: str) -> list[Problem]:
    """What a straight move of a planar robot cannot do: leave the plane, or turn out of it.

    Parameters
    ----------
    study : Study
        Robot and plane.
    ends : (2, 3) array
        Start and end. [m]
    orientation : sequence of three float
        Angles ψ, θ, φ. [rad]
    place : str
        For messages.

    Returns
    -------
    list of Problem
        Empty of a robot in space.
    """
    robot = study.robot
    if robot.freedom not in (Freedom.POINT_IN_PLANE, Freedom.PLANAR):
        return []
    normal, plane = robot.plane_normal, robot.plane.value
    expected = f"a move in the plane {plane}, where degrees_of_freedom is {robot.freedom.value}"
    problems = []
    if np.abs(ends[:, normal] - study.region[normal, 0]).max() > LEAST_CABLE_LENGTH:
        problems.append(Problem(place=place, value=f"leaves the plane along {'xyz'[normal]}", expected=expected))
    if any(angle for axis, angle in enumerate(orientation) if axis != normal):
        problems.append(Problem(place=place, value="turns out of the plane", expected=expected))
    return problems


def _turning_in_vain(study: "Study") -> list[Problem]:
    """Turns and moments about axes that the robot's degrees of freedom leave out."""
    robot, place = study.robot, "workspace.orientations_rad"
    planar = robot.freedom in (Freedom.POINT_IN_PLANE, Freedom.PLANAR)
    axes = [axis for axis in range(3) if axis not in robot.turning_axes]
    body = bool(robot.platform_anchors.any())
    problems = []
    for index, load in enumerate(study.loads):
        if axes and (load.moment_lower[axes].any() or load.moment_upper[axes].any()):
            problems.append(
                Problem(
                    place=f"payload[{index}].moment_n_m",
                    value=f"turns about {' and '.join('xyz'[axis] for axis in axes)}",
                    expected=f"moments that the cables take up with degrees_of_freedom {robot.freedom.value} [N m]",
                )
            )
    for case in np.flatnonzero(study.motion.listed[:, 2:][:, :, axes].any(axis=(1, 2))):
        expected = f"turns that the robot makes with degrees_of_freedom {robot.freedom.value}"
        problems.append(Problem(place=f"motion.case[{case}]", value="turns", expected=expected))
    if planar and study.orientations[:, axes].any() and body:
        turned = [float(angle) for angle in study.orientations[study.orientations[:, axes].any(axis=1)][0]]
        problems.append(
            Problem(
                place=place,
                value=str(turned),
                expected=f"turns about {'xyz'[robot.plane_normal]} only with degrees_of_freedom {robot.freedom.value}",
            )
        )
    if study.motion.turns and not robot.turning_axes:
        problems.append(
            Problem(
                place="motion.angular_speed_max_rad_per_s",
                value=f"{study.motion.angular_speed:g}",
                expected=f"0, where degrees_of_freedom is {robot.freedom.value}: a point does not turn [rad/s]",
            )
        )
    return problems


def _same_cable_twice(study: "Study") -> list[Problem]:
    robot = study.robot
    ends = np.column_stack([robot.frame_anchors, robot.platform_anchors])
    apart = np.abs(ends[:, None] - ends[None]).max(axis=2)
    twins = np.argwhere(np.triu(apart < LEAST_CABLE_LENGTH, 1))
    return [
        Problem(
            place=f"robot.cable[{second}]",
            value=f"both anchors coincide with those of robot.cable[{first}]",
            expected="cables that differ in one anchor at least [m]",
            remedy="leave one of them out, and give the other the tension of both",
        )
        for first, second in twins
    ]


def _nothing_to_hold(study: "Study") -> list[Problem]:
    for index, load in enumerate(study.loads):
        pushed = np.abs([load.force_lower, load.force_upper, load.moment_lower, load.moment_upper]).any()
        if study.robot.platform.mass + load.body.mass == 0.0 and not pushed:
            given = "payload" in study.table.model_fields_set
            return [
                Problem(
                    place=f"payload[{index}]" if given else "payload",
                    value="nothing is to be held" if given else "is missing",
                    expected="mass_kg of the payload or the robot, or force_n or moment_n_m [kg, N, N m]",
                )
            ]
    return []


def _cables_without_length(study: "Study") -> list[Problem]:
    """A grid position in an anchor, unless the study states a least length: 0 says that such positions are known of."""
    robot = study.robot
    if study.table.cables.length_min_m is not None:
        return []
    for orientation in study.orientations:
        ends = robot.frame_anchors - robot.platform_anchors @ rotation_matrix(orientation).T
        for cable in range(robot.cables):
            nearest = _nearest(study.positions, ends[cable])
            if np.linalg.norm(nearest - ends[cable]) < LEAST_CABLE_LENGTH:
                x, y, z = nearest
                return [
                    Problem(
                        place="workspace",
                        value=f"at ({x:g}, {y:g}, {z:g}) m cable {cable + 1} has no length and so no direction",
                        expected="positions off the anchors [m]",
                        remedy="move the box or the grid; or state cables.length_min_m, which sets nearer positions "
                        "apart (0: they count as not served)",
                    )
                ]
    return []


def _nearest(positions: FloatArray, point: FloatArray) -> FloatArray:
    found: FloatArray = positions[((positions - point) ** 2).sum(axis=1).argmin()]
    return found
