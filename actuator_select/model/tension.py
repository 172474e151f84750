"""How the cables share the required wrench."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.dynamics import RequiredWrench

RANK_TOLERANCE = 1e-9  # relative to the largest singular value
BALANCE_TOLERANCE = 1e-9  # relative to the norm of the largest required wrench, N and N m taken alike


class TensionModel(StrEnum):
    """Rule by which tensions are found."""

    PSEUDO_INVERSE = "pseudo_inverse"


@dataclass(frozen=True, slots=True, kw_only=True)
class CableTensions:
    """Tensions t(a) = static + per_acceleration · a at Q poses, positive in pull, and what they leave unbalanced.

    Attributes
    ----------
    static : (Q, m) array
        At rest. [N]
    per_acceleration : (Q, m, 3) array
        Per unit of the platform's acceleration. [kg]
    rank : (Q,) array
        Rank of the structure matrix.
    residual_static : (Q, 6) array
        Required wrench less the wrench of the tensions, at rest. [N, N m]
    residual_per_acceleration : (Q, 6, 3) array
        The same per unit of acceleration. [kg, kg m]
    """

    static: FloatArray
    per_acceleration: FloatArray
    rank: IntArray
    residual_static: FloatArray
    residual_per_acceleration: FloatArray


def pseudo_inverse_tensions(structure_matrix: FloatArray, wrench: RequiredWrench) -> CableTensions:
    """Tensions of least Euclidean norm, t = W⁺ w; where w is out of the range of W, of the least residual.

    The model lets a cable push: a negative tension is a result, not an error.

    Parameters
    ----------
    structure_matrix : (Q, 6, m) array
        W.
    wrench : RequiredWrench
        w, affine in the acceleration.

    Returns
    -------
    CableTensions
        At the Q poses.

    References
    ----------
    Eq. 20 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    left, sigma, right = np.linalg.svd(structure_matrix, full_matrices=False)
    kept = sigma > RANK_TOLERANCE * sigma[:, :1]
    inverse_sigma = np.divide(1.0, sigma, out=np.zeros_like(sigma), where=kept)
    columns = np.column_stack([wrench.static, wrench.per_acceleration])  # (6, 4)
    projected = left.swapaxes(-1, -2) @ columns
    tensions = right.swapaxes(-1, -2) @ (inverse_sigma[..., None] * projected)  # (Q, m, 4)
    residual = columns - structure_matrix @ tensions
    return CableTensions(
        static=np.ascontiguousarray(tensions[..., 0]),
        per_acceleration=np.ascontiguousarray(tensions[..., 1:]),
        rank=kept.sum(axis=-1, dtype=np.int64),
        residual_static=residual[..., 0],
        residual_per_acceleration=residual[..., 1:],
    )


def unbalanced(
    tensions: CableTensions, wrench: RequiredWrench, acceleration_lower: FloatArray, acceleration_upper: FloatArray
) -> BoolArray:
    """Tell the poses whose tensions do not balance the required wrench somewhere in a box of accelerations.

    Parameters
    ----------
    tensions : CableTensions
        At Q poses.
    wrench : RequiredWrench
        What they should balance.
    acceleration_lower, acceleration_upper : (3,) array
        Corners of the box. [m/s²]

    Returns
    -------
    (Q,) array of bool
        True where a component of the residual exceeds `BALANCE_TOLERANCE`.
    """
    centre, half = (acceleration_lower + acceleration_upper) / 2.0, (acceleration_upper - acceleration_lower) / 2.0
    middle = tensions.residual_static + tensions.residual_per_acceleration @ centre
    largest = np.abs(middle) + np.abs(tensions.residual_per_acceleration) @ half
    return exceeds_balance(largest, wrench, np.maximum(np.abs(acceleration_lower), np.abs(acceleration_upper)))


def exceeds_balance(residual: FloatArray, wrench: RequiredWrench, acceleration: FloatArray) -> BoolArray:
    """Tell where a residual is more than rounding.

    Parameters
    ----------
    residual : (..., 6) array
        Required wrench less the wrench of the tensions. [N, N m]
    wrench : RequiredWrench
        What is required.
    acceleration : (..., 3) array
        Its magnitudes, axis by axis. [m/s²]

    Returns
    -------
    (...) array of bool
        True where a component exceeds `BALANCE_TOLERANCE` of the required wrench.
    """
    reach = np.abs(wrench.static) + acceleration @ np.abs(wrench.per_acceleration).T
    tolerance = BALANCE_TOLERANCE * np.linalg.norm(reach, axis=-1, keepdims=True)
    exceeds: BoolArray = np.any(np.abs(residual) > tolerance, axis=-1)
    return exceeds
