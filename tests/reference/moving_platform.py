"""A moving platform from first principles: mass points on a path, cable lengths, and finite differences of both.

Written from Newton's laws and from the definition of a cable's length; knows nothing of the package's closed forms.
Arrays of S motions are (S, 3): velocity and acceleration of the platform's origin, its angular velocity and angular
acceleration, all in the world frame.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

STEP = 2e-3  # s; between the error of the differences, of fourth order, and rounding over the step's square
FIRST = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0  # weights at -2 to 2 steps
SECOND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Motions:
    """S motions, each (S, 3)."""

    velocity: np.ndarray
    acceleration: np.ndarray
    spin: np.ndarray
    spin_rate: np.ndarray

    def __len__(self) -> int:
        return len(self.velocity)

    def take(self, some: np.ndarray) -> "Motions":
        return Motions(
            velocity=self.velocity[some],
            acceleration=self.acceleration[some],
            spin=self.spin[some],
            spin_rate=self.spin_rate[some],
        )


def rotation(angles: np.ndarray) -> np.ndarray:
    """About x by the first angle, then about the fixed y by the second, then about the fixed z by the third."""
    result = np.eye(3)
    for axis, angle in enumerate(angles):
        result = turned(np.eye(3)[axis] * angle) @ result
    return result


def turned(vector: np.ndarray) -> np.ndarray:
    """Rotation about each (..., 3) vector by its length."""
    angle = np.linalg.norm(vector, axis=-1)[..., None, None]
    axis = vector / np.where(angle[..., 0] > 0.0, angle[..., 0], 1.0)
    cross = np.zeros((*vector.shape[:-1], 3, 3))
    cross[..., 0, 1], cross[..., 0, 2], cross[..., 1, 2] = -axis[..., 2], axis[..., 1], -axis[..., 0]
    cross = cross - cross.swapaxes(-1, -2)
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def paths(position: np.ndarray, placed: np.ndarray, motions: Motions) -> np.ndarray:
    """Where points of the platform are at -2 to 2 steps, (5, S, K, 3); now they are at position + placed (K, 3).

    The turn ω t + α t²/2 has at t = 0 the angular velocity ω and the angular acceleration α.
    """
    times = (np.arange(-2.0, 3.0) * STEP)[:, None, None]
    origin = position + times * motions.velocity + times**2 / 2.0 * motions.acceleration
    turn = turned(times * motions.spin + times**2 / 2.0 * motions.spin_rate)
    return origin[:, :, None] + np.einsum("tsij,kj->tski", turn, placed)


def cable_rates(
    frame: np.ndarray, position: np.ndarray, placed: np.ndarray, motions: Motions
) -> tuple[np.ndarray, np.ndarray]:
    """Speed and acceleration of winding in, each (S, K): less the derivatives of the cables' lengths."""
    lengths = np.linalg.norm(frame - paths(position, placed, motions), axis=-1)
    return -np.einsum("t,tsk->sk", FIRST, lengths) / STEP, -np.einsum("t,tsk->sk", SECOND, lengths) / STEP**2


def structure(frame: np.ndarray, position: np.ndarray, placed: np.ndarray) -> np.ndarray:
    """Wrench of each cable per unit of tension about the platform's origin, (6, K)."""
    reach = frame - position - placed
    directions = reach / np.linalg.norm(reach, axis=1, keepdims=True)
    return np.vstack([directions.T, np.cross(placed, directions).T])


@dataclass(frozen=True, slots=True, kw_only=True)
class MassPoints:
    """Points (K, 3) of a body in the platform frame, and their masses (K,)."""

    points: np.ndarray
    masses: np.ndarray

    @property
    def centre(self) -> np.ndarray:
        return self.masses @ self.points / self.masses.sum()

    @property
    def inertia(self) -> np.ndarray:
        """About the centre of gravity."""
        total = np.zeros((3, 3))
        for mass, point in zip(self.masses, self.points - self.centre, strict=True):
            total += mass * (point @ point * np.eye(3) - np.outer(point, point))
        return total


def random_body(generator: np.random.Generator, mass: float, size: float, *, flat: bool = False) -> MassPoints:
    """Six points; of a flat body they lie in the plane y = 0."""
    points = generator.uniform(-size, size, (6, 3)) * ([1.0, 0.0, 1.0] if flat else 1.0) + [0.1 * size, 0.0, -size]
    shares = generator.uniform(0.5, 1.5, 6)
    return MassPoints(points=points, masses=mass * shares / shares.sum())


def needed_wrench(body: MassPoints, gravity: float, turn: np.ndarray, motions: Motions) -> np.ndarray:
    """Rate of momentum and of angular momentum about where the origin is now, less gravity's part, (S, 6)."""
    placed = body.points @ turn.T
    where = paths(np.zeros(3), placed, motions)
    acceleration = np.einsum("t,tski->ski", SECOND, where) / STEP**2
    forces = body.masses[:, None] * (acceleration + np.array([0.0, 0.0, gravity]))
    return np.hstack([forces.sum(axis=1), np.cross(placed, forces).sum(axis=1)])


def energy_rate(body: MassPoints, gravity: float, turn: np.ndarray, motions: Motions) -> np.ndarray:
    """Rate of kinetic and potential energy, (S,), by differences of both over the path."""
    placed = body.points @ turn.T
    energies = []
    for shift in range(-2, 3):
        now = shift * STEP
        # Velocities of the points at that instant are differences once more, with a finer step.
        fine = 1e-4
        where = [_at(placed, motions, now + part * fine) for part in range(-2, 3)]
        velocity = sum(weight * one for weight, one in zip(FIRST, where, strict=True)) / fine
        kinetic = (body.masses * (velocity**2).sum(axis=-1)).sum(axis=1) / 2.0
        energies.append(kinetic + gravity * (where[2][..., 2] @ body.masses))
    return sum(weight * one for weight, one in zip(FIRST, energies, strict=True)) / STEP


def _at(placed: np.ndarray, motions: Motions, time: float) -> np.ndarray:
    origin = time * motions.velocity + time**2 / 2.0 * motions.acceleration
    return origin[:, None] + np.einsum(
        "sij,kj->ski", turned(time * motions.spin + time**2 / 2.0 * motions.spin_rate), placed
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionLimits:
    """What a set of motions allows, in words of its own.

    `straight`: velocity and acceleration on one line. `velocity_box`, `acceleration_box`: every component is bounded,
    not the magnitude. `axes`, `turns`: 1 for each axis along and about which the platform moves.
    """

    speed: float
    acceleration: float
    spin: float = 0.0
    spin_rate: float = 0.0
    straight: bool = False
    velocity_box: bool = False
    acceleration_box: bool = False
    axes: tuple[float, float, float] = (1.0, 1.0, 1.0)
    turns: tuple[float, float, float] = (1.0, 1.0, 1.0)

    def into(self, raw: np.ndarray) -> Motions:
        """Nearest motions of the set to (S, 4, 3) numbers, in which 1 is the bound."""
        free, turning = np.array(self.axes), np.array(self.turns)
        velocity = _clipped(raw[:, 0] * free, box=self.velocity_box)
        acceleration = _clipped(raw[:, 1] * free, box=self.acceleration_box)
        if self.straight:
            length = np.linalg.norm(velocity, axis=1, keepdims=True)
            line = velocity / np.where(length > 0.0, length, 1.0)
            velocity = line * np.clip(raw[:, 1, 1:2], -1.0, 1.0)
            acceleration = line * np.clip(raw[:, 1, :1], -1.0, 1.0)
        return Motions(
            velocity=self.speed * velocity,
            acceleration=self.acceleration * acceleration,
            spin=self.spin * _clipped(raw[:, 2] * turning, box=self.velocity_box),
            spin_rate=self.spin_rate * _clipped(raw[:, 3] * turning, box=self.acceleration_box),
        )

    def raw(self, generator: np.random.Generator, directions: np.ndarray, count: int) -> np.ndarray:
        """Random numbers for `into`, half of them from corners, given directions, their opposites and zeros."""
        corners = np.array(list(product((-1.0, 1.0), repeat=3)))
        perpendicular = np.cross(directions, generator.normal(size=directions.shape))
        perpendicular /= np.linalg.norm(perpendicular, axis=1, keepdims=True)
        special = np.vstack([corners, directions, -directions, perpendicular, np.zeros((2, 3))])
        picked = special[generator.integers(len(special), size=(count, 4))]
        random = generator.normal(size=(count, 4, 3))
        random /= np.linalg.norm(random, axis=2, keepdims=True)
        random *= generator.uniform(0.0, 1.5, (count, 4, 1))
        result = np.where(generator.random((count, 1, 1)) < 0.5, picked, random)
        if self.straight:
            result[:, 1, :2] = generator.choice([-1.0, 0.0, 1.0], size=(count, 2))
        return result


def _clipped(raw: np.ndarray, *, box: bool) -> np.ndarray:
    if box:
        return np.clip(raw, -1.0, 1.0)
    return raw / np.maximum(1.0, np.linalg.norm(raw, axis=1, keepdims=True))


def climb(
    objective: Callable[[Motions], np.ndarray], limits: MotionLimits, start: np.ndarray, generator: np.random.Generator
) -> float:
    """Largest value that random steps of shrinking size reach from the (4, 3) start."""
    best, at = -np.inf, start
    for size in np.geomspace(0.3, 1e-4, 30):
        steps = at + size * generator.normal(size=(30, 4, 3)) * (generator.random((30, 4, 1)) < 0.6)
        steps[0] = at
        values = objective(limits.into(steps))
        if values.max() > best:
            best, at = values.max(), steps[values.argmax()]
    return float(best)
