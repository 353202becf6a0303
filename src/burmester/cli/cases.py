"""`burmester cases`: tasks with known answers."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, print_json, show_list


@click.command()
@click.argument("name", required=False)
def cases(name: str | None) -> int:
    """List the tasks with known answers, or print one."""
    from burmester.io.cases import load, names

    if name is not None:
        print_json(load(name))
        return EXIT_FOUND
    loaded = [(each, load(each)) for each in names()]
    show_list([(each, f"{len(case['poses'])} poses: {case['source']}") for each, case in loaded])
    return EXIT_FOUND
