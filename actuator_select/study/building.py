"""From the tables of a study file to robot, loads and motion."""

import csv
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from math import radians
from pathlib import Path

import numpy as np

from actuator_select.errors import InvalidStudy, Problem
from actuator_select.model.arrays import FloatArray
from actuator_select.model.dynamics import Load
from actuator_select.model.families import (
    Routing,
    constrained_eight,
    cpr8,
    cpr8_region,
    hall_region,
    planar_four,
    six_six,
    suspended_eight,
)
from actuator_select.model.motion import (
    MotionKind,
    MotionSet,
    SetShape,
    independent_motion,
    listed_motion,
    rest,
    sampled_motion,
)
from actuator_select.model.robot import CableBounds, CableRobot, Counterbalance, Freedom, Plane, RigidBody
from actuator_select.model.tension import TensionModel
from actuator_select.study.schema import (
    LARGE,
    REGIONS,
    CablesTable,
    CounterbalanceTable,
    PayloadTable,
    RobotTable,
    StudyTable,
    WorkspaceTable,
)

ANCHOR_COLUMNS = (
    "cable",
    "frame_x_m",
    "frame_y_m",
    "frame_z_m",
    "platform_x_m",
    "platform_y_m",
    "platform_z_m",
)


def rigid_body(mass: float, centre_of_gravity: Sequence[float], inertia: Sequence[Sequence[float]] | None) -> RigidBody:
    """Body of a table; without an inertia a point at its centre of gravity."""
    return RigidBody(
        mass=mass,
        centre_of_gravity=np.array(centre_of_gravity),
        inertia=np.zeros((3, 3)) if inertia is None else np.array(inertia),
    )


def build_robot(table: StudyTable, place: str, folder: Path) -> tuple[CableRobot, FloatArray]:
    """Build the robot of a study and the box that it works in.

    Parameters
    ----------
    table : StudyTable
        Validated.
    place : str
        Of the study, for messages.
    folder : Path
        Where files that the study names are looked for.

    Returns
    -------
    tuple of CableRobot and (3, 2) array
        With bounds, body and counterbalances; lower and upper end of x, y and z. [m]

    Raises
    ------
    InvalidStudy
        If the tables contradict each other.
    """
    described = table.robot
    robot = _anchored(described, place, folder)
    if described.degrees_of_freedom is not None:
        robot = replace(robot, freedom=Freedom(described.degrees_of_freedom), plane=Plane(described.plane or "xz"))
    robot = replace(
        robot,
        platform=rigid_body(described.mass_kg, described.centre_of_gravity_m, described.inertia_kg_m2),
        bounds=_bounds(table, robot.cables, place),
        counterbalances=robot.counterbalances + tuple(_counterbalance(one) for one in described.counterbalance),
    )
    return robot, _region(table, place)


def _anchored(robot: RobotTable, place: str, folder: Path) -> CableRobot:
    if robot.builder is not None:
        return _BUILDERS[robot.builder](robot)
    if robot.cable is not None:
        return CableRobot(
            frame_anchors=np.array([cable.frame_anchor_m for cable in robot.cable], dtype=np.float64),
            platform_anchors=np.array([cable.platform_anchor_m for cable in robot.cable], dtype=np.float64),
        )
    anchors = read_anchors(folder / str(robot.anchors_csv), place)
    return CableRobot(frame_anchors=anchors[:, :3], platform_anchors=anchors[:, 3:])


def _lengths(robot: RobotTable, *keys: str) -> dict[str, float]:
    return {key.removesuffix("_m"): float(getattr(robot, key)) for key in keys}


def _planar_four(robot: RobotTable) -> CableRobot:
    tension = robot.t5_range_n or (robot.t5_n or 0.0, robot.t5_n or 0.0)
    return planar_four(
        **_lengths(robot, "w_m", "h_m", "w_b_m", "h_1_m", "h_bu_m", "w_p_m", "h_p_m", "h_bp_m", "w_bp_m"),
        routing=Routing(robot.configuration or "none"),
        tension=tension,
    )


_BUILDERS: dict[str, Callable[[RobotTable], CableRobot]] = {
    "cpr8": lambda robot: cpr8(np.array(robot.frame_m), np.array(robot.carrier_m)),
    "planar-4": _planar_four,
    "six-six": lambda robot: six_six(**_lengths(robot, "r_base_m", "r_end_m"), gamma=radians(robot.gamma_deg or 0.0)),
    "suspended-8": lambda robot: suspended_eight(np.array(robot.hall_m), np.array(robot.platform_m)),
    "constrained-8": lambda robot: constrained_eight(np.array(robot.hall_m), np.array(robot.platform_m)),
}


def read_anchors(path: Path, place: str) -> FloatArray:
    """Anchors of a CSV file with the columns `ANCHOR_COLUMNS`, (m, 6). [m]

    Cables are numbered by their rows; the column ``cable`` is a name for people, each once.

    Raises
    ------
    InvalidStudy
        Naming every bad cell with its line.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.DictReader(file)
            rows, header = list(reader), list(reader.fieldnames or ())
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        problem = Problem(
            place="robot.anchors_csv", value=f"{str(path)!r} cannot be read ({error})", expected="a CSV file, UTF-8"
        )
        raise InvalidStudy(f"{place} does not hold", [problem]) from error
    missing = [name for name in ANCHOR_COLUMNS if not rows or name not in rows[0]]
    if missing:
        problem = Problem(
            place=f"{path}, line 1",
            value=f"no column {', '.join(missing)}" if rows else "no rows",
            expected=f"the columns {', '.join(ANCHOR_COLUMNS)} and a row per cable",
            remedy="separate columns with commas, and write decimals with points",
        )
        raise InvalidStudy(f"{place} does not hold", [problem])
    twice = sorted({name for name in header if header.count(name) > 1})
    if twice:
        problem = Problem(
            place=f"{path}, line 1", value=f"column {', '.join(twice)} twice", expected="every column once"
        )
        raise InvalidStudy(f"{place} does not hold", [problem])
    anchors, problems = np.zeros((len(rows), 6)), []
    names: dict[str, int] = {}
    for line, row in enumerate(rows, start=2):
        where = f"{path}, line {line}"
        if None in row:
            value = f"{len(ANCHOR_COLUMNS) + len(row[None])} cells"
            problems.append(Problem(place=where, value=value, expected=f"{len(ANCHOR_COLUMNS)}, one per column"))
        name = str(row["cable"])
        if name in names:
            value = f"cable {name!r} stands in line {names[name]} already"
            problems.append(Problem(place=where, value=value, expected="every cable once"))
        names.setdefault(name, line)
        for column, key in enumerate(ANCHOR_COLUMNS[1:]):
            anchors[line - 2, column] = _coordinate(row[key])
            if np.isnan(anchors[line - 2, column]):
                value = "is missing" if row[key] is None else repr(row[key])
                expected = f"a number from -{LARGE:g} to {LARGE:g} [m]"
                problems.append(Problem(place=f"{where}, {key}", value=value, expected=expected))
    if problems:
        raise InvalidStudy(f"{place} does not hold", problems)
    return anchors


def _coordinate(text: str | None) -> float:
    """Number of a cell, NaN where it is none that a study takes."""
    try:
        number = float(text or "")
    except ValueError:
        return np.nan
    return number if abs(number) <= LARGE else np.nan


def _counterbalance(table: CounterbalanceTable) -> Counterbalance:
    lower, upper = table.tension_range_n or (table.tension_n or 0.0, table.tension_n or 0.0)
    return Counterbalance(
        frame_anchors=np.array([one.frame_anchor_m for one in table.segment]),
        platform_anchors=np.array([one.platform_anchor_m for one in table.segment]),
        tension_min=lower,
        tension_max=upper,
    )


def _bounds(table: StudyTable, cables: int, place: str) -> CableBounds:
    """Bounds of every cable; the least tension has no default where it decides something."""
    stated = {
        name: getattr(table.cables, key)
        for name, key in zip(
            ("tension_min", "tension_max", "length_min", "length_max", "speed_max", "axial_stiffness"),
            CablesTable.model_fields,
            strict=True,
        )
        if getattr(table.cables, key) is not None
    }
    problems = [
        Problem(place=f"cables.{key}", value=f"{len(value)} values", expected=f"one number, or {cables}, one per cable")
        for key in CablesTable.model_fields
        if isinstance(value := getattr(table.cables, key), tuple) and len(value) != cables
    ]
    if table.cables.tension_min_n is None and not TensionModel(table.tension.model).lets_cables_push:
        most = table.cables.tension_max_n
        hint = f", here {0.01 * np.min(most):g} to {0.05 * np.min(most):g} N" if most is not None else ""
        problems.append(
            Problem(
                place="cables.tension_min_n",
                value="is missing",
                expected="the least tension that keeps a cable taut [N]",
                remedy=f"1 to 5 % of the greatest tension is usual{hint}; 0 only to compare with theory",
            )
        )
    for lower, upper, unit in (("tension_min_n", "tension_max_n", "N"), ("length_min_m", "length_max_m", "m")):
        low, high = getattr(table.cables, lower), getattr(table.cables, upper)
        if low is not None and high is not None and not problems and np.any(np.array(low) > np.array(high)):
            cable = int(np.argmax(np.broadcast_to(low, cables) > np.broadcast_to(high, cables)))
            least, most = (float(np.broadcast_to(end, cables)[cable]) for end in (low, high))
            problems.append(
                Problem(
                    place=f"cables.{lower}",
                    value=f"{least:g} of cable {cable + 1}",
                    expected=f"at most its {upper}, {most:g} [{unit}]",
                )
            )
    if problems:
        raise InvalidStudy(f"{place} does not hold", problems)
    return CableBounds.of(cables, **{name: np.array(value) for name, value in stated.items()})


def _region(table: StudyTable, place: str) -> FloatArray:
    if table.workspace.box_m is not None:
        return np.array(table.workspace.box_m, dtype=np.float64)
    robot = table.robot
    if robot.builder not in REGIONS:
        problem = Problem(
            place="workspace.region",
            value=f'"builder" for a robot with {robot.builder or "explicit cables"}',
            expected="box_m = [[x0, x1], [y0, y1], [z0, z1]] in m",
        )
        raise InvalidStudy(f"{place} does not hold", [problem])
    frame_key, body_key = ("frame_m", "carrier_m") if robot.builder == "cpr8" else ("hall_m", "platform_m")
    frame, body = np.array(getattr(robot, frame_key)), np.array(getattr(robot, body_key))
    region = cpr8_region(frame, body) if robot.builder == "cpr8" else hall_region(frame, body)
    if (region[:, 0] > region[:, 1]).any():
        problem = Problem(
            place=f"robot.{body_key}",
            value=str([float(length) for length in body]),
            expected=f"a {body_key[:-2]} whose diagonal ({np.linalg.norm(body):.4g} m) fits into the {frame_key[:-2]}, "
            f"{[float(length) for length in frame]} m, on every axis",
            remedy=f"make the {body_key[:-2]} smaller or the {frame_key[:-2]} larger",
        )
        raise InvalidStudy(f"{place} does not hold", [problem])
    return region


def build_orientations(workspace: WorkspaceTable) -> FloatArray:
    """Angles ψ, θ, φ that every position is taken at, (O, 3). [rad]"""
    if workspace.orientation_grid_deg is not None:
        return np.radians(np.array(list(product(*workspace.orientation_grid_deg)), dtype=np.float64))
    return np.array(workspace.orientations_rad, dtype=np.float64)


def build_load(payload: PayloadTable) -> Load:
    """What one payload table asks to be held."""
    force, moment = np.array(payload.force_n), np.array(payload.moment_n_m)
    force_reach, moment_reach = np.array(payload.force_reach_n), np.array(payload.moment_reach_n_m)
    return Load(
        title=payload.title,
        body=rigid_body(payload.mass_kg, payload.centre_of_gravity_m, payload.inertia_kg_m2),
        force_lower=force - force_reach,
        force_upper=force + force_reach,
        moment_lower=moment - moment_reach,
        moment_upper=moment + moment_reach,
    )


def build_motion(table: StudyTable) -> MotionSet:
    """Motions that have to be possible at every pose."""
    motion = table.motion
    if motion.set == "rest":
        return rest(centripetal=motion.centripetal)
    if motion.set == "list":
        listed = [
            [
                one.velocity_m_per_s,
                one.acceleration_m_per_s2,
                one.angular_velocity_rad_per_s,
                one.angular_acceleration_rad_per_s2,
            ]
            for one in motion.case
        ]
        return listed_motion(np.array(listed, dtype=np.float64), centripetal=motion.centripetal)
    ramps = (motion.speed_max_m_per_s, motion.acceleration_time_s, motion.deceleration_time_s)
    speed, up, down = (float(value or 0.0) for value in ramps)  # the schema has seen to it that none is missing
    if motion.set == "sampled":
        return sampled_motion(
            speed,
            up,
            down,
            velocity_intervals=motion.velocity_intervals,
            acceleration_levels=motion.acceleration_levels,
            centripetal=motion.centripetal,
        )
    straight = motion.set == "straight"
    return independent_motion(
        speed,
        up,
        down,
        centripetal=motion.centripetal,
        kind=MotionKind.STRAIGHT if straight else MotionKind.INDEPENDENT,
        velocity_shape=SetShape(motion.velocity_set),
        acceleration_shape=SetShape.BALL if straight else _acceleration_shape(table),
        angular_speed=motion.angular_speed_max_rad_per_s,
    )


def _acceleration_shape(table: StudyTable) -> SetShape:
    """The published model goes with the published box; everything newer with a ball, unless the study says."""
    if table.motion.acceleration_set is not None:
        return SetShape(table.motion.acceleration_set)
    return SetShape.BOX if TensionModel(table.tension.model).lets_cables_push else SetShape.BALL
