"""The required wrench against mass points that move by Newton's laws."""

import numpy as np
import pytest

from actuator_select.model.dynamics import Load, RequiredWrench, platform_wrench, wrench_sets
from actuator_select.model.motion import MotionKind, MotionSet, SetShape, independent_motion, listed_motion
from actuator_select.model.robot import CableRobot, Freedom, RigidBody
from tests.reference.moving_platform import (
    MassPoints,
    MotionLimits,
    Motions,
    energy_rate,
    needed_wrench,
    random_body,
    rotation,
)

GRAVITY = 9.7
ANGLES = np.array([0.3, -0.5, 0.8])


def rigid(body: MassPoints) -> RigidBody:
    return RigidBody(mass=float(body.masses.sum()), centre_of_gravity=body.centre, inertia=body.inertia)


def together(*bodies: MassPoints) -> MassPoints:
    return MassPoints(
        points=np.vstack([one.points for one in bodies]), masses=np.concatenate([one.masses for one in bodies])
    )


def random_motions(generator: np.random.Generator, count: int) -> Motions:
    velocity, acceleration, spin, spin_rate = generator.normal(size=(4, count, 3))
    return Motions(velocity=velocity, acceleration=acceleration, spin=spin, spin_rate=spin_rate)


def wrench_of(wrench: RequiredWrench, motions: Motions) -> np.ndarray:
    turning = np.array([wrench.of_rotation(one) for one in motions.spin])
    return (
        wrench.static
        + motions.acceleration @ wrench.per_acceleration.T
        + motions.spin_rate @ wrench.per_angular_acceleration.T
        + turning
    )


@pytest.mark.parametrize("seed", range(5))
def test_the_wrench_is_the_rate_of_momentum_and_angular_momentum_of_mass_points(seed: int) -> None:
    generator = np.random.default_rng(seed)
    platform, payload = random_body(generator, 3.0, 0.4), random_body(generator, 11.0, 0.7)
    motions = random_motions(generator, 20)
    angles = generator.uniform(-1.0, 1.0, 3)
    wrench = platform_wrench([rigid(platform)], GRAVITY, angles, Load(title="", body=rigid(payload)))
    expected = needed_wrench(together(platform, payload), GRAVITY, rotation(angles), motions)
    assert wrench_of(wrench, motions) == pytest.approx(expected, abs=2e-7)


def test_external_loads_go_off_what_is_required_and_their_box_is_its_reach() -> None:
    body = rigid(random_body(np.random.default_rng(3), 4.0, 0.3))
    lower, upper = np.array([-1.0, 2.0, -30.0]), np.array([5.0, 2.0, 10.0])
    load = Load(
        title="", body=body, force_lower=lower, force_upper=upper, moment_lower=lower / 10.0, moment_upper=upper / 10.0
    )
    free = platform_wrench([body], GRAVITY, ANGLES)
    pushed = platform_wrench([], GRAVITY, ANGLES, load)
    corners = [pushed.static - pushed.external_reach, pushed.static + pushed.external_reach]
    assert corners[0] == pytest.approx(free.static - np.concatenate([upper, upper / 10.0]))
    assert corners[1] == pytest.approx(free.static - np.concatenate([lower, lower / 10.0]))
    assert pushed.per_acceleration == pytest.approx(free.per_acceleration)


def test_the_power_of_the_wrench_is_the_rate_of_energy() -> None:
    generator = np.random.default_rng(8)
    body, motions = random_body(generator, 5.0, 0.5), random_motions(generator, 20)
    wrenches = wrench_of(platform_wrench([rigid(body)], GRAVITY, ANGLES), motions)
    power = (wrenches[:, :3] * motions.velocity).sum(axis=1) + (wrenches[:, 3:] * motions.spin).sum(axis=1)
    assert power == pytest.approx(energy_rate(body, GRAVITY, rotation(ANGLES), motions), abs=1e-6)


def a_robot(freedom: Freedom) -> CableRobot:
    anchors = np.random.default_rng(1).uniform(-3.0, 3.0, (8, 3))
    return CableRobot(frame_anchors=anchors, platform_anchors=0.1 * anchors[::-1], freedom=freedom)


@pytest.mark.parametrize("freedom", [Freedom.POINT, Freedom.PLANAR, Freedom.SPATIAL])
@pytest.mark.parametrize("velocity", list(SetShape))
@pytest.mark.parametrize("acceleration", list(SetShape))
@pytest.mark.parametrize("spin", [0.0, 1.7])
def test_no_motion_asks_for_a_wrench_outside_the_set(
    freedom: Freedom, velocity: SetShape, acceleration: SetShape, spin: float
) -> None:
    if freedom is Freedom.POINT and spin:
        pytest.skip("a point does not turn")
    generator = np.random.default_rng(12)
    robot = a_robot(freedom)
    rows = list(robot.wrench_rows)
    flat = freedom is Freedom.PLANAR
    body = random_body(generator, 6.0, 0.5, flat=flat)
    angles = np.array([0.0, 0.4, 0.0]) if flat else ANGLES
    motion = independent_motion(
        2.0, 1.0, 1.0, centripetal=True, velocity_shape=velocity, acceleration_shape=acceleration, angular_speed=spin
    )
    limits = MotionLimits(
        speed=2.0,
        acceleration=2.0,
        spin=spin,
        spin_rate=spin,
        velocity_box=velocity is SetShape.BOX,
        acceleration_box=acceleration is SetShape.BOX,
        axes=(1.0, 0.0, 1.0) if flat else (1.0, 1.0, 1.0),
        turns=(0.0, 1.0, 0.0) if flat else (1.0, 1.0, 1.0),
    )
    wrench = platform_wrench([rigid(body)], GRAVITY, angles)
    motions = limits.into(limits.raw(generator, np.eye(3), 4000))
    asked = needed_wrench(body, GRAVITY, rotation(angles), motions)[:, rows]
    scale = np.where(np.array(rows) < 3, 1.0, 1.0 / robot.characteristic_length)
    sets = wrench_sets(robot, rows, [[wrench]], motion)
    normals = generator.normal(size=(200, len(rows)))
    bound = normals @ sets.centre[0, 0] + sets.reach(normals, np.zeros(200, dtype=np.int64))[:, 0]
    reached = (normals @ (asked * scale).T).max(axis=1)
    assert (reached <= bound + 1e-6).all()
    if not spin:  # exact: the worst acceleration is a corner, or lies along the normal
        force = normals[:, : len(robot.translation_rows)] if freedom is Freedom.POINT else None
        if force is not None:
            size = np.abs(force).sum(axis=1) if limits.acceleration_box else np.linalg.norm(force, axis=1)
            assert bound == pytest.approx(force @ [0.0, 0.0, 6.0 * GRAVITY] + 6.0 * 2.0 * size)


def test_listed_motions_are_points_with_external_loads_around_them() -> None:
    generator = np.random.default_rng(5)
    body, motions = random_body(generator, 2.0, 0.3), random_motions(generator, 4)
    robot = a_robot(Freedom.SPATIAL)
    listed = np.stack([motions.velocity, motions.acceleration, motions.spin, motions.spin_rate], axis=1)
    load = Load(title="", body=rigid(body), force_lower=np.full(3, -2.0), force_upper=np.full(3, 2.0))
    empty = Load(title="", body=RigidBody(mass=1.0))
    wrenches = [[platform_wrench([], GRAVITY, ANGLES, one) for one in (empty, load)]]
    sets = wrench_sets(robot, range(6), wrenches, listed_motion(listed, centripetal=True))
    scale = np.array([1.0] * 3 + [1.0 / robot.characteristic_length] * 3)
    assert sets.centre.shape == (1, 8, 6)
    expected = needed_wrench(body, GRAVITY, rotation(ANGLES), motions) * scale
    assert sets.centre[0, 4:] == pytest.approx(expected, abs=1e-6)
    assert np.abs(sets.segments[0, :4]).sum() == 0.0
    assert np.abs(sets.segments[0, 4:]).sum(axis=1) == pytest.approx(np.tile([2.0, 2.0, 2.0, 0.0, 0.0, 0.0], (4, 1)))
    assert not sets.balls.size


def test_a_set_of_rest_is_gravity_alone() -> None:
    rest = MotionSet(
        kind=MotionKind.REST,
        speed=0.0,
        velocities=np.empty((0, 3)),
        acceleration_lower=np.zeros(3),
        acceleration_upper=np.zeros(3),
        centripetal=True,
    )
    body = random_body(np.random.default_rng(2), 2.0, 0.3)
    sets = wrench_sets(a_robot(Freedom.POINT), (0, 1, 2), [[platform_wrench([rigid(body)], GRAVITY, ANGLES)]], rest)
    assert sets.centre[0, 0] == pytest.approx([0.0, 0.0, 2.0 * GRAVITY])
    assert not sets.segments.size
    assert not sets.balls.size
