"""``actuator-select workspace``."""

import shlex
from math import isfinite, isinf, isnan
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options

if TYPE_CHECKING:
    from pathlib import Path

    from actuator_select.model.tension import TensionModel
    from actuator_select.model.workspace import OrientationRule, WorkspaceKind
    from actuator_select.selection.workspaces import WorkspaceResult
    from actuator_select.study import Study


@click.command("workspace")
@click.argument("study", metavar="STUDY")
@options.workspace_options
@options.set_option
@options.format_option("table", "json", "csv")
@options.plot_option("Draw the workspace")
@click.option(
    "--counterbalance-interval",
    is_flag=True,
    help="Find the feasible tensions of a counterbalance rope at every position instead: a constant tension, a range "
    "that is controlled, what would serve all.",
)
@click.option(
    "--counterbalance",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    metavar="NUMBER",
    help="Which one, with --counterbalance-interval; the others keep their tensions.",
)
@options.no_limit_option
def command(
    study: str,
    kind: str,
    orientations: str,
    tension_model: str | None,
    overrides: tuple[str, ...],
    output_format: str,
    plot: "Path | None",
    counterbalance_interval: bool,
    counterbalance: int,
    no_limit: bool,
) -> None:
    """Find where the robot can work, whatever drives it.

    STUDY is a built-in study (see `actuator-select study list`) or a TOML file. No actuators are looked at: the share
    is what cables within the bounds of [cables] can do.

    \b
    Kinds, from the least that is asked to the most:
        reachable         cable lengths within their bounds, nothing else
        static            tensions within their bounds hold platform and load at rest
        wrench-feasible   ... against the whole box of external loads
        dynamic-feasible  ... and every acceleration of the motion set
        twist-feasible    cable speeds within cables.speed_max_m_per_s, no tensions

    \b
    Examples:
        actuator-select workspace cpr8 --kind static --tension-model wrench_feasible
        actuator-select workspace my-robot.toml --plot workspace.svg
        actuator-select workspace my-robot.toml --set workspace.grid=midpoints --format json

    Every load of the study has to hold. Area or volume is an estimate: positions times the cell of the grid, with the
    interval from the cells that are surely inside, as far as the grid tells, to these and those on the border. CSV
    gives the verdict, the margin and the minimax tension of every position (empty where none within the bounds holds).

    That nothing is feasible is a result, with its reasons; the exit status is 0.
    """
    from actuator_select.model.tension import TensionModel
    from actuator_select.model.workspace import OrientationRule, WorkspaceKind
    from actuator_select.selection.workspaces import evaluate_workspace, workspace_record
    from actuator_select.study import load_study, parse_overrides

    draw = options.plot_writer(plot)
    loaded = load_study(study, parse_overrides(overrides), limit=not no_limit)
    model = None if tension_model is None else TensionModel(tension_model)
    if counterbalance_interval:
        if plot is not None:
            raise click.UsageError("--plot draws a workspace, not --counterbalance-interval; give one of them")
        asked = (WorkspaceKind(kind), OrientationRule(orientations), model)
        _show_tensions(loaded, counterbalance - 1, asked, output_format)
        return
    with console.progress("Finding the workspace") as progress:
        result = evaluate_workspace(
            loaded,
            kind=WorkspaceKind(kind),
            over=OrientationRule(orientations),
            tension_model=model,
            progress=progress,
        )
    if plot is not None:
        from actuator_select.report.robot_workspace import workspace_map

        draw(workspace_map(result))
    if output_format == "json":
        console.emit_json(workspace_record(result))
    elif output_format == "csv":
        _emit_csv(result)
    else:
        print_workspace(result)
        console.say(f"Next: {_next_command(result, study)}")


def _show_tensions(
    study: "Study", rope: int, asked: "tuple[WorkspaceKind, OrientationRule, TensionModel | None]", output_format: str
) -> None:
    from actuator_select.cli.counterbalance import emit_intervals, print_tensions
    from actuator_select.selection.support_intervals import rope_record, rope_tensions

    kind, over, model = asked
    with console.progress("Finding the tensions") as progress:
        found = rope_tensions(study, rope=rope, kind=kind, over=over, tension_model=model, progress=progress)
    if output_format == "json":
        console.emit_json(rope_record(found))
    elif output_format == "csv":
        emit_intervals(found)
    else:
        print_tensions(found)


def print_workspace(result: "WorkspaceResult") -> None:
    """Print what the share is of, the figures, reasons and warnings."""
    from actuator_select.selection.workspaces import workspace_basis

    click.echo(f"Study {result.study.name}, {result.kind.value} workspace. The share is of")
    for name, text in workspace_basis(result).items():
        click.echo(f"  {name:<14}{text}")
    console.emit_table(["", ""], [[name, value] for name, value in _figures(result)])
    for reason in result.reasons:
        click.echo(f"Nothing is feasible. {reason}" if reason is result.reasons[0] else reason)
    for warning in result.warnings:
        console.warn(warning)


def _figures(result: "WorkspaceResult") -> list[tuple[str, str]]:
    from actuator_select.selection.wording import count_of
    from actuator_select.selection.workspaces import unit_words

    rows = [("feasible", count_of(result.feasible_poses, result.poses) if result.poses else "no position judged")]
    if result.measured is not None and result.unit is not None:
        unit = unit_words(result.unit)
        inner, outer = result.measured.inner, result.measured.outer
        name = {1: "length", 2: "area", 3: "volume"}[result.measured.dimension]
        rows.append(
            (f"{name}, estimated", f"{result.measured.value:.5g} {unit} (cells: {inner:.5g} to {outer:.5g} {unit})")
        )
    rows.append(("short of rank", f"{result.singular_poses} positions"))
    rows.append(("too near to an anchor", f"{result.too_near_poses} positions, not judged"))
    if result.connected_percent is not None:
        home = ", ".join(f"{value:g}" for value in result.study.table.workspace.home_m or ())
        rows.append(("connected to home", f"{result.connected_percent:.1f} % of the feasible, home ({home}) m"))
    if result.largest_tension is not None:
        least = "largest tension" if result.tension_model.lets_cables_push else "largest minimax tension"
        rows.append((least, f"{result.largest_tension:.4g} N over the feasible positions"))
    margins = result.margin[result.feasible]
    if len(margins) and isfinite(float(margins.min())):
        rows.append(("least margin inside", f"{float(margins.min()):.4g} {result.margin_unit}"))
    return rows


def _emit_csv(result: "WorkspaceResult") -> None:
    margin_column = {"N": "margin_n", "m": "margin_m", "m/s": "margin_m_per_s"}[result.margin_unit]
    rows = [
        [
            *(float(f"{value:.10g}") for value in position),
            int(feasible),
            _margin(float(margin)),
            None if isnan(tension) or isinf(tension) else float(f"{tension:.10g}"),
            int(apart),
        ]
        for position, feasible, margin, tension, apart in zip(
            result.study.positions, result.feasible, result.margin, result.tension, result.apart, strict=True
        )
    ]
    console.emit_csv(["x_m", "y_m", "z_m", "feasible", margin_column, "tension_n", "apart"], rows)


def _margin(value: float) -> float | str | None:
    """Empty where no tension balances what is asked, so that there is no distance to a border."""
    if isnan(value) or (isinf(value) and value < 0.0):
        return None
    return "unlimited" if isinf(value) else float(f"{value:.10g}")


def _next_command(result: "WorkspaceResult", study: str) -> str:
    """Rank the actuators over the same grid, or report where none are asked for: what was set stays set."""
    typed = list(click.get_current_context().find_root().obj or ())
    kept = [word for index, word in enumerate(typed) if word.startswith("--set") or typed[index - 1] == "--set"]
    following = "report" if result.study.table.candidates.kind == "none" else "rank"
    return shlex.join(["actuator-select", following, study, *kept])
