"""The exact joint test against linear programs over sampled motions, and against the published study's counts."""

import json
from dataclasses import dataclass, replace
from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog

from actuator_select import Catalogue, load_study, rank
from actuator_select.model.demand import Demand, compute_demand
from actuator_select.model.dynamics import Load, RequiredWrench, platform_wrench
from actuator_select.model.joint import DriveLines, can_be_tested, exact_positions, jointly_feasible
from actuator_select.model.motion import MotionKind, MotionSet, SetShape, independent_motion, rest
from actuator_select.model.robot import CableBounds, CableRobot, Counterbalance, Freedom, RigidBody
from actuator_select.model.tension import TensionModel
from tests.reference.moving_platform import structure

GRAVITY, SPEED, RAMP = 9.81, 1.2, 0.6
ACCELERATION = SPEED / RAMP
BORDER = 1e-6  # relative to the forces; nearer to the border a verdict hangs on rounding
NO_LIMIT = 1e6  # N
FLAT = (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
FREEDOMS = [Freedom.POINT_IN_PLANE, Freedom.POINT, Freedom.PLANAR, Freedom.SPATIAL]
KINDS = ["ball and box", "balls", "boxes", "straight", "rest"]


def few(freedom: Freedom, rope: str) -> int:
    """Positions that keep a test short: eight cables on three lines each have 6561 choices."""
    eight = freedom in (Freedom.SPATIAL, Freedom.POINT)
    return 2 if eight and rope == "weak" else 15 if eight else 40


def motion_of(kind: str, *, centripetal: bool = False) -> MotionSet:
    if kind == "rest":
        return rest(centripetal=centripetal)
    return independent_motion(
        SPEED,
        RAMP,
        RAMP,
        centripetal=centripetal,
        kind=MotionKind.STRAIGHT if kind == "straight" else MotionKind.INDEPENDENT,
        velocity_shape=SetShape.BOX if kind == "boxes" else SetShape.BALL,
        acceleration_shape=SetShape.BOX if kind in ("ball and box", "boxes") else SetShape.BALL,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A robot with its load and its drive, at P positions."""

    robot: CableRobot
    body: RigidBody
    pushed: np.ndarray  # half the box of external forces, (3,)
    positions: np.ndarray
    lines: DriveLines
    ropes: tuple[float, np.ndarray]  # tension of the constant counterbalance, range of the controlled one

    @property
    def wrenches(self) -> list[list[RequiredWrench]]:
        load = Load(title="", body=self.body, force_lower=-self.pushed, force_upper=self.pushed)
        return [[platform_wrench([], GRAVITY, np.zeros(3), load)]]

    def demand(self, motion: MotionSet) -> Demand:
        return compute_demand(
            self.robot,
            self.positions,
            np.zeros((1, 3)),
            self.wrenches,
            motion,
            tension_model=TensionModel.WRENCH_FEASIBLE,
        )

    def verdicts(self, motion: MotionSet) -> np.ndarray:
        demand = self.demand(motion)
        found = jointly_feasible(self.robot, demand, self.wrenches, self.lines, np.arange(len(self.positions)))
        assert found is not None
        return found

    def with_drive(self, factor: float) -> "Case":
        lines = replace(self.lines, torque=self.lines.torque * factor, voltage=self.lines.voltage * factor)
        return replace(self, lines=lines)


def a_case(freedom: Freedom, seed: int, *, count: int = 12, rope: str = "strong") -> Case:
    generator = np.random.default_rng(seed)
    inside = np.array([1.0, 0.0, 1.0]) if freedom in FLAT else np.ones(3)
    corners = np.array(list(product((-1.0, 1.0), repeat=3)))
    if freedom in FLAT:
        corners = corners[[0, 1, 4, 5]]
    arms = 0.0 if freedom in (Freedom.POINT, Freedom.POINT_IN_PLANE) else 1.0
    frame = corners * [3.0, 2.5, 2.0] * inside * generator.uniform(0.7, 1.3, corners.shape)
    placed = arms * corners * [0.4, 0.3, -0.5] * inside * generator.uniform(0.7, 1.3, corners.shape)
    cables = len(frame)
    above = np.array([[0.3, 0.1, 4.0], [-0.4, 0.2, 3.0]]) * inside
    ends = arms * np.array([[0.1, 0.0, 0.1], [-0.1, 0.1, 0.0]]) * inside
    limit = generator.uniform(90.0, 220.0)
    strength = {"strong": 1000.0, "weak": generator.uniform(0.6, 1.1, cables) * limit, "none": np.inf}[rope]
    counterbalances = tuple(
        Counterbalance(
            frame_anchors=above[k : k + 1], platform_anchors=ends[k : k + 1], tension_min=low, tension_max=high
        )
        for k, (low, high) in enumerate([(15.0, 15.0), (5.0, 25.0)])
    )
    return Case(
        robot=CableRobot(
            frame_anchors=frame,
            platform_anchors=placed,
            freedom=freedom,
            bounds=CableBounds.of(cables, tension_min=generator.uniform(0.0, 6.0, cables), tension_max=strength),
            counterbalances=counterbalances if seed % 2 else (),
        ),
        body=RigidBody(mass=generator.uniform(4.0, 10.0), centre_of_gravity=0.05 * arms * inside),
        pushed=generator.uniform(0.0, 5.0, 3),
        positions=generator.uniform(-0.9, 0.9, (count, 3)) * inside,
        lines=DriveLines(
            torque=limit,
            torque_mass=generator.uniform(2.0, 15.0),
            voltage=limit * generator.uniform(1.0, 1.4),
            voltage_mass=generator.uniform(2.0, 15.0),
            voltage_damping=generator.uniform(5.0, 60.0),
        ),
        ropes=(15.0, np.array([5.0, 25.0])),
    )


class Program:
    """Tensions of one pose by linear programs: how much lower all limits could be.

    The dual names the hyperplane that stops them from being lower still, and with it the worst motion nearby.
    """

    def __init__(self, case: Case, position: np.ndarray) -> None:
        robot = case.robot
        self.case, self.rows = case, list(robot.wrench_rows)
        self.curving = np.zeros(robot.cables)  # 1/l where the centripetal term counts
        placed = robot.platform_anchors
        self.free = np.isin(np.arange(3), robot.free_axes).astype(float)
        whole = structure(robot.frame_anchors, position, placed)
        self.directions, self.columns = whole[:3].T * self.free, whole[self.rows]
        self.shift, self.extra = np.zeros(len(self.rows)), np.zeros((len(self.rows), 0))
        if robot.counterbalances:
            fixed, steered = robot.counterbalances
            self.shift = case.ropes[0] * structure(fixed.frame_anchors, position, fixed.platform_anchors)[self.rows, 0]
            self.extra = structure(steered.frame_anchors, position, steered.platform_anchors)[self.rows]
        centre = case.body.centre_of_gravity
        self.mass, self.lever = case.body.mass, np.cross(centre, np.eye(3)).T  # moment of a force at the centre

    def wrench(self, acceleration: np.ndarray, push: np.ndarray) -> np.ndarray:
        force = self.mass * (acceleration * self.free + [0.0, 0.0, GRAVITY])
        return np.concatenate([force + push, self.lever @ force])[self.rows]

    def limits(self, velocity: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
        lines = self.case.lines
        speed, swing = self.directions @ velocity, self.directions @ acceleration
        swing = swing - self.curving * (velocity @ velocity - speed**2)
        by_voltage = lines.voltage - lines.voltage_mass * swing - lines.voltage_damping * speed
        return np.minimum.reduce(
            [lines.torque - lines.torque_mass * swing, by_voltage, self.case.robot.bounds.tension_max]
        )

    def slack(self, velocity: np.ndarray, acceleration: np.ndarray, push: np.ndarray) -> tuple[float, np.ndarray]:
        """By how much all limits may fall until no tensions are left [N], below 0 if none are; and the normal why."""
        lower, upper = self.case.robot.bounds.tension_min, self.limits(velocity, acceleration)
        size, cables, ropes = len(self.rows), len(lower), self.extra.shape[1]
        solved = linprog(
            np.append(np.zeros(cables + ropes), -1.0),
            A_ub=np.hstack([np.eye(cables), np.zeros((cables, ropes)), np.ones((cables, 1))]),
            b_ub=np.minimum(upper, NO_LIMIT),
            A_eq=np.hstack([self.columns, self.extra, np.zeros((size, 1))]),
            b_eq=self.wrench(acceleration, push) - self.shift,
            bounds=[*((low, None) for low in lower), *([tuple(self.case.ropes[1])] * ropes), (None, None)],
            method="highs",
        )
        return (-float(solved.fun), solved.eqlin.marginals) if solved.status == 0 else (-np.inf, np.zeros(size))

    def worst_motion(
        self, motion: MotionSet, normal: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Worst motion of a hyperplane, with the lines that are the least at the motion at hand."""
        lines, pulls = self.case.lines, np.maximum(0.0, self.columns.T @ normal)
        speed, swing = self.directions @ velocity, self.directions @ acceleration
        values = np.stack(
            [
                lines.torque - lines.torque_mass * swing,
                lines.voltage - lines.voltage_mass * swing - lines.voltage_damping * speed,
                np.broadcast_to(self.case.robot.bounds.tension_max, swing.shape),
            ]
        )
        line = values.argmin(axis=0)
        mass = np.array([lines.torque_mass, lines.voltage_mass, 0.0])[line]
        damping = np.array([0.0, lines.voltage_damping, 0.0])[line]
        unit = np.array([self.wrench(one, np.zeros(3)) - self.wrench(np.zeros(3), np.zeros(3)) for one in np.eye(3)])
        hard, fast = unit @ normal + (mass * pulls) @ self.directions, (damping * pulls) @ self.directions
        worst_push = np.sign(self._push_part(normal)) * self.case.pushed
        if motion.kind is MotionKind.REST:
            return np.zeros(3), np.zeros(3), worst_push
        if motion.kind is MotionKind.STRAIGHT:
            sums = [SPEED * fast + sign * ACCELERATION * hard for sign in (1.0, -1.0)]
            best = int(np.argmax([np.linalg.norm(one) for one in sums]))
            along = _unit(sums[best])
            return SPEED * along, (1.0, -1.0)[best] * ACCELERATION * along, worst_push
        quick = SPEED * (_unit(fast) if motion.velocity_shape is SetShape.BALL else np.sign(fast))
        strong = ACCELERATION * (_unit(hard) if motion.acceleration_shape is SetShape.BALL else np.sign(hard))
        return quick, strong, worst_push

    def _push_part(self, normal: np.ndarray) -> np.ndarray:
        force = np.zeros(6)
        force[self.rows] = normal
        return force[:3]

    def search(self, motion: MotionSet, starts: list[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> float:
        """Least slack found: from every start along worst motions until nothing gets worse."""
        found = np.inf
        for start in starts:
            now, before = start, np.inf
            while True:
                value, normal = self.slack(*now)
                found = min(found, value)
                if value >= before - 1e-9 or not normal.any() or found < -1e-3:
                    break
                before, now = value, self.worst_motion(motion, normal, *now[:2])
            if found < -1e-3:
                break
        return found


def _unit(vector: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 else vector


def samples(
    motion: MotionSet, program: Program, generator: np.random.Generator, count: int
) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Motions on the set's border: along cables, and at random."""
    found = []
    ways = [*program.directions, *-program.directions, *generator.normal(size=(count, 3))]
    for way in ways:
        push = generator.choice([-1.0, 1.0], 3) * program.case.pushed
        along, other = _unit(way * program.free), _unit(generator.normal(size=3) * program.free)
        if motion.kind is MotionKind.REST:
            found.append((np.zeros(3), np.zeros(3), push))
        elif motion.kind is MotionKind.STRAIGHT:
            found.append((SPEED * along, generator.choice([-1.0, 1.0]) * ACCELERATION * along, push))
        else:
            quick = np.sign(along) if motion.velocity_shape is SetShape.BOX else along
            strong = np.sign(other) if motion.acceleration_shape is SetShape.BOX else other
            found.append((SPEED * quick * program.free, ACCELERATION * strong * program.free, push))
    return found


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_pose_is_feasible_exactly_if_no_motion_finds_its_tensions_short(freedom: Freedom, kind: str) -> None:
    motion = motion_of(kind)
    verdicts = []
    for seed, (rope, factor) in enumerate([("strong", 2.5), ("weak", 1.0), ("strong", 0.5)]):
        case = a_case(freedom, 7 * seed + FREEDOMS.index(freedom), count=3, rope=rope).with_drive(factor)
        holds = case.verdicts(motion)
        surely, nearly = case.with_drive(1.0 + BORDER).verdicts(motion), case.with_drive(1.0 - BORDER).verdicts(motion)
        generator = np.random.default_rng(seed)
        for index, position in enumerate(case.positions):
            program = Program(case, position)
            found = program.search(motion, samples(motion, program, generator, 6))
            verdicts.append(bool(holds[index]))
            if holds[index] and nearly[index]:
                assert found >= -1e-7 * case.lines.torque
            elif not holds[index] and not surely[index]:
                assert found < 0.0
    assert len(set(verdicts)) > 1 or kind == "rest"  # the cases decide something


def safe_rule(case: Case, motion: MotionSet) -> np.ndarray:
    """Positions by one constant limit per cable; without the centripetal term winding in and out are alike."""
    demand, lines = case.demand(motion), case.lines
    own = np.minimum(
        lines.torque - lines.torque_mass * demand.acceleration,
        lines.voltage - lines.voltage_mass * demand.acceleration - lines.voltage_damping * demand.speed,
    )
    return np.asarray((demand.force <= own).all(axis=1))


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("kind", KINDS)
def test_exact_lies_between_the_safe_rule_and_torque_alone(freedom: Freedom, kind: str) -> None:
    motion = motion_of(kind)
    for seed, rope in enumerate(("strong", "weak", "none")):
        case = a_case(freedom, seed, count=few(freedom, rope), rope=rope)
        exact = case.verdicts(motion)
        assert (exact | ~safe_rule(case, motion)).all()
        alone = replace(case, lines=replace(case.lines, voltage=np.inf, voltage_mass=0.0, voltage_damping=0.0))
        assert (alone.verdicts(motion) | ~exact).all()
        still = replace(alone, lines=alone.lines.without_rotor_torque())
        by_force = (case.demand(motion).force <= case.lines.torque * (1.0 + 1e-9)).all(axis=1)
        assert np.array_equal(still.verdicts(motion), by_force)


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_less_motion_and_larger_limits_never_lose_a_pose(freedom: Freedom) -> None:
    for seed in range(3):
        rope = ("strong", "weak", "none")[seed]
        case = a_case(freedom, seed, count=few(freedom, rope), rope=rope)
        chain = [case.verdicts(motion_of(kind)) for kind in ("boxes", "ball and box", "balls", "straight", "rest")]
        for more, less in pairwise(chain):
            assert (less | ~more).all()
        motion = motion_of("ball and box")
        before = case.verdicts(motion)
        for changed in (
            case.with_drive(1.1),
            replace(case, lines=replace(case.lines, voltage_damping=0.5 * case.lines.voltage_damping)),
        ):
            after = changed.verdicts(motion)
            assert (after | ~before).all()
        bounds = replace(case.robot.bounds, tension_max=case.robot.bounds.tension_max * 1.2)
        assert (replace(case, robot=replace(case.robot, bounds=bounds)).verdicts(motion) | ~before).all()


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_the_centripetal_term_never_raises_the_count_above_the_true_one(freedom: Freedom) -> None:
    # With the term a cable's limit is higher while it winds in, so that what holds without it holds with it: sampled.
    motion = motion_of("balls", centripetal=True)
    case = a_case(freedom, 4, count=6).with_drive(2.0)
    holds = case.verdicts(motion)
    assert (case.verdicts(motion_of("balls")) | ~holds).all()
    generator = np.random.default_rng(1)
    for position in case.positions[holds][:3]:
        program = Program(case, position)
        lengths = np.linalg.norm(case.robot.frame_anchors - position - case.robot.platform_anchors, axis=1)
        program.curving = 1.0 / lengths
        for one in samples(motion, program, generator, 30):
            assert program.slack(*one)[0] >= -1e-7 * case.lines.torque


def test_several_orientations_and_loads_are_each_held() -> None:
    case = a_case(Freedom.SPATIAL, 4, count=8).with_drive(1.5)
    motion, turns = motion_of("balls"), np.array([[0.0, 0.0, 0.0], [0.1, -0.2, 0.15]])
    loads = [Load(title="", body=replace(case.body, mass=mass)) for mass in (0.5, 9.0)]
    wrenches = [[platform_wrench([], GRAVITY, turn, load) for load in loads] for turn in turns]

    def ask(which: list[int], carried: list[int]) -> np.ndarray:
        asked = [[wrenches[o][k] for k in carried] for o in which]
        demand = compute_demand(
            case.robot, case.positions, turns[which], asked, motion, tension_model=TensionModel.WRENCH_FEASIBLE
        )
        found = jointly_feasible(case.robot, demand, asked, case.lines, np.arange(len(demand.lengths)))
        assert found is not None
        nothing = np.zeros(len(case.positions), dtype=np.bool_)
        assert np.array_equal(
            exact_positions(case.robot, demand, asked, case.lines, safe=nothing, possible=~nothing),
            found.reshape(len(nothing), -1).all(axis=1),
        )
        return found.reshape(len(case.positions), len(which), len(carried))

    together = ask([0, 1], [0, 1])
    assert 0 < together.sum() < together.size
    for orientation, load in product((0, 1), (0, 1)):
        assert np.array_equal(together[:, orientation, load], ask([orientation], [load])[:, 0, 0])


def test_what_has_no_closed_form_is_not_tested() -> None:
    case = a_case(Freedom.SPATIAL, 2)
    exact = TensionModel.WRENCH_FEASIBLE
    assert can_be_tested(case.robot, motion_of("balls"), exact)
    assert not can_be_tested(case.robot, replace(motion_of("balls"), angular_speed=1.0), exact)
    assert not can_be_tested(case.robot, motion_of("balls"), TensionModel.PSEUDO_INVERSE)
    assert not can_be_tested(case.robot, replace(motion_of("balls"), kind=MotionKind.SAMPLED), exact)


def find(tree: object, key: str) -> list[int]:
    """Value of a key, however deep it stands."""
    found = [
        value if name == key else find(value, key)
        for name, value in (tree.items() if isinstance(tree, dict) else ())
        if name == key or isinstance(value, dict)
    ]
    return next((one for one in found if one), [])


def test_the_published_study_has_the_reference_counts(catalogue: Catalogue) -> None:
    reference = json.loads((Path(__file__).parents[1] / "reference/cpr8.json").read_text(encoding="utf-8"))
    key = "force_equations_only_ball_and_box_0_rad_joint_torque_inertia_voltage_no_centripetal_term"
    expected = find(reference, key)
    study = load_study("cpr8", overrides={"tension.model": "force_only", "motion.centripetal": False})
    ranked = {one.name: one for one in rank(study, catalogue).ranked}
    assert [ranked[f"Actuator {number}"].exact_poses for number in range(1, 6)] == expected
    assert all(one.feasible_poses <= (one.exact_poses or 0) for one in ranked.values())
