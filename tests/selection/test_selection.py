"""Ranking, verdicts, records: what users are told."""

import json
from collections.abc import Iterator

import numpy as np
import pytest

from actuator_select import Catalogue, evaluate, load_study, open_catalogue, rank, simulate
from actuator_select.errors import InvalidExpression, InvalidInput, NoCandidates, UnknownName
from actuator_select.model.actuation import Check
from actuator_select.selection import selection_record
from tests.selection.parts import PRINTED


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


def add_actuator(catalogue: Catalogue, name: str, **motor: object) -> None:
    """Actuator 1 with some of its motor's figures changed."""
    figures = dict(catalogue.part("filipovic-kevac-2018-motor-1")[1])
    figures = {key: value for key, value in figures.items() if value is not None and key != "origin"}
    catalogue.add("motors", figures | {"id": f"{name}-motor"} | motor)
    catalogue.add(
        "actuators",
        {
            "id": name,
            "name": name,
            "motor_id": f"{name}-motor",
            "gearbox_id": "filipovic-kevac-2018-gearbox-30",
            "winch_id": "filipovic-kevac-2018-winch",
            "efficiency_percent": 60,
            "source_id": "filipovic-kevac-2018",
        },
    )


def test_order_is_verdict_then_share_then_unknowns_then_utilisation(own: Catalogue) -> None:
    add_actuator(own, "stronger", rated_torque_nm=0.9)
    add_actuator(own, "unknown", nominal_voltage_v=None)
    add_actuator(own, "weaker", rated_torque_nm=0.01)
    selection = rank(load_study("cpr8"), own, where="id in ('stronger', 'unknown', 'weaker', 'filipovic-kevac-2018-1')")
    assert [actuator.name for actuator in selection.ranked] == ["stronger", "Actuator 1", "unknown", "weaker"]
    assert [actuator.verdict.value for actuator in selection.ranked] == ["meets", "meets", "undecided", "fails"]


def test_an_unknown_figure_gives_an_upper_bound_and_names_what_is_missing(own: Catalogue) -> None:
    add_actuator(own, "unknown", nominal_voltage_v=None)
    actuator = rank(load_study("cpr8"), own, where="name = 'unknown'").ranked[0]
    assert actuator.feasible_poses == 204
    assert actuator.checks[Check.VOLTAGE].state == "not_evaluated"
    assert actuator.checks[Check.VOLTAGE].missing == ("voltage",)
    assert actuator.checks[Check.VOLTAGE].poses is None


def test_an_unknown_check_cannot_save_an_actuator_that_fails_another(own: Catalogue) -> None:
    add_actuator(own, "hopeless", nominal_voltage_v=None, rated_torque_nm=0.001)
    assert rank(load_study("cpr8"), own, where="name = 'hopeless'").ranked[0].verdict == "fails"


def test_a_check_that_the_study_does_not_ask_for_is_not_applicable(catalogue: Catalogue) -> None:
    actuator = rank(load_study("cpr8-published"), catalogue).ranked[0]
    assert actuator.checks[Check.VOLTAGE].state == "not_applicable"
    assert actuator.verdict == "meets"


def test_an_actuator_that_meets_the_requirement_has_passed_every_check(catalogue: Catalogue) -> None:
    for require in (0.0, 50.0, 84.0, 90.0, 92.6, 100.0):
        for actuator in rank(load_study("cpr8"), catalogue, require=require).ranked:
            states = {verdict.state.value for verdict in actuator.checks.values()}
            if actuator.verdict == "meets":
                assert states == {"passed"}


def test_a_share_equal_to_the_requirement_meets_it(catalogue: Catalogue) -> None:
    study = load_study("cpr8")
    exact = 100.0 * 200 / 216
    assert rank(study, catalogue, require=exact).ranked[0].verdict == "meets"
    assert rank(study, catalogue, require=exact + 1e-6).ranked[0].verdict == "fails"


def test_conditions_of_study_and_call_both_apply(catalogue: Catalogue) -> None:
    study = load_study("cpr8", {"candidates.where": "motor.rated_power_w >= 50"})
    selection = rank(study, catalogue, where="rated_power_w <= 100")
    assert sorted(actuator.name for actuator in selection.ranked) == ["Actuator 2", "Actuator 3"]


def test_no_candidate_is_an_error_that_says_so(catalogue: Catalogue) -> None:
    with pytest.raises(NoCandidates, match=r"no actuator in the catalogue meets \(rated_power_w > 1000\)"):
        rank(load_study("cpr8"), catalogue, where="rated_power_w > 1000")
    with pytest.raises(InvalidExpression, match="rated_powr_w"):
        rank(load_study("cpr8"), catalogue, where="rated_powr_w > 1000")


def test_the_record_is_strict_json_and_keeps_the_contract(own: Catalogue) -> None:
    add_actuator(own, "unknown", nominal_voltage_v=None, rotor_inertia_g_cm2=0)
    record = selection_record(rank(load_study("cpr8"), own))
    text = json.dumps(record, allow_nan=False)
    assert json.loads(text) == record
    assert {"study", "tension_model", "motion_set", "catalogue", "poses", "warnings", "actuators"} <= set(record)
    first = record["actuators"][0]
    assert {"name", "feasible_percent", "feasible_poses", "poses", "verdict", "checks"} <= set(first)
    assert set(first["checks"]) == {"speed", "torque", "acceleration", "voltage"}
    assert {"state", "poses", "worst_utilisation"} <= set(first["checks"]["speed"])
    assert all(set(warning) == {"code", "poses", "text"} for warning in record["warnings"])
    assert len(record["catalogue"]["fingerprint"]) == 64


def test_tables_come_out_as_data_frames(catalogue: Catalogue) -> None:
    selection = rank(load_study("cpr8"), catalogue, where=PRINTED)
    frame = selection.frame()
    assert frame.index[0] == "filipovic-kevac-2018-1"
    assert frame["feasible_poses"].tolist() == [200, 184, 180, 152, 0]
    result = evaluate(load_study("cpr8"), catalogue)
    assert result.evaluation.demand.force.shape == (216, 8)
    assert result.frame().loc["filipovic-kevac-2018-4", "voltage_poses"] == 152


def test_several_orientations_count_each_position_once(catalogue: Catalogue) -> None:
    both = load_study("cpr8", {"workspace.orientations_rad": [[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]]})
    selection = rank(both, catalogue)
    assert selection.poses == 216
    first = next(actuator for actuator in selection.ranked if actuator.name == "Actuator 1")
    assert first.feasible_poses <= 152
    assert {warning.code: warning.poses for warning in selection.warnings}["negative_tension_at_rest"] == 216


def test_an_actuator_is_found_by_name_or_id_and_a_wrong_one_is_suggested(catalogue: Catalogue) -> None:
    study = load_study("cpr8")
    for word in ("actuator 2", "filipovic-kevac-2018-2"):
        run = simulate(study, catalogue, word, start=(0.5, 0.5, -1.0), stop=(1.5, 0.5, -1.0))
        assert run.candidates.names == ["Actuator 2"]
    with pytest.raises(UnknownName, match="did you mean 'Actuator "):
        simulate(study, catalogue, "Actuator 9", start=(0.5, 0.5, -1.0), stop=(1.5, 0.5, -1.0))


def test_a_move_that_cannot_be_is_refused(catalogue: Catalogue) -> None:
    study = load_study("cpr8")
    with pytest.raises(InvalidInput, match="another position"):
        simulate(study, catalogue, "Actuator 1", start=(1.0, 1.0, -1.0), stop=(1.0, 1.0, -1.0))
    with pytest.raises(InvalidInput, match="not finite"):
        simulate(study, catalogue, "Actuator 1", start=(1.0, 1.0, float("nan")), stop=(1.0, 1.0, -1.0))


def test_a_simulation_with_unknown_figures_evaluates_the_rest(own: Catalogue) -> None:
    add_actuator(own, "unknown", nominal_voltage_v=None, terminal_resistance_ohm=None)
    run = simulate(load_study("cpr8"), own, "unknown", start=(0.5, 0.5, -1.0), stop=(1.5, 0.5, -1.0))
    assert np.isnan(run.limits[Check.VOLTAGE])
    assert np.isnan(run.peaks[Check.VOLTAGE]).all()
    assert np.isfinite(run.peaks[Check.TORQUE]).all()
    assert {"time_s", "torque_8_nm"} <= set(run.frame().columns)
