"""Rows as CSV files that read back exactly."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from actuator_select._resources import replace_atomically
from actuator_select.database.cells import Value, write_value
from actuator_select.database.csv_table import write_csv
from actuator_select.database.fields import Kind
from actuator_select.errors import OutputNotWritable


def rows_as_csv(kind: Kind, rows: Iterable[Mapping[str, Value]]) -> str:
    """Write rows with every column that users fill."""
    names = [field.name for field in kind.fields]
    return write_csv(names, ([write_value(row[name]) for name in names] for row in rows))


def write_folder(folder: Path, texts: Mapping[str, str]) -> list[Path]:
    """Write one file for each kind.

    Parameters
    ----------
    folder : Path
        Made where it is missing.
    texts : mapping of str to str
        Content by kind.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    OutputNotWritable
        If a file cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputNotWritable(
            f"cannot make the folder {folder}: {error.strerror or error}; choose another"
        ) from error
    files = []
    for kind, text in texts.items():
        file = folder / f"{kind}.csv"
        replace_atomically(file, text)
        files.append(file)
    return files
