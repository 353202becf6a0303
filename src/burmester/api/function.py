"""From pairs of angles, or a function, to function generators in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.api.linkage import as_type
from burmester.api.python_words import in_python_words
from burmester.api.result import AnyResult, Result
from burmester.api.synthesize import require_callable
from burmester.describe import generator_words
from burmester.errors import InputError
from burmester.functions.found_generator import FoundGenerator
from burmester.io.reading.functions.function_options import Spacing, task_of_function, task_of_pairs
from burmester.numerics.arrays import FloatArray
from burmester.progress import Listener, shown
from burmester.synthesis.function_generation import (
    FunctionSynthesis,
    coupler_synthesis,
    generate_function,
)
from burmester.tasks.motion_task import AngleUnit, require_angle_unit
from burmester.values import real_numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FunctionGenerators(AnyResult[FoundGenerator], FunctionSynthesis):
    """A `FunctionSynthesis` to look at, save and hand over: the generators by rank.

    Examples
    --------
    >>> import burmester
    >>> found = burmester.synthesize_function(
    ...     "log10(x)", (1, 2), input_deg=60, output_deg=60, pairs=5
    ... )
    >>> found.best.type
    'double-rocker'
    """

    @classmethod
    def of(cls, synthesis: FunctionSynthesis) -> Self:
        """A synthesis that can be looked at and handed over."""
        return as_type(cls, synthesis)

    def coupler_motion(self, which: int | str = 0) -> Result:
        """A generator as a linkage that guides its coupler, to draw, animate and export."""
        return Result.of(coupler_synthesis(self[which]))

    def plot(self) -> Figure:
        """The structural error over the input, by Matplotlib."""
        from burmester import plot  # noqa: PLC0415  Matplotlib may be missing

        with plot.house_style():
            return plot.structural_error_figure(self)

    def _columns(self) -> tuple[Sequence[str], list[tuple[str, ...]], range]:
        rows = [generator_words.row(self, each) for each in self]
        return generator_words.HEADS, rows, range(2, 9)

    def _sentences(self) -> list[str]:
        return generator_words.best_sentences(self)


def synthesize_function(
    function: str | Callable[[FloatArray], FloatArray] | ArrayLike,
    x: tuple[float, float] | None = None,
    *,
    input_deg: float | None = None,
    output_deg: float | None = None,
    angle_unit: AngleUnit | None = None,
    pairs: int | None = None,
    spacing: Spacing | None = None,
    opposite: bool = False,
    minimax: bool = False,
    input_phase_deg: float | None = None,
    output_phase_deg: float | None = None,
    ground: float = 1.0,
    transmission_deg: float | None = None,
    link_ratio: float | None = None,
    types: Set[str] | None = None,
    progress: Listener | None = None,
) -> FunctionGenerators:
    """The four-bars whose output angle is a function of the input angle, judged and ranked.

    Parameters
    ----------
    function : str, callable, or (N, 2) array_like
        An expression in x such as "log10(x)", a function of arrays, or pairs of input and output
        angles in rows.
    x : (float, float)
        The range of x, for an expression or a function.
    input_deg, output_deg : float
        How far the two links turn over that range, in degrees.
    angle_unit : {"deg", "rad"}
        The unit of pairs in rows; it is never guessed.
    pairs : int, optional
        How many pairs are taken from a function: 3 to 5 are met exactly.  By default 61, met as
        nearly as possible.
    spacing : {"chebyshev", "even"}, optional
        Where they are: by default Chebyshev's spacing up to 5, even beyond.
    opposite : bool
        Whether the output link turns against the input link.
    minimax : bool
        Whether the greatest error is to be least, instead of the sum of squares.
    input_phase_deg, output_phase_deg : float, optional
        The angles of the links, from the ground link, where input and output are 0.  They are found
        where they are not given.
    ground : float
        The length of the ground link.
    transmission_deg, link_ratio : float, optional
        What a linkage has to keep: the least transmission angle, and the longest link over the
        shortest.
    types : set of str, optional
        The types allowed, such as {"double-rocker"}, or the words "grashof" and "non-grashof".
    progress : callable, optional
        Called with a `Progress` where something begins.

    Raises
    ------
    InputError
        E110 (pairs without an angle unit), E125 (no numbers, or of a wrong shape), E134 (a type
        that is not known), E190 (an expression that cannot be read), E191 (a task that makes no
        sense), E192 (infinitely many linkages), E194 (settings that are missing or make no sense).

    Examples
    --------
    >>> import burmester
    >>> rows = [(0, 0), (15, 10), (30, 25), (45, 45), (60, 75)]
    >>> found = burmester.synthesize_function(rows, angle_unit="deg")
    >>> print(found.outcome.message)
    2 function generators of the 3 that such pairs have, 1 of them usable
    """
    require_callable(progress)
    given = {
        "x": x,
        "input_deg": input_deg,
        "output_deg": output_deg,
        "pairs": pairs,
        "spacing": spacing,
        "opposite": opposite,
        "minimax": minimax,
        "input_phase_deg": input_phase_deg,
        "output_phase_deg": output_phase_deg,
        "ground": ground,
        "transmission_deg": transmission_deg,
        "link_ratio": link_ratio,
        "types": types,
    }
    stated = {name: value for name, value in given.items() if value is not None}
    if isinstance(function, str) or callable(function):
        if any(each is None for each in (x, input_deg, output_deg)):
            raise InputError(
                "E194",
                "a function needs x, input_deg and output_deg",
                help="give all three, such as x=(1, 2), input_deg=60, output_deg=60",
            )
        task = task_of_function({"expression": function, **stated})
    else:
        require_angle_unit(angle_unit)
        rows = real_numbers(function, (None, 2), "the pairs")
        rows = rows if angle_unit == "deg" else np.degrees(rows)
        task = task_of_pairs(rows[:, 0], rows[:, 1], None, stated)
    with in_python_words(), shown(progress):
        return FunctionGenerators.of(generate_function(task))
