"""The catalogue as the rest of the program and a notebook see it."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from actuator_select.database.changing import Edit, Removal, add_row, copy_row, edit_row, remove_row
from actuator_select.database.connection import database_url, make_engine, prepare, writing
from actuator_select.database.importing import ImportReport, OnRows, Progress, Terms, take_in
from actuator_select.database.kinds import find_kind
from actuator_select.database.opening import tables_of
from actuator_select.database.queries import Row, fetch_row
from actuator_select.database.reader import ReadableCatalogue
from actuator_select.errors import InvalidRows

if TYPE_CHECKING:
    from actuator_select.database.mapping import Mapping as ColumnMapping


def open_catalogue(url: str | Path | None = None) -> "Catalogue":
    """Open the catalogue; it is made, migrated and filled where it needs it.

    Parameters
    ----------
    url : str or Path, optional
        A file, an SQLAlchemy URL, or ``":memory:"``. By default the environment variable
        ``ACTUATOR_SELECT_DATABASE``, else ``catalogue.db`` in the user's data folder.

    Returns
    -------
    Catalogue
        To be closed, or used in a ``with`` statement.

    Raises
    ------
    CatalogueUnavailable
        If it cannot be used; the message says why and what to do.

    Examples
    --------
    >>> with open_catalogue(":memory:") as catalogue:
    ...     strong = catalogue.rows("actuators", where="rated_power_w >= 50")
    >>> [row["name"] for row in strong]
    ['Actuator 1', 'Actuator 2', 'Actuator 3']
    """
    engine = make_engine(database_url(url))
    try:
        notices = prepare(engine)
    except BaseException:
        engine.dispose()
        raise
    return Catalogue(engine, notices)


class Catalogue(ReadableCatalogue):
    """Motors, gearboxes, winches, ropes, actuators, which gearboxes fit which motors, and the sources of all figures.

    Unknown figures are None, unlimited ones an infinite float. Units are those of the column names.

    Attributes
    ----------
    notices : tuple of str
        What opening it did that the user should know.
    """

    def add(
        self,
        kind: str,
        values: Mapping[str, object],
        source: Mapping[str, object] | None = None,
        *,
        dry_run: bool = False,
    ) -> Row:
        """Add one row, and the source of its figures where that is new.

        Parameters
        ----------
        kind : str
            Kind of the row.
        values : mapping of str to object
            Numbers or texts by column name, in the columns' units.
        source : mapping of str to object, optional
            A new row of ``sources`` to be added first.
        dry_run : bool
            Check everything and write nothing.

        Returns
        -------
        dict
            The row as the catalogue holds it, or would.

        Raises
        ------
        InvalidRows
            With everything that is wrong.
        """
        found = find_kind(kind)
        with writing(self._engine, keep=not dry_run) as connection:
            row_id = add_row(connection, found, values, source)
            return fetch_row(connection, found, row_id)

    def import_csv(
        self,
        path: str | Path,
        kind: str | None = None,
        *,
        dry_run: bool = False,
        update: bool = False,
        progress: Progress | None = None,
        on_rows: OnRows | None = None,
    ) -> ImportReport:
        """Take in a CSV file in the catalogue's own columns, all of it or nothing.

        Parameters
        ----------
        path : str or Path
            UTF-8 with a header of column names; an empty cell is unknown, the word ``unlimited`` unlimited.
        kind : str, optional
            Kind of the rows; told by the file's name or header by default.
        dry_run : bool
            Check everything and write nothing.
        update : bool
            Change rows that exist; their columns that the file leaves out keep their values.
        progress : callable, optional
            Told (done, total) lines.
        on_rows : callable, optional
            Told the kind and the rows that are added or updated, portion by portion.

        Returns
        -------
        ImportReport
            What was done.

        Raises
        ------
        InvalidRows
            With everything that is wrong: place, value, what was expected, remedy; also if it is no CSV file.
        UnknownName
            If the kind is unknown.
        """
        if Path(path).is_dir() or Path(path).suffix.casefold() in {".xlsx", ".json"}:
            raise InvalidRows(f"{path} is no CSV file; import_file takes workbooks, JSON files and folders")
        (report,) = self.import_file(path, kind, dry_run=dry_run, update=update, progress=progress, on_rows=on_rows)
        return report

    def import_file(  # noqa: PLR0913 - one keyword for each option of the command
        self,
        path: str | Path,
        kind: str | None = None,
        *,
        mapping: "str | Path | ColumnMapping | None" = None,
        source: str | None = None,
        sheet: str | None = None,
        dry_run: bool = False,
        update: bool = False,
        replace: bool = False,
        progress: Progress | None = None,
        on_rows: OnRows | None = None,
    ) -> list[ImportReport]:
        """Take in a file or a folder in one transaction, all of it or nothing, with flat memory.

        Parameters
        ----------
        path : str or Path
            CSV (UTF-8 with a header of column names), an XLSX workbook with a sheet for each kind, a JSON file of
            lists of rows, or a folder of CSV files named after kinds, as `export_folder` writes it. An empty cell is
            unknown, the word ``unlimited`` unlimited.
        kind : str, optional
            Kind of the rows, or which of several kinds to take; told by names and headers by default.
        mapping : str, Path or Mapping, optional
            What foreign columns mean: a TOML file, or the name of a mapping that comes with the program.
        source : str, optional
            Id of the source of every row.
        sheet : str, optional
            Sheet of a workbook.
        dry_run : bool
            Check everything and write nothing.
        update : bool
            Change rows that exist; their columns that the file leaves out keep their values.
        replace : bool
            Make the imported kinds hold exactly the rows of the file.
        progress : callable, optional
            Told (done, total) lines.
        on_rows : callable, optional
            Told the kind and the rows that are added or updated, portion by portion. What it is told of is undone if
            a problem turns up later.

        Returns
        -------
        list of ImportReport
            One for each kind.

        Raises
        ------
        InvalidRows
            With everything that is wrong: place, value, what was expected, remedy.
        UnknownName
            If the kind, the sheet or the mapping is unknown.
        """
        found = mapping
        if isinstance(found, str | Path):
            from actuator_select.database.mapping import load_mapping

            found = load_mapping(found)
        path = Path(path)
        terms = Terms(by=f"catalog import {path.name}", mapping=found, source=source, update=update, replace=replace)
        with (
            tables_of(path, kind, found, sheet) as contents,
            writing(self._engine, keep=not dry_run) as connection,
        ):
            reports = take_in(connection, contents.tables, terms, progress, on_rows)
        reports = [dataclasses.replace(report, dry_run=dry_run) for report in reports]
        if reports and contents.passed_over:
            notice = f"not read of {path.name}: {', '.join(contents.passed_over)}"
            reports[0] = dataclasses.replace(reports[0], notices=(notice, *reports[0].notices))
        return reports

    def edit(
        self,
        row_id: str,
        values: Mapping[str, object],
        kind: str | None = None,
        source: Mapping[str, object] | None = None,
        *,
        dry_run: bool = False,
    ) -> Edit:
        """Change columns of one row; a shipped row becomes the user's.

        Parameters
        ----------
        row_id : str
            The id, which never changes; for actuators the name as well.
        values : mapping of str to object
            Numbers or texts by column name, in the columns' units; empty is unknown. Other columns stay.
        kind : str, optional
            Where to look; everywhere by default.
        source : mapping of str to object, optional
            A new row of ``sources``, which then states the row's figures.
        dry_run : bool
            Check everything and write nothing.

        Returns
        -------
        Edit
            What changed.

        Raises
        ------
        InvalidRows
            With everything that is wrong.
        UnknownName
            If there is no such row, or several kinds have it.
        """
        with writing(self._engine, keep=not dry_run) as connection:
            return edit_row(connection, row_id, values, kind, source)

    def copy(
        self,
        row_id: str,
        new_id: str,
        values: Mapping[str, object] = MappingProxyType({}),
        kind: str | None = None,
        source: Mapping[str, object] | None = None,
        *,
        dry_run: bool = False,
    ) -> tuple[str, Row]:
        """Add a row that starts from another one, without what a check of the other one's figures said.

        Parameters
        ----------
        row_id : str
            The row to start from.
        new_id : str
            Id of the new row, and its name where names are unique and `values` has none.
        values : mapping of str to object, optional
            Columns with other values.
        kind, source, dry_run
            As for `edit`.

        Returns
        -------
        str, dict
            Kind and values of the new row.

        Raises
        ------
        InvalidRows
            With everything that is wrong.
        UnknownName
            If there is no such row, or several kinds have it.
        """
        with writing(self._engine, keep=not dry_run) as connection:
            found, _ = copy_row(connection, row_id, new_id, values, kind, source)
            return found.name, fetch_row(connection, found, new_id)

    def remove(self, row_id: str, kind: str | None = None, *, dry_run: bool = False) -> Removal:
        """Remove one row; its history keeps what it said.

        Parameters
        ----------
        row_id : str
            The id; for actuators the name as well.
        kind : str, optional
            Where to look; everywhere by default.
        dry_run : bool
            Find out whether it can be removed, and leave it.

        Returns
        -------
        Removal
            What was removed.

        Raises
        ------
        RowInUse
            If other rows refer to it; the message names them.
        UnknownName
            If there is no such row, or several kinds have it.
        """
        with writing(self._engine, keep=not dry_run) as connection:
            return remove_row(connection, row_id, kind)
