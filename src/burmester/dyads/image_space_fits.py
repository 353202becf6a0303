"""Three classical fits of RR dyads, each searching from a start value by Levenberg-Marquardt.

They are the methods that the paper holds its own against (its Sec. 4 and Tables 1 and 9), kept
here to be compared with; `pencil` and `optimal` need no start value and find more.

    algebraic_fit   the algebraic distance from one constraint manifold (row A of Table 1)
    larochelle      the exact normal distance from one constraint manifold (row L)
    ravani_roth     the first-order normal distance from the curve in which two constraint
                    manifolds meet, both at once (row R)

The metric.  A displacement is its unit image point, a point of the cylinder Z3² + Z4² = 1, and
the metric is the one the cylinder has in the four-space of Z: flat, with w = Z1 + i Z2 and the
half angle psi as Cartesian coordinates, ds² = |dw|² + dpsi².  It is not invariant: it changes
with the origins of F and M, and the unit of length decides what a radian weighs.  Poses are
taken as they come, so give them in canonical frames (`frames`) for an answer that changes with
nothing.  The circle of an RR dyad is a circle at every half angle,

    g = Zᵀ C Z = |u|² - r²/4,   u = w + (i/2)(exp(i psi) m - exp(-i psi) c),            (6)

so the nearest point of a manifold is a search along psi alone.

What is ours.  The three fits are written from what the paper says of them.  It leaves open in
which chart and frames they measured, how many start values they drew and where, when they
stopped, how Larochelle searched for the normal ("a direct search"), and which residual and
parameters row A took.  The chart Z4 = 1, which is not used here, is singular at half turns.

Sources: Ravani and Roth, J. Mech. Trans. Autom. Des. 105(3), 1983, 460-467; Larochelle's
constraint manifold fitting and row A as told by Ge et al. 2012, Sec. 4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.least_squares import Kernel, levenberg_marquardt

__all__ = [
    "ImagePoints",
    "NormalFit",
    "algebraic_distance",
    "algebraic_fit",
    "curve_distance",
    "larochelle",
    "manifold_distance",
    "ravani_roth",
]

LEAST_POSES = 5  # below, a whole curve of dyads has distance zero
SAMPLES = 65  # of the half angle, where the nearest point of a manifold is looked for
VALLEYS = 5  # at most; a harmonic of order 2 squared has four, and t² hardly adds one
NEWTON_STEPS = 20
TINY = 1e-300  # instead of zero, to divide by

ComplexArray: TypeAlias = NDArray[np.complex128]


@final
@dataclass(frozen=True, slots=True, eq=False)
class NormalFit:
    """Where each start value (*,) has led.

    dyads: (*,), or (*, 2) of `ravani_roth`, in the frames of the poses.
    residual: (*,), the root mean square over the poses of the distance that was minimised, in
        the metric of this module (the algebraic one in squared lengths).
    iterations: (*,), steps taken; evaluations: (*,), times the residuals were computed.
    converged: (*,), the fit has settled; in a local minimum as a rule, which nothing here
        tells from a global one.  One whose pivots run away to infinity does not settle.
    A start value without a distance (see `ravani_roth`) stays where it is, with residual inf.
    """

    dyads: RR
    residual: FloatArray
    iterations: NDArray[np.int_]
    evaluations: NDArray[np.int_]
    converged: NDArray[np.bool_]


def algebraic_fit(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the algebraic distance Zᵀ C Z, a quarter of the circle equation.

    poses: (N,), N >= 5; start: (*,), leading axes are start values.
    Raises InputError E121 (fewer than 5 poses) and E103 (not finite), as the other two do.
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: algebraic_distance(at, x), start, poses.shape[0])


def larochelle(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the exact normal distance from one constraint manifold.

    poses: (N,), N >= 5; start: (*,), leading axes are start values.  The nearest point of the
    manifold is looked for anew at every evaluation.
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: manifold_distance(at, x), start, poses.shape[0])


def ravani_roth(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the first-order normal distance from a curve of two manifolds.

    poses: (N,), N >= 5; start: (*, 2), leading axes are start values.  With g the two algebraic
    distances and J (2, 3) their derivatives by (Z1, Z2, psi), the squared distance to first
    order is gᵀ (J Jᵀ)⁻¹ g.  It has no bound where the normals of the manifolds are parallel.
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: curve_distance(at, x), start, poses.shape[0], together=2)


# --- The distances: parameters x (*, 5) are Xc, Yc, x, y, r; the poses are a last axis, and
# derivatives by the parameters one after it


class ImagePoints(NamedTuple):
    """Unit image points (N,): w = Z1 + i Z2 and exp(i psi) = Z4 + i Z3."""

    place: ComplexArray
    half_turn: ComplexArray

    @classmethod
    def of(cls, poses: Displacement) -> ImagePoints:
        if len(poses.shape) != 1:
            raise ValueError(f"a fit takes poses of shape (N,), not {poses.shape}")
        if poses.shape[0] < LEAST_POSES:
            raise InputError(
                "E121",
                f"a fit by distance needs at least {LEAST_POSES} poses, not {poses.shape[0]}",
                why="four poses or fewer are met exactly by infinitely many dyads",
                help="give more poses; dyad_curve takes 4 of them, dyad_with_moving_pivot 3",
            )
        poses.require_finite()
        z = poses.as_image_point()
        return cls(z[:, 0] + 1j * z[:, 1], z[:, 3] + 1j * z[:, 2])


class _Surfaces(NamedTuple):
    """Constraint manifolds at image points: g (*, N), its normal (*, N, 3) by (Z1, Z2, psi).

    by: (*, N, 5) and normal_by: (*, N, 3, 5), their derivatives by the parameters.
    """

    value: FloatArray
    normal: FloatArray
    by: FloatArray
    normal_by: FloatArray


def _surfaces(at: ImagePoints, x: FloatArray) -> _Surfaces:
    fixed, moving = _arms(at.half_turn, x)
    radius = x[..., None, 4]
    u, slope = at.place + fixed + moving, 1j * (moving - fixed)
    u_by, slope_by = _arms_by(at.half_turn)
    normal = np.stack([u.real, u.imag, _dot(u, slope)], axis=-1) * 2
    by = np.empty((*u.shape, 5))
    by[..., :4] = 2 * _dot(u[..., None], u_by)
    by[..., 4] = -radius / 2
    normal_by = np.zeros((*u.shape, 3, 5))
    normal_by[..., 0, :4], normal_by[..., 1, :4] = 2 * u_by.real, 2 * u_by.imag
    normal_by[..., 2, :4] = 2 * (_dot(slope[..., None], u_by) + _dot(u[..., None], slope_by))
    return _Surfaces(_square(u) - radius**2 / 4, normal, by, normal_by)


def _arms(half_turn: ComplexArray, x: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """The two parts (*, N) of u that turn with psi: the fixed pivot's back, the moving one's on."""
    c, m = (x[..., None, k] + 1j * x[..., None, k + 1] for k in (0, 2))
    return -0.5j * half_turn.conj() * c, 0.5j * half_turn * m


def _arms_by(half_turn: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """The derivatives (*, 4) of u and of du/dpsi by c and m; both are linear in them."""
    fixed, moving = -0.5j * half_turn.conj(), 0.5j * half_turn
    u_by = np.stack([fixed, 1j * fixed, moving, 1j * moving], axis=-1)
    return u_by, u_by * np.array([-1j, -1j, 1j, 1j])


def algebraic_distance(at: ImagePoints, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The values (*, N) of g for manifolds x (*, 5), and their derivatives."""
    surface = _surfaces(at, x)
    return surface.value, surface.by


def curve_distance(at: ImagePoints, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Residuals (*, 2N) of x (*, 10), and derivatives: L⁻¹ g with J Jᵀ = L Lᵀ (Cholesky).

    So the first is the distance from the first manifold, and the second what the curve adds.
    """
    first, second = _surfaces(at, x[..., :5]), _surfaces(at, x[..., 5:])
    n1, n2 = first.normal, second.normal
    none = np.zeros_like(first.by)
    g1_by, g2_by = np.concatenate([first.by, none], -1), np.concatenate([none, second.by], -1)

    def along(normal: FloatArray, normal_by: FloatArray) -> FloatArray:
        return np.asarray((normal[..., None, :] @ normal_by)[..., 0, :])

    a11_by = 2 * np.concatenate([along(n1, first.normal_by), none], axis=-1)
    a22_by = 2 * np.concatenate([none, along(n2, second.normal_by)], axis=-1)
    a12_by = np.concatenate([along(n2, first.normal_by), along(n1, second.normal_by)], axis=-1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        l11 = np.linalg.norm(n1, axis=-1)
        l21 = (n1 * n2).sum(axis=-1) / l11
        l22 = np.linalg.norm(np.cross(n1, n2), axis=-1) / l11
        e1 = first.value / l11
        e2 = (second.value - l21 * e1) / l22
        e1_, e2_, l11_, l21_, l22_ = (v[..., None] for v in (e1, e2, l11, l21, l22))
        l11_by = a11_by / (2 * l11_)
        l21_by = (a12_by - l21_ * l11_by) / l11_
        l22_by = (a22_by / 2 - l21_ * l21_by) / l22_
        e1_by = (g1_by - e1_ * l11_by) / l11_
        e2_by = (g2_by - e1_ * l21_by - l21_ * e1_by - e2_ * l22_by) / l22_
    return np.concatenate([e1, e2], axis=-1), np.concatenate([e1_by, e2_by], axis=-2)


def manifold_distance(at: ImagePoints, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The distances (*, N) from manifolds x (*, 5), positive outside, and their derivatives.

    At the half angle psi + t a manifold is a circle, and a(t) = |u| - r/2 is the distance from
    it; the nearest point is at the least a² + t².  As this foot moves freely, the distance
    changes with the parameters as a does, tilted.
    """
    fixed, moving = _arms(at.half_turn, x)
    half = np.abs(x[..., None, 4]) / 2
    parts = tuple(v[..., None] for v in np.broadcast_arrays(at.place, fixed, moving, half))
    t = _feet(parts)
    u, a, tilt, _, turn = (v[..., 0] for v in _gap(parts, t))
    by = np.empty((*a.shape, 5))
    u_by, _ = _arms_by(at.half_turn * turn)
    by[..., :4] = _dot((u / np.maximum(np.abs(u), TINY))[..., None], u_by)
    by[..., 4] = -np.sign(x[..., None, 4]) / 2
    # At the foot t = -a da/dt, and the distance is |a| sqrt(1 + (da/dt)²): smooth through zero.
    return np.copysign(np.hypot(a, t[..., 0]), a), by / np.sqrt(1 + tilt**2)[..., None]


def _feet(parts: tuple[Any, ...]) -> FloatArray:
    """The t (*, N, 1) of the nearest points.

    It has |t| <= |a(0)| and |t| <= pi.  There t is sampled, and every valley of a² + t² that
    shows is followed to its ground by Newton's method, held between the neighbouring samples.
    Narrow valleys can hide: of 240,000 random points, most of them far away, 25 got a farther foot.
    """
    _, a, *_ = _gap(parts, np.zeros_like(parts[-1]))
    reach = np.minimum(np.abs(a), np.pi)
    t = reach * np.linspace(-1, 1, SAMPLES)
    _, a, tilt, *_ = _gap(parts, t)
    force, height = a * tilt + t, a**2 + t**2
    # A valley shows by a lowest sample, or by the slope turning up between two of them.
    floor = height[..., 1:-1]
    dip = (floor <= height[..., :-2]) & (floor <= height[..., 2:])
    turns = (force[..., :-2] <= 0) & (force[..., 1:-1] >= 0)
    floor = np.where(dip | turns, floor, np.inf)
    order = np.argsort(floor, axis=-1)[..., :VALLEYS]
    order = np.where(np.isinf(np.take_along_axis(floor, order, axis=-1)), order[..., :1], order)
    t = np.take_along_axis(t, order + 1, axis=-1)
    gap = reach * (2 / (SAMPLES - 1))
    low, high, slack = t - gap, t + gap, 1e-12 * reach
    for _ in range(NEWTON_STEPS):
        _, a, tilt, bend, _ = _gap(parts, t)
        force, stiff = a * tilt + t, tilt**2 + a * bend + 1
        low, high = np.where(force < 0, t, low), np.where(force < 0, high, t)
        newton = t - np.divide(force, stiff, out=np.full_like(t, np.inf), where=stiff > 0)
        inside = (newton >= low - slack) & (newton <= high + slack)
        before, t = t, np.where(inside, newton, (low + high) / 2)
        if (np.abs(t - before) <= 100 * slack).all():  # the next step would square it
            break
    _, a, *_ = _gap(parts, t)
    return np.take_along_axis(t, np.argmin(a**2 + t**2, axis=-1)[..., None], axis=-1)


def _gap(parts: tuple[Any, ...], t: FloatArray) -> tuple[Any, ...]:
    """u, a, da/dt, d²a/dt² and exp(i t) at the half angles psi + t."""
    place, fixed, moving, half = parts
    turn = np.exp(1j * t)
    back, on = fixed * turn.conj(), moving * turn
    u, slope = place + back + on, 1j * (on - back)
    size = np.maximum(np.abs(u), TINY)
    tilt = _dot(u, slope) / size
    bend = (_square(slope) - _dot(u, back + on) - tilt**2) / size
    return u, size - half, tilt, bend, turn


def _dot(a: ComplexArray, b: ComplexArray) -> FloatArray:
    return np.asarray(a.real * b.real + a.imag * b.imag)


def _square(a: ComplexArray) -> FloatArray:
    return _dot(a, a)


def _fit(kernel: Kernel, start: RR, poses: int, together: int = 1) -> NormalFit:
    """Levenberg-Marquardt from start values, `together` dyads on the last axis of `start` each."""
    radius = start.radius[..., None]
    x = np.concatenate([start.fixed_pivot, start.moving_pivot, radius], axis=-1)
    lead = start.radius.shape[: start.radius.ndim - (together > 1)]
    ends = levenberg_marquardt(kernel, x.reshape(-1, 5 * together))
    x = ends.x.reshape(x.shape)
    return NormalFit(
        RR(x[..., :2], x[..., 2:4], np.abs(x[..., 4])),
        np.sqrt(ends.cost / poses).reshape(lead),
        ends.steps.reshape(lead),
        ends.evaluations.reshape(lead),
        ends.converged.reshape(lead),
    )
