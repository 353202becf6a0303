"""Four poses: Burmester's curve, every RR dyad that meets them, as whole closed loops.

Four image points leave a four-dimensional null space of manifolds.  In it, a projective
three-space, the two conditions of Eq. (17) are two quadric surfaces, and the dyads are the
curve of degree four in which they meet.  Its fixed pivots make the centre-point curve in F,
its moving pivots the circle-point curve in M, both cubics (Burmester 1888; Bottema and Roth,
Theoretical Kinematics, chapter 8).

The curve is not followed step by step but written down (`curve_chords`).  Fourteen of its points
are known by linear algebra alone: its two sliders, and a dyad at each of the twelve poles.  Every
plane through two of them meets it in two more points, the roots of a quadratic equation, and
these make its closed loops.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import NoReturn, Self, final

import numpy as np

from burmester.dyads.curve_chords import DOUBLE_ZERO, RANK_TOLERANCE, SAME_PLACE, Chord, Loop
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, unit_vectors

MIN_SOUNDNESS = 1e-6  # of a chord; below, one of its planes holds a whole piece of the curve
SLIDER_P1 = 1e-7  # |p1| of a unit manifold; below, it is a slider and its pivots are noise
DISTANT_P1 = 1e-5  # |p1| of a unit manifold; below, a pivot is hundreds of lengths away
MAX_LOOP_STEP = 0.1  # chordal; a loop with a longer step is noise
MIN_LOOP_LENGTH = 1e-4  # chordal; a shorter loop is a point
EXACT_TOLERANCE = 1e-9  # relative to a dyad's size; it is no answer if it misses a pose by more
START_PARAMETER = 0.1  # radians; a loop begins here, at no place that symmetry makes special
FIRST_STEPS, MAX_STEPS = 256, 20_000  # around a loop; a loop that needs more is noise
MIN_PARAMETER_STEP = 1e-9  # radians; a shorter step is not halved
STEPS_PER_SAMPLE = 4  # with which a loop is measured
DRAFT_SAMPLES = 50  # with which loops are compared before they are sampled
MIN_SAMPLES = 12  # of the smallest loop
NEWTON_STEPS = 3  # on the circle equations; they square the error
PAIRS = np.triu_indices(4, 1)  # of poses


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadCurve:
    """All RR dyads of four poses.

    components: one RR for each closed loop, one or two of them but for special poses, with
        arrays (n, 2), (n, 2) and (n,) in the task's own frames, in order along the loop.  A
        loop closes from its last sample to its first, and may pass through infinity, where
        the dyad becomes a slider.
    frames: where the curve was found.
    singular_values: (4,) of the design matrix, descending; where the last is small, the poses
        hardly determine the curve.
    spacing: from one sample to the next, in the metric that `dyad_curve` describes.
    """

    components: tuple[RR, ...]
    frames: CanonicalFrames
    singular_values: FloatArray
    spacing: float


def dyad_curve(poses: Displacement, samples: int = 400) -> DyadCurve:
    """The whole curve of RR dyads that pass through four poses exactly.

    About `samples` dyads are shared out among the closed loops by length, and neighbours are
    equally far apart, everywhere.  Length is that of both pivots on the sphere of directions: a
    pivot is (X, Y, L) / norm up to sign in the canonical frames, with L their length, so infinity
    is a place like others.

    Formula `four-poses` of the theory.

    Parameters
    ----------
    poses : Displacement, (4,)
        Four different poses.
    samples : int, default 400
        The number of dyads on all loops together, about.

    Returns
    -------
    DyadCurve
        The dyads, loop by loop.

    Raises
    ------
    InputError
        E121 (another number of poses), E103 (a number that is not finite), E124 (the four poses
        do not determine a curve).

    Notes
    -----
    Burmester 1888; Bottema and Roth, Theoretical Kinematics, chapter 8.

    Examples
    --------
    >>> t = np.linspace(0, 1.5, 4)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> curve = dyad_curve(poses, samples=100)
    >>> [loop.radius.size for loop in curve.components]
    [50, 50]
    >>> bool(np.abs(curve.components[0][:, None].residual(poses)).max() < 1e-9)
    True
    """
    if poses.shape != (4,):
        got = poses.shape[-1] if poses.shape else 0
        raise InputError(
            "E121",
            f"4 poses are needed here, not {got}",
            help="give 4 poses; dyads_of_five takes 5, and fit_pencil 6 or more",
        )
    poses.require_finite()
    frames, seen = CanonicalFrames.of(poses)
    spread = float(np.linalg.norm(np.std([np.cos(seen.angle), np.sin(seen.angle)], axis=-1)))
    if spread < RANK_TOLERANCE:
        _refuse(seen)
    # A body that turns little has its pivots far away: measure in the size of the pole figure.
    # Then Z1, Z2 and Z3 are as small as the spread of the rotations, and Z4 has to become so.
    frames = replace(frames, length=frames.length / spread)
    seen = Displacement(seen.translation * spread, seen.angle)
    balance = spread ** np.array([0, 0, 0, 0, 1, 1, 1, 2])
    design = constraint_manifold.monomials(seen.as_image_point()) * balance / spread**2
    _, singular_values, v = np.linalg.svd(design)
    if singular_values[3] < RANK_TOLERANCE * singular_values[0]:
        _refuse(seen)
    basis = v[4:] * balance
    known, quadrics = _known_points(seen, basis)
    traces = _traces(known, quadrics, basis, samples)
    if not traces:
        _refuse(seen)
    spacing = float(sum(trace.length[-1] for trace in traces) / samples)
    loops = [_polished(trace.sampled(spacing), seen) for trace in traces]
    gap = max(_distance(x, np.roll(x, 1, axis=0)).max() for x in loops)
    circles, errors = zip(*(_circles(x, seen) for x in loops), strict=True)
    if gap > 2 * spacing or max(errors) > EXACT_TOLERANCE:
        _refuse(seen)  # nothing but sliders, or lost in rounding
    components = tuple(frames.circle_from_canonical(circle) for circle in circles)
    return DyadCurve(components, frames, singular_values, spacing)


def _known_points(seen: Displacement, basis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points (n, 4) of the curve by linear algebra, at most 14, and its two quadrics (2, 4, 4)."""
    quadrics = np.moveaxis(constraint_manifold.condition_gradients(basis) @ basis.T, 1, 0)
    quadrics = np.linalg.svd(quadrics.reshape(2, 16), full_matrices=False)[2].reshape(2, 4, 4)
    points = np.empty((0, 4))
    for which, poles in enumerate(_poles(seen)):
        pivot = _pivots(basis)[:, which].T
        # The dyads with a given pivot are a line through the slider that has none; it meets
        # the curve once more.
        slider = np.linalg.svd(pivot)[2][3]
        pole = unit_vectors(poles) @ np.linalg.pinv(pivot).T
        linear = 2 * np.einsum("kij,ni,j->nk", quadrics, pole, slider)
        square = np.einsum("kij,ni,nj->nk", quadrics, pole, pole)
        other = (linear**2).sum(-1)[:, None] * pole - (linear * square).sum(-1)[:, None] * slider
        points = np.concatenate([points, slider[None], other])
    points = unit_vectors(points[np.linalg.norm(points, axis=-1) > RANK_TOLERANCE])
    residual = np.abs(np.einsum("kij,ni,nj->nk", quadrics, points, points)).max(axis=-1)
    return points[residual < SAME_PLACE], quadrics  # for special poses some are not on the curve


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Trace:
    """A loop with parameters (n,), the manifolds (n, 8) there and the length up to each (n,)."""

    chord: Chord
    loop: Loop
    parameter: FloatArray
    manifolds: FloatArray
    length: FloatArray

    @classmethod
    def of(cls, chord: Chord, loop: Loop, samples: int) -> Self:
        """Fine enough to place that many samples."""
        s = START_PARAMETER + np.linspace(0, 2 * np.pi, FIRST_STEPS + 1)
        while True:
            p = chord.manifolds(loop, s)
            pivots = _places(p)
            steps = _distance(pivots[1:], pivots[:-1])
            wide = steps * STEPS_PER_SAMPLE * samples > steps.sum()
            # Near a zero of D, real or not, the curve may run far within a small angle.
            z = np.exp(2j * loop.at(s)[0])
            near = np.abs(z[1:, None] - chord.zeros).min(axis=-1, initial=2.0) + 10 * DOUBLE_ZERO
            wide = (wide | (np.abs(np.diff(z)) > near)) & (np.diff(s) > MIN_PARAMETER_STEP)
            if not wide.any() or s.size > MAX_STEPS:
                break
            s = np.sort(np.concatenate([s, (s[1:] + s[:-1])[wide] / 2]))
        return cls(chord, loop, s, p, np.append(0.0, steps.cumsum()))

    def sampled(self, spacing: float) -> FloatArray:
        """The pivots (n, 2, 3) at equal distances along the loop."""
        total = self.length[-1]
        count = max(round(total / spacing), MIN_SAMPLES)
        at = np.interp((np.arange(count) + 0.5) / count * total, self.length, self.parameter)
        return _places(self.chord.manifolds(self.loop, at))

    def is_curve(self) -> bool:
        """Whether this is a smooth loop of RR dyads: no point, no noise, not only sliders.

        The poses of a two-slider motion have a loop of sliders.
        """
        smooth = np.diff(self.length).max() <= MAX_LOOP_STEP
        circles = np.abs(self.manifolds[:, 0]).max() > SLIDER_P1
        return bool(smooth and self.length[-1] > MIN_LOOP_LENGTH and circles)


def _traces(
    known: FloatArray, quadrics: FloatArray, basis: FloatArray, samples: int
) -> list[_Trace]:
    """The loops of RR dyads, each once.

    The best chord shows them all, unless one of its planes holds a whole piece of the curve;
    then what one chord hides another one shows.  The curve of symmetric poses is two pieces,
    a line and a circle in F, and the best chord goes from piece to piece.
    """
    every = [Chord.of(np.stack(xy), quadrics, basis) for xy in combinations(known, 2)]
    chords = sorted((x for x in every if x is not None), key=lambda chord: -chord.soundness)
    sound = bool(chords) and chords[0].soundness > MIN_SOUNDNESS
    for some in (chords[:1], chords) if sound else (chords,):
        drafts = [_Trace.of(chord, loop, DRAFT_SAMPLES) for chord in some for loop in chord.loops()]
        distinct: list[_Trace] = []
        for draft in sorted(filter(_Trace.is_curve, drafts), key=lambda trace: trace.length[-1]):
            if not distinct or not _covered(draft.manifolds[:: FIRST_STEPS // 16], distinct):
                distinct.append(draft)
        # The known points have to be on it; if not, rounding has spoiled this chord.
        if distinct and _covered(unit_vectors(known @ basis), distinct):
            return [_Trace.of(trace.chord, trace.loop, samples) for trace in distinct]
    return []


def _covered(p: FloatArray, traces: list[_Trace]) -> bool:
    """Whether manifolds (n, 8) are on these loops within the loops' steps, sliders by one pivot."""
    pivots = _places(p[np.abs(p[:, 0]) > DISTANT_P1])[:, None]
    nearest = [_distance(pivots, _places(trace.manifolds)).min(axis=-1) for trace in traces]
    step = max(np.diff(trace.length).max() for trace in traces)
    return bool(np.min(nearest, axis=0).max(initial=0.0) < 2 * step)


def _pivots(p: FloatArray) -> FloatArray:
    """Both pivots (*, 2, 3) of manifolds (*, 8), homogeneous and linear in p; see `circle`."""
    parts = np.stack(constraint_manifold.prismatic_parts(p), axis=-2)
    scale = np.broadcast_to(p[..., None, :1], (*parts.shape[:-1], 1))
    return np.concatenate([-2 * parts, scale], axis=-1)


def _places(p: FloatArray) -> FloatArray:
    """Both pivots (*, 2, 3) of manifolds (*, 8) as unit vectors (X, Y, 1) / norm."""
    return unit_vectors(_pivots(p))


def _distance(one: FloatArray, two: FloatArray) -> FloatArray:
    """The chordal distance (*) between dyads given by homogeneous pivots (*, 2, 3) of any sign."""
    apart = [np.linalg.norm(one - sign * two, axis=-1) for sign in (1, -1)]
    length: FloatArray = np.linalg.norm(np.minimum(*apart), axis=-1)
    return length


def _polished(pivots: FloatArray, seen: Displacement) -> FloatArray:
    """Newton by the shortest step on the circle equations, at pivots (n, 2, 3).

    In homogeneous pivots c and m the equations are s = c . B m, with one B for each pose;
    without their mean they are bilinear, and well-conditioned however far a pivot is.
    """
    forms = np.empty((4, 3, 3))
    forms[:, :2, :2] = -2 * seen.as_matrix()[:, :2, :2]
    forms[:, :2, 2] = -2 * seen.translation
    forms[:, 2, :2] = 2 * seen.inverse().rotate(seen.translation)
    forms[:, 2, 2] = (seen.translation**2).sum(axis=-1)
    forms -= forms.mean(axis=0)
    for _ in range(NEWTON_STEPS):
        by_c = np.einsum("ijk,nk->nij", forms, pivots[:, 1])
        by_m = np.einsum("ijk,nj->nik", forms, pivots[:, 0])
        residual = np.einsum("nij,nj->ni", by_c, pivots[:, 0])
        # The same again from arms of finite length, which suffer less where they are short.
        scale = pivots[..., 2].prod(axis=-1)[:, None]
        square = _arms(pivots, seen)[2] ** 2 * scale
        short = np.abs(square).max(axis=-1, keepdims=True) < 1
        residual = np.where(short, square - square.mean(axis=-1, keepdims=True), residual)
        jacobian = np.concatenate([by_c, by_m], axis=-1)
        step = matvec(np.linalg.pinv(jacobian, rcond=RANK_TOLERANCE), residual)
        pivots = unit_vectors(pivots - step.reshape(pivots.shape))
    return pivots


def _arms(pivots: FloatArray, seen: Displacement) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Both pivots (n, 2) of pivots (n, 2, 3), and their distances (n, 4) over the poses."""
    fixed_pivot, moving_pivot = np.moveaxis(pivots[..., :2] / pivots[..., 2:], 1, 0)
    bare = RR(fixed_pivot, moving_pivot, np.zeros(len(pivots)))
    return fixed_pivot, moving_pivot, bare[:, None].residual(seen)


def _circles(pivots: FloatArray, seen: Displacement) -> tuple[RR, float]:
    """The dyads with pivots (n, 2, 3), the radius the mean over the poses.

    Returns the dyads (n,) and their greatest distance from a pose, measured in the radius, or in
    the size of the motion where that is larger.
    """
    fixed_pivot, moving_pivot, arms = _arms(pivots, seen)
    radius = arms.mean(axis=-1)
    size = np.maximum(radius, np.sqrt((seen.translation**2).sum(axis=-1).mean()))
    error = np.abs(arms - radius[:, None]).max(axis=-1) / size
    return RR(fixed_pivot, moving_pivot, radius), float(error.max())


def _poles(seen: Displacement) -> tuple[FloatArray, FloatArray]:
    """The poles in F and in M (6, 3) of each two of four poses, homogeneous: (Z1 : Z2 : Z3)."""
    i, j = PAIRS
    back = seen[i].inverse()
    in_fixed, in_moving = (x.as_image_point()[:, :3] for x in (seen[j] @ back, back @ seen[j]))
    return in_fixed, in_moving


def _refuse(seen: Displacement) -> NoReturn:
    """Say in plain words why the poses (4,) have no curve."""
    both = _poles(seen)
    size = np.linalg.norm(both[0], axis=-1)
    name = [f"from pose {i + 1} to pose {j + 1}" for i, j in zip(*PAIRS, strict=True)]
    why = "every dyad of these poses is a slider, or rounding hides where the curve goes"
    help = "change one of the poses"
    if size.min() <= SAME_PLACE * size.max():
        why = f"{name[int(size.argmin())]} nothing changes, so they are not four different poses"
        help = "change one of the two; with three poses every moving pivot has a fixed pivot"
    elif np.abs(both[0][:, 2]).max() <= SAME_PLACE * size.max():
        why = "the body never turns, so all its points trace the same curve"
        help = "turn the body in one of the poses, or use two parallel equal links on a circle"
    else:
        for poles, of in zip(both, ("space", "the body"), strict=True):
            unit = unit_vectors(poles)
            a, b = np.triu_indices(6, 1)
            same = np.linalg.norm(np.cross(unit[a], unit[b]), axis=-1) < SAME_PLACE
            same &= np.abs(unit[a, 2]) > SAME_PLACE  # at infinity the body moves along, not around
            if same.all():
                why = "the body only turns about one point"
                help = "use a single pin there, or move two of the poses off that turn"
                break
            if same.any():
                first, second = a[same][0], b[same][0]
                why = (
                    f"{name[first]} and {name[second]} the body turns about the same point of "
                    f"{of}, and dyads with a pivot there are a second family"
                )
                help = "move or turn one of these poses a little"
    raise InputError("E124", "the four poses do not determine a curve of dyads", why=why, help=help)
