"""Verdicts on evaluated actuators, and the order in which they are shown."""

from enum import StrEnum
from math import ceil

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.evaluation import Evaluation

PERCENT_TOLERANCE = 1e-9  # per cent; 90 % of 10 positions is 9 positions, whatever the rounding


class State(StrEnum):
    """What became of one check of one actuator."""

    PASSED = "passed"
    FAILED = "failed"
    NOT_EVALUATED = "not_evaluated"
    NOT_APPLICABLE = "not_applicable"


class Verdict(StrEnum):
    """What became of one actuator, best first."""

    MEETS = "meets"
    UNDECIDED = "undecided"
    FAILS = "fails"


def meets_share(positions: IntArray, total: int, required_percent: float) -> BoolArray:
    """Tell whether so many positions out of `total` are at least the required share, elementwise."""
    enough: BoolArray = 100.0 * positions / total >= required_percent - PERCENT_TOLERANCE
    return enough


def required_positions(total: int, required_percent: float) -> int:
    """Least number of positions, 1 or more, that is at least the required share of `total`."""
    return max(1, ceil(total * required_percent / 100.0 - PERCENT_TOLERANCE))


def verdicts(evaluation: Evaluation, required_percent: float, served: list[bool | None] | None = None) -> list[Verdict]:
    """Judge every actuator.

    An actuator with a check that could not be evaluated, or to which none applies, is at best undecided; it fails only
    if the checks that could be evaluated exclude too many positions already. A check that does not apply to it counts
    for nothing.

    Parameters
    ----------
    evaluation : Evaluation
        Of C actuators.
    required_percent : float
        Share of the positions that has to be served.
    served : list of bool or None, optional
        For every actuator, whether it serves all places that have to be served; None where that is unknown.

    Returns
    -------
    list of Verdict
        One per actuator.
    """
    enough = meets_share(evaluation.positions, len(evaluation.demand.positions), required_percent)
    decided = evaluation.decided
    places: list[bool | None] = [True] * len(enough) if served is None else served
    return [
        Verdict.FAILS
        if not reached or place is False
        else Verdict.UNDECIDED
        if not known or place is None
        else Verdict.MEETS
        for reached, known, place in zip(enough, decided, places, strict=True)
    ]


def worst_utilisation(evaluation: Evaluation) -> FloatArray:
    """Largest utilisation over the evaluated checks, (C,); NaN where none was evaluated."""
    stacked = np.stack([count.worst_utilisation for count in evaluation.checks.values()])
    worst: FloatArray = np.fmax.reduce(stacked, axis=0)
    return worst


def ranking_order(evaluation: Evaluation, verdict: list[Verdict]) -> IntArray:
    """Order by verdict, feasible share, fewest checks not evaluated, smallest worst utilisation.

    Checks that do not apply are no checks that were not evaluated.

    Parameters
    ----------
    evaluation : Evaluation
        Of C actuators.
    verdict : list of Verdict
        As `verdicts` gives them.

    Returns
    -------
    (C,) array
        Indices, best first; equal actuators keep their order.
    """
    place = {verdict: index for index, verdict in enumerate(Verdict)}
    standing = np.array([place[one] for one in verdict], dtype=np.int64)
    order: IntArray = np.lexsort(
        (worst_utilisation(evaluation), evaluation.open_checks, -evaluation.positions, standing)
    )
    return order
