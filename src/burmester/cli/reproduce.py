"""`burmester reproduce`: the tables and figures of the paper, recomputed."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, console, print_json


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option(
    "--figures", metavar="DIR", help="Draw the figures into the folder DIR: PNG, SVG and PDF."
)
@click.option("--force", is_flag=True, help="Write the figures even if the files exist.")
def reproduce(as_json: bool, figures: str | None, force: bool) -> int:
    """Recompute the tables of Ge et al. 2012, or draw the figures."""
    from burmester.cli.progress_line import working

    if figures is not None:
        from burmester.plot import write_figures
        from burmester.printable import printable

        with working("drawing the figures"):
            paths = write_figures(figures, force=force)
        for path in paths:
            click.echo(f"wrote {printable(str(path))}")
        return EXIT_FOUND
    from burmester.paper.five_methods import side_by_side
    from burmester.paper.reproduction import reproduce as run
    from burmester.paper.reproduction import reproduction_data

    with working("computing the tables of the paper"):
        sections, tasks = run(), side_by_side()
    if as_json:
        print_json(reproduction_data(sections, tasks))
    else:
        from burmester.paper.tables import show_reproduction

        show_reproduction(sections, tasks, console())
    return EXIT_FOUND
