"""Requirements in JSON and TOML: the keys under `requirements`, and the values they give.

Imported on first use, as pydantic is slow to import.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from pydantic import Field, ValidationError, create_model

from burmester.errors import InputError
from burmester.geometry.regions import Region
from burmester.io.reading.specification import LIMIT_KEYS, SHAPES
from burmester.io.reading.stated_requirements import (
    FILE_KEYS,
    REQUIREMENT_KEYS,
    StatedRequirement,
    checked_requirement,
)
from burmester.io.reading.trees.limits_tree import Model, Number, Pair, TwoPairs, model_fault
from burmester.io.reading.trees.locations import Document, close_match
from burmester.requirements.requirement import Form
from burmester.requirements.table import ASKED
from burmester.wording import listed

__all__ = ["read_requirements"]


class _Footprint(Model):
    box: TwoPairs | None = None
    polygon: Annotated[list[Pair], Field(min_length=3)] | None = None


_VALUES: dict[Form | None, Any] = {
    "number": Number, "names": list[str], "choice": str, "area": _Footprint, "flag": bool,
}  # fmt: skip
_Requirements = create_model(
    "_Requirements",
    __base__=Model,
    **{each.name: (_VALUES[each.form] | None, None) for each in ASKED},  # type: ignore[call-overload]
)
_HELP = {each.name: each.such for each in ASKED}
_TABLE = f"a table of requirements has {listed(FILE_KEYS)}, or some of them"


def read_requirements(tree: dict[str, Any], document: Document) -> tuple[StatedRequirement, ...]:
    """The requirements in the tree of a task.

    Raises E103 to E107 as for limits, E108 (a footprint of two shapes), E131, E132 and E134.
    """
    for key in REQUIREMENT_KEYS[1:]:
        if key in tree:
            message = f"{document.named(key)} stands beside the poses, where it has no effect"
            help = "write it under requirements, or delete it"
            if key == "requirement":
                help = "write requirements in its place, or delete it"
            raise InputError("E107", message, where=document.where(key, key=True), help=help)
    given, path = tree.get("requirements"), "requirements"
    if given is None:
        return ()
    try:
        table = _Requirements.model_validate(given)
    except ValidationError as error:
        raise _requirements_fault(document, error.errors(include_url=False)[0]) from None
    out = []
    for each in ASKED:
        key, value = each.name, getattr(table, each.name)
        if value is None:
            continue
        if each.form == "names" and value:
            names = [
                _requirement(document, key, [name], path, key, i).value
                for i, name in enumerate(value)
            ]
            value = frozenset(name for each in names for name in each)
        elif each.form == "area":
            value = _area(value, document, path, key)
        stated = _requirement(document, key, value, path, key)
        out.append(stated._replace(where=document.where(path, key, key=True)))
    return tuple(out)


def _requirement(document: Document, field: str, value: Any, *path: str | int) -> StatedRequirement:
    """A requirement that is valid by itself; raises the errors of `Requirements`, located."""
    try:
        return checked_requirement(field, value, "")
    except InputError as error:
        raise document.again(error, *path) from None


def _area(tree: _Footprint, document: Document, *path: str) -> Region:
    given = tree.model_dump(exclude_none=True)
    if len(given) != 1:
        code, what = ("E108", " and ".join(given)) if given else ("E105", "no shape")
        message, where = f"{document.named(*path)} has {what}", document.where(*path)
        raise InputError(code, message, where=where, help=_HELP[path[-1]])
    ((shape, points),) = given.items()
    try:
        return SHAPES[shape][1](np.array(points))
    except InputError as error:
        raise document.again(error, *path, shape) from None


def _requirements_fault(document: Document, fault: Any) -> InputError:
    """The error for a fault reported by pydantic."""
    keys = list(fault["loc"])
    help = _HELP.get(str(keys[0]), _TABLE) if keys else _TABLE
    if fault["type"] == "extra_forbidden":
        if keys[-1] in LIMIT_KEYS:
            help = f"write {keys[-1]} under limits, which holds for single dyads"
        elif near := close_match(
            str(keys[-1]), FILE_KEYS if len(keys) == 1 else ("box", "polygon")
        ):
            help = f"write {near} in its place; {help}"
    item = "a name of a type" if keys[:1] == ["types"] else "one of its names"
    return model_fault(document, ("requirements", *keys), fault, item, help)
