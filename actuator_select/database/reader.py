"""Reading a catalogue: rows, parts, sources, history, exports."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

import sqlalchemy as sa

from actuator_select.database import queries
from actuator_select.database.connection import reading
from actuator_select.database.content import catalogue_digest
from actuator_select.database.export import rows_as_csv, write_folder
from actuator_select.database.history import Change
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.naming import locate
from actuator_select.database.queries import Row

if TYPE_CHECKING:
    import pandas as pd


class ReadableCatalogue:
    """A catalogue that is only read.

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
        with reading(self._engine) as connection:
            found, own_id = locate(connection, row_id, kind)
            return found.name, queries.fetch_row(connection, found, own_id)

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

    def history(self, row_id: str, kind: str | None = None) -> list[Change]:
        """What happened to a row, also to one that is gone.

        Parameters
        ----------
        row_id : str
            Its id; for actuators the name as well.
        kind : str, optional
            Its kind; every kind by default.

        Returns
        -------
        list of Change
            Oldest first; empty for a row that was there before the history began, and that nothing happened to since.

        Raises
        ------
        UnknownName
            If there never was such a row.
        """
        found = None if kind is None else find_kind(kind)
        with reading(self._engine) as connection:
            changes = queries.fetch_changes(connection, row_id, found)
            if not changes:
                known, own_id = locate(connection, row_id, kind, queries.fetch_past_ids(connection))
                changes = queries.fetch_changes(connection, own_id, known)
            return [Change(**change) for change in changes]

    def transaction(self) -> AbstractContextManager[sa.Connection]:
        """Transaction that reads, for what this class has no method for."""
        return reading(self._engine)

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
