"""The shipped rows: Table 1 as printed, and what a newer set of rows does to a database that is in use."""

import shutil
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

from actuator_select._resources import shipped_dir
from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.connection import writing
from actuator_select.database.kinds import KINDS
from actuator_select.database.queries import delete_rows
from actuator_select.errors import InvalidRows

# Table 1 of M. Filipović, Lj. B. Kevac, Facta Universitatis, Series: Automatic Control and Robotics 17(2), 2018,
# doi 10.22190/FUACR1802071F. [W, V, rpm, N m, V s/rad, N m/A, N m s/rad, Ω, g cm², 1, %, mm]
TABLE_1_COLUMNS = (
    "motor.rated_power_w",
    "motor.nominal_voltage_v",
    "motor.rated_speed_rpm",
    "motor.rated_torque_nm",
    "motor.back_emf_constant_v_s_per_rad",
    "motor.torque_constant_nm_per_a",
    "motor.viscous_friction_nm_s_per_rad",
    "motor.terminal_resistance_ohm",
    "motor.rotor_inertia_g_cm2",
    "gearbox.ratio",
    "efficiency_percent",
    "winch.drum_radius_mm",
)
TABLE_1 = {
    "Actuator 1": (300, 48, 4700, 0.6, 0.0945, 0.095, 0, 0.369, 3579, 30, 60, 80),
    "Actuator 2": (100, 48, 3970, 0.319, 0.1145, 0.114, 0, 1.1, 1210, 25, 70, 80),
    "Actuator 3": (50, 24, 4500, 0.131, 0.0356, 0.0357, 0, 0.567, 181, 26, 70, 80),
    "Actuator 4": (20, 24, 5060, 0.212, 0.0352, 0.0352, 0, 3.99, 45.3, 30, 70, 80),
    "Actuator 5": (10, 18, 4777, 0.03, 0.029, 0.0299, 0, 3.01, 9.26, 26, 70, 80),
}

MOTOR = "filipovic-kevac-2018-motor-1"
ACTUATOR = "filipovic-kevac-2018-1"

PARTS = {"motors": 145, "gearboxes": 230, "ropes": 54}  # beside those of Table 1
TWINS = {
    "filipovic-kevac-2018-4": "filipovic-kevac-2018-4-maxon-236662",
    "filipovic-kevac-2018-5": "filipovic-kevac-2018-5-maxon-DCX22L01EBSL596",
}

Edit = Callable[[str, str, str], None]


@pytest.fixture
def catalogue() -> Iterator[Catalogue]:
    """Everything that is shipped."""
    with open_catalogue(":memory:") as opened:
        yield opened


def test_the_shipped_actuators_are_table_1_as_printed_and_two_twins(catalogue: Catalogue) -> None:
    rows = [row for row in catalogue.rows("actuators") if row["id"] not in TWINS.values()]
    assert {row["name"]: tuple(row[column] for column in TABLE_1_COLUMNS) for row in rows} == TABLE_1
    assert catalogue.count("actuators") == len(TABLE_1) + len(TWINS)


@pytest.mark.parametrize(("printed", "twin"), TWINS.items())
def test_a_twin_differs_from_the_printed_row_in_its_motor_alone(catalogue: Catalogue, printed: str, twin: str) -> None:
    one, other = catalogue.part(printed)[1], catalogue.part(twin)[1]
    for column in ("gearbox_id", "winch_id", "efficiency_percent", "source_id"):
        assert one[column] == other[column]
    assert other["motor_id"] == twin.replace(f"{printed}-", "")
    # What identifies the motor.
    for column in ("terminal_resistance_ohm", "torque_constant_nm_per_a", "rotor_inertia_g_cm2", "nominal_voltage_v"):
        assert one[f"motor.{column}"] == other[f"motor.{column}"]
    assert one["motor.rated_speed_rpm"] == pytest.approx(other["motor.rated_speed_rpm"], rel=2e-3)


def test_the_shipped_rows_are_as_many_as_they_were_read(catalogue: Catalogue) -> None:
    own = {kind: sum(row["source_id"] != "filipovic-kevac-2018" for row in catalogue.rows(kind)) for kind in PARTS}
    assert own == PARTS


def test_a_calculated_sheet_says_so(catalogue: Catalogue) -> None:
    calculated = [row for row in catalogue.rows("motors") if row["provenance"] == "manufacturer_calculation"]
    assert {row["manufacturer"] for row in calculated} == {"Magmotor"}
    assert len(calculated) == 23
    assert all("Calculated sheet" in row["notes"] for row in calculated)


def test_no_shipped_efficiency_is_a_maximum_in_disguise(catalogue: Catalogue) -> None:
    rows = catalogue.rows("gearboxes")
    assert sum(row["max_efficiency_percent"] is not None for row in rows) == 223
    assert not any(row["efficiency_percent"] is not None for row in rows)


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "sources"])
def test_every_shipped_row_states_source_and_origin(catalogue: Catalogue, kind: str) -> None:
    for row in catalogue.rows(kind):
        assert catalogue.source(str(row["source_id"]))["document"]
        assert row["source_location"]
        assert row["origin"] == "shipped"


def test_the_shipped_files_are_as_the_program_writes_them(catalogue: Catalogue) -> None:
    for kind in KINDS:
        assert (shipped_dir("catalog") / f"{kind}.csv").read_text(encoding="utf-8") == catalogue.export_csv(kind)


@pytest.fixture
def shipped_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """What the next version ships: a copy of what this one does, to be edited."""
    folder = tmp_path / "catalog"
    shutil.copytree(shipped_dir("catalog"), folder)
    monkeypatch.setattr("actuator_select.database.shipped.shipped_dir", lambda _: folder)
    return folder


@pytest.fixture
def edit(shipped_folder: Path) -> Edit:
    """Replace a text in a shipped file."""

    def replace(kind: str, old: str, new: str) -> None:
        path = shipped_folder / f"{kind}.csv"
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new), encoding="utf-8")

    return replace


@pytest.fixture
def database(tmp_path: Path, shipped_folder: Path) -> Path:
    assert shipped_folder.is_dir()
    path = tmp_path / "catalogue.db"
    open_catalogue(path).close()
    return path


def user_edits(path: Path, tmp_path: Path, kind: str, cells: Mapping[str, str]) -> None:
    file = tmp_path / "edit.csv"
    file.write_text(f"{','.join(cells)}\n{','.join(cells.values())}\n")
    with open_catalogue(path) as catalogue:
        catalogue.import_csv(file, kind, update=True)


def user_deletes(path: Path, kind: str, row_id: str) -> None:
    with open_catalogue(path) as catalogue, writing(catalogue._engine) as connection:  # noqa: SLF001
        delete_rows(connection, KINDS[kind], [row_id])


def test_a_row_that_nobody_edited_is_renewed(database: Path, edit: Edit) -> None:
    edit("motors", "300,48,,,4700", "310,48,,,4700")
    with open_catalogue(database) as catalogue:
        assert catalogue.part(MOTOR)[1]["rated_power_w"] == 310.0
        assert catalogue.notices == ("The shipped catalogue rows were refreshed: 1 renewed.",)
    with open_catalogue(database) as catalogue:
        assert catalogue.notices == ()


def test_an_edited_row_is_kept_and_told(database: Path, edit: Edit, tmp_path: Path) -> None:
    user_edits(database, tmp_path, "motors", {"id": MOTOR, "rated_power_w": "295"})
    edit("motors", "300,48,,,4700", "310,48,,,4700")
    with open_catalogue(database) as catalogue:
        row = catalogue.part(MOTOR)[1]
        assert (row["rated_power_w"], row["origin"]) == (295.0, "user")
        assert catalogue.notices == (
            f"Catalogue rows kept as edited, although the program ships other figures: motor {MOTOR}.",
        )


def test_an_edit_that_is_undone_follows_the_program_again(database: Path, edit: Edit, tmp_path: Path) -> None:
    user_edits(database, tmp_path, "motors", {"id": MOTOR, "rated_power_w": "295"})
    user_edits(database, tmp_path, "motors", {"id": MOTOR, "rated_power_w": "300"})
    edit("motors", "300,48,,,4700", "310,48,,,4700")
    with open_catalogue(database) as catalogue:
        row = catalogue.part(MOTOR)[1]
        assert (row["rated_power_w"], row["origin"]) == (310.0, "shipped")


def test_an_edit_that_the_program_ships_later_becomes_shipped(database: Path, edit: Edit, tmp_path: Path) -> None:
    user_edits(database, tmp_path, "motors", {"id": MOTOR, "rated_power_w": "310"})
    edit("motors", "300,48,,,4700", "310,48,,,4700")
    with open_catalogue(database) as catalogue:
        assert catalogue.part(MOTOR)[1]["origin"] == "shipped"


def test_new_rows_are_added(database: Path, edit: Edit) -> None:
    edit("winches", "\nfilipovic-kevac-2018-winch,", "\nbigger,,,,90" + "," * 33 + "\nfilipovic-kevac-2018-winch,")
    edit("winches", "bigger,,,,90" + "," * 33, "bigger,,,,90" + "," * 27 + ",filipovic-kevac-2018,,,,")
    with open_catalogue(database) as catalogue:
        assert catalogue.part("bigger")[1]["drum_radius_mm"] == 90.0
        assert "1 added" in catalogue.notices[0]


def test_a_row_that_the_user_deleted_does_not_come_back(database: Path, edit: Edit) -> None:
    user_deletes(database, "actuators", ACTUATOR)
    edit("actuators", "Actuator 1,", "Actuator One,")
    with open_catalogue(database) as catalogue:
        assert catalogue.count("actuators") == len(TABLE_1) + len(TWINS) - 1
        assert catalogue.notices == (
            f"Catalogue rows not brought back, because they were deleted: actuator {ACTUATOR}.",
        )


def test_a_users_own_row_of_the_same_id_is_kept(database: Path, edit: Edit) -> None:
    with open_catalogue(database) as catalogue:
        catalogue.add("gearboxes", {"id": "new-gearbox", "ratio": 5, "source_id": "filipovic-kevac-2018"})
    edit("gearboxes", "filipovic-kevac-2018-gearbox-25", "new-gearbox")
    edit("actuators", "filipovic-kevac-2018-gearbox-25", "filipovic-kevac-2018-gearbox-26")
    with open_catalogue(database) as catalogue:
        row = catalogue.part("new-gearbox")[1]
        assert (row["ratio"], row["origin"]) == (5.0, "user")
        assert any("kept as you made them" in notice and "new-gearbox" in notice for notice in catalogue.notices)


def test_rows_that_are_no_longer_shipped_go(database: Path, shipped_folder: Path) -> None:
    remove_line(shipped_folder / "actuators.csv", ACTUATOR)
    remove_line(shipped_folder / "motors.csv", MOTOR)
    with open_catalogue(database) as catalogue:
        assert not {ACTUATOR, MOTOR} & {row["id"] for kind in ("actuators", "motors") for row in catalogue.rows(kind)}
        assert catalogue.notices == ("The shipped catalogue rows were refreshed: 2 removed.",)


def test_a_row_that_is_no_longer_shipped_stays_while_a_users_row_needs_it(database: Path, shipped_folder: Path) -> None:
    with open_catalogue(database) as catalogue:
        own = {"id": "mine", "name": "Mine", "motor_id": MOTOR, "winch_id": "filipovic-kevac-2018-winch"}
        catalogue.add("actuators", {**own, "source_id": "filipovic-kevac-2018"})
    remove_line(shipped_folder / "actuators.csv", ACTUATOR)
    remove_line(shipped_folder / "motors.csv", MOTOR)
    with open_catalogue(database) as catalogue:
        assert catalogue.part(MOTOR)[1]["rated_power_w"] == 300.0
        assert f"kept because other rows refer to them: motor {MOTOR}" in catalogue.notices[1]


def test_an_edited_row_that_is_no_longer_shipped_becomes_the_users(
    database: Path, shipped_folder: Path, tmp_path: Path
) -> None:
    user_edits(database, tmp_path, "actuators", {"id": ACTUATOR, "name": "My favourite"})
    remove_line(shipped_folder / "actuators.csv", ACTUATOR)
    with open_catalogue(database) as catalogue:
        assert catalogue.part(ACTUATOR)[1]["origin"] == "user"
        assert "kept because they were edited" in catalogue.notices[0]


def test_a_shipped_row_whose_name_is_taken_does_not_stop_the_others(database: Path, edit: Edit, tmp_path: Path) -> None:
    user_edits(database, tmp_path, "actuators", {"id": ACTUATOR, "name": "Actuator Two"})
    edit("actuators", "Actuator 2,", "Actuator Two,")
    edit("motors", "100,48,,,3970", "110,48,,,3970")
    with open_catalogue(database) as catalogue:
        assert catalogue.part("filipovic-kevac-2018-2")[1]["name"] == "Actuator 2"
        assert catalogue.part("filipovic-kevac-2018-motor-2")[1]["rated_power_w"] == 110.0
        assert any("not taken over" in notice for notice in catalogue.notices)


def test_faulty_shipped_rows_change_nothing(database: Path, edit: Edit) -> None:
    edit("motors", "300,48,,,4700", "-300,48,,,4700")
    with pytest.raises(InvalidRows, match=r"motors\.csv, line \d+, rated_power_w"):
        open_catalogue(database)


def remove_line(path: Path, row_id: str) -> None:
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith(f"{row_id},")]
    assert len(kept) == len(lines) - 1
    path.write_text("".join(kept), encoding="utf-8")
