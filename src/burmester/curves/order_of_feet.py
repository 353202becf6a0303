"""Feet in the order of the points: noise may exchange neighbours that lie closer than it."""

from __future__ import annotations

import numpy as np

from burmester.curves.crank_linkages import CrankLinkages
from burmester.numerics.arrays import FloatArray, wrapped_angle

__all__ = ["in_order"]


def in_order(linkages: CrankLinkages, t: FloatArray, *, closed: bool) -> FloatArray:
    """Crank angles (k, n) that never go back, nearest to those of the feet (k, n).

    By the squared way along the curve from the feet: neighbours in the wrong order share a place
    (the pooling of adjacent violators).  Closed, a row that is not one turn stays as it is.
    """
    steps = wrapped_angle(np.diff(t, axis=1, append=t[:, :1]))
    sense = np.where(steps[:, : t.shape[1] - 1].sum(axis=1) < 0, -1.0, 1.0)
    steps = steps * sense[:, None]
    turned = np.abs(steps.sum(axis=1) - 2 * np.pi) < 1e-6
    backwards = (steps if closed else steps[:, :-1]).min(axis=1) < 0
    out = np.array(t)
    for k in np.flatnonzero(backwards & (turned | (not closed))):
        begin = (int(steps[k].argmax()) + 1) % t.shape[1] if closed else 0  # after the longest step
        turn = np.concatenate([np.arange(begin, t.shape[1]), np.arange(begin)])
        along = np.concatenate([[0.0], steps[k, turn[:-1]].cumsum()])
        weight = np.abs(linkages[[k]].at(t[k : k + 1, turn]).velocity[0]) ** 2
        out[k, turn] = t[k, begin] + sense[k] * _pooled(along, weight)
        out[k, :begin] -= sense[k] * 2 * np.pi
    return out


def _pooled(x: FloatArray, weight: FloatArray) -> FloatArray:
    """The numbers (n,) that never fall with the least weighted sum of squares from x (n,)."""
    blocks: list[tuple[float, float, int]] = []  # mean, weight, length
    for value, own in zip(x.tolist(), weight.tolist(), strict=True):
        mean, heavy, length = value, max(own, 1e-300), 1
        while blocks and blocks[-1][0] > mean:
            before, more, count = blocks.pop()
            mean = (before * more + mean * heavy) / (more + heavy)
            heavy, length = more + heavy, length + count
        blocks.append((mean, heavy, length))
    return np.repeat([each[0] for each in blocks], [each[2] for each in blocks])
