"""How a task is solved: the method, what is least, and how the linkages are to be made."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from burmester.errors import InputError
from burmester.tasks.motion_task import MOST
from burmester.tasks.option_table import OPTIONS, Method, Norm, Preference
from burmester.values import shown
from burmester.wording import listed


@final
@dataclass(frozen=True, slots=True)
class SynthesisOptions:
    """What a synthesis is to do with a task.

    Attributes
    ----------
    method
        "complete" finds every locally best dyad of six poses or more, and of any task with
        limits; "exact" meets five conditions: five poses, or fewer with pivots at points or on
        lines; "pencil" is the paper's, for six poses or more; "auto" is exact where there are
        five conditions and complete where there are more.
    norm
        What is least: "rms", the sum of squared distances, or "worst", the greatest distance.
    prefer
        By which figure of quality the recommended linkage is chosen where few poses leave
        infinitely many: "transmission", the greatest least transmission angle, up to 60 degrees;
        "size", the least extent; "accuracy", the least sensitivity.
    normalise
        False lets the pencil fit the numbers as they come, as the paper does.
    certify
        Whether a certificate is made, of a task without limits.
    length_per_radian
        The length, in the task's unit, that counts as much as one radian of angle error; None for
        that of the body's outline or of its travel (`default_length_per_radian`).
    manufacturing_tolerance
        How exactly links and pivots are built, in the task's unit: the spread of the errors is
        reported.  None for no report.
    rounding_step
        Lengths and pivots are rounded to multiples of this length, in the task's unit.
    stock_lengths
        The link lengths that are available, in the task's unit; the nearest ones are used.
    time_limit
        Seconds after which nothing more is looked for or refined; what must be done is.  None for
        no limit.
    nine_point_starts
        Whether linkages near the points of an open path are looked for from those through nine of
        them as well; other tasks have none.

    Raises
    ------
    InputError
        E134, where a word is unknown, or a length or the time limit is not a number above zero;
        E112, where a length is too large to compute with.
    """

    method: Method = "auto"
    norm: Norm = "rms"
    normalise: bool = True
    certify: bool = False
    length_per_radian: float | None = None
    manufacturing_tolerance: float | None = None
    rounding_step: float | None = None
    stock_lengths: Sequence[float] = ()
    prefer: Preference = "transmission"
    time_limit: float | None = None
    nine_point_starts: bool = False

    def __post_init__(self) -> None:
        for each in OPTIONS:
            value = getattr(self, each.name)
            if each.form == "word":
                _require_word(each.name, value, each.known)
            elif each.form == "flag" and not isinstance(value, bool | np.bool_):
                message = f"{each.name} is {shown(value)}, neither True nor False"
                help = f"give {each.name}=True or {each.name}=False"
                raise InputError("E134", message, help=help)
            elif each.form == "lengths":
                stock = (value,) if isinstance(value, str) or not np.iterable(value) else value
                stock = tuple(_length(each.name, length) for length in stock)
                object.__setattr__(self, each.name, stock)
            elif each.form == "length" and value is not None:
                object.__setattr__(self, each.name, _length(each.name, value))
            elif each.form == "seconds" and value is not None:
                such = "seconds above zero, such as 2.0"
                seconds = _above_zero(each.name, value, "a number of seconds", such)
                object.__setattr__(self, each.name, seconds)

    @property
    def refines(self) -> bool:
        """Whether linkages are refined as a whole; those of the pencil are the paper's."""
        return self.normalise and self.method != "pencil"

    @property
    def rounds(self) -> bool:
        """Whether dimensions are rounded."""
        return self.rounding_step is not None or bool(self.stock_lengths)


def _require_word(name: str, value: object, known: tuple[str, ...]) -> None:
    if not isinstance(value, str) or value not in known:
        raise InputError(
            "E134",
            f"there is no {name} {shown(value)}",
            help=f"choose {listed([repr(each) for each in known], 'or')}",
        )


def _above_zero(name: str, value: Any, what: str, such: str) -> float:
    """A number above zero, or E134; what: it is, such as "a length"; such: what to give."""
    real = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not (real and math.isfinite(value) and value > 0):
        message = f"{name} is {shown(value)}, not {what} above zero"
        raise InputError("E134", message, help=f"give {such}, or leave it out")
    return float(value)


def _length(name: str, value: Any) -> float:
    """A length above zero that can be computed with; raises E112 and E134."""
    such = "a length above zero, in the unit of the poses"
    length = _above_zero(name, value, "a length", such)
    if length > MOST:
        raise InputError(
            "E112",
            f"the {name.replace('_', ' ')} is too large",
            why=f"it is {length:g}, and {MOST:g} is the most to compute with",
            help="give a smaller length, in the unit of the poses, or leave it out",
        )
    return length
