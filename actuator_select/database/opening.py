"""Opening files and folders: which tables they hold, and of which kinds."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

from actuator_select.database.csv_table import read_csv
from actuator_select.database.fields import Kind
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.tables import Table, kind_named, kind_of, one_to_many
from actuator_select.errors import InvalidRows, UnknownName, did_you_mean

if TYPE_CHECKING:
    from actuator_select.database.mapping import Mapping

_FORMATS = {".csv", ".tsv", ".txt", ".xls", ".xlsx", ".ods", ".json"}
_NEARLY_A_KIND = 0.8  # of all letters are those of a kind's name; "gearboxs" has 0.94, "Motor notes" 0.7


@dataclass(frozen=True, slots=True, kw_only=True)
class Contents:
    """What a file or a folder holds.

    Attributes
    ----------
    tables : list of (Kind, Table)
        In an order in which references point backwards.
    passed_over : tuple of str
        Sheets, lists and files that are not read: ``sheet Notes``.
    """

    tables: list[tuple[Kind, Table]]
    passed_over: tuple[str, ...] = ()


@contextmanager
def tables_of(
    path: Path, kind: str | None, mapping: "Mapping | None" = None, sheet: str | None = None
) -> Iterator[Contents]:
    """Open a file or a folder while its tables are read.

    Parameters
    ----------
    path : Path
        A CSV, XLSX or JSON file, or a folder of CSV files that are named after kinds.
    kind : str or None
        Kind of the rows, or which of several to take; told by names and headers by default.
    mapping : Mapping, optional
        What tells the kind and how CSV is written.
    sheet : str, optional
        Of a workbook.

    Yields
    ------
    Contents
        Its tables, and what is passed over.

    Raises
    ------
    InvalidRows
        If it cannot be read.
    UnknownName
        If a kind or a sheet does not exist or cannot be told.
    """
    wanted = None if kind is None else find_kind(kind).name
    suffix = path.suffix.casefold()
    if mapping is not None:
        mapped = find_kind(mapping.kind).name
        if wanted not in {None, mapped}:
            raise UnknownName(f"the mapping {mapping.name} is for {mapped}, not {wanted}; drop --kind, or take another")
        wanted = mapped
        if suffix in {".xlsx", ".json"} and not mapping.is_for_any_format:
            raise UnknownName(
                f"the mapping {mapping.name} has no header or a layout of pairs, which is for CSV files; save "
                f"{path.name} as CSV"
            )
    if sheet is not None and suffix != ".xlsx":
        raise UnknownName(f"{path.name} is no XLSX workbook and has no sheet {sheet!r}; drop --sheet")
    if suffix == ".xlsx":
        from actuator_select.database.xlsx_table import xlsx_tables

        with xlsx_tables(path) as tables:
            chosen = tables if sheet is None else [_sheet(tables, sheet, path)]
            yield _with_kinds(chosen, path, "sheet", wanted, is_stated=sheet is not None)
    elif suffix == ".json":
        from actuator_select.database.json_table import json_tables

        yield _with_kinds(json_tables(path), path, "list", wanted)
    elif path.is_dir():
        entries = _files(path)
        files = [file for file in entries if file.suffix.casefold() == ".csv"]
        _refuse_near_names([file.stem for file in files], path, "file", wanted)
        # The others need not be readable.
        named = [file for file in files if (one := kind_named(file.stem)) and wanted in {None, one}]
        read = _with_kinds([_csv_table(file, mapping) for file in named], path, "file", wanted)
        yield Contents(
            tables=read.tables, passed_over=tuple(f"file {file.name}" for file in entries if file not in named)
        )
    else:
        table = _csv_table(path, mapping)
        yield Contents(tables=[(find_kind(wanted or kind_of(table)), table)])


def _with_kinds(
    tables: Sequence[Table], path: Path, part: str, wanted: str | None, *, is_stated: bool = False
) -> Contents:
    """Tables and their kinds, in an order in which references point backwards; others are passed over."""
    if wanted is not None and len(tables) == 1 and (is_stated or kind_named(tables[0].title) in {None, wanted}):
        return Contents(tables=[(KINDS[wanted], tables[0])])
    named = [(KINDS[name], table) for table in tables if (name := kind_named(table.title))]
    if wanted is None and not named and len(tables) == 1:
        return Contents(tables=[(KINDS[kind_of(tables[0])], tables[0])])
    found = [(kind, table) for kind, table in named if wanted in {None, kind.name}]
    titles = [table.title for table in tables]
    _refuse_near_names(titles, path, part, wanted)
    how = "state one with --sheet and --kind" if part == "sheet" else f"name the {part} so"
    if not found:
        asked = f"named {wanted}" if wanted else "named after a kind of row, such as motors"
        has = f"it has {', '.join(titles)}; " if titles and part != "file" else ""
        raise InvalidRows(f"{path} has no {part} {asked}; {has}{how}")
    names = [kind.name for kind, _ in found]
    if twice := next((name for name in names if names.count(name) > 1), None):
        how = "state one with --sheet" if part == "sheet" else "keep one of them"
        raise InvalidRows(f"{path} has several {part}s for {twice}; {how}")
    read = [table.title for _, table in found]
    return Contents(
        tables=sorted(found, key=lambda one: list(KINDS).index(one[0].name)),
        passed_over=tuple(f"{part} {title}" for title in titles if title not in read),
    )


def _files(folder: Path) -> list[Path]:
    """Files of a folder that look like tables, of whatever format."""
    try:
        return sorted(one for one in folder.iterdir() if one.suffix.casefold() in _FORMATS and one.is_file())
    except OSError as error:
        raise InvalidRows(f"cannot read {folder}: {error.strerror or error}; check its permissions") from error


def _csv_table(path: Path, mapping: "Mapping | None") -> Table:
    if mapping is None:
        return read_csv(path)
    table = read_csv(path, mapping.csv_format)
    return one_to_many(table) if mapping.layout == "one-to-many" else table


def _refuse_near_names(titles: Sequence[str], path: Path, part: str, wanted: str | None) -> None:
    """Refuse a misspelt kind, the rows of which would be passed over unseen."""
    known = {name: kind.name for kind in KINDS.values() for name in (kind.name, kind.singular)}
    for title in titles:
        near = get_close_matches(title.strip().casefold(), known, n=1, cutoff=_NEARLY_A_KIND)
        if near and kind_named(title) is None and wanted in {None, known[near[0]]}:
            raise InvalidRows(
                f"{path} has a {part} {title!r}, which is no kind of row; did you mean {known[near[0]]!r}? Name it so, "
                "or otherwise if it holds something else"
            )


def _sheet(tables: Sequence[Table], sheet: str, path: Path) -> Table:
    for table in tables:
        if table.title == sheet:
            return table
    raise UnknownName(f"{path.name} has no sheet {sheet!r}; {did_you_mean(sheet, [one.title for one in tables])}")
