"""Circles through poses by SciPy, by distances to first order."""

import numpy as np
from scipy.optimize import least_squares


def least_sum(odd, poses):
    """The least sum of squared distances of a pair of circles, to first order, by SciPy."""
    d, turn = poses.translation @ [1, 1j], np.exp(1j * poses.angle)

    def residual(z):
        forces, gaps = [], []
        for c1, c2, m1, m2, r in z.reshape(2, 5):
            arm = d + turn * (m1 + 1j * m2) - c1 - 1j * c2
            along = arm / abs(arm)
            moment = (np.conj(1j * turn * (m1 + 1j * m2)) * along).real / odd.length
            forces.append(np.stack([along.real, along.imag, moment], axis=-1))
            gaps.append(abs(arm) - r)
        force, gap = np.stack(forces, axis=1), np.stack(gaps, axis=1)
        lower = np.linalg.cholesky(force @ np.swapaxes(force, 1, 2))
        return np.linalg.solve(lower, gap[..., None]).ravel()

    dyads = odd.linkage.first, odd.linkage.second
    start = np.concatenate([[*d.fixed_pivot, *d.moving_pivot, d.radius] for d in dyads])
    end = least_squares(residual, start, x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return 2 * end.cost
