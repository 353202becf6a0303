"""Linkages handed over: drawings, tables and models for other programs, each read back.

A format is a module of this room with `write(chosen, path, options)` and
`check(chosen, path, options)`, or `write_<name>` and `check_<name>` where one module has several.
Every file is read back before it gets its name; a file that does not contain the linkage is
deleted.  Four-bars and six-bars go the same way.

E161 no such format        E130 a library is missing        E198 none of six-bars
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Final, final

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.options import Options
from burmester.io.files import atomic_file
from burmester.progress import step
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import listed

__all__ = [
    "FORMATS",
    "SIX_BAR_FORMATS",
    "Format",
    "Options",
    "export",
    "format_of",
    "require_format",
]


@final
@dataclass(frozen=True, slots=True)
class Format:
    """A format of `export`.

    Attributes
    ----------
    module : str
        The module of this package that writes it.
    what : str
        Its description, with the unit of lengths.
    suffix : str
        The suffix of its files.
    extra : str or None
        The extra of `pip install "burmester[extra]"` that it needs.
    libraries : tuple of str
        The libraries of that extra that it imports.
    """

    module: str
    what: str
    suffix: str
    extra: str | None = None
    libraries: tuple[str, ...] = ()


FORMATS: Final[Mapping[str, Format]] = {
    "dxf": Format(
        "drawings.dxf",
        "drawing of the plates for cutting, and of the assembly (mm, or inches)",
        ".dxf",
        "export",
        ("ezdxf",),
    ),
    "svg": Format(
        "drawings.svg", "the same drawing, 1:1, for printing and laser cutting (mm)", ".svg"
    ),
    "pdf": Format(
        "drawings.pdf",
        "the plates at 1:1, to print on A4 or Letter",
        ".pdf",
        "export",
        ("matplotlib", "pypdf"),
    ),
    "step": Format(
        "solids.solid", "solid parts in their places (mm)", ".step", "solid", ("build123d",)
    ),
    "stl": Format(
        "solids.solid",
        "solid parts flat beside each other, for printing (mm)",
        ".stl",
        "solid",
        ("build123d",),
    ),
    "flat": Format(
        "solids.solid", "the same; --to stl does it now (STL, mm)", ".stl", "solid", ("build123d",)
    ),
    "openscad": Format("solids.openscad", "OpenSCAD model, animated (mm)", ".scad"),
    "mjcf": Format("models.mjcf", "MuJoCo model with a motor (m)", ".xml"),
    "urdf": Format("models.urdf", "robot description; its loop is open (m)", ".urdf"),
    "sdf": Format("models.sdf", "Gazebo world with the linkage as a model (m)", ".sdf"),
    "pylinkage": Format("pylinkage", "Python script for pylinkage", ".py"),
    "csv": Format("tables", "table of the coupler's places along the motion", ".csv"),
    "json": Format("tables", "the linkage as JSON", ".json"),
    "gif": Format("films.movie", "moving picture", ".gif", "export", ("PIL", "matplotlib")),
    "mp4": Format("films.movie", "film", ".mp4", "export", ("imageio_ffmpeg", "matplotlib")),
}

SIX_BAR_FORMATS: Final = tuple(name for name in FORMATS if name != "pylinkage")
PACKAGES: Final = {"PIL": "pillow", "imageio_ffmpeg": "imageio-ffmpeg"}  # module: what pip calls it


def format_of(path: str | os.PathLike[str]) -> str | None:
    """The format that belongs to the suffix of a file.

    Parameters
    ----------
    path : str or path
        Name of a file.

    Returns
    -------
    str or None
        A key of `FORMATS`; None where the suffix belongs to no format.

    Examples
    --------
    >>> from burmester.export import format_of
    >>> format_of("lid.dxf"), format_of("lid.doc")
    ('dxf', None)
    """
    suffix = Path(path).suffix.lower()
    return next((name for name, each in FORMATS.items() if each.suffix == suffix), None)


def require_format(path: str | os.PathLike[str], to: str | None = None) -> str:
    """The key of `FORMATS` that is named, or that belongs to the suffix of a file; else E161."""
    name = format_of(path) if to is None else to.lower()
    if name is not None and name in FORMATS:
        return name
    raise InputError(
        "E161",
        f"the name {os.fspath(path)} does not determine a format"
        if to is None
        else f"there is no format {to!r}",
        why=f"the formats are {', '.join(FORMATS)}",
        help=Help.of("give {}, or another of these", Cure("to", "dxf")),
    )


def export(
    chosen: Candidate,
    to: str | None,
    path: str | os.PathLike[str],
    options: Options = Options(),  # noqa: B008  frozen
    force: bool = False,
) -> list[Path]:
    """Write a linkage in a format, read the file back, and compare it with the linkage.

    Parameters
    ----------
    chosen : Candidate
        The linkage.
    to : str or None
        A key of `FORMATS`; None leaves the choice to the suffix of `path`.
    path : str or path
        The file.
    options : Options
        Unit, dimensions of plates, and settings of moving pictures.
    force : bool
        Replace a file that exists.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        E130 (a library is missing), E140 and E141 (the file), E161 (no such format), E162 and E163
        (the linkage does not suit the format), E198 (a format that six-bars do not have).
    BurmesterError
        E160 where the written file does not contain the linkage.

    Examples
    --------
    >>> import os, tempfile
    >>> from burmester import read_task, synthesize
    >>> from burmester.export import export
    >>> best = synthesize(read_task("case:ge2012-exact")).best
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path] = export(best, "svg", os.path.join(folder, "linkage.svg"))
    >>> path.name
    'linkage.svg'
    """
    name = require_format(path, to)
    form = FORMATS[name]
    if name not in SIX_BAR_FORMATS and not isinstance(chosen, FoundLinkage):
        raise InputError(
            "E198",
            f"a six-bar cannot be written as {name}: {form.what}",
            why=f"the formats of six-bars are {listed(SIX_BAR_FORMATS)}",
            help=Help.of("give {}, or another of these", Cure("to", "csv")),
        )
    try:
        for library in form.libraries:
            step(f"loading {library}")
            import_module(library)
        module = import_module(f"burmester.export.{form.module}")
    except ImportError as error:
        missing = (error.name or "a library").partition(".")[0]
        missing = PACKAGES.get(missing, missing)
        raise InputError(
            "E130",
            f"{name} needs {missing}, which is not installed",
            help=f'pip install "burmester[{form.extra or "export"}]"',
        ) from None
    write = getattr(module, f"write_{name}", None) or module.write
    check = getattr(module, f"check_{name}", None) or module.check
    with atomic_file(path, force=force) as temporary:
        step(f"writing {name}")
        write(chosen, temporary, options)
        step("reading it back")
        check(chosen, temporary, options)
    return [Path(path)]
