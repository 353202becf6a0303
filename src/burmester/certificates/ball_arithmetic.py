"""Ball arithmetic for certificates: poses with bounds on every rounding, proofs of a zero.

A ball is a number with a bound on its error (python-flint's arb, complex acb); a comparison of
balls that comes out true is a theorem.  python-flint is optional and loaded when first needed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from math import inf, isnan, nextafter
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, weights_or_ones

Ball: TypeAlias = Any  # arb or acb
Matrix: TypeAlias = Any  # arb_mat or acb_mat
System: TypeAlias = Callable[[Matrix], tuple[Matrix, Matrix]]  # values and Jacobian at a column

MAX_NEWTON_STEPS = 8  # to the middle of a box; from a good start three or four are enough


@cache
def flint() -> Any:
    """The python-flint module; raises InputError E130 where it is missing."""
    try:
        return import_module("flint")
    except ImportError as error:
        raise InputError(
            "E130",
            "certificates need python-flint",
            why="proofs are done in ball arithmetic, which NumPy does not have",
            help='pip install "burmester[certify]"',
        ) from error


class BallPoses(NamedTuple):
    """Poses in canonical frames, with their weights, all as balls.

    The doubles of poses, weights and frames count as exact numbers.
    """

    places: list[tuple[Ball, Ball, Ball, Ball]]  # d1, d2, cos, sin
    angles: list[float]
    weights: list[Ball]
    fixed_origin: tuple[Ball, ...]
    moving_origin: tuple[Ball, ...]
    length: Ball

    @classmethod
    def of(
        cls, poses: Displacement, weights: FloatArray | None, frames: CanonicalFrames
    ) -> BallPoses:
        """Poses (N,) and weights (N,) or None, in the canonical frames of one task."""
        arb = flint().arb
        fixed = tuple(arb(float(v)) for v in frames.fixed_origin)
        moving = tuple(arb(float(v)) for v in frames.moving_origin)
        length = arb(float(frames.length))
        angles = [float(angle) for angle in poses.angle]
        places = []
        for (x, y), angle in zip(poses.translation, angles, strict=True):
            sin, cos = arb(angle).sin_cos()
            d1 = (arb(float(x)) + cos * moving[0] - sin * moving[1] - fixed[0]) / length
            d2 = (arb(float(y)) + sin * moving[0] + cos * moving[1] - fixed[1]) / length
            places.append((d1, d2, cos, sin))
        share = [arb(float(w)) for w in weights_or_ones(weights, (len(angles),))]
        return cls(places, angles, share, fixed, moving, length)

    def inverse(self) -> BallPoses:
        """The inverse motion: F and M exchanged."""
        places = [
            (-cos * d1 - sin * d2, sin * d1 - cos * d2, cos, -sin)
            for d1, d2, cos, sin in self.places
        ]
        return BallPoses(
            places,
            [-angle for angle in self.angles],
            self.weights,
            self.moving_origin,
            self.fixed_origin,
            self.length,
        )

    def weighted(self, rows: Matrix) -> Matrix:
        """Rows (N, k), each times its pose's weight."""
        pairs = zip(self.weights, rows.tolist(), strict=True)
        return flint().arb_mat([[w * x for x in row] for w, row in pairs])


def zero_near(system: System, start: Matrix) -> Matrix | None:
    """A box near `start` that holds exactly one zero, a simple one; None if that is not proved.

    start: a column of real or of complex balls; it decides which zeros count.  Newton's
    method goes to the middle of the box; the proof is Krawczyk's test, that a box is mapped into
    its own interior (Rump, Acta Numerica 19, 2010, section 13).

    Formula `krawczyk` of the theory.
    """
    lib = flint()
    kind, n = type(start), start.nrows()
    real = kind is lib.arb_mat
    small = lib.arb(2) ** (-lib.ctx.prec // 2)
    x = start.mid()
    try:
        for _ in range(MAX_NEWTON_STEPS):
            values, jacobian = system(x)
            step = jacobian.mid().solve(values.mid()).mid()
            x = (x - step).mid()
            size = 1 + sum(abs(e) for e in x.entries())
            if all(abs(e) < small * size / 1024 for e in step.entries()):
                break
        radius = (small * size).mid()
        side = lib.arb(0, radius)
        around = kind(n, 1, [side if real else lib.acb(side, side)] * n)
        values, jacobian = system(x)
        inverse = jacobian.mid().inv().mid()
        _, jacobians = system(x + around)
    except ZeroDivisionError:  # a matrix that is singular as far as these bits can tell
        return None
    identity = kind(n, n, [int(j == k) for j in range(n) for k in range(n)])
    moved = ((identity - inverse * jacobians) * around - inverse * values).entries()
    parts = moved if real else [part for e in moved for part in (e.real, e.imag)]
    return x + around if all(abs(part) < radius for part in parts) else None


def positive_definite(matrix: Matrix) -> bool:
    """Whether a real symmetric matrix is surely positive definite: all pivots of elimination."""
    rows = matrix.tolist()
    while rows:
        (pivot, *first), *below = rows
        if not pivot > 0:
            return False
        rows = [
            [x - row[0] * y / pivot for x, y in zip(row[1:], first, strict=True)] for row in below
        ]
    return True


def has_descent(matrix: Matrix) -> bool:
    """Whether a real symmetric matrix surely has a negative direction."""
    middle = np.array([[float(x) for x in row] for row in matrix.tolist()])
    if not np.isfinite(middle).all():
        return False
    down = column(np.linalg.eigh(middle)[1][:, 0], real=True)
    return bool((down.transpose() * matrix * down)[0, 0] < 0)


def is_nonzero(ball: Ball) -> bool:
    """Whether a ball surely is not zero."""
    return bool(abs(ball) > 0)


def upper_bound(ball: Ball) -> float:
    """A double that surely is not below the absolute value of a ball."""
    value = float(abs(ball).upper())
    return inf if isnan(value) else nextafter(value, inf)


def column(values: Sequence[Any] | FloatArray, *, real: bool) -> Matrix:
    """A column of exact doubles, of real or of complex balls."""
    if real:
        return flint().arb_mat([[float(v)] for v in values])
    return flint().acb_mat([[complex(v)] for v in values])
