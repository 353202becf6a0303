"""The outline of the body in the tree of a task: `body`, corners in M or a drawing.

body = [[X, Y], [X, Y], [X, Y]]
body = "lid.dxf"
body = { file = "lid.svg", id = "lid" }
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon
from burmester.io.reading.outlines.outline_file import OutlineFile, folder_of, read_outline
from burmester.io.reading.trees.limits_tree import Model, Pair, model_fault
from burmester.io.reading.trees.locations import Document, Path

__all__ = ["PART_KEYS", "drawn_outline", "outline_file", "read_body"]

PART_KEYS = ("layer", "id")  # what part of a drawing is meant: of DXF, and of SVG

_CORNERS: TypeAdapter[list[list[float]]] = TypeAdapter(Annotated[list[Pair], Field(min_length=3)])
_HELP = (
    "body is a list of corners in order around it, in M: [[X, Y], [X, Y], [X, Y]] or more; "
    'or a drawing: "lid.dxf", or file and layer, or file and id'
)


class _Drawing(Model):
    file: str
    layer: str | None = None
    id: str | None = None


def read_body(
    tree: dict[str, Any], document: Document, length_unit: str | None
) -> tuple[Polygon | None, tuple[Advice, ...]]:
    """The outline in the tree of a task, and how a drawing was read.

    Raises E103 to E107 as for limits, E108 (a layer and an id), E131, and what drawings raise.
    """
    given = tree.get("body")
    if given is None:
        return None, ()
    if isinstance(given, str | dict):
        try:
            drawing = _Drawing(file=given) if isinstance(given, str) else _Drawing(**given)
        except ValidationError as error:
            raise _fault(document, error) from None
        file = outline_file(drawing.file, drawing.layer, drawing.id, document, ("body",))
        return drawn_outline(file, document, ("body",), length_unit)
    try:
        corners = _CORNERS.validate_python(given, strict=True)
    except ValidationError as error:
        raise _fault(document, error) from None
    try:
        return Polygon(np.array(corners)), ()
    except InputError as error:
        raise document.again(error, "body") from None


def _fault(document: Document, error: ValidationError) -> InputError:
    faults: list[Any] = list(error.errors(include_url=False))
    fault = next((each for each in faults if each["type"] == "extra_forbidden"), faults[0])
    if fault["type"] == "missing":
        message, where = f"{document.named('body')} names no file", document.where("body")
        return InputError("E105", message, where=where, help=_HELP)
    item = "a text" if fault["loc"] and isinstance(fault["loc"][0], str) else "a corner"
    return model_fault(document, ("body", *fault["loc"]), fault, item, _HELP)


def outline_file(
    path: str, layer: str | None, id: str | None, document: Document, at: Path
) -> OutlineFile:
    """The drawing that a tree names, and its part; raises E108 where it has two parts."""
    if layer is not None and id is not None:
        raise InputError(
            "E108",
            f"{document.named(*at)} has layer and id",
            where=document.where(*at, "id", key=True),
            why="a drawing in DXF has layers, one in SVG ids",
            help="leave one of the two out",
        )
    return OutlineFile(path, layer if id is None else id)


def drawn_outline(
    file: OutlineFile, document: Document, at: Path, length_unit: str | None
) -> tuple[Polygon, tuple[Advice, ...]]:
    """The outline in a drawing that a tree names, with the place of its name in errors."""
    try:
        outline, note = read_outline(file, folder_of(document.source.label), length_unit)
    except InputError as error:
        raise document.again(error, *at) from None
    return outline, (note,)
