"""What leaves the studio: the files that the command writes, byte by byte."""

from __future__ import annotations

import json
import tempfile
from dataclasses import fields
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Final

from burmester.errors import InputError
from burmester.export import FORMATS, Options, export, require_format
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.io.saved import read_result
from burmester.report.page import page_of
from burmester.studio.commands import plain_name
from burmester.synthesis.given_linkage import OpenLink
from burmester.values import real_numbers

_TYPES: Final = {  # of the options of an export, as JSON has them
    "float | None": (int, float, type(None)),
    "str | None": (str, type(None)),
    "float": (int, float),
    "int": (int,),
    "str": (str,),
    "bool": (bool,),
}


# What a file is for: how the page groups the formats.
_USES: Final = {
    **dict.fromkeys(("dxf", "svg"), "cut"),
    **dict.fromkeys(("pdf", "stl"), "print"),
    **dict.fromkeys(("step", "openscad"), "cad"),
    **dict.fromkeys(("mjcf", "urdf", "sdf", "pylinkage"), "simulate"),
    **dict.fromkeys(("gif", "mp4"), "film"),
}


def dyads_of(given: Any) -> Linkage:
    """The linkage of two links: [{"fixed_pivot": [x, y], "moving_pivot": [x, y], "radius": r}] x 2.

    Raises InputError E153 for what is none.
    """
    first, second = (
        RR(
            real_numbers(each.get("fixed_pivot"), (2,), "a fixed pivot", code="E153"),
            real_numbers(each.get("moving_pivot"), (2,), "a moving pivot", code="E153"),
            real_numbers(each.get("radius"), (), "a length", code="E153"),
        )
        for each in links_of(given)
    )
    return Linkage(first, second)


def links_of(given: Any) -> list[dict[str, Any]]:
    """Two tables, of a link each; raises InputError E153 for what is none."""
    links = given if isinstance(given, list) else []
    if len(links) != 2 or not all(isinstance(each, dict) for each in links):
        raise InputError("E153", "two links make a linkage", help="give two links")
    return links


def links_data(found: Any, name: str) -> list[dict[str, Any]]:
    """The links of what `read_linkage` found, as `links_of` takes them; raises InputError E153."""
    dyads = (found.first, found.second) if isinstance(found, Linkage) else found
    if not isinstance(dyads, tuple) or not all(isinstance(e, RR | OpenLink) for e in dyads):
        message = "the page judges four-bars of two links"
        help = "give this file to the command: `burmester judge POSES --linkage FILE`"
        raise InputError("E153", message, where=name, help=help)
    names = ("fixed_pivot", "moving_pivot", "radius")
    return [{e: getattr(each, e).tolist() for e in names if hasattr(each, e)} for each in dyads]


def formats() -> list[dict[str, Any]]:
    """The formats whose libraries are installed, as the page offers them."""
    return [
        {
            "format": name,
            "title": each.what,
            "suffix": each.suffix,
            "use": _USES.get(name, "share"),
        }
        for name, each in FORMATS.items()
        if name != "flat" and all(find_spec(library) for library in each.libraries)
    ]


def exported(result: bytes, given: dict[str, Any]) -> tuple[bytes, str]:
    """A linkage of a result in a format, and the name of the file.

    given: "format", "linkage" (its id; the best one by default), "name" (of the task) and, in
    "settings", options of `burmester export`.  Raises what `export` raises.
    """
    to, linkage = given.get("format"), given.get("linkage")
    if not isinstance(to, str):
        raise InputError("E161", "no format is given", help=f"give one of {', '.join(FORMATS)}")
    if linkage is not None and not isinstance(linkage, str):
        raise InputError("E151", "the linkage has no name", help="give its id, such as L1")
    name = require_format("", to)
    options = _options(given.get("settings"))
    chosen = read_result("-", data=result).exported(linkage)
    file = f"{plain_name(given.get('name'))}-{chosen.id}{FORMATS[name].suffix}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / file
        export(chosen, name, path, options)
        return path.read_bytes(), file


def _options(given: Any) -> Options:
    """The options of an export; raises E100 for what is none."""
    if given is None:
        return Options()
    types = {each.name: str(each.type) for each in fields(Options)}
    for name, value in given.items() if isinstance(given, dict) else [("", given)]:
        allowed = _TYPES.get(types.get(name, ""), ())
        if not isinstance(value, allowed) or (isinstance(value, bool) and bool not in allowed):
            raise InputError(
                "E100",
                f"an export has no option {str(name)[:40]!r} of this kind",
                help=f"the options are {', '.join(types)}",
            )
    return Options(**given)


def report_page(report: bytes, name: str) -> bytes:
    """The page of `burmester report`, of what `report_data` said."""
    return page_of(json.loads(report), f"{name}.toml").encode()
