"""Tasks whose closest linkage often does not work, and linkages for them by SciPy's SLSQP."""

import numpy as np
from scipy.optimize import minimize

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from tests.oracles.witness import places, random_four_bar

CLEAR = np.radians(5.0)  # what the search keeps from dead points


def sines(first, second, where, phi):
    """Signed sines of the transmission angle, RR or PR follower of an RR driver."""
    turn = np.exp(1j * phi)
    m1, m2 = (np.asarray(dyad.moving_pivot) @ [1, 1j] for dyad in (first, second))
    coupler = (m2 - m1) * turn
    lever = where + m2 * turn - np.asarray(second.fixed_pivot) @ [1, 1j]
    return (np.conj(coupler) * lever).imag / abs(coupler) / abs(lever)


def noisy_task(rng, count, noise=0.04):
    """Poses near places of a random four-bar, in order along a branch; with their linkage."""
    while True:
        dyads = random_four_bar(rng)
        side, reach = int(rng.integers(2)), rng.uniform(1.0, 5.0)
        drive = rng.uniform(-np.pi, np.pi) + np.linspace(0, reach, count) * rng.choice([-1, 1])
        where, phi = (part[side] for part in places(*dyads, np.linspace(drive[0], drive[-1], 200)))
        if not np.isfinite(phi).all():
            continue
        if np.abs(sines(*dyads, where, phi)).min() < np.sin(np.radians(15)):
            continue
        where, phi = (part[side] for part in places(*dyads, drive))
        size = np.sqrt((abs(where - where.mean()) ** 2).mean())
        rows = np.column_stack([where.real, where.imag, np.unwrap(phi)])
        if size < 0.2 or np.ptp(rows[:, 2]) < 0.3:
            continue
        rows += rng.normal(size=rows.shape) * noise * [size, size, 1.0]
        return rows, (Linkage(*dyads), drive)


def rough_task(rng, count):
    """Poses of a wavy path, or of no path at all; no linkage is known."""
    if rng.random() < 0.5:
        at = rng.uniform(-1, 1, (count, 2))
        return np.column_stack([at, rng.uniform(-1.5, 1.5, count)]), None
    phase = 3 * np.linspace(0, 1, count)[:, None] * np.arange(1, 4)
    a, b = rng.normal(size=(2, 3, 3)) / np.arange(1, 4)
    return np.sin(phase) @ a.T + np.cos(phase) @ b.T, None


def drives_of(dyad, rows):
    """The drive's coordinate at places (n, 3)."""
    d, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    if isinstance(dyad, RP):
        return rows[:, 2] + dyad.normal_angle
    pin = d + turn * (dyad.moving_pivot @ [1, 1j])
    if isinstance(dyad, RR):
        return np.angle(pin - dyad.fixed_pivot @ [1, 1j])
    return (pin * np.exp(-1j * dyad.normal_angle)).imag


def assembled(first, second, drive):
    """`places`, for a slot that drives by its angle, too: two assemblies, the same if only one."""
    if not isinstance(first, RP):
        return places(first, second, drive)
    phi = drive - first.normal_angle
    turn, normal = np.exp(1j * phi), np.exp(1j * drive)
    base, along = first.fixed_pivot @ [1, 1j] - first.offset * normal, -1j * normal
    if isinstance(second, RR):
        to = base + turn * (second.moving_pivot @ [1, 1j]) - second.fixed_pivot @ [1, 1j]
        across = (to * along.conj()).real
        with np.errstate(invalid="ignore"):
            root = np.sqrt(second.radius**2 - abs(to) ** 2 + across**2)
        slide = -across + np.stack([root, -root])
    else:
        if isinstance(second, PR):
            force, point = np.exp(1j * second.normal_angle), turn * (second.moving_pivot @ [1, 1j])
            value = (np.conj(force) * (base + point)).real - second.offset
        else:
            force = turn * np.exp(1j * second.normal_angle)
            value = second.offset - (np.conj(force) * (second.fixed_pivot @ [1, 1j] - base)).real
        across = (np.conj(force) * along).real
        slide = np.stack(2 * [-value / across])
        locked = np.diff(np.sign(across), append=np.sign(across[-1])) != 0
        slide[:, locked] = np.nan
    return base + slide * along, np.stack([phi, phi])


def comes_by(found, least=0.0, in_order=True):
    """Whether a usable linkage, swept along its drive, meets its places as it says, in order.

    On one side of `witness.places`, which is followed all the way: monotonically, assembled, the
    sine of the transmission angle never below that of `least`.
    """
    led = found.driver_first
    at = found.error.places
    rows = np.column_stack([at.translation, at.angle])
    drive = drives_of(led.first, rows)
    tries = [drive]
    if isinstance(led.first, RR | RP):
        step = np.diff(drive)
        for sense in (1, -1):
            tries.append(drive[0] + sense * np.append(0, np.cumsum(sense * step % (2 * np.pi))))
        tries.append(np.unwrap(drive))
    size = max(1.0, float(np.ptp(rows[:, :2], axis=0).max()))
    for way in tries:
        step = np.diff(way)
        turns = isinstance(led.first, RR | RP)
        if in_order and not ((step > 0).all() or (step < 0).all()):
            continue
        if turns and np.ptp(way) > 2 * np.pi:
            continue
        sweep = np.linspace(way.min(), way.max(), 4001)
        for side in (0, 1):
            where, phi = (part[side] for part in assembled(led.first, led.second, way))
            gap = np.hypot(
                abs(where - rows[:, :2] @ [1, 1j]), abs(np.exp(1j * (phi - rows[:, 2])) - 1)
            )
            if not (np.nan_to_num(gap, nan=np.inf) < 1e-6 * size).all():
                continue
            where, phi = (part[side] for part in assembled(led.first, led.second, sweep))
            if not np.isfinite(phi).all() or np.abs(np.diff(np.unwrap(phi))).max() > 0.5:
                continue
            if isinstance(led.first, RR) and isinstance(led.second, RR):
                sine = sines(led.first, led.second, where, phi)
                if not (np.abs(sine) > np.sin(least) - 1e-6).all():
                    continue
            return True
    return False


def unit_of(rows, length):
    """Where errors are measured from, and in what."""
    middle = rows[:, :2].mean(axis=0)
    return middle, max(np.sqrt(((rows[:, :2] - middle) ** 2).sum(axis=1).mean()), length)


def squares(found, result):
    """The sum of squared distances of a linkage, in the motion's size."""
    at = result.task.poses
    _, unit = unit_of(np.column_stack([at.translation, at.angle]), result.length_per_radian)
    error = found.error
    return (
        (error.position**2).sum() + result.length_per_radian**2 * (error.angle**2).sum()
    ) / unit**2


def slsqp(  # noqa: PLR0917
    rows, length, linkage, drive=None, clear=CLEAR, steps=200
):
    """SciPy's least sum of squares for an RR driver and an RR follower, under the same conditions.

    Unknowns: ten dimensions, and at each pose the crank's and the coupler's angle.  Between the
    poses the crank is swept in five places.  Returned with whether all conditions hold.
    """
    count = len(rows)
    middle, unit = unit_of(rows, length)
    at, radian = (rows[:, :2] - middle) @ [1, 1j] / unit, length / unit
    start = []
    for dyad in (linkage.first, linkage.second):
        start += [
            *(dyad.fixed_pivot - middle) / unit,
            *dyad.moving_pivot / unit,
            dyad.radius / unit,
        ]
    if drive is None:
        pin = at + np.exp(1j * rows[:, 2]) * (start[2] + 1j * start[3])
        drive = np.unwrap(np.angle(pin - start[0] - 1j * start[1]))
    sense = 1.0 if drive[-1] >= drive[0] else -1.0
    share = np.linspace(0, 1, 5, endpoint=False)

    def seen(v):
        z, crank, phi = v[:10], v[10 : 10 + count], v[10 + count :]
        c, m, c2, m2 = (z[k] + 1j * z[k + 1] for k in (0, 2, 5, 7))
        pin, turn = c + z[4] * np.exp(1j * crank), np.exp(1j * phi)
        coupler = (m2 - m) * turn
        lever = pin + coupler - c2
        sine = (np.conj(coupler) * lever).imag / abs(coupler) / abs(lever)
        every = crank[:-1, None] + share * np.diff(crank)[:, None]
        away = abs(c + z[4] * np.exp(1j * every) - c2).ravel()
        arm = abs(m2 - m)
        cosine = (arm**2 + z[9] ** 2 - away**2) / (2 * arm * z[9])
        return z, crank, phi, pin - m * turn, abs(lever) - z[9], sine, cosine

    v = np.concatenate([start, drive, rows[:, 2]])
    sign = np.sign(np.median(seen(v)[5]))

    def cost(v):
        _, _, phi, d, *_ = seen(v)
        return (abs(d - at) ** 2).sum() + radian**2 * ((phi - rows[:, 2]) ** 2).sum()

    def closed(v):
        return seen(v)[4]

    def kept(v):
        z, crank, _, _, _, sine, cosine = seen(v)
        step = sense * np.diff(crank)
        return np.concatenate(
            [
                sign * sine - np.sin(clear),
                np.cos(clear) - abs(cosine),
                step - 2e-3,
                [2 * np.pi - 2e-3 - step.sum(), z[4] - 1e-3, z[9] - 1e-3],
            ]
        )

    with np.errstate(all="ignore"):
        end = minimize(
            cost,
            v,
            method="SLSQP",
            constraints=[{"type": "eq", "fun": closed}, {"type": "ineq", "fun": kept}],
            options={"maxiter": steps, "ftol": 1e-13},
        )
    ok = np.isfinite(end.x).all() and abs(closed(end.x)).max() < 1e-7 and kept(end.x).min() > -1e-7
    return float(end.fun), bool(ok)


def known_cost(rows, known, length=None):
    """The least sum of squares that SciPy comes to from the linkage that made the poses."""
    length = synthesis_length(rows) if length is None else length
    value, ok = slsqp(rows, length, *known)
    return value if ok else np.inf


def synthesis_length(rows):
    return float(CanonicalFrames.of(Displacement.from_poses(rows))[0].length)
