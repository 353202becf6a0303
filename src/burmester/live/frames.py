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
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from burmester.following.followed import Followed
from burmester.io.linkage_data import dyad_data, number
from burmester.linkages.evaluation import transmission_at_given_poses
from burmester.numerics.arrays import FloatArray
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import reasons
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.branches import Branches

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
            with np.errstate(over="ignore", invalid="ignore"):
                array = np.asarray(piece, dtype=np.float64).astype("<f4")
            self._pieces.append(array)
            self._count += array.size
        return start

    def of_way(self, way: dict[str, Any]) -> dict[str, Any]:
        """Append the numbers of a way; the rest of it, and where they are."""
        facts = {key: value for key, value in way.items() if key not in WAY}
        start = self.add(*(way[name] for name in WAY))
        return {**facts, "count": len(way["x"]), "start": start}

    def bytes(self) -> bytes:
        return b"".join(piece.tobytes() for piece in self._pieces)


def frame(header: dict[str, Any], numbers: bytes) -> bytes:
    """A header and numbers as one frame."""
    text = json.dumps(header, allow_nan=False, separators=(",", ":")).encode("ascii")
    text += b" " * (-len(text) % 4)
    return struct.pack("<I", len(text)) + text + numbers


class Drawn(NamedTuple):
    """What a frame says of a linkage: facts for the header, and its places at the poses."""

    found: FoundLinkage
    facts: dict[str, Any]
    places: FloatArray


def followed_frame(
    n: int,
    followed: Followed,
    motion: Mapping[str, Branches],
    drawn: Mapping[str, Drawn] = MappingProxyType({}),
    *,
    start: int | None = None,
) -> tuple[bytes, dict[str, Drawn]]:
    """Answers that were followed, and what was drawn of them.

    start: the number of the message whose answer they go on from.
    motion: the ways of the linkages that are shown, by their ids.
    drawn: what the frame before has drawn: linkages that were not judged since are as they were,
    and the frame names them only.
    """
    numbers, linkages, now = _Numbers(), [], {}
    for found in followed.linkages:
        last = drawn.get(found.id)
        fresh = last is None or last.found is not found
        one = _drawn(followed.problem, found) if last is None or fresh else last
        now[found.id] = one
        ways = motion.get(found.id)
        if ways is None and not fresh:
            linkages.append({"id": found.id, "fresh": False})
            continue
        linkages.append(
            {
                **one.facts,
                "fresh": fresh,
                "ways": None if ways is None else [numbers.of_way(each) for each in ways.ways],
                "at": None if ways is None else ways.at,
                "poses": {"count": len(found.error.position), "start": numbers.add(one.places)},
            }
        )
    changes = [{"id": e.id, "kind": e.kind, "message": e.message} for e in followed.changes]
    header = {
        "n": n,
        "kind": "followed",
        "from": start,
        "linkages": linkages,
        "vanished": [
            {"id": each["id"], "message": each["message"]}
            for each in changes
            if each["kind"] == "vanished" and each["id"].startswith("L")
        ],
        "changes": changes,
        "uncertain": list(followed.uncertain),
        "complete": followed.complete,
    }
    return frame(header, numbers.bytes()), now


def drawn_of(problem: SynthesisProblem, linkages: Sequence[FoundLinkage]) -> dict[str, Drawn]:
    """What a frame would say of linkages: of a search, say, from which a follow goes on."""
    return {each.id: _drawn(problem, each) for each in linkages}


def _drawn(problem: SynthesisProblem, found: FoundLinkage) -> Drawn:
    """What is said of a linkage."""
    error, driven = found.error, found.driven
    places = error.places
    facts = {
        "id": found.id,
        "rank": found.rank,
        "usable": found.usable,
        "type": found.type,
        "driver": found.driver,
        "verdict": "usable" if found.usable else "not usable",
        "reason": None if found.usable else "; ".join(reasons(found, problem.given)),
        "rms": number(error.rms),
        "worst": number(error.worst),
        "worst_deg": number(math.degrees(float(error.angle.max()))),
        "combined": number(found.combined_error),
        "transmission_deg": number(math.degrees(driven.least_over_range)),
        "dyads": [each.id for each in found.dyads],
        "led": [dyad_data(each, places) for each in found.dyads_driver_first],
    }
    at_poses = np.concatenate(
        [
            places.translation.T.ravel(),
            np.degrees(places.angle),
            error.position,
            np.degrees(error.angle),
            np.degrees(transmission_at_given_poses(found, problem)),
        ]
    )
    return Drawn(found, facts, at_poses)
