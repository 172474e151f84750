"""From a study file to a study: parse, override, validate, build."""

from collections.abc import Callable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from importlib import resources
from pathlib import Path

import numpy as np
import tomlkit
from pydantic import ValidationError
from tomlkit.exceptions import TOMLKitError

from actuator_select.errors import InvalidStudy, Problem, UnknownName, did_you_mean
from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray
from actuator_select.model.dynamics import Load, RequiredWrench, platform_wrench
from actuator_select.model.kinematics import LEAST_CABLE_LENGTH, least_cable_lengths, position_grid
from actuator_select.model.motion import MotionSet
from actuator_select.model.robot import CableRobot
from actuator_select.model.tension import TensionModel
from actuator_select.study.building import build_load, build_motion, build_orientations, build_robot
from actuator_select.study.overrides import apply_overrides
from actuator_select.study.problems import study_problems
from actuator_select.study.refusals import refuse_too_many_poses, refuse_what_cannot_be
from actuator_select.study.schema import StudyTable

VARIANT_TABLES = (
    "gravity_m_per_s2",
    "robot",
    "cables",
    "payload",
    "workspace",
    "motion",
    "tension",
    "checks",
    "assumptions",
)
NOT_IN_VARIANTS = ("variant", "sweep", "note")

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
    place : str
        File or name that the study was read from.
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
    loads : tuple of Load
        What is carried; a position has to hold with each.
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
    place: str
    text: str
    table: StudyTable
    robot: CableRobot
    region: FloatArray
    positions: FloatArray
    orientations: FloatArray
    loads: tuple[Load, ...]
    motion: MotionSet
    tension_model: TensionModel
    checks: tuple[Check, ...]
    variants: tuple[Variant, ...] = ()

    def wrench(self, orientation: FloatArray, load: int = 0) -> RequiredWrench:
        """Required wrench at an orientation [rad], of one of the loads."""
        return platform_wrench([self.robot.platform], self.table.gravity_m_per_s2, orientation, self.loads[load])

    @property
    def wrenches(self) -> list[list[RequiredWrench]]:
        """Required wrench at every orientation, of every load."""
        return [[self.wrench(one, load) for load in range(len(self.loads))] for one in self.orientations]

    @property
    def cell_size(self) -> FloatArray:
        """Distance of neighbouring grid positions along each axis, 0 where there is a single one, (3,). [m]"""
        points = np.array(self.table.workspace.points)
        cells = points if self.table.workspace.grid == "midpoints" else np.maximum(points - 1, 1)
        return np.where(points > 1, (self.region[:, 1] - self.region[:, 0]) / cells, 0.0)


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


def load_study(study: str | Path, overrides: Mapping[str, object] | None = None, *, limit: bool = True) -> Study:
    """Load a study and check all of it.

    Parameters
    ----------
    study : str or Path
        Name of a built-in study, or a TOML file.
    overrides : mapping of str to object, optional
        Dotted key to value, for example ``{"workspace.points": [11, 11, 11]}``.
    limit : bool
        Refuse grids that would take very much time and memory.

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
    return parse_study(study_text(study, overrides), place=str(study), limit=limit)


def study_builder(
    study: str | Path, overrides: Mapping[str, object] | None = None, *, limit: bool = True
) -> Callable[[Mapping[str, object]], Study]:
    """Read a study once, to build it many times with keys changed.

    Parameters
    ----------
    study, overrides, limit
        As for `load_study`.

    Returns
    -------
    callable
        From further overrides to the study, without its variants; its `text` is that of the unchanged one.

    Raises
    ------
    UnknownName, InvalidStudy
        As `load_study`; the callable raises `InvalidStudy`.
    """
    return text_builder(study_text(study, overrides), str(study), limit=limit)


def text_builder(
    text: str, place: str, overrides: Mapping[str, object] | None = None, *, limit: bool = True
) -> Callable[[Mapping[str, object]], Study]:
    """As `study_builder`, for the text of a study at hand; `place` names it, and says where its files are."""
    content = {key: value for key, value in _parsed(text, place).unwrap().items() if key not in NOT_IN_VARIANTS}
    apply_overrides(content, overrides or {})

    def build(changed: Mapping[str, object]) -> Study:
        own = deepcopy(content)
        apply_overrides(own, changed)
        return _build(own, text, f"study {place!r}", place, limit=limit)

    return build


def parse_study(text: str, *, place: str, overrides: Mapping[str, object] | None = None, limit: bool = True) -> Study:
    """Validate the text of a study file and build the study.

    Parameters
    ----------
    text : str
        TOML.
    place : str
        Name for messages.
    overrides : mapping of str to object, optional
        Dotted key to value.
    limit : bool
        As for `load_study`.

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
    study = _build(content, text, f"study {place!r}", place, limit=limit)
    _refuse_moves_through_anchors(study, place)
    return replace(study, variants=tuple(_variants(study, content, limit=limit)))


def _refuse_moves_through_anchors(study: Study, place: str) -> None:
    if study.table.move and study.table.motion.speed_max_m_per_s is None:
        problem = Problem(
            place="motion.speed_max_m_per_s",
            value="is missing",
            expected="the speed of the study's [[move]] tables, with acceleration_time_s and deceleration_time_s [m/s]",
        )
        raise InvalidStudy(f"study {place!r} does not hold", [problem])
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


def _variants(study: Study, content: dict[str, object], *, limit: bool) -> Iterator[Variant]:
    for index, one in enumerate(study.table.variant):
        where = f"study {study.place!r}, variant[{index}]"
        for key in one.set:
            if key.split(".")[0].split("[")[0] not in VARIANT_TABLES:
                problem = Problem(
                    place=f"variant[{index}].set",
                    value=repr(key),
                    expected=f"a key of {', '.join(VARIANT_TABLES)}, which are what a variant may change",
                )
                raise InvalidStudy(f"{where} does not hold", [problem])
        changed = deepcopy({key: value for key, value in content.items() if key not in NOT_IN_VARIANTS})
        try:
            apply_overrides(changed, one.set)
        except InvalidStudy as error:
            raise InvalidStudy(f"{where} does not hold", error.problems) from error
        yield Variant(
            title=one.title, keys=tuple(one.set), study=_build(changed, study.text, where, study.place, limit=limit)
        )


def _build(content: dict[str, object], text: str, place: str, source: str, *, limit: bool) -> Study:
    try:
        table = StudyTable.model_validate(content)
    except ValidationError as error:
        raise InvalidStudy(f"{place} does not hold", study_problems(error, content)) from error
    workspace = table.workspace
    robot, region = build_robot(table, place, Path(source).parent)
    orientations = build_orientations(workspace)
    loads = tuple(build_load(one) for one in table.payload)
    if limit:
        refuse_too_many_poses(table, robot, len(orientations), place)
    study = Study(
        name=table.name,
        place=source,
        text=text,
        table=table,
        robot=robot,
        region=region,
        positions=position_grid(region, workspace.points, midpoints=workspace.grid == "midpoints"),
        orientations=orientations,
        loads=loads,
        motion=build_motion(table),
        tension_model=TensionModel(table.tension.model),
        checks=tuple(check for check in Check if check.value in table.checks.apply),
    )
    refuse_what_cannot_be(study, place)
    return study


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
