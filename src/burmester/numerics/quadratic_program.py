"""Quadratic programs with soft conditions, many at once: the step of a descent under conditions.

min over s of  s · H s / 2 + c · s + sum of rho |w_i| over equalities + rho max(0, w_i) over the
others, with w = g + G s.  It always has a solution; for rho large enough it keeps all conditions
that can be kept together.

Solved in its multipliers y, each within 0 and rho (-rho and rho for equalities), by a primal-dual
interior-point method (Wright, Primal-dual interior-point methods, SIAM 1997).
"""

from __future__ import annotations

import numpy as np

from burmester.numerics.arrays import FloatArray

__all__ = ["soft_step"]

STEPS = 14
CENTRED = 0.1  # of the gap, that is aimed at in a step
SHORT = 0.99  # of the way to the nearest bound
TINY = 1e-15  # of the width, that a multiplier keeps off its bounds
STIFFEST = 1e12  # of a condition against a multiplier's room
ROUNDING = 1e-14  # relative


def soft_step(  # noqa: PLR0917
    bowl: FloatArray,
    pull: FloatArray,
    value: FloatArray,
    slope: FloatArray,
    low: FloatArray,
    high: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """The solutions s (k, n) and multipliers y (k, m) of programs (k,).

    bowl: (k, n, n), H, positive definite; pull: (k, n), c; value: (k, m), g; slope: (k, m, n), G;
    low, high: (k, m), the bounds of the multipliers.
    """
    back = np.swapaxes(slope, -1, -2)
    if not value.shape[1]:
        return _solved(bowl, -pull), np.zeros_like(value)

    def best(y: FloatArray) -> FloatArray:
        return -_solved(bowl, pull + _times(back, y))

    width, eye = high - low, np.eye(bowl.shape[-1])
    y = np.where(low < 0, 0.0, 0.1 * high)
    w = value + _times(slope, best(y))
    # u - v = w all along: what presses a multiplier against its upper and its lower bound.
    start = 0.01 + 0.1 * np.abs(w)
    u = np.maximum(w, 0.0) + start
    v = u - w
    for _ in range(STEPS):
        u, v = np.maximum(u, TINY), np.maximum(v, TINY)
        top, bottom = (np.maximum(room, TINY * width) for room in (high - y, y - low))
        aim = CENTRED * (u * top + v * bottom).mean(axis=1, keepdims=True) / 2
        loose = np.minimum(1 / (u / top + v / bottom), STIFFEST)
        free = loose * (u - v - aim / top + aim / bottom)
        inner = bowl + back @ (loose[..., None] * slope)
        inner = inner + (ROUNDING * np.einsum("kii->k", inner))[:, None, None] * eye
        dy = free - loose * _times(slope, _solved(inner, _times(back, free)))
        du, dv = (aim + u * dy) / top - u, (aim - v * dy) / bottom - v
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ways = [top / np.maximum(dy, 0.0), bottom / np.maximum(-dy, 0.0)]
            ways += [u / np.maximum(-du, 0.0), v / np.maximum(-dv, 0.0)]
        reach = np.min(ways, axis=(0, 2))
        part = np.minimum(1.0, SHORT * reach)[:, None]
        y, u, v = y + part * dy, u + part * du, v + part * dv
    return best(y), y


def _times(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    return np.asarray((matrix @ vector[..., None])[..., 0])


def _solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
