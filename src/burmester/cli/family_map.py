"""The map of a family as a file, for `burmester synthesize --map`."""

from __future__ import annotations

import os
from io import BytesIO
from typing import Final

from burmester.errors import InputError
from burmester.synthesis.result import Synthesis

__all__ = ["require_map_file", "write_map"]

FIGURES: Final = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


def require_map_file(path: str) -> None:
    """Refuse a file that no map can be written to, before anything is computed.

    Raises InputError E161 (no such format), E130 (a figure needs Matplotlib).
    """
    suffix = os.path.splitext(path)[1].lower()
    if suffix in FIGURES:
        pass
    elif suffix != ".json":
        raise InputError(
            "E161",
            f"the name {path} does not determine a format",
            why=f"a map is written as json, {', '.join(each[1:] for each in FIGURES)}",
            help="give a name such as map.json or map.png",
        )


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

        drawing, content = plot.family_figure(found, best), BytesIO()
        with plot.house_style():
            drawing.savefig(content, format=suffix[1:], metadata=FIGURES[suffix])
        files.write(path, content.getvalue(), force=force)
    else:
        files.write(path, json_line(family_map_data(found, best)), force=force)
    return f"wrote {printable(path)}"
