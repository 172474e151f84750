"""Editing, copying and removing single rows: checked as a whole, written as a whole, and told."""

import shutil
import sqlite3
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from math import inf
from pathlib import Path

import pytest

from actuator_select._resources import shipped_dir
from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.kinds import KINDS
from actuator_select.errors import CatalogueUnavailable, InvalidRows, RowInUse, UnknownName

SOURCE = "filipovic-kevac-2018"
MOTOR = "filipovic-kevac-2018-motor-1"
GEARBOX = "filipovic-kevac-2018-gearbox-30"
ACTUATOR = "filipovic-kevac-2018-1"
NEW_SOURCE = {"document": "Acme catalogue", "url": "https://acme.example/m.pdf", "date": "2024-05"}
OWN_MOTOR = {"id": "m", "rated_power_w": 150, "mass_kg": 0.9, "check_status": "pass", "check_notes": "agrees"}


@pytest.fixture
def own(catalogue: Catalogue) -> Catalogue:
    """The shipped rows and a motor of the user's."""
    catalogue.add("motors", OWN_MOTOR | {"source_id": SOURCE})
    return catalogue


def test_a_column_cannot_be_given_by_two_of_its_names(own: Catalogue) -> None:
    told = refusals(lambda: own.edit("m", {"rated_torque_nm": 0.5, "nominal_torque_nm": 0.6}))
    assert told == ["nominal_torque_nm: '0.6', expected each column once; it is rated_torque_nm again"]


def changed(catalogue: Catalogue, row_id: str, values: dict[str, object]) -> list[tuple[str, object, object]]:
    done = catalogue.edit(row_id, values)
    return [(one.field.name, one.old, one.new) for one in done.differences]


def refusals(change: Callable[[], object]) -> list[str]:
    with pytest.raises(InvalidRows) as error:
        change()
    return [str(problem) for problem in error.value.problems]


def test_an_edit_changes_what_it_names_and_keeps_the_rest(own: Catalogue) -> None:
    values: dict[str, object] = {"rated_power_w": "120.5", "mass_kg": "", "max_speed_rpm": "unlimited"}
    assert changed(own, "m", values) == [
        ("rated_power_w", 150.0, 120.5),
        ("max_speed_rpm", None, inf),
        ("mass_kg", 0.9, None),
    ]
    row = own.part("m")[1]
    assert (row["rated_power_w"], row["max_speed_rpm"], row["mass_kg"]) == (120.5, inf, None)
    assert (row["check_notes"], row["source_id"]) == ("agrees", SOURCE)


def test_an_edit_takes_a_columns_other_name_and_an_actuators_own(own: Catalogue) -> None:
    assert changed(own, "m", {"nominal_speed_rpm": 3000}) == [("rated_speed_rpm", None, 3000.0)]
    done = own.edit("Actuator 1", {"efficiency_percent": 65})
    assert (done.kind, done.row["id"], done.row["motor.id"]) == ("actuators", ACTUATOR, MOTOR)


def test_an_edit_to_the_same_values_writes_nothing(own: Catalogue) -> None:
    history = own.history("m")
    assert changed(own, "m", {"id": "m", "rated_power_w": "150.0"}) == []
    assert own.history("m") == history


def test_everything_that_is_wrong_with_an_edit_is_told_and_nothing_written(own: Catalogue) -> None:
    before, history = own.fingerprint(), own.history("m")
    values: dict[str, object] = {"rated_power_w": "0,5", "watts": 3, "mass_kg": 1, "source_id": "nowhere", "id": "n"}
    told = refusals(lambda: own.edit("m", values))
    by_column = {problem.split(":")[0]: problem for problem in told}
    assert set(by_column) == {"id", "watts", "rated_power_w", "source_id"}
    assert "catalog copy m --as NEW" in by_column["id"]
    assert "write 0.5 with a point" in by_column["rated_power_w"]
    assert "[W]" in by_column["rated_power_w"]
    assert (own.fingerprint(), own.history("m")) == (before, history)


@pytest.mark.parametrize(
    ("row_id", "values", "told"),
    [
        ("m", {"source_id": ""}, "source_id: empty, expected the id of a row of sources"),
        (SOURCE, {"page": "", "url": "", "doi": ""}, "page: empty, expected at least one of page, url, doi"),
        ("Actuator 1", {"name": "Actuator 2"}, "name: 'Actuator 2', expected another name than actuator"),
        (
            GEARBOX,
            {"max_continuous_torque_nm": 9, "max_intermittent_torque_nm": 3},
            "max_intermittent_torque_nm: '3.0'",
        ),
    ],
)
def test_an_edit_is_checked_with_the_whole_row(
    own: Catalogue, row_id: str, values: dict[str, object], told: str
) -> None:
    (problem,) = refusals(lambda: own.edit(row_id, values))
    assert problem.startswith(told)


def test_a_new_source_is_written_with_the_edit_or_not_at_all(own: Catalogue) -> None:
    refusals(lambda: own.edit("m", {"rated_power_w": -1}, source=NEW_SOURCE))
    assert own.count("sources") == 1
    own.edit("m", {"rated_power_w": 140}, source=NEW_SOURCE)
    assert own.part("m")[1]["source_id"] == "acme-catalogue-2024-05"
    assert own.source("acme-catalogue-2024-05")["document"] == "Acme catalogue"


def test_two_sources_for_one_row_are_refused(own: Catalogue) -> None:
    (problem,) = refusals(lambda: own.edit("m", {"source_id": SOURCE}, source=NEW_SOURCE))
    assert problem == f"source_id: '{SOURCE}', expected no source_id beside source.…; leave out one of them"
    (problem,) = refusals(lambda: own.edit(SOURCE, {}, source=NEW_SOURCE))
    assert problem.startswith("source.document: 'Acme catalogue', expected no source.… for a row of sources")


def test_a_dry_run_tells_and_writes_nothing(own: Catalogue) -> None:
    before, history = own.fingerprint(), own.history("m")
    done = own.edit("m", {"rated_power_w": 120}, source=NEW_SOURCE, dry_run=True)
    assert [one.field.name for one in done.differences] == ["rated_power_w", "source_id"]
    assert done.row["rated_power_w"] == 120.0
    assert own.remove("m", dry_run=True).row["id"] == "m"
    assert (own.fingerprint(), own.history("m")) == (before, history)


def test_a_row_that_does_not_exist_is_suggested(own: Catalogue) -> None:
    for change in (own.edit, own.remove):
        with pytest.raises(UnknownName, match="did you mean 'Actuator 1'"):
            change("Actuator1", *([{}] if change == own.edit else []))


def test_a_copy_starts_from_the_original_without_what_its_check_said(own: Catalogue) -> None:
    kind, row = own.copy("m", "n", {"rated_power_w": 100})
    assert (kind, row["id"], row["rated_power_w"], row["mass_kg"]) == ("motors", "n", 100.0, 0.9)
    assert (row["check_status"], row["check_notes"], row["origin"]) == (None, None, "user")
    assert own.part("m")[1]["check_notes"] == "agrees"
    assert [change.changed_by for change in own.history("n")] == ["catalog copy, copied from m"]


def test_a_copied_actuator_is_called_by_its_new_id_or_as_stated(catalogue: Catalogue) -> None:
    assert catalogue.copy("Actuator 1", "mine")[1]["name"] == "mine"
    row = catalogue.copy("Actuator 1", "other", {"name": "Other"})[1]
    assert (row["name"], row["motor_id"], row["motor.id"]) == ("Other", MOTOR, MOTOR)
    assert catalogue.history("mine")[0].changed_by == f"catalog copy, copied from {ACTUATOR}"


def test_a_copy_takes_a_columns_other_name_and_a_new_source(own: Catalogue) -> None:
    own.edit("m", {"rated_speed_rpm": 3000})
    row = own.copy("m", "n", {"nominal_speed_rpm": 2000}, source=NEW_SOURCE)[1]
    assert (row["rated_speed_rpm"], row["source_id"]) == (2000.0, "acme-catalogue-2024-05")


@pytest.mark.parametrize(
    ("new_id", "values", "told"),
    [
        (MOTOR, {}, [f"id: '{MOTOR}', expected an id that the catalogue does not have; choose another with --as"]),
        ("m", {}, ["id: 'm', expected an id that the catalogue does not have; choose another with --as"]),
        ("two words", {"mass_kg": -1}, ["id: 'two words', expected up to 100", "mass_kg: '-1', expected"]),
        ("n", {"id": "o"}, ["id: 'o', expected no other id than 'n'; state it once"]),
    ],
)
def test_a_copy_that_cannot_be_is_refused_whole(
    own: Catalogue, new_id: str, values: dict[str, object], told: list[str]
) -> None:
    before = own.fingerprint()
    problems = refusals(lambda: own.copy("m", new_id, values))
    assert len(problems) == len(told), problems
    assert all(problem.startswith(start) for problem, start in zip(problems, told, strict=True)), problems
    assert own.fingerprint() == before


def test_a_removed_row_is_gone_and_its_history_keeps_its_values(own: Catalogue) -> None:
    removed = own.remove("m")
    assert (removed.kind, removed.row["rated_power_w"], removed.is_of_the_program) == ("motors", 150.0, False)
    assert own.count("motors") == 5
    values = {change.field: change.old for change in own.history("m") if change.action == "removed"}
    assert values == {name: str(value) for name, value in OWN_MOTOR.items()} | {"source_id": SOURCE}


def test_a_row_in_use_is_not_removed_and_its_users_are_named(own: Catalogue) -> None:
    own.copy("Actuator 1", "mine")
    before = own.fingerprint()
    with pytest.raises(RowInUse) as error:
        own.remove(MOTOR)
    assert f"2 rows of actuators use it as their motor: {ACTUATOR}, mine\n" in str(error.value)
    assert f"catalog edit {ACTUATOR} --kind actuators motor_id=…" in str(error.value)
    with pytest.raises(RowInUse, match=r"6 rows of motors name it as their source: .* and 3 more"):
        own.remove(SOURCE)
    own.edit("mine", {"motor_id": "m"})
    with pytest.raises(RowInUse, match="actuator mine uses it as its motor"):
        own.remove("m")
    own.edit("mine", {"motor_id": MOTOR})
    assert own.fingerprint() == before


def test_a_row_that_nothing_uses_any_more_can_be_removed(catalogue: Catalogue) -> None:
    catalogue.remove("Actuator 1")
    assert catalogue.remove(MOTOR).is_of_the_program
    assert (catalogue.count("actuators"), catalogue.count("motors")) == (4, 4)


@pytest.fixture
def next_version(template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], Catalogue]:
    """Open a database as the next version does, which ships 310 W for motor 1 instead of 300 W."""
    shutil.copy(template, tmp_path / "catalogue.db")

    def upgraded() -> Catalogue:
        folder = tmp_path / "catalog"
        shutil.copytree(shipped_dir("catalog"), folder)
        text = (folder / "motors.csv").read_text(encoding="utf-8")
        assert text.count("300,48,") == 1
        (folder / "motors.csv").write_text(text.replace("300,48,", "310,48,"), encoding="utf-8")
        monkeypatch.setattr("actuator_select.database.shipped.shipped_dir", lambda _: folder)
        return open_catalogue(tmp_path / "catalogue.db")

    return upgraded


def power(catalogue: Catalogue) -> tuple[object, object]:
    row = catalogue.part(MOTOR)[1]
    return row["rated_power_w"], row["origin"]


def test_an_edited_shipped_row_is_the_users_and_survives_an_upgrade(
    tmp_path: Path, next_version: Callable[[], Catalogue]
) -> None:
    with open_catalogue(tmp_path / "catalogue.db") as catalogue:
        catalogue.edit(MOTOR, {"rated_power_w": 295})
        assert power(catalogue) == (295.0, "user")
    with next_version() as catalogue:
        assert power(catalogue) == (295.0, "user")


def test_a_row_that_is_edited_back_is_shipped_again_and_follows_upgrades(
    tmp_path: Path, next_version: Callable[[], Catalogue]
) -> None:
    with open_catalogue(tmp_path / "catalogue.db") as catalogue:
        catalogue.edit(MOTOR, {"rated_power_w": 295})
        catalogue.edit(MOTOR, {"rated_power_w": 300})
        assert power(catalogue) == (300.0, "shipped")
    with next_version() as catalogue:
        assert power(catalogue) == (310.0, "shipped")


@pytest.mark.parametrize(("again", "before", "after"), [(300.0, "shipped", 310.0), (295.0, "user", 295.0)])
def test_a_shipped_row_that_is_removed_and_added_again_is_told_by_its_figures(
    tmp_path: Path, next_version: Callable[[], Catalogue], again: float, before: str, after: float
) -> None:
    with open_catalogue(tmp_path / "catalogue.db") as catalogue:
        catalogue.remove("Actuator 1")
        row = catalogue.remove(MOTOR).row
        values = {field.name: row[field.name] for field in KINDS["motors"].fields}
        catalogue.add("motors", values | {"rated_power_w": again})
        assert power(catalogue) == (again, before)
    with next_version() as catalogue:
        assert power(catalogue) == (after, before)


def test_a_removed_shipped_row_does_not_come_back(tmp_path: Path, next_version: Callable[[], Catalogue]) -> None:
    with open_catalogue(tmp_path / "catalogue.db") as catalogue:
        catalogue.remove("Actuator 1")
        catalogue.remove(MOTOR)
    with next_version() as catalogue, pytest.raises(UnknownName):
        catalogue.part(MOTOR)


def test_an_edit_waits_for_another_programs_write(own: Catalogue, tmp_path: Path) -> None:
    other = sqlite3.connect(tmp_path / "catalogue.db", isolation_level=None, check_same_thread=False)
    other.execute("BEGIN IMMEDIATE")
    other.execute("UPDATE motors SET mass_kg = 2.5 WHERE id = 'm'")
    began = time.monotonic()
    timer = threading.Timer(0.3, other.commit)
    timer.start()
    assert changed(own, "m", {"rated_power_w": 120}) == [("rated_power_w", 150.0, 120.0)]
    assert time.monotonic() - began > 0.25
    timer.join()
    other.close()
    assert own.part("m")[1]["mass_kg"] == 2.5


def test_an_edit_that_waits_in_vain_says_so_and_writes_nothing(own: Catalogue, tmp_path: Path) -> None:
    before, history = own.fingerprint(), own.history("m")
    other = sqlite3.connect(tmp_path / "catalogue.db", isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    with (
        open_catalogue(f"sqlite:///{tmp_path / 'catalogue.db'}?timeout=0.05") as impatient,
        pytest.raises(CatalogueUnavailable, match="another program is reading or writing it"),
    ):
        impatient.edit("m", {"rated_power_w": 120})
    other.close()
    assert (own.fingerprint(), own.history("m")) == (before, history)


def test_processes_that_edit_one_row_together_lose_nothing(own: Catalogue, tmp_path: Path) -> None:
    code = (
        "import sys\n"
        "from actuator_select.database import open_catalogue\n"
        "with open_catalogue(sys.argv[1]) as catalogue:\n"
        "    for number in range(1, 11):\n"
        "        catalogue.edit('m', {sys.argv[2]: number})\n"
    )
    columns = ("rated_power_w", "mass_kg", "length_mm")
    path = str(tmp_path / "catalogue.db")
    running = [subprocess.Popen([sys.executable, "-c", code, path, column]) for column in columns]
    assert [process.wait(timeout=60) for process in running] == [0, 0, 0]
    row = own.part("m")[1]
    assert [row[column] for column in columns] == [10.0, 10.0, 10.0]
    for column in columns:
        recorded = [change for change in own.history("m") if change.field == column]
        assert [change.new for change in recorded] == [str(number) for number in range(1, 11)]


def test_a_change_that_is_interrupted_leaves_nothing(own: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    before, history = own.fingerprint(), own.history("m")

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    changes: list[Callable[[], object]] = [
        lambda: own.edit("m", {"mass_kg": 2}, source=NEW_SOURCE),
        lambda: own.copy("m", "n"),
        lambda: own.remove("m"),
    ]
    monkeypatch.setattr("actuator_select.database.queries.insert_changes", stop)
    for change in changes:
        with pytest.raises(KeyboardInterrupt):
            change()
    assert (own.fingerprint(), own.history("m")) == (before, history)


def test_uses_tell_who_refers_to_a_row_by_which_column(own: Catalogue) -> None:
    own.copy("Actuator 1", "mine", {"name": "My drive"})
    uses = own.uses(MOTOR, "motor")
    assert [(use.used_id, use.kind.name, use.field.name, use.row_id, use.name) for use in uses] == [
        (MOTOR, "actuators", "motor_id", ACTUATOR, "Actuator 1"),
        (MOTOR, "actuators", "motor_id", "mine", "My drive"),
    ]
    assert {use.kind.name for use in own.uses(SOURCE, "sources")} == {"motors", "gearboxes", "winches", "actuators"}
    assert own.uses("mine", "actuators") == []


def test_a_name_with_no_near_one_is_answered_with_the_command_that_lists_the_kind(own: Catalogue) -> None:
    for number in range(8):
        own.copy("m", f"m{number}")
    with pytest.raises(UnknownName, match="`actuator-select catalog list motors` lists what there is"):
        own.part("zzzzzzzz", "motor")
    with pytest.raises(UnknownName, match="`actuator-select catalog list KIND` lists what there is"):
        own.part("zzzzzzzz")


def test_a_copy_to_an_id_that_is_taken_names_the_other_faults_too(own: Catalogue) -> None:
    problems = refusals(lambda: own.copy("m", MOTOR, {"mass_kg": -1}, source={"document": "D"}))
    assert any("choose another with --as" in problem for problem in problems)
    assert any(problem.startswith("mass_kg: '-1'") for problem in problems)
    assert any(problem.startswith("source.") for problem in problems)
    assert not any("--update" in problem for problem in problems)
