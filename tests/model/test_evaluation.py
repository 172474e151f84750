"""Actuators held against a demand."""

import sys
from dataclasses import fields, replace

import numpy as np
import pytest

from actuator_select.model import voltage, voltage_count
from actuator_select.model.actuation import Check, voltage_line
from actuator_select.model.arrays import FloatArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, compute_demand
from actuator_select.model.dynamics import required_wrench
from actuator_select.model.evaluation import evaluate_actuators, missing_figures, position_utilisation
from actuator_select.model.families import cpr8, cpr8_region
from actuator_select.model.kinematics import position_grid
from actuator_select.model.motion import MotionSet, independent_motion, sampled_motion
from actuator_select.model.robot import CableRobot, Freedom
from actuator_select.model.tension import TensionModel
from actuator_select.model.voltage import voltage_demand

FRAME, CARRIER = np.array([3.2, 2.2, 2.2]), np.array([0.224, 0.154, 0.140])
MOTION = independent_motion(1.3, 1.82, 1.2, centripetal=True)
SAMPLED = sampled_motion(1.3, 1.82, 1.2, velocity_intervals=5, acceleration_levels=(-1.0, 0.5), centripetal=False)
SAMPLED_CENTRIPETAL = replace(SAMPLED, centripetal=True)


def demand_of(motion: MotionSet = MOTION, orientation: float = 0.5, points: int = 4, mass: float = 2.0) -> Demand:
    return compute_demand(
        cpr8(FRAME, CARRIER),
        position_grid(cpr8_region(FRAME, CARRIER), (points, points, points)),
        np.array([[0.0, 0.0, 0.0], [orientation, 0.0, orientation]]),
        [[required_wrench(mass, 9.81)]] * 2,
        motion,
    )


def synthetic_actuators(count: int, seed: int = 3) -> ActuatorSet:
    generator = np.random.default_rng(seed)

    def spread(low: float, high: float) -> FloatArray:
        return np.exp(generator.uniform(np.log(low), np.log(high), count))

    constant = spread(0.02, 0.12)
    return ActuatorSet(
        motor_speed=spread(200.0, 700.0),
        motor_torque=spread(0.2, 3.0),
        voltage=spread(15.0, 60.0),
        back_emf_constant=constant,
        torque_constant=constant * spread(0.95, 1.05),
        resistance=spread(0.3, 4.0),
        friction=spread(1e-7, 1e-5),
        rotor_inertia=spread(1e-7, 3e-4),
        ratio=spread(15.0, 35.0),
        efficiency=spread(0.5, 0.9),
        drum_radius=spread(0.05, 0.1),
    )


@pytest.mark.parametrize(
    "motion", [MOTION, replace(MOTION, centripetal=False), SAMPLED], ids=["ball", "flat", "samples"]
)
def test_the_compiled_counter_agrees_with_numpy(motion: MotionSet, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    demand, actuators = demand_of(motion, points=6), synthetic_actuators(60)
    slow = evaluate_actuators(demand, actuators, list(Check))
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    fast = evaluate_actuators(demand, actuators, list(Check))
    counts = slow.checks[Check.VOLTAGE].positions
    assert 0 < np.count_nonzero((counts > 0) & (counts < 216)) < 60  # the case decides something
    assert fast.checks[Check.VOLTAGE].positions.tolist() == counts.tolist()
    assert fast.positions.tolist() == slow.positions.tolist()
    assert fast.checks[Check.VOLTAGE].worst_utilisation == pytest.approx(
        slow.checks[Check.VOLTAGE].worst_utilisation, rel=1e-12
    )


def test_the_compiled_counter_agrees_where_cables_lead_out_of_the_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    frame = np.array([[x, y, z] for x, y, z in ((-3.0, 2.0, 0.0), (3.0, -2.5, 0.0), (-3.0, 1.0, 4.0), (3.0, 3.0, 4.0))])
    demand = compute_demand(
        CableRobot(frame_anchors=frame, platform_anchors=np.zeros((4, 3)), freedom=Freedom.POINT_IN_PLANE),
        position_grid(np.array([[-2.0, 2.0], [0.0, 0.0], [1.0, 3.0]]), (12, 1, 10)),
        np.zeros((1, 3)),
        [[required_wrench(8.0, 9.81)]],
        MOTION,
        tension_model=TensionModel.WRENCH_FEASIBLE,
    )
    assert (voltage_demand(demand).least_swing > 0.0).any()
    actuators = synthetic_actuators(60)
    slow = evaluate_actuators(demand, actuators, list(Check))
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    fast = evaluate_actuators(demand, actuators, list(Check))
    for check in (Check.VOLTAGE, Check.ACCELERATION):
        assert fast.checks[check].positions.tolist() == slow.checks[check].positions.tolist()
        assert len(set(slow.checks[check].positions.tolist())) > 2  # the case decides something
    assert fast.positions.tolist() == slow.positions.tolist()


def test_the_compiled_counter_agrees_for_actuators_that_are_all_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    demand, actuators = demand_of(), synthetic_actuators(1)
    twins = actuators.take([0, 0, 0])
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    fast = evaluate_actuators(demand, twins, [Check.VOLTAGE])
    monkeypatch.undo()
    slow = evaluate_actuators(demand, twins, [Check.VOLTAGE])
    assert fast.positions.tolist() == slow.positions.tolist()


def test_the_compiled_counter_agrees_where_masses_differ_by_rounding(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    # One rotor behind gears and drums of one N/R_w: equal reflected masses, rounded differently; others far away.
    generator = np.random.default_rng(1)
    one = synthetic_actuators(1, seed=1).take([0] * 300)
    scale = np.array([5.0, 10.0, 20.0, 40.0, 7.0, 14.0, 28.0, 3.5, 12.0, 24.0, 13.0, 26.0])[
        generator.integers(12, size=300)
    ]
    inertia = np.full(300, 3e-4)
    inertia[:12], inertia[12:24] = 3e-4 * np.linspace(0.02, 0.9, 12), 3e-4 * np.linspace(1.2, 30.0, 12)
    clustered = replace(
        one,
        ratio=one.ratio * scale / 20.0,
        drum_radius=one.drum_radius * scale / 20.0,
        rotor_inertia=inertia,
        voltage=np.exp(generator.uniform(np.log(10.0), np.log(400.0), 300)),
    )
    masses = np.unique(voltage_line(clustered).reflected_mass)
    assert (np.diff(masses) < 1e-12 * masses[1:]).any()
    demand = demand_of(points=20)
    slow = evaluate_actuators(demand, clustered, [Check.VOLTAGE])
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    fast = evaluate_actuators(demand, clustered, [Check.VOLTAGE])
    assert fast.positions.tolist() == slow.positions.tolist()
    assert fast.checks[Check.VOLTAGE].worst_utilisation == pytest.approx(
        slow.checks[Check.VOLTAGE].worst_utilisation, rel=1e-12
    )


@pytest.mark.parametrize("inertia", [0.0, 1e-12])
def test_the_compiled_counter_agrees_without_inertia(inertia: float, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    actuators = synthetic_actuators(40)
    light = replace(actuators, rotor_inertia=np.where(np.arange(40) % 2, inertia, 0.0))
    demand = demand_of(points=5)
    slow = evaluate_actuators(demand, light, [Check.VOLTAGE])
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    assert evaluate_actuators(demand, light, [Check.VOLTAGE]).positions.tolist() == slow.positions.tolist()


def test_without_a_compiler_numpy_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    demand, actuators = demand_of(), synthetic_actuators(5)
    expected = evaluate_actuators(demand, actuators, [Check.VOLTAGE]).positions.tolist()
    monkeypatch.setattr(voltage_count, "KERNEL_PAYS_FROM", 0)
    monkeypatch.delitem(sys.modules, "actuator_select.model.voltage_kernel", raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    assert evaluate_actuators(demand, actuators, [Check.VOLTAGE]).positions.tolist() == expected


@pytest.mark.parametrize("motion", [MOTION, SAMPLED, SAMPLED_CENTRIPETAL], ids=["ball", "samples", "centripetal"])
def test_the_worst_voltage_is_that_of_the_worst_of_many_motions(motion: MotionSet) -> None:
    demand, actuators = demand_of(motion, points=2), synthetic_actuators(5)
    line = voltage_line(actuators)
    closed = voltage_demand(demand).worst(line)
    assert demand.tensions is not None
    generator = np.random.default_rng(11)
    velocities = motion.velocities
    if not len(velocities):
        directions = generator.normal(size=(4000, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        velocities = directions * motion.speed * generator.uniform(0.0, 1.0, (4000, 1)) ** 0.2
    corners = np.array(np.meshgrid(*zip(motion.acceleration_lower, motion.acceleration_upper, strict=True)))
    accelerations = corners.reshape(3, -1).T
    rate = demand.directions @ velocities.T  # (Q, m, S)
    swing = ((velocities**2).sum(axis=1) - rate**2) / demand.lengths[..., None] if motion.centripetal else 0.0
    largest = np.zeros_like(closed)
    for index, (mass, damping) in enumerate(zip(line.reflected_mass, line.damping, strict=True)):
        moving = damping * rate - mass * swing
        for acceleration in accelerations:
            still = (
                demand.tensions.static
                + demand.tensions.per_acceleration @ acceleration
                + mass * (demand.directions @ acceleration)
            )
            reached = np.abs(still[..., None] + moving).max(axis=(1, 2)).reshape(len(demand.positions), -1).max(axis=1)
            largest[index] = np.maximum(largest[index], reached)
    assert (largest <= closed * (1.0 + 1e-12)).all()
    tight = 0.97 if not len(motion.velocities) else 1.0 - 1e-12  # random directions come close to the ball's worst
    assert (largest >= closed * tight).all()


def test_counts_agree_with_the_utilisation_of_every_position() -> None:
    demand, actuators = demand_of(), synthetic_actuators(20)
    evaluation = evaluate_actuators(demand, actuators, list(Check))
    utilisation = position_utilisation(demand, actuators, list(Check))
    every = np.ones((20, 64), dtype=bool)
    for check in Check:
        holds = utilisation[check] <= 1.0 + 1e-12
        every &= holds
        assert evaluation.checks[check].positions.tolist() == holds.sum(axis=1).tolist()
        assert evaluation.checks[check].worst_utilisation == pytest.approx(utilisation[check].max(axis=1))
        worst = utilisation[check][np.arange(20), evaluation.checks[check].worst_position]
        assert worst == pytest.approx(utilisation[check].max(axis=1))
    assert evaluation.positions.tolist() == every.sum(axis=1).tolist()


def test_counting_in_many_chunks_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    demand, actuators = demand_of(), synthetic_actuators(20)
    whole = evaluate_actuators(demand, actuators, list(Check))
    monkeypatch.setattr("actuator_select.model.evaluation.CELLS_AT_ONCE", 60)
    monkeypatch.setattr(voltage, "CELLS_AT_ONCE", 500)
    chunked = evaluate_actuators(demand, actuators, list(Check))
    assert chunked.positions.tolist() == whole.positions.tolist()
    for check in Check:
        for field in fields(whole.checks[check]):
            assert np.array_equal(getattr(chunked.checks[check], field.name), getattr(whole.checks[check], field.name))


@pytest.mark.parametrize("figure", ["motor_speed", "motor_torque", "voltage"])
def test_a_larger_limit_never_shrinks_a_workspace(figure: str) -> None:
    demand, actuators = demand_of(), synthetic_actuators(30)
    stronger = replace(actuators, **{figure: getattr(actuators, figure) * 1.2})
    before = evaluate_actuators(demand, actuators, list(Check))
    after = evaluate_actuators(demand, stronger, list(Check))
    assert (after.positions >= before.positions).all()
    assert (after.positions > before.positions).any()
    for check in Check:
        assert (after.checks[check].worst_utilisation <= before.checks[check].worst_utilisation).all()


def test_scaling_the_load_and_the_torque_and_the_inertia_changes_nothing() -> None:
    actuators = synthetic_actuators(30)
    # Twice the load, torque, inertia and friction at half the resistance: every voltage and every ratio stays.
    doubled = replace(
        actuators,
        motor_torque=actuators.motor_torque * 2.0,
        rotor_inertia=actuators.rotor_inertia * 2.0,
        friction=actuators.friction * 2.0,
        resistance=actuators.resistance / 2.0,
    )
    one = evaluate_actuators(demand_of(mass=2.0), actuators, list(Check))
    two = evaluate_actuators(demand_of(mass=4.0), doubled, list(Check))
    assert two.positions.tolist() == one.positions.tolist()
    for check in Check:
        assert two.checks[check].worst_utilisation == pytest.approx(one.checks[check].worst_utilisation, rel=1e-9)


def test_turning_the_world_about_the_vertical_leaves_tensions_unchanged() -> None:
    robot = cpr8(FRAME, CARRIER)
    angle = 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    turned = CableRobot(frame_anchors=robot.frame_anchors @ turn.T, platform_anchors=robot.platform_anchors)
    position = np.array([[1.0, 0.8, -1.0]])
    wrench = required_wrench(2.0, 9.81)
    here = compute_demand(robot, position, np.array([[0.1, 0.2, 0.3]]), [[wrench]], MOTION)
    there = compute_demand(turned, position @ turn.T, np.array([[0.1, 0.2, 0.3 + angle]]), [[wrench]], MOTION)
    assert here.tensions is not None
    assert there.tensions is not None
    assert there.tensions.static == pytest.approx(here.tensions.static)
    assert there.lengths == pytest.approx(here.lengths)


def test_an_unknown_figure_is_not_evaluated_and_never_passed() -> None:
    actuators = replace(synthetic_actuators(3), friction=np.array([0.0, np.nan, 0.0]))
    evaluation = evaluate_actuators(demand_of(), actuators, list(Check))
    count = evaluation.checks[Check.VOLTAGE]
    assert count.evaluated.tolist() == [True, False, True]
    assert count.positions[1] == -1
    assert np.isnan(count.worst_utilisation[1])
    assert missing_figures(actuators, Check.VOLTAGE, TensionModel.PSEUDO_INVERSE) == [(), ("friction",), ()]
    assert evaluation.checks[Check.TORQUE].evaluated.all()


def test_an_unlimited_figure_passes_everywhere_and_a_zero_one_nowhere() -> None:
    actuators = replace(synthetic_actuators(2), motor_speed=np.array([np.inf, 0.0]))
    count = evaluate_actuators(demand_of(), actuators, [Check.SPEED]).checks[Check.SPEED]
    assert count.positions.tolist() == [64, 0]
    assert count.worst_utilisation.tolist() == [0.0, np.inf]


def test_a_position_has_to_hold_at_every_orientation() -> None:
    robot, wrench = cpr8(FRAME, CARRIER), required_wrench(2.0, 9.81)
    positions = position_grid(cpr8_region(FRAME, CARRIER), (5, 5, 5))
    orientations = np.array([[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]])
    actuators = synthetic_actuators(10)
    holds = [
        np.all(
            [
                values <= 1.0
                for values in position_utilisation(
                    compute_demand(robot, positions, one[None], [[wrench]], MOTION), actuators, list(Check)
                ).values()
            ],
            axis=0,
        )
        for one in orientations
    ]
    both = evaluate_actuators(
        compute_demand(robot, positions, orientations, [[wrench]] * 2, MOTION), actuators, list(Check)
    )
    assert both.positions.tolist() == (holds[0] & holds[1]).sum(axis=1).tolist()


def test_a_pose_at_an_anchor_is_served_by_nobody() -> None:
    robot = CableRobot(frame_anchors=np.eye(3), platform_anchors=np.zeros((3, 3)))
    demand = compute_demand(
        robot, np.array([[1.0, 0.0, 0.0]]), np.zeros((1, 3)), [[required_wrench(1.0, 9.81)]], MOTION
    )
    unlimited = replace(synthetic_actuators(2), voltage=np.array([24.0, np.inf]))
    for check in Check:
        assert evaluate_actuators(demand, unlimited, [check]).positions.tolist() == [0, 0]
    assert evaluate_actuators(demand, unlimited, list(Check)).positions.tolist() == [0, 0]
    worst = evaluate_actuators(demand, unlimited, list(Check)).checks[Check.VOLTAGE].worst_utilisation
    assert worst.tolist() == [np.inf, np.inf]
