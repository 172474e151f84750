"""Geometry of the cables."""

import numpy as np
import pytest

from actuator_select.model.families import cpr8, cpr8_region
from actuator_select.model.kinematics import cable_geometry, position_grid, rotation_matrix
from actuator_select.model.robot import CableRobot

FRAME, CARRIER = np.array([3.2, 2.2, 2.2]), np.array([0.224, 0.154, 0.140])


@pytest.fixture
def robot() -> CableRobot:
    generator = np.random.default_rng(5)
    return CableRobot(
        frame_anchors=generator.uniform(-3.0, 3.0, (7, 3)), platform_anchors=generator.uniform(-0.3, 0.3, (7, 3))
    )


def test_rotation_turns_about_x_then_y_then_z() -> None:
    quarter = np.pi / 2.0
    assert rotation_matrix(np.array([quarter, 0.0, 0.0])) @ [0.0, 1.0, 0.0] == pytest.approx([0.0, 0.0, 1.0])
    assert rotation_matrix(np.array([0.0, quarter, 0.0])) @ [0.0, 0.0, 1.0] == pytest.approx([1.0, 0.0, 0.0])
    assert rotation_matrix(np.array([0.0, 0.0, quarter])) @ [1.0, 0.0, 0.0] == pytest.approx([0.0, 1.0, 0.0])
    # x first: the y axis goes to z, which turning about y takes to x.
    assert rotation_matrix(np.array([quarter, quarter, 0.0])) @ [0.0, 1.0, 0.0] == pytest.approx([1.0, 0.0, 0.0])


def test_finite_difference_cable_rates_equal_minus_the_structure_matrix_transposed_times_the_twist(
    robot: CableRobot,
) -> None:
    position, angles = np.array([0.2, -0.1, 0.4]), np.array([0.3, -0.2, 0.5])
    velocity, angular_velocity = np.array([0.7, -0.4, 0.2]), np.array([0.3, 0.6, -0.5])
    geometry = cable_geometry(robot, position[None], angles)
    step = 1e-6
    lengths = []
    for time in (-step, step):
        # Turn the platform about the world axis: Rodrigues to second order is exact enough for a central difference.
        spin = np.cross(np.eye(3), angular_velocity * time)
        turned = (np.eye(3) + spin + spin @ spin / 2.0) @ rotation_matrix(angles)
        cables = robot.frame_anchors - (position + velocity * time) - robot.platform_anchors @ turned.T
        lengths.append(np.linalg.norm(cables, axis=1))
    rates = (lengths[1] - lengths[0]) / (2.0 * step)
    twist = np.concatenate([velocity, angular_velocity])
    assert rates == pytest.approx(-geometry.structure_matrix[0].T @ twist, abs=1e-8)


def test_cpr8_lengths_are_those_of_equations_10_to_17() -> None:
    position = np.array([1.1, 0.7, -0.9])
    lengths = cable_geometry(cpr8(FRAME, CARRIER), position[None], np.zeros(3)).lengths[0]
    (d, s, _), (length, width, height) = FRAME, CARRIER
    x, y, z = position
    upper_a = np.sqrt((x - length / 2) ** 2 + (y - width / 2) ** 2 + (z + height / 2) ** 2)
    lower_c = np.sqrt((d - x - length / 2) ** 2 + (s - y - width / 2) ** 2 + (height + z - height / 2) ** 2)
    assert lengths[0] == pytest.approx(upper_a, abs=1e-14)
    assert lengths[6] == pytest.approx(lower_c, abs=1e-14)


def test_cpr8_region_is_the_frame_less_half_the_carriers_diagonal() -> None:
    margin = 0.1528823
    assert cpr8_region(FRAME, CARRIER) == pytest.approx(
        np.array([[margin, 3.2 - margin], [margin, 2.2 - margin], [-2.2 + margin, -margin]]), abs=1e-6
    )


def test_grid_includes_both_ends_and_a_single_point_stands_in_the_middle() -> None:
    grid = position_grid(np.array([[0.0, 1.0], [2.0, 4.0], [-1.0, 0.0]]), (3, 1, 2))
    assert grid.tolist() == [
        [0.0, 3.0, -1.0],
        [0.0, 3.0, 0.0],
        [0.5, 3.0, -1.0],
        [0.5, 3.0, 0.0],
        [1.0, 3.0, -1.0],
        [1.0, 3.0, 0.0],
    ]


def test_a_cable_without_length_has_no_direction() -> None:
    robot = CableRobot(frame_anchors=np.array([[0.0, 0.0, 1.0]]), platform_anchors=np.zeros((1, 3)))
    geometry = cable_geometry(robot, np.array([[0.0, 0.0, 1.0]]), np.zeros(3))
    assert geometry.lengths[0, 0] == 0.0
    assert geometry.directions[0, 0].tolist() == [0.0, 0.0, 0.0]


def test_anchors_that_do_not_match_are_refused() -> None:
    with pytest.raises(ValueError, match="platform_anchors"):
        CableRobot(frame_anchors=np.zeros((4, 3)), platform_anchors=np.zeros((3, 3)))
    with pytest.raises(ValueError, match="finite"):
        CableRobot(frame_anchors=np.full((1, 3), np.nan), platform_anchors=np.zeros((1, 3)))


def test_a_point_mass_has_three_degrees_of_freedom_and_a_body_six() -> None:
    anchors = np.array([[0.0, 0.0, 2.0], [3.0, 0.0, 2.0], [3.0, 2.0, 2.0], [0.0, 2.0, 2.0]])
    assert CableRobot(frame_anchors=anchors, platform_anchors=np.zeros((4, 3))).degrees_of_freedom == 3
    assert cpr8(FRAME, CARRIER).degrees_of_freedom == 6


def test_a_cable_whose_length_is_rounding_has_neither_length_nor_direction() -> None:
    frame = np.array([[0.3, -0.7, 1.9], [2.0, 1.0, 3.0]])
    placed = np.array([[0.1, 0.2, -0.7], [0.0, 0.0, 0.1]])
    robot = CableRobot(frame_anchors=frame, platform_anchors=placed)
    off = np.array([[1e-16, 0.0, 0.0], [0.0, 1e-12, 0.0]])
    geometry = cable_geometry(robot, frame[0] - placed[0] + off, np.zeros(3))
    assert (geometry.lengths[:, 0] == 0.0).all()
    assert (geometry.directions[:, 0] == 0.0).all()
    assert (geometry.lengths[:, 1] > 1.0).all()
