"""Numbers of other published robots: IPAnema 1 (WireX), CoGiRo, and the CPR-8 with cables that only pull."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from actuator_select import Catalogue, load_study, rank
from actuator_select.model.cable_motion import cable_motion
from actuator_select.model.demand import compute_demand
from actuator_select.model.dynamics import RequiredWrench
from actuator_select.model.kinematics import cable_geometry, rotation_matrix
from actuator_select.model.motion import MotionSet, SetShape, independent_motion, rest
from actuator_select.model.robot import CableBounds, CableRobot
from actuator_select.model.tension import TensionModel, pseudo_inverse
from actuator_select.selection.selection import study_demand

FOLDER = Path(__file__).parent / "reference"


def reference(name: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    return content


IPANEMA, COGIRO, CPR8 = reference("ipanema1"), reference("cogiro"), reference("cpr8")

# ---- IPAnema 1 ----

POSE = np.array([0.5, 0.3, 0.8])
PUSH = np.array([0.0, 0.0, -5.0, 0.0, 0.0, 0.0])  # on the platform: W t + w = 0
POSED = "tensions_n at [0.5, 0.3, 0.8], R = I, w = (0, 0, -5, 0, 0, 0)"


@pytest.fixture(scope="module")
def ipanema() -> CableRobot:
    lower, upper = (float(value) for value in IPANEMA["tension_bounds_n"])
    return CableRobot(
        frame_anchors=np.array(IPANEMA["frame_anchors_m"]),
        platform_anchors=np.array(IPANEMA["platform_anchors_m"]),
        bounds=CableBounds.of(8, tension_min=lower, tension_max=upper),
    )


def wirex_matrix(robot: CableRobot, position: np.ndarray, orientation: np.ndarray) -> np.ndarray:
    """Columns [u; R b × u] cable by cable, from the components of the cross product."""
    turn = rotation_matrix(orientation)
    columns = []
    for frame, platform in zip(robot.frame_anchors, robot.platform_anchors, strict=True):
        x, y, z = turn @ platform
        line = frame - position - np.array([x, y, z])
        a, b, c = line / np.sqrt(line @ line)
        columns.append([a, b, c, y * c - z * b, z * a - x * c, x * b - y * a])
    return np.array(columns).T


def test_ipanema_lengths(ipanema: CableRobot) -> None:
    lengths = cable_geometry(ipanema, np.array([[0.0, 0.0, 1.0], [0.1, 0.2, 1.0]]), np.zeros(3)).lengths
    text = IPANEMA["lengths_m"]["[0, 0, 1]"]
    np.testing.assert_allclose(lengths[0], float(text.split(" ", maxsplit=1)[0]), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(lengths[1], IPANEMA["lengths_m"]["[0.1, 0.2, 1]"], rtol=0.0, atol=5.1e-9)  # as printed


def test_ipanema_structure_matrix(ipanema: CableRobot) -> None:
    positions = np.array([[0.0, 0.0, 1.0], [0.1, 0.2, 1.0], POSE])
    orientations = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.1, -0.2, 0.3]])
    found = cable_geometry(ipanema, positions, orientations).structure_matrix
    for index in range(3):
        expected = wirex_matrix(ipanema, positions[index], orientations[index])
        np.testing.assert_allclose(found[index], expected, rtol=0.0, atol=1e-12)


def test_ipanema_closed_form_and_puncture(ipanema: CableRobot) -> None:
    matrix = cable_geometry(ipanema, POSE[None], np.zeros(3)).structure_matrix
    inverse = pseudo_inverse(matrix).matrix[0]
    lower, upper = ipanema.bounds.tension_min, ipanema.bounds.tension_max
    middle = (lower + upper) / 2.0
    closed = middle - inverse @ (PUSH + matrix[0] @ middle)
    np.testing.assert_allclose(closed, IPANEMA[POSED]["closed_form_pott_2009"], rtol=0.0, atol=5.1e-6)
    least_norm = -inverse @ PUSH
    steps = (lower - least_norm) / (closed - least_norm)
    step = steps[least_norm < lower].max()
    puncture = least_norm + step * (closed - least_norm)
    np.testing.assert_allclose(puncture, IPANEMA[POSED]["puncture"], rtol=0.0, atol=5.1e-6)
    for tensions in (closed, puncture):
        np.testing.assert_allclose(matrix[0] @ tensions + PUSH, 0.0, atol=1e-12)


def test_ipanema_minimax_tension(ipanema: CableRobot) -> None:
    wrench = RequiredWrench(static=-PUSH, per_acceleration=np.zeros((6, 3)))
    demand = compute_demand(
        ipanema, POSE[None], np.zeros((1, 3)), [[wrench]], rest(), tension_model=TensionModel.WRENCH_FEASIBLE
    )
    assert demand.force[0, 0] == pytest.approx(IPANEMA[POSED]["minimax_tension"], abs=1e-9)


def box_of_twists(linear: float, angular: float) -> MotionSet:
    return independent_motion(linear, 1.0, 1.0, centripetal=False, velocity_shape=SetShape.BOX, angular_speed=angular)


@pytest.mark.parametrize(
    ("key", "angular"), [("box +-(1, 1, 1, 0, 0, 0)", 0.0), ("box +-(1, 1, 1, 0.5, 0.5, 0.5)", 0.5)]
)
def test_ipanema_cable_speed(ipanema: CableRobot, key: str, angular: float) -> None:
    geometry = cable_geometry(ipanema, POSE[None], np.zeros(3))
    motion = cable_motion(ipanema, geometry, box_of_twists(1.0, angular))
    expected = IPANEMA["max_cable_speed_m_per_s at [0.5, 0.3, 0.8]"][key]
    assert motion.speed_in.max() == pytest.approx(expected, abs=1e-9)
    assert motion.speed_out.max() == pytest.approx(expected, abs=1e-9)


# ---- CoGiRo ----


def test_cogiro_is_the_one_of_the_reference() -> None:
    study = load_study("cogiro")
    np.testing.assert_array_equal(study.robot.frame_anchors, COGIRO["frame_anchors_m"])
    np.testing.assert_array_equal(study.robot.platform_anchors, COGIRO["platform_anchors_m"])
    assert study.robot.platform.mass == COGIRO["mass_kg"]
    np.testing.assert_array_equal(study.robot.platform.centre_of_gravity, COGIRO["centre_of_gravity_m"])
    np.testing.assert_array_equal(study.robot.platform.inertia, COGIRO["inertia_kg_m2"])
    assert study.robot.bounds.tension_max.tolist() == [COGIRO["cable"]["tension_max_n"]] * 8
    torque = COGIRO["cable"]["tension_max_n"] * COGIRO["winch"]["drum_radius_m"] / COGIRO["winch"]["ratio"]
    assert torque == pytest.approx(COGIRO["computed"]["5000 N at rest is this torque at the motor, N m"])
    inertia = COGIRO["winch"]["inertia_at_motor_kg_m2"] * COGIRO["winch"]["ratio"] ** 2
    assert inertia == pytest.approx(COGIRO["winch"]["inertia_at_drum_kg_m2"])


def test_cogiro_minimax_tensions() -> None:
    key = "minimax_tension_n, R = I, straight cables, t >= 0, mass and centre of gravity as above, g = 9.81"
    expected = COGIRO["computed"][key]
    study = load_study("cogiro", {"motion.set": "rest"})
    demand = study_demand(replace(study, positions=np.array([json.loads(place) for place in expected], dtype=float)))
    np.testing.assert_allclose(demand.force[:, 0], list(expected.values()), rtol=0.0, atol=5.1e-3)


def test_cogiro_carries_what_was_published_at_least() -> None:
    assert study_demand(load_study("cogiro", {"payload.mass_kg": 300.0})).attainable.all()
    near_centre = {"workspace.box_m": [[-2.0, 2.0], [-2.0, 2.0], [0.5, 2.0]], "workspace.points": [5, 5, 4]}
    assert study_demand(load_study("cogiro", {"payload.mass_kg": 500.0, **near_centre})).attainable.all()


# ---- CPR-8 with cables that only pull ----

PULLING = CPR8["computed"]["wrench_feasible_t_min_0"]
REST = {"motion.set": "rest", "checks.apply": ["torque"]}
BOX = {"motion.acceleration_set": "box", "motion.centripetal": False, "checks.apply": ["torque"]}
TURNED = {"workspace.orientations_rad": [[0.5, 0.5, 0.5]]}
SIX, FORCES = {"tension.model": "wrench_feasible"}, {"tension.model": "force_only"}

# Torque alone at the pose: no rotor's inertia, no voltage.
CASES = [
    ("six_equations_at_rest_0_rad", SIX | REST),
    ("six_equations_at_rest_0.5_rad", SIX | REST | TURNED),
    ("force_equations_only_at_rest_0_rad", FORCES | REST),
    ("force_equations_only_box_corner_accelerations_0_rad", FORCES | BOX),
]


@pytest.mark.parametrize(("key", "changes"), CASES, ids=[key for key, _ in CASES])
def test_cpr8_positions_that_any_drive_could_hold(key: str, changes: dict[str, Any]) -> None:
    assert int(study_demand(load_study("cpr8", changes)).attainable.sum()) == PULLING[key]["any_limit"]


@pytest.mark.parametrize("angle", [0.0, 0.5])
def test_cpr8_holds_all_six_equations_nowhere_while_it_accelerates(angle: float) -> None:
    turned = {"workspace.orientations_rad": [[angle] * 3]}
    found = int(study_demand(load_study("cpr8", SIX | BOX | turned)).attainable.sum())
    assert found == PULLING["six_equations_box_corner_accelerations"]["0_rad" if angle == 0.0 else "0.5_rad"]


@pytest.mark.parametrize(
    ("key", "changes"), [case for case in CASES if "actuators" in PULLING[case[0]]], ids=lambda one: str(one)[:40]
)
def test_cpr8_actuators_by_torque(catalogue: Catalogue, key: str, changes: dict[str, Any]) -> None:
    selection = rank(load_study("cpr8", changes), catalogue)
    by_name = {actuator.name: actuator.feasible_poses for actuator in selection.ranked}
    assert [by_name[f"Actuator {number}"] for number in range(1, 6)] == PULLING[key]["actuators"]
