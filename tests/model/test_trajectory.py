"""Straight moves: the speed profile, and what it asks of a drive."""

import numpy as np
import pytest

from actuator_select.model.actuation import Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.dynamics import required_wrench
from actuator_select.model.exceedance import exceedances, peaks, with_peaks
from actuator_select.model.families import cpr8
from actuator_select.model.kinematics import cable_geometry, least_cable_lengths
from actuator_select.model.robot import CableRobot
from actuator_select.model.tension import TensionModel
from actuator_select.model.trajectory import (
    DriveHistory,
    DrivenMove,
    LineMove,
    TorqueTest,
    TrapezoidalProfile,
    instants,
    torque_test,
    trapezoidal_profile,
)

ROBOT = cpr8(np.array([3.2, 2.2, 2.2]), np.array([0.224, 0.154, 0.140]))
WRENCH = required_wrench(2.0, 9.81)
PUBLISHED = TensionModel.PSEUDO_INVERSE


def actuator(**changed: float) -> ActuatorSet:
    figures = {
        "motor_speed": 500.0,
        "motor_torque": 0.6,
        "voltage": 48.0,
        "back_emf_constant": 0.095,
        "torque_constant": 0.095,
        "resistance": 0.369,
        "friction": 0.0,
        "rotor_inertia": 3.579e-4,
        "ratio": 30.0,
        "efficiency": 0.6,
        "drum_radius": 0.08,
    }
    return ActuatorSet.from_figures([figures | changed])


def line_move(profile: TrapezoidalProfile | None = None) -> LineMove:
    start, stop = np.array([0.3, 0.4, -1.8]), np.array([2.6, 1.5, -0.4])
    return LineMove(
        start=start,
        stop=stop,
        orientation=np.array([0.2, -0.1, 0.3]),
        profile=profile or trapezoidal_profile(float(np.linalg.norm(stop - start)), 1.3, 0.8, 1.1),
        centripetal=True,
    )


def driven(
    drive: ActuatorSet, move: LineMove | None = None, robot: CableRobot = ROBOT, model: TensionModel = PUBLISHED
) -> DrivenMove:
    return DrivenMove(
        robot=robot,
        wrench=WRENCH,
        tension_model=model,
        move=move or line_move(),
        actuator=drive,
        torque_test=torque_test(model),
    )


def history(drive: ActuatorSet, per_phase: int = 401) -> tuple[LineMove, DriveHistory]:
    move = line_move()
    return move, driven(drive, move).history(*instants(move.profile, per_phase))


def test_a_long_move_cruises_at_the_greatest_speed() -> None:
    profile = trapezoidal_profile(3.0, 1.5, 0.5, 1.0)
    assert profile.speed == 1.5
    assert profile.corners.tolist() == pytest.approx([0.0, 0.5, 1.75, 2.75])


def test_a_short_move_is_a_triangle_that_keeps_the_accelerations() -> None:
    profile = trapezoidal_profile(0.1, 1.5, 0.5, 1.0)
    assert (profile.acceleration, profile.deceleration) == (3.0, 1.5)
    assert profile.speed < 1.5
    start, ramp, brake, stop = profile.corners
    assert ramp == pytest.approx(brake)
    assert profile.speed * (stop - start) / 2.0 == pytest.approx(0.1)


@pytest.mark.parametrize("distance", [0.1, 0.8, 5.0])
def test_way_and_speed_are_continuous_over_the_corners_and_cover_the_distance(distance: float) -> None:
    profile = trapezoidal_profile(distance, 1.3, 0.7, 0.4)
    corners = profile.corners
    for phase in (0, 1):
        here = profile.motion(corners[phase + 1 : phase + 2], phase)
        there = profile.motion(corners[phase + 1 : phase + 2], phase + 1)
        assert here[0] == pytest.approx(there[0])
        assert here[1] == pytest.approx(there[1])
    way, speed, _ = profile.motion(corners[3:], 2)
    assert way[0] == pytest.approx(distance)
    assert speed[0] == pytest.approx(0.0, abs=1e-12)


def test_derivatives_are_exact() -> None:
    _, run = history(actuator(), per_phase=20001)
    for phase in range(3):
        inside = run.phases == phase
        step = np.diff(run.times[inside])[0]
        speed = run.speed[inside]
        differenced = (speed[2:] - speed[:-2]) / (2.0 * step)
        assert differenced == pytest.approx(run.acceleration[inside][1:-1], abs=1e-5)


def test_every_corner_is_looked_at_from_both_sides() -> None:
    move, run = history(actuator())
    for corner in move.profile.corners[1:3]:
        at = np.flatnonzero(run.times == corner)
        assert len(at) == 2
        assert not np.allclose(run.acceleration[at[0]], run.acceleration[at[1]], rtol=0.01)


def test_power_is_equal_on_both_sides_of_a_lossless_drive() -> None:
    # Without friction, inertia and losses the motor's back-EMF power is the shaft's mechanical power.
    drive = actuator(efficiency=1.0, rotor_inertia=0.0)
    _, run = history(drive)
    current = run.torque / (0.095 * 30.0)
    electrical = run.voltage * current - 0.369 * current**2
    assert electrical == pytest.approx(run.torque * run.speed, rel=1e-9, abs=1e-12)


def test_tensions_do_the_work_that_the_load_receives() -> None:
    move, run = history(actuator())
    way, speed, acceleration = (np.empty_like(run.times) for _ in range(3))
    for phase in range(3):
        inside = run.phases == phase
        way[inside], speed[inside], acceleration[inside] = move.profile.motion(run.times[inside], phase)
    line = (move.stop - move.start) / move.profile.distance
    cable_power = (run.tension * run.speed * 0.08).sum(axis=1)
    load_power = 2.0 * speed * (acceleration + 9.81 * line[2])
    assert cable_power == pytest.approx(load_power, abs=1e-9)


def test_without_the_centripetal_term_only_accelerations_and_voltages_change() -> None:
    move, run = history(actuator())
    flat = LineMove(
        start=move.start, stop=move.stop, orientation=move.orientation, profile=move.profile, centripetal=False
    )
    other = driven(actuator(), flat).history(run.times, run.phases)
    assert np.array_equal(other.torque, run.torque)
    assert np.array_equal(other.speed, run.speed)
    assert (other.acceleration >= run.acceleration).all()
    assert (other.acceleration > run.acceleration + 0.1).any()


def test_peaks_are_found_between_coarse_instants() -> None:
    coarse = driven(actuator()).history(*instants(line_move().profile, 9))
    dense = driven(actuator()).history(*instants(line_move().profile, 40001))
    closer = with_peaks(driven(actuator()), coarse)
    for check in Check:
        height, when = peaks(closer, check)
        expected, at = peaks(dense, check)
        assert height == pytest.approx(expected, rel=1e-7)
        assert when == pytest.approx(at, abs=2e-3)


def test_a_limit_just_below_a_peak_is_exceeded_at_the_peak() -> None:
    plain = driven(actuator())
    coarse = plain.history(*instants(plain.move.profile, 21))
    top, when = peaks(with_peaks(plain, coarse), Check.VOLTAGE)
    between = np.flatnonzero(top > np.abs(coarse.voltage).max(axis=0) * (1.0 + 1e-7))
    cable = int(between[top[between].argmax()])
    weak = driven(actuator(voltage=float(top[cable] * (1.0 - 1e-9))))
    found = [
        one
        for one in exceedances(weak, with_peaks(weak, coarse))
        if one.check is Check.VOLTAGE and one.actuator == cable + 1
    ]
    assert len(found) == 1
    assert found[0].worst == pytest.approx(top[cable], rel=1e-12)
    assert found[0].start < when[cable] < found[0].stop
    assert found[0].stop - found[0].start < 0.01


def test_an_exceedance_begins_and_ends_where_the_curve_crosses_the_limit() -> None:
    weak = driven(actuator(motor_torque=0.5))
    found = exceedances(weak, with_peaks(weak, weak.history(*instants(weak.move.profile, 101))))
    inner = [one for one in found if one.check is Check.TORQUE]
    assert inner
    corners = weak.move.profile.corners
    for one in inner:
        for time in (one.start, one.stop):
            if np.abs(corners - time).min() > 1e-6:
                phase = int(np.searchsorted(corners, time)) - 1
                here = weak.history(np.array([time]), np.array([phase]))
                assert np.abs(here.torque[0, one.actuator - 1]) == pytest.approx(one.limit, rel=1e-6)


def test_the_least_length_of_a_cable_over_a_move_is_that_of_the_nearest_instant() -> None:
    dense = driven(actuator())
    way = np.linspace(0.0, 1.0, 20001)[:, None]
    positions = dense.move.start + way * (dense.move.stop - dense.move.start)
    lengths = cable_geometry(ROBOT, positions, dense.move.orientation).lengths
    least = least_cable_lengths(ROBOT, dense.move.start, dense.move.stop, dense.move.orientation)
    assert least == pytest.approx(lengths.min(axis=0), abs=1e-7)


def test_flat_histories_do_not_count_as_thousands_of_maxima() -> None:
    # Eight vertical cables and a vertical move: every speed and tension is flat but for rounding.
    anchors = np.array([[x, y, 0.0] for x in (0.0, 2.0) for y in (0.0, 0.1, 1.5, 1.6)])
    robot = CableRobot(frame_anchors=anchors + np.array([1.0, 0.0, 3.0]), platform_anchors=anchors)
    start, stop = np.array([1.0, 0.0, 2.3]), np.array([1.0, 0.0, 0.4])
    move = LineMove(
        start=start,
        stop=stop,
        orientation=np.zeros(3),
        profile=trapezoidal_profile(1.9, 0.3, 1.0, 1.0),
        centripetal=True,
    )
    hoist = driven(actuator(), move, robot)
    coarse = hoist.history(*instants(move.profile, 401))
    assert len(with_peaks(hoist, coarse).times) < 4 * len(coarse.times)


HEAVY_ROTOR = 1.0e-4  # kg m²; its torque is of the size of the load's


def test_where_tensions_are_bounded_the_torque_test_is_of_load_and_rotor_together() -> None:
    drive = actuator(rotor_inertia=HEAVY_ROTOR)
    plain = driven(drive, model=TensionModel.FORCE_ONLY)
    assert plain.torque_test is TorqueTest.LOAD_AND_ROTOR
    run = plain.history(*instants(plain.move.profile, 51))
    held = ~run.infeasible
    rotor = HEAVY_ROTOR * 30.0**2 * 0.6 * run.acceleration  # J_M N_V N_M φ̈
    assert held.any()
    assert run.of(Check.TORQUE)[held] == pytest.approx((run.tension * 0.08 + rotor)[held], rel=1e-12)
    assert driven(drive).torque_test is TorqueTest.LOAD
    published = driven(drive).history(run.times, run.phases)
    assert published.of(Check.TORQUE) == pytest.approx(published.tension * 0.08, rel=1e-12)


@pytest.mark.parametrize("share", [0.5, 1.0 - 1e-7])
def test_a_sum_of_torques_over_the_limit_is_found_though_load_and_rotor_alone_are_below(share: float) -> None:
    drive = actuator(rotor_inertia=HEAVY_ROTOR)
    plain = driven(drive, model=TensionModel.FORCE_ONLY)
    closer = with_peaks(plain, plain.history(*instants(plain.move.profile, 101)))
    alone = float(np.nanmax(np.abs(closer.torque)))
    rotor = float(np.nanmax(np.abs(closer.total_torque - closer.torque)))
    together = float(peaks(closer, Check.TORQUE)[0].max())
    assert together > 1.02 * max(alone, rotor)
    limit = max(alone, rotor) + share * (together - max(alone, rotor))
    weak = driven(actuator(rotor_inertia=HEAVY_ROTOR, motor_torque=limit / (30.0 * 0.6)), model=TensionModel.FORCE_ONLY)
    found = [one for one in exceedances(weak, closer) if one.check is Check.TORQUE]
    assert found
    assert max(one.worst for one in found) == pytest.approx(together, rel=1e-9)
    assert all(one.limit == pytest.approx(limit) for one in found)
    assert not [one for one in exceedances(weak, closer) if one.check is Check.ACCELERATION]
