"""`burmester explain`: what a code means, and what to do about it."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, console


@click.command()
@click.argument("code", required=False)
def explain(code: str | None) -> int:
    """Explain a CODE such as E103, or list all of them."""
    from burmester.io.explain import page, show_all, show_page

    if code is None:
        show_all(console())
    else:
        show_page(page(code), console())
    return EXIT_FOUND
