"""``actuator-select catalog edit``, ``copy``, ``remove``, ``history`` and ``diff``: what they print and where."""

import json
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import pytest

from actuator_select.cli import main
from actuator_select.database import Catalogue, migration, open_catalogue
from actuator_select.database.connection import database_url, make_engine, writing
from actuator_select.database.kinds import KINDS

SOURCE = "filipovic-kevac-2018"
MOTOR = "filipovic-kevac-2018-motor-1"
NEW_SOURCE = ["source.document=Acme catalogue", "source.url=https://acme.example/m.pdf", "source.date=2024"]

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The shipped rows and a motor of the user's."""
    path = tmp_path_factory.mktemp("template") / "catalogue.db"
    with open_catalogue(path) as catalogue:
        values = {"id": "m", "rated_power_w": 150, "rated_speed_rpm": 3000, "rated_torque_nm": 0.4775}
        catalogue.add("motors", values | {"source_id": SOURCE})
    return path


@pytest.fixture
def database(template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = Path(shutil.copy(template, tmp_path / "catalogue.db"))
    monkeypatch.setenv("ACTUATOR_SELECT_DATABASE", str(path))
    monkeypatch.chdir(tmp_path)
    return path


@pytest.fixture
def run(database: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run ``actuator-select catalog``; status, stdout, stderr."""
    assert database.exists()

    def call(*arguments: str) -> tuple[int, str, str]:
        capsys.readouterr()
        status = main(["catalog", *arguments])
        printed = capsys.readouterr()
        return status, printed.out, printed.err

    return call


@pytest.fixture
def catalogue(database: Path) -> Iterator[Catalogue]:
    with open_catalogue(database) as opened:
        yield opened


def answer(
    monkeypatch: pytest.MonkeyPatch, answers: dict[str, list[str]], *, again: dict[str, str] | None = None
) -> dict[str, str]:
    """Answer questions by their field, others by Enter; the defaults that stood in brackets are collected.

    Those of a field that was asked before go to `again`.
    """
    asked: dict[str, str] = {}
    waiting = {name: iter(texts) for name, texts in answers.items()}

    def prompt(question: str, *, default: str, show_default: bool, err: bool) -> str:
        assert err
        assert show_default == bool(default)
        field = question.split(" – ", maxsplit=1)[0]
        if again is not None and field in asked:
            again[field] = default
        asked.setdefault(field, default)
        return next(waiting.get(field, iter([])), default)

    monkeypatch.setattr(click, "prompt", prompt)
    return asked


def test_edit_prints_what_changed_with_units(run: Run) -> None:
    status, out, err = run("edit", "m", "rated_torque_nm=0.48", "rated_current_a=", "peak_torque_nm=unlimited")
    assert (status, out) == (0, "")
    assert err == (
        "Changed motor m.\n  rated_torque_nm: 0.4775 → 0.48 N m\n  peak_torque_nm: – → unlimited N m\n"
        "Next: actuator-select catalog show m --kind motors\n"
    )
    assert run("edit", "m", "rated_torque_nm=0.480")[2] == "There is nothing to change: motor m has these values.\n"


def test_edit_warns_of_what_is_implausible_and_writes_it(run: Run, catalogue: Catalogue) -> None:
    status, _, err = run("edit", "m", "rated_torque_nm=4.775", *NEW_SOURCE)
    assert status == 0
    assert "Warning: motors m: rated_power_w is 150 W, but 1500 W follows" in err
    assert f"  source_id: {SOURCE} → acme-catalogue-2024\n" in err
    assert catalogue.part("m")[1]["rated_torque_nm"] == 4.775


def test_a_dry_run_of_an_edit_tells_and_warns_but_writes_nothing(run: Run, catalogue: Catalogue) -> None:
    before = catalogue.fingerprint()
    status, out, err = run("edit", "m", "rated_torque_nm=4.775", "--dry-run")
    assert (status, out) == (0, "")
    assert err.startswith("Dry run: motor m would change. Nothing was written.\n  rated_torque_nm: 0.4775 → 4.775 N m")
    assert "Warning: motors m" in err
    assert catalogue.fingerprint() == before


def test_a_refused_edit_names_every_fault(run: Run, catalogue: Catalogue) -> None:
    before = catalogue.fingerprint()
    status, out, err = run("edit", "m", "rated_power_w=1,5", "mass_kg=-1", "wats=3", "id=n")
    assert (status, out) == (2, "")
    assert "motor 'm' was not changed" in err
    for words in (
        "rated_power_w: '1,5', expected a number more than 0 [W]",
        "mass_kg: '-1', expected a number more than 0 [kg]",
        "wats: '3', expected a column of motors",
        "id: 'n', expected no other id than 'm'; the id never changes; copy the row: catalog copy m --as NEW",
    ):
        assert words in err
    assert run("edit", "m", "rated_power_w")[2].startswith("Error: nothing was written\n  'rated_power_w': no value")
    assert catalogue.fingerprint() == before


def test_edit_without_fields_asks_with_the_present_values(
    run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    catalogue.edit("m", {"mass_kg": 2, "notes": "old", "peak_torque_nm": "unlimited"})
    asked = answer(monkeypatch, {"rated_power_w": ["-1", "160"], "mass_kg": ["-"], "source_id": ["-", "nowhere"]})
    status, out, err = run("edit", "m")
    assert (status, out) == (0, "")
    assert [*asked] == [field.name for field in KINDS["motors"].fields if field.name != "id"]
    assert {name: default for name, default in asked.items() if default} == {
        "rated_power_w": "150",
        "rated_speed_rpm": "3000",
        "rated_torque_nm": "0.4775",
        "peak_torque_nm": "unlimited",
        "mass_kg": "2",
        "notes": "old",
        "source_id": SOURCE,
    }
    for words in ("rated_power_w: '-1', expected", "source_id has to be filled in", "there is no 'nowhere'"):
        assert words in err
    assert err.endswith(
        "Changed motor m.\n  rated_power_w: 150 → 160 W\n  mass_kg: 2 → – kg\n"
        "Next: actuator-select catalog show m --kind motors\n"
    )
    assert len(catalogue.history("m")) == 6


def test_edit_asks_again_for_what_the_whole_row_shows_to_be_wrong(
    run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    catalogue.edit("m", {"stall_torque_nm": 5})
    gearbox = {"id": "g", "max_continuous_torque_nm": 5, "max_intermittent_torque_nm": 6, "source_id": SOURCE}
    catalogue.add("gearboxes", gearbox)
    source = {"document": ["Acme"], "url": ["https://acme.example"], "date": ["2024"]}
    answer(monkeypatch, {"max_intermittent_torque_nm": ["3", "12"], "source_id": ["new"], **source})
    status, _, err = run("edit", "g")
    assert status == 0
    assert "max_intermittent_torque_nm: '3.0', expected at least max_continuous_torque_nm = 5 [N m]" in err
    row = catalogue.part("g")[1]
    assert (row["max_intermittent_torque_nm"], row["source_id"]) == (12.0, "acme-2024")


def test_a_question_that_is_repeated_offers_the_last_answer(
    run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    gearbox = {"id": "g", "max_continuous_torque_nm": 5, "max_intermittent_torque_nm": 6, "source_id": SOURCE}
    catalogue.add("gearboxes", gearbox)
    again: dict[str, str] = {}
    answers = {"max_intermittent_torque_nm": ["3", "12"], "source_id": ["new"], "document": ["Acme"], "date": ["2024"]}
    # A source without an address is refused as a whole; then only the address is new.
    answer(monkeypatch, answers | {"url": ["", "https://acme.example"], "page": ["", ""]}, again=again)
    status, _, err = run("edit", "g")
    assert status == 0
    assert "Once more; Enter keeps what stands in brackets, - empties it." in err
    assert again["max_intermittent_torque_nm"] == "3"
    assert (again["source_id"], again["document"], again["date"]) == ("new", "Acme", "2024")
    row = catalogue.part("g")[1]
    assert (row["max_intermittent_torque_nm"], row["source_id"]) == (12.0, "acme-2024")


def test_answers_that_end_early_change_nothing(run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    before = catalogue.fingerprint()

    def end(*_: object, **__: object) -> str:
        raise click.Abort

    monkeypatch.setattr(click, "prompt", end)
    status, _, err = run("edit", "m")
    assert status == 2
    assert "the answers end before the row is complete; nothing was written" in err
    assert catalogue.fingerprint() == before


def test_copy_adds_a_row_and_warns(run: Run, catalogue: Catalogue) -> None:
    status, out, err = run("copy", "m", "--as", "n", "rated_torque_nm=4.775")
    assert (status, out) == (0, "")
    assert err.startswith("Added motor n, copied from m.\nNext: actuator-select catalog show n --kind motors\nWarning:")
    assert catalogue.part("n")[1]["rated_power_w"] == 150.0
    status, _, err = run("copy", "m", "--as", MOTOR)
    assert status == 2
    assert "choose another with --as" in err


def test_remove_says_what_is_left_of_the_row(run: Run) -> None:
    status, out, err = run("remove", "m")
    assert (status, out) == (0, "")
    assert err == (
        "Removed motor m.\nAll its values, to add it again: actuator-select catalog history m --kind motors --all\n"
    )
    _, _, err = run("remove", "Actuator 1", "--yes")
    assert err.startswith("Removed actuator filipovic-kevac-2018-1.\nThe program ships a row of this id; it does not")


def test_remove_is_refused_while_the_row_is_used(run: Run, catalogue: Catalogue) -> None:
    before = catalogue.fingerprint()
    status, out, err = run("remove", MOTOR)
    assert (status, out) == (2, "")
    assert "actuator filipovic-kevac-2018-1 uses it as its motor" in err
    assert "6 rows of motors name it as their source" in run("remove", SOURCE)[2]
    assert catalogue.fingerprint() == before


@pytest.mark.parametrize(("options", "answers", "removed"), [([], [True], 1), ([], [False], 0), (["--yes"], [], 1)])
def test_on_a_terminal_remove_asks_first(
    run: Run,
    catalogue: Catalogue,
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    answers: list[bool],
    removed: int,
) -> None:
    before = catalogue.count("motors")
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr(click, "confirm", lambda question, **_: question == "Remove motor m?" and answers.pop())
    status, _, err = run("remove", "m", *options)
    assert (status, answers, catalogue.count("motors")) == (0, [], before - removed)
    assert ("Nothing was removed." in err) == (removed == 0)


def test_remove_does_not_ask_for_what_cannot_be_removed(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr(click, "confirm", pytest.fail)
    status, _, err = run("remove", MOTOR)
    assert status == 2
    assert "is in use" in err


def test_history_is_a_table_with_units(run: Run) -> None:
    run("edit", "m", "rated_power_w=160")
    run("remove", "m")
    status, out, err = run("history", "m")
    assert (status, err) == (0, "")
    lines = [line.split() for line in out.splitlines() if "motors m" in line]
    assert lines[0][2:] == ["catalog", "add", "motors", "m", "added"]
    assert lines[1][2:] == ["catalog", "edit", "motors", "m", "changed", "rated_power_w", "150", "160", "W"]
    assert [line[2:] for line in lines[2:]] == [
        ["catalog", "remove", "motors", "m", "removed", "5", "values", "(--all", "lists", "them)", "–"]
    ]


def test_history_lists_the_values_of_a_removed_row_on_request(run: Run) -> None:
    run("remove", "m")
    lines = [line.split()[2:] for line in run("history", "m", "--all")[1].splitlines() if "removed" in line]
    assert len(lines) == 5
    assert ["catalog", "remove", "motors", "m", "removed", "rated_power_w", "150", "–", "W"] in lines
    changes = json.loads(run("history", "m", "--format", "json")[1])["changes"]
    assert sum(change["action"] == "removed" for change in changes) == 5


@pytest.mark.parametrize(
    "command",
    [["add", "motor", "id=n", f"source_id={SOURCE}"], ["edit", "m"], ["copy", "m", "--as", "n"]],
    ids=lambda command: command[0],
)
def test_a_field_without_a_value_is_told_with_every_other_objection(
    run: Run, catalogue: Catalogue, command: list[str]
) -> None:
    before = catalogue.fingerprint()
    fields = ["nominal_voltage_v=abc", "mass_kg", "x=1", "rated_power_w=2", "rated_power_w=3"]
    status, out, err = run(*command, *fields)
    assert (status, out) == (2, "")
    heading, *objections = err.splitlines()
    assert heading == "Error: nothing was written"
    assert [line.split(":")[0].strip() for line in objections] == [
        "'mass_kg'",
        "rated_power_w",
        "nominal_voltage_v",
        "x",
    ]
    status, _, err = run(*command, "mass_kg")
    assert (status, err.count("mass_kg")) == (2, 1)
    assert catalogue.fingerprint() == before


def test_history_is_json(run: Run) -> None:
    run("edit", "m", "max_speed_rpm=unlimited")
    record = json.loads(run("history", "m", "--format", "json")[1])
    assert (record["id"], record["is_complete"]) == ("m", True)
    assert [(one["action"], one["field"], one["old"], one["new"]) for one in record["changes"]] == [
        ("added", None, None, None),
        ("changed", "max_speed_rpm", None, "unlimited"),
    ]


def test_history_of_what_never_was_is_an_error_with_near_names(run: Run) -> None:
    run("copy", "m", "--as", "old-drive")
    run("remove", "old-drive")
    status, out, err = run("history", "old-drivo")
    assert (status, out) == (2, "")
    assert "did you mean 'old-drive'?" in err


def test_history_says_that_it_began_after_the_row(run: Run, database: Path) -> None:
    engine = make_engine(database_url(database))
    with writing(engine) as connection:
        migration.downgrade(connection, "0001")
    engine.dispose()
    status, out, err = run("history", "m")
    assert (status, out) == (0, "")
    assert err == "m was there before this catalogue began to keep a history; nothing has happened to it since.\n"
    run("edit", "m", "rated_power_w=160")
    _, out, err = run("history", "m")
    assert "rated_power_w" in out
    assert err == "m was there before this catalogue began to keep a history; what is listed happened since.\n"
    assert json.loads(run("history", "m", "--format", "json")[1])["is_complete"] is False


def test_diff_prints_counts_and_what_differs(run: Run, database: Path, template: Path, catalogue: Catalogue) -> None:
    motors = catalogue.count("motors")
    other = shutil.copy(template, database.parent / "other.db")
    run("edit", "m", "rated_power_w=160", "max_speed_rpm=unlimited")
    run("copy", "m", "--as", "n")
    run("remove", "Actuator 1")
    before = Path(other).read_bytes()
    status, out, err = run("diff", "other.db")
    assert (status, err) == (0, "")
    assert ["motors", str(motors + 1), str(motors), "1", "0", "1"] in [line.split() for line in out.splitlines()]
    assert "motors only here: n\n" in out
    assert "actuators only there: filipovic-kevac-2018-1\n" in out
    assert ["m", "rated_power_w", "160", "150", "W"] in [line.split() for line in out.splitlines()]
    assert ["m", "max_speed_rpm", "unlimited", "–", "rpm"] in [line.split() for line in out.splitlines()]
    assert Path(other).read_bytes() == before


def test_diff_is_json(run: Run, database: Path, template: Path, catalogue: Catalogue) -> None:
    shutil.copy(template, database.parent / "other.db")
    run("edit", "m", "max_speed_rpm=unlimited")
    _, out, _ = run("diff", "other.db", "--kind", "motor", "--format", "json")
    (motors,) = json.loads(out, parse_constant=pytest.fail)["kinds"]
    columns = [{"column": "max_speed_rpm", "unit": "rpm", "here": "unlimited", "there": None}]
    assert motors == {
        "kind": "motors",
        "rows_here": catalogue.count("motors"),
        "rows_there": catalogue.count("motors"),
        "only_here": [],
        "only_there": [],
        "different": [{"id": "m", "columns": columns}],
    }


def test_a_long_diff_is_shortened_and_says_so(run: Run, database: Path, template: Path) -> None:
    shutil.copy(template, database.parent / "other.db")
    rows = "".join(f"r{number:02},{SOURCE}\n" for number in range(25))
    (database.parent / "ropes.csv").write_text(f"id,source_id\n{rows}")
    run("import", "ropes.csv")
    out = run("diff", "other.db")[1]
    assert "r19 … and 5 more; --format json names all" in out
    assert "r20" not in out


def test_diff_of_equal_catalogues_says_so(run: Run, catalogue: Catalogue) -> None:
    motors = str(catalogue.count("motors"))
    status, out, err = run("diff", "catalogue.db")
    assert (status, err) == (0, "Nothing differs.\n")
    assert ["motors", motors, motors, "0", "0", "0"] in [line.split() for line in out.splitlines()]


def test_diff_with_nothing_makes_nothing(run: Run, database: Path) -> None:
    status, out, err = run("diff", "none.db", "--database", "mine.db")
    assert (status, out) == (2, "")
    assert "there is no catalogue file none.db" in err
    assert [path.name for path in database.parent.iterdir()] == ["catalogue.db"]


def test_a_locked_catalogue_is_told(run: Run, database: Path) -> None:
    writer = sqlite3.connect(database, isolation_level=None)
    writer.execute("BEGIN IMMEDIATE")
    for arguments in (("edit", "m", "mass_kg=1"), ("copy", "m", "--as", "n"), ("remove", "m")):
        status, out, err = run(*arguments, "--database", f"sqlite:///{database}?timeout=0.05")
        assert (status, out) == (2, "")
        assert "another program is reading or writing it" in err
    writer.close()
