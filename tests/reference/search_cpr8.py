"""The worst case over the whole velocity ball and acceleration box of the first paper, by search, not by formula.

The oracle for closed forms: it knows nothing of them. "eq. n" is an equation in [1] of scalar_cpr8.
"""


@lru_cache(maxsize=4)
def _sphere(radius: float) -> list[Vector]:
    """Evenly spread points (a Fibonacci spiral) on the sphere, and its centre."""
    points = [(0.0, 0.0, 0.0)]
    for i in range(SPHERE_POINTS):
        z = 1.0 - (2.0 * i + 1.0) / SPHERE_POINTS
        ring, angle = math.sqrt(1.0 - z * z), math.pi * (1.0 + math.sqrt(5.0)) * i
        points.append((radius * ring * math.cos(angle), radius * ring * math.sin(angle), radius * z))
    return points


def _climb(value: Callable[[Vector], float], start: Vector, radius: float) -> float:
    """The maximum near `start` within the ball, by a compass search that halves its step when no direction helps."""
    here, best, step = start, value(start), FIRST_STEP
    while step > LAST_STEP:
        before = best
        for axis, sign in product(range(3), (-1.0, 1.0)):
            moved = list(here)
            moved[axis] += sign * step * radius
            shrink = min(1.0, radius / max(math.hypot(*moved), radius * LAST_STEP))  # back onto the ball
            trial = (moved[0] * shrink, moved[1] * shrink, moved[2] * shrink)
            reached = value(trial)
            if reached > best:
                here, best = trial, reached
        if best == before:
            step /= 2.0
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
        return box
    u, length = pose.directions[cable], pose.lengths[cable]
    inertial, damping = sign * weights[0] / radius, sign * weights[1] / radius

    def moving(velocity: Vector) -> float:
        return inertial * bend_of(case, u, length, velocity) + damping * dot(u, velocity)

    start = max(_sphere(case.speed), key=moving)
    sampled = box + moving(start)
    if abs(sampled - limit) > doubt * limit:
        return sampled
    return box + _climb(moving, start, case.speed)


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
