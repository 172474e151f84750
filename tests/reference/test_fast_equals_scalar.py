"""The vectorised closed forms against the scalar loops and the search, which know nothing of them."""

from dataclasses import replace

import pytest

from actuator_select import Catalogue, Selection, load_study, rank
from tests.reference.scalar_cpr8 import TABLE_1, Case, count_poses_each, worst_utilisation
from tests.reference.search_cpr8 import exact_utilisation

CHECKS = ("speed", "torque", "acceleration", "voltage")
# Unlike the case study in every number, so that nothing agrees by chance.
CASE = Case(
    frame=(4.1, 3.3, 2.7),
    carrier=(0.5, 0.2, 0.31),
    mass=1.3,
    gravity=9.7,
    speed=1.1,
    acceleration_time=0.9,
    deceleration_time=1.4,
    grid_points=4,
    orientation=(0.4, -0.2, 0.3),
    velocity_intervals=5,
    acceleration_levels=(-1.0, 0.25, 1.0),
)


def ranked(catalogue: Catalogue, case: Case, motion: str) -> Selection:
    sampled = {
        "motion.velocity_intervals": case.velocity_intervals,
        "motion.acceleration_levels": list(case.acceleration_levels),
    }
    study = load_study(
        "cpr8",
        {
            "gravity_m_per_s2": case.gravity,
            "robot.frame_m": list(case.frame),
            "robot.carrier_m": list(case.carrier),
            "payload.mass_kg": case.mass,
            "workspace.points": [case.grid_points] * 3,
            "workspace.orientations_rad": [list(case.orientation)],
            "motion.set": motion,
            "motion.speed_max_m_per_s": case.speed,
            "motion.acceleration_time_s": case.acceleration_time,
            "motion.deceleration_time_s": case.deceleration_time,
            "motion.centripetal": case.centripetal,
            **(sampled if motion == "sampled" else {}),
        },
    )
    return rank(study, catalogue, where="source_location = 'Table 1'")


@pytest.mark.parametrize("centripetal", [True, False])
def test_sampled_motions_give_the_same_counts_and_worst_utilisations(
    catalogue: Catalogue, *, centripetal: bool
) -> None:
    case = replace(CASE, centripetal=centripetal)
    selection = ranked(catalogue, case, "sampled")
    by_name = {actuator.name: actuator for actuator in selection.ranked}
    mine = [by_name[f"Actuator {number}"] for number in range(1, 6)]
    assert [actuator.feasible_poses for actuator in mine] == count_poses_each(case, TABLE_1, CHECKS)
    assert len({actuator.feasible_poses for actuator in mine}) > 1
    for check in CHECKS:
        theirs = count_poses_each(case, TABLE_1, (check,))
        assert [actuator.checks[check].poses for actuator in mine] == theirs
        for actuator, one in zip(mine, TABLE_1, strict=True):
            # The paper divides by 9.5493 where this program divides by 30/pi: 4e-6 apart.
            assert actuator.checks[check].worst_utilisation == pytest.approx(
                worst_utilisation(case, one, check), rel=1e-5 if check == "speed" else 1e-9
            )


def test_the_closed_forms_reach_what_a_search_over_the_ball_and_the_box_finds(catalogue: Catalogue) -> None:
    # Ramps alike, because the independent set takes the shorter one for both signs.
    case = replace(CASE, deceleration_time=CASE.acceleration_time, acceleration_levels=(-1.0, 1.0))
    selection = ranked(catalogue, case, "independent")
    for actuator in selection.ranked:
        one = TABLE_1[int(actuator.name[-1]) - 1]
        for check in CHECKS:
            verdict = actuator.checks[check]
            assert verdict.worst_position is not None
            assert verdict.worst_utilisation == pytest.approx(
                exact_utilisation(case, one, check, verdict.worst_position), rel=1e-5
            )
