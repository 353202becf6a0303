"""The command `burmester`: decode, call one function, encode.

A command a file.  Rooms are imported inside the commands, so that `burmester --help` stays fast.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence

import click

from burmester import __version__, signals
from burmester.cli import streams
from burmester.cli.balance import balance
from burmester.cli.batch import batch
from burmester.cli.cases import cases
from burmester.cli.check import check
from burmester.cli.explain import explain
from burmester.cli.export import export
from burmester.cli.function import function
from burmester.cli.judge import judge
from burmester.cli.new import new
from burmester.cli.output import EXIT_FOUND, EXIT_INTERRUPT, EXIT_NOTHING, console, print_json
from burmester.cli.pairs import words_of_function
from burmester.cli.report import report
from burmester.cli.reproduce import reproduce
from burmester.cli.studio import studio
from burmester.cli.synthesize import synthesize
from burmester.errors import BurmesterError, InputError

__all__ = ["main"]


class _Commands(click.Group):
    """The commands; those of poses hand functions on."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command, and the words that follow it."""
        name, command, words = super().resolve_command(ctx, args)
        if command is not None and (of_pairs := words_of_function(ctx, command, words)) is not None:
            return function.name, function, of_pairs
        return name, command, words


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    invoke_without_command=True,
)
@click.version_option(__version__, prog_name="burmester")
@click.pass_context
def burmester(context: click.Context) -> None:
    """Planar four-bar linkages that guide a body through given poses.

    Start with: burmester synthesize poses.csv
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


COMMANDS = (
    new, check, synthesize, function, judge, balance, batch, report, export, studio, explain, cases,
    reproduce,
)  # fmt: skip
for command in COMMANDS:
    burmester.add_command(command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit: 0 a usable linkage found, 1 none, 2 bad input or usage, 3 a bug."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    with signals.handled(), streams.guarded(), warnings.catch_warnings():
        if not sys.warnoptions:  # numbers that overflow are judged by what comes of them
            warnings.simplefilter("ignore")
        code = _run(given)
        if (error := streams.failure()) is not None and code in (EXIT_FOUND, EXIT_NOTHING):
            code = _report(_unwritten(error), False)
    sys.exit(code)


def _run(given: Sequence[str]) -> int:
    """The exit code of a command, whatever comes of it."""
    as_json = "--json" in given
    try:
        code: int = burmester.main(given, prog_name="burmester", standalone_mode=False)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except (click.Abort, KeyboardInterrupt):
        click.echo("interrupted; no unfinished file is left", err=True)
        return EXIT_INTERRUPT
    except Exception as error:
        if (stopped := signals.exit_code()) is not None:  # what broke, broke by the signal
            return stopped
        if isinstance(error, click.UsageError):
            return _report(_usage(error), as_json)
        return _report(error if isinstance(error, BurmesterError) else _bug(error, given), as_json)
    return code


def _report(error: BurmesterError, as_json: bool) -> int:
    if as_json:
        from burmester.io.result import failure

        print_json(failure(error))
    from burmester.io.message import show

    show("error", error, console(stderr=True))
    return error.exit_code


def _usage(error: click.UsageError) -> InputError:
    command = error.ctx.command_path if error.ctx else "burmester"
    return InputError("E100", error.format_message(), help=f"see `{command} --help`")


def _unwritten(error: OSError) -> InputError:
    """Standard output that took nothing, or not all."""
    why = error.strerror or str(error)
    help = "free some space there, or send the output somewhere else"
    return InputError("E141", "standard output cannot be written", why=why, help=help)


def _bug(error: Exception, given: Sequence[str]) -> BurmesterError:
    """A failure of burmester itself, with a file that its authors can work with."""
    import tempfile
    import traceback

    last = traceback.extract_tb(error.__traceback__)[-1]
    send = "the command and the input that led here"
    try:
        handle, path = tempfile.mkstemp(prefix="burmester-", suffix=".txt")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            trace = "".join(traceback.format_exception(error))
            file.write(f"burmester {__version__}, Python {sys.version}\n{list(given)}\n\n{trace}")
        send = f"{path} and your input"
    except OSError:
        pass  # no place for a file: the message itself has to do
    return BurmesterError(
        "E900",
        f"burmester itself failed: {type(error).__name__}: {error}",
        where=f"{os.path.basename(last.filename)}:{last.lineno} in {last.name}",
        help=f"this is a bug; please report it with {send}",
    )
