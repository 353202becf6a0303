"""Closed outlines of sides and arcs: hulls with round corners, and their moments.

Rows (x, y, bulge) as in DXF: the bulge, the tangent of a quarter of the arc's angle, says how the
way to the next point bends (0 straight, 1 half a circle to the left).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.geometry.regions import outside_corners
from burmester.numerics.arrays import FloatArray

NODES: Final = 24  # of Gauss's rule on a side: arcs up to half a circle exact but for rounding


SHARP: Final = -0.9  # cosine of the turn at a corner that is cut off square
GRID_SIDE = 40  # points along a side of the grid; the point is the best of these, not the very best
AS_DEEP = (
    0.95  # of the greatest depth: of points as deep as that the one nearest to the middle is taken
)


def convex_hull(points: FloatArray) -> FloatArray:
    """The corners (n, 2) of the convex hull of points (m, 2), counter-clockwise."""
    size = float(np.ptp(points, axis=0).max())
    rows: list[FloatArray] = []
    for point in points[np.lexsort((points[:, 1], points[:, 0]))]:
        if not any(np.linalg.norm(point - each) <= 1e-12 * size for each in rows):
            rows.append(point)
    if len(rows) < 3:
        return np.array(rows)

    def half(run: list[FloatArray]) -> list[FloatArray]:
        chain: list[FloatArray] = []
        for point in run:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-1] - chain[-2], point - chain[-1]
                if ax * by - ay * bx > 1e-12 * size * size:
                    break
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return np.array(half(rows) + half(rows[::-1]))


def grown_hull(points: FloatArray, by: float) -> FloatArray:
    """The corners (n, 2) of a polygon that holds all within a length of points' convex hull.

    Its sides are that far away; sharp corners are cut off square.
    """
    corners = convex_hull(points)
    if len(corners) == 1:
        return corners + by * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    edge = np.roll(corners, -1, axis=0) - corners
    along = edge / np.linalg.norm(edge, axis=1, keepdims=True)
    normal = np.stack([along[:, 1], -along[:, 0]], axis=1)
    rows: list[FloatArray] = []
    for at, one, two, into, out in zip(
        corners, np.roll(normal, 1, axis=0), normal, np.roll(along, 1, axis=0), along, strict=True
    ):
        cosine = float(one @ two)
        if cosine < SHARP:
            rows += [at + by * (one + into), at + by * (two - out)]
        else:
            rows.append(at + by * (one + two) / (1 + cosine))
    return np.array(rows)


def rounded_hull(corners: FloatArray, radius: float) -> FloatArray:
    """The outline (k, 3), with bulges, of all that is within a radius of a convex polygon."""
    if len(corners) == 1:
        (x, y), r = corners[0], radius
        return np.array([[x + r, y, 1.0], [x - r, y, 1.0]])
    edge = np.roll(corners, -1, axis=0) - corners
    unit = edge / np.linalg.norm(edge, axis=1, keepdims=True)
    normal = np.stack([unit[:, 1], -unit[:, 0]], axis=1)
    before = np.roll(normal, 1, axis=0)
    cross = before[:, 0] * normal[:, 1] - before[:, 1] * normal[:, 0]
    turn = np.arctan2(np.abs(cross), (before * normal).sum(axis=1))
    into = np.column_stack([corners + radius * before, np.tan(turn / 4)])
    out = np.column_stack([corners + radius * normal, np.zeros(len(corners))])
    return np.stack([into, out], axis=1).reshape(-1, 3)


def outline_moments(outline: FloatArray, origin: FloatArray) -> FloatArray:
    """The integrals (6,) of 1, x, y, xx, xy and yy within an outline (k, 3) with bulges.

    x and y are from the origin (2,); counter-clockwise outlines have a positive area.  They are
    computed along the outline (Green's theorem), exact but for rounding.
    """
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    share = (nodes + 1) / 2
    start = outline[:, :2] - origin
    chord = np.roll(start, -1, axis=0) - start
    half = 2 * np.arctan(outline[:, 2])  # of the arc's angle
    # A point of an arc: start + chord * ratio(share), as complex numbers; the ratio is the share
    # where the side is straight.
    with np.errstate(invalid="ignore", divide="ignore"):
        angle = 2 * half[:, None] * share
        ratio = np.expm1(1j * angle) / np.expm1(2j * half[:, None])
        rate = 2j * half[:, None] * np.exp(1j * angle) / np.expm1(2j * half[:, None])
    straight = outline[:, 2:] == 0
    ratio, rate = np.where(straight, share, ratio), np.where(straight, 1.0, rate)
    along = (chord @ [1, 1j])[:, None]
    z, dz = (start @ [1, 1j])[:, None] + along * ratio, along * rate
    x, y, dx, dy = z.real, z.imag, dz.real, dz.imag
    sides = [
        (x * dy - y * dx) / 2,
        x**2 * dy / 2,
        -(y**2) * dx / 2,
        x**3 * dy / 3,
        x**2 * y * dy / 2,
        -(y**3) * dx / 3,
    ]
    return np.asarray(np.array([each.sum(axis=0) for each in sides]) @ weights / 2)


def inner_point(vertices: FloatArray) -> FloatArray:
    """The point (2,) of a grid over a polygon (n, 2) that is about the farthest from its edges.

    The vertices stand in order around it, in either sense.  Of points about as far the one nearest
    to the middle of the vertices' box is taken.  The point lies inside the polygon, unless that is
    thinner than the grid is fine: then it is the middle of an edge.
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    share = (np.arange(GRID_SIDE) + 0.5) / GRID_SIDE
    x, y = (low + share[:, None] * (high - low)).T
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    depth = -outside_corners(points, vertices)
    if not (depth > 0).any():
        return np.asarray((vertices[0] + vertices[1]) / 2)
    off = np.linalg.norm(points - (low + high) / 2, axis=-1)
    deep = depth >= AS_DEEP * depth.max()
    return np.asarray(points[int(np.where(deep, off, np.inf).argmin())])
