"""The catalogue from Python."""

import shutil
from math import inf, isnan
from pathlib import Path

import pytest

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.kinds import ACTUATORS, KINDS, ROLES
from actuator_select.errors import InvalidRows, UnknownName

SOURCE = "filipovic-kevac-2018"
MOTOR = {"id": "m", "rated_power_w": 150, "rated_torque_nm": "0.5", "max_speed_rpm": "unlimited", "source_id": SOURCE}
NEW_SOURCE = {"document": "Acme catalogue", "url": "https://acme.example/m.pdf", "date": "2024-05"}


def test_rows_are_plain_dicts_in_the_order_of_their_ids(catalogue: Catalogue) -> None:
    rows = catalogue.rows("motors")
    assert [row["id"] for row in rows] == sorted(str(row["id"]) for row in rows)
    assert list(rows[0]) == [field.name for field in KINDS["motors"].columns]
    assert {type(value) for row in rows for value in row.values()} == {str, float, type(None)}


def test_actuators_come_with_the_columns_of_their_parts(catalogue: Catalogue) -> None:
    expected = [field.name for field in ACTUATORS.columns]
    expected += [f"{role}.{field.name}" for role, kind in ROLES.items() for field in kind.columns]
    assert list(catalogue.rows("actuators")[0]) == expected


def test_an_actuator_without_a_gearbox_is_listed(catalogue: Catalogue) -> None:
    parts = {"motor_id": "filipovic-kevac-2018-motor-1", "winch_id": "filipovic-kevac-2018-winch"}
    catalogue.add("actuators", {"id": "direct", "name": "Direct", **parts, "source_id": SOURCE})
    (row,) = catalogue.rows("actuators", where="name = 'Direct'")
    assert (row["gearbox_id"], row["gearbox.ratio"]) == (None, None)
    assert row["motor.rated_power_w"] == 300.0


def test_a_frame_has_numbers_where_there_are_numbers(catalogue: Catalogue) -> None:
    catalogue.add("motors", MOTOR)
    frame = catalogue.frame("motors", where="origin = 'user'", sort="id")
    assert frame["rated_power_w"].tolist() == [150.0]
    assert frame["max_speed_rpm"].tolist() == [inf]
    assert isnan(frame["mass_kg"].iloc[0])
    assert catalogue.frame("ropes")["diameter_mm"].dtype == float


def test_a_part_is_found_by_id_and_an_actuator_by_name(catalogue: Catalogue) -> None:
    assert catalogue.part("filipovic-kevac-2018-motor-4")[0] == "motors"
    kind, row = catalogue.part("Actuator 4")
    assert (kind, row["id"], row["motor.rated_power_w"]) == ("actuators", "filipovic-kevac-2018-4", 20.0)
    assert catalogue.source(SOURCE)["doi"] == "10.22190/FUACR1802071F"


def test_a_part_that_does_not_exist_is_suggested(catalogue: Catalogue) -> None:
    with pytest.raises(UnknownName, match="did you mean 'Actuator 4'"):
        catalogue.part("Actuator4")
    with pytest.raises(UnknownName, match="in motors"):
        catalogue.part("Actuator 4", "motors")


def test_an_id_of_several_kinds_asks_for_the_kind(catalogue: Catalogue) -> None:
    catalogue.add("motors", MOTOR)
    catalogue.add("gearboxes", {"id": "m", "ratio": 3, "source_id": SOURCE})
    with pytest.raises(UnknownName, match="'m' is in motors, gearboxes; state which with --kind"):
        catalogue.part("m")
    assert catalogue.part("m", "gearbox")[1]["ratio"] == 3.0


def test_an_unknown_kind_is_suggested(catalogue: Catalogue) -> None:
    with pytest.raises(UnknownName, match="did you mean 'motors'"):
        catalogue.rows("motor s")


def test_a_row_is_added_and_given_back(catalogue: Catalogue) -> None:
    row = catalogue.add("motors", MOTOR)
    assert (row["rated_power_w"], row["rated_torque_nm"], row["max_speed_rpm"]) == (150.0, 0.5, inf)
    assert (row["mass_kg"], row["origin"]) == (None, "user")
    assert catalogue.part("m")[1] == row


def test_a_row_and_its_source_are_added_together(catalogue: Catalogue) -> None:
    row = catalogue.add("motors", {"id": "m", "rated_power_w": 1}, NEW_SOURCE)
    assert row["source_id"] == "acme-catalogue-2024-05"
    assert catalogue.source("acme-catalogue-2024-05")["document"] == "Acme catalogue"


def test_a_refused_row_does_not_leave_its_source_behind(catalogue: Catalogue) -> None:
    with pytest.raises(InvalidRows, match="rated_power_w: '-1', expected"):
        catalogue.add("motors", {"id": "m", "rated_power_w": -1}, NEW_SOURCE)
    assert catalogue.count("sources") == 1


@pytest.mark.parametrize(
    ("values", "source", "told"),
    [
        ({"id": "m", "watts": 3, "source_id": SOURCE}, None, ["watts: '3', expected a column of motors"]),
        ({"id": "m"}, None, ["source_id: empty"]),
        ({"source_id": SOURCE}, None, ["id: empty"]),
        ({"id": "m", "rated_power_w": 0.0, "mass_kg": "x"}, None, ["rated_power_w", "mass_kg", "source_id"]),
        ({"id": "m"}, {"document": "D"}, ["source.page: empty, expected at least one of", "source.date: empty"]),
        ({"id": "m"}, {"url": "acme"}, ["source.url: 'acme'", "source.document: empty", "source.date: empty"]),
        ({"id": "filipovic-kevac-2018-motor-1", "source_id": SOURCE}, None, ["id: 'filipovic-kevac-2018-motor-1'"]),
    ],
)
def test_everything_that_is_wrong_with_a_row_is_told(
    catalogue: Catalogue, values: dict[str, object], source: dict[str, object] | None, told: list[str]
) -> None:
    before = catalogue.fingerprint()
    with pytest.raises(InvalidRows) as error:
        catalogue.add("motors", values, source)
    problems = [str(problem) for problem in error.value.problems]
    assert len(problems) == len(told)
    assert all(problem.startswith(start) for problem, start in zip(problems, told, strict=True)), problems
    assert catalogue.fingerprint() == before


def test_the_fingerprint_is_of_the_content_alone(catalogue: Catalogue, template: Path, tmp_path: Path) -> None:
    with open_catalogue(":memory:") as one, open_catalogue(tmp_path / "new.db") as other:
        assert one.fingerprint() == other.fingerprint()
    first = catalogue.fingerprint()
    catalogue.add("motors", MOTOR)
    catalogue.add("motors", MOTOR | {"id": "n"})
    with open_catalogue(shutil.copy(template, tmp_path / "other.db")) as other:
        other.add("motors", MOTOR | {"id": "n"})
        assert other.fingerprint() not in {first, catalogue.fingerprint()}
        other.add("motors", MOTOR)
        assert other.fingerprint() == catalogue.fingerprint()
