"""Catalogues and CSV files for the tests."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.connection import writing
from actuator_select.database.kinds import KINDS
from actuator_select.database.queries import delete_rows
from actuator_select.database.schema import CHANGES

SOURCE = "filipovic-kevac-2018"


@pytest.fixture(scope="session")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue of Table 1 alone, to be copied, which is faster than to be made."""
    path = tmp_path_factory.mktemp("template") / "catalogue.db"
    with open_catalogue(path) as made:
        others = {
            kind: [row["id"] for row in made.rows(kind) if row.get("source_id", row["id"]) != SOURCE] for kind in KINDS
        }
        others["actuators"] = [row["id"] for row in made.rows("actuators") if "identified" in row["source_location"]]
        with writing(made._engine) as connection:  # noqa: SLF001
            for kind in reversed(KINDS):
                delete_rows(connection, KINDS[kind], others[kind])
                # As if they had never been shipped: their history would only make tests slow.
                connection.execute(CHANGES.delete().where(CHANGES.c.kind == kind, CHANGES.c.row_id.in_(others[kind])))
    return path


@pytest.fixture
def catalogue(template: Path, tmp_path: Path) -> Iterator[Catalogue]:
    with open_catalogue(shutil.copy(template, tmp_path / "catalogue.db")) as opened:
        yield opened


@pytest.fixture
def write_csv(tmp_path: Path) -> Callable[[str, str], Path]:
    """Write a CSV file; a ``$`` in its text is the id of a source that exists."""

    def write(name: str, text: str) -> Path:
        path = tmp_path / name
        path.write_bytes(text.replace("$", SOURCE).encode())
        return path

    return write
