"""``catalog list``, ``show``, ``fields`` and ``export`` for people: what fits, what is said, what files are written."""

import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select.cli import main
from actuator_select.cli.catalog.cells import fitting, folded, shortened
from actuator_select.database import open_catalogue
from actuator_select.database.conventions import CONVENTIONS
from actuator_select.database.groups import GROUPS, MEANINGS, MISSED, NOT_MISSED
from actuator_select.database.kinds import KINDS

SOURCE = "filipovic-kevac-2018"
TABLE_1 = f"source_id = '{SOURCE}'"
SERVO = [
    "id=acme-servo-with-a-long-id-2026",
    "manufacturer=Acme",
    "electrical_convention=ac_rms_phase",
    "rated_power_w=750",
    "rated_speed_rpm=3000",
    "rated_torque_nm=2.39",
    "standstill_torque_nm=2.6",
    "peak_torque_nm=7.1",
    "max_speed_rpm=unlimited",
    "check_status=flag",
    "source_location=https://acme.example/a-very-long-address/that-has-to-be/printed-in-one-piece/servo.html",
    f"source_id={SOURCE}",
]
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("template") / "catalogue.db"
    open_catalogue(path).close()
    return path


@pytest.fixture
def run(template: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run ``actuator-select catalog``, in a terminal of `width` characters or in a pipe."""
    monkeypatch.setenv("ACTUATOR_SELECT_DATABASE", str(shutil.copy(template, tmp_path / "catalogue.db")))
    monkeypatch.chdir(tmp_path)

    def call(*arguments: str, width: int | None = None) -> tuple[int, str, str]:
        capsys.readouterr()
        with monkeypatch.context() as patch:
            if width is not None:
                patch.setattr(sys.stdout, "isatty", lambda: True)
                patch.setenv("COLUMNS", str(width))
                patch.setenv("TERM", "dumb")
            status = main(["catalog", *arguments])
        printed = capsys.readouterr()
        return status, printed.out, printed.err

    return call


@pytest.mark.parametrize("width", [80, 120, 200])
def test_a_list_fits_into_the_terminal_and_never_cuts_an_id(run: Run, width: int) -> None:
    assert run("add", "motor", *SERVO)[0] == 0
    _, out, _ = run("list", "motors", width=width)
    table = out.split("\n! ")[0]
    assert max(len(line) for line in table.splitlines()) <= width
    (row,) = [line for line in table.splitlines() if "acme-servo-with-a-long-id-2026" in line]
    assert row.split()[:5] == ["acme-servo-with-a-long-id-2026", "750", "–", "3000", "2.39"]


def test_120_columns_show_power_speed_torques_voltage_inertia_and_mass(run: Run) -> None:
    run("add", "motor", *SERVO)
    _, out, _ = run("list", "motors", width=120)
    head = " ".join(out.split("──")[0].split())
    for word in ("power", "voltage", "speed", "standstill", "peak", "inertia", "mass", "[W]", "[rpm]", "[N m]"):
        assert word in head


def test_what_a_narrow_terminal_leaves_out_is_named(run: Run) -> None:
    _, out, _ = run("list", "motors", width=80)
    assert "Not shown for want of room" in out
    assert "part_number" in out
    assert "part number" in run("list", "motors")[1].splitlines()[1]


def test_a_pipe_gets_every_text_whole_on_one_line(run: Run) -> None:
    long = "word " * 70 + "end"
    run("add", "rope", "id=r", f"construction={long}", f"source_id={SOURCE}")
    assert any(long in line for line in run("list", "ropes")[1].splitlines())
    assert "…" in run("list", "ropes", width=120)[1]


def marked(out: str) -> set[str]:
    """First words of the lines of a list that end in the mark."""
    return {line.split()[0] for line in out.splitlines() if line.rstrip().endswith("!")}


def test_doubtful_rows_are_marked_and_the_mark_is_explained(run: Run) -> None:
    run("add", "motor", *SERVO)
    _, out, _ = run("list", "motors", "--where", TABLE_1)
    assert marked(out) == {*(f"filipovic-kevac-2018-motor-{number}" for number in (2, 3, 4, 5)), SERVO[0][3:]}
    assert "`actuator-select catalog show ID` says why" in out
    _, out, _ = run("list", "actuators", "--where", "source_location = 'Table 1'")
    assert [line.split()[0][-1] for line in out.splitlines() if line.rstrip().endswith("!")] == ["2", "3", "4", "5"]
    assert "!" not in run("list", "winches")[1]


def test_a_rope_out_of_its_group_is_told_of_by_every_command(run: Run) -> None:
    warning = "Warning: ropes odd (An odd rope): breaking_force_n is 900000 N"
    construction = "steel 7x19, grade 2070, galvanised"
    fields = [f"construction={construction}", "diameter_mm=8", "name=An odd rope", f"source_id={SOURCE}"]
    assert warning in run("add", "rope", "id=odd", *fields, "breaking_force_n=900000")[2]
    for arguments in (
        ("show", "odd"),
        ("edit", "odd", "diameter_mm=8.1"),
        ("edit", "odd", "mass_kg_per_m=1", "--dry-run"),
    ):
        assert warning in run(*arguments)[2]
    assert "Warning: ropes odder" in run("copy", "odd", "--as", "odder")[2]
    for condition in ("id = 'odd'", f"construction = '{construction}'"):
        assert "odd" in marked(run("list", "ropes", "--where", condition)[1])


def test_add_names_the_row_that_it_warns_of_as_other_commands_do(run: Run) -> None:
    fields = ["id=x", "part_number=No. 7", "rated_power_w=1", "rated_speed_rpm=3000", "rated_torque_nm=9"]
    assert "Warning: motors x (No. 7): rated_power_w is 1 W" in run("add", "motor", *fields, f"source_id={SOURCE}")[2]


def test_a_cut_list_says_how_to_see_more(run: Run) -> None:
    assert "2 of 5 motors; a greater --limit" in run("list", "motors", "--where", TABLE_1, "--limit", "2")[2]


def test_headers_fold_to_the_width_of_their_column_and_units_stay_whole() -> None:
    assert folded("rotor inertia [g cm²]", 4) == "rotor\ninertia\n[g cm²]"
    assert folded("rotor inertia [g cm²]", 13) == "rotor inertia\n[g cm²]"
    assert folded("id", 30) == "id"
    assert shortened("a\nb") == "a b"
    assert fitting(["id", "mass [kg]"], [["x", "1"]], 17) == (2, False)
    assert fitting(["id", "mass [kg]"], [["x", "1"]], 12) == (2, True)
    assert fitting(["id", "mass [kg]"], [["x" * 30, "1"]], 12) == (1, True)


def test_show_groups_figures_and_says_what_they_mean(run: Run) -> None:
    run("add", "motor", *SERVO)
    _, out, err = run("show", SERVO[0][3:])
    titles = [line.strip() for line in out.splitlines() if line.startswith("  ") and not line.startswith("   ")]
    assert titles[:4] == ["what it is", "rated figures", "limits", "constants"]
    for words in (
        "2.39 N m (continuous, at rated speed)",
        "2.6 N m (continuous, near zero speed)",
        "unlimited (the maker's limit)",
        "ac_rms_phase: rms phase values (AC servo)",
        "flag: usable, but check_notes says what is off",
        "https://acme.example/a-very-long-address/that-has-to-be/printed-in-one-piece/servo.html",
        "no actuator",
    ):
        assert words in out
    assert err == ""


def test_show_lists_expected_figures_as_unknown_and_counts_the_others(run: Run) -> None:
    run("add", "motor", *SERVO)
    _, out, _ = run("show", SERVO[0][3:])
    lines = {line[4:38].strip(): line[38:].strip() for line in out.splitlines()}
    assert lines["mass"] == "–"
    assert "terminal resistance" not in lines, "an AC servo needs no resistance"
    assert "pole pairs" not in lines
    assert "more columns unknown (--all lists them)" in out
    _, out, _ = run("show", SERVO[0][3:], "--all")
    assert "pole pairs" in out
    assert "more columns unknown" not in out


def test_a_link_is_printed_whole_in_a_narrow_terminal(run: Run) -> None:
    run("add", "motor", *SERVO)
    _, out, _ = run("show", SERVO[0][3:], width=60)
    assert "https://acme.example/a-very-long-address/that-has-to-be/printed-in-one-piece/servo.html" in out
    _, out, _ = run("show", "filipovic-kevac-2018-motor-1", width=60)
    assert "https://doi.org/10.22190/FUACR1802071F" in out, "the source's address where the row has none"


def test_show_says_what_uses_a_part_and_a_source(run: Run) -> None:
    _, out, _ = run("show", "filipovic-kevac-2018-gearbox-26")
    assert "actuator filipovic-kevac-2018-3 (Actuator 3)" in out
    assert "actuator filipovic-kevac-2018-5 (Actuator 5)" in out
    assert "filipovic-kevac-2018-4" not in out
    _, out, _ = run("show", SOURCE)
    for words in ("5 motors", "3 gearboxes", "1 winch", "7 actuators"):
        assert words in out


def test_show_says_what_fits_a_motor_and_a_gearbox(run: Run) -> None:
    run("add", "gearbox", "id=gp-1", "ratio=5", f"source_id={SOURCE}")
    run("add", "motor", *SERVO)
    for number, pattern in enumerate(("acme-*", "*-2026", "other-*", "acme", SERVO[0][3:], "*a*", "*", "a*6", "ACME*")):
        fields = [f"id=c{number}", f"motor_pattern={pattern}", "gearbox_pattern=gp-*", f"source_id={SOURCE}"]
        assert run("add", "compatibility", *fields)[0] == 0
    lines = [line.split()[1:] for line in run("show", SERVO[0][3:])[1].splitlines() if line.startswith("fits ")]
    assert lines[:5] == [["gearboxes", "gp-*", "(compatibility", f"c{number})"] for number in (0, 1, 4, 5, 6)]
    assert lines[5][:3] == ["and", "1", "more;"]
    lines = [line.split()[1:] for line in run("show", "gp-1")[1].splitlines() if line.startswith("fits ")]
    assert lines[0] == ["motors", "acme-*", "(compatibility", "c0)"]
    assert lines[5][:3] == ["and", "4", "more;"]
    assert "\nfits " not in run("show", "filipovic-kevac-2018-winch")[1]


@pytest.mark.parametrize("kind", list(KINDS))
def test_every_column_stands_in_one_group(kind: str) -> None:
    grouped = [name for names in GROUPS[kind].values() for name in names]
    assert sorted(grouped) == sorted(field.name for field in KINDS[kind].columns)
    assert MISSED.get(kind, frozenset()) <= set(grouped)


def test_explanations_are_of_columns_and_choices_that_exist() -> None:
    fields = {field.name: field for kind in KINDS.values() for field in kind.fields}
    for column, words in CONVENTIONS.items():
        assert set(words) == set(fields[column].choices)
    assert set(MEANINGS) <= set(fields)
    assert set(NOT_MISSED) == set(fields["electrical_convention"].choices)


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf"])
def test_show_draws_motors_gearboxes_and_actuators(run: Run, tmp_path: Path, suffix: str) -> None:
    for row_id in ("filipovic-kevac-2018-motor-1", "filipovic-kevac-2018-gearbox-30", "Actuator 1"):
        file = tmp_path / f"part.{suffix}"
        status, out, err = run("show", row_id, "--plot", str(file))
        assert status == 0
        assert row_id in out
        assert f"Wrote {file}" in err
        assert file.stat().st_size > 1000
        file.unlink()


@pytest.mark.parametrize("row_id", ["filipovic-kevac-2018-winch", SOURCE])
def test_what_cannot_be_drawn_is_said(run: Run, tmp_path: Path, row_id: str) -> None:
    status, out, err = run("show", row_id, "--plot", "p.svg")
    assert (status, out) == (2, "")
    assert "motors, gearboxes and actuators can be drawn" in err
    assert not (tmp_path / "p.svg").exists()


def test_fields_tells_opc_names_and_conventions(run: Run) -> None:
    _, out, _ = run("fields", "motors")
    assert "MotorTorqueContinuousStall" in out
    assert "rms phase values (AC servo)" in out
    assert "OPC" not in run("fields", "ropes")[1]
    fields = {field["name"]: field for field in json.loads(run("fields", "motors", "--format", "json")[1])["fields"]}
    assert fields["rated_speed_rpm"]["opc_name"] == "MotorSpeedRated"
    assert fields["mass_kg"]["opc_name"] is None
    assert "dc_terminal" in fields["electrical_convention"]["conventions"]


def test_the_ending_of_the_file_or_the_option_says_the_format(run: Run, tmp_path: Path) -> None:
    for name, start in (("a.xlsx", b"PK"), ("a.json", b'{\n  "format"')):
        status, out, err = run("export", "--output", name)
        assert (status, out, err) == (0, "", f"Wrote {name}\n")
        assert (tmp_path / name).read_bytes().startswith(start)
    assert run("export", "--format", "json", "--output", "a.txt")[0] == 0
    assert json.loads((tmp_path / "a.txt").read_text(encoding="utf-8"))["format_version"] == 1
    (tmp_path / "folder").mkdir()
    run("export", "--format", "xlsx", "--output", "folder")
    run("export", "motors", "--format", "json", "--output", "folder")
    assert sorted(file.name for file in (tmp_path / "folder").iterdir()) == ["catalogue.xlsx", "motors.json"]


def test_json_goes_to_stdout_too_and_conditions_narrow_it(run: Run) -> None:
    status, out, _ = run("export", "motors", "--format", "json", "--where", f"{TABLE_1} and rated_power_w > 50")
    assert status == 0
    assert [row["id"][-1] for row in json.loads(out, parse_constant=pytest.fail)["motors"]] == ["1", "2"]
    _, out, _ = run("export", "motors", "--where", f"{TABLE_1} and rated_power_w > 50")
    assert len(out.splitlines()) == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--where", "mass_kg > 3", "--output", "a.json"], "name a KIND"),
        (["motors", "--format", "xlsx"], "--output FILE.xlsx"),
        (["--output", "all.csv"], "can hold one kind"),
        (["motors", "--format", "doc"], "doc"),
        (["motors", "--where", "weight > 3"], "weight"),
    ],
)
def test_what_cannot_be_exported_is_explained(run: Run, tmp_path: Path, arguments: list[str], words: str) -> None:
    before = sorted(tmp_path.iterdir())
    status, out, err = run("export", *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert sorted(tmp_path.iterdir()) == before
