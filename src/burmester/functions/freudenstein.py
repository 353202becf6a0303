"""Freudenstein's equation: linear in three ratios of the links.

    R1 cos(phi) - R2 cos(theta) + R3 = cos(theta - phi),
    R1 = 1 / a,  R2 = 1 / b,  R3 = (1 + a² + b² - r²) / (2 a b)

with the input link a at the angle theta, the output link b at phi, the coupler r, and the ground
link as unit.  F. Freudenstein, Approximate synthesis of four-bar linkages, Transactions of the ASME
77 (1955), 853-861.
"""

from __future__ import annotations

import numpy as np

from burmester.functions.generator import Generator
from burmester.numerics.arrays import FloatArray


def rows(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """The equation's terms (*, N, 4) at link angles (*, N): of R1, R2 and R3, and the right side.

    Formula `freudenstein` of the theory.
    """
    theta, phi = np.broadcast_arrays(theta, phi)
    terms = [np.cos(phi), -np.cos(theta), np.ones_like(phi), np.cos(theta - phi)]
    return np.stack(terms, axis=-1)


def ratios(
    theta: FloatArray, phi: FloatArray, weights: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """The ratios (*, 3) of the least squared residual at angles (*, N), and the rank's measure.

    The second is the least singular value (*,) of the equations, of unit columns: as it vanishes,
    infinitely many ratios do.
    """
    every = rows(theta, phi)
    if weights is not None:
        every = every * np.sqrt(weights)[:, None]
    left, right = every[..., :3], every[..., 3]
    columns = np.linalg.norm(left, axis=-2, keepdims=True)
    columns = np.where(columns > 0, columns, 1.0)
    u, s, vt = np.linalg.svd(left / columns, full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        solved = (np.swapaxes(u, -1, -2) @ right[..., None])[..., 0] / s
    x = (np.swapaxes(vt, -1, -2) @ solved[..., None])[..., 0] / columns[..., 0, :]
    return x, s[..., -1]


def generators_of_ratios(
    ratio: FloatArray, input_phase: FloatArray, output_phase: FloatArray
) -> Generator:
    """The linkages (*,) of ratios (*, 3); nan where a length is infinite or not real.

    A negative length is the link drawn the other way: its phase changes by half a turn.
    """
    input_phase, output_phase, _ = np.broadcast_arrays(input_phase, output_phase, ratio[..., 0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        a, b = 1 / ratio[..., 0], 1 / ratio[..., 1]
        coupler = np.sqrt(1 + a * a + b * b - 2 * a * b * ratio[..., 2])
    fine = np.isfinite(a) & np.isfinite(b) & np.isfinite(coupler)
    a, b, coupler = (np.where(fine, each, np.nan) for each in (a, b, coupler))
    return Generator(
        np.abs(a),
        coupler,
        np.abs(b),
        input_phase + np.pi * (a < 0),
        output_phase + np.pi * (b < 0),
        np.ones_like(a),
    )
