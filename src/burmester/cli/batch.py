"""`burmester batch`: many tasks, in parts, on this machine or a cluster."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import Number
from burmester.cli.output import EXIT_FOUND, EXIT_INTERRUPT, EXIT_NOTHING, console, print_json
from burmester.errors import InputError

TASKS_HELP = """\b
TASKS   a table with a row for each pose (.parquet or .csv), whose columns are
        task, x, y, angle_deg (or angle_rad), and weight and exact if wanted;
        a row without an angle is a point; ten or more points alone are a
        path, timed by crank_deg in a table without a column of angles;
        or a row for each pair of angles,
        with task, input_deg, output_deg;
        a file with a task a line, in JSON (.jsonl); or a folder with a file
        for each task, as `burmester synthesize` reads it."""


@click.command(epilog=TASKS_HELP)
@click.argument("tasks", required=False)
@click.option("-o", "--output", metavar="FOLDER", help="The folder of the parts.")
@click.option(
    "--sample",
    type=click.Choice(["four-bars"]),
    help="In place of TASKS: random usable four-bars, with poses on their way.",
)
@click.option("--count", type=click.IntRange(1), metavar="N", help="How many of them.")
@click.option("--seed", type=int, metavar="N", help="The seed of the draws; by default 0.")
@click.option("--poses", type=click.IntRange(2), metavar="N", help="Poses of each; by default 10.")
@click.option(
    "--noise",
    type=Number(0, 1),
    metavar="SIGMA",
    help="Standard deviation of the errors of the poses: a share of their span, and radians; by "
    "default 0.",
)
@click.option(
    "--types",
    metavar="NAME,...",
    help="Types that are drawn, such as crank-rocker,slider-crank; by default all that can be.",
)
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
    type=Number(min=0.1),
    metavar="SECONDS",
    help="A part that takes longer is taken apart, and a task that alone takes longer fails; "
    "by default 600 at the depth full, and 120 at the others.",
)
@click.option(
    "--worker-memory",
    type=Number(min=0.1),
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
    from burmester.batch.manifest import read_summary

    if show is not None:
        if tasks is not None or output is not None:
            raise InputError("E100", "--show takes a folder alone", help="leave TASKS and -o out")
        _tell(read_summary(show), as_json=as_json)
        return EXIT_FOUND
    sample = {name: given.pop(name) for name in ("count", "seed", "poses", "noise", "types")}
    source = _source(tasks, given.pop("sample"), sample)
    if source is None or output is None:
        raise InputError(
            "E100",
            "there are no tasks" if source is None else "there is no folder to write to",
            help="say `burmester batch TASKS -o FOLDER`; `burmester batch --help` has more",
        )
    from burmester.batch.job import run
    from burmester.cli.batch_progress import watching

    with watching() as progress:
        summary = run(source, output, progress=progress, **given)
    _tell(summary, as_json=as_json)
    if not summary.complete:
        click.echo("stopped; the same command goes on", err=True)
        return EXIT_INTERRUPT
    return EXIT_NOTHING if summary.outcomes.get("failed") else EXIT_FOUND


def _source(tasks: str | None, sample: str | None, given: dict[str, Any]) -> Any:
    """The path of the tasks, or a sample of random ones; None for neither."""
    stated = {name: value for name, value in given.items() if value is not None}
    if sample is None:
        if stated:
            message = f"--{next(iter(stated))} is for a sample"
            raise InputError("E100", message, help="add --sample four-bars, or leave it out")
        return tasks
    if tasks is not None:
        raise InputError("E100", "TASKS and --sample are given", help="leave one of them out")
    if "count" not in stated:
        message = "a sample has no count"
        raise InputError("E100", message, help="say how many, such as --count 1000")
    from burmester.batch.job import require_pyarrow

    require_pyarrow()
    from burmester.batch.sample import Sample

    if "types" in stated:
        stated["types"] = tuple(each.strip() for each in stated["types"].split(","))
    return Sample.of(stated.pop("count"), **stated)


def _tell(summary: Any, *, as_json: bool) -> None:
    if as_json:
        print_json(summary.data)
    else:
        from burmester.cli.batch_table import show_summary

        show_summary(summary, console())
