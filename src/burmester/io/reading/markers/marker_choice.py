"""Which markers of a recording are on the body: those that --points names, or the only two."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from burmester.errors import InputError
from burmester.io.files import quoted
from burmester.io.reading.markers.marker_header import MarkerHeader
from burmester.io.reading.markers.marker_recording import MarkerRecording, read_recording
from burmester.io.reading.pose_table import Source, shown
from burmester.numerics.arrays import FloatArray
from burmester.wording import listed, shortened

MAX_SUGGESTED = 24  # markers among which a pair is looked for that stays on one body
MIN_MOTION = 0.1  # of the motion of the marker that moves most; one that moves less is at rest
MAX_LISTED = 12  # markers that a message lists


def chosen_markers(header: MarkerHeader, points: str | None) -> MarkerRecording:
    """The recording of the markers that `points` names.

    points: names separated by commas; None takes the only two of a file.  Raises E102 to E108,
    and E114 where the markers are not known or not chosen.
    """
    if points is None:
        if len(header.markers) == 2:
            return read_recording(header, tuple(header.markers))._replace(chosen=True)
        raise _no_choice(header)
    names = tuple(_marker(word, header, points) for word in points.split(","))
    if len(names) < 2 or len(set(names)) < len(names):
        message = "a pose takes two different markers or more"
        raise _refusal(header, message, points)
    return read_recording(header, names)


def _marker(word: str, header: MarkerHeader, points: str) -> str:
    """The marker that a word names: by its name, without capitals, or without its subject."""
    word = word.strip()
    if word in header.markers:
        return word
    small, names = word.lower(), list(header.markers)
    for short in (names, [name.rpartition(":")[2] for name in names]):
        found = [name for name, each in zip(names, short, strict=True) if each.lower() == small]
        if len(found) == 1:
            return found[0]
    raise _refusal(header, f"there is no marker {shown(word)} in this file", points)


def _refusal(header: MarkerHeader, message: str, points: str) -> InputError:
    where = Source("--points", points).where(0, len(points))
    why, pair = _known_markers(header), _suggested(header)
    return InputError("E114", message, where=where, why=why, help=f"pass --points {_joined(pair)}")


def _no_choice(header: MarkerHeader) -> InputError:
    """E114, with a command that works: the pair whose distance varies least."""
    count, label = len(header.markers), header.source.label
    path = "-" if label == "<stdin>" else quoted(label)
    pair = _joined(_suggested(header))
    help = (
        "name two markers of the body (the origin first, the x axis points to the second), or "
        f"more to fit them all: `burmester synthesize {path} --points {pair}`"
    )
    message = f"this is a recording of {count} markers, and --points names none of them"
    return InputError("E114", message, where=header.where, why=_known_markers(header), help=help)


def _known_markers(header: MarkerHeader) -> str:
    return f"its markers are {listed(shortened(list(header.markers), MAX_LISTED))}"


def _joined(names: Sequence[str]) -> str:
    """Names as the option takes them, in quotes where a shell needs them."""
    return quoted(",".join(names))


def _suggested(header: MarkerHeader) -> tuple[str, str]:
    """The two moving markers whose distance varies least, among the first ones."""
    names = [name for name in header.markers if "," not in name][:MAX_SUGGESTED]
    best, pair = np.inf, tuple(names[:2])
    try:
        places = read_recording(header, tuple(names), one_mark=False).places
    except InputError:
        return pair[0], pair[1]
    moves = [_motion(places[:, k]) for k in range(len(names))]
    moving = [k for k in range(len(names)) if moves[k] > MIN_MOTION * max(moves)]
    for i, j in combinations(moving, 2):
        distance = np.linalg.norm(places[:, i] - places[:, j], axis=1)
        distance = distance[np.isfinite(distance)]
        # a pair that is seen in half of the frames is of little use
        if 2 * len(distance) >= len(places) and distance.size and distance.mean() > 0:
            change = float(distance.std() / distance.mean())
            if change < best:
                best, pair = change, (names[i], names[j])
    return pair[0], pair[1]


def _motion(places: FloatArray) -> float:
    """How far a marker moves about its mean, root mean square; 0 if it is never seen."""
    seen = places[np.isfinite(places).all(axis=1)]
    return float(np.sqrt(seen.var(axis=0).sum())) if len(seen) else 0.0
