"""Measure minimax tensions over a box of accelerations: ``python -m tests.benchmarks.tensions``."""

import tracemalloc

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.feasibility import hold_wrenches
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.robot import CableRobot
from tests.benchmarks.linear_programs import (
    by_linear_programs,
    by_plain_shifting,
    normals_by_determinants,
    normals_by_svd,
)
from tests.benchmarks.timing import best_of

CABLES, TENSION_MIN = 8, 1.0  # [N]
MASS, GRAVITY, ACCELERATION = 2.0, 9.81, 1.82  # [kg], [m/s²], [m/s²] along each axis
PROGRAM_POSES, PLAIN_POSES, POSES, MANY_POSES = 20, 2000, 10_000, 100_000
BAND = 1e-6  # relative; a linear program is solved no better than this


def structure_matrices(poses: int, seed: int = 2010) -> FloatArray:
    """An 8-cable 3R3T robot in a box, all cables crossed, at random positions; moments divided by 0.2 m."""
    side = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    robot = CableRobot(
        frame_anchors=side * [1.6, 1.1, 1.1], platform_anchors=side * [0.2, 0.15, 0.1] * [1.0, -1.0, -1.0]
    )
    positions = np.random.default_rng(seed).uniform(-0.5, 0.5, (poses, 3))
    geometry = cable_geometry(robot, positions, np.array([0.1, -0.2, 0.15]))
    return geometry.structure_matrix / np.array([1.0, 1.0, 1.0, 0.2, 0.2, 0.2])[:, None]


def required() -> tuple[FloatArray, FloatArray]:
    """Gravity, and the force that each axis' acceleration takes."""
    return np.array([0.0, 0.0, MASS * GRAVITY, 0.0, 0.0, 0.0]), MASS * ACCELERATION * np.eye(3, 6)


def ours(columns: FloatArray) -> FloatArray:
    """Minimax tensions by the package; (P,)."""
    centre, segments = required()
    wrenches = WrenchSets(centre=centre[None, None], segments=segments[None, None], balls=np.zeros((1, 1, 0, 6, 3)))
    bounds = ColumnBounds(
        lower=np.full(CABLES, TENSION_MIN), upper=np.full(CABLES, np.inf), shared=np.ones(CABLES, dtype=bool)
    )
    poses = len(columns)
    holding = hold_wrenches(columns, wrenches, np.zeros(poses, dtype=np.int64), np.zeros((poses, 6)), bounds)
    return holding.minimax_tension[:, 0]


def against_linear_programs() -> None:
    """(d) Time per pose against eight linear programs and against plain hyperplane shifting."""
    columns = structure_matrices(POSES)
    mine = ours(columns)  # compiles, or loads what was compiled
    fast = best_of(3, lambda: ours(columns)) / POSES
    programs = best_of(3, lambda: by_linear_programs(columns[:PROGRAM_POSES], *required(), TENSION_MIN)) / PROGRAM_POSES
    some = columns[:PLAIN_POSES]
    plain = {
        name: best_of(3, lambda way=way: by_plain_shifting(some, *required(), TENSION_MIN, way)) / PLAIN_POSES
        for name, way in (("determinants", normals_by_determinants), ("singular vectors", normals_by_svd))
    }
    quickest = min(plain, key=plain.__getitem__)
    print(
        f"(d) minimax tension over a box of accelerations, {CABLES} cables, 3R3T: eight linear programs "
        f"{programs * 1e6:,.0f} µs per pose, plain NumPy by {quickest} {plain[quickest] * 1e6:.0f} µs, actuator-select "
        f"{fast * 1e6:.1f} µs: {programs / fast:,.0f} times (promised 500) and {plain[quickest] / fast:.1f} times "
        f"faster (promised 5)"
    )
    worst = 0.0
    for theirs in (
        by_linear_programs(columns[:PROGRAM_POSES], *required(), TENSION_MIN),
        by_plain_shifting(some, *required(), TENSION_MIN),
    ):
        same = mine[: len(theirs)]
        finite = np.isfinite(theirs)
        differ = int((finite != np.isfinite(same)).sum())
        worst = max(worst, float(np.max(np.abs(same[finite] / theirs[finite] - 1.0), initial=0.0)))
        print(f"(d) feasible {finite.mean() * 100.0:.0f} % of {len(theirs)}; verdicts that differ: {differ}")
    print(f"(d) largest relative difference {worst:.1e} (expected under {BAND:.0e})")


def peak_memory(columns: FloatArray) -> float:
    """Most that is allocated beyond the structure matrices. [MiB]"""
    tracemalloc.start()
    ours(columns)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak / 2**20


def over_poses() -> None:
    """(e) Time per pose and memory at ten times as many poses."""
    columns = structure_matrices(MANY_POSES)
    few = best_of(3, lambda: ours(columns[:POSES])) / POSES
    many = best_of(3, lambda: ours(columns)) / MANY_POSES
    print(
        f"(e) {POSES:,} poses {few * 1e6:.1f} µs each, {MANY_POSES:,} poses {many * 1e6:.1f} µs each: "
        f"{many / few:.2f} times (linear: 1)"
    )
    halves = [peak_memory(columns[:poses]) for poses in (MANY_POSES // 4, MANY_POSES // 2, MANY_POSES)]
    print(
        f"(e) peak memory beyond the structure matrices at {MANY_POSES // 4:,}, {MANY_POSES // 2:,} and "
        f"{MANY_POSES:,} poses: " + ", ".join(f"{one:.0f}" for one in halves) + " MiB"
    )


def main() -> None:
    """Print all ratios."""
    against_linear_programs()
    over_poses()


if __name__ == "__main__":
    main()
