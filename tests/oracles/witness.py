"""A second opinion that shares no code with the package: linkages driven joint by joint.

Everything is in complex numbers.  The first dyad puts its moving pivot on its guide (a crank
angle, or a place along a rail); the body then turns about that pin until the second dyad is
content, which is one equation a cos(phi) + b sin(phi) = e with two solutions.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.least import least


def _c(pair):
    return complex(pair[0], pair[1])


def _rail(line, along):
    return (float(line.offset) + 1j * along) * np.exp(1j * float(line.normal_angle))


def places(first, second, drive):
    """Body places (x + iy, phi), two assemblies each, at driver positions (n,); nan if open."""
    if isinstance(first, RR):
        pin, hand = (
            _c(first.fixed_pivot) + first.radius * np.exp(1j * drive),
            _c(first.moving_pivot),
        )
    elif isinstance(first, PR):
        pin, hand = _rail(first, drive), _c(first.moving_pivot)
    else:
        pin, hand = _c(first.fixed_pivot), _rail(first, drive)
    if isinstance(second, RR):
        arm = _c(second.moving_pivot) - hand
        to = pin - _c(second.fixed_pivot)
        # |to + arm e^{i phi}|² = r²
        z = np.conj(to) * arm
        e = (second.radius**2 - abs(to) ** 2 - abs(arm) ** 2) / 2
    elif isinstance(second, PR):
        n = np.exp(1j * float(second.normal_angle))
        arm = _c(second.moving_pivot) - hand
        z = np.conj(n) * arm
        e = second.offset - (np.conj(n) * pin).real
    else:
        n = np.exp(1j * float(second.normal_angle))
        # n . (e^{-i phi} (c - pin) + hand) = h
        z = np.conj(_c(second.fixed_pivot) - pin) * n
        e = second.offset - (np.conj(n) * hand).real
    # Re(z e^{i phi}) = e
    z, e, pin, hand = np.broadcast_arrays(z, e, pin, hand)
    with np.errstate(invalid="ignore", divide="ignore"):
        open_angle = np.arccos(e / abs(z))
    phi = -np.angle(z) + np.stack([open_angle, -open_angle])
    return pin - hand * np.exp(1j * phi), phi


def turned(slot, second, phi):
    """Body places (x + iy), two assemblies each, where an RP dyad, `slot`, drives to phi (n,)."""
    turn = np.exp(1j * phi)
    normal = turn * np.exp(1j * float(slot.normal_angle))
    # conj(normal) (c - d) = h + i s with s the place along the slot
    foot, way = _c(slot.fixed_pivot) - normal * float(slot.offset), -1j * normal
    if isinstance(second, RR):
        to = foot + turn * _c(second.moving_pivot) - _c(second.fixed_pivot)
        half = (np.conj(way) * to).real
        with np.errstate(invalid="ignore"):
            root = np.sqrt(half**2 - abs(to) ** 2 + second.radius**2)
        along = np.stack([-half - root, -half + root])
    else:
        n = np.exp(1j * float(second.normal_angle))
        if isinstance(second, PR):
            miss = second.offset - (np.conj(n) * (foot + turn * _c(second.moving_pivot))).real
            share = (np.conj(n) * way).real
        else:
            body = np.conj(turn * n)
            miss = second.offset - (body * (_c(second.fixed_pivot) - foot)).real
            share = -(body * way).real
        along = np.stack([miss / share] * 2)
    return foot + along * way


def missed(linkage, place):
    """How far the body is from a place (x, y, angle) when its first link stands as there."""
    first, second = linkage.first, linkage.second
    x, y, angle = place
    pin = x + 1j * y + complex(*first.moving_pivot) * np.exp(1j * angle)
    drive = np.angle(pin - complex(*first.fixed_pivot))
    at, phi = places(first, second, np.array([drive]))
    away = np.abs(at - (x + 1j * y)) + np.abs(np.exp(1j * phi) - np.exp(1j * angle))
    return np.nanmin(away)


def misses(linkage, poses, length):
    """How near (N,) the linkage comes to each pose, driven from either side."""
    pairs = [(linkage.first, linkage.second), (linkage.second, linkage.first)]
    # A drive is blind at its own dead points; the other one sees there.
    return np.min([_driven(*pair, poses, length) for pair in pairs], axis=0)


def _driven(first, second, poses, length):
    """The same for one driver: a sweep, then a refinement."""
    if isinstance(first, RR):
        sweep = np.linspace(-np.pi, np.pi, 7201)
    else:
        sweep = 50 * length * np.linspace(-1, 1, 20001) ** 3
    where, phi = places(first, second, sweep)
    d = poses.translation[:, 0] + 1j * poses.translation[:, 1]

    def gap(where, phi, k):
        turn = np.exp(1j * (phi - poses.angle[k]))
        return np.hypot(abs(where - d[k]), length * np.angle(turn))

    # Drive to where the pose itself would have the driver, too: a sweep alone stops at 1e-7.
    turn = np.exp(1j * poses.angle)
    if isinstance(first, RR):
        asked = np.angle(d + _c(first.moving_pivot) * turn - _c(first.fixed_pivot))
    else:
        fixed = isinstance(first, PR)
        on = d + _c(first.moving_pivot) * turn if fixed else (_c(first.fixed_pivot) - d) / turn
        asked = (on * np.exp(-1j * float(first.normal_angle))).imag

    each = np.arange(len(d))
    best = np.full(len(d), np.inf)
    for side in (0, 1):

        def along(t, side=side):
            w, p = places(first, second, t)
            return np.nan_to_num(gap(w[side], p[side], each), nan=1e9)

        distance = np.array([gap(where[side], phi[side], k) for k in each])
        distance[np.isnan(distance)] = 1e9
        at = distance.argmin(axis=1)
        low, high = sweep[np.maximum(at - 1, 0)], sweep[np.minimum(at + 1, len(sweep) - 1)]
        _, fine = least(along, low, high)
        best = np.min([best, along(asked), distance.min(axis=1), fine], axis=0)
    return best


def random_four_bar(rng, second=RR):
    """Two dyads that can be assembled often enough; wild proportions welcome."""
    while True:
        c, m = rng.normal(size=(2, 2)), rng.normal(size=(2, 2))
        dyads = [RR(c[i], m[i], rng.uniform(0.2, 2.0)) for i in range(2)]
        if second is PR:
            dyads[1] = PR(rng.uniform(-np.pi, np.pi), rng.normal(), m[1])
        if second is RP:
            dyads[1] = RP(c[1], rng.uniform(-np.pi, np.pi), rng.normal())
        where, _ = places(*dyads, np.linspace(-np.pi, np.pi, 73))
        if np.isfinite(where[0]).mean() > 0.2:
            return dyads


def random_poses(dyads, rng, count, side=None, ordered=False):
    """`count` poses (x, y, angle) that two dyads pass through, on one assembly (side 0 or 1).

    ordered: as the first dyad meets them on its way between two dead points, or once round.
    """
    side = int(rng.integers(2)) if side is None else side
    if ordered:
        where, phi = places(*dyads, np.sort(_on_the_way(dyads, rng, count)))
        return np.column_stack([where[side].real, where[side].imag, phi[side]])
    rows = []
    while len(rows) < count:
        drive = rng.uniform(-np.pi, np.pi, 64)
        where, phi = places(*dyads, drive)
        sound = np.isfinite(where[side])
        rows += list(
            zip(where[side][sound].real, where[side][sound].imag, phi[side][sound], strict=True)
        )
    return np.array(rows[:count])


def _on_the_way(dyads, rng, count):
    """Crank angles (count,) at random in the longest stretch without a dead point."""
    sweep = np.linspace(0, 4 * np.pi, 1441)
    sound = np.isfinite(places(*dyads, sweep)[1][0])
    if sound.all():
        return rng.uniform(-np.pi, np.pi) + rng.uniform(0, 2 * np.pi, count)
    edge = np.flatnonzero(np.diff(sound.astype(int)))
    runs = [(a + 1, b) for a, b in pairwise(edge) if sound[a + 1]]
    first, last = max(runs, key=lambda run: run[1] - run[0])
    return rng.uniform(sweep[first], sweep[last], count)


def span(poses):
    """The diagonal of the box that holds the poses' origins."""
    return float(np.hypot(*np.ptp(np.asarray(poses)[:, :2], axis=0)))
