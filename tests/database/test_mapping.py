"""Somebody else's columns and units, and what is said of a mapping that cannot be used."""

from collections.abc import Callable
from math import inf
from pathlib import Path

import pytest

from actuator_select.database import Catalogue
from actuator_select.database.mapping import load_mapping, read_mapping, shipped_mappings
from actuator_select.errors import InvalidRows, UnknownName

Write = Callable[[str, str], Path]

FOREIGN = """Model;Maker;Torque;kn;J;Weight;Peak;Kind;Colour
A 1/24;Acme;28,3;350;0,00051;0,51;inf;brushless;red
A 2/24;Acme;n/a;;0;0,6;;DC;
"""
MAPPING = """
kind = "motors"
missing = ["n/a"]

[csv]
delimiter = ";"
decimal = ","

[columns]
Model = [{ field = "id", prefix = "acme-", make_id = true }, { field = "part_number" }]
Maker = { field = "manufacturer" }
Torque = { field = "rated_torque_nm", unit = "mNm" }
kn = [
    { field = "speed_constant_rpm_per_v", unit = "rpm/V" },
    { field = "back_emf_constant_v_s_per_rad", unit = "rpm/V", reciprocal = true },
]
J = { field = "rotor_inertia_g_cm2", unit = "oz-in-s²", zero_is_unknown = true }
Weight = { field = "mass_kg", unit = "lb" }
Peak = { field = "peak_torque_nm", unit = "N m", unlimited = ["inf"] }
Kind = { field = "motor_type", values = { brushless = "bldc", DC = "dc_brushed" } }
Colour = { ignore = true }

[constants]
source_id = "$"
notes = "from the list of 2026"
"""


def test_foreign_columns_and_units_become_ours(catalogue: Catalogue, write_csv: Write) -> None:
    (report,) = catalogue.import_file(write_csv("acme.csv", FOREIGN), mapping=write_csv("acme.toml", MAPPING))
    assert (report.kind, report.added) == ("motors", 2)
    first, second = (catalogue.part(row_id)[1] for row_id in ("acme-A-1-24", "acme-A-2-24"))
    assert first["part_number"] == "A 1/24"
    assert first["rated_torque_nm"] == 0.0283
    assert first["speed_constant_rpm_per_v"] == 350.0
    assert first["back_emf_constant_v_s_per_rad"] == pytest.approx(60.0 / (2.0 * 3.141592653589793 * 350.0), rel=1e-14)
    # 1 oz-in-s² = 0.028349523125 kg × 9.80665 m/s² × 0.0254 m × s²
    assert first["rotor_inertia_g_cm2"] == pytest.approx(0.00051 * 0.028349523125 * 9.80665 * 0.0254 * 1e7, rel=1e-14)
    assert first["mass_kg"] == 0.2313321087
    assert (first["peak_torque_nm"], first["motor_type"], first["notes"]) == (inf, "bldc", "from the list of 2026")
    assert [second[name] for name in ("rated_torque_nm", "rotor_inertia_g_cm2", "peak_torque_nm")] == [None] * 3


@pytest.mark.parametrize(
    ("old", "new", "place", "words"),
    [
        ("Acme;28,3", "Acme;28.3", "Torque", "a point was given although the mapping states a decimal comma"),
        ("Acme;28,3", "Acme;-3", "Torque", "-3 mNm was given, which is -0.003 N m"),
        ("Acme;28,3", "Acme;much", "Torque", "leave it empty if it is unknown"),
        ("350;", "0;", "kn", "0 rpm/V is no figure"),
        (";brushless", ";stepper", "Kind", "say in the values of acme.toml what it means"),
        ("A 2/24", "A 1-24", "Model", "remove or rename one"),
    ],
)
def test_a_bad_cell_is_named_as_the_file_spells_it(
    catalogue: Catalogue, write_csv: Write, old: str, new: str, place: str, words: str
) -> None:
    assert old in FOREIGN
    path = write_csv("acme.csv", FOREIGN.replace(old, new))
    with pytest.raises(InvalidRows) as error:
        catalogue.import_file(path, mapping=write_csv("acme.toml", MAPPING))
    told = [str(problem) for problem in error.value.problems]
    assert any(f", {place}: " in one and words in one for one in told), told


def test_a_column_that_the_mapping_does_not_name_is_refused(catalogue: Catalogue, write_csv: Write) -> None:
    mapping = write_csv("acme.toml", MAPPING.replace("Colour", "Color"))
    with pytest.raises(InvalidRows, match=r"line 1: 'Colour', .*\"Colour\" = \{ ignore = true \}"):
        catalogue.import_file(write_csv("acme.csv", FOREIGN), mapping=mapping)


def test_others_can_be_ignored_but_then_every_named_column_has_to_be_there(
    catalogue: Catalogue, write_csv: Write
) -> None:
    text = MAPPING.replace("missing =", "ignore_others = true\nmissing =").replace("Colour = { ignore = true }\n", "")
    path = write_csv("acme.csv", FOREIGN)
    assert catalogue.import_file(path, mapping=write_csv("acme.toml", text), dry_run=True)[0].added == 2
    with pytest.raises(InvalidRows, match="there is no column 'Mass'"):
        catalogue.import_file(path, mapping=write_csv("acme.toml", text.replace("Weight", "Mass")))


ZEROS = ["0", "-0.0", ".0", "0e5", "0e9999999999999999999"]


@pytest.mark.parametrize("cell", [*ZEROS, "1e9999999999999999999", "1e-9999999999999999999"])
def test_only_zero_is_unknown_whatever_its_exponent(catalogue: Catalogue, write_csv: Write, cell: str) -> None:
    mapping = 'kind = "motors"\n[columns]\nid = { field = "id" }\n'
    mapping += 'J = { field = "rotor_inertia_g_cm2", unit = "kg m²", zero_is_unknown = true }\n'
    files = write_csv("list.csv", f"id,J\nm,{cell}\n"), write_csv("own.toml", mapping)
    if cell == "1e9999999999999999999":
        with pytest.raises(InvalidRows, match="is no figure"):
            catalogue.import_file(files[0], mapping=files[1], source="filipovic-kevac-2018")
        return
    catalogue.import_file(files[0], mapping=files[1], source="filipovic-kevac-2018")
    assert catalogue.part("m")[1]["rotor_inertia_g_cm2"] == (None if cell in ZEROS else 0.0)


def test_an_unknown_constant_source_is_told_once(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("acme.csv", FOREIGN)
    with pytest.raises(InvalidRows) as error:
        catalogue.import_file(path, mapping=write_csv("acme.toml", MAPPING.replace('"$"', '"nowhere"')))
    (problem,) = error.value.problems
    assert problem.place == "acme.toml, constants.source_id"


def test_a_source_can_be_stated_for_the_whole_file(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("motors.csv", "id,rated_power_w\na,1\n")
    catalogue.import_file(path, source="filipovic-kevac-2018")
    assert catalogue.part("a")[1]["source_id"] == "filipovic-kevac-2018"
    path = write_csv("motors.csv", "id,source_id\nb,$\n")
    with pytest.raises(InvalidRows, match="--source: 'filipovic-kevac-2018', expected a field that no column"):
        catalogue.import_file(path, source="filipovic-kevac-2018")


COLUMN = "columns.x"


@pytest.mark.parametrize(
    ("content", "place", "words"),
    [
        ({}, "own.toml, kind", 'such as kind = "motors"'),
        ({"kind": "motrs"}, "own.toml, kind", "did you mean 'motors'"),
        ({"kind": "motors", "colums": {}}, "own.toml, colums", "did you mean 'columns'"),
        ({"kind": "motors", "columns": {"x": {"feld": "mass_kg"}}}, f"own.toml, {COLUMN}.feld", "did you mean 'field'"),
        ({"kind": "motors", "columns": {"x": {"field": "mas_kg"}}}, f"own.toml, {COLUMN}.field", "did you mean"),
        ({"kind": "motors", "columns": {"x": {}}}, f"own.toml, {COLUMN}.field", "a column of motors"),
        (
            {"kind": "motors", "columns": {"x": {"field": "mass_kg"}}},
            f"own.toml, {COLUMN}.unit",
            "mass_kg is in kg",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "mass_kg", "unit": "mNm"}}},
            f"own.toml, {COLUMN}.unit",
            "does not measure what kg measures",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "back_emf_constant_v_s_per_rad", "unit": "rpm/V"}}},
            f"own.toml, {COLUMN}.unit",
            "reciprocal = true",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "mass_kg", "unit": "stone-ish"}}},
            f"own.toml, {COLUMN}.unit",
            "is no known unit",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "notes", "unit": "kg"}}},
            f"own.toml, {COLUMN}.unit",
            "is a text",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "mass_kg", "unit": "kg", "unlimited": ["inf"]}}},
            f"own.toml, {COLUMN}.unlimited",
            "cannot be unlimited",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "motor_type", "values": {"DC": "dc"}}}},
            f"own.toml, {COLUMN}.values.DC",
            "one of dc_brushed",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "id"}, "y": {"field": "id"}}},
            "own.toml, columns.y.field",
            "'x' fills it already",
        ),
        (
            {"kind": "motors", "columns": {"x": {"field": "id"}}, "constants": {"id": "a"}},
            "own.toml, constants.id",
            "a field that no column fills",
        ),
        ({"kind": "motors", "constants": {"mass_kg": -1}}, "own.toml, constants.mass_kg", "more than 0 [kg]"),
        ({"kind": "motors", "csv": {"decimal": ";"}}, "own.toml, csv.decimal", "'.' or ','"),
        ({"kind": "motors", "csv": {"encoding": "utf-9"}}, "own.toml, csv.encoding", "cp1252"),
        (
            {"kind": "motors", "csv": {"delimiter": ",", "decimal": ","}},
            "own.toml, csv.delimiter",
            "another character than the decimal comma",
        ),
        (
            {"kind": "motors", "constants": {"rated_torque_nm": 0.5, "nominal_torque_nm": 0.6}},
            "own.toml, constants.nominal_torque_nm",
            "each field once; 'rated_torque_nm' fills it already",
        ),
        (
            {"kind": "motors", "id_from": "{part_number}", "constants": {"id": "a"}},
            "own.toml, id_from",
            "no other column or constant that fills id",
        ),
        ({"kind": "motors", "id_from": "{notes}-{weight}"}, "own.toml, id_from", "'weight'"),
    ],
)
def test_a_mapping_that_cannot_be_used_is_explained(content: dict[str, object], place: str, words: str) -> None:
    with pytest.raises(InvalidRows) as error:
        read_mapping(content, "own.toml")
    (problem,) = error.value.problems
    assert problem.place == place
    assert words in str(problem)


def test_a_mapping_that_is_not_there_or_no_toml_is_explained(tmp_path: Path) -> None:
    with pytest.raises(InvalidRows, match="cannot read the mapping"):
        load_mapping(tmp_path / "none.toml")
    (tmp_path / "bad.toml").write_text("kind = ")
    with pytest.raises(InvalidRows, match="is no TOML"):
        load_mapping(tmp_path / "bad.toml")
    with pytest.raises(UnknownName, match="did you mean 'mgdb-motors'"):
        load_mapping("mgdb-motor")


def test_the_shipped_mappings_can_be_used() -> None:
    names = list(shipped_mappings())
    assert names == ["mgdb-compatibility", "mgdb-gearboxes", "mgdb-motors"]
    assert [load_mapping(name).kind for name in names] == ["compatibilities", "gearboxes", "motors"]


MGDB_MOTORS = """key,manufacturer,ID,type,V,k_t,k_e,R,L,mass,inertia,diameter,length,omega_nl,I_nl,I_nom,\
max_int_torque,max_int_speed,max_cont_speed,max_cont_power,coulomb_friction,viscous_friction,Rth1,Rth2
inv_1,Invented,1,DC,24,0.03,0.03,1.5,0.0004,0.25,1e-05,0.03,0.07,800,0.05,2.5,inf,1000,900,60,0.001,nan,2.5,nan
inv_2,Invented,2,BLDC,48,0.05,,0.4,,0,0,,,950,0.2,5,1.5,inf,inf,inf,nan,1e-06,1,4
"""


def test_the_layout_of_mgdb_motors_is_understood(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("invented_motors.csv", MGDB_MOTORS)
    catalogue.import_file(path, mapping="mgdb-motors", source="filipovic-kevac-2018")
    one, other = (catalogue.part(row_id, "motors")[1] for row_id in ("inv_1", "inv_2"))
    assert (one["motor_type"], one["electrical_convention"]) == ("dc_brushed", "dc_terminal")
    assert (other["motor_type"], other["electrical_convention"]) == ("bldc", "dc_phase_to_phase")
    assert (one["terminal_inductance_mh"], one["rotor_inertia_g_cm2"], one["diameter_mm"]) == (0.4, 100.0, 30.0)
    assert one["no_load_speed_rpm"] == pytest.approx(800 * 60 / (2 * 3.141592653589793), rel=1e-14)
    assert (one["peak_torque_nm"], other["max_speed_rpm"]) == (None, None)
    assert (other["mass_kg"], other["rotor_inertia_g_cm2"], other["back_emf_constant_v_s_per_rad"]) == (None,) * 3
    without = "\n".join(",".join(line.split(",")[:6] + line.split(",")[7:]) for line in MGDB_MOTORS.splitlines())
    catalogue.import_file(write_csv("others.csv", without.replace("inv_", "no_ke_")), mapping="mgdb-motors",
                          source="filipovic-kevac-2018")  # fmt: skip


def test_the_layout_of_mgdb_gearboxes_is_understood(catalogue: Catalogue, write_csv: Write) -> None:
    text = (
        "key,manufacturer,ID,type,stages,ratio,mass,inertia,efficiency,direction,max_int_torque,max_cont_torque\n"
        "g_1,Invented,1,planetary,2,23.04,0.18,1e-07,0.81,1,3.4,2.25\n"
    )
    catalogue.import_file(write_csv("invented.csv", text), mapping="mgdb-gearboxes", source="filipovic-kevac-2018")
    row = catalogue.part("g_1")[1]
    assert (row["ratio"], row["max_efficiency_percent"], row["inertia_input_g_cm2"]) == (23.04, 81.0, 1.0)
    assert (row["max_intermittent_torque_nm"], row["max_continuous_torque_nm"]) == (3.4, 2.25)
    assert row["efficiency_percent"] is None


def test_the_layout_of_mgdb_compatibility_is_understood(catalogue: Catalogue, write_csv: Write) -> None:
    long = "L" * 70
    text = f"IN_22,GI_26_1R_R*,GI_30_1S\nIN_24,GI_22\n{long},G{long}\n"
    path = write_csv("compatibility.csv", text)
    catalogue.import_file(path, mapping="mgdb-compatibility", source="filipovic-kevac-2018")
    rows = {str(row["id"]): (row["motor_pattern"], row["gearbox_pattern"]) for row in catalogue.rows("compatibilities")}
    assert rows["IN_22--GI_26_1R_R-"] == ("IN_22", "GI_26_1R_R*")
    assert rows["IN_22--GI_30_1S"] == ("IN_22", "GI_30_1S")
    assert rows["IN_24--GI_22"] == ("IN_24", "GI_22")
    assert len(rows) == 4
    assert max(len(row_id) for row_id in rows) == 100


def test_pairs_that_would_get_the_same_id_are_refused(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("compatibility.csv", "IN_22,GI_1,GI_2\nIN_22,GI_1\n")
    with pytest.raises(InvalidRows, match=r"line 2, id: 'IN_22--GI_1', expected another id than"):
        catalogue.import_file(path, mapping="mgdb-compatibility", source="filipovic-kevac-2018")


def test_a_kind_that_is_not_the_mappings_is_refused(catalogue: Catalogue, write_csv: Write) -> None:
    with pytest.raises(UnknownName, match=r"mgdb-motors\.toml is for motors, not gearboxes"):
        catalogue.import_file(write_csv("m.csv", MGDB_MOTORS), "gearboxes", mapping="mgdb-motors", source="x")


def test_a_list_in_another_encoding_is_read_as_the_mapping_says(catalogue: Catalogue, tmp_path: Path) -> None:
    (tmp_path / "list.csv").write_bytes("Name\tHersteller\nm1\tStöber\n".encode("cp1252"))
    text = 'kind = "motor"\n[csv]\ndelimiter = "\\t"\nencoding = "{}"\n[columns]\nName = {{ field = "id" }}\n'
    text += 'Hersteller = {{ field = "manufacturer" }}\n[constants]\naccessed_date = 2026-11-03\n'
    (tmp_path / "list.toml").write_text(text.format("utf-8"))
    with pytest.raises(InvalidRows, match=r"not UTF-8: byte 21 \(line 2\) is 0xF6"):
        catalogue.import_file(tmp_path / "list.csv", mapping=tmp_path / "list.toml", source="filipovic-kevac-2018")
    (tmp_path / "list.toml").write_text(text.format("cp1252"))
    catalogue.import_file(tmp_path / "list.csv", mapping=tmp_path / "list.toml", source="filipovic-kevac-2018")
    row = catalogue.part("m1")[1]
    assert (row["manufacturer"], row["accessed_date"]) == ("Stöber", "2026-11-03")


def test_a_torn_line_is_told_by_the_sign_that_separates_the_cells(catalogue: Catalogue, write_csv: Write) -> None:
    mapping = write_csv("own.toml", 'kind = "motors"\n[csv]\ndelimiter = ";"\n')
    with pytest.raises(InvalidRows, match=r"line 2: 3 cells, .*is a semicolon missing or too many"):
        catalogue.import_file(write_csv("list.csv", "id;source_id\na;b;c\n"), mapping=mapping)


@pytest.mark.parametrize(
    ("constants", "words"),
    [({"notes": ["a"]}, "own.toml, constants.notes: .*a text or a number"), ({"rated_power": 1}, "did you mean")],
)
def test_a_constant_that_cannot_stand_is_explained(constants: dict[str, object], words: str) -> None:
    with pytest.raises(InvalidRows, match=words):
        read_mapping({"kind": "motors", "constants": constants}, "own.toml")


def test_a_text_alone_names_the_field() -> None:
    mapping = read_mapping({"kind": "motors", "columns": {"Type": "id", "No": ["part_number", "notes"]}}, "own.toml")
    assert [one.field for fillings in mapping.columns.values() for one in fillings] == ["id", "part_number", "notes"]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ({"columns": 5}, "own.toml, columns: '5', expected a table"),
        ({"columns": {"x": 5}}, "own.toml, columns.x: '5', expected a table"),
        ({"csv": {"delimiter": ";;"}}, "own.toml, csv.delimiter: ';;', expected one character"),
        ({"missing": "n/a"}, "own.toml, missing: 'n/a', expected a list such as"),
        ({"columns": {"x": {"field": "id", "make_id": 1}}}, "columns.x.make_id: '1', expected true or false"),
    ],
)
def test_what_is_formed_wrongly_is_told_in_the_words_of_toml(content: dict[str, object], words: str) -> None:
    with pytest.raises(InvalidRows) as error:
        read_mapping({"kind": "motors"} | content, "own.toml")
    (problem,) = error.value.problems
    assert words in str(problem)


def test_every_problem_of_a_mapping_is_told_in_one_round() -> None:
    columns = {"x": {"field": "mass_kg", "unit": 5}, "y": {"field": "mas_kg"}, "z": {"field": "mass_kg", "unit": "s"}}
    content = {"kind": "motors", "colums": 1, "columns": columns, "csv": {"delimiter": ";;", "encoding": "utf-9"}}
    with pytest.raises(InvalidRows) as error:
        read_mapping(content, "own.toml")
    assert {one.place.removeprefix("own.toml, ") for one in error.value.problems} == {
        "colums", "columns.x.unit", "columns.y.field", "columns.z.unit", "csv.delimiter", "csv.encoding"
    }  # fmt: skip


def test_without_a_source_the_remedy_is_to_state_one(catalogue: Catalogue, write_csv: Write) -> None:
    with pytest.raises(
        InvalidRows, match=r"'source_id'.*; state --source ID for all rows; `actuator-select catalog add"
    ):
        catalogue.import_file(write_csv("m.csv", MGDB_MOTORS), mapping="mgdb-motors")
    with pytest.raises(InvalidRows, match=r"'source_id'.*; add the column, or state --source ID"):
        catalogue.import_file(write_csv("motors.csv", "id\nm1\n"))


def test_a_word_that_a_shipped_mapping_lacks_is_told_once_with_the_way_to_a_copy(
    catalogue: Catalogue, write_csv: Write
) -> None:
    text = MGDB_MOTORS.replace("BLDC", "stepper")
    assert text != MGDB_MOTORS
    with pytest.raises(InvalidRows) as error:
        catalogue.import_file(write_csv("m.csv", text), mapping="mgdb-motors", source="filipovic-kevac-2018")
    told = [str(one) for one in error.value.problems if "'stepper'" in str(one)]
    assert len(told) == text.count("stepper")
    assert "catalog import --show-mapping mgdb-motors > own.toml" in told[0]


def test_a_file_with_names_of_columns_is_no_list_of_pairs(catalogue: Catalogue, write_csv: Write) -> None:
    with pytest.raises(InvalidRows, match="line 1: the name of a column, 'key', expected a key and those"):
        catalogue.import_file(
            write_csv("m.csv", MGDB_MOTORS), mapping="mgdb-compatibility", source="filipovic-kevac-2018"
        )


def test_lines_of_a_key_alone_are_counted(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("compatibility.csv", "IN_1,GI_1\nIN_2\nIN_3,,\n")
    (report,) = catalogue.import_file(path, mapping="mgdb-compatibility", source="filipovic-kevac-2018")
    words = "passed over: 2 lines of compatibility.csv with a key and nothing that belongs to it"
    assert (report.added, report.notices) == (1, (words,))


def test_patterns_that_differ_only_in_what_an_id_cannot_hold_are_explained(
    catalogue: Catalogue, write_csv: Write
) -> None:
    path = write_csv("compatibility.csv", "IN_1,GI*,GI-\n")
    with pytest.raises(InvalidRows, match=r"made as \{motor_pattern\}--\{gearbox_pattern\}, with a hyphen"):
        catalogue.import_file(path, mapping="mgdb-compatibility", source="filipovic-kevac-2018")
