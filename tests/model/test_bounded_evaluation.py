"""Tensions that cables can have, by linear programs, and actuators held against them by a scalar loop."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog

from actuator_select.model import voltage_count
from actuator_select.model.actuation import Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, compute_demand
from actuator_select.model.dynamics import Load, platform_wrench
from actuator_select.model.evaluation import evaluate_actuators
from actuator_select.model.motion import MotionKind, MotionSet, SetShape, independent_motion
from actuator_select.model.robot import CableBounds, CableRobot, Freedom, RigidBody
from actuator_select.model.tension import TensionModel
from tests.reference.moving_platform import structure

SPEED, RAMP, GRAVITY = 1.2, 0.8, 9.81
ACCELERATION = SPEED / RAMP
MOTION = independent_motion(SPEED, RAMP, RAMP, centripetal=True, acceleration_shape=SetShape.BALL)
FREEDOMS = [Freedom.POINT_IN_PLANE, Freedom.POINT, Freedom.PLANAR, Freedom.SPATIAL]
EDGE = 1e-6  # relative step over the border
ROUNDING = 1e-12


def a_robot(freedom: Freedom, seed: int, **bounds: float) -> CableRobot:
    """One cable more than freedoms at least, anchors all around."""
    generator = np.random.default_rng(seed)
    flat = freedom in (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
    inside = np.array([1.0, 0.0, 1.0]) if flat else np.ones(3)
    corners = np.array([[x, y, z] for z in (-1.0, 1.0) for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    if flat:
        corners = corners[[0, 2, 4, 6]]
    arms = 0.0 if freedom in (Freedom.POINT, Freedom.POINT_IN_PLANE) else 1.0
    frame = corners * [3.0, 2.5, 2.0] * inside * generator.uniform(0.8, 1.2, corners.shape)
    # Crossed: the upper cables end low on the platform.
    placed = arms * corners * [0.4, 0.3, -0.5] * inside * generator.uniform(0.7, 1.3, corners.shape)
    return CableRobot(
        frame_anchors=frame,
        platform_anchors=placed,
        freedom=freedom,
        bounds=CableBounds.of(len(frame), **({"tension_min": 3.0} | bounds)),
    )


def loads(*masses: float) -> list[Load]:
    return [
        Load(title="", body=RigidBody(mass=mass), force_lower=np.full(3, -2.0), force_upper=np.full(3, 2.0))
        for mass in masses
    ]


def demand_of(
    robot: CableRobot, motion: MotionSet = MOTION, masses: tuple[float, ...] = (4.0,), count: int = 40
) -> Demand:
    flat = robot.freedom in (Freedom.PLANAR, Freedom.POINT_IN_PLANE)
    positions = np.random.default_rng(21).uniform(-1.3, 1.3, (count, 3)) * ([1.0, 0.0, 1.0] if flat else 1.0)
    wrenches = [[platform_wrench([], GRAVITY, np.zeros(3), load) for load in loads(*masses)]]
    return compute_demand(
        robot, positions, np.zeros((1, 3)), wrenches, motion, tension_model=TensionModel.WRENCH_FEASIBLE
    )


def least_level(columns: np.ndarray, wrench: np.ndarray, tension_min: float) -> tuple[float, np.ndarray]:
    """Least τ with tensions from tension_min to τ that exert the wrench, and its derivative with respect to it."""
    rows, count = columns.shape
    solved = linprog(
        np.append(np.zeros(count), 1.0),
        np.hstack([np.eye(count), -np.ones((count, 1))]),
        np.zeros(count),
        np.hstack([columns, np.zeros((rows, 1))]),
        wrench,
        bounds=[(tension_min, None)] * count + [(tension_min, None)],
        method="highs",
    )
    return (float(solved.fun), solved.eqlin.marginals) if solved.status == 0 else (np.inf, np.zeros(rows))


def can_hold(columns: np.ndarray, wrench: np.ndarray, tension_min: float, tension_max: float) -> bool:
    bounds = [(tension_min, tension_max)] * columns.shape[1]
    return bool(
        linprog(np.zeros(columns.shape[1]), A_eq=columns, b_eq=wrench, bounds=bounds, method="highs").status == 0
    )


@pytest.mark.parametrize("freedom", FREEDOMS)
@pytest.mark.parametrize("shape", list(SetShape))
def test_under_the_minimax_tension_every_acceleration_is_held_and_below_it_some_is_not(
    freedom: Freedom, shape: SetShape
) -> None:
    robot = a_robot(freedom, seed=1)
    demand = demand_of(robot, replace(MOTION, acceleration_shape=shape), count=12)
    generator = np.random.default_rng(6)
    rows = list(robot.wrench_rows)
    forces = np.eye(6)[rows][:, :3]
    free = forces.any(axis=0)
    tried = 0
    for pose in np.flatnonzero(demand.attainable)[:4]:
        columns = structure(robot.frame_anchors, demand.positions[pose], robot.platform_anchors)[rows]
        level = demand.force[pose, 0]
        worst, worst_wrench = 0.0, np.zeros(len(rows))
        for start in generator.normal(size=(12, 3)):
            direction, reached = start * free, -np.inf
            while True:  # convex in the wrench: along the derivative to the border of the set
                if shape is SetShape.BALL:
                    acceleration = ACCELERATION * direction / np.linalg.norm(direction)
                else:
                    acceleration = ACCELERATION * np.sign(direction)
                external = 2.0 * np.sign(direction)
                wrench = forces @ (4.0 * acceleration + external + [0.0, 0.0, 4.0 * GRAVITY])
                assert can_hold(columns, wrench, 3.0, level * (1.0 + EDGE))
                found, slope = least_level(columns, wrench, 3.0)
                if found > worst:
                    worst, worst_wrench = found, wrench
                if found <= reached + 1e-9 or not np.any(slope):
                    break
                reached, direction = found, forces.T @ slope
        assert worst == pytest.approx(level, rel=1e-7)
        if level > 3.0 * (1.0 + EDGE):
            assert not can_hold(columns, worst_wrench, 3.0, level * (1.0 - EDGE))
            tried += 1
    assert tried > 0


def actuators_for(demand: Demand, count: int, seed: int = 1) -> ActuatorSet:
    """Random ones, whose every limit is the demand of a random pose times about 1."""
    generator = np.random.default_rng(seed)

    def spread(low: float, high: float) -> np.ndarray:
        return np.exp(generator.uniform(np.log(low), np.log(high), count))

    held = demand.force[demand.attainable].max(axis=1)
    constant, ratio, radius, efficiency = spread(0.03, 0.1), spread(10.0, 30.0), spread(0.03, 0.1), spread(0.5, 0.9)
    force = generator.choice(held, count) * spread(0.9, 1.6)
    resistance = spread(0.3, 3.0)
    torque = force * radius / (ratio * efficiency)
    return ActuatorSet(
        motor_speed=generator.choice(demand.speed.max(axis=1), count) * spread(0.9, 1.5) * ratio / radius,
        motor_torque=torque,
        voltage=(torque / constant * resistance + constant * SPEED * ratio / radius) * spread(0.8, 1.4),
        back_emf_constant=constant,
        torque_constant=constant,
        resistance=resistance,
        friction=spread(1e-7, 1e-5),
        rotor_inertia=spread(1e-6, 1e-4),
        ratio=ratio,
        efficiency=efficiency,
        drum_radius=radius,
    )


def scalar_verdicts(demand: Demand, actuators: ActuatorSet, index: int, tension_min: float) -> dict[str, list[bool]]:
    """The safe rule at every pose, cable by cable, from the design's definitions."""
    ratio, radius = actuators.ratio[index], actuators.drum_radius[index]
    torque_ratio = ratio * actuators.efficiency[index]  # N_M
    inertia = actuators.rotor_inertia[index] * ratio * torque_ratio  # J_r
    gain = actuators.resistance[index] / (actuators.torque_constant[index] * torque_ratio)  # S
    damping = actuators.friction[index] * ratio * torque_ratio * gain + actuators.back_emf_constant[index] * ratio  # L
    alpha, beta = inertia / radius**2, damping / (gain * radius**2)
    by_torque, by_voltage = (
        actuators.motor_torque[index] * torque_ratio / radius,
        actuators.voltage[index] / (gain * radius),
    )
    verdicts: dict[str, list[bool]] = {check.value: [] for check in Check}
    for pose in range(len(demand.force)):
        holds = dict.fromkeys(verdicts, True)
        level = demand.force[pose, 0]
        for length in demand.lengths[pose]:
            # The ball of velocities: winding at σ, the rest of the speed swings the cable; and a straight pull of A.
            holds["speed"] &= ratio * SPEED / radius <= actuators.motor_speed[index]
            holds["torque"] &= level <= by_torque
            swing = SPEED**2 / length
            holds["acceleration"] &= level + alpha * ACCELERATION <= by_torque
            holds["acceleration"] &= alpha * (ACCELERATION + swing) - tension_min <= by_torque
            holds["voltage"] &= level + alpha * ACCELERATION + beta * SPEED <= by_voltage
            winding = [0.0, SPEED, min(SPEED, beta * length / (2.0 * alpha))]
            out = max(beta * rate + alpha * (SPEED**2 - rate**2) / length for rate in winding)
            holds["voltage"] &= out + alpha * ACCELERATION - tension_min <= by_voltage
        for check, held in holds.items():
            verdicts[check].append(bool(held))
    return verdicts


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_counts_are_those_of_a_scalar_loop_over_poses_and_cables(
    freedom: Freedom, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = a_robot(freedom, seed=3)
    demand = demand_of(robot)
    actuators = actuators_for(demand, 60)
    evaluation = evaluate_actuators(demand, actuators, list(Check))
    deciding = set()
    for index in range(60):
        verdicts = scalar_verdicts(demand, actuators, index, 3.0)
        for check in Check:
            assert evaluation.checks[check].positions[index] == sum(verdicts[check.value])
            if 0 < sum(verdicts[check.value]) < int(demand.attainable.sum()):
                deciding.add(check)
        together = np.all([*verdicts.values(), demand.attainable], axis=0)
        assert evaluation.positions[index] == together.sum()
    assert deciding >= {Check.TORQUE, Check.ACCELERATION, Check.VOLTAGE}  # of a ball every cable's speed is alike
    pytest.importorskip("numba")
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    compiled = evaluate_actuators(demand, actuators, list(Check))
    assert compiled.positions.tolist() == evaluation.positions.tolist()
    for check in Check:
        assert compiled.checks[check].positions.tolist() == evaluation.checks[check].positions.tolist()
        assert compiled.checks[check].worst_utilisation == pytest.approx(
            evaluation.checks[check].worst_utilisation, rel=1e-12
        )


@pytest.mark.parametrize("figure", ["motor_speed", "motor_torque", "voltage"])
def test_a_larger_limit_never_shrinks_a_workspace(figure: str) -> None:
    demand = demand_of(a_robot(Freedom.SPATIAL, seed=5))
    actuators = actuators_for(demand, 40)
    stronger = replace(actuators, **{figure: getattr(actuators, figure) * 1.3})
    before, after = (evaluate_actuators(demand, one, list(Check)) for one in (actuators, stronger))
    assert (after.positions >= before.positions).all()
    assert (after.positions > before.positions).any()
    for check in Check:
        assert (after.checks[check].positions >= before.checks[check].positions).all()


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_smaller_sets_of_motions_are_served_at_no_fewer_positions(freedom: Freedom) -> None:
    robot = a_robot(freedom, seed=7)
    spin = 0.6 if robot.turning_axes else 0.0
    ball = replace(MOTION, angular_speed=spin, angular_acceleration=spin / RAMP)
    chain = [
        replace(ball, kind=MotionKind.STRAIGHT),
        ball,
        replace(ball, acceleration_shape=SetShape.BOX),
        replace(ball, acceleration_shape=SetShape.BOX, velocity_shape=SetShape.BOX),
    ]
    demands = [demand_of(robot, motion) for motion in chain]
    actuators = actuators_for(demands[1], 40)
    counts = [evaluate_actuators(demand, actuators, list(Check)).positions for demand in demands]
    for less, more, many, few in zip(demands, demands[1:], counts, counts[1:], strict=False):
        assert (less.force <= more.force * (1.0 + ROUNDING)).all()
        assert (many >= few).all()
    assert (counts[1] > counts[3]).any()


def test_another_load_never_enlarges_a_workspace() -> None:
    robot = a_robot(Freedom.SPATIAL, seed=9)
    full, both = demand_of(robot, masses=(6.0,)), demand_of(robot, masses=(6.0, 1.0))
    empty = demand_of(robot, masses=(1.0,))
    actuators = actuators_for(full, 40)
    one, other, together = (evaluate_actuators(each, actuators, list(Check)).positions for each in (full, empty, both))
    assert (together <= np.minimum(one, other)).all()
    assert both.by_position(both.force).max(axis=1) == pytest.approx(np.maximum(full.force, empty.force)[:, 0])
    assert np.array_equal(both.attainable_positions, full.attainable_positions & empty.attainable_positions)


@pytest.mark.parametrize("freedom", FREEDOMS)
def test_positions_that_a_cable_cannot_reach_are_served_by_nobody(freedom: Freedom) -> None:
    robot = a_robot(freedom, seed=11)
    free = demand_of(robot)
    reach = float(np.median(free.lengths.max(axis=1)))
    short = demand_of(replace(robot, bounds=replace(robot.bounds, length_max=np.full(robot.cables, reach))))
    beyond = (free.lengths > reach).any(axis=1)
    assert np.array_equal(short.unreachable, beyond)
    mighty = replace(
        actuators_for(free, 1),
        motor_speed=np.array([np.inf]),
        motor_torque=np.array([np.inf]),
        voltage=np.array([np.inf]),
    )
    served = evaluate_actuators(short, mighty, list(Check)).positions
    assert served.tolist() == [int((free.attainable & ~beyond).sum())]
    assert 0 < served[0] < free.attainable.sum()
