"""Families of cable robots that a few lengths describe."""

from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import FloatArray
from actuator_select.model.robot import CableRobot, Counterbalance, Freedom, Plane


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


class Routing(StrEnum):
    """How the counterbalance rope of `planar_four` runs, figure 2 in the paper cited there."""

    NONE = "none"
    A = "a"
    B = "b"
    C = "c"
    D = "d"


def planar_four(  # noqa: PLR0913 - the paper's symbols, one each
    *,
    w: float,
    h: float,
    w_b: float,
    h_1: float,
    h_bu: float,
    w_p: float,
    h_p: float,
    h_bp: float,
    w_bp: float,
    routing: Routing,
    tension: tuple[float, float],
) -> CableRobot:
    """Four cables in a vertical plane and one counterbalance rope, as in [1]; its y is z here.

    Parameters
    ----------
    w, h : float
        Width and height of the frame, whose centre is the origin. [m]
    w_b : float
        Width of the platform. [m]
    h_1, h_bu : float
        Upper frame anchors stand at h/2 - h_1, lower platform anchors at h_bu above the platform's origin. [m]
    w_p, h_p : float
        The rope's pulleys on the frame stand at ±w_p and at the height h_p. [m]
    h_bp, w_bp : float
        The rope's pulleys on the platform: height above its origin, and distance of a pair. [m]
    routing : Routing
        Segments from platform to frame: (a) both from one pulley at the top, (b) from a pair at the top, (c) from a
        pair at the bottom, (d) from a pair at the top, with further segments to a pulley at the middle of the frame.
        The text of [1] gives the coordinates of (a) and (d); (b) and (c) are read off their description.
    tension : tuple of float
        Least and greatest tension T5 of the rope. [N]

    Returns
    -------
    CableRobot
        Cables 1 and 2 go up to the left and right, 3 and 4 down to the right and left.

    References
    ----------
    .. [1] R. Qi, H. Jamshidifar, A. Khajepour, "Workspace analysis and optimal design of cable-driven parallel robots
       via auxiliary counterbalances", 2020, arXiv:2012.12387; eqs. 25 and 26 with each cable's own length.
    """
    upper, lower = h / 2.0 - h_1, -h / 2.0
    segments = {
        Routing.NONE: [],
        Routing.A: [((0.0, h_bp), (-w_p, h_p)), ((0.0, h_bp), (w_p, h_p))],
        Routing.B: [((-w_bp / 2.0, h_bp), (-w_p, h_p)), ((w_bp / 2.0, h_bp), (w_p, h_p))],
        Routing.C: [((-w_bp / 2.0, -h_bp), (-w_p, h_p)), ((w_bp / 2.0, -h_bp), (w_p, h_p))],
        Routing.D: [
            ((-w_bp / 2.0, h_bp), (-w_p, h_p)),
            ((-w_bp / 2.0, h_bp), (0.0, h_p)),
            ((w_bp / 2.0, h_bp), (0.0, h_p)),
            ((w_bp / 2.0, h_bp), (w_p, h_p)),
        ],
    }[routing]
    rope = Counterbalance(
        frame_anchors=_upright([frame for _, frame in segments]),
        platform_anchors=_upright([platform for platform, _ in segments]),
        tension_min=tension[0],
        tension_max=tension[1],
    )
    return CableRobot(
        frame_anchors=_upright([(-w / 2.0, upper), (w / 2.0, upper), (w / 2.0, lower), (-w / 2.0, lower)]),
        platform_anchors=_upright([(-w_b / 2.0, 0.0), (w_b / 2.0, 0.0), (w_b / 2.0, h_bu), (-w_b / 2.0, h_bu)]),
        freedom=Freedom.PLANAR,
        plane=Plane.XZ,
        counterbalances=(rope,) if segments else (),
    )


def _upright(points: list[tuple[float, float]]) -> FloatArray:
    """Points of the x-z plane."""
    flat = np.array(points, dtype=np.float64).reshape(-1, 2)
    return np.column_stack([flat[:, 0], np.zeros(len(flat)), flat[:, 1]])


def six_six(*, r_base: float, r_end: float, gamma: float) -> CableRobot:
    """Six cables from pairs of points of a base circle to pairs of points of a platform's circle, hanging below it.

    The paper's z points down; here it points up, which mirrors y and z, the angles θ and φ with them.

    Parameters
    ----------
    r_base, r_end : float
        Radius of the base's and of the platform's circle. [m]
    gamma : float
        Angle between the points of a pair; 0 makes triangles. [rad]

    Returns
    -------
    CableRobot
        With the base in the plane z = 0.

    References
    ----------
    J. Hamedi, H. Zohoor, "Modeling and wrench feasible workspace analysis of a cable suspended robot for heavy loads
    handling", section 2.1; after J. Pusey et al. 2004, doi:10.1016/j.mechmachtheory.2004.02.010.
    """
    third = 2.0 * np.pi / 3.0
    base = np.array([k * third + side * gamma / 2.0 for k in range(3) for side in (-1.0, 1.0)])
    platform = np.array([k * third + side * (third - gamma) / 2.0 for k in range(3) for side in (-1.0, 1.0)])
    return CableRobot(
        frame_anchors=r_base * _on_circle(base), platform_anchors=r_end * _on_circle(platform), freedom=Freedom.SPATIAL
    )


def _on_circle(angles: FloatArray) -> FloatArray:
    """Points of the unit circle, y mirrored."""
    return np.column_stack([np.cos(angles), -np.sin(angles), np.zeros(len(angles))])


def suspended_eight(hall: FloatArray, platform: FloatArray) -> CableRobot:
    """Eight cables from the upper corners of a hall, two from each, wound about a box-shaped platform.

    From every corner one cable goes to a lower vertex of the platform that lies a quarter turn away in one sense, the
    other to an upper vertex a quarter turn away in the other sense, the arrangement of the CoGiRo.

    Parameters
    ----------
    hall : (3,) array
        Length, width and height of the space between the pulleys: -length/2 to length/2, -width/2 to width/2, 0 to
        height. [m]
    platform : (3,) array
        Length, width and height of the platform; its origin is the centre of the box. [m]

    Returns
    -------
    CableRobot
        With six degrees of freedom.

    References
    ----------
    M. Gouttefarde et al., "Geometry selection of a redundantly actuated cable-suspended parallel robot", IEEE
    Transactions on Robotics 31(2), 2015, doi:10.1109/TRO.2015.2400253.
    """
    corners = np.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]])
    top = np.column_stack([corners * hall[:2] / 2.0, np.full(4, hall[2])])
    frame, vertices = [], []
    for index in range(4):
        for step, height in ((-1, -0.5), (1, 0.5)):
            frame.append(top[index])
            vertices.append([*(corners[(index + step) % 4] * platform[:2] / 2.0), height * platform[2]])
    return CableRobot(frame_anchors=np.array(frame), platform_anchors=np.array(vertices), freedom=Freedom.SPATIAL)


def constrained_eight(hall: FloatArray, platform: FloatArray) -> CableRobot:
    """Eight cables from all corners of a hall, crossed: from the upper corners to the platform's lower vertices.

    The upper cables of corners that are neighbours along x change places besides, because with cables from corner to
    corner a platform shaped like the hall could not be kept from turning.

    Parameters
    ----------
    hall, platform : (3,) array
        As for `suspended_eight`; the lower pulleys stand at z = 0. [m]

    Returns
    -------
    CableRobot
        With six degrees of freedom.
    """
    corners = np.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]])
    frame, vertices = [], []
    for level, height, neighbours in ((hall[2], -0.5, (3, 2, 1, 0)), (0.0, 0.5, (0, 1, 2, 3))):
        for index, neighbour in enumerate(neighbours):
            frame.append([*(corners[index] * hall[:2] / 2.0), level])
            vertices.append([*(corners[neighbour] * platform[:2] / 2.0), height * platform[2]])
    return CableRobot(frame_anchors=np.array(frame), platform_anchors=np.array(vertices), freedom=Freedom.SPATIAL)


def hall_region(hall: FloatArray, platform: FloatArray) -> FloatArray:
    """Box in which the platform's origin has room: the hall less half the platform's diagonal on every side.

    Parameters
    ----------
    hall, platform : (3,) array
        As for `suspended_eight`. [m]

    Returns
    -------
    (3, 2) array
        Lower and upper end of x, y and z; empty (lower > upper) where the platform does not fit. [m]
    """
    margin = np.linalg.norm(platform) / 2.0
    lower, upper = np.array([-hall[0], -hall[1], 0.0]), np.array([hall[0], hall[1], 2.0 * hall[2]])
    lower, upper = lower / 2.0 + margin, upper / 2.0 - margin
    return np.column_stack([lower, upper])
