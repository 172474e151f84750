"""Baseline: the paper's loops as they stand, every combination of velocity and acceleration, cable by cable."""

from tests.reference.scalar_cpr8 import (
    Actuator,
    Case,
    Vector,
    acceleration_samples,
    bend_of,
    dot,
    force_at,
    pose_at,
    velocity_samples,
)


def passes(case: Case, actuator: Actuator, position: Vector) -> bool:
    """Whether every combination keeps all four limits at this position; the pseudo-inverse is taken once.

    The first combination that breaks a limit ends the loops; a position that passes costs them all.
    """
    pose = pose_at(case, position)
    radius = actuator.radius_m
    speed_limit, torque_limit = actuator.limit("speed"), actuator.limit("torque")
    acceleration_limit, voltage_limit = actuator.limit("acceleration"), actuator.limit("voltage")
    geometric, damping = actuator.geometric, actuator.damping
    inertia = actuator.geared_inertia * geometric  # G_v in eq. 22
    for velocity in velocity_samples(case):
        square = dot(velocity, velocity)
        for acceleration in acceleration_samples(case):
            force = force_at(case, acceleration)
            for direction, length, pull in zip(pose.directions, pose.lengths, pose.pull, strict=True):
                rate = dot(direction, velocity)
                speed = rate / radius
                winding = (dot(direction, acceleration) + bend_of(case, rate, square, length)) / radius
                torque = radius * dot(pull, force)  # eq. 20
                voltage = inertia * winding + damping * speed + geometric * torque  # eq. 21
                if (
                    abs(speed) > speed_limit
                    or abs(torque) > torque_limit
                    or abs(winding) > acceleration_limit
                    or abs(voltage) > voltage_limit
                ):
                    return False
    return True
