"""Results in words, the same on the command line and in reports."""

from collections.abc import Mapping, Sequence
from math import inf, isinf

from actuator_select.model.actuation import Check
from actuator_select.model.arrays import FloatArray
from actuator_select.model.motion import MotionKind, SetShape
from actuator_select.model.ranking import State, Verdict
from actuator_select.model.tension import TensionModel
from actuator_select.selection.assumptions import Assumed
from actuator_select.selection.electrical import Row
from actuator_select.selection.results import CheckVerdict, RankedActuator, Selection
from actuator_select.study import Study

MOST_NAMED = 3  # actuators of one note that are named, the others counted
MOST_LISTED = 6  # orientations that are listed one by one
LARGE = 1e4  # utilisations from here on are written with three digits

FIGURE_NAMES = {
    "motor_speed": "rated speed",
    "motor_torque": "rated torque",
    "voltage": "nominal voltage",
    "back_emf_constant": "back-EMF constant",
    "torque_constant": "torque constant",
    "resistance": "terminal resistance",
    "friction": "viscous friction",
    "rotor_inertia": "rotor inertia",
    "ratio": "gear ratio",
    "efficiency": "efficiency",
    "drum_radius": "drum radius",
    "electrical_convention": "electrical convention",
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
    if isinf(verdict.worst_utilisation):  # at no position that some drive could serve
        return f"{verdict.poses}/{total}"
    return f"{verdict.poses}/{total}  ×{utilisation_words(verdict.worst_utilisation)}"


def utilisation_words(utilisation: float) -> str:
    """Demand over limit; undefined where a cable has no length."""
    if isinf(utilisation):
        return "–"
    return f"{utilisation:.3f}" if utilisation < LARGE else f"{utilisation:.3g}"


def actuator_count(count: int) -> str:
    """``5 actuators``."""
    return f"{count} actuator{'' if count == 1 else 's'}"


def marked(actuator: RankedActuator) -> str:
    """Name of an actuator, with a star where something was assumed for it."""
    return f"{actuator.name} *" if actuator.assumptions else actuator.name


def check_notes(actuators: Sequence[RankedActuator]) -> list[str]:
    """Which checks of which actuators were not evaluated for want of which figures, or do not apply, and why."""
    found: dict[str, list[str]] = {}
    for actuator in actuators:
        for check, verdict in actuator.checks.items():
            if verdict.missing:
                found.setdefault(
                    f"{check.value} not evaluated, {unknown_words(verdict.missing, verdict.assumable)}", []
                ).append(actuator.name)
            elif verdict.reason:
                found.setdefault(inapplicable_words(check, verdict.reason), []).append(actuator.name)
    return [f"{some_of(names)}: {text}." for text, names in found.items()]


def inapplicable_words(check: Check, reason: str) -> str:
    """Why a check does not apply to an actuator."""
    return f"{check.value} not applicable, because its electrical figures are {reason}"


def unknown_words(figures: Sequence[str], assumable: Mapping[str, str]) -> str:
    """Figures that a check lacks, and what would help: to state them, or the study's key that `assumable` has."""
    text = f"{', '.join(FIGURE_NAMES[name] for name in figures)} unknown"
    keys = {name: assumable[name] for name in figures if name in assumable}
    if not keys:
        return text
    if len(keys) == len(figures):
        return f"{text}: state {'it' if len(keys) == 1 else 'them'}, or {', '.join(keys.values())}"
    each = "; ".join(f"{FIGURE_NAMES[name]} could be assumed by {key}" for name, key in keys.items())
    return f"{text} ({each})"


def assumption_notes(actuators: Sequence[RankedActuator]) -> list[str]:
    """What was assumed for which actuators, a sentence for each assumption."""
    found: dict[str, list[tuple[str, Assumed]]] = {}
    for actuator in actuators:
        for one in actuator.assumptions:
            found.setdefault(one.text, []).append((actuator.name, one))
    return [
        f"{assumed_words([one for _, one in entries])}, for {some_of([name for name, _ in entries], len(actuators))}."
        for entries in found.values()
    ]


def assumed_words(alike: Sequence[Assumed]) -> str:
    """One assumption as it was made once or more, its values where they differ, and the study's key."""
    first = alike[0]
    values = sorted({one.value for one in alike if isinstance(one.value, float)})
    spread = f", {values[0]:g} to {values[-1]:g} {first.unit}" if len(values) > 1 else ""
    if not spread and first.key.endswith("_of_maximum"):
        spread = f", {values[0]:g} {first.unit}"
    return f"{first.text}{spread}{f' ({first.key})' if first.key else ''}"


def unchecked_limits(rows: Sequence[Row]) -> str:
    """What no check holds an actuator against, even where the catalogue states it.

    Parameters
    ----------
    rows : sequence of mapping
        Actuators of the catalogue with their joined columns; what gearboxes bear is named where one has a gearbox.

    Returns
    -------
    str
        A list for the middle of a sentence.
    """
    geared = any(row.get("gearbox_id") is not None for row in rows)
    gearbox = ["the gearbox's continuous and intermittent torque and input speed"] if geared else []
    return "; ".join(
        [
            "the motor's peak torque, greatest speed and heating",
            *gearbox,
            "the winch's tension and speed",
            "the rope's breaking force",
        ]
    )


def some_of(names: Sequence[str], total: int = 0) -> str:
    """Names, at most a few of them, or all of `total` actuators."""
    if total > MOST_NAMED and len(names) == total:
        return f"all {total} actuators"
    rest = len(names) - MOST_NAMED
    if rest <= 1:  # one more takes no more room than its count
        return ", ".join(names)
    return f"{', '.join(names[:MOST_NAMED])} and {rest} more"


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
    placed = "cell midpoints" if study.table.workspace.grid == "midpoints" else "both ends included"
    items = {
        "box": box,
        "grid": f"{grid} positions, {placed}{'; a single point in the middle' if 1 in points else ''}",
        "orientations": orientation_words(study),
        "load": load_words(study),
        "tensions": tension_words(study),
        "motion set": motion_words(study),
        "checks": ", ".join(check.value for check in study.checks),
    }
    if study.table.candidates.kind == "none":
        del items["checks"]
    return items


def orientation_words(study: Study) -> str:
    """Orientations of every position."""
    if len(study.orientations) > MOST_LISTED:
        spans = ", ".join(
            f"{angle} {low:g} to {high:g}"
            for angle, low, high in zip(
                "ψθφ", study.orientations.min(axis=0), study.orientations.max(axis=0), strict=True
            )
        )
        return f"{len(study.orientations)} of {spans} rad, at all of which a position has to hold"
    listed = "; ".join(f"({', '.join(f'{angle:g}' for angle in one)})" for one in study.orientations)
    several = ", at all of which a position has to hold" if len(study.orientations) > 1 else ""
    return f"(ψ, θ, φ) = {listed} rad{several}"


def load_words(study: Study) -> str:
    """What is held: the platform, the payloads, external forces, counterbalances."""
    own = study.robot.platform.mass
    loads = []
    for load in study.loads:
        parts = [f"{load.body.mass:g} kg"] if load.body.mass or not own else []
        for name, unit, low, high in (
            ("force", "N", load.force_lower, load.force_upper),
            ("moment", "N m", load.moment_lower, load.moment_upper),
        ):
            if low.any() or high.any():
                middle, reach = (low + high) / 2.0, (high - low) / 2.0
                around = f" ± ({', '.join(f'{value:g}' for value in reach)})" if reach.any() else ""
                parts.append(f"{name} ({', '.join(f'{value:g}' for value in middle)}){around} {unit}")
        loads.append(" and ".join(parts) or "nothing")
    text = "; ".join(loads)
    if own:
        text = f"platform {own:g} kg with {text}" if text != "nothing" else f"platform {own:g} kg"
    if len(loads) > 1:
        text += ", each of which has to be held"
    for rope in study.robot.counterbalances:
        tension = f"{rope.tension_min:g} to {rope.tension_max:g}" if rope.is_controlled else f"{rope.tension_min:g}"
        text += f"; counterbalance rope at {tension} N over {len(rope.frame_anchors)} segments"
    return text


def tension_words(study: Study) -> str:
    """The tension model and the bounds that it keeps."""
    model, bounds = study.tension_model, study.robot.bounds
    if model.lets_cables_push:
        return f"{model.value} (published model: cables may push)"
    what = {
        TensionModel.WRENCH_FEASIBLE: f"all {study.robot.degrees_of_freedom} equations balanced by cables that pull",
        TensionModel.FORCE_ONLY: "forces balanced by cables that pull, moments left out",
    }[model]
    return f"{model.value} ({what}, {_range(bounds.tension_min, bounds.tension_max)} N)"


def _range(lower: FloatArray, upper: FloatArray) -> str:
    """``0 to 16000``, or one per cable where they differ; without an upper bound ``50 or more``."""
    pairs = [
        f"{low:g} to {high:g}" if high < inf else f"{low:g} or more" for low, high in zip(lower, upper, strict=True)
    ]
    return pairs[0] if len(set(pairs)) == 1 else ", ".join(pairs)


def motion_words(study: Study) -> str:
    """The motion set in a sentence."""
    motion = study.motion
    term = "with" if motion.centripetal else "without"
    if motion.kind is MotionKind.REST:
        return "rest: the platform stands still"
    if motion.kind is MotionKind.LISTED:
        return f"list: {len(motion.listed)} given motions, {term} the centripetal term"
    low, high = motion.acceleration_lower, motion.acceleration_upper
    accelerations = (
        f"up to {high[0]:.3f} m/s²"
        if motion.acceleration_shape is SetShape.BALL
        else ", ".join(f"{a:.3f} to {b:.3f}" for a, b in sorted(set(zip(low.tolist(), high.tolist(), strict=True))))
        + " m/s² per axis"
    )
    if motion.kind is MotionKind.STRAIGHT:
        text = f"every straight line up to {motion.speed:g} m/s, speeding up and braking along it by {accelerations}"
    elif motion.kind is MotionKind.SAMPLED:
        text = f"{len(motion.velocities)} sampled velocities up to {motion.speed:g} m/s × accelerations {accelerations}"
    else:
        each = " per axis" if motion.velocity_shape is SetShape.BOX else ""
        text = f"every velocity up to {motion.speed:g} m/s{each} × accelerations {accelerations}"
    if motion.turns:
        text += f", turning at up to {motion.angular_speed:g} rad/s and {motion.angular_acceleration:g} rad/s²"
    return f"{motion.kind.value}: {text}, {term} the centripetal term"


def summary(selection: Selection) -> list[str]:
    """The answer in three lines: what any drive could reach, the best candidate, what limits it and where."""
    total, required = selection.poses, selection.required_percent
    attainable = (
        f"Attainable by any drive, however strong: {count_of(selection.attainable_poses, total)}"
        f" under {selection.study.tension_model.value}"
    )
    if selection.unattainable_places:
        named = ", ".join(selection.unattainable_places)
        attainable += f". No drive could serve {named}, as required: the robot has to change, not the drive."
    elif selection.robot_falls_short:
        attainable += f". Below the required {required:g} %: the robot has to change, not the drive."
    elif selection.study.tension_model.lets_cables_push:
        attainable += ", which lets cables push."
    else:
        attainable += "."
    best = selection.ranked[0]
    done = {
        Verdict.MEETS: f"meets the required {required:g} %",
        Verdict.UNDECIDED: "is undecided, because figures are missing",
        Verdict.FAILS: f"does not meet the required {required:g} %",
    }[best.verdict]
    exact = f", {best.exact_poses} by the exact joint test" if best.exact_poses is not None else ""
    missed = f"; not served: {', '.join(best.missed)}" if best.missed else ""
    if best.connected_percent is not None:
        missed += f"; {best.connected_percent:.1f} % of its positions are connected to the home position"
    return [
        attainable,
        f"Best candidate: {best.name} serves {share(best, total)}{exact}, and {done}{missed}.",
        limit_words(best, total, selection.attainable_poses),
    ]


def limited_by(actuator: RankedActuator, total: int, attainable: int) -> str:
    """What keeps an actuator from serving everything, in a word: a check, the robot, or nothing (a dash)."""
    if actuator.feasible_poses == total:
        return "–"
    if attainable <= actuator.feasible_poses:
        return "robot"
    check = actuator.limiting_check
    return "–" if check is None else check.value


def limit_words(actuator: RankedActuator, total: int, attainable: int) -> str:
    """What limits an actuator, and where."""
    check = actuator.limiting_check
    if not attainable:
        return "What limits it: nothing that a drive could change; no position is attainable."
    if attainable <= actuator.feasible_poses < total:
        return "What limits it: nothing that a drive could change; it serves every position that is attainable."
    if check is None:
        return "What limits it: no check could be evaluated."
    verdict = actuator.checks[check]
    if verdict.worst_utilisation is None or verdict.worst_position is None:
        return "What limits it: nothing that a drive could change; no position is attainable."
    where = ", ".join(f"{axis} {value:.3f}" for axis, value in zip("xyz", verdict.worst_position, strict=True))
    begins = "What limits it"
    if actuator.feasible_poses == total:
        begins = "Nearest to its limit"
    return (
        f"{begins}: {check.value} ({verdict.poses}/{total} on its own), most at {where} m, "
        f"where the demand is {utilisation_words(verdict.worst_utilisation)} of the limit."
    )
