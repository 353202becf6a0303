"""What SciPy's solvers are given for functions: the output of a four-bar, and its derivatives.

Parameters v (5,): logarithms of the lengths of input link, coupler and output link beside a ground
link of 1, the angle of the input link at its zero, and that of the output link.
"""

from __future__ import annotations

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar

NEAR_DEAD = 1e-3  # of the cosine between diagonal and output link: where a linkage is shut


def made(
    v: np.ndarray, side: float, inputs: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Output angles (*, N) of linkages v (*, 5), unwrapped from the first; and their cosines.

    Also the diagonals to the input's pin, and the sines.
    """
    a, r, b = np.exp(np.moveaxis(v[..., :3], -1, 0))[..., None]
    to = a * np.exp(1j * (v[..., 3:4] + inputs)) - 1
    size = np.maximum(abs(to), 1e-12)
    cosine = (b**2 + size**2 - r**2) / (2 * b * size)
    opening = np.arccos(np.clip(cosine, -1, 1))
    return np.unwrap(np.angle(to) + side * opening), cosine, to, np.sin(opening)


def errors(v: np.ndarray, side: float, pairs: np.ndarray) -> np.ndarray:
    """By how much the outputs are off (N,), the zero of the output link v[4] taken off."""
    off = made(v, side, pairs[:, 0])[0] - pairs[:, 1] - v[4]
    return off - 2 * np.pi * np.round(off[0] / (2 * np.pi))


def by_parameters(v: np.ndarray, side: float, pairs: np.ndarray) -> np.ndarray:
    """The derivatives (N, 5) of these errors."""
    r, b = np.exp(v[1:3])
    _, cosine, to, sine = made(v, side, pairs[:, 0])
    size = np.maximum(abs(to), 1e-12)
    pin = to + 1
    out = np.zeros((len(pairs), 5))
    steep = -side / np.maximum(sine, 1e-3)  # of the opening by the cosine
    by_size = 1 / b - cosine / size
    for column, move in ((0, pin), (3, 1j * pin)):
        longer = (np.conj(to) * move).real / size
        out[:, column] = (move / to).imag + steep * by_size * longer
    out[:, 1] = steep * -(r**2) / (b * size)
    out[:, 2] = steep * (b / size - cosine)
    out[:, 4] = -1
    return out


def start(rng: np.random.Generator, side: float, pairs: np.ndarray) -> np.ndarray:
    """A linkage at random that goes through the whole range, its output's zero the best."""
    while True:
        v = np.append(rng.uniform(-1.5, 1.5, 3), [rng.uniform(-np.pi, np.pi), 0.0])
        output, cosine, _, _ = made(v, side, pairs[:, 0])
        if abs(cosine).max() < 1:
            v[4] = (output - pairs[:, 1]).mean()
            return v


def minimax(v: np.ndarray, side: float, pairs: np.ndarray) -> tuple[float, np.ndarray]:
    """The greatest error made least by SLSQP, the linkage shut over the whole range."""
    from scipy.optimize import minimize

    def kept(u: np.ndarray) -> np.ndarray:
        e, cosine = errors(u[:5], side, pairs), made(u[:5], side, pairs[:, 0])[1]
        room = 1 - NEAR_DEAD
        return np.concatenate([u[5] - e, u[5] + e, room - cosine, room + cosine])

    def slope(u: np.ndarray) -> np.ndarray:
        by = by_parameters(u[:5], side, pairs)
        one = np.ones((len(by), 1))
        r, b = np.exp(u[1:3])
        _, cosine, to, _ = made(u[:5], side, pairs[:, 0])
        size, pin = np.maximum(abs(to), 1e-12), to + 1
        by_size = 1 / b - cosine / size
        turn = np.zeros((len(by), 6))
        for column, move in ((0, pin), (3, 1j * pin)):
            turn[:, column] = by_size * (np.conj(to) * move).real / size
        turn[:, 1], turn[:, 2] = -(r**2) / (b * size), b / size - cosine
        return np.concatenate([np.hstack([-by, one]), np.hstack([by, one]), -turn, turn])

    u = np.append(v, abs(errors(v, side, pairs)).max())
    end = minimize(
        lambda u: u[5],
        u,
        jac=lambda u: np.eye(6)[5],
        method="SLSQP",
        constraints={"type": "ineq", "fun": kept, "jac": slope},
        bounds=[(-5, 5)] * 3 + [(None, None)] * 3,
        options={"maxiter": 200, "ftol": 1e-10},
    )
    better = end.x if np.isfinite(end.x).all() and kept(end.x).min() > -1e-6 else u
    return float(abs(errors(better[:5], side, pairs)).max()), better[:5]


def four_bar(v: np.ndarray) -> FourBar:
    """The linkage, M being the coupler at the input pin, its x axis to the output pin."""
    a, r, b = np.exp(v[:3])
    return FourBar(Dyad("RR", 0j, 0j, float(a)), Dyad("RR", 1 + 0j, complex(r), float(b)))
