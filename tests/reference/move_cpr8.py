"""The simulated move of section 3.1.3 in [1] of scalar_cpr8, one instant at a time in plain floats."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from tests.reference.scalar_cpr8 import (
    Actuator,
    Case,
    Vector,
    bend_of,
    dot,
    half_diagonal,
    pose_at,
    tensions_at,
)


@dataclass(frozen=True, slots=True)
class Instant:
    """One time of a simulated move; lists of eight shafts behind the gearbox, in SI units."""

    time: float
    position: Vector
    speeds: list[float]
    accelerations: list[float]
    torques: list[float]
    voltages: list[float]


def top_edge(case: Case) -> tuple[Vector, Vector]:
    margin = half_diagonal(case)
    return (margin, margin, -margin), (case.frame[0] - margin, margin, -margin)


def _trapezoid(case: Case, distance: float, steps: int) -> Iterator[tuple[float, float, float, float]]:
    """Time, path length, speed and acceleration; both one-sided accelerations at the two corners of the profile."""
    top, rise, fall = case.speed, case.acceleration_time, case.deceleration_time
    ramps = top * (rise + fall) / 2.0
    if distance < ramps:
        raise ValueError(f"a move of {distance} m ends before the speed is reached: the ramps alone take {ramps} m")
    cruise = (distance - ramps) / top
    phases = ((rise, 0.0, top / rise), (cruise, top, 0.0), (fall, top, -top / fall))
    began, covered = 0.0, 0.0
    for duration, speed, acceleration in phases:
        for step in range(steps + 1):
            t = duration * step / steps
            path = covered + speed * t + acceleration * t * t / 2.0
            yield began + t, path, speed + acceleration * t, acceleration
        began += duration
        covered += speed * duration + acceleration * duration * duration / 2.0


def simulate(case: Case, actuator: Actuator, start: Vector, end: Vector, steps: int = 1000) -> list[Instant]:
    """A straight move at constant orientation with `steps` intervals in each phase of its trapezoidal speed.

    The torque peaks between two instants, so a coarse move understates it: by 5e-6 N m at 200 steps, 3e-7 at 1000.
    """
    distance = math.dist(start, end)
    way = tuple((b - a) / distance for a, b in zip(start, end, strict=True))
    radius = actuator.radius_m
    instants = []
    for time, path, speed, rise in _trapezoid(case, distance, steps):
        position, velocity, acceleration = (
            (start[0] + path * way[0], start[1] + path * way[1], start[2] + path * way[2]),
            (speed * way[0], speed * way[1], speed * way[2]),
            (rise * way[0], rise * way[1], rise * way[2]),
        )
        pose = pose_at(case, position)
        speeds = [dot(u, velocity) / radius for u in pose.directions]
        accelerations = [
            (dot(u, acceleration) + bend_of(case, turn * radius, speed * speed, length)) / radius
            for u, length, turn in zip(pose.directions, pose.lengths, speeds, strict=True)
        ]
        torques = [tension * radius for tension in tensions_at(case, pose, acceleration)]
        voltages = [
            actuator.inertial * turning + actuator.damping * turn + actuator.geometric * torque  # eq. 21
            for turning, turn, torque in zip(accelerations, speeds, torques, strict=True)
        ]
        instants.append(Instant(time, position, speeds, accelerations, torques, voltages))
    return instants
