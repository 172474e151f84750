"""``actuator-select catalog edit``, ``copy`` and ``remove``."""

import sys
from functools import partial
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.cells import exact
from actuator_select.cli.catalog.interview import EMPTIED, Values, interview, write_fields
from actuator_select.cli.catalog.session import findings_of, opened, warn_of

if TYPE_CHECKING:
    from actuator_select.database import Catalogue
    from actuator_select.database.changing import Edit
    from actuator_select.database.comparing import Difference

_kind_option = click.option("--kind", metavar="KIND", help="Kind of the row, where several kinds have the id.")


@click.command("edit")
@click.argument("row_id", metavar="ID")
@click.argument("fields", nargs=-1, metavar="[FIELD=VALUE]...")
@_kind_option
@click.option("--dry-run", is_flag=True, help="Check everything, tell what would change, and write nothing.")
@options.database_option
def edit(row_id: str, fields: tuple[str, ...], kind: str | None, dry_run: bool, database: str | None) -> None:
    """Change fields of one row: FIELD=VALUE on the command line, or without fields, question by question.

    ID is the row's id; an actuator's name does as well. FIELD= empties a field (the figure is unknown then),
    FIELD=unlimited says that there is no limit. Units are those of the field's name. The checks are those of an
    import: all of the change or nothing, and every objection at once. source.document=… with source.url=… and
    source.date=… names a new source. A row that came with the program becomes yours: upgrades leave it alone, until you
    edit it back. The id never changes; copy the row and remove the old one instead. `catalog history` keeps every
    value that was there before.

    \b
    Examples:
        actuator-select catalog edit my-motor rated_torque_nm=0.25 mass_kg=
        actuator-select catalog edit my-motor peak_torque_nm=unlimited --dry-run
        actuator-select catalog edit my-motor
        actuator-select catalog edit my-motor rated_power_w=110 \\
            source.document="Data sheet, 2nd edition" source.url=https://example.org/2.pdf source.date=2026-12
    """
    with opened(database) as catalogue:
        if fields:
            done = write_fields(fields, partial(catalogue.edit, row_id, kind=kind), dry_run=dry_run)
        else:
            done = _edit_by_questions(catalogue, row_id, kind, dry_run=dry_run)
        findings = findings_of(catalogue, done.kind, [done.row]) if done.differences else []
    _tell_edit(done, dry_run=dry_run)
    warn_of(findings)


@click.command("copy")
@click.argument("row_id", metavar="ID")
@click.argument("fields", nargs=-1, metavar="[FIELD=VALUE]...")
@click.option("--as", "new_id", required=True, metavar="NEW", help="Id of the new row.")
@_kind_option
@options.database_option
def copy(row_id: str, fields: tuple[str, ...], new_id: str, kind: str | None, database: str | None) -> None:
    """Add a row that starts from a similar one, with the changes that FIELD=VALUE state.

    ID is the row to start from; an actuator's name does as well. An actuator's name becomes NEW unless name=… states
    another. check_status and check_notes stay behind, because they speak of the original's figures. The copy names the
    original's source: where your figures are from another document, say which with source_id=…, or source.document=…
    with source.url=… and source.date=… for a new one.

    \b
    Examples:
        actuator-select catalog copy my-motor --as my-motor-24v nominal_voltage_v=24 terminal_resistance_ohm=0.2
        actuator-select catalog copy "Actuator 1" --as mine-2 name="My second drive" motor_id=my-motor
    """
    from actuator_select.database.kinds import find_kind

    with opened(database) as catalogue:
        found, row = write_fields(fields, partial(catalogue.copy, row_id, new_id, kind=kind))
        findings = findings_of(catalogue, found, [row])
    console.say(f"Added {find_kind(found).singular} {new_id}, copied from {row_id}.")
    console.say(f"Next: actuator-select catalog show {new_id} --kind {found}")
    warn_of(findings)


@click.command("remove")
@click.argument("row_id", metavar="ID")
@_kind_option
@click.option("--yes", is_flag=True, help="Do not ask; without a terminal it does not ask either.")
@options.database_option
def remove(row_id: str, kind: str | None, yes: bool, database: str | None) -> None:
    """Remove one row, unless other rows refer to it.

    ID is the row's id; an actuator's name does as well. A part that an actuator is made of, or a source that rows name,
    is not removed; the message says by what it is used. `catalog history` still shows every value of a removed row. A
    removed row that came with the program does not come back by itself.

    \b
    Examples:
        actuator-select catalog remove mine
        actuator-select catalog remove my-drum --kind winches --yes
    """
    from actuator_select.database.kinds import find_kind

    with opened(database) as catalogue:
        if sys.stdin.isatty() and not yes:
            found = catalogue.remove(row_id, kind, dry_run=True)
            name = f"{find_kind(found.kind).singular} {found.row['id']}"
            if not click.confirm(f"Remove {name}?", err=True):
                console.say("Nothing was removed.")
                return
        removed = catalogue.remove(row_id, kind)
    own_id = removed.row["id"]
    console.say(f"Removed {find_kind(removed.kind).singular} {own_id}.")
    if removed.is_of_the_program:
        console.say("The program ships a row of this id; it does not bring it back by itself.")
    console.say(
        f"All its values, to add it again: actuator-select catalog history {own_id} --kind {removed.kind} --all"
    )


def _change_text(difference: "Difference") -> str:
    """What became of a column, such as ``mass_kg: 0.4 → 0.5 kg``."""
    old, new = exact(difference.old), exact(difference.new)
    return f"{difference.field.name}: {old} → {new} {difference.field.unit}".rstrip()


def _edit_by_questions(catalogue: "Catalogue", row_id: str, kind: str | None, *, dry_run: bool) -> "Edit":
    from actuator_select.database.kinds import find_kind

    name, row = catalogue.part(row_id, kind)
    found, own_id = find_kind(name), str(row["id"])

    def write(values: Values, source: Values | None) -> "Edit":
        return catalogue.edit(own_id, values, name, source, dry_run=dry_run)

    console.say(
        f"{found.singular} {own_id}. Press Enter to keep what stands in brackets, {EMPTIED} to empty it, Ctrl-C to "
        "stop; nothing is half-changed."
    )
    return interview(catalogue, found, write, row)


def _tell_edit(done: "Edit", *, dry_run: bool) -> None:
    from actuator_select.database.kinds import find_kind

    name = f"{find_kind(done.kind).singular} {done.row['id']}"
    if not done.differences:
        console.say(f"There is nothing to change: {name} has these values.")
        return
    console.say(f"Dry run: {name} would change. Nothing was written." if dry_run else f"Changed {name}.")
    for difference in done.differences:
        console.say(f"  {_change_text(difference)}")
    if not dry_run:
        console.say(f"Next: actuator-select catalog show {done.row['id']} --kind {done.kind}")
