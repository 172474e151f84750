"""Baselines for minimax tensions over a box of accelerations: eight linear programs, and plain hyperplane shifting."""

from collections.abc import Callable
from itertools import combinations, product

import numpy as np
from scipy.optimize import linprog

from actuator_select.model.arrays import FloatArray, IntArray

POSES_AT_ONCE = 1000  # in the plain evaluation; fastest of 100 to 5,000
SMALL = 1e-9  # of a unit normal's components; smaller ones are rounding


def by_linear_programs(columns: FloatArray, centre: FloatArray, segments: FloatArray, tension_min: float) -> FloatArray:
    """Least τ at every pose, one HiGHS program for each vertex centre ± segments; (P,)."""
    poses, rows, count = columns.shape
    signs = np.array(list(product((-1.0, 1.0), repeat=len(segments))))
    cost = np.append(np.zeros(count), 1.0)
    below = np.hstack([np.eye(count), -np.ones((count, 1))])
    result = np.zeros(poses)
    for pose in range(poses):
        equal = np.hstack([columns[pose], np.zeros((rows, 1))])
        for wrench in centre + signs @ segments:
            solved = linprog(cost, below, np.zeros(count), equal, wrench, bounds=(tension_min, None), method="highs")
            result[pose] = max(result[pose], solved.fun if solved.status == 0 else np.inf)
    return result


def normals_by_svd(columns: FloatArray, sets: IntArray) -> FloatArray:
    """Last left singular vector of every set of r - 1 columns, (P, sets, r)."""
    chosen = columns[:, :, sets].transpose(0, 2, 1, 3)
    return np.linalg.svd(chosen, full_matrices=True)[0][..., -1]


def normals_by_determinants(columns: FloatArray, sets: IntArray) -> FloatArray:
    """Generalised cross product of every set of r - 1 columns, (P, sets, r)."""
    rows = columns.shape[1]
    chosen = columns[:, :, sets].transpose(0, 2, 1, 3)
    minors = [(-1.0) ** row * np.linalg.det(np.delete(chosen, row, axis=2)) for row in range(rows)]
    normals = np.stack(minors, axis=-1)
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def by_plain_shifting(
    columns: FloatArray,
    centre: FloatArray,
    segments: FloatArray,
    tension_min: float,
    normals_of: Callable[[FloatArray, IntArray], FloatArray] = normals_by_determinants,
) -> FloatArray:
    """Least τ at every pose, all sets of r - 1 columns at once; (P,)."""
    poses, rows, count = columns.shape
    sets = np.array(list(combinations(range(count), rows - 1)))
    result = np.empty(poses)
    for start in range(0, poses, POSES_AT_ONCE):
        some = columns[start : start + POSES_AT_ONCE]
        normals = normals_of(some, sets)
        normals = np.concatenate([normals, -normals], axis=1)
        pulls = normals @ some
        pulls[np.abs(pulls) < SMALL] = 0.0
        with_it, against = np.maximum(pulls, 0.0).sum(axis=2), np.maximum(-pulls, 0.0).sum(axis=2)
        needed = normals @ centre + np.abs(normals @ segments.T).sum(axis=2) + tension_min * against
        with np.errstate(divide="ignore", invalid="ignore"):
            level = np.where(needed <= SMALL * np.linalg.norm(centre), 0.0, needed / with_it)
        result[start : start + POSES_AT_ONCE] = np.maximum(level.max(axis=1), tension_min)
    return result
