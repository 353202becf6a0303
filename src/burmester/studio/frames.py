"""Followed answers as one binary frame: a header in JSON, then numbers.

    uint32    the length of the header, little end first
    header    JSON in UTF-8, with blanks at its end so that what follows begins at a multiple of 4
    float32   numbers, little end first

The header says of each piece of numbers where it starts and how many numbers it has; the start is
counted in numbers.  A way has five pieces of `count` numbers one after another: x, y, angle
(radians), drive (degrees, or a length), transmission (degrees).  The places of a linkage at the
poses are six such pieces: x, y, angle (degrees), position error, turned (degrees), transmission.
nan stands for a number that does not exist.  `web/studio/frames.mjs` reads it.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np

from burmester.following.followed import Followed
from burmester.fourbar.defects import Driven
from burmester.io.linkage_data import dyad_data, number
from burmester.linkages.explanation import reasons
from burmester.linkages.found_linkage import FoundLinkage
from burmester.web.branches import Branches

__all__ = ["followed_frame", "frame"]

WAY = ("x", "y", "angle", "drive", "transmission")


class _Numbers:
    """The numbers behind a header."""

    def __init__(self) -> None:
        self._pieces: list[np.ndarray] = []
        self._count = 0

    def add(self, *pieces: Sequence[float | None] | np.ndarray) -> int:
        """Append pieces; where the first of them starts."""
        start = self._count
        for piece in pieces:
            # As an array of float, None becomes nan.
            array = np.asarray(piece, dtype=np.float64).astype("<f4")
            self._pieces.append(array)
            self._count += array.size
        return start

    def bytes(self) -> bytes:
        return b"".join(piece.tobytes() for piece in self._pieces)


def frame(header: dict[str, Any], numbers: bytes) -> bytes:
    """A header and numbers as one frame."""
    text = json.dumps(header, allow_nan=False, separators=(",", ":")).encode("ascii")
    text += b" " * (-len(text) % 4)
    return struct.pack("<I", len(text)) + text + numbers


def followed_frame(
    n: int, followed: Followed, motion: dict[str, Branches], uncertain: Sequence[str] = ()
) -> bytes:
    """Answers that were followed; motion: the ways of the linkages that are shown, by their ids."""
    numbers = _Numbers()
    with np.errstate(over="ignore", invalid="ignore"):
        linkages = [
            _linkage(followed, each, motion.get(each.id), numbers) for each in followed.linkages
        ]
    header = {
        "n": n,
        "kind": "followed",
        "linkages": linkages,
        "vanished": [
            {"id": each.id, "message": each.message}
            for each in followed.changes
            if each.kind == "vanished" and each.id.startswith("L")
        ],
        "changes": [
            {"id": each.id, "kind": each.kind, "message": each.message} for each in followed.changes
        ],
        "uncertain": [*uncertain, *followed.uncertain],
        "complete": followed.complete,
    }
    return frame(header, numbers.bytes())


def _linkage(
    followed: Followed, found: FoundLinkage, motion: Branches | None, numbers: _Numbers
) -> dict[str, Any]:
    """What the header says of a linkage; its numbers are added to the others."""
    error, driven = found.error, found.driven
    places = error.places
    return {
        "id": found.id,
        "rank": found.rank,
        "usable": found.usable,
        "type": found.type,
        "driver": found.driver,
        "verdict": "usable" if found.usable else "not usable",
        "reason": None if found.usable else "; ".join(reasons(found, followed.task)),
        "rms": number(error.rms),
        "worst": number(error.worst),
        "worst_deg": number(math.degrees(float(error.angle.max()))),
        "combined": number(found.combined_error),
        "transmission_deg": _least(driven),
        "dyads": [each.id for each in found.dyads],
        "led": [dyad_data(each, places) for each in found.dyads_driver_first],
        "ways": None if motion is None else [_way(each, numbers) for each in motion.ways],
        "at": None if motion is None else motion.at,
        "poses": {
            "count": places.shape[0],
            "start": numbers.add(
                places.translation[:, 0],
                places.translation[:, 1],
                np.degrees(places.angle),
                error.position,
                np.degrees(error.angle),
                np.degrees(driven.transmission),
            ),
        },
    }


def _least(driven: Driven) -> float | None:
    return number(math.degrees(driven.least_over_range))


def _way(way: dict[str, Any], numbers: _Numbers) -> dict[str, Any]:
    facts = {key: value for key, value in way.items() if key not in WAY}
    start = numbers.add(*(way[name] for name in WAY))
    return {**facts, "count": len(way["x"]), "start": start}
