"""What frame and ropes of a robot have to be: forces on the frame, rope lengths, and what to mind."""

from dataclasses import dataclass, replace

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.demand import Demand, Progress
from actuator_select.model.distribution import distribute
from actuator_select.model.redundancy_one import unstretched_lengths
from actuator_select.model.robot import CableRobot, Freedom
from actuator_select.selection.cautions import Warned, demand_warnings
from actuator_select.selection.places import counted_positions, study_demand
from actuator_select.study import Study

SAME_POINT = 1e-3  # m; frame anchors nearer to each other than this are one point of the frame
SHORT_CABLE = 0.05  # of the robot's longest cable; a shorter one changes its direction and its length quickly
SIMILAR = 1e-6  # relative; frame and platform anchors that match by scaling to this much are similar
POSES_AT_ONCE = 20_000


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameForce:
    """The largest force on a point of the frame, at rest.

    Attributes
    ----------
    force : float or None
        Magnitude; None where the robot stands nowhere. [N]
    direction : tuple of float or None
        Unit vector of the force on the frame, world frame.
    position : tuple of float or None
        Of the platform, where the force is largest. [m]
    load : str or None
        Title of the load.
    """

    force: float | None
    direction: tuple[float, float, float] | None = None
    position: tuple[float, float, float] | None = None
    load: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class FramePoint:
    """A point of the frame and the cables that end there.

    Attributes
    ----------
    anchor : tuple of float
        [m]
    cables : tuple of int
        Counted from 1.
    largest : FrameForce
        Of all its cables together.
    """

    anchor: tuple[float, float, float]
    cables: tuple[int, ...]
    largest: FrameForce


@dataclass(frozen=True, slots=True, kw_only=True)
class CableSheet:
    """One cable.

    Attributes
    ----------
    number : int
        Counted from 1.
    frame_anchor, platform_anchor : tuple of float
        World and platform frame. [m]
    shortest, longest : float
        Straight length between the anchors, over all positions and orientations. [m]
    unstretched : tuple of float or None
        Shortest and longest length of rope that is let out where the platform stands still, eq. 22 in Qi et al. 2020;
        None without `cables.axial_stiffness_n`. [m]
    largest : FrameForce
        What it pulls its frame anchor with.
    tension_bound : float or None
        Greatest tension that the study allows. [N]
    speed : float
        Greatest cable speed over all poses and the motion set. [m/s]
    """

    number: int
    frame_anchor: tuple[float, float, float]
    platform_anchor: tuple[float, float, float]
    shortest: float
    longest: float
    unstretched: tuple[float, float] | None
    largest: FrameForce
    tension_bound: float | None
    speed: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotSheet:
    """A robot as its builder needs it.

    Attributes
    ----------
    study : Study
        Robot, region and loads.
    cables : tuple of CableSheet
        In the robot's order.
    frame_points : tuple of FramePoint
        Frame anchors, those at one place together.
    positions : int
        Of the study's grid.
    attainable : int
        Positions that a drive without limits could hold over the whole motion set.
    held_at_rest : int
        Positions where the platform can stand still, at every orientation, with every load.
    singular : int
        Positions where the structure matrix is short of rank at one orientation or more.
    least_rank : int
        Over all poses.
    warnings : tuple of Warned
        What to mind.
    """

    study: Study
    cables: tuple[CableSheet, ...]
    frame_points: tuple[FramePoint, ...]
    positions: int
    attainable: int
    held_at_rest: int
    singular: int
    least_rank: int
    warnings: tuple[Warned, ...]


class _Largest:
    """Largest resultant of groups of cables, found chunk by chunk."""

    def __init__(self, groups: list[list[int]]) -> None:
        cables = 1 + max(cable for one in groups for cable in one)
        self._member = np.zeros((len(groups), cables))
        for row, one in enumerate(groups):
            self._member[row, one] = 1.0
        self.found = [FrameForce(force=None) for _ in groups]

    def take(self, tension: FloatArray, directions: FloatArray, positions: FloatArray, load: str) -> None:
        """Look at (q, m) tensions with their directions from platform to frame, (q, m, 3)."""
        pull = -tension[..., None] * directions  # on the frame, towards the platform
        resultants = np.einsum("gm,qmk->qgk", self._member, pull)
        size = np.linalg.norm(resultants, axis=-1)
        for group, where in enumerate(size.argmax(axis=0)):
            force, before = float(size[where, group]), self.found[group].force
            if before is not None and force <= before:
                continue
            direction = resultants[where, group] / force if force > 0.0 else np.zeros(3)
            self.found[group] = FrameForce(
                force=force, direction=_point(direction), position=_point(positions[where]), load=load
            )


def robot_sheet(study: Study, progress: Progress | None = None) -> RobotSheet:
    """Work out rope lengths, forces on the frame, cable speeds, and what to mind about a robot.

    Parameters
    ----------
    study : Study
        Robot, region, loads and motion.
    progress : callable, optional
        Called with (work done, work).

    Returns
    -------
    RobotSheet
        Forces are those of the study's tension distribution at rest, external loads in the middle of their range, over
        the poses that can be held so.
    """
    # Positions that are set apart belong to no total.
    study = replace(study, positions=study.positions[counted_positions(study)])
    robot, demand = study.robot, study_demand(study, progress=progress)
    groups = _same_points(robot.frame_anchors)
    single, joint = _Largest([[cable] for cable in range(robot.cables)]), _Largest(groups)
    held, let_out = _stand_still(study, [single, joint])
    cables = tuple(
        CableSheet(
            number=cable + 1,
            frame_anchor=_point(robot.frame_anchors[cable]),
            platform_anchor=_point(robot.platform_anchors[cable]),
            shortest=float(demand.lengths[:, cable].min()),
            longest=float(demand.lengths[:, cable].max()),
            unstretched=let_out[cable],
            largest=single.found[cable],
            tension_bound=float(bound) if np.isfinite(bound := robot.bounds.tension_max[cable]) else None,
            speed=float(demand.speed[:, cable].max()),
        )
        for cable in range(robot.cables)
    )
    return RobotSheet(
        study=study,
        cables=cables,
        frame_points=tuple(
            FramePoint(
                anchor=_point(robot.frame_anchors[one[0]]), cables=tuple(cable + 1 for cable in one), largest=largest
            )
            for one, largest in zip(groups, joint.found, strict=True)
        ),
        positions=len(study.positions),
        attainable=int(demand.attainable_positions.sum()),
        held_at_rest=int(held.sum()),
        singular=demand.positions_with(demand.rank_deficient),
        least_rank=int(demand.rank.min()),
        warnings=_warnings(study, demand, held),
    )


def _stand_still(study: Study, found: list[_Largest]) -> tuple[BoolArray, list[tuple[float, float] | None]]:
    """Positions where the platform can stand still in every case, (P,), and the rope let out there, per cable.

    Largest forces go to `found`.
    """
    held = np.ones(len(study.positions), dtype=np.bool_)
    stiffness = study.robot.bounds.axial_stiffness
    shortest, longest = np.full(len(stiffness), np.inf), np.zeros(len(stiffness))
    for orientation in study.orientations:
        for index, load in enumerate(study.loads):
            static = study.wrench(orientation, index).static
            for start in range(0, len(held), POSES_AT_ONCE):
                positions = study.positions[start : start + POSES_AT_ONCE]
                wrenches = np.broadcast_to(static, (len(positions), 6))
                shared = distribute(study.robot, study.tension_model, positions, orientation, wrenches)
                holds = np.isfinite(shared.tension).all(axis=1)
                held[start : start + len(positions)] &= holds
                if holds.any():
                    let_out = unstretched_lengths(shared.geometry.lengths[holds], shared.tension[holds], stiffness)
                    shortest, longest = (
                        np.minimum(shortest, let_out.min(axis=0)),
                        np.maximum(longest, let_out.max(axis=0)),
                    )
                    for one in found:
                        one.take(shared.tension[holds], shared.geometry.directions[holds], positions[holds], load.title)
    ends = zip(shortest.tolist(), longest.tolist(), np.isfinite(stiffness), strict=True)
    return held, [(low, high) if stretches and low <= high else None for low, high, stretches in ends]


def _same_points(anchors: FloatArray) -> list[list[int]]:
    """Cables by frame anchor, in the order of their first cable."""
    groups: list[list[int]] = []
    for cable, anchor in enumerate(anchors):
        near = [one for one in groups if np.linalg.norm(anchors[one[0]] - anchor) < SAME_POINT]
        if near:
            near[0].append(cable)
        else:
            groups.append([cable])
    return groups


def _point(vector: FloatArray) -> tuple[float, float, float]:
    x, y, z = (float(one) + 0.0 for one in vector)
    return x, y, z


def _warnings(study: Study, demand: Demand, held: BoolArray) -> tuple[Warned, ...]:
    robot, total = study.robot, len(study.positions)
    found = []
    if robot.redundancy < 0:
        found.append(
            Warned(
                code="too_few_cables",
                poses=total,
                text=f"{robot.cables} cables cannot control {robot.degrees_of_freedom} degrees of freedom "
                f"({robot.freedom.value}): the platform keeps {-robot.redundancy} or more to itself.",
            )
        )
    if (demand.directions[..., 2] > 0.0).all():
        found.append(
            Warned(
                code="suspended",
                poses=total,
                text="Every cable leads upwards: only weight keeps them taut, and nothing pulls the platform down.",
            )
        )
    found += [
        Warned(
            code="similar_anchors",
            poses=total,
            text=f"Seen along {'xyz'[axis]}, the platform's anchors are a scaled copy of the frame's: all cable lines "
            f"of an upright platform meet one line along {'xyz'[axis]}, about which no cable can turn it. Let cables "
            "change places, or give the platform another shape.",
        )
        for axis in range(3)
        if _is_similar(robot, axis)
    ]
    found += demand_warnings(demand)
    if not held.all():
        found.append(
            Warned(
                code="not_held_at_rest",
                poses=int((~held).sum()),
                text=f"At {int((~held).sum())} of {total} positions no tensions within their bounds hold the platform "
                "still.",
            )
        )
    return (*found, *_short_cables(robot, demand))


def _is_similar(robot: CableRobot, axis: int) -> bool:
    """Whether a_i = c + s b_i for all cables of a spatial robot, seen along an axis."""
    if robot.freedom is not Freedom.SPATIAL:
        return False
    seen = [other for other in range(3) if other != axis]
    frame, platform = robot.frame_anchors[:, seen], robot.platform_anchors[:, seen]
    frame, platform = frame - frame.mean(axis=0), platform - platform.mean(axis=0)
    size = float((platform**2).sum())
    if size == 0.0:
        return False
    scale = float((frame * platform).sum()) / size
    return bool(np.abs(frame - scale * platform).max() <= SIMILAR * np.abs(frame).max())


def _short_cables(robot: CableRobot, demand: Demand) -> list[Warned]:
    least = np.maximum(robot.bounds.length_min, SHORT_CABLE * float(demand.lengths.max()))
    short = demand.lengths < least
    if not short.any():
        return []
    numbers = ", ".join(str(cable + 1) for cable in np.flatnonzero(short.any(axis=0)))
    several = "," in numbers
    count = demand.positions_with(np.asarray(short.any(axis=1), dtype=np.bool_))
    return [
        Warned(
            code="short_cable",
            poses=count,
            text=f"Cable{'s' if several else ''} {numbers} become{'' if several else 's'} as short as "
            f"{demand.lengths[short].min():.3g} m, at {count} of {len(demand.positions)} positions shorter than "
            f"{float(least.max()):.3g} m: near an anchor a cable turns quickly. Keep the workspace off it, or state "
            "cables.length_min_m.",
        )
    ]
