"""Opening a database: what can be wrong with it, and what opening does."""

import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from actuator_select.database import migration, open_catalogue, shipped
from actuator_select.database.connection import database_url
from actuator_select.errors import CatalogueUnavailable


@pytest.fixture
def database(tmp_path: Path) -> Path:
    path = tmp_path / "catalogue.db"
    open_catalogue(path).close()
    return path


def shipped_count(kind: str) -> int:
    return len(shipped.read_shipped()[kind])


def read_only(path: Path) -> str:
    return f"sqlite:///file:{path}?mode=ro&uri=true"


def execute(path: Path, statement: str) -> None:
    connection = sqlite3.connect(path)
    connection.execute(statement)
    connection.commit()
    connection.close()


def test_first_use_makes_tables_and_rows_and_says_so(tmp_path: Path) -> None:
    path = tmp_path / "catalogue.db"
    with open_catalogue(path) as catalogue:
        assert catalogue.count("actuators") == shipped_count("actuators")
        assert catalogue.notices == (f"Made the catalogue {path}.",)
    with open_catalogue(str(path)) as catalogue:
        assert catalogue.notices == ()


def test_the_environment_names_the_database(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ACTUATOR_SELECT_DATABASE", str(tmp_path / "mine.db"))
    with open_catalogue() as catalogue:
        assert catalogue.url == f"sqlite:///{tmp_path}/mine.db"


def test_the_users_data_folder_is_the_default(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ACTUATOR_SELECT_DATABASE", raising=False)
    monkeypatch.setattr("actuator_select.database.connection.user_data_dir", lambda: tmp_path)
    assert database_url(None).database == str(tmp_path / "catalogue.db")


@pytest.mark.parametrize("url", ["nosuch+driver://user:secret@host/parts", "no url://user:secret@host/parts"])
def test_a_url_keeps_its_password_to_itself(url: str) -> None:
    with pytest.raises(CatalogueUnavailable) as error:
        open_catalogue(url)
    assert "secret" not in str(error.value)


@pytest.mark.parametrize(
    ("url", "words"),
    [
        ("steam://engine", "names no kind of database"),
        ("sqlite+nosuchdriver:///x.db", "names no kind of database"),
        ("://", "is no database URL"),
    ],
)
def test_an_address_that_leads_nowhere_is_explained(url: str, words: str) -> None:
    with pytest.raises(CatalogueUnavailable, match=words):
        open_catalogue(url)


def test_a_named_folder_that_does_not_exist_is_not_made_because_it_may_be_a_slip(tmp_path: Path) -> None:
    with pytest.raises(CatalogueUnavailable, match="there is no folder"):
        open_catalogue(tmp_path / "deep" / "catalogue.db")
    assert list(tmp_path.iterdir()) == []


def test_a_data_folder_that_cannot_be_made_is_explained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.delenv("ACTUATOR_SELECT_DATABASE", raising=False)
    monkeypatch.setattr("actuator_select.database.connection.user_data_dir", lambda: tmp_path / "file" / "data")
    with pytest.raises(CatalogueUnavailable, match="cannot make the folder"):
        open_catalogue()


def test_a_folder_is_no_database(tmp_path: Path) -> None:
    with pytest.raises(CatalogueUnavailable, match="cannot be opened"):
        open_catalogue(tmp_path)


def test_a_file_that_is_no_database_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "notes.txt"
    path.write_text("not a database, but a text that is long enough to have a header " * 10)
    before = path.read_bytes()
    with pytest.raises(CatalogueUnavailable, match="is not an SQLite database"):
        open_catalogue(path)
    assert path.read_bytes() == before


def test_a_database_of_another_program_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "other.db"
    execute(path, "CREATE TABLE songs (title TEXT)")
    with pytest.raises(CatalogueUnavailable, match=r"another program.*songs"):
        open_catalogue(path)


def test_a_newer_database_asks_for_a_newer_program(database: Path) -> None:
    execute(database, "UPDATE alembic_version SET version_num = '9999'")
    with pytest.raises(CatalogueUnavailable, match=r"'9999'.*update actuator-select"):
        open_catalogue(database)


def test_a_read_only_database_can_be_read(database: Path) -> None:
    with open_catalogue(read_only(database)) as catalogue:
        assert catalogue.count("motors") == shipped_count("motors")
        with pytest.raises(CatalogueUnavailable, match="cannot be written"):
            catalogue.add("motors", {"id": "m", "source_id": "filipovic-kevac-2018"})


def test_a_read_only_database_with_other_shipped_rows_can_be_read(database: Path) -> None:
    execute(database, "UPDATE catalogue_state SET value = 'of another version'")
    with open_catalogue(read_only(database)) as catalogue:
        assert "cannot be written now" in catalogue.notices[0]
        assert catalogue.count("motors") == shipped_count("motors")


def test_a_read_only_database_of_nothing_cannot_be_used(tmp_path: Path) -> None:
    path = tmp_path / "empty.db"
    path.touch()
    with pytest.raises(CatalogueUnavailable, match="cannot be written"):
        open_catalogue(read_only(path))


@pytest.mark.parametrize("begin", ["BEGIN EXCLUSIVE", "BEGIN IMMEDIATE"])
def test_a_locked_database_says_so(database: Path, begin: str) -> None:
    other = sqlite3.connect(database, isolation_level=None)
    other.execute(begin)
    try:
        with pytest.raises(CatalogueUnavailable, match="another program is reading or writing it"):
            open_and_add(f"sqlite:///{database}?timeout=0.05")
    finally:
        other.close()


def open_and_add(url: str) -> None:
    with open_catalogue(url) as catalogue:
        catalogue.add("motors", {"id": "m", "source_id": "filipovic-kevac-2018"})


def test_processes_that_start_together_share_the_new_database(tmp_path: Path) -> None:
    code = (
        "import sys\n"
        "from actuator_select.database import open_catalogue\n"
        "with open_catalogue(sys.argv[1]) as catalogue:\n"
        "    print(catalogue.count('actuators'))\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "shared.db")]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    assert [process.communicate(timeout=60)[0].strip() for process in running] == [str(shipped_count("actuators"))] * 3


@pytest.mark.parametrize("stopped", [migration, shipped], ids=["migrating", "filling"])
def test_first_use_that_is_interrupted_can_be_repeated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stopped: object
) -> None:
    path = tmp_path / "catalogue.db"
    name = "upgrade" if stopped is migration else "refresh"
    original = getattr(stopped, name)

    def work_and_stop(*arguments: object) -> None:
        original(*arguments)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(stopped, name, work_and_stop)
        with pytest.raises(KeyboardInterrupt):
            open_catalogue(path)
    assert path.stat().st_size == 0
    with open_catalogue(path) as catalogue:
        assert catalogue.count("actuators") == shipped_count("actuators")


def test_opening_an_up_to_date_database_imports_neither_alembic_nor_pandas(database: Path) -> None:
    code = (
        "import sys\n"
        "from actuator_select import database\n"
        "assert 'sqlalchemy' not in sys.modules\n"
        "with database.open_catalogue(sys.argv[1]) as catalogue:\n"
        "    catalogue.rows('actuators')\n"
        "print({'alembic', 'pandas', 'lark'} & set(sys.modules))\n"
    )
    run = subprocess.run([sys.executable, "-c", code, database], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "set()"
