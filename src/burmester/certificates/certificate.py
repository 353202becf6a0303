"""Certificates: which answers of a task are proved, and how near they are to the exact ones.

Everything here is about the very doubles in the poses and weights, taken as exact numbers;
`ball_arithmetic` has the arithmetic and `proofs` the arguments.  A fit's frames are doubles as
well: c = length c' + origin is exact in balls, and radii are in the task's unit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, Context
from math import degrees, inf
from typing import final

from burmester.certificates.ball_arithmetic import (
    Ball,
    BallPoses,
    Matrix,
    flint,
    has_descent,
    is_nonzero,
    positive_definite,
    upper_bound,
    zero_near,
)
from burmester.certificates.proofs import (
    MAX_RELATIVE_ERROR,
    circle_distances,
    circle_of,
    first_is_least,
    five_equations,
    gram_of,
    grows_to_infinity,
    infinity_takes_eight,
    proved_zeros,
    squared_residual,
    stationary_line,
    surely_different,
)
from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.critical_search import COUNT
from burmester.dyads.five_poses import FivePoseDyads
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.values import real_numbers, require_instance

PRECISION_BITS = (128, 384)  # the second where the first leaves something unproved
FIVE_POSE_ROOTS = 4  # dyads through five poses, real or complex


@final
@dataclass(frozen=True, slots=True, eq=False)
class CertifiedDyad:
    """How near a reported dyad is to an exact one.

    Attributes
    ----------
    index : int
        Its place among the reported dyads, from 0.
    kind : str
        RR, PR, RP or PP.
    proved : bool
        Whether an exact one (see `certify` and `certify_five`) surely lies within `radius`, and
        `radius` is small against the dyad.
    radius : float
        A bound on the error of each pivot, of the length of the link and of a line's offset, in
        the task's unit; infinite where no exact one is known.
    angle_radius : float
        A bound on the error of a line's normal, in radians; also of its double in degrees.
    minimum : bool
        Whether the exact one is surely a strict local minimum; of a line, the only global one.
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

    Attributes
    ----------
    complete : bool
        Whether the computed critical points (`certify`) or roots (`certify_five`) are proved to be
        all there are, each of them real or not and a minimum or not as reported.  It says nothing
        about `dyads`.
    proved, numerical : tuple of str
        Sentences for the user: what is proved, and what is only computed.
    dyads : tuple of CertifiedDyad
        One entry for each reported dyad.
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
    """Prove what can be proved of the answers for six poses or more.

    The exact dyads are, for RR, a strict local minimum of the weighted sum of (|R m + d - c| - r)²,
    and for PR and RP a stationary line of the weighted sum of squared distances, the best of all
    where `minimum`.  A proof that fails is reported, not raised.

    Parameters
    ----------
    poses : Displacement, (N,)
        Five poses or more of one task.
    weights : array_like, (N,), or None
        Their weights; None for equal ones.
    critical : CriticalDyads
        The critical points of these poses and weights.
    dyads : sequence of Dyad
        The reported dyads, one by one.

    Returns
    -------
    Certificate

    Raises
    ------
    InputError
        E130 (python-flint is missing), E125 or E103 (values of a wrong type or shape).

    Examples
    --------
    >>> import numpy as np
    >>> from burmester.dyads.critical_points import critical_dyads
    >>> k = np.arange(6.0)
    >>> poses = Displacement(np.stack([np.cos(1.7 * k) + k, np.sin(2.3 * k)], axis=-1), k**1.5)
    >>> certificate = certify(poses, None, critical_dyads(poses), [])
    >>> certificate.complete
    True
    >>> print(certificate.proved[1])
    there are no others: 25 simple ones, and two points at infinity of multiplicity four, \
are the 33 that Bezout's theorem allows
    """
    require_instance(poses, Displacement, "poses", "give a Displacement of shape (N,)")
    if weights is not None:
        weights = real_numbers(weights, poses.shape, "weights")

    def attempt() -> Certificate:
        balls = BallPoses.of(poses, weights, critical.frames)
        complete, proved, numerical = _critical_points(balls, critical)
        numerical.append(
            "the sum of squared true distances may have minima other than those reported, which "
            "were reached from the minima of the squared circle residual"
        )
        verdicts = [_least_dyad(balls, index, dyad) for index, dyad in enumerate(dyads)]
        return _certificate(complete, proved, numerical, verdicts)

    return _at_sufficient_precision(attempt)


def certify_five(poses: Displacement, five: FivePoseDyads, dyads: Sequence[Dyad]) -> Certificate:
    """Prove what can be proved of the dyads through five poses.

    The exact dyads are circles through all poses.  A slider is never proved: the slightest
    rounding of its poses makes it a circle, with an enormous link.  Else as `certify`.

    Parameters
    ----------
    poses : Displacement, (5,)
        The poses of one task.
    five : FivePoseDyads
        The dyads of these poses.
    dyads : sequence of Dyad
        The reported dyads, one by one.

    Returns
    -------
    Certificate

    Raises
    ------
    InputError
        E130 (python-flint is missing), E125 (no poses).

    Examples
    --------
    >>> import numpy as np
    >>> from burmester.dyads.five_poses import dyads_of_five
    >>> k = np.arange(5.0)
    >>> poses = Displacement(np.stack([np.cos(1.7 * k) + k, np.sin(2.3 * k)], axis=-1), k**1.5)
    >>> certify_five(poses, dyads_of_five(poses), []).proved[1]
    'there are no others: two conics have no more than four isolated points'
    """
    require_instance(poses, Displacement, "poses", "give a Displacement of shape (5,)")

    def attempt() -> Certificate:
        balls = BallPoses.of(poses, None, five.frames)
        complete, proved, numerical, roots = _five_roots(balls, five)
        verdicts = [_exact_dyad(balls, roots, index, dyad) for index, dyad in enumerate(dyads)]
        return _certificate(complete, proved, numerical, verdicts)

    return _at_sufficient_precision(attempt)


def _at_sufficient_precision(attempt: Callable[[], Certificate]) -> Certificate:
    """The certificate at the first precision that settles everything, else at the last."""
    for bits in PRECISION_BITS:
        with flint().ctx.workprec(bits):
            certificate = attempt()
        if certificate.complete and all(dyad.proved for dyad in certificate.dyads):
            break
    return certificate


def _certificate(
    complete: bool,
    proved: list[str],
    numerical: list[str],
    verdicts: Sequence[tuple[CertifiedDyad, str]],
) -> Certificate:
    for item, sentence in verdicts:
        place = proved if item.proved else numerical
        place.append(f"dyad {item.index + 1} ({item.kind}): {sentence}")
    return Certificate(complete, tuple(proved), tuple(numerical), tuple(i for i, _ in verdicts))


def _rounded_up(bound: float) -> str:
    """An upper bound with two digits."""
    return f"{Context(prec=2, rounding=ROUND_CEILING).create_decimal(bound):.1e}"


# --- the critical points of the squared residual


def _critical_points(
    balls: BallPoses, critical: CriticalDyads
) -> tuple[bool, list[str], list[str]]:
    """Whether the critical points are proved to be all; what is proved; what is not."""
    computed = int(critical.found)
    gram = gram_of(balls)
    system = squared_residual(gram)
    zeros = proved_zeros(
        lambda _: system,
        critical.points[:computed],
        critical.real[:computed],
        lambda a, b: not a.overlaps(b),
    )
    minimum = {k: bool(critical.minimum[k]) for k in zeros.real}
    proved_kind = {
        k: (positive_definite if minimum[k] else has_descent)(system(box)[1])
        for k, box in zeros.real.items()
    }
    minima = [box for k, box in zeros.real.items() if minimum[k] and proved_kind[k]]
    eight = infinity_takes_eight(gram)
    bound = _rounded_up(upper_bound(zeros.error * balls.length))
    proved: list[str] = []
    numerical: list[str] = []
    if zeros.total:
        proved.append(
            f"{zeros.total} critical points of the squared circle residual, each alone in a box "
            f"of its own, each coordinate within {bound} of the computed one; "
            f"{len(zeros.real)} are real, {len(zeros.others)} are not"
        )
    if zeros.total < computed:
        numerical.append(f"{computed - zeros.total} critical points are computed, not proved")
    if not all(proved_kind.values()):
        unsure = list(proved_kind.values()).count(False)
        numerical.append(f"whether {unsure} of the real ones are minima is computed, not proved")
    if zeros.total == COUNT and eight:
        proved.append(
            f"there are no others: {COUNT} simple ones, and two points at infinity of "
            "multiplicity four, are the 33 that Bezout's theorem allows"
        )
    else:
        numerical.append("there may be more critical points of the squared circle residual")
    complete = zeros.total == COUNT and eight and all(proved_kind.values())
    if complete:
        proved.append(
            f"so the squared circle residual has {len(minima)} local "
            f"minim{'um, a strict one' if len(minima) == 1 else 'a, all of them strict'}"
        )
        if grows_to_infinity(gram) and first_is_least(gram, minima):
            proved.append(
                "the first of them is the global minimum: no other circle has a sum of squared "
                "circle residuals as small"
            )
    return complete, proved, numerical


# --- the reported dyads of six poses or more


def _least_dyad(balls: BallPoses, index: int, dyad: Dyad) -> tuple[CertifiedDyad, str]:
    """The distance of a reported dyad from the exact one, and a sentence on it."""
    if isinstance(dyad, RR):
        system = circle_distances(balls)
        box = zero_near(system, _circle_in_frames(balls, dyad))
        if box is None or not positive_definite(system(box)[1]):
            return _unknown(index, dyad)
        what = "a strict local minimum of the sum of squared distances from the circle"
        return _circle_verdict(index, dyad, *_circle_error(balls, box.entries(), dyad), what)
    if isinstance(dyad, PR | RP):
        return _least_line(balls, index, dyad)
    return _unknown(index, dyad)


def _circle_verdict(
    index: int, dyad: Dyad, radius: float, size: float, what: str
) -> tuple[CertifiedDyad, str]:
    """A circle with a bound on its error, and a sentence on it."""
    near = radius < MAX_RELATIVE_ERROR * size
    bound = _rounded_up(radius)
    sentence = f"within {bound} of {what}" if near else _too_far(bound)
    return CertifiedDyad(index, type(dyad).__name__, near, radius, 0.0, near), sentence


def _too_far(bound: str) -> str:
    return f"not proved; the exact one that it leads to may be {bound} away"


def _unknown(index: int, dyad: Dyad) -> tuple[CertifiedDyad, str]:
    item = CertifiedDyad(index, type(dyad).__name__, False, inf, inf, False)
    return item, "only computed: no exact one could be proved to be near"


def _circle_in_frames(balls: BallPoses, dyad: RR) -> Matrix:
    """(c1, c2, m1, m2, r) of a reported circle, in the frames of the ball poses."""
    arb = flint().arb
    values = [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
    pairs = zip(values, [*balls.fixed_origin, *balls.moving_origin, 0], strict=True)
    return flint().arb_mat([[(arb(float(v)) - origin) / balls.length] for v, origin in pairs])


def _circle_error(balls: BallPoses, exact: Sequence[Ball], dyad: RR) -> tuple[float, float]:
    """How far a reported circle is at most from an exact one, and the size of that one."""
    reported = _circle_in_frames(balls, dyad).entries()
    c1, c2, m1, m2, r = (x - y for x, y in zip(exact, reported, strict=True))
    errors = [_norm(c1, c2), _norm(m1, m2), r]
    size = upper_bound((1 + sum(abs(e) for e in exact)) * balls.length)
    return max(upper_bound(e * balls.length) for e in errors), size


def _norm(x: Ball, y: Ball) -> Ball:
    """A bound on the length of a vector; the length itself has no root in balls around 0."""
    return (abs(x).upper() ** 2 + abs(y).upper() ** 2).sqrt()


def _least_line(balls: BallPoses, index: int, line: PR | RP) -> tuple[CertifiedDyad, str]:
    """The distance of a reported line from the nearer stationary one, and a sentence on it."""
    pivot = line.moving_pivot if isinstance(line, PR) else line.fixed_pivot
    if isinstance(line, RP):
        balls = balls.inverse()
    angle, *reported = (flint().arb(float(v)) for v in (line.normal_angle, line.offset, *pivot))
    exact = stationary_line(balls, angle)
    if exact is None:
        return _unknown(index, line)
    (turn, h, x, y), best = exact
    n2, n1 = (angle + turn).sin_cos()
    (c1, c2), (m1, m2) = balls.fixed_origin, balls.moving_origin
    in_task = (
        h * balls.length + n1 * c1 + n2 * c2,
        x * balls.length + m1,
        y * balls.length + m2,
    )
    offset, *gap = (value - own for value, own in zip(in_task, reported, strict=True))
    size = upper_bound((1 + abs(h) + abs(x) + abs(y)) * balls.length)
    radius = max(upper_bound(offset), upper_bound(_norm(*gap)))
    # Files hold the angle in degrees, rounded once more: the bound is for either number.
    in_degrees = flint().arb(degrees(float(line.normal_angle))) * flint().arb.pi() / 180
    angle_radius = max(upper_bound(turn), upper_bound(angle + turn - in_degrees))
    near = radius < MAX_RELATIVE_ERROR * size and angle_radius < MAX_RELATIVE_ERROR
    item = CertifiedDyad(index, type(line).__name__, near, radius, angle_radius, near and best)
    bound = f"{_rounded_up(radius)} and {_rounded_up(angle_radius)} rad"
    if not near:
        return item, _too_far(bound)
    what = "the line with the least sum of squared distances of all"
    what = what if best else "a line that is stationary, and not the best"
    return item, f"within {bound} of {what}"


# --- five poses


def _five_roots(
    balls: BallPoses, five: FivePoseDyads
) -> tuple[bool, list[str], list[str], list[Matrix]]:
    """Whether the roots are proved to be all; what is proved; what is not; the real ones."""
    zeros = proved_zeros(five_equations(balls), five.roots, five.real, surely_different)
    proved, numerical = [], []
    if zeros.total:
        proved.append(
            f"{zeros.total} dyads with real or complex coefficients pass through the five poses, "
            "each alone in a box of its own, within "
            f"{_rounded_up(zeros.error)} of its computed unit coefficients; "
            f"{len(zeros.real)} are real, {len(zeros.others)} are not"
        )
    complete = zeros.total == FIVE_POSE_ROOTS
    if complete:
        proved.append("there are no others: two conics have no more than four isolated points")
    else:
        numerical.append("there may be more dyads that pass through the five poses")
    return complete, proved, numerical, list(zeros.real.values())


def _exact_dyad(
    balls: BallPoses, roots: Sequence[Matrix], index: int, dyad: Dyad
) -> tuple[CertifiedDyad, str]:
    """The distance of a reported dyad from the nearest exact circle, and a sentence on it."""
    if not isinstance(dyad, RR):
        item, _ = _unknown(index, dyad)
        return item, "only computed: the last digits of the poses make it a slider or a long link"
    errors = [
        _circle_error(balls, circle_of(root), dyad) for root in roots if is_nonzero(root[0, 0])
    ]
    radius, size = min(errors, default=(inf, 1.0))
    if radius == inf:
        return _unknown(index, dyad)
    return _circle_verdict(
        index, dyad, radius, size, "a circle that passes through the poses exactly"
    )
