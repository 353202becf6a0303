"""The places at which linkages are judged: all on one circuit, whoever asks.

A linkage is judged on each of its circuits by itself, at the places nearest to the poses there.  It
is what it is on the best one (`best_places`): one where it works, else the nearest.  Only where one
circuit alone is much farther from the poses than both together, it is judged on both as well: then
it has to be taken apart between the poses, and that is what is to be said of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import nearest, on_circuits, on_own_circuits
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray
from burmester.refinement.target import ONE_CIRCUIT_RATIO, Target
from burmester.verdicts.found_linkage import FoundLinkage


class NearestPlaces(NamedTuple):
    """Places of linkages (k,) nearest to the poses.

    both: (k, 2, N, 3), on each circuit; one: (k, N, 3), on the nearer of them, by its number
    nearer (k,); best: (k, N, 3), on either at each pose.  apart: (k,), whether `one` is much
    farther from the poses than `best`.
    """

    both: FloatArray
    nearer: NDArray[np.intp]
    one: FloatArray
    best: FloatArray
    apart: NDArray[np.bool_]

    @classmethod
    def of(
        cls, batch: LinkageBatch, target: Target, both: FloatArray | None = None
    ) -> NearestPlaces:
        """Those of linkages (k,) of one task, whichever of their dyads is the first.

        both: as of the attribute, where they are known.
        """
        if both is None:
            return cls.to(batch, target.poses, target.length, target.cost)
        return cls._of_both(both, target.poses, target.length, target.cost)

    @classmethod
    def to(
        cls,
        batch: LinkageBatch,
        poses: Displacement,
        length: float,
        cost: Callable[[FloatArray], FloatArray],
    ) -> NearestPlaces:
        """Those to poses (N,) of all linkages (k,), or (k, N) of each; cost: of rows, (k, 2)."""
        both = rows_of(on_circuits(_in_one_order(batch), poses, length), length)
        return cls._of_both(both, poses, length, cost)

    @classmethod
    def _of_both(
        cls,
        both: FloatArray,
        poses: Displacement,
        length: float,
        cost: Callable[[FloatArray], FloatArray],
    ) -> NearestPlaces:
        found, wanted = places_of(both, length), rows_of(poses, length)
        nearer = np.nan_to_num(cost(both), nan=np.inf).argmin(axis=1)
        one = both[np.arange(len(both)), nearer]
        best = rows_of(nearest(found, poses, length), length)
        away, least = (
            np.sqrt(np.nan_to_num(((each - wanted) ** 2).sum(axis=-1), nan=np.inf)).max(axis=1)
            for each in (one, best)
        )
        apart = (away > np.maximum(ONE_CIRCUIT_RATIO * least, ROUNDING)) & np.isfinite(least)
        return cls(both, nearer, one, best, apart)

    def ways(self) -> tuple[NDArray[np.intp], FloatArray, NDArray[np.bool_]]:
        """The numbers (n,) of linkages, the rows (n, N, 3) of each way to judge them.

        Every linkage has a way, by rising number; places may be nan.  Also returns which (n,) is
        the first way of each: the one on the nearer circuit.
        """
        exists = np.asarray(np.isfinite(self.both).all(axis=(-1, -2)))
        met = np.isfinite(self.best).all(axis=(1, 2), keepdims=True)
        every = np.concatenate([self.both, np.where(met, self.best, self.one)[:, None]], axis=1)
        none = ~exists.any(axis=1)
        index, way = np.nonzero(np.column_stack([exists, self.apart | none]))
        return index, every[index, way], way == np.where(none, 2, self.nearer)[index]


def at_nearest(
    batch: LinkageBatch, rows: FloatArray, target: Target
) -> tuple[FloatArray, FloatArray]:
    """The places (k, N, 3) nearest to the poses on the circuits of given places (k, N, 3).

    Also returns those on each circuit, (k, 2, N, 3).
    """
    batch, length = _in_one_order(batch), target.length
    both = rows_of(on_circuits(batch, target.poses, length), length)
    return on_own_circuits(batch, rows, both, target.poses, length), both


def _in_one_order(batch: LinkageBatch) -> LinkageBatch:
    """The same linkages, their dyads in the order of kinds and dimensions.

    The search for the nearest places samples the motion by the first dyad's input.
    """
    numbers = np.concatenate([batch.kinds[..., None], batch.dimensions], axis=-1)
    gap = numbers[:, 1] - numbers[:, 0]
    first = np.take_along_axis(gap, (gap != 0).argmax(axis=1)[:, None], axis=1)[:, 0]
    return batch.in_order(np.where((first < 0)[:, None], (1, 0), (0, 1)))


def best_places(found: Sequence[FoundLinkage]) -> int:
    """Of one linkage, judged in several ways, the number of the one that counts.

    Where it works, else where it breaks fewer limits; then the nearest to the poses.
    """

    def order(k: int) -> tuple[bool, int, float]:
        broken = sum(violation.kind == "limit" for violation in found[k].violations)
        return not found[k].usable, broken, found[k].combined_error

    return min(range(len(found)), key=order)
