"""Dead points in closed form, for every pair of dyads: the inputs where the two closures meet.

In terms of f (see `loop_closure`), each pair of kinds has a highest f, a lowest f, both or none.
For 4R they are the triangles that the diagonal makes with coupler and follower laid straight:
(a - b)² <= g² + r² + 2 g r cos psi <= (a + b)².  Every distance from a bound to the ends of the
range of f is a product of sums of lengths, so nothing cancels near a change point, where one of
these distances is zero.
"""

from __future__ import annotations

from functools import reduce
from typing import NamedTuple

import numpy as np

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.numerics.arrays import FloatArray, complex_of

PARALLEL_RAILS = 1e-14  # two rails are parallel where the sine between them is below this


class Bound(NamedTuple):
    """A bound of f, (*,) each: scale > 0, scale (bound - least f), scale (greatest f - bound).

    The least f is -1 or 0; the greatest is 1, and infinite for slides.  q² is the product of
    low.scale (f - low) and high.scale (high - f); a missing bound has scale 0, and its factor
    is 1.
    """

    scale: FloatArray
    down: FloatArray
    up: FloatArray


class Closing(NamedTuple):
    """The closures and dead points of a pair of dyads: fields of `DrivenLoop` of the same names."""

    closures: int
    centre: FloatArray
    high: Bound
    low: Bound
    margin: FloatArray


def of_crank(first: RR, second: Dyad) -> Closing:
    """The closing of a second dyad on a crank."""
    c, m, r = complex_of(first.fixed_pivot), complex_of(first.moving_pivot), first.radius
    if isinstance(second, PP):
        return Closing(1, np.zeros_like(r), *_no_bounds(r), np.ones_like(r))
    if isinstance(second, PR):
        n, a = np.exp(1j * second.normal_angle), np.abs(complex_of(second.moving_pivot) - m)
        k = second.offset - (n.conj() * c).real
        high, low = Bound(r, r + k + a, r - k - a), Bound(r, r + k - a, r - k + a)
        margin = _smallest(r, a, *high[1:], *low[1:]) / (r + a + abs(k))
        return Closing(2, second.normal_angle, high, low, margin)
    to = c - complex_of(second.fixed_pivot)
    g = np.abs(to)
    if isinstance(second, RP):
        e = np.abs(second.offset - (np.exp(-1j * second.normal_angle) * m).real)
        margin = _smallest(r, e - abs(g - r), g + r - e) / (g + r + e)
        return Closing(2, np.angle(to), _no_bounds(r)[0], _at_length(e, g, r), margin)
    a, b = np.abs(complex_of(second.moving_pivot) - m), second.radius
    reach, fold = a + b, abs(a - b)
    excess = (g + r - reach, reach - abs(g - r), fold - abs(g - r), g + r - fold)
    margin = _smallest(a, b, r, *excess) / (g + r + reach)
    high = Bound(*(room / 4 for room in _at_length(reach, g, r)))
    return Closing(2, np.angle(to), high, _at_length(fold, g, r), margin)


def of_rail(first: PR, second: Dyad) -> Closing:
    """The closing of a second dyad on a pivot driven along a line."""
    m, one = complex_of(first.moving_pivot), np.ones_like(first.offset)
    no_high, no_low = _no_bounds(one)
    if isinstance(second, PP):
        return Closing(1, 0 * one, no_high, no_low, one)
    if isinstance(second, PR):
        a = np.abs(complex_of(second.moving_pivot) - m)
        between = first.normal_angle - second.normal_angle
        sine, e = np.sin(between), second.offset - first.offset * np.cos(between)
        parallel = np.abs(sine) < PARALLEL_RAILS
        centre, e = np.where(parallel, 0, -e / sine), np.where(parallel, abs(e), 0)
        high = Bound(np.where(parallel, 0, sine**2), (a - e) * (a + e), np.inf * one)
        margin = np.where(parallel, _smallest(a - e, a) / (a + e), np.where(a > 0, abs(sine), 0))
        return Closing(2, centre, high, no_low, margin)
    foot = complex_of(second.fixed_pivot) * np.exp(-1j * first.normal_angle)
    p = np.abs(first.offset - foot.real)
    if isinstance(second, RP):
        e = np.abs(second.offset - (np.exp(-1j * second.normal_angle) * m).real)
        low = Bound(one, (e - p) * (e + p), np.inf * one)
        return Closing(2, foot.imag, no_high, low, np.abs(e - p) / (e + p))
    a, b = np.abs(complex_of(second.moving_pivot) - m), second.radius
    reach, fold = a + b, abs(a - b)
    high = Bound(one / 4, (reach - p) * (reach + p) / 4, np.inf * one)
    low = Bound(one, (fold - p) * (fold + p), np.inf * one)
    return Closing(2, foot.imag, high, low, _smallest(a, b, reach - p, fold - p) / (reach + p))


def of_slot(first: RP, second: RR | PR | RP) -> Closing:
    """The closing of a second dyad on a turning slot."""
    c, back = complex_of(first.fixed_pivot), np.exp(-1j * first.normal_angle)
    if isinstance(second, RP):
        sine = np.sin(second.normal_angle - first.normal_angle)
        return Closing(1, 0 * sine, *_no_bounds(sine), np.abs(sine))
    k = (complex_of(second.moving_pivot) * back).real - first.offset
    if isinstance(second, PR):
        p = (np.exp(-1j * second.normal_angle) * c).real - second.offset
        margin = np.abs(abs(k) - abs(p)) / (abs(k) + abs(p))
        return Closing(1, second.normal_angle, *_no_bounds(k), margin)
    to, b = c - complex_of(second.fixed_pivot), second.radius
    g = np.abs(to)
    high, low = Bound(g, g + b - k, g - b + k), Bound(g, g - b - k, g + b + k)
    return Closing(2, np.angle(to), high, low, _smallest(b, *high[1:], *low[1:]) / (g + b + abs(k)))


def _at_length(length: FloatArray, g: FloatArray, r: FloatArray) -> Bound:
    """The bound where g² + r² + 2 g r cos psi = length²."""
    less = abs(g - r)
    up, down = (g + r - length) * (g + r + length), (length - less) * (length + less)
    return Bound(2 * g * r, down, up)


def _no_bounds(like: FloatArray) -> tuple[Bound, Bound]:
    """High and low where f runs over its whole range."""
    none, one = np.zeros_like(like), np.ones_like(like)
    return Bound(none, one, -one), Bound(none, -one, one)


def _smallest(*lengths: FloatArray) -> FloatArray:
    return reduce(np.minimum, [np.abs(length) for length in lengths])
