"""``actuator-select catalog``: what it prints, where, and with which exit status."""

import csv
import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import pytest

from actuator_select.cli import main
from actuator_select.cli.catalog import command
from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.connection import writing
from actuator_select.database.history import add_rows
from actuator_select.database.kinds import KINDS
from actuator_select.database.queries import Row, fetch_rows
from actuator_select.database.reader import ReadableCatalogue
from actuator_select.database.shipped import read_shipped

SOURCE = "filipovic-kevac-2018"
MOTOR_FIELDS = ["id=m", "rated_power_w=150", "rated_speed_rpm=3000", "rated_torque_nm=0.4775"]
SHIPPED_MOTORS = len(read_shipped()["motors"])
NEW_SOURCE = ["source.document=Acme catalogue", "source.url=https://acme.example/m.pdf", "source.date=2024"]

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("template") / "catalogue.db"
    open_catalogue(path).close()
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


def answer(monkeypatch: pytest.MonkeyPatch, answers: list[str]) -> list[str]:
    """Answer the questions of a prompt; what was asked is collected in the list returned."""
    asked: list[str] = []
    waiting = iter(answers)

    def prompt(question: str, **_: object) -> str:
        asked.append(question)
        try:
            return next(waiting)
        except StopIteration:
            raise click.Abort from None

    monkeypatch.setattr(click, "prompt", prompt)
    return asked


@pytest.mark.parametrize("name", list(command.commands))
def test_every_command_teaches_with_an_example(run: Run, name: str) -> None:
    status, out, _ = run(name, "--help")
    assert status == 0
    assert "\n  Example" in out
    assert "\\b" not in out
    assert f"actuator-select catalog {name}" in out


def test_a_table_has_units_in_its_headers_and_tidy_numbers(run: Run) -> None:
    status, out, err = run("list", "actuators", "--where", "rated_power_w >= 50", "--sort", "rated_torque_nm")
    assert status == 0
    assert "motor rated power [W]" in out
    assert [line.split()[2] for line in out.splitlines() if "filipovic" in line] == ["3", "2", "1"]
    assert "3970" in out
    assert "3970.0" not in out
    assert err == "3 actuators\n"


def test_a_table_tells_unknown_from_unlimited(run: Run) -> None:
    run("add", "motor", "id=m", "max_speed_rpm=unlimited", f"source_id={SOURCE}")
    _, out, _ = run("list", "motors", "--columns", "id,max_speed_rpm,mass_kg", "--where", "id = 'm'")
    assert out.split()[-3:] == ["m", "unlimited", "–"]


def test_csv_has_every_column_by_its_own_name(run: Run) -> None:
    _, out, _ = run("list", "motor", "--format", "csv", "--limit", "2")
    header, *rows = out.splitlines()
    assert header.split(",") == [field.name for field in KINDS["motors"].columns]
    assert len(rows) == 2


def test_json_is_strict_and_carries_the_fingerprint(run: Run, catalogue: Catalogue) -> None:
    run("add", "motor", "id=m", "max_speed_rpm=unlimited", f"source_id={SOURCE}")
    status, out, _ = run("list", "motors", "--format", "json", "--where", "id = 'm'")
    record = json.loads(out, parse_constant=pytest.fail)
    assert status == 0
    assert record["kind"] == "motors"
    assert record["catalogue"] == {"fingerprint": catalogue.fingerprint()}
    (row,) = record["rows"]
    assert (row["max_speed_rpm"], row["mass_kg"]) == ("unlimited", None)


def test_a_minus_begins_with_the_greatest(run: Run) -> None:
    _, out, _ = run(
        *("list", "motors", "--sort", "-rated_power_w", "--where", "id contains 'filipovic'"),
        *("--columns", "rated_power_w", "--format", "csv"),
    )
    assert out.splitlines() == ["rated_power_w", "300", "100", "50", "20", "10"]


def test_a_limit_says_how_many_there_are(run: Run) -> None:
    _, out, err = run("list", "motors", "--limit", "2", "--columns", "id")
    assert out.count("beckhoff") == 2
    more = "a greater --limit shows more, --where chooses, --format csv gives all"
    assert err == f"2 of {SHIPPED_MOTORS} motors; {more}\n"


@pytest.fixture
def many(catalogue: Catalogue) -> Catalogue:
    """A catalogue with 700 ropes that no list shows at once; r-0003 says that it is to be looked at."""
    ropes = [{"id": f"r-{number:04}", "source_id": SOURCE, "origin": "user"} for number in range(700)]
    ropes[3]["check_status"] = "flag"
    with writing(catalogue._engine) as connection:  # noqa: SLF001
        add_rows(connection, KINDS["ropes"], ropes, by="test")
    return catalogue


@pytest.mark.parametrize("columns", [[], ["--columns", "id,diameter_mm"]])
def test_a_table_ends_after_500_rows_and_tells_how_many_there_are(
    run: Run, many: Catalogue, columns: list[str]
) -> None:
    where = ["--where", "id contains 'r-0' and diameter_mm is unknown"]
    _, out, err = run("list", "ropes", *where, *columns)
    assert (out.count("r-0"), "r-0499" in out) == (500, True)
    assert err.startswith("500 of 700 ropes; a greater --limit shows more")
    assert run("list", "ropes", *where, *columns, "--limit", "600")[1].count("r-0") == 600
    assert run("list", "ropes", *where, *columns, "--limit", "700")[2] == "700 ropes\n"
    assert many.count("ropes") > 700


def test_a_table_reads_no_more_rows_than_it_shows(run: Run, many: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    assert many.count("ropes", "id contains 'r-0'") == 700
    read: list[int] = []

    def counted(*arguments: object) -> list[Row]:
        found = fetch_rows(*arguments)
        read.append(len(found))
        return found

    monkeypatch.setattr("actuator_select.database.queries.fetch_rows", counted)
    out = run("list", "ropes", "--where", "id contains 'r-0'", "--columns", "id")[1]
    assert (out.count("r-0"), read) == (500, [500])


@pytest.mark.parametrize("file_format", ["csv", "json"])
def test_csv_and_json_give_every_row_unless_limited(run: Run, many: Catalogue, file_format: str) -> None:
    arguments = ["list", "ropes", "--where", "id contains 'r-0'", "--columns", "id,id,mass_kg_per_m"]
    assert many.count("ropes", "id contains 'r-0'") == 700

    def ids(*more: str) -> list[str]:
        out = run(*arguments, "--format", file_format, *more)[1]
        if file_format == "json":
            return [row["id"] for row in json.loads(out)["rows"]]
        return [row["id"] for row in csv.DictReader(out.splitlines())]

    assert ids() == [f"r-{number:04}" for number in range(700)]
    assert ids("--limit", "2", "--sort", "-id") == ["r-0699", "r-0698"]
    assert ids("--where", "id = 'no-rope'") == []


ODD_TEXT = "a\r\nb\tc\u202ed\u2066e"


def test_control_characters_are_escaped_for_people_and_kept_for_programs(run: Run, catalogue: Catalogue) -> None:
    catalogue.add("ropes", {"id": "odd", "name": ODD_TEXT, "notes": "one\ntwo\rthree", "source_id": SOURCE})
    catalogue.edit("odd", {"manufacturer": ODD_TEXT})
    where = ["--where", "id = 'odd'"]
    for arguments in (["list", "ropes", *where], ["history", "odd"]):
        out = run(*arguments)[1]
        assert r"a\r\nb\tc\u202ed\u2066e" in out
        assert set(out) & set("\r\t\u202e\u2066") == set()
    out = run("show", "odd")[1]
    assert r"b\tc\u202ed\u2066e" in out
    assert set(out) & set("\r\t\u202e\u2066") == set()
    assert [line.split()[-1] for line in out.splitlines() if line.endswith(("one", r"two\rthree"))] == [
        "one",
        r"two\rthree",
    ]
    (row,) = json.loads(run("list", "ropes", *where, "--format", "json")[1])["rows"]
    assert row["name"] == ODD_TEXT
    assert f'"{ODD_TEXT}"' in run("list", "ropes", *where, "--columns", "name", "--format", "csv")[1]
    assert json.loads(run("show", "odd", "--format", "json")[1])["row"]["name"] == ODD_TEXT


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["list", "motrs"], "did you mean 'motors'"),
        (["list", "motors", "--where", "powr > 3"], "  powr > 3\n  ^"),
        (["list", "motors", "--sort", "weight"], "there is no column weight"),
        (["list", "motors", "--columns", "id,weight"], "there is no column weight"),
        (["list", "motors", "--limit", "0"], "--limit"),
        (["list"], "Missing argument"),
        (["show", "nothing"], "there is no 'nothing'"),
        (["fields", "wheels"], "no kind 'wheels'"),
        (["check", "wheels"], "no kind 'wheels'"),
        (["export", "wheels"], "no kind 'wheels'"),
        (["export"], "name a KIND"),
        (["export", "motors", "--output", "no/such/folder/motors.csv"], "cannot write"),
        (["import", "nothing.csv"], "cannot read nothing.csv"),
        (["add", "motor", "rated_power_w"], "expected FIELD=VALUE"),
        (["add", "motor", "id=a", "id=b"], "expected each field once"),
        (["add", "motor", "id=a", "rated_power_w=-1"], "expected a number more than 0 [W]"),
        (["list", "motors", "--database", "steam://engine"], "names no kind of database"),
    ],
)
def test_a_question_that_cannot_be_posed_is_explained(run: Run, arguments: list[str], words: str) -> None:
    status, out, err = run(*arguments)
    assert status == 2
    assert out == ""
    assert words in err
    assert "Traceback" not in err


def test_show_gives_figures_parts_source_and_findings(run: Run) -> None:
    status, out, err = run("show", "Actuator 4")
    assert status == 0
    for words in ("rated torque", "0.212 N m", "80 mm", "Mirjana Filipović", "10.22190/FUACR1802071F"):
        assert words in out
    assert "Warning: motors filipovic-kevac-2018-motor-4" in err


def test_show_as_json_has_the_same(run: Run) -> None:
    _, out, _ = run("show", "filipovic-kevac-2018-4", "--format", "json")
    record = json.loads(out, parse_constant=pytest.fail)
    assert record["kind"] == "actuators"
    assert record["row"]["name"] == "Actuator 4"
    assert record["parts"]["motor"]["rated_torque_nm"] == 0.212
    assert [source["id"] for source in record["sources"]] == [SOURCE]
    assert "rated_power" in {finding["rule"] for finding in record["findings"]}


def test_check_names_the_faults_of_table_1_with_numbers(run: Run) -> None:
    status, out, _ = run("check")
    assert status == 0
    assert "112.3   W" in out
    assert "stall torque" in out
    assert "Actuator 4" in out
    _, out, _ = run("check", "motors", "--format", "json")
    findings = json.loads(out, parse_constant=pytest.fail)["findings"]
    printed = [finding for finding in findings if finding["id"].startswith("filipovic")]
    wrong_power = {finding["id"][-1] for finding in printed if finding["rule"] == "rated_power"}
    assert wrong_power == {"2", "3", "4", "5"}


def test_check_of_actuators_checks_their_parts(run: Run) -> None:
    run(
        "add",
        "motor",
        "id=unused",
        "rated_power_w=1",
        "rated_speed_rpm=3000",
        "rated_torque_nm=9",
        f"source_id={SOURCE}",
    )
    _, out, _ = run("check", "actuators", "--format", "json")
    ids = {finding["id"] for finding in json.loads(out)["findings"]}
    assert "filipovic-kevac-2018-motor-4" in ids
    assert "unused" not in ids


def test_fields_lists_every_column_with_its_range(run: Run) -> None:
    _, out, _ = run("fields", "motors")
    for field in KINDS["motors"].fields:
        assert field.name in out
    assert "a number more than 0 [N m], or unlimited" in out
    _, out, _ = run("fields", "motors", "--format", "json")
    assert [field["name"] for field in json.loads(out)["fields"]] == [field.name for field in KINDS["motors"].fields]


def test_add_takes_fields_and_a_new_source(run: Run, catalogue: Catalogue) -> None:
    status, out, err = run("add", "motor", *MOTOR_FIELDS, *NEW_SOURCE)
    assert (status, out) == (0, "")
    assert err == "Added motor m.\nNext: actuator-select catalog show m --kind motors\n"
    assert catalogue.part("m")[1]["source_id"] == "acme-catalogue-2024"


def test_add_warns_of_what_is_implausible_and_adds_it(run: Run, catalogue: Catalogue) -> None:
    status, _, err = run("add", "motor", *MOTOR_FIELDS[:3], "rated_torque_nm=4.775", f"source_id={SOURCE}")
    assert status == 0
    assert "Warning: motors m: rated_power_w is 150 W, but 1500 W follows" in err
    assert catalogue.count("motors") == SHIPPED_MOTORS + 1


def test_add_without_fields_asks_for_each_and_again_after_a_bad_answer(
    run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong_first = {
        "id": ["two words", "filipovic-kevac-2018-winch", "w"],
        "winch_type": ["Drum", "drum"],
        "drum_radius_mm": ["8,0", "-1", "80"],
        "source_id": ["", "nowhere", SOURCE],
    }
    fields = KINDS["winches"].fields
    asked = answer(monkeypatch, [text for field in fields for text in wrong_first.get(field.name, [""])])
    status, out, err = run("add", "winch")
    assert (status, out) == (0, "")
    for words in (
        "exists already; choose another id",
        "write drum",
        "write 8.0 with a point",
        "source_id has to be filled in",
        "there is no 'nowhere' in sources",
    ):
        assert words in err
    assert "drum_radius_mm – Radius to the centre of the cable (a number more than 0 [mm]; may be empty)" in asked
    row = catalogue.part("w")[1]
    assert (row["winch_type"], row["drum_radius_mm"], row["source_id"]) == ("drum", 80.0, SOURCE)


def test_add_asks_again_for_what_the_whole_row_shows_to_be_wrong(
    run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = {"id": "g", "ratio": "5", "max_continuous_torque_nm": "9", "max_intermittent_torque_nm": "3"}
    answers = [({"source_id": "new"} | given).get(field.name, "") for field in KINDS["gearboxes"].fields]
    source = {"document": "Acme", "url": "https://acme.example", "date": "2024"}
    answers += [source.get(field.name, "") for field in KINDS["sources"].fields]
    answer(monkeypatch, [*answers, "12"])
    status, _, err = run("add", "gearbox")
    assert status == 0
    assert "max_intermittent_torque_nm: '3.0', expected at least max_continuous_torque_nm = 9 [N m]" in err
    row = catalogue.part("g")[1]
    assert (row["max_intermittent_torque_nm"], row["source_id"]) == (12.0, "acme-2024")


def test_answers_that_end_early_add_nothing(run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    answer(monkeypatch, ["m", "Acme"])
    status, _, err = run("add", "motor")
    assert status == 2
    assert "the answers end before the row is complete" in err
    assert catalogue.count("motors") == SHIPPED_MOTORS


def test_ctrl_c_at_a_question_adds_nothing(run: Run, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: object, **__: object) -> str:
        raise KeyboardInterrupt

    monkeypatch.setattr(click, "prompt", stop)
    status, _, err = run("add", "motor")
    assert status == 130
    assert "Interrupted." in err
    assert catalogue.count("motors") == SHIPPED_MOTORS


def test_import_tells_what_it_did_and_warns(run: Run, tmp_path: Path) -> None:
    (tmp_path / "motors.csv").write_text(
        f"id,rated_power_w,rated_speed_rpm,rated_torque_nm,source_id\na,100,3000,0.3,{SOURCE}\nb,1,3000,9,{SOURCE}\n"
    )
    status, out, err = run("import", "motors.csv", "--dry-run")
    assert (status, out) == (0, "")
    assert "would be 2 added, 0 changed, 0 already there. Nothing was written." in err
    status, out, err = run("import", "motors.csv")
    assert (status, out) == (0, "")
    assert "Warning: motors b: rated_power_w is 1 W" in err
    assert "2 added, 0 changed, 0 already there" in err
    assert "2 already there" in run("import", "motors.csv")[2]


def test_a_bad_file_is_refused_whole(run: Run, tmp_path: Path, catalogue: Catalogue) -> None:
    (tmp_path / "motors.csv").write_text(f'id,rated_power_w,source_id\na,1,{SOURCE}\nb,"0,94",{SOURCE}\nc,1,nowhere\n')
    status, _, err = run("import", "motors.csv")
    assert status == 2
    assert "motors.csv, line 3, rated_power_w: '0,94', expected a number more than 0 [W]" in err
    assert "motors.csv, line 4, source_id: 'nowhere'" in err
    assert catalogue.count("motors") == SHIPPED_MOTORS


def test_ctrl_c_during_an_import_leaves_nothing(
    run: Run, tmp_path: Path, catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("actuator_select.database.queries.insert_changes", stop)
    (tmp_path / "motors.csv").write_text(f"id,source_id\na,{SOURCE}\n")
    status, _, err = run("import", "motors.csv")
    assert (status, err.strip()) == (130, "Interrupted.")
    assert catalogue.count("motors") == SHIPPED_MOTORS


def test_export_goes_to_stdout_a_file_or_a_folder(run: Run, tmp_path: Path, catalogue: Catalogue) -> None:
    text = catalogue.export_csv("motors")
    assert run("export", "motors") == (0, text, "")
    run("export", "motor", "--output", "mine.csv")
    assert (tmp_path / "mine.csv").read_text(encoding="utf-8") == text
    status, out, err = run("export", "--output", "all")
    assert (status, out) == (0, "")
    assert sorted(path.name for path in (tmp_path / "all").iterdir()) == sorted(f"{kind}.csv" for kind in KINDS)
    assert "motors.csv" in err
    run("export", "winches", "--output", "all")
    assert (tmp_path / "all" / "winches.csv").read_text(encoding="utf-8") == catalogue.export_csv("winches")


def test_opening_a_new_database_is_told_on_stderr(run: Run, tmp_path: Path) -> None:
    status, out, err = run("list", "actuators", "--format", "json", "--database", str(tmp_path / "new.db"))
    assert status == 0
    assert len(json.loads(out)["rows"]) == len(read_shipped()["actuators"])
    assert err == f"Made the catalogue {tmp_path / 'new.db'}.\n"


def test_help_and_docstrings_name_every_kind(run: Run) -> None:
    helps = {name: run(*name.split(), "--help")[1] for name in ("list", "add")}
    texts = [ReadableCatalogue.rows.__doc__ or "", helps["list"]]
    assert [kind for kind in KINDS for text in texts if kind not in text] == []
    assert [kind.singular for kind in KINDS.values() if kind.singular not in helps["add"]] == []
    assert [kind for kind in KINDS if kind not in " ".join(run("--help")[1].split())] == []
