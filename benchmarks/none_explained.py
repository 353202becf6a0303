"""Where no linkage works: is the limit that is told to blame, and how little would do?

    python -m benchmarks.none_explained --count 60 --seed 0

Tasks of `tests/oracles/tight_boxes.py`: a box of fixed pivots was cut down.  Of those that end in
"none" every option that the answer names is carried out, and has to give a sound linkage.  What is
told of the box that was cut down is held against brute force, which shares no code with the
package: it looks in the box as it stands (where the program says none there must be none), in the
box grown by half of what is told (so that what is told is at most twice the least), and, where
nothing is told of that box, in a box grown by the span.

Exit code 1 if an option that is told does not work, or if brute force contradicts in more than one
task of 20.
"""

import argparse
import json
import shlex
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
from tests.oracles.few_poses import span_of
from tests.oracles.tight_boxes import grown, has_linkage, outside, tight_task

from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements

KNOWN = Path(__file__).with_name("few_poses.json")
LEAST = 30.0  # degrees of transmission that are asked for


def task_of(rows, boxes):
    """The task as the package takes it."""
    limits = tuple(Limits(box(*fixed), box(*moving), kinds={"RR"}) for fixed, moving in boxes)
    asked = Requirements(transmission_deg=LEAST)
    poses = Displacement.from_poses(rows)
    return Task(poses, limits=limits, requirements=asked, length_unit="mm")


def compared(rows, boxes, number, seed):
    """What became of one task, by name; and the answer."""
    answer = synthesize(task_of(rows, boxes))
    if answer.usable:
        return ["answered"], answer
    told = ["none"]
    if has_linkage(rows, boxes, seed):
        told.append("none, and brute force has one")
    for cause in answer.causes if len(answer.causes) > 1 or _alone(answer) else ():
        again = synthesize(cause.task)
        works = any(not each.shortcomings for each in again.usable)
        told.append("option works" if works else f"option fails: {shlex.quote(cause.option)}")
    of_box = [c for c in answer.causes if _alone(answer) and _is_of(c, number)]
    if of_box:
        both = of_box[0].found.linkage.first, of_box[0].found.linkage.second
        dyads = both if len(boxes) == 1 else both[number : number + 1]
        pivots = np.array([dyad.fixed_pivot for dyad in dyads if isinstance(dyad, RR)])
        by = outside(boxes, number, pivots)
        half = has_linkage(rows, grown(boxes, number, by / 2), seed, LEAST)
        told.append("brute force has one with half of it" if half else "least within twice")
    else:
        any_ = has_linkage(rows, grown(boxes, number, span_of(rows)), seed, LEAST)
        told.append("box not told, and brute force has one" if any_ else "box not told, rightly")
    return told, answer


def _alone(answer):
    return "no one limit" not in (answer.outcome.why or "")


def _is_of(cause, number):
    return (cause.limit.kind, cause.limit.number) == ("fixed pivot", number)


def seeds_with_linkage():
    """Seeds of tasks with a known linkage, and its pivots."""
    for seed, each in json.loads(KNOWN.read_text()).items():
        if each is not None and each["angle"] >= LEAST:
            yield int(seed), np.array(each["pivots"]) @ [1, 1j]


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0, help="the first of them")
    given = parser.parse_args()
    counts, took = Counter(), []
    for seed, known in list(seeds_with_linkage())[given.seed : given.seed + given.count]:
        rows, boxes, number = tight_task(seed, known)
        begun = time.process_time()
        told, answer = compared(rows, boxes, number, seed)
        took.append(time.process_time() - begun)
        counts.update(each.split(":")[0] for each in told)
        print(seed, "; ".join(told), "|", answer.outcome.why, flush=True)
    for name, number in sorted(counts.items()):
        print(f"{name}: {number}")
    print(f"time of a task, both sides: median {np.median(took):.1f} s, worst {max(took):.1f} s")
    wrong = sum(number for name, number in counts.items() if "brute force has one" in name)
    return int(counts["option fails"] > 0 or 20 * wrong > counts["none"])


if __name__ == "__main__":
    sys.exit(main())
