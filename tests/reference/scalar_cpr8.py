"""The loops of the first paper, one pose and one motion sample at a time, in plain floats.

Slow on purpose and independent of the package, which it must not import: the oracle of the fast evaluator, and the
baseline of its benchmarks. "eq. n" is an equation in [1]. Two things differ from the print: winding in is positive
(the paper's cable lengths, and with them its Jacobian, change sign), and eq. 31 is F = m (a - g) with g pointing down,
so that hoisting loads a drive in the direction in which it turns. With accelerations of both signs |M| is the same.

[1] M. Filipović, L. B. Kevac, "A novel methodology for choosing actuators of cable-suspended parallel robots", Facta
    Universitatis, Series: Automatic Control and Robotics 17(2), 71–91, 2018, doi 10.22190/FUACR1802071F
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Literal

import numpy as np

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
Check = Literal["speed", "torque", "acceleration", "voltage"]

CHECKS: tuple[Check, ...] = ("speed", "torque", "acceleration", "voltage")  # eqs. 30, 32, 33, 34
PAPER_CHECKS: tuple[Check, ...] = ("speed", "torque", "acceleration")  # those that bind in Table 2
RANK_TOLERANCE = 1e-9  # relative to the largest singular value
SPEED_TOLERANCE = 1e-9  # relative; keeps samples that rounding puts just outside the ball of eq. 26
RPM_PER_RAD_PER_S = 9.5493  # as printed in eq. 30
KG_M2_PER_G_CM2 = 1e-7


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A robot of the CPR-8 family and its motion; the defaults are section 3.1 of [1], in SI units and radians."""

    frame: Vector = (3.2, 2.2, 2.2)  # d, s, v
    carrier: Vector = (0.224, 0.154, 0.140)  # l, w, h_o
    mass: float = 2.0
    gravity: float = 9.81
    speed: float = 1.3
    acceleration_time: float = 1.82
    deceleration_time: float = 1.82
    grid_points: int = 6  # per axis, both ends included
    orientation: Vector = (0.0, 0.0, 0.0)  # psi, theta, phi
    velocity_intervals: int = 6  # per axis, eqs. 23 to 25
    acceleration_levels: tuple[float, ...] = (-1.0, 1.0)  # per axis, of V / t_dec below zero and V / t_acc above
    centripetal: bool = True  # whether the second derivative of the lengths keeps its velocity term


@dataclass(frozen=True, slots=True, kw_only=True)
class Actuator:
    """One column of Table 1, in the units that it prints."""

    power_w: float
    voltage_v: float
    speed_rpm: float
    torque_nm: float
    back_emf_v_s_per_rad: float
    torque_constant_nm_per_a: float
    friction_nm_s_per_rad: float
    resistance_ohm: float
    inertia_g_cm2: float
    ratio: float
    efficiency: float
    radius_m: float

    @property
    def torque_ratio(self) -> float:
        return self.ratio * self.efficiency

    @property
    def geared_inertia(self) -> float:
        return self.inertia_g_cm2 * KG_M2_PER_G_CM2 * self.ratio * self.torque_ratio

    @property
    def geometric(self) -> float:
        return self.resistance_ohm / (self.torque_constant_nm_per_a * self.torque_ratio)  # S_v in eq. 22

    @property
    def inertial(self) -> float:
        return self.geared_inertia * self.geometric  # G_v in eq. 22

    @property
    def damping(self) -> float:
        friction = self.friction_nm_s_per_rad * self.ratio * self.torque_ratio
        return friction * self.geometric + self.back_emf_v_s_per_rad * self.ratio  # L_v in eq. 22

    def limit(self, check: Check) -> float:
        if check == "speed":
            return self.speed_rpm / (RPM_PER_RAD_PER_S * self.ratio)  # eq. 30
        if check == "torque":
            return self.torque_nm * self.torque_ratio  # eq. 32
        if check == "acceleration":
            return self.torque_nm * self.torque_ratio / self.geared_inertia  # eq. 33
        return self.voltage_v  # eq. 34


def _table_1() -> tuple[Actuator, ...]:
    rows = (
        (300.0, 48.0, 4700.0, 0.6, 0.0945, 0.095, 0.0, 0.369, 3579.0, 30.0, 0.6, 0.08),
        (100.0, 48.0, 3970.0, 0.319, 0.1145, 0.114, 0.0, 1.1, 1210.0, 25.0, 0.7, 0.08),
        (50.0, 24.0, 4500.0, 0.131, 0.0356, 0.0357, 0.0, 0.567, 181.0, 26.0, 0.7, 0.08),
        (20.0, 24.0, 5060.0, 0.212, 0.0352, 0.0352, 0.0, 3.99, 45.3, 30.0, 0.7, 0.08),
        (10.0, 18.0, 4777.0, 0.03, 0.029, 0.0299, 0.0, 3.01, 9.26, 26.0, 0.7, 0.08),
    )
    names = tuple(Actuator.__dataclass_fields__)
    return tuple(Actuator(**dict(zip(names, row, strict=True))) for row in rows)


TABLE_1 = _table_1()


@dataclass(frozen=True, slots=True)
class Pose:
    """What eqs. 1 to 20 give at one position, before any actuator is known."""

    directions: list[Vector]  # of each cable, from carrier to frame
    lengths: list[float]
    jacobian: list[tuple[float, ...]]  # of winding in [m] with respect to x, y, z, psi, theta, phi
    pull: list[tuple[float, ...]]  # pseudo-inverse of the transposed Jacobian; M = R_w pull F


@dataclass(frozen=True, slots=True)
class Samples:
    """The motion samples of a pose, one list of eight cables per velocity or per acceleration."""

    rates: list[list[float]]  # per velocity [m/s]
    bends: list[list[float]]  # per velocity: the centripetal part of the cable acceleration [m/s²]
    hauls: list[list[float]]  # per acceleration: the other part [m/s²]
    tensions: list[list[float]]  # per acceleration [N]


# Geometry, eqs. 1 to 20


def half_diagonal(case: Case) -> float:
    return math.hypot(*case.carrier) / 2.0  # d_e


def _levels(first: float, last: float, count: int) -> list[float]:
    return [first + (last - first) * i / (count - 1) for i in range(count)]


def pose_grid(case: Case) -> list[Vector]:
    margin = half_diagonal(case)
    depth, width, height = case.frame
    n = case.grid_points
    xs = _levels(margin, depth - margin, n)
    ys = _levels(margin, width - margin, n)
    zs = _levels(margin - height, -margin, n)
    return [(x, y, z) for x in xs for y in ys for z in zs]


def _frame_points(case: Case) -> list[Vector]:
    depth, width, _ = case.frame
    corners = ((0.0, 0.0), (depth, 0.0), (depth, width), (0.0, width))  # O, F, G, H
    return [(x, y, z) for z in (0.0, -case.carrier[2]) for x, y in corners]


def _carrier_points(case: Case) -> list[Vector]:
    length, width, height = (side / 2.0 for side in case.carrier)
    corners = ((-length, -width), (length, -width), (length, width), (-length, width))  # A, B, C, D
    return [(x, y, z) for z in (height, -height) for x, y in corners]


def _rotations(orientation: Vector) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Eq. 9 and its derivatives with respect to psi, theta and phi, written out."""
    (s1, s2, s3), (c1, c2, c3) = map(math.sin, orientation), map(math.cos, orientation)
    rotation = (
        (c3 * c2, c3 * s2 * s1 - s3 * c1, c3 * s2 * c1 + s3 * s1),
        (s3 * c2, s3 * s2 * s1 + c3 * c1, s3 * s2 * c1 - c3 * s1),
        (-s2, c2 * s1, c2 * c1),
    )
    by_psi = (
        (0.0, c3 * s2 * c1 + s3 * s1, -c3 * s2 * s1 + s3 * c1),
        (0.0, s3 * s2 * c1 - c3 * s1, -s3 * s2 * s1 - c3 * c1),
        (0.0, c2 * c1, -c2 * s1),
    )
    by_theta = (
        (-c3 * s2, c3 * c2 * s1, c3 * c2 * c1),
        (-s3 * s2, s3 * c2 * s1, s3 * c2 * c1),
        (-c2, -s2 * s1, -s2 * c1),
    )
    by_phi = (
        (-s3 * c2, -s3 * s2 * s1 - c3 * c1, -s3 * s2 * c1 + c3 * s1),
        (c3 * c2, c3 * s2 * s1 - s3 * c1, c3 * s2 * c1 + s3 * s1),
        (0.0, 0.0, 0.0),
    )
    return rotation, by_psi, by_theta, by_phi


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _turned(matrix: Matrix, point: Vector) -> Vector:
    return (dot(matrix[0], point), dot(matrix[1], point), dot(matrix[2], point))


@lru_cache(maxsize=16)
def _arms(case: Case) -> list[tuple[Vector, Vector, Vector, Vector, Vector]]:
    """Each cable's frame point, and its carrier point turned by eq. 9 and by its three derivatives.

    The orientation is constant over a case, so the loop over poses need not turn the carrier again.
    """
    rotation, by_psi, by_theta, by_phi = _rotations(case.orientation)
    return [
        (anchor, _turned(rotation, point), _turned(by_psi, point), _turned(by_theta, point), _turned(by_phi, point))
        for anchor, point in zip(_frame_points(case), _carrier_points(case), strict=True)
    ]


def pose_at(case: Case, position: Vector) -> Pose:
    directions, lengths, jacobian = [], [], []
    x, y, z = position
    for anchor, arm, by_psi, by_theta, by_phi in _arms(case):
        gap = (anchor[0] - x - arm[0], anchor[1] - y - arm[1], anchor[2] - z - arm[2])  # eqs. 1 to 8
        length = math.sqrt(dot(gap, gap))  # eqs. 10 to 17
        u = (gap[0] / length, gap[1] / length, gap[2] / length)
        directions.append(u)
        lengths.append(length)
        jacobian.append((*u, dot(u, by_psi), dot(u, by_theta), dot(u, by_phi)))  # eqs. 18 and 19, times R_w
    pull = np.linalg.pinv(np.array(jacobian).T, rcond=RANK_TOLERANCE).tolist()  # eq. 20
    return Pose(directions, lengths, jacobian, [tuple(row[:3]) for row in pull])


def structure_rank(case: Case, position: Vector) -> int:
    return int(np.linalg.matrix_rank(np.array(pose_at(case, position).jacobian).T, rtol=RANK_TOLERANCE))


def force_at(case: Case, acceleration: Vector) -> Vector:
    """Eq. 31 without its three zero moments; see the module's docstring for the sign of gravity."""
    ax, ay, az = acceleration
    return (case.mass * ax, case.mass * ay, case.mass * (az + case.gravity))


def tensions_at(case: Case, pose: Pose, acceleration: Vector) -> list[float]:
    force = force_at(case, acceleration)
    return [dot(row, force) for row in pose.pull]  # eq. 20


def unbalanced(case: Case, pose: Pose, acceleration: Vector) -> tuple[float, ...]:
    """What the pseudo-inverse tensions leave of eq. 31: three forces [N], three moments about the Euler axes [N m]."""
    tensions = tensions_at(case, pose, acceleration)
    wanted = (*force_at(case, acceleration), 0.0, 0.0, 0.0)
    return tuple(
        sum(row[axis] * tension for row, tension in zip(pose.jacobian, tensions, strict=True)) - wanted[axis]
        for axis in range(6)
    )


def bend_of(case: Case, rate: float, square: float, length: float) -> float:
    """The velocity term of the cable's acceleration, from cable rate and squared velocity, winding in positive."""
    return (rate * rate - square) / length if case.centripetal else 0.0


# The sampled loops, eqs. 23 to 34


@lru_cache(maxsize=16)
def velocity_samples(case: Case) -> list[Vector]:
    axis = _levels(-case.speed, case.speed, case.velocity_intervals + 1)  # eqs. 23 to 25
    longest = case.speed * (1.0 + SPEED_TOLERANCE)
    return [v for v in product(axis, axis, axis) if math.sqrt(dot(v, v)) <= longest]  # eq. 26


@lru_cache(maxsize=16)
def acceleration_samples(case: Case) -> list[Vector]:
    braking, driving = case.speed / case.deceleration_time, case.speed / case.acceleration_time
    axis = [level * (braking if level < 0.0 else driving) for level in case.acceleration_levels]  # eqs. 27 to 29
    return list(product(axis, axis, axis))


def motion_samples(case: Case) -> int:
    """The combinations k that eqs. 30 to 34 try at each pose."""
    return len(velocity_samples(case)) * len(acceleration_samples(case))


def sample_pose(case: Case, position: Vector) -> Samples:
    pose = pose_at(case, position)
    samples = Samples([], [], [], [])
    for velocity in velocity_samples(case):
        square = dot(velocity, velocity)
        rates = [dot(u, velocity) for u in pose.directions]  # eq. 19, times R_w
        samples.rates.append(rates)
        samples.bends.append(
            [bend_of(case, rate, square, length) for rate, length in zip(rates, pose.lengths, strict=True)]
        )
    for acceleration in acceleration_samples(case):
        samples.hauls.append([dot(u, acceleration) for u in pose.directions])
        samples.tensions.append(tensions_at(case, pose, acceleration))
    return samples


def _largest(rows: list[list[float]], stop: float) -> float:
    worst = 0.0
    for row in rows:
        for value in row:
            worst = max(worst, abs(value))
        if worst > stop:
            break
    return worst


def _largest_acceleration(case: Case, samples: Samples, stop: float) -> float:
    if not case.centripetal:  # the velocity then changes nothing
        return _largest(samples.hauls, stop)
    worst = 0.0
    for bends in samples.bends:
        for hauls in samples.hauls:
            for bend, haul in zip(bends, hauls, strict=True):
                turning = abs(haul + bend)
                if turning > worst:  # noqa: PLR1730 - max() doubles the time of this innermost loop
                    worst = turning
        if worst > stop:
            break
    return worst


def _largest_voltage(samples: Samples, actuator: Actuator, stop: float) -> float:
    inertial, damping = actuator.inertial / actuator.radius_m, actuator.damping / actuator.radius_m
    geometric = actuator.geometric * actuator.radius_m
    worst = 0.0
    for rates, bends in zip(samples.rates, samples.bends, strict=True):
        for hauls, tensions in zip(samples.hauls, samples.tensions, strict=True):
            for rate, bend, haul, tension in zip(rates, bends, hauls, tensions, strict=True):
                voltage = abs(inertial * (haul + bend) + damping * rate + geometric * tension)  # eq. 21
                if voltage > worst:  # noqa: PLR1730 - as above
                    worst = voltage
        if worst > stop:
            break
    return worst


def largest_share(
    case: Case, samples: Samples, actuator: Actuator, check: Check, stop_above: float = math.inf
) -> float:
    """The largest sampled value of one check over its limit; given up early once above `stop_above`."""
    limit, radius = actuator.limit(check), actuator.radius_m
    stop = stop_above * limit
    if check == "speed":
        return _largest(samples.rates, stop * radius) / (radius * limit)
    if check == "torque":
        return _largest(samples.tensions, stop / radius) * radius / limit
    if check == "acceleration":
        return _largest_acceleration(case, samples, stop * radius) / (radius * limit)
    return _largest_voltage(samples, actuator, stop) / limit


def passes(case: Case, actuator: Actuator, check: Check, position: Vector) -> bool:
    return largest_share(case, sample_pose(case, position), actuator, check, stop_above=1.0) <= 1.0


def count_poses_each(case: Case, actuators: Sequence[Actuator], checks: Sequence[Check]) -> list[int]:
    """For each actuator, the poses that pass every check; each pose is sampled once for all of them."""
    counts = [0] * len(actuators)
    for position in pose_grid(case):
        samples = sample_pose(case, position)
        for index, actuator in enumerate(actuators):
            if all(largest_share(case, samples, actuator, check, stop_above=1.0) <= 1.0 for check in checks):
                counts[index] += 1
    return counts


def count_poses(case: Case, actuator: Actuator, checks: Sequence[Check]) -> int:
    return count_poses_each(case, [actuator], checks)[0]


def utilisation(case: Case, actuator: Actuator, check: Check, position: Vector) -> float:
    return largest_share(case, sample_pose(case, position), actuator, check)


def worst_utilisation(case: Case, actuator: Actuator, check: Check) -> float:
    """The largest utilisation over all poses of the grid."""
    return max(utilisation(case, actuator, check, position) for position in pose_grid(case))
