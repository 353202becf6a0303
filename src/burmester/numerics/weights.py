"""Weights of observations: the default, and what they are scaled to."""

from __future__ import annotations

import numpy as np

from burmester.numerics.arrays import FloatArray


def weights_or_ones(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights as they are, broadcast to a shape; ones where there are none."""
    return np.ones(shape) if weights is None else np.broadcast_to(weights, shape)


def shares(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights (*, N) over their sum, so that those of the last axis add up to 1."""
    whole = weights_or_ones(weights, shape)
    return np.asarray(whole / whole.sum(axis=-1, keepdims=True))


def weights_of_mean_one(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights (*, N) over their mean, so that a sum over the last axis is as without weights."""
    whole = weights_or_ones(weights, shape)
    return np.asarray(whole / whole.mean(axis=-1, keepdims=True))
