"""Surroundings as a file states them, and as a result holds them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from burmester.tasks.surroundings import KeepOut, Surroundings


class StatedSurroundings(NamedTuple):
    """Surroundings as stated: regions, the other fields of `Surroundings`, and where."""

    keep_out: tuple[KeepOut, ...] = ()
    values: Mapping[str, Any] = MappingProxyType({})
    where: str = ""

    def surroundings(self) -> Surroundings | None:
        """The surroundings, or None where nothing is stated."""
        if not self.keep_out and not self.values:
            return None
        return Surroundings(self.keep_out, **self.values)


def surroundings_data(around: Surroundings) -> dict[str, Any]:
    """The surroundings as a file may hold them: the keys `keep_out` and `surroundings`."""
    regions = []
    for each in around.keep_out:
        region: dict[str, Any] = {"polygon": each.polygon.vertices.tolist()}
        regions.append({"name": each.name, **region} if each.name else region)
    values = {
        "link_width": around.link_width,
        "margin": around.margin,
        "body_in_plane": around.body_in_plane,
    }
    return {"keep_out": regions, "surroundings": values}
