"""Does the verdict on a motion depend on where the origin of M is?

    nice python -m benchmarks.two_origins --count 200 --seed 0

Each task is a motion of known kind, in mm: turns about a point (two of five tasks), translations
along lines and arcs, two-slider motions, and four-bars whose coupler turns by 30 to 150 degrees.
6 to 14 poses in order, with errors of 0 to 0.3 mm (standard deviation) and 0.005 degrees, printed
to 0.01 mm and 0.01 degrees.  Every second task states these errors (`--pose-sigma`).  The origin
of M is at the special point of the motion (the pin, the centre of the circle of points on lines),
and 240 mm away in some direction: either the motion is put there and then gets errors of the same
size, or the poses with their errors are put there.

The first table tells how often both verdicts are the same (code of the motion; of turns also the
centre, within the uncertainties said) and how often they are right.  The second tells how many
percent of general motions are taken for a turn: four-bars printed in 30 to 1000 steps of the last
digit, and practical tasks.  With --synthesize N general tasks are also solved from both origins,
and their outcomes compared.
"""

from __future__ import annotations

import argparse
import math
from collections import Counter, defaultdict

import numpy as np
from tests.oracles.two_slider_motions import general

from benchmarks.practical_tasks import practical_tasks
from burmester import synthesize
from burmester.geometry.displacement import Displacement
from burmester.io.reading.pose_table import resolution_by_digits
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import Rotation
from burmester.tasks.motion_task import Task

AWAY = 240.0  # mm
NOISES = (0.0, 0.01, 0.03, 0.1, 0.3)  # mm, standard deviation of x and y
ANGLE_NOISE = np.radians(0.005)
DECIMALS = 2
KINDS = ("turn", "turn", "translation", "two sliders", "four-bar")
CODES = {
    "turn": ("R315",),
    "translation": ("R312", "R313"),
    "two sliders": ("R316",),
    "four-bar": ("R321",),
}


def motion(rng, kind, count):
    """Rows x, y, angle in radians, with the origin of M at the motion's special point."""
    angle = np.linspace(0, np.radians(rng.uniform(50, 150)), count) + rng.uniform(-3, 3)
    if kind == "turn":
        z = np.full(count, complex(*rng.uniform(-300, 300, 2)))
    elif kind == "translation":
        radius = rng.choice([100.0, np.inf])
        t = np.linspace(0, 1, count)
        z = 150 * t if np.isinf(radius) else radius * np.exp(1.5j * t)
        z, angle = z * np.exp(1j * rng.uniform(-3, 3)), np.full(count, angle[0])
    elif kind == "two sliders":
        z = 80 * np.exp(1j * (rng.uniform(-3, 3) - angle))
    else:
        rows = general(rng, count, np.radians(rng.uniform(30, 150)))
        return rows * [40, 40, 1]
    return np.column_stack([z.real, z.imag, angle])


def put(rows, away):
    """The same motion with the origin of M at its point `away`, a complex number."""
    z = away * np.exp(1j * rows[:, 2])
    return rows + np.column_stack([z.real, z.imag, np.zeros(len(z))])


def with_errors(rng, rows, noise):
    errors = rng.normal(size=rows.shape) * [noise, noise, ANGLE_NOISE if noise else 0.0]
    return rows + errors


def printed_task(rows, noise, states):
    """The task as it is read from a file, or with its errors stated."""
    degrees = np.degrees(rows[:, 2]).round(DECIMALS)
    half = 0.5 * 10.0**-DECIMALS
    extent = np.hypot(*np.ptp(rows[:, :2], axis=0))
    known = resolution_by_digits(half, extent), np.radians(half)
    if states:
        known = math.sqrt(3) * noise + half, math.sqrt(3) * (noise > 0) * ANGLE_NOISE + known[1]
    poses = Displacement(rows[:, :2].round(DECIMALS), np.radians(degrees))
    return Task(poses, length_unit="mm", resolution=known)


def pair_of_tasks(seed, number):
    """A kind, its noise, whether it is stated, and the task from both origins."""
    rng = np.random.default_rng([seed, number])
    kind, states = KINDS[number % 5], bool(number // 5 % 2)
    noise = NOISES[number // 10 % len(NOISES)]
    rows = motion(rng, kind, int(rng.integers(6, 15)))
    away = AWAY * np.exp(1j * rng.uniform(-3, 3))
    near = with_errors(rng, rows, noise)
    far = put(near, away) if rng.integers(2) else with_errors(rng, put(rows, away), noise)
    return kind, noise, states, *(printed_task(each, noise, states) for each in (near, far))


def same(one, other):
    """Whether two kinds are the same, turns about the same centre of F."""
    if one.code != other.code:
        return False
    if not isinstance(one, Rotation):
        return True
    miss = np.linalg.norm(one.fixed_centre - other.fixed_centre)
    return bool(miss <= one.uncertainty + other.uncertainty)


def taken_for_turns(seed, count):
    """The shares of four-bars in few digits, and of practical tasks, that are called a turn."""
    rng = np.random.default_rng([seed, 1])
    shares = {}
    for steps in (30, 100, 300, 1000):
        hits = 0
        for _ in range(count):
            rows = general(rng, int(rng.integers(6, 13)), np.radians(rng.uniform(30, 180)))
            size = np.hypot(*np.ptp(rows[:, :2], axis=0))
            rows[:, :2] = (rows[:, :2] / size * steps).round()
            rows[:, 2] = np.radians(np.degrees(rows[:, 2]).round())
            kind = classify_motion(Task(Displacement.from_poses(rows))).kind
            hits += isinstance(kind, Rotation)
        shares[f"four-bars in {steps} steps"] = hits / count
    tasks = practical_tasks(count, seed)
    hits = sum(isinstance(classify_motion(task).kind, Rotation) for _, task in tasks)
    shares["practical tasks"] = hits / count
    return shares


def main():
    """Run the campaign and print its tables."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--synthesize", type=int, default=0)
    given = parser.parse_args()
    table, solved, differ = defaultdict(Counter), 0, []
    for number in range(given.count):
        kind, noise, states, *tasks = pair_of_tasks(given.seed, number)
        near, far = (classify_motion(task).kind for task in tasks)
        row = table[kind, "errors stated" if states else "not stated"]
        row["tasks"] += 1
        row["same"] += same(near, far)
        row["right near"] += near.code in CODES[kind]
        row["right far"] += far.code in CODES[kind]
        if not same(near, far):
            print(f"task {number}: {kind}, {noise} mm, {states=}: {near.code} and {far.code}")
        if near.code == far.code == "R321" and solved < given.synthesize:
            solved += 1
            codes = tuple(synthesize(task).outcome.code for task in tasks)
            if codes[0] != codes[1]:
                differ.append((number, kind, noise, *codes))
    columns = ("tasks", "same", "right near", "right far")
    print("| motion | errors | " + " | ".join(columns) + " |")
    print("|---|---|" + "--:|" * len(columns))
    for (kind, stated), row in sorted(table.items()):
        print(f"| {kind} | {stated} | " + " | ".join(str(row[each]) for each in columns) + " |")
    if given.synthesize:
        print(f"{solved} general tasks solved from both origins; outcomes differ in: {differ}")
    for name, share in taken_for_turns(given.seed, given.count).items():
        print(f"{name}: {100 * share:.2g} % called a turn")


if __name__ == "__main__":
    main()
