"""Certificates: which answers of a task are proved, and how near they are to the exact ones.

Everything here is about the very doubles in the poses and weights, taken as exact numbers; `balls`
has the arithmetic and `proofs` the arguments.  A fit's frames are doubles as well: c = length c'
+ origin is exact in balls, and radii are told in the task's unit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, Context
from math import inf
from typing import final

from burmester.certificates.ball_arithmetic import (
    Ball,
    Matrix,
    Motion,
    descends,
    flint,
    nonzero,
    positive,
    upper,
    zero_near,
)
from burmester.certificates.proofs import (
    NEAR,
    circle_distances,
    circle_of,
    different,
    five_equations,
    gram_of,
    grows,
    infinity_takes_eight,
    proved_zeros,
    squared_residual,
    stationary_line,
    sure_least,
)
from burmester.dyads.critical_points import COUNT, CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["Certificate", "CertifiedDyad", "certify", "certify_five"]

PRECISIONS = (128, 384)  # bits; the second where the first does not settle everything
ROOTS = 4  # dyads through five poses, real or not


@final
@dataclass(frozen=True, slots=True, eq=False)
class CertifiedDyad:
    """How near a reported dyad is to an exact one.

    index: its place among the reported dyads, from 0; kind: RR, PR, RP or PP.
    proved: whether an exact one (see `certify` and `certify_five`) surely lies within `radius`,
        and `radius` is small against the dyad.
    radius: bounds the error of each pivot, of the length of the link and of a line's offset,
        in the task's unit; angle_radius: that of a line's normal, in radians.  Infinite where
        no exact one is known.
    minimum: whether the exact one is surely a strict local minimum; a line, the only global one.
    """

    index: int
    kind: str
    proved: bool
    radius: float
    angle_radius: float
    minimum: bool


@final
@dataclass(frozen=True, slots=True, eq=False)
class Certificate:
    """What is proved about the answers of a task.

    complete: whether the critical points (`certify`) or the roots (`certify_five`) that were
        computed are proved to be all there are, each real or not and a minimum or not as told.
    proved, numerical: sentences for the user: what is proved, and what is only computed.
    dyads: one entry for each reported dyad; `complete` says nothing of them.
    """

    complete: bool
    proved: tuple[str, ...]
    numerical: tuple[str, ...]
    dyads: tuple[CertifiedDyad, ...]


def certify(
    poses: Displacement,
    weights: FloatArray | None,
    critical: CriticalDyads,
    dyads: Sequence[Dyad],
) -> Certificate:
    """Prove what can be proved of the answers for poses (N,), N >= 5, of one task.

    critical: of these poses and weights.  dyads: those reported, one by one; the exact ones are,
    for RR, a strict local minimum of the weighted sum of (|R m + d - c| - r)², and for PR and RP
    a stationary line of the weighted sum of squared distances, the best of all where `minimum`.
    A proof that fails is told, not raised.  Raises InputError E130 without python-flint.
    """

    def attempt() -> Certificate:
        motion = Motion.of(poses, weights, critical.frames)
        complete, proved, numerical = _critical_points(motion, critical)
        numerical.append(
            "the sum of squared true distances may have minima other than those reported, which "
            "were reached from the minima of the squared circle residual"
        )
        judged = [_least_dyad(motion, index, dyad) for index, dyad in enumerate(dyads)]
        return _certificate(complete, proved, numerical, judged)

    return _settled(attempt)


def certify_five(poses: Displacement, five: FivePoseDyads, dyads: Sequence[Dyad]) -> Certificate:
    """Prove what can be proved of the dyads through poses (5,), of one task.

    five: of these poses.  dyads: those reported, one by one; the exact ones are circles through
    all poses.  A slider is never proved: the slightest rounding of its poses makes it a circle,
    with an enormous link.  Else as `certify`.
    """

    def attempt() -> Certificate:
        motion = Motion.of(poses, None, five.frames)
        complete, proved, numerical, roots = _five_roots(motion, five)
        judged = [_exact_dyad(motion, roots, index, dyad) for index, dyad in enumerate(dyads)]
        return _certificate(complete, proved, numerical, judged)

    return _settled(attempt)


def _settled(attempt: Callable[[], Certificate]) -> Certificate:
    """The certificate at the first precision that settles everything, else at the last."""
    for bits in PRECISIONS:
        with flint().ctx.workprec(bits):
            certificate = attempt()
        if certificate.complete and all(dyad.proved for dyad in certificate.dyads):
            break
    return certificate


def _certificate(
    complete: bool,
    proved: list[str],
    numerical: list[str],
    judged: Sequence[tuple[CertifiedDyad, str]],
) -> Certificate:
    for item, sentence in judged:
        place = proved if item.proved else numerical
        place.append(f"dyad {item.index + 1} ({item.kind}): {sentence}")
    return Certificate(complete, tuple(proved), tuple(numerical), tuple(i for i, _ in judged))


def _told(bound: float) -> str:
    """A bound with two digits, rounded up."""
    return f"{Context(prec=2, rounding=ROUND_CEILING).create_decimal(bound):.1e}"


# --- the critical points of the squared residual


def _critical_points(motion: Motion, critical: CriticalDyads) -> tuple[bool, list[str], list[str]]:
    """Whether the critical points are proved to be all; what is proved; what is not."""
    found = int(critical.found)
    gram = gram_of(motion)
    system = squared_residual(gram)
    zeros = proved_zeros(
        lambda _: system,
        critical.points[:found],
        critical.real[:found],
        lambda a, b: not a.overlaps(b),
    )
    said = {k: bool(critical.minimum[k]) for k in zeros.real}
    sure = {k: (positive if said[k] else descends)(system(box)[1]) for k, box in zeros.real.items()}
    minima = [box for k, box in zeros.real.items() if said[k] and sure[k]]
    eight = infinity_takes_eight(gram)
    proved: list[str] = []
    numerical: list[str] = []
    if zeros.total:
        proved.append(
            f"{zeros.total} critical points of the squared circle residual, each alone in a box "
            f"of its own, each coordinate within {_told(upper(zeros.error * motion.length))} of "
            f"the computed; {len(zeros.real)} are real, {len(zeros.others)} are not"
        )
    if zeros.total < found:
        numerical.append(f"{found - zeros.total} critical points are computed and not proved")
    if not all(sure.values()):
        unsure = list(sure.values()).count(False)
        numerical.append(f"whether {unsure} of the real ones are minima is computed, not proved")
    if zeros.total == COUNT and eight:
        proved.append(
            f"there are no others: {COUNT} simple ones, and two points at infinity of "
            "multiplicity four, are the 33 that Bezout's theorem allows"
        )
    else:
        numerical.append("there may be more critical points of the squared circle residual")
    complete = zeros.total == COUNT and eight and all(sure.values())
    if complete:
        proved.append(
            f"so the squared circle residual has {len(minima)} local "
            f"minim{'um, a strict one' if len(minima) == 1 else 'a, all of them strict'}"
        )
        if grows(gram) and sure_least(gram, minima):
            proved.append(
                "the first of them is the global minimum: no other circle has a sum of squared "
                "circle residuals as small"
            )
    return complete, proved, numerical


# --- the reported dyads of six poses or more


def _least_dyad(motion: Motion, index: int, dyad: Dyad) -> tuple[CertifiedDyad, str]:
    """A reported dyad held against the exact one, and a sentence on it."""
    if isinstance(dyad, RR):
        system = circle_distances(motion)
        box = zero_near(system, _seen_circle(motion, dyad))
        if box is None or not positive(system(box)[1]):
            return _unknown(index, dyad)
        what = "a strict local minimum of the sum of squared distances from the circle"
        return _judged(index, dyad, *_circle_error(motion, box.entries(), dyad), what)
    if isinstance(dyad, PR | RP):
        return _least_line(motion, index, dyad)
    return _unknown(index, dyad)


def _judged(
    index: int, dyad: Dyad, radius: float, size: float, what: str
) -> tuple[CertifiedDyad, str]:
    """A circle with a bound on its error."""
    near = radius < NEAR * size
    told = _told(radius)
    sentence = f"within {told} of {what}" if near else _too_far(told)
    return CertifiedDyad(index, type(dyad).__name__, near, radius, 0.0, near), sentence


def _too_far(told: str) -> str:
    return f"not proved; the exact one found from it may be {told} away"


def _unknown(index: int, dyad: Dyad) -> tuple[CertifiedDyad, str]:
    item = CertifiedDyad(index, type(dyad).__name__, False, inf, inf, False)
    return item, "only computed: that an exact one is near could not be proved"


def _seen_circle(motion: Motion, dyad: RR) -> Matrix:
    """(c1, c2, m1, m2, r) of a reported circle, as the motion's frames see it."""
    arb = flint().arb
    values = [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
    pairs = zip(values, [*motion.fixed_origin, *motion.moving_origin, 0], strict=True)
    return flint().arb_mat([[(arb(float(v)) - origin) / motion.length] for v, origin in pairs])


def _circle_error(motion: Motion, exact: Sequence[Ball], dyad: RR) -> tuple[float, float]:
    """How far a reported circle is at most from an exact one, and the size of that one."""
    reported = _seen_circle(motion, dyad).entries()
    c1, c2, m1, m2, r = (x - y for x, y in zip(exact, reported, strict=True))
    errors = [_norm(c1, c2), _norm(m1, m2), r]
    size = upper((1 + sum(abs(e) for e in exact)) * motion.length)
    return max(upper(e * motion.length) for e in errors), size


def _norm(x: Ball, y: Ball) -> Ball:
    """A bound on the length of a vector; the length itself has no root in balls around 0."""
    return (abs(x).upper() ** 2 + abs(y).upper() ** 2).sqrt()


def _least_line(motion: Motion, index: int, line: PR | RP) -> tuple[CertifiedDyad, str]:
    """A reported line held against the nearer of the two stationary ones, and a sentence on it."""
    pivot = line.moving_pivot if isinstance(line, PR) else line.fixed_pivot
    if isinstance(line, RP):
        motion = motion.inverse()
    angle, *reported = (flint().arb(float(v)) for v in (line.normal_angle, line.offset, *pivot))
    exact = stationary_line(motion, angle)
    if exact is None:
        return _unknown(index, line)
    (turn, h, x, y), best = exact
    n2, n1 = (angle + turn).sin_cos()
    (c1, c2), (m1, m2) = motion.fixed_origin, motion.moving_origin
    seen = (h * motion.length + n1 * c1 + n2 * c2, x * motion.length + m1, y * motion.length + m2)
    offset, *gap = (value - told for value, told in zip(seen, reported, strict=True))
    size = upper((1 + abs(h) + abs(x) + abs(y)) * motion.length)
    radius, angle_radius = max(upper(offset), upper(_norm(*gap))), upper(turn)
    near = radius < NEAR * size and angle_radius < NEAR
    item = CertifiedDyad(index, type(line).__name__, near, radius, angle_radius, near and best)
    told = f"{_told(radius)} and {_told(angle_radius)} rad"
    if not near:
        return item, _too_far(told)
    what = "the line with the least sum of squared distances of all"
    what = what if best else "a line that is stationary, and not the best"
    return item, f"within {told} of {what}"


# --- five poses


def _five_roots(
    motion: Motion, five: FivePoseDyads
) -> tuple[bool, list[str], list[str], list[Matrix]]:
    """Whether the roots are proved to be all; what is proved; what is not; the real ones."""
    zeros = proved_zeros(five_equations(motion), five.roots, five.real, different)
    proved, numerical = [], []
    if zeros.total:
        proved.append(
            f"{zeros.total} dyads with real or complex coefficients pass through the five poses, "
            f"each alone in a box of its own, within {_told(zeros.error)} of its computed unit "
            f"coefficients; {len(zeros.real)} are real, {len(zeros.others)} are not"
        )
    complete = zeros.total == ROOTS
    if complete:
        proved.append("there are no others: two conics have no more than four isolated points")
    else:
        numerical.append("there may be more dyads that pass through the five poses")
    return complete, proved, numerical, list(zeros.real.values())


def _exact_dyad(
    motion: Motion, roots: Sequence[Matrix], index: int, dyad: Dyad
) -> tuple[CertifiedDyad, str]:
    """A reported dyad held against the nearest exact circle, and a sentence on it."""
    if not isinstance(dyad, RR):
        item, _ = _unknown(index, dyad)
        return item, "only computed: the last digits of the poses make it a slider or a long link"
    errors = [_circle_error(motion, circle_of(root), dyad) for root in roots if nonzero(root[0, 0])]
    radius, size = min(errors, default=(inf, 1.0))
    if radius == inf:
        return _unknown(index, dyad)
    return _judged(index, dyad, radius, size, "a circle that passes through the poses exactly")
