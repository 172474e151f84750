"""The catalogue as the rest of the program and a notebook see it."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from actuator_select.database.cells import quoted
from actuator_select.database.connection import database_url, make_engine, prepare, writing
from actuator_select.database.csv_table import read_csv
from actuator_select.database.ingest import (
    Progress,
    Record,
    find_kind_of,
    plan_rows,
    read_record,
    read_records,
    refuse,
    write_plan,
)
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.queries import Row
from actuator_select.database.reader import ReadableCatalogue
from actuator_select.errors import Problem

if TYPE_CHECKING:
    from actuator_select.database.fields import Kind


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportReport:
    """What an import did, or would do.

    Attributes
    ----------
    kind : str
        Kind of the rows.
    added, updated, unchanged : int
        Numbers of rows.
    rows : tuple of dict
        The rows that were added or updated.
    dry_run : bool
        Whether nothing was written.
    """

    kind: str
    added: int
    updated: int
    unchanged: int
    rows: tuple[Row, ...]
    dry_run: bool


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
    ) -> ImportReport:
        """Take in a CSV file, all of it or nothing.

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
        table = read_csv(Path(path))
        found = find_kind_of(table, kind)
        records, problems = read_records(found, table, progress)
        with writing(self._engine, keep=not dry_run) as connection:
            plan, more = plan_rows(connection, found, records, update=update)
            refuse(f"nothing was imported from {table.name}", [*problems, *more])
            write_plan(connection, found, plan, by=f"catalog import {table.name}")
        return ImportReport(
            kind=found.name,
            added=len(plan.added),
            updated=len(plan.updated),
            unchanged=plan.unchanged,
            rows=(*plan.added, *plan.updated),
            dry_run=dry_run,
        )


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
