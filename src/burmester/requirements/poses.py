"""How the poses are met: the greatest errors, and the order.  They are judged with the poses."""

from __future__ import annotations

from typing import Final

from burmester.errors import InputError
from burmester.requirements.requirement import Number, Requirement, shown


def _flag(value: object) -> bool:
    if type(value).__name__ not in ("bool", "bool_"):  # Python's, or NumPy's
        raise InputError(
            "E134",
            f"any_order is {shown(value)}, neither true nor false",
            help="give True where the poses need not be met in their order, else False",
        )
    return bool(value)


WITHIN: Final = Requirement(
    name="within",
    form="number",
    option="--within",
    label="position error at most",
    metavar="LENGTH",
    help="Largest position error allowed at a pose.",
    subject="the greatest acceptable error is",
    words="a position error of at most {:g}".format,
    such="within is one length in the unit of the poses, such as 0.5",
    checked=Number(
        "length",
        "the greatest acceptable error",
        "an error of at most {:g} is impossible",
        why="no pose is met better than rounding allows",
        help="give a length above zero, and mark poses that must be met exactly",
        above=0,
    ),
)
WITHIN_ANGLE: Final = Requirement(
    name="within_deg",
    form="number",
    option="--within-angle",
    label="angle error at most",
    metavar="DEG",
    help="Largest angle error allowed at a pose; by default the angle that counts as much as "
    "the position error of --within.",
    subject="the greatest acceptable angle error is",
    words="an angle error of at most {:g}°".format,
    such="within_deg is one angle in degrees, such as 2",
    checked=Number(
        "angle",
        "the greatest acceptable angle error",
        "an error of at most {:g}° is impossible",
        why="no pose is met better than rounding allows",
        help="give an angle above zero, and mark poses that must be met exactly",
        above=0,
    ),
)
ANY_ORDER: Final = Requirement(
    name="any_order",
    form="flag",
    default=False,
    option="--any-order",
    label="the poses may be met in any order",
    help="The poses may be met in any order.",
    words=lambda _any: "any order of the poses",
    subject="the order of the poses is",
    such="write true or false",
    checked=_flag,
)
