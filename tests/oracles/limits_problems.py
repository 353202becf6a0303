"""Random tasks with limits, and the best dyads within them by many starts of SciPy's SLSQP."""

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.optimize import minimize

from burmester.dyads.minima_within_limits import limited_dyads
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.tasks.limits import Limits
from tests.oracles.witness import random_four_bar, random_poses, span

LONG = 100.0  # spans: beyond this a link is a slider in disguise
CORNER = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], float)  # an L
ANYWHERE = [(np.zeros(2), np.eye(2), np.full(2, -np.inf), np.full(2, np.inf))]


@dataclass
class Problem:
    """A task for both: regions as the package takes them, and as pieces origin + basis u.

    rows: poses x, y, angle; fixed, moving: pieces (origin, basis, low, high), low <= u <= high.
    """

    rows: np.ndarray
    weights: np.ndarray | None
    exact: np.ndarray
    limits: Limits
    fixed: list
    moving: list

    @property
    def poses(self):
        return Displacement.from_poses(self.rows)

    @property
    def share(self):
        share = np.ones(len(self.rows)) if self.weights is None else self.weights
        return share / share.sum()


def circle_distance(z, rows):
    """Of z = c, m, r: |R m + d - c| - r (N,) and its derivatives (N, 5)."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    x = cos * z[2] - sin * z[3] + rows[:, 0] - z[0]
    y = sin * z[2] + cos * z[3] + rows[:, 1] - z[1]
    far = np.maximum(np.hypot(x, y), 1e-200)
    x, y = x / far, y / far
    slope = np.stack([-x, -y, x * cos + y * sin, y * cos - x * sin, -np.ones_like(x)], axis=-1)
    return far - z[4], slope


def circle_squared(z, rows):
    """The same for |R m + d - c|² - r²."""
    miss, slope = circle_distance(z, rows)
    more = miss + 2 * z[4]
    total = slope * (miss + z[4])[:, None] * 2
    total[:, 4] = -2 * z[4]
    return miss * more, total


def line_distance(z, rows):
    """Of z = (normal angle, offset, m): n . (R m + d) - h and its derivatives (N, 4)."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    n1, n2 = np.cos(z[0]), np.sin(z[0])
    x = cos * z[2] - sin * z[3] + rows[:, 0]
    y = sin * z[2] + cos * z[3] + rows[:, 1]
    slope = [n1 * y - n2 * x, -np.ones_like(x), n1 * cos + n2 * sin, n2 * cos - n1 * sin]
    return n1 * x + n2 * y - z[1], np.stack(slope, axis=-1)


def inverse(rows):
    """The inverse motion: rows x, y, angle of M's fixed plane."""
    d = -(rows[:, 0] + 1j * rows[:, 1]) * np.exp(-1j * rows[:, 2])
    return np.column_stack([d.real, d.imag, -rows[:, 2]])


def local(distance, problem, rows, start, piece):
    """SLSQP from one start y; z = zero + basis y within bounds.  Its cost and z, or None."""
    (zero, basis), bounds = piece
    held, share = problem.exact, np.where(problem.exact, 0.0, problem.share)

    def cost(y):
        miss, slope = distance(zero + basis @ y, rows)
        return share @ miss**2, 2 * (share * miss) @ slope @ basis

    conditions = []
    if held.any():
        conditions = [
            {
                "type": "eq",
                "fun": lambda y: distance(zero + basis @ y, rows)[0][held],
                "jac": lambda y: distance(zero + basis @ y, rows)[1][held] @ basis,
            }
        ]
    with np.errstate(all="ignore"):
        fit = minimize(
            cost,
            start,
            jac=True,
            bounds=bounds,
            constraints=conditions,
            method="SLSQP",
            options={"maxiter": 300, "ftol": 1e-15},
        )
    z = zero + basis @ np.clip(fit.x, *np.array(bounds).T)
    if not np.isfinite(z).all() or np.abs(distance(z, rows)[0][held]).max(initial=0) > 1e-9:
        return None
    return float(share @ distance(z, rows)[0] ** 2), z


def maps(problem, kind):
    """Every piece of a kind's space: (zero, basis), bounds of y."""
    endless = (-np.inf, np.inf)
    if kind is RR:
        for (c, a, lo, hi), (m, b, low, high) in product(problem.fixed, problem.moving):
            basis = np.zeros((5, a.shape[1] + b.shape[1] + 1))
            basis[:2, : a.shape[1]], basis[2:4, a.shape[1] : -1], basis[4, -1] = a, b, 1.0
            bounds = [*zip(lo, hi, strict=True), *zip(low, high, strict=True)]
            yield (np.array([*c, *m, 0.0]), basis), [*bounds, problem.limits.length]
    else:
        for m, b, low, high in problem.moving if kind is PR else problem.fixed:
            basis = np.zeros((4, 2 + b.shape[1]))
            basis[:2, :2], basis[2:, 2:] = np.eye(2), b
            bounds = [endless, endless, *zip(low, high, strict=True)]
            yield (np.array([0.0, 0.0, *m]), basis), bounds


def by_force(problem, kind, rng, starts):
    """The least cost that SciPy finds from random starts in every piece, its z, and its piece."""
    rows = inverse(problem.rows) if kind is RP else problem.rows
    distance = circle_distance if kind is RR else line_distance
    size, best = span(problem.rows), (np.inf, None, None)
    for map_, bounds in maps(problem, kind):
        for _ in range(starts):
            y = rng.normal(scale=1.5 * size, size=len(bounds))
            if kind is not RR:
                y[0] = rng.uniform(-np.pi, np.pi)
            low, high = np.array(bounds).T
            ends = np.isfinite(low) & np.isfinite(high)
            y[ends] = rng.uniform(low[ends], high[ends])
            if kind is RR:
                z = map_[0] + map_[1] @ y
                y[-1] = (distance(z, rows)[0] + z[4]).mean()
            else:
                y[1] += distance(map_[0] + map_[1] @ y, rows)[0].mean()
            fit = local(distance, problem, rows, np.clip(y, low, high), (map_, bounds))
            if fit is not None and fit[0] < best[0]:
                best = (*fit, (map_, bounds))
    return best


def random_region(rng, what, size):
    """A region of some sort, and its pieces."""
    at, turn = rng.normal(scale=0.7 * size, size=2), rng.uniform(-np.pi, np.pi)
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    wide = size * rng.uniform(0.2, 1.5, 2)
    if what == "none":
        return None, ANYWHERE
    if what == "point":
        return Point(at), [(at, np.empty((2, 0)), np.empty(0), np.empty(0))]
    if what == "line":
        along = turned[:, :1]
        pieces = [(at, along, np.array([-np.inf]), np.array([np.inf]))]
        return Line(at, at + 3 * size * along[:, 0]), pieces
    if what == "segment":
        along = wide[0] * turned[:, :1]
        return Segment(at, at + along[:, 0]), [(at, along, np.zeros(1), np.ones(1))]
    if what == "box":
        return box(at, at + wide), [(at, np.eye(2), np.zeros(2), wide)]
    assert what == "concave"
    turned = turned * wide
    pieces = [(at, turned, np.zeros(2), np.array(high)) for high in ([2.0, 1.0], [1.0, 2.0])]
    return Polygon(at + CORNER @ turned.T), pieces


SORTS = ["none", "point", "line", "segment", "box", "concave"]


PAIRS = [pair for pair in product(SORTS, SORTS) if pair != ("none", "none")]


def random_rows(rng, count, noises):
    """Noisy poses of a random four-bar, and their span without the noise."""
    rows = random_poses(random_four_bar(rng), rng, count)
    noise, size = rng.choice(noises), span(rows)
    return rows + noise * rng.normal(size=rows.shape) * [size, size, 1.0], size


def random_problem_of(rng, sorts):
    """A task of 5 to 12 poses, rough ones too, with limits of two sorts; half of them weighted."""
    count = int(rng.integers(5, 13))
    rows, size = random_rows(rng, count, [0.001, 0.01, 0.05, 0.15])
    (fixed, in_f), (moving, in_m) = (random_region(rng, sort, size) for sort in sorts)
    weights = 10 ** rng.uniform(-1, 1, count) if rng.random() < 0.5 else None
    return Problem(rows, weights, np.zeros(count, bool), Limits(fixed, moving), in_f, in_m)


def random_problem(rng, sorts=SORTS):
    """A task of 6 to 13 noisy poses with limits of all sorts, and up to as many exact poses."""
    count = int(rng.integers(6, 14))
    rows, size = random_rows(rng, count, [0.001, 0.01, 0.05])
    a, b = rng.choice(sorts), rng.choice(["none", "none", *sorts])
    if rng.random() < 0.5:
        a, b = b, a
    fixed, in_f = random_region(rng, a, size)
    moving, in_m = random_region(rng, b, size)
    length = (0.0, np.inf)
    if rng.random() < 0.4:
        least = size * rng.uniform(0.1, 1)
        length = [(least, np.inf), (0.0, least), (least, least + size * rng.uniform(0.1, 1))][
            rng.integers(3)
        ]
    limits = Limits(fixed, moving, length)
    exact = np.zeros(count, dtype=bool)
    most = 5 - limits.conditions
    exact[rng.permutation(count)[: rng.choice([0, 0, *range(1, most + 1)])]] = True
    weights = 10 ** rng.uniform(-2, 2, count) if rng.random() < 0.4 else None
    return Problem(rows, weights, exact, limits, in_f, in_m)


def outside(point, pieces):
    """How far a point lies outside all of its pieces."""
    gaps = []
    for origin, basis, low, high in pieces:
        u = np.linalg.lstsq(basis, point - origin, rcond=None)[0] if basis.size else np.empty(0)
        gaps.append(np.abs(origin + basis @ np.clip(u, low, high) - point).max())
    return min(gaps)


def ours(problem, found, kind):
    """The dyads of a kind as z (k, ...), in the task's own frames."""
    if kind is RR:
        d = found.frames.circle_from_canonical(found.circles)
        return np.column_stack([d.fixed_pivot, d.moving_pivot, d.radius])
    lines = [
        found.frames.line_from_canonical(line) for line in found.sliders if isinstance(line, kind)
    ]
    pivots = [line.moving_pivot if kind is PR else line.fixed_pivot for line in lines]
    return np.array(
        [
            [line.normal_angle, line.offset, *pivot]
            for line, pivot in zip(lines, pivots, strict=True)
        ]
    ).reshape(-1, 4)


def breaches(problem, found, kind):
    """By how much the dyads found break the limits, or miss the exact poses, in spans."""
    rows = inverse(problem.rows) if kind is RP else problem.rows
    distance = circle_distance if kind is RR else line_distance
    size, worst = span(problem.rows), 0.0
    for z in ours(problem, found, kind):
        scale = max(size, np.abs(z).max())  # a far pivot has as many digits as any number
        gaps = [np.abs(distance(z, rows)[0][problem.exact]).max(initial=0)]
        if kind is not PR:
            gaps.append(outside(z[:2] if kind is RR else z[2:], problem.fixed))
        if kind is not RP:
            gaps.append(outside(z[2:4], problem.moving))
        if kind is RR:
            least, most = problem.limits.length
            gaps.append(max(least - z[4], z[4] - most, 0.0))
        worst = max(worst, max(gaps) / scale)
    return worst


def verdict(problem, found, kind, rng, starts):
    """One of "ours", "same", or where SciPy is better why: "long", "no counterpart" or "bug".

    "no counterpart": a minimum of the true distance at which the squared one leads away.
    """
    rows = inverse(problem.rows) if kind is RP else problem.rows
    distance = circle_distance if kind is RR else line_distance
    share = np.where(problem.exact, 0.0, problem.share)
    costs = [share @ distance(z, rows)[0] ** 2 for z in ours(problem, found, kind)]
    best = min(costs, default=np.inf)
    least, z, piece = by_force(problem, kind, rng, starts)
    rounding = (1e-9 * span(problem.rows)) ** 2
    if best <= least * (1 + 1e-6) + rounding:
        return ("same" if least <= best * (1 + 1e-6) + rounding else "ours"), best, least, z
    if kind is RR and z[4] > LONG * span(problem.rows):
        return "long", best, least, z
    if kind is RR:
        zero, basis = piece[0]
        start = np.linalg.lstsq(basis, z - zero, rcond=None)[0]
        there = local(circle_squared, problem, rows, start, piece)
        if there is not None:
            start = np.linalg.lstsq(basis, there[1] - zero, rcond=None)[0]
            back = local(distance, problem, rows, start, piece)
            if back is None or back[0] > least * (1 + 1e-5) + rounding:
                return "no counterpart", best, least, z
    return "bug", best, least, z


def kinds_of(problem):
    return [kind for kind in (RR, PR, RP) if kind.__name__ in problem.limits.allowed]


def solved(problem, norm="rms"):
    return limited_dyads(problem.poses, problem.weights, problem.exact, problem.limits, norm)
