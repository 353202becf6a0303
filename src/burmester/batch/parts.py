"""Tasks as they are handed to workers: a part is so many of them, one after the other.

What a part holds is plain arrays, texts or numbers, so that a worker on another machine needs
none of the files that the tasks were read from.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

Names: TypeAlias = NDArray[np.int64] | tuple[str, ...]
Indices: TypeAlias = Sequence[int] | NDArray[np.intp]


@final
@dataclass(frozen=True, slots=True, eq=False)
class TableTasks:
    """Tasks out of a long table.

    names: of the tasks (T,); starts (T + 1,): the row at which each begins, and the end of the
    last; poses (R, 3): x, y and angle in the unit that `degrees` says; a number that is missing
    is nan, and an angle that is nan is free; weights (R,), exact (R,): None where no column has
    them.  pairs: whether they are tasks of function generators; then poses is (R, 2): inputs and
    outputs in that unit.  points: whether no row has an angle; then poses is (R, 2), or (R, 3)
    with angles of the crank.
    """

    names: Names
    starts: NDArray[np.int64]
    poses: FloatArray
    weights: FloatArray | None
    exact: NDArray[np.bool_] | None
    degrees: bool
    label: str
    pairs: bool = False
    points: bool = False

    def __len__(self) -> int:
        return len(self.names)

    @property
    def has_angles(self) -> bool:
        """Whether the rows are poses, whose angles may be free."""
        return not (self.pairs or self.points)

    @property
    def counts(self) -> NDArray[np.int64]:
        """The number of poses of each task (T,)."""
        return np.diff(self.starts)

    def only(self, indices: Indices) -> TableTasks:
        """Some of the tasks."""
        chosen = np.asarray(indices, dtype=np.int64)
        rows = self.rows(chosen)
        starts = np.concatenate([[0], np.cumsum(self.counts[chosen])])
        names: Names = _picked(self.names, chosen)
        return replace(
            self,
            names=names,
            starts=starts,
            poses=self.poses[rows],
            weights=None if self.weights is None else self.weights[rows],
            exact=None if self.exact is None else self.exact[rows],
        )

    def rows(self, chosen: NDArray[np.int64]) -> NDArray[np.int64]:
        """The rows of some tasks, one task after the other."""
        counts = self.counts[chosen]
        before = np.cumsum(counts) - counts
        shift: NDArray[np.int64] = np.repeat(self.starts[chosen] - before, counts)
        return shift + np.arange(counts.sum())


@final
@dataclass(frozen=True, slots=True)
class TextTasks:
    """Tasks in texts of their own: files of a folder, or lines of JSON.

    names: of the tasks; labels: what messages call their texts; data: the texts, as bytes.
    """

    names: tuple[str, ...]
    labels: tuple[str, ...]
    data: tuple[bytes, ...]

    def __len__(self) -> int:
        return len(self.names)

    def only(self, indices: Indices) -> TextTasks:
        """Some of the tasks."""
        return TextTasks(
            tuple(self.names[k] for k in indices),
            tuple(self.labels[k] for k in indices),
            tuple(self.data[k] for k in indices),
        )


@final
@dataclass(frozen=True, slots=True)
class DrawnTasks:
    """Tasks that are still to be drawn, by their numbers: each worker draws its own."""

    recipe: Any
    numbers: tuple[int, ...] | range

    def __len__(self) -> int:
        return len(self.numbers)

    def only(self, indices: Indices) -> DrawnTasks:
        """Some of the tasks."""
        return DrawnTasks(self.recipe, tuple(self.numbers[k] for k in indices))


Tasks: TypeAlias = TableTasks | TextTasks | DrawnTasks


@final
@dataclass(frozen=True, slots=True)
class Part:
    """A part: its number from 0, its tasks, and the share of the input up to its end."""

    number: int
    tasks: Tasks
    share: float


def _picked(names: Names, chosen: NDArray[np.int64]) -> Names:
    if isinstance(names, tuple):
        return tuple(names[k] for k in chosen.tolist())
    return names[chosen]
