"""Nearest places by brute force: each circuit of a linkage as a curve, looked at closely.

A drive is swept, the places come from the witness, and runs of the drive between its dead points
are the circuits: where a run ends both assemblies meet.  Shares no code with the package.
"""

import numpy as np

from burmester.fourbar.dyad import RP, RR
from tests.oracles.tracer import constraint, driven
from tests.oracles.witness import places

SWEEP, LOOKS, ZOOMS = 8000, 1500, 9  # drives tried; places of a circuit; times looked closer
FAR = 60.0  # a rail's end


class TooFineError(Exception):
    """The sweep does not tell the circuits apart."""


class Circuit:
    """One circuit: rows (x, y, angle) at parameters t, all that it has between `low` and `high`."""

    def __init__(self, dyads, drive, side, low, high):
        self.dyads, self.drive, self.side, self.low, self.high = dyads, drive, side, low, high

    def rows(self, t):
        where, phi = places(*self.dyads, self.drive(t))
        second = self.side(t).astype(bool)
        where, phi = (np.where(second, x[1], x[0]) for x in (where, phi))
        return np.stack([where.real, where.imag, phi], axis=-1)

    def gaps(self, rows, poses, length):
        """Rows (N, n, 3) beside poses (N, 3): distances (N, n)."""
        gap = rows - poses[:, None]
        turn = np.angle(np.exp(1j * gap[..., 2]))
        out = np.sqrt(gap[..., 0] ** 2 + gap[..., 1] ** 2 + (length * turn) ** 2)
        return np.nan_to_num(out, nan=np.inf)

    def nearest(self, poses, length, valleys=8):
        """The least distances (N,), from every valley of many places, looked at closer and closer.

        As good as 1e-7: a sweep that ends at a dead point is blind there.
        """
        t = np.linspace(self.low, self.high, LOOKS)
        away = self.gaps(self.rows(t)[None], poses, length)
        walls = np.pad(away, ((0, 0), (1, 1)), constant_values=np.inf)
        valley = np.where((away <= walls[:, :-2]) & (away <= walls[:, 2:]), away, np.inf)
        best = t[np.argsort(valley, axis=1)[:, :valleys]].reshape(-1)
        again = np.repeat(poses, valleys, axis=0)
        step = t[1] - t[0]
        for _ in range(ZOOMS):
            near = best[:, None] + step * np.linspace(-1, 1, 21)
            near = np.clip(near, self.low, self.high)
            away = self.gaps(self.rows(near), again, length)
            at = away.argmin(axis=1)
            best, step = near[np.arange(len(near)), at], step / 8
        return away.min(axis=1).reshape(len(poses), valleys).min(axis=1)


def circuits(first, second):
    """The circuits of two dyads, and a function that says on which one places (n, 3) are."""
    if not isinstance(first, RR) and isinstance(second, RR):
        first, second = second, first
    dyads, turns = (first, second), isinstance(first, RR)
    sweep = (
        np.linspace(-np.pi, np.pi, SWEEP + 1)
        if turns
        else (FAR * np.linspace(-1, 1, SWEEP + 1) ** 3)
    )

    def there(drive):
        return np.isfinite(places(*dyads, np.atleast_1d(drive))[1][0])

    sound = there(sweep)
    if turns:
        sound[-1] = sound[0]
    out = []
    if sound.all():
        for side in (0, 1):
            out.append(
                Circuit(
                    dyads, lambda t: t, lambda t, s=side: np.full(t.shape, s), sweep[0], sweep[-1]
                )
            )
        runs = [(sweep[0], sweep[-1], [0, 1])]
    else:
        runs = []
        edge = np.flatnonzero(sound[1:] != sound[:-1])
        if len(edge) > 1 and np.diff(edge).min() < 4:
            raise TooFineError
        ends = [_end(there, sweep[e], sweep[e + 1], sound[e]) for e in edge]
        opens = [e for e, k in zip(ends, edge, strict=True) if not sound[k]]
        shuts = [e for e, k in zip(ends, edge, strict=True) if sound[k]]
        if sound[0]:
            if turns:  # the run over the seam
                shuts = [*shuts[1:], shuts[0] + 2 * np.pi]
            else:
                opens = [-np.inf, *opens]
        if not turns and sound[-1]:
            shuts = [*shuts, np.inf]
        for low, high in zip(opens, shuts, strict=True):
            runs.append((low, high, [len(out)] * 2))
            out.append(_between(dyads, low, high))

    def which(rows):
        drive = drive_at(first, rows)
        if turns:
            drive = np.mod(drive + np.pi, 2 * np.pi) - np.pi
        where, phi = places(*dyads, drive)
        gap = np.abs(where - (rows[:, 0] + 1j * rows[:, 1])) + np.abs(
            np.exp(1j * phi) - np.exp(1j * rows[:, 2])
        )
        side = np.nan_to_num(gap, nan=np.inf).argmin(axis=0)
        found = np.full(len(rows), -1)
        for low, high, numbers in runs:
            for turn in (0.0, 2 * np.pi) if turns else (0.0,):
                inside = (drive + turn >= low - 1e-9) & (drive + turn <= high + 1e-9)
                found = np.where(inside, np.array(numbers)[side], found)
        return found

    return out, which


def drive_at(dyad, rows):
    """What drives a dyad: an angle, or a length along the rail or the slot."""
    if not isinstance(dyad, RP):
        return driven(dyad, rows)
    body = (dyad.fixed_pivot @ [1, 1j] - rows[:, 0] - 1j * rows[:, 1]) * np.exp(-1j * rows[:, 2])
    return (body * np.exp(-1j * dyad.normal_angle)).imag


def _end(there, a, b, inside):
    """Where runs end between drives a and b, by halving, on the inner side."""
    for _ in range(60):
        middle = (a + b) / 2
        if there(middle)[0] == inside:
            a = middle
        else:
            b = middle
    return a if inside else b


def _between(dyads, low, high):
    """A circuit that goes from one dead point to the other and back on the other assembly."""
    if np.isfinite(low) and np.isfinite(high):
        middle, half = (low + high) / 2, (high - low) / 2
        return Circuit(
            dyads,
            lambda t: middle - half * np.cos(t),
            lambda t: np.sin(t) < 0,
            0.0,
            2 * np.pi,
        )
    far = np.sqrt(2 * FAR)
    if np.isfinite(low):
        return Circuit(dyads, lambda t: low + t * t, lambda t: t < 0, -far, far)
    return Circuit(dyads, lambda t: high - t * t, lambda t: t < 0, -far, far)


def on_both(dyads, rows):
    """The greatest miss of both dyads' equations at rows (n, 3)."""
    return max(np.abs(constraint(dyad, rows)[0]).max() for dyad in dyads)
