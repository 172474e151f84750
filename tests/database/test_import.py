"""CSV files: taken in whole, or refused with every objection."""

from collections.abc import Callable
from math import inf
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from actuator_select.database import Catalogue, queries
from actuator_select.database.kinds import KINDS
from actuator_select.errors import ActuatorSelectError, InvalidRows, UnknownName

Write = Callable[[str, str], Path]

GOOD = "id,rated_power_w,peak_torque_nm,source_id\na,100,unlimited,$\nb,,,$\n"


NO_SOURCE = (
    "motors.csv, line 2, source_id: 'nowhere', expected the id of a row of sources; known are filipovic-kevac-2018 "
    "(import sources.csv first, or add the source)"
)
TOO_LITTLE_PEAK = (
    "motors.csv, line 3, peak_torque_nm: '1.0', expected at least rated_torque_nm = 2 [N m]; check both figures in "
    "the source"
)
BAD_ID = (
    "motors.csv, line 4, id: 'c c', expected up to 100 letters, digits and . _ + -, beginning with a letter or digit"
)
EMPTY_SOURCE = (
    "motors.csv, line 4, source_id: empty, expected the id of a row of sources; this column has to be filled in every "
    "row"
)


def refusal(catalogue: Catalogue, path: Path, kind: str | None = None, *, update: bool = False) -> list[str]:
    """Import a file that has to be refused; what is said about it. Nothing may have changed."""
    before = catalogue.fingerprint()
    with pytest.raises(InvalidRows) as error:
        catalogue.import_csv(path, kind, update=update)
    assert catalogue.fingerprint() == before
    return [str(problem) for problem in error.value.problems] or [str(error.value)]


def test_rows_are_taken_in(catalogue: Catalogue, write_csv: Write) -> None:
    report = catalogue.import_csv(write_csv("motors.csv", GOOD))
    assert (report.kind, report.added, report.updated, report.unchanged) == ("motors", 2, 0, 0)
    first, second = (catalogue.part(row_id)[1] for row_id in ("a", "b"))
    assert (first["rated_power_w"], first["peak_torque_nm"], first["origin"]) == (100.0, inf, "user")
    assert (second["rated_power_w"], second["peak_torque_nm"]) == (None, None)


@pytest.mark.parametrize("text", ["\ufeff" + GOOD, GOOD.replace("\n", "\r\n"), GOOD.replace("\n", "\n\n")])
def test_what_spreadsheets_write_is_understood(catalogue: Catalogue, write_csv: Write, text: str) -> None:
    assert catalogue.import_csv(write_csv("motors.csv", text)).added == 2


def test_other_names_of_columns_are_understood(catalogue: Catalogue, write_csv: Write) -> None:
    text = "id,nominal_torque_nm,max_efficiency_pct,source_url,source_id\na,0.5,90,https://example.org/a,$\n"
    catalogue.import_csv(write_csv("motors.csv", text))
    row = catalogue.part("a")[1]
    assert row["rated_torque_nm"] == 0.5
    assert row["max_efficiency_percent"] == 90.0
    assert row["source_location"] == "https://example.org/a"


@pytest.mark.parametrize(
    ("name", "kind", "header"),
    [
        ("motors.csv", None, "id,source_id"),
        ("Motor.CSV", None, "id,source_id"),
        ("acme.csv", "motor", "id,source_id"),
        ("acme.csv", None, "id,rotor_inertia_g_cm2,source_id"),
    ],
)
def test_the_kind_is_stated_or_told_by_name_or_header(
    catalogue: Catalogue, write_csv: Write, name: str, kind: str | None, header: str
) -> None:
    cells = ",".join({"id": "a", "source_id": "$"}.get(column, "1") for column in header.split(","))
    assert catalogue.import_csv(write_csv(name, f"{header}\n{cells}\n"), kind).kind == "motors"


def test_a_kind_that_cannot_be_told_is_asked_for(catalogue: Catalogue, write_csv: Write) -> None:
    with pytest.raises(UnknownName, match="state it with --kind"):
        catalogue.import_csv(write_csv("acme.csv", "id,source_id\na,$\n"))


def test_every_bad_cell_is_told_at_once_in_the_order_of_the_lines(catalogue: Catalogue, write_csv: Write) -> None:
    text = (
        "id,rated_power_w,nominal_torque_nm,max_efficiency_percent,peak_torque_nm,source_id\n"
        'a,"1,5",0,0.94,,nowhere\n'
        "a,NaN,2,120,1,$\n"
        "c c,1,1,,,\n"
    )
    told = refusal(catalogue, write_csv("motors.csv", text))
    number, percent = "expected a number more than 0", "expected a number more than 1 and at most 100 [%]"
    assert told == [
        f"motors.csv, line 2, rated_power_w: '1,5', {number} [W]; a decimal comma was given, write 1.5 with a point",
        f"motors.csv, line 2, nominal_torque_nm: '0', {number} [N m]; leave it empty if it is unknown",
        f"motors.csv, line 2, max_efficiency_percent: '0.94', {percent}; a fraction was given, write 94",
        NO_SOURCE,
        f"motors.csv, line 3, rated_power_w: 'NaN', {number} [W]; leave it empty if it is unknown",
        f"motors.csv, line 3, max_efficiency_percent: '120', {percent}",
        "motors.csv, line 3, id: 'a', expected another id than motors.csv, line 2; remove or rename one",
        TOO_LITTLE_PEAK,
        BAD_ID,
        EMPTY_SOURCE,
    ]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("id,rated_powr_w,source_id\na,1,$\n", "'rated_powr_w', expected a column of motors; did you mean"),
        ("id,source_id,wheels\na,$,4\n", "`actuator-select catalog fields motors` lists what there is"),
        ("id,source_id,\na,$,4\n", "line 1: empty, expected a column"),
        ("id,origin,source_id\na,shipped,$\n", "'origin', expected a column of motors"),
        ("id,rated_torque_nm,nominal_torque_nm,source_id\na,1,1,$\n", "expected each column once"),
        ("id,rated_power_w\na,1\nb,2\n", "line 1: there is no column 'source_id'"),
        ("rated_power_w,source_id\n1,$\n", "line 1: there is no column 'id'"),
        ("id,source_id\na\nb,$\n", "line 2: 1 cells, expected 2 cells"),
        ("id,source_id\n\n\na,$,3\n", "line 4: 3 cells, expected 2 cells"),
        ("id;source_id\na;$\n", "replace the semicolons by commas"),
        ("id\tsource_id\na\t$\n", "replace the tabs by commas"),
        ("List of 2026,\nid,source_id\na,$\n", "which stand in line 2; remove the lines above them"),
        ('id,rated_power_w,source_id\na,"1,000.5",$\n', "thousands are separated, write 1000.5"),
        ('id,rated_power_w,source_id\na,"1.234,5",$\n', "thousands are separated, write 1234.5"),
        ("id,price_date,source_id\na,2024-05-01 12:30:00,$\n", "write 2024-05-01 without the time"),
        ("id,price_date,source_id\na,45413,$\n", "a spreadsheet counts days so"),
        ('id,source_id\na,"$\n', "does every cell that opens with a double quote close with one?"),
        ("", "motors.csv is empty"),
    ],
)
def test_a_file_that_cannot_be_understood_is_explained(
    catalogue: Catalogue, write_csv: Write, text: str, words: str
) -> None:
    told = refusal(catalogue, write_csv("motors.csv", text))
    assert any(words in problem for problem in told), told
    assert len(told) == 1


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("id,notes\na,Zürich\n".encode("latin-1"), r"not UTF-8: byte 12 \(line 2\) is 0xFC; save it again"),
        ("id,notes\na,b\n".encode("utf-16"), "UTF-16, expected UTF-8"),
        (b"\x00\x01\x02\xff", "is no text but a binary file"),
        (b"SQLite format 3\0...", "is no CSV file but an SQLite database"),
    ],
)
def test_another_encoding_is_named(catalogue: Catalogue, tmp_path: Path, data: bytes, words: str) -> None:
    path = tmp_path / "motors.csv"
    path.write_bytes(data)
    with pytest.raises(InvalidRows, match=words):
        catalogue.import_csv(path)


def test_a_missing_file_is_named(catalogue: Catalogue, tmp_path: Path) -> None:
    with pytest.raises(InvalidRows, match=r"cannot read .*nothing\.csv"):
        catalogue.import_csv(tmp_path / "nothing.csv")


def test_a_cell_over_several_lines_does_not_shift_the_line_numbers(catalogue: Catalogue, write_csv: Write) -> None:
    told = refusal(catalogue, write_csv("motors.csv", 'id,notes,rated_power_w,source_id\na,"x\ny\nz",1,$\nb,,-1,$\n'))
    assert told == ["motors.csv, line 5, rated_power_w: '-1', expected a number more than 0 [W]"]


def test_a_misspelt_reference_is_suggested(catalogue: Catalogue, write_csv: Write) -> None:
    text = "id,name,motor_id,winch_id,source_id\na,A,filipovic-kevac-2018-motor-9,filipovic-kevac-2018-winch,$\n"
    (told,) = refusal(catalogue, write_csv("actuators.csv", text))
    assert "did you mean 'filipovic-kevac-2018-motor-5'" in told


def test_names_of_actuators_are_unique(catalogue: Catalogue, write_csv: Write) -> None:
    parts = "filipovic-kevac-2018-motor-1,filipovic-kevac-2018-winch,$"
    text = f"id,name,motor_id,winch_id,source_id\na,Actuator 1,{parts}\nb,New,{parts}\nc,New,{parts}\n"
    told = refusal(catalogue, write_csv("actuators.csv", text))
    assert "another name than actuator 'filipovic-kevac-2018-1' of the catalogue" in told[0]
    assert "another name than actuators.csv, line 3" in told[1]


def test_an_equal_row_is_passed_over(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("motors.csv", GOOD)
    catalogue.import_csv(path)
    report = catalogue.import_csv(path)
    assert (report.added, report.updated, report.unchanged) == (0, 0, 2)


def test_another_row_of_the_same_id_needs_update(catalogue: Catalogue, write_csv: Write) -> None:
    catalogue.import_csv(write_csv("motors.csv", GOOD))
    changed = write_csv("motors.csv", "id,rated_power_w\na,120\n")
    (told,) = refusal(catalogue, changed)
    assert "(rated_power_w is '100' there and '120' here)" in told
    assert "--update" in told
    report = catalogue.import_csv(changed, update=True)
    assert (report.added, report.updated) == (0, 1)
    row = catalogue.part("a")[1]
    assert (row["rated_power_w"], row["peak_torque_nm"]) == (120.0, inf)


def test_an_update_cannot_empty_what_is_required(catalogue: Catalogue, write_csv: Write) -> None:
    catalogue.import_csv(write_csv("motors.csv", GOOD))
    (told,) = refusal(catalogue, write_csv("motors.csv", "id,source_id\na,\n"), update=True)
    assert "line 2, source_id: empty" in told


def test_a_dry_run_checks_and_writes_nothing(catalogue: Catalogue, write_csv: Write) -> None:
    before = catalogue.fingerprint()
    report = catalogue.import_csv(write_csv("motors.csv", GOOD), dry_run=True)
    assert (report.added, report.dry_run) == (2, True)
    assert catalogue.fingerprint() == before
    with pytest.raises(InvalidRows):
        catalogue.import_csv(write_csv("motors.csv", GOOD.replace("100", "-100")), dry_run=True)


@pytest.mark.parametrize("moment", ["reading", "writing", "after writing"])
def test_an_interrupted_import_leaves_nothing(
    catalogue: Catalogue, write_csv: Write, monkeypatch: pytest.MonkeyPatch, moment: str
) -> None:
    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    before = catalogue.fingerprint()
    if moment == "writing":
        monkeypatch.setattr(queries, "insert_rows", stop)
    elif moment == "after writing":
        monkeypatch.setattr(queries, "update_rows", stop)
    progress = stop if moment == "reading" else None
    with pytest.raises(KeyboardInterrupt):
        catalogue.import_csv(write_csv("motors.csv", GOOD), progress=progress)
    assert catalogue.fingerprint() == before


def test_progress_reaches_the_last_line(catalogue: Catalogue, write_csv: Write) -> None:
    told: list[tuple[int, int]] = []
    text = "id,source_id\n" + "".join(f"m{number},$\n" for number in range(250))
    catalogue.import_csv(write_csv("motors.csv", text), progress=lambda done, total: told.append((done, total)))
    assert told == [(100, 250), (200, 250), (250, 250)]


def test_many_rows_are_one_transaction(catalogue: Catalogue, write_csv: Write) -> None:
    text = "id,ratio,source_id\n" + "".join(f"g{number},{number + 1},$\n" for number in range(1200)) + "g,0,$\n"
    (told,) = refusal(catalogue, write_csv("gearboxes.csv", text))
    assert told.startswith("gearboxes.csv, line 1202, ratio: '0'")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)
@given(st.binary(max_size=200) | st.text(max_size=200).map(lambda text: text.encode(errors="surrogatepass")))
def test_no_file_is_a_fault_of_the_program(catalogue: Catalogue, tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "motors.csv"
    path.write_bytes(b"id,notes,rated_power_w,source_id\n" + data)
    before = catalogue.fingerprint()
    try:
        written: list[object] = []
        report = catalogue.import_csv(path, dry_run=True, on_rows=lambda _, rows: written.extend(rows))
    except ActuatorSelectError:
        pass
    else:
        assert report.added == len(written)
    assert catalogue.fingerprint() == before


def test_every_kind_can_be_imported_from_what_it_exports(catalogue: Catalogue, tmp_path: Path) -> None:
    for path in catalogue.export_folder(tmp_path / "all"):
        if path.stem == "ropes":
            continue  # none are shipped, and a file without rows is refused
        report = catalogue.import_csv(path)
        assert report.unchanged == catalogue.count(report.kind)
    assert list(KINDS) == [path.stem for path in catalogue.export_folder(tmp_path / "all")]
