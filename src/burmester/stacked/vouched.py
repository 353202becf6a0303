"""The dyads of tasks that the stacked road vouches for, with what is to be said of them."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.bundles import take
from burmester.stacked.advice import DyadAdvice
from burmester.stacked.answers import DyadRows, Status
from burmester.stacked.found_dyads import Fits, Found

__all__ = ["Vouched"]


class Vouched(NamedTuple):
    """Tasks (V,) by their indices in a stack, rising, and what was found for them.

    status: (D,), of the dyads of `found`, in `DyadRows.STATUSES`.
    """

    tasks: NDArray[np.intp]
    fits: Fits
    found: Found
    advice: DyadAdvice
    status: NDArray[np.int8]

    @classmethod
    def of(cls, tasks: NDArray[np.intp], status: Status, fits: Fits, found: Found) -> Self:
        """All of the tasks; the dyads are all of one status."""
        number = DyadRows.STATUSES.index(status)
        statuses = np.full(len(found.task), number, dtype=np.int8)
        return cls(tasks, fits, found, DyadAdvice.of(fits, found), statuses)

    def of_those(self, mask: NDArray[np.bool_]) -> Vouched:
        """Some of the tasks only, by a mask (V,)."""
        if mask.all():
            return self
        fits, found, advice = self.fits.of_those(mask), self.found.of_those(mask), self.advice
        status = self.status[mask[self.found.task]]
        return Vouched(self.tasks[mask], fits, found, take(advice, mask), status)
