"""``actuator-select catalog``."""

import click

from actuator_select.cli.catalog.adding import add
from actuator_select.cli.catalog.changing import copy, edit, remove
from actuator_select.cli.catalog.checking import check
from actuator_select.cli.catalog.comparing import diff, history
from actuator_select.cli.catalog.exporting import export
from actuator_select.cli.catalog.importing import import_file
from actuator_select.cli.catalog.listing import fields, list_rows
from actuator_select.cli.catalog.showing import show


@click.group("catalog")
def command() -> None:
    """Query, extend and check the catalogue: motors, gearboxes, winches, ropes, actuators, and more.

    An actuator is a named assembly of a motor, a gearbox (or none) and a winch; compatibilities say which gearboxes fit
    which motors; sources are the documents that state the figures. Every figure has its unit in the column's name
    (rated_torque_nm: N m) and every row its source. Unknown, unlimited and zero differ: an empty cell is unknown, the
    word unlimited says that there is no limit.

    \b
    Examples:
        actuator-select catalog list actuators --where "rated_power_w >= 50" --sort rated_torque_nm
        actuator-select catalog show "Actuator 4"
        actuator-select catalog fields motors
        actuator-select catalog import motors.csv --dry-run
        actuator-select catalog copy my-motor --as my-motor-24v nominal_voltage_v=24
        actuator-select catalog history my-motor
        actuator-select catalog check
    """


for subcommand in (list_rows, show, fields, add, edit, copy, remove, history, diff, import_file, export, check):
    command.add_command(subcommand)
