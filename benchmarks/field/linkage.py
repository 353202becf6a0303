"""A planar four-bar as plain numbers: what every tool's answer is written in.

Points are complex.  The body's frame M stands at d, turned by phi, in the ground's frame F:
a point m of M is at d + exp(i phi) m.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

Kind = Literal["RR", "PR", "RP"]


@dataclass(frozen=True, slots=True)
class Dyad:
    """What holds one point of the body, or one line of it.

    RR: |d + exp(i phi) moving - fixed| = size, a link with two pins.
    PR: Re(conj(n) (d + exp(i phi) moving)) = size, n = exp(i normal): a pin on a ground line.
    RP: Re(conj(n) exp(-i phi) (fixed - d)) = size: a ground pin in a straight slot of the body.
    """

    kind: Kind
    fixed: complex = 0j
    moving: complex = 0j
    size: float = 0.0
    normal: float = 0.0

    def to_json(self) -> list[Any]:
        fixed, moving = self.fixed, self.moving
        numbers = [fixed.real, fixed.imag, moving.real, moving.imag, self.size, self.normal]
        return [self.kind, *(float(number) for number in numbers)]

    @classmethod
    def from_json(cls, row: list[Any]) -> Dyad:
        kind, a, b, c, d, size, normal = row
        return cls(kind, complex(a, b), complex(c, d), size, normal)

    @property
    def ground_pivot(self) -> complex | None:
        """The pivot on the ground; a slider on the ground has none."""
        return None if self.kind == "PR" else self.fixed


@dataclass(frozen=True, slots=True)
class FourBar:
    """A body held by two dyads."""

    first: Dyad
    second: Dyad

    def to_json(self) -> list[Any]:
        return [self.first.to_json(), self.second.to_json()]

    @classmethod
    def from_json(cls, rows: list[Any]) -> FourBar:
        return cls(*map(Dyad.from_json, rows))
