"""Fixtures of the tests of the command line."""

from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select.cli import main

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run the program in an empty folder on a database of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ACTUATOR_SELECT_DATABASE", str(tmp_path / "catalogue.db"))

    def call(*arguments: str) -> tuple[int, str, str]:
        status = main(list(arguments))
        out, err = capfd.readouterr()
        return status, out, err

    return call
