"""Four-bars that turn their coupler little, made with forty digits: tasks with two known dyads.

No code of the package.  All is in complex numbers: a dyad is (c, m, r), a pose d, e^{i angle}.
"""

from typing import NamedTuple

import mpmath
import numpy as np
from scipy.optimize import least_squares

DIGITS = (3, 4, 5, 6, 8, 10, 12, 16, 16, 16)  # decimals of the poses; 16 are all of a double
NEAR = 1e-3  # of a dyad's size; nearer than that, it is the same
ONE = 1e-2  # of a dyad's size; two ends of SciPy's in a flat valley that are nearer are one
LEAST_SINE = 0.3  # of the transmission angle at the start
ULP = float(np.finfo(float).eps)


class SmallTurn(NamedTuple):
    """A task: rows (N, 3) of x, y and radians, and the two dyads (c, m, r) that made them.

    sweep: of the crank, in radians; apart: from a parallelogram, a share; 0 for any four-bar.
    """

    rows: np.ndarray
    resolution: float
    dyads: list
    sweep: float
    apart: float


def small_turn(rng):
    """A random task: any four-bar through a small sweep, or nearly a parallelogram."""
    while True:
        near = rng.random() < 1 / 3
        apart = 10 ** rng.uniform(-3, -1) if near else 0.0
        sweep = rng.uniform(0.5, 2.0) if near else 10 ** rng.uniform(-2, np.log10(0.5))
        pins = near_parallelogram(rng, apart) if near else any_four_bar(rng)
        if pins is None:
            continue
        count = int(rng.integers(5, 31))
        where = np.concatenate([[0, 1], rng.random(count - 2)]) if count < 8 else evenly(rng, count)
        poses = driven(rng, pins, sweep * np.sort(where))
        if poses is not None:
            digits = int(rng.choice(DIGITS))
            rows, dyads = poses
            rows = rows if digits == 16 else np.round(rows, digits)
            return SmallTurn(rows, 0.5 * 10.0**-digits * (digits < 16), dyads, sweep, apart)


def evenly(rng, count):
    """Places in [0, 1], nearly evenly spaced."""
    inner = (np.arange(1, count - 1) + 0.3 * rng.uniform(-1, 1, count - 2)) / (count - 1)
    return np.concatenate([[0], inner, [1]])


def any_four_bar(rng):
    """Pivots c1, c2 and pins p1, p2 at the start; None where links are short or the angle bad."""
    c1, c2, p1, p2 = rng.normal(size=(4, 2)) @ [1, 1j]
    links = [p1 - c1, p2 - c2, c2 - c1, p2 - p1]
    coupler, lever = links[3], links[1]
    sine = abs((np.conj(coupler) * lever).imag) / abs(coupler) / abs(lever)
    return (c1, c2, p1, p2) if min(map(abs, links)) > 0.3 and sine > LEAST_SINE else None


def near_parallelogram(rng, apart):
    """The same, with opposite links that are equal but for a share."""
    angle, ground = rng.uniform(0.5, 1.1), rng.uniform(0.7, 2.0)
    off = rng.choice([-1, 1], 2) * rng.uniform(0.3, 1, 2) * apart
    p1, r, coupler = np.exp(1j * angle), 1 + off[0], ground * (1 + off[1])
    # The follower's pin: at a distance from both p1 and c2, on the parallelogram's side.
    to = ground - p1
    cosine = (abs(to) ** 2 + coupler**2 - r**2) / (2 * abs(to) * coupler)
    if abs(cosine) >= 1:
        return None
    p2 = p1 + coupler * to / abs(to) * np.exp(1j * np.arccos(cosine))
    return 0.0, ground, p1, p2


def driven(rng, pins, turns):
    """Rows (N, 3) of a coupler, its crank turned by `turns`, and both dyads; or None."""
    with mpmath.workdps(40):
        c1, c2, p1, p2 = (mpmath.mpc(complex(p)) for p in pins)
        body = mpmath.expj(rng.uniform(-3, 3))
        origin = mpmath.mpc(*rng.normal(size=2))
        coupler, r2 = p2 - p1, abs(p2 - c2)
        m1, m2 = (p1 - origin) / body, (p2 - origin) / body
        side = mpmath.sign(((c2 - p1) * mpmath.conj(coupler)).imag)
        rows = []
        for turn in turns:
            pin = c1 + (p1 - c1) * mpmath.expj(float(turn))
            to = c2 - pin
            cosine = (abs(to) ** 2 + abs(coupler) ** 2 - r2**2) / (2 * abs(to) * abs(coupler))
            if abs(cosine) > 0.999:
                return None
            now = abs(coupler) * to / abs(to) * mpmath.expj(-side * mpmath.acos(cosine))
            rotation = now / coupler
            where = pin + rotation * (origin - p1)
            rows.append([where.real, where.imag, mpmath.arg(rotation * body)])
        rows = np.array([[float(x) for x in row] for row in rows])
        rows[:, 2] = np.unwrap(rows[:, 2])
        links = abs(p1 - c1), r2
        made = zip((c1, c2), (m1, m2), links, strict=True)
        return rows, [(complex(c), complex(m), float(r)) for c, m, r in made]


# --- what is known of the planted dyads at the poses as given


def distances(x, rows):
    """|R m + d - c| - r at the poses; x = c1, c2, m1, m2, r."""
    d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    return abs(t * (x[2] + 1j * x[3]) + d - (x[0] + 1j * x[1])) - x[4]


def planted_rms(task):
    """The rms (2,) of both planted dyads at the poses as given, rising, with the dyads (2, 5).

    Each is fitted to these poses by SciPy, if that makes it better.
    """
    found = []
    for c, m, r in task.dyads:
        x = np.array([c.real, c.imag, m.real, m.imag, r])
        end = x
        if task.resolution:
            exact = {"method": "lm", "xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15, "max_nfev": 4000}
            end = least_squares(distances, x, args=(task.rows,), x_scale="jac", **exact).x
        both = [(np.sqrt((distances(y, task.rows) ** 2).mean()), y) for y in (x, end)]
        found.append((*min(both, key=lambda pair: pair[0]), x))
    found.sort(key=lambda each: each[0])
    return [np.array(part) for part in zip(*found, strict=True)]


def moved_by_rounding(task):
    """How far one unit in the last place of all poses moves the dyads (2,), to first order."""
    d, t = task.rows[:, 0] + 1j * task.rows[:, 1], np.exp(1j * task.rows[:, 2])
    moved = []
    for c, m, r in task.dyads:
        u = (t * m + d - c) / r
        arm = np.conj(u) * t
        rows = np.stack([-u.real, -u.imag, arm.real, -arm.imag, -np.ones(len(d))], axis=1)
        moved.append(ULP * (1 + abs(m)) / np.linalg.svd(rows, compute_uv=False)[-1])
    return np.array(moved)


def verdicts(task, listed):
    """What became of both planted dyads: "listed", "as good" or "lost".

    listed: rows (k, 6), c, m, r and the rms distance as it is claimed; c, m, r are nan of sliders.
    Where both lead to one minimum of these poses, that is asked for.  A dyad is as good if one
    stands in its place of the order whose rms is no greater, or no greater
    than what the rounding of the poses makes of the planted one's distances.
    """
    rms, fitted, made = planted_rms(task)
    listed = listed[np.argsort(listed[:, 5], kind="stable")] if len(listed) else np.empty((0, 6))
    result = []
    one = np.abs(fitted[0] - fitted[1]).max() < ONE * (1 + np.abs(fitted).max())
    for k, place in enumerate((0, 0) if one else (0, 1)):
        size = 1 + np.abs(made[k]).max()
        near = [np.abs(listed[:, :5] - x).max(axis=1, initial=0) for x in (made[k], fitted[k])]
        # Numbers rounded to their last digit err evenly within half of it.
        digits = task.resolution / np.sqrt(3) * np.hypot(1, abs(complex(*made[k][2:4])))
        rounding = 4 * ULP * (size + np.abs(task.rows).max())
        if (np.minimum(*near) < NEAR * size).any():
            result.append("listed")
        elif (
            len(listed) > place and listed[place, 5] <= max(rms[k] * (1 + 1e-4), digits) + rounding
        ):
            result.append("as good")
        else:
            result.append("lost")
    return result
