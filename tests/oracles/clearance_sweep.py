"""The clearance of a linkage by a dense sweep, with motion and outlines of its own.

The linkage is driven by the witness, every frame is drawn with Shapely as it would be cut from a
sheet, and the least distance of all frames counts.  Nothing is bounded or refined.
"""

from __future__ import annotations

import numpy as np
import shapely

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles import witness

__all__ = ["Moved", "moved_four_bar", "random_outline", "sweep"]

FRAMES_AT_ONCE = 20_000


def _c(pair):
    return complex(pair[0], pair[1])


class Moved:
    """A four-bar on its way: dyads, driver positions (n,), body places d, phi (n,)."""

    def __init__(self, first, second, drive, side):
        d, phi = witness.places(first, second, np.asarray(drive))
        self.first, self.second, self.drive = first, second, np.asarray(drive)
        self.d, self.phi = d[side], phi[side]

    def moving_pivots(self, part):
        """Of RR and PR dyads, (n,) each; None of others."""
        out = []
        for dyad in (self.first, self.second):
            pin = None
            if isinstance(dyad, RR | PR):
                pin = self.d[part] + _c(dyad.moving_pivot) * np.exp(1j * self.phi[part])
            out.append(pin)
        return out


def moved_four_bar(rng, frames):
    """A random four-bar with a motion of one assembly, RR and RR, PR or RP, or PR and RR."""
    while True:
        first = RR(rng.uniform(-50, 50, 2), rng.uniform(-30, 30, 2), rng.uniform(20, 60))
        second = (
            RR(rng.uniform(-80, 80, 2), rng.uniform(-30, 30, 2), rng.uniform(30, 90)),
            PR(rng.uniform(-3, 3), rng.uniform(-40, 40), rng.uniform(-30, 30, 2)),
            RP(rng.uniform(-60, 60, 2), rng.uniform(-3, 3), rng.uniform(-20, 20)),
        )[rng.integers(3)]
        start, size = rng.uniform(-3, 3), rng.uniform(0.5, 2.5)
        if rng.random() < 0.2:
            first, second = (
                PR(rng.uniform(-3, 3), rng.uniform(-40, 40), rng.uniform(-30, 30, 2)),
                first,
            )
            start, size = 30 * start, 40 * size
        moved = Moved(first, second, np.linspace(start, start + size, frames), rng.integers(2))
        if np.isfinite(moved.phi).all():
            return moved


def sweep(moved, body, regions, width):
    """Distances (n,) of all that moves from all regions, 0 where they touch."""
    parts = range(0, len(moved.d), FRAMES_AT_ONCE)
    regions = [shapely.Polygon(each) for each in regions]
    return np.concatenate(
        [_distances(moved, slice(k, k + FRAMES_AT_ONCE), body, regions, width / 2) for k in parts]
    )


def _distances(moved, part, body, regions, half):
    shapes = []
    if body is not None:
        z = (body[:, 0] + 1j * body[:, 1]) * np.exp(1j * moved.phi[part])[:, None] + moved.d[part][
            :, None
        ]
        shapes.append((shapely.polygons(np.stack([z.real, z.imag], axis=-1)), 0.0))
    pins = moved.moving_pivots(part)
    for dyad, pin in zip((moved.first, moved.second), pins, strict=True):
        if pin is not None:
            fixed = np.full_like(pin, _c(dyad.fixed_pivot)) if isinstance(dyad, RR) else pin
            shapes.append((_bars(fixed, pin), half))
    if all(pin is not None for pin in pins):
        shapes.append((_bars(*pins), half))
    least = np.full(len(moved.d[part]), np.inf)
    for geometries, width in shapes:
        for region in regions:
            np.minimum(least, shapely.distance(geometries, region) - width, out=least)
    return np.maximum(least, 0.0)


def _bars(one, other):
    ends = np.stack([one, other], axis=1)
    return shapely.linestrings(np.stack([ends.real, ends.imag], axis=-1))


def random_outline(rng, size, count=9):
    """A star-shaped outline (n, 2), as a rule with concavities."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False) + rng.uniform(0, 1 / count, count)
    radius = size * rng.uniform(0.25, 1.0, count)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
