# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""How far two shapes are apart, pair by pair; compiled.

A shape is the corners of a simple polygon in order, with its inside; two corners are a segment, one
is a point.  A side whose box is farther from the other shape's than the least distance so far is
passed over.
"""

import cython

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import INFINITY, fabs

TOUCHING = cython.declare(cython.double, 1e-15)  # of the greatest coordinate; nearer is rounding


@cython.cclass
class Nearest:
    """The squared distance of two shapes, and the points where they come so near."""

    square: cython.double
    points: cython.double[4]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def take(
        self,
        square: cython.double,
        x: cython.double,
        y: cython.double,
        other_x: cython.double,
        other_y: cython.double,
    ) -> cython.void:
        """Keep two points if they are nearer than those before."""
        if square < self.square:
            self.square = square
            self.points[0], self.points[1] = x, y
            self.points[2], self.points[3] = other_x, other_y

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def foot(
        self,
        x: cython.double,
        y: cython.double,
        start_x: cython.double,
        start_y: cython.double,
        along_x: cython.double,
        along_y: cython.double,
        is_second: cython.bint,
    ) -> cython.void:
        """Look at a point and its foot on a side; is_second: whether the second shape's point."""
        share: cython.double = along_x * along_x + along_y * along_y
        if share > 0:
            share = ((x - start_x) * along_x + (y - start_y) * along_y) / share
        share = min(max(share, 0.0), 1.0)
        foot_x: cython.double = start_x + share * along_x
        foot_y: cython.double = start_y + share * along_y
        d_x: cython.double = x - foot_x
        d_y: cython.double = y - foot_y
        if is_second:
            self.take(d_x * d_x + d_y * d_y, foot_x, foot_y, x, y)
        else:
            self.take(d_x * d_x + d_y * d_y, x, y, foot_x, foot_y)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(
        self,
        a: cython.const[cython.double][:, :],
        b: cython.const[cython.double][:, :],
        enough: cython.double,
    ) -> cython.void:
        """Set both for two shapes; once it is at most `enough` none nearer is looked for."""
        self.square = INFINITY
        low_x: cython.double = INFINITY
        low_y: cython.double = INFINITY
        high_x: cython.double = -INFINITY
        high_y: cython.double = -INFINITY
        size: cython.double = 0.0
        for j in range(b.shape[0]):
            low_x, high_x = min(low_x, b[j, 0]), max(high_x, b[j, 0])
            low_y, high_y = min(low_y, b[j, 1]), max(high_y, b[j, 1])
        for i in range(a.shape[0]):
            size = max(size, fabs(a[i, 0]), fabs(a[i, 1]))
        size = max(size, fabs(low_x), fabs(high_x), fabs(low_y), fabs(high_y))
        if holds(b, a[0, 0], a[0, 1]):
            self.take(0.0, a[0, 0], a[0, 1], a[0, 0], a[0, 1])
            return
        if holds(a, b[0, 0], b[0, 1]):
            self.take(0.0, b[0, 0], b[0, 1], b[0, 0], b[0, 1])
            return
        for i in range(sides_of(a)):
            i2: cython.Py_ssize_t = i + 1 if i + 1 < a.shape[0] else 0
            x, y, x2, y2 = a[i, 0], a[i, 1], a[i2, 0], a[i2, 1]
            if apart(x, y, x2, y2, low_x, low_y, high_x, high_y) >= self.square:
                continue
            for j in range(sides_of(b)):
                j2: cython.Py_ssize_t = j + 1 if j + 1 < b.shape[0] else 0
                u, v, u2, v2 = b[j, 0], b[j, 1], b[j2, 0], b[j2, 1]
                gap: cython.double = apart(
                    x, y, x2, y2, min(u, u2), min(v, v2), max(u, u2), max(v, v2)
                )
                if gap >= self.square:
                    continue
                if gap <= 0 and self.cross(x, y, x2, y2, u, v, u2, v2):
                    return
                self.foot(x, y, u, v, u2 - u, v2 - v, False)
                self.foot(x2, y2, u, v, u2 - u, v2 - v, False)
                self.foot(u, v, x, y, x2 - x, y2 - y, True)
                self.foot(u2, v2, x, y, x2 - x, y2 - y, True)
                if self.square <= enough * enough:
                    return
        if self.square <= TOUCHING * TOUCHING * size * size:
            self.square = 0.0

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def cross(
        self,
        x: cython.double,
        y: cython.double,
        x2: cython.double,
        y2: cython.double,
        u: cython.double,
        v: cython.double,
        u2: cython.double,
        v2: cython.double,
    ) -> cython.bint:
        """Whether two sides cross, each with ends on both sides of the other; and where."""
        d_x, d_y, e_x, e_y = x2 - x, y2 - y, u2 - u, v2 - v
        one: cython.double = d_x * (v - y) - d_y * (u - x)
        two: cython.double = d_x * (v2 - y) - d_y * (u2 - x)
        three: cython.double = e_x * (y - v) - e_y * (x - u)
        four: cython.double = e_x * (y2 - v) - e_y * (x2 - u)
        if not (((one < 0) != (two < 0)) and ((three < 0) != (four < 0))):
            return False
        if one == 0 or two == 0 or three == 0 or four == 0:
            return False  # an end lies on the other side, or on its line: a foot tells
        share: cython.double = three / (three - four)
        at_x: cython.double = x + share * d_x
        at_y: cython.double = y + share * d_y
        self.take(0.0, at_x, at_y, at_x, at_y)
        return True


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def sides_of(a: cython.const[cython.double][:, :]) -> cython.Py_ssize_t:
    """How many sides a shape has; a point counts as one."""
    return a.shape[0] if a.shape[0] > 2 else 1


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def apart(
    x: cython.double,
    y: cython.double,
    x2: cython.double,
    y2: cython.double,
    low_x: cython.double,
    low_y: cython.double,
    high_x: cython.double,
    high_y: cython.double,
) -> cython.double:
    """The squared distance of the box about a side from a box."""
    d_x: cython.double = max(low_x - max(x, x2), min(x, x2) - high_x, 0.0)
    d_y: cython.double = max(low_y - max(y, y2), min(y, y2) - high_y, 0.0)
    return d_x * d_x + d_y * d_y


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def holds(a: cython.const[cython.double][:, :], x: cython.double, y: cython.double) -> cython.bint:
    """Whether a point lies inside a polygon: a ray from it crosses an odd number of sides."""
    odd: cython.bint = False
    if a.shape[0] < 3:
        return False
    j: cython.Py_ssize_t = a.shape[0] - 1
    for i in range(a.shape[0]):
        if (a[i, 1] > y) != (a[j, 1] > y) and x < a[i, 0] + (y - a[i, 1]) / (a[j, 1] - a[i, 1]) * (
            a[j, 0] - a[i, 0]
        ):
            odd = not odd
        j = i
    return odd


def nearest(
    ones: cython.const[cython.double][:, :, :],
    others: cython.const[cython.double][:, :, :],
    enough: cython.double,
    square: cython.double[:],
    points: cython.double[:, :],
) -> None:
    """Set the squared distances (n,) of shapes (n, k, 2) from shapes (n or 1, m, 2).

    points: (n, 4), the point of the first and that of the second that are so near.
    A distance of at most `enough` may be told as any that is.
    """
    one: Nearest = Nearest()
    for n in range(ones.shape[0]):
        one.look(ones[n], others[n if others.shape[0] > 1 else 0], enough)
        square[n] = one.square
        for i in range(4):
            points[n, i] = one.points[i]
