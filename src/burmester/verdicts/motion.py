"""The motion of a linkage through the poses: of a film, of a table, of loads, of models.

It runs along one circuit, from the first pose that the driver reaches to the last, in the sense in
which the poses are met; with a driver that turns fully it may be a whole turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import LinkPlaces
from burmester.numerics.arrays import FloatArray

LOOKS: Final = 721  # places in which the driver's way is tabled
PROBES: Final = 9  # places that tell whether the driver goes evenly
CORRECTIONS: Final = 4  # of a share; each is nearly LOOKS times as close
CLOSE: Final = 1e-12  # of the driver's way


class Configuration(NamedTuple):
    """Where a linkage is for values (*,) of its driver; nan where these are beyond a dead point.

    driver: (*,), degrees in F, or lengths along its line where the driver slides; body: the poses
    (*,) of M in F; joints: their places (*, 2) in F by name, in the unit of the task.
    """

    driver: FloatArray
    body: Displacement
    joints: dict[str, FloatArray]


class Travels(Protocol):
    """A linkage of any kind that was judged."""

    def travel(self, whole: bool = False) -> Way:
        """Its motion, at whatever shares of it; see `Motion.of`."""
        ...


@final
@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Places (n,) of the body from the first pose to the last.

    places: (n,), of a four-bar with angles without jumps.
    drive: (n,), of the driver, without jumps: an angle if `in_turns`, or a length.  That of a
    four-bar (`DrivenLoop`) begins within the first turn, from 0 to 2 pi.
    pose_shares: (N,), the share of the motion, 0 to 1, at which each pose is met; nan for poses
    that the driver does not reach.
    links: the places (n,) of all bodies, where they came with those of the body.
    turns_fully: whether the driver can make full turns; full_turn: whether the motion is one, until
    all is as it was.
    """

    places: Displacement
    drive: FloatArray
    pose_shares: FloatArray
    in_turns: bool
    turns_fully: bool
    full_turn: bool
    links: LinkPlaces | None = None

    @classmethod
    def of(cls, chosen: Travels, count: int | ArrayLike, whole: bool = False) -> Motion:
        """The motion of a linkage in its task's unit.

        count: the number of places, 2 or more, or their shares (n,) of the motion, from 0 to 1.
        whole: a whole turn that begins at the first pose, if the driver turns fully.
        Of a four-bar that is not usable, only the poses on the branch with the most poses count.
        Raises InputError E163 where these are fewer than two, and where the linkage cannot be
        driven.
        """
        share = np.linspace(0.0, 1.0, count) if isinstance(count, int) else np.asarray(count, float)
        return chosen.travel(whole)(share)


Way: TypeAlias = Callable[[FloatArray], Motion]  # the motion at shares (n,) of it


def by_driver(way: Way) -> Way:
    """A motion at shares (n,) of what the driver goes, which may be others of the motion."""
    few = np.linspace(0.0, 1.0, PROBES)
    drive = way(few).drive
    if np.abs(drive - drive[0] - (drive[-1] - drive[0]) * few).max() < CLOSE * np.ptp(drive):
        return way  # the driver's own coordinate tells how far the motion is
    table = np.linspace(0.0, 1.0, LOOKS)
    drive = way(table).drive
    first, whole = drive[0], drive[-1] - drive[0]
    gone = (drive - first) / whole
    slope = np.maximum(np.gradient(gone, table), 1 / LOOKS)

    def there(share: FloatArray) -> Motion:
        at = np.interp(share, gone, table)
        for _ in range(CORRECTIONS):
            off = share - (way(at).drive - first) / whole
            at = np.clip(at + off / np.interp(at, table, slope), 0.0, 1.0)
            if np.abs(off).max() < CLOSE:  # before the correction, after which nothing is off
                break
        return way(at)

    return there
