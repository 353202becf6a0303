"""The map of a family as plain data: the object that `burmester synthesize --map FILE` writes.

The contract is `family_map.schema.json` beside this file.  A number that does not exist (the
transmission angle of a pair that does not work, a pivot at infinity) is null.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import CLASS_WORDS
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.regions import Polygon
from burmester.io.linkage_data import dimensions_data, numbers
from burmester.io.pose_data import poses_data
from burmester.requirements.links import LINK_RATIO, LONGEST_LINK, SHORTEST_LINK
from burmester.requirements.transmission import TRANSMISSION

SCHEMA = "burmester.family_map/1"


def family_map_data(found: FamilyMap, recommended: Linkage | None = None) -> dict[str, Any]:
    """The map as an object ready for JSON.

    recommended: the linkage of the task that is recommended; of a curve its place is told.
    """
    (classes, angle, driver), asked = found.verdicts, found.bounds.asked
    data: dict[str, Any] = {
        "schema": SCHEMA,
        "kind": found.kind,
        "length_unit": found.task.length_unit,
        "poses": poses_data(found.task.poses),
        "bounds": {
            **{each.name: asked[each] for each in (TRANSMISSION, LINK_RATIO)},
            "shortest_link": asked[SHORTEST_LINK],
            "longest_link": asked[LONGEST_LINK],
            "fixed_pivot": _corners(found.bounds.fixed),
            "moving_pivot": _corners(found.bounds.moving),
        },
        "class_words": list(CLASS_WORDS.values()),
    }
    if found.kind == "curve":
        assert isinstance(found.first, RR)
        data["curve"] = {
            "loop": found.loop.tolist(),
            "position": found.position.tolist(),
            **_circles(found.first),
        }
        data["recommended"] = None if recommended is None else found.places_of(recommended)
    else:
        data["chosen"] = dimensions_data(found.first)
        data["plane"] = _circles(found.second)
        data["poles"] = numbers(found.poles)
    return data | {
        "class": classes.tolist(),
        "transmission_deg": numbers(np.degrees(angle)),
        "driver": driver.tolist(),
    }


def _circles(dyads: RR) -> dict[str, Any]:
    return {
        "fixed_pivot": numbers(dyads.fixed_pivot),
        "moving_pivot": numbers(dyads.moving_pivot),
        "radius": numbers(dyads.radius),
    }


def _corners(region: Polygon | None) -> Any:
    """The corners of a region, where there is one."""
    return None if region is None else region.vertices.tolist()
