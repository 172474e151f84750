"""The catalogue as the rest of the program and a notebook see it."""

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from actuator_select.database.cells import quoted
from actuator_select.database.connection import database_url, make_engine, prepare, writing
from actuator_select.database.importing import ImportReport, OnRows, Progress, Terms, tables_of, take_in
from actuator_select.database.ingest import Record, plan_rows, read_record, refuse, write_plan
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.queries import Row
from actuator_select.database.reader import ReadableCatalogue
from actuator_select.errors import Problem

if TYPE_CHECKING:
    from actuator_select.database.fields import Kind
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
    """Motors, gearboxes, winches, ropes, actuators and the sources of their figures.

    Unknown figures are None, unlimited ones an infinite float. Units are those of the column names.

    Attributes
    ----------
    notices : tuple of str
        What opening it did that the user should know.
    """

    def add(self, kind: str, values: Mapping[str, object], source: Mapping[str, object] | None = None) -> Row:
        """Add one row, and the source of its figures where that is new.

        Parameters
        ----------
        kind : str
            Kind of the row.
        values : mapping of str to object
            Numbers or texts by column name, in the columns' units.
        source : mapping of str to object, optional
            A new row of ``sources`` to be added first.

        Returns
        -------
        dict
            The row as the catalogue holds it.

        Raises
        ------
        InvalidRows
            With everything that is wrong.
        """
        found = find_kind(kind)
        rows: list[tuple[Kind, Mapping[str, object], str]] = [(found, values, "")]
        if source is not None:
            new_source = {"id": _derived_id(source), **source}
            rows = [(KINDS["sources"], new_source, "source."), (found, {**values, "source_id": new_source["id"]}, "")]
        problems: list[Problem] = []
        with writing(self._engine) as connection:
            for one, given, prefix in rows:
                record, refused = read_record(one, given, prefix)
                plan, more = plan_rows(connection, one, [record], update=False)
                # A source that is refused cannot be referred to either; that needs no telling.
                problems += [problem for problem in (*refused, *more) if not problems or problem.place != "source_id"]
                if not problems:
                    write_plan(connection, one, plan, by="catalog add")
            if not problems and not plan.added:
                problems = [_already_there(record)]
            refuse(f"the {found.singular} was not added", problems)
        return self.part(str(record.given["id"]), found.name)[1]

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
            With everything that is wrong: place, value, what was expected, remedy.
        UnknownName
            If the kind is unknown.
        """
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
            tables_of(path, kind, found, sheet) as tables,
            writing(self._engine, keep=not dry_run) as connection,
        ):
            reports = take_in(connection, tables, terms, progress, on_rows)
        return [dataclasses.replace(report, dry_run=dry_run) for report in reports]


def _derived_id(source: Mapping[str, object]) -> str:
    """Id for a source that was described without one, from its title and date."""
    words = f"{source.get('document') or ''} {source.get('date') or ''}".lower()
    return "-".join(re.findall("[a-z0-9]+", words))[:60].strip("-") or "source"


def _already_there(record: Record) -> Problem:
    return Problem(
        place=record.at("id"),
        value=quoted(record.given.get("id")),
        expected="an id that the catalogue does not have",
        remedy="the catalogue has this very row already",
    )
