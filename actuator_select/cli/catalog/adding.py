"""``actuator-select catalog add``: from the command line, or question by question."""

from functools import partial

import click

from actuator_select.cli import console, options
from actuator_select.cli.catalog.interview import interview, write_fields
from actuator_select.cli.catalog.session import findings_of, opened, warn_of


@click.command("add")
@click.argument("kind", metavar="KIND")
@click.argument("fields", nargs=-1, metavar="[FIELD=VALUE]...")
@options.database_option
def add(kind: str, fields: tuple[str, ...], database: str | None) -> None:
    """Add one row: FIELD=VALUE on the command line, or without fields, question by question.

    KIND is source, motor, gearbox, compatibility, winch, rope or actuator. Units are those of the field's name;
    `actuator-select catalog fields KIND` lists all fields with their ranges. What is left out or empty is unknown.
    Every row names its source: source_id=… for one that the catalogue has, or source.document=… with source.url=… (or
    source.page=…, source.doi=…) and source.date=… for a new one.

    \b
    Examples:
        actuator-select catalog add motor
        actuator-select catalog add motor id=acme-m1 rated_power_w=150 rated_speed_rpm=3000 rated_torque_nm=0.48 \\
            source.document="Acme catalogue" source.url=https://acme.example/m.pdf source.date=2024
        actuator-select catalog add actuator id=mine name="My actuator" motor_id=acme-m1 \\
            winch_id=filipovic-kevac-2018-winch source_id=acme-catalogue-2024
    """
    from actuator_select.database.kinds import find_kind

    found = find_kind(kind)
    with opened(database) as catalogue:
        if fields:
            row = write_fields(fields, partial(catalogue.add, found.name))
        else:
            console.say(
                f"{found.description}. Press Enter where a figure is unknown, Ctrl-C to stop; nothing is half-added."
            )
            row = interview(catalogue, found, lambda answers, new: catalogue.add(found.name, answers, new))
        findings = findings_of(catalogue, found.name, [row])
    console.say(f"Added {found.singular} {row['id']}.")
    console.say(f"Next: actuator-select catalog show {row['id']} --kind {found.name}")
    warn_of(findings)
