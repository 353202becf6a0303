"""`burmester check`: the poses or pairs of angles as read, and findings about them."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import POSES, Sectioned, pose_arguments, read_poses, with_options
from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, console, print_json


@click.command(cls=Sectioned)
@with_options(POSES)
@click.option("--verbose", is_flag=True, help="Say also how many quadrics hold the poses.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
def check(poses: str, *, verbose: bool, as_json: bool, **given: Any) -> int:
    """Read POSES, or pairs of angles, and report anything unusual.

    Exit code 0: nothing unusual; 1: a finding; 2: the file cannot be used.
    """
    from dataclasses import replace

    from burmester.cli.progress_line import working
    from burmester.diagnosis.checks import diagnose, disagreement
    from burmester.io import overview
    from burmester.io.files import quoted
    from burmester.progress import step

    with working("reading the poses"):
        task = read_poses(poses, **given)
        step("comparing each pose with the others")
        diagnosis = diagnose(task)
        if (odd := disagreement(diagnosis.task, diagnosis.motion)) is not None:
            diagnosis = replace(diagnosis, findings=(odd, *diagnosis.findings))
    if as_json:
        print_json(overview.check_data(diagnosis))
    else:
        overview.show(diagnosis, console(), verbose=verbose)
        if diagnosis.sound:
            again = " ".join(map(quoted, (poses, *pose_arguments(given))))
            click.echo(f"\nNothing stands out. Next: burmester synthesize {again}")
    return EXIT_FOUND if diagnosis.sound else EXIT_NOTHING
