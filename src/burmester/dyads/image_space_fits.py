"""Three classical fits of RR dyads, each searching from a start value by Levenberg-Marquardt.

They are the methods with which the paper compares its own (its Sec. 4 and Tables 1 and 9), kept
here for comparison; `pencil` and `local_minima` need no start value and find more.

    algebraic_fit   the algebraic distance from one constraint manifold (row A of Table 1)
    larochelle      the exact normal distance from one constraint manifold (row L)
    ravani_roth     the first-order normal distance from the curve in which two constraint
                    manifolds meet, both at once (row R)

The metric.  A displacement is its unit image point, a point of the cylinder Z3² + Z4² = 1, and
the metric is the one the cylinder has in the four-space of Z: flat, with w = Z1 + i Z2 and the
half angle psi as Cartesian coordinates, ds² = |dw|² + dpsi².  It is not invariant: it changes
with the origins of F and M, and the unit of length decides what a radian weighs.  Poses are
taken as they come, so give them in canonical frames (`canonical_frames`) for an answer that
changes with nothing.  The circle of an RR dyad is a circle at every half angle,

    g = Zᵀ C Z = |u|² - r²/4,   u = w + (i/2)(exp(i psi) m - exp(-i psi) c),            (6)

so the nearest point of a manifold is a search along psi alone.

What is ours.  The three fits are written from what the paper says of them.  It leaves open in
which chart and frames they measured, how many start values they drew and where, when they
stopped, how Larochelle searched for the normal ("a direct search"), and which residual and
parameters row A took.  The chart Z4 = 1, which is not used here, is singular at half turns.

Sources: Ravani and Roth, J. Mech. Trans. Autom. Des. 105(3), 1983, 460-467; Larochelle's
constraint manifold fitting and row A as described by Ge et al. 2012, Sec. 4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import DIVISOR_FLOOR
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage_batch import row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, dot
from burmester.numerics.least_squares import Kernel, levenberg_marquardt

MIN_POSES = 5  # of a fit; with fewer a whole curve of dyads has distance zero
SAMPLES = 65  # of the half angle, among which the nearest point of a manifold is bracketed
MAX_VALLEYS = 5  # of the distance; a harmonic of order 2 squared has four, and t² hardly adds one
MAX_NEWTON_STEPS = 20  # down a valley
BRACKET_ROUNDING = 1e-12  # share of the sampled range; a Newton step so far outside is inside
SETTLED_ROUNDINGS = 100  # times the rounding; after steps below this the next is rounding


@final
@dataclass(frozen=True, slots=True, eq=False)
class NormalFit:
    """Where each start value (*,) has led.

    dyads: (*,), or (*, 2) of `ravani_roth`, in the frames of the poses.
    residual: (*,), the root mean square over the poses of the distance that was minimised, in
        the metric of this module (the algebraic one in squared lengths).
    iterations: (*,), steps taken; evaluations: (*,), times the residuals were computed.
    converged: (*,), the fit has settled; in a local minimum as a rule, perhaps not the global
        one.  One whose pivots run away to infinity does not settle.
    A start value without a distance (see `ravani_roth`) stays where it is, with residual inf.
    """

    dyads: RR
    residual: FloatArray
    iterations: NDArray[np.int_]
    evaluations: NDArray[np.int_]
    converged: NDArray[np.bool_]


def algebraic_fit(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the algebraic distance Zᵀ C Z, a quarter of the circle equation.

    Parameters
    ----------
    poses : Displacement, (N,)
        N >= 5 poses, best in canonical frames.
    start : RR, (*,)
        Start values; leading axes are fits of their own.

    Returns
    -------
    NormalFit
        Where each start value has led.

    Raises
    ------
    InputError
        E121 (fewer than 5 poses), E103 (a number that is not finite).

    Notes
    -----
    Row A of Table 1 of Ge et al. 2012.

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> fit = algebraic_fit(poses, RR([0.1, 0], [0, 0.1], 1.2))
    >>> float(fit.dyads.radius.round(6)), bool(fit.converged)
    (1.0, True)
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: algebraic_distance(at, x), start, poses.shape[0])


def larochelle(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the exact normal distance from one constraint manifold.

    The nearest point of the manifold is searched anew at every evaluation.

    Formula `manifold-distance` of the theory.

    Parameters, result and errors as of `algebraic_fit`.

    Notes
    -----
    Row L of Table 1 of Ge et al. 2012.

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> fit = larochelle(poses, RR([0.1, 0], [0, 0.1], 1.2))
    >>> float(fit.dyads.radius.round(6)), bool(fit.converged)
    (1.0, True)
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: manifold_distance(at, x), start, poses.shape[0])


def ravani_roth(poses: Displacement, start: RR) -> NormalFit:
    """Least sum of squares of the first-order normal distance from a curve of two manifolds.

    With g the two algebraic distances and J (2, 3) their derivatives by (Z1, Z2, psi), the squared
    distance to first order is gᵀ (J Jᵀ)⁻¹ g.  It has no bound where the normals of the manifolds
    are parallel.

    Formula `normal-distance` of the theory.

    Parameters, result and errors as of `algebraic_fit`; start: (*, 2).

    Notes
    -----
    Ravani and Roth 1983; row R of Table 1 of Ge et al. 2012.

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> start = RR([[0.1, 0], [-0.4, -0.6]], [[0, 0.1], [0.1, -0.8]], [1.1, 1.3])
    >>> fit = ravani_roth(poses, start)
    >>> fit.dyads.radius.shape, bool(fit.residual < 0.01)
    ((2,), True)
    """
    at = ImagePoints.of(poses)
    return _fit(lambda x: curve_distance(at, x), start, poses.shape[0], together=2)


# --- The distances: parameters x (*, 5) are Xc, Yc, x, y, r; the poses are a last axis, and
# derivatives by the parameters one after it


class ImagePoints(NamedTuple):
    """Unit image points (N,): w = Z1 + i Z2 and exp(i psi) = Z4 + i Z3."""

    place: ComplexArray
    half_rotation: ComplexArray

    @classmethod
    def of(cls, poses: Displacement) -> ImagePoints:
        if len(poses.shape) != 1:
            raise ValueError(f"a fit takes poses of shape (N,), not {poses.shape}")
        if poses.shape[0] < MIN_POSES:
            raise InputError(
                "E121",
                f"a fit by distance needs at least {MIN_POSES} poses, not {poses.shape[0]}",
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
    fixed, moving = _arms(at.half_rotation, x)
    radius = x[..., None, 4]
    u, velocity = at.place + fixed + moving, 1j * (moving - fixed)  # velocity: du/dpsi
    u_by, velocity_by = _arms_by(at.half_rotation)
    normal = np.stack([u.real, u.imag, dot(u, velocity)], axis=-1) * 2
    by = np.empty((*u.shape, 5))
    by[..., :4] = 2 * dot(u[..., None], u_by)
    by[..., 4] = -radius / 2
    normal_by = np.zeros((*u.shape, 3, 5))
    normal_by[..., 0, :4], normal_by[..., 1, :4] = 2 * u_by.real, 2 * u_by.imag
    by_psi = dot(velocity[..., None], u_by) + dot(u[..., None], velocity_by)
    normal_by[..., 2, :4] = 2 * by_psi
    return _Surfaces(_square(u) - radius**2 / 4, normal, by, normal_by)


def _arms(half_rotation: ComplexArray, x: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """The parts (*, N) of u that rotate with psi: of the fixed pivot, then of the moving one."""
    c, m = (x[..., None, k] + 1j * x[..., None, k + 1] for k in (0, 2))
    return -0.5j * half_rotation.conj() * c, 0.5j * half_rotation * m


def _arms_by(half_rotation: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """The derivatives (*, 4) of u and of du/dpsi by c and m; both are linear in them."""
    fixed, moving = -0.5j * half_rotation.conj(), 0.5j * half_rotation
    u_by = np.stack([fixed, 1j * fixed, moving, 1j * moving], axis=-1)
    return u_by, u_by * np.array([-1j, -1j, 1j, 1j])


def algebraic_distance(at: ImagePoints, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The values (*, N) of g for manifolds x (*, 5), and their derivatives (*, N, 5)."""
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
    fixed, moving = _arms(at.half_rotation, x)
    half = np.abs(x[..., None, 4]) / 2
    parts = tuple(v[..., None] for v in np.broadcast_arrays(at.place, fixed, moving, half))
    t = _feet(parts)
    foot = _circle_distance(parts, t)
    u, a, a_by_t = foot.u[..., 0], foot.distance[..., 0], foot.derivative[..., 0]
    by = np.empty((*a.shape, 5))
    u_by, _ = _arms_by(at.half_rotation * foot.rotation[..., 0])
    by[..., :4] = dot((u / np.maximum(np.abs(u), DIVISOR_FLOOR))[..., None], u_by)
    by[..., 4] = -np.sign(x[..., None, 4]) / 2
    # At the foot t = -a da/dt, and the distance is |a| sqrt(1 + (da/dt)²): smooth through zero.
    return np.copysign(np.hypot(a, t[..., 0]), a), by / np.sqrt(1 + a_by_t**2)[..., None]


def _feet(parts: tuple[Any, ...]) -> FloatArray:
    """The t (*, N, 1) of the nearest points.

    It has |t| <= |a(0)| and |t| <= pi.  There t is sampled, and every valley of a² + t² that
    shows is followed to its minimum by Newton's method, kept between the neighbouring samples.
    Narrow valleys can hide: of 240,000 random points, most of them far away, 25 got a farther foot.
    """
    here = _circle_distance(parts, np.zeros_like(parts[-1]))
    reach = np.minimum(np.abs(here.distance), np.pi)
    t = reach * np.linspace(-1, 1, SAMPLES)
    gradient, height = _circle_distance(parts, t).descent(t)[0], _height(parts, t)
    # A valley shows by a lowest sample, or by a derivative that becomes positive between two.
    floor = height[..., 1:-1]
    dip = (floor <= height[..., :-2]) & (floor <= height[..., 2:])
    upward = (gradient[..., :-2] <= 0) & (gradient[..., 1:-1] >= 0)
    floor = np.where(dip | upward, floor, np.inf)
    order = np.argsort(floor, axis=-1)[..., :MAX_VALLEYS]
    order = np.where(np.isinf(np.take_along_axis(floor, order, axis=-1)), order[..., :1], order)
    t = np.take_along_axis(t, order + 1, axis=-1)
    spacing = reach * (2 / (SAMPLES - 1))
    low, high, slack = t - spacing, t + spacing, BRACKET_ROUNDING * reach
    for _ in range(MAX_NEWTON_STEPS):
        gradient, second = _circle_distance(parts, t).descent(t)
        low, high = np.where(gradient < 0, t, low), np.where(gradient < 0, high, t)
        newton = t - np.divide(gradient, second, out=np.full_like(t, np.inf), where=second > 0)
        inside = (newton >= low - slack) & (newton <= high + slack)
        before, t = t, np.where(inside, newton, (low + high) / 2)
        if (np.abs(t - before) <= SETTLED_ROUNDINGS * slack).all():  # the next would square it
            break
    return np.take_along_axis(t, np.argmin(_height(parts, t), axis=-1)[..., None], axis=-1)


def _height(parts: tuple[Any, ...], t: FloatArray) -> FloatArray:
    """The squared distances a² + t² of the points of a manifold nearest at psi + t."""
    return np.asarray(_circle_distance(parts, t).distance ** 2 + t**2)


class _CircleDistance(NamedTuple):
    """The distance a = |u| - r/2 from a manifold's circle at half angles psi + t, (*, N, k) each.

    derivative, second: da/dt and d²a/dt²; rotation: exp(i t).
    """

    u: ComplexArray
    distance: FloatArray
    derivative: FloatArray
    second: FloatArray
    rotation: ComplexArray

    def descent(self, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Half the first and second derivatives of a² + t²."""
        gradient = self.distance * self.derivative + t
        return gradient, self.derivative**2 + self.distance * self.second + 1


def _circle_distance(parts: tuple[Any, ...], t: FloatArray) -> _CircleDistance:
    """The distance at half angles psi + t; parts: w, both arms, and half the radius."""
    place, fixed, moving, half = parts
    rotation: ComplexArray = np.exp(1j * t)
    fixed, moving = fixed * rotation.conj(), moving * rotation
    u: ComplexArray = place + fixed + moving
    velocity: ComplexArray = 1j * (moving - fixed)
    size = np.maximum(np.abs(u), DIVISOR_FLOOR)
    derivative = dot(u, velocity) / size
    second = (_square(velocity) - dot(u, fixed + moving) - derivative**2) / size
    return _CircleDistance(u, size - half, derivative, second, rotation)


def _square(a: ComplexArray) -> FloatArray:
    return dot(a, a)


def _fit(kernel: Kernel, start: RR, poses: int, together: int = 1) -> NormalFit:
    """Levenberg-Marquardt from start values, `together` dyads on the last axis of `start` each."""
    x = row_of(start)
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
