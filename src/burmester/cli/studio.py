"""`burmester studio`: the page on which a linkage is designed by hand and eye."""

from __future__ import annotations

import re
import sys

import click

from burmester.cli.options import Number
from burmester.cli.output import EXIT_FOUND
from burmester.errors import InputError
from burmester.printable import printable

LIBRARIES = ("starlette", "uvicorn", "websockets")
MOST_BYTES = 50_000_000  # of standard input


@click.command()
@click.argument("task", required=False)
@click.option("--no-browser", is_flag=True, help="Only print the address; open no browser.")
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    metavar="N",
    help="Port of the page; 0, the default, takes any that is free.",
)
@click.option(
    "--host",
    default="127.0.0.1",
    show_default=True,
    metavar="ADDRESS",
    help="Address to listen at; any but this machine's own takes the next option as well.",
)
@click.option(
    "--i-know-that-others-can-connect",
    "exposed",
    is_flag=True,
    help="Let other machines reach the page; unencrypted, and with the address as only lock.",
)
@click.option(
    "--time-limit",
    type=Number(min=0.1),
    default=10.0,
    show_default=True,
    metavar="SECONDS",
    help="Time after which a search is stopped.",
)
@click.option(
    "--links-to",
    metavar="ADDRESS",
    help="Address of a studio that others reach; links to tasks lead there.",
)
def studio(
    task: str | None,
    *,
    no_browser: bool,
    port: int,
    host: str,
    exposed: bool,
    time_limit: float,
    links_to: str | None,
) -> int:
    """Open a page on which linkages follow as poses are dragged.

    TASK is a file or a link as for `burmester synthesize`; by default the page opens on a lid.
    The first line printed is the address of the page, which opens it once, within five minutes;
    Enter prints another one.  Ctrl-C ends the studio.
    """
    from importlib.util import find_spec

    if missing := [each for each in LIBRARIES if find_spec(each) is None]:
        raise InputError(
            "E130",
            f"the studio needs {missing[0]}, which is not installed",
            help='pip install "burmester[studio]"',
        )
    from burmester.studio.access import is_loopback
    from burmester.studio.serve import Opening, serve

    if not is_loopback(host) and not exposed:
        raise InputError(
            "E100",
            f"at {host} other machines could connect to the studio",
            why="whoever listens on the way, where nothing is encrypted, or opens the address "
            "before you do, could read and change the task",
            help="leave --host out, or add --i-know-that-others-can-connect",
        )
    if links_to is not None and not re.fullmatch(r"https?://[^\s#]+", links_to):
        raise InputError(
            "E100",
            "links to tasks need an address of the web",
            why=f"{printable(links_to)} is none",
            help="give one that begins with https:// and has no #",
        )
    data = sys.stdin.buffer.read(MOST_BYTES) if task == "-" and sys.stdin is not None else b""
    opening = Opening(task, data, host, port, time_limit, not no_browser, links_to)
    serve(opening, click.echo)
    return EXIT_FOUND
