"""Dyads of five poses as intersections of two conics, solved in fifty digits."""

import mpmath
import numpy as np


def as_rows(dyads):
    """Real dyads as rows Xc, Yc, x, y, r."""
    rows = np.column_stack([dyads.fixed_pivot, dyads.moving_pivot, dyads.radius])
    return rows[np.isfinite(rows).all(axis=1)]


def circle_equations(v, rows):
    """The five circle equations written out, for other people's solvers."""
    xc, yc, x, y, r2 = v
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    big_x, big_y = cos * x - sin * y + rows[:, 0], sin * x + cos * y + rows[:, 1]
    return (big_x - xc) ** 2 + (big_y - yc) ** 2 - r2


def in_fifty_digits(start, rows):
    """The exact dyad of these very poses nearest to `start`, by Newton in 50 digits."""
    with mpmath.workdps(50):
        poses = [tuple(mpmath.mpf(float(v)) for v in row) for row in rows]

        def equations(xc, yc, x, y, r2):
            return [
                (mpmath.cos(a) * x - mpmath.sin(a) * y + d1 - xc) ** 2
                + (mpmath.sin(a) * x + mpmath.cos(a) * y + d2 - yc) ** 2
                - r2
                for d1, d2, a in poses
            ]

        begin = [mpmath.mpf(float(v)) for v in (*start[:4], start[4] ** 2)]
        root = mpmath.findroot(equations, begin, tol=1e-35, maxsteps=50)
        return np.array([*(float(v) for v in root[:4]), float(mpmath.sqrt(root[4]))])
