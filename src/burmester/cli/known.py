"""`burmester cases` and `burmester reproduce`: tasks with known answers."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, console, print_json

__all__ = ["cases", "reproduce"]


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


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option("--figures", metavar="DIR", help="Draw the figures into DIR: PNG, SVG and PDF.")
@click.option("--force", is_flag=True, help="Draw over files that exist.")
def reproduce(as_json: bool, figures: str | None, force: bool) -> int:
    """Recompute the tables of Ge et al. 2012, or draw the figures."""
    if figures is not None:
        from burmester.plot import write_figures

        for path in write_figures(figures, force=force):
            click.echo(f"wrote {path}")
        return EXIT_FOUND
    from burmester.paper.reproduction import as_json as plain
    from burmester.paper.reproduction import reproduce as run
    from burmester.paper.side_by_side import side_by_side

    sections, tasks = run(), side_by_side()
    if as_json:
        print_json(plain(sections, tasks))
    else:
        from burmester.paper.tables import show_reproduction

        show_reproduction(sections, tasks, console())
    return EXIT_FOUND
