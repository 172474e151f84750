"""Reading a catalogue: rows, parts, sources, history, exports."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from tempfile import SpooledTemporaryFile
from types import TracebackType
from typing import TYPE_CHECKING, Self

import sqlalchemy as sa

from actuator_select._resources import replacing
from actuator_select.database import queries
from actuator_select.database.connection import reading
from actuator_select.database.content import catalogue_digest
from actuator_select.database.export import csv_pieces, json_pieces, list_json_pieces, make_folder
from actuator_select.database.expressions import chosen_columns, condition_of, order_of
from actuator_select.database.history import Change
from actuator_select.database.kinds import COMPATIBILITIES, KINDS, find_kind
from actuator_select.database.naming import locate, locate_ever, matches
from actuator_select.database.queries import Row

if TYPE_CHECKING:
    import pandas as pd

    from actuator_select.database.fields import Kind

_SPOOLED_BYTES = 16_777_216  # of an export in memory; a longer one goes through a temporary file
_CHARACTERS_PER_PIECE = 32_768  # of an export that is read back


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

    def rows(
        self, kind: str, where: str = "", sort: str = "", columns: str = "", limit: int | None = None
    ) -> list[Row]:
        """Rows of one kind.

        Parameters
        ----------
        kind : str
            ``sources``, ``motors``, ``gearboxes``, ``compatibilities``, ``winches``, ``ropes`` or ``actuators``.
        where : str, optional
            Condition over column names, such as ``rated_power_w >= 50 and manufacturer = 'maxon'``.
        sort : str, optional
            Columns to sort by, such as ``rated_torque_nm, -mass_kg``; by id by default.
        columns : str, optional
            Columns to read, such as ``id, mass_kg``; every column by default.
        limit : int, optional
            Number of rows to read, the first ones; all by default.

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
            If the condition, the order or the columns cannot be understood.
        """
        found = find_kind(kind)
        asked = (condition_of(found, where), order_of(found, sort), chosen_columns(found, columns), limit)
        with reading(self._engine) as connection:
            return queries.fetch_rows(connection, found, *asked)

    def list_pieces(
        self,
        file_format: str,
        kind: str,
        where: str = "",
        sort: str = "",
        columns: str = "",
        limit: int | None = None,
    ) -> Iterator[str]:
        """Rows as of `rows` as CSV or JSON text, piece by piece: many rows need not fit into memory.

        Parameters
        ----------
        file_format : str
            ``csv`` or ``json``.
        kind, where, sort, columns, limit
            As for `rows`.

        Yields
        ------
        str
            Piece of the text.

        Raises
        ------
        UnknownName, InvalidExpression
            As for `rows`.
        """
        found = find_kind(kind)
        chosen = chosen_columns(found, columns) or queries.columns_of(found)
        asked = (condition_of(found, where), order_of(found, sort), chosen, limit)
        names = [column.name for column in chosen]

        def pieces(connection: sa.Connection) -> Iterator[str]:
            if file_format == "csv":
                return csv_pieces(names, queries.stream_rows(connection, found, *asked))
            fingerprint = _fingerprint(connection)
            return list_json_pieces(found, queries.stream_rows(connection, found, *asked), fingerprint)

        return self._spooled(pieces)

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

    def uses(self, row_id: str, kind: str) -> list[queries.Use]:
        """What refers to a row.

        Parameters
        ----------
        row_id, kind : str
            Its id and kind.

        Returns
        -------
        list of Use
            By the users' kind and id; empty where nothing does.

        Raises
        ------
        UnknownName
            If there is no such kind.
        """
        with reading(self._engine) as connection:
            return queries.fetch_uses(connection, find_kind(kind), [row_id])

    def fits(self, row_id: str, kind: str) -> list[Row]:
        """Compatibilities that speak of a motor or a gearbox, by their id; none of any other kind."""
        column = f"{find_kind(kind).singular}_pattern"
        if column not in COMPATIBILITIES.spellings:
            return []
        with reading(self._engine) as connection:
            rows = queries.stream_rows(connection, COMPATIBILITIES)
            return [row for row in rows if matches(str(row[column]), row_id)]

    def count(self, kind: str, where: str = "") -> int:
        """Count the rows of one kind: all, or those that meet a condition, as for `rows`."""
        found = find_kind(kind)
        condition = condition_of(found, where)
        with reading(self._engine) as connection:
            return queries.count_rows(connection, found, condition)

    def fingerprint(self) -> str:
        """SHA-256 of everything that the catalogue states.

        Returns
        -------
        str
            64 hexadecimal digits, equal for equal contents, whatever the database and the order of the rows.
        """
        with reading(self._engine) as connection:
            return _fingerprint(connection)

    def history(self, row_id: str, kind: str | None = None) -> list[Change]:
        """What happened to a row, also to one that is gone.

        Parameters
        ----------
        row_id : str
            Its id; for actuators the name as well, also one that it no longer has.
        kind : str, optional
            Its kind; every kind by default.

        Returns
        -------
        list of Change
            Oldest first, row by row where several had the name; empty for a row that was there before the history
            began, and that nothing happened to since.

        Raises
        ------
        UnknownName
            If there never was such a row.
        """
        found = None if kind is None else find_kind(kind)
        with reading(self._engine) as connection:
            changes = queries.fetch_changes(connection, row_id, found)
            if not changes:
                rows = locate_ever(connection, row_id, kind)
                changes = [
                    change for known, own_id in rows for change in queries.fetch_changes(connection, own_id, known)
                ]
            return [Change(**change) for change in changes]

    def transaction(self) -> AbstractContextManager[sa.Connection]:
        """Transaction that reads, for what this class has no method for."""
        return reading(self._engine)

    def export_csv(self, kind: str, where: str = "") -> str:
        """Rows of one kind as CSV text that `import_csv` reads back exactly.

        Parameters
        ----------
        kind : str
            Kind of the rows.
        where : str, optional
            Condition, as for `rows`.

        Returns
        -------
        str
            With every column that users fill, by id.
        """
        return "".join(self.export_pieces("csv", kind, where))

    def export_pieces(self, file_format: str, kind: str | None = None, where: str = "") -> Iterator[str]:
        """Rows as the text of a file, piece by piece: many rows need not fit into memory.

        All is read before the first piece comes, so that no transaction is open between the pieces.

        Parameters
        ----------
        file_format : str
            ``csv`` or ``json``.
        kind : str, optional
            Kind of the rows; JSON takes all kinds by default.
        where : str, optional
            Condition over the rows of that kind, as for `rows`.

        Yields
        ------
        str
            Piece of the file.

        Raises
        ------
        UnknownName, InvalidExpression
            As for `rows`.
        ValueError
            If one file cannot hold what is asked for.
        """
        kinds = _kinds(kind, where, file_format)
        condition = condition_of(kinds[0], where)
        return self._spooled(lambda connection: _pieces(connection, file_format, kinds, condition))

    def export_file(self, path: str | Path, file_format: str, kind: str | None = None, where: str = "") -> None:
        """Write rows to a file, whole or not at all.

        Parameters
        ----------
        path : str or Path
            The file.
        file_format : str
            ``csv``, ``json`` or ``xlsx``.
        kind, where : str, optional
            As for `export_pieces`; XLSX takes all kinds by default, too.

        Raises
        ------
        OutputNotWritable
            If the file cannot be written.
        InvalidRows
            If the format cannot hold a row.
        UnknownName, InvalidExpression, ValueError
            As for `export_pieces`.
        """
        kinds = _kinds(kind, where, file_format)
        condition = condition_of(kinds[0], where)
        with replacing(Path(path)) as file, reading(self._engine) as connection:
            if file_format == "xlsx":
                from actuator_select.database.workbook_export import write_workbook

                write_workbook(file, [(one, queries.stream_own_rows(connection, one, condition)) for one in kinds])
            else:
                file.writelines(piece.encode() for piece in _pieces(connection, file_format, kinds, condition))

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
        make_folder(Path(path))
        files = [Path(path) / f"{kind}.csv" for kind in KINDS]
        with reading(self._engine) as connection:
            for file, kind in zip(files, KINDS.values(), strict=True):
                with replacing(file) as opened:
                    names = [field.name for field in kind.fields]
                    pieces = csv_pieces(names, queries.stream_own_rows(connection, kind))
                    opened.writelines(piece.encode() for piece in pieces)
        return files

    def _spooled(self, pieces: Callable[[sa.Connection], Iterator[str]]) -> Iterator[str]:
        # Whoever takes the pieces may wait, as a pager does; what is read must not keep others from writing meanwhile.
        with SpooledTemporaryFile(_SPOOLED_BYTES, "w+", encoding="utf-8", newline="") as spool:
            with reading(self._engine) as connection:
                spool.writelines(pieces(connection))
            spool.seek(0)
            while piece := spool.read(_CHARACTERS_PER_PIECE):
                yield piece


def _kinds(kind: str | None, where: str, file_format: str) -> list["Kind"]:
    if kind is not None:
        return [find_kind(kind)]
    if where:
        raise ValueError("a condition is over the columns of one kind; name it")
    if file_format == "csv":
        raise ValueError("a CSV file holds rows of one kind")
    return list(KINDS.values())


def _pieces(
    connection: sa.Connection, file_format: str, kinds: Sequence["Kind"], condition: sa.ColumnElement[bool] | None
) -> Iterator[str]:
    streams = [(one, queries.stream_own_rows(connection, one, condition)) for one in kinds]
    if file_format == "csv":
        kind, rows = streams[0]
        return csv_pieces([field.name for field in kind.fields], rows)
    return json_pieces(streams, _fingerprint(connection))


def _fingerprint(connection: sa.Connection) -> str:
    return catalogue_digest((kind, row) for kind in KINDS.values() for row in queries.stream_own_rows(connection, kind))
