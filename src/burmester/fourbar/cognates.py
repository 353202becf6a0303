"""Roberts' cognates: the other linkages whose coupler point traces the same curve.

In complex numbers, let A0 and B0 be the fixed pivots, A and B the moving ones in F, P the coupler
point and k = (P - A)/(B - A), a constant of the coupler.  Two parallelograms, A0 A P A1 and
B0 B P B1, and the third fixed pivot C0 = A0 + k (B0 - A0) give two more linkages:
A1 = A0 + (P - A) stays on a circle about A0, C1 = A1 + k (A - A0) on one about C0, since
C0 - C1 = k (B0 - B), and A1, C1 and P are points of one body, which turns as the link A0 A does.

Source: S. Roberts, On three-bar motion in plane space, Proceedings of the London Mathematical
Society 7, 1875, pages 14 to 23.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import ComplexArray, complex_of, pairs_of


def cognates(linkage: Linkage, point: ArrayLike = (0.0, 0.0)) -> tuple[Linkage, ...]:
    """The other linkages whose coupler point traces the same curve.

    Two for a linkage of two RR dyads, the first with the fixed pivot of the linkage's first dyad,
    the second with that of its second dyad; both with the third fixed pivot in their second dyad.
    One for a slider-crank, none for other linkages with sliders.

    In the body frame of a cognate the coupler point has the same coordinates as in that of the
    linkage.  Its body turns as the link with the shared fixed pivot does, and its angle is the
    direction in F of that link, from the fixed to the moving pivot.  So the cognate of a crank has
    the crank's angle as its body angle.

    Parameters
    ----------
    linkage : Linkage
        (*,)
    point : (*, 2) array of float
        The coupler point, in M, in the task's length unit.

    Returns
    -------
    tuple of Linkage
        (*,) each.  Nan where the coupler has no length; a link has none where the coupler point is
        a moving pivot, since the curve is a circle then.

    Examples
    --------
    >>> import numpy as np
    >>> from burmester import RR
    >>> linkage = Linkage(RR([0, 0], [0, 0], 1), RR([4, 0], [3, 0], 3))
    >>> left, right = cognates(linkage, (1.5, 1.5))
    >>> left.second.fixed_pivot.round(6)  # the three fixed pivots are a triangle like the coupler
    array([2., 2.])
    >>> left.type, right.type
    ('double-rocker', 'rocker-crank')
    """
    a, b, c = linkage.first, linkage.second, complex_of(np.asarray(point, dtype=np.float64))
    if isinstance(a, RR) and isinstance(b, RR):
        return _beside(a, b, c), _beside(b, a, c)
    if isinstance(a, RR) and isinstance(b, PR):
        return (_beside_slider(a, b, c),)
    if isinstance(a, PR) and isinstance(b, RR):
        return (_beside_slider(b, a, c),)
    return ()


def _beside(a: RR, b: RR, c: ComplexArray) -> Linkage:
    """The cognate that keeps the fixed pivot of `a`."""
    ratio = _ratio(a, b, c)
    ground, arm = complex_of(a.fixed_pivot), np.abs(c - complex_of(a.moving_pivot))
    third = ground + ratio * (complex_of(b.fixed_pivot) - ground)
    return Linkage(
        RR(a.fixed_pivot, pairs_of(c - a.radius), arm),
        RR(pairs_of(third), pairs_of(c - (1 - ratio) * a.radius), np.abs(ratio) * b.radius),
    )


def _beside_slider(a: RR, b: PR, c: ComplexArray) -> Linkage:
    """The cognate of a slider-crank: C1 = A0 + k (B - A0) stays on a line as B does."""
    ratio = _ratio(a, b, c)
    ground, arm = complex_of(a.fixed_pivot), np.abs(c - complex_of(a.moving_pivot))
    normal = np.exp(1j * b.normal_angle)
    away = b.offset - (np.conj(normal) * ground).real  # of the line from A0
    turned = b.normal_angle + np.angle(ratio)
    offset = np.abs(ratio) * away + (np.exp(-1j * turned) * ground).real
    return Linkage(
        RR(a.fixed_pivot, pairs_of(c - a.radius), arm),
        PR(turned, offset, pairs_of(c - (1 - ratio) * a.radius)),
    )


def _ratio(a: RR | PR, b: RR | PR, c: ComplexArray) -> ComplexArray:
    """The place (*,) of the coupler point c on the coupler of which `a` is at 0 and `b` at 1."""
    start = complex_of(a.moving_pivot)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray((c - start) / (complex_of(b.moving_pivot) - start))
