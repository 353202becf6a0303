"""`burmester batch`: many tasks, in parts, on this machine or a cluster."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.output import (
    EXIT_FOUND,
    EXIT_INTERRUPT,
    EXIT_NOTHING,
    console,
    print_json,
)
from burmester.errors import InputError

__all__ = ["batch"]

TASKS_HELP = """\b
TASKS   a table with a row for each pose (.parquet or .csv), whose columns are
        task, x, y, angle_deg (or angle_rad), and weight and exact if wanted;
        a file with a task a line, in JSON (.jsonl); or a folder with a file
        for each task, as `burmester synthesize` reads it."""


@click.command(epilog=TASKS_HELP)
@click.argument("tasks", required=False)
@click.option("-o", "--output", metavar="FOLDER", help="The folder of the parts.")
@click.option(
    "--depth",
    type=click.Choice(["pencil", "dyads", "linkages", "full"]),
    default="full",
    show_default=True,
    help="How far to go: the pencil's two dyads; all dyads; their pairs, judged but not refined; "
    "what `burmester synthesize` does (full).",
)
@click.option(
    "--options",
    metavar="FILE",
    help="A TOML file with options of the synthesis, limits and requirements, for all tasks.",
)
@click.option(
    "--part-tasks",
    type=click.IntRange(1, 1_000_000),
    metavar="N",
    help="Tasks of a part; by default as many as take some second.",
)
@click.option(
    "--workers",
    type=click.IntRange(1, 10_000),
    metavar="N",
    help="Processes of this machine; by default one a core.",
)
@click.option(
    "--dask",
    metavar="ADDRESS",
    help="Work on a Dask cluster that runs already, such as tcp://host:8786, instead.",
)
@click.option(
    "--part-limit",
    type=click.FloatRange(min=0.1),
    metavar="SECONDS",
    help="A part that takes longer is taken apart, and a task that alone takes longer fails; "
    "by default 600 at the depth full, and 120 at the others.",
)
@click.option(
    "--worker-memory",
    type=click.FloatRange(min=0.1),
    metavar="GB",
    help="Address space that each process may have; by default there is no limit.",
)
@click.option("--show", metavar="FOLDER", help="Say what is in a folder of parts, and do nothing.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
def batch(
    tasks: str | None, *, output: str | None, show: str | None, as_json: bool, **given: Any
) -> int:
    """Solve many TASKS, and write a row for each into a folder of Parquet files.

    Stopped at any time and started again by the same command, it goes on and ends with the same
    files.
    """
    from burmester.batch.summary import read_summary

    if show is not None:
        if tasks is not None or output is not None:
            raise InputError("E100", "--show takes a folder alone", help="leave TASKS and -o out")
        _tell(read_summary(show), as_json=as_json)
        return EXIT_FOUND
    if tasks is None or output is None:
        raise InputError(
            "E100",
            "there are no tasks" if tasks is None else "there is no folder to write to",
            help="say `burmester batch TASKS -o FOLDER`; `burmester batch --help` has more",
        )
    from burmester.batch.job import run
    from burmester.cli.batch_progress import watching

    with watching(as_json=as_json) as progress:
        summary = run(tasks, output, progress=progress, **given)
    _tell(summary, as_json=as_json)
    if not summary.complete:
        click.echo("stopped; the same command goes on", err=True)
        return EXIT_INTERRUPT
    return EXIT_NOTHING if summary.outcomes.get("failed") else EXIT_FOUND


def _tell(summary: Any, *, as_json: bool) -> None:
    if as_json:
        print_json(summary.data)
    else:
        from burmester.cli.batch_table import show_summary

        show_summary(summary, console())
