"""Cable-driven robots: where the cables are fixed, and the families that a few lengths describe."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class CableRobot:
    """A platform on m cables.

    Attributes
    ----------
    frame_anchors : (m, 3) array
        Where each cable leaves the frame, world frame, z up. [m]
    platform_anchors : (m, 3) array
        Where each cable is fixed, platform frame, origin at the centre of mass. [m]
    """

    frame_anchors: FloatArray
    platform_anchors: FloatArray

    def __post_init__(self) -> None:
        for name in ("frame_anchors", "platform_anchors"):
            anchors = np.array(getattr(self, name), dtype=np.float64)
            anchors.flags.writeable = False
            object.__setattr__(self, name, anchors)
        if self.frame_anchors.ndim != 2 or self.frame_anchors.shape[1] != 3 or not len(self.frame_anchors):  # noqa: PLR2004 - x, y, z
            raise ValueError(f"{self.frame_anchors.shape=}, expected (cables, 3) with at least one cable")
        if self.platform_anchors.shape != self.frame_anchors.shape:
            raise ValueError(f"{self.platform_anchors.shape=} but {self.frame_anchors.shape=}")
        if not (np.isfinite(self.frame_anchors).all() and np.isfinite(self.platform_anchors).all()):
            raise ValueError("anchors must be finite")

    @property
    def cables(self) -> int:
        """Number of cables m."""
        return len(self.frame_anchors)

    @property
    def degrees_of_freedom(self) -> int:
        """3 for a point mass, whose cables all meet in the platform's origin; 6 for a body."""
        return 6 if self.platform_anchors.any() else 3


def cpr8(frame: FloatArray, carrier: FloatArray) -> CableRobot:
    """Eight-cable robot CPR-8: a box-shaped carrier hung by its vertices inside a box-shaped frame.

    Cables 1 to 4 join the carrier's upper vertices A, B, C, D to the frame's upper corners O, F, G, H; cables 5 to 8
    the lower vertices to the points one carrier height below those corners (figure 1 in [1]).

    Parameters
    ----------
    frame : (3,) array
        Length d, width s and height v of the frame. The frame spans 0 to d, 0 to s and -v to 0. [m]
    carrier : (3,) array
        Length l, width w and height h_o of the carrier. [m]

    Returns
    -------
    CableRobot
        With eight cables in the paper's order.

    References
    ----------
    .. [1] M. Filipović, Lj. B. Kevac, "A novel methodology for choosing actuators of cable-suspended parallel
       robots", Facta Universitatis, Automatic Control and Robotics 17(2), 2018, doi:10.22190/FUACR1802071F.
    """
    side = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=np.float64)
    upper_frame = np.column_stack([(side + 1.0) / 2.0 * frame[:2], np.zeros(4)])
    upper_platform = np.column_stack([side * carrier[:2] / 2.0, np.full(4, carrier[2] / 2.0)])  # eqs. 1-4 in [1]
    lower_platform = upper_platform * np.array([1.0, 1.0, -1.0])  # eqs. 5-8 in [1]
    lower_frame = upper_frame - np.array([0.0, 0.0, carrier[2]])  # eqs. 14-17 in [1]
    return CableRobot(
        frame_anchors=np.vstack([upper_frame, lower_frame]),
        platform_anchors=np.vstack([upper_platform, lower_platform]),
    )


def cpr8_region(frame: FloatArray, carrier: FloatArray) -> FloatArray:
    """Reduced geometric workspace of the CPR-8: the frame less half the carrier's diagonal on every side.

    Parameters
    ----------
    frame, carrier : (3,) array
        As for `cpr8`. [m]

    Returns
    -------
    (3, 2) array
        Lower and upper end of x, y and z; empty (lower > upper) where the carrier does not fit. [m]

    References
    ----------
    Section 3 and figure 3 of the paper cited in `cpr8`.
    """
    margin = np.linalg.norm(carrier) / 2.0  # d_e
    lower = np.array([0.0, 0.0, -frame[2]]) + margin
    upper = np.array([frame[0], frame[1], 0.0]) - margin
    return np.column_stack([lower, upper])
