"""A body amid regions to keep out of, and where its corners are, by complex numbers."""

from dataclasses import replace

import numpy as np

from burmester import KeepOut, Polygon, Surroundings, read_task

# An L without any symmetry, so that no turn, flip or exchange of corners gives it again.
BODY = ((-0.7, -0.4), (1.9, -0.4), (1.9, 0.1), (0.3, 0.2), (0.3, 1.1), (-0.7, 0.9))
# Nothing here may end the text, tag or comment that it stands in, nor call for anything.
HOSTILE = "</text></g><script>alert(1)</script> &amp; \"'--> %%d \\U+00B0 ^J $x$ \x1b[31m"
REGIONS = (
    (((-5, -4), (-4, -4), (-4.5, -3)), "bumper"),
    (((4, 3.5), (6, 3.5), (6, 5), (5, 4), (4, 5)), HOSTILE),
    (((6, -4), (7, -4), (7, -3.5)), None),
)


def bodied(source="case:ge2012-exact", size=1.0, regions=REGIONS):
    """A task with that body, `size` times as large, and with regions."""
    kept = tuple(KeepOut(Polygon(corners), name) for corners, name in regions)
    return replace(
        read_task(source),
        body=Polygon(size * np.array(BODY)),
        surroundings=Surroundings(kept) if kept else None,
    )


def carried(corners, x, y, angle):
    """Corners (k, 2) of M in F, for places (n,) each: (n, k, 2)."""
    z = np.asarray(corners, dtype=float) @ [1, 1j]
    at = (np.asarray(x) + 1j * np.asarray(y))[:, None] + np.exp(1j * np.asarray(angle))[:, None] * z
    return np.stack([at.real, at.imag], axis=-1)


def same_ring(drawn, corners):
    """How far a ring (k, 2) is from another one, from wherever and in whichever sense it starts."""
    drawn, corners = np.asarray(drawn, dtype=float), np.asarray(corners, dtype=float)
    if drawn.shape != corners.shape:
        return np.inf
    ways = (corners, corners[::-1])
    every = [np.roll(way, k, axis=0) for way in ways for k in range(len(corners))]
    return min(float(np.abs(drawn - each).max()) for each in every)
