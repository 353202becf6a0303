"""The best slider-crank of two or three poses by brute force, as `few_poses` for four-bars.

One dyad is a link between pivots in boxes; the other a slider on the ground, whose moving pivot is
in a box, and whose line goes through its places at the poses.  Of three poses such pivots lie on a
circle.  The transmission angle at the slider is that between the coupler and the normal of its
line, where the link drives; that between coupler and link, where the slider drives.

A linkage is (c, m, p): the link's pivots, and the slider's moving pivot.  The ratio of four links
is not asked of it; link and coupler are within the bounds.
"""

from itertools import pairwise

import numpy as np
from scipy.optimize import minimize

from tests.oracles.few_poses import (
    FINE,
    FULL,
    LEAST_STEP,
    LOCKED,
    MET,
    WITHIN,
    FewPoses,
    clipped,
    drawn,
    parts,
)

DRAWN, KEPT, COARSE = 4000, 420, 40
APART = 0.05  # motion spans


class SliderPoses:
    """The search for one task: rows (N, 3); boxes of the fixed, the moving, the slider's pivot."""

    def __init__(self, rows, fixed, moving, slider):
        self.one = FewPoses(rows, ((fixed, moving),))
        self.box = np.asarray(slider, float) @ [1, 1j] / self.one.unit
        self.bounds = self.one.bounds

    def bends(self, p):
        """What vanishes where the places (k, N) of pivots p (k,) are on a line: (k, N-2)."""
        pins = self.one.pins(p)
        return ((pins[:, 1:2] - pins[:, :1]).conj() * (pins[:, 2:] - pins[:, :1])).imag

    def sliders(self, rng):
        """Moving pivots (k,) of sliders in their box."""
        p = drawn(rng, self.box, DRAWN)
        for _ in range(12):
            bend = self.bends(p)
            if not bend.shape[1]:
                break
            slope = [(self.bends(p + d) - self.bends(p - d)) / 2e-6 for d in (1e-6, 1e-6j)]
            x, y = (each[:, 0] for each in slope)
            step = bend[:, 0] / np.maximum(x**2 + y**2, 1e-300)
            p = clipped(p - np.clip(step * x, -1, 1) - 1j * np.clip(step * y, -1, 1), self.box)
        good = (abs(self.bends(p)) < MET).all(axis=1)
        good &= abs(np.diff(self.one.pins(p)[:, :2], axis=1)[:, 0]) > 1e-3
        return p[good][:KEPT]

    def figures(self, z):
        """Of linkages z (k, 3): places of both pins, the line's direction, link and coupler."""
        c, m, p = z.T
        a, b = self.one.pins(m), self.one.pins(p)
        way = b[:, -1] - b[:, 0] if self.bends(p).shape[1] == 0 else b[:, 1] - b[:, 0]
        return a, b, way / abs(way), abs(a[:, 0] - c), abs(p - m)

    def driven(self, z, by_slider, steps):
        """The greatest |cos| (2, k) of the transmission angle, either way; and the way."""
        c = z[:, :1]
        a, b, along, *_ = self.figures(z)
        coupler = b - a
        lever = a - c if by_slider else along[:, None]
        product = (coupler.conj() * lever).imag if by_slider else (coupler.conj() * lever).real
        one_branch = abs(np.sign(product).sum(axis=1)) == b.shape[1]
        drive = ((b - b[:, :1]) * along.conj()[:, None]).real if by_slider else np.angle(a - c)
        worst, ways = [], []
        for sense in (1, -1):
            step = sense * np.diff(drive, axis=1)
            step = step if by_slider else np.mod(step, FULL)
            way = step.sum(axis=1)
            sweep = drive[:, :1] + sense * way[:, None] * np.linspace(0, 1, steps)
            cosine = abs(self.cosines(z, sweep, by_slider)).max(axis=1)
            good = one_branch & ((step > 0).all(axis=1) if by_slider else way <= FULL)
            worst.append(np.where(good, cosine, np.inf))
            ways.append(way)
        return np.array(worst), np.array(ways)

    def cosines(self, z, drive, by_slider):
        """Those of the transmission angle at drives (k, S)."""
        _, b, along, link, arm = (
            each[:, None] if each.ndim == 1 else each for each in self.figures(z)
        )
        if by_slider:
            away = abs(b[:, :1] + drive * along - z[:, :1])
            return (arm**2 + link**2 - away**2) / (2 * arm * link)
        pin = z[:, :1] + link * np.exp(1j * drive)
        return ((b[:, :1] - pin) * along.conj()).imag / arm

    def judged(self, z, steps):
        """The least transmission angles (k,), degrees; |cos|; by the slider; the sense."""
        out = []
        for by_slider in (False, True):
            worst, way = self.driven(z, by_slider, steps)
            free = worst < LOCKED
            shorter = np.where(free[0] & (~free[1] | (way[0] <= way[1])), 0, 1)
            out.append((np.take_along_axis(worst, shorter[None], 0)[0], shorter))
        (one, sense_one), (two, sense_two) = out
        by_slider = two < one
        worst = np.where(by_slider, two, one)
        angle = np.where(worst < LOCKED, np.degrees(np.arccos(np.minimum(worst, 1.0))), 0.0)
        return angle, worst, by_slider, 1 - 2 * np.where(by_slider, sense_two, sense_one)

    def within_bounds(self, z, slack=1.0):
        *_, link, arm = self.figures(z)
        least, most = np.minimum(link, arm) * slack, np.maximum(link, arm) / slack
        return (least >= self.bounds.shortest - 1e-9) & (most <= self.bounds.longest + 1e-9)

    def best(self, rng, starts=24, steps=60):
        """The greatest least transmission angle found, degrees, and its linkage; or None."""
        links, sliders = self.one.dyads(rng, self.one.boxes[0]), self.sliders(rng)
        if not len(links) or not len(sliders):
            return None
        a, b = np.indices((len(links), len(sliders))).reshape(2, -1)
        z = np.column_stack([links[a], sliders[b]])
        z = z[self.within_bounds(z)]
        if not len(z):
            return None
        chunks = np.array_split(z, len(z) // 20_000 + 1)
        judged = [self.judged(chunk, COARSE)[1:] for chunk in chunks]
        worst, by_slider, sense = (np.concatenate(part) for part in zip(*judged, strict=True))
        chosen = []
        for k in np.argsort(worst, kind="stable")[:20_000]:
            if len(chosen) == starts or not np.isfinite(worst[k]):
                break
            if all(abs(z[k] - z[j]).max() > APART for j in chosen):
                chosen.append(k)
        ends = [self.descended(z[k], bool(by_slider[k]), int(sense[k]), steps) for k in chosen]
        every = np.concatenate([z[chosen], np.array(ends).reshape(-1, 3)])
        good = np.isfinite(every).all(axis=1) & self.within_bounds(every)
        good &= (abs(self.one.misses(*every[:, :2].T)) < 1e-7).all(axis=1)
        good &= (abs(self.bends(every[:, 2])) < 1e-7).all(axis=1)
        if not good.any():
            return None
        every = every[good]
        angle = self.judged(every, FINE)[0]
        k = int(angle.argmax())
        pivots = every[k] * self.one.unit + np.array([self.one.middle, 0, 0])
        return (float(angle[k]), pivots) if angle[k] > 0 else None

    def descended(self, z, by_slider, sense, steps):
        """SLSQP from one linkage (3,)."""
        boxes = [*self.one.boxes[0], self.box]
        low, high = (np.array([part for box in boxes for part in parts(box[e])]) for e in (0, 1))

        def of(x):
            return x[:, 0:6:2] + 1j * x[:, 1:6:2]

        def equal(x):
            z = of(x)
            return np.concatenate([self.one.misses(*z[:, :2].T), self.bends(z[:, 2])], axis=1)

        def above(x):
            z = of(x)
            a, b, along, link, arm = self.figures(z)
            if by_slider:
                step = sense * np.diff(((b - b[:, :1]) * along.conj()[:, None]).real, axis=1)
                drive = ((b - b[:, :1]) * along.conj()[:, None]).real[:, :1]
            else:
                drive = np.angle(a - z[:, :1])
                step = np.mod(sense * np.diff(drive, axis=1) + 0.3, FULL) - 0.3
            way = np.concatenate([np.zeros((len(z), 1)), np.cumsum(step, axis=1)], axis=1)
            share = np.linspace(0, 1, WITHIN + 1)
            between = [
                way[:, [i]] + share * (way[:, [j]] - way[:, [i]])
                for i, j in pairwise(range(way.shape[1]))
            ]
            sweep = drive[:, :1] + sense * np.concatenate(between, axis=1)
            cosine = self.cosines(z, sweep, by_slider)
            lengths = np.column_stack([link, arm])
            worst = x[:, 6:7]
            return np.concatenate(
                [
                    worst - cosine,
                    worst + cosine,
                    lengths - self.bounds.shortest,
                    self.bounds.longest - lengths,
                    step - LEAST_STEP,
                ],
                axis=1,
            )

        def slope(fun):
            sides = 1e-6 * np.concatenate([np.eye(7), -np.eye(7)])

            def jacobian(x):
                up, down = np.split(fun(x + sides), 2)
                return ((up - down) / 2e-6).T

            return jacobian

        start = np.clip(np.array([part for point in z for part in parts(point)]), low, high)
        with np.errstate(all="ignore"):
            end = minimize(
                lambda x: x[6],
                np.append(start, 1.0),
                jac=lambda _: np.eye(7)[6],
                bounds=[*zip(low, high, strict=True), (0.0, 4.0)],
                method="SLSQP",
                constraints=[
                    {"type": kind, "fun": lambda x, f=fun: f(x[None])[0], "jac": slope(fun)}
                    for kind, fun in (("eq", equal), ("ineq", above))
                ],
                options={"maxiter": steps, "ftol": 1e-7},
            ).x
        return of(np.clip(end[:6], low, high)[None])[0] if np.isfinite(end).all() else z
