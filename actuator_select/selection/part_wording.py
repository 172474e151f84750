"""What results say about gearboxes and drums beside the checks: inertias left out, stated limits exceeded."""

from collections.abc import Sequence

from actuator_select.selection.inertias import NO_DRUM, NO_GEARBOX
from actuator_select.selection.results import RankedActuator
from actuator_select.selection.wording import some_of

MOST_WARNED = 5  # actuators whose exceeded limits are told one by one


def left_out_note(actuators: Sequence[RankedActuator]) -> str:
    """What the inertias of which actuators leave out, in one sentence; empty where they are complete."""
    found: dict[tuple[str, ...], list[str]] = {}
    for actuator in actuators:
        if actuator.left_out:
            found.setdefault(actuator.left_out, []).append(actuator.name)
    if not found:
        return ""
    groups = [f"{_joined(what)}, for {some_of(names, len(actuators))}" for what, names in found.items()]
    return f"Left out, because neither catalogue nor study states it: {'; '.join(groups)}."


def exceeded_words(actuator: RankedActuator) -> str:
    """Stated limits of an actuator's parts that the demand exceeds; empty where it exceeds none."""
    if not actuator.exceeded:
        return ""
    limits = "; ".join(one.text for one in actuator.exceeded)
    return f"{actuator.name}: beyond what its parts may bear, which no check holds yet: {limits}."


def exceeded_notes(actuators: Sequence[RankedActuator]) -> list[str]:
    """The same for several actuators, the first few one by one, the others counted."""
    notes = [words for actuator in actuators if (words := exceeded_words(actuator))]
    rest = len(notes) - MOST_WARNED
    if rest <= 0:
        return notes
    return [*notes[:MOST_WARNED], f"and {rest} more beyond what their parts may bear."]


def _joined(left_out: tuple[str, ...]) -> str:
    return "inertia of gearbox and drum" if left_out == (NO_GEARBOX, NO_DRUM) else " and ".join(left_out)
