"""Results in words, the same on the command line and in reports."""

from collections.abc import Sequence
from math import isinf

from actuator_select.model.exceedance import Exceedance
from actuator_select.model.motion import MotionKind
from actuator_select.model.ranking import State
from actuator_select.selection.selection import CheckVerdict, RankedActuator, Selection
from actuator_select.selection.simulation import UNITS, Simulation
from actuator_select.study import Study

LARGE = 1e4  # utilisations from here on are written with three digits

FIGURE_NAMES = {
    "motor_speed": "rated speed",
    "motor_torque": "rated torque",
    "voltage": "nominal voltage",
    "back_emf_constant": "back-EMF constant",
    "torque_constant": "torque constant",
    "resistance": "terminal resistance",
    "friction": "viscous friction (enter 0 to neglect it)",
    "rotor_inertia": "rotor inertia",
    "ratio": "gear ratio",
    "efficiency": "efficiency",
    "drum_radius": "drum radius",
}


def count_of(positions: int, total: int) -> str:
    """``208/216 (96.3 %)``."""
    return f"{positions}/{total} ({100.0 * positions / total:.1f} %)"


def share(actuator: RankedActuator, total: int) -> str:
    """Feasible share; an upper bound where a check was not evaluated."""
    return f"{'at most ' if actuator.is_upper_bound else ''}{count_of(actuator.feasible_poses, total)}"


def bounded(actuator: RankedActuator) -> str:
    """Feasible positions; marked where they are an upper bound."""
    return f"{'≤ ' if actuator.is_upper_bound else ''}{actuator.feasible_poses}"


def check_cell(verdict: CheckVerdict, total: int) -> str:
    """One check in a table's cell: positions, and the worst utilisation."""
    if verdict.state is State.NOT_APPLICABLE:
        return "not applicable"
    if verdict.poses is None or verdict.worst_utilisation is None:
        return "not evaluated"
    return f"{verdict.poses}/{total}  ×{utilisation_words(verdict.worst_utilisation)}"


def utilisation_words(utilisation: float) -> str:
    """Demand over limit; undefined where a cable has no length."""
    if isinf(utilisation):
        return "undefined"
    return f"{utilisation:.3f}" if utilisation < LARGE else f"{utilisation:.3g}"


def actuator_count(count: int) -> str:
    """``5 actuators``."""
    return f"{count} actuator{'' if count == 1 else 's'}"


def missing_notes(actuators: Sequence[RankedActuator]) -> list[str]:
    """Which figures keep which checks of which actuators from being evaluated, a sentence each."""
    return [
        f"{actuator.name}: {check.value} not evaluated, {missing_words(verdict.missing)} unknown."
        for actuator in actuators
        for check, verdict in actuator.checks.items()
        if verdict.missing
    ]


def missing_words(figures: Sequence[str]) -> str:
    """Names of figures that a check lacks."""
    return ", ".join(FIGURE_NAMES[name] for name in figures)


def heading(selection: Selection) -> list[str]:
    """What the percentages are of: box, grid, orientations, tension model, motion set."""
    study = selection.study
    return [
        f"Study {study.name}, {selection.required_percent:g} % required. Shares are of",
        *(f"  {name:<14}{text}" for name, text in basis(study).items()),
    ]


def basis(study: Study) -> dict[str, str]:
    """What a percentage of this study is of, item by item.

    Parameters
    ----------
    study : Study
        Any study.

    Returns
    -------
    dict of str to str
        Name of the item to its description, with units.
    """
    box = ", ".join(f"{axis} {low:.3f} to {high:.3f} m" for axis, (low, high) in zip("xyz", study.region, strict=True))
    points = study.table.workspace.points
    grid = " × ".join(str(count) for count in points)
    orientations = "; ".join(f"({', '.join(f'{angle:g}' for angle in one)})" for one in study.orientations)
    several = ", at all of which a position has to hold" if len(study.orientations) > 1 else ""
    return {
        "box": box,
        "grid": f"{grid} positions, both ends included{'; a single point in the middle' if 1 in points else ''}",
        "orientations": f"(ψ, θ, φ) = {orientations} rad{several}",
        "tensions": f"{study.tension_model.value} (published model: cables may push)",
        "motion set": motion_words(study),
        "checks": ", ".join(check.value for check in study.checks),
    }


def motion_words(study: Study) -> str:
    """The motion set in a sentence."""
    motion = study.motion
    low, high = motion.acceleration_lower, motion.acceleration_upper
    box = ", ".join(f"{a:.3f} to {b:.3f}" for a, b in sorted(set(zip(low.tolist(), high.tolist(), strict=True))))
    kind = (
        f"every velocity up to {motion.speed:g} m/s"
        if motion.kind is MotionKind.INDEPENDENT
        else f"{len(motion.velocities)} sampled velocities up to {motion.speed:g} m/s"
    )
    term = "with" if motion.centripetal else "without"
    return f"{motion.kind.value}: {kind} × accelerations {box} m/s² per axis, {term} the centripetal term"


def move_words(run: Simulation) -> str:
    """What was simulated, in a sentence."""
    start, stop = (", ".join(f"{value:g}" for value in end) for end in (run.move.start, run.move.stop))
    angles = ", ".join(f"{value:g}" for value in run.move.orientation)
    profile = run.move.profile
    return (
        f"{run.candidates.names[0]} on {run.study.robot.cables} cables: ({start}) to ({stop}) m at (ψ, θ, φ) = "
        f"({angles}) rad, {profile.distance:.3f} m in {run.duration:.4g} s, up to {profile.speed:.4g} m/s; "
        f"tensions: {run.study.tension_model.value}"
    )


def exceedance_words(exceedance: Exceedance) -> str:
    """One exceedance in a sentence."""
    over = 100.0 * (exceedance.worst / exceedance.limit - 1.0)
    unit = UNITS[exceedance.check]
    return (
        f"actuator {exceedance.actuator}: {exceedance.check.value} over its limit from {exceedance.start:.3f} s to "
        f"{exceedance.stop:.3f} s, up to {exceedance.worst:.4g} {unit} of {exceedance.limit:.4g} {unit} ({over:+.1f} %)"
    )


def pushing_words(run: Simulation) -> str:
    """Warning about cables that would have to push."""
    cables = ", ".join(str(cable) for cable in run.pushing)
    return f"the tension model lets cable {cables} push during this move; real cables cannot push."
