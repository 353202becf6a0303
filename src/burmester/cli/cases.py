"""`burmester cases`: tasks with known answers."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, print_json

__all__ = ["cases"]


@click.command()
@click.argument("name", required=False)
def cases(name: str | None) -> int:
    """List the tasks with known answers, or print one."""
    from burmester.io.cases import load, names

    if name is not None:
        print_json(load(name))
        return EXIT_FOUND
    width = max(map(len, names()))
    for each in names():
        case = load(each)
        click.echo(f"{each:{width}}  {len(case['poses']):2} poses  {case['source']}")
    return EXIT_FOUND
