"""Where the links of a linkage are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, final, overload

from burmester.geometry.displacement import Displacement

GROUND: Final = "ground"


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
