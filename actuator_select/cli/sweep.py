"""``actuator-select sweep``."""

import shlex
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options

if TYPE_CHECKING:
    from pathlib import Path

    from actuator_select.selection.sweeps import Sweep, SweepPoint


@click.command("sweep")
@click.argument("study", metavar="STUDY")
@click.argument("ranges", metavar="KEY=RANGE...", nargs=-1, required=True)
@options.workspace_options
@options.set_option
@options.format_option("table", "csv", "json")
@options.plot_option(
    "Draw area, volume or share over the first key (a line per value of the second key, a map where both have many)"
)
@options.no_limit_option
def command(
    study: str,
    ranges: tuple[str, ...],
    kind: str,
    orientations: str,
    tension_model: str | None,
    overrides: tuple[str, ...],
    output_format: str,
    plot: "Path | None",
    no_limit: bool,
) -> None:
    """Find the workspace over ranges of one or more keys of the study.

    KEY is any numeric key of the study (`actuator-select study show STUDY`), entries of lists too. RANGE is
    START:STOP:STEP, the stop included where a step meets it, or a list in brackets. All combinations are taken.

    \b
    Examples:
        actuator-select sweep cpr8 payload.mass_kg=1:5:1 cables.tension_max_n=[20,40] --tension-model force_only
        actuator-select sweep my-robot.toml cables.tension_max_n=[500,1000,2000] motion.speed_max_m_per_s=0.5:2:0.5
        actuator-select sweep my-robot.toml "payload.force_n[1]=-100:100:20" --plot sweep.svg --format csv

    Kinds, measures and their intervals are those of `actuator-select workspace`.
    """
    from actuator_select.model.tension import TensionModel
    from actuator_select.model.workspace import OrientationRule, WorkspaceKind
    from actuator_select.selection.sweeps import sweep_record, sweep_workspace
    from actuator_select.study import parse_overrides
    from actuator_select.study.sweeping import parse_sweep

    draw = options.plot_writer(plot)
    axes = parse_sweep(ranges)
    with console.progress("Sweeping") as progress:
        sweep = sweep_workspace(
            study,
            axes,
            overrides=parse_overrides(overrides),
            kind=WorkspaceKind(kind),
            over=OrientationRule(orientations),
            tension_model=None if tension_model is None else TensionModel(tension_model),
            limit=not no_limit,
            progress=progress,
        )
    if plot is not None:
        from actuator_select.report.sweep_figures import sweep_figure

        draw(sweep_figure(sweep))
    if output_format == "json":
        console.emit_json(sweep_record(sweep))
    elif output_format == "csv":
        _emit_csv(sweep)
    else:
        print_sweep(sweep)
        console.say(f"Next: {_next_command(sweep, study, overrides, tension_model)}")


def print_sweep(sweep: "Sweep") -> None:
    """Print a row per combination, and the best one."""
    from actuator_select.selection.workspaces import measure_warnings, unit_words

    keys = [axis.key for axis in sweep.axes]
    unit = sweep.points[0].measure_unit
    shown = "" if unit is None else f" [{unit_words(unit)}]"
    click.echo(
        f"Study {sweep.study.name}, {sweep.kind.value} workspace, orientations: {sweep.over.value}, "
        f"tensions: {sweep.tension_model.value}"
    )
    header = [*keys, "feasible", "[%]", f"measure{shown}", f"cells, from{shown}", f"to{shown}"]
    console.emit_table(header, [_row(point) for point in sweep.points], right=range(len(header)))
    best = ", ".join(f"{key} = {value:g}" for key, value in zip(keys, sweep.best.values, strict=True))
    click.echo(f"Most is feasible at {best}: {sweep.best.feasible_poses} of {sweep.best.poses} positions.")
    beyond = {
        text
        for point in sweep.points
        if point.measure is not None and point.measure_most is not None
        for text in measure_warnings(point.measure, point.measure_most)
    }
    for text in beyond:
        console.warn(text)
    if len(sweep.points) > 1 and len({point.feasible_poses for point in sweep.points}) == 1:
        console.warn("the count is the same at every combination: none of these keys decides it within its range")


def _row(point: "SweepPoint") -> list[str]:
    percent = "–" if point.feasible_percent is None else f"{point.feasible_percent:.2f}"
    measures = [
        "–" if value is None else f"{value:.5g}" for value in (point.measure, point.measure_least, point.measure_most)
    ]
    return [*(f"{value:g}" for value in point.values), f"{point.feasible_poses}/{point.poses}", percent, *measures]


def _emit_csv(sweep: "Sweep") -> None:
    from actuator_select.selection.sweeps import COLUMNS

    rows = [[*point.values, *(getattr(point, name) for name in COLUMNS)] for point in sweep.points]
    console.emit_csv([*(axis.key for axis in sweep.axes), *COLUMNS], rows)


def _next_command(sweep: "Sweep", study: str, overrides: tuple[str, ...], tension_model: str | None) -> str:
    """The same workspace at the best combination."""
    best = [f"{axis.key}={value}" for axis, value in zip(sweep.axes, sweep.best.values, strict=True)]
    words = ["--kind", sweep.kind.value, "--orientations", sweep.over.value]
    words += ["--tension-model", tension_model] if tension_model is not None else []
    words += [word for one in (*overrides, *best) for word in ("--set", one)]
    return shlex.join(["actuator-select", "workspace", study, *words])
