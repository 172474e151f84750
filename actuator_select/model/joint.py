"""The exact test of limits that fall with cable speed and acceleration: one tension has to meet all of them jointly.

The safe rule gives every cable one constant limit, the least that its own worst speed and acceleration leave. Over all
motions at once more is possible, because the cables are not at their worst together. At a motion (v, a) a cable's limit
is the least of three lines, of torque, of voltage and of its rope; a hyperplane's condition is then that of the worst
choice of lines among the cables that pull along its normal, and its worst motion is a closed form.
"""

from dataclasses import dataclass, replace
from itertools import product
from math import comb, prod

import numpy as np

from actuator_select.model.actuation import ROUNDING, VoltageLine
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.demand import Demand, Wrenches
from actuator_select.model.dynamics import wrench_scale
from actuator_select.model.feasibility import structure_rank
from actuator_select.model.hyperplanes import WRENCH_TOLERANCE, facet_normals, in_hyperplane
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionKind, MotionSet, extent
from actuator_select.model.robot import CableRobot
from actuator_select.model.supports import support_wrenches
from actuator_select.model.tension import TensionModel, balanced_rows

MOST_CABLES = 12
MOST_CHOICES = 1 << 13  # of a line for every cable
MOST_WORK = 1 << 26  # (pose, hyperplane, choice) cells, most of which constant limits settle; some seconds
CHOICES_AT_ONCE = 1 << 19  # (pose, choice, cable) cells in one chunk
LINES = 3  # of torque, voltage and rope


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveLines:
    """Limits of one drive at the drum: force ≤ torque - torque_mass · s, force ≤ voltage - mass · s - damping · v.

    Attributes
    ----------
    torque, torque_mass : float
        Infinite and 0 where torque is not tested. [N, kg]
    voltage, voltage_mass, voltage_damping : float
        Infinite and 0 where voltage is not tested. [N, kg, N s/m]
    """

    torque: float
    torque_mass: float
    voltage: float
    voltage_mass: float
    voltage_damping: float

    @classmethod
    def of(cls, torque: VoltageLine | None, voltage: VoltageLine | None) -> "DriveLines":
        """Lines of a single drive; None where a limit is not tested."""
        return cls(
            torque=np.inf if torque is None else float(torque.force_limit[0]),
            torque_mass=0.0 if torque is None else float(torque.reflected_mass[0]),
            voltage=np.inf if voltage is None else float(voltage.force_limit[0]),
            voltage_mass=0.0 if voltage is None else float(voltage.reflected_mass[0]),
            voltage_damping=0.0 if voltage is None else float(voltage.damping[0]),
        )

    def without_rotor_torque(self) -> "DriveLines":
        """The same, with torque held against the load alone."""
        return replace(self, torque_mass=0.0)


def can_be_tested(robot: CableRobot, motion: MotionSet, model: TensionModel) -> bool:
    """Whether the exact test has a closed form: bounded tensions, a platform that does not turn, few enough cables."""
    kinds = (MotionKind.INDEPENDENT, MotionKind.STRAIGHT, MotionKind.REST)
    return not model.lets_cables_push and motion.kind in kinds and not motion.turns and robot.cables <= MOST_CABLES


def jointly_feasible(
    robot: CableRobot, demand: Demand, wrenches: Wrenches, lines: DriveLines, poses: IntArray
) -> BoolArray | None:
    """Tell the poses at which one drive meets all limits jointly for every motion.

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    demand : Demand
        Under a model with bounded tensions, `can_be_tested`.
    wrenches : sequence of sequence of RequiredWrench
        As the demand was computed with.
    lines : DriveLines
        The drive.
    poses : (q,) array
        Indices of the demand's poses.

    Returns
    -------
    (q,) array of bool or None
        None where it would take too long. Exact without the centripetal term. With it, a safe answer: the term relieves
        a cable that is wound in, and is left out there.
    """
    rows = balanced_rows(robot, demand.tension_model)
    cases = len(demand.lengths) // len(demand.positions)
    loads = len(wrenches[0])
    which = (poses % cases) // loads
    load = poses % loads
    positions, orientations = demand.positions[poses // cases], demand.orientations[which]
    geometry = cable_geometry(robot, positions, orientations)
    support = support_wrenches(robot, positions, orientations, rows)
    scale = wrench_scale(robot, rows)
    columns = np.concatenate([geometry.structure_matrix[:, rows], support.controlled], axis=2) * scale[:, None]
    pick = list(rows)
    static = np.array([[w.static[pick] * scale for w in each] for each in wrenches])[which, load]
    lever = np.array([[w.per_acceleration[pick] * scale[:, None] for w in each] for each in wrenches])[which, load]
    external = np.array([[w.external_reach[pick] * scale for w in each] for each in wrenches])[which, load]
    problem = _Problem(
        robot=robot,
        motion=demand.motion,
        lines=lines,
        columns=columns,
        directions=geometry.directions * np.isin(np.arange(3), robot.free_axes),
        static=static - support.constant * scale,
        lever=lever,
        external=external,
        lower=np.concatenate([robot.bounds.tension_min, support.lower]),
        upper=support.upper,
    )
    choices = problem.choices()
    normals = comb(problem.columns.shape[2], max(0, len(rows) - 1))
    if not len(choices) or len(poses) * normals * len(choices) > MOST_WORK:
        return None
    return demand.attainable[poses] & problem.box_is_open(demand.acceleration_out[poses]) & problem.holds(choices)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Problem:
    """q poses of one drive."""

    robot: CableRobot
    motion: MotionSet
    lines: DriveLines
    columns: FloatArray  # (q, n, M), counterbalances of controlled tension last
    directions: FloatArray  # (q, m, 3)
    static: FloatArray  # (q, n)
    lever: FloatArray  # (q, n, 3)
    external: FloatArray  # (q, n)
    lower: FloatArray  # (M,)
    upper: FloatArray  # (M - m,)

    @property
    def _acceleration(self) -> FloatArray:
        return self.motion.acceleration_reach

    def _along(self) -> tuple[FloatArray, FloatArray]:
        """Greatest cable acceleration and speed of the motion set, without the centripetal term, each (q, m)."""
        acceleration = extent(self.directions, self._acceleration, self.motion.acceleration_shape)
        return acceleration, extent(self.directions, np.full(3, self.motion.speed), self.motion.velocity_shape)

    def box_is_open(self, acceleration_out: FloatArray) -> BoolArray:
        """Whether every cable's own limits leave room above its least tension, winding in and winding out, (q,)."""
        lines, least = self.lines, self.lower[: self.robot.cables]
        acceleration, speed = self._along()
        up = (least + lines.torque_mass * acceleration <= lines.torque * (1.0 + ROUNDING)) & (
            least + lines.voltage_mass * acceleration + lines.voltage_damping * speed
            <= lines.voltage * (1.0 + ROUNDING)
        )
        down = (lines.torque_mass * acceleration_out - least <= lines.torque * (1.0 + ROUNDING)) & (
            lines.voltage_mass * acceleration_out + lines.voltage_damping * speed - least
            <= lines.voltage * (1.0 + ROUNDING)
        )
        return np.asarray((up & down).all(axis=1), dtype=np.bool_)

    def holds(self, choices: IntArray) -> BoolArray:
        """Whether every hyperplane leaves room for every motion, (q,)."""
        result = np.ones(len(self.columns), dtype=np.bool_)
        rank, left = structure_rank(self.columns)
        for value in np.unique(rank):
            at = np.flatnonzero(rank == value)
            # What lies outside the range has been seen to with the minimax tension.
            base = left[at][:, :, :value]
            result[at] = self._holds(at, np.einsum("qnm,qnr->qrm", self.columns[at], base), base, choices)
        return result

    def _holds(self, at: IntArray, columns: FloatArray, base: FloatArray, choices: IntArray) -> BoolArray:
        result = np.ones(len(at), dtype=np.bool_)
        if columns.shape[1] == 0:
            return result
        cables = self.robot.cables
        constant = self._constant_limits()[at]
        for normal, _ in facet_normals(columns):
            pulls = in_hyperplane(np.einsum("qr,qrm->qm", normal, columns), columns)
            whole = np.einsum("qnr,qr->qn", base, normal)
            middle = np.einsum("qn,qn->q", whole, self.static[at])
            external = np.einsum("qn,qn->q", np.abs(whole), self.external[at])
            lever = np.einsum("qn,qna->qa", whole, self.lever[at])
            for sign in (1.0, -1.0):
                with_it, against = np.maximum(sign * pulls, 0.0), np.maximum(-sign * pulls, 0.0)
                needed = sign * middle + external + against @ self.lower
                needed = needed - _times(with_it[:, cables:], self.upper)
                # Constant limits leave no more room than the least of all motions does: most normals need no more.
                asked = extent(lever, self._acceleration, self.motion.acceleration_shape)
                doubtful = np.flatnonzero(result & (needed > _times(with_it[:, :cables], constant) - asked))
                if not len(doubtful):
                    continue
                room = self._room(at[doubtful], with_it[doubtful, :cables], sign * lever[doubtful], choices)
                size = np.abs(middle[doubtful]) + external[doubtful] + np.abs(room) + asked[doubtful]
                result[doubtful] = needed[doubtful] <= room + WRENCH_TOLERANCE * size
        return result

    def _constant_limits(self) -> FloatArray:
        """Least that every cable's own worst speed and acceleration leave of its limits, (q, m)."""
        acceleration, speed = self._along()
        mass, damping = self._masses()[:, None, None], self._dampings()[:, None, None]
        least: FloatArray = (self._forces()[:, None] - mass * acceleration - damping * speed).min(axis=0)
        return least

    def choices(self) -> IntArray:
        """Every choice of a line per cable among those that are the least at some motion of some pose, (c, m)."""
        acceleration, speed = self._along()
        mass, damping = self._masses()[:, None, None], self._dampings()[:, None, None]
        falls = mass * acceleration + damping * speed  # (lines, q, m)
        force = self._forces()[:, None]
        least, most = force - falls, force + falls
        needed = []
        for line in range(LINES):
            above = np.zeros_like(acceleration, dtype=np.bool_)  # where another line is lower at every motion
            for other in range(LINES):
                above |= least[line] > most[other] if other >= line else least[line] >= most[other]
            needed.append(~above.all(axis=0))
        used = [np.flatnonzero(cable) for cable in np.stack(needed, axis=1)]
        if prod(len(lines) for lines in used) > MOST_CHOICES:
            return np.empty((0, self.robot.cables), dtype=np.int64)
        return np.array(list(product(*used)), dtype=np.int64)

    def _forces(self) -> FloatArray:
        """Force of every line at rest, (lines, m). [N]"""
        rope = self.robot.bounds.tension_max
        return np.stack([np.full_like(rope, self.lines.torque), np.full_like(rope, self.lines.voltage), rope])

    def _masses(self) -> FloatArray:
        return np.array([self.lines.torque_mass, self.lines.voltage_mass, 0.0])

    def _dampings(self) -> FloatArray:
        return np.array([0.0, self.lines.voltage_damping, 0.0])

    def _room(self, at: IntArray, pulls: FloatArray, lever: FloatArray, choices: IntArray) -> FloatArray:
        """What the cables can pull along the normal less what motion asks, least over lines and motions, (q,)."""
        room = np.full(len(pulls), np.inf)
        step = max(1, CHOICES_AT_ONCE // choices.size)
        for start in range(0, len(pulls), step):
            part = slice(start, start + step)
            room[part] = self._least_room(pulls[part], self.directions[at[part]], lever[part], choices)
        return room

    def _least_room(
        self, pulls: FloatArray, directions: FloatArray, lever: FloatArray, choices: IntArray
    ) -> FloatArray:
        motion = self.motion
        force = _times(pulls[:, None], self._forces()[choices, np.arange(choices.shape[1])])
        inertia = pulls[:, None] * self._masses()[choices]  # (q, c, m)
        accelerating = lever[:, None] + np.einsum("qcm,qma->qca", inertia, directions)
        cruising = np.einsum("qcm,qma->qca", pulls[:, None] * self._dampings()[choices], directions)
        if motion.kind is MotionKind.STRAIGHT:
            fast, hard = motion.speed * cruising, self._acceleration[0] * accelerating
            asked = np.maximum(np.linalg.norm(fast + hard, axis=-1), np.linalg.norm(fast - hard, axis=-1))
        else:
            asked = extent(accelerating, self._acceleration, motion.acceleration_shape)
            asked = asked + extent(cruising, np.full(3, motion.speed), motion.velocity_shape)
        least: FloatArray = (force - asked).min(axis=1)
        return least


def _times(pulls: FloatArray, limits: FloatArray) -> FloatArray:
    """Sum of pull · limit over the last axis; an unlimited cable that does not pull adds nothing."""
    total: FloatArray = (pulls * np.where(pulls > 0.0, limits, 0.0)).sum(axis=-1)
    return total


def exact_positions(
    robot: CableRobot,
    demand: Demand,
    wrenches: Wrenches,
    lines: DriveLines,
    *,
    safe: BoolArray,
    possible: BoolArray,
) -> BoolArray | None:
    """Positions at which one drive meets all limits jointly, (P,); None where that would take too long.

    Parameters
    ----------
    robot, demand, wrenches, lines
        As for `jointly_feasible`.
    safe : (P,) array of bool
        Positions that pass by the safe rule, and need no test.
    possible : (P,) array of bool
        Positions that pass every necessary test: each limit alone, speed and acceleration at their least.
    """
    cases = len(demand.lengths) // len(demand.positions)
    doubtful = np.flatnonzero(possible & ~safe)
    result = safe.copy()
    if len(doubtful):
        poses = (doubtful[:, None] * cases + np.arange(cases)).ravel()
        holds = jointly_feasible(robot, demand, wrenches, lines, poses)
        if holds is None:
            return None
        result[doubtful] = holds.reshape(len(doubtful), cases).all(axis=1)
    return result
