"""Simulated moves in words, the same on the command line and in reports."""

import numpy as np

from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray
from actuator_select.model.exceedance import Exceedance
from actuator_select.model.trajectory import TorqueTest
from actuator_select.selection.simulation import UNITS, Simulation
from actuator_select.study import Study


def move_words(run: Simulation) -> str:
    """What was simulated, in a sentence."""
    start, stop = (", ".join(f"{value:g}" for value in end) for end in (run.move.start, run.move.stop))
    angles = ", ".join(f"{value:g}" for value in run.move.orientation)
    profile = run.move.profile
    return (
        f"{run.candidates.names[0]} on {run.study.robot.cables} cables: ({start}) to ({stop}) m at (ψ, θ, φ) = "
        f"({angles}) rad, {profile.distance:.3f} m in {run.duration:.4g} s, up to {profile.speed:.4g} m/s; "
        f"tensions: {run.study.tension_model.value}{_load_of_move(run.study)}"
    )


def _load_of_move(study: Study) -> str:
    """Which of several loads a move carries."""
    return f"; load: {study.loads[0].title}, the first of {len(study.loads)}" if len(study.loads) > 1 else ""


def check_words(run: Simulation, check: Check) -> str:
    """What a check of this move looks at; the torque may be that of load and rotor together."""
    if check is Check.TORQUE and run.history.torque_test is TorqueTest.LOAD_AND_ROTOR:
        return "torque, load and rotor"
    return check.value


def exceedance_words(run: Simulation, exceedance: Exceedance) -> str:
    """One exceedance in a sentence."""
    what = check_words(run, exceedance.check)
    what += "," if "," in what else ""
    return (
        f"actuator {exceedance.actuator}: {what} over its limit from {exceedance.start:.3f} s to "
        f"{exceedance.stop:.3f} s, {_up_to(exceedance)}"
    )


def together_words(run: Simulation) -> list[str]:
    """Where load and rotor together exceed a limit that each of them is held against alone, a sentence each."""
    return [
        f"actuator {one.actuator}: torque of load and rotor together, which eqs. 32 and 33 test apart, exceeds the "
        f"motor's from {one.start:.3f} s to {one.stop:.3f} s, {_up_to(one)}"
        for one in run.together
    ]


def _up_to(exceedance: Exceedance) -> str:
    over = 100.0 * (exceedance.worst / exceedance.limit - 1.0)
    unit = UNITS[exceedance.check]
    return f"up to {exceedance.worst:.4g} {unit} of {exceedance.limit:.4g} {unit} ({over:+.1f} %)"


def unheld_words(run: Simulation) -> list[str]:
    """Where a move cannot be made, whatever drives the robot, a sentence per stretch of time."""
    move = run.move
    line = (move.stop - move.start) / move.profile.distance
    found = []
    for start, stop in run.unheld:
        where = move.start + line * float(np.interp(start, *_way(run)))
        at = ", ".join(f"{value:.3f}" for value in where)
        found.append(
            f"the move cannot be made: no tensions and lengths within the cables' bounds hold the platform from "
            f"{start:.3f} s, at ({at}) m, to {stop:.3f} s; the figures leave that out"
        )
    return found


def _way(run: Simulation) -> tuple[FloatArray, FloatArray]:
    """Times [s] and way covered [m], dense enough to name a place."""
    profile = run.move.profile
    corners = profile.corners
    times, way = [], []
    for phase in range(3):
        instants = np.linspace(corners[phase], corners[phase + 1], 101)
        times.append(instants)
        way.append(profile.motion(instants, phase)[0])
    return np.concatenate(times), np.concatenate(way)


def pushing_words(run: Simulation) -> str:
    """Warning about cables that would have to push."""
    cables = ", ".join(str(cable) for cable in run.pushing)
    return f"the tension model lets cable {cables} push during this move; real cables cannot push."
