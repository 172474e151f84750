"""What every command says, and where: results to stdout, everything else to stderr."""

import csv
import io
import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import click

PIPED_WIDTH = 200  # columns of a table that goes to a file or a pipe
ANY_HEIGHT = 50  # lines; tables are not cut to it
PROGRESS_DELAY = 1.0  # seconds before a progress bar appears


def emit_json(value: object) -> None:
    """Print strict JSON; a NaN or an infinity in it is a fault of the program."""
    click.echo(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False))


def emit_csv(header: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """Print CSV; None is an empty cell."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([["" if cell is None else cell for cell in row] for row in rows])
    click.echo(text.getvalue(), nl=False)


def terminal_width() -> int | None:
    """Characters in a line of the terminal; None where the result goes to a file or a pipe."""
    from shutil import get_terminal_size

    return get_terminal_size().columns if sys.stdout.isatty() else None


def emit_table(
    header: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    right: Sequence[int] = (),
    title: str | None = None,
    piped_width: int = PIPED_WIDTH,
) -> None:
    """Print a table for people; `right` lists the columns that are aligned to the right."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left", pad_edge=False, show_header=any(header))
    for index, name in enumerate(header):
        table.add_column(Text(name), justify="right" if index in right else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    # With a height, too: rich takes every dumb terminal to have 80 columns otherwise.
    Console(width=terminal_width() or piped_width, height=ANY_HEIGHT, highlight=False).print(table)


def say(text: str) -> None:
    """Tell the user something that is not the result."""
    click.echo(text, err=True)


def say_all(notices: Sequence[str]) -> None:
    """Tell the user several things, such as what opening the catalogue did."""
    for notice in notices:
        say(notice)


def warn(text: str) -> None:
    """Warn the user."""
    click.echo(f"Warning: {text}", err=True)


@contextmanager
def progress(label: str) -> Iterator[Callable[[int, int], None]]:
    """Show a bar with the time left on stderr once the work has taken a while.

    Yields
    ------
    callable
        To be called with (done, total).
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    began = _clock()
    console = Console(stderr=True)
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        auto_refresh=False,
    )
    task = bar.add_task(label, total=None)

    def advance(done: int, total: int) -> None:
        # Started only now: a bar that starts and stops leaves an empty line in a log.
        if console.is_terminal and _clock() - began > PROGRESS_DELAY:
            bar.start()
        bar.update(task, completed=done, total=total, refresh=True)

    try:
        yield advance
    finally:
        if bar.live.is_started:
            bar.stop()


def _clock() -> float:
    from time import monotonic

    return monotonic()


def plain(record: Mapping[str, Any]) -> dict[str, Any]:
    """Make a record fit for strict JSON: an unlimited figure becomes the word ``"unlimited"``, NaN becomes null."""
    from math import isinf, isnan

    def cell(value: object) -> object:
        if isinstance(value, float) and isinf(value):
            return "unlimited"
        if isinstance(value, float) and isnan(value):
            return None
        return value

    return {key: cell(value) for key, value in record.items()}
