"""Is a linkage found wherever one is known?  Linkages planted in tasks that they keep to.

    python -m benchmarks.planted_limits --count 300 --seed 0

Each task is made from a random usable linkage (`stacked/random_linkages`): six to twelve of its
poses, from a part of its motion or all of it, most of them with a little noise, and around it what
limits and requirements can say, each drawn by itself: boxes around the pivots (one for both dyads,
or one for each; from a fiftieth to ten spans wide), lengths, kinds, exact poses, a transmission
angle a little below the linkage's own, a footprint, and a greatest error (`within`) a little above
its own.  A task counts where the package's judge says that the planted linkage keeps all of it, so
that there is an answer.

Exit code 1 if a task is left without a linkage.
"""

import argparse
import sys
import time
from dataclasses import replace

import numpy as np

from burmester import judge
from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.stacked.random_linkages import SampleOptions, random_linkages
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements

NOISES = 0.0, 1e-4, 1e-3, 5e-3  # spans, and radians
WIDEST, NARROWEST = 10.0, 0.02  # spans; of boxes
MOST_EXACT = 2  # number of poses that are met exactly
PLACES = 60  # number of places along a motion from which poses are taken
LEAST_PART, MOST_SHIFT = 0.12, 4.0  # of a motion; spans that the body's origin is moved by


def _box(rng, points, span):
    """A box that holds points (k, 2), as roomy as it happens to be, the points anywhere in it."""
    width = span * NARROWEST * (WIDEST / NARROWEST) ** rng.random(2)
    share = rng.random(2)
    low, high = points.min(axis=0) - share * width, points.max(axis=0) + (1 - share) * width
    return box(low, high)


def _pivots(linkage, places):
    """Fixed pivots, moving pivots, all in F at the places, and lengths of links; lists."""
    fixed, moving, there, lengths = [], [], [], []
    for dyad in (linkage.first, linkage.second):
        moving.append(dyad.moving_pivot)
        there.append(places.act(dyad.moving_pivot))
        if not isinstance(dyad, PR):
            fixed.append(dyad.fixed_pivot)
            there.append(dyad.fixed_pivot[None])
            lengths.append(float(dyad.radius))
    return fixed, moving, np.concatenate(there), lengths


def _range(rng, lengths):
    """A least and a greatest length around lengths."""
    least = min(lengths) * rng.uniform(0.3, 0.99) if rng.random() < 0.6 else 0.0
    return least, max(lengths) * rng.uniform(1.01, 3.0)


def _limits(rng, linkage, places, span):
    """What each dyad is allowed to be, of what the planted ones are; nothing here and there."""
    has_fixed, has_moving, has_length, has_kinds = rng.random(4) < (0.75, 0.65, 0.5, 0.5)
    fixed, moving, _, lengths = _pivots(linkage, places)
    slides = isinstance(linkage.second, PR)
    kinds = frozenset({"RR", "PR"} if slides else {"RR"})
    common = {"kinds": kinds} if has_kinds else {}
    if not (has_fixed or has_moving or has_length):
        return ()
    if rng.random() < 0.5:  # one for both; no fixed pivot of a slider can be limited
        own = dict(common)
        if has_fixed and not slides:
            own["fixed_pivot"] = _box(rng, np.array(fixed), span)
        if has_moving:
            own["moving_pivot"] = _box(rng, np.array(moving), span)
        if has_length:
            own["length"] = _range(rng, lengths)
        return (Limits(**own),)
    out = []
    for number, dyad in enumerate((linkage.first, linkage.second)):
        own = dict(common)
        if has_fixed and not isinstance(dyad, PR):
            own["fixed_pivot"] = _box(rng, dyad.fixed_pivot[None], span)
        if has_moving:
            own["moving_pivot"] = _box(rng, moving[number][None], span)
        if has_length and not isinstance(dyad, PR):
            own["length"] = _range(rng, [float(dyad.radius)])
        out.append(Limits(**own))
    return tuple(out)


def planted(seed, number):
    """A task and the linkage that it was made from; None where that does not keep to it."""
    rng = np.random.default_rng([33, seed, number])
    drawn = random_linkages(SampleOptions(seed=seed, poses=PLACES), np.array([number]))
    unit, linkage = float(np.exp(rng.uniform(0, np.log(1000)))), drawn.linkages.linkage(0)
    exact_rows = _part(rng, drawn.exact_poses[0]) * [unit, unit, 1.0]
    span = float(np.linalg.norm(np.ptp(exact_rows[:, :2], axis=0)))
    shift = span * rng.uniform(-1, 1, 2) * MOST_SHIFT * (rng.random() < 0.3)
    exact_rows[:, :2] = Displacement.from_poses(exact_rows).act(shift)
    linkage = _moved(linkage, unit, shift)
    span = float(np.linalg.norm(np.ptp(exact_rows[:, :2], axis=0)))
    noise, number_exact = NOISES[rng.integers(len(NOISES))], int(rng.integers(0, MOST_EXACT + 1))
    exact = np.zeros(len(exact_rows), dtype=bool)
    exact[rng.permutation(len(exact))[:number_exact]] = rng.random() < 0.5
    errors = rng.normal(scale=noise, size=exact_rows.shape) * [span, span, 1.0]
    rows = np.round(np.where(exact[:, None], exact_rows, exact_rows + errors), 9)
    limits = _limits(rng, linkage, Displacement.from_poses(exact_rows), span)
    task = Task(
        Displacement.from_poses(rows), length_unit="mm", exact=exact if exact.any() else None
    )
    try:
        task = replace(task, limits=limits)
    except ValueError:
        return None
    judged = judge(task, linkage).linkages[0]
    asked = {}
    if rng.random() < 0.6:
        least = np.degrees(judged.driven.least_over_range)
        asked["transmission_deg"] = float(least * rng.uniform(0.85, 0.999))
    if rng.random() < 0.4:
        there = _pivots(linkage, Displacement.from_poses(exact_rows))[2]
        more = span * rng.uniform(0.1, 1.0)
        asked["footprint"] = box(there.min(axis=0) - more, there.max(axis=0) + more)
    if rng.random() < 0.7:
        length = judge(task, linkage).problem.length_per_radian
        worst = max(judged.error.worst, length * float(judged.error.angle.max()))
        asked["within"] = max(float(worst * rng.uniform(1.02, 1.5)), 1e-5 * span)
    task = replace(task, requirements=Requirements(**asked))
    return (task, linkage) if judge(task, linkage).linkages[0].usable else None


def _part(rng, rows):
    """Six to twelve poses from a part of a motion in rows (N, 3), in their order."""
    count = int(rng.integers(6, 13))
    wide = len(rows) * (LEAST_PART ** rng.random() if rng.random() < 0.5 else 1.0)
    wide = max(count, int(wide))
    start = int(rng.integers(0, len(rows) - wide + 1))
    return rows[start + np.round(np.linspace(0, wide - 1, count)).astype(int)]


def _moved(linkage, unit, shift):
    """A linkage with all lengths times a number, the body's origin then moved by a shift in M."""
    dyads = []
    for dyad in (linkage.first, linkage.second):
        moving = dyad.moving_pivot * unit - shift
        if isinstance(dyad, PR):
            dyads.append(PR(dyad.normal_angle, dyad.offset * unit, moving))
        else:
            dyads.append(RR(dyad.fixed_pivot * unit, moving, dyad.radius * unit))
    return Linkage(*dyads)


def planted_tasks(count, seed):
    """The first tasks of a seed, with their numbers."""
    number = 0
    while count:
        if (one := planted(seed, number)) is not None:
            yield number, *one
            count -= 1
        number += 1


def words(task):
    """What a task asks, in short."""
    asked, limits = task.requirements, task.limits
    names = [f"{len(limits)} limits"] if limits else []
    names += ["fixed"] * any(each.fixed_pivot is not None for each in limits)
    names += ["moving"] * any(each.moving_pivot is not None for each in limits)
    names += ["length"] * any(each.has_length for each in limits)
    names += [f"{int(task.exact.sum())} exact"] if task.exact is not None else []
    names += [f"{asked.transmission_deg:.1f}°"] if asked.transmission_deg else []
    names += ["footprint"] if asked.footprint is not None else []
    names += [f"within {asked.within:.3g}"] if asked.within is not None else []
    return ", ".join(names)


def main():
    """Run the campaign, and name the tasks without a linkage."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--number", type=int, help="this task alone")
    given = parser.parse_args()
    tasks = planted_tasks(given.count, given.seed)
    if given.number is not None:
        tasks = [(given.number, *planted(given.seed, given.number))]
    lost, took, total = [], [], 0
    for number, task, _ in tasks:
        begun = time.process_time()
        result = synthesize(task)
        took.append(time.process_time() - begun)
        total += 1
        if not result.usable:
            lost.append(number)
            print(
                f"{number:4d} {result.outcome.code} {len(task.poses.angle)} poses, {words(task)} "
                f"({took[-1]:.1f} s)",
                flush=True,
            )
    print(f"{total} tasks, seed {given.seed}: {len(lost)} without a linkage", *lost)
    print(f"time of a task: median {np.median(took):.2f} s, {sum(took):.0f} s in all")
    return int(bool(lost))


if __name__ == "__main__":
    sys.exit(main())
