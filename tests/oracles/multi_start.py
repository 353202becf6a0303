"""The best 4R linkage of a task by SciPy's SLSQP from many random starts: no code of the package.

The unknowns are both fixed pivots, both moving pivots, both links' lengths, and the crank's angle
at each pose; the follower's pin is where two circles intersect.  Least is the mean over the poses
of |position error|² + (length x angle error)², with the crank turning one way, through no more than
one turn, and the transmission angle kept at the poses and in between.  Of all random starts (2,000)
a sweep of the crank tells how near each comes to the poses, and SLSQP runs from the few dozen best.

A linkage is z = c1, m1, r1, c2, m2, r2 (10,), the first dyad driving.
"""

import numpy as np
from scipy.optimize import minimize

SWEEP = 72  # crank angles at which a start is looked at
BETWEEN = 4  # places from pose to pose where the transmission angle is kept
FIRST, SECOND = (60, 40), (15, 200)  # numbers of starts, and of steps of SLSQP
KEPT_BEYOND = np.radians(0.05)  # of the transmission angle, as it is kept at places only
LEAST_STEP = 2e-3  # radians, of the crank from pose to pose
LEAST_LINK = 0.02  # motion sizes
FAR, WIDE = 3.0, 2.0  # motion sizes: how far pivots start where they may lie anywhere
REACH = 30.0  # motion sizes: how far they may go there
STRIDE = 1e-6  # of difference quotients
ENOUGH, LEAST_COST = 1e-8, 1e-7  # share of the first cost that ends SLSQP; its floor, sizes squared


class MultiStart:
    """The search for one task: poses rows (N, 3), the greatest miss and the link ratio allowed."""

    def __init__(self, rows, length, boxes=(), ratio=np.inf, transmission=0.0):
        self.middle = rows[:, :2].mean(axis=0)
        spread = np.sqrt(((rows[:, :2] - self.middle) ** 2).sum(axis=1).mean())
        self.unit = max(float(spread), length)
        self.at = ((rows[:, :2] - self.middle) / self.unit) @ [1, 1j]
        self.angle, self.length = rows[:, 2], length / self.unit
        self.ratio, self.transmission = ratio, transmission
        # Ranges (2, 10) of the dimensions for the dyads in either order.
        both = (tuple(boxes) * 2)[:2] if boxes else (None, None)
        self.ranges = [self._range(order) for order in (both, both[::-1])]
        self.limited = bool(boxes)

    def _range(self, boxes):
        low, high = np.full(10, -REACH), np.full(10, REACH)
        low[[4, 9]] = LEAST_LINK
        for at, pair in zip((0, 5), boxes, strict=True):
            if pair is not None:
                for k, corners in zip((at, at + 2), pair, strict=True):
                    origin = self.middle if k == at else 0.0
                    low[k : k + 2], high[k : k + 2] = (np.array(corners) - origin) / self.unit
        return np.array([low, high])

    def starts(self, rng, count):
        """Random linkages (count, 10) within the limits, the links as long as fits the poses."""
        orders = rng.integers(2, size=count)
        low, high = np.moveaxis(np.array(self.ranges)[orders], 1, 0)
        z = np.empty((count, 10))
        for at, wide in ((0, FAR), (2, WIDE), (5, FAR), (7, WIDE)):
            a, b = low[:, at : at + 2], high[:, at : at + 2]
            anywhere = rng.normal(size=(count, 2)) * wide / 2
            inside = a + (b - a) * rng.random((count, 2))
            z[:, at : at + 2] = inside if self.limited else anywhere
        turn = np.exp(1j * self.angle)
        for at in (0, 5):
            c, m = (z[:, k] + 1j * z[:, k + 1] for k in (at, at + 2))
            z[:, at + 4] = abs(self.at + m[:, None] * turn - c[:, None]).mean(axis=1)
        return z, orders

    def screened(self, z):
        """For linkages (k, 10), on both branches: a score and the crank's angles at the poses.

        Returned (k, 2) and (k, 2, N).
        """
        crank = np.linspace(-np.pi, np.pi, SWEEP, endpoint=False)
        d, phi, cosine = (
            each[:, :, None] for each in places(z, np.tile(crank, (len(z), 1)))
        )  # (k, 2, 1, S)
        miss = abs(d - self.at[:, None]) ** 2
        miss = miss + self.length**2 * np.angle(np.exp(1j * (phi - self.angle[:, None]))) ** 2
        beyond = np.maximum(abs(cosine) - np.cos(self.transmission), 0.0)
        miss = miss + np.where(np.isfinite(miss), 0.3 * beyond, 0.0)
        miss = np.where(np.isfinite(miss), miss, 1e3)
        best = miss.argmin(axis=-1)
        least = np.take_along_axis(miss, best[..., None], axis=-1)[..., 0].mean(axis=-1)
        at = np.unwrap(crank[best], axis=-1)
        step = np.diff(at, axis=-1)
        back = np.minimum(np.maximum(step, 0).sum(-1), np.maximum(-step, 0).sum(-1))
        return least + 0.05 * back, at

    def best(self, rng, count=2000):
        """The best linkages, the best first.

        A list of the error, z (10,) and places (N, 3), all in the task's unit.
        """
        z, orders = self.starts(rng, count)
        score, crank = self.screened(z)
        k, branch = np.unravel_index(np.argsort(score, axis=None), score.shape)
        chosen = [
            (np.concatenate([z[a], crank[a, b]]), 1 - 2 * int(b), int(orders[a]))
            for a, b in zip(k[: FIRST[0]], branch[: FIRST[0]], strict=True)
        ]
        found = []
        for number, steps in (FIRST, SECOND):
            found = []
            for v, sign, order in chosen[:number]:
                end, value = self.descended(v, sign, order, steps)
                if np.isfinite(end).all():
                    off = max(0.0, -float(self.values(end[None], sign)[1].min()))
                    found.append((value, off, end, sign, order))
            found.sort(key=lambda each: each[0] + 10 * each[1])
            distinct = []
            for each in found:
                if all(abs(each[0] - other[0]) > 1e-4 * each[0] for other in distinct):
                    distinct.append(each)
            chosen = [(v, sign, order) for _, _, v, sign, order in distinct]
        return [
            (np.sqrt(value) * self.unit, *self.in_the_task(v, sign, order))
            for value, off, v, sign, order in found
            if off < 1e-6
        ]

    def values(self, v, sign):
        """The cost (k,) of unknowns (k, n), and what has to be at least 0, (k, m)."""
        z, crank = v[:, :10], v[:, 10:]
        d, phi, _ = (each[:, (1 - sign) // 2] for each in places(z, crank))
        gap = np.angle(np.exp(1j * (phi - self.angle)))
        cost = (abs(d - self.at) ** 2 + (self.length * gap) ** 2).mean(axis=1)
        share = np.arange(BETWEEN) / BETWEEN
        every = crank[:, :-1, None] + share * np.diff(crank, axis=1)[..., None]
        every = np.concatenate([every.reshape(len(v), -1), crank[:, -1:]], axis=1)
        cosine = places(z, every)[2][:, 0]
        links = links_of(z)
        step = np.diff(crank, axis=1)
        step = step * np.sign(step.sum(axis=1, keepdims=True))
        kept = [
            np.cos(self.transmission + KEPT_BEYOND) ** 2 - cosine**2,
            step - LEAST_STEP,
            2 * np.pi - LEAST_STEP - step.sum(axis=1, keepdims=True),
            links[:, [0, 2]] - LEAST_LINK,
        ]
        if np.isfinite(self.ratio):
            less = self.ratio * (1 - 1e-5) * links[:, :, None] - links[:, None]
            kept.append(less[:, ~np.eye(4, dtype=bool)])
        return cost, np.concatenate(kept, axis=1)

    def descended(self, v, sign, order, steps):
        """The end (n,) of SLSQP from v (n,), and its cost; derivatives by central differences."""
        memory = {}
        # SLSQP ends by what it still gains: in shares of the cost at the start.
        unit = max(float(self.values(v[None], sign)[0][0]), LEAST_COST)

        def at(v):
            key = v.tobytes()
            if key not in memory:
                memory.clear()
                stride = STRIDE * np.eye(len(v))
                cost, kept = self.values(np.concatenate([v[None], v + stride, v - stride]), sign)
                n, cost = len(v), cost / unit
                memory[key] = (
                    cost[0],
                    (cost[1 : n + 1] - cost[n + 1 :]) / (2 * STRIDE),
                    kept[0],
                    (kept[1 : n + 1] - kept[n + 1 :]).T / (2 * STRIDE),
                )
            return memory[key]

        low, high = self.ranges[order]
        bounds = [*zip(low, high, strict=True), *[(None, None)] * (len(v) - 10)]
        with np.errstate(all="ignore"):
            end = minimize(
                lambda v: at(v)[0],
                v,
                jac=lambda v: at(v)[1],
                method="SLSQP",
                bounds=bounds,
                constraints={
                    "type": "ineq",
                    "fun": lambda v: at(v)[2],
                    "jac": lambda v: at(v)[3],
                },
                options={"maxiter": steps, "ftol": ENOUGH},
            )
        return end.x, float(end.fun) * unit

    def in_the_task(self, v, sign, order):
        """The dimensions (10,), and the places (N, 3), in the task's own frame and unit.

        The dyads stand in the order of their limits.
        """
        d, phi, _ = (each[0, (1 - sign) // 2] for each in places(v[None, :10], v[None, 10:]))
        phi = self.angle + np.angle(np.exp(1j * (phi - self.angle)))
        z = v[:10] * self.unit
        z[[0, 1, 5, 6]] += np.tile(self.middle, 2)
        rows = np.column_stack([d.real, d.imag]) * self.unit + self.middle
        return np.roll(z, 5) if order else z, np.column_stack([rows, phi])


def places(z, crank):
    """Body places d, phi (k, 2, n) on both branches at crank angles (k, n), and the cosine.

    The cosine is that of the angle between coupler and follower; where the linkage does not close,
    it is beyond 1 and the places are those of the follower's pin nearest to closing.
    """
    c1, m1, c2, m2 = ((z[:, k] + 1j * z[:, k + 1])[:, None] for k in (0, 2, 5, 7))
    r1, r2 = z[:, 4:5], z[:, 9:10]
    with np.errstate(all="ignore"):
        pin = c1 + r1 * np.exp(1j * crank)
        arm, to = m2 - m1, c2 - pin
        away = abs(to)
        # The triangle of coupler, follower and the line from the crank's pin to the other ground.
        along = (abs(arm) ** 2 - r2**2 + away**2) / (2 * away)
        across = np.sqrt(np.maximum(abs(arm) ** 2 - along**2, 1e-12))
        phi = np.stack([np.angle(to * (along + s * 1j * across) / arm) for s in (1, -1)], axis=1)
        cosine = (abs(arm) ** 2 + r2**2 - away**2) / (2 * abs(arm) * r2)
        d = pin[:, None] - m1[:, None] * np.exp(1j * phi)
    return d, phi, np.stack([cosine, cosine], axis=1)


def links_of(z):
    """Ground, crank, coupler and follower (k, 4)."""
    ground, coupler = (np.hypot(z[:, 5 + k] - z[:, k], z[:, 6 + k] - z[:, k + 1]) for k in (0, 2))
    return np.stack([ground, z[:, 4], coupler, z[:, 9]], axis=1)
