"""Workbooks, JSON and folders: the same rows, the same checks, one transaction for all kinds."""

import json
import zipfile
from collections.abc import Callable
from datetime import date, datetime
from math import inf
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from openpyxl import Workbook

from actuator_select.database import Catalogue
from actuator_select.errors import ActuatorSelectError, InvalidRows, UnknownName

Write = Callable[[str, str], Path]
SOURCE = "filipovic-kevac-2018"
Sheets = dict[str, list[list[Any]]]


def write_xlsx(path: Path, sheets: Sheets) -> Path:
    book = Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


def refusal(catalogue: Catalogue, path: Path, **options: Any) -> list[str]:  # noqa: ANN401 - options of the import
    before = catalogue.fingerprint()
    with pytest.raises(InvalidRows) as error:
        catalogue.import_file(path, **options)
    assert catalogue.fingerprint() == before
    return [str(problem) for problem in error.value.problems] or [str(error.value)]


NEW_SOURCE = [["id", "document", "page", "date", "accessed_date"], ["new", "A list", 7, date(2026, 11, 3), 2026]]


def test_a_workbook_brings_several_kinds_whatever_the_order_of_its_sheets(catalogue: Catalogue, tmp_path: Path) -> None:
    motors = [
        ["id", "part_number", "rated_power_w", "peak_torque_nm", "pole_pairs", "price_date", "source_id"],
        [236662, 236662.0, 0.1, "unlimited", 7, datetime(2026, 1, 31), "new"],  # noqa: DTZ001 - spreadsheets know no time zones
        [None],
        ["m2", "007", 30, None, None, None, "new"],
    ]
    path = write_xlsx(tmp_path / "parts.xlsx", {"Notes": [["hello"]], "Motors": motors, "sources": NEW_SOURCE})
    reports = catalogue.import_file(path)
    assert [(one.kind, one.added) for one in reports] == [("sources", 1), ("motors", 2)]
    row = catalogue.part("236662")[1]
    assert (row["part_number"], row["rated_power_w"], row["pole_pairs"]) == ("236662", 0.1, 7)
    assert (row["peak_torque_nm"], row["price_date"]) == (inf, "2026-01-31")
    assert catalogue.part("m2")[1]["part_number"] == "007"
    source = catalogue.source("new")
    assert (source["page"], source["date"], source["accessed_date"]) == ("7", "2026-11-03", "2026")


def test_every_kind_or_none_is_taken_from_a_workbook(catalogue: Catalogue, tmp_path: Path) -> None:
    motors = [["id", "rated_power_w", "source_id"], ["m1", -1, "new"], ["m2", 1, "new"], ["m3", 1, "newer"]]
    told = refusal(catalogue, write_xlsx(tmp_path / "p.xlsx", {"sources": NEW_SOURCE, "motors": motors}))
    assert [one.split(":")[0] for one in told] == [
        "p.xlsx, sheet motors, cell B2, rated_power_w",
        "p.xlsx, sheet motors, cell C4, source_id",
    ]


def test_failed_formulas_and_dates_in_place_of_numbers_are_named_by_their_cells(
    catalogue: Catalogue, tmp_path: Path
) -> None:
    rows = [
        ["id", "rated_power_w", "rated_torque_nm", "notes", "source_id"],
        ["m1", "#DIV/0!", date(2026, 5, 1), "#N/A", SOURCE],
        ["m2", "=1+1", True, None, SOURCE],
    ]
    told = refusal(catalogue, write_xlsx(tmp_path / "motors.xlsx", {"Sheet": rows}), kind="motors")
    place = "motors.xlsx, sheet Sheet, cell"
    assert told[0].startswith(f"{place} B2, rated_power_w: '#DIV/0!'")
    assert told[1].startswith(f"{place} C2, rated_torque_nm: '2026-05-01'")
    assert "made a date of it" in told[1]
    assert told[2].startswith(f"{place} D2, notes: '#N/A'")
    assert told[3].startswith(f"{place} B3, rated_power_w: '=1+1'")
    assert "never calculated" in told[3]
    assert told[4].startswith(f"{place} C3, rated_torque_nm: 'true'")
    assert len(told) == 5


def test_a_cell_beside_the_columns_is_told_in_the_words_of_a_spreadsheet(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [["id", "source_id"], ["m1", SOURCE, "a remark"]]
    (told,) = refusal(catalogue, write_xlsx(tmp_path / "p.xlsx", {"motors": rows}))
    assert told.startswith(
        "p.xlsx, sheet motors, row 2: 3 cells, expected 2 cells, as many as the header; empty the cells"
    )
    assert "comma" not in told


def test_a_sheet_is_chosen_by_its_name(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [["id", "source_id"], ["m1", SOURCE]]
    path = write_xlsx(tmp_path / "p.xlsx", {"old": [["id"], ["m0"]], "new": rows})
    with pytest.raises(InvalidRows, match="it has old, new; state one with --sheet"):
        catalogue.import_file(path)
    with pytest.raises(UnknownName, match="has no sheet 'newer'; did you mean 'new'"):
        catalogue.import_file(path, sheet="newer")
    assert catalogue.import_file(path, "motors", sheet="new")[0].added == 1


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 no zip", b"id,source_id\n"])
def test_what_is_no_workbook_is_told(catalogue: Catalogue, tmp_path: Path, content: bytes) -> None:
    (tmp_path / "p.xlsx").write_bytes(content)
    assert "is no XLSX workbook" in refusal(catalogue, tmp_path / "p.xlsx")[0]


def write_json(path: Path, content: object) -> Path:
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def test_json_is_read_with_its_units_and_names_of_opc(catalogue: Catalogue, tmp_path: Path) -> None:
    content = {
        "format": "actuator-select catalogue",
        "format_version": 1,
        "motors": [
            {
                "id": "m1",
                "MotorSpeedRated": {"Value": 100, "EngineeringUnits": "rad/s"},
                "MotorTorqueMax": "unlimited",
                "MotorInertia": {"Value": 1.2, "EngineeringUnits": "g cm²"},
                "rated_power_w": 20,
                "mass_kg": None,
                "source_id": "new",
            },
            {"id": "m2", "source_id": "new"},
        ],
        "sources": [{"id": "new", "document": "A list", "page": "1", "date": "2026"}],
    }
    reports = catalogue.import_file(write_json(tmp_path / "parts.json", content))
    assert [(one.kind, one.added) for one in reports] == [("sources", 1), ("motors", 2)]
    row = catalogue.part("m1")[1]
    assert row["rated_speed_rpm"] == pytest.approx(954.929658551372, rel=1e-14)
    assert (row["peak_torque_nm"], row["rotor_inertia_g_cm2"], row["mass_kg"]) == (inf, 1.2, None)


FIELDS_AND_CELLS = [
    ({"Value": "125", "EngineeringUnits": "mNm"}, 0.125),
    ({"Value": " 1.25e2 ", "EngineeringUnits": "mNm"}, 0.125),
    ({"Value": 125, "EngineeringUnits": "mNm"}, 0.125),
    ({"Value": "125", "EngineeringUnits": "N m"}, 125.0),
    ({"Value": "125", "EngineeringUnits": "Nm"}, 125.0),
    ({"Value": "unlimited", "EngineeringUnits": "mNm"}, inf),
    ({"Value": None, "EngineeringUnits": "mNm"}, None),
    ({"Value": "", "EngineeringUnits": "mNm"}, None),
]


@pytest.mark.parametrize(("cell", "expected"), FIELDS_AND_CELLS)
def test_a_figure_of_json_is_in_the_unit_beside_it_also_as_a_text(
    catalogue: Catalogue, tmp_path: Path, cell: object, expected: float | None
) -> None:
    rows = [{"id": "m", "peak_torque_nm": cell, "source_id": SOURCE}]
    catalogue.import_file(write_json(tmp_path / "motors.json", rows))
    assert catalogue.part("m")[1]["peak_torque_nm"] == expected


def test_a_unit_beside_a_figure_outranks_the_mappings(catalogue: Catalogue, tmp_path: Path, write_csv: Write) -> None:
    torques = ["125", {"Value": 125, "EngineeringUnits": "mNm"}, {"Value": 2, "EngineeringUnits": "N m"}]
    torques += [{"Value": "none", "EngineeringUnits": "mNm"}, {"Value": "n/a", "EngineeringUnits": "mNm"}]
    rows = [{"Name": f"m{number}", "Torque": torque} for number, torque in enumerate(torques)]
    columns = 'Name = { field = "id" }\nTorque = { field = "peak_torque_nm", unit = "mNm", unlimited = ["none"], '
    mapping = write_csv("own.toml", f'kind = "motors"\n[columns]\n{columns}missing = ["n/a"] }}\n')
    catalogue.import_file(write_json(tmp_path / "list.json", rows), mapping=mapping, source=SOURCE)
    found = [catalogue.part(f"m{number}")[1]["peak_torque_nm"] for number in range(len(torques))]
    assert found == [0.125, 0.125, 2.0, inf, None]


@pytest.mark.parametrize(
    ("cell", "words"),
    [
        ({"Value": "12,5", "EngineeringUnits": "mNm"}, "a decimal comma was given"),
        ({"Value": "12 Nm", "EngineeringUnits": "mNm"}, "a unit was given"),
        ({"Value": True, "EngineeringUnits": "mNm"}, "write a number"),
        ({"Value": [1], "EngineeringUnits": "mNm"}, "write a number"),
        ({"Value": "unlimited", "EngineeringUnits": "kg"}, "it does not measure what"),
        ({"Value": 1, "EngineeringUnits": 1000}, "write it plainly"),
        ({"Value": 10**400, "EngineeringUnits": "mNm"}, "more than a number can hold"),
        ({"Value": "1e400", "EngineeringUnits": "N m"}, "more than a number can hold"),
    ],
)
def test_a_figure_of_json_that_cannot_be_converted_is_refused(
    catalogue: Catalogue, tmp_path: Path, cell: object, words: str
) -> None:
    rows = [{"id": "m", "peak_torque_nm": cell, "source_id": SOURCE}]
    (told,) = refusal(catalogue, write_json(tmp_path / "motors.json", rows))
    assert words in told


@pytest.mark.parametrize("kind", ["motors", None])
def test_names_of_opc_are_known_whatever_the_list_is_called(
    catalogue: Catalogue, tmp_path: Path, kind: str | None
) -> None:
    rows = [{"id": "m", "MotorPowerRated": {"Value": 0.02, "EngineeringUnits": "kW"}, "source_id": SOURCE}]
    catalogue.import_file(write_json(tmp_path / "foo.json", rows), kind)
    assert catalogue.part("m")[1]["rated_power_w"] == 20.0


def test_a_column_is_taken_once_by_either_of_its_names(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [{"id": "m", "MotorPowerRated": 20, "rated_power_w": 30, "source_id": SOURCE}]
    (told,) = refusal(catalogue, write_json(tmp_path / "motors.json", rows))
    assert "'rated_power_w', expected each column once; it is rated_power_w again" in told


def test_what_a_row_of_json_leaves_out_keeps_its_value_in_an_update(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [{"id": "a", "rated_power_w": 1, "mass_kg": 2, "source_id": SOURCE}, {"id": "b", "source_id": SOURCE}]
    catalogue.import_file(write_json(tmp_path / "motors.json", rows))
    changed = [{"id": "a", "rated_power_w": 3}, {"id": "b", "mass_kg": None}]
    assert catalogue.import_file(write_json(tmp_path / "motors.json", changed), update=True)[0].updated == 1
    row = catalogue.part("a")[1]
    assert (row["rated_power_w"], row["mass_kg"]) == (3.0, 2.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"motors": [{"id": "a", "mass_kg": "x", "source_id": "s"}]}', "p.json, motors, row 1, mass_kg: 'x'"),
        ('{"motors": [{"id": "a"}, {"id": "b", "source_id": "$"}]}', "p.json, motors, row 1, source_id: empty"),
        ('{"motors": [{"id": "a", "wheels": 4}]}', "p.json, motors: 'wheels', expected a column of motors"),
        ('{"motors": [{"id": "a", "id": "b"}]}', "'id' stands twice in one object"),
        ('{"motors": [{"mass_kg": NaN}]}', "NaN is no figure"),
        ('{"motors": {}}', "'motors' is no list of rows"),
        ('{"motors": [], "wheels": []}', "'wheels' is no kind of row"),
        ('{"format": "shopping list"}', "expected 'actuator-select catalogue'"),
        ('{"format_version": 2}', "states format_version 2, expected 1"),
        ("[[[", "is no JSON"),
        ("3", "is no catalogue"),
        ('{"motors": [{"id": "a", "mass_kg": true, "source_id": "$"}]}', "mass_kg: 'true'"),
        ('{"motors": [{"id": "a", "mass_kg": ["s"], "source_id": "$"}]}', "mass_kg: '[\"s\"]'"),
        ('{"motors": [{"mass_kg": ' + "9" * 5000 + "}]}", "a number of 5000 digits is more than a number can hold"),
        ("[" * 100000, "nested too deeply|is no JSON"),
        (
            '{"motors": [{"id": "a", "mass_kg": {"Value": 1, "EngineeringUnits": "s"}, "source_id": "$"}]}',
            "the unit 's' cannot stand here: it does not measure what kg measures",
        ),
        (
            '{"motors": [{"id": "a", "mass_kg": {"Value": 1}, "source_id": "$"}]}',
            'as {"Value": 5060, "EngineeringUnits": "rpm"}',
        ),
    ],
)
def test_json_that_cannot_be_taken_is_explained(catalogue: Catalogue, write_csv: Write, text: str, words: str) -> None:
    told = refusal(catalogue, write_csv("p.json", text))
    assert any(word in one for one in told for word in words.split("|")), told


def test_a_folder_is_one_import(catalogue: Catalogue, tmp_path: Path) -> None:
    catalogue.export_folder(tmp_path / "all")
    motors = tmp_path / "all" / "motors.csv"
    motors.write_text(motors.read_text(encoding="utf-8").replace("filipovic-kevac-2018-motor-1", "other"), "utf-8")
    (tmp_path / "all" / "README.txt").write_text("no rows")
    told = refusal(catalogue, tmp_path / "all", replace=True)
    assert any("'filipovic-kevac-2018-motor-1', expected the id of a row of motors" in one for one in told) or any(
        "motor 'filipovic-kevac-2018-motor-1' of the catalogue: not in the file" in one for one in told
    )
    (report,) = catalogue.import_file(tmp_path / "all", "motors", update=True)
    assert (report.added, report.unchanged) == (1, 4)
    with pytest.raises(InvalidRows, match=r"has no file named after a kind of row, such as motors; name the file so$"):
        catalogue.import_file(tmp_path)


@pytest.mark.parametrize(
    ("titles", "options", "words"),
    [
        (["motors", "gearboxs"], {}, "has a sheet 'gearboxs', which is no kind of row; did you mean 'gearboxes'"),
        (["motors", "Winchs"], {"kind": "winches"}, "did you mean 'winches'"),
        (["Notes", "Ideas"], {}, "no sheet named after a kind of row, such as motors; it has Notes, Ideas; state one"),
        (["Notes", "motors"], {"kind": "winches"}, "has no sheet named winches; it has Notes, motors; state one with"),
        (["motor", "motors"], {}, "has several sheets for motors; state one with --sheet"),
    ],
)
def test_a_sheet_that_would_be_passed_over_unseen_is_told(
    catalogue: Catalogue, tmp_path: Path, titles: list[str], options: dict[str, str], words: str
) -> None:
    path = write_xlsx(tmp_path / "p.xlsx", {title: [["id", "source_id"], [title, SOURCE]] for title in titles})
    (told,) = refusal(catalogue, path, **options)
    assert words in told


def test_a_folder_takes_singular_names_and_refuses_misspelt_ones(catalogue: Catalogue, tmp_path: Path) -> None:
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "Gearbox.CSV").write_text(f"id,source_id\ng,{SOURCE}\n")
    (folder / "notes.csv").write_bytes(b"\xff\x00")
    assert [(one.kind, one.added) for one in catalogue.import_file(folder)] == [("gearboxes", 1)]
    (folder / "motrs.csv").write_text("")
    assert "has a file 'motrs', which is no kind of row; did you mean 'motors'" in refusal(catalogue, folder)[0]
    (folder / "motrs.csv").rename(folder / "gearboxes.csv")
    (folder / "gearboxes.csv").write_text(f"id,source_id\ng,{SOURCE}\n")
    assert "has several files for gearboxes; keep one of them" in refusal(catalogue, folder)[0]


@pytest.mark.parametrize("words", ['layout = "one-to-many"\n', "[csv]\nheader = false\n"])
def test_a_mapping_for_csv_alone_takes_no_workbook(
    catalogue: Catalogue, tmp_path: Path, write_csv: Write, words: str
) -> None:
    columns = '[columns]\n1 = { field = "motor_pattern" }\n2 = { field = "gearbox_pattern" }\n'
    mapping = write_csv("own.toml", f'kind = "compatibilities"\n{words}{columns}')
    path = write_xlsx(tmp_path / "p.xlsx", {"compatibilities": [["IN_22", "GI_1", "GI_2"]]})
    with pytest.raises(UnknownName, match=r"own\.toml has no header or a layout of pairs, .*save p\.xlsx as CSV"):
        catalogue.import_file(path, mapping=mapping)


def test_pairs_are_taken_from_a_folder_too(catalogue: Catalogue, tmp_path: Path) -> None:
    (tmp_path / "compatibilities.csv").write_text("IN_22,GI_1,GI_2\n")
    (report,) = catalogue.import_file(tmp_path, mapping="mgdb-compatibility", source=SOURCE)
    assert report.added == 2


@pytest.mark.parametrize("name", ["p.xlsx", "p.json", "folder"])
def test_import_csv_takes_csv_alone(catalogue: Catalogue, tmp_path: Path, name: str) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(InvalidRows, match="is no CSV file; import_file takes"):
        catalogue.import_csv(tmp_path / name)


def test_replace_restores_an_exported_catalogue(catalogue: Catalogue, tmp_path: Path, write_csv: Write) -> None:
    before = catalogue.fingerprint()
    catalogue.export_folder(tmp_path / "all")
    catalogue.import_file(write_csv("motors.csv", "id,rated_power_w,source_id\nnew,1,$\n"))
    catalogue.import_file(
        write_csv("motors.csv", "id,rated_power_w,mass_kg\nfilipovic-kevac-2018-motor-1,7,2\n"), update=True
    )
    parts = "new,filipovic-kevac-2018-winch,$"
    catalogue.import_file(write_csv("actuators.csv", f"id,name,motor_id,winch_id,source_id\nx,Mine,{parts}\n"))
    reports = {one.kind: one for one in catalogue.import_file(tmp_path / "all", replace=True)}
    assert (reports["motors"].removed, reports["motors"].updated, reports["actuators"].removed) == (1, 1, 1)
    assert catalogue.fingerprint() == before
    assert catalogue.history("new", "motors")[-1].action == "removed"


def test_a_name_is_free_once_its_row_is_replaced(catalogue: Catalogue, write_csv: Write) -> None:
    parts = "filipovic-kevac-2018-motor-1,filipovic-kevac-2018-winch,$"
    text = f"id,name,motor_id,winch_id,source_id\nnew,Actuator 1,{parts}\n"
    (report,) = catalogue.import_file(write_csv("actuators.csv", text), replace=True)
    assert (report.added, report.removed) == (1, 5)
    assert catalogue.count("actuators") == 1


def test_an_export_with_exchanged_names_is_restored(catalogue: Catalogue, tmp_path: Path) -> None:
    first, second = (f"filipovic-kevac-2018-{number}" for number in (1, 2))
    for row_id, name in ((first, "Between"), (second, "Actuator 1"), (first, "Actuator 2")):
        catalogue.edit(row_id, {"name": name})
    exchanged = catalogue.fingerprint()
    catalogue.export_folder(tmp_path / "exchanged")
    for row_id, name in ((first, "Between"), (second, "Actuator 2"), (first, "Actuator 1")):
        catalogue.edit(row_id, {"name": name})
    reports = {one.kind: one for one in catalogue.import_file(tmp_path / "exchanged", replace=True)}
    assert (reports["actuators"].updated, reports["actuators"].unchanged) == (2, 3)
    assert catalogue.fingerprint() == exchanged
    last = catalogue.history(first)[-1]
    assert (last.field, last.old, last.new) == ("name", "Actuator 1", "Actuator 2")


PARTS = "filipovic-kevac-2018-motor-1,filipovic-kevac-2018-winch,$"
ACTUATORS = "id,name,motor_id,winch_id,source_id\n"


@pytest.mark.parametrize("option", ["update", "replace"])
def test_names_are_exchanged_and_handed_on_far_apart(catalogue: Catalogue, write_csv: Write, option: str) -> None:
    count = 2100  # more than two portions
    names = [f"Name {number}" for number in range(count)]
    rows = "".join(f"a{number},{name},{PARTS}\n" for number, name in enumerate(names))
    path = write_csv("actuators.csv", ACTUATORS + rows)
    catalogue.import_file(path)
    names[0], names[-1] = names[-1], names[0]
    names[1], names[1050], names[2090] = names[1050], "Another", names[1]
    rows = "".join(f"a{number},{name},{PARTS}\n" for number, name in enumerate(names))
    write_csv("actuators.csv", ACTUATORS + f"new,Name 2090,{PARTS}\n" + rows)
    (report,) = catalogue.import_file(path, **{option: True})
    assert (report.added, report.updated, report.unchanged) == (1, 5, count - 5)
    found = {str(row["id"]): row["name"] for row in catalogue.rows("actuators")}
    assert [found[f"a{number}"] for number in range(count)] == names
    assert found["new"] == "Name 2090"
    last = catalogue.history("a2099")[-1]
    assert (last.field, last.old, last.new) == ("name", "Name 2099", "Name 0")


def test_a_name_that_its_row_keeps_is_not_given_to_another(catalogue: Catalogue, write_csv: Write) -> None:
    header = "id,name,motor_id,winch_id,source_id\n"
    taken = write_csv("actuators.csv", f"{header}filipovic-kevac-2018-1,Actuator 2,{PARTS}\n")
    (told,) = refusal(catalogue, taken, update=True)
    assert "expected another name than actuator 'filipovic-kevac-2018-2' of the catalogue" in told
    taken = write_csv("actuators.csv", "id,name,price\nfilipovic-kevac-2018-1,Actuator 2,\nfilipovic-kevac-2018-2,,1\n")
    told = refusal(catalogue, taken, update=True)[0]
    assert "expected another name than actuator 'filipovic-kevac-2018-2' of the catalogue" in told


def test_of_a_replacement_that_breaks_off_every_problem_is_told(catalogue: Catalogue, write_csv: Write) -> None:
    rows = f"filipovic-kevac-2018-1,Actuator 5,nowhere,filipovic-kevac-2018-winch,$\nx,Actuator 2,{PARTS}\n"
    path = write_csv("actuators.csv", f'{ACTUATORS}{rows}y,"Broken,{PARTS}\n')
    told = refusal(catalogue, path, replace=True)
    assert [one.split(":")[0] for one in told] == ["actuators.csv, line 2, motor_id", "actuators.csv, line 4"]


def test_an_import_drops_no_table_which_would_end_the_transaction_on_mysql(
    catalogue: Catalogue, write_csv: Write
) -> None:
    said: list[str] = []
    sa.event.listen(catalogue._engine, "before_cursor_execute", lambda *one: said.append(one[2]))  # noqa: SLF001
    for number in range(2):
        catalogue.import_file(write_csv("motors.csv", f"id,source_id\nm{number},$\n"))
    assert not [statement for statement in said if "DROP" in statement]
    assert [statement for statement in said if "CREATE TEMPORARY TABLE" in statement]


def test_what_others_use_is_not_replaced(catalogue: Catalogue, write_csv: Write) -> None:
    told = refusal(catalogue, write_csv("winches.csv", "id,drum_radius_mm,source_id\nnew,1,$\n"), replace=True)
    assert len(told) == 1
    assert told[0].startswith("winch 'filipovic-kevac-2018-winch' of the catalogue: not in the file, expected a row")
    assert "actuator 'filipovic-kevac-2018-1'" in told[0]


CELLS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-5, 10**20),
    st.floats(),
    st.text(max_size=6),
    st.sampled_from(["1,5", "12", "0", "unlimited", "nan", SOURCE, "m1", "94 %"]),
)
TEXTS = ("id", "notes", "motor_type", "source_id")
NAMES = st.sampled_from([*TEXTS, "rated_power_w", "peak_torque_nm", "pole_pairs", "x"])


@settings(suppress_health_check=list(HealthCheck), max_examples=60, deadline=None)
@given(
    rows=st.lists(st.dictionaries(NAMES, CELLS, max_size=4), max_size=4),
    complete=st.integers(0, 4).map(bool),
)
def test_any_table_is_taken_rightly_or_refused_without_a_trace(
    catalogue: Catalogue, tmp_path: Path, rows: list[dict[str, Any]], *, complete: bool
) -> None:
    before = catalogue.fingerprint()
    filled = [{"id": f"r{number}", "source_id": SOURCE} if complete else {} for number in range(len(rows))]
    objects = [one | row for one, row in zip(filled, rows, strict=True)]
    path = tmp_path / "motors.json"
    path.write_text(json.dumps({"motors": objects}), encoding="utf-8")
    count = catalogue.count("motors")
    try:
        (report,) = catalogue.import_file(path, dry_run=True)
    except ActuatorSelectError:
        with pytest.raises(ActuatorSelectError):
            catalogue.import_file(path)
    else:
        assert report.added + report.unchanged == len(rows)
        catalogue.import_file(path)
        for one in objects:
            row = catalogue.part(str(one["id"]), "motors")[1]
            for name in TEXTS:
                assert (row[name] or "") == (one[name] if (one.get(name) or "").strip() else "")
        catalogue.import_file(write_json(tmp_path / "motors.json", _kept(catalogue)), replace=True)
    assert catalogue.count("motors") == count
    assert catalogue.fingerprint() == before


def _kept(catalogue: Catalogue) -> list[dict[str, object]]:
    """The shipped motors as rows of JSON."""
    rows = catalogue.rows("motors", where="origin = 'shipped'")
    return [{name: value for name, value in row.items() if name != "origin"} for row in rows]


def test_a_replacement_with_a_bad_cell_tells_of_that_cell_only(catalogue: Catalogue, tmp_path: Path) -> None:
    catalogue.export_folder(tmp_path / "all")
    motors = tmp_path / "all" / "motors.csv"
    lines = motors.read_text(encoding="utf-8").splitlines()
    motors.write_text("\n".join([lines[0], "b" + "," * lines[0].count(","), *lines[1:]]), encoding="utf-8")
    actuators = tmp_path / "all" / "actuators.csv"
    actuators.write_text(actuators.read_text(encoding="utf-8").replace("2018-1,Actuator 1", "2018-new,Actuator 1"))
    (told,) = refusal(catalogue, tmp_path / "all", replace=True)
    assert told.startswith("motors.csv, line 2, source_id: empty")


def test_a_damaged_sheet_is_told(catalogue: Catalogue, tmp_path: Path) -> None:
    whole = write_xlsx(tmp_path / "whole.xlsx", {"motors": [["id", "source_id"], ["m1", SOURCE]]})
    path = tmp_path / "motors.xlsx"
    with zipfile.ZipFile(whole) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            target.writestr(name, content[:-30] if name.endswith("sheet1.xml") else content)
    assert "the sheet motors cannot be read" in refusal(catalogue, path)[0]


def test_only_a_workbook_has_sheets(catalogue: Catalogue, write_csv: Write) -> None:
    with pytest.raises(UnknownName, match="is no XLSX workbook and has no sheet 'parts'"):
        catalogue.import_file(write_csv("motors.csv", "id,source_id\na,$\n"), sheet="parts")


def test_merged_cells_below_the_header_are_refused_with_their_ranges(catalogue: Catalogue, tmp_path: Path) -> None:
    book = Workbook()
    sheet = book.active
    for row in (["id", "rated_power_w", "source_id"], ["m1", 5, SOURCE], ["m2", None, SOURCE]):
        sheet.append(row)
    sheet.merge_cells("B2:B3")
    sheet.merge_cells("E1:F1")
    book.save(tmp_path / "motors.xlsx")
    (told,) = refusal(catalogue, tmp_path / "motors.xlsx", kind="motors")
    assert told.startswith("motors.xlsx, sheet Sheet: merged cells B2:B3, expected every cell for itself")
    assert told.endswith("unmerge them and fill every cell")


def test_what_is_not_read_of_a_workbook_or_a_folder_is_named(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [["id", "source_id"], ["m1", SOURCE]]
    (report,) = catalogue.import_file(write_xlsx(tmp_path / "p.xlsx", {"Notes": [["hello"]], "motors": rows}))
    assert report.notices == ("not read of p.xlsx: sheet Notes",)
    content = {"motors": [{"id": "m2", "source_id": SOURCE}], "winches": []}
    (report,) = catalogue.import_file(write_json(tmp_path / "p.json", content), "motors")
    assert report.notices == ("not read of p.json: list winches",)
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "motors.csv").write_text(f"id,source_id\nm3,{SOURCE}\n")
    (folder / "prices.csv").write_bytes(b"\xff")
    (report,) = catalogue.import_file(folder)
    assert report.notices == ("not read of own: file prices.csv",)
