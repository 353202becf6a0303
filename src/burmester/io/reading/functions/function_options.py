"""A function task as options, keywords and trees state it: all of them come here.

E191 a function task that makes no sense      E194 settings that are missing or exclude each other
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final, Literal, TypeAlias

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.linkage import TYPE_OF_SIGNS
from burmester.io.reading.functions.expression import read_expression, read_number
from burmester.io.reading.option_text import lengths_from_texts
from burmester.io.reading.pose_table import Source, shown
from burmester.numerics.arrays import FloatArray
from burmester.requirements.links import LINK_RATIO
from burmester.requirements.transmission import TRANSMISSION
from burmester.requirements.types import TYPE, TYPES
from burmester.tasks.function_task import (
    FUNCTION_SAMPLES,
    FunctionTask,
    SampledFunction,
    chebyshev_spacing,
    even_spacing,
)
from burmester.tasks.requirements import Requirements
from burmester.wording import listed

KEPT: Final = (TRANSMISSION, LINK_RATIO, TYPE)  # what can be asked of generators
Spacing: TypeAlias = Literal["chebyshev", "even"]
SAMPLES: Final = 61  # of a function whose number of pairs is not given
MOST_PAIRS: Final = 1000
MOST_RANGE: Final = 350.0  # degrees, of an input or an output
MOST_EXACT: Final = 5  # pairs; from more the spacing is even where none is given
LEAST_STEP: Final = 1e-9  # radians; inputs that differ less are one


Stated: TypeAlias = Mapping[str, Any]  # what is stated of a function task, by the keys of a file
NOTHING: Final[Stated] = MappingProxyType({})


def read_range(source: Source) -> tuple[float, float]:
    """The ends of a range FROM:TO, each a number that may be an expression; raises E190, E194."""
    low, colon, high = source.text.partition(":")
    if not colon:
        raise InputError(
            "E194",
            f"{source.label} has no range",
            help=f"give both ends, such as {source.label} 1:2",
        )
    return read_number(source, 0, low), read_number(source, len(low) + 1, high)


def read_links(option: str, text: str) -> tuple[float, float, float, float]:
    """The lengths of ground, input link, coupler and output link; raises E134, E194."""
    every = lengths_from_texts(option, [text])
    if len(every) != 4:
        raise InputError(
            "E194",
            f"{option} has {len(every)} numbers, and a four-bar has four links",
            help="give the ground link, the input link, the coupler and the output link, such as "
            f"{option} 1,0.5,1.2,0.9",
        )
    ground, a, r, b = every
    return ground, a, r, b


def task_of_function(stated: Stated, source: Source | None = None) -> FunctionTask:
    """The task of a function over a range of x, by angles in degrees.

    Raises E134 (a type that is not known), E190, E191 and E194.

    stated: with an `expression`, a text or a function of arrays, its range `x`, `input_deg` and
        `output_deg`.  source: where the expression stands, for carets.
    """
    function, pairs = stated["expression"], stated.get("pairs")
    input_range, output_range = stated["input_deg"], stated["output_deg"]
    low, high = (float(each) for each in stated["x"])
    if not (math.isfinite(low) and math.isfinite(high) and low != high):
        raise InputError(
            "E191",
            f"x runs from {low:g} to {high:g}, which is no range",
            help="give two different numbers, such as --x 1:2",
        )
    for name, value in (("input", input_range), ("output", output_range)):
        if not 0 < value <= MOST_RANGE:
            raise InputError(
                "E191",
                f"the {name} link is to turn by {value:g} deg",
                why=f"a range is above 0 and at most {MOST_RANGE:g} deg",
                help=f"give the range of the {name} in degrees, such as --{name} 60; for an output "
                "that turns against the input, say --opposite",
            )
    if pairs is not None and not 3 <= pairs <= MOST_PAIRS:
        raise InputError(
            "E192" if pairs < 3 else "E191",
            f"{pairs} pairs of angles are asked for",
            why=f"from 3 to {MOST_PAIRS} are taken",
            help="give --pairs 5 for five pairs that are met exactly, or leave --pairs out",
        )
    text = function if isinstance(function, str) else getattr(function, "__name__", "f")
    source = source or Source("expression", text)
    values = read_expression(source) if isinstance(function, str) else _checked(function)
    every = np.asarray(values(np.linspace(low, high, FUNCTION_SAMPLES)), dtype=float)
    if not np.isfinite(every).all():
        at = float(np.linspace(low, high, FUNCTION_SAMPLES)[int((~np.isfinite(every)).argmax())])
        raise InputError(
            "E191",
            f"{text} has no finite value at x = {at:g}",
            where=source.where(0, len(source.text)),
            help="give a range of x where it has, or another function",
        )
    if not np.ptp(every) > 1e-12 * np.abs(every).max():
        raise InputError(
            "E191",
            f"{text} is the same all over the range of x, so the output does not move",
            where=source.where(0, len(source.text)),
            help="give a function of x, such as log10(x), or another range of x",
        )
    sampled = SampledFunction(
        text,
        values,
        (low, high),
        math.radians(input_range),
        math.radians(-output_range if stated.get("opposite") else output_range),
        isinstance(function, str),
    )
    number = pairs or SAMPLES
    chosen = stated.get("spacing") or ("chebyshev" if number <= MOST_EXACT else "even")
    shares = chebyshev_spacing(number) if chosen == "chebyshev" else even_spacing(number)
    inputs, outputs = sampled.at(shares)
    return _task(inputs, outputs, stated, sampled, None)


def task_of_pairs(
    inputs: FloatArray,
    outputs: FloatArray,
    weights: FloatArray | None = None,
    stated: Stated = NOTHING,
    where: Callable[[int], str] | None = None,
) -> FunctionTask:
    """The task of pairs of angles in degrees; raises E134, E191 and E194.

    where: the location of a pair, by its number from 0.
    """
    if len(inputs) > MOST_PAIRS:
        raise InputError(
            "E191",
            f"there are {len(inputs)} pairs of angles, and {MOST_PAIRS} are the most",
            help="take one pair in ten, say",
        )
    theta, phi = np.radians(inputs), np.radians(outputs)
    for k in range(len(theta)):
        same = np.flatnonzero(np.abs(np.angle(np.exp(1j * (theta[:k] - theta[k])))) < LEAST_STEP)
        if len(same):
            raise InputError(
                "E191",
                f"pairs {int(same[0]) + 1} and {k + 1} have the same input, {inputs[k]:g} deg",
                where=where and where(k),
                why="at one input the linkage has one output; inputs that differ by full turns "
                "are one",
                help="delete one of the two pairs",
            )
    if len(phi) and np.ptp(phi) < LEAST_STEP:
        raise InputError(
            "E191",
            "all outputs are the same, so the output does not move",
            help="give outputs that differ",
        )
    return _task(theta, phi, stated, None, weights)


def _task(
    inputs: FloatArray,
    outputs: FloatArray,
    stated: Stated,
    function: SampledFunction | None,
    weights: FloatArray | None,
) -> FunctionTask:
    ground = stated.get("ground", 1.0)
    if not 0 < ground < 1e9:
        raise InputError(
            "E194",
            f"the length of the ground link is {ground:g}",
            help="give a number above 0 and below 1e+09",
        )
    one, two = (stated.get(f"{name}_phase_deg") for name in ("input", "output"))
    for name, value in (("input", one), ("output", two)):
        if value is not None and not math.isfinite(value):
            raise InputError(
                "E194", f"the {name} phase is {shown(value)}", help="give an angle in degrees"
            )
    known = {each.name for each in KEPT}
    asked = Requirements(**{name: value for name, value in stated.items() if name in known})
    of_generators = [name for name in TYPES if name in TYPE_OF_SIGNS.values()]
    if not any(map(asked.allows, of_generators)):
        allowed = sorted(asked.allowed_types or ())
        raise InputError(
            "E194",
            f"no function generator that is made is a {listed(allowed, 'or')}",
            help=f"give one or more of {listed(of_generators)}",
        )
    return FunctionTask(
        inputs,
        outputs,
        one and math.radians(one),
        two and math.radians(two),
        weights,
        ground,
        function,
        stated.get("minimax", False),
        asked,
    )


def _checked(function: Callable[[FloatArray], FloatArray]) -> Callable[[FloatArray], FloatArray]:
    """A function of arrays, whatever shape it gives back."""

    def values(x: FloatArray) -> FloatArray:
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(function(x), dtype=np.float64), np.shape(x))

    return values
