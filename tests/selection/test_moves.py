"""Moves that no drive could make, and places that no drive could serve, are said to be so."""

from actuator_select import Catalogue, load_study, open_catalogue, rank, simulate
from actuator_select.model.actuation import Check
from actuator_select.selection.move_wording import check_words, exceedance_words, together_words, unheld_words
from actuator_select.selection.records import selection_record, simulation_record
from actuator_select.selection.wording import summary
from actuator_select.study import parse_study, template_text
from tests.selection.parts import DC, add_drive

HALL = template_text("hall", "suspended-8")


def test_a_move_out_of_the_hall_is_not_held_from_where_it_leaves(catalogue: Catalogue) -> None:
    study = parse_study(HALL, place="hall.toml")
    run = simulate(study, catalogue, "Actuator 1", start=(0.0, 0.0, 1.0), stop=(20.0, 0.0, 9.0))
    assert len(run.unheld) == 1
    start, stop = run.unheld[0]
    assert 0.0 < start < stop
    assert stop == run.duration
    record = simulation_record(run)
    assert record["infeasible"] is True
    assert record["not_held"] == [{"from_s": start, "to_s": stop}]
    (sentence,) = unheld_words(run)
    assert sentence.startswith("the move cannot be made")


def test_a_move_inside_is_held(catalogue: Catalogue) -> None:
    study = parse_study(HALL, place="hall.toml")
    run = simulate(study, catalogue, "Actuator 1", start=(0.0, 0.0, 1.0), stop=(2.0, 0.0, 1.0))
    assert run.unheld == ()
    assert simulation_record(run)["not_held"] == []


def test_a_place_that_no_drive_could_serve_is_the_robots_fault(catalogue: Catalogue) -> None:
    far = {"requirement.must_serve": [{"position_m": [30.0, 0.0, 1.0]}], "requirement.feasible_percent": 0.0}
    selection = rank(parse_study(HALL, place="hall.toml", overrides=far), catalogue)
    assert selection.unattainable_places == ("place 1",)
    assert selection.robot_falls_short
    assert "No drive could serve place 1, as required: the robot has to change" in summary(selection)[0]
    assert selection_record(selection)["unattainable_places"] == ["place 1"]


def test_the_share_of_a_robot_that_holds_enough_is_not_its_fault(catalogue: Catalogue) -> None:
    selection = rank(load_study("cpr8"), catalogue)
    assert not selection.robot_falls_short
    assert selection.unattainable_places == ()


def test_a_move_with_a_cable_beyond_its_greatest_length_is_not_held(catalogue: Catalogue) -> None:
    study = parse_study(HALL, place="hall.toml", overrides={"cables.length_max_m": 9.0})
    run = simulate(study, catalogue, "Actuator 1", start=(0.0, 0.0, 1.0), stop=(4.0, 3.0, 1.0))
    assert run.unheld
    assert run.unheld[0][1] == run.duration


def test_where_a_drive_serves_all_that_is_attainable_the_robot_limits_it(catalogue: Catalogue) -> None:
    light = {"payload.mass_kg": 0.5, "cables.tension_min_n": 0.0, "cables.tension_max_n": 30.0}
    shorter = {"cables.length_max_m": 2.4, "motion.speed_max_m_per_s": 0.2}
    study = parse_study(template_text("camera"), place="camera.toml", overrides=light | shorter)
    selection = rank(study, catalogue)
    best = selection.ranked[0]
    assert 0 < selection.attainable_poses < selection.poses
    assert best.feasible_poses == selection.attainable_poses
    assert "it serves every position that is attainable" in summary(selection)[2]


def test_a_move_near_an_anchor_is_warned_of(catalogue: Catalogue) -> None:
    near = {"cables.length_min_m": 6.0}
    study = parse_study(HALL, place="hall.toml", overrides=near)
    ends = {"start": (0.0, 0.0, 1.0), "stop": (4.0, 3.0, 1.0)}
    assert any("cables.length_min_m" in text for text in simulate(study, catalogue, "Actuator 1", **ends).glossed_over)
    free = parse_study(HALL, place="hall.toml")
    assert simulate(free, catalogue, "Actuator 1", **ends).glossed_over == []


LINE = {"start": (0.5, 0.5, -0.5), "stop": (2.5, 0.5, -0.5)}
BOUNDED = {"tension.model": "force_only", "cables.tension_min_n": 1.0, "cables.tension_max_n": 500.0}


def test_load_and_rotor_together_are_a_note_where_the_equations_test_them_apart() -> None:
    with open_catalogue(":memory:") as own:
        # A rotor so heavy that it takes nearly all of the torque, as the load does at another moment.
        add_drive(own, "heavy", DC | {"rotor_inertia_g_cm2": 2500, "rated_torque_nm": 0.085}, efficiency_percent=60)
        run = simulate(load_study("cpr8"), own, "heavy", **LINE)
        bounded = simulate(load_study("cpr8", BOUNDED), own, "heavy", **LINE)
    assert not [one for one in run.exceedances if one.check in (Check.TORQUE, Check.ACCELERATION)]
    assert run.together
    assert all("which eqs. 32 and 33 test apart, exceeds" in text for text in together_words(run))
    assert check_words(run, Check.TORQUE) == "torque"
    assert bounded.together == ()
    over = [one for one in bounded.exceedances if one.check is Check.TORQUE]
    assert over
    assert ": torque, load and rotor, over its limit from" in exceedance_words(bounded, over[0])
    table = bounded.frame()
    assert (table["total_torque_1_nm"] - table["torque_1_nm"]).abs().max() > 0.0


def test_without_a_rotor_inertia_the_sum_is_not_evaluated_and_the_load_alone_is() -> None:
    light = {name: value for name, value in DC.items() if name != "rotor_inertia_g_cm2"}
    with open_catalogue(":memory:") as own:
        add_drive(own, "light", light, efficiency_percent=60)
        run = simulate(load_study("cpr8"), own, "light", **LINE)
        bounded = simulate(load_study("cpr8", BOUNDED), own, "light", **LINE)
    assert Check.TORQUE not in run.missing
    assert run.missing[Check.ACCELERATION] == bounded.missing[Check.TORQUE] == ("rotor_inertia",)
