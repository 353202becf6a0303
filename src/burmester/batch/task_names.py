"""Names of tasks, each of which may be there once only, in a table of any length.

Names that go up, or down, from part to part cost no memory.  Others cost eight bytes each: what is
kept of a name is a digest, or the name itself where it is a number.  Two names may have the same
digest; before a name is called a repetition, the names before it are read again.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

Digests: TypeAlias = NDArray[np.int64]


def digests(names: Any) -> Digests:
    """Eight bytes for each of some names (T,), an Arrow array: numbers are their own."""
    from pyarrow import types  # noqa: PLC0415  an extra

    if types.is_integer(names.type):
        own: Digests = names.to_numpy(zero_copy_only=False)
        return own
    texts = (name.encode() for name in names.to_pylist())
    bytes_of = b"".join(hashlib.blake2b(text, digest_size=8).digest() for text in texts)
    return np.frombuffer(bytes_of, dtype=np.int64)


@final
class TaskNames:
    """Which names there were.

    earlier: the names, in Arrow arrays, that stand before a row of the table.
    """

    def __init__(
        self,
        earlier: Callable[[int], Iterator[Any]],
        digests: Callable[[Any], Digests] = digests,
    ) -> None:
        self._earlier, self._digests = earlier, digests
        self._bounds: tuple[Any, Any] | None = None  # the least and the greatest name so far
        self._known: list[Digests] | None = None  # sorted, each longer than the next

    def repeated(self, names: Any, row: int) -> Any | None:
        """One of the names of a part that stands before the part's first row, too, if any does.

        names: an Arrow array, in which each is once.
        """
        if self._known is None:
            if self._beyond(names):
                return None
            self._known = []
            for some in self._earlier(row):
                self._keep(self._digests(some.unique()))
        new = self._digests(names)
        again = np.zeros(len(new), dtype=bool)
        for known in self._known:
            at = np.minimum(np.searchsorted(known, new), len(known) - 1)
            again |= known[at] == new
        self._keep(new)
        return self._confirmed(names.take(np.flatnonzero(again)), row) if again.any() else None

    def _beyond(self, names: Any) -> bool:
        """Whether all names of a part are above, or below, all before."""
        import pyarrow.compute as pc  # noqa: PLC0415

        found = pc.min_max(names).as_py()
        least, most = found["min"], found["max"]
        if self._bounds is None:
            self._bounds = (least, most)
        elif least > self._bounds[1]:
            self._bounds = (self._bounds[0], most)
        elif most < self._bounds[0]:
            self._bounds = (least, self._bounds[1])
        else:
            return False
        return True

    def _keep(self, new: Digests) -> None:
        assert self._known is not None
        new = np.sort(new)
        while self._known and len(self._known[-1]) <= len(new):
            new = np.sort(np.concatenate([self._known.pop(), new]), kind="stable")
        if len(new):
            self._known.append(new)

    def _confirmed(self, names: Any, row: int) -> Any | None:
        suspected = set(names.to_pylist())
        for some in self._earlier(row):
            if there := suspected.intersection(some.unique().to_pylist()):
                return min(there)
        return None
