"""XLSX and JSON files say exactly what the database holds; a reader written from the description proves it."""

import json
import shutil
from math import inf
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.fields import Kind
from actuator_select.database.kinds import KINDS
from actuator_select.database.opc import opc_name
from actuator_select.database.workbook_text import escape_text, unescape_text
from actuator_select.errors import InvalidExpression, InvalidRows, OutputNotWritable, UnknownName

SOURCE = "filipovic-kevac-2018"
CONTROLS = "".join(map(chr, {*range(32), 127} - {9, 10, 13}))
TEXTS = st.one_of(
    st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters=CONTROLS), min_size=1).filter(str.strip),
    st.sampled_from(
        [
            "=1+1",
            "236662",
            "+1",
            "@SUM(A1)",
            "a\rb",
            "a\r\nb",
            "\r",
            " a ",
            "_x000D_",
            "_x005F_x000D_",
            "__x000d_",
            "_x000D_x000D_",
            "#N/A",
            "TRUE",
            "2020-01-01",
            "unlimited",
            "￾￿",
            "𝛀 – 日本",
        ]
    ).filter(str.strip),
)
FIGURES = st.floats(1e-12, 1e12) | st.sampled_from([0.1 + 0.2, 1.1e-9 / 3, 5060.0, 1e12 / 3])
Known = dict[str, Any]


def own(kind: Kind, row: Known) -> Known:
    """What is known of a row, without what the program fills itself."""
    return {field.name: row[field.name] for field in kind.fields if row[field.name] is not None}


def read_workbook(path: Path) -> dict[str, list[Known]]:
    book = load_workbook(path, read_only=True)
    sheets = {}
    for sheet in book:
        header, *rows = sheet.iter_rows(values_only=True)
        kind = KINDS[sheet.title]
        sheets[sheet.title] = [
            {
                str(name): read_cell(kind, str(name), cell)
                for name, cell in zip(header, row, strict=False)  # empty cells at the end are not stored
                if cell is not None
            }
            for row in rows
        ]
    book.close()
    return sheets


def read_cell(kind: Kind, name: str, cell: object) -> object:
    field = kind.field(name)
    if field.is_text:
        assert isinstance(cell, str)
        return unescape_text(cell)
    if cell == "unlimited":
        return inf
    assert isinstance(cell, int | float)
    return int(cell) if field.type == "int" else float(cell)


def read_json(text: str) -> dict[str, list[Known]]:
    record = json.loads(text, parse_constant=pytest.fail)
    assert record["format"] == "actuator-select catalogue"
    assert record["format_version"] == 1
    found = {}
    for kind in KINDS.values():
        if kind.name in record:
            names = {opc_name(kind, field.name): field for field in kind.fields}
            found[kind.name] = [
                {names[key].name: read_entry(kind, names[key].name, value) for key, value in row.items()}
                for row in record[kind.name]
            ]
    return found


def read_entry(kind: Kind, name: str, entry: object) -> object:
    field = kind.field(name)
    if isinstance(entry, dict):
        assert entry["EngineeringUnits"] == field.unit
        assert opc_name(kind, name) != name
        entry = entry["Value"]
    return inf if entry == "unlimited" and not field.is_text else entry


def everything(catalogue: Catalogue) -> dict[str, list[Known]]:
    return {
        kind.name: [
            own(kind, {name: value for name, value in row.items() if "." not in name})
            for row in catalogue.rows(kind.name)
        ]
        for kind in KINDS.values()
    }


@settings(suppress_health_check=list(HealthCheck), max_examples=40, deadline=None)
@given(texts=st.lists(TEXTS, min_size=3, max_size=3), figures=st.lists(FIGURES, min_size=3, max_size=3), pairs=...)
@example(texts=["=1+1", "236662", "a\r\nb"], figures=[0.1 + 0.2, 5060.0, 1e-12], pairs=7)
def test_xlsx_and_json_say_exactly_what_the_database_holds(
    template: Path, tmp_path: Path, texts: list[str], figures: list[float], pairs: int
) -> None:
    row = {
        "id": "236662",
        "manufacturer": texts[0],
        "notes": texts[1],
        "supply": texts[2],
        "rated_torque_nm": figures[0],
        "rotor_inertia_g_cm2": figures[1],
        "price": figures[2],
        "peak_torque_nm": inf,
        "viscous_friction_nm_s_per_rad": 0.0,
        "pole_pairs": 1 + abs(pairs) % 1000,
        "source_id": SOURCE,
    }
    with open_catalogue(shutil.copy(template, tmp_path / "one.db")) as catalogue:
        catalogue.add("motors", row)
        held = everything(catalogue)
        catalogue.export_file(tmp_path / "all.xlsx", "xlsx")
        catalogue.export_file(tmp_path / "all.json", "json")
        fingerprint = catalogue.fingerprint()
    assert row in held["motors"]
    assert read_workbook(tmp_path / "all.xlsx") == held
    text = (tmp_path / "all.json").read_text(encoding="utf-8")
    assert read_json(text) == held
    assert json.loads(text)["fingerprint"] == fingerprint


@given(TEXTS)
def test_an_escaped_text_reads_back(text: str) -> None:
    assert unescape_text(escape_text(text)) == text
    assert "\r" not in escape_text(text)


def test_a_workbook_holds_texts_as_texts_under_a_frozen_header(catalogue: Catalogue, tmp_path: Path) -> None:
    catalogue.add("motors", {"id": "236662", "notes": "=1+1", "rated_power_w": 20, "source_id": SOURCE})
    catalogue.export_file(tmp_path / "m.xlsx", "xlsx", "motors", "id = '236662'")
    book = load_workbook(tmp_path / "m.xlsx")
    assert book.sheetnames == ["motors"]
    sheet = book["motors"]
    assert sheet.freeze_panes == "B2"
    cells = {header.value: cell for header, cell in zip(*sheet.iter_rows(), strict=True)}
    assert (cells["id"].value, cells["id"].data_type, cells["id"].number_format) == ("236662", "s", "@")
    assert (cells["notes"].value, cells["notes"].data_type) == ("=1+1", "s")
    assert (cells["rated_power_w"].value, cells["rated_power_w"].data_type) == (20, "n")
    assert cells["mass_kg"].value is None
    assert sheet.column_dimensions["A"].width >= 25


def test_a_text_that_a_cell_cannot_hold_is_refused_and_the_old_file_stays(catalogue: Catalogue, tmp_path: Path) -> None:
    catalogue.add("motors", {"id": "m", "notes": "x" * 32_768, "source_id": SOURCE})
    (tmp_path / "m.xlsx").write_text("old", encoding="utf-8")
    with pytest.raises(InvalidRows, match=r"motor m, notes: .* 32767 characters.*export CSV or JSON"):
        catalogue.export_file(tmp_path / "m.xlsx", "xlsx", "motors")
    assert (tmp_path / "m.xlsx").read_text(encoding="utf-8") == "old"
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_more_rows_than_a_sheet_holds_are_refused(
    catalogue: Catalogue, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("actuator_select.database.workbook_export.MOST_ROWS", 4)
    with pytest.raises(InvalidRows, match="motors are more than the 4 that a sheet holds"):
        catalogue.export_file(tmp_path / "m.xlsx", "xlsx", "motors")
    assert not (tmp_path / "m.xlsx").exists()


def test_json_uses_the_names_of_opc_40400_1_where_it_has_them(catalogue: Catalogue) -> None:
    catalogue.add(
        "motors",
        {
            "id": "m",
            "manufacturer": "Acme",
            "rated_speed_rpm": 5060,
            "peak_torque_nm": inf,
            "mass_kg": 2,
            "source_id": SOURCE,
        },
    )
    record = json.loads("".join(catalogue.export_pieces("json", "motors", "id = 'm'")))
    assert [key for key in record if key in KINDS] == ["motors"]
    assert record["motors"] == [
        {
            "id": "m",
            "Manufacturer": "Acme",
            "MotorSpeedRated": {"Value": 5060.0, "EngineeringUnits": "rpm"},
            "MotorTorqueMax": {"Value": "unlimited", "EngineeringUnits": "N m"},
            "mass_kg": 2.0,
            "source_id": SOURCE,
        }
    ]


def test_no_kind_has_two_columns_of_one_name_in_json() -> None:
    for kind in KINDS.values():
        names = [opc_name(kind, field.name) for field in kind.fields]
        assert len(set(names)) == len(names)


def test_an_empty_kind_is_an_empty_list_and_a_sheet_with_a_header(catalogue: Catalogue, tmp_path: Path) -> None:
    record = json.loads("".join(catalogue.export_pieces("json", "ropes")))
    assert record["ropes"] == []
    catalogue.export_file(tmp_path / "r.xlsx", "xlsx", "ropes")
    assert read_workbook(tmp_path / "r.xlsx") == {"ropes": []}


def test_a_condition_over_parts_narrows_what_is_exported(catalogue: Catalogue) -> None:
    text = catalogue.export_csv("actuators", where="motor.rated_power_w >= 100")
    assert [line.split(",")[1] for line in text.splitlines()] == ["name", "Actuator 1", "Actuator 2"]


def test_many_rows_are_exported_in_pieces_and_none_is_lost(catalogue: Catalogue, tmp_path: Path) -> None:
    lines = [f"m{number:05},{SOURCE}" for number in range(2345)]
    (tmp_path / "motors.csv").write_text("\n".join(["id,source_id", *lines]), encoding="utf-8")
    catalogue.import_csv(tmp_path / "motors.csv")
    pieces = list(catalogue.export_pieces("csv", "motors"))
    assert len(pieces) > 3
    assert [line.split(",")[0] for line in "".join(pieces).splitlines()[6:]] == [line.split(",")[0] for line in lines]


def test_what_no_file_can_be_made_of_is_refused_before_a_file_is_touched(catalogue: Catalogue, tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="no kind"):
        catalogue.export_file(tmp_path / "f.json", "json", "wheels")
    with pytest.raises(InvalidExpression):
        catalogue.export_file(tmp_path / "f.json", "json", "motors", "weight > 3")
    with pytest.raises(ValueError, match="one kind"):
        catalogue.export_file(tmp_path / "f.csv", "csv")
    with pytest.raises(ValueError, match="name it"):
        catalogue.export_file(tmp_path / "f.json", "json", where="mass_kg > 3")
    with pytest.raises(OutputNotWritable, match="cannot write"):
        catalogue.export_file(tmp_path / "no" / "f.xlsx", "xlsx")
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith((".", "f"))] == []


@pytest.mark.parametrize(("file_format", "kind"), [("csv", "motors"), ("json", None)])
def test_an_export_that_waits_for_its_reader_keeps_nobody_from_writing(
    catalogue: Catalogue, tmp_path: Path, file_format: str, kind: str | None
) -> None:
    before = "".join(catalogue.export_pieces(file_format, kind))
    pieces = catalogue.export_pieces(file_format, kind)
    first = next(pieces)
    with open_catalogue(f"sqlite:///{tmp_path / 'catalogue.db'}?timeout=0.05") as other:
        other.edit("filipovic-kevac-2018-motor-1", {"mass_kg": 3})
    assert first + "".join(pieces) == before
