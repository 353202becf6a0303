"""What every command puts out: exit codes, JSON, and the consoles it draws on."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["EXIT_FOUND", "EXIT_INTERRUPT", "EXIT_NOTHING", "as_line", "console", "print_json"]

EXIT_FOUND, EXIT_NOTHING, EXIT_INTERRUPT = 0, 1, 130  # errors bring their own: 2 and 3


def console(stderr: bool = False) -> Console:
    """Standard output, or standard error."""
    from rich.console import Console

    return Console(stderr=stderr, highlight=False)


def as_line(data: dict[str, Any], encoding: str = "utf-8") -> str:
    """A line of JSON with all digits; what the encoding does not have is escaped."""
    line = json.dumps(data, ensure_ascii=False, allow_nan=False) + "\n"
    try:
        line.encode(encoding)
    except UnicodeEncodeError:  # half a character too, of a name or a path
        line = json.dumps(data, allow_nan=False) + "\n"
    return line


def print_json(data: dict[str, Any]) -> None:
    """That line on standard output, and nothing else."""
    click.echo(as_line(data, sys.stdout.encoding or "utf-8"), nl=False)
