"""How a linkage traces the points of a path, both ways: points to curve, and curve to path.

That a curve comes near to all points says little of what it does between them.  A linkage strays
where its arc between two neighbouring points leaves their chord by more than the points allow
(`path_gaps`): of points that make a drawing it is then not usable.  Fewer points say where the
curve is to be and leave open how it gets there, so that it is only told of their linkages.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple, final

import numpy as np

from burmester.errors import Finding
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven, Verdict
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.path_gaps import PathGaps, are_drawing
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, pose_labels, span
from burmester.verdicts.found_linkage import FoundLinkage

COMPARED: Final = 100  # points at equal steps of arc length, of path and curve, that are compared
FULL_TURN: Final = 2 * math.pi


MET = 1e-7  # spans of the path; points that are missed by less are met
ANGLES_DEG = (0.0, 20.0, 30.0, 40.0, 60.0)  # least transmission angles; more runs no better
RATIOS = (math.inf, 10.0, 5.0)  # of the longest link to the shortest
SAME_MISS = 1e-4  # relative; misses that differ by less are the same
ALIKE_MISS = 0.1  # relative; a linkage farther by less is hardly farther


def is_drawn(task: Task) -> bool:
    """Whether the points of a task, met in their order, say where a curve goes between them."""
    path = task.path
    if path is None or task.requirements.any_order:
        return False
    timed = path.crank_angles is not None
    return are_drawing(len(task.poses.angle), closed=path.closed, timed=timed)


def _gaps(task: Task) -> PathGaps | None:
    """The gaps of a task of points that are traced in their order; None of other tasks."""
    ordered = task.angles_are_free and not task.requirements.any_order
    if not ordered or len(task.poses.angle) < 3:
        return None
    closed = task.path is not None and task.path.closed
    return PathGaps.of(task.poses.translation, closed=closed)


@final
@dataclass(frozen=True, slots=True)
class Tracing:
    """How near points and curve are to each other, both ways, as lengths.

    Attributes
    ----------
    to_curve : (2,) tuple of float
        Root mean square and greatest distance of the points from their places on the curve.
    to_path : (2,) tuple of float
        The same of the curve from the path, over the arcs between neighbouring points, by their
        arc length; the path is the chords of the points.
    chamfer : float
        The mean of both mean distances to the nearest point, of COMPARED points of path and curve
        at equal steps of arc length.
    dtw : float
        The least sum of the distances of pairs of these points along a warping path (dynamic time
        warping), over COMPARED.
    """

    to_curve: tuple[float, float]
    to_path: tuple[float, float]
    chamfer: float
    dtw: float

    @property
    def greatest(self) -> float:
        """The greatest distance, either way."""
        return max(self.to_curve[1], self.to_path[1])

    @classmethod
    def of(cls, found: FoundLinkage, task: Task) -> Tracing | None:
        """Of a linkage at the points of a task; None where it does not come from point to point."""
        gaps, driven = _gaps(task), found.driven
        if gaps is None or driven.circuit < 0 or not np.isfinite(driven.parameter).all():
            return None
        if len(driven.parameter) != len(task.poses.angle):  # of repeated points each counts once
            return None
        batch = LinkageBatch.of([found.driver_first])
        circuits, ends = _travelled(batch, [driven], gaps)
        arcs = gaps.sampled(_curve(circuits), ends)
        points, away = arcs.points[0], arcs.away[0]
        if not np.isfinite(away).all():
            return None
        share = np.abs(np.diff(points, axis=1))
        total = float(share.sum())
        square = (away[:, 1:] ** 2 + away[:, :-1] ** 2) / 2
        mean = float((square * share).sum()) / total if total > 0 else 0.0
        greatest = float(gaps.bulges(_curve(circuits), ends).max())
        curve = np.append(points[:, :-1].ravel(), points[-1, -1])
        z = complex_of(task.poses.translation)
        path = np.append(z, z[:1]) if gaps.closed else z
        one, two = _at_equal_steps(path), _at_equal_steps(curve)
        apart = np.abs(one[:, None] - two)
        return cls(
            (found.error.rms, found.error.worst),
            (math.sqrt(mean), greatest),
            float(apart.min(axis=1).mean() + apart.min(axis=0).mean()) / 2,
            _warped(apart),
        )


def stray_defects(
    batch: LinkageBatch, verdicts: Sequence[Verdict], task: Task, names: Sequence[str]
) -> list[Verdict]:
    """The verdicts on linkages (k,), with a defect of either driver that leaves the path.

    names: of the points.  Unchanged where the points make no drawing (`is_drawn`).
    """
    if not is_drawn(task) or (gaps := _gaps(task)) is None:
        return list(verdicts)
    sides = []
    for own, driven in (
        (batch, [each.first for each in verdicts]),
        (batch.exchanged(), [each.second for each in verdicts]),
    ):
        strays = _strays(own, driven, gaps, task, names)
        sides.append(
            [
                each if stray is None else replace(each, defects=(*each.defects, stray))
                for each, stray in zip(driven, strays, strict=True)
            ]
        )
    return [
        Verdict(each.defects, first, second)
        for each, first, second in zip(verdicts, *sides, strict=True)
    ]


def stray_shortcomings(found: Sequence[FoundLinkage], task: Task) -> list[tuple[str, ...]]:
    """Where linkages through points that make no drawing stray, in words that follow "it"."""
    gaps = None if is_drawn(task) else _gaps(task)
    if gaps is None or not found:
        return [()] * len(found)
    batch = LinkageBatch.of([each.driver_first for each in found])
    names = pose_labels(task, range(len(task.poses.angle)))
    strays = _strays(batch, [each.driven for each in found], gaps, task, names)
    return [() if each is None else (each.message,) for each in strays]


def nearest_both_ways(found: Sequence[FoundLinkage], task: Task) -> list[FoundLinkage]:
    """Linkages by their greatest distance either way; in their order where none strays."""
    if not any(strays(each) for each in found):
        return list(found)

    def greatest(each: FoundLinkage) -> float:
        traced = Tracing.of(each, task)
        return math.inf if traced is None else traced.greatest

    return sorted(found, key=greatest)


def strays(found: FoundLinkage) -> bool:
    """Whether a linkage leaves the path between points, and is not usable for that."""
    return any(each.kind == "stray" for each in found.defects)


def _strays(
    batch: LinkageBatch,
    driven: Sequence[Driven],
    gaps: PathGaps,
    task: Task,
    names: Sequence[str],
) -> list[Finding | None]:
    """Where linkages (k,), driven by their first dyads, leave the path between points."""
    circuits, ends = _travelled(batch, driven, gaps)
    bulges = gaps.bulges(_curve(circuits), ends)
    tolerance = np.zeros(len(names))
    if task.tolerances is not None:
        tolerance = np.linalg.norm(task.tolerances.position, axis=-1)
    beside = np.roll(tolerance, -1)
    allowed = gaps.allowed(np.maximum(tolerance, beside)[: len(gaps.begin)])
    out: list[Finding | None] = []
    for bulge in bulges:
        with np.errstate(invalid="ignore"):
            far = np.flatnonzero(bulge > allowed)
        if not len(far):
            out.append(None)
            continue
        at = int(far[bulge[far].argmax()])
        pair = at, (at + 1) % len(names)
        text = (
            f"leaves the path by {length_of(float(bulge[at]), task)} between points "
            f"{names[pair[0]]} and {names[pair[1]]}"
        )
        if len(far) > 1:
            text += f", and in {len(far) - 1} other place{'s' * (len(far) > 2)}"
        poses = sorted({int(each) for gap in far for each in (gap, (gap + 1) % len(names))})
        out.append(Finding("stray", text, tuple(poses)))
    return out


def _travelled(
    batch: LinkageBatch, driven: Sequence[Driven], gaps: PathGaps
) -> tuple[Circuits, FloatArray]:
    """The circuits (k,) on which linkages trace their points, and the ends (k, g, 2) of arcs."""
    number = np.array([max(each.circuit, 0) for each in driven], dtype=np.intp)
    circuits = Circuits.of(batch, as_given=True)[np.arange(len(number)), number]
    there = np.array([each.circuit >= 0 for each in driven])[:, None]
    along = np.where(there, np.array([each.parameter for each in driven]), np.nan)
    round_ = np.where([each.turns_fully for each in driven], FULL_TURN, 0.0)
    return circuits, gaps.ends(along, round_)


def _curve(circuits: Circuits) -> Callable[[FloatArray], ComplexArray]:
    """The coupler points (k, m) of circuits (k,) at parameters (k, m)."""

    def points(parameter: FloatArray) -> ComplexArray:
        with np.errstate(invalid="ignore", divide="ignore"):
            return complex_of(circuits.curve(np.zeros(2), parameter))

    return points


def _at_equal_steps(line: ComplexArray) -> ComplexArray:
    """COMPARED points at equal steps along a line of chords through points (n,)."""
    at = np.concatenate([[0.0], np.abs(np.diff(line)).cumsum()])
    wanted = np.linspace(0, at[-1], COMPARED)
    return np.asarray(np.interp(wanted, at, line))


def _warped(apart: FloatArray) -> float:
    """The least sum of distances (n, n) along a warping path, over n (dynamic time warping)."""
    total = [0.0, *[math.inf] * apart.shape[1]]
    for row in apart.tolist():
        last, total[0] = total[0], math.inf
        for j, each in enumerate(row, start=1):
            best = min(last, total[j], total[j - 1])
            last, total[j] = total[j], each + best
    return total[-1] / len(apart)


class Price(NamedTuple):
    """What a linkage costs, and what it gives.

    miss: the greatest distance of a point from the curve, in the task's unit.
    times: the same, over that of the nearest linkage; None where that one misses by nothing.
    transmission_deg: the least transmission angle on the path; link_ratio: longest over shortest.
    """

    found: FoundLinkage
    miss: float
    times: float | None
    transmission_deg: float
    link_ratio: float


def price_list(linkages: Sequence[FoundLinkage], task: Task) -> list[Price]:
    """The usable linkages of a path that are worth their price, the nearest first.

    Of those that miss by as much, as cognates do, the first.  Left out is a linkage where another
    is as good and hardly farther.
    """
    met = MET * span(task)
    usable = [_priced(each) for each in linkages if each.usable]
    kept: list[Price] = []
    for ratio in RATIOS:
        for angle in ANGLES_DEG if ratio == math.inf else ANGLES_DEG[1:]:
            some = [e for e in usable if e.transmission_deg >= angle and e.link_ratio <= ratio]
            least = max(min((each.miss for each in some), default=0.0), met)
            nearest = next((each for each in some if each.miss <= (1 + SAME_MISS) * least), None)
            if nearest is not None and nearest not in kept:
                kept.append(nearest)
    kept[1:] = sorted(kept[1:], key=lambda price: price.miss)
    kept = kept[:1] + [e for e in kept[1:] if not any(_replaces(one, e) for one in kept)]
    free = not kept or kept[0].miss <= met
    return [e._replace(times=None if free else e.miss / kept[0].miss) for e in kept]


def _priced(found: FoundLinkage) -> Price:
    links = [float(each) for each in found.linkage.links or ()]
    ratio = max(links) / min(links) if links and min(links) > 0 else math.inf
    degrees = math.degrees(found.driven.least_over_range)
    return Price(found, found.combined_error, None, degrees, ratio)


def _marks(price: Price) -> tuple[int, int]:
    """How many of the transmission angles, and of the link ratios, a linkage keeps."""
    angles = sum(price.transmission_deg >= each for each in ANGLES_DEG)
    return angles, sum(price.link_ratio <= each for each in RATIOS)


def _replaces(one: Price, other: Price) -> bool:
    """Whether one linkage keeps more than another and is hardly farther."""
    mine, its = _marks(one), _marks(other)
    as_good = mine[0] >= its[0] and mine[1] >= its[1]
    return mine != its and as_good and one.miss <= (1 + ALIKE_MISS) * other.miss
