"""Numbers of the planar robot with a counterbalance, from `tests/reference/qi-2020.json`.

Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387; the counts were computed independently of this program.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from actuator_select import load_study
from actuator_select.errors import InvalidInput
from actuator_select.model.dynamics import wrench_scale
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.redundancy_one import (
    NullInterval,
    interval_at_rest,
    null_interval,
    stiffest_tensions,
    tensions_for_unstretched_lengths,
    unstretched_lengths,
)
from actuator_select.model.supports import counterbalance_columns
from actuator_select.selection.elastic import elastic_lengths
from actuator_select.selection.selection import study_demand
from actuator_select.study import Study

REFERENCE = json.loads((Path(__file__).parent / "reference" / "qi-2020.json").read_text(encoding="utf-8"))
PUBLISHED, COMPUTED = REFERENCE["published"], REFERENCE["computed"]
TENSIONS = COMPUTED["T5_n"]
NODES = dict(zip(TENSIONS, COMPUTED["nodes_configuration_a_w_p_13"], strict=True))
MIDPOINTS = dict(zip(TENSIONS, COMPUTED["midpoints_configuration_a_w_p_13"], strict=True))
FINE = {"workspace.points": [1000, 1, 400], "workspace.grid": "midpoints"}
NODE_AREA, MIDPOINT_AREA = 0.04, 3.125e-4  # m²
CORNER = (12.5, -2.85)


def qi(t5: float = 3000.0, **changes: object) -> Study:
    return load_study("qi-a", {"robot.t5_n": t5, **changes})


def active(most: float) -> Study:
    return load_study("qi-a", {"robot.t5_range_n": [0.0, float(most)]})


def at(study: Study, *points: tuple[float, float]) -> Study:
    return replace(study, positions=np.array([[x, 0.0, y] for x, y in points]))


def count(study: Study) -> int:
    return int(study_demand(study).attainable_positions.sum())


def interval(study: Study) -> NullInterval:
    orientations = np.zeros_like(study.positions)
    return interval_at_rest(
        study.robot, study.positions, orientations, [study.wrench(study.orientations[0])] * len(orientations)
    )


def rope_tensions(study: Study) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest T5 at every position, negative ones too: ends of a pairwise elimination of α from eq. 18."""
    robot, rows = study.robot, study.robot.wrench_rows
    level = np.zeros_like(study.positions)
    scale = wrench_scale(robot, rows)
    columns = cable_geometry(robot, study.positions, level).structure_matrix[:, rows] * scale[:, None]
    rope = counterbalance_columns(robot, study.positions, level, rows)[:, :, 0] * scale
    weight = study.wrench(study.orientations[0]).static[list(rows)] * scale
    bounds = robot.bounds.tension_min, robot.bounds.tension_max
    without = null_interval(columns, np.broadcast_to(weight, rope.shape), *bounds)
    per_unit = null_interval(columns, -rope, *bounds).particular
    null = without.null_vector * np.sign(without.null_vector[:, :1])
    assert (null > 0.0).all()  # one sign, so that least tensions bound α below and greatest ones above
    low, high = ((bound - without.particular) / null for bound in bounds)
    slope = per_unit / null
    # least_i - slope_i T5 <= greatest_j - slope_j T5 for every pair of cables
    room = high[:, None, :] - low[:, :, None]
    fall = slope[:, None, :] - slope[:, :, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        limit = room / fall
    most = np.where(fall > 0.0, limit, np.inf).min(axis=(1, 2))
    least = np.where(fall < 0.0, limit, -np.inf).max(axis=(1, 2))
    return least, most


def test_the_study_is_table_1() -> None:
    study = load_study("qi-a")
    robot = study.robot
    given = study.table.robot
    assert (given.w_p_m, given.t5_n) == (PUBLISHED["best_w_p_m"], PUBLISHED["best_T5_n"])
    np.testing.assert_allclose(robot.frame_anchors[:, [0, 2]], [[-14, 2.4], [14, 2.4], [14, -2.85], [-14, -2.85]])
    np.testing.assert_allclose(robot.platform_anchors[:, [0, 2]], [[-0.95, 0], [0.95, 0], [0.95, 0.45], [-0.95, 0.45]])
    np.testing.assert_allclose(robot.counterbalances[0].frame_anchors[:, [0, 2]], [[-13, 3.246], [13, 3.246]])
    np.testing.assert_allclose(robot.counterbalances[0].platform_anchors[:, [0, 2]], [[0, 0.45], [0, 0.45]])
    assert robot.platform.mass == 300.0
    assert robot.bounds.tension_min.tolist() == [0.0] * 4
    assert robot.bounds.tension_max.tolist() == [16000.0, 16000.0, 12000.0, 12000.0]
    assert np.prod(study.cell_size[[0, 2]]) == pytest.approx(NODE_AREA)
    assert np.prod(load_study("qi-a", FINE).cell_size[[0, 2]]) == pytest.approx(MIDPOINT_AREA)


def test_structure_matrix_is_equation_25_with_each_cables_own_length() -> None:
    study = qi()
    w, h, w_b, h_1, h_bu = 28.0, 5.7, 1.9, 0.45, 0.45
    x, y = 3.1, -0.7
    rise, drop = h_1 - h / 2 + y, h / 2 + h_bu + y
    numerators = np.array(
        [
            [-(w - w_b + 2 * x) / 2, -(w_b - w + 2 * x) / 2, -(w_b - w + 2 * x) / 2, -(w - w_b + 2 * x) / 2],
            [-rise, -rise, -drop, -drop],
            [
                w_b * rise / 2,
                -w_b * rise / 2,
                -(2 * h_bu * w + h * w_b - 4 * h_bu * x + 2 * w_b * y) / 4,
                (2 * h_bu * w + h * w_b + 4 * h_bu * x + 2 * w_b * y) / 4,
            ],
        ]
    )
    expected = numerators / np.linalg.norm(numerators[:2], axis=0)
    found = cable_geometry(study.robot, np.array([[x, 0.0, y]]), np.zeros(3)).structure_matrix[
        0, study.robot.wrench_rows
    ]
    turn = np.array([1.0, 1.0, -1.0])[:, None]  # about y the moment turns the other way than the paper's about z
    np.testing.assert_allclose(found * turn, expected, atol=1e-12)


@pytest.mark.parametrize("t5", TENSIONS)
def test_nodes_over_the_ropes_tension(t5: int) -> None:
    study = qi(float(t5))
    demand = study_demand(study)
    assert int(demand.attainable.sum()) == NODES[t5]
    line = interval(study)
    assert line.of_full_rank.all()
    np.testing.assert_array_equal(line.feasible, demand.attainable)


def test_nodes_over_the_pulleys_distance() -> None:
    found = [count(qi(**{"robot.w_p_m": float(w_p)})) for w_p in range(21)]
    assert found == COMPUTED["nodes_w_p_0_to_20_at_3000_n"]
    assert int(np.argmax(found)) == PUBLISHED["best_w_p_m"]


@pytest.mark.parametrize("t5", [0, 2000, 3000])
def test_midpoints(t5: int) -> None:
    assert count(qi(float(t5), **FINE)) == pytest.approx(MIDPOINTS[t5], abs=4)


@pytest.mark.slow
@pytest.mark.parametrize("t5", TENSIONS)
def test_all_midpoints_by_both_methods(t5: int) -> None:
    study = qi(float(t5), **FINE)
    demand = study_demand(study)
    assert int(demand.attainable.sum()) == pytest.approx(MIDPOINTS[t5], abs=4)
    np.testing.assert_array_equal(interval(study).feasible, demand.attainable)


def test_what_is_met_of_the_published_areas_and_what_is_not() -> None:
    nodes = {t5: NODES[t5] * NODE_AREA for t5 in TENSIONS}
    assert max(nodes, key=lambda t5: nodes[t5]) == PUBLISHED["best_T5_n"]
    assert max(MIDPOINTS, key=lambda t5: MIDPOINTS[t5]) == PUBLISHED["best_T5_n"]
    assert round(nodes[3000], 1) == 112.8 != PUBLISHED["area_m2"]
    assert round(MIDPOINTS[3000] * MIDPOINT_AREA, 2) == 109.14
    assert round(100.0 * (nodes[3000] / nodes[0] - 1.0), 2) == 13.07 != PUBLISHED["gain_percent"]
    assert round(100.0 * (nodes[3000] / nodes[2000] - 1.0), 2) == 3.98


@pytest.mark.slow
def test_the_best_distance_of_the_pulleys_depends_on_the_grid() -> None:
    found = {w_p: count(qi(**FINE, **{"robot.w_p_m": w_p})) for w_p in (11.0, 12.0, 13.0, 14.0)}
    assert max(found, key=lambda w_p: found[w_p]) == 12.0
    assert [round(found[w_p] * MIDPOINT_AREA, 2) for w_p in (12.0, 13.0)] == [109.7, 109.14]


@pytest.mark.slow
def test_the_best_distance_depends_on_the_ropes_tension() -> None:
    best = {}
    for t5 in (1000.0, 2000.0, 4000.0, 5000.0):
        best[t5] = int(np.argmax([count(qi(t5, **{"robot.w_p_m": float(w_p)})) for w_p in range(21)]))
    assert best == {1000.0: 12, 2000.0: 11, 4000.0: 17, 5000.0: 20}


def test_the_lower_corners_hold_at_2000_n_and_are_lost_above_2934_7_n() -> None:
    lost = COMPUTED["bottom_corner_feasible_up_to_T5_n"]
    for t5, holds in ((2000.0, True), (lost - 0.1, True), (lost + 0.1, False), (3000.0, False)):
        corners = study_demand(at(qi(t5), CORNER, (-CORNER[0], CORNER[1])))
        assert corners.attainable.tolist() == [holds, holds]


@pytest.mark.parametrize("most", [5000, 10000, 16000, 20000, 26000])
def test_nodes_with_a_controlled_rope(most: int) -> None:
    study = active(most)
    demand = study_demand(study)
    assert int(demand.attainable.sum()) == COMPUTED["nodes_active_0_to_T5max_w_p_13"][str(most)]
    least, greatest = rope_tensions(study)
    np.testing.assert_array_equal(demand.attainable, (least <= most) & (greatest >= 0.0) & (least <= greatest))


def test_0_to_26_kn_cover_everything_and_the_threshold() -> None:
    assert COMPUTED["nodes_active_0_to_T5max_w_p_13"]["26000"] == len(load_study("qi-a").positions)
    threshold = COMPUTED["active_full_cover_from_T5max_n"]
    least, most = rope_tensions(load_study("qi-a"))
    assert (most >= np.maximum(least, 0.0)).all()
    assert least.max() == pytest.approx(threshold["on the nodes"], abs=0.05)
    for study, whole in ((active(least.max() + 0.1), True), (active(least.max() - 0.1), False)):
        assert bool(study_demand(study).attainable.all()) is whole
    edge = np.concatenate([np.linspace(-12.5, 12.5, 2501), [-0.75, 0.75]])
    along = rope_tensions(at(load_study("qi-a"), *((x, 2.15) for x in edge)))[0]
    assert abs(edge[along.argmax()]) == pytest.approx(0.75, abs=0.011)
    here = rope_tensions(at(load_study("qi-a"), (0.75, 2.15), (-0.75, 2.15)))[0]
    np.testing.assert_allclose(here, threshold["continuous domain, at x = +-0.75, y = 2.15"], atol=0.005)
    grid = [(x, y) for x in np.linspace(-12.5, 12.5, 501) for y in np.linspace(-2.85, 2.15, 101)]
    assert rope_tensions(at(load_study("qi-a"), *grid))[0].max() <= here.max() + 1e-6


@pytest.mark.parametrize(("place", "expected"), COMPUTED["T5_interval_n"].items())
def test_interval_of_the_ropes_tension(place: str, expected: list[float]) -> None:
    least, most = rope_tensions(at(load_study("qi-a"), tuple(json.loads(place))))
    np.testing.assert_allclose([least[0], most[0]], expected, atol=6e-4)


@pytest.mark.parametrize(("place", "expected"), COMPUTED["stiffest_tensions_n"].items())
def test_stiffest_tensions(place: str, expected: list[float] | str) -> None:
    position, _, t5 = place.partition(", T5 = ")
    study = at(qi(float(t5)), tuple(json.loads(position)))
    found = stiffest_tensions(interval(study))[0]
    if expected == "infeasible":
        assert np.isnan(found).all()
        assert not study_demand(study).attainable.any()
    else:
        np.testing.assert_allclose(found, expected, atol=6e-4)


def printed_equations(study: Study) -> np.ndarray:
    """Eqs. 20 and 21 as printed, one cable after the other at its greatest tension."""
    robot, rows = study.robot, list(study.robot.wrench_rows)
    level = np.zeros_like(study.positions)
    columns = cable_geometry(robot, study.positions, level).structure_matrix[:, rows]
    rope = counterbalance_columns(robot, study.positions, level, robot.wrench_rows)[:, :, 0]
    u = study.wrench(study.orientations[0]).static[rows] - rope * robot.counterbalances[0].tension_min
    lower, upper = robot.bounds.tension_min, robot.bounds.tension_max
    best = np.full((len(level), 4), np.nan)
    for cable in range(4):
        others = [one for one in range(4) if one != cable]
        tensions = np.full((len(level), 4), upper[cable])
        rest = u - columns[:, :, cable] * upper[cable]
        tensions[:, others] = np.linalg.solve(columns[:, :, others], rest[..., None])[..., 0]
        holds = ((tensions >= lower - 1e-6) & (tensions <= upper + 1e-6)).all(axis=1)
        stiffer = ~(np.linalg.norm(best, axis=1) >= np.linalg.norm(tensions, axis=1))
        best[holds & stiffer] = tensions[holds & stiffer]
    return best


def test_the_printed_equations_hold_where_the_null_vector_has_one_sign() -> None:
    study = qi()
    line = interval(study)
    assert (np.abs(np.sign(line.null_vector).sum(axis=1)) == 4).all()
    np.testing.assert_allclose(printed_equations(study), stiffest_tensions(line), atol=1e-5)


def test_the_printed_equations_miss_tensions_where_the_null_vector_has_two_signs() -> None:
    study = qi(0.0)
    frame = np.array([[-14.0, 0.0, 2.4], [14.0, 0.0, 2.4], [12.0, 0.0, 4.4], [-10.0, 0.0, 5.4]])  # all hang from above
    study = at(replace(study, robot=replace(study.robot, frame_anchors=frame)), (0.0, -4.0), (0.0, -2.0), (1.0, -2.0))
    line = interval(study)
    assert (np.abs(np.sign(line.null_vector).sum(axis=1)) < 4).all()
    np.testing.assert_array_equal(line.feasible, study_demand(study).attainable)
    assert line.feasible.any()
    assert np.isfinite(stiffest_tensions(line)[line.feasible]).all()
    assert np.isnan(printed_equations(study)[line.feasible]).any()


def test_stiffest_tensions_hold_the_load_within_their_bounds_and_none_are_stiffer() -> None:
    study = qi()
    robot, rows = study.robot, list(study.robot.wrench_rows)
    line = interval(study)
    tensions = stiffest_tensions(line)[line.feasible]
    positions = study.positions[line.feasible]
    columns = cable_geometry(robot, positions, np.zeros(3)).structure_matrix[:, rows]
    rope = counterbalance_columns(robot, positions, np.zeros_like(positions), robot.wrench_rows)[:, :, 0] * 3000.0
    held = np.einsum("qnm,qm->qn", columns, tensions) + rope
    np.testing.assert_allclose(held, np.broadcast_to([0.0, 300.0 * 9.81, 0.0], held.shape), atol=1e-7)
    assert (tensions >= robot.bounds.tension_min - 1e-6).all()
    assert (tensions <= robot.bounds.tension_max + 1e-6).all()
    for share in (0.0, 0.3, 0.7, 1.0):
        other = line.tensions(line.lower + share * (line.upper - line.lower))[line.feasible]
        assert (np.linalg.norm(other, axis=1) <= np.linalg.norm(tensions, axis=1) + 1e-6).all()


def test_a_cable_that_the_null_vector_leaves_alone_decides_by_itself() -> None:
    columns = np.array([[[1.0, -1.0, 0.0], [0.0, 0.0, 1.0]]])
    for load, holds in ((5.0, True), (11.0, False), (-1.0, False)):
        line = null_interval(columns, np.array([[2.0, load]]), np.zeros(3), np.full(3, 10.0))
        assert line.feasible.tolist() == [holds]
    with pytest.raises(ValueError, match="one column more than rows"):
        null_interval(columns[:, :, :2], np.zeros((1, 2)), np.zeros(2), np.ones(2))


def test_a_line_without_an_end_has_no_stiffest_tensions_and_a_short_rank_no_line() -> None:
    columns = np.array([[[1.0, -1.0, 0.0], [0.0, 0.0, 1.0]], [[1.0, -1.0, 0.0], [2.0, -2.0, 0.0]]])
    line = null_interval(columns, np.zeros((2, 2)), np.zeros(3), np.full(3, np.inf))
    assert line.feasible.tolist() == line.of_full_rank.tolist() == [True, False]
    assert np.isnan(stiffest_tensions(line)).all()


def test_unstretched_lengths_stretch_back_to_the_lengths() -> None:
    stiffness = 2.0e6
    study = at(qi(**{"cables.axial_stiffness_n": stiffness}), (0.0, 0.0), (5.0, 1.0), (8.0, 1.6))
    found = elastic_lengths(study)
    assert found.feasible.tolist() == [True, True, False]
    np.testing.assert_allclose(found.tensions[0], [16000.0, 16000.0, 8375.462, 8375.462], atol=6e-4)
    assert np.isnan(found.unstretched[2]).all()
    np.testing.assert_allclose(found.unstretched[0], found.lengths[0] * stiffness / (found.tensions[0] + stiffness))
    stretched = found.unstretched[:2] * (1.0 + found.tensions[:2] / stiffness)
    np.testing.assert_allclose(stretched, found.lengths[:2], rtol=1e-14)
    rigid = elastic_lengths(at(qi(), (0.0, 0.0)))
    np.testing.assert_array_equal(rigid.unstretched, rigid.lengths)


def test_bounds_of_the_unstretched_length_are_met_where_the_pose_is_feasible() -> None:
    stiffness = 2.0e5
    study = at(qi(**{"cables.axial_stiffness_n": stiffness}), *((x, y) for x in np.arange(-12, 13) for y in (-2, 0, 1)))
    free = elastic_lengths(study)
    least = np.array([8.0, 8.0, 0.0, 0.0])
    bound = elastic_lengths(study, least=least, greatest=18.0)
    assert 0 < bound.feasible.sum() < free.feasible.sum()
    assert not (bound.feasible & ~free.feasible).any()
    inside = bound.unstretched[bound.feasible]
    assert (inside >= least - 1e-9).all()
    assert (inside <= 18.0 + 1e-9).all()
    # By brute force: no tension of the whole line has lengths within the bounds where the pose is called infeasible.
    line = interval(study)
    for share in np.linspace(0.0, 1.0, 201):
        tensions = line.tensions(line.lower + share * (line.upper - line.lower))
        lengths = unstretched_lengths(free.lengths, tensions, np.full(4, stiffness))
        holds = line.feasible & (lengths >= least).all(axis=1) & (lengths <= 18.0).all(axis=1)
        assert not (holds & ~bound.feasible).any()


def test_a_cable_that_does_not_stretch_has_its_own_length_or_none() -> None:
    lower, upper = tensions_for_unstretched_lengths(
        np.array([[2.0, 5.0, 0.5]]), np.full(3, np.inf), np.full(3, 1.0), np.full(3, 4.0)
    )
    assert (lower <= upper).tolist() == [[True, False, False]]
    with pytest.raises(InvalidInput, match="one cable more than degrees of freedom"):
        elastic_lengths(load_study("cogiro"))
    with pytest.raises(InvalidInput, match="controlled tension"):
        elastic_lengths(active(5000.0))


def test_the_other_configurations_at_3000_n_and_the_best_of_c() -> None:
    counts = {}
    for name, t5 in (("b", 3000.0), ("c", 3000.0), ("d", 3000.0), ("c", 2000.0)):
        study = load_study(f"qi-{name}", {"robot.t5_n": t5})
        demand = study_demand(study)
        np.testing.assert_array_equal(interval(study).feasible, demand.attainable)
        counts[name, t5] = int(demand.attainable.sum())
    assert counts == {("b", 3000.0): 2732, ("c", 3000.0): 2796, ("d", 3000.0): 1602, ("c", 2000.0): 2832}
    assert max(counts["b", 3000.0], counts["c", 3000.0], counts["d", 3000.0]) < NODES[3000]


def test_variants_are_the_maps_of_figures_5_7_and_8() -> None:
    ropes = {one.title: one.study.robot.counterbalances[0] for one in load_study("qi-a").variants}
    assert [ropes[f"T5 = {t5} N (figure 5)"].tension_max for t5 in range(0, 6000, 1000)] == list(range(0, 6000, 1000))
    controlled = [rope.tension_max for rope in ropes.values() if rope.is_controlled]
    assert controlled == [5000.0, 10000.0, 20000.0, 26000.0]
    assert len(ropes["Configuration (d) (figure 7c)"].frame_anchors) == 4
