"""Does advice keep its promise?  Every option that an answer names is typed, and looked at.

    python -m benchmarks.advice --count 150 --seed 0

Random tasks of all sorts: those of practice (`practical_tasks`), of common shapes with boxes
(`tests/oracles/common_tasks`), of two to four poses (`tests/oracles/few_pose_tasks`), and with a
planted linkage (`planted_limits`), five poses too, and drawn paths (`sound_paths`); most of them
ask for more than they can have.
Of each answer every piece of help that names options, in the outcome and in warnings, is taken at
its word: the task is solved again with these options.  A usable linkage has to come of it, and
where the piece says how far a linkage misses ("L3 would do (it misses by 2 mm and 3°)"), one that
misses by no more.  What only offers a choice ("change it with --fixed-pivot") promises nothing.

Exit code 1 if a promise is not kept.
"""

import argparse
import math
import re
import sys
from collections import Counter, defaultdict
from dataclasses import replace

import numpy as np
from tests.oracles.common_tasks import common_task
from tests.oracles.few_pose_tasks import few_pose_task

from benchmarks.planted_limits import planted
from benchmarks.practical_tasks import FAMILIES
from benchmarks.search_witness import task_of
from benchmarks.sound_paths import shape
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.io.reading.specification_text import limits_from_options
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import TracedPath

LIMIT_NAMES = ("fixed_pivot", "moving_pivot", "length", "kinds")
OPTION = re.compile(r'(--[a-z-]+)(?: ("[^"]+"|[^-\s;()"][^\s;()]*))?')
PIECE = re.compile(r"; or |; |, or (?=with |take |ask |say )")
TIMES = re.compile(r"all tolerances ([\d.]+) times as wide")
ERRORS = re.compile(r"misses by ([\d.e+-]+)(?: mm)?(?: and ([\d.e+-]+)°)?\)?")
TYPES = "crank-rocker", "double-crank", "double-rocker", "triple-rocker", "grashof"
SHOWN = 1.06  # times an error as it is shown with two digits
# What offers a choice, and promises nothing.
CHOICES = (
    "take fewer with",
    "change it with",
    "compare with",
    "say otherwise",
    "give more time",
    "look for six bars",
)


def _asked(rng, size):
    """Requirements, more of them than most tasks can have."""
    asked = {}
    if rng.random() < 0.5:
        asked["transmission_deg"] = float(np.round(rng.uniform(20, 75)))
    if rng.random() < 0.5:
        asked["within"] = float(np.round(size * 10 ** rng.uniform(-4, -1), 4)) or 0.001
        if rng.random() < 0.3:
            asked["within_deg"] = float(np.round(10 ** rng.uniform(-1, 1), 2))
    if rng.random() < 0.25:
        asked["link_ratio"] = float(np.round(rng.uniform(1.5, 6), 1))
    if rng.random() < 0.2:
        asked["types"] = {str(rng.choice(TYPES))}
    elif rng.random() < 0.2:
        asked["driver"] = "crank"
    return Requirements(**asked)


def _plain(rng):
    name = str(rng.choice(list(FAMILIES)))
    rows = np.round(FAMILIES[name](rng, np.linspace(0, 1, int(rng.integers(5, 10)))), 2)
    task = Task.from_rows(rows, angle_unit="deg", length_unit="mm")
    return replace(task, resolution=(0.005, float(np.radians(0.005))))


def _limited(rng):
    task = task_of(common_task(int(rng.integers(100_000))))
    return replace(task, length_unit="mm", requirements=Requirements())


def _few(rng):
    given = few_pose_task(int(rng.integers(100_000)))
    limits = tuple(Limits(fixed_pivot=box(*f), moving_pivot=box(*m)) for f, m in given.boxes)
    poses = Displacement.from_poses(given.rows)
    return Task(poses, length_unit="mm", limits=limits if rng.random() < 0.5 else ())


def _of_linkage(rng):
    while (one := planted(1, int(rng.integers(100_000)))) is None:
        pass
    return replace(one[0], requirements=Requirements())


def _with_tolerances(rng):
    task = _plain(rng)
    span = float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
    room = np.tile(
        [span * 10 ** rng.uniform(-4, -1.5)] * 2 + [10 ** rng.uniform(-3, -1)],
        (len(task.poses.angle), 1),
    )
    return replace(task, tolerances=PoseTolerances(room[:, :2], room[:, 2]))


def _drawn(rng):
    _, points, closed = shape(int(rng.integers(100_000)), int(rng.integers(17)))
    return Task(Displacement(points, np.zeros(len(points))), path=TracedPath(closed=closed))


SORTS = {
    "plain": _plain, "limits": _limited, "few poses": _few, "planted": _of_linkage,
    "tolerances": _with_tolerances, "paths": _drawn,
}  # fmt: skip


def advice_task(seed, number):
    """A sort of task, and one of it."""
    rng = np.random.default_rng([34, seed, number])
    name = list(SORTS)[number % len(SORTS)]
    task = SORTS[name](rng)
    size = float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
    if rng.random() < 0.75:
        asked = _asked(rng, size)
        if task.tolerances is not None:
            asked = replace(asked, within=None, within_deg=None)
        task = replace(task, requirements=asked)
    return name, task


def pieces(text):
    """The parts of a help that stand for one thing to do each."""
    return [
        each.strip() for each in re.split(r"; or |; |, or (?=with |take |ask |say )", text) if each
    ]


FIELDS = {
    "--within": "within", "--within-angle": "within_deg", "--min-transmission": "transmission_deg",
    "--link-ratio": "link_ratio", "--type": "types", "--driver": "driver",
    "--any-order": "any_order",
}  # fmt: skip
LIMITS = {f"--{name.replace('_', '-')}": name for name in LIMIT_NAMES}


def solved_with(task, piece):
    """The answer to the task with the options of a piece of help; None where it names none.

    A text names an option that is none of the known ones.
    """
    if (times := TIMES.search(piece)) is not None:
        stated, ratio = task.tolerances, float(times[1])
        wide = PoseTolerances(stated.position * ratio, stated.angle * ratio, stated.axes)
        return synthesize(replace(task, tolerances=wide))
    found, limits = OPTION.findall(piece), defaultdict(list)
    if not found or any(word in piece for word in CHOICES):
        return None
    for name, text in found:
        value = text.strip('",')
        if name in FIELDS:
            typed = float(value) if re.fullmatch(r"[\d.e+-]+", value) else value or True
            typed = set(value.split(",")) if name == "--type" else typed
            asked = replace(task.requirements, **{FIELDS[name]: typed})
            task = replace(task, requirements=asked)
        elif name == "--drop":
            task = task.at(np.delete(np.arange(len(task.poses.angle)), int(value) - 1), None)
        elif name == "--every":
            task = task.at(np.arange(0, len(task.poses.angle), int(value)), None)
        elif name == "--pose-tolerance":
            x, y, angle = (math.inf if each == "free" else float(each) for each in text.split(","))
            count = len(task.poses.angle)
            wide = PoseTolerances.uniform(count, x, y, math.radians(angle))
            task = replace(task, tolerances=wide)
        elif value == ":MAX":  # which the reader chooses
            return None
        elif name in LIMITS:
            limits[LIMITS[name]].append(value)
        else:
            return name
    return synthesize(with_limits(task, limits))


def with_limits(task, texts):
    """The task with the limits in the texts of options in the place of its own."""
    stated, free = limits_from_options(**texts), Limits()
    for name in texts:
        values = [getattr(free, name) if v is None else v for v in getattr(stated, name)]
        own = task.limits or (free,)
        own = own * 2 if len(values) > len(own) else own
        values = values * (len(own) // len(values))
        limits = (replace(each, **{name: v}) for each, v in zip(own, values, strict=True))
        task = replace(task, limits=tuple(limits))
    return task


def kept(result, piece):
    """Whether an answer is what a piece of help promises, and why not."""
    if not result.usable:
        return "no usable linkage", result.outcome.code
    if (told := ERRORS.search(piece)) is None:
        return "kept", ""
    far, turned = SHOWN * float(told[1]), SHOWN * float(told[2] or np.inf)
    near = [
        each
        for each in result.usable
        if each.error.worst <= far and np.degrees(each.error.angle.max()) <= turned
    ]
    if near or "would do" not in piece:
        return "kept", ""
    best = min(result.usable, key=lambda each: each.combined_error)
    return "misses by more", f"{best.error.worst:.3g} {np.degrees(best.error.angle.max()):.3g}"


def promises(task):
    """What the answer to a task promises: code, piece of help, what came of it, why."""
    result = synthesize(task)
    helps = [(result.outcome.code, result.outcome.help)]
    helps += [(each.code, each.help) for each in result.warnings]
    for code, text in helps:
        for piece in pieces(text or ""):
            answer = solved_with(task, piece)
            if answer is None:
                continue
            if isinstance(answer, str):
                yield code, piece, f"cannot be typed: {answer}", ""
            else:
                yield code, piece, *kept(answer, piece)


def main():
    """Run the campaign, and name the promises that were not kept."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--number", type=int, help="this task alone")
    given = parser.parse_args()
    numbers = range(given.count) if given.number is None else [given.number]
    counts, bad = Counter(), 0
    for number in numbers:
        name, task = advice_task(given.seed, number)
        for code, piece, what, why in promises(task):
            names = " ".join(sorted({each for each, _ in OPTION.findall(piece)})) or "times as wide"
            counts[code, names, what] += 1
            if what != "kept":
                bad += 1
                print(f"{number:4d} {name}: {code} {piece!r}: {what} {why}", flush=True)
            elif given.number is not None:
                print(f"{number:4d} {name}: {code} {piece!r}: kept")
    for key, count in sorted(counts.items()):
        print(*key, count, sep="  ")
    print(
        f"{len(numbers)} tasks, seed {given.seed}: {sum(counts.values())} promises, {bad} not kept"
    )
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
