"""Outlines in the tree of a task: `body`, the list `keep_out` and the table `surroundings`.

body = [[X, Y], [X, Y], [X, Y]]
body = "lid.dxf"
body = { file = "lid.svg", id = "lid" }

[[keep_out]]
name = "bumper"
box = [[X, Y], [X, Y]]

[surroundings]
link_width = 8
"""

from __future__ import annotations

from typing import Any, Final

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon
from burmester.io.reading.outlines.outline_file import OutlineFile, folder_of, read_outline
from burmester.io.reading.specification import StatedSurroundings
from burmester.io.reading.trees.node import (
    NOT_NEGATIVE,
    PAIR,
    Field,
    Fields,
    Node,
    one_or_more,
    table_schema,
)
from burmester.io.reading.trees.specification_tree import SHAPE_FIELDS, read_region
from burmester.tasks.surroundings import MAX_REGIONS, KeepOut, Surroundings

_AREAS: Final[Fields] = {name: SHAPE_FIELDS[name] for name in ("polygon", "box")}
_OUTLINE: Final[Fields] = {name: Field(Node.text) for name in ("name", "file", "layer", "id")} | {
    name: Field(lambda node: node, "", area.schema) for name, area in _AREAS.items()
}
_DRAWING: Final[Fields] = {key: _OUTLINE[key] for key in ("file", "layer", "id")}
_SURROUNDINGS: Final[Fields] = {
    "link_width": Field(Node.number, schema=NOT_NEGATIVE),
    "margin": Field(Node.number, schema=NOT_NEGATIVE),
    "body_in_plane": Field(Node.flag),
}
_BODY_HELP = (
    "body is a list of corners in order around it, in M: [[X, Y], [X, Y], [X, Y]] or more; "
    'or a drawing: "lid.dxf", or file and layer, or file and id'
)
_REGION_HELP = (
    "a keep-out region has one of polygon, three corners or more [[X, Y], [X, Y], [X, Y]]; box, "
    "two corners [[X, Y], [X, Y]]; or file, a drawing, with layer or id; and a name, if you like"
)
_SURROUNDINGS_HELP = (
    "surroundings has the keys link_width and margin with a length each, and body_in_plane, true "
    "or false; or some of them"
)
BODY_SCHEMA: Final = table_schema(_DRAWING, required=["file"]) | {
    "description": _BODY_HELP,
    "type": ["array", "string", "object"],
    "items": PAIR,
    "minItems": 3,
}
KEEP_OUT_SCHEMA: Final = one_or_more(
    table_schema(_OUTLINE, oneOf=[{"required": [shape]} for shape in (*_AREAS, "file")]),
    most=MAX_REGIONS,
) | {"description": _REGION_HELP}
SURROUNDINGS_SCHEMA: Final = table_schema(_SURROUNDINGS, description=_SURROUNDINGS_HELP)


def read_body(node: Node, length_unit: str | None) -> tuple[Polygon, tuple[Advice, ...]]:
    """The outline at `body`, and how a drawing was read.

    Raises E103 to E107 as for limits, E108 (a layer and an id), E131, and what drawings raise.
    """
    node = node._replace(help=_BODY_HELP)
    if isinstance(node.value, list):
        return node.build(Polygon, node.points(3)), ()
    if isinstance(node.value, str):
        return _drawn(node, {"file": node.text()}, node, length_unit)
    given = node.table(_DRAWING)
    if "file" not in given:
        raise node.fault("E105", "names no file")
    return _drawn(node, given, node, length_unit)


def read_surroundings(
    keep_out: Node | None, around: Node | None, length_unit: str | None
) -> tuple[StatedSurroundings, tuple[Advice, ...]]:
    """The surroundings at `keep_out` and `surroundings`, and how drawings were read.

    Raises E103 to E107 as for limits, E108 (a region of two shapes), E131, E176, and what drawings
    raise.
    """
    regions, values, place = [], {}, keep_out or around
    notes: tuple[Advice, ...] = ()
    for node in keep_out._replace(help=_REGION_HELP).one_or_more() if keep_out else ():
        region, read_as = _keep_out(node, length_unit)
        regions.append(region)
        notes += read_as
    if around is not None:
        values = around._replace(help=_SURROUNDINGS_HELP).table(_SURROUNDINGS)
        for key, value in values.items():
            around.at(key).build(Surroundings, **{key: value})
    where = place.document.where(*place.path, key=True) if place else ""
    return StatedSurroundings(tuple(regions), values, where), notes


def _keep_out(node: Node, length_unit: str | None) -> tuple[KeepOut, tuple[Advice, ...]]:
    """One region; contradictions are refused here, where its location is known."""
    given = node.table(_OUTLINE)
    shape, _ = node.only({key: given[key] for key in ("polygon", "box", "file") if key in given})
    part = next((key for key in ("layer", "id") if key in given), None)
    notes: tuple[Advice, ...] = ()
    if shape == "file":
        polygon, notes = _drawn(node, given, node.at("file"), length_unit)
    elif part:
        message = f"is for a drawing, and there is a {shape}"
        raise node.at(part).fault("E108", message, f"delete {part}, or name a file", key=True)
    else:
        region = read_region(node._replace(value={shape: node.value[shape]}), _AREAS)
        if not isinstance(region, Polygon):
            why, help = f"it is {region}", "give it a width and a height"
            no_inside = InputError("E176", "a keep-out box has no inside", why=why, help=help)
            raise node.document.located(no_inside, *node.path, shape)
        polygon = region
    return node.build(KeepOut, polygon, given.get("name")), notes


def _drawn(
    node: Node, given: dict[str, Any], at: Node, length_unit: str | None
) -> tuple[Polygon, tuple[Advice, ...]]:
    """The outline in a drawing that a table names, with the place of its name in errors."""
    if "layer" in given and "id" in given:
        why, help = "a drawing in DXF has layers, one in SVG ids", "leave one of the two out"
        raise node.fault("E108", "has layer and id", help, why=why, key="id")
    file = OutlineFile(given["file"], given.get("layer", given.get("id")))
    folder = at.build(folder_of, node.document.source.label)
    outline, note = at.build(read_outline, file, folder, length_unit)
    return outline, (note,)
