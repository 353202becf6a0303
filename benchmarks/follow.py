"""Drags of a pose, a weight or a corner of a limit: does the follow stay on the answers, how fast?

    python -m benchmarks.follow --drags 60 --seed 0
    python -m benchmarks.follow --drags 20 --seed 0 --sort limits

Each drag moves one pose of a task (or a corner of its limits, or a weight) along a smooth path of
up to a tenth of the span of the poses in 200 steps, its angle by up to 6 degrees, and `follow`
goes along.  Then the whole road looks for all dyads of the last task (`search_dyads`).  A drag is
confirmed where every dyad followed is one of these within 1e-8 of the span; it is complete where
these are all there are.  An exception counts as told where the follow was uncertain of a dyad
during the drag.  Of the linkages at the end it is counted whether they work as they do at places
that are looked for anew, whether their defects are the same, too, and whether those that are
followed as minima are some.  A linkage keeps to its branch; where a place beyond a dead point has
come nearer, its verdict may be another one than when it is judged from nothing: these are counted
for themselves.

Times are CPU times of one step, on one thread; the first step of a drag is counted like the others.
"""

import argparse
import math
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field, fields, replace
from pathlib import Path

import numpy as np

from burmester import follow
from burmester.following.linkage_strands import Way
from burmester.fourbar.dyad import PR, RP
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.linkages.judged_places import NearestPlaces
from burmester.synthesis.dyad_search import search_dyads
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task

STEPS = 200
LONGEST = 0.1  # spans; of the path of a drag
GREATEST_TURN = math.radians(6)  # of a dragged pose
SAME = 1e-8  # spans; dyads that differ by less are one
SORTS = ("five", "ten", "limits", "few")
LIMITED = ("lid-hinge", "tailgate", "prosthetic-knee", "landing-gear", "gripper")
FEW = ("monitor-arm", "tilting-window", "robot-intake")


@dataclass
class Record:
    """What came of the drags of one sort."""

    drags: int = 0
    confirmed: int = 0
    complete: int = 0
    untold: list = field(default_factory=list)
    doubtful: int = 0
    times: list = field(default_factory=list)
    changes: Counter = field(default_factory=Counter)
    linkages: int = 0
    same_use: int = 0
    same_defects: int = 0
    nearer_elsewhere: int = 0
    least: int = 0
    at_rest: int = 0


def smooth_motion(rng, count):
    """Poses (count,) along a random cubic, with a little noise."""
    t = np.linspace(-1, 1, count)[:, None]
    x = rng.normal(size=(4, 2)) * np.array([0, 3, 1, 0.5])[:, None]
    place = sum(t**k * x[k] for k in range(4)) + 0.01 * rng.normal(size=(count, 2))
    turn = rng.uniform(0.6, 1.6) * t[:, 0] + 0.2 * rng.normal() * t[:, 0] ** 2
    return Displacement(place, turn + 0.005 * rng.normal(size=count))


def task_of(sort, rng, number):
    """A task of one sort."""
    if sort == "five":
        return Task(smooth_motion(rng, 5))
    if sort == "ten":
        weights = rng.uniform(0.5, 3, 10) if number % 4 == 3 else None
        return Task(smooth_motion(rng, 10), weights=weights)
    names = LIMITED if sort == "limits" else FEW
    text = templates.text(names[number % len(names)])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "task.toml"
        path.write_text(text)
        task = read_task(str(path))
    return replace(task, surroundings=None)


def drag_of(task, rng, number):
    """A function from 0..1 to tasks on the way of a drag."""
    size = float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
    way = rng.normal(size=(2, 2))
    way *= rng.uniform(0.3, 1) * LONGEST * size / np.linalg.norm(way, axis=1).sum()
    turn = rng.uniform(-1, 1) * GREATEST_TURN
    pose = int(rng.integers(task.poses.shape[0]))
    boxed = [k for k, each in enumerate(task.limits) if each.fixed_pivot is not None]

    def path(u):
        return math.sin(math.pi * u / 2) * way[0] + math.sin(math.pi * u) * way[1] / 2

    def moved_pose(u):
        place, angle = task.poses.translation.copy(), task.poses.angle.copy()
        place[pose] += path(u)
        angle[pose] += u * turn
        return replace(task, poses=Displacement(place, angle))

    def moved_corner(u):
        at = boxed[0]
        region = task.limits[at].fixed_pivot
        if not hasattr(region, "vertices"):
            return moved_pose(u)
        low, high = region.vertices.min(axis=0), region.vertices.max(axis=0)
        step = np.clip(path(u), -0.3 * (high - low), None)
        limits = list(task.limits)
        limits[at] = replace(limits[at], fixed_pivot=box(low, high + step))
        return replace(task, limits=tuple(limits))

    def moved_weight(u):
        weights = task.weights.copy()
        weights[pose] *= math.exp(u * rng_weight)
        return replace(task, weights=weights)

    rng_weight = rng.uniform(-1, 1)
    if boxed and number % 2:
        return moved_corner
    if task.weights is not None and number % 3 == 0:
        return moved_weight
    return moved_pose


def numbers_of(dyad):
    """A dyad's dimensions; of a slider with the normal in the upper half plane."""
    parts = [np.atleast_1d(getattr(dyad, each.name)) for each in fields(dyad)]
    if isinstance(dyad, PR | RP):
        n = np.array([math.cos(dyad.normal_angle), math.sin(dyad.normal_angle)])
        sign = -1.0 if n[1] < -1e-9 or (abs(n[1]) <= 1e-9 and n[0] < 0) else 1.0
        pivot = dyad.moving_pivot if isinstance(dyad, PR) else dyad.fixed_pivot
        parts = [n * sign, [float(dyad.offset) * sign], pivot]
    return np.concatenate(parts)


def missing(some, others, size):
    """How many dyads of some are none of the others."""
    known = [(type(each.dyad), numbers_of(each.dyad)) for each in others]
    out = 0
    for each in some:
        own = numbers_of(each.dyad)
        scale = max(size, float(np.abs(own).max()) * 1e-2)
        near = [np.abs(own - other).max() for kind, other in known if kind is type(each.dyad)]
        out += not (near and min(near) < SAME * scale)
    return out


def verdict(found):
    """Whether a linkage works, and the kinds of its defects."""
    return found.usable, {defect.kind for defect in found.defects}


def verdicts(followed):
    """Of each linkage the verdicts, and squared errors, where a linkage that exists is judged.

    With the squared error at the places where it was followed to.
    """
    problem, strands = followed.problem, followed.linkage_strands
    target = target_of(problem)
    batch = strands.own.to_canonical(target.frames)
    known = {each.id: each for found in followed.linkages for each in found.dyads}
    out = []
    for k, (one, two) in enumerate(strands.pairs):
        _, rows, _ = NearestPlaces.of(batch[[k]], target).ways()
        index = np.full(len(rows), k)
        found = Evaluation(problem, target).members(
            Candidates(
                batch[index],
                rows,
                [(known[one], known[two])] * len(rows),
                strands.from_search[index],
                strands.own[index],
            )
        )
        own = target.cost(target.rows_at(followed.linkages[k].error.places))
        out.append(
            (
                [verdict(each) for each in found],
                np.nan_to_num(target.cost(rows), nan=np.inf).min(),
                own,
            )
        )
    return out


def dragged(sort, number, seed, record):
    """One drag, added to the record."""
    rng = np.random.default_rng([seed, SORTS.index(sort), number])
    task = task_of(sort, rng, number)
    here = synthesize(task)
    if not here.linkages or (not here.fits and here.family is None):
        return
    way, told = drag_of(task, rng, number), False
    for step in range(1, STEPS + 1):
        there = way(step / STEPS)
        start = time.process_time()
        here = follow(here, there)
        record.times.append(time.process_time() - start)
        told |= any(each[0] != "L" for each in here.uncertain)  # of dyads
        record.changes.update(
            f"{'dyad' if each.id[0] == 'D' else 'linkage'} {each.kind}" for each in here.changes
        )
        if here.uncertain:
            record.changes["uncertain steps"] += 1
    record.drags += 1
    record.doubtful += told
    size = float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
    if sort != "few":
        road = search_dyads(here.problem).dyads
        lost, more = missing(here.dyads, road, size), missing(road, here.dyads, size)
        record.confirmed += not lost
        record.complete += not more
        if (lost or more) and not told:
            record.untold.append((number, lost, more))
    for one, (again, least, own) in zip(here.linkages, verdicts(here), strict=True):
        record.linkages += 1
        same = one.usable in {works for works, _ in again}
        record.same_use += same
        record.same_defects += verdict(one) in again
        record.nearer_elsewhere += bool(not same and least < own * (1 - 1e-6))
    strands, target = here.linkage_strands, target_of(here.problem)
    least = np.flatnonzero(strands.way == Way.LEAST)
    if len(least) and not target.kept and target.exact is None:
        batch = strands.own[least].to_canonical(target.frames)
        rows = target.rows_at(strands.places[least])
        best = target.refine(batch, rows, steps=60)
        record.least += len(least)
        record.at_rest += int((target.cost(rows) <= target.cost(best.rows) * (1 + 1e-6)).sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--drags", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sort", choices=SORTS)
    given = parser.parse_args()
    for sort in [given.sort] if given.sort else SORTS:
        record = Record()
        for number in range(given.drags):
            dragged(sort, number, given.seed, record)
        ms = 1e3 * np.array(record.times or [math.nan])
        median, high, most = (*np.quantile(ms, [0.5, 0.95]), ms.max())
        print(
            f"{sort}: {record.drags} drags; median {median:.1f} ms, 95th percentile {high:.1f} ms, "
            f"most {most:.0f} ms; dyads confirmed {record.confirmed}, complete {record.complete}, "
            f"exceptions not told {record.untold}; uncertain in {record.doubtful} drags; of "
            f"{record.linkages} linkages {record.same_use} work or fail as judged anew (of the "
            f"others {record.nearer_elsewhere} have nearer places elsewhere), "
            f"{record.same_defects} for the same reasons; at rest {record.at_rest} of "
            f"{record.least} minima; {dict(record.changes)}",
            flush=True,
        )


if __name__ == "__main__":
    main()
