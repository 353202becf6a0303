"""One thing that can be asked of a linkage, with all that is said of it anywhere.

A new one is one module with a `Requirement`, and its name in `table`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, final

from burmester.cures import Cure
from burmester.errors import InputError

if TYPE_CHECKING:  # options are told without NumPy
    from burmester.numerics.arrays import FloatArray
    from burmester.requirements.figures import Figures

Form: TypeAlias = Literal["number", "names", "choice", "area", "flag", "corridor"]


class Looser(NamedTuple):
    """A looser bound, in words, and by how much: radians, a logarithm of a ratio, or 1."""

    bound: Any
    words: str
    size: float


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Requirement:
    """A requirement; its bounds are as users state them, angles in degrees.

    name: the argument of `Requirements`, and the key in files.  kind: its name in verdicts.
    excess: how far figures (*,) are beyond a bound, (*,), radians, logarithms of ratios, lengths or
        1; 0 keeps it, and so does nan.
    said: what a linkage does that exceeds a bound, after "it" or a name; takes a unit of lengths.
    slack: what may be exceeded; by rounding a bound is missed by less.
    standard: the bound where nothing is asked.  scaled: whether bounds are lengths, and that of the
        standard is in spans of the motion.
    short: how a linkage falls short of the standard, after "it"; takes lengths with their unit.
    assumed: bounds of a family where nothing is asked, at first and where nothing keeps them;
    words: a bound that is asked for.  useful: what is kept even where the bound is dropped.
    form: how it is written; None where nobody asks for it.  default: what asks for nothing.
    choices: its values, in words; known: the names that may be in it.
    label: of its field on a page.
    option, metavar, help: on the command line; `subject` "is given twice".
    such: what stands in a file.
    checked: the value of what a caller gives; raises InputError E134.
    looser: a bound that the figures of one linkage keep, or that is a share of the way to it, or
        more; None where no such bound helps.
    written: a bound as the option takes it.
    """

    name: str
    kind: str = ""
    excess: Callable[[Figures, Any], FloatArray] = lambda figures, _bound: figures.none
    said: Callable[[Figures, Any, str], str] = lambda _figures, _bound, _unit: ""
    slack: Callable[[Any], float] = lambda _: 1e-9
    standard: Any = None
    scaled: bool = False
    short: Callable[[Figures, Callable[[float], str]], str] = lambda _figures, _length: ""
    assumed: tuple[float, ...] = ()
    words: Callable[[Any], str] = lambda _bound: ""
    useful: float | None = None
    form: Form | None = None
    default: Any = None
    option: str = ""
    label: str = ""
    metavar: str | None = None
    choices: Mapping[str, str] = field(default_factory=dict)
    known: tuple[str, ...] = ()
    help: str = ""
    subject: str = ""
    such: str = ""
    checked: Callable[[object], Any] = lambda value: value
    looser: Callable[[Any, Figures, float], Looser | None] = lambda _bound, _figures, _share: None
    written: Callable[[Any], str] = "{:g}".format
    plain: Callable[[Any], Any] = lambda value: value

    @property
    def code(self) -> str:
        """Its name in verdicts, as a code."""
        return self.kind.replace(" ", "-")

    @property
    def argument(self) -> str:
        """The name of the option's value in a command."""
        return self.name if self.form == "names" else self.option[2:].replace("-", "_")

    def given(self, bound: Any = None) -> Cure:
        """What asks for a bound; None: for one that is left open."""
        if bound is None:
            return Cure(self.name, None, self.option, words=self.subject.rpartition(" ")[0])
        return Cure(self.name, bound, self.option, self.written(bound), self.words(bound))

    def cure(self, bound: Any, figures: Figures) -> Cure | None:
        """With what the linkage of some figures keeps it; None where nothing helps."""
        looser = self.looser(bound, figures, 1.0)
        return None if looser is None else self.given(looser.bound)


Bounds: TypeAlias = Mapping[Requirement, Any]


def shown(value: object) -> str:
    """A value in short, as messages quote it."""
    from burmester.values import shown as in_short  # noqa: PLC0415  it loads NumPy

    return in_short(value)


def number(value: object, what: str, *, infinite: bool = False) -> float:
    """A finite number (or infinity, where that is one), or E134."""
    if not isinstance(value, Real) or isinstance(value, bool):
        raise InputError(
            "E134", f"{what} is {shown(value)}, not a number", help="give a number, such as 0.5"
        )
    try:
        out = float(value)
    except OverflowError:
        out = math.nan
    if not math.isfinite(out) and not (infinite and out == math.inf):
        raise InputError(
            "E134", f"{what} is {shown(value)}, not a finite number", help="give a finite number"
        )
    return out


@final
@dataclass(frozen=True, slots=True)
class Number:
    """A number that is asked for, and what it may be; called, the check of a value: E134.

    measure: what it counts, for its unit.  what: it is.
    wrong: what is said of one that is out of bounds, with a place for it.
    least: the bound is allowed itself; above, below: it is not.  infinite: whether infinity is.
    """

    measure: Literal["number", "length", "angle"]
    what: str
    wrong: str
    why: str
    help: str
    least: float = -math.inf
    above: float = -math.inf
    below: float = math.inf
    infinite: bool = False

    def __call__(self, value: object) -> float:
        """The number that a caller gives."""
        out = number(value, self.what, infinite=self.infinite)
        if out < self.least or out <= self.above or self.below <= out < math.inf:
            raise InputError("E134", self.wrong.format(out), why=self.why, help=self.help)
        return out

    @property
    def bounds(self) -> dict[str, float]:
        """Those that it has, by name."""
        every = {name: getattr(self, name) for name in ("least", "above", "below")}
        return {name: bound for name, bound in every.items() if math.isfinite(bound)}


def above(value: float) -> str:
    """The value rounded up to three digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.ceil(value / step) * step:.3g}"
