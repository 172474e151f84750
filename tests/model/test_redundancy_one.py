"""The interval test of redundancy 1 and hyperplane shifting, two ways to one answer, on random robots."""

import numpy as np
import pytest

from actuator_select.model.demand import compute_demand
from actuator_select.model.dynamics import RequiredWrench, platform_wrench
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import rest
from actuator_select.model.redundancy_one import interval_at_rest, stiffest_tensions
from actuator_select.model.robot import CableBounds, CableRobot, Counterbalance, Freedom, RigidBody
from actuator_select.model.supports import counterbalance_columns
from actuator_select.model.tension import TensionModel

CLOSE = 1e-4  # N; nearer to a facet the answer is a matter of rounding


@pytest.mark.parametrize(
    ("freedom", "cables"),
    [(Freedom.POINT_IN_PLANE, 3), (Freedom.POINT, 4), (Freedom.PLANAR, 4), (Freedom.SPATIAL, 7)],
)
@pytest.mark.parametrize("seed", range(5))
def test_the_interval_holds_a_value_exactly_where_the_pose_is_feasible(
    freedom: Freedom, cables: int, seed: int
) -> None:
    random = np.random.default_rng(seed)
    turns = freedom in {Freedom.PLANAR, Freedom.SPATIAL}
    frame = random.uniform(-3.0, 3.0, (cables, 3))
    frame[: cables - 1, 2] = random.uniform(1.0, 3.0, cables - 1)
    rope = Counterbalance(
        frame_anchors=np.array([[0.0, 0.0, 4.0]]), platform_anchors=np.zeros((1, 3)), tension_min=20.0, tension_max=20.0
    )
    robot = CableRobot(
        frame_anchors=frame,
        platform_anchors=random.uniform(-0.3, 0.3, (cables, 3)) * turns,
        freedom=freedom,
        bounds=CableBounds.of(cables, tension_min=1.0, tension_max=random.uniform(80.0, 400.0, cables)),
        counterbalances=(rope,) if seed % 2 else (),
    )
    positions = random.uniform(-0.5, 0.5, 3) + random.uniform(-1.0, 1.0, (400, 3)) * np.linspace(0.0, 4.0, 400)[:, None]
    angles = random.uniform(-0.2, 0.2, 3) * turns
    # What tensions within their bounds supply at the first position, so that it is feasible, and some around it.
    tensions = random.uniform(20.0, 60.0, cables)
    supplied = cable_geometry(robot, positions[:1], angles).structure_matrix[0] @ tensions
    if robot.counterbalances:
        supplied += counterbalance_columns(robot, positions[:1], angles[None], tuple(range(6)))[0, :, 0] * 20.0
    wrench = RequiredWrench(static=supplied, per_acceleration=np.zeros((6, 3)))
    demand = compute_demand(
        robot, positions, angles[None], [[wrench]], rest(), tension_model=TensionModel.WRENCH_FEASIBLE
    )
    line = interval_at_rest(robot, positions, np.tile(angles, (400, 1)), [wrench] * 400)
    clear = np.abs(demand.margin) > CLOSE
    assert clear.sum() > 390
    np.testing.assert_array_equal(line.feasible[clear], demand.attainable[clear])
    assert line.feasible[0]
    stiffest = stiffest_tensions(line)[line.feasible]
    assert (stiffest >= robot.bounds.tension_min - 1e-6).all()
    assert (stiffest <= robot.bounds.tension_max + 1e-6).all()


def test_a_controlled_counterbalance_is_refused() -> None:
    rope = Counterbalance(
        frame_anchors=np.array([[0.0, 0.0, 4.0]]), platform_anchors=np.zeros((1, 3)), tension_min=0.0, tension_max=20.0
    )
    robot = CableRobot(
        frame_anchors=np.array([[1.0, 0.0, 2.0], [-1.0, 1.0, 2.0], [-1.0, -1.0, 2.0], [0.0, 0.0, -2.0]]),
        platform_anchors=np.zeros((4, 3)),
        counterbalances=(rope,),
    )
    wrench = platform_wrench([RigidBody(mass=1.0)], 9.81, np.zeros(3))
    with pytest.raises(ValueError, match="state a constant tension"):
        interval_at_rest(robot, np.zeros((1, 3)), np.zeros((1, 3)), [wrench])
