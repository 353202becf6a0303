"""Tasks put elsewhere: frames moved and turned, another unit and order, F and M exchanged.

What is found there is brought back in long doubles, and compared; see `benchmarks/invariance.py`
for what is fair to ask.
"""

import numpy as np

from burmester import Displacement, Task, best_dyads, critical_dyads
from burmester.fourbar.dyad import PR, RP, RR
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from tests.oracles.witness import random_four_bar, random_poses, span

LIMIT, EPS, ENDLESS = 1e-8, 1e-15, 100
LONG = np.longdouble


def turned(vectors, angle):
    """Vectors (*, 2) turned by an angle, in long doubles."""
    v, angle = np.asarray(vectors, dtype=LONG), np.asarray(angle, dtype=LONG)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * v[..., 0] - s * v[..., 1], s * v[..., 0] + c * v[..., 1]], axis=-1)


class Place:
    """Where a task is put: x in F goes to unit (R x + offset), M likewise; then maybe swapped."""

    def __init__(self, rng, count):
        self.unit = LONG(10 ** rng.uniform(-6, 6))
        self.offsets = (10 ** rng.uniform(-1, 6, 2)[:, None] * rng.normal(size=(2, 2))).astype(LONG)
        half = np.pi + rng.choice([-1e-12, 0, 1e-12], 2)
        self.angles = np.where(rng.random(2) < 0.5, half, rng.uniform(-np.pi, np.pi, 2))
        self.order = rng.permutation(count)
        self.swapped = bool(rng.random() < 0.5)

    def put(self, rows):
        """Rows as they are there, rounded to doubles."""
        (f, m), (a, b) = self.angles, self.offsets
        angle = np.asarray(rows[:, 2], dtype=LONG)
        d = turned(rows[:, :2] + turned(turned(-b, -m), angle), f) + a
        poses = Displacement(
            (self.unit * d).astype(float), (angle + LONG(f) - LONG(m)).astype(float)
        )[self.order]
        return poses.inverse() if self.swapped else poses

    def meant(self, poses):
        """Rows that those doubles mean, here."""
        (f, m), (a, b) = self.angles, self.offsets
        d, angle = poses.translation.astype(LONG), poses.angle.astype(LONG)
        if self.swapped:
            d, angle = -turned(d, -angle), -angle
        angle = angle - LONG(f) + LONG(m)
        d = turned(d / self.unit - a, -f) + turned(turned(b, -m), angle)
        back = np.empty((len(d), 3))
        back[self.order] = np.column_stack([d, angle]).astype(float)
        return back

    def back(self, dyad):
        """A dyad found there, as it is here: its kind and what it is made of."""
        kind, parts = made_of(dyad)
        if self.swapped:
            kind, parts = kind[::-1], parts[::-1]
        result = [
            self._back(part, offset, angle)
            for part, offset, angle in zip(parts, self.offsets, self.angles, strict=True)
        ]
        return kind, result

    def _back(self, part, offset, angle):
        if len(part) == 2:
            return turned(np.asarray(part, dtype=LONG) / self.unit - offset, -angle)
        normal = np.asarray(part[:2], dtype=LONG)
        return np.append(turned(normal, -angle), LONG(part[2]) / self.unit - normal @ offset)


def made_of(dyad):
    """The kind of a dyad and its parts, in F and in M: a point, or a line n1, n2, offset."""
    if isinstance(dyad, RR):
        return "RR", [dyad.fixed_pivot, dyad.moving_pivot]
    line = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle), dyad.offset])
    return (
        ("PR", [line, dyad.moving_pivot])
        if isinstance(dyad, PR)
        else ("RP", [dyad.fixed_pivot, line])
    )


def gap(one, other):
    """How far two dyads are apart, in the rows' unit (lines: in radians, too)."""
    if one[0] != other[0]:
        return np.inf
    gaps = []
    for a, b in zip(one[1], other[1], strict=True):
        gaps.append(min(np.abs(a - b).max(), np.abs(a + b).max() if len(a) == 3 else np.inf))
    return float(max(gaps))


def solved(poses, method):
    """The dyads by a method, a list, as `synthesize` has them; no linkages are made of them."""
    if method == "critical":
        found = critical_dyads(poses)
        return [found.dyads[k] for k in np.flatnonzero(found.real)]
    if method == "best_dyads":
        fit = best_dyads(poses)
        return [fit.dyads[k] for k in range(len(fit.rms_error))]
    task = Task(poses)
    problem = SynthesisProblem.of(task, classify_motion(task), SynthesisOptions(method))
    return [found.dyad for found in search_dyads(with_method(problem)).dyads]


def random_task(rng, method):
    """Rows (x, y, angle) with a span of 1."""
    count = 5 if method == "exact" else int(rng.integers(6, 31))
    rows = random_poses(random_four_bar(rng, rng.choice([RR, RR, RR, PR, RP])), rng, count)
    rows[:, :2] /= span(rows)
    if rng.random() < 0.75:
        rows = rows + 10 ** rng.uniform(-6, -1) * rng.normal(size=rows.shape)
    return rows


def is_near(dyad):
    """Whether both pivots, or the line, are within ENDLESS."""
    return all(np.abs(part).max() < ENDLESS for part in dyad[1])


def judged(rng, method):
    """Our own loss, what the poses' rounding moved, and what is allowed, for each near dyad.

    With it, whether there are more or fewer of them elsewhere.  Dyads with a pivot beyond ENDLESS
    spans are left out: nearly sliders, they are told by their last digits.
    """
    rows = random_task(rng, method)
    place = Place(rng, len(rows))
    poses = place.put(rows)
    there = [place.back(dyad) for dyad in solved(poses, method)]
    meant = place.meant(poses)
    here = [made_of(dyad) for dyad in solved(Displacement.from_poses(meant), method)]
    given = [made_of(dyad) for dyad in solved(Displacement.from_poses(rows), method)]
    shaken = [
        [made_of(dyad) for dyad in solved(Displacement.from_poses(meant + change), method)]
        for change in 1e3 * EPS * rng.normal(size=(2, *rows.shape))
    ]

    def moved(dyad, others):
        return min((gap(dyad, other) for other in others), default=np.inf)

    result = []
    for dyad in filter(is_near, here):
        shake = max(moved(dyad, others) for others in shaken) / 1e3
        lost = moved(dyad, given)
        result.append((moved(dyad, there), lost, max(LIMIT, shake, 10 * lost)))
    return np.array(result).reshape(-1, 3), sum(map(is_near, here)) != sum(map(is_near, there))
