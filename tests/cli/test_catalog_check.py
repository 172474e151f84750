"""``actuator-select catalog check``: what it prints of findings and of what explains them."""

import json
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select._resources import shipped_dir

Run = Callable[..., tuple[int, str, str]]
MARKDOWN = ("catalog", "check", "--format", "markdown", "--database", ":memory:")


def test_the_shipped_document_is_what_the_command_in_its_head_writes(run: Run) -> None:
    document = (shipped_dir("catalog") / "FINDINGS.md").read_text(encoding="utf-8")
    status, out, _ = run(*MARKDOWN)
    assert status == 0
    assert out == document
    assert f"`actuator-select {' '.join(MARKDOWN)} > catalog/FINDINGS.md`" in document


@pytest.mark.parametrize("arguments", [("motors",), ("--database", "my parts.db"), ("actuators", "--database", "m.db")])
def test_a_document_about_something_else_names_the_command_that_wrote_it(
    run: Run, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...]
) -> None:
    monkeypatch.delenv("ACTUATOR_SELECT_DATABASE")
    monkeypatch.setattr("actuator_select.database.connection.user_data_dir", Path.cwd)
    _, out, _ = run("catalog", "check", *arguments, "--format", "markdown")
    command = out.partition("Made by `")[2].partition("`")[0]
    first, *words = shlex.split(command)
    assert (first, ">" in words) == ("actuator-select", False)
    assert set(words) == {"catalog", "check", "--format", "markdown", *arguments}
    assert run(*words)[1] == out


def test_a_finding_refers_to_its_explanation_and_the_end_counts_them(run: Run) -> None:
    status, out, err = run("catalog", "check")
    assert status == 0
    (line,) = [line for line in out.splitlines() if line.startswith(" maxon-236662")]
    note = line.split()[-1]
    assert f"\n{note} rated_power, expected: rated torque × rated speed.\n    20 W is the power by which" in out
    total = len(json.loads(run("catalog", "check", "--format", "json")[1])["findings"])
    assert f"{total} findings: {total} explained, 0 not explained." in err
    assert "150 motors, 233 gearboxes, 1 winch, 54 ropes" in err


def test_no_line_is_wider_than_a_terminal_of_120_columns(run: Run) -> None:
    assert max(len(line.rstrip()) for line in run("catalog", "check")[1].splitlines()) <= 120


def test_json_carries_the_explanation_or_null(run: Run, tmp_path: Path) -> None:
    (tmp_path / "motors.csv").write_text(
        "id,rated_power_w,rated_speed_rpm,rated_torque_nm,source_id\nmine,1,3000,9,filipovic-kevac-2018\n"
    )
    assert run("catalog", "import", "motors.csv")[0] == 0
    _, out, err = run("catalog", "check", "motors", "--format", "json")
    record = json.loads(out, parse_constant=pytest.fail)
    explained = {finding["id"]: finding["explanation"] for finding in record["findings"]}
    assert explained["mine"] is None
    assert "power by which maxon names the type" in explained["maxon-236662"]
    assert record["checked"] == {"motors": 151}
    assert "1 not explained" in err
    _, out, _ = run("catalog", "check")
    assert "motors mine: rated_power_w is 1 W, but 2827 W follows" in out


def test_a_kind_without_findings_says_so(run: Run) -> None:
    status, out, err = run("catalog", "check", "gearboxes")
    assert (status, out) == (0, "")
    assert err.endswith("Checked 233 gearboxes.\n0 findings.\n")
