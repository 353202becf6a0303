"""Linkages handed over: drawings, tables and models for other programs, each read back.

A format is a module of this package with `write(chosen, path, options)` and
`check(chosen, path, options)`, or `write_<name>` and `check_<name>` where one module has several.
What is written is read back before it is put in place; a file that does not hold the linkage
never comes to be.

E161 no such format        E130 a library is missing
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Final, final

from burmester.errors import InputError
from burmester.export.options import Options
from burmester.io.files import whole
from burmester.io.saved import SavedLinkage

__all__ = ["FORMATS", "Format", "Options", "export", "format_of"]


@final
@dataclass(frozen=True, slots=True)
class Format:
    """A format: the module that writes it, what it is, what has to be installed, its suffix.

    extra: of `pip install 'burmester[extra]'`; libraries: what that brings and the format needs.
    """

    module: str
    what: str
    suffix: str
    extra: str | None = None
    libraries: tuple[str, ...] = ()


FORMATS: Final[Mapping[str, Format]] = {
    "dxf": Format(
        "dxf",
        "drawing of the plates for cutting, and of the assembly (mm)",
        ".dxf",
        "export",
        ("ezdxf",),
    ),
    "svg": Format("svg", "the same drawing, 1:1, for printing and laser cutting (mm)", ".svg"),
    "step": Format("solid", "solid parts in their places (mm)", ".step", "solid", ("build123d",)),
    "stl": Format("solid", "solid parts for printing (mm)", ".stl", "solid", ("build123d",)),
    "flat": Format(
        "solid", "the same parts flat beside each other (STL, mm)", ".stl", "solid", ("build123d",)
    ),
    "openscad": Format("openscad", "OpenSCAD model, animated (mm)", ".scad"),
    "mjcf": Format("mjcf", "MuJoCo model with a motor (m)", ".xml"),
    "urdf": Format("urdf", "robot description; its loop is open (m)", ".urdf"),
    "pylinkage": Format("pylinkage", "Python script for pylinkage", ".py"),
    "csv": Format("tables", "table of the coupler's places along the motion", ".csv"),
    "json": Format("tables", "the linkage as JSON", ".json"),
    "gif": Format("movie", "moving picture", ".gif", "export", ("PIL", "matplotlib")),
    "mp4": Format("movie", "film", ".mp4", "export", ("imageio_ffmpeg", "matplotlib")),
}


def format_of(path: str | os.PathLike[str]) -> str | None:
    """The format that a file's name asks for by its ending, where it asks for one."""
    suffix = Path(path).suffix.lower()
    return next((name for name, each in FORMATS.items() if each.suffix == suffix), None)


def export(
    chosen: SavedLinkage,
    to: str,
    path: str | os.PathLike[str],
    options: Options = Options(),  # noqa: B008  frozen
    force: bool = False,
) -> list[Path]:
    """Write a linkage in a format, read it back and compare; the files that came to be.

    Raises InputError E130, E140, E141, E161, E162 and E163, and BurmesterError E160 where what
    was written is not the linkage.
    """
    name = to.lower()
    if name not in FORMATS:
        raise InputError(
            "E161",
            f"there is no format {to!r}",
            why=f"the formats are {', '.join(FORMATS)}",
            help="give --to dxf, or another of these",
        )
    form = FORMATS[name]
    try:
        for library in form.libraries:
            import_module(library)
        module = import_module(f"burmester.export.{form.module}")
    except ModuleNotFoundError as error:
        missing = (error.name or "a library").partition(".")[0]
        raise InputError(
            "E130",
            f"{name} needs {missing}, which is not installed",
            help=f"pip install 'burmester[{form.extra or 'export'}]'",
        ) from None
    write = getattr(module, f"write_{name}", None) or module.write
    check = getattr(module, f"check_{name}", None) or module.check
    with whole(path, force=force) as temporary:
        write(chosen, temporary, options)
        check(chosen, temporary, options)
    return [Path(path)]
