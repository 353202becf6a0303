"""Linkages of many tasks: every pair of dyads of a task, as they are, with errors and verdicts.

Lengths are measured in what a radian counts as in each task, so that near is the same for all.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import Found, same_dyads
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.defects import Driven, judge
from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage import TYPES, grashof_numbers
from burmester.fourbar.linkage_batch import DYAD_KINDS, LinkageBatch, pin_distances
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import sizable
from burmester.linkages.judged_places import NearestPlaces
from burmester.numerics.arrays import FloatArray, concatenate, shares, take, wrapped_angle
from burmester.stacked.answers import LinkageRows
from burmester.tasks.length_per_radian import lengths_per_radian
from burmester.verdicts.quality import reached
from burmester.verdicts.ranking import DEFAULT_TOLERANCE
from burmester.verdicts.requirement_check import MAX_SENSITIVITY, MIN_LINK_SHARE
from burmester.verdicts.tolerances import sensitivity_bound

PLACES_AT_ONCE = 1500  # of linkages computed together; their samples fit a cache
RADIAN = 1.0  # in its own unit
USABLE, DEGENERATE = map(LinkageRows.VERDICTS.index, ("usable", "degenerate"))
OF_ANY_DRIVER = [*map(LinkageRows.VERDICTS.index, ("assembly", "circuit"))]

Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]


class Scales(NamedTuple):
    """Lengths of tasks (T,), each in its own unit.

    characteristic: of the task; radian: what a radian counts as; motion: the size of its motion;
    least: the shortest link that makes a usable linkage.
    """

    characteristic: FloatArray
    radian: FloatArray
    motion: FloatArray
    least: FloatArray

    @classmethod
    def of(cls, poses: Displacement, weights: FloatArray | None) -> Scales:
        """Those of tasks with poses (T, N)."""
        radian = lengths_per_radian(poses, weights)
        span = np.linalg.norm(np.ptp(poses.translation, axis=-2), axis=-1)
        own = CanonicalFrames.of(poses, weights)[0].length
        motion = np.maximum(span, radian)
        return cls(own, radian, motion, MIN_LINK_SHARE * np.where(span > 0, span, motion))


def pair_linkages(
    dyads: Found, poses: Displacement, weights: FloatArray | None, scales: Scales
) -> LinkageRows:
    """The linkages of all pairs of dyads (D,), by rising task, of tasks with poses (T, N).

    Usable ones come first, those of the least combined error first.  A pair of one dyad with
    itself is none, nor one of pins that fall together; no single joint drives a PP dyad.
    """
    pairs = _pairs(dyads, scales)
    at_once = max(1, PLACES_AT_ONCE // poses.shape[-1])
    parts = [LinkageRows.blank(0)]
    for start in range(0, len(pairs.task), at_once):
        some = take(pairs, slice(start, start + at_once))
        parts.append(_judged(some, poses, weights, scales))
    rows = concatenate(parts)
    order = (rows.second, rows.first, rows.combined, rows.verdict != USABLE, rows.task)
    return take(rows, np.lexsort(order))


class _Pairs(NamedTuple):
    """Pairs (k,) of dyads: their tasks, the dyads' places among those of the task, the linkages."""

    task: Indices
    first: Indices
    second: Indices
    batch: LinkageBatch


def _pairs(dyads: Found, scales: Scales) -> _Pairs:
    """All pairs of two different dyads of a task, the kinds in the order of `DYAD_KINDS`."""
    count = np.bincount(dyads.task, minlength=len(scales.radian))
    starts = np.cumsum(count) - count
    one, two = [np.zeros(0, dtype=np.intp)], [np.zeros(0, dtype=np.intp)]
    for number in range(2, int(count.max(initial=0)) + 1):  # of the later dyad, from 1
        task = np.flatnonzero(count >= number)
        earlier = np.arange(number - 1)
        one.append((starts[task][:, None] + earlier).ravel())
        two.append(np.repeat(starts[task] + number - 1, number - 1))
    a, b = np.concatenate(one), np.concatenate(two)
    kind, task = dyads.kind, dyads.task[a]
    same, early, late = same_dyads(dyads, scales.characteristic)
    twice = np.isin(a * len(kind) + b, (starts[same] + early) * len(kind) + starts[same] + late)
    sound = np.flatnonzero(~twice & (kind[a] < len(DYAD_KINDS)) & (kind[b] < len(DYAD_KINDS)))
    a, b, task = a[sound], b[sound], task[sound]
    swap = kind[b] < kind[a]
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    both = np.stack([a, b], axis=1)
    batch = LinkageBatch(kind[both], dyads.dimensions[both])
    return _Pairs(task, a - starts[task], b - starts[task], batch)


def _judged(
    pairs: _Pairs, poses: Displacement, weights: FloatArray | None, scales: Scales
) -> LinkageRows:
    """The linkages of pairs that are judged together."""
    given, unit = poses.translation[pairs.task], scales.radian[pairs.task]
    middle = given.mean(axis=1)
    frames = CanonicalFrames(middle, np.zeros_like(middle), unit)
    spread = np.sqrt(((given - middle[:, None]) ** 2).sum(axis=-1).mean(axis=1)) / unit
    size = np.maximum(spread, RADIAN)
    pairs = pairs._replace(batch=pairs.batch.to_canonical(frames))
    sound = np.flatnonzero(sizable(pairs.batch, size))
    pairs, frames, unit, size = take((pairs, frames, unit, size), sound)
    wanted = frames.to_canonical(poses[pairs.task])
    share = shares(None if weights is None else weights[pairs.task], wanted.shape)
    here = _Here(pairs, wanted, share, unit, size)
    # On the nearer circuit first; where a linkage does not work there, elsewhere too.
    target = rows_of(wanted, RADIAN)[:, None]

    def cost(rows: FloatArray) -> FloatArray:
        return np.asarray((share[:, None] * ((rows - target) ** 2).sum(axis=-1)).sum(axis=-1))

    index, rows, first = NearestPlaces.to(pairs.batch, wanted, RADIAN, cost).ways()
    told = _at_places(take(here, index[first]), rows[first], scales)
    failed = np.zeros(len(size), dtype=bool)
    failed[index[first][told.verdict != USABLE]] = True
    more = ~first & failed[index]
    out = concatenate([told, _at_places(take(here, index[more]), rows[more], scales)])
    index = np.concatenate([index[first], index[more]])
    best = np.lexsort([out.combined, out.verdict != USABLE, index])
    return take(out, best[np.unique(index[best], return_index=True)[1]])


class _Here(NamedTuple):
    """Linkages (k,) with their poses (k, N) in frames of their own, the share of each pose.

    unit: of the frames, in the task's; size: of the motion, in the frames.
    """

    pairs: _Pairs
    wanted: Displacement
    share: FloatArray
    unit: FloatArray
    size: FloatArray


def _at_places(here: _Here, rows: FloatArray, scales: Scales) -> LinkageRows:
    """Linkages (k,) judged at places (k, N, 3)."""
    pairs, wanted, share, unit, size = here
    batch = pairs.batch
    places, gap = places_of(rows, RADIAN), rows - rows_of(wanted, RADIAN)
    away = np.hypot(gap[..., 0], gap[..., 1])
    turn = np.abs(wrapped_angle(places.angle - wanted.angle))
    missed, reach = np.maximum(away, RADIAN * turn), DEFAULT_TOLERANCE * size[:, None]
    verdicts = judge(batch, places, missed=missed, reach=reach, length=RADIAN)
    out = LinkageRows.blank(len(batch))
    out.task[:], out.first[:], out.second[:] = pairs.task, pairs.first, pairs.second
    far, turned, both = (
        np.nan_to_num(each, nan=np.inf) for each in (away, turn, np.linalg.norm(gap, axis=-1))
    )
    out.rms[:], out.worst[:] = unit * np.sqrt((far**2).mean(axis=1)), unit * far.max(axis=1)
    out.angle_rms_deg[:] = np.degrees(np.sqrt((turned**2).mean(axis=1)))
    out.angle_worst_deg[:] = np.degrees(turned.max(axis=1))
    out.combined[:] = unit * np.sqrt((share * both**2).sum(axis=1))
    side = np.array([each.second.rank() < each.first.rank() for each in verdicts], dtype=np.intp)
    driven = [
        each.second if other else each.first for each, other in zip(verdicts, side, strict=True)
    ]
    for k, (verdict, motion) in enumerate(zip(verdicts, driven, strict=True)):
        if defects := verdict.defects + motion.defects:
            out.verdict[k] = LinkageRows.VERDICTS.index(defects[0].kind)
    exchanged = side == 1
    out.first[exchanged], out.second[exchanged] = out.second[exchanged], out.first[exchanged]
    batch = batch.in_order(side[:, None] ^ np.arange(2))
    for index, linkage in batch.alike():
        links = linkage.links
        number = TYPES.index(linkage.type) if links is None else grashof_numbers(links)
        out.type[index] = number
    exists = np.flatnonzero(np.isfinite(out.combined))
    if len(exists):
        some = take((batch, wanted, places), exists)
        quality = _quality([driven[k] for k in exists.tolist()], *some)
        out.transmission_deg[exists], out.sensitivity[exists] = quality[0], quality[2]
        out.extent[exists] = quality[1] * (unit / scales.motion[pairs.task])[exists]
    shortest = unit * np.fmin.reduce(pin_distances(batch), axis=1, initial=np.inf)
    degenerate = (shortest < scales.least[pairs.task]) | (out.sensitivity > MAX_SENSITIVITY)
    # As `FoundLinkage` has them: after assembly and circuit, before what depends on the driver.
    out.verdict[degenerate & ~np.isin(out.verdict, OF_ANY_DRIVER)] = DEGENERATE
    return out


def _quality(
    driven: list[Driven], batch: LinkageBatch, wanted: Displacement, places: Displacement
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Transmission in degrees, extent and sensitivity of linkages (k,), the driver first."""
    _, _, reach = reached(batch, driven)
    least = np.degrees([each.least_over_range for each in driven])
    bound = sensitivity_bound(batch, wanted, places, RADIAN).max(axis=-1)
    return least, reach, np.asarray(bound)
