"""Where the line of a slider may lie: how it is drawn, and the way back to what a rail allows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail

PR_KIND: Final = 1  # number of the kind in a batch


@final
@dataclass(frozen=True, slots=True, eq=False)
class RailFreedom:
    """A rail (kind PR) or a slot (kind RP), in the frames of an open task."""

    kind: int
    rail: Rail

    @classmethod
    def of(cls, limits: Limits, frames: CanonicalFrames) -> Self | None:
        """What limits say of the line; None where they say nothing."""
        unit = float(frames.length)
        if limits.rail is not None:
            return cls(PR_KIND, limits.rail.moved(np.asarray(frames.fixed_origin), unit))
        if limits.slot is not None:
            return cls(PR_KIND + 1, limits.slot.moved(np.asarray(frames.moving_origin), unit))
        return None

    @property
    def at(self) -> slice:
        """The dimensions of the line: the angle of its normal and its offset."""
        return slice(0, 2) if self.kind == PR_KIND else slice(2, 4)

    @property
    def pin(self) -> slice:
        """The dimensions of the pin."""
        return slice(2, 4) if self.kind == PR_KIND else slice(0, 2)

    def nearest(self, lines: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The lines (k, 2) on the rail nearest to lines, and how they may move (k, 2, 2).

        A line that is turned too far, or passes beside what it should pass through, may move along
        that limit.
        """
        back = lines.copy()
        along = np.broadcast_to(np.eye(2), (*lines.shape, 2)).copy()
        if (heading := self.rail.heading) is not None:
            off, within = self.rail.turned(lines[:, 0]), heading[1]
            back[:, 0] += off.clip(-within, within) - off
            along[(np.abs(off) > within) | (within == 0), 0, 0] = 0.0
        if (anchors := self.rail.anchors) is None:
            return back, along
        c, s = np.cos(back[:, 0]), np.sin(back[:, 0])
        at = np.stack([c, s], axis=-1) @ anchors.T
        across = np.stack([-s, c], axis=-1) @ anchors.T
        back[:, 1] = back[:, 1].clip(at.min(axis=1), at.max(axis=1))
        low, rows = at.argmin(axis=1), np.arange(len(lines))
        nearest = np.where(back[:, 1] == at[rows, low], low, at.argmax(axis=1))
        held = (back[:, 1] != lines[:, 1]) | (len(anchors) == 1)
        way = np.stack([along[:, 0, 0], along[:, 0, 0] * across[rows, nearest]], axis=-1)
        square = np.maximum((way * way).sum(axis=-1), 1e-300)[:, None, None]
        turning = way[:, :, None] * way[:, None, :] / square
        return back, np.where(held[:, None, None], turning, along)

    def pins_of(self, z: FloatArray, poses: Displacement) -> FloatArray:
        """The places (k, N, 2) of the pins of dyads z (k, 5), seen along the line."""
        seen = poses if self.kind == PR_KIND else poses.inverse()
        return seen.act(z[..., None, self.pin])

    def draw(
        self, z: FloatArray, poses: Displacement, rng: np.random.Generator
    ) -> tuple[FloatArray, FloatArray]:
        """Pins (k, 2), and lines (k, 2) for them, of dyads z (k, 5) whose pins are drawn already.

        Every other pin is moved so that it lies within the travel at one of the poses.
        """
        pin = z[:, self.pin].copy()
        travel = None if self.rail.travel is None else self.rail.travel.corners()
        if travel is not None:
            low, high = travel.min(axis=0), travel.max(axis=0)
            some = pin[::2]
            at = rng.integers(poses.shape[0], size=len(some))
            there = poses[at] if self.kind == PR_KIND else poses[at].inverse()
            pin[::2] = there.inverse().act(rng.uniform(low, high, size=some.shape))
        moved = z.copy()
        moved[:, self.pin] = pin
        pins = self.pins_of(moved, poses)
        _, _, v = np.linalg.svd(pins - pins.mean(axis=1, keepdims=True), full_matrices=False)
        angle = np.arctan2(v[:, -1, 1], v[:, -1, 0])
        if self.rail.heading is not None:  # the line is not drawn, it is stated
            middle, within = self.rail.heading[0] + np.pi / 2, self.rail.heading[1]
            angle = middle + rng.uniform(-within, within, size=len(angle))
        normal = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        offset = (pins.mean(axis=1) * normal).sum(axis=-1)
        return pin, self.nearest(np.stack([angle, offset], axis=-1))[0]

    def beyond(self, z: FloatArray, poses: Displacement) -> FloatArray:
        """How far the pins of dyads z (k, 5) leave the travel at poses, (k,)."""
        excess = self.rail.travel_excess(self.pins_of(z, poses))
        return np.asarray(np.maximum(excess.max(axis=-1), 0.0))
