"""Six-bars by a random search over 3R chains, and for better ones near the best of them.

Every chain is worked out whole (`added_dyads`); which chains are looked at is left to chance.  So
the answer is the best that was seen, and no proof that there is no better one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Region, Segment
from burmester.numerics.arrays import FloatArray, complex_of, concatenate, take, where
from burmester.progress import goes_on, time_for
from burmester.requirements.table import excess, keeps, standard
from burmester.requirements.transmission import TRANSMISSION
from burmester.sixbar.added_dyads import ThreeRChain
from burmester.sixbar.candidates import Candidates, Conditions, watt_candidates
from burmester.sixbar.search_space import POSES, SearchSpace
from burmester.sixbar.stephenson_candidates import (
    driven_four_bar_candidates,
    first_class_candidates,
    third_class_candidates,
)
from burmester.verdicts.quality import best_first

# How the six-bars of a class are worked out of chains, by the name of the class.
Recipe: TypeAlias = Callable[[ThreeRChain, Displacement, FloatArray, Conditions], Candidates]
SEARCHED: Final[Mapping[str, tuple[Recipe, ...]]] = {
    "Watt I six-bar": (watt_candidates,),
    "Stephenson I six-bar": (first_class_candidates,),
    "Stephenson III six-bar": (third_class_candidates, driven_four_bar_candidates),
}

ROUND = 500  # chains worked out at a time
DRAWN_SHARE = 0.4  # of the rounds, in which chains are drawn at random; then near the best as well
VIOLATED = 120.0  # degrees of transmission that a violation of 1 counts as, in what is climbed
# Of the search under loads: rounds, six-bars that are loaded in each, and parents of the next.
LOADED_ROUNDS, LOADED, PARENTS = 12, 16, 8
KEPT = 100  # of the best, around which chains are drawn
STEPS = 0.003, 0.3  # least and greatest deviation of a chain from its parent, in sizes
MARGIN = 1.002  # of the reach that a chain needs, at least
LONGEST_REACH = 2.5  # of the reach that a chain needs, at most
FREE_POSE = 0.15  # deviation of a pose that is free, in sizes and radians
AROUND = 1.0  # sizes around the poses, in which a pivot on an endless line is looked for
OUTSIDE = 1e-9  # sizes; as far outside a region a pivot still is in it
NICHE = 0.05  # sizes; of two six-bars whose joints are all nearer than this the better is kept
APART = (
    0.15  # sizes; two six-bars of an answer have a joint that is farther apart at the first pose
)


@final
class ChainSearch(NamedTuple):
    """What a search has found: six-bars (n,) of one class, the best first.

    chains, designs, working: how many were worked out, how many six-bars they made (with a first
    loop that works), and how many of these work within the regions.
    """

    best: Candidates
    chains: int
    designs: int
    working: int


class _Chains(NamedTuple):
    """Chains (k,) as a search draws them: A, E, the reach in needed ones, how unequal the links.

    poses: (k, 5); side: (k,), of the elbow.
    """

    fixed: FloatArray
    moving: FloatArray
    reach: FloatArray
    balance: FloatArray
    side: FloatArray
    poses: Displacement

    def chains(self) -> ThreeRChain:
        """As chains that reach all their poses."""
        ends = complex_of(self.poses.act(self.moving[:, None]))
        far = np.abs(ends - complex_of(self.fixed)[:, None])
        total, less = far.max(axis=-1) * self.reach, far.min(axis=-1) * self.balance
        return ThreeRChain(self.fixed, (total + less) / 2, (total - less) / 2, self.moving)


def search(
    space: SearchSpace,
    kinds: Sequence[str],
    chains: int,
    seed: int,
    most: int,
    *,
    burden: Callable[[Candidates, int], float] | None = None,
) -> list[ChainSearch]:
    """The best six-bars of each recipe on so many chains, `most` at most of each.

    burden: by how much one of them bears too much, 0 where it bears what is asked.
    The same seed gives the same answer.  A time limit (`progress.limited`) ends it after a round.
    """
    rounds = -(-chains // ROUND)
    searches = [_Search(space, recipe, seed) for kind in kinds for recipe in SEARCHED[kind]]
    time_for(f"looking for six-bars on {chains} chains")
    for number in range(rounds):
        if number and not goes_on(number + 1, rounds, "round"):
            break
        for each in searches:
            each.look(min(ROUND, chains - ROUND * number), number >= DRAWN_SHARE * rounds)
    if burden is not None and time_for("looking for six-bars that bear what is asked"):
        for each in searches:
            each.bear(burden)
    return [each.found(most) for each in searches]


class _Search:
    """The search for six-bars of one recipe: chains that were looked at, and the best so far."""

    def __init__(self, space: SearchSpace, recipe: Recipe, seed: int) -> None:
        self._space, self._recipe = space, recipe
        self._random = np.random.default_rng(seed)
        given = space.poses.shape[0]
        self._own = np.round(np.linspace(0, POSES - 1, given)).astype(np.intp)
        self._kept: Candidates | None = None
        self._drawn: _Chains | None = None
        self._looked = self._designs = self._working = 0

    def look(self, count: int, near: bool) -> None:
        """Work out so many chains more, those near the best among them if `near`."""
        space, kept, drawn = self._space, self._kept, self._drawn
        fresh = _drawn(space, self._own, count, self._random)
        if near and drawn is not None and len(drawn.side):
            fresh = _varied(space, drawn, fresh, self._random)
        found = self._recipe(fresh.chains(), fresh.poses, fresh.side, space.conditions)
        self._designs += found.designs
        self._working += len(np.unique(found.design[_violation(space, found) == 0]))
        mine = take(fresh, found.chain)
        found = found._replace(chain=found.chain + self._looked)
        self._looked += count
        if kept is not None and drawn is not None:
            found, mine = concatenate([(kept, drawn), (found, mine)])
        merit = found.merit(space.size) - VIOLATED * _violation(space, found)
        order = np.argsort(-merit, kind="stable")
        best = _distinct(found, order, NICHE * space.size, KEPT)
        self._kept, self._drawn = take((found, mine), best)

    def bear(self, burden: Callable[[Candidates, int], float]) -> None:
        """Go on near those that bear least, and keep those that bear what is asked, if any does."""
        space, size = self._space, self._space.size
        assert self._kept is not None
        assert self._drawn is not None
        good = np.flatnonzero(_violation(space, self._kept) == 0)
        kept, drawn = take((self._kept, self._drawn), good)
        borne = np.array([burden(kept, k) for k in range(len(good))])
        for _ in range(LOADED_ROUNDS if len(good) else 0):
            if (borne <= 0).sum() > PARENTS:
                break
            first = np.argsort(borne, kind="stable")[:PARENTS]
            fresh = _drawn(space, self._own, ROUND, self._random)
            near = _varied(space, take(drawn, first), fresh, self._random)
            found = self._recipe(near.chains(), near.poses, near.side, space.conditions)
            some = np.flatnonzero(_violation(space, found) == 0)
            some = some[self._random.permutation(len(some))[:LOADED]]
            mine, found = take(near, found.chain[some]), take(found, some)
            more = np.array([burden(found, k) for k in range(len(some))])
            found = found._replace(chain=found.chain + self._looked)
            self._looked += ROUND
            kept, drawn = concatenate([(kept, drawn), (found, mine)])
            borne = np.concatenate([borne, more])
            order = np.lexsort((-kept.merit(size), borne))
            best = _distinct(kept, order, NICHE * size, KEPT)
            kept, drawn, borne = take((kept, drawn, borne), best)
        bears = borne <= max(float(borne.min(initial=math.inf)), 0.0)
        self._kept, self._drawn = take((kept, drawn), bears)

    def found(self, most: int) -> ChainSearch:
        """What was found, the best `most` of it."""
        assert self._kept is not None
        kept = take(self._kept, _violation(self._space, self._kept) == 0)
        best = take(kept, _ranked(kept, self._space, most))
        return ChainSearch(best, self._looked, self._designs, self._working)


def _drawn(
    space: SearchSpace, own: NDArray[np.intp], count: int, random: np.random.Generator
) -> _Chains:
    """Chains drawn at random."""
    origins, around = space.poses.translation, AROUND * space.size
    low, high = origins.min(axis=0) - around, origins.max(axis=0) + around
    fixed = _points(space.fixed[0], low, high, count, random)
    moving = _points(space.moving[0], np.full(2, -around), np.full(2, around), count, random)
    reach = MARGIN + (LONGEST_REACH - MARGIN) * random.random(count) ** 2
    balance = random.uniform(-0.98, 0.98, count)
    side = random.choice([-1.0, 1.0], count)
    return _Chains(fixed, moving, reach, balance, side, _five(space, own, count, random))


def _varied(
    space: SearchSpace, parents: _Chains, fresh: _Chains, random: np.random.Generator
) -> _Chains:
    """Chains near `parents`; one in five stays as it was drawn."""
    count = len(fresh.side)
    parent = take(parents, (len(parents.side) * random.random(count) ** 2).astype(np.intp))
    step = np.exp(random.uniform(math.log(STEPS[0]), math.log(STEPS[1]), count))
    move = space.size * step[:, None]
    fixed = parent.fixed + move * random.standard_normal((count, 2))
    moving = parent.moving + move * random.standard_normal((count, 2))
    reach = 1 + (parent.reach - 1) * np.exp(step * random.standard_normal(count))
    balance = np.clip(parent.balance + step * random.standard_normal(count), -0.98, 0.98)
    fixed = _into(space.fixed[0], fixed, parent.fixed, space.size)
    moving = _into(space.moving[0], moving, parent.moving, space.size)
    near = _Chains(fixed, moving, np.maximum(reach, MARGIN), balance, parent.side, parent.poses)
    stays = random.random(count) < 0.2
    return where(stays, fresh, near)


def _five(
    space: SearchSpace, own: NDArray[np.intp], count: int, random: np.random.Generator
) -> Displacement:
    """Five poses (count, 5): the task's at `own`, and between them others that are free."""
    given = np.column_stack([space.poses.translation, space.poses.angle])
    rows = np.empty((count, POSES, 3))
    for k in range(3):
        rows[..., k] = np.interp(np.arange(POSES), own, given[:, k])
    free = np.setdiff1d(np.arange(POSES), own)
    spread = FREE_POSE * np.array([space.size, space.size, 1.0])
    rows[:, free] += spread * random.standard_normal((count, len(free), 3))
    return Displacement.from_poses(rows)


def _points(
    region: Region,
    low: FloatArray,
    high: FloatArray,
    count: int,
    random: np.random.Generator,
) -> FloatArray:
    """Points (count, 2) of a region; of an endless line beside the box from low to high."""
    if isinstance(region, Point):
        return np.tile(region.at, (count, 1))
    if isinstance(region, Segment):
        return np.asarray(region.start + random.random((count, 1)) * (region.end - region.start))
    if isinstance(region, Line):
        along = (region.end - region.start) / np.linalg.norm(region.end - region.start)
        middle = region.start + ((low + high) / 2 - region.start) @ along * along
        half = np.linalg.norm(high - low) / 2
        return np.asarray(middle + random.uniform(-half, half, (count, 1)) * along)
    low, high = region.vertices.min(axis=0), region.vertices.max(axis=0)
    inside = np.empty((0, 2))
    while len(inside) < count:
        more = random.uniform(low, high, (2 * count, 2))
        inside = np.concatenate([inside, more[region.distance(more) == 0]])
    return inside[:count]


def _into(region: Region, points: FloatArray, before: FloatArray, size: float) -> FloatArray:
    """Points (k, 2), each brought into a region, or left where it was before (in the region)."""
    if isinstance(region, Line | Segment):
        way = region.end - region.start
        share = ((points - region.start) @ way / (way @ way))[:, None]
        points = region.start + share * way
    return np.where(region.distance(points)[:, None] <= OUTSIDE * size, points, before)


def _violation(space: SearchSpace, found: Candidates) -> FloatArray:
    """How far six-bars (n,) are from their regions, lengths and requirements; 0 keeps them all.

    In sizes of the motion, logarithms of ratios, and shares of a transmission angle of 30°.
    """
    linkage, slack = found.linkages, OUTSIDE * space.size
    skeleton, frames, lengths = linkage.skeleton, linkage.frames(), linkage.lengths()
    off = []
    for regions, link in ((space.fixed, skeleton.ground), (space.moving, linkage.carries)):
        for number, at in enumerate(frames[link].values()):
            far = regions[min(number, 1)].distance(at)
            off.append(np.where(far <= slack, 0.0, far / space.size))
    for number, pivot in enumerate(skeleton.drivers):
        least, most = space.lengths[min(number, 1)]
        arm = set(skeleton.arm(pivot))
        length = lengths[:, [set(bar) for bar in skeleton.bars].index(arm)]
        far = np.maximum(least - length, length - most)
        off.append(np.where(far <= slack, 0.0, far / space.size))
    asked = dict(space.conditions.asked)
    lacking = np.zeros(len(found.chain))
    if (angle := asked.pop(TRANSMISSION, None)) is not None:
        lacking = np.degrees(excess({TRANSMISSION: angle}, found.figures)) / TRANSMISSION.standard
    short = np.log(np.maximum(space.bars[skeleton.name] / lengths, 1.0)).max(axis=-1)
    off += [lacking, excess(asked, found.figures), short]
    return np.asarray(np.sum(off, axis=0))


def _distinct(
    found: Candidates, order: NDArray[np.intp], apart: float, most: int
) -> NDArray[np.intp]:
    """Those of `order` whose joints at the first pose differ by more than `apart`, `most` at most.

    Of two that differ by less the one that comes first stays.
    """
    joints = found.joints[:, 0]
    kept: list[int] = []
    for k in order.tolist():
        if (np.abs(joints[kept] - joints[k]).max(axis=-1) > apart).all():
            kept.append(k)
            if len(kept) == most:
                break
    return np.array(kept, dtype=np.intp)


def is_sound(found: Candidates, size: float) -> NDArray[np.bool_]:
    """Which six-bars meet the standard: (n,); size: of the motion."""
    return keeps(standard({}, size), found.figures)


def _ranked(found: Candidates, space: SearchSpace, most: int) -> NDArray[np.intp]:
    """The order to recommend them in: sound ones first, then by transmission and extent."""
    sound = is_sound(found, space.size)
    ones = np.ones(len(found.chain))
    extent = found.extent / space.size
    order = best_first(found.transmission, extent, ones, enough=np.pi / 2)
    order = order[np.argsort(~sound[order], kind="stable")]
    return _distinct(found, order, APART * space.size, most)
