"""What explains a ranking: needs, variants, moves, parts, operating points."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from actuator_select import Catalogue, load_study, open_catalogue, rank
from actuator_select.model.actuation import Check, voltage_line
from actuator_select.model.drive_cloud import drive_cloud
from actuator_select.model.evaluation import evaluate_actuators
from actuator_select.model.ranking import Verdict, required_positions
from actuator_select.selection.dossier import Dossier, build_dossier
from tests.selection.parts import PRINTED

FIGURES = {Check.SPEED: "motor_speed", Check.TORQUE: "motor_torque", Check.VOLTAGE: "voltage"}


@pytest.fixture(scope="module")
def dossier(catalogue: Catalogue) -> Dossier:
    return build_dossier(rank(load_study("cpr8"), catalogue, where=PRINTED), catalogue)


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


def test_a_figure_raised_to_what_is_needed_makes_its_check_pass_and_a_little_less_does_not(dossier: Dossier) -> None:
    evaluation = dossier.selection.result.evaluation
    enough = required_positions(216, 90.0)
    assert enough == 195
    tried = 0
    for actuator, needs in dossier.needs:
        figures = evaluation.actuators.take([actuator.index])
        for need in needs:
            name = FIGURES[need.check]
            for slack, passes in ((1.0 + 1e-9, True), (1.0 - 1e-6, False)):
                raised = replace(figures, **{name: getattr(figures, name) * need.needed / need.stated * slack})
                positions = evaluate_actuators(evaluation.demand, raised, [need.check]).positions[0]
                assert (positions >= enough) is np.bool_(passes)
            tried += 1
    assert tried == 6


def test_every_failing_actuator_is_explained_and_every_part_has_its_source(dossier: Dossier) -> None:
    failing = [actuator.id for actuator in dossier.selection.ranked if actuator.verdict is Verdict.FAILS]
    assert [actuator.id for actuator, needs in dossier.needs if needs] == failing
    assert len(failing) == 4
    assert {part.kind for part in dossier.parts} == {"actuators", "motors", "gearboxes", "winches"}
    assert len([part for part in dossier.parts if part.kind == "motors"]) == 5
    assert all(part.source["doi"] == "10.22190/FUACR1802071F" for part in dossier.parts)
    assert {finding.id[-1] for finding in dossier.findings} == {"2", "3", "4", "5"}


def test_more_actuators_than_get_pictures_are_all_explained(own: Catalogue) -> None:
    for number in range(6, 15):
        row = own.part("filipovic-kevac-2018-4")[1]
        same = {name: value for name, value in row.items() if "." not in name and name != "origin"}
        own.add("actuators", same | {"id": f"a{number}", "name": f"A{number}"})
    added = ", ".join(f"'a{number}'" for number in range(6, 15))
    found = build_dossier(rank(load_study("cpr8"), own, where=f"{PRINTED} or id in ({added})"), own)
    assert len(found.selection.ranked) == 14
    assert len(found.details) < 14
    assert len(found.needs) == 13
    assert "filipovic-kevac-2018-motor-5" in {part.id for part in found.parts}


def test_variants_are_counted_beside_the_study(dossier: Dossier) -> None:
    counts = {
        result.variant.title: result.actuator(dossier.selection.ranked[0].index).feasible_poses
        for result in dossier.variants
    }
    assert list(counts.values()) == [152, 212, 204, 216, 183]
    for result in dossier.variants:
        assert result.feasible.sum() == counts[result.variant.title]


def test_details_say_where_an_actuator_serves_and_what_stops_it(dossier: Dossier) -> None:
    for detail in dossier.details:
        assert detail.feasible.sum() == detail.actuator.feasible_poses
        assert np.array_equal(detail.feasible, detail.utilisation <= 1.0 + 1e-12)
        worst = max(verdict.worst_utilisation or 0.0 for verdict in detail.actuator.checks.values())
        assert detail.utilisation.max() == pytest.approx(worst)
    moves = [run.exceedances for _, run in dossier.moves]
    assert not moves[0]
    assert {one.actuator for one in moves[1]} == {1, 3, 8}


def test_the_operating_points_reach_the_worst_case_and_never_exceed_it(dossier: Dossier) -> None:
    evaluation = dossier.selection.result.evaluation
    for detail in dossier.details:
        line = voltage_line(detail.figures)
        figures, verdict = detail.figures, detail.actuator.checks
        # u/(S R_w) = force + reflected mass · s + damping · v, written at the motor.
        torque_at_drum = float((figures.ratio * figures.efficiency / figures.drum_radius)[0])
        speed_at_drum = float((figures.drum_radius / figures.ratio)[0])
        asked = np.abs(
            detail.cloud.total_torque * torque_at_drum + float(line.damping[0]) * detail.cloud.speed * speed_at_drum
        )
        used = asked.max() / float(line.force_limit[0])
        assert used <= verdict[Check.VOLTAGE].worst_utilisation * (1.0 + 1e-9)
        assert used >= verdict[Check.VOLTAGE].worst_utilisation * 0.995
        load = np.abs(detail.cloud.load_torque).max() / float(figures.motor_torque[0])
        assert load == pytest.approx(verdict[Check.TORQUE].worst_utilisation)
    again = drive_cloud(evaluation.demand, dossier.details[0].figures, 100, np.array([3]))
    assert np.array_equal(
        again.speed, drive_cloud(evaluation.demand, dossier.details[0].figures, 100, np.array([3])).speed
    )
