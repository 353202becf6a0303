"""Four poses: Burmester's curve, every RR dyad that meets them, as whole closed loops.

Four image points leave a four-dimensional null space of manifolds.  In it, a projective
three-space, the two conditions of Eq. (17) are two quadric surfaces, and the dyads are the
curve of degree four in which they meet.  Its fixed pivots make the centre-point curve in F,
its moving pivots the circle-point curve in M, both cubics (Burmester 1888; Bottema and Roth,
Theoretical Kinematics, chapter 8).

The curve is not followed step by step but written down (`chord`).  Fourteen of its points are
known by linear algebra alone: its two sliders, and a dyad at each of the twelve poles.  Every
plane through two of them meets it in two more points, the roots of a quadratic equation, and
these make its closed loops.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import NoReturn, Self, final

import numpy as np

from burmester.dyads.curve_chords import DEPENDENT, DOUBLE, SAME, Chord, Loop, unit_rows
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["DyadCurve", "dyad_curve"]

BROKEN = 1e-6  # below this a plane through the chord holds a whole piece of the curve
SLIDER = 1e-7  # a unit manifold with |p1| below this is a slider, and its pivots are noise
FAR = 1e-5  # a unit manifold with |p1| below this has pivots hundreds of lengths away
ROUGH, SMALL = 0.1, 1e-4  # a step of a loop that is noise; the length of one that is a point
EXACT = 1e-9  # a dyad that misses its poses by more, relative to its size, is no answer
START = 0.1  # where on a loop to begin: not at a place that symmetry makes special
STEPS, MOST = 256, 20_000  # around a loop at first, and at last: more is noise
SHORT = 1e-9  # a step of the parameter too short to be halved
FINER = 4  # steps that a loop is measured with, for one between samples
PAIRS = np.triu_indices(4, 1)  # of poses
DRAFT = 50  # samples to look at a loop with
LEAST = 12  # samples that the smallest loop gets
NEWTON_STEPS = 3


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
    """The whole curve of RR dyads that pass through four poses (4,) exactly.

    About `samples` dyads are shared out among the loops by length, and neighbours are equally
    far apart, everywhere.  Length is that of both pivots on the sphere of directions: a pivot
    is (X, Y, L) / norm up to sign in the canonical frames, with L their length, so infinity
    is a place like others.

    Raises InputError E121 (another number of poses), E103 (a number that is not finite) and
    E124 (the four poses do not determine a curve).
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
    turn = float(np.linalg.norm(np.std([np.cos(seen.angle), np.sin(seen.angle)], axis=-1)))
    if turn < DEPENDENT:
        _refuse(seen)
    # A body that turns little has its pivots far away: measure in the size of the pole figure.
    # Then Z1, Z2 and Z3 are as small as the turn, and Z4 has to become so.
    frames = replace(frames, length=frames.length / turn)
    seen = Displacement(seen.translation * turn, seen.angle)
    balance = turn ** np.array([0, 0, 0, 0, 1, 1, 1, 2])
    design = constraint_manifold.monomials(seen.as_image_point()) * balance / turn**2
    _, singular_values, v = np.linalg.svd(design)
    if singular_values[3] < DEPENDENT * singular_values[0]:
        _refuse(seen)
    basis = v[4:] * balance
    known, quadrics = _known_points(seen, basis)
    traces = _traces(known, quadrics, basis, samples)
    if not traces:
        _refuse(seen)
    spacing = float(sum(trace.length[-1] for trace in traces) / samples)
    found = [_polished(trace.sampled(spacing), seen) for trace in traces]
    gap = max(_distance(x, np.roll(x, 1, axis=0)).max() for x in found)
    circles, misses = zip(*(_circles(x, seen) for x in found), strict=True)
    if gap > 2 * spacing or max(misses) > EXACT:
        _refuse(seen)  # nothing but sliders, or lost in rounding
    components = tuple(frames.circle_back(circle) for circle in circles)
    return DyadCurve(components, frames, singular_values, spacing)


def _known_points(seen: Displacement, basis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points (n, 4) of the curve, at most fourteen, and the two quadrics (2, 4, 4) it lies on."""
    quadrics = np.moveaxis(constraint_manifold.condition_gradients(basis) @ basis.T, 1, 0)
    quadrics = np.linalg.svd(quadrics.reshape(2, 16), full_matrices=False)[2].reshape(2, 4, 4)
    points = np.empty((0, 4))
    for which, poles in enumerate(_poles(seen)):
        pivot = _pivots(basis)[:, which].T
        # The dyads with a given pivot are a line through the slider that has none; it meets
        # the curve once more.
        slider = np.linalg.svd(pivot)[2][3]
        pole = unit_rows(poles) @ np.linalg.pinv(pivot).T
        slope = 2 * np.einsum("kij,ni,j->nk", quadrics, pole, slider)
        square = np.einsum("kij,ni,nj->nk", quadrics, pole, pole)
        ahead = (slope**2).sum(-1)[:, None] * pole - (slope * square).sum(-1)[:, None] * slider
        points = np.concatenate([points, slider[None], ahead])
    points = unit_rows(points[np.linalg.norm(points, axis=-1) > DEPENDENT])
    miss = np.abs(np.einsum("kij,ni,nj->nk", quadrics, points, points)).max(axis=-1)
    return points[miss < SAME], quadrics  # of special poses some are not what they should be


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
        s = START + np.linspace(0, 2 * np.pi, STEPS + 1)
        while True:
            p = chord.manifolds(loop, s)
            pivots = _places(p)
            steps = _distance(pivots[1:], pivots[:-1])
            wide = steps * FINER * samples > steps.sum()
            # Near a zero of D, real or not, the curve may run far within a small angle.
            z = np.exp(2j * loop.at(s)[0])
            near = np.abs(z[1:, None] - chord.zeros).min(axis=-1, initial=2.0) + 10 * DOUBLE
            wide = (wide | (np.abs(np.diff(z)) > near)) & (np.diff(s) > SHORT)
            if not wide.any() or s.size > MOST:
                break
            s = np.sort(np.concatenate([s, (s[1:] + s[:-1])[wide] / 2]))
        return cls(chord, loop, s, p, np.append(0.0, steps.cumsum()))

    def sampled(self, spacing: float) -> FloatArray:
        """The pivots (n, 2, 3) at equal distances along the loop."""
        total = self.length[-1]
        count = max(round(total / spacing), LEAST)
        at = np.interp((np.arange(count) + 0.5) / count * total, self.length, self.parameter)
        return _places(self.chord.manifolds(self.loop, at))

    def is_curve(self) -> bool:
        """Whether this is a smooth loop of RR dyads: no point, no noise, not only sliders.

        The poses of a two-slider motion have a loop of sliders.
        """
        rough = np.diff(self.length).max() > ROUGH
        return not rough and self.length[-1] > SMALL and np.abs(self.manifolds[:, 0]).max() > SLIDER


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
    sound = bool(chords) and chords[0].soundness > BROKEN
    for some in (chords[:1], chords) if sound else (chords,):
        drafts = [_Trace.of(chord, loop, DRAFT) for chord in some for loop in chord.loops()]
        found: list[_Trace] = []
        for draft in sorted(filter(_Trace.is_curve, drafts), key=lambda trace: trace.length[-1]):
            if not found or not _covered(draft.manifolds[:: STEPS // 16], found):
                found.append(draft)
        # The known points have to be on it; if not, rounding has spoiled this chord.
        if found and _covered(unit_rows(known @ basis), found):
            return [_Trace.of(trace.chord, trace.loop, samples) for trace in found]
    return []


def _covered(p: FloatArray, traces: list[_Trace]) -> bool:
    """Whether the manifolds (n, 8) are on these loops, as far as their steps tell.

    Near a slider one of the pivots is noise, and says nothing.
    """
    pivots = _places(p[np.abs(p[:, 0]) > FAR])[:, None]
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
    return unit_rows(_pivots(p))


def _distance(one: FloatArray, two: FloatArray) -> FloatArray:
    """The chordal distance (*) between dyads given by their pivots (*, 2, 3).

    A pivot is a line through the origin: of two differences of unit vectors the smaller counts.
    """
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
        miss = np.einsum("nij,nj->ni", by_c, pivots[:, 0])
        # The same again from arms of finite length, which suffer less where they are short.
        scale = pivots[..., 2].prod(axis=-1)[:, None]
        square = _arms(pivots, seen)[2] ** 2 * scale
        short = np.abs(square).max(axis=-1, keepdims=True) < 1
        miss = np.where(short, square - square.mean(axis=-1, keepdims=True), miss)
        slope = np.concatenate([by_c, by_m], axis=-1)
        step = np.linalg.pinv(slope, rcond=DEPENDENT) @ miss[..., None]
        pivots = unit_rows(pivots - step.reshape(pivots.shape))
    return pivots


def _arms(pivots: FloatArray, seen: Displacement) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Both pivots (n, 2) of pivots (n, 2, 3), and their distances (n, 4) over the poses."""
    fixed_pivot, moving_pivot = np.moveaxis(pivots[..., :2] / pivots[..., 2:], 1, 0)
    bare = RR(fixed_pivot, moving_pivot, np.zeros(len(pivots)))
    return fixed_pivot, moving_pivot, bare[:, None].residual(seen)


def _circles(pivots: FloatArray, seen: Displacement) -> tuple[RR, float]:
    """The dyads (n,) with these pivots (n, 2, 3), and how far they miss the poses at most.

    The radius is the mean over the poses; a miss is measured in it, or in the size of the
    motion where that is larger.
    """
    fixed_pivot, moving_pivot, arms = _arms(pivots, seen)
    radius = arms.mean(axis=-1)
    size = np.maximum(radius, np.sqrt((seen.translation**2).sum(axis=-1).mean()))
    miss = np.abs(arms - radius[:, None]).max(axis=-1) / size
    return RR(fixed_pivot, moving_pivot, radius), float(miss.max())


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
    if size.min() <= SAME * size.max():
        why = f"{name[int(size.argmin())]} nothing changes, so they are not four different poses"
        help = "change one of the two; with three poses every moving pivot has a fixed pivot"
    elif np.abs(both[0][:, 2]).max() <= SAME * size.max():
        why = "the body never turns, so all its points trace the same curve"
        help = "turn the body in one of the poses, or use two parallel equal links on a circle"
    else:
        for poles, of in zip(both, ("space", "the body"), strict=True):
            turned = unit_rows(poles)
            a, b = np.triu_indices(6, 1)
            same = np.linalg.norm(np.cross(turned[a], turned[b]), axis=-1) < SAME
            same &= np.abs(turned[a, 2]) > SAME  # at infinity the body moves along, not around
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
