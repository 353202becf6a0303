"""The map of a family as a file, for `burmester synthesize --map`."""

from __future__ import annotations

import os
from io import BytesIO
from typing import TYPE_CHECKING, Final

from burmester.errors import InputError
from burmester.synthesis.result import Synthesis

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES: Final = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


def require_map_file(path: str) -> None:
    """Refuse a file that no map can be written to, before anything is computed.

    Raises InputError E161 (no such format), E130 (a figure needs Matplotlib).
    """
    figure_format(path, "a map", ".json")


def figure_format(path: str, what: str, *others: str) -> str:
    """The suffix of a file that holds a figure, or of another format; raises E161."""
    suffix = os.path.splitext(path)[1].lower()
    known = (*others, *FIGURES)
    if suffix not in known:
        examples = [f"{what.rsplit(maxsplit=1)[-1]}{each}" for each in (*others, ".png")]
        raise InputError(
            "E161",
            f"the name {path} does not determine a format",
            why=f"{what} is written as {', '.join(each[1:] for each in known)}",
            help=f"give a name such as {' or '.join(examples)}",
        )
    return suffix


def figure_bytes(drawing: Figure, suffix: str) -> bytes:
    """A figure of Matplotlib as a file whose bytes do not depend on the time."""
    from burmester import plot

    content = BytesIO()
    with plot.house_style():
        drawing.savefig(content, format=suffix[1:], metadata=FIGURES[suffix])
    return content.getvalue()


def write_map(synthesis: Synthesis, path: str, *, force: bool) -> str:
    """Write the map; returns what was done in one line.

    Raises InputError as `family_map` does, E140 and E141 (the file).
    """
    from burmester.io import files
    from burmester.io.family_map_data import family_map_data
    from burmester.io.result import json_line
    from burmester.printable import printable
    from burmester.synthesis.family_map import family_map_of, recommended

    found, best = family_map_of(synthesis), recommended(synthesis)
    if found is None:
        return f"{printable(path)} not written: these poses have no map"
    suffix = os.path.splitext(path)[1].lower()
    if suffix in FIGURES:
        from burmester import plot

        files.write(path, figure_bytes(plot.family_figure(found, best), suffix), force=force)
    else:
        files.write(path, json_line(family_map_data(found, best)), force=force)
    return f"wrote {printable(path)}"
