"""The proofs of a certificate: zeros in boxes, and why there are no others.

The derivatives of F = vᵀ G v (see `dyads.critical_points`) have degrees (1, 2), (1, 2), (2, 1),
(2, 1) in (c0 : c1 : c2) and (m0 : m1 : m2).  Where they have but finitely many common zeros these
count 33, with multiplicity (Bezout).  Two of them are at infinity for every task and count four
each (`infinity_takes_eight`); 25 simple ones exhaust the number.  A further zero z, isolated
or not, cannot be: add to the equations a small multiple of generic ones that vanish at z.  The
sum has finitely many zeros, 33 in all; 33 of them stay near those that were counted, and z is
one more.  So it is with two conics and their four points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.certificates.ball_arithmetic import (
    Ball,
    BallPoses,
    Matrix,
    System,
    column,
    flint,
    is_nonzero,
    positive_definite,
    upper_bound,
    zero_near,
)

MAX_RELATIVE_ERROR = 1e-7  # of a point's size; an exact point farther away is another one


class Zeros(NamedTuple):
    """Boxes with one zero each, all of them different.

    error: the greatest distance of a box from its computed point.
    """

    real: dict[int, Matrix]  # by their place among the points
    others: list[Matrix]
    error: float

    @property
    def total(self) -> int:
        return len(self.real) + len(self.others)


def proved_zeros(
    equations: Callable[[NDArray[Any]], System],
    points: NDArray[Any],
    real: NDArray[np.bool_],
    differ: Callable[[Matrix, Matrix], bool],
) -> Zeros:
    """Boxes around those of the points (k, n) that are proved to be zeros, real ones or not.

    equations: the system to solve near a point.  differ: whether two boxes surely hold different
    zeros.  A point marked `real` (k,) gets a real box; any other box must differ from its
    conjugate, and so from all real ones.
    """
    zeros = Zeros({}, [], 0.0)
    for k, point in enumerate(points):
        at = point.real if real[k] else point
        start = column(at, real=bool(real[k]))
        box = zero_near(equations(at), start)
        if box is None:
            continue
        away = max(upper_bound(e) for e in (box - start).entries())
        others = zeros.real.values() if real[k] else [*zeros.others, box.conjugate()]
        if away < MAX_RELATIVE_ERROR * (1 + np.abs(at).max()) and all(
            differ(box, other) for other in others
        ):
            if real[k]:
                zeros.real[k] = box
            else:
                zeros.others.append(box)
            zeros = zeros._replace(error=max(zeros.error, away))
    return zeros


def gram_of(poses: BallPoses) -> Matrix:
    """G (7, 7) with vᵀ G v the weighted sum of the squared circle residuals."""
    a = flint().arb_mat(
        [
            [
                *(d1 * d1 + d2 * d2, -2 * d1, -2 * d2),
                *(2 * (c * d1 + s * d2), 2 * (c * d2 - s * d1), -2 * c, -2 * s),
            ]
            for d1, d2, c, s in poses.places
        ]
    )
    total = flint().arb_mat([poses.weights]) * a
    mean = total.transpose() * total * (1 / sum(poses.weights))
    return a.transpose() * poses.weighted(a) - mean


def _features(x: Matrix) -> Matrix:
    """The column v (7, 1) at (c1, c2, m1, m2)."""
    c1, c2, m1, m2 = x.entries()
    return type(x)(7, 1, [1, c1, c2, m1, m2, c1 * m1 + c2 * m2, c2 * m1 - c1 * m2])


def squared_residual(gram: Matrix) -> System:
    """Half the gradient and half the Hessian of F = vᵀ G v at (c1, c2, m1, m2)."""

    def system(x: Matrix) -> tuple[Matrix, Matrix]:
        c1, c2, m1, m2 = x.entries()
        kind = type(x)
        rows = [[0, 1, 0, 0, 0, m1, -m2], [0, 0, 1, 0, 0, m2, m1]]
        rows += [[0, 0, 0, 1, 0, c1, c2], [0, 0, 0, 0, 1, c2, -c1]]
        jacobian, gradient = kind(rows), gram * _features(x)
        p, q = gradient[5, 0], gradient[6, 0]
        second_derivatives = kind([[0, 0, p, -q], [0, 0, q, p], [p, q, 0, 0], [-q, p, 0, 0]])
        return jacobian * gradient, jacobian * gram * jacobian.transpose() + second_derivatives

    return system


def infinity_takes_eight(gram: Matrix) -> bool:
    """Whether the two points at infinity are surely isolated zeros, of multiplicity four.

    In g = c1 + i c2, g* = c1 - i c2, and h, h* likewise, v becomes (c0 m0, g m0, g* m0, c0 h,
    c0 h*, g h*, g* h) in homogeneous unknowns, and with V = G v, counted from 1, the derivatives
    by g, h, g*, h* become

        m0 V2 + h* V6,   c0 V4 + g* V7,   m0 V3 + h V7,   c0 V5 + g V6.

    All vanish at c0 = m0 = g = h = 0, g* = h* = 1, where v is (0, 0, m0, 0, c0, g, h) to first
    order.  The first two start with the linear forms V6 and V7, which give g and h by m0 and c0
    if the block of G on (g h*, g* h) is regular.  The other two start with m0 V3 and c0 V5, which
    then are m0 (S11 m0 + S12 c0) and c0 (S21 m0 + S22 c0), with S the Schur complement on (g*, h*).
    Where these have no common zero but 0, the point is isolated and has multiplicity
    1 · 1 · 2 · 2.  The other point is its conjugate.

    Formula `at-infinity` of the theory.
    """
    lib = flint()
    half = lib.acb(1) / 2
    turn = lib.acb(0, 1) / 2
    rows: list[list[Ball]] = [[int(j == k == 0) for k in range(7)] for j in range(7)]
    for k in (1, 3, 5):  # c1 = (g + g*)/2, c2 = -i (g - g*)/2, and so m and the two products
        rows[k][k : k + 2] = [half, half]
        rows[k + 1][k : k + 2] = [-turn, turn]
    change = lib.acb_mat(rows)
    g = change.transpose() * lib.acb_mat(gram) * change

    def block(at: tuple[int, int], by: tuple[int, int]) -> Matrix:
        return lib.acb_mat([[g[j, k] for k in by] for j in at])

    products, rest = (5, 6), (2, 4)
    try:
        inverse = block(products, products).inv()
    except ZeroDivisionError:
        return False
    s = block(rest, rest) - block(rest, products) * inverse * block(products, rest)
    return all(is_nonzero(value) for value in (s[0, 0], s[1, 1], s.det()))


def grows_to_infinity(gram: Matrix) -> bool:
    """Whether F surely grows beyond all bounds far away, and so has a global minimum.

    Far away v points along (0, c, 0, c · m, c x m) or (0, 0, m, c · m, c x m), never along 0.
    """
    blocks = ((1, 2, 5, 6), (3, 4, 5, 6))
    return all(
        positive_definite(flint().arb_mat([[gram[j, k] for k in block] for j in block]))
        for block in blocks
    )


def first_is_least(gram: Matrix, boxes: Iterable[Matrix]) -> bool:
    """Whether F surely is less in the first box than in all others."""
    first, *others = [(_features(x).transpose() * gram * _features(x))[0, 0] for x in boxes]
    return all(first < other for other in others)


def circle_distances(poses: BallPoses) -> System:
    """Half the gradient and half the Hessian of the sum of (|R m + d - c| - r)².

    In the five unknowns (c1, c2, m1, m2, r), real.
    """

    def system(x: Matrix) -> tuple[Matrix, Matrix]:
        c1, c2, m1, m2, r = x.entries()
        forces, arm_turns, weighted_turns, residuals = [], [], [], []
        for (d1, d2, c, s), w in zip(poses.places, poses.weights, strict=True):
            a1, a2 = c * m1 - s * m2 + d1 - c1, s * m1 + c * m2 + d2 - c2
            arm = (a1 * a1 + a2 * a2).sqrt()
            u1, u2 = a1 / arm, a2 / arm
            along, across = c * u1 + s * u2, c * u2 - s * u1
            forces.append([-u1, -u2, along, across, -1])
            arm_turns.append([u2, -u1, -across, along, 0])
            residuals.append([w * (arm - r)])
            weighted_turns.append([residuals[-1][0] / arm * e for e in arm_turns[-1]])
        kind = type(x)
        jacobian, turns = kind(forces), kind(arm_turns)
        hessian = jacobian.transpose() * poses.weighted(jacobian)
        hessian += turns.transpose() * kind(weighted_turns)
        return jacobian.transpose() * kind(residuals), hessian

    return system


def stationary_line(poses: BallPoses, angle: Ball) -> tuple[list[Ball], bool] | None:
    """The stationary line fixed in F whose normal is nearer to `angle`, and whether it is the best.

    As balls: how far its normal is from `angle`, its offset, and the moving pivot.  The weighted
    sum of squared distances with all but the normal eliminated is a quadratic form of the normal,
    and the line an eigenvector.  None where that is not proved.
    """
    lib = flint()
    d = lib.arb_mat([[d1, d2] for d1, d2, _, _ in poses.places])
    others = lib.arb_mat([[c, s, -1] for _, _, c, s in poses.places])
    normal = others.transpose() * poses.weighted(others)
    if not positive_definite(normal):
        return None
    mixed = others.transpose() * poses.weighted(d)
    try:
        solve = normal.solve(mixed)
    except ZeroDivisionError:  # regular, but by less than these bits can invert
        return None
    form = d.transpose() * poses.weighted(d) - mixed.transpose() * solve
    # Half the difference of the eigenvalues is p along one eigenvector, with q = 0.
    sin, cos = (2 * angle).sin_cos()
    p, q = (form[0, 0] - form[1, 1]) / 2, form[0, 1]
    p, q = p * cos + q * sin, q * cos - p * sin
    if not is_nonzero(p):
        return None
    turn = (q / p).atan() / 2
    n2, n1 = (angle + turn).sin_cos()
    u, v, h = (-solve * lib.arb_mat([[n1], [n2]])).entries()
    return [turn, h, n1 * u + n2 * v, n2 * u - n1 * v], bool(p < 0)


# Eight times the conditions of Eq. (17), as quadratic forms: entries added to their mirror image.
_CONDITIONS = (
    {(0, 6): 4, (2, 4): -2, (3, 5): -2},
    {(0, 1): 4, (0, 7): -4, (2, 2): -1, (3, 3): -1, (4, 4): 1, (5, 5): 1},
)


def five_equations(poses: BallPoses) -> Callable[[NDArray[Any]], System]:
    """The equations for p (8,) near a root: five linear ones, two conditions, and a scale."""
    lib = flint()
    linear = []
    for (d1, d2, _, _), angle in zip(poses.places, poses.angles, strict=True):
        s, c = (lib.arb(angle) / 2).sin_cos()
        z1, z2 = (d1 * s - d2 * c) / 2, (d1 * c + d2 * s) / 2
        linear.append([z1 * z1 + z2 * z2, s * s, z1 * s, z2 * s, z1 * c, z2 * c, s * c, c * c])
    forms = [lib.arb_mat(8, 8) for _ in _CONDITIONS]
    for form, condition in zip(forms, _CONDITIONS, strict=True):
        for (j, k), value in condition.items():
            form[j, k] += value
            form[k, j] += value

    def near(root: NDArray[Any]) -> System:
        chart = root.conj().tolist()

        def system(p: Matrix) -> tuple[Matrix, Matrix]:
            kind = type(p)
            jacobian = kind([*linear, *((form * p * 2).entries() for form in forms), chart])
            values = (jacobian * p).entries()
            values[5:] = values[5] / 2, values[6] / 2, values[7] - 1
            return kind(8, 1, values), jacobian

        return system

    return near


def surely_different(a: Matrix, b: Matrix) -> bool:
    """Whether two columns of coefficients surely are no multiples of each other."""
    p, q = a.entries(), b.entries()
    return any(is_nonzero(p[j] * q[k] - p[k] * q[j]) for j, k in combinations(range(len(p)), 2))


def circle_of(root: Matrix) -> list[Ball]:
    """(c1, c2, m1, m2, r) of coefficients (8,) with p1 not zero."""
    p1, *rest = root.entries()
    p2, p3, p4, p5, p6, _, _ = (p / p1 for p in rest)
    s1, s2, t1, t2 = p3 / 2, p4 / 2, p5 / 2, p6 / 2
    return [-s1 - t2, t1 - s2, t2 - s1, -s2 - t1, 2 * (s1 * s1 + s2 * s2 - p2).sqrt()]
