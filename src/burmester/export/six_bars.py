"""A six-bar of a result as a file: CSV of its motion, JSON, an SVG drawing, a film.

Every file is read back before it gets its name.

E130 a library is missing        E198 a format that six-bars do not have
"""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path
from typing import Final

from burmester.errors import InputError
from burmester.export import FORMATS, require_format
from burmester.export.options import Options
from burmester.io.files import atomic_file
from burmester.io.saved_six_bars import SavedSixBar
from burmester.progress import step
from burmester.wording import listed

__all__ = ["SIX_BAR_FORMATS", "export_six_bar"]

SIX_BAR_FORMATS: Final = ("svg", "gif", "csv", "json")


def export_six_bar(
    chosen: SavedSixBar,
    to: str | None,
    path: str | os.PathLike[str],
    options: Options = Options(),  # noqa: B008  frozen
    force: bool = False,
) -> list[Path]:
    """Write a six-bar in a format, and read the file back.

    to: one of `SIX_BAR_FORMATS`; None leaves the choice to the suffix of `path`.
    Raises E140 and E141 (the file), E161 and E198 (the format), E162 (a film or a pose that cannot
    be drawn), and BurmesterError E160 where the file does not contain the six-bar.
    """
    name = require_format(path, to)
    if name not in SIX_BAR_FORMATS:
        raise InputError(
            "E198",
            f"a six-bar cannot be written as {name}: {FORMATS[name].what}",
            why=f"the formats of six-bars are {listed(SIX_BAR_FORMATS)}",
            help="give --to csv, or another of these",
        )
    pictures = name in ("svg", "gif")
    if pictures:
        step("loading matplotlib")
    try:
        module = import_module(f"burmester.export.six_bar_{'pictures' if pictures else 'tables'}")
    except ModuleNotFoundError as error:
        raise InputError(
            "E130",
            f"{name} needs {error.name}, which is not installed",
            help='pip install "burmester[export]"',
        ) from None
    with atomic_file(path, force=force) as temporary:
        step(f"writing {name}")
        getattr(module, f"write_{name}")(chosen, temporary, options)
        step("reading it back")
        getattr(module, f"check_{name}")(chosen, temporary, options)
    return [Path(path)]
