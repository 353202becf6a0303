"""Surroundings in the tree of a task: the list `keep_out` and the table `surroundings`.

    [[keep_out]]
    name = "bumper"
    box = [[X, Y], [X, Y]]

    [surroundings]
    link_width = 8

Imported on first use, as pydantic is slow to import.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon, box
from burmester.io.reading.stated_surroundings import StatedSurroundings
from burmester.io.reading.trees.body_tree import drawn_outline, outline_file
from burmester.io.reading.trees.limits_tree import Model, Number, Pair, TwoPairs, model_fault
from burmester.io.reading.trees.locations import Document, Path, close_match
from burmester.tasks.surroundings import KeepOut, Surroundings

__all__ = ["SURROUNDINGS_KEYS", "read_surroundings"]

SURROUNDINGS_KEYS = ("keep_out", "surroundings")  # beside the poses

_SHAPES = ("polygon", "box", "file")


class _Region(Model):
    name: str | None = None
    polygon: Annotated[list[Pair], Field(min_length=3)] | None = None
    box: TwoPairs | None = None
    file: str | None = None
    layer: str | None = None
    id: str | None = None


class _Surroundings(Model):
    link_width: Number | None = None
    margin: Number | None = None
    body_in_plane: bool | None = None


_REGIONS: TypeAdapter[list[_Region]] = TypeAdapter(list[_Region])
_REGION = (
    "a keep-out region has one of polygon, three corners or more [[X, Y], [X, Y], [X, Y]]; box, "
    "two corners [[X, Y], [X, Y]]; or file, a drawing, with layer or id; and a name, if you like"
)
_TABLE = (
    "surroundings has the keys link_width and margin with a length each, and body_in_plane, true "
    "or false; or some of them"
)


def read_surroundings(
    tree: dict[str, Any], document: Document, length_unit: str | None
) -> tuple[StatedSurroundings, tuple[Advice, ...]]:
    """The surroundings in the tree of a task, and how drawings were read.

    Raises E103 to E107 as for limits, E108 (a region of two shapes), E131, E176, and what drawings
    raise.
    """
    given = tree.get("keep_out")
    regions = [given] if isinstance(given, dict) else given
    single = regions is not given
    keep_out: list[KeepOut] = []
    notes: tuple[Advice, ...] = ()
    if regions is not None:
        try:
            tables = _REGIONS.validate_python(regions)
        except ValidationError as error:
            raise _region_fault(document, error, single) from None
        for k, table in enumerate(tables):
            at: Path = ("keep_out",) if single else ("keep_out", k)
            region, read_as = _region(table, document, at, length_unit)
            keep_out.append(region)
            notes += read_as
    try:
        whole = _Surroundings.model_validate(tree.get("surroundings") or {})
    except ValidationError as error:
        fault: Any = error.errors(include_url=False)[0]
        help = _TABLE
        if fault["type"] == "extra_forbidden":
            help = _instead(str(fault["loc"][-1]), tuple(_Surroundings.model_fields), _TABLE)
        path = ("surroundings", *fault["loc"])
        raise model_fault(document, path, fault, "a text", help) from None
    values = whole.model_dump(exclude_none=True)
    for key, value in values.items():
        try:
            Surroundings(**{key: value})
        except InputError as error:
            raise document.again(error, "surroundings", key) from None
    where = document.where("keep_out" if keep_out else "surroundings", key=True)
    return StatedSurroundings(tuple(keep_out), values, where), notes


def _region(
    table: _Region, document: Document, at: Path, length_unit: str | None
) -> tuple[KeepOut, tuple[Advice, ...]]:
    """One region; contradictions are refused here, where its location is known."""
    given = [key for key in _SHAPES if getattr(table, key) is not None]
    if len(given) != 1:
        code, what = ("E108", " and ".join(given)) if given else ("E105", "no shape")
        message = f"{document.named(*at)} has {what}"
        raise InputError(code, message, where=document.where(*at), help=_REGION)
    (shape,) = given
    part = next((key for key in ("layer", "id") if getattr(table, key) is not None), None)
    if part and shape != "file":
        message = f"{document.named(*at, part)} is for a drawing, and there is a {shape}"
        where, help = document.where(*at, part, key=True), f"delete {part}, or name a file"
        raise InputError("E108", message, where=where, help=help)
    notes: tuple[Advice, ...] = ()
    if table.file is not None:
        file = outline_file(table.file, table.layer, table.id, document, at)
        polygon, notes = drawn_outline(file, document, (*at, "file"), length_unit)
    else:
        polygon = _typed(table, shape, document, at)
    try:
        return KeepOut(polygon, table.name), notes
    except InputError as error:
        raise document.again(error, *at) from None


def _typed(table: _Region, shape: str, document: Document, at: Path) -> Polygon:
    """A region of corners."""
    try:
        if table.polygon is not None:
            return Polygon(np.array(table.polygon))
        low, high = np.array(table.box)
        region = box(low.tolist(), high.tolist())
        if not isinstance(region, Polygon):
            raise InputError(
                "E176",
                "a keep-out box has no inside",
                why=f"it is {region}",
                help="give it a width and a height",
            )
    except InputError as error:
        raise document.again(error, *at, shape) from None
    return region


def _region_fault(document: Document, error: ValidationError, single: bool) -> InputError:
    """The error for a fault reported by pydantic."""
    fault: Any = error.errors(include_url=False)[0]
    keys = fault["loc"][1:] if single else fault["loc"]
    help = _REGION
    if fault["type"] == "extra_forbidden":
        help = _instead(str(keys[-1]), tuple(_Region.model_fields), _REGION)
    return model_fault(document, ("keep_out", *keys), fault, "a text", help)


def _instead(key: str, known: tuple[str, ...], help: str) -> str:
    near = close_match(key, known)
    return f"write {near} in its place; {help}" if near else help
