"""A second opinion on function generators that shares no code with the package.

Pins are where two circles meet, found by geometry; the output is followed step by step from one
input to the next, by Newton's method on the length of the coupler alone.
"""

from __future__ import annotations

import numpy as np


def pins(a, r, b, theta):
    """The two places of the output link's pin for an input link at theta; nan where it is open."""
    pin = a * np.exp(1j * theta)
    to = 1 - pin
    size = abs(to)
    along = (size**2 + r**2 - b**2) / (2 * size)
    height2 = r**2 - along**2
    if height2 < 0:
        return (complex(np.nan, np.nan),) * 2
    way = to / size
    return tuple(pin + way * (along + sign * 1j * np.sqrt(height2)) for sign in (1, -1))


def outputs(generator, inputs):
    """The outputs (N,) along sorted inputs: the loop driven from the first input in small steps.

    Returns nan from where the linkage locks on.
    """
    a, r, b = (float(v) for v in (generator.input_link, generator.coupler, generator.output_link))
    start = float(generator.input_phase)
    first = pins(a, r, b, start + inputs[0])
    # Left of the way from the input link's pin to the output's pivot, or right of it.
    pin = a * np.exp(1j * (start + inputs[0]))
    wanted = next(
        (p for p in first if ((p - pin) * np.conj(1 - pin)).imag * float(generator.side) > 0), None
    )
    out = []
    if wanted is None:
        return np.full(len(inputs), np.nan)
    phi = np.angle(wanted - 1)
    at = inputs[0]
    for target in inputs:
        for theta in np.linspace(at, target, 41)[1:] if target > at else [target]:
            for _ in range(50):
                gap = 1 + b * np.exp(1j * phi) - a * np.exp(1j * (start + theta))
                value = abs(gap) ** 2 - r**2
                slope = 2 * (np.conj(gap) * 1j * b * np.exp(1j * phi)).real
                step = value / slope
                phi -= np.clip(step, -0.1, 0.1)
                if abs(step) < 1e-14:
                    break
            else:
                phi = np.nan
        at = target
        out.append(phi - float(generator.output_phase))
    return np.array(out)


def residual(parameters, inputs, outputs):
    """|B - A| - r at pairs of angles, for a, r, b and both phases: what exact pairs make zero."""
    a, r, b, p, q = parameters
    gap = 1 + b * np.exp(1j * (q + outputs)) - a * np.exp(1j * (p + inputs))
    return np.abs(gap) - r
