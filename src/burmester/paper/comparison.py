"""A printed number beside the computed one, and the verdict on it.

The spread of a computed number is its smallest and greatest value over copies of the data drawn
within the rounding of its printed digits.  A verdict is always computed: a known misprint is called
one only where the print fails and what is meant in its place passes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from enum import StrEnum
from typing import Final, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.numerics.arrays import FloatArray

MISPRINTS: Final = {  # item: what is printed, what is meant, what went wrong
    "Table 2, angle 6": (52.67, 52.87, "A digit is wrong"),
    "Table 3, sigma5": (0.2868, 0.1868, "A digit is wrong"),
    "Table 4, v1 p5": (-0.8009, -0.08009, "A zero was lost"),
    "Fig. 4, Xc1": (-22, -2.2, "The decimal point was lost"),
    "Fig. 4, Yc1": (1, 0.1, "The decimal point was lost"),
    "Fig. 4, Xc2": (-115, 1.15, "The decimal point was lost, and the sign is wrong"),
    "Fig. 4, Yc2": (38, 0.38, "The decimal point was lost"),
    "Table 6, sigma3": (0.0696, 0.00696, "A zero was lost"),
    "Eq. (24), tau1": (0.07263, -0.07263, "The sign was lost"),
}


class Verdict(StrEnum):
    """The result of comparing a printed number with the computed one."""

    AGREES = "agrees"  # to the last printed digit
    WITHIN = "within rounding"  # inside the spread that the rounding of the poses allows
    MISPRINT = "misprint"  # it fails, and what is meant in its place passes
    FREE = "free rotation"  # it depends on the free choice of v1, v2, and passes for the printed
    BELOW = "below rounding"  # zero on exact data; the printed digits of the poses hide it
    DIFFERS = "differs"


@final
@dataclass(frozen=True, slots=True)
class Comparison:
    """A printed number beside the computed one, angles in degrees.

    printed: as the paper writes it; low, high: the spread of `computed`, or None; note: the
    evidence, or nothing; form: how the numbers are written, with the digits of the print.
    """

    item: str
    printed: str
    computed: float
    low: float | None
    high: float | None
    verdict: Verdict
    note: str = ""
    form: str = ".4f"

    def noted(self, note: str) -> Comparison:
        """The same with a further note."""
        return replace(self, note=f"{self.note} {note}".strip())

    def cells(self) -> tuple[str, str, str, str, str]:
        """Item, print, computed, spread and verdict, for a table."""
        spread = ""
        if self.low is not None and self.high is not None:
            spread = f"{self.low:{self.form}} .. {self.high:{self.form}}"
        return self.item, self.printed, f"{self.computed:{self.form}}", spread, str(self.verdict)


@final
@dataclass(frozen=True, slots=True)
class Section:
    """A table or a few equations of the paper, with notes about them."""

    title: str
    rows: tuple[Comparison, ...]
    remarks: tuple[str, ...] = ()


def compare(
    item: str,
    printed: float,
    values: FloatArray,
    form: str = "",
    other: tuple[FloatArray, Verdict] | None = None,
    *,
    vanishes: bool = False,
) -> Comparison:
    """The verdict on one printed number.

    values: (k,), the computed one first, then its rounding samples.  vanishes: it is zero on
    exact data.  other: values (k,) that decide where the print does not agree with the
    computed one: the verdict if it fits them; else it differs.
    """
    printed = float(printed)
    form = form or f".{max(4, -int(Decimal(repr(printed)).as_tuple().exponent))}f"
    low, high = (float(values.min()), float(values.max())) if values.size > 1 else (None, None)
    wrong, meant, why = MISPRINTS.get(item, (None, 0.0, ""))
    verdict, note = _fits(printed, values, form), ""
    if other is not None and verdict is not Verdict.AGREES:
        verdict = Verdict.DIFFERS if _fits(printed, other[0], form) is Verdict.DIFFERS else other[1]
    elif verdict is Verdict.DIFFERS:
        if printed == wrong and _fits(meant, values, form) is not Verdict.DIFFERS:
            verdict, note = Verdict.MISPRINT, f"{why}: {meant:g} is meant."
        elif vanishes and low is not None and 0 <= printed < low:
            verdict = Verdict.BELOW
    text = f"{printed:{form}}"
    return Comparison(item, text, float(values[0]), low, high, verdict, note, form)


def _fits(printed: float, values: FloatArray, form: str) -> Verdict:
    """AGREES, WITHIN or DIFFERS: by half a unit of the last printed digit, then by the spread."""
    digits = int(form[1:-1])
    if form[-1] == "e":
        digits -= math.floor(math.log10(abs(printed)))
    half = 0.5 * 10.0**-digits * (1 + 1e-9)
    if abs(values[0] - printed) <= half:
        return Verdict.AGREES
    inside = values.min() - half <= printed <= values.max() + half
    return Verdict.WITHIN if inside and values.size > 1 else Verdict.DIFFERS


def compare_columns(
    where: str,
    names: Sequence[str],
    printed: ArrayLike,
    values: FloatArray,
    form: str = "",
    *,
    vanishes: bool = False,
) -> list[Comparison]:
    """A comparison for each of the columns of values (k, n)."""
    columns = zip(names, np.asarray(printed, dtype=np.float64), values.T, strict=True)
    return [
        compare(f"{where}, {n}", x, column, form, vanishes=vanishes) for n, x, column in columns
    ]
