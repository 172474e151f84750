"""Baseline and oracle: the paper's loops as they stand, one pose, one motion, one cable at a time.

Written from Filipović & Kevac 2018, doi:10.22190/FUACR1802071F, with plain floats; NumPy only for the pseudo-inverse,
once per pose. Winding in is positive, F = m (a - gravity vector).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import cos, sin, sqrt

import numpy as np


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """The study of section 3.1. Lengths in m, mass in kg, angles in rad."""

    frame: tuple[float, float, float] = (3.2, 2.2, 2.2)
    carrier: tuple[float, float, float] = (0.224, 0.154, 0.140)
    mass: float = 2.0
    gravity: float = 9.81
    speed: float = 1.3
    time: float = 1.82
    intervals: int = 6
    levels: tuple[float, ...] = (-1.0, 1.0)
    points: int = 6
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0)
    centripetal: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """One column of Table 1, in its units."""

    voltage: float
    rpm: float
    torque: float
    back_emf: float
    torque_constant: float
    resistance: float
    inertia_g_cm2: float
    ratio: float
    efficiency: float
    radius: float = 0.08


TABLE_1 = tuple(
    Drive(
        voltage=row[0],
        rpm=row[1],
        torque=row[2],
        back_emf=row[3],
        torque_constant=row[4],
        resistance=row[5],
        inertia_g_cm2=row[6],
        ratio=row[7],
        efficiency=row[8],
    )
    for row in (
        (48.0, 4700.0, 0.6, 0.0945, 0.095, 0.369, 3579.0, 30.0, 0.6),
        (48.0, 3970.0, 0.319, 0.1145, 0.114, 1.1, 1210.0, 25.0, 0.7),
        (24.0, 4500.0, 0.131, 0.0356, 0.0357, 0.567, 181.0, 26.0, 0.7),
        (24.0, 5060.0, 0.212, 0.0352, 0.0352, 3.99, 45.3, 30.0, 0.7),
        (18.0, 4777.0, 0.03, 0.029, 0.0299, 3.01, 9.26, 26.0, 0.7),
    )
)


def positions(case: Case) -> Iterator[tuple[float, float, float]]:
    """Grid over the reduced geometric workspace, both ends included."""
    margin = sqrt(sum(length**2 for length in case.carrier)) / 2.0
    steps = [index / (case.points - 1) for index in range(case.points)]
    d, s, v = case.frame
    for i, j, k in product(steps, steps, steps):
        yield (
            margin + i * (d - 2.0 * margin),
            margin + j * (s - 2.0 * margin),
            margin - v + k * (v - 2.0 * margin),
        )


def cables(case: Case, position: tuple[float, float, float]) -> list[tuple[list[float], list[float], float]]:
    """Unit vector to the frame, arm R b, length, for each cable; eqs. 1-17."""
    psi, theta, phi = case.angles
    cf, sf, ct, st, cp, sp = cos(phi), sin(phi), cos(theta), sin(theta), cos(psi), sin(psi)
    rotation = (
        (cf * ct, cf * st * sp - sf * cp, cf * st * cp + sf * sp),
        (sf * ct, sf * st * sp + cf * cp, sf * st * cp - cf * sp),
        (-st, ct * sp, ct * cp),
    )
    d, s, _ = case.frame
    length, width, height = case.carrier
    found = []
    for level in (0, 1):
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corner = ((x - 0.5) * length, (y - 0.5) * width, (0.5 - level) * height)
            arm = [sum(rotation[row][column] * corner[column] for column in range(3)) for row in range(3)]
            anchor = (x * d, y * s, -level * height)
            rope = [anchor[axis] - position[axis] - arm[axis] for axis in range(3)]
            reach = sqrt(sum(part**2 for part in rope))
            found.append(([part / reach for part in rope], arm, reach))
    return found


def motions(case: Case) -> tuple[list[tuple[float, ...]], list[tuple[float, ...]]]:
    """Sampled velocities, eqs. 23-26, and accelerations, eqs. 27-29."""
    axis = [-case.speed + 2.0 * case.speed * index / case.intervals for index in range(case.intervals + 1)]
    limit = case.speed * (1.0 + 1e-9)
    velocities = [v for v in product(axis, axis, axis) if sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2) <= limit]
    levels = [level * case.speed / case.time for level in case.levels]
    return velocities, list(product(levels, levels, levels))


def passes(case: Case, drive: Drive, position: tuple[float, float, float], checks: frozenset[str]) -> bool:
    """Whether every motion keeps every limit at this pose; eqs. 18-34."""
    ropes = cables(case, position)
    matrix = np.array(
        [[*u, r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]] for u, r, _ in ropes]
    ).T
    inverse = np.linalg.pinv(matrix, rcond=1e-9).tolist()
    gear_torque = drive.ratio * drive.efficiency
    inertia = drive.inertia_g_cm2 * 1e-7 * drive.ratio * gear_torque
    load_gain = drive.resistance / (drive.torque_constant * gear_torque)
    inertia_gain, damping_gain = inertia * load_gain, drive.back_emf * drive.ratio
    speed_limit, torque_limit = drive.rpm / (9.5493 * drive.ratio), drive.torque * gear_torque
    acceleration_limit = torque_limit / inertia
    velocities, accelerations = motions(case)
    for v in velocities:
        square = v[0] ** 2 + v[1] ** 2 + v[2] ** 2
        for a in accelerations:
            force = (case.mass * a[0], case.mass * a[1], case.mass * (a[2] + case.gravity))
            for cable, (u, _, reach) in enumerate(ropes):
                rate = u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
                winding = u[0] * a[0] + u[1] * a[1] + u[2] * a[2]
                if case.centripetal:
                    winding -= (square - rate**2) / reach
                row = inverse[cable]
                torque = drive.radius * (row[0] * force[0] + row[1] * force[1] + row[2] * force[2])
                speed, acceleration = rate / drive.radius, winding / drive.radius
                if "speed" in checks and abs(speed) > speed_limit:
                    return False
                if "torque" in checks and abs(torque) > torque_limit:
                    return False
                if "acceleration" in checks and abs(acceleration) > acceleration_limit:
                    return False
                if "voltage" in checks:
                    voltage = inertia_gain * acceleration + damping_gain * speed + load_gain * torque
                    if abs(voltage) > drive.voltage:
                        return False
    return True
