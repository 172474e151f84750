"""Taking in whole files: in one transaction, portion by portion, so that memory stays flat; all of it or nothing."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import TYPE_CHECKING, TypeAlias

import sqlalchemy as sa

from actuator_select.database import history, queries
from actuator_select.database.csv_table import SEMICOLONS
from actuator_select.database.fields import Kind
from actuator_select.database.heading import Heading, read_heading
from actuator_select.database.ingest import in_order, plan_rows, write_plan
from actuator_select.database.queries import Row
from actuator_select.database.records import Record, iter_records, places_of
from actuator_select.database.seen import Purpose, Seen, remembering
from actuator_select.database.suggestions import first_of
from actuator_select.database.tables import Table
from actuator_select.errors import InvalidRows, Problem

if TYPE_CHECKING:
    from actuator_select.database.mapping import Mapping

Progress: TypeAlias = Callable[[int, int], None]
"""Told (done, total) lines."""

OnRows: TypeAlias = Callable[[str, Sequence[Row]], None]
"""Told the kind of rows that were added or updated, and the rows, portion by portion."""

_PORTION = 1000  # rows that are held in memory
_LINES_PER_REPORT = 100  # of progress
_MOST_PROBLEMS = 2000  # nobody reads more


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportReport:
    """What an import did to one kind, or would do.

    Attributes
    ----------
    kind : str
        Kind of the rows.
    added, updated, unchanged, removed : int
        Numbers of rows.
    dry_run : bool
        Whether nothing was written.
    notices : tuple of str
        What to mind: what was passed over.
    """

    kind: str
    added: int = 0
    updated: int = 0
    unchanged: int = 0
    removed: int = 0
    dry_run: bool = False
    notices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Terms:
    """How a file is to be taken in.

    Attributes
    ----------
    by : str
        By what, for the history.
    mapping : Mapping or None
        What the foreign columns mean.
    source : str or None
        Source of every row.
    update : bool
        Whether rows that exist may be changed.
    replace : bool
        Whether the kinds are to hold exactly the rows of the file.
    """

    by: str
    mapping: "Mapping | None" = None
    source: str | None = None
    update: bool = False
    replace: bool = False


def take_in(
    connection: sa.Connection,
    tables: Sequence[tuple[Kind, Table]],
    terms: Terms,
    progress: Progress | None = None,
    on_rows: OnRows | None = None,
) -> list[ImportReport]:
    """Take tables in, in the caller's transaction, which is to be undone if this raises.

    Parameters
    ----------
    connection : sqlalchemy.Connection
        In a transaction that writes.
    tables : sequence of (Kind, Table)
        In an order in which references point backwards.
    terms : Terms
        How.
    progress, on_rows : callable, optional
        Told what has been done.

    Returns
    -------
    list of ImportReport
        One for each kind.

    Raises
    ------
    InvalidRows
        With everything that is wrong, up to a few thousand problems.
    """
    with remembering(connection) as seen:
        intake = _Intake(connection, seen, terms, progress, on_rows, sum(table.length for _, table in tables))
        reports = [intake.take(kind, table) for kind, table in tables]
        if terms.replace and intake.has_no_problem:
            # Otherwise rows that were not written would seem to be missing, and rows that stay to be in use.
            gone = {kind.name: intake.remove_others(kind) for kind, _ in reversed(tables)}
            reports = [replace(one, removed=one.removed + gone[one.kind]) for one in reports]
        intake.refuse(" and ".join(table.name for _, table in tables))
        return reports


class _Intake:
    """One import under way."""

    def __init__(
        self,
        connection: sa.Connection,
        seen: Seen,
        terms: Terms,
        progress: Progress | None,
        on_rows: OnRows | None,
        total: int,
    ) -> None:
        self._connection = connection
        self._seen = seen
        self._terms = terms
        self._progress = progress
        self._on_rows = on_rows
        self._total = total
        self._done = 0
        self._problems: dict[Problem, None] = {}

    def take(self, kind: Kind, table: Table) -> ImportReport:
        """Take one table in; from the first problem on it is only checked."""
        heading, problems = read_heading(kind, table, self._terms.mapping, self._terms.source)
        self._object(problems)
        removed = 0
        if kind.unique and (self._terms.replace or self._terms.update):
            # What goes has to go first, and what gets another name to be known: their names may be given to others.
            is_whole = self._note_coming(heading)
            if self._terms.replace and is_whole:
                removed = self._remove(kind, self._seen.other_ids(Purpose.COMING, kind))
        report = ImportReport(kind=kind.name, removed=removed)
        lines = self._counted(heading)
        while self._can_go_on and (portion := list(islice(lines, _PORTION))):
            report = self._take_portion(heading, portion, report)
        self._done += table.length
        return report if table.notices is None else replace(report, notices=table.notices())

    def remove_others(self, kind: Kind) -> int:
        """Remove the rows of a kind that were not in the file; how many there were."""
        return self._remove(kind, self._seen.other_ids(Purpose.PLACE, kind))

    def refuse(self, name: str) -> None:
        """Raise `InvalidRows` if anything was objected to."""
        problems = list(self._problems)
        if not problems:
            return
        heading = f"nothing was imported from {name}"
        if not self._can_go_on:
            heading += f"; there are more than {_MOST_PROBLEMS} problems, the first of which are"
        raise InvalidRows(heading, _with_decimal_comma(problems[:_MOST_PROBLEMS]))

    @property
    def has_no_problem(self) -> bool:
        """Whether nothing has been objected to yet."""
        return not self._problems

    @property
    def _can_go_on(self) -> bool:
        return len(self._problems) <= _MOST_PROBLEMS

    def _take_portion(
        self, heading: Heading, portion: Sequence[tuple[Record | None, list[Problem]]], report: ImportReport
    ) -> ImportReport:
        records = [record for record, _ in portion if record is not None]
        plan, more = plan_rows(
            self._connection,
            heading.kind,
            records,
            update=self._terms.update,
            replace=self._terms.replace,
            seen=self._seen,
        )
        self._object(in_order([*(problem for _, problems in portion for problem in problems), *more]))
        if not self._problems:
            write_plan(self._connection, heading.kind, plan, by=self._terms.by, seen=self._seen)
            if self._on_rows is not None:
                self._on_rows(heading.kind.name, (*plan.added, *plan.updated))
        return replace(
            report,
            added=report.added + len(plan.added),
            updated=report.updated + len(plan.updated),
            unchanged=report.unchanged + plan.unchanged,
        )

    def _counted(self, heading: Heading) -> Iterator[tuple[Record | None, list[Problem]]]:
        """Records and problems of a table, with progress; a file that breaks off ends with a problem."""
        told = -1
        try:
            for count, (number, record, problems) in enumerate(iter_records(heading), start=1):
                yield record, problems
                if count % _LINES_PER_REPORT == 0:
                    told = self._tell(number - heading.table.numbered_from)
        except InvalidRows as error:
            if not error.problems:
                raise
            yield None, list(error.problems)
        if told != self._done + heading.table.length:
            self._tell(heading.table.length)

    def _tell(self, lines: int) -> int:
        """Tell how many lines have been read, of this table and those before."""
        done = min(self._done + lines, self._total)
        if self._progress is not None:
            self._progress(done, self._total)
        return done

    def _note_coming(self, heading: Heading) -> bool:
        """Note which ids and unique texts are to come; whether the file could be read to its end.

        What is wrong is told when the rows are taken in.
        """
        kind = heading.kind
        records = (record for _, record, _ in iter_records(heading) if record is not None)
        try:
            while portion := list(islice(records, _PORTION)):
                rows = {row_id: record for _, row_id, record in places_of(portion, "id")}
                known = self._seen.recall(Purpose.COMING, kind, "id", rows)
                new = [record for row_id, record in rows.items() if row_id not in known]
                for field in ("id", *(one.name for one in kind.unique)):
                    said = {str(one.given["id"]): value for _, value, one in places_of(new, field)}
                    self._seen.note(Purpose.COMING, kind, field, said)
        except InvalidRows as error:
            if not error.problems:
                raise
            return False
        return True

    def _remove(self, kind: Kind, ids: Sequence[str]) -> int:
        users: dict[str, list[str]] = {}
        for use in queries.fetch_uses(self._connection, kind, ids):
            users.setdefault(use.used_id, []).append(f"{use.kind.singular} {use.row_id!r}")
        self._object(
            Problem(
                place=f"{kind.singular} {row_id!r} of the catalogue",
                value="not in the file",
                expected=f"a row for it, because {first_of(by)} {'uses' if len(by) == 1 else 'use'} it",
                remedy="replace or remove these first, or import with --update instead of --replace",
            )
            for row_id, by in users.items()
        )
        for batch in queries.batches(row_id for row_id in ids if row_id not in users):
            history.remove_rows(self._connection, kind, batch, by=self._terms.by)
        return len(ids)

    def _object(self, problems: "Sequence[Problem] | Iterator[Problem]") -> None:
        self._problems.update(dict.fromkeys(problems))


def _with_decimal_comma(problems: list[Problem]) -> list[Problem]:
    """Where semicolons and decimal commas are all that is wrong, say how to import the file as it is."""
    semicolons = [one for one in problems if one.remedy == SEMICOLONS]
    others = [one for one in problems if one.remedy != SEMICOLONS]
    if not semicolons or not others or not all("a decimal comma was given" in one.remedy for one in others):
        return problems
    remedy = (
        'the file can be imported as it is with a mapping (--mapping FILE.toml) of three lines: kind = "motors", then '
        '[csv], then delimiter = ";" and decimal = ","'
    )
    return [replace(one, remedy=remedy) if one.remedy == SEMICOLONS else one for one in problems]
