"""How a task of points is a path: whether it is closed, and how the crank times it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.values import real_numbers

LEAST_TIMED: Final = 5  # points; fewer of them with crank angles leave infinitely many linkages


@final
@dataclass(frozen=True, slots=True, eq=False)
class TracedPath:
    """How N points are traced.

    Attributes
    ----------
    closed : bool
        Whether the path leads from the last point back to the first; the crank of a linkage then
        goes all the way round.
    crank_angles : (N,) array, optional
        By how much the crank has turned at each point, in radians; all of them may be shifted by
        one angle.

    Raises
    ------
    InputError
        E186 (crank angles that are no row of numbers, that are too few, or that are all the same).

    Examples
    --------
    >>> import numpy as np
    >>> TracedPath(closed=True).closed
    True
    >>> TracedPath(crank_angles=np.radians([0, 30]))
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E186]: 2 points with crank angles: too few for a linkage
      why: fewer than 5 leave infinitely many linkages
      help: give 5 points with their crank angles, or more; or leave the crank angles out
    """

    closed: bool = False
    crank_angles: FloatArray | None = None

    def __post_init__(self) -> None:
        if self.crank_angles is None:
            return
        angles = real_numbers(self.crank_angles, (None,), "the crank angles", code="E186")
        if len(angles) < LEAST_TIMED:
            raise InputError(
                "E186",
                f"{len(angles)} points with crank angles: too few for a linkage",
                why=f"fewer than {LEAST_TIMED} leave infinitely many linkages",
                help=f"give {LEAST_TIMED} points with their crank angles, or more; or leave the "
                "crank angles out",
            )
        if np.ptp(angles) == 0:
            raise InputError(
                "E186",
                "the crank angles are all the same",
                why="a crank that stands still traces one point only",
                help="give the angle by which the crank has turned at each point",
            )
        object.__setattr__(self, "crank_angles", angles)

    def at(self, index: NDArray[np.intp]) -> TracedPath:
        """The same of some points; they are closed as all were."""
        angles = self.crank_angles
        if angles is None or index.max(initial=-1) >= len(angles):  # which the task refuses
            return self
        return TracedPath(self.closed, angles[index])

    def require_fitting(self, count: int) -> None:
        """Refuse crank angles of another number of points: E186."""
        if self.crank_angles is not None and len(self.crank_angles) != count:
            raise InputError(
                "E186",
                f"crank angles of {len(self.crank_angles)} points, and {count} points",
                help="give a crank angle for every point, or for none",
            )
