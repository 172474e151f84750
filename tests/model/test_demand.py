"""Demand and worst voltage under the pseudo-inverse against sampled motions of mass points on differenced cables."""

from dataclasses import dataclass, replace
from itertools import pairwise, product

import numpy as np
import pytest

from actuator_select.model.actuation import VoltageLine
from actuator_select.model.demand import Demand, compute_demand
from actuator_select.model.dynamics import Load, platform_wrench
from actuator_select.model.motion import (
    MotionKind,
    MotionSet,
    SetShape,
    independent_motion,
    listed_motion,
    sampled_motion,
)
from actuator_select.model.robot import CableBounds, CableRobot, Counterbalance, Freedom, RigidBody
from actuator_select.model.voltage import voltage_demand
from tests.reference.moving_platform import (
    MassPoints,
    MotionLimits,
    Motions,
    cable_rates,
    climb,
    needed_wrench,
    random_body,
    rotation,
    structure,
)

GRAVITY, SPEED, RAMP = 9.81, 1.5, 0.6
FLAT = (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
POINTS = (Freedom.POINT, Freedom.POINT_IN_PLANE)
LINE = VoltageLine(
    reflected_mass=np.array([0.0, 3.0, 25.0]), damping=np.array([40.0, 5.0, 60.0]), force_limit=np.ones(3)
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Situation:
    """A robot at one pose, with two loads (mass points, half a box of external force and moment)."""

    robot: CableRobot
    position: np.ndarray
    angles: np.ndarray
    bodies: tuple[MassPoints, MassPoints]
    reach: tuple[np.ndarray, np.ndarray]
    rope: np.ndarray  # of the counterbalance: frame and platform anchor

    @property
    def rows(self) -> list[int]:
        return list(self.robot.wrench_rows)

    @property
    def turn(self) -> np.ndarray:
        return rotation(self.angles)

    @property
    def loads(self) -> list[Load]:
        return [
            Load(
                title="",
                body=RigidBody(mass=body.masses.sum(), centre_of_gravity=body.centre, inertia=body.inertia),
                force_lower=-reach[:3],
                force_upper=reach[:3],
                moment_lower=-reach[3:],
                moment_upper=reach[3:],
            )
            for body, reach in zip(self.bodies, self.reach, strict=True)
        ]

    def demand(self, motion: MotionSet) -> Demand:
        wrenches = [[platform_wrench([], GRAVITY, self.angles, load) for load in self.loads]]
        return compute_demand(self.robot, self.position[None], self.angles[None], wrenches, motion)

    def tensions(self, load: int, motions: Motions) -> tuple[np.ndarray, np.ndarray]:
        """Tensions of the pseudo-inverse without external loads, (S, m), and what these add at most, (m,)."""
        inverse = self.inverse()
        rope = structure(self.rope[:1], self.position, self.rope[1:] @ self.turn.T)[:, 0] * 35.0
        needed = needed_wrench(self.bodies[load], GRAVITY, self.turn, motions) - rope
        return needed[:, self.rows] @ inverse.T, np.abs(inverse) @ self.reach[load][self.rows]

    def inverse(self) -> np.ndarray:
        placed = self.robot.platform_anchors @ self.turn.T
        return np.linalg.pinv(structure(self.robot.frame_anchors, self.position, placed)[self.rows])

    def worst(self, load: int, motions: Motions, mass: float, damping: float) -> np.ndarray:
        """Magnitude of tension + mass · acceleration + damping · speed, external loads at their worst, (S, m)."""
        tension, external = self.tensions(load, motions)
        placed = self.robot.platform_anchors @ self.turn.T
        speed, acceleration = cable_rates(self.robot.frame_anchors, self.position, placed, motions)
        return np.abs(tension + mass * acceleration + damping * speed) + external


def situation(freedom: Freedom, seed: int, cables: int = 5) -> Situation:
    generator = np.random.default_rng(seed)
    inside = np.array([1.0, 0.0, 1.0]) if freedom in FLAT else np.ones(3)
    arms = 0.0 if freedom in POINTS else 1.0
    cables = 7 if freedom is Freedom.SPATIAL else cables
    frame = np.sign(generator.normal(size=(cables, 3))) * generator.uniform(1.5, 4.0, (cables, 3)) * inside
    rope = np.array([[0.3, 0.0, 4.0], arms * np.array([0.1, 0.0, 0.2])])
    bodies = [random_body(generator, mass, 0.3 * arms, flat=freedom in FLAT) for mass in (2.0, 9.0)]
    external = generator.uniform(0.0, 4.0, (2, 6)) * np.array([1.0, 1.0, 1.0, *(3 * [0.3 * arms])])
    return Situation(
        robot=CableRobot(
            frame_anchors=frame,
            platform_anchors=arms * generator.uniform(-0.5, 0.5, (cables, 3)) * inside,
            freedom=freedom,
            counterbalances=(
                Counterbalance(frame_anchors=rope[:1], platform_anchors=rope[1:], tension_min=35.0, tension_max=35.0),
            ),
        ),
        position=generator.uniform(-0.6, 0.6, 3) * inside,
        angles=generator.uniform(-0.5, 0.5, 3) * arms * ([0.0, 1.0, 0.0] if freedom in FLAT else [1.0, 1.0, 1.0]),
        bodies=(bodies[0], bodies[1]),
        reach=(external[0], external[1]),
        rope=rope,
    )


def sets(
    freedom: Freedom,
    *,
    straight: bool = False,
    velocity_box: bool = False,
    acceleration_box: bool = False,
    spin: float = 0.0,
) -> tuple[MotionSet, MotionLimits]:
    """The same set for the package and for the search."""
    motion = independent_motion(
        SPEED,
        RAMP,
        RAMP,
        centripetal=True,
        kind=MotionKind.STRAIGHT if straight else MotionKind.INDEPENDENT,
        velocity_shape=SetShape.BOX if velocity_box else SetShape.BALL,
        acceleration_shape=SetShape.BOX if acceleration_box else SetShape.BALL,
        angular_speed=spin,
    )
    limits = MotionLimits(
        speed=SPEED,
        acceleration=SPEED / RAMP,
        spin=spin,
        spin_rate=spin / RAMP,
        straight=straight,
        velocity_box=velocity_box,
        acceleration_box=acceleration_box,
        axes=(1.0, 0.0, 1.0) if freedom in FLAT else (1.0, 1.0, 1.0),
        turns=(0.0, 1.0, 0.0) if freedom in FLAT else (1.0, 1.0, 1.0),
    )
    return motion, limits


def largest(
    case: Situation, limits: MotionLimits, load: int, mass: float, damping: float, *, every: bool = False
) -> np.ndarray:
    """Per cable, over samples and a search from the best of them, (m,); searched for the worst cables, or for every."""
    generator = np.random.default_rng(31)
    placed = case.robot.platform_anchors @ case.turn.T
    along = structure(case.robot.frame_anchors, case.position, placed)[:3].T
    # Accelerations along W⁺'s rows and in between; velocities along the cables.
    by_mass = (case.inverse() @ np.eye(6)[case.rows][:, :3]) * case.bodies[load].masses.sum()
    special = np.vstack([along, by_mass, by_mass + mass * along])
    special = special[np.linalg.norm(special, axis=1) > 1e-9]
    starts = limits.raw(generator, special / np.linalg.norm(special, axis=1, keepdims=True), 1500)
    values = case.worst(load, limits.into(starts), mass, damping)
    found = values.max(axis=0)
    for cable in np.flatnonzero(found > (0.0 if every else 0.95) * found.max()):
        best = climb(
            lambda motions, cable=cable: case.worst(load, motions, mass, damping)[:, cable],
            limits,
            starts[values[:, cable].argmax()],
            generator,
        )
        found[cable] = max(found[cable], best)
    return found


@pytest.mark.parametrize("freedom", list(Freedom))
@pytest.mark.parametrize("acceleration_box", [False, True])
@pytest.mark.parametrize("straight", [False, True])
def test_the_worst_force_and_voltage_are_those_of_the_worst_motion(
    freedom: Freedom, *, acceleration_box: bool, straight: bool
) -> None:
    if straight and acceleration_box:
        pytest.skip("straight moves have no box")
    case = situation(freedom, seed=2)
    motion, limits = sets(freedom, straight=straight, acceleration_box=acceleration_box)
    demand = case.demand(motion)
    for load in (0, 1):
        assert demand.force[load] == pytest.approx(largest(case, limits, load, 0.0, 0.0, every=True), rel=1e-5)
    closed = voltage_demand(demand).worst(LINE)[:, 0]
    for index, (mass, damping) in enumerate(zip(LINE.reflected_mass, LINE.damping, strict=True)):
        found = max(largest(case, limits, load, mass, damping).max() for load in (0, 1))
        assert found <= closed[index] * (1.0 + 1e-6)
        if not straight or mass == 0.0:  # of straight moves the swing term is taken at its worst
            assert found == pytest.approx(closed[index], rel=1e-4)
        else:
            assert found > 0.7 * closed[index]


@pytest.mark.parametrize("freedom", FLAT)
@pytest.mark.parametrize("kind", ["independent", "straight", "sampled"])
def test_cables_that_lead_out_of_the_plane_ask_what_motions_in_the_plane_ask(freedom: Freedom, kind: str) -> None:
    flat = situation(freedom, seed=2)
    aside = np.array([[0.0, y, 0.0] for y in (3.0, -2.0, 4.0, -1.0, 2.5)])
    case = replace(flat, robot=replace(flat.robot, frame_anchors=flat.robot.frame_anchors + aside))
    motion, limits = sets(freedom, straight=kind == "straight", acceleration_box=kind == "sampled")
    if kind == "sampled":
        motion = sampled_motion(
            SPEED, RAMP, RAMP, velocity_intervals=20, acceleration_levels=(-1.0, 1.0), centripetal=True
        )
    closed = voltage_demand(case.demand(motion)).worst(LINE)[:, 0]
    for index, (mass, damping) in enumerate(zip(LINE.reflected_mass, LINE.damping, strict=True)):
        found = max(largest(case, limits, load, mass, damping).max() for load in (0, 1))
        if kind == "independent":
            assert found == pytest.approx(closed[index], rel=1e-4)
        elif kind == "straight":
            assert 0.7 * closed[index] < found <= closed[index] * (1.0 + 1e-6)
        else:  # samples lie within the ball, and not far from its border
            assert 0.95 * found < closed[index] <= found * (1.0 + 1e-4)


@pytest.mark.parametrize("freedom", [Freedom.PLANAR, Freedom.SPATIAL])
@pytest.mark.parametrize("shape", ["ball", "velocity box", "boxes", "straight"])
@pytest.mark.parametrize("spin", [0.0, 1.9])
def test_no_motion_asks_more_than_a_safe_bound(freedom: Freedom, shape: str, spin: float) -> None:
    case = situation(freedom, seed=5)
    motion, limits = sets(
        freedom,
        straight=shape == "straight",
        velocity_box="box" in shape,
        acceleration_box=shape == "boxes",
        spin=spin,
    )
    demand = case.demand(motion)
    for load in (0, 1):
        found = largest(case, limits, load, 0.0, 0.0, every=True)
        assert (found <= demand.force[load] * (1.0 + 1e-6)).all()
        assert (found >= demand.force[load] * (0.5 if spin else 1.0 - 1e-5)).all()
    closed = voltage_demand(demand).worst(LINE)[:, 0]
    for index, (mass, damping) in enumerate(zip(LINE.reflected_mass, LINE.damping, strict=True)):
        found = max(largest(case, limits, load, mass, damping).max() for load in (0, 1))
        assert 0.4 * closed[index] < found <= closed[index] * (1.0 + 1e-6)


def test_a_box_of_velocities_swings_a_cable_that_lies_along_one_of_its_axes() -> None:
    # A cable along x: its speed is V at most, but V along y and z swings it.
    robot = CableRobot(frame_anchors=np.array([[2.0, 0.0, 0.0]]), platform_anchors=np.zeros((1, 3)))
    motion = replace(
        sets(Freedom.POINT, velocity_box=True)[0], acceleration_lower=np.zeros(3), acceleration_upper=np.zeros(3)
    )
    wrench = platform_wrench([RigidBody(mass=0.0)], GRAVITY, np.zeros(3))
    demand = compute_demand(robot, np.zeros((1, 3)), np.zeros((1, 3)), [[wrench]], motion)
    mass, damping = 1.0, 20.0
    line = VoltageLine(reflected_mass=np.array([mass]), damping=np.array([damping]), force_limit=np.ones(1))
    assert voltage_demand(demand).worst(line)[0, 0] >= damping * SPEED + mass * 2.0 * SPEED**2 / 2.0


@pytest.mark.parametrize("freedom", [Freedom.PLANAR, Freedom.SPATIAL])
def test_listed_motions_are_held_one_by_one(freedom: Freedom) -> None:
    case = situation(freedom, seed=3)
    _, limits = sets(freedom, spin=1.2)
    motions = limits.into(limits.raw(np.random.default_rng(4), np.eye(3), 6))
    listed = np.stack([motions.velocity, motions.acceleration, motions.spin, motions.spin_rate], axis=1)
    demand = case.demand(listed_motion(listed, centripetal=True))
    expected = np.vstack([case.worst(load, motions, 0.0, 0.0) for load in (0, 1)])
    assert demand.force == pytest.approx(expected, rel=1e-6, abs=1e-6)
    closed = voltage_demand(demand).worst(LINE)[:, 0]
    for index, (mass, damping) in enumerate(zip(LINE.reflected_mass, LINE.damping, strict=True)):
        found = max(case.worst(load, motions, mass, damping).max() for load in (0, 1))
        assert closed[index] == pytest.approx(found, rel=1e-6)


def many(case: Situation, motion: MotionSet, **changed: object) -> Demand:
    """Demand of a grid around the situation's position."""
    inside = np.array([1.0, 0.0, 1.0]) if case.robot.freedom in FLAT else np.ones(3)
    positions = np.array(list(product((-0.8, 0.1, 0.9), repeat=3))) * inside
    wrenches = [[platform_wrench([], GRAVITY, case.angles, load) for load in case.loads]]
    asked = {"robot": case.robot, "wrenches": wrenches} | changed
    return compute_demand(
        asked["robot"],
        positions,
        case.angles[None],
        asked["wrenches"],
        motion,  # type: ignore[arg-type]
    )


@pytest.mark.parametrize("freedom", [Freedom.POINT, Freedom.SPATIAL])
def test_a_ball_never_asks_more_than_its_box_nor_a_straight_move_more_than_independent_ones(freedom: Freedom) -> None:
    case = situation(freedom, seed=7)
    spin = 1.0 if freedom is Freedom.SPATIAL else 0.0
    chain = [
        many(case, sets(freedom, straight=True, spin=spin)[0]),
        many(case, sets(freedom, spin=spin)[0]),
        many(case, sets(freedom, acceleration_box=True, spin=spin)[0]),
        many(case, sets(freedom, acceleration_box=True, velocity_box=True, spin=spin)[0]),
    ]
    for less, more in pairwise(chain):
        assert (less.force <= more.force * (1.0 + 1e-12)).all()
        assert (less.acceleration <= more.acceleration * (1.0 + 1e-12)).all()
        assert (voltage_demand(less).worst(LINE) <= voltage_demand(more).worst(LINE) * (1.0 + 1e-12)).all()


def test_a_cable_that_is_too_short_for_a_position_makes_it_unreachable() -> None:
    case = situation(Freedom.SPATIAL, seed=7)
    motion, _ = sets(Freedom.SPATIAL)
    free = many(case, motion)
    reach = float(np.median(free.lengths.max(axis=1)))
    robot = replace(case.robot, bounds=CableBounds.of(case.robot.cables, length_max=reach))
    short = many(case, motion, robot=robot)
    beyond = (free.lengths > reach).any(axis=1)
    assert 0 < beyond.sum() < len(beyond)
    assert np.array_equal(short.unreachable, beyond)
    assert np.array_equal(short.attainable, free.attainable & ~beyond)
