"""A link held by three legs: all places at which its three points keep their distances.

The turn of the link is a root of a polynomial of degree six, found as eigenvalues and polished on
the three circles; so all places are found.
"""

from __future__ import annotations

import numpy as np

from burmester.numerics.arrays import ComplexArray, FloatArray

NEARLY_REAL = 1e-6  # from the unit circle: the root of a place before Newton's method
NEWTON_STEPS = 3
EXACT = 1e-9  # of the size: a place that misses a circle by more is none


def triad(
    centres: ComplexArray, points: ComplexArray, radii: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """The places of a link with three points, each at a distance from its centre.

    |z + t points_k - centres_k| = radii_k for k = 1, 2, 3.  centres, points, radii: (*, 3).
    Returns the turns t (*, 6), unit complex numbers, and the shifts z (*, 6); nan where none.
    """
    cc, pp = centres[..., 1:] - centres[..., :1], points[..., 1:] - points[..., :1]
    size = np.sqrt((abs(cc) ** 2 + abs(pp) ** 2).sum(-1) + (radii**2).sum(-1))[..., None]
    cc, pp, rr = cc / size, pp / size, radii / size

    def parts(t: ComplexArray) -> tuple[ComplexArray, ComplexArray, FloatArray]:
        w = pp[..., None, :] * t[..., None] - cc[..., None, :]
        s = (rr[..., None, 1:] ** 2 - rr[..., None, :1] ** 2 - abs(w) ** 2) / 2
        u = s[..., 1] * w[..., 0] - s[..., 0] * w[..., 1]
        return w, u, (w[..., 0].conj() * w[..., 1]).imag

    t = np.broadcast_to(np.exp(2j * np.pi * np.arange(8) / 8), (*size.shape[:-1], 8))
    _, u, det = parts(t)
    t = laurent_roots(abs(u) ** 2 - rr[..., :1] ** 2 * det**2, 3)
    with np.errstate(all="ignore"):
        real, t = abs(abs(t) - 1) < NEARLY_REAL, t / abs(t)
        w, u, det = parts(t)
        z = 1j * u / det
        for _ in range(NEWTON_STEPS):
            t, z = _nearer(t, z, w, pp, rr)
            w, _, _ = parts(t)
        q = np.concatenate([z[..., None], z[..., None] + w], -1)
        real &= abs(abs(q) - rr[..., None, :]).max(-1) < EXACT
    return (
        np.where(real, t, np.nan),
        np.where(real, size * z + centres[..., :1] - points[..., :1] * t, np.nan),
    )


def _nearer(
    t: ComplexArray, z: ComplexArray, w: ComplexArray, points: ComplexArray, radii: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """A step of Newton's method on the three circles, in the angle of t and in z."""
    q = np.stack([z, z + w[..., 0], z + w[..., 1]])
    turn = 1j * np.stack([0 * z, points[..., None, 0] * t, points[..., None, 1] * t])
    off = np.abs(q) ** 2 - np.moveaxis(radii, -1, 0)[..., None] ** 2
    rows = (q.conj() * turn).real, q.real, q.imag
    step = solved_three(rows, off / 2)
    return t * np.exp(-1j * step[0]), z - step[1] - 1j * step[2]


def solved_three(columns: tuple[FloatArray, ...], right: FloatArray) -> list[FloatArray]:
    """The solutions of systems of three equations, by Cramer's rule.

    columns: of the matrix, (3, *) each; right: (3, *).
    """

    def det(one: FloatArray, two: FloatArray, three: FloatArray) -> FloatArray:
        first = one[0] * (two[1] * three[2] - two[2] * three[1])
        second = one[1] * (two[2] * three[0] - two[0] * three[2])
        return np.asarray(first + second + one[2] * (two[0] * three[1] - two[1] * three[0]))

    whole = det(*columns)
    out = []
    for k in range(3):
        changed = [right if k == i else column for i, column in enumerate(columns)]
        out.append(det(*changed) / whole)
    return out


def laurent_roots(values: FloatArray, degree: int) -> ComplexArray:
    """The roots (*, 2 degree) of Laurent polynomials with powers from -degree to degree.

    values: (*, m), at the m-th roots of one, m > 2 degree.
    """
    c, n = np.fft.fft(values, axis=-1), 2 * degree
    c = np.concatenate([c[..., -degree:], c[..., : degree + 1]], -1)
    out = np.zeros((*c.shape[:-1], n, n), complex)
    out[..., 1:, :-1] = np.eye(n - 1)
    out[..., -1] = -c[..., :-1] / c[..., -1:]
    return np.asarray(np.linalg.eigvals(out))
