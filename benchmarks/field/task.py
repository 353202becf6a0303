"""A task as every tool gets it: poses, points of a path, or pairs of angles, always in order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from benchmarks.field.linkage import FourBar

EXACT = 1e-3  # of the span: poses that a linkage passes, or passes but for their last digit
NOISE = 4.0  # times the standard deviation of the noise
NO_LINKAGE = 2e-2  # of the span: motions and shapes that no four-bar makes
FUNCTION = 5e-3  # of the output's range: functions
DISC = 0.25  # of the span: the radius of the disc about M's origin by which errors are measured


@dataclass(frozen=True, slots=True)
class Pivots:
    """Where ground pivots may be: both in one box, both on one line, or one at each of two points.

    places: lower left and upper right corner; two points of the line; the two points.
    """

    kind: Literal["box", "line", "points"]
    places: tuple[complex, complex]

    def off(self, pivot: complex) -> float:
        """How far a pivot is from where it may be."""
        a, b = self.places
        if self.kind == "line":
            return abs(((pivot - a) * np.conj(b - a)).imag) / abs(b - a)
        if self.kind == "points":
            return min(abs(pivot - a), abs(pivot - b))
        inside = complex(np.clip(pivot.real, a.real, b.real), np.clip(pivot.imag, a.imag, b.imag))
        return abs(pivot - inside)


@dataclass(frozen=True)
class FieldTask:
    """One task.

    rows: (N, 3) x, y, angle in radians; (N, 2) points of a path; (N, 2) angles of the input and
        the output link, radians, each from a zero of its own, where `is_function`.
    tolerance: the greatest error with which it counts as solved, in spans.
    known: linkages that solve it, where they can be known.
    closed: whether a path leads from its last point back to the first, and a drive turns fully.
    crank: (N,) by how much the drive has turned at each point of a path, radians, if it matters.
    """

    name: str
    kind: str
    source: str
    rows: np.ndarray
    tolerance: float
    pivots: Pivots | None = None
    known: tuple[FourBar, ...] = ()
    is_function: bool = False
    closed: bool = False
    crank: np.ndarray | None = None

    @property
    def is_path(self) -> bool:
        return self.rows.shape[1] == 2 and not self.is_function

    @cached_property
    def way(self) -> np.ndarray:
        """The points of a path from the first to the last, which is the first of a closed one."""
        return np.append(self.places, self.places[:1]) if self.closed else self.places

    @cached_property
    def places(self) -> np.ndarray:
        """Where M's origin has to be, complex (N,)."""
        return self.rows[:, 0] + 1j * self.rows[:, 1]

    @cached_property
    def angles(self) -> np.ndarray:
        if self.rows.shape[1] == 2:
            raise ValueError(f"{self.name} has no angles")
        return self.rows[:, 2]

    @cached_property
    def span(self) -> float:
        """The diagonal of the box around the positions; of a function the output's range."""
        if self.is_function:
            return float(np.ptp(self.rows[:, 1]))
        return float(np.hypot(*np.ptp(self.rows[:, :2], axis=0)))

    @property
    def disc(self) -> float:
        """A length that counts as one radian; nothing for a path."""
        return 0.0 if self.is_path else DISC * self.span

    def to_json(self) -> dict[str, Any]:
        out: dict[str, Any] = {
            "name": self.name,
            "kind": self.kind,
            "source": self.source,
            "rows": self.rows.tolist(),
            "tolerance": self.tolerance,
            "known": [four_bar.to_json() for four_bar in self.known],
            "is_function": self.is_function,
            "closed": self.closed,
            "crank": None if self.crank is None else self.crank.tolist(),
        }
        if self.pivots is not None:
            places = [[place.real, place.imag] for place in self.pivots.places]
            out["pivots"] = {"kind": self.pivots.kind, "places": places}
        return out

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> FieldTask:
        pivots = None
        if "pivots" in data:
            a, b = (complex(*place) for place in data["pivots"]["places"])
            pivots = Pivots(data["pivots"]["kind"], (a, b))
        known = tuple(map(FourBar.from_json, data["known"]))
        rows = np.array(data["rows"], dtype=float)
        names = (data["name"], data["kind"], data["source"])
        crank = None if data["crank"] is None else np.array(data["crank"])
        what = (data["is_function"], data["closed"], crank)
        return cls(*names, rows, data["tolerance"], pivots, known, *what)
