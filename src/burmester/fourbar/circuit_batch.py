"""Circuits of linkages of mixed kinds, with what `Circuits` has for one pair of kinds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits, Location
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import put

__all__ = ["AnyCircuits", "CircuitBatch"]

Index: TypeAlias = NDArray[np.intp]


@final
@dataclass(frozen=True, slots=True, eq=False)
class CircuitBatch:
    """Circuits (k, *) of linkages (k,), each driven by its first dyad.

    groups: for each pair of kinds the indices (n,) of its linkages, and their circuits (n, *).
    group, row: (k,), for each linkage its group and its index there.
    """

    groups: tuple[tuple[Index, Circuits], ...]
    group: Index
    row: Index

    @classmethod
    def of(cls, batch: LinkageBatch) -> Self:
        """The circuits (k, 2) of linkages (k,) as given; see `Circuits.of`."""
        return cls.of_groups(batch.alike(), len(batch))

    @classmethod
    def of_groups(cls, groups: Iterable[tuple[Index, Linkage]], count: int) -> Self:
        """The circuits (count, 2), as given, of linkages with their indices, a group a pair."""
        return cls._of([(index, Circuits.of(each, as_given=True)) for index, each in groups], count)

    @classmethod
    def _of(cls, groups: list[tuple[Index, Circuits]], count: int) -> Self:
        group, row = np.zeros((2, count), dtype=np.intp)
        for number, (index, _) in enumerate(groups):
            group[index], row[index] = number, np.arange(len(index))
        return cls(tuple(groups), group, row)

    def __getitem__(self, index: Any) -> CircuitBatch:
        """Pick linkages, or circuits (n,) by linkages and numbers: two arrays (n,)."""
        rows, *rest = index if isinstance(index, tuple) else (index,)
        rows = np.arange(len(self.group))[rows]
        groups = []
        for number, (_, circuits) in enumerate(self.groups):
            here = np.flatnonzero(self.group[rows] == number)
            if len(here):
                own = [each[here] if isinstance(each, np.ndarray) else each for each in rest]
                groups.append((here, circuits[(self.row[rows[here]], *own)]))
        return self._of(groups, len(rows))

    def exchanged(self) -> CircuitBatch:
        """The circuits (k, 2) of the same linkages, driven by their second dyads."""
        return CircuitBatch(
            tuple((index, each.exchanged()) for index, each in self.groups), self.group, self.row
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes."""
        trailing = self.groups[0][1].shape[1:] if self.groups else ()
        return (len(self.group), *trailing)

    @property
    def range_type(self) -> NDArray[np.int8]:
        """The type of the range of each circuit, (k, *)."""
        return self._joined(lambda each: each.range_type, np.int8)

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Whether the circuit exists, (k, *)."""
        return self._joined(lambda each: each.exists, np.bool_)

    @property
    def near_change_point(self) -> NDArray[np.bool_]:
        """Whether the linkage is within 1e-9 of a change point, (k, *)."""
        return self._joined(lambda each: each.near_change_point, np.bool_)

    @property
    def branches(self) -> NDArray[np.int8]:
        """The number of branches of the circuit, (k, *): 1 without dead points, else 2."""
        return self._joined(lambda each: each.branches, np.int8)

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Whether the circuit returns to its start, (k, *)."""
        return self._joined(lambda each: each.closed, np.bool_)

    @property
    def turns(self) -> NDArray[np.bool_]:
        """Whether the input is an angle, (k, *)."""
        return self._joined(lambda each: each.turns, np.bool_)

    def couplers(self, parameter: FloatArray) -> Displacement:
        """Coupler places (k, *, n) at parameters (n,) or (k, *, n); nan without a circuit."""
        shared = np.ndim(parameter) == 1
        shape = (*self.shape, np.shape(parameter)[-1])
        return self._places(
            lambda index, each: each.couplers(parameter if shared else parameter[index]), shape
        )

    def inputs(self, parameter: FloatArray, places: Displacement) -> FloatArray:
        """The inputs (k, n) at places (k, n) of these circuits, without jumps."""
        out = np.empty(places.shape)
        for index, each in self.groups:
            out[index] = each.inputs(parameter[index], places[index])
        return out

    def locate(self, places: Displacement) -> Location:
        """The circuit (of k, 2), the branch and the parameter of coupler places (k, *)."""
        found = Location.none(places.shape)
        for index, each in self.groups:
            put(found, index, each.locate(places[index]))
        return found

    def _joined(self, values: Callable[[Circuits], NDArray[Any]], dtype: Any) -> NDArray[Any]:
        out = np.empty(self.shape, dtype=dtype)
        for index, each in self.groups:
            out[index] = values(each)
        return out

    def _places(
        self, places: Callable[[Index, Circuits], Displacement], shape: tuple[int, ...]
    ) -> Displacement:
        translation, angle = np.empty((*shape, 2)), np.empty(shape)
        for index, each in self.groups:
            found = places(index, each)
            translation[index], angle[index] = found.translation, found.angle
        return Displacement(translation, angle)


AnyCircuits: TypeAlias = Circuits | CircuitBatch
