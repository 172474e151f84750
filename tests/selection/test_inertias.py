"""What turns with a motor: stated inertias of gearbox and drum count, missing ones are assumed or named as left out."""

import csv
import io
import json
from collections.abc import Iterator
from math import isnan
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from actuator_select import Catalogue, load_study, open_catalogue, rank, render_report, simulate
from actuator_select.cli import command
from actuator_select.model.actuation import Check, shaft_inertia
from actuator_select.selection import selection_record
from actuator_select.selection.candidates import from_rows
from actuator_select.selection.inertias import NO_SHAFT
from actuator_select.selection.part_wording import exceeded_notes, left_out_note
from actuator_select.selection.records import simulation_record
from actuator_select.study import TemplateOptions, parse_study, template_text
from actuator_select.study.schema import AssumptionsTable
from tests.selection.parts import DC, PRINTED, SERVO, SOURCE, add_drive

ROW = {
    "id": "x",
    "name": "x",
    "gearbox_id": "g",
    "gearbox.ratio": 30.0,
    "efficiency_percent": 60.0,
    "motor.rotor_inertia_g_cm2": 100.0,
    "motor.electrical_convention": "dc_terminal",
}
GEARBOX, DRUM = {"gearbox.inertia_input_g_cm2": 50.0}, {"winch.drum_inertia_kg_m2": 2e-3}
AT_MOTOR = 2e-3 / (30.0**2 * 0.6)
BOTH = 1e-5 + AT_MOTOR  # rotor and drum
NEITHER = ("inertia of the gearbox", "inertia of the drum")


@pytest.fixture
def own() -> Iterator[Catalogue]:
    with open_catalogue(":memory:") as opened:
        yield opened


@pytest.mark.parametrize(
    ("stated", "inertia", "left_out"),
    [
        ({}, 1e-5, NEITHER),
        (GEARBOX, 1.5e-5, NEITHER[1:]),
        (DRUM, 1e-5 + AT_MOTOR, NEITHER[:1]),
        (GEARBOX | DRUM, 1.5e-5 + AT_MOTOR, ()),
        ({"gearbox.inertia_input_g_cm2": 0.0, "winch.drum_inertia_kg_m2": 0.0}, 1e-5, ()),
        (GEARBOX | {"winch.winch_inertia_kg_m2": 2e-3, "winch.winch_inertia_at": "drum_shaft"}, 1.5e-5 + AT_MOTOR, ()),
        (GEARBOX | {"winch.winch_inertia_kg_m2": 2e-6, "winch.winch_inertia_at": "motor_shaft"}, 1.7e-5, ()),
        (GEARBOX | {"winch.winch_inertia_kg_m2": 2e-3}, 1.5e-5, (NO_SHAFT,)),
        (DRUM | {"winch.winch_inertia_kg_m2": 9.0, "winch.winch_inertia_at": "drum_shaft"}, BOTH, NEITHER[:1]),
        ({"gearbox_id": None, "efficiency_percent": None}, 1e-5, NEITHER[1:]),
        (DRUM | {"gearbox_id": None, "efficiency_percent": None}, 1e-5 + 2e-3, ()),
    ],
)  # fmt: skip
def test_what_is_stated_of_gearbox_and_drum_is_added_at_the_motors_shaft(
    stated: dict[str, object], inertia: float, left_out: tuple[str, ...]
) -> None:
    found = from_rows([ROW | stated])
    assert found.actuators.rotor_inertia[0] == pytest.approx(inertia, rel=1e-14)
    assert found.left_out == (left_out,)
    assert found.assumed == ((),)


def test_a_drums_inertia_arrives_whole_behind_the_gearbox() -> None:
    with_drum, without = (shaft_inertia(from_rows([ROW | stated]).actuators)[0] for stated in (DRUM, {}))
    assert with_drum - without == pytest.approx(2e-3, rel=1e-12)


def test_missing_inertias_are_taken_from_the_study_and_listed() -> None:
    assumptions = AssumptionsTable(gearbox_inertia_g_cm2=50.0, drum_inertia_kg_m2=2e-3)
    found = from_rows([ROW, ROW | GEARBOX | DRUM], assumptions)
    assert found.actuators.rotor_inertia == pytest.approx(np.full(2, 1.5e-5 + AT_MOTOR), rel=1e-14)
    assert [(one.key, one.value) for one in found.assumed[0]] == [
        ("assumptions.gearbox_inertia_g_cm2", 50.0),
        ("assumptions.drum_inertia_kg_m2", 2e-3),
    ]
    assert found.assumed[1] == ()
    assert found.left_out == ((), ())


def test_without_the_rotors_inertia_nothing_is_known_and_nothing_else_is_listed() -> None:
    row = ROW | GEARBOX | {"motor.rotor_inertia_g_cm2": None}
    found = from_rows([row], AssumptionsTable(drum_inertia_kg_m2=1e-3))
    assert isnan(found.actuators.rotor_inertia[0])
    assert (found.assumed, found.left_out) == (((),), ((),))


def test_a_drum_behind_an_unknown_efficiency_makes_the_inertia_unknown_and_names_the_efficiency(own: Catalogue) -> None:
    own.add("winches", SOURCE | {"id": "heavy", "drum_radius_mm": 80, "drum_inertia_kg_m2": 1e-3})
    add_drive(own, "dc", DC, winch_id="heavy")
    asked = {"checks.apply": ["acceleration"], "tension.model": "pseudo_inverse"}
    dc = rank(load_study("cpr8", asked), own, where="id = 'dc'").ranked[0]
    acceleration = dc.checks[Check.ACCELERATION]
    assert acceleration.state == "not_evaluated"
    assert acceleration.missing == ("efficiency",)
    key = "assumptions.gearbox_efficiency_percent"
    assert acceleration.assumable == {"efficiency": key}
    helped = rank(load_study("cpr8", asked | {key: 70.0}), own, where="id = 'dc'").ranked[0]
    assert helped.checks[Check.ACCELERATION].missing == ()
    assert [one.key for one in helped.assumptions] == [key]


def test_a_heavier_drum_never_raises_the_count(own: Catalogue) -> None:
    for name, inertia in (("light", 0.0), ("heavy", 0.5)):
        own.add("winches", SOURCE | {"id": name, "drum_radius_mm": 80, "drum_inertia_kg_m2": inertia})
        add_drive(own, f"on-{name}", DC, winch_id=name, efficiency_percent=60)
    counts = {
        one.id: one.checks[Check.ACCELERATION].poses
        for one in rank(load_study("cpr8"), own, where="id in ('on-light', 'on-heavy')").ranked
    }
    assert counts["on-heavy"] < counts["on-light"]


@pytest.mark.parametrize(
    ("motor", "checks", "left_out"),
    [
        (DC, ["speed", "torque"], ()),
        (DC, ["acceleration"], NEITHER),
        (DC, ["voltage"], NEITHER),
        (SERVO, ["speed", "torque", "voltage"], ()),
        (SERVO, ["acceleration"], NEITHER),
    ],
)
def test_an_inertia_is_missed_or_assumed_only_where_a_check_needs_it(
    own: Catalogue, motor: dict[str, object], checks: list[str], left_out: tuple[str, ...]
) -> None:
    add_drive(own, "one", motor, efficiency_percent=60)
    asked = {"checks.apply": checks}
    assert rank(load_study("cpr8", asked), own, where="id = 'one'").ranked[0].left_out == left_out
    keys = {"assumptions.gearbox_inertia_g_cm2": 0.0, "assumptions.drum_inertia_kg_m2": 0.0}
    assumed = rank(load_study("cpr8", asked | keys), own, where="id = 'one'").ranked[0]
    assert assumed.left_out == ()
    assert set(keys) & {one.key for one in assumed.assumptions} == (set(keys) if left_out else set())


def test_what_is_left_out_is_one_line_for_all_and_stands_in_json(own: Catalogue) -> None:
    selection = rank(load_study("cpr8"), own, where=PRINTED)
    begins = "Left out, because neither catalogue nor study states it: inertia of gearbox and drum, for "
    assert left_out_note(selection.ranked) == f"{begins}all 5 actuators."
    assert left_out_note([]) == ""
    assert selection_record(selection)["actuators"][0]["left_out"] == list(NEITHER)
    assert f"{begins}all 5 actuators." in render_report(selection, own)


HALL = TemplateOptions(hall=(15.0, 11.0, 5.0), mass=300.0)
EXCEEDS = "id = 'big'"


def add_big(catalogue: Catalogue) -> None:
    catalogue.add("winches", SOURCE | {"id": "drum-60", "drum_radius_mm": 60})
    parts = {"motor_id": "mitsubishi-HC702", "gearbox_id": "beckhoff-NPS015-MF-i10", "winch_id": "drum-60"}
    catalogue.add("actuators", SOURCE | {"id": "big", "name": "Big", "efficiency_percent": 90} | parts)


def test_a_gearbox_that_would_break_is_warned_of_though_the_drive_meets(own: Catalogue) -> None:
    add_big(own)
    study = parse_study(template_text("hall", "suspended-8", HALL), place="hall")
    selection = rank(study, own, where=EXCEEDS)
    (big,) = selection.ranked
    assert big.verdict == "meets"
    torque = big.exceeded[0]
    assert (torque.column, torque.limit, torque.unit) == ("gearbox.max_intermittent_torque_nm", 35.0, "N m")
    assert torque.demand > 100.0
    (note,) = exceeded_notes(selection.ranked)
    assert note.startswith(
        "Big: beyond what its parts may bear, which no check holds yet: gearbox.max_intermittent_torque_nm 35 N m, "
        f"where up to {torque.demand:.4g} N m are asked for"
    )
    assert selection_record(selection)["actuators"][0]["exceeded_part_limits"][0]["limit"] == 35.0
    page = " ".join(render_report(selection, own).split())
    assert "Big is asked for more than its parts may bear" in page[: page.index("Shortlist")]
    assert note in page[page.index("<h2>Parts and sources</h2>") :]
    assert len(exceeded_notes([big] * 9)) == 6
    assert exceeded_notes([big] * 9)[-1] == "and 4 more beyond what their parts may bear."


def test_an_ordinary_drive_is_not_warned_of(own: Catalogue) -> None:
    selection = rank(load_study("cpr8"), own, where=PRINTED)
    assert exceeded_notes(selection.ranked) == []
    assert "more than its parts may bear" not in render_report(selection, own)


def test_csv_says_as_much_as_json_and_every_format_warns(tmp_path: Path) -> None:
    database, study = str(tmp_path / "catalogue.db"), tmp_path / "hall.toml"
    with open_catalogue(database) as catalogue:
        add_big(catalogue)
    study.write_text(template_text("hall", "suspended-8", HALL), encoding="utf-8")
    done = {
        one: CliRunner().invoke(
            command, ["rank", str(study), "--where", EXCEEDS, "--format", one, "--database", database]
        )
        for one in ("table", "csv", "json")
    }
    for result in done.values():
        assert "Warning: Big: beyond what its parts may bear" in result.stderr
        assert "beyond what its parts" not in result.stdout
    header, cells = csv.reader(io.StringIO(done["csv"].stdout))
    row = dict(zip(header, cells, strict=True))
    (record,) = json.loads(done["json"].stdout)["actuators"]
    assert row["left_out"] == "; ".join(record["left_out"]) == "inertia of the drum"
    assert row["exceeded_part_limits"] == "; ".join(one["text"] for one in record["exceeded_part_limits"])
    assert row["feasible_is_upper_bound"] == str(record["feasible_is_upper_bound"])
    assert row["feasible_poses_exact"] == str(record["feasible_poses_exact"])
    for check, verdict in record["checks"].items():
        assert row[f"{check}_missing"] == "; ".join(verdict["missing"])
        assert row[f"{check}_reason"] == (verdict["reason"] or "")
    assert row["voltage_reason"]


def test_a_gear_inside_the_winch_multiplies_the_ratio_and_its_losses_are_the_assemblys_to_state() -> None:
    row: dict[str, object] = {
        "gearbox_id": "g",
        "gearbox.ratio": 10.0,
        "gearbox.efficiency_percent": 90.0,
        "winch.drum_radius_mm": 50.0,
    }
    plain, geared, stated = (
        from_rows([row | more]).actuators
        for more in ({}, {"winch.gear_ratio": 2.0}, {"winch.gear_ratio": 2.0, "efficiency_percent": 80.0})
    )
    assert (plain.ratio[0], plain.efficiency[0]) == (10.0, 0.9)
    assert geared.ratio[0] == 20.0
    assert np.isnan(geared.efficiency[0]), "the gearbox's efficiency says nothing about the winch's gear"
    assert (stated.ratio[0], stated.efficiency[0]) == (20.0, 0.8)
    (direct,) = from_rows([{"winch.gear_ratio": 2.0}]).actuators.ratio
    assert direct == 2.0


def test_a_move_names_what_an_unknown_inertia_takes_and_what_is_left_out(tmp_path: Path) -> None:
    with open_catalogue(tmp_path / "own.db") as own:
        own.add("winches", {"id": "w", "drum_radius_mm": 80, "drum_inertia_kg_m2": 0.01, **SOURCE})
        parts = {"motor_id": "mitsubishi-HC702", "gearbox_id": "beckhoff-NPS045-MF-i5", "winch_id": "w"}
        own.add("actuators", {"id": "a", "name": "a", **parts, **SOURCE})
        run = simulate(load_study("cpr8"), own, "a", start=(0.5, 0.5, -1.0), stop=(1.5, 0.5, -1.0))
    assert run.missing[Check.ACCELERATION] == ("efficiency",)
    assert simulation_record(run)["left_out"] == list(run.candidates.left_out[0])
