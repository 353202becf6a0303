"""`burmester judge`: a linkage that exists, at the poses of a task."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import JUDGEMENT, Sectioned, run_judgement, with_options
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, hand_over

GIVEN_WORKS = "R330"

DYAD_HELP = """\b
DYAD    FX,FY:MX,MY            a link: fixed pivot on the ground, moving pivot
                               on the body; its length follows from the poses,
                               or from --length
        line@DEG,X,Y:MX,MY     a slider on the ground: a line through X,Y at DEG
                               degrees, and the moving pivot on the body
        FX,FY:line@DEG,x,y     a slot in the body: the fixed pivot on the ground,
                               and a line through x,y of the body at DEG degrees
FILE    a result of `burmester synthesize POSES -o FILE`, an export to JSON, or
        two [[dyads]] with fixed_pivot, moving_pivot, length or line, in TOML or
        JSON; of a six-bar (Watt I) its joints: [ground] A, B, [coupler] D, E,
        [second_crank] D, G, [body] E, H, and [lengths] AC, GH

PAIRS of angles stand in the place of POSES, for a linkage in a FILE; by its four
lengths `burmester function` judges one.
POSES, REGION and NAME are those of `burmester synthesize`."""


@click.command(cls=Sectioned, epilog=DYAD_HELP)
@with_options(*JUDGEMENT)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option("-o", "file", metavar="FILE", help="Write that object to FILE as well.")
@click.option("--output", metavar="FILE", help="The same as -o.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def judge(
    poses: str,
    *,
    linkage: str | None,
    as_json: bool,
    file: str | None,
    output: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Judge a linkage that exists, at the poses or the pairs of angles of a task.

    It is told what `burmester synthesize` tells of its own linkages.  Exit code 0: the linkage
    works; 1: it does not; 2: the input cannot be used.
    """
    from burmester.io import files

    output = file or output
    if output is not None:
        for source in (poses, linkage):
            if source is not None:
                files.require_writable(output, force=force, source=source)
    synthesis = run_judgement(poses, linkage=linkage, **given)
    hand_over(synthesis, output, force=force, as_json=as_json)
    return EXIT_FOUND if synthesis.outcome.code == GIVEN_WORKS else EXIT_NOTHING
