"""What differs: between two states of a row, and between two catalogues."""

from collections.abc import Mapping
from dataclasses import dataclass

import sqlalchemy as sa

from actuator_select.database import queries
from actuator_select.database.cells import Value
from actuator_select.database.fields import Field, Kind
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.reader import ReadableCatalogue


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """A column that two states of a row have different values in.

    Attributes
    ----------
    field : Field
        The column.
    old, new : float, int, str or None
        Its values before and after, or in this catalogue and in the other one; None is unknown. [field.unit]
    """

    field: Field
    old: Value
    new: Value


@dataclass(frozen=True, slots=True, kw_only=True)
class DifferentRow:
    """A row that two catalogues have, with different values.

    Attributes
    ----------
    row_id : str
        Its id.
    differences : tuple of Difference
        From the first catalogue to the second.
    """

    row_id: str
    differences: tuple[Difference, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class KindComparison:
    """What two catalogues have of one kind.

    Attributes
    ----------
    kind : str
        The kind.
    here, there : int
        Numbers of rows.
    only_here, only_there : tuple of str
        Ids of the rows that the other catalogue does not have.
    different : tuple of DifferentRow
        Rows of both with different values.
    """

    kind: str
    here: int
    there: int
    only_here: tuple[str, ...]
    only_there: tuple[str, ...]
    different: tuple[DifferentRow, ...]

    @property
    def is_equal(self) -> bool:
        """Whether both have the same rows."""
        return not (self.only_here or self.only_there or self.different)


def differences(kind: Kind, old: Mapping[str, Value], new: Mapping[str, Value]) -> tuple[Difference, ...]:
    """Columns that users fill and that differ; an absent one is unknown."""
    return tuple(
        Difference(field=field, old=old.get(field.name), new=new.get(field.name))
        for field in kind.fields
        if old.get(field.name) != new.get(field.name)
    )


def compare(here: ReadableCatalogue, there: ReadableCatalogue, kind: str | None = None) -> tuple[KindComparison, ...]:
    """Compare two catalogues, row by row of the same id.

    Parameters
    ----------
    here, there : ReadableCatalogue
        The catalogues; `open_for_reading` opens one without touching it.
    kind : str, optional
        Kind of the rows; every kind by default.

    Returns
    -------
    tuple of KindComparison
        One for each kind, also where nothing differs. Whether a row was shipped or is the user's is not compared.

    Raises
    ------
    UnknownName
        If there is no such kind.
    """
    kinds = list(KINDS.values()) if kind is None else [find_kind(kind)]
    with here.transaction() as ours, there.transaction() as theirs:
        return tuple(_compare_kind(ours, theirs, one) for one in kinds)


def _compare_kind(ours: sa.Connection, theirs: sa.Connection, kind: Kind) -> KindComparison:
    here, there = (set(queries.fetch_values(connection, kind, "id")) for connection in (ours, theirs))
    different: list[DifferentRow] = []
    for ids in queries.batches(here & there):
        our_rows, their_rows = queries.fetch_cells(ours, kind, ids), queries.fetch_cells(theirs, kind, ids)
        different += _different_rows(kind, our_rows - their_rows, their_rows - our_rows)
    return KindComparison(
        kind=kind.name,
        here=len(here),
        there=len(there),
        only_here=tuple(sorted(here - there)),
        only_there=tuple(sorted(there - here)),
        different=tuple(different),
    )


def _different_rows(kind: Kind, ours: set[tuple[Value, ...]], theirs: set[tuple[Value, ...]]) -> list[DifferentRow]:
    names = [field.name for field in kind.fields]
    (old, new) = ({str(cells[0]): dict(zip(names, cells, strict=True)) for cells in rows} for rows in (ours, theirs))
    return [
        DifferentRow(row_id=row_id, differences=differences(kind, old[row_id], new[row_id])) for row_id in sorted(old)
    ]
