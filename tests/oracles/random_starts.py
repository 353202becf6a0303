"""Local fits of a dyad from random starts, all at once, with no code of the package.

The pivots x = (c1, c2, m1, m2); poses are complex d = x + i y and t = e^{i angle}.  A residual
gives its values f (k, N), their derivatives (k, N, 4) and the sum of f f'' (k, 4, 4).
"""

import numpy as np

FAR = 1e3  # a start that went farther is on its way to a slider


def squared(x, d, t):
    """|R m + d - c|² less its mean."""
    arm, slope = arms(x, d, t)
    value = abs(arm) ** 2
    value = value - value.mean(axis=1, keepdims=True)
    turn = -2 * value @ t
    bend = np.zeros((len(x), 4, 4))
    bend[:, :2, 2:] = np.array([[turn.real, -turn.imag], [turn.imag, turn.real]]).transpose(2, 0, 1)
    bend += bend.transpose(0, 2, 1)
    slope = 2 * (slope * arm.conj()[:, :, None]).real
    return value, slope - slope.mean(axis=1, keepdims=True), bend


def distance(x, d, t):
    """|R m + d - c| less its mean."""
    arm, slope = arms(x, d, t)
    length = np.maximum(abs(arm), 1e-300)
    value = length - length.mean(axis=1, keepdims=True)
    slope = slope * (arm / length).conj()[:, :, None]
    bend = np.einsum("kn,kni,knj->kij", value / length, slope.imag, slope.imag)
    slope = slope.real
    return value, slope - slope.mean(axis=1, keepdims=True), bend


def arms(x, d, t):
    """R m + d - c (k, N), complex, and its derivatives (k, N, 4)."""
    arm = t * (x[:, 2:3] + 1j * x[:, 3:]) + d - (x[:, :1] + 1j * x[:, 1:2])
    slope = np.stack(np.broadcast_arrays(-1.0, -1j, t, 1j * t), axis=-1)
    return arm, np.broadcast_to(slope, (*arm.shape, 4))


def local_fits(residual, x, d, t, rounds=300):
    """Where starts x (k, 4) come to rest, and the rms there; the others are left out.

    Newton's method with the curvature made positive and damped, as Levenberg and Marquardt do.
    """
    x, damping = x.copy(), np.full(len(x), 1e-2)
    rest, rms = np.zeros(len(x), dtype=bool), np.full(len(x), np.inf)
    for _ in range(rounds):
        run = np.flatnonzero(~rest)
        if not len(run):
            break
        f, j, bend = residual(x[run], d, t)
        cost = (f**2).mean(axis=1)
        curvature, axes = np.linalg.eigh(j.transpose(0, 2, 1) @ j + bend)
        curvature = abs(curvature) + damping[run, None] * abs(curvature).max(axis=1, keepdims=True)
        pull = (axes * (j * f[:, :, None]).sum(axis=1)[:, :, None]).sum(axis=1)
        step = -(axes @ (pull / np.maximum(curvature, 1e-300))[:, :, None])[:, :, 0]
        after = (residual(x[run] + step, d, t)[0] ** 2).mean(axis=1)
        better = after <= cost
        x[run[better]] += step[better]
        damping[run] = np.where(better, damping[run] / 10, damping[run] * 4).clip(1e-16, 1e16)
        rms[run] = np.sqrt(np.where(better, after, cost))
        small = np.linalg.norm(step, axis=1) < 1e-9 * (1 + np.linalg.norm(x[run], axis=1))
        stuck = ~better & (small | (damping[run] > 1e8))
        rest[run] = small & (damping[run] < 1e-3) | stuck
        rest[run[np.abs(x[run]).max(axis=1) > 10 * FAR]] = True
    near = rest & (np.abs(x).max(axis=1) < FAR)
    return x[near], rms[near]
