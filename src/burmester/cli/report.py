"""`burmester report`: the linkages for a motion as a page that moves."""

from __future__ import annotations

import os
from typing import Any

import click

from burmester.cli.options import (
    MANUFACTURING,
    METHOD,
    POSES,
    SPECIFICATION,
    Sectioned,
    run_synthesis,
    with_options,
)
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING

__all__ = ["report"]


@click.command(cls=Sectioned)
@with_options(POSES, SPECIFICATION, METHOD, MANUFACTURING)
@click.option(
    "-o", "--output", metavar="FILE", help="Name of the page; by default that of POSES with .html."
)
@click.option("--title", metavar="TEXT", help="Title of the page; by default the name of POSES.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def report(poses: str, *, output: str | None, title: str | None, force: bool, **given: Any) -> int:
    """Write a page on which the linkages for POSES move.

    It is one file, and needs no network.  The options are those of `burmester synthesize`, where
    REGION and NAME are explained.
    """
    from burmester.cli.progress_line import working
    from burmester.describe.sentences import headline
    from burmester.io import files
    from burmester.printable import printable
    from burmester.report import page

    name = {"-": "poses"}.get(poses, os.path.basename(poses.removeprefix("case:")))
    path = output or f"{os.path.splitext(name)[0]}.html"
    files.require_writable(path, force=force, source=poses)
    synthesis = run_synthesis(poses, **given)
    with working("drawing the page"):
        text = page(synthesis, printable(title or name))
    files.write(path, text, force=force)
    first = headline(synthesis) if synthesis.usable else f"{synthesis.outcome.message}."
    click.echo(f"{first}\nwrote {printable(path)}; open it in any browser")
    return EXIT_FOUND if synthesis.usable else EXIT_NOTHING
