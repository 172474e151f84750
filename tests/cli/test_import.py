"""``catalog import``: what it says of mappings, workbooks and many findings, and the example of the README."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select.database import open_catalogue

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
SOURCE = "filipovic-kevac-2018"
Run = Callable[..., tuple[int, str, str]]


def test_the_list_of_the_readme_becomes_rows_in_our_units(run: Run, tmp_path: Path) -> None:
    for name, text in re.findall(r"a file `([\w.]+)`[^`]*:\n\n```\w+\n(.*?)```", README, flags=re.DOTALL):
        (tmp_path / name).write_text(text, encoding="utf-8")
    status, _, err = run("catalog", "import", "acme.csv", "--mapping", "acme.toml", "--source", SOURCE)
    assert status == 0, err
    assert "motors: 2 added, 0 changed, 0 already there" in err
    with open_catalogue(tmp_path / "catalogue.db") as catalogue:
        row = catalogue.part("acme-M-40-24")[1]
        other = catalogue.part("acme-M-60-48")[1]
    assert (row["rated_torque_nm"], row["mass_kg"], row["peak_torque_nm"]) == (0.0125, 0.1995806428, None)
    assert (row["speed_constant_rpm_per_v"], row["motor_type"], row["manufacturer"]) == (310.0, "bldc", "Acme")
    assert row["rotor_inertia_g_cm2"] == pytest.approx(0.02 * 28.349523125 * 2.54**2, rel=1e-14)
    assert other["peak_torque_nm"] == pytest.approx(85 * 0.028349523125 * 9.80665 * 0.0254, rel=1e-14)


def test_of_many_findings_the_first_and_their_number_are_told(run: Run, tmp_path: Path) -> None:
    rows = "".join(f"m{number},1,3000,9,{SOURCE}\n" for number in range(1500))
    (tmp_path / "motors.csv").write_text(f"id,rated_power_w,rated_speed_rpm,rated_torque_nm,source_id\n{rows}")
    status, _, err = run("catalog", "import", "motors.csv")
    assert status == 0
    assert err.count("Warning: motors m") == 20
    assert "Warning: 1500 findings in all; actuator-select catalog check lists them" in err


def test_replace_tells_what_it_removed(run: Run, tmp_path: Path) -> None:
    table = tmp_path / "compatibilities.csv"
    header = "id,motor_pattern,gearbox_pattern,source_id"
    table.write_text(f"{header}\na,m*,g*,{SOURCE}\nb,n*,g*,{SOURCE}\n")
    run("catalog", "import", table.name)
    table.write_text(f"{header}\nb,n*,g*,{SOURCE}\n")
    status, _, err = run("catalog", "import", table.name, "--replace")
    assert status == 0
    assert "compatibilities: 0 added, 0 changed, 1 already there, 1 removed" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--mapping", "mgdb-motor"], "did you mean 'mgdb-motors'? (a file of your own ends in .toml)"),
        (["--show-mapping", "mgdb-motor"], "did you mean 'mgdb-motors'?"),
        (["--mapping", "none.toml"], "cannot read the mapping none.toml"),
        (["--update", "--replace"], "state one of them"),
        (["--source", "nowhere"], "--source: 'nowhere', expected the id of a row of sources"),
        (["--kind", "wheels"], "no kind 'wheels'"),
    ],
)
def test_an_import_that_cannot_be_meant_is_explained(
    run: Run, tmp_path: Path, arguments: list[str], words: str
) -> None:
    (tmp_path / "motors.csv").write_text("id\na\n")
    status, out, err = run("catalog", "import", "motors.csv", *arguments)
    assert (status, out) == (2, "")
    assert words in err


def test_files_that_are_not_read_are_named_on_stderr(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "motors.csv").write_text(f"id,source_id\nm1,{SOURCE}\n")
    (folder / "prices.csv").write_text("a\n")
    status, out, err = run("catalog", "import", "own")
    assert (status, out) == (0, "")
    assert "Warning: not read of own: file prices.csv" in err


def test_a_shipped_mapping_is_written_to_stdout_and_can_be_used_as_a_file(run: Run, tmp_path: Path) -> None:
    status, out, err = run("catalog", "import", "--show-mapping", "mgdb-motors")
    assert (status, err) == (0, "")
    (tmp_path / "own.toml").write_text(out, encoding="utf-8")
    (tmp_path / "list.csv").write_text("key,type\nm1,DC\n", encoding="utf-8")
    status, _, err = run("catalog", "import", "list.csv", "--mapping", "own.toml", "--source", SOURCE)
    assert (status, "motors: 1 added" in err) == (0, True), err
