"""How often clean poses are named, and single wrong numbers missed, by the number of poses.

`python -m benchmarks.odd_pose_chances clean 10 0.5 200 1` makes 200 tasks of 10 poses from seed 1:
poses on a random linkage with noise of 1e-4 to 1e-3 of their extent (`NormalizedPoses`), and of
half as many radians.  It counts the tasks in which a pose is named.  `single` puts one number (x, y
or the angle) of one pose off by 20 standard deviations, wherever that leads, and counts

found: the right pose is named; among: another is, and the right one as a likely one; wrong.
known: what a judge names who knows the linkage, the noise and its ratio, but for small changes
    of the linkage: chi-square tests to first order, at the same chance of 0.5 %.
scale: the same of a judge who knows the linkage and the ratio, and not how large the noise is.

What `known` does not name no test can tell.  The judges share no code with the package.
"""

import sys
from collections import Counter
from typing import NamedTuple

import numpy as np
from scipy.stats import beta, chi2, f
from tests.oracles.witness import random_four_bar, random_poses, span

from burmester import Displacement, Task
from burmester.diagnosis.odd_pose import odd_pose
from burmester.fourbar.dyad import PR, RP, RR

LEVEL = 0.005
DEVIATIONS = 20.0
STEP = 1e-6  # of differences


class Sample(NamedTuple):
    """Rows (N, 3), their standard deviations (3,), the dyads, and the pose that is wrong."""

    rows: np.ndarray
    sigma: np.ndarray
    dyads: tuple
    wrong: int | None = None

    @property
    def task(self):
        return Task(Displacement.from_poses(self.rows))


def extent(rows):
    """Of positions spread evenly over a line, its length."""
    away = np.sort(((rows[:, :2] - np.median(rows[:, :2], axis=0)) ** 2).sum(axis=1))[:-1]
    return float(np.sqrt(12 * away.mean()))


def clean(rng, count, ratio):
    """Poses on a random linkage with noise."""
    second = (RR, RR, RR, PR, RP)[rng.integers(5)]
    size = 0.0
    while size < 0.2:
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, count)
        size = span(rows)
    length = extent(rows)
    sigma = 10 ** rng.uniform(-4, -3) * np.array([length, length, ratio])
    return Sample(rows + sigma * rng.normal(size=rows.shape), sigma, tuple(dyads))


def single(rng, count, ratio):
    """The same with one number wrong."""
    rows, sigma, dyads, _ = clean(rng, count, ratio)
    pose, number = int(rng.integers(count)), int(rng.integers(3))
    rows[pose, number] += DEVIATIONS * sigma[number] * rng.choice([-1, 1])
    return Sample(rows, sigma, dyads, pose)


def _equations(z, kinds, rows):
    """What dyads with numbers z (2, 5) miss at rows (*, 3): (*, 2)."""
    turn, place = np.exp(1j * rows[..., 2]), rows[..., 0] + 1j * rows[..., 1]
    out = []
    for kind, (a, b, c, d, e) in zip(kinds, z, strict=True):
        if kind is RR:
            out.append(abs(place + turn * (c + 1j * d) - a - 1j * b) - e)
        elif kind is PR:
            out.append((np.exp(-1j * a) * (place + turn * (c + 1j * d))).real - b)
        else:
            out.append((np.exp(-1j * c) * (a + 1j * b - place) / turn).real - d)
    return np.stack(out, axis=-1)


def _numbers(dyad):
    if isinstance(dyad, RR):
        return [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
    if isinstance(dyad, PR):
        return [dyad.normal_angle, dyad.offset, *dyad.moving_pivot, 0.0]
    return [*dyad.fixed_pivot, dyad.normal_angle, dyad.offset, 0.0]


def judged(sample):
    """What judges `known` and `scale` name: the poses, or None."""
    rows, sigma = sample.rows, sample.sigma
    kinds = [type(dyad) for dyad in sample.dyads]
    z = np.array([_numbers(dyad) for dyad in sample.dyads], dtype=float)
    count = len(rows)
    by_pose = np.stack(
        [
            (_equations(z, kinds, rows + STEP * e) - _equations(z, kinds, rows - STEP * e))
            for e in np.eye(3)
        ],
        axis=-1,
    ) / (2 * STEP)
    by_pose = by_pose * sigma
    slopes = []
    for k in range(10):
        e = STEP * np.eye(10)[k].reshape(2, 5)
        if kinds[k // 5] is RR or k % 5 < 4:
            change = _equations(z + e, kinds, rows) - _equations(z - e, kinds, rows)
            slopes.append(change / (2 * STEP))
    root = np.linalg.inv(np.linalg.cholesky(by_pose @ by_pose.swapaxes(1, 2)))
    miss = (root @ _equations(z, kinds, rows)[..., None])[..., 0].ravel()
    slope = np.stack([(root @ each[..., None])[..., 0].ravel() for each in slopes], axis=-1)
    left = np.eye(2 * count) - slope @ np.linalg.pinv(slope)
    off, spare = left @ miss, 2 * count - len(slopes)
    total, chances = off @ off, np.ones((count, 2))
    for k in range(count):
        at = slice(2 * k, 2 * k + 2)
        shares, turns = left[at, at], root[k] @ by_pose[k]
        gain = off[at] @ np.linalg.pinv(shares) @ off[at]
        gains = (turns.T @ off[at]) ** 2 / (turns * (shares @ turns)).sum(axis=0)
        rest, rests = max(total - gain, 0.0), np.maximum(total - gains, 1e-300)
        known = count * chi2.sf(gain, 2), 3 * count * chi2.sf(gains, 1).min()
        scale = (
            count * f.sf(gain / 2 * (spare - 2) / max(rest, 1e-300), 2, spare - 2),
            3 * count * f.sf(gains * (spare - 1) / rests, 1, spare - 1).min(),
        )
        chances[k] = 2 * min(known), 2 * min(scale)
    named = chances.argmin(axis=0)
    return [int(named[j]) if chances[named[j], j] < LEVEL else None for j in (0, 1)]


def counted(kind, count, ratio, number, seed):
    """What is said of so many tasks, by words."""
    found = Counter()
    for index in range(number):
        rng = np.random.default_rng([seed, count, index])
        sample = {"clean": clean, "single": single}[kind](rng, count, ratio)
        odd = odd_pose(sample.task)
        if odd is None:
            found["silent"] += 1
        elif odd.pose == sample.wrong:
            found["found"] += 1
        else:
            found["among" if sample.wrong in odd.others else "wrong"] += 1
        if kind == "single":
            known, scale = judged(sample)
            found["known"] += known == sample.wrong
            found["scale"] += scale == sample.wrong
    return found


def interval(times, number, confidence=0.95):
    """The interval of a share of `times` in `number` (Clopper and Pearson)."""
    tail = (1 - confidence) / 2
    low = beta.ppf(tail, times, number - times + 1) if times else 0.0
    high = beta.ppf(1 - tail, times + 1, number - times) if times < number else 1.0
    return float(low), float(high)


def main(kind, count, ratio, number, seed):
    """Count and print."""
    found = counted(kind, int(count), float(ratio), int(number), int(seed))
    print(kind, "N =", count, "ratio", ratio, dict(found))
    if kind == "clean":
        low, high = interval(found["wrong"], int(number))
        print(f"  named {found['wrong']}: {100 * low:.2f} to {100 * high:.2f} %")


if __name__ == "__main__":
    main(*sys.argv[1:])
