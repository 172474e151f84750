"""``actuator-select simulate``."""

from math import isnan
from typing import TYPE_CHECKING, Any

import click

from actuator_select.cli import console, options

if TYPE_CHECKING:
    from pathlib import Path

    from actuator_select.selection import Simulation


class Vector(click.ParamType[tuple[float, ...]]):
    """Three numbers, separated by commas."""

    name = "x,y,z"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:  # noqa: ANN401
        """Read the numbers."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in str(value).split(","))
        except ValueError:
            numbers = ()
        if len(numbers) != 3:  # noqa: PLR2004 - x, y, z
            self.fail(f"{value!r}, expected three numbers separated by commas, such as 0.153,0.153,-0.153", param, ctx)
        return numbers


@click.command("simulate")
@click.argument("study", metavar="STUDY")
@click.argument("actuator", metavar="ACTUATOR")
@click.option("--from", "start", type=Vector(), required=True, help="Start of the line [m].")
@click.option("--to", "stop", type=Vector(), required=True, help="End of the line [m].")
@click.option(
    "--orientation-rad",
    "orientation",
    type=Vector(),
    default="0,0,0",
    show_default=True,
    help="Angles ψ, θ, φ of the platform, constant over the move [rad].",
)
@options.set_option
@options.plot_option("Draw the histories with their limits")
@options.format_option("table", "json", "csv")
@options.database_option
def command(
    study: str,
    actuator: str,
    start: tuple[float, float, float],
    stop: tuple[float, float, float],
    orientation: tuple[float, float, float],
    overrides: tuple[str, ...],
    plot: "Path | None",
    output_format: str,
    database: str | None,
) -> None:
    """Drive one actuator along a straight line and show its limits.

    ACTUATOR is the id or the name of a catalogue actuator; every cable has one of it. The move starts and ends at
    rest, with the study's greatest speed and ramp times; a short move keeps the accelerations and peaks below.

    \b
    Example (figure 6b of Filipović & Kevac 2018):
        actuator-select simulate cpr8 "Actuator 1" --from 0.153,0.153,-0.153 --to 3.047,0.153,-0.153 \
            --orientation-rad 0.5,0.5,0.5 --plot run.svg

    CSV gives the histories, JSON the peaks and exceedances.
    """
    from actuator_select.database import open_catalogue
    from actuator_select.selection import simulate
    from actuator_select.selection.records import simulation_record
    from actuator_select.study import load_study, parse_overrides

    draw = options.plot_writer(plot)
    loaded = load_study(study, parse_overrides(overrides))
    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        run = simulate(loaded, catalogue, actuator, start=start, stop=stop, orientation=orientation)
    if plot is not None:
        from actuator_select.report.drive_figures import simulation_figure

        draw(simulation_figure(run))
    if output_format == "json":
        console.emit_json(simulation_record(run))
    elif output_format == "csv":
        frame = run.frame()
        console.emit_csv(list(frame.columns), frame.astype(object).where(frame.notna(), None).to_numpy().tolist())
    else:
        print_simulation(run)


def print_simulation(run: "Simulation") -> None:
    """Print the peaks per actuator, what exceeds which limit when, and warnings."""
    from actuator_select.selection.move_wording import check_words, move_words, pushing_words, unheld_words
    from actuator_select.selection.simulation import UNITS
    from actuator_select.selection.wording import assumed_words, inapplicable_words, unchecked_limits, unknown_words

    click.echo(move_words(run))
    header = ["actuator", *(f"|{check_words(run, check)}| [{UNITS[check]}]" for check in run.checks)]
    rows = [
        [str(cable + 1), *(_cell(run.peaks[check][cable]) for check in run.checks)]
        for cable in range(run.study.robot.cables)
    ]
    rows.append(["limit", *(_cell(run.limits[check]) for check in run.checks)])
    console.emit_table(header, rows, right=range(1, 1 + len(run.checks)))
    terminals = "" if run.not_applicable else " (voltage at the motor's terminals)"
    click.echo(f"Largest magnitudes at the shaft behind the gearbox{terminals}.")
    for text in unheld_words(run):
        click.echo(f"  {text}")
    _print_limits(run)
    for check, missing in run.missing.items():
        click.echo(f"  {check_words(run, check)} not evaluated: {unknown_words(missing, run.assumable)}")
    for check, reason in run.not_applicable.items():
        click.echo(f"  {inapplicable_words(check, reason)}")
    for assumed in run.candidates.assumed[0]:
        click.echo(f"  assumed: {assumed_words([assumed])}")
    if left_out := run.candidates.left_out[0]:
        click.echo(f"  left out, because neither catalogue nor study states it: {' and '.join(left_out)}")
    click.echo(f"Not checked, even where the catalogue states it: {unchecked_limits(run.candidates.rows)}.")
    if run.pushing:
        console.warn(pushing_words(run))
    for warning in run.glossed_over:
        console.warn(warning)


def _print_limits(run: "Simulation") -> None:
    """Print what exceeds which limit when, or that nothing does."""
    from actuator_select.selection.move_wording import exceedance_words, together_words

    for exceedance in run.exceedances:
        click.echo(f"  {exceedance_words(run, exceedance)}")
    if not (run.exceedances or run.missing or run.unheld):
        pushing = ", if its cables could push" if run.pushing else ""
        click.echo(f"Every limit holds over the whole move{pushing}.")
    for text in together_words(run):
        click.echo(f"  note: {text}")


def _cell(value: float) -> str:
    """A number of a table; an unknown one is a dash."""
    return "–" if isnan(value) else f"{value:.5g}"
