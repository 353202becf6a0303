"""The best dyads within limits: on every face of the regions, and with the link at its bounds.

A dyad that is best within limits lies on some face of them: the fixed pivot inside its region, on
an edge or at a corner, the moving pivot likewise, the link's length free or at a bound.  On each of
these faces all stationary points of the squared residual are found (`stationary_points`).  All of
them, complex ones by their real parts, and long links along the best lines are followed to minima
of the true distance on the face, the minima among them down to minima within the limits.  Those are
kept that lie within the limits and from which no direction into them leads down.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circles_within_limits import circles_within_limits
from burmester.dyads.face_search import Descents, FaceSearch
from burmester.dyads.geometric_fit import line_distances
from burmester.dyads.limited_block import Block
from burmester.dyads.rail_sliders import sliders_on_rail
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Face, Region
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import shares
from burmester.polynomials.bilinear_fit import Parameters, Shape, line_shape
from burmester.tasks.frames import frames_of, limits_in
from burmester.tasks.limits import Limits
from burmester.tasks.option_table import Norm
from burmester.tasks.rails import Rail
from burmester.tasks.thin_regions import without_thin_regions

_LINE = line_shape(2, 0)


@final
@dataclass(frozen=True, slots=True, eq=False)
class LimitedDyads:
    """The locally best dyads within limits, by distance from their circles and lines.

    circles: (k,), sliders: PR and RP dyads, all in `frames`; by rising rms error each.
    systems: how many faces were searched; found: their stationary points, complex ones included;
    lost: paths that ended nowhere: where there are any, a dyad may be missing.
    unsettled: how many ways down from minima of the squared residual were given up, and did not
        lead to a dyad.
    """

    frames: CanonicalFrames
    circles: RR
    sliders: tuple[PR | RP, ...]
    systems: int
    found: int
    lost: int
    unsettled: int


def limited_dyads(
    poses: Displacement,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    limits: Limits | None = None,
    norm: Norm = "rms",
) -> LimitedDyads:
    """Every locally best dyad of poses (N,) within limits, and through the exact ones of them.

    weights: (N,) or None; exact: (N,), or None for no exact poses; norm: the sum of squared
    distances is least, or the worst distance.  A region thinner than rounding is its segment or its
    point (`without_thin_regions`).
    On every face all stationary points of the squared residual are found, with probability one.
    That the true distance has no other minima than those they lead to is not proved, nor that the
    worst distance has none.
    """
    limits = limits or Limits()
    frames, seen = frames_of(poses, weights, (limits,))
    held = np.zeros(poses.shape, dtype=bool) if exact is None else exact
    limits = limits_in(frames, without_thin_regions(limits, frames, int(held.sum())))
    search = FaceSearch(shares(weights, poses.shape), held, norm)
    kinds = limits.allowed
    rr = circles_within_limits(seen, limits, search) if "RR" in kinds else np.empty((0, 5))
    sliders: list[PR | RP] = []
    if "PR" in kinds:
        sliders += [PR(*line) for line in _lines(seen, limits.moving_pivot, search, limits.rail)]
    if "RP" in kinds:
        lines = _lines(seen.inverse(), limits.fixed_pivot, search, limits.slot)
        sliders += [RP(pivot, angle, offset) for angle, offset, pivot in lines]
    return LimitedDyads(
        frames,
        RR(rr[:, :2], rr[:, 2:4], rr[:, 4]),
        tuple(sliders),
        search.systems,
        search.found,
        search.lost,
        search.unsettled,
    )


def _lines(
    seen: Displacement, region: Region | None, search: FaceSearch, rail: Rail | None
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """The PR dyads, on the rail if there is one: normal angle, offset, moving pivot."""
    if rail is not None:
        lines = sliders_on_rail(seen, rail, region, search.share, search.exact)
        return [_with_upper_normal(z) for z in lines]
    rows = np.concatenate(
        [seen.translation, np.cos(seen.angle)[:, None], np.sin(seen.angle)[:, None]], axis=-1
    )
    base, gram, conditions = search.centre(rows)
    block = Block(slice(2, 4), region)
    descents = Descents(search, line_distances(seen), (block,), np.empty((0, 4)))
    starts = [np.empty((0, 4))]
    systems: dict[Shape, list[tuple[Face, Parameters]]] = {}
    for face in block.faces():
        j = face.basis.shape[1]
        if 1 + j < len(conditions):
            continue
        features = _line_map(face)
        gram_of_face, zero = features.T @ gram @ features, np.zeros(features.shape[1])
        system = Parameters(gram_of_face, conditions @ features, zero, np.ones(()))
        systems.setdefault(line_shape(j, len(conditions)), []).append((face, system))
    for shape, members in systems.items():
        parts = zip(*(system for _, system in members), strict=True)
        every = search.solve(shape, Parameters(*(np.stack(part) for part in parts)))
        for (face, _), found in zip(members, every, strict=True):
            x = found.points[found.minimum]
            n, pivot = x[:, :2], face.origin + x[:, 2:] @ face.basis.T
            offset = _LINE.features(np.concatenate([n, pivot], axis=-1)) @ base
            starts.append(np.column_stack([np.arctan2(n[:, 1], n[:, 0]), offset, pivot]))
    descents.follow(np.concatenate(starts))
    return [_with_upper_normal(z) for z in descents.in_order()]


def _with_upper_normal(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Normal angle, offset and pivot (2,) of a dyad z (4,), the normal in the upper half plane."""
    angle = np.arctan2(np.sin(z[0]), np.cos(z[0]))
    flip = angle < 0 or angle == np.pi
    angle = np.mod(angle, np.pi)
    return angle, -z[1] if flip else z[1], z[2:]


def _line_map(face: Face) -> FloatArray:
    """The matrix (4, f) from the features of a face to (n, n · m, n x m)."""
    normals, step = np.eye(2), face.basis.T
    at = [_LINE.features(np.concatenate([n, face.origin])) for n in normals]
    if len(step) == 2:
        return np.eye(4)
    more = [
        _LINE.features(np.concatenate([n, face.origin + step[0]])) - zero
        for n, zero in zip(normals, at, strict=True)
        if len(step)
    ]
    return np.stack(at + more, axis=-1)
