"""Numbers of the 6-6 cable robot for heavy loads, from `tests/reference/hamedi.json`.

J. Hamedi, H. Zohoor, "Modeling and wrench feasible workspace analysis of a cable suspended robot for heavy loads
handling"; the counts under "computed" were computed independently of this program. The paper's z points down, so that
its y, z, θ, φ, f_y, f_z, m_y and m_z change sign here.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from actuator_select import load_study
from actuator_select.model.demand import Demand
from actuator_select.model.kinematics import cable_geometry
from actuator_select.selection.selection import study_demand
from actuator_select.study import Study

REFERENCE = json.loads((Path(__file__).parent / "reference" / "hamedi.json").read_text(encoding="utf-8"))
PUBLISHED, COMPUTED, MODEL = REFERENCE["published"], REFERENCE["computed"], REFERENCE["model"]
ANGLES = ("0", "15", "30", "45")
GAMMAS = pytest.mark.parametrize("gamma", ANGLES)
HALF_TURN = np.array([1.0, -1.0, -1.0])  # about x, from the paper's frame to this program's
BOUNDS = {"cables.tension_min_n": 5000.0, "cables.tension_max_n": 55000.0}
LENGTH = {"cables.length_max_m": 15.0}


def hamedi(gamma: str = "0", **changes: object) -> Study:
    return load_study("hamedi", {"robot.gamma_deg": float(gamma), **changes})


def count(study: Study) -> int:
    return int(study_demand(study).attainable_positions.sum())


@pytest.fixture(scope="module")
def plain() -> dict[str, Demand]:
    """Demand of the built-in study at each γ."""
    return {gamma: study_demand(hamedi(gamma)) for gamma in ANGLES}


@GAMMAS
def test_points_of_constant_orientation(plain: dict[str, Demand], gamma: str) -> None:
    found = int(plain[gamma].attainable.sum())
    assert found == COMPUTED["COWV_r_base_6_tensions_nonnegative"][gamma] == PUBLISHED["COWV"][gamma]


@GAMMAS
def test_points_of_constant_orientation_with_the_bounds_of_the_text(plain: dict[str, Demand], gamma: str) -> None:
    study = hamedi(gamma)
    here = replace(study, positions=study.positions[plain[gamma].attainable])  # bounds take away and never give
    found = replace(here, robot=hamedi(gamma, **BOUNDS).robot)
    assert count(found) == COMPUTED["COWV_r_base_6_r_end_6_tensions_5_to_55_kn"][gamma]


@GAMMAS
def test_points_on_a_base_half_as_large(gamma: str) -> None:
    found = count(hamedi(gamma, **{"robot.r_base_m": 3.0}))
    assert found == COMPUTED["COWV_r_base_3_tensions_nonnegative"][gamma]


def test_the_platforms_radius_does_not_matter_at_zero_rotation(plain: dict[str, Demand]) -> None:
    study = hamedi("15", **{"robot.r_end_m": 2.5})
    np.testing.assert_array_equal(study_demand(study).attainable, plain["15"].attainable)


def test_nodes_and_singular_ones(plain: dict[str, Demand]) -> None:
    study = hamedi()
    assert len(study.positions) == 43706
    assert study.cell_size.tolist() == pytest.approx([0.4] * 3)
    for demand in plain.values():
        assert int((~demand.rank_deficient).sum()) == COMPUTED["nonsingular_nodes_zero_rotation"]
    np.testing.assert_array_equal(plain["0"].rank_deficient, np.abs(study.positions[:, 2]) < 1e-9)


def closed_form(gamma: float, r_base: float) -> tuple[float, np.ndarray]:
    """Distance of the six sides from the centre, and their normals, in the paper's frame."""
    apart = (r_base / 2.0) * np.cos(np.radians(30.0 + gamma))
    normals = np.radians([side * (30.0 - gamma / 2.0) + 120.0 * k for k in range(3) for side in (-1.0, 1.0)])
    return float(apart), np.column_stack([np.cos(normals), np.sin(normals)])


@GAMMAS
@pytest.mark.parametrize("r_base", [3.0, 6.0])
def test_the_cross_section_is_a_hexagon_at_every_height(plain: dict[str, Demand], gamma: str, r_base: float) -> None:
    apart, normals = closed_form(float(gamma), r_base)
    study = hamedi(gamma, **{"robot.r_base_m": r_base})
    demand = plain[gamma] if r_base == 6.0 else study_demand(study)
    paper = study.positions * HALF_TURN
    beyond = (paper[:, :2] @ normals.T - apart).max(axis=1)
    below = paper[:, 2] > 1e-9
    clear = np.abs(beyond) > 1e-6  # a node on a side is a matter of rounding
    np.testing.assert_array_equal(demand.attainable[clear], (below & (beyond < 0.0))[clear])


@pytest.mark.parametrize("gamma", [0.0, 15.0, 30.0, 45.0])
def test_area_of_the_cross_section(gamma: float) -> None:
    apart, normals = closed_form(gamma, 6.0)
    angle = np.radians(gamma / 2.0)
    area = 3.0 * apart**2 * (np.tan(np.pi / 6.0 - angle) + np.tan(np.pi / 6.0 + angle))
    order = np.argsort(np.arctan2(normals[:, 1], normals[:, 0]))
    sides = normals[order]
    corners = np.linalg.solve(np.stack([sides, np.roll(sides, -1, axis=0)], axis=1), np.full((6, 2, 1), apart))[..., 0]
    ahead = np.roll(corners, -1, axis=0)
    shoelace = abs((corners[:, 0] * ahead[:, 1] - corners[:, 1] * ahead[:, 0]).sum()) / 2.0
    assert shoelace == pytest.approx(area, rel=1e-12)
    # The share of cell midpoints in one plane converges to it.
    study = load_study(
        "hamedi",
        {
            "robot.gamma_deg": gamma,
            "workspace.grid": "midpoints",
            "workspace.points": [160, 160, 1],
            "workspace.box_m": [[-8.0, 8.0], [-8.0, 8.0], [-5.0, -5.0]],
        },
    )
    assert count(study) * 0.01 == pytest.approx(area, abs=0.25)


@GAMMAS
def test_points_under_a_lateral_force_with_short_cables(gamma: str) -> None:
    study = hamedi(gamma, **LENGTH, **{"payload.force_n": [100000.0, 0.0, -100000.0]})
    assert count(study) == COMPUTED["WFWV_r_end_6_nonnegative_length_15, f = (100, 0, 100) kN"][gamma]


@GAMMAS
def test_points_over_a_box_of_wrenches(plain: dict[str, Demand], gamma: str) -> None:
    reach = {"payload.force_reach_n": [10000.0] * 3, "payload.moment_reach_n_m": [10000.0] * 3}
    boxed = hamedi(gamma, **reach)
    here = replace(boxed, positions=boxed.positions[plain[gamma].attainable])  # the box holds the plain load
    key = "WFWV box f_z = 100, +-10 kN and kN m on all six, r_base 6, r_end 6, no length limit"
    assert count(here) == COMPUTED[key]["nonnegative"][gamma]


TENSIONS = COMPUTED["tensions_kn_r_6_g_0"]


@pytest.mark.parametrize(
    ("key", "position", "angles"),
    [
        ("centre, z = 4", (0.0, 0.0, 4.0), (0.0, 0.0, 0.0)),
        ("(0.8, -0.4, 4)", (0.8, -0.4, 4.0), (0.0, 0.0, 0.0)),
        ("(0.8, -0.4, 4), psi theta phi = 10, -5, 5 deg", (0.8, -0.4, 4.0), (10.0, -5.0, 5.0)),
    ],
)
def test_tensions(key: str, position: tuple[float, ...], angles: tuple[float, ...]) -> None:
    study = hamedi()
    place, turned = np.array(position) * HALF_TURN, np.radians(angles) * HALF_TURN
    structure = cable_geometry(study.robot, place[None], turned).structure_matrix[0]
    tensions = np.linalg.solve(structure, study.wrench(turned).static) / 1000.0
    np.testing.assert_allclose(tensions, np.broadcast_to(TENSIONS[key], 6), atol=6e-7)
    demand = study_demand(replace(study, positions=place[None], orientations=turned[None]))
    assert demand.force.max() / 1000.0 == pytest.approx(tensions.max(), rel=1e-9)  # six cables leave no choice


TURNED = {"workspace.orientation_grid_deg": [[-30.0, 0.0, 30.0], [10.0, 0.0, -10.0], [5.0, 0.0, -5.0]]}
KEY_27 = "27_orientations psi {-30,0,30} x theta {-10,0,10} x phi {-5,0,5} deg, r_base 6, r_end 6, g 0"
AT_ONCE = 5000  # positions, for the sake of memory


def over_27_orientations(positions: np.ndarray, weights: np.ndarray) -> dict[str, int]:
    """Weighted count of positions held at one orientation or more, and at all of them."""
    counts: dict[str, int] = {}
    free, bounded = hamedi(**TURNED), hamedi(**TURNED, **BOUNDS, **LENGTH)
    for start in range(0, len(positions), AT_ONCE):
        some, weight = positions[start : start + AT_ONCE], weights[start : start + AT_ONCE]
        demand = study_demand(replace(free, positions=some))
        short = (demand.lengths <= 15.0 * (1.0 + 1e-9)).all(axis=1)
        held = {"nonnegative": demand.attainable.reshape(len(some), -1)}
        held["nonnegative_length_15"] = (demand.attainable & short).reshape(len(some), -1)
        held["5_55_length_15"] = np.zeros_like(held["nonnegative"])
        here = held["nonnegative_length_15"].any(axis=1)  # bounds take away and never give
        if here.any():
            found = study_demand(replace(bounded, positions=some[here])).attainable
            held["5_55_length_15"][here] = found.reshape(-1, held["nonnegative"].shape[1])
        for name, each in held.items():
            for kind, poses in (("inclusion", each.any(axis=1)), ("total", each.all(axis=1))):
                counts[f"{kind}_{name}"] = counts.get(f"{kind}_{name}", 0) + int(weight[poses].sum())
    return counts


def test_points_over_27_orientations() -> None:
    positions = hamedi().positions
    # A mirror in y turns ψ and φ around, and the set of orientations into itself: half the grid says it all.
    half = positions[positions[:, 1] > -1e-9]
    weights = np.where(np.abs(half[:, 1]) < 1e-9, 1, 2)
    assert weights.sum() == len(positions)
    assert over_27_orientations(half, weights) == COMPUTED[KEY_27]


@pytest.mark.slow
def test_points_over_27_orientations_without_the_mirror() -> None:
    positions = hamedi().positions
    assert over_27_orientations(positions, np.ones(len(positions), dtype=int)) == COMPUTED[KEY_27]


def test_at_60_degrees_everything_is_singular_at_zero_rotation() -> None:
    coarse = {"workspace.points": [9, 9, 6], "workspace.box_m": [[-4.0, 4.0], [-4.0, 4.0], [-10.0, -1.0]]}
    assert study_demand(hamedi("60", **coarse)).rank_deficient.all()
    gaps = np.diff(np.sort(np.degrees(np.arctan2(*hamedi("45").robot.frame_anchors[:, 1::-1].T))))
    assert sorted({round(gap) for gap in gaps}) == [45, 75]


def test_the_symmetry_is_three_fold_so_that_lateral_forces_differ() -> None:
    coarse = {"workspace.points": [33, 33, 6], "workspace.box_m": [[-4.0, 4.0], [-4.0, 4.0], [-10.0, -1.0]]}
    along_x, along_y = (
        count(hamedi("15", **coarse, **{"payload.force_n": [1e5 * x, 1e5 * y, -1e5]})) for x, y in ((1, 0), (0, 1))
    )
    assert along_x != along_y


def test_what_the_text_leaves_open_stays_open() -> None:
    assert [line.split(":")[0] for line in REFERENCE["not_identifiable_from_the_text"]] == [
        "SRWV",
        "TOWV",
        "r_end",
        "WFWV curves",
    ]


def test_a_lateral_force_or_a_moment_may_serve_more_points(plain: dict[str, Demand]) -> None:
    pushed = count(hamedi("45", **{"payload.force_n": [0.0, -50000.0, -100000.0]}))
    assert (int(plain["45"].attainable.sum()), pushed) == (375, 388)
    base = {"robot.r_base_m": 12.0, "robot.r_end_m": 12.0}
    large = load_study("hamedi", base)
    turned = load_study("hamedi", {**base, "payload.moment_n_m": [100000.0, 0.0, 0.0]})
    assert (count(large), count(turned)) == (14275, 14400)


def test_variants_are_the_other_maps() -> None:
    study = load_study("hamedi")
    found = {one.title: one.study.robot for one in study.variants}
    assert len(found) == 5
    for gamma, figure in ((15, 9), (30, 8), (45, 7)):
        expected = hamedi(str(gamma)).robot.frame_anchors
        np.testing.assert_array_equal(found[f"γ = {gamma}° (figure {figure})"].frame_anchors, expected)
