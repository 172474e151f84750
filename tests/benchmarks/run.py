"""Measure what the design promises, as ratios in one run: ``python -m tests.benchmarks.run``."""

import statistics
import subprocess
import sys
from resource import RUSAGE_SELF, getrusage

import numpy as np

from actuator_select.model.actuation import Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import compute_demand
from actuator_select.model.dynamics import required_wrench
from actuator_select.model.evaluation import evaluate_actuators, position_utilisation
from actuator_select.model.families import cpr8, cpr8_region
from actuator_select.model.kinematics import position_grid
from actuator_select.model.motion import sampled_motion
from actuator_select.units import kg_m2, rad_per_s
from tests.benchmarks import plain_numpy
from tests.benchmarks.cases import large_demand, synthetic_actuators
from tests.benchmarks.paper_loops import passes
from tests.benchmarks.tensions import against_linear_programs, over_poses
from tests.benchmarks.timing import best_of
from tests.reference.scalar_cpr8 import TABLE_1, Case, pose_grid

SCALAR_SLICE = 12  # poses that the scalar loops are timed on; scaled to all
PLAIN_SLICE = 40  # actuators that the plain evaluation is timed on; scaled to all
BAND = 1e-12  # relative distance from a limit within which verdicts may differ


def table_1() -> ActuatorSet:
    """The five actuators in SI units."""
    return ActuatorSet.from_figures(
        [
            {
                "motor_speed": rad_per_s(drive.speed_rpm),
                "motor_torque": drive.torque_nm,
                "voltage": drive.voltage_v,
                "back_emf_constant": drive.back_emf_v_s_per_rad,
                "torque_constant": drive.torque_constant_nm_per_a,
                "resistance": drive.resistance_ohm,
                "friction": 0.0,
                "rotor_inertia": kg_m2(drive.inertia_g_cm2),
                "ratio": drive.ratio,
                "efficiency": drive.efficiency,
                "drum_radius": drive.radius_m,
            }
            for drive in TABLE_1
        ]
    )


def against_the_scalar_loops() -> None:
    """(a) The sampled set, five actuators, all four checks."""
    case = Case(centripetal=False)
    frame, carrier = np.array(case.frame), np.array(case.carrier)
    actuators = table_1()
    grid = position_grid(cpr8_region(frame, carrier), (6, 6, 6))
    motion = sampled_motion(1.3, 1.82, 1.82, velocity_intervals=6, acceleration_levels=(-1.0, 1.0), centripetal=False)

    def ours() -> np.ndarray:
        demand = compute_demand(cpr8(frame, carrier), grid, np.zeros((1, 3)), [[required_wrench(2.0, 9.81)]], motion)
        return evaluate_actuators(demand, actuators, list(Check)).positions

    # Every motion is evaluated where a pose passes; those are what the paper's loops cost.
    every = pose_grid(case)
    passing = [
        (drive, position)
        for drive in TABLE_1[:3]
        for position in every[:: len(every) // SCALAR_SLICE]
        if passes(case, drive, position)
    ]
    scalar = best_of(3, lambda: [passes(case, drive, position) for drive, position in passing])
    scalar *= len(every) * len(TABLE_1) / len(passing)
    fast = best_of(200, ours)
    print(
        f"(a) sampled set, 216 poses × 984 motions × 5 actuators: scalar loops {scalar:.1f} s, "
        f"actuator-select {fast * 1e3:.2f} ms with the demand: {scalar / fast:,.0f} times faster (promised 1,000)"
    )


def against_plain_numpy() -> None:
    """(b) 100,000 poses, 1,000 synthetic actuators, each check by itself."""
    demand = large_demand((50, 50, 40))
    actuators = synthetic_actuators(demand, 1000)
    evaluate_actuators(demand, actuators, [Check.VOLTAGE])  # compiles, or loads what was compiled
    some = actuators.take(np.arange(PLAIN_SLICE))
    for check in Check:
        fast = best_of(3, lambda check=check: evaluate_actuators(demand, actuators, [check]))
        slow = best_of(1, lambda check=check: plain_numpy.counts(demand, some, check.value)) * 1000 / PLAIN_SLICE
        mine = evaluate_actuators(demand, actuators, [check]).checks[check].positions[:PLAIN_SLICE]
        theirs = plain_numpy.counts(demand, some, check.value)
        near = np.sum(np.abs(position_utilisation(demand, some, [check])[check] - 1.0) < BAND, axis=1)
        shares = np.percentile(mine / len(demand.positions), [0, 50, 100]) * 100.0
        differ = int((np.abs(mine - theirs) > near).sum())
        print(
            f"(b) {check.value}: plain NumPy {slow:.2f} s, actuator-select {fast:.3f} s: {slow / fast:.1f} times "
            f"faster; passing {shares[0]:.0f} to {shares[2]:.0f} %; verdicts that differ outside the band: {differ}"
        )
    together = best_of(3, lambda: evaluate_actuators(demand, actuators, list(Check)))
    print(
        f"(b) all four together {together:.3f} s; peak memory {getrusage(RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB "
        "(promised under 1), the plain evaluation's included"
    )


def start_up() -> None:
    """(c) ``--help`` against importing click."""

    def run(arguments: list[str]) -> float:
        return statistics.median(
            best_of(1, lambda: subprocess.run([sys.executable, *arguments], check=True, capture_output=True))
            for _ in range(15)
        )

    floor, ours = run(["-c", "import click"]), run(["-m", "actuator_select", "--help"])
    print(
        f"(c) --help {ours * 1e3:.0f} ms, importing click {floor * 1e3:.0f} ms: {ours / floor:.2f} times (promised 4)"
    )


if __name__ == "__main__":
    start_up()
    against_the_scalar_loops()
    against_plain_numpy()
    against_linear_programs()
    over_poses()
