"""The outline of the body in the tree of a task: `body`, a list of corners in M."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from burmester.errors import InputError
from burmester.geometry.regions import Polygon
from burmester.io.reading.trees.limits_tree import Pair, model_fault
from burmester.io.reading.trees.locations import Document

__all__ = ["read_body"]

_CORNERS: TypeAdapter[list[list[float]]] = TypeAdapter(Annotated[list[Pair], Field(min_length=3)])
_HELP = "body is a list of corners in order around it, in M: [[X, Y], [X, Y], [X, Y]] or more"


def read_body(tree: dict[str, Any], document: Document) -> Polygon | None:
    """The outline in the tree of a task; raises E103 to E107 as for limits, and E131."""
    if tree.get("body") is None:
        return None
    try:
        corners = _CORNERS.validate_python(tree["body"], strict=True)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        raise model_fault(document, ("body", *fault["loc"]), fault, "a corner", _HELP) from None
    try:
        return Polygon(np.array(corners))
    except InputError as error:
        raise document.again(error, "body") from None
