"""`burmester synthesize`: from poses to linkages."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import (
    MANUFACTURING,
    METHOD,
    POSES,
    POSES_HELP,
    SIX_BARS,
    SPECIFICATION,
    Sectioned,
    run_synthesis,
    with_options,
)
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, hand_over


@click.command(cls=Sectioned, epilog=POSES_HELP)
@with_options(POSES, SPECIFICATION, METHOD, SIX_BARS, MANUFACTURING)
@click.option(
    "--all",
    "everything",
    is_flag=True,
    help="List all usable linkages, and those that are not, with the reasons.",
)
@click.option("--dyads", is_flag=True, help="List the dyads as well.")
@click.option("--verbose", is_flag=True, help="Say why these come first, and what the columns are.")
@click.option(
    "--require-determined",
    is_flag=True,
    help="Exit with 1 if the poses leave open where the pivots are.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option(
    "--map",
    "family_map",
    metavar="FILE",
    help="Write the map of the family of three or four poses to FILE as well: numbers (.json) or a "
    "figure (.png, .svg, .pdf).",
)
@click.option("-o", "file", metavar="FILE", help="Write that object to FILE as well.")
@click.option("--output", metavar="FILE", help="The same as -o.")
@click.option("--force", is_flag=True, help="Write files even if they exist.")
def synthesize(
    poses: str,
    *,
    everything: bool,
    dyads: bool,
    verbose: bool,
    require_determined: bool,
    as_json: bool,
    family_map: str | None,
    file: str | None,
    output: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Find four-bars that guide a body through POSES.

    With --six-bars, six-bars for the poses.  Functions of angles are for `burmester function`.
    """
    output = file or output
    from burmester.cli.family_map import require_map_file, write_map
    from burmester.cli.progress_line import working
    from burmester.io import files

    if output is not None:
        files.require_writable(output, force=force, source=poses)
    if family_map is not None:
        require_map_file(family_map)
        files.require_writable(family_map, force=force, source=poses)
    synthesis = run_synthesis(poses, **given)
    if family_map is not None:
        with working("drawing the map"):
            click.echo(write_map(synthesis, family_map, force=force), err=True)
    shown = {"everything": everything, "dyads": dyads, "verbose": verbose}
    hand_over(synthesis, output, force=force, as_json=as_json, **shown)
    good = synthesis.determined if require_determined else synthesis.works
    if synthesis.usable and not good:
        reason = "the poses determine the pivots of no usable linkage, and --require-determined is"
        click.echo(f"exit code 1: {reason} given", err=True)
    return EXIT_FOUND if good else EXIT_NOTHING
