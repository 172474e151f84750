"""Extremes of cable speed and acceleration against cables whose lengths are differenced along sampled motions."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from actuator_select.model.cable_motion import CableMotion, cable_motion
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionKind, SetShape, independent_motion, listed_motion, sampled_motion
from actuator_select.model.robot import CableRobot, Freedom
from tests.reference.moving_platform import MotionLimits, Motions, cable_rates, climb, rotation

SPEED, RAMP = 1.6, 0.5
DIFFERENCES = 1e-6  # m/s²; what finite differences leave


def a_robot(freedom: Freedom, seed: int) -> tuple[CableRobot, np.ndarray, np.ndarray]:
    """A robot, a position and an orientation."""
    generator = np.random.default_rng(seed)
    flat = freedom in (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
    inside = np.array([1.0, 0.0, 1.0]) if flat else np.ones(3)
    placed = generator.uniform(-0.5, 0.5, (4, 3)) * inside
    if freedom in (Freedom.POINT, Freedom.POINT_IN_PLANE):
        placed = 0.0 * placed
    sides = np.sign(generator.normal(size=(4, 3)))
    robot = CableRobot(
        frame_anchors=sides * generator.uniform(1.5, 4.0, (4, 3)) * inside, platform_anchors=placed, freedom=freedom
    )
    angles = generator.uniform(-0.6, 0.6, 3) * ([0.0, 1.0, 0.0] if flat else [1.0, 1.0, 1.0])
    return robot, generator.uniform(-0.7, 0.7, 3) * inside, angles * (0.0 if not placed.any() else 1.0)


def limits_of(freedom: Freedom, **changed: object) -> MotionLimits:
    flat = freedom in (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
    limits = MotionLimits(
        speed=SPEED,
        acceleration=SPEED / RAMP,
        axes=(1.0, 0.0, 1.0) if flat else (1.0, 1.0, 1.0),
        turns=(0.0, 1.0, 0.0) if flat else (1.0, 1.0, 1.0),
    )
    return replace(limits, **changed)


def bounds_at(robot: CableRobot, position: np.ndarray, angles: np.ndarray, motion: object) -> CableMotion:
    return cable_motion(robot, cable_geometry(robot, position[None], angles[None]), motion)  # type: ignore[arg-type]


def rates(
    robot: CableRobot, position: np.ndarray, angles: np.ndarray, motions: Motions
) -> tuple[np.ndarray, np.ndarray]:
    return cable_rates(robot.frame_anchors, position, robot.platform_anchors @ rotation(angles).T, motions)


def reached(
    robot: CableRobot, position: np.ndarray, angles: np.ndarray, limits: MotionLimits, *, search: bool
) -> list[np.ndarray]:
    """Largest speed in and out and acceleration in and out of every cable over samples, refined by a search."""
    generator = np.random.default_rng(17)
    directions = cable_geometry(robot, position[None], angles[None]).directions[0]
    starts = limits.raw(generator, directions, 4000)
    speed, acceleration = rates(robot, position, angles, limits.into(starts))
    found = [speed.max(axis=0), (-speed).max(axis=0), acceleration.max(axis=0), (-acceleration).max(axis=0)]
    if search:
        for which, (cable, sign) in product((0, 1), product(range(robot.cables), (1.0, -1.0))):
            best = climb(
                lambda motions, which=which, cable=cable, sign=sign: (
                    sign * rates(robot, position, angles, motions)[which][:, cable]
                ),
                limits,
                starts[(sign * (speed, acceleration)[which][:, cable]).argmax()],
                generator,
            )
            row = 2 * which + (sign < 0.0)
            found[row][cable] = max(found[row][cable], best)
    return found


def extremes(bounds: CableMotion) -> list[np.ndarray]:
    return [
        values[0, 0] for values in (bounds.speed_in, bounds.speed_out, bounds.acceleration_in, bounds.acceleration_out)
    ]


@pytest.mark.parametrize("freedom", list(Freedom))
@pytest.mark.parametrize("velocity", list(SetShape))
@pytest.mark.parametrize("acceleration", list(SetShape))
def test_without_turning_the_bounds_are_attained_and_never_exceeded(
    freedom: Freedom, velocity: SetShape, acceleration: SetShape
) -> None:
    robot, position, angles = a_robot(freedom, 4)
    motion = independent_motion(
        SPEED, RAMP, RAMP, centripetal=True, velocity_shape=velocity, acceleration_shape=acceleration
    )
    limits = limits_of(freedom, velocity_box=velocity is SetShape.BOX, acceleration_box=acceleration is SetShape.BOX)
    found = reached(robot, position, angles, limits, search=True)
    for bound, largest in zip(extremes(bounds_at(robot, position, angles, motion)), found, strict=True):
        assert (largest <= bound + DIFFERENCES).all()
        assert largest == pytest.approx(bound, rel=1e-6, abs=DIFFERENCES)


@pytest.mark.parametrize("freedom", [Freedom.PLANAR, Freedom.SPATIAL])
@pytest.mark.parametrize("shape", list(SetShape))
@pytest.mark.parametrize("kind", [MotionKind.INDEPENDENT, MotionKind.STRAIGHT])
@pytest.mark.parametrize("seed", range(4))
def test_a_turning_platform_never_exceeds_the_bounds(
    freedom: Freedom, shape: SetShape, kind: MotionKind, seed: int
) -> None:
    if kind is MotionKind.STRAIGHT and shape is SetShape.BOX:
        pytest.skip("straight moves have no box")
    robot, position, angles = a_robot(freedom, seed)
    spin = 1.3
    motion = independent_motion(
        SPEED,
        RAMP,
        RAMP,
        centripetal=True,
        kind=kind,
        velocity_shape=shape,
        acceleration_shape=shape,
        angular_speed=spin,
    )
    box = shape is SetShape.BOX
    limits = limits_of(
        freedom,
        spin=spin,
        spin_rate=spin / RAMP,
        velocity_box=box,
        acceleration_box=box,
        straight=kind is MotionKind.STRAIGHT,
    )
    found = reached(robot, position, angles, limits, search=seed == 0)
    bounds = extremes(bounds_at(robot, position, angles, motion))
    for bound, largest in zip(bounds, found, strict=True):
        assert (largest <= bound + DIFFERENCES).all()
    if seed == 0:  # speeds of linear and angular velocities are exact all the same
        for bound, largest in zip(bounds[:2], found[:2], strict=True):
            assert largest == pytest.approx(bound, rel=1e-6)


@pytest.mark.parametrize("freedom", [Freedom.POINT, Freedom.SPATIAL, Freedom.PLANAR])
def test_straight_moves_stay_within_the_bounds_and_attain_all_but_the_acceleration_out(freedom: Freedom) -> None:
    robot, position, angles = a_robot(freedom, 6)
    motion = independent_motion(
        SPEED, RAMP, RAMP, centripetal=True, kind=MotionKind.STRAIGHT, acceleration_shape=SetShape.BALL
    )
    bounds = extremes(bounds_at(robot, position, angles, motion))
    found = reached(robot, position, angles, limits_of(freedom, straight=True), search=True)
    for bound, largest in zip(bounds, found, strict=True):
        assert (largest <= bound + DIFFERENCES).all()
    for bound, largest in zip(bounds[:3], found[:3], strict=True):
        assert largest == pytest.approx(bound, rel=1e-6, abs=DIFFERENCES)
    # What is attained on one line of cosine c: A c + V² (1 - c²)/l.
    lengths = np.linalg.norm(robot.frame_anchors - position - robot.platform_anchors @ rotation(angles).T, axis=1)
    cosine = np.linspace(0.0, 1.0, 100_001)[:, None]
    exact = (SPEED / RAMP * cosine + SPEED**2 * (1.0 - cosine**2) / lengths).max(axis=0)
    assert found[3] == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize("freedom", [Freedom.PLANAR, Freedom.SPATIAL, Freedom.POINT])
def test_listed_motions_wind_as_lengths_change(freedom: Freedom) -> None:
    robot, position, angles = a_robot(freedom, 9)
    generator = np.random.default_rng(2)
    turning = 1.0 if robot.turning_axes else 0.0
    limits = limits_of(freedom, spin=1.1 * turning, spin_rate=2.0 * turning)
    motions = limits.into(limits.raw(generator, np.eye(3), 30))
    listed = np.stack([motions.velocity, motions.acceleration, motions.spin, motions.spin_rate], axis=1)
    bounds = bounds_at(robot, position, angles, listed_motion(listed, centripetal=True))
    speed, acceleration = rates(robot, position, angles, motions)
    assert bounds.speed_in[0] == pytest.approx(speed, abs=DIFFERENCES)
    assert bounds.speed_out[0] == pytest.approx(-speed, abs=DIFFERENCES)
    assert bounds.acceleration_in[0] == pytest.approx(acceleration, abs=DIFFERENCES)
    assert bounds.acceleration_out[0] == pytest.approx(-acceleration, abs=DIFFERENCES)


def test_sampled_velocities_with_every_acceleration_of_the_box() -> None:
    robot, position, angles = a_robot(Freedom.SPATIAL, 3)
    motion = sampled_motion(
        SPEED, RAMP, 2.0 * RAMP, velocity_intervals=4, acceleration_levels=(-1.0, 0.5), centripetal=True
    )
    corners = np.array(list(product(*zip(motion.acceleration_lower, motion.acceleration_upper, strict=True))))
    velocity = np.repeat(motion.velocities, len(corners), axis=0)
    nothing = np.zeros_like(velocity)
    motions = Motions(
        velocity=velocity, acceleration=np.tile(corners, (len(motion.velocities), 1)), spin=nothing, spin_rate=nothing
    )
    speed, acceleration = rates(robot, position, angles, motions)
    bounds = extremes(bounds_at(robot, position, angles, motion))
    for bound, values in zip(bounds, (speed, -speed, acceleration, -acceleration), strict=True):
        assert values.max(axis=0) == pytest.approx(bound, abs=DIFFERENCES)


def test_a_ball_never_asks_more_than_its_box_nor_a_straight_move_more_than_independent_ones() -> None:
    for seed in range(10):
        robot, position, angles = a_robot(Freedom.SPATIAL, seed)
        ball = independent_motion(
            SPEED, RAMP, RAMP, centripetal=True, acceleration_shape=SetShape.BALL, angular_speed=0.7
        )
        box = replace(ball, velocity_shape=SetShape.BOX, acceleration_shape=SetShape.BOX)
        straight = replace(ball, kind=MotionKind.STRAIGHT)
        middle = extremes(bounds_at(robot, position, angles, ball))
        for less, more in (
            (extremes(bounds_at(robot, position, angles, straight)), middle),
            (middle, extremes(bounds_at(robot, position, angles, box))),
        ):
            for one, other in zip(less, more, strict=True):
                assert (one <= other * (1.0 + 1e-12)).all()
