"""Where the program's own files and the user's files are."""

import errno
import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from actuator_select.errors import ActuatorSelectError, OutputNotWritable

_PACKAGE = Path(__file__).resolve().parent


def shipped_dir(name: str) -> Path:
    """Folder of shipped files, in an installed wheel or in a checkout.

    Parameters
    ----------
    name : str
        ``"catalog"`` or ``"migrations"``.

    Returns
    -------
    Path
        The existing folder.

    Raises
    ------
    FileNotFoundError
        If the installation is incomplete.
    """
    for folder in (_PACKAGE / f"_{name}", _PACKAGE.parent / name):
        if folder.is_dir():
            return folder
    raise FileNotFoundError(f"the installation lacks its folder {name!r}; install actuator-select again")


def user_data_dir() -> Path:
    """Folder of the user's database, by the platform's convention."""
    from platformdirs import user_data_path

    return user_data_path("actuator-select", appauthor=False)


def writable_cache_dir(name: str) -> Path:
    """Folder for what can be made again, by the platform's convention; a temporary one where that cannot be written.

    Parameters
    ----------
    name : str
        Of the folder inside the program's cache.

    Returns
    -------
    Path
        An existing folder.
    """
    from platformdirs import user_cache_path

    folder = user_cache_path("actuator-select", appauthor=False) / name
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.mkdtemp(prefix="actuator-select-"))


def refuse_no_folder(path: Path) -> None:
    """Refuse, before any work, a file whose folder is missing.

    Raises
    ------
    OutputNotWritable
        If there is no such folder, or the path is a folder itself.
    """
    if path.is_dir() or not path.parent.is_dir():
        reason = "it is a folder" if path.is_dir() else os.strerror(errno.ENOENT)
        raise OutputNotWritable(_cannot_write(path, OSError(errno.EISDIR, reason)))


def replace_atomically(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all.

    Parameters
    ----------
    path : Path
        The file; its folder must exist. The target of a link is replaced, not the link; a device or a pipe is written
        to; the permissions of an existing file stay.
    content : str or bytes
        Text is written as UTF-8.

    Raises
    ------
    OutputNotWritable
        If the folder is missing or the file cannot be written; an existing file is then untouched.
    """
    # A name typed in another encoding must not cost the report.
    data = content.encode(errors="replace") if isinstance(content, str) else content
    with replacing(path) as file:
        file.write(data)


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """Write a file piece by piece, and put it in its place only when it is whole; as `replace_atomically`.

    Yields
    ------
    binary file
        To write to.
    """
    try:
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        is_special = path.exists() and not path.is_file()
        with path.open("wb") if is_special else _replacement(path) as file:
            yield file
    except ActuatorSelectError:
        raise
    except OSError as error:
        raise OutputNotWritable(_cannot_write(path, error)) from error


@contextmanager
def _replacement(path: Path) -> Iterator[BinaryIO]:
    """Open a temporary file beside a file's target, that takes the target's place when it is whole."""
    try:
        target = path.resolve(strict=path.is_symlink())
    except RuntimeError as error:  # links in a circle
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP)) from error
    mode = stat.S_IMODE(target.stat().st_mode) if target.exists() else 0o666 & ~_umask()
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=".actuator-select-")
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
        temporary.chmod(mode)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _cannot_write(path: Path, error: OSError) -> str:
    return f"cannot write {path}: {error.strerror or error}; choose a file in a folder that exists and may be written"
