"""`burmester judge`: a linkage that exists, at the poses of a task."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import JUDGEMENT, Sectioned, run_judgement, with_options
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, hand_over

__all__ = ["judge"]

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
        JSON

POSES, REGION and NAME are those of `burmester synthesize`."""


@click.command(cls=Sectioned, epilog=DYAD_HELP)
@with_options(*JUDGEMENT)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option("-o", "--output", metavar="FILE", help="Write that object to FILE as well.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def judge(
    poses: str,
    *,
    linkage: str | None,
    as_json: bool,
    output: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Judge a linkage that exists, at the poses of a task.

    It is told what `burmester synthesize` tells of its own linkages.  Exit code 0: the linkage
    works; 1: it does not; 2: the input cannot be used.
    """
    from burmester.cli.function import function_task, judge_function
    from burmester.io import files

    if linkage is not None and (task := function_task(poses, given)) is not None:
        one = given.get("id")
        return judge_function(task, linkage, one, file=output, force=force, as_json=as_json)
    if output is not None:
        for source in (poses, linkage):
            if source is not None:
                files.require_writable(output, force=force, source=source)
    synthesis = run_judgement(poses, linkage=linkage, **given)
    hand_over(synthesis, output, force=force, as_json=as_json)
    return EXIT_FOUND if synthesis.linkages[0].usable else EXIT_NOTHING
