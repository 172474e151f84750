"""``actuator-select catalog history`` and ``diff``."""

from dataclasses import asdict
from itertools import groupby
from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import UNKNOWN, exact
from actuator_select.cli.catalog.session import opened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from actuator_select.database.comparing import KindComparison
    from actuator_select.database.history import Change

_LISTED_ROWS = 20  # rows of one kind that the table names; JSON names all


@click.command("history")
@click.argument("row_id", metavar="ID")
@click.option("--kind", metavar="KIND", help="Kind of the row, where several kinds have or had the id.")
@click.option("--all", "every", is_flag=True, help="List every value of a removed row; JSON always does.")
@options.format_option("table", "json")
@options.database_option
def history(row_id: str, kind: str | None, every: bool, output_format: str, database: str | None) -> None:
    """Show what happened to a row: when (UTC), by what, and every value before and after.

    ID is the row's id, also of a row that was removed; an actuator's name does as well, also a former one. A
    catalogue made by an older program has kept its history only since a newer one opened it. A removal is one line of
    the table; --all lists what the row said.

    \b
    Examples:
        actuator-select catalog history my-motor
        actuator-select catalog history my-motor --all
        actuator-select catalog history my-motor --kind motors --format json
    """
    with opened(database) as catalogue:
        changes = catalogue.history(row_id, kind)
    began = {(change.kind, change.row_id): change.action == "added" for change in reversed(changes)}
    is_complete = bool(began) and all(began.values())
    if output_format == "json":
        console.emit_json({"id": row_id, "is_complete": is_complete, "changes": [asdict(change) for change in changes]})
        return
    if changes:
        rows = [_history_cells(change) for change in changes] if every else _folded_cells(changes)
        console.emit_table(["when (UTC)", "by", "row", "what", "column", "old", "new", "unit"], rows)
    if not is_complete:
        after = "what is listed happened since" if changes else "nothing has happened to it since"
        console.say(f"{row_id} was there before this catalogue began to keep a history; {after}.")


@click.command("diff")
@click.argument("other", metavar="OTHER")
@click.option("--kind", metavar="KIND", help="Compare one kind of row; every kind by default.")
@options.format_option("table", "json")
@options.database_option
def diff(other: str, kind: str | None, output_format: str, database: str | None) -> None:
    """Compare this catalogue with another one: rows that only one of them has, and different values.

    OTHER is a file or an SQLAlchemy URL. It is only read: an SQLite file is copied into memory, where the copy of an
    older program's catalogue is brought up to date. Rows are compared by kind and id. The exit status is 0 whether
    they differ or not.

    \b
    Examples:
        actuator-select catalog diff colleague.db
        actuator-select catalog diff before.db --kind motors --format json
    """
    from actuator_select.database import compare, open_for_reading

    # The other one first: where it cannot be read, this one need not be made.
    with open_for_reading(other) as there, opened(database) as here:
        console.say_all(there.notices)
        comparisons = compare(here, there, kind)
    if output_format == "json":
        console.emit_json({"kinds": [_diff_record(comparison) for comparison in comparisons]})
        return
    counts = [
        [
            one.kind,
            str(one.here),
            str(one.there),
            *(str(len(rows)) for rows in (one.only_here, one.only_there, one.different)),
        ]
        for one in comparisons
    ]
    header = ["kind", "rows here", "rows there", "only here", "only there", "different"]
    console.emit_table(header, counts, right=range(1, 6))
    for comparison in comparisons:
        _emit_kind(comparison)
    if all(comparison.is_equal for comparison in comparisons):
        console.say("Nothing differs.")


def _history_cells(change: "Change") -> list[str]:
    if change.field is None:
        return [*_what_happened(change), "", "", "", ""]
    return [*_what_happened(change), change.field, exact(change.old), exact(change.new), _unit(change)]


def _folded_cells(changes: "Sequence[Change]") -> list[list[str]]:
    """Cells of changes, those of a removal in one line."""
    rows: list[list[str]] = []
    for (*_, action), group in groupby(changes, key=_what_happened):
        some = list(group)
        if action == "removed":
            values = f"{len(some)} value{'' if len(some) == 1 else 's'} (--all lists them)"
            rows.append([*_what_happened(some[0]), "", values, UNKNOWN, ""])
        else:
            rows += map(_history_cells, some)
    return rows


def _what_happened(change: "Change") -> list[str]:
    when = change.changed_at.replace("T", " ").removesuffix("Z")
    return [when, exact(change.changed_by), f"{change.kind} {change.row_id}", change.action]


def _unit(change: "Change") -> str:
    """Unit of the column; empty for one that the program no longer has."""
    from actuator_select.database.kinds import KINDS

    kind = KINDS.get(change.kind)
    units = {} if kind is None else {field.name: field.unit for field in kind.fields}
    return units.get(change.field or "", "")


def _emit_kind(comparison: "KindComparison") -> None:
    for ids, where in ((comparison.only_here, "here"), (comparison.only_there, "there")):
        if ids:
            click.echo(f"{comparison.kind} only {where}: {', '.join(ids[:_LISTED_ROWS])}{_rest(ids)}")
    if comparison.different:
        rows = [
            [one.row_id, difference.field.name, exact(difference.old), exact(difference.new), difference.field.unit]
            for one in comparison.different[:_LISTED_ROWS]
            for difference in one.differences
        ]
        click.echo()
        header = ["row", "column", "here", "there", "unit"]
        console.emit_table(header, rows, title=f"{comparison.kind} that differ{_rest(comparison.different)}")


def _rest(rows: "Sequence[object]") -> str:
    left = len(rows) - _LISTED_ROWS
    return f" … and {left} more; --format json names all" if left > 0 else ""


def _diff_record(comparison: "KindComparison") -> dict[str, Any]:
    return {
        "kind": comparison.kind,
        "rows_here": comparison.here,
        "rows_there": comparison.there,
        "only_here": comparison.only_here,
        "only_there": comparison.only_there,
        "different": [
            {
                "id": one.row_id,
                "columns": [
                    {"column": difference.field.name, "unit": difference.field.unit}
                    | console.plain({"here": difference.old, "there": difference.new})
                    for difference in one.differences
                ],
            }
            for one in comparison.different
        ],
    }
