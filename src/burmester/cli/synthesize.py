"""`burmester synthesize`: from poses to linkages."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import (
    MANUFACTURING,
    METHOD,
    POSES,
    POSES_HELP,
    SPECIFICATION,
    Sectioned,
    run_synthesis,
    with_options,
)
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, console, print_json

__all__ = ["synthesize"]


@click.command(cls=Sectioned, epilog=POSES_HELP)
@with_options(POSES, SPECIFICATION, METHOD, MANUFACTURING)
@click.option(
    "--accept-uncertain",
    is_flag=True,
    help="Exit with 0 even if the poses hardly determine the pivots.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option("-o", "--output", metavar="FILE", help="Write that object to FILE as well.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def synthesize(
    poses: str,
    *,
    accept_uncertain: bool,
    as_json: bool,
    output: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Find four-bars that guide a body through POSES."""
    from burmester.io import files
    from burmester.io.result import json_line, synthesis_data

    if output is not None:
        files.require_writable(output, force=force)
    synthesis = run_synthesis(poses, **given)
    if output is not None:
        files.write(output, json_line(synthesis_data(synthesis)), force=force)
        click.echo(f"wrote {output}", err=True)
    if as_json:
        print_json(synthesis_data(synthesis))
    else:
        from burmester.io.terminal import show_synthesis

        show_synthesis(synthesis, console())
    # Whether a linkage was found that can be built: it works, and its pivots are determined.
    good = synthesis.determined or (accept_uncertain and bool(synthesis.usable))
    return EXIT_FOUND if good else EXIT_NOTHING
