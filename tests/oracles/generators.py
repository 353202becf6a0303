"""Function generators drawn at random that go through a range of the input."""

import numpy as np

from burmester.functions.generator import Generator


def drawn(seed, span=1.2, count=6):
    """A generator that goes through the range, and the outputs there."""
    rng = np.random.default_rng(seed)
    inputs = np.linspace(0, span, count)
    while True:
        lengths = np.exp(rng.uniform(-1, 1, (3, 1)))
        phases = rng.uniform(-np.pi, np.pi, (2, 1))
        one = Generator(*lengths, *phases, rng.choice([-1.0, 1.0], 1))
        if one.runs_through(0, span)[0]:
            return one, inputs, np.unwrap(one.outputs(inputs)[0])
