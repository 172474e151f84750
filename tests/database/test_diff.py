"""Comparing two catalogues, of which the other one is only read."""

import shutil
import sqlite3
from collections.abc import Iterator
from math import inf
from pathlib import Path

import pytest

from actuator_select.database import Catalogue, compare, migration, open_catalogue, open_for_reading, snapshot
from actuator_select.database.comparing import KindComparison
from actuator_select.database.connection import database_url, make_engine, writing
from actuator_select.database.kinds import KINDS
from actuator_select.errors import CatalogueUnavailable, UnknownName

SOURCE = "filipovic-kevac-2018"
MOTOR = "filipovic-kevac-2018-motor-1"


@pytest.fixture
def other_file(template: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(template, tmp_path / "other's file #1.db"))


@pytest.fixture
def other(other_file: Path) -> Iterator[Catalogue]:
    with open_catalogue(other_file) as opened:
        yield opened


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def compared(here: Catalogue, file: Path, kind: str | None = None) -> dict[str, KindComparison]:
    with open_for_reading(file) as there:
        return {comparison.kind: comparison for comparison in compare(here, there, kind)}


def test_equal_catalogues_do_not_differ(catalogue: Catalogue, other_file: Path) -> None:
    found = compared(catalogue, other_file)
    assert list(found) == list(KINDS)
    assert all(comparison.is_equal for comparison in found.values())
    assert (found["motors"].here, found["motors"].there) == (5, 5)


def test_what_differs_is_told_from_here_to_there(catalogue: Catalogue, other: Catalogue, other_file: Path) -> None:
    catalogue.add("motors", {"id": "mine", "source_id": SOURCE})
    other.add("motors", {"id": "theirs", "source_id": SOURCE})
    catalogue.edit(MOTOR, {"mass_kg": 0.1 + 0.2})
    other.edit(MOTOR, {"mass_kg": 0.3, "max_speed_rpm": "unlimited", "series": "theirs"})
    found = compared(catalogue, other_file)
    motors = found.pop("motors")
    assert (motors.here, motors.there, motors.only_here, motors.only_there) == (6, 6, ("mine",), ("theirs",))
    (row,) = motors.different
    assert row.row_id == MOTOR
    assert [(one.field.name, one.field.unit, one.old, one.new) for one in row.differences] == [
        ("series", "", None, "theirs"),
        ("max_speed_rpm", "rpm", None, inf),
        ("mass_kg", "kg", 0.1 + 0.2, 0.3),
    ]
    assert all(comparison.is_equal for comparison in found.values())


def test_one_kind_is_compared_where_one_is_asked_for(catalogue: Catalogue, other_file: Path) -> None:
    assert list(compared(catalogue, other_file, "motor")) == ["motors"]
    with pytest.raises(UnknownName, match="did you mean 'motors'"):
        compared(catalogue, other_file, "motorz")


def test_whose_a_row_is_makes_no_difference(catalogue: Catalogue, other_file: Path) -> None:
    connection = sqlite3.connect(other_file)
    connection.execute("UPDATE motors SET origin = 'user'")
    connection.commit()
    connection.close()
    assert compared(catalogue, other_file)["motors"].is_equal


def test_more_rows_than_fit_into_one_query_are_compared(
    catalogue: Catalogue, other: Catalogue, other_file: Path, tmp_path: Path
) -> None:
    for one, changed in ((catalogue, {700: 1}), (other, {3: 2, 1200: 2, 1300: None})):
        masses = {number: changed.get(number, 5) for number in range(1301)}
        lines = [f"r{number:04},{mass},{SOURCE}" for number, mass in masses.items() if mass is not None]
        file = tmp_path / "ropes.csv"
        file.write_text("\n".join(["id,mass_kg_per_m,source_id", *lines]))
        one.import_csv(file)
    ropes = compared(catalogue, other_file)["ropes"]
    assert [row.row_id for row in ropes.different] == ["r0003", "r0700", "r1200"]
    assert (ropes.here - ropes.there, ropes.only_here, ropes.only_there) == (1, ("r1300",), ())


def test_the_other_file_is_read_and_never_touched(other_file: Path, tmp_path: Path) -> None:
    other_file.chmod(0o444)
    before = files(tmp_path)
    with open_for_reading(other_file) as there:
        assert there.count("motors") == 5
        assert there.notices == ()
        assert not hasattr(there, "edit")
    assert files(tmp_path) == before


@pytest.mark.parametrize("form", ["sqlite:///{}", "sqlite+pysqlite:///{}", "sqlite:///file:{}?mode=ro&uri=true"])
def test_a_url_names_a_file_as_well(template: Path, form: str) -> None:
    with open_for_reading(form.format(template)) as there:
        assert there.count("motors") == 5


def test_an_older_catalogue_is_brought_up_to_date_in_memory_alone(
    catalogue: Catalogue, other_file: Path, tmp_path: Path
) -> None:
    engine = make_engine(database_url(other_file))
    with writing(engine) as connection:
        connection.exec_driver_sql("UPDATE motors SET mass_kg = 2 WHERE id = :id", {"id": MOTOR})
        migration.downgrade(connection, "0001")
    engine.dispose()
    before = files(tmp_path)
    with open_for_reading(other_file) as there:
        assert there.notices == (
            f"The catalogue {other_file} is of an older program (revision 0001); only a copy in memory was migrated.",
        )
        different = {one.kind: [row.row_id for row in one.different] for one in compare(catalogue, there)}
    assert different == {kind: [MOTOR] if kind == "motors" else [] for kind in KINDS}
    assert files(tmp_path) == before


@pytest.mark.parametrize("shipped", ["other rows", "no state"])
def test_shipped_rows_are_not_filled_in(catalogue: Catalogue, other_file: Path, shipped: str) -> None:
    connection = sqlite3.connect(other_file)
    connection.execute("DELETE FROM ropes")
    connection.execute("DELETE FROM actuators")
    connection.execute("DELETE FROM shipped_rows")
    statement = "UPDATE catalogue_state SET value = 'x'" if shipped == "other rows" else "DELETE FROM catalogue_state"
    connection.execute(statement)
    connection.commit()
    connection.close()
    actuators = compared(catalogue, other_file)["actuators"]
    assert (actuators.here, actuators.there, len(actuators.only_here)) == (5, 0, 5)


def test_a_file_that_does_not_exist_is_not_made(tmp_path: Path) -> None:
    for name in (tmp_path / "none.db", tmp_path / "no folder" / "none.db", ":memory:"):
        with pytest.raises(CatalogueUnavailable, match="there is no catalogue file"):
            open_for_reading(name)
    assert list(tmp_path.iterdir()) == []


def write_text(path: Path) -> None:
    path.write_text("a text that is long enough to have a header " * 10)


def write_tables(path: Path) -> None:
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE songs (title TEXT)")
    connection.close()


def write_newer(path: Path) -> None:
    open_catalogue(path).close()
    connection = sqlite3.connect(path)
    connection.execute("UPDATE alembic_version SET version_num = '9999'")
    connection.commit()
    connection.close()


@pytest.mark.parametrize(
    ("write", "words"),
    [
        (Path.touch, "is an empty database and no catalogue"),
        (Path.mkdir, "there is no catalogue file"),
        (write_text, "is not an SQLite database"),
        (write_tables, "is a database of another program"),
        (write_newer, "'9999'.*update actuator-select"),
    ],
)
def test_what_is_no_catalogue_of_this_program_is_explained(tmp_path: Path, write: object, words: str) -> None:
    path = tmp_path / "other"
    assert callable(write)
    write(path)
    with pytest.raises(CatalogueUnavailable, match=words) as error:
        open_for_reading(path)
    assert str(path) in str(error.value)


def test_a_file_that_another_program_writes_is_not_waited_for_for_ever(
    other_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(snapshot, "BUSY_TIMEOUT", 0.05)
    writer = sqlite3.connect(other_file, isolation_level=None)
    writer.execute("BEGIN EXCLUSIVE")
    with pytest.raises(CatalogueUnavailable, match="another program is reading or writing it"):
        open_for_reading(other_file)
    writer.close()


def test_a_server_has_to_have_the_same_revision(other_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # An SQLite file stands for the database of a server: it is read where it is.
    monkeypatch.setattr(snapshot, "_can_be_copied", lambda _: False)
    with open_for_reading(other_file) as there:
        assert there.count("motors") == 5
    connection = sqlite3.connect(other_file)
    connection.execute("UPDATE alembic_version SET version_num = '0001'")
    connection.commit()
    before = other_file.read_bytes()
    with pytest.raises(CatalogueUnavailable, match="has revision '0001', expected '0002'"):
        open_for_reading(other_file)
    assert other_file.read_bytes() == before
    connection.execute("DROP TABLE alembic_version")
    connection.close()
    with pytest.raises(CatalogueUnavailable, match="another program"):
        open_for_reading(other_file)
