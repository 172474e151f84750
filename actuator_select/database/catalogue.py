"""The catalogue as the rest of the program and a notebook see it."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

import sqlalchemy as sa

from actuator_select.database import queries
from actuator_select.database.cells import quoted
from actuator_select.database.connection import database_url, make_engine, prepare, reading, writing
from actuator_select.database.content import catalogue_digest
from actuator_select.database.csv_table import read_csv
from actuator_select.database.export import rows_as_csv, write_folder
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
from actuator_select.errors import Problem, UnknownName, did_you_mean

if TYPE_CHECKING:
    import pandas as pd

    from actuator_select.database.fields import Kind

_LISTED_NAMES = 12  # more names than these are not listed in a message


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


class Catalogue:
    """Motors, gearboxes, winches, ropes, actuators and the sources of their figures.

    Unknown figures are None, unlimited ones an infinite float. Units are those of the column names.

    Attributes
    ----------
    notices : tuple of str
        What opening it did that the user should know.
    """

    def __init__(self, engine: sa.Engine, notices: Sequence[str]) -> None:
        self._engine = engine
        self.notices = tuple(notices)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the database."""
        self._engine.dispose()

    @property
    def url(self) -> str:
        """Address of the database, its password hidden."""
        return self._engine.url.render_as_string(hide_password=True)

    def rows(self, kind: str, where: str = "", sort: str = "") -> list[Row]:
        """Rows of one kind.

        Parameters
        ----------
        kind : str
            ``sources``, ``motors``, ``gearboxes``, ``winches``, ``ropes`` or ``actuators``.
        where : str, optional
            Condition over column names, such as ``rated_power_w >= 50 and manufacturer = 'maxon'``.
        sort : str, optional
            Columns to sort by, such as ``rated_torque_nm, -mass_kg``; by id by default.

        Returns
        -------
        list of dict
            Values by column name. Actuators have their parts' columns as well: ``motor.rated_power_w``,
            ``gearbox.ratio`` (None without a gearbox), ``winch.drum_radius_mm``.

        Raises
        ------
        UnknownName
            If there is no such kind.
        InvalidExpression
            If the condition or the order cannot be understood.
        """
        found = find_kind(kind)
        condition, order = None, []
        if where or sort:
            # Building the parser takes longer than reading a small catalogue.
            from actuator_select.database.where import compile_condition, compile_sort

            columns = queries.columns_of(found)
            condition, order = compile_condition(where, columns), compile_sort(sort, columns)
        with reading(self._engine) as connection:
            return queries.fetch_rows(connection, found, condition, order)

    def frame(self, kind: str, where: str = "", sort: str = "") -> "pd.DataFrame":
        """Rows of one kind as a DataFrame; parameters and errors as for `rows`.

        Parameters
        ----------
        kind, where, sort : str
            As for `rows`.

        Returns
        -------
        pandas.DataFrame
            One column per catalogue column, numbers as floats (NaN unknown, inf unlimited).
        """
        import pandas as pd

        columns = queries.columns_of(find_kind(kind))
        frame = pd.DataFrame(self.rows(kind, where, sort), columns=[column.name for column in columns])
        numbers = {column.name: float for column in columns if not column.field.is_text}
        return frame.astype(numbers)

    def part(self, row_id: str, kind: str | None = None) -> tuple[str, Row]:
        """One row by its id.

        Parameters
        ----------
        row_id : str
            The id; for actuators the name as well.
        kind : str, optional
            Where to look; everywhere by default.

        Returns
        -------
        str, dict
            Kind and values.

        Raises
        ------
        UnknownName
            If there is none, or several kinds have it.
        """
        kinds = list(KINDS.values()) if kind is None else [find_kind(kind)]
        with reading(self._engine) as connection:
            names = [(one, queries.fetch_names(connection, one)) for one in kinds]
            found = [(one, known[row_id]) for one, known in names if row_id in known]
            if len(found) == 1:
                (one, own_id) = found[0]
                identity = queries.columns_of(one)[0].expression
                return one.name, queries.fetch_rows(connection, one, identity == own_id)[0]
        if found:
            among = ", ".join(one.name for one, _ in found)
            raise UnknownName(f"{row_id!r} is in {among}; state which with --kind")
        where = "the catalogue" if kind is None else kinds[0].name
        raise UnknownName(
            f"there is no {row_id!r} in {where}; {_hint(row_id, [name for _, known in names for name in known])}"
        )

    def source(self, row_id: str) -> Row:
        """Document that states figures, by its id; UnknownName where there is none."""
        return self.part(row_id, "sources")[1]

    def count(self, kind: str) -> int:
        """Count the rows of one kind."""
        with reading(self._engine) as connection:
            return queries.count_rows(connection, find_kind(kind))

    def fingerprint(self) -> str:
        """SHA-256 of everything that the catalogue states.

        Returns
        -------
        str
            64 hexadecimal digits, equal for equal contents, whatever the database and the order of the rows.
        """
        with reading(self._engine) as connection:
            return catalogue_digest(
                (kind, row) for kind in KINDS.values() for row in queries.fetch_own_rows(connection, kind).values()
            )

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

    def export_csv(self, kind: str) -> str:
        """Rows of one kind as CSV text that `import_csv` reads back exactly.

        Parameters
        ----------
        kind : str
            Kind of the rows.

        Returns
        -------
        str
            With every column that users fill, by id.
        """
        found = find_kind(kind)
        with reading(self._engine) as connection:
            return rows_as_csv(found, queries.fetch_own_rows(connection, found).values())

    def export_folder(self, path: str | Path) -> list[Path]:
        """Write every kind to a CSV file.

        Parameters
        ----------
        path : str or Path
            The folder; it is made where it is missing.

        Returns
        -------
        list of Path
            The files, in an order in which they can be imported.

        Raises
        ------
        OutputNotWritable
            If a file cannot be written.
        """
        with reading(self._engine) as connection:
            rows = {kind: queries.fetch_own_rows(connection, kind).values() for kind in KINDS.values()}
        return write_folder(Path(path), {kind.name: rows_as_csv(kind, found) for kind, found in rows.items()})


def _hint(word: str, known: Sequence[str]) -> str:
    hint = did_you_mean(word, known)
    if len(known) > _LISTED_NAMES and hint.startswith("known are"):
        return "`actuator-select catalog list KIND` shows what there is"
    return hint


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
