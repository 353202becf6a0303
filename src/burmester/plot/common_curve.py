"""The curve in which two quadrics of a pencil meet: the image curve that all of the pencil share.

At a half angle (s, c) = (Z3, Z4) each quadric of Eq. (13) is a circle of the (Z1, Z2) plane,

    p1 |z|² + b . z + e = 0,      b linear and e quadratic in (s, c),

so the curve is where two circles meet: the foot of the line through both common points, and a step
sqrt(D) to either side, with D a form of degree four in (s, c).  Between the real zeros of D the
curve makes closed loops, each written down as a function of one parameter.  Nothing here needs the
quadrics to be dyads.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from burmester.numerics.arrays import FloatArray

MAX_IMAGINARY = 1e-7  # of a root's size: largest imaginary part of a real root
ZERO_COEFFICIENT = 1e-12  # of the largest coefficient: smaller ones count as 0


def common_curve(p: ArrayLike, q: ArrayLike, samples: int = 400) -> list[FloatArray]:
    """The loops in which two quadrics meet, as image points.

    Parameters
    ----------
    p, q : (8,) array_like
        The coefficients of two constraint manifolds.
    samples : int
        Points of each loop.

    Returns
    -------
    list of (samples, 4) array
        Unit image points; the last sample is the first point again, perhaps of the other sign.  Of
        two quadrics of lines (p1 = q1 = 0: two sliders) the points have other lengths, because the
        curve runs through displacements that are infinitely far away.  The list is empty where the
        quadrics have no real point in common.

    Examples
    --------
    >>> from burmester import plot
    >>> from burmester.fourbar.dyad import RR
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> [loop.shape for loop in plot.common_curve(crank.coefficients(), rocker.coefficients(), 50)]
    [(50, 4), (50, 4)]
    """
    one, two = (np.asarray(v, dtype=np.float64) for v in (p, q))
    if _roundness(two) > _roundness(one):
        one, two = two, one
    unit = _length(one)
    # Lengths measured in one that is about theirs, so that no coefficient is small for its unit.
    in_unit = unit ** np.array([2, 0, 1, 1, 1, 1, 0, 0])
    one, two = (v * in_unit / np.linalg.norm(v * in_unit) for v in (one, two))
    back = np.array([unit, unit, 1.0, 1.0])
    if _roundness(one) <= ZERO_COEFFICIENT:
        return [_crossing(one, two, np.linspace(0, np.pi, samples)) * back]
    two, one = two - two[0] / one[0] * one, one / one[0]
    loops = []
    for low, high in _spans(one, two):
        u = np.linspace(0, 2 * np.pi, samples)
        if high - low >= np.pi:  # never a zero: two loops, one on either side
            half = low + u / 2
            loops += [_points(one, two, half, np.full(samples, side)) for side in (1.0, -1.0)]
        else:
            # Near a zero of D its root goes as that of the distance, and so does this parameter.
            half = (low + high) / 2 - (high - low) / 2 * np.cos(u)
            side = np.where(u <= np.pi, 1.0, -1.0)
            loops.append(_points(one, two, half, side))
    return [loop * back for loop in loops]


def _roundness(p: FloatArray) -> float:
    """0 for a quadric of lines, about 1 for one of circles, whatever the unit of length."""
    first, zeroth = np.linalg.norm(p[2:6]), np.linalg.norm(p[[1, 6, 7]])
    with np.errstate(divide="ignore"):
        return float(np.nan_to_num(abs(p[0]) * zeroth / first**2, nan=0.0))


def _length(p: FloatArray) -> float:
    """A length of the size of those in p; 1 where there is none."""
    first, zeroth = np.linalg.norm(p[2:6]), np.linalg.norm(p[[1, 6, 7]])
    if _roundness(p) > ZERO_COEFFICIENT:
        size = max(first / abs(p[0]), np.sqrt(zeroth / abs(p[0])))
    else:
        size = zeroth / first if first > 0 else 1.0
    return float(size) if size > 0 else 1.0


def _circle(p: FloatArray) -> tuple[list[FloatArray], FloatArray]:
    """A quadric's b (two polynomials) and e, in tan(half angle), the constant first."""
    return [p[[4, 2]], p[[5, 3]]], p[[7, 6, 1]]


def _spans(p: FloatArray, q: FloatArray) -> list[tuple[float, float]]:
    """Where D > 0, as intervals of the half angle; one of length pi where it is all of them."""
    poly = np.polynomial.polynomial
    (b1, b2), e = _circle(p)
    (n1, n2), f = _circle(q)
    square = poly.polyadd(poly.polymul(n1, n1), poly.polymul(n2, n2))
    inside = poly.polysub(poly.polyadd(poly.polymul(b1, b1), poly.polymul(b2, b2)) / 4, e)
    away = poly.polysub(f, poly.polyadd(poly.polymul(n1, b1), poly.polymul(n2, b2)) / 2)
    d = np.zeros(5)
    for sign, term in ((1, poly.polymul(square, inside)), (-1, poly.polymul(away, away))):
        d[: len(term)] += sign * term
    d[np.abs(d) <= ZERO_COEFFICIENT * np.abs(d).max()] = 0.0
    roots = poly.polyroots(np.trim_zeros(d, "b"))
    real = roots[np.abs(roots.imag) <= MAX_IMAGINARY * (1 + np.abs(roots))].real
    ends = np.sort(np.arctan(real))
    if d[4] == 0:  # a form: what the polynomial lacks in degree is at infinity
        ends = np.append(ends, np.pi / 2)

    def positive(half: float) -> bool:
        s, c = np.sin(half), np.cos(half)
        return bool((d * s ** np.arange(5) * c ** np.arange(4, -1, -1)).sum() > 0)

    if not ends.size:
        return [(-np.pi / 2, np.pi / 2)] if positive(0.1) else []
    nexts = np.append(ends[1:], ends[0] + np.pi)
    return [
        (float(a), float(b))
        for a, b in zip(ends, nexts, strict=True)
        if b > a and positive((a + b) / 2)
    ]


def _points(p: FloatArray, q: FloatArray, half: FloatArray, side: FloatArray) -> FloatArray:
    """Unit image points (n, 4) at half angles (n,), on a side (n,) of the foot."""
    s, c = np.sin(half), np.cos(half)
    b = np.stack([p[2] * s + p[4] * c, p[3] * s + p[5] * c])
    n = np.stack([q[2] * s + q[4] * c, q[3] * s + q[5] * c])
    e = p[1] * s * s + p[6] * s * c + p[7] * c * c
    f = q[1] * s * s + q[6] * s * c + q[7] * c * c
    size = (n * n).sum(axis=0)
    away = f - (n * b).sum(axis=0) / 2
    step = np.sqrt(np.maximum(size * ((b * b).sum(axis=0) / 4 - e) - away * away, 0.0)) / size
    foot = -b / 2 - away / size * n
    z = foot + side * step * np.stack([-n[1], n[0]])
    return np.stack([z[0], z[1], s, c], axis=-1)


def _crossing(p: FloatArray, q: FloatArray, half: FloatArray) -> FloatArray:
    """Image points (n, 4) of norm 1 where at half angles (n,) two lines b . z + e = 0 cross."""
    s, c = np.sin(half), np.cos(half)
    (p1, p2, pe), (q1, q2, qe) = (
        (v[2] * s + v[4] * c, v[3] * s + v[5] * c, v[1] * s * s + v[6] * s * c + v[7] * c * c)
        for v in (p, q)
    )
    across = p1 * q2 - p2 * q1
    z = np.stack([p2 * qe - q2 * pe, q1 * pe - p1 * qe, s * across, c * across], axis=-1)
    size = np.linalg.norm(z, axis=-1, keepdims=True)
    return np.asarray(z / np.where(size > 0, size, 1.0))
