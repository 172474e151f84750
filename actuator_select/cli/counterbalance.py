"""``actuator-select workspace --counterbalance-interval``: which tension of the rope suits."""

from typing import TYPE_CHECKING

import click

from actuator_select.cli import console

if TYPE_CHECKING:
    from actuator_select.selection.support_intervals import RopeTensions


def print_tensions(found: "RopeTensions") -> None:
    """Print which positions some tension serves, the best constant one, and what a controlled range has to span."""
    from actuator_select.selection.wording import count_of

    interval, total = found.interval, len(found.positions)
    click.echo(
        f"Study {found.study.name}, {found.kind.value} workspace ({found.tension_model.value}): feasible tensions of "
        f"counterbalance {found.rope + 1}, whatever the study gives it"
    )
    rows = []
    for level in found.levels:
        fixed, active = interval.feasible_at(float(level)), interval.feasible_within(0.0, float(level))
        rows.append([f"{level:g}", count_of(int(fixed.sum()), total), count_of(int(active.sum()), total)])
    console.emit_table(["tension [N]", "constant", "controlled from 0"], rows, right=(0, 1, 2))
    tension, count = found.best
    click.echo(f"Some tension serves {count_of(int(interval.exists.sum()), total)} positions.")
    click.echo(f"The best constant tension is {tension:.6g} N: {count_of(count, total)}.")
    covering = interval.covering()
    if covering is None:
        click.echo("No tension or range of tensions serves every position.")
    elif covering[0] == covering[1]:
        click.echo(f"A constant {covering[0]:.6g} N serves every position.")
    else:
        click.echo(f"A range that is controlled has to span {covering[0]:.6g} to {covering[1]:.6g} N to serve all.")


def emit_intervals(found: "RopeTensions") -> None:
    """Print CSV: the interval of every judged position, empty where no tension is feasible."""
    rows = [
        [*(float(f"{value:.10g}") for value in position), _end(float(low)), _end(float(high))]
        for position, low, high in zip(found.positions, found.interval.lower, found.interval.upper, strict=True)
    ]
    console.emit_csv(["x_m", "y_m", "z_m", "tension_least_n", "tension_greatest_n"], rows)


def _end(value: float) -> float | str | None:
    shown = console.plain({"end": value})["end"]
    return float(f"{shown:.10g}") if isinstance(shown, float) else shown
