"""How the cables share the required wrench."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.hyperplanes import WrenchSets
from actuator_select.model.robot import CableRobot

RANK_TOLERANCE = 1e-9  # relative to the largest singular value
BALANCE_TOLERANCE = 1e-9  # of a wrench that nothing balances, relative to the norm of the largest required one


class TensionModel(StrEnum):
    """Rule by which tensions are found."""

    WRENCH_FEASIBLE = "wrench_feasible"
    FORCE_ONLY = "force_only"
    PSEUDO_INVERSE = "pseudo_inverse"

    @property
    def lets_cables_push(self) -> bool:
        """Whether tensions may be negative."""
        return self is TensionModel.PSEUDO_INVERSE


def balanced_rows(robot: CableRobot, model: TensionModel) -> tuple[int, ...]:
    """Rows of the structure matrix that have to be balanced: those of the forces alone under `FORCE_ONLY`."""
    return robot.translation_rows if model is TensionModel.FORCE_ONLY else robot.wrench_rows


@dataclass(frozen=True, slots=True, kw_only=True)
class PseudoInverse:
    """W⁺ of Q structure matrices.

    Attributes
    ----------
    matrix : (Q, m, n) array
        W⁺.
    residual_maker : (Q, n, n) array
        E - W W⁺, what of a wrench is left unbalanced.
    rank : (Q,) array
        Of W.
    """

    matrix: FloatArray
    residual_maker: FloatArray
    rank: IntArray


def pseudo_inverse(structure_matrix: FloatArray) -> PseudoInverse:
    """Moore-Penrose inverse of (Q, n, m) structure matrices, N and N m taken alike.

    Its tensions t = W⁺ w have the least Euclidean norm; where w is out of the range of W, they leave the least
    residual. A negative one, a cable that pushes, is a result, not an error.

    References
    ----------
    Eq. 20 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    left, sigma, right = np.linalg.svd(structure_matrix, full_matrices=False)
    kept = sigma > RANK_TOLERANCE * sigma[:, :1]
    inverse_sigma = np.divide(1.0, sigma, out=np.zeros_like(sigma), where=kept)
    matrix = right.swapaxes(-1, -2) @ (inverse_sigma[..., None] * left.swapaxes(-1, -2))
    identity = np.eye(structure_matrix.shape[1])
    return PseudoInverse(
        matrix=matrix, residual_maker=identity - structure_matrix @ matrix, rank=kept.sum(axis=-1, dtype=np.int64)
    )


def leaves_unbalanced(inverse: PseudoInverse, wrenches: WrenchSets, which: IntArray, shift: FloatArray) -> BoolArray:
    """Tell where the pseudo-inverse leaves a part of the required wrenches unbalanced, (Q, G).

    Parameters
    ----------
    inverse : PseudoInverse
        At Q poses.
    wrenches : WrenchSets
        What is required, N and N m unscaled.
    which : (Q,) array
        Index of every pose's sets.
    shift : (Q, n) array
        Wrench that counterbalances supply.

    Returns
    -------
    (Q, G) array of bool
        True where a component of the residual exceeds `BALANCE_TOLERANCE` of the wrenches.
    """
    centre = wrenches.centre[which] - shift[:, None]
    size = np.abs(centre) + np.abs(wrenches.segments[which]).sum(axis=2)
    size += np.linalg.norm(wrenches.balls[which], axis=-1).sum(axis=2)
    tolerance = BALANCE_TOLERANCE * np.linalg.norm(size, axis=-1)
    worst = np.zeros(centre.shape[:2])
    for row in range(centre.shape[-1]):
        left = inverse.residual_maker[:, row]
        middle = np.abs(np.einsum("qn,qgn->qg", left, centre))
        np.maximum(worst, middle + wrenches.reach(left, which), out=worst)
    exceeds: BoolArray = worst > tolerance
    return exceeds
