"""The best four-bar of two, three or four poses by brute force: no code of the package.

Best is the greatest least transmission angle over the range that the poses use, by the better of
the two drivers.  Random pivots in their boxes are moved onto the poses' equations by Newton's
method, along the edges of the boxes where it leads out.  All pairs of such dyads are driven through
the poses in many small steps.  From the best of them, far apart, SciPy's SLSQP goes on: it lowers
the greatest |cos| of the transmission angle, with the poses met, the pivots in their boxes, and the
four links within their bounds.  What it ends at is driven again, in small steps.

Complex numbers are points; a linkage is (c1, m1, c2, m2): fixed pivots in F, moving ones in M.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import minimize

FULL = 2 * np.pi
LOCKED = 1.0 - 5e-7  # |cos| of the transmission angle at which a driver locks (0.06 degrees)
DRAWN = 6000  # random dyads of each pair of boxes, up to four times
KEPT = 420  # dyads of which all pairs are driven
COARSE, FINE = 40, 1500  # steps of a drive: of all pairs, and of what is told
WITHIN = 9  # places from pose to pose at which SLSQP holds the transmission angle
LEAST_STEP = 1e-3  # radians that the driver turns from pose to pose
APART = 0.05  # motion spans: starts nearer to each other are one
MET = 1e-9  # motion spans by which a pose may be missed


@dataclass(frozen=True)
class Bounds:
    """Of the four links: longest over shortest; shortest and longest, in spans of the motion."""

    ratio: float = 5.0
    shortest: float = 0.05
    longest: float = 10.0


@dataclass(frozen=True)
class Best:
    """angle: the least transmission angle over the range, degrees; pivots: c1, m1, c2, m2."""

    angle: float
    pivots: np.ndarray


def span_of(rows):
    """The diagonal of the box that holds the poses' origins."""
    return float(np.hypot(*np.ptp(np.asarray(rows)[:, :2], axis=0)))


class FewPoses:
    """The search for one task.

    rows: (N, 3), x, y, angle (radians).
    boxes: for both dyads, or one for each: the corners (2, 2) of the boxes of its fixed and of its
        moving pivot.
    draws: the random dyads of each round.
    """

    def __init__(self, rows, boxes, bounds=None, draws=DRAWN):
        rows = np.asarray(rows, dtype=float)
        self.unit, self.middle = span_of(rows), complex(*rows[:, :2].mean(axis=0))
        self.at = (rows[:, :2] @ [1, 1j] - self.middle) / self.unit
        self.angle, self.turn = rows[:, 2], np.exp(1j * rows[:, 2])
        self.boxes = [
            (
                (np.asarray(fixed, float) @ [1, 1j] - self.middle) / self.unit,
                np.asarray(moving, float) @ [1, 1j] / self.unit,
            )
            for fixed, moving in (tuple(boxes) * 2)[:2]
        ]
        self.same_boxes = len(boxes) == 1
        self.bounds = Bounds() if bounds is None else bounds
        self.draws = draws

    # dyads ----------------------------------------------------------------------------------

    def misses(self, c, m):
        """How far the pin (k,) is farther from the fixed pivot than at the first pose, (k, N-1)."""
        square = abs(self.pins(m) - c[:, None]) ** 2
        return square[:, 1:] - square[:, :1]

    def pins(self, m):
        """Moving pivots (k,) at the poses, (k, N)."""
        return self.at + self.turn * m[:, None]

    def onto_the_poses(self, c, m, steps=12, box=None):
        """Newton's shortest steps from pivots (k,), (k,) onto the poses' equations, within a box.

        A coordinate at the edge of the box stays there where the step leads out.
        """
        x = np.stack([c.real, c.imag, m.real, m.imag], axis=1)
        low, high = (
            np.array([part for corners in box for part in parts(corners[end])])
            if box is not None
            else np.full(4, side)
            for end, side in ((0, -np.inf), (1, np.inf))
        )
        for _ in range(steps):
            c, m = x[:, 0] + 1j * x[:, 1], x[:, 2] + 1j * x[:, 3]
            pins = self.pins(m)
            by_c = -2 * (pins[:, 1:] - pins[:, :1])
            arm = self.turn.conj() * (pins - c[:, None])
            by_m = 2 * (arm[:, 1:] - arm[:, :1])
            jacobian = np.stack([by_c.real, by_c.imag, by_m.real, by_m.imag], axis=-1)
            step = _shortest(jacobian, self.misses(c, m))
            for _ in range(2 if box is not None else 0):
                out = ((x <= low) & (step < 0)) | ((x >= high) & (step > 0))
                if not out.any():
                    break
                step = _shortest(jacobian * ~out[:, None], self.misses(c, m))
            size = np.linalg.norm(step, axis=1, keepdims=True)
            x = np.clip(x + step * np.minimum(1.0, 0.7 / np.maximum(size, 1e-300)), low, high)
        return x[:, 0] + 1j * x[:, 1], x[:, 2] + 1j * x[:, 3]

    def dyads(self, rng, box):
        """Dyads c (k,), m (k,) that meet the poses within a pair of boxes, at most KEPT."""
        found = [np.empty((0, 2), complex)]
        for _ in range(4):
            c, m = (drawn(rng, corners, self.draws) for corners in box)
            c, m = self.onto_the_poses(c, m, 30, box)
            good = (abs(self.misses(c, m)) < MET).all(axis=1)
            length = abs(self.pins(m)[:, 0] - c)
            good &= (length > self.bounds.shortest) & (length < self.bounds.longest)
            found.append(np.stack([c, m], axis=1)[good])
            if sum(map(len, found)) >= 3 * KEPT:
                break
        every = np.concatenate(found)
        return rng.permutation(every)[:KEPT]

    # driving --------------------------------------------------------------------------------

    def links(self, z):
        """Of linkages z (k, 4): both links, the coupler, the ground; (k, 4)."""
        c1, m1, c2, m2 = z.T
        first = self.turn[0] * z[:, [1, 3]] + self.at[0] - z[:, [0, 2]]
        return np.column_stack([abs(first), abs(m2 - m1), abs(c2 - c1)])

    def within_bounds(self, z, slack=1.0):
        """Which linkages z (k, 4) have sane links."""
        links = self.links(z)
        least, most = links.min(axis=1), links.max(axis=1)
        return (
            (most <= self.bounds.ratio * slack * least + 1e-9)
            & (least * slack >= self.bounds.shortest - 1e-9)
            & (most <= self.bounds.longest * slack + 1e-9)
        )

    def driven(self, z, steps):
        """Linkages z (k, 4) driven by their first dyads, either way round, (2, k) each.

        The greatest |cos| of the transmission angle on the way through the poses in their order
        (infinite where that needs more than a turn, or the other branch), and the way, radians.
        """
        pins = [self.pins(z[:, 1]), self.pins(z[:, 3])]
        crank = np.angle(pins[0] - z[:, :1])
        coupler, follower = pins[1] - pins[0], pins[1] - z[:, 2:3]
        side = np.sign((coupler.conj() * follower).imag)
        one_branch = abs(side.sum(axis=1)) == len(self.at)
        worst, ways = [], []
        for sense in (1, -1):
            step = np.mod(sense * np.diff(crank, axis=1), FULL)
            way = step.sum(axis=1)
            sweep = crank[:, :1] + sense * way[:, None] * np.linspace(0, 1, steps)
            cosine = abs(self.cosines(z, np.concatenate([sweep, crank], axis=1))).max(axis=1)
            worst.append(np.where(one_branch & (way <= FULL), cosine, np.inf))
            ways.append(way)
        return np.array(worst), np.array(ways)

    def cosines(self, z, crank):
        """Those of the transmission angle at crank angles (k, S); beyond 1 it comes apart."""
        l1, l2, arm, _ = self.links(z).T[:, :, None]
        away = abs(z[:, 2:3] - z[:, :1] - l1 * np.exp(1j * crank))
        return (arm**2 + l2**2 - away**2) / (2 * arm * l2)

    def judged(self, z, steps):
        """The least transmission angles (k,), degrees, by the better driver; 0 if it fails.

        With the order of the dyads and the sense of that drive, (k,) each.  Where a crank may turn
        either way it takes the shorter one that does not lock.
        """
        out = []
        for order in ([0, 1, 2, 3], [2, 3, 0, 1]):
            worst, way = self.driven(z[:, order], steps)
            free = worst < LOCKED
            shorter = np.where(free[0] & (~free[1] | (way[0] <= way[1])), 0, 1)
            out.append((np.take_along_axis(worst, shorter[None], 0)[0], shorter))
        (one, sense_one), (two, sense_two) = out
        swap = two < one
        worst = np.where(swap, two, one)
        angle = np.where(worst < LOCKED, np.degrees(np.arccos(np.minimum(worst, 1.0))), 0.0)
        return angle, worst, swap, 1 - 2 * np.where(swap, sense_two, sense_one)

    # search ---------------------------------------------------------------------------------

    def pairs(self, rng):
        """Pairs of dyads (k, 4) with sane links, or nearly."""
        first = self.dyads(rng, self.boxes[0])
        second = first if self.same_boxes else self.dyads(rng, self.boxes[1])
        if not len(first) or not len(second):
            return np.empty((0, 4), complex)
        a, b = np.indices((len(first), len(second))).reshape(2, -1)
        if self.same_boxes:
            a, b = a[a < b], b[a < b]
        z = np.concatenate([first[a], second[b]], axis=1)
        return z[self.within_bounds(z, slack=1.6)]

    def starts(self, rng, count):
        """The best pairs, far from each other: z (4,), dyads swapped, the driver's sense."""
        z = self.pairs(rng)
        found = []
        for chunk in np.array_split(z, max(1, len(z) // 20_000)) if len(z) else ():
            _, worst, swap, sense = self.judged(chunk, COARSE)
            sane = self.within_bounds(chunk)
            # Pairs beyond the bounds, or not assembled between the poses, come last.
            found.append((worst + 1.0 * ~sane, chunk, swap, sense))
        if not found:
            return []
        worst, z, swap, sense = (np.concatenate(part) for part in zip(*found, strict=True))
        out = []
        for k in np.argsort(worst, kind="stable")[:20_000]:
            if len(out) == count or not np.isfinite(worst[k]):
                break
            if all(abs(z[k] - other[0]).max() > APART for other in out):
                out.append((z[k], bool(swap[k]), int(sense[k])))
        return out

    def best(self, rng, rounds=1, starts=24, steps=60):
        """The best linkage found within all bounds in so many rounds, or None."""
        found = [self._best(rng, starts, steps) for _ in range(rounds)]
        found = [each for each in found if each is not None]
        return max(found, key=lambda each: each.angle, default=None)

    def _best(self, rng, starts, steps):
        ends = []
        for z, swap, sense in self.starts(rng, starts):
            ends += [z, self.descended(z, swap, sense, steps)]
        z = np.array([each for each in ends if each is not None]).reshape(-1, 4)
        if not len(z):
            return None
        good = self.within_bounds(z)
        for at in (0, 2):
            good &= (abs(self.misses(z[:, at], z[:, at + 1])) < MET).all(axis=1)
            for pivot, corners in zip(z[:, at : at + 2].T, self.boxes[at // 2], strict=True):
                good &= abs(clipped(pivot, corners) - pivot) < 1e-7
        if not good.any():
            return None
        z = z[good]
        angle = self.judged(z, FINE)[0]
        k = int(angle.argmax())
        if not angle[k] > 0:
            return None
        pivots = z[k] * self.unit + np.array([self.middle, 0, self.middle, 0])
        return Best(float(angle[k]), pivots)

    def descended(self, z, swap, sense, steps):
        """SLSQP from one pair, (4,); None where it fails."""
        order = [2, 3, 0, 1] if swap else [0, 1, 2, 3]
        z = z[order]
        low, high = (
            np.array([edge for k in order for edge in parts(self.boxes[k // 2][k % 2][end])])
            for end in (0, 1)
        )
        start = np.array([part for point in z for part in parts(point)])
        pins = self.pins(z[[1]]), self.pins(z[[3]])
        side = np.sign(((pins[1] - pins[0]).conj() * (pins[1] - z[2])).imag[0, 0])
        problem = _Program(self, sense, side)
        worst = abs(problem.values(start[None])[2]).max()
        x = np.append(np.clip(start, low, high), min(worst, 3.0))
        limits = [*zip(low, high, strict=True), (0.0, 4.0)]
        with np.errstate(all="ignore"):
            end = minimize(
                lambda x: x[8],
                x,
                jac=lambda _: np.eye(9)[8],
                bounds=limits,
                method="SLSQP",
                constraints=[
                    {"type": kind, "fun": _flat(fun), "jac": problem.derivative(fun)}
                    for kind, fun in (("eq", problem.equal), ("ineq", problem.above))
                ],
                options={"maxiter": steps, "ftol": 1e-7},
            ).x
        if not np.isfinite(end).all():
            return None
        end = np.clip(end[:8], low, high)
        z = end[0::2] + 1j * end[1::2]
        for at in (0, 2):
            z[at : at + 2] = [part[0] for part in self.onto_the_poses(z[[at]], z[[at + 1]], 4)]
        return z[np.argsort(order)]


class _Program:
    """The conditions of SLSQP at x (9,): eight coordinates, and a bound of |cos|."""

    def __init__(self, task, sense, side):
        self.task, self.sense, self.side = task, sense, side

    def values(self, x):
        """Of points x (k, 8): misses, links, cosines on the way, steps of the crank, sides."""
        task = self.task
        z = x[:, 0:8:2] + 1j * x[:, 1:8:2]
        pins = [task.pins(z[:, 1]), task.pins(z[:, 3])]
        crank = np.angle(pins[0] - z[:, :1])
        # Half a turn before zero a step counts as one back: no jump where two poses nearly meet.
        step = np.mod(self.sense * np.diff(crank, axis=1) + 0.3, FULL) - 0.3
        along = np.concatenate([np.zeros((len(z), 1)), np.cumsum(step, axis=1)], axis=1)
        share = np.linspace(0, 1, WITHIN + 1)
        between = [
            along[:, [a]] + share[1 if a else 0 :] * (along[:, [b]] - along[:, [a]])
            for a, b in pairwise(range(along.shape[1]))
        ]
        sweep = crank[:, :1] + self.sense * np.concatenate(between, axis=1)
        coupler, follower = pins[1] - pins[0], pins[1] - z[:, 2:3]
        sine = (coupler.conj() * follower).imag / abs(coupler) / abs(follower)
        misses = np.concatenate([task.misses(z[:, at], z[:, at + 1]) for at in (0, 2)], axis=1)
        return misses, task.links(z), task.cosines(z, sweep), step, self.side * sine

    def equal(self, x):
        return self.values(np.atleast_2d(x))[0]

    def above(self, x):
        x = np.atleast_2d(x)
        _, links, cosine, step, sine = self.values(x)
        bounds, worst = self.task.bounds, x[:, 8:9]
        ratio = bounds.ratio * links[:, :, None] - links[:, None, :]
        return np.concatenate(
            [
                worst - cosine,
                worst + cosine,
                ratio[:, ~np.eye(4, dtype=bool)],
                links - bounds.shortest,
                bounds.longest - links,
                step - LEAST_STEP,
                FULL - step.sum(axis=1, keepdims=True),
                sine - 1e-3,
            ],
            axis=1,
        )

    def derivative(self, fun):
        """Central differences, all in one call."""
        stride = 1e-6

        def jacobian(x):
            moved = x + stride * np.concatenate([np.eye(9), -np.eye(9)])
            up, down = np.split(fun(moved), 2)
            return ((up - down) / (2 * stride)).T

        return jacobian


def _shortest(jacobian, misses):
    """The shortest steps (k, 4) that make up for misses (k, N-1) to first order."""
    across = np.swapaxes(jacobian, 1, 2)
    square = jacobian @ across
    damping = 1e-12 * np.trace(square, axis1=1, axis2=2) + 1e-18
    square = square + damping[:, None, None] * np.eye(square.shape[-1])
    return -(across @ np.linalg.solve(square, misses[..., None]))[..., 0]


def _flat(fun):
    return lambda x: fun(x)[0]


def drawn(rng, corners, count):
    """Random points in a box, its corners two complex numbers."""
    low, high = corners
    x, y = rng.random((2, count))
    return low + x * (high - low).real + 1j * y * (high - low).imag


def clipped(point, corners):
    """The nearest points of a box."""
    low, high = corners
    return np.clip(point.real, low.real, high.real) + 1j * np.clip(point.imag, low.imag, high.imag)


def parts(point):
    return point.real, point.imag
