"""From a study file to a study: parse, override, validate, build."""

from collections.abc import Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from importlib import resources
from math import prod
from pathlib import Path

import numpy as np
import tomlkit
from pydantic import ValidationError
from tomlkit.exceptions import TOMLKitError

from actuator_select.errors import InvalidStudy, Problem, UnknownName, did_you_mean
from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray
from actuator_select.model.dynamics import RequiredWrench, required_wrench
from actuator_select.model.kinematics import LEAST_CABLE_LENGTH, least_cable_lengths, position_grid
from actuator_select.model.motion import MotionSet, independent_motion, sampled_motion
from actuator_select.model.robot import CableRobot, cpr8, cpr8_region
from actuator_select.model.tension import TensionModel
from actuator_select.study.overrides import apply_overrides
from actuator_select.study.problems import study_problems
from actuator_select.study.schema import MotionTable, RobotTable, StudyTable, WorkspaceTable

MOST_CABLE_POSES = 8_000_000  # poses times cables; some 2.4 GB of demand
VARIANT_TABLES = ("gravity_m_per_s2", "robot", "payload", "workspace", "motion", "tension", "checks")

_STUDIES = resources.files("actuator_select") / "studies"


@dataclass(frozen=True, slots=True, kw_only=True)
class Variant:
    """A study with some keys changed.

    Attributes
    ----------
    title : str
        Of the variant.
    keys : tuple of str
        The keys that it changes.
    study : Study
        The changed study.
    """

    title: str
    keys: tuple[str, ...]
    study: "Study"


@dataclass(frozen=True, slots=True, kw_only=True)
class Study:
    """A robot, what it has to do, and what counts as good enough.

    Attributes
    ----------
    name : str
        Of the study.
    text : str
        The study file, overrides included: what has to be kept to repeat the study.
    table : StudyTable
        The same, validated; units as in the key names.
    robot : CableRobot
        With m cables.
    region : (3, 2) array
        Box of the positions. [m]
    positions : (P, 3) array
        Grid over the region. [m]
    orientations : (O, 3) array
        Angles ψ, θ, φ at every position. [rad]
    wrench : RequiredWrench
        What the cables must supply together.
    motion : MotionSet
        Velocities and accelerations.
    tension_model : TensionModel
        How the cables share the load.
    checks : tuple of Check
        Limits that have to hold.
    variants : tuple of Variant
        The same study read otherwise.
    """

    name: str
    text: str
    table: StudyTable
    robot: CableRobot
    region: FloatArray
    positions: FloatArray
    orientations: FloatArray
    wrench: RequiredWrench
    motion: MotionSet
    tension_model: TensionModel
    checks: tuple[Check, ...]
    variants: tuple[Variant, ...] = ()


def builtin_studies() -> list[str]:
    """Names of the studies that come with the program."""
    return sorted(file.name.removesuffix(".toml") for file in _STUDIES.iterdir() if file.name.endswith(".toml"))


def study_text(study: str | Path, overrides: Mapping[str, object] | None = None) -> str:
    """Text of a study file, as it stands or with keys changed.

    Parameters
    ----------
    study : str or Path
        Name of a built-in study, or a file.
    overrides : mapping of str to object, optional
        Dotted key to value.

    Returns
    -------
    str
        TOML.

    Raises
    ------
    UnknownName
        If there is no such study.
    InvalidStudy
        If the file is no TOML, or a key cannot be changed.
    """
    text = _read(study)
    return _overridden(text, overrides, str(study)) if overrides else text


def load_study(study: str | Path, overrides: Mapping[str, object] | None = None) -> Study:
    """Load a study and check all of it.

    Parameters
    ----------
    study : str or Path
        Name of a built-in study, or a TOML file.
    overrides : mapping of str to object, optional
        Dotted key to value, for example ``{"workspace.points": [11, 11, 11]}``.

    Returns
    -------
    Study
        Ready to be evaluated.

    Raises
    ------
    UnknownName
        If there is no such study.
    InvalidStudy
        Naming every problem with its key path, value, expectation and unit.

    Examples
    --------
    >>> study = load_study("cpr8", {"motion.speed_max_m_per_s": 0.8})
    >>> study.positions.shape
    (216, 3)
    """
    return parse_study(study_text(study, overrides), place=str(study))


def parse_study(text: str, *, place: str, overrides: Mapping[str, object] | None = None) -> Study:
    """Validate the text of a study file and build the study.

    Parameters
    ----------
    text : str
        TOML.
    place : str
        Name for messages.
    overrides : mapping of str to object, optional
        Dotted key to value.

    Returns
    -------
    Study
        Ready to be evaluated.

    Raises
    ------
    InvalidStudy
        As `load_study`.
    """
    if overrides:
        text = _overridden(text, overrides, place)
    content = _parsed(text, place).unwrap()
    study = _build(content, text, f"study {place!r}")
    _refuse_moves_through_anchors(study, place)
    return replace(study, variants=tuple(_variants(study, content, place)))


def _refuse_moves_through_anchors(study: Study, place: str) -> None:
    problems = [
        Problem(
            place=f"move[{index}]",
            value="the line touches a frame anchor, where a cable has no direction",
            expected="a line that keeps off the anchors [m]",
        )
        for index, move in enumerate(study.table.move)
        if least_cable_lengths(
            study.robot, np.array(move.from_m), np.array(move.to_m), np.array(move.orientation_rad)
        ).min()
        < LEAST_CABLE_LENGTH
    ]
    if problems:
        raise InvalidStudy(f"study {place!r} does not hold", problems)


def _variants(study: Study, content: dict[str, object], place: str) -> Iterator[Variant]:
    for index, one in enumerate(study.table.variant):
        where = f"study {place!r}, variant[{index}]"
        for key in one.set:
            if key.split(".")[0].split("[")[0] not in VARIANT_TABLES:
                problem = Problem(
                    place=f"variant[{index}].set",
                    value=repr(key),
                    expected=f"a key of {', '.join(VARIANT_TABLES)}, which are what a variant may change",
                )
                raise InvalidStudy(f"{where} does not hold", [problem])
        changed = deepcopy({key: value for key, value in content.items() if key != "variant"})
        try:
            apply_overrides(changed, one.set)
        except InvalidStudy as error:
            raise InvalidStudy(f"{where} does not hold", error.problems) from error
        yield Variant(title=one.title, keys=tuple(one.set), study=_build(changed, study.text, where))


def _build(content: dict[str, object], text: str, place: str) -> Study:
    try:
        table = StudyTable.model_validate(content)
    except ValidationError as error:
        raise InvalidStudy(f"{place} does not hold", study_problems(error)) from error
    workspace = table.workspace
    robot, region = _robot(table.robot, workspace, place)
    _refuse_too_many_poses(workspace, robot.cables, place)
    return Study(
        name=table.name,
        text=text,
        table=table,
        robot=robot,
        region=region,
        positions=position_grid(region, workspace.points),
        orientations=np.array(workspace.orientations_rad, dtype=np.float64),
        wrench=required_wrench(table.payload.mass_kg, table.gravity_m_per_s2),
        motion=_motion(table.motion),
        tension_model=TensionModel(table.tension.model),
        checks=tuple(check for check in Check if check.value in table.checks.apply),
    )


def starter_text(name: str) -> str:
    """Text of a commented study file to start from, which works as it stands.

    Parameters
    ----------
    name : str
        Name of the new study.

    Returns
    -------
    str
        TOML.
    """
    return (
        (_STUDIES / "starter.toml.txt")
        .read_text(encoding="utf-8")
        .replace('"@NAME@"', tomlkit.string(name).as_string())
    )


def _read(study: str | Path) -> str:
    path = Path(study)
    names = builtin_studies()
    if isinstance(study, str) and study in names:
        return (_STUDIES / f"{study}.toml").read_text(encoding="utf-8")
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as error:
        known = did_you_mean(path.name, names)
        raise UnknownName(
            f"no study {str(study)!r}: it is neither a built-in study ({known}) nor an existing file; "
            f"`actuator-select study new {path.stem}.toml` starts one"
        ) from error
    except UnicodeDecodeError as error:
        raise InvalidStudy(
            f"study {str(study)!r} is not UTF-8 text (byte {error.start}); save the file as UTF-8"
        ) from error
    except OSError as error:
        raise UnknownName(f"study {str(study)!r} cannot be read: {error.strerror}; name a TOML file") from error


def _parsed(text: str, place: str) -> tomlkit.TOMLDocument:
    try:
        return tomlkit.parse(text)
    except TOMLKitError as error:
        raise InvalidStudy(f"study {place!r} is not valid TOML: {error}; mend the file there") from error


def _overridden(text: str, overrides: Mapping[str, object], place: str) -> str:
    document = _parsed(text, place)
    apply_overrides(document, overrides)
    return tomlkit.dumps(document)


def _refuse_too_many_poses(workspace: WorkspaceTable, cables: int, place: str) -> None:
    poses, most = prod(workspace.points) * len(workspace.orientations_rad), MOST_CABLE_POSES // cables
    if poses > most:
        problem = Problem(
            place="workspace.points",
            value=f"{list(workspace.points)} at {len(workspace.orientations_rad)} orientations are {poses:,} poses",
            expected=f"at most {most:,} with {cables} cables, which take some 2 GB of memory",
            remedy="take a coarser grid, or parts of the workspace one after the other with box_m",
        )
        raise InvalidStudy(f"{place} does not hold", [problem])


def _robot(robot: RobotTable, workspace: WorkspaceTable, place: str) -> tuple[CableRobot, FloatArray]:
    box = None if workspace.box_m is None else np.array(workspace.box_m, dtype=np.float64)
    if robot.cable is not None:
        if box is None:
            problem = Problem(
                place="workspace.region",
                value='"builder" for a robot with explicit cables',
                expected="box_m = [[x0, x1], [y0, y1], [z0, z1]] in m",
            )
            raise InvalidStudy(f"{place} does not hold", [problem])
        frame_anchors = np.array([cable.frame_anchor_m for cable in robot.cable], dtype=np.float64)
        platform_anchors = np.array([cable.platform_anchor_m for cable in robot.cable], dtype=np.float64)
        return CableRobot(frame_anchors=frame_anchors, platform_anchors=platform_anchors), box
    frame, carrier = np.array(robot.frame_m), np.array(robot.carrier_m)
    region = cpr8_region(frame, carrier)
    if (region[:, 0] > region[:, 1]).any():
        problem = Problem(
            place="robot.carrier_m",
            value=str([float(length) for length in carrier]),
            expected=f"a carrier whose diagonal ({np.linalg.norm(carrier):.4g} m) fits into the frame, "
            f"{[float(length) for length in frame]} m, on every axis",
            remedy="make the carrier smaller or the frame larger",
        )
        raise InvalidStudy(f"{place} does not hold", [problem])
    return cpr8(frame, carrier), region if box is None else box


def _motion(motion: MotionTable) -> MotionSet:
    ramps = (motion.speed_max_m_per_s, motion.acceleration_time_s, motion.deceleration_time_s)
    if motion.set == "independent":
        return independent_motion(*ramps, centripetal=motion.centripetal)
    return sampled_motion(
        *ramps,
        velocity_intervals=motion.velocity_intervals,
        acceleration_levels=motion.acceleration_levels,
        centripetal=motion.centripetal,
    )
