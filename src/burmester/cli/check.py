"""`burmester check`: the poses as they are read, and what stands out among them."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import READ, Sectioned, takes, task
from burmester.cli.out import EXIT_FOUND, EXIT_NOTHING, console, print_json

__all__ = ["check"]


@click.command(cls=Sectioned)
@takes(READ)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
def check(poses: str, *, as_json: bool, **given: Any) -> int:
    """Read POSES and say what stands out among them.

    Exit code 0: nothing does; 1: something does; 2: the file cannot be used.
    """
    from burmester.diagnosis import diagnose
    from burmester.io import overview

    found = diagnose(task(poses, **given))
    if as_json:
        print_json(overview.plain(found))
    else:
        overview.show(found, console())
        if not found.findings:
            click.echo(f"\nNothing stands out. Next: burmester synthesize {poses}")
    return EXIT_NOTHING if found.findings else EXIT_FOUND
