"""`burmester balance`: springs for the linkages of a task with loads."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import POSES, SPECIFICATION, Sectioned, read_poses, with_options
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, console, print_json

LIST_HELP = """\b
LIST    a CSV file with the columns name, kind and the numbers of the springs as
        in a task file: of gas springs force_N, compressed_force_N, stroke,
        length and friction_N; of others rate_N_per_mm and free_length; and
        diameter, how wide it is
BOX     X,Y:X,Y, two corners in the unit of the poses"""


@click.command(cls=Sectioned, epilog=LIST_HELP)
@with_options(POSES, SPECIFICATION)
@click.option("--springs", metavar="LIST", help="The springs; by default usual sizes.")
@click.option("--pairs", is_flag=True, help="Two of each spring, one on either side.")
@click.option("--ground", metavar="BOX", help="Where the spring may attach on the ground.")
@click.option("--on-body", metavar="BOX", help="Where it may attach on the body, in its frame.")
@click.option("--with-linkage", is_flag=True, help="Move pivots too, within what is asked.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option(
    "-o",
    "file",
    metavar="FILE",
    help="Write the task with the best spring to FILE; to FILE.json the linkage with it, as "
    "`burmester judge` does.",
)
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
def balance(
    poses: str,
    *,
    springs: str | None,
    pairs: bool,
    ground: str | None,
    on_body: str | None,
    with_linkage: bool,
    as_json: bool,
    file: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Find the springs with which a hand moves the linkages of a task with little force.

    POSES states the loads: the mass of the body, and where the hand is.  Exit code 0: a spring
    keeps all that is asked; 1: none does; 2: the input cannot be used.
    """
    from burmester.cli.progress_line import working
    from burmester.io import files
    from burmester.io.balance_table import balance_data, corners_of, is_result, show_balance
    from burmester.io.result import json_line, synthesis_data
    from burmester.io.spring_list import in_pairs, springs_of_file, usual_springs
    from burmester.live.document import document_of, task_file
    from burmester.synthesis.balanced import BalanceRegions
    from burmester.synthesis.balanced import balance as balanced
    from burmester.synthesis.judgement import judge_linkage
    from burmester.verdicts.found_linkage import FoundLinkage

    if file is not None:
        files.require_writable(file, force=force, source=poses)
    with working("reading the poses"):
        task = read_poses(poses, **given)
        offers = usual_springs(task.length_unit or "mm") if springs is None else (
            springs_of_file(springs)
        )  # fmt: skip
        if pairs:
            offers = in_pairs(offers)
        regions = BalanceRegions(corners_of("--ground", ground), corners_of("--on-body", on_body))
        answer, found = balanced(task, offers, regions, with_linkage=with_linkage)
    if file is not None and found:
        best = found[0].found
        if is_result(file) and isinstance(best, FoundLinkage):
            content = json_line(synthesis_data(judge_linkage(best.task, best.linkage)))
        else:
            content = task_file(document_of(best.task))
        files.write(file, content, force=force)
    if as_json:
        print_json(balance_data(answer, found))
    else:
        show_balance(answer, found, len(offers), console(), file)
    return EXIT_FOUND if found and found[0].keeps else EXIT_NOTHING
