"""Catalogues and CSV files for the tests."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from actuator_select.database import Catalogue, open_catalogue

SOURCE = "filipovic-kevac-2018"


@pytest.fixture(scope="session")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue of the shipped rows, to be copied, which is faster than to be made."""
    path = tmp_path_factory.mktemp("template") / "catalogue.db"
    open_catalogue(path).close()
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
