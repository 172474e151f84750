"""Folders and files of the program and its user."""

import errno
import os
import stat
from pathlib import Path

import pytest

from actuator_select._resources import replace_atomically, replacing, shipped_dir, writable_cache_dir
from actuator_select.errors import OutputNotWritable


def test_shipped_folders_are_found() -> None:
    assert (shipped_dir("catalog") / "actuators.csv").is_file()
    assert (shipped_dir("migrations") / "env.py").is_file()
    with pytest.raises(FileNotFoundError, match="install actuator-select again"):
        shipped_dir("nonsense")


def test_a_cache_that_cannot_be_made_is_replaced_by_a_temporary_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    folder = writable_cache_dir("kernels")
    assert folder.is_dir()
    assert blocked not in folder.parents
    folder.rmdir()


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    replace_atomically(path, "one")
    replace_atomically(path, "zwei äöü")
    assert path.read_text(encoding="utf-8") == "zwei äöü"
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "report.html"
    replace_atomically(path, "old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(OutputNotWritable, match="No space left on device; choose a file"):
        replace_atomically(path, "new")
    assert path.read_text(encoding="utf-8") == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]


def test_what_goes_wrong_while_writing_keeps_its_name_and_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    replace_atomically(path, "old")

    def write_half(error: Exception) -> None:
        with replacing(path) as file:
            file.write(b"half")
            raise error

    for error in (RuntimeError("a fault"), OutputNotWritable("another file")):
        with pytest.raises(type(error), match=f"^{error}$"):
            write_half(error)
    assert path.read_text(encoding="utf-8") == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]


def test_links_in_a_circle_and_long_names_are_told_or_taken(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    with pytest.raises(OutputNotWritable, match=os.strerror(errno.ELOOP)):
        replace_atomically(loop, "new")
    long = tmp_path / ("x" * 250)
    replace_atomically(long, "M\udcfcller")
    assert long.read_text(encoding="utf-8") == "M?ller"


def test_links_are_followed_permissions_stay_and_devices_are_written_to(tmp_path: Path) -> None:
    target, link = tmp_path / "target.html", tmp_path / "link.html"
    target.write_text("old", encoding="utf-8")
    target.chmod(0o600)
    link.symlink_to(target)
    replace_atomically(link, "new")
    assert link.is_symlink()
    assert target.read_text(encoding="utf-8") == "new"
    assert stat.S_IMODE(target.stat().st_mode) == 0o600
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    replace_atomically(pipe, "through")
    assert os.read(reader, 100) == b"through"
    os.close(reader)
    assert stat.S_ISFIFO(pipe.stat().st_mode)
