"""From poses to cables: lengths, directions and the structure matrix."""

from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray
from actuator_select.model.robot import CableRobot

LEAST_CABLE_LENGTH = 1e-9  # m; a shorter cable has no direction that rounding leaves


@dataclass(frozen=True, slots=True, kw_only=True)
class CableGeometry:
    """Cables at Q poses.

    Attributes
    ----------
    lengths : (Q, m) array
        Straight cable length. [m]
    directions : (Q, m, 3) array
        Unit vector from the platform to the frame, world frame. [-]
    arms : (Q, m, 3) array
        From the platform's origin to the platform anchors, R b, world frame. [m]
    structure_matrix : (Q, 6, m) array
        Wrench on the platform per unit of tension: force, then moment about the platform's origin. [-, m]
    """

    lengths: FloatArray
    directions: FloatArray
    arms: FloatArray
    structure_matrix: FloatArray


def rotation_matrix(orientation: FloatArray) -> FloatArray:
    """Rotation R = Rz(φ) Ry(θ) Rx(ψ).

    Parameters
    ----------
    orientation : (..., 3) array
        Angles ψ, θ, φ. [rad]

    Returns
    -------
    (..., 3, 3) array
        From platform to world coordinates.

    References
    ----------
    Eq. 9 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    angles = np.asarray(orientation, dtype=np.float64)
    (cx, cy, cz), (sx, sy, sz) = np.moveaxis(np.cos(angles), -1, 0), np.moveaxis(np.sin(angles), -1, 0)
    rows = [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def position_grid(region: FloatArray, points: tuple[int, int, int], *, midpoints: bool = False) -> FloatArray:
    """Positions of a regular grid; a single point on an axis stands in its middle.

    Parameters
    ----------
    region : (3, 2) array
        Lower and upper end of each axis. [m]
    points : tuple of int
        Number of points on each axis, at least 1.
    midpoints : bool
        Take the midpoints of so many equal cells instead of nodes with both ends included.

    Returns
    -------
    (P, 3) array
        z varies fastest. [m]
    """
    axes = []
    for (lower, upper), count in zip(region, points, strict=True):
        half = (upper - lower) / (2.0 * count) if midpoints or count == 1 else 0.0
        axes.append(np.linspace(lower + half, upper - half, count))
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def cable_geometry(robot: CableRobot, positions: FloatArray, orientations: FloatArray) -> CableGeometry:
    """Cable lengths, directions and structure matrix.

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    positions : (Q, 3) array
        Position of the platform's origin. [m]
    orientations : (Q, 3) or (3,) array
        Angles ψ, θ, φ. [rad]

    Returns
    -------
    CableGeometry
        A cable shorter than `LEAST_CABLE_LENGTH` has length and direction 0, so that it carries nothing.

    References
    ----------
    Eqs. 1-17 and 19 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
    """
    return segment_geometry(robot.frame_anchors, robot.platform_anchors, positions, orientations)


def segment_geometry(
    frame_anchors: FloatArray, platform_anchors: FloatArray, positions: FloatArray, orientations: FloatArray
) -> CableGeometry:
    """As `cable_geometry`, of any straight segments between frame and platform, such as a counterbalance's."""
    arms = np.einsum("...ij,mj->...mi", rotation_matrix(orientations), platform_anchors)  # R b_i
    arms = np.broadcast_to(arms, (len(positions), len(frame_anchors), 3))
    cables = frame_anchors - positions[:, None, :] - arms
    lengths = np.linalg.norm(cables, axis=-1)
    lengths[lengths < LEAST_CABLE_LENGTH] = 0.0
    directions = np.divide(cables, lengths[..., None], out=np.zeros_like(cables), where=lengths[..., None] > 0.0)
    moments = np.cross(arms, directions)
    structure_matrix = np.concatenate([directions, moments], axis=-1).swapaxes(-1, -2)
    return CableGeometry(lengths=lengths, directions=directions, arms=arms, structure_matrix=structure_matrix)


def too_near(robot: CableRobot, positions: FloatArray, orientations: FloatArray) -> BoolArray:
    """Tell the positions at which some cable is shorter than its least length at some orientation.

    Parameters
    ----------
    robot : CableRobot
        With `length_min` of m cables.
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        Angles ψ, θ, φ. [rad]

    Returns
    -------
    (P,) array of bool
        All False where no least length is stated.
    """
    near = np.zeros(len(positions), dtype=np.bool_)
    for cable in np.flatnonzero(robot.bounds.length_min > 0.0):
        for rotation in rotation_matrix(orientations):
            end = robot.frame_anchors[cable] - rotation @ robot.platform_anchors[cable]
            near |= np.linalg.norm(positions - end, axis=1) < robot.bounds.length_min[cable]
    return near


def least_cable_lengths(robot: CableRobot, start: FloatArray, stop: FloatArray, orientation: FloatArray) -> FloatArray:
    """Shortest length of every cable over a straight line at constant orientation, (m,). [m].

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    start, stop : (3,) array
        Ends of the line, apart from each other. [m]
    orientation : (3,) array
        Angles ψ, θ, φ. [rad]

    Returns
    -------
    (m,) array
        In closed form, not only at sampled points.
    """
    arms = robot.platform_anchors @ rotation_matrix(orientation).T
    ends = robot.frame_anchors - arms  # where the platform's origin would be with a cable of no length
    line = stop - start
    along = np.clip((ends - start) @ line / (line @ line), 0.0, 1.0)
    least: FloatArray = np.linalg.norm(ends - start - along[:, None] * line, axis=1)
    return least
