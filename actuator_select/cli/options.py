"""Options that several commands share."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

_Command = TypeVar("_Command", bound=Callable[..., Any])


def database_option(function: _Command) -> _Command:
    """``--database``: which catalogue."""
    return click.option(
        "--database",
        envvar="ACTUATOR_SELECT_DATABASE",
        metavar="URL",
        help="Catalogue database: a file or an SQLAlchemy URL. "
        "Default: catalogue.db in your user data folder, made and filled on first use. "
        "[env: ACTUATOR_SELECT_DATABASE]",
    )(function)


def set_option(function: _Command) -> _Command:
    """``--set``: override keys of the study."""
    return click.option(
        "--set",
        "overrides",
        multiple=True,
        metavar="KEY=VALUE",
        help="Override a key of the study with a TOML value, e.g. --set workspace.points=[11,11,11]. "
        "May be given again.",
    )(function)


def where_option(function: _Command) -> _Command:
    """``--where``: which rows."""
    return click.option(
        "--where",
        default="",
        metavar="EXPRESSION",
        help="Keep rows that meet the expression, e.g. \"rated_power_w >= 50 and motor.manufacturer = 'maxon'\".",
    )(function)


def format_option(*formats: str) -> Callable[[_Command], _Command]:
    """``--format``: how the result is printed."""
    return click.option(
        "--format",
        "output_format",
        type=click.Choice(formats),
        default=formats[0],
        show_default=True,
        help="How the result is printed.",
    )
