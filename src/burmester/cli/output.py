"""The output of every command: exit codes, JSON, and consoles."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

    from burmester.synthesis.function_generation import AnySynthesis

EXIT_FOUND, EXIT_NOTHING, EXIT_INTERRUPT = 0, 1, 130  # errors bring their own: 2 and 3

CONTENT, NOTES = "content", "notes"  # of standard input, if it was read; to be told beside


def console(stderr: bool = False) -> Console:
    """Standard output, or standard error."""
    from rich.console import Console

    return Console(stderr=stderr, highlight=False, emoji=False)


def print_json(data: dict[str, Any]) -> None:
    """One line of JSON on standard output, and nothing else."""
    from burmester.io.result import json_line

    click.echo(json_line(data, sys.stdout.encoding or "utf-8"), nl=False)


def hand_over(
    synthesis: AnySynthesis,
    output: str | None,
    *beside: tuple[str | None, Callable[[], str | bytes]],
    force: bool,
    as_json: bool,
    **shown: bool,
) -> None:
    """A synthesis to the file `output`, if there is one, and to standard output.

    beside: other files, each with what makes its content; shown: as in `show_synthesis`.
    """
    from burmester.cli.progress_line import working
    from burmester.io import files
    from burmester.io.result import json_line, synthesis_data
    from burmester.printable import printable

    def result() -> str:
        return json_line(synthesis_data(synthesis))

    for path, content in ((output, result), *beside):
        if path is not None:
            with working("writing the result"):
                files.write(path, content(), force=force)
            click.echo(f"wrote {printable(path)}", err=True)
    if as_json:
        print_json(synthesis_data(synthesis))
    else:
        from burmester.io.terminal import show_synthesis

        show_synthesis(synthesis, console(), **shown)


def show_list(rows: list[tuple[str, str]]) -> None:
    """Names with what they stand for, in two columns as wide as the terminal."""
    formatter = click.HelpFormatter(width=shutil.get_terminal_size().columns, indent_increment=0)
    formatter.write_dl(rows)
    click.echo(formatter.getvalue(), nl=False)
