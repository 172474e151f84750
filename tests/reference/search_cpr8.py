"""The worst case over the whole velocity ball and acceleration box of the first paper, by search, not by formula.

The oracle for closed forms: it knows none of them. Each value is a part that is affine in the acceleration, extreme at
a corner of the box, plus a part that only the velocity moves, which is sampled over the ball and refined. "eq. n" is
an equation in [1] of scalar_cpr8.
"""

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import product

from tests.reference.scalar_cpr8 import (
    Actuator,
    Case,
    Check,
    Pose,
    Vector,
    bend_of,
    dot,
    force_at,
    pose_at,
    pose_grid,
)

# Points this dense on the sphere miss the maximum of a quadratic by less than 1 % of its range: a value further than
# DOUBT from its limit, relative to the limit, needs no refinement to be told from it.
SPHERE_POINTS = 300
DOUBT = 0.05
FIRST_STEP = 0.15  # of the radius; about the distance between sphere points
LAST_STEP = 1e-6  # of the radius; the maximum is flat, so its value is then right to about 1e-12
SHRINK = 0.5  # per round; the patch can still travel twice its first size


@lru_cache(maxsize=4)
def _ball(radius: float) -> list[Vector]:
    """Evenly spread points (a Fibonacci spiral) on the sphere, and its centre.

    No shells between them: along its own cable every value is linear in the velocity, so the sphere has a maximum.
    """
    points = [(0.0, 0.0, 0.0)]
    for i in range(SPHERE_POINTS):
        z = 1.0 - (2.0 * i + 1.0) / SPHERE_POINTS
        ring, angle = radius * math.sqrt(1.0 - z * z), math.pi * (1.0 + math.sqrt(5.0)) * i
        points.append((ring * math.cos(angle), ring * math.sin(angle), radius * z))
    return points


def _refined(value: Callable[[Vector], float], start: Vector, radius: float) -> float:
    """The maximum near `start` within the ball: each round tries a smaller patch of 26 points about the best so far."""
    here, best, step = start, value(start), FIRST_STEP * radius
    patch = [offset for offset in product((-1.0, 0.0, 1.0), repeat=3) if any(offset)]
    while step > LAST_STEP * radius:
        centre = here
        for dx, dy, dz in patch:
            x, y, z = centre[0] + step * dx, centre[1] + step * dy, centre[2] + step * dz
            size = math.sqrt(x * x + y * y + z * z)
            back = radius / size if size > radius else 1.0  # onto the ball
            trial = (back * x, back * y, back * z)
            reached = value(trial)
            if reached > best:
                here, best = trial, reached
        step *= SHRINK
    return best


def _weights(actuator: Actuator, check: Check) -> Vector:
    """What the check makes of shaft acceleration, speed and torque; eq. 21 for the voltage."""
    if check == "speed":
        return (0.0, 1.0, 0.0)
    if check == "torque":
        return (0.0, 0.0, 1.0)
    if check == "acceleration":
        return (1.0, 0.0, 0.0)
    return (actuator.inertial, actuator.damping, actuator.geometric)


def _box_share(case: Case, pose: Pose, cable: int, weights: Vector, radius: float) -> list[float]:
    """The part that is affine in the acceleration, at the corners of the box, where alone its extremes can be."""
    inertial, _, geometric = weights
    braking, driving = case.speed / case.deceleration_time, case.speed / case.acceleration_time
    shares = []
    for corner in product((-braking, driving), repeat=3):
        haul = dot(pose.directions[cable], corner) / radius
        torque = dot(pose.pull[cable], force_at(case, corner)) * radius
        shares.append(inertial * haul + geometric * torque)
    return shares


def _exact_end(
    case: Case, pose: Pose, cable: int, actuator: Actuator, check: Check, sign: float, doubt: float = math.inf
) -> float:
    """The largest of sign × value over ball and box, refined where it lies within `doubt` of the limit."""
    weights, radius, limit = _weights(actuator, check), actuator.radius_m, actuator.limit(check)
    box = max(sign * share for share in _box_share(case, pose, cable, weights, radius))
    if check == "torque":
        return box  # no velocity in it
    u, length = pose.directions[cable], pose.lengths[cable]
    inertial, damping = sign * weights[0] / radius, sign * weights[1] / radius

    def moving(velocity: Vector) -> float:
        rate = dot(u, velocity)
        return inertial * bend_of(case, rate, dot(velocity, velocity), length) + damping * rate

    start = max(_ball(case.speed), key=moving)
    sampled = box + moving(start)
    if abs(sampled - limit) > doubt * limit:
        return sampled
    return box + _refined(moving, start, case.speed)


def exact_extremes(case: Case, actuator: Actuator, check: Check, position: Vector) -> list[tuple[float, float]]:
    """Each cable's least and greatest value of one check over velocity ball and acceleration box.

    The box reaches from -V / t_dec to V / t_acc on each axis, whatever the sampled levels are. Winding in is positive.
    """
    pose = pose_at(case, position)
    return [
        (-_exact_end(case, pose, cable, actuator, check, -1.0), _exact_end(case, pose, cable, actuator, check, 1.0))
        for cable in range(len(pose.lengths))
    ]


def exact_utilisation(case: Case, actuator: Actuator, check: Check, position: Vector) -> float:
    ends = exact_extremes(case, actuator, check, position)
    return max(max(-least, greatest) for least, greatest in ends) / actuator.limit(check)


def _passes_exactly(case: Case, pose: Pose, actuator: Actuator, check: Check) -> bool:
    limit = actuator.limit(check)
    return all(
        _exact_end(case, pose, cable, actuator, check, sign, DOUBT) <= limit
        for cable in range(len(pose.lengths))
        for sign in (-1.0, 1.0)
    )


def count_poses_exactly(case: Case, actuator: Actuator, checks: Sequence[Check]) -> int:
    poses = (pose_at(case, position) for position in pose_grid(case))
    return sum(all(_passes_exactly(case, pose, actuator, check) for check in checks) for pose in poses)
