"""`burmester report`: the linkages for a motion, or a function, as a page that moves."""

from __future__ import annotations

import os
from typing import Any

import click

from burmester.cli.options import (
    FUNCTION,
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
@with_options(POSES, FUNCTION, SPECIFICATION, METHOD, MANUFACTURING, poses_required=False)
@click.option(
    "-o", "file", metavar="FILE", help="Name of the page; by default that of POSES with .html."
)
@click.option(
    "--output",
    metavar="FILE|DEG",
    help="The same as -o; with --function, how far the output link turns, in degrees.",
)
@click.option("--title", metavar="TEXT", help="Title of the page; by default the name of POSES.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def report(
    poses: str | None,
    *,
    file: str | None,
    output: str | None,
    title: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Write a page on which the linkages for POSES move.

    It is one file, and needs no network.  The options are those of `burmester synthesize`, where
    REGION and NAME are explained.
    """
    from burmester.cli.function import function_task, page_of_function
    from burmester.cli.progress_line import working
    from burmester.describe.sentences import headline
    from burmester.io import files
    from burmester.printable import printable
    from burmester.report import page

    given["output"] = output
    task = function_task(poses, given)
    if given["function"] is None:
        file = file or output
    name = {"-": "poses", None: "function"}.get(
        poses, os.path.basename((poses or "").removeprefix("case:"))
    )
    path = file or f"{os.path.splitext(name)[0]}.html"
    files.require_writable(path, force=force, source=poses or "")
    if task is not None:
        with working("looking for function generators"):
            text, first, good = page_of_function(
                task, printable(title or given["function"] or name)
            )
    else:
        assert poses is not None
        synthesis = run_synthesis(poses, **given)
        with working("drawing the page"):
            text = page(synthesis, printable(title or name))
        good = bool(synthesis.usable)
        first = headline(synthesis) if good else f"{synthesis.outcome.message}."
    files.write(path, text, force=force)
    click.echo(f"{first}\nwrote {printable(path)}; open it in any browser")
    return EXIT_FOUND if good else EXIT_NOTHING
