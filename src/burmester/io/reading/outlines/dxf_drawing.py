"""The curves of a DXF file: lines, arcs, polylines, splines and blocks of its model space.

E170 a drawing that cannot be read        E130 ezdxf is missing
"""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Iterator
from itertools import islice
from typing import Any, Final

import numpy as np

from burmester.errors import InputError, library
from burmester.io.reading.outlines.curves import FLATNESS, Curve, Drawing, unreadable

UNITS: Final = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 13: "um", 14: "dm"}  # of $INSUNITS
FAR: Final = 1e60  # no length of a drawing is as great
MAX_ENTITIES: Final = 20_000  # those of blocks counted at each place
_ENTRY = re.compile("^ *0\n *[A-Za-z]", re.MULTILINE)
ALONE_HELP: Final = "save the outline alone to a file of its own"
ASCII_HELP: Final = "save it as DXF in text form (ASCII), of any version"


def read_dxf(data: bytes, part: str | None) -> Drawing:
    """The curves of the layers of a DXF file, or of one of them; raises E170 and E130."""
    ezdxf = library("ezdxf", "reading DXF", "outlines")
    from ezdxf import path as paths

    # What ezdxf passes over in a damaged file is no message of ours.
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    try:
        return _drawing(_document(ezdxf, data), paths, part)
    except InputError:
        raise
    except Exception as error:  # of many kinds, for files that are damaged
        said = str(error).partition("\n")[0][:150] or type(error).__name__
        raise unreadable(f"as DXF it is damaged: {said}", ASCII_HELP) from None


def _drawing(document: Any, paths: Any, part: str | None) -> Drawing:
    """The curves of the layers of a document, or of one of them."""
    layers: dict[str, None] = {}
    found: list[tuple[Any, str, str]] = []
    for entity, layer in _entities(document):
        kind = entity.dxftype()
        if kind not in CURVES:
            continue
        layers.setdefault(layer)
        if part is None or layer.lower() == part.lower():
            found.append((paths.make_path(entity), kind, layer))
    points = [point for path, _, _ in found for point in path.control_vertices()]
    size = 0.0
    if points:
        xy = np.array([(point.x, point.y) for point in points])
        if not (np.abs(xy) < FAR).all():
            why = "it has a coordinate that is not finite, or too large"
            raise unreadable(why, "repair the drawing in the program that wrote it")
        size = float(np.hypot(*np.ptp(xy, axis=0)))
    curves = []
    for path, kind, layer in found:
        subpaths = path.sub_paths() if path.has_sub_paths else [path]
        for each in subpaths:
            corners = [(p.x, p.y) for p in each.flattening(max(FLATNESS * size, 1e-300))]
            if len(corners) > 1:
                curves.append(Curve(np.array(corners), bool(each.is_closed), kind, (layer,)))
    unit = UNITS.get(int(document.header.get("$INSUNITS", 0)))
    return Drawing(curves, unit, "layer", tuple(layers), ())


CURVES: Final = frozenset(
    {"LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "SOLID", "TRACE"}
)


def _document(ezdxf: Any, data: bytes) -> Any:
    """The document in the bytes of a DXF file."""
    if data.startswith(b"AC10") or data.startswith(b"AutoCAD Binary"):
        what = "a DWG file" if data.startswith(b"AC10") else "a DXF file in binary form"
        raise unreadable(f"it is {what}", ASCII_HELP)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if "SECTION" not in text[:100_000] or not text.rstrip().endswith("EOF"):
        why = "its text does not begin or not end as DXF does"
        raise unreadable(why, "save it anew; a file that was cut off has no EOF at its end")
    most = 3 * MAX_ENTITIES  # with layers and other entries of tables
    if sum(1 for _ in islice(_ENTRY.finditer(text), most + 1)) > most:
        raise unreadable(f"it has more than {most} entries", ALONE_HELP)
    return ezdxf.read(io.StringIO(text))


def _entities(document: Any) -> Iterator[tuple[Any, str]]:
    """Entities of the model space with their layers, blocks taken apart; raises E170."""
    stack: list[tuple[Iterator[Any], str | None, int]] = [(iter(document.modelspace()), None, 0)]
    count = 0
    while stack:
        entities, block_layer, depth = stack[-1]
        entity = next(entities, None)
        if entity is None:
            stack.pop()
            continue
        is_bent = entity.dxftype() in ("LWPOLYLINE", "POLYLINE") and entity.has_arc
        count += len(entity) if is_bent else 1  # each of its arcs takes as long as an entity
        if count > MAX_ENTITIES or depth > 20:
            why = f"it has more than {MAX_ENTITIES} curves, those of its blocks counted"
            raise unreadable(why, ALONE_HELP)
        layer = str(entity.dxf.get("layer", "0"))
        if layer == "0" and block_layer is not None:  # as CAD programs show it
            layer = block_layer
        if entity.dxftype() != "INSERT":
            yield entity, layer
            continue
        if entity.mcount > MAX_ENTITIES:
            count = MAX_ENTITIES
            continue
        parts = entity.multi_insert() if entity.mcount > 1 else [entity]
        stack.append((_inside(parts), layer, depth + 1))


def _inside(inserts: Any) -> Iterator[Any]:
    for insert in inserts:
        yield from insert.virtual_entities()
