"""Options that several commands share."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from actuator_select.cli import console

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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


def no_limit_option(function: _Command) -> _Command:
    """``--no-limit``: go ahead with a grid of any size."""
    return click.option(
        "--no-limit",
        is_flag=True,
        help="Take a grid of any size; beyond a limit it is refused otherwise, with an estimate of time and memory.",
    )(function)


class Words(click.Choice[str]):
    """A choice among names that may be typed with - or _, and without their ending."""

    def __init__(self, words: Sequence[str], ending: str = "") -> None:
        super().__init__(words, case_sensitive=False)
        self._ending = ending

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:  # noqa: ANN401
        """Bring what was typed to the name that is meant."""
        typed = str(value).lower().replace("_", "-")
        for word in self.choices:
            if typed in (word.replace("_", "-"), word.replace("_", "-").removesuffix(self._ending)):
                return word
        return super().convert(value, param, ctx)


def workspace_options(function: _Command) -> _Command:
    """``--kind``, ``--orientations`` and ``--tension-model``: which workspace."""
    for option in (
        click.option(
            "--tension-model",
            type=Words(("wrench_feasible", "force_only", "pseudo_inverse")),
            help="How the cables share the load; the study's own model by default. Under pseudo_inverse a position "
            "counts where the tensions of least norm balance what is asked and stay within their bounds.",
        ),
        click.option(
            "--orientations",
            type=Words(("total", "inclusion", "constant")),
            default="total",
            show_default=True,
            help="Count a position that holds at every orientation of the study, at some orientation, or at the first.",
        ),
        click.option(
            "--kind",
            type=Words(
                ("dynamic-feasible", "wrench-feasible", "static", "twist-feasible", "reachable"), ending="-feasible"
            ),
            default="dynamic-feasible",
            show_default=True,
            help="What has to be possible at a position.",
        ),
    ):
        function = option(function)
    return function


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


def plot_option(what: str) -> Callable[[_Command], _Command]:
    """``--plot``: which file a picture goes to; `what` begins its help, ``Draw the robot``."""
    return click.option(
        "--plot",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help=f"{what}, as .svg, .png or .pdf.",
    )


def plot_writer(plot: Path | None) -> Callable[["Figure"], None]:
    """Check the name of a ``--plot`` file before any work, and give back what writes a figure there.

    Raises
    ------
    click.BadParameter
        If the name does not say a format.
    """
    if plot is None:
        return lambda _: None
    from actuator_select._resources import refuse_no_folder, replace_atomically
    from actuator_select.report.style import IMAGE_FORMATS, image_bytes

    suffix = plot.suffix.lower().removeprefix(".")
    if suffix not in IMAGE_FORMATS:
        raise click.BadParameter(
            f"{plot}: expected a name that ends in {', '.join(IMAGE_FORMATS)}", param_hint="--plot"
        )

    refuse_no_folder(plot)

    def write(figure: "Figure") -> None:
        replace_atomically(plot, image_bytes(figure, suffix))
        console.say(f"Wrote {plot}")

    return write
