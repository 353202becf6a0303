"""Four-bars through poses and points from random starts, by Levenberg and Marquardt's method.

Real pivots and angles, and the equations of equal link lengths: nothing is shared with the paths of
the package, which are complex.
"""

import numpy as np

MET = 1e-10  # greatest difference of squared lengths, in squares of the size of the task
LEAST = 1e-3  # two dyads with pivots nearer than this are one
FARTHEST = 50.0  # sizes of the task; beyond it random starts run off
STEPS = 300


def pivots_from_random_starts(positions, angles, is_point, starts, rng):
    """The pivots (k, 2, 4) of linkages, rows fixed x, y, moving x, y; not each of them once.

    positions: (N,), complex, about 1 in size; angles: (N,), those at points do not count.
    """
    free = np.flatnonzero(is_point)
    if is_point.all():
        free = free[1:]  # the first angle is that of the frame
    turn = np.where(is_point, 0.0, angles)
    y = np.concatenate(
        [2 * rng.normal(size=(starts, 8)), rng.uniform(-np.pi, np.pi, (starts, len(free)))], axis=1
    )
    damping = np.full(starts, 1e-2)
    r, slope = _gaps(y, positions, turn, free)
    for _ in range(STEPS):
        normal = np.swapaxes(slope, 1, 2) @ slope
        scale = np.einsum("kii->ki", normal) + 1e-12
        normal[:, np.arange(y.shape[1]), np.arange(y.shape[1])] += damping[:, None] * scale
        step = np.linalg.solve(normal, (np.swapaxes(slope, 1, 2) @ r[..., None]))[..., 0]
        new, new_slope = _gaps(y - step, positions, turn, free)
        better = (new**2).sum(axis=1) < (r**2).sum(axis=1)
        y, r = np.where(better[:, None], y - step, y), np.where(better[:, None], new, r)
        slope = np.where(better[:, None, None], new_slope, slope)
        damping = np.where(better, np.maximum(damping / 5, 1e-15), np.minimum(damping * 3, 1e6))
    pivots = y[:, :8].reshape(-1, 2, 2, 2)  # fixed or moving, dyad, x or y
    apart = np.linalg.norm(pivots[:, :, 1] - pivots[:, :, 0], axis=-1).min(axis=1)
    near = np.abs(pivots).max(axis=(1, 2, 3)) < FARTHEST
    sound = (np.abs(r).max(axis=1) < MET) & (apart > LEAST) & near
    return np.concatenate([pivots[:, 0], pivots[:, 1]], axis=-1)[sound]


def _gaps(y, positions, turn, free):
    """Differences (k, 2 (N - 1)) of squared lengths from the first, and their derivatives."""
    fixed, moving = (y[:, :8].reshape(-1, 2, 2, 2) @ [1, 1j])[..., None].transpose(1, 0, 2, 3)
    angle = np.broadcast_to(turn, (len(y), len(turn))).copy()
    angle[:, free] = y[:, 8:]
    unit = np.exp(1j * angle)[:, None]
    way = positions + unit * moving - fixed  # start, dyad, position
    square = np.abs(way) ** 2
    rows = np.zeros((*way.shape, y.shape[1]))
    for dyad in range(2):
        back, own = way[:, dyad].conj(), unit[:, 0]
        rows[:, dyad, :, 2 * dyad] = -2 * back.real
        rows[:, dyad, :, 2 * dyad + 1] = -2 * (1j * back).real
        rows[:, dyad, :, 4 + 2 * dyad] = 2 * (back * own).real
        rows[:, dyad, :, 5 + 2 * dyad] = 2 * (1j * back * own).real
        for column, place in enumerate(free, start=8):
            turned = 1j * own[:, place] * moving[:, dyad, 0]
            rows[:, dyad, place, column] = 2 * (back[:, place] * turned).real
    gaps, slopes = square[:, :, 1:] - square[:, :, :1], rows[:, :, 1:] - rows[:, :, :1]
    count = 2 * (len(turn) - 1)
    return gaps.reshape(-1, count), slopes.reshape(-1, count, y.shape[1])


def lacking(known, pivots, same):
    """The pivots (k, 2, 4) that no known linkage (n, 2, 4) has, in either order of the dyads."""
    both = np.concatenate([known, known[:, ::-1]])
    if not len(both):
        return pivots
    size = 1 + np.abs(pivots).max(axis=(1, 2))
    gap = np.abs(both[None] - pivots[:, None]).max(axis=(2, 3)).min(axis=1)
    return pivots[gap > same * size]
