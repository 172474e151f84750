"""What the platform's motion asks of the cables together: the required wrench."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiredWrench:
    """Wrench that the cables must supply, w(a) = static + per_acceleration · a.

    Attributes
    ----------
    static : (6,) array
        At rest: force [N], then moment about the platform's origin [N m].
    per_acceleration : (6, 3) array
        Per unit of the platform's acceleration. [kg, kg m]
    """

    static: FloatArray
    per_acceleration: FloatArray


def required_wrench(mass: float, gravity: float) -> RequiredWrench:
    """Wrench of a load that translates: F = m (a - gravity vector), no moments.

    Eq. 31 in [1] prints m (z̈ - g); with z up, as in its figures, gravity has to be *added* for a load that hangs.

    Parameters
    ----------
    mass : float
        Mass of carrier and load, its centre at the platform's origin. [kg]
    gravity : float
        Gravitational acceleration, acting along -z. [m/s²]

    Returns
    -------
    RequiredWrench
        Affine in the acceleration.

    References
    ----------
    .. [1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    static = np.zeros(6)
    static[2] = mass * gravity
    per_acceleration = np.zeros((6, 3))
    per_acceleration[:3] = mass * np.eye(3)
    return RequiredWrench(static=static, per_acceleration=per_acceleration)
