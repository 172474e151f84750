"""The command line: thin commands over the public Python functions.

Commands are imported when they are called, so that ``--help`` answers at once.
"""

import errno
import importlib
import io
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

import click

from actuator_select._version import __version__
from actuator_select.errors import ActuatorSelectError

EXIT_DONE = 0
EXIT_OUR_FAULT = 1
EXIT_BAD_INPUT = 2
EXIT_INTERRUPTED = 130
EXIT_TERMINATED = 143
OUTPUT_ERRORS = (errno.EPIPE, errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)  # of a stream that takes no more

COMMANDS = {
    "workspace": ("actuator_select.cli.workspace", "Find where the robot can work, whatever drives it."),
    "sweep": ("actuator_select.cli.sweep", "Find the workspace over ranges of one or more keys of the study."),
    "rank": ("actuator_select.cli.rank", "Rank actuators by the share of the workspace that they can serve."),
    "report": ("actuator_select.cli.report", "Write the design report, one self-contained HTML file."),
    "simulate": ("actuator_select.cli.simulate", "Drive one actuator along a straight line and show its limits."),
    "study": ("actuator_select.cli.study", "List, show and start study files."),
    "robot": ("actuator_select.cli.robot", "Show a robot: anchors, rope lengths, forces on the frame, warnings."),
    "catalog": ("actuator_select.cli.catalog", "Query, extend and check the catalogue."),
}


class LazyGroup(click.Group):
    """A group that knows its commands by name and imports one when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - the signature is click's
        """Name the commands, in the order of a first session."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import one command."""
        if cmd_name not in COMMANDS:
            return None
        module, _ = COMMANDS[cmd_name]
        command: click.Command = importlib.import_module(module).command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """List the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, summary) for name, (_, summary) in COMMANDS.items()])


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(__version__, prog_name="actuator-select")
def command() -> None:
    """Choose motors, gearboxes and winches for cable-driven robots.

    \b
    Start with the paper's case study:
        actuator-select rank cpr8
        actuator-select report cpr8 --output cpr8.html
    Then with your own robot:
        actuator-select study new my-robot.toml
        actuator-select robot show my-robot.toml --plot my-robot.svg
        actuator-select rank my-robot.toml
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program.

    Parameters
    ----------
    arguments : sequence of str, optional
        The command line without the program's name; the process's own by default.

    Returns
    -------
    int
        0 done, 1 a fault of the program, 2 the question cannot be posed, 130 interrupted, 143 terminated.
    """
    with _interrupts() as interrupts:
        try:
            _prepare_streams()
            status = _run(arguments, interrupts)
            sys.stdout.flush()
        except Exception as error:
            if isinstance(error, OSError) and error.errno in OUTPUT_ERRORS:
                return _output_failed(error)
            if interrupts:  # libraries may turn an interrupt into an error of their own
                return _say_interrupted(interrupts)
            if os.environ.get("ACTUATOR_SELECT_TRACEBACK"):
                raise
            return _admit_fault(error)
        return status


def _admit_fault(error: Exception) -> int:
    click.echo(
        f"Error: a fault of actuator-select, not of your input: {type(error).__name__}: {error}\n"
        "Set ACTUATOR_SELECT_TRACEBACK=1, repeat the command and report what it prints.",
        err=True,
    )
    return EXIT_OUR_FAULT


def _run(arguments: Sequence[str] | None, interrupts: Sequence[int]) -> int:
    try:
        typed = list(sys.argv[1:] if arguments is None else arguments)
        command.main(args=typed, prog_name="actuator-select", standalone_mode=False, obj=typed)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except click.ClickException as error:
        error.show()
        return EXIT_BAD_INPUT
    except ActuatorSelectError as error:
        click.echo(f"Error: {error}", err=True)
        return EXIT_BAD_INPUT
    except (click.Abort, KeyboardInterrupt):
        return _say_interrupted(interrupts)
    except SystemExit:
        # Click leaves so when the reader of a pipe (head, less) has what it wanted, and after shell completion.
        return EXIT_DONE
    return EXIT_DONE


def _prepare_streams() -> None:
    """Write UTF-8 whatever the locale says, and survive closed streams."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123, SIM115 - lives as long as we
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8", errors="replace")


@contextmanager
def _interrupts() -> Iterator[list[int]]:
    """A list of the signals that came, of Ctrl-C and SIGTERM; KeyboardInterrupt is raised for both."""
    seen: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        seen.append(number)
        signal.default_int_handler(number, frame)

    usual: dict[signal.Signals, Any] = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: signal.SIG_DFL}
    in_main_thread = threading.current_thread() is threading.main_thread()
    # Others are somebody else's, or ignored as in a shell's background jobs.
    ours = [one for one, handler in usual.items() if in_main_thread and signal.getsignal(one) is handler]
    for one in ours:
        signal.signal(one, note)
    try:
        yield seen
    finally:
        for one in ours:
            signal.signal(one, usual[one])


def _say_interrupted(interrupts: Sequence[int]) -> int:
    if signal.SIGTERM in interrupts:
        click.echo("Terminated.", err=True)
        return EXIT_TERMINATED
    click.echo("Interrupted.", err=True)
    return EXIT_INTERRUPTED


def _output_failed(error: OSError) -> int:
    """End after the result could not be printed; nothing may be left for the interpreter to flush at its exit."""
    with suppress(io.UnsupportedOperation, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(error, BrokenPipeError):  # the reader (head, less) has what it wanted
        return EXIT_DONE
    with suppress(OSError):
        click.echo(
            f"Error: cannot write the result: {error.strerror or error}; make room, or write elsewhere", err=True
        )
    return EXIT_BAD_INPUT
