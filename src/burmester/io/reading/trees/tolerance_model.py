"""A tolerance in JSON and TOML: of a pose, or of all poses of a task that state none.

    tolerance = { x = 0.1, y = "free", angle_deg = 0.5, axes = "body" }

A number, or "free".  `angle` is in the unit of the poses' angles.  Imported on first use, as
pydantic is slow to import.
"""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError
from pydantic_core import PydanticCustomError

from burmester.errors import InputError
from burmester.io.reading.stated_tolerances import FREE_WORDS, DefaultTolerance
from burmester.io.reading.trees.locations import Document, Path, close_match
from burmester.tasks.pose_tolerances import COMPONENTS

__all__ = ["FREE_HELP", "TOLERANCE_HELP", "ToleranceModel", "read_tolerance", "tolerance_fault"]

TOLERANCE_HELP = (
    'a tolerance has x, y and angle_deg (or angle, angle_rad), each a number or "free", and axes, '
    '"fixed" or "body"'
)
FREE_HELP = 'free is a list of some of "x", "y" and "angle"'
ANGLE_KEYS = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}


def _bound(value: Any) -> float:
    """The nearest double to a Decimal or an integer of TOML; infinite for "free"."""
    if isinstance(value, str) and value.strip().lower() in FREE_WORDS:
        return math.inf
    if type(value) is not int and not isinstance(value, Decimal):
        raise PydanticCustomError("no_tolerance", "not a number")
    number = float(Decimal(value))
    if math.isinf(number) and Decimal(value).is_finite():  # 1e400 is a finite Decimal
        raise PydanticCustomError("finite_number", "not finite")
    return number


_Bound = Annotated[float, BeforeValidator(_bound)]


class ToleranceModel(BaseModel):
    """A tolerance as it stands in a file."""

    model_config = ConfigDict(strict=True, str_strip_whitespace=True, extra="forbid")
    x: _Bound | None = None
    y: _Bound | None = None
    angle: _Bound | None = None
    angle_deg: _Bound | None = None
    angle_rad: _Bound | None = None
    axes: Literal["fixed", "body"] | None = None

    def bounds(self, unit: str | None) -> tuple[float, float, float]:
        """x, y and angle, the angle in `unit`; nan where nothing is stated."""
        angle = math.nan if self.angle is None else self.angle
        if self.angle_deg is not None:
            angle = self.angle_deg if unit == "deg" else math.radians(self.angle_deg)
        if self.angle_rad is not None:
            angle = self.angle_rad if unit != "deg" else math.degrees(self.angle_rad)
        x, y = (math.nan if each is None else each for each in (self.x, self.y))
        return x, y, angle

    def require_one_angle(self, document: Document, *path: str | int) -> None:
        """Refuse an angle that is stated twice: E108."""
        given = [key for key in ANGLE_KEYS if getattr(self, key) is not None]
        if len(given) > 1:
            raise InputError(
                "E108",
                f"{document.named(*path)} has {' and '.join(given)}",
                where=document.where(*path, given[1], key=True),
                help=f"delete one of them, such as {given[1]}",
            )


def read_tolerance(
    tree: dict[str, Any], document: Document, unit: str | None
) -> DefaultTolerance | None:
    """The tolerance beside the poses; raises E103 to E108.  unit: of the poses' angles."""
    if tree.get("tolerance") is None:
        return None
    try:
        model = ToleranceModel.model_validate(tree["tolerance"])
    except ValidationError as error:
        fault: Any = error.errors(include_url=False)[0]
        raise tolerance_fault(document, ("tolerance", *fault["loc"]), fault) from None
    model.require_one_angle(document, "tolerance")
    where = document.where("tolerance", key=True)
    return DefaultTolerance(model.bounds(unit), model.axes or "fixed", unit, where)


def tolerance_fault(document: Document, path: Path, fault: Any) -> InputError:
    """The error for a fault reported by pydantic in a tolerance or in `free`."""
    kind, given = fault["type"], fault.get("input")
    if kind == "string_unicode" and document.is_key(given, *path):
        path, kind = (*path, given), "extra_forbidden"
    value, of_free = document.shown(given, *path), "free" in path
    help = FREE_HELP if of_free else TOLERANCE_HELP
    code, message = {
        "finite_number": ("E103", "is not a finite number"),
        "no_tolerance": ("E104", f"is {value}, neither a number nor free"),
        "literal_error": ("E104", f"is {value}, none of the words that may stand there"),
        "extra_forbidden": ("E107", "is not known"),
    }.get(kind, ("E104", f"does not fit: {value}"))
    extra = kind == "extra_forbidden"
    if extra and (near := close_match(str(path[-1]), (*COMPONENTS, *ANGLE_KEYS, "axes"))):
        help = f"write {near} in its place; {help}"
    where = document.where(*path, key=extra)
    return InputError(code, f"{document.named(*path)} {message}", where=where, help=help)
