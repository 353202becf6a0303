"""Where a driver at F or at G stands still: all dead points, of degree 24 each.

With the angle at F held, CDE hangs on three legs, AC, BD and GE; it gives way where these meet in
one point: EG passes through the instant centre I of CDE against the first link.  With the angle at
G held the third leg is EF, which passes through I.  Both are a polynomial in the angle of AC, and
in that of BD as well; where AC sweeps a small arc only its polynomial loses digits, so that the
places of both are taken together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.stephenson.chain import EXCHANGED, Chain, inserted
from burmester.stephenson.triad import laurent_roots, solved_three

NEAR_CIRCLE = 1e-2  # of the unit circle: roots that Newton's method starts from
STEPS = 12
EXACT = 1e-10  # a residual, in sizes
MOVED = 0.05  # radians; a start that moves by more is none
DIFFERENCE = 1e-7  # radians, for derivatives
SAME = 1e-6  # sizes; joints of two places that all are nearer are one place


def standstill(chain: Chain, driven: str) -> ComplexArray:
    """The joints (m, 7) of one chain wherever the angle at F, or at G, stands still."""
    own = _from_first(chain, driven)
    other = inserted(_from_first(chain.exchanged(), driven), EXCHANGED)
    every = np.concatenate([own, other])
    kept: list[int] = []
    for k in range(len(every)):
        if (np.abs(every[kept] - every[k]).max(axis=-1) > SAME * chain.size()).all():
            kept.append(k)
    return every[kept]


def _from_first(chain: Chain, driven: str) -> ComplexArray:
    """The places (m, 7) that the polynomial in the angle of AC has."""
    root = _polynomial_roots(chain, driven)
    angle = np.angle(root[np.abs(np.abs(root) - 1) < NEAR_CIRCLE])
    angle, side, way = (
        each.ravel() for each in np.meshgrid(angle, [1.0, -1.0], [1.0, -1.0], indexing="ij")
    )
    start = chain.joints(angle, side, way, closed=True)
    c, d, e = (start[:, k] for k in (2, 3, 4))
    x = np.stack([angle, np.angle(e - c), np.angle(d - chain.base)])
    found, good = _polished(chain, x, way, driven)
    turn, c = np.exp(1j * found[1]), chain.first * np.exp(1j * found[0])
    if driven == "F":
        joints = chain.with_coupler(c, turn, np.ones(len(way)), closed=True)
        joints[:, 6] = joints[:, 4] + way * _toward_centre(chain, found) * chain.upper
    else:
        joints = chain.with_coupler(c, turn, way)
    good &= np.isfinite(joints).all(axis=-1)
    return joints[good]


def _polished(
    chain: Chain, start: FloatArray, way: FloatArray, driven: str
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Newton's method in the angles (3, m) of AC, CE and BD, and where it succeeds."""
    x = start.copy()
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            off = _residual(chain, x, way, driven)
            columns = []
            for k in range(3):
                beside = x.copy()
                beside[k] += DIFFERENCE
                columns.append((_residual(chain, beside, way, driven) - off) / DIFFERENCE)
            step = np.array(solved_three((columns[0], columns[1], columns[2]), off))
            x = x - np.clip(np.nan_to_num(step), -MOVED, MOVED)
        off = np.abs(_residual(chain, x, way, driven)).max(axis=0)
    moved = np.abs(x - start)[:1].max(axis=0)
    return x, (off < EXACT) & (moved < MOVED)


def _residual(chain: Chain, x: FloatArray, way: FloatArray, driven: str) -> FloatArray:
    """How open the loop is, and how far from its standstill the driver: (3, m), in sizes."""
    size = chain.size()
    c, turn = chain.first * np.exp(1j * x[0]), np.exp(1j * x[1])
    gap = c + turn * chain.d - chain.base - chain.second * np.exp(1j * x[2])
    e, toward = c + turn * chain.arm, _toward_centre(chain, x)
    if driven == "F":
        g = e + way * toward * chain.upper
        last = (np.abs(g - chain.f) ** 2 - chain.lower**2) / size**2
    else:
        last = ((e - chain.f).conj() * toward).imag / size
    return np.stack([gap.real / size, gap.imag / size, last])


def _toward_centre(chain: Chain, x: FloatArray) -> ComplexArray:
    """The direction (m,) of the line from the instant centre of the second link to E."""
    first, turn, second = (np.exp(1j * each) for each in x)
    d, e = turn * chain.d, turn * chain.arm
    m, k = (d * second.conj()).imag, (first * second.conj()).imag
    line = first * m - k * e
    return np.asarray(line / np.abs(line))


def _polynomial_roots(chain: Chain, driven: str) -> ComplexArray:
    """The roots of the polynomial in the turn of AC; real angles are on the unit circle.

    Points and their formal conjugates are functions of the turn, on both sides of D; the product
    over both sides is a polynomial.
    """
    degree, power = (12, 4) if driven == "F" else (6, 2)
    chain = chain.scaled(1 / chain.size())
    a = np.exp(2j * np.pi * np.arange(4 * degree) / (4 * degree))
    w, v = chain.base - chain.first * a, chain.base - chain.first / a
    m = w * v + np.abs(chain.d) ** 2 - chain.second**2
    root = np.sqrt(4 * w * v * np.abs(chain.d) ** 2 - m**2 + 0j)
    out = (w * v) ** power
    arm, d, f = complex(chain.arm), complex(chain.d), complex(chain.f)
    for s in (1, -1):
        x, xc = (m + 1j * s * root) / (2 * v), (m - 1j * s * root) / (2 * w)  # CD
        y, yc = x * arm / d, xc * arm / d.conjugate()  # CE
        r, rc = x - w, xc - v  # BD
        e, ec = y + chain.base - w - f, yc + chain.base - v - f.conjugate()  # FE
        along, across = (x * rc - xc * r) / 2j, (a * rc - r / a) / 2j
        n, nc = a * along - across * y, along / a - across * yc  # from the instant centre to E
        if driven == "F":
            far = e * ec + chain.upper**2 - chain.lower**2
            out = out * (far**2 * n * nc - chain.upper**2 * (ec * n + e * nc) ** 2)
        else:
            out = out * (ec * n - e * nc) / 2j
    return laurent_roots(out.real, degree)
