"""Paths whose nearest linkages nobody would build: is a sound one listed, and at what price?

Run it from the project's root: python -m benchmarks.sound_paths --count 40 --seed 0

Shapes as people draw them (half-discs, rounded boxes, feet, hearts, beans, arcs, hooks ...), closed
ones of 40 points and open ones of 24.  Each is solved as `burmester synthesize` does.  Then SciPy
looks for a sound linkage (transmission angle 30 degrees, link ratio 10, links of 0.05 to 10 spans)
with other code and ten times the time: random linkages whose curves are laid over the shape, the
best ones refined by `least_squares` on all dimensions and crank angles at once.  Printed are
greatest distances of a point from the curve, in thousandths of the path's span.

Exit code 1 if a shape has no sound linkage in its list, and SciPy knows one that misses by at most
three times as much as the nearest linkage of the list.

What SciPy found may be kept (--record FILE), and read in a later run (--against FILE), which then
takes a minute or two.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.traced_path import TracedPath

LONGER = 10.0  # times the seconds of the answer that SciPy is given
DRAWN = 30_000  # random linkages of SciPy's search
LEAST_ANGLE, MOST_RATIO, SHORTEST, LONGEST = np.radians(30), 10.0, 0.05, 10.0
WITHIN = 3.0  # times as far as the nearest linkage


# The shapes.


def _corners(points, rounding, rng):
    """A closed polygon, its corners rounded by a share of the shorter side."""
    points, out = np.asarray(points, dtype=complex), []
    for k, corner in enumerate(points):
        before, after = points[k - 1] - corner, points[(k + 1) % len(points)] - corner
        size = rounding * min(abs(before), abs(after))
        one, two = corner + size * before / abs(before), corner + size * after / abs(after)
        s = np.linspace(0, 1, 12)
        out += [*((1 - s) ** 2 * one + 2 * s * (1 - s) * corner + s**2 * two)]
    return np.array([*out, out[0]])


def _half_disc(rng):
    turn = np.linspace(0, np.pi, 60)
    return np.append(np.exp(1j * turn) * (1 + rng.uniform(-0.3, 0.5) * 1j * np.sin(turn)), 1)


def _superellipse(rng):
    t, n = np.linspace(0, 2 * np.pi, 181), rng.uniform(0.4, 1.2)
    x, y = np.cos(t), np.sin(t)
    return np.sign(x) * abs(x) ** n + 1j * rng.uniform(0.3, 0.9) * np.sign(y) * abs(y) ** n


def _egg(rng):
    t = np.linspace(0, 2 * np.pi, 181)
    return np.cos(t) + 1j * rng.uniform(0.4, 0.8) * np.sin(t) * np.exp(
        rng.uniform(0.1, 0.5) * np.cos(t)
    )


def _bean(rng):
    t = np.linspace(0, 2 * np.pi, 181)
    p = np.cos(t) + 1j * rng.uniform(0.3, 0.5) * np.sin(t)
    return p + 1j * rng.uniform(0.2, 0.6) * p.real**2


def _drop(rng):
    t = np.linspace(0, 2 * np.pi, 181)
    return np.cos(t) + 1j * np.sin(t) * np.sin(t / 2) ** rng.uniform(0.8, 2.5)


def _foot(rng):
    """A flat step, and a lift above it."""
    t, lift = np.linspace(np.pi, 0, 90), rng.uniform(0.3, 0.8)
    return np.concatenate(
        [np.linspace(-1, 1, 60), (np.cos(t) + 1j * lift * np.sin(t) ** rng.uniform(0.7, 1.4))[::-1]]
    )


def _box(rng):
    a = rng.uniform(0.3, 0.9)
    return _corners([-1 - a * 1j, 1 - a * 1j, 1 + a * 1j, -1 + a * 1j], rng.uniform(0.1, 0.5), rng)


def _triangle(rng):
    return _corners(np.exp(1j * np.sort(rng.uniform([0, 2, 4], [1, 3, 5]))), 0.3, rng)


def _heart(rng):
    t = np.linspace(0, 2 * np.pi, 181)
    r = 1 - rng.uniform(0.3, 0.7) * np.sin(t)
    return r * np.exp(1j * t)


def _eight(rng):
    t = np.linspace(0, 2 * np.pi, 181)
    return np.cos(t) + 1j * rng.uniform(0.3, 0.8) * np.sin(2 * t + rng.uniform(-0.4, 0.4))


def _stadium(rng):
    t, long = np.linspace(-np.pi / 2, np.pi / 2, 50), rng.uniform(0.3, 1.5)
    half = long + np.exp(1j * t)
    return np.concatenate([half, -half, half[:1]])


def _crescent(rng):
    t, deep = np.linspace(0, np.pi, 80), rng.uniform(0.2, 0.6)
    outer, inner = np.exp(1j * t), np.cos(t) + 1j * deep * np.sin(t)
    return np.concatenate([outer, inner[::-1], outer[:1]])


def _arc(rng):
    t = np.linspace(0, rng.uniform(1.0, 4.5), 90)
    return np.cos(t) + 1j * rng.uniform(0.5, 1.0) * np.sin(t)


def _hook(rng):
    t = np.linspace(0, np.pi * rng.uniform(0.6, 1.1), 60)
    return np.concatenate([np.linspace(-2 * rng.uniform(0.4, 1), 0, 40) - 1j, -1j * np.exp(1j * t)])


def _wave(rng):
    x = np.linspace(-1, 1, 90)
    return x + 1j * rng.uniform(0.1, 0.5) * np.sin(rng.uniform(1.5, 3.2) * x)


def _parabola(rng):
    x = np.linspace(-1, rng.uniform(0.4, 1), 90)
    return x + 1j * rng.uniform(0.3, 1.2) * x**2


def _spiral(rng):
    t = np.linspace(0, rng.uniform(2, 5), 90)
    return (1 + rng.uniform(0.05, 0.2) * t) * np.exp(1j * t)


CLOSED = (
    _half_disc, _superellipse, _egg, _bean, _drop, _foot, _box, _triangle, _heart, _eight,
    _stadium, _crescent,
)  # fmt: skip
OPEN = _arc, _hook, _wave, _parabola, _spiral


def shape(seed, number):
    """The name of a shape, its points (n, 2), and whether it is closed."""
    rng = np.random.default_rng([34, seed, number])
    kinds = [*CLOSED, *OPEN]
    make = kinds[number % len(kinds)]
    closed = make in CLOSED
    drawn = make(rng) * rng.uniform(5, 80) * np.exp(1j * rng.uniform(0, 2 * np.pi))
    count = 40 if closed else 24
    points = _even(drawn, count + closed)[:count] + rng.normal() * 20 + 1j * rng.normal() * 20
    return make.__name__[1:], np.round(np.column_stack([points.real, points.imag]), 4), closed


def _even(drawn, count):
    """Points at equal steps of arc length along a drawn line."""
    arc = np.append(0, np.abs(np.diff(drawn)).cumsum())
    wanted = np.linspace(0, arc[-1], count)
    return np.interp(wanted, arc, drawn.real) + 1j * np.interp(wanted, arc, drawn.imag)


# SciPy's search: the kinematics, the starts and the descent are its own.


def _coupler(z, side, t):
    """The coupler point, and the cosine of the transmission angle, of linkages at crank angles.

    z: x0 y0 angle ground crank coupler follower and the coupler point, on the last axis.
    """
    x, y, turn, g, a, b, r, u, v = np.moveaxis(z[..., None, :], -1, 0)
    pin = a * np.exp(1j * t)
    to = g - pin
    size = np.abs(to)
    cosine = (b * b + size**2 - r * r) / (2 * b * size)
    with np.errstate(invalid="ignore"):
        bar = to / size * (cosine + 1j * side[..., None] * np.sqrt(1 - cosine**2))
    between = (b * b + r * r - size**2) / (2 * b * r)
    return x + 1j * y + np.exp(1j * turn) * (pin + (u + 1j * v) * bar), between


def _drawn_linkages(rng, closed):
    """Random linkages that are sound, the crank turning fully where the path is closed."""
    z = np.zeros((DRAWN, 9))
    z[:, 3:7] = 10 ** rng.uniform(-1, 0, (DRAWN, 4))
    z[:, 7:] = z[:, 5, None] * rng.normal(0, 1.5, (DRAWN, 2)) + [0, 0]
    side = rng.choice([-1.0, 1.0], DRAWN)
    g, a, b, r = z[:, 3:7].T
    ends = np.stack([abs(g - a), g + a], axis=-1)
    cosine = (b * b + r * r)[:, None] - ends**2
    good = (np.abs(cosine / (2 * b * r)[:, None]) < np.cos(LEAST_ANGLE)).all(axis=-1)
    if not closed:
        good |= rng.random(DRAWN) < 0.5
    return z[good], side[good]


def _laid(z, curve, wanted):
    """Linkages turned, stretched and shifted so that their curves (k, n) lie over points (n,)."""
    here, there = curve.mean(axis=1), wanted.mean()
    one, two = curve - here[:, None], wanted - there
    factor = (one.conj() @ two) / np.maximum((np.abs(one) ** 2).sum(axis=1), 1e-300)
    left = np.sqrt((np.abs(factor[:, None] * one - two) ** 2).mean(axis=1))
    out, size = z.copy(), np.abs(factor)
    out[:, 3:] *= size[:, None]
    out[:, 2] += np.angle(factor)
    middle = there - factor * here
    out[:, 0], out[:, 1] = middle.real, middle.imag
    return out, left


def _starts(rng, points, closed):
    """Linkages with sides and crank angles (k, n), the most alike first."""
    n, found = len(points), []
    z, side = _drawn_linkages(rng, closed)
    for flipped in (False, True):
        y = z * [1, 1, 1, 1, 1, 1, 1, 1, -1] if flipped else z
        s = -side if flipped else side
        for sense in (1, -1):
            for _ in range(4 if closed else 12):
                begin = rng.uniform(0, 2 * np.pi, (len(z), 1))
                turn = 2 * np.pi if closed else rng.uniform(0.6, 6, (len(z), 1))
                t = begin + sense * turn * np.linspace(0, 1, 97)
                p, _ = _coupler(y, s, t)
                whole = np.isfinite(p).all(axis=1)
                arc = np.abs(np.diff(p[whole])).cumsum(axis=1)
                arc = np.column_stack([np.zeros(len(arc)), arc])
                share = np.linspace(0, 1, n + closed)[:n]
                steps = np.stack([np.interp(share * e[-1], e, np.arange(97.0)) for e in arc])
                angle = (
                    t[whole, :1] + sense * np.broadcast_to(turn, (len(z), 1))[whole] * steps / 96
                )
                own, left = _laid(y[whole], _coupler(y[whole], s[whole], angle)[0], points)
                best = np.argsort(left)[:40]
                found += [(left[k], own[k], s[whole][k], angle[k]) for k in best]
    return [each[1:] for each in sorted(found, key=lambda each: each[0])]


def _lacks(z, t, closed, span):
    """By what a linkage falls short of the standard; all are 0 where it is sound."""
    g, a, b, r = links = np.abs(z[3:7])
    ends = np.array([abs(g - a), g + a]) if closed else np.abs(g - a * np.exp(1j * t))
    cosine = np.abs(b * b + r * r - ends**2) / (2 * b * r)
    return np.concatenate(
        [
            np.maximum(cosine - np.cos(LEAST_ANGLE), 0),
            [max(np.log(links.max() / links.min() / MOST_RATIO), 0)],
            np.maximum(np.log(SHORTEST * span / links), 0),
            np.maximum(np.log(links / span / LONGEST), 0),
        ]
    )


def _refined(start, points, closed, span):
    """The greatest distance of a point and the linkage, refined; infinite where it is not sound."""
    z, side, t = start
    side = np.array(side)
    inner = 1.005  # what is asked more, so that it is kept

    def residual(x):
        gap = (_coupler(x[:9], side, x[9:])[0] - points) / span
        lack = _lacks(x[:9] * np.r_[1, 1, 1, np.ones(6)], x[9:], closed, span * 1.0)
        gap = np.nan_to_num(gap, nan=1.0)
        return np.concatenate([gap.real, gap.imag, 3 * inner * lack])

    scale = np.r_[span, span, 1, np.full(6, span), np.ones(len(t))]
    done = least_squares(residual, np.r_[z, t], x_scale=scale, max_nfev=80, ftol=1e-7)
    x = done.x
    if (x[3:7] <= 0).any() or (_lacks(x[:9], x[9:], closed, span) > 2e-3).any():
        return np.inf, x
    if closed and not np.isfinite(_coupler(x[:9], side, np.linspace(0, 2 * np.pi, 361))[0]).all():
        return np.inf, x
    steps = np.diff(x[9:])
    if not ((steps > 0).all() or (steps < 0).all()):
        return np.inf, x
    return float(np.abs(_coupler(x[:9], side, x[9:])[0] - points).max()), x


def scipys(points, closed, seconds, rng):
    """The least distance of a sound linkage that SciPy finds in the time; infinite without any."""
    begun, best = time.process_time(), np.inf
    wanted = points[:, 0] + 1j * points[:, 1]
    span = float(np.linalg.norm(np.ptp(points, axis=0)))
    for start in _starts(rng, wanted, closed):
        if time.process_time() - begun > seconds:
            break
        best = min(best, _refined(start, wanted, closed, span)[0])
    return best


def answered(points, closed):
    """The list for a shape: its nearest and its nearest sound linkage, and the seconds it took."""
    begun = time.process_time()
    poses = Displacement(points, np.zeros(len(points)))
    found = synthesize(Task(poses, path=TracedPath(closed=closed)))
    seconds = time.process_time() - begun
    nearest = min((each.error.worst for each in found.usable), default=np.inf)
    sound = [each.error.worst for each in found.usable if not each.shortcomings]
    return nearest, min(sound, default=np.inf), found, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--record", metavar="FILE")
    parser.add_argument("--against", metavar="FILE")
    given = parser.parse_args()
    known = json.loads(Path(given.against).read_text()) if given.against else {}
    told, lost, listed, farther = {}, [], 0, []
    print("shape              nearest   sound   SciPy's sound  seconds")
    for number in range(given.count):
        name, points, closed = shape(given.seed, number)
        span = float(np.linalg.norm(np.ptp(points, axis=0)))
        nearest, sound, _, seconds = answered(points, closed)
        key = f"{given.seed}-{number}"
        if key not in known:
            rng = np.random.default_rng([35, given.seed, number])
            other = scipys(points, closed, LONGER * seconds, rng) / span
            known[key] = None if np.isinf(other) else round(float(other), 7)
        told[key] = known[key]
        other = np.inf if known[key] is None else known[key]
        nearest, sound = nearest / span, sound / span
        listed += np.isfinite(sound)
        missing = np.isinf(sound) and other <= WITHIN * nearest
        lost += [name] if missing else []
        farther += [sound / other] if np.isfinite(sound) and np.isfinite(other) else []
        print(
            f"{number:3} {name:12} {1e3 * nearest:9.3f} {1e3 * sound:9.3f} {1e3 * other:9.3f} "
            f"{seconds:12.1f} {'missing' if missing else ''}",
            flush=True,
        )
    print(f"a sound linkage is listed for {listed} of {given.count} shapes; missing: {lost}")
    if farther:
        print(
            f"as far as SciPy's: {np.median(farther):.2f} in the median, {max(farther):.2f} at most"
        )
    if given.record:
        Path(given.record).write_text(json.dumps(told, indent=0) + "\n")
    sys.exit(bool(lost))


if __name__ == "__main__":
    main()
