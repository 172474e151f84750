"""Workspaces of small robots, against what can be worked out by hand."""

from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest

from actuator_select.model.dynamics import Load, platform_wrench
from actuator_select.model.grid_measure import connected_positions, measure_of
from actuator_select.model.kinematics import cable_geometry, position_grid
from actuator_select.model.motion import MotionSet, SetShape, independent_motion, rest
from actuator_select.model.robot import CableBounds, CableRobot, Counterbalance, Freedom, Plane, RigidBody
from actuator_select.model.support_interval import support_interval
from actuator_select.model.tension import TensionModel
from actuator_select.model.workspace import OrientationRule, WorkspaceKind, judge_positions

G = 9.81
UPRIGHT = np.zeros((1, 3))


def point_on_two_cables(**bounds: float) -> CableRobot:
    """A point mass of 10 kg in a plane below two pulleys 4 m apart."""
    return CableRobot(
        frame_anchors=np.array([[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]),
        platform_anchors=np.zeros((2, 3)),
        freedom=Freedom.POINT_IN_PLANE,
        plane=Plane.XZ,
        platform=RigidBody(mass=10.0),
        bounds=CableBounds.of(2, **bounds),
    )


def wrenches(robot: CableRobot, orientations: np.ndarray, *loads: Load) -> list[list]:
    every = loads or (Load(title="nothing", body=RigidBody(mass=0.0)),)
    return [[platform_wrench([robot.platform], G, one, load) for load in every] for one in orientations]


def judge(robot: CableRobot, positions: np.ndarray, motion: MotionSet | None = None, *loads: Load, **choices: object):  # noqa: ANN201
    orientations = choices.pop("orientations", UPRIGHT)
    moving = rest() if motion is None else motion
    return judge_positions(robot, positions, orientations, wrenches(robot, orientations, *loads), moving, **choices)


BELOW = np.array([[x, 0.0, z] for x in (-3.0, -1.0, 0.0, 1.0, 3.0) for z in (-3.0, -1.0, 1.0)])


def test_a_hanging_point_is_held_below_and_between_its_pulleys_only() -> None:
    held = judge(point_on_two_cables(), BELOW, kind=WorkspaceKind.STATIC).feasible
    assert held.tolist() == [bool(abs(x) < 2.0 and z < 0.0) for x, _, z in BELOW]


def test_the_greatest_tension_bounds_the_height() -> None:
    # In the middle both cables pull m g l / (2 |z|) with l² = 4 + z².
    limit = 100.0
    heights = np.linspace(-3.0, -0.1, 59)
    positions = np.column_stack([np.zeros(59), np.zeros(59), heights])
    tension = 10.0 * G * np.hypot(2.0, heights) / (2.0 * -heights)
    held = judge(point_on_two_cables(tension_max=limit), positions, kind=WorkspaceKind.STATIC).feasible
    assert held.tolist() == (tension <= limit).tolist()
    assert 0 < held.sum() < len(held)


def test_each_kind_asks_for_more_than_the_one_before() -> None:
    grid = position_grid(np.array([[-2.5, 2.5], [0.0, 0.0], [-3.0, 0.5]]), (21, 1, 15))
    robot = point_on_two_cables(tension_min=5.0, tension_max=150.0, length_max=4.5)
    windy = Load(
        title="wind", body=RigidBody(mass=0.0), force_lower=np.array([-20.0, 0, 0]), force_upper=np.array([20.0, 0, 0])
    )
    motion = independent_motion(1.0, 0.5, 0.5, centripetal=True, acceleration_shape=SetShape.BALL)
    order = (WorkspaceKind.REACHABLE, WorkspaceKind.STATIC, WorkspaceKind.WRENCH, WorkspaceKind.DYNAMIC)
    found = [judge(robot, grid, motion, windy, kind=kind).feasible for kind in order]
    for wider, narrower in pairwise(found):
        assert (narrower <= wider).all()
        assert narrower.sum() < wider.sum()
    assert found[-1].any()


def test_every_load_has_to_hold() -> None:
    robot = point_on_two_cables(tension_max=80.0)
    empty, full = (Load(title=str(mass), body=RigidBody(mass=mass)) for mass in (0.0, 4.0))
    both = judge(robot, BELOW, None, empty, full).feasible
    alone = [judge(robot, BELOW, None, load).feasible for load in (empty, full)]
    assert both.tolist() == (alone[0] & alone[1]).tolist()
    assert both.sum() < alone[0].sum()


def test_twist_feasibility_compares_the_fastest_cable_with_its_bound() -> None:
    robot = point_on_two_cables(speed_max=0.9)
    motion = independent_motion(1.0, 1.0, 1.0, centripetal=False, velocity_shape=SetShape.BOX)
    found = judge(robot, BELOW, motion, kind=WorkspaceKind.TWIST)
    directions = cable_geometry(robot, BELOW, UPRIGHT[0]).directions
    fastest = np.abs(directions).sum(axis=2).max(axis=1)  # of a box of velocities of 1 m/s
    assert found.feasible.tolist() == (fastest <= 0.9).tolist()
    np.testing.assert_allclose(found.margin, 0.9 - fastest, atol=1e-12)


def test_lengths_alone_decide_what_is_reachable_and_near_positions_are_set_apart() -> None:
    robot = point_on_two_cables(length_min=1.5, length_max=4.0)
    found = judge(robot, BELOW, kind=WorkspaceKind.REACHABLE)
    lengths = cable_geometry(robot, BELOW, UPRIGHT[0]).lengths
    assert found.apart.tolist() == (lengths.min(axis=1) < 1.5).tolist()
    assert found.feasible.tolist() == ((lengths.min(axis=1) >= 1.5) & (lengths.max(axis=1) <= 4.0)).tolist()
    assert found.apart.any()
    held = judge(robot, BELOW, kind=WorkspaceKind.STATIC)
    assert not (held.feasible & held.apart).any()


def turning_robot() -> CableRobot:
    """A planar platform on four cables; how far it may be turned depends on where it is."""
    return CableRobot(
        frame_anchors=np.array([[-2.0, 0, 1.5], [2.0, 0, 1.5], [2.0, 0, -1.5], [-2.0, 0, -1.5]]),
        platform_anchors=np.array([[-0.3, 0, -0.1], [0.3, 0, -0.1], [0.3, 0, 0.1], [-0.3, 0, 0.1]]),
        freedom=Freedom.PLANAR,
        platform=RigidBody(mass=5.0),
        bounds=CableBounds.of(4, tension_min=5.0, tension_max=400.0),
    )


@pytest.mark.parametrize("kind", [WorkspaceKind.STATIC, WorkspaceKind.REACHABLE])
def test_total_lies_in_constant_lies_in_inclusion(kind: WorkspaceKind) -> None:
    robot = turning_robot()
    robot = replace(robot, bounds=replace(robot.bounds, length_max=np.full(4, 3.6)))
    grid = position_grid(np.array([[-1.8, 1.8], [0.0, 0.0], [-1.3, 1.3]]), (13, 1, 9))
    turns = np.array([[0.0, 0.2, 0.0], [0.0, -0.5, 0.0], [0.0, 0.6, 0.0]])
    found = {
        rule: judge(robot, grid, kind=kind, over=rule, orientations=turns).feasible
        for rule in (OrientationRule.TOTAL, OrientationRule.CONSTANT, OrientationRule.INCLUSION)
    }
    each = np.array([judge(robot, grid, kind=kind, orientations=turn[None]).feasible for turn in turns])
    assert found[OrientationRule.TOTAL].tolist() == each.all(axis=0).tolist()
    assert found[OrientationRule.CONSTANT].tolist() == each[0].tolist()
    assert found[OrientationRule.INCLUSION].tolist() == each.any(axis=0).tolist()
    assert each.all(axis=0).sum() < each[0].sum() < each.any(axis=0).sum()


def test_larger_limits_never_shrink_a_workspace() -> None:
    grid = position_grid(np.array([[-1.8, 1.8], [0.0, 0.0], [-1.3, 1.3]]), (13, 1, 9))
    robot = turning_robot()
    before = np.zeros(len(grid), dtype=bool)
    for limit in (50.0, 100.0, 200.0, 400.0):
        bounds = replace(robot.bounds, tension_max=np.full(4, limit))
        now = judge(replace(robot, bounds=bounds), grid, kind=WorkspaceKind.STATIC).feasible
        assert (before <= now).all()
        before = now
    assert before.any()


def test_under_the_pseudo_inverse_its_own_tensions_stay_within_their_bounds() -> None:
    robot = turning_robot()
    robot = replace(robot, bounds=replace(robot.bounds, tension_min=np.full(4, -20.0), tension_max=np.full(4, 60.0)))
    grid = position_grid(np.array([[-1.8, 1.8], [0.0, 0.0], [-1.3, 1.3]]), (9, 1, 7))
    motion = independent_motion(1.0, 0.5, 0.5, centripetal=False, acceleration_shape=SetShape.BOX)
    found = judge(robot, grid, motion, tension_model=TensionModel.PSEUDO_INVERSE)
    structure = cable_geometry(robot, grid, UPRIGHT[0]).structure_matrix[:, [0, 2, 4]]
    least, most = np.full(len(grid), np.inf), np.full(len(grid), -np.inf)
    for signs in product((-2.0, 2.0), repeat=2):
        required = 5.0 * np.array([signs[0], signs[1] + G, 0.0])
        tensions = np.linalg.pinv(structure) @ required
        least, most = np.minimum(least, tensions.min(axis=1)), np.maximum(most, tensions.max(axis=1))
    np.testing.assert_allclose(found.margin, np.minimum(least + 20.0, 60.0 - most), atol=1e-9)
    assert found.feasible.tolist() == (found.margin >= 0.0).tolist()
    assert 0 < found.feasible.sum() < len(grid)


def test_chunks_do_not_change_a_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    grid = position_grid(np.array([[-1.8, 1.8], [0.0, 0.0], [-1.3, 1.3]]), (9, 1, 7))
    whole = judge(turning_robot(), grid)
    monkeypatch.setattr("actuator_select.model.workspace.CABLE_POSES_AT_ONCE", 40)
    seen: list[tuple[int, int]] = []
    parts = judge(turning_robot(), grid, progress=lambda done, total: seen.append((done, total)))
    np.testing.assert_allclose(parts.margin, whole.margin, rtol=1e-12)
    assert parts.feasible.tolist() == whole.feasible.tolist()
    assert seen[-1] == (63, 63)
    assert len(seen) == 7


def test_the_area_of_a_disc_lies_in_its_interval_and_converges() -> None:
    region = np.array([[-1.0, 1.0], [0.0, 0.0], [-1.0, 1.0]])
    errors = []
    for count in (20, 40, 80, 160):
        points = (count, 1, count)
        positions = position_grid(region, points, midpoints=True)
        inside = (positions[:, 0] ** 2 + positions[:, 2] ** 2) < 0.81
        found = measure_of(inside, points, np.array([2.0 / count, 0.0, 2.0 / count]), midpoints=True)
        assert found is not None
        assert found.unit == "m2"
        assert found.inner < 0.81 * np.pi < found.outer
        errors.append(found.outer - found.inner)
    assert errors[-1] < errors[0] / 7.0


def test_nodes_count_a_cell_each_and_cells_by_their_corners() -> None:
    feasible = np.array([[1, 1, 0], [1, 1, 0], [0, 0, 0]], dtype=bool).reshape(-1)
    found = measure_of(feasible, (3, 3, 1), np.array([0.5, 0.2, 0.0]), midpoints=False)
    assert found is not None
    assert (found.value, found.inner, found.outer) == pytest.approx((0.4, 0.1, 0.4))
    line = measure_of(np.array([True, True, False]), (1, 1, 3), np.array([0.0, 0.0, 2.0]), midpoints=True)
    assert line is not None
    assert (line.value, line.inner, line.outer, line.unit) == pytest.approx((4.0, 2.0, 6.0, "m"))
    assert measure_of(np.array([True]), (1, 1, 1), np.zeros(3), midpoints=False) is None


def test_what_is_connected_to_home_is_reached_over_faces() -> None:
    islands = np.array([[1, 1, 0], [0, 0, 1], [1, 0, 1]], dtype=bool).reshape(-1)
    counts = [connected_positions(islands, (3, 3, 1), home) for home in range(9)]
    assert counts == [2, 2, 0, 0, 0, 2, 1, 0, 2]


def with_rope(tension: tuple[float, float], cables: int = 4) -> CableRobot:
    robot = turning_robot()
    rope = Counterbalance(
        frame_anchors=np.array([[-0.5, 0, 1.6], [0.5, 0, 1.6]]),
        platform_anchors=np.array([[0.0, 0, 0.1], [0.0, 0, 0.1]]),
        tension_min=tension[0],
        tension_max=tension[1],
    )
    bounds = CableBounds.of(cables, tension_min=5.0, tension_max=60.0)
    return replace(
        robot,
        frame_anchors=robot.frame_anchors[:cables],
        platform_anchors=robot.platform_anchors[:cables],
        bounds=bounds,
        counterbalances=(rope,),
    )


@pytest.mark.parametrize("cables", [4, 3, 2])
def test_the_interval_of_a_rope_agrees_with_every_fixed_tension_and_range(cables: int) -> None:
    grid = position_grid(np.array([[-1.0, 1.0], [0.0, 0.0], [-1.2, 1.2]]), (9, 1, 9))
    robot = with_rope((0.0, 0.0), cables)
    motion = independent_motion(0.5, 1.0, 1.0, centripetal=False) if cables > 2 else rest()
    found = support_interval(robot, grid, UPRIGHT, wrenches(robot, UPRIGHT), motion)
    for tension in (0.0, 7.0, 20.0, 33.0, 60.0):
        fixed = judge(with_rope((tension, tension), cables), grid, motion).feasible
        assert found.feasible_at(tension).tolist() == fixed.tolist()
        active = judge(with_rope((0.0, tension), cables), grid, motion).feasible
        assert found.feasible_within(0.0, tension).tolist() == active.tolist()
    if cables == 4:
        assert found.feasible_at(20.0).any()


def test_where_cables_are_short_of_rank_what_they_cannot_hold_fixes_the_tension() -> None:
    # Two level cables pull sideways only; a rope straight up has to carry the weight, exactly.
    robot = CableRobot(
        frame_anchors=np.array([[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]),
        platform_anchors=np.zeros((2, 3)),
        freedom=Freedom.POINT_IN_PLANE,
        platform=RigidBody(mass=3.0),
        counterbalances=(
            Counterbalance(
                frame_anchors=np.array([[0.0, 0.0, 5.0]]),
                platform_anchors=np.zeros((1, 3)),
                tension_min=0.0,
                tension_max=0.0,
            ),
        ),
    )
    middle = np.zeros((1, 3))
    found = support_interval(robot, middle, UPRIGHT, wrenches(robot, UPRIGHT), rest())
    assert found.lower == pytest.approx([3.0 * G])
    assert found.upper == pytest.approx([3.0 * G])
    moving = independent_motion(1.0, 1.0, 1.0, centripetal=False)
    assert not support_interval(robot, middle, UPRIGHT, wrenches(robot, UPRIGHT), moving).exists.any()


def test_the_covering_range_serves_every_position_and_no_narrower_one_does() -> None:
    grid = position_grid(np.array([[-0.6, 0.6], [0.0, 0.0], [-0.5, 0.5]]), (5, 1, 5))
    robot = with_rope((0.0, 0.0))
    found = support_interval(robot, grid, UPRIGHT, wrenches(robot, UPRIGHT), rest())
    covering = found.covering()
    assert covering is not None
    least, greatest = covering
    assert found.feasible_within(least, greatest).all()
    if least < greatest:
        assert not found.feasible_within(least, greatest * (1.0 - 1e-6)).all()
        assert not found.feasible_within(least * (1.0 + 1e-6), greatest).all()
