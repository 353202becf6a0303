"""A second witness for critical points: path tracking, with no code of the package.

The point m of the body goes to m e^{i phi} + d, at the squared distance

    |m|² + |c|² + |d|² + m t d* + m* t* d - m t c* - m* t* c - d c* - d* c,   t = e^{i phi},

from c.  With c, c*, m, m* taken for four independent complex unknowns x, this less its mean over
the poses is linear in v = (1, c, c*, m, m*, c* m, c m*), and the sum of its squares is
F = vᵀ S v with a complex symmetric S.  A generic S has 25 critical points.  Those of one random S
are found by monodromy; they are then followed while S goes over into that of a task.

Not proved, but hard to deceive: paths must end at 25 different points, and the ends, as a set, must
be their own conjugates; where they do not, no answer is given (`LostError`).
"""

from contextlib import suppress
from functools import cache

import numpy as np

COUNT = 25
ORDER = [1, 0, 3, 2]  # what conjugation does to c, c*, m, m*


class LostError(ArithmeticError):
    """A path was lost, or two came together: nothing is claimed."""


def critical_points(rows):
    """All 25 (c, c*, m, m*) of poses (N, 3), complex, and which of them are real.

    rows: x, y, angle in radians.  Points in the frames and unit of the rows.
    """
    d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    # A handy place: where some point of the body strays least, in units of how far.
    (m, c), *_ = np.linalg.lstsq(np.column_stack([t, -np.ones_like(t)]), -d, rcond=None)
    near = d + t * m - c
    size = np.sqrt((abs(near) ** 2).mean())
    target = symmetric_matrix(near / size, t)
    for seed in range(4):
        ends = follow(start_points(), start_matrix(), target, gamma(seed), careful=1 + seed)
        conjugate = ends[:, ORDER].conj()
        gap = np.linalg.norm(ends[:, None] - ends, axis=2) + np.diag(np.full(len(ends), np.inf))
        width = 1 + np.linalg.norm(ends, axis=1)
        mirror = np.linalg.norm(conjugate[:, None] - ends, axis=2)
        partner = mirror.argmin(axis=1)
        if (
            np.isfinite(ends).all()
            and (gap.min(axis=1) > 1e-7 * width).all()
            and (mirror.min(axis=1) < np.minimum(1e-5 * width, gap.min(axis=1) / 3)).all()
            and (partner[partner] == np.arange(COUNT)).all()
        ):
            origin = np.array([c, c.conj(), m, m.conj()])
            return ends * size + origin, partner == np.arange(COUNT)
    raise LostError("a path was lost, or two ended at one point")


def symmetric_matrix(d, t):
    """S (7, 7) of poses d, t, of unit size."""
    rows = [abs(d) ** 2, -d.conj(), -d, t * d.conj(), t.conj() * d, -t, -t.conj()]
    a = np.column_stack(rows)
    a = a - a.mean(axis=0)
    return a.T @ a / np.linalg.norm(a) ** 2


def gamma(seed):
    """A number on the unit circle; for all but a few, all paths are smooth."""
    return np.exp(2j * np.pi * np.random.default_rng([17, seed]).random())


# --- F and its derivatives at x (k, 4) for matrices S (k, 7, 7)


def features(x):
    c, cc, m, mm = x.T
    return np.stack([np.ones_like(c), c, cc, m, mm, cc * m, c * mm], axis=1)


def slopes(x):
    c, cc, m, mm = x.T
    one, zero = np.ones_like(c), np.zeros_like(c)
    by = [
        [zero, one, zero, zero, zero, zero, mm],
        [zero, zero, one, zero, zero, m, zero],
        [zero, zero, zero, one, zero, cc, zero],
        [zero, zero, zero, zero, one, zero, c],
    ]
    return np.moveaxis(np.array(by), 2, 0)


def gradient(x, s):
    return (slopes(x) @ (s @ features(x)[:, :, None]))[:, :, 0]


def hessian(x, s):
    slope, pull = slopes(x), (s @ features(x)[:, :, None])[:, :, 0]
    h = slope @ s @ slope.transpose(0, 2, 1)
    h[:, 1, 2] += pull[:, 5]
    h[:, 2, 1] += pull[:, 5]
    h[:, 0, 3] += pull[:, 6]
    h[:, 3, 0] += pull[:, 6]
    return h


def solve(matrix, right):
    """The x (k, 4) of matrix x = right; nan where something is not finite, or singular."""
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(right).all(axis=1)
    x = np.full_like(right, np.nan)
    with suppress(np.linalg.LinAlgError):
        x[good] = np.linalg.solve(matrix[good], right[good, :, None])[:, :, 0]
    return x


# --- paths


def follow(x, first, last, turn, *, careful=1, limit=4000):
    """The ends (k, 4) of the paths that start at the critical points x of S = first.

    S(s) = (1 - s) turn first + s last.  Runge and Kutta predict, Newton corrects; each path has
    a step of its own, halved when three corrections do not do.  nan where a path was lost.
    """

    def matrix(s):
        return (1 - s)[:, None, None] * turn * first + s[:, None, None] * last

    def velocity(x, s):
        return -solve(hessian(x, matrix(s)), gradient(x, np.broadcast_to(motion, (len(x), 7, 7))))

    def corrected(x, s, rounds, tolerance):
        """Newton's x, and whether its steps shrank below the tolerance as they should."""
        at, sound, before = matrix(s), np.ones(len(x), dtype=bool), None
        for _ in range(rounds):
            step = solve(hessian(x, at), gradient(x, at))
            x = x - step
            now = np.linalg.norm(step, axis=1) / (1 + np.linalg.norm(x, axis=1))
            if before is not None:
                sound &= (now < 0.1 * before) | (now < tolerance)
            else:
                sound &= now < 1e-3 / careful
            before = now
        return x, sound & (now < tolerance)

    motion = last - turn * first
    x, s, step = x.copy(), np.zeros(len(x)), np.full(len(x), 0.02 / careful)
    good_ones, alive = np.zeros(len(x), dtype=int), np.ones(len(x), dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(limit):
            run = np.flatnonzero(alive & (s < 1))
            if not len(run):
                break
            h = np.minimum(step[run], 1 - s[run])
            y, at, half = x[run], s[run], h[:, None] / 2
            k1 = velocity(y, at)
            k2 = velocity(y + half * k1, at + h / 2)
            k3 = velocity(y + half * k2, at + h / 2)
            k4 = velocity(y + 2 * half * k3, at + h)
            guess = y + half / 3 * (k1 + 2 * k2 + 2 * k3 + k4)
            to = np.where(h >= 1 - at, 1.0, at + h)
            new, sound = corrected(guess, to, 3, 1e-9)
            x[run[sound]], s[run[sound]] = new[sound], to[sound]
            good_ones[run] = np.where(sound, good_ones[run] + 1, 0)
            longer = good_ones[run] >= 3
            step[run] = np.where(sound, np.where(longer, 2 * step[run], step[run]), step[run] / 2)
            good_ones[run[longer]] = 0
            alive[run] = step[run] > 1e-13
        x, sound = corrected(x, s, 4, 1e-7)
    x[~(alive & (s == 1) & np.isfinite(x).all(axis=1))] = np.nan
    return x


# --- one random S and its 25 points


@cache
def _start():
    """A random S and its critical points, by monodromy: loops of S permute them all."""
    rng = np.random.default_rng(2)

    def random_matrix():
        a = rng.normal(size=(7, 7)) + 1j * rng.normal(size=(7, 7))
        return a + a.T

    # A random point, and a random S that is made critical there.
    x = rng.normal(size=(1, 4)) + 1j * rng.normal(size=(1, 4))
    pairs = [(i, j) for i in range(7) for j in range(i, 7)]
    basis = np.zeros((len(pairs), 7, 7), dtype=complex)
    for k, (i, j) in enumerate(pairs):
        basis[k, i, j] = basis[k, j, i] = 1
    s = random_matrix()
    rows = np.array([gradient(x, b[None])[0] for b in basis]).T
    s = s - np.tensordot(np.linalg.pinv(rows) @ gradient(x, s[None])[0], basis, axes=1)
    quiet = 0
    while quiet < 5:  # rounds of loops that bring nothing new
        other = random_matrix()
        away = follow(x, s, other, np.exp(2j * np.pi * rng.random()))
        back = follow(
            away[np.isfinite(away).all(axis=1)], other, s, np.exp(2j * np.pi * rng.random())
        )
        known = len(x)
        for y in back[np.isfinite(back).all(axis=1)]:
            if np.linalg.norm(x - y, axis=1).min() > 1e-6 * (1 + np.linalg.norm(y)):
                x = np.vstack([x, y])
        quiet = quiet + 1 if len(x) == known else 0
    if len(x) != COUNT:
        raise LostError(f"{len(x)} critical points of a random matrix, not {COUNT}")
    return s, x


def start_matrix():
    return _start()[0]


def start_points():
    return _start()[1]
