"""What a result rests on that a real robot cannot do, in words."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.demand import Demand
from actuator_select.model.tension import TensionModel


@dataclass(frozen=True, slots=True, kw_only=True)
class Warned:
    """Something that the percentages rest on and a real robot cannot do.

    Attributes
    ----------
    code : str
        Stable name.
    poses : int
        Positions where it happens, at one listed orientation or more.
    text : str
        For people.
    """

    code: str
    poses: int
    text: str


def demand_warnings(demand: Demand, *, apart: int = 0, moments_left_out: bool = False) -> tuple[Warned, ...]:
    """What a demand rests on that real cables cannot do, with the positions concerned.

    Parameters
    ----------
    demand : Demand
        Under any tension model.
    apart : int
        Positions that were set apart because a cable would be too short.
    moments_left_out : bool
        Whether the robot's degrees of freedom leave out moments that its cables exert.

    Returns
    -------
    tuple of Warned
        Only what happens somewhere.
    """
    total = len(demand.positions)
    everywhere = np.ones(len(demand.lengths), dtype=np.bool_)
    nowhere = ~everywhere
    slack = not demand.tension_model.lets_cables_push and bool((demand.tension_min <= 0.0).any())
    found = (
        (
            "moments_left_out",
            everywhere if demand.tension_model is TensionModel.FORCE_ONLY or moments_left_out else nowhere,
            "moments are not balanced: the platform hangs, and may turn",
        ),
        (
            "slack_cables",
            everywhere if slack else nowhere,
            "a cable may go slack, because its least tension is 0",
        ),
        (
            "unreachable",
            demand.unreachable,
            "a cable would have to be longer than cables.length_max_m; such positions count as not served",
        ),
        (
            "zero_length_cable",
            np.any(demand.lengths <= 0.0, axis=1),
            "a cable has no length and so no direction; such positions count as not served",
        ),
        (
            "rank_deficient",
            demand.rank_deficient,
            "the structure matrix is short of rank: no tensions can balance every force and moment on the platform",
        ),
        (
            "negative_tension_at_rest",
            demand.negative_at_rest,
            "a cable would have to push while the platform stands still; real cables cannot push",
        ),
        (
            "negative_tension_in_motion",
            demand.negative_in_motion,
            "a cable would have to push somewhere in the motion set; real cables cannot push",
        ),
        (
            "unbalanced_wrench",
            demand.unbalanced,
            "the pseudo-inverse leaves part of the required wrench unbalanced somewhere in the motion set",
        ),
    )
    counts = ((code, demand.positions_with(poses), reason) for code, poses, reason in found)
    warnings = [
        Warned(code=code, poses=count, text=f"At {count} of {total} positions {reason}.")
        for code, count, reason in counts
        if count
    ]
    if apart:
        text = f"{apart} positions lie nearer to an anchor than cables.length_min_m and are left out of every share."
        warnings.append(Warned(code="too_near_anchor", poses=apart, text=text))
    return tuple(warnings)
