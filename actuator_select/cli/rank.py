"""``actuator-select rank``."""

import shlex
from typing import TYPE_CHECKING

import click

from actuator_select.cli import console, options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from actuator_select.selection import RankedActuator, Selection


SAFE_RULE = (
    "Feasible by the safe rule: one constant limit for all cables, the least that the cables' worst speed and\n"
    "acceleration leave; sufficient, so that the true share is no smaller. Acceleration: torque for load and rotor."
)
NO_EXACT_TEST = (
    "The exact joint test was not made: it leaves out turning platforms, sampled and listed motions, unknown figures,\n"
    "more than 12 cables, and what would take more than some seconds."
)


@click.command("rank")
@click.argument("study", metavar="STUDY")
@options.set_option
@options.where_option
@click.option(
    "--require",
    type=click.FloatRange(0.0, 100.0),
    metavar="PERCENT",
    help="Share of the workspace that has to be served; the study's own requirement by default.",
)
@click.option("--only-meeting", is_flag=True, help="Show only the actuators that meet the requirement.")
@options.format_option("table", "json", "csv")
@options.no_limit_option
@options.database_option
def command(
    study: str,
    overrides: tuple[str, ...],
    where: str,
    require: float | None,
    only_meeting: bool,
    output_format: str,
    no_limit: bool,
    database: str | None,
) -> None:
    """Rank actuators by the share of the workspace that they can serve.

    STUDY is a built-in study (see `actuator-select study list`) or a TOML file.

    \b
    Examples:
        actuator-select rank cpr8
        actuator-select rank cpr8 --require 80 --where "rated_power_w <= 100"
        actuator-select rank my-robot.toml --set motion.speed_max_m_per_s=0.8 --format json

    Actuators are ordered by verdict (meets, undecided, fails), feasible share, fewest checks not evaluated, smallest
    worst utilisation (demand over limit). The exit status is 0 also when no actuator meets the requirement.
    """
    from actuator_select.database import open_catalogue
    from actuator_select.selection import rank, selection_record
    from actuator_select.selection.part_wording import exceeded_notes
    from actuator_select.study import load_study, parse_overrides

    loaded = load_study(study, parse_overrides(overrides), limit=not no_limit)
    with open_catalogue(database) as catalogue:
        console.say_all(catalogue.notices)
        with console.progress("Evaluating") as progress:
            selection = rank(loaded, catalogue, where=where, require=require, progress=progress)
    exceeded = exceeded_notes(selection.shown(only_meeting=only_meeting))
    if output_format == "json":
        console.emit_json(selection_record(selection, only_meeting=only_meeting))
    elif output_format == "csv":
        _emit_csv(selection, only_meeting=only_meeting)
    else:
        print_ranking(selection, only_meeting=only_meeting)
    for note in exceeded:
        console.warn(note)
    if output_format == "table":
        console.say(f"Next: {_report_command(study)}")


def print_ranking(selection: "Selection", *, only_meeting: bool) -> None:
    """Print the answer in three lines, what the percentage is of, the table, its notes, and the warnings."""
    from actuator_select.selection.wording import actuator_count, heading, summary
    from actuator_select.selection.workspaces import reasons_why_nothing_holds

    why = reasons_why_nothing_holds(selection.study, selection.attainable_poses)
    for line in [*summary(selection), *why, "", *heading(selection)]:
        click.echo(line)
    actuators = selection.shown(only_meeting=only_meeting)
    if actuators:
        _print_table(selection, actuators)
        for line in _notes(selection, actuators):
            click.echo(line)
    meeting, ranked = len(selection.shown(only_meeting=True)), actuator_count(len(selection.ranked))
    verb = "meets" if 1 in (meeting, len(selection.ranked)) else "meet"
    click.echo(f"{meeting} of {ranked} {verb} the requirement of {selection.required_percent:g} %.")
    for warning in selection.warnings:
        console.warn(warning.text)


def _print_table(selection: "Selection", actuators: "Sequence[RankedActuator]") -> None:
    """Print a row per actuator: verdict, share, every check of the study, what limits it."""
    from actuator_select.selection.wording import check_cell, limited_by, marked, share

    checks = selection.study.checks
    header = ["", "actuator", "verdict", "feasible", *(check.value for check in checks), "limited by"]
    rows = [
        [
            str(place),
            marked(actuator),
            actuator.verdict.value,
            share(actuator, selection.poses),
            *(check_cell(actuator.checks[check], selection.poses) for check in checks),
            limited_by(actuator, selection.poses, selection.attainable_poses),
        ]
        for place, actuator in enumerate(actuators, start=1)
    ]
    console.emit_table(header, rows, right=range(3, 4 + len(checks)))


def _notes(selection: "Selection", actuators: "Sequence[RankedActuator]") -> list[str]:
    """What to know about the table: checks not evaluated, assumptions, how a check counts, what is not checked."""
    from actuator_select.selection.part_wording import left_out_note
    from actuator_select.selection.wording import assumption_notes, check_notes, unchecked_limits

    notes = [*check_notes(actuators), *(f"* Assumed: {note}" for note in assumption_notes(actuators))]
    notes += [note] if (note := left_out_note(actuators)) else []
    notes.append("Each check: positions that this limit alone allows, worst demand / limit over the whole motion set.")
    if not selection.study.tension_model.lets_cables_push:
        exact = [f"{one.name} {one.exact_poses}" for one in actuators if one.exact_poses is not None]
        notes += [SAFE_RULE, f"By the exact joint test, positions: {', '.join(exact)}." if exact else NO_EXACT_TEST]
    rows = [selection.result.candidates.rows[actuator.index] for actuator in actuators]
    return [*notes, f"Not checked, even where the catalogue states it: {unchecked_limits(rows)}."]


def _emit_csv(selection: "Selection", *, only_meeting: bool) -> None:
    from actuator_select.selection.wording import assumed_words

    checks = list(selection.study.checks)
    header = ["id", "name", "verdict", "feasible_percent", "feasible_poses", "poses"]
    header += [f"{check.value}_{what}" for check in checks for what in ("state", "poses", "worst_utilisation")]
    header += ["assumptions", "left_out", "exceeded_part_limits", "feasible_is_upper_bound", "feasible_poses_exact"]
    header += [f"{check.value}_{what}" for check in checks for what in ("missing", "reason")]
    rows = []
    for actuator in selection.shown(only_meeting=only_meeting):
        row: list[object] = [
            actuator.id,
            actuator.name,
            actuator.verdict.value,
            round(actuator.feasible_percent, 2),
            actuator.feasible_poses,
            selection.poses,
        ]
        for check in checks:
            verdict = actuator.checks[check]
            row += [verdict.state.value, verdict.poses, verdict.worst_utilisation]
        row += [
            "; ".join(assumed_words([one]) for one in actuator.assumptions),
            "; ".join(actuator.left_out),
            "; ".join(one.text for one in actuator.exceeded),
            actuator.is_upper_bound,
            actuator.exact_poses,
        ]
        for check in checks:
            row += ["; ".join(actuator.checks[check].missing), actuator.checks[check].reason]
        rows.append(row)
    console.emit_csv(header, rows)


def _report_command(study: str) -> str:
    """The report of this very ranking: the options as they were typed, but for those that `report` does not have."""
    typed = list(click.get_current_context().find_root().obj)
    words = [word for word in typed if word not in ("rank", study, "--only-meeting")]
    if "--format" in words:
        at = words.index("--format")
        del words[at : at + 2]
    return shlex.join(["actuator-select", "report", study, *words])
