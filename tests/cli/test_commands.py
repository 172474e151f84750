"""The command line: contract, bad input, and the README's commands."""

import csv
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import click
import pytest

from actuator_select.cli import COMMANDS
from actuator_select.cli import command as root
from tests.selection.parts import PRINTED

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
Run = Callable[..., tuple[int, str, str]]


def readme_commands() -> list[str]:
    blocks = re.findall(r"```console\n(.*?)```", README, flags=re.DOTALL)
    quick = [line for block in blocks for line in block.splitlines() if line.startswith("actuator-select ")]
    tabled = re.findall(r"`(actuator-select (?:rank|report|workspace) [^`]*)`", README.split("## Study files")[0])
    return [command for command in quick + tabled if "reports/" not in command]


def readme_files() -> dict[str, str]:
    """Files that the README shows: blocks after a sentence that ends in ``file `NAME`:`` or begins with it."""
    shown = r"a file `([\w.]+)`[^`]*:\n\n```\w+\n(.*?)```"
    return dict(re.findall(shown, README, flags=re.DOTALL))


def test_every_command_in_the_readme_runs_in_order(run: Run, tmp_path: Path) -> None:
    commands = readme_commands()
    assert len(commands) > 12
    files = readme_files()
    assert sorted(files) == ["acme.csv", "acme.toml"]
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    for command in commands:
        status, _, err = run(*shlex.split(command)[1:])
        assert status == 0, f"{command}\n{err}"


def test_the_counts_in_the_readme_are_what_its_commands_print(run: Run) -> None:
    rows = re.findall(r"\| ([\d, *]+) \| `actuator-select ([^`]+)` \|", README)
    assert len(rows) == 14
    for text, command in rows:
        expected = [int(number) for number in text.replace("*", "").split(",")]
        _, out, _ = run(*shlex.split(command), "--format", "json")
        if command.startswith("workspace"):
            assert [json.loads(out)["feasible_poses"]] == expected, command
            continue
        found = {one["name"]: one["feasible_poses"] for one in json.loads(out)["actuators"]}
        assert [found[f"Actuator {number}"] for number in range(1, len(expected) + 1)] == expected, command


def test_the_shares_in_the_readme_are_what_its_commands_print(run: Run) -> None:
    shares = []
    for grid in ("[6,6,6]", "[50,50,40]"):
        _, out, _ = run("rank", "cpr8", "--set", f"workspace.points={grid}", "--format", "json")
        shares.append(f"{json.loads(out)['actuators'][0]['feasible_percent']:.1f} %")
    text = " ".join(README.split())
    assert f"a share of {shares[0]}, 100,000 positions give {shares[1]}" in text


def test_the_python_of_the_readme_runs(tmp_path: Path) -> None:
    block = re.search(r"```python\n(.*?)```", README, flags=re.DOTALL)
    assert block is not None
    (tmp_path / "notebook.py").write_text(block[1] + "print(force.shape)", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "notebook.py"],
        cwd=tmp_path,
        env=os.environ | {"ACTUATOR_SELECT_DATABASE": str(tmp_path / "c.db")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert "filipovic-kevac-2018-1" in done.stdout
    assert done.stdout.endswith("(216, 8)\n")


def test_the_readme_has_two_set_up_lines_on_its_first_screen() -> None:
    lines = README.splitlines()
    assert [index for index, line in enumerate(lines) if line.startswith("python3 -m venv")][-1] < 25
    assert sum(line.startswith("python3 -m venv") for line in lines) == 2


def all_commands() -> dict[str, click.Command]:
    context = click.Context(root)
    found = {}
    for name in COMMANDS:
        one = root.get_command(context, name)
        assert one is not None
        if isinstance(one, click.Group):
            found |= {f"{name} {sub}": inner for sub, inner in one.commands.items()}
        else:
            found[name] = one
    return found


def test_the_readme_lists_every_command_and_no_other() -> None:
    table = README.split("## Commands")[1].split("## ")[0]
    listed = {" ".join(re.findall(r"[a-z]+", row)) for row in re.findall(r"`actuator-select ([a-z ]+)", table)}
    assert listed == set(all_commands())


@pytest.mark.parametrize("name", sorted(all_commands()))
def test_every_command_and_option_has_help(name: str) -> None:
    command = all_commands()[name]
    assert command.help
    for parameter in command.params:
        if isinstance(parameter, click.Option):
            assert parameter.help, f"{name} {parameter.opts}"


def test_rank_prints_what_the_share_is_of_then_the_table(run: Run) -> None:
    status, out, err = run("rank", "cpr8")
    assert status == 0
    for text in ("box", "6 × 6 × 6 positions", "orientations", "pseudo_inverse", "independent", "200/216 (92.6 %)"):
        assert text in out
    assert out.index("pseudo_inverse") < out.index("Actuator 1")
    assert "172 of 216" in err
    assert "172 of 216" not in out


def test_rank_says_in_one_line_which_limits_are_not_checked(run: Run) -> None:
    _, out, _ = run("rank", "cpr8", "--where", "id = 'filipovic-kevac-2018-1'")
    (line,) = [line for line in out.splitlines() if line.startswith("Not checked")]
    assert line == (
        "Not checked, even where the catalogue states it: the motor's peak torque, greatest speed and heating; the "
        "gearbox's continuous and intermittent torque and input speed; the winch's "
        "tension and speed; the rope's breaking force."
    )


def test_json_stands_alone_on_stdout(run: Run) -> None:
    status, out, _ = run("rank", "cpr8", "--format", "json", "--only-meeting")
    record = json.loads(out, parse_constant=pytest.fail)
    assert status == 0
    assert [one["name"] for one in record["actuators"]] == ["Actuator 1"]
    assert record["actuators"][0]["feasible_percent"] == 92.59


def test_that_no_actuator_meets_the_requirement_is_a_result(run: Run) -> None:
    status, out, _ = run("rank", "cpr8", "--where", PRINTED, "--require", "100")
    assert status == 0
    assert "0 of 5 actuators meet" in out
    status, out, _ = run("rank", "cpr8", "--require", "100", "--only-meeting", "--format", "json")
    assert status == 0
    assert json.loads(out)["actuators"] == []


def test_csv_has_a_row_per_actuator(run: Run) -> None:
    status, out, _ = run("rank", "cpr8-published", "--format", "csv")
    assert status == 0
    lines = out.splitlines()
    assert lines[0].startswith("id,name,verdict,feasible_percent,feasible_poses,poses,speed_state")
    assert len(lines) == 6


def test_simulate_names_who_exceeds_what_when_and_draws_it(run: Run, tmp_path: Path) -> None:
    line = ["--from", "0.153,0.153,-0.153", "--to", "3.047,0.153,-0.153", "--orientation-rad", "0.5,0.5,0.5"]
    status, out, err = run("simulate", "cpr8", "Actuator 1", *line, "--plot", "run.svg")
    assert status == 0
    for actuator in (1, 3, 8):
        assert re.search(rf"actuator {actuator}: torque over its limit from 0\.\d+ s to 2\.\d+ s", out)
    assert "push" in err
    assert (tmp_path / "run.svg").read_text(encoding="utf-8").startswith("<?xml")
    status, out, _ = run("simulate", "cpr8", "Actuator 1", *line, "--format", "json")
    record = json.loads(out, parse_constant=pytest.fail)
    assert {one["actuator"] for one in record["exceedances"]} == {1, 3, 8}


def test_a_shown_study_is_a_study_file(run: Run, tmp_path: Path) -> None:
    _, out, _ = run("study", "show", "cpr8", "--set", "payload.mass_kg=3.0")
    (tmp_path / "own.toml").write_text(out, encoding="utf-8")
    assert run("rank", "own.toml")[0] == 0
    assert run("study", "list", "--format", "json")[0] == 0


def test_a_new_study_does_not_replace_a_file_unless_told_to(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("precious", encoding="utf-8")
    status, _, err = run("study", "new", "mine.toml")
    assert status == 2
    assert "--force" in err
    assert file.read_text(encoding="utf-8") == "precious"
    assert run("study", "new", "mine.toml", "--force")[0] == 0
    assert run("rank", "mine.toml")[0] == 0


BAD_INPUT = [
    (["rank", "cpr9"], "did you mean 'cpr8'"),
    (["rank"], "Missing argument 'STUDY'"),
    (
        ["rank", "cpr8", "--set", "motion.acceleration_time_s=0"],
        "motion.acceleration_time_s: 0, expected at least 1e-06 [s]",
    ),
    (["rank", "cpr8", "--set", "motion.speed_max_m_per_s=nan"], "expected a finite number [m/s]"),
    (["rank", "cpr8", "--set", "motion.speed_max_m_per_s=inf"], "expected a finite number [m/s]"),
    (["rank", "cpr8", "--set", "motion.sped=1"], "is not a key of a study"),
    (["rank", "cpr8", "--set", "workspace.points=[0,6,6]"], "expected at least 1"),
    (["rank", "cpr8", "--set", "robot.carrier_m=[3,3,3]"], "fits into the frame"),
    (["rank", "cpr8", "--set", "nonsense"], "KEY=VALUE"),
    (["rank", "cpr8", "--where", "rated_power_w > 1000"], "no actuator in the catalogue meets"),
    (["rank", "cpr8", "--where", "rated_powr_w > 10"], "rated_power_w"),
    (["rank", "cpr8", "--where", "rated_power_w >"], "^"),
    (["rank", "cpr8", "--require", "120"], "120"),
    (["rank", "cpr8", "--require", "nan"], "expected a number from 0 to 100"),
    (["rank", "cpr8", "--database", "missing/c.db"], "there is no folder"),
    (["report", "cpr8", "--output", "missing/cpr8.html"], "cannot write"),
    (["simulate", "cpr8", "Actuator 9", "--from", "0,0,-1", "--to", "1,1,-1"], "did you mean"),
    (["simulate", "cpr8", "Actuator 1", "--from", "0,0", "--to", "1,1,-1"], "three numbers"),
    (["simulate", "cpr8", "Actuator 1", "--from", "1,1,-1", "--to", "1,1,-1"], "another position"),
    (["simulate", "cpr8", "Actuator 1", "--from", "1,1,-1", "--to", "1,1,nan"], "finite"),
    (["simulate", "cpr8", "Actuator 1", "--from", "1,1,-1", "--to", "1,2,-1", "--plot", "run.doc"], ".doc"),
    (["study", "show", "missing.toml"], "missing.toml"),
    (["study", "new", "missing/robot.toml"], "cannot write"),
    (["study", "new", "a.toml", "--template", "suspendet-8"], "did you mean 'suspended-8'"),
    (["study", "new", "a.toml", "--template", "suspended-8", "--hall", "15,11"], "three numbers"),
    (["study", "new", "a.toml", "--template", "suspended-8", "--platform", "1,1,9"], "smaller than the hall"),
    (["study", "new", "a.toml", "--template", "six-six", "--hall", "3,3,3"], "no --hall with the template six-six"),
    (["study", "new", "a.toml", "--mass", "0"], "--mass: 0, expected a number from 0.001"),
    (["study", "new", "a.toml", "--mass", "-2"], "--mass: -2, expected"),
    (["study", "new", "a.toml", "--speed", "nan"], "--speed: nan, expected"),
    (["study", "new", "a.toml", "--template", "anchors"], "--anchors: is missing"),
    (["study", "new", "a.toml", "--template", "anchors", "--anchors", "none.csv"], "cannot be read"),
    (["robot", "show", "cpr9"], "did you mean 'cpr8'"),
    (["robot", "show", "cpr8", "--plot", "cpr8.doc"], ".doc"),
    (["nonsense"], "No such command"),
]


@pytest.mark.parametrize(
    ("arguments", "message"), BAD_INPUT, ids=lambda value: " ".join(value) if isinstance(value, list) else ""
)
def test_bad_input_gets_one_clear_message_and_status_2(
    run: Run, arguments: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACTUATOR_SELECT_TRACEBACK", "1")
    status, out, err = run(*arguments)
    assert status == 2
    assert message in err
    assert "Traceback" not in err
    assert out == ""


def test_an_unwritable_report_leaves_the_old_one(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "cpr8.html"
    folder.mkdir()
    status, _, err = run("report", "cpr8", "--output", "cpr8.html")
    assert status == 2
    assert "it is a folder" in err
    assert list(tmp_path.glob(".cpr8*")) == []


def test_ctrl_c_is_status_130(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("actuator_select.selection.rank", interrupt)
    status, out, err = run("rank", "cpr8")
    assert status == 130
    assert out == ""
    assert "Interrupted" in err


@pytest.mark.parametrize(
    ("how", "status", "word"), [(signal.SIGTERM, 143, "Terminated."), (signal.SIGINT, 130, "Interrupted.")]
)
def test_an_import_that_is_stopped_by_a_signal_leaves_nothing(
    run: Run, tmp_path: Path, how: signal.Signals, status: int, word: str
) -> None:
    assert run("catalog", "list", "sources")[0] == 0
    rows = [f"m{number},150,3000,0.48,filipovic-kevac-2018\n" for number in range(200_000)]
    path = tmp_path / "motors.csv"
    path.write_text("id,rated_power_w,rated_speed_rpm,rated_torque_nm,source_id\n" + "".join(rows))
    command = [sys.executable, "-m", "actuator_select", "catalog", "import", str(path)]
    journal = tmp_path / "catalogue.db-journal"
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 60.0
        while not journal.exists():
            assert process.poll() is None
            assert time.monotonic() < deadline
            time.sleep(0.01)
        process.send_signal(how)
        _, err = process.communicate(timeout=60)
    assert (process.returncode, err.strip()) == (status, word)
    assert not journal.exists()
    assert run("catalog", "list", "motors", "--where", "id = 'm0'")[2] == "0 motors\n"


def test_a_fault_of_the_program_is_status_1_and_says_so(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RuntimeError("broken")

    monkeypatch.delenv("ACTUATOR_SELECT_TRACEBACK", raising=False)
    monkeypatch.setattr("actuator_select.selection.rank", fail)
    status, _, err = run("rank", "cpr8")
    assert status == 1
    assert "a fault of actuator-select" in err


def program(tmp_path: Path, arguments: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    """Run the program in a shell, as users do."""
    return subprocess.run(
        ["bash", "-c", f"{sys.executable} -m actuator_select {arguments}"],
        cwd=tmp_path,
        env=os.environ | {"ACTUATOR_SELECT_DATABASE": str(tmp_path / "c.db")} | environment,
        capture_output=True,
        check=False,
    )


def test_a_reader_that_leaves_early_is_no_fault(tmp_path: Path) -> None:
    done = program(tmp_path, "rank cpr8 --format json | true; exit ${PIPESTATUS[0]}")
    assert done.returncode == 0
    assert b"Traceback" not in done.stderr
    assert b"fault" not in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_full_disk_is_told_and_is_no_fault_of_the_program(tmp_path: Path) -> None:
    done = program(tmp_path, "rank cpr8 > /dev/full")
    assert done.returncode == 2
    assert b"cannot write the result: No space left on device" in done.stderr


def test_any_locale_prints_utf_8(tmp_path: Path) -> None:
    done = program(tmp_path, "rank cpr8", PYTHONIOENCODING="ascii", LC_ALL="C", PYTHONUTF8="0")
    assert done.returncode == 0
    assert "(ψ, θ, φ)" in done.stdout.decode("utf-8")


def test_a_closed_stream_is_survived(tmp_path: Path) -> None:
    assert program(tmp_path, "rank cpr8 2>&-").returncode == 0
    assert program(tmp_path, "rank cpr8 >&-").returncode == 0


PARTS = (
    ("motors", "id=servo", "motor_type=pmsm_servo", "electrical_convention=ac_rms_phase", "rated_speed_rpm=5000",
     "rated_torque_nm=0.637", "rotor_inertia_g_cm2=106", "source_id=filipovic-kevac-2018"),
    ("gearboxes", "id=gear", "ratio=30", "max_efficiency_percent=75", "source_id=filipovic-kevac-2018"),
    ("actuators", "id=servo", "name=Servo", "motor_id=servo", "gearbox_id=gear", "winch_id=filipovic-kevac-2018-winch",
     "source_id=filipovic-kevac-2018"),
)  # fmt: skip
SHARE = ("--set", "assumptions.gearbox_efficiency_of_maximum=0.9")


def test_what_was_assumed_and_what_does_not_apply_is_told_in_every_format(run: Run) -> None:
    for kind, *cells in PARTS:
        assert run("catalog", "add", kind, *cells)[0] == 0
    asked = ("rank", "cpr8", "--where", "id = 'servo'", *SHARE)
    _, out, _ = run(*asked)
    assert "Servo *" in out
    assert "not applicable" in out
    assert "Servo: voltage not applicable, because its electrical figures are rms phase values" in out
    key = "(assumptions.gearbox_efficiency_of_maximum)"
    assumed = f"gearbox efficiency 0.9 × the greatest that is stated, 67.5 % {key}"
    assert f"* Assumed: {assumed}, for Servo." in out
    _, out, _ = run(*asked, "--format", "csv")
    header, row = list(csv.reader(out.splitlines()))
    assert dict(zip(header, row, strict=True))["assumptions"] == assumed
    assert dict(zip(header, row, strict=True))["voltage_state"] == "not_applicable"
    _, out, _ = run(*asked, "--format", "json")
    assert json.loads(out)["actuators"][0]["assumptions"][0]["value"] == 67.5
    _, out, _ = run("simulate", "cpr8", "Servo", "--from", "0.5,0.5,-0.5", "--to", "2.5,0.5,-0.5", *SHARE)
    assert "|voltage|" not in out
    assert "voltage not applicable" in out
    assert f"assumed: {assumed}" in out
