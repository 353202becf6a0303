"""The least values of many functions of one number at once, by the golden section."""

import numpy as np

SHARE = (np.sqrt(5) - 1) / 2
STEPS = 52  # which leave 1e-11 of the bounds' distance


def least(of, low, high, steps=STEPS):
    """Where functions are least between bounds (n,), and the values; `of` takes n and gives n."""
    low, high = np.broadcast_arrays(np.asarray(low, float), np.asarray(high, float))
    a, b = high - SHARE * (high - low), low + SHARE * (high - low)
    at_a, at_b = of(a), of(b)
    for _ in range(steps):
        lower = at_a < at_b
        low, high = np.where(lower, low, a), np.where(lower, b, high)
        new = np.where(lower, high - SHARE * (high - low), low + SHARE * (high - low))
        at_new = of(new)
        a, b = np.where(lower, new, b), np.where(lower, a, new)
        at_a, at_b = np.where(lower, at_new, at_b), np.where(lower, at_a, at_new)
    return np.where(at_a < at_b, a, b), np.minimum(at_a, at_b)
