"""`burmester report`: the linkages for a motion as a page that moves."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import click

from burmester.cli.options import (
    MANUFACTURING,
    METHOD,
    POSES,
    SIX_BARS,
    SPECIFICATION,
    Sectioned,
    run_synthesis,
    with_options,
)
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING

if TYPE_CHECKING:
    from burmester.synthesis.result import Synthesis


@click.command(cls=Sectioned)
@with_options(POSES, SPECIFICATION, METHOD, SIX_BARS, MANUFACTURING)
@click.option(
    "-o", "file", metavar="FILE", help="Name of the page; by default that of POSES with .html."
)
@click.option("--output", metavar="FILE", help="The same as -o.")
@click.option("--title", metavar="TEXT", help="Title of the page; by default the name of POSES.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def report(
    poses: str,
    *,
    file: str | None,
    output: str | None,
    title: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Write a page on which the linkages for POSES move.

    With --six-bars, the six-bars.  It is one file, and needs no network.  The options are those
    of `burmester synthesize`, where REGION and NAME are explained.
    """
    from burmester.cli.progress_line import working
    from burmester.io import files
    from burmester.io.reading.link import is_link
    from burmester.printable import printable
    from burmester.report import page

    plain = poses == "-" or is_link(poses)  # without a name
    name = "poses" if plain else os.path.basename(poses.removeprefix("case:"))
    path = file or output or f"{os.path.splitext(name)[0]}.html"
    files.require_writable(path, force=force, source=poses)
    synthesis = run_synthesis(poses, **given)
    with working("drawing the page"):
        text = page(synthesis, printable(title or name))
    files.write(path, text, force=force)
    click.echo(f"{_answer(synthesis)}\nwrote {printable(path)}; open it in any browser")
    return EXIT_FOUND if synthesis.works else EXIT_NOTHING


def _answer(synthesis: Synthesis) -> str:
    """The best linkage in a sentence; where there is none, why, and what helps."""
    from burmester.describe.sentences import best_sentences

    if best := best_sentences(synthesis):
        return best[0]
    outcome = synthesis.outcome
    return f"{outcome.message}." + (f"\nWhat helps: {outcome.help}." if outcome.help else "")
