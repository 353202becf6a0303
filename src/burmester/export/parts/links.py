"""A linkage as links with holes and slots, before their widths are chosen; millimetres."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, final, overload

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["GROUND", "Arrangement", "Hinge", "LinkPlaces", "Links", "Spacing"]

GROUND = "ground"


@final
class LinkPlaces:
    """Where the frames of links are in F, at places (*,) of the motion: by the name of a link."""

    def __init__(self, of: Mapping[str, Displacement]) -> None:
        self._of = of

    @property
    def shape(self) -> tuple[int, ...]:
        """The axes of the places."""
        return next(iter(self._of.values())).shape

    @overload
    def __getitem__(self, key: str) -> Displacement: ...
    @overload
    def __getitem__(self, key: Any) -> LinkPlaces: ...
    def __getitem__(self, key: Any) -> Displacement | LinkPlaces:
        """The places (*,) of a link by its name, or some places of all links by their indices."""
        if isinstance(key, str):
            return self._of[key]
        return LinkPlaces({name: each[key] for name, each in self._of.items()})


class Hinge(NamedTuple):
    """A pin that joins two links.

    holder: the link that holds it, at a point (2,) of its frame.  joins: both links; where one is
    the ground, it is the first.  on_ground: the number of the ground's hole or slot, if one is.
    name: of the joint, where it has one.
    """

    holder: str
    at: FloatArray
    joins: tuple[str, str]
    on_ground: int | None = None
    name: str = ""


class Spacing(NamedTuple):
    """How far two holes or slots of one moving link are apart.

    holes: what they are called; where there is no room for them, whose is too short.
    """

    holes: str
    fault: str
    apart: float


class Arrangement(NamedTuple):
    """The layer of each moving link, and of the ground under each hole or slot of the ground."""

    layers: Mapping[str, int]
    grounds: tuple[int, ...]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Links:
    """What plates and pins have to hold.

    features: of each link, the ground first: centres (1, 2) of holes, ends (2, 2) of slots, in its
    frame.  hinges: the pins.  poses, motion: the frames of links at the poses (N,), and along the
    stretch of the motion (n,) that holds them.
    body: the link whose frame is M.  moving: all links that move, as their colours are chosen.
    arms: of links that turn about the ground and end at the coupler, both pivots, in F and in M.
    lengths: whose median says how large the linkage is.  spacings: of holes on moving links.
    arrangements: which layers are tried, one after the other.
    """

    features: Mapping[str, Sequence[FloatArray]]
    hinges: tuple[Hinge, ...]
    poses: LinkPlaces
    motion: LinkPlaces
    body: str
    moving: tuple[str, ...]
    arms: Mapping[str, tuple[FloatArray, FloatArray]]
    lengths: tuple[float, ...]
    spacings: tuple[Spacing, ...]
    arrangements: Iterable[Arrangement]

    @property
    def size(self) -> float:
        """The median length."""
        return float(np.median([each for each in self.lengths if each > 0] or [1.0]))
