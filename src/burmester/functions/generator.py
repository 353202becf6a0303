"""Function generators: four-bars as the angles of input and output see them.

The ground link runs from the input's pivot (0, 0) to the output's at (1, 0); other lengths are in
ground links.  The input link is at the angle theta = input phase + input, the output link at
phi = output phase + output.  Coupler and output link close the triangle over the diagonal from the
input link's pin to the output's pivot on one side of it or on the other; along a branch the side
stays the same.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import RR
from burmester.fourbar.instantaneous import crossing_angle
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray, Indexed, wrapped_angle


@final
@dataclass(frozen=True, slots=True, eq=False)
class Generator(Indexed):
    """Function generators (*,).

    input_link, coupler, output_link: lengths (*,) in ground links.
    input_phase, output_phase: (*,), radians.
    side: (*,), 1 or -1: the sign of the angle from the diagonal to the output link.
    """

    input_link: FloatArray
    coupler: FloatArray
    output_link: FloatArray
    input_phase: FloatArray
    output_phase: FloatArray
    side: FloatArray

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, np.asarray(getattr(self, each.name), dtype=float))

    def __len__(self) -> int:
        return len(self.input_link)

    @property
    def sizes(self) -> FloatArray:
        """The lengths (*, 4) of ground, input link, coupler and output link, in ground links."""
        one = np.ones_like(self.input_link)
        return np.stack([one, self.input_link, self.coupler, self.output_link], axis=-1)

    @property
    def link_ratio(self) -> FloatArray:
        """The longest of the four links over the shortest, (*,)."""
        return np.asarray(self.sizes.max(axis=-1) / self.sizes.min(axis=-1))

    def first_apart(self, distance: float, most: int, *, phases_only: bool) -> NDArray[np.intp]:
        """The indices of the first generators (k,) of which none is near an earlier one.

        distance: of phases and, unless they alone count, of the logarithms of links; on the other
            side of the diagonal a generator is never near.
        """
        phases = np.stack([self.input_phase, self.output_phase], axis=-1)
        place = np.concatenate([np.log(self.sizes[:, 1:]), self.side[:, None]], axis=1)
        chosen: list[int] = []
        left = np.ones(len(self), dtype=bool)
        while left.any() and len(chosen) < most:
            chosen.append(best := int(left.argmax()))
            away = np.abs(wrapped_angle(phases - phases[best])).max(axis=1)
            if not phases_only:
                away = np.maximum(away, np.abs(place - place[best]).max(axis=1))
            left &= away > distance
        return np.array(chosen, dtype=np.intp)

    def diagonal(self, inputs: FloatArray) -> FloatArray:
        """From the input link's pin to the output's pivot, complex (*, N), at inputs (N,)."""
        theta = self.input_phase[..., None] + inputs
        return np.asarray(1 - self.input_link[..., None] * np.exp(1j * theta))

    def outputs(self, inputs: FloatArray) -> FloatArray:
        """The outputs (*, N) at inputs (N,), in (-pi, pi]; nan where the linkage is open.

        Formula `structural-error` of the theory.
        """
        diagonal = self.diagonal(inputs)
        b, r = self.output_link[..., None], self.coupler[..., None]
        size = np.abs(diagonal)
        with np.errstate(invalid="ignore", divide="ignore"):
            opening = np.arccos((r * r - b * b - size * size) / (2 * b * size))
        phi = np.angle(diagonal) + self.side[..., None] * opening
        return wrapped_angle(phi - self.output_phase[..., None])

    def error(self, inputs: FloatArray, outputs: FloatArray) -> FloatArray:
        """The structural error (*, N): the true output less the one asked for, radians."""
        return wrapped_angle(self.outputs(inputs) - outputs)

    def with_better_side(
        self, inputs: FloatArray, outputs: FloatArray, weights: FloatArray | None = None
    ) -> Self:
        """The generators on the side of the diagonal where the errors are less.

        An input at which the linkage is open counts as half a turn.
        """
        costs = []
        for side in (1.0, -1.0):
            error = self._on(side).error(inputs, outputs)
            share = 1.0 if weights is None else weights
            costs.append((share * np.where(np.isnan(error), np.pi, error) ** 2).sum(axis=-1))
        return self._on(np.where(costs[0] <= costs[1], 1.0, -1.0))

    def _on(self, side: float | FloatArray) -> Self:
        return replace(self, side=np.broadcast_to(side, self.input_link.shape).copy())

    def reach(self, low: float, high: float) -> FloatArray:
        """The least and the greatest length (*, 2) of the diagonal over inputs from low to high.

        It grows and shrinks with the cosine of the input link's angle, so it is extreme at the ends
        or where the input link is in line with the ground link.
        """
        ends = np.abs(self.diagonal(np.array([low, high])))
        a = self.input_link
        least, greatest = ends.min(axis=-1), ends.max(axis=-1)
        start = self.input_phase + low
        least = np.where(_passes(start, high - low, 0.0), np.abs(1 - a), least)
        greatest = np.where(_passes(start, high - low, np.pi), 1 + a, greatest)
        return np.stack([least, greatest], axis=-1)

    def least_transmission(self, low: float, high: float) -> FloatArray:
        """The least transmission angle (*,) over inputs from low to high, in [0, pi/2], radians.

        The angle between coupler and output link; nan where the linkage opens or locks on the way.
        """
        b, r = self.output_link[..., None], self.coupler[..., None]
        return np.asarray(crossing_angle(r, b, self.reach(low, high)).min(axis=-1))

    def runs_through(self, low: float, high: float) -> NDArray[np.bool_]:
        """Whether (*,) the linkage goes from low to high on one branch, without a dead point."""
        reach = self.reach(low, high)
        least = np.abs(self.coupler - self.output_link)
        return np.asarray(
            (reach[..., 0] > least) & (reach[..., 1] < self.coupler + self.output_link)
        )

    def linkage(self, ground: float = 1.0) -> Linkage:
        """As four-bars whose input link drives: the coupler is the body.

        The frame of the ground has its origin at the input's pivot, and its x axis runs to the
        output's.  That of the body has its origin at the input link's pin, and its x axis runs to
        the output link's.
        """
        zero = np.zeros_like(self.coupler)
        origin = np.stack([zero, zero], axis=-1)
        return Linkage(
            RR(origin, origin, ground * self.input_link),
            RR(
                np.stack([zero + ground, zero], axis=-1),
                np.stack([ground * self.coupler, zero], axis=-1),
                ground * self.output_link,
            ),
        )

    def coupler_poses(self, inputs: FloatArray, ground: float = 1.0) -> FloatArray:
        """The places (*, N, 3) of that body at inputs (N,): x, y and angle in radians."""
        pin = 1 - self.diagonal(inputs)
        phi = self.output_phase[..., None] + self.outputs(inputs)
        other = 1 + self.output_link[..., None] * np.exp(1j * phi)
        return np.stack([ground * pin.real, ground * pin.imag, np.angle(other - pin)], axis=-1)


def _passes(start: FloatArray, span: float, angle: float) -> NDArray[np.bool_]:
    """Whether angles from start (*,) on over a span pass the angle, radians."""
    return np.asarray(np.mod(angle - start, 2 * np.pi) <= span)
