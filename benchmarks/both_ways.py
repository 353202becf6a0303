"""Shapes to trace: does the coupler stay on the path between the points, too?

    python -m benchmarks.both_ways [--count 1] [--seed 0] [--shape vee bow-tie ...] [--planted 0]

Each shape is drawn by corners of our own, turned at random, with points at equal steps.  Every
usable linkage is driven by the witness (`tests/oracles/both_ways`) from point to point.  Printed
are, of the linkage that comes first and of the nearest one, the greatest distance of the points
from the curve and of the curve from the path, in per cent of the diameter; and of all usable ones
the greatest stray.  A stray of more than a tenth of the diameter is one too many.

With --planted so many curves of random cranks are looked for of each kind: closed, open, and timed
by the crank.  Their points lie at equal steps of arc length, so that sharp tips lie between some of
them; a usable linkage is to pass them all.
"""

import argparse
import time

import numpy as np
from tests.oracles.both_ways import from_path, travelled
from tests.oracles.coupler_curves import dyads_of, random_crank, traced

from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.traced_path import TracedPath

MOST = 0.1  # diameters that a usable linkage may stray
EXACT = 1e-5  # spans; a planted curve that misses its points by less is found
TRIFOIL = [(1 + 0.55 * np.cos(3 * t)) * np.exp(1j * t) for t in np.linspace(0, 2 * np.pi, 49)[:-1]]
STAR = [(1.0 if k % 2 == 0 else 0.45) * 1j * np.exp(1j * np.pi * k / 5) for k in range(10)]
ARC = np.exp(1j * np.linspace(0.25 * np.pi, 1.75 * np.pi, 25))
BOW = np.exp(1j * np.linspace(-0.5 * np.pi, 0.5 * np.pi, 15))
S = np.linspace(0.15 * np.pi, 1.5 * np.pi, 15)
# Corners, whether it is closed, and the number of points.
SHAPES = {
    "vee": ([-1 + 1j, -1j, 1 + 1j], False, 17),
    "zed": ([-1 + 1j, 1 + 1j, -1 - 1j, 1 - 1j], False, 25),
    "double-u": ([-2 + 1j, -1 - 1j, 0.6j, 1 - 1j, 2 + 1j], False, 29),
    "en": ([-1 - 1j, -1 + 1j, 1 - 1j, 1 + 1j], False, 25),
    "lambda": ([-1 - 1j, 1j, 1 - 1j], False, 17),
    "el": ([-0.6 + 1j, -0.6 - 1j, 0.6 - 1j], False, 17),
    "ess": ([*(0.5j + 0.5 * np.exp(1j * S)), *(-0.5j - 0.5 * np.exp(1j * S[::-1]))], False, 27),
    "see": (ARC, False, 25),
    "jay": ([0.5 + 1j, 0.5 - 0.5j, *(-0.5j - 0.5j * np.exp(1j * np.linspace(1.4, -1.5, 13)))],
            False, 23),
    "star": (STAR, True, 40),
    "hourglass": ([-1 + 1.2j, 1 + 1.2j, -1 - 1.2j, 1 - 1.2j], True, 36),
    "bow-tie": ([-1 - 0.6j, 1 + 0.6j, 1 - 0.6j, -1 + 0.6j], True, 32),
    "trifoil": (TRIFOIL, True, 42),
    "letter-d": ([-0.6 - 1j, *(0.0 + BOW), -0.6 + 1j], True, 36),
    "letter-o": (0.7 * np.exp(1j * np.linspace(0, 2 * np.pi, 33)[:-1]).real
                 + 1j * np.exp(1j * np.linspace(0, 2 * np.pi, 33)[:-1]).imag, True, 30),
    "letter-v-closed": ([-1 + 1j, -0.15 - 1j, 0.15 - 1j, 1 + 1j, 0.7 + 1j, -0.6j, -0.7 + 1j],
                        True, 40),
    "kite": ([1.2j, 0.7 + 0.3j, -1.2j, -0.7 + 0.3j], True, 32),
    "eight": ([np.sin(t) + 0.5j * np.sin(2 * t) for t in np.linspace(0, 2 * np.pi, 41)[:-1]],
              True, 36),
}  # fmt: skip


def planted(kind, rng):
    """Points (N, 2) on the curve of a random crank, and crank angles (N,) where it is timed."""
    z, side = random_crank(rng)
    if kind == "timed":
        t = rng.uniform(0, 2 * np.pi) + np.linspace(0, rng.uniform(2, 5.5), 18)
    else:
        fine = np.linspace(0, 2 * np.pi, 2001)
        if kind == "open":
            fine = rng.uniform(0, 2 * np.pi) + np.linspace(0, rng.uniform(1.5, 4), 2001)
        steps = np.abs(np.diff(traced(dyads_of(z), side, fine)))
        at = np.concatenate([[0], steps.cumsum()])
        number = 15 if kind == "open" else 40
        t = np.interp(np.linspace(0, at[-1], number, endpoint=kind == "open"), at, fine)
    p = traced(dyads_of(z), side, t)
    return np.column_stack([p.real, p.imag]), t - t[0] if kind == "timed" else None


def find_planted(number, seed):
    """Print how many planted curves of each kind are found."""
    for kind in ("closed", "open", "timed"):
        missed = []
        for k in range(number):
            points, turns = planted(kind, np.random.default_rng([seed, k]))
            path = TracedPath(kind == "closed", turns)
            found = synthesize(Task(Displacement(points, np.zeros(len(points))), path=path)).usable
            size = float(np.linalg.norm(np.ptp(points, axis=0)))
            missed.append(min((each.error.worst / size for each in found), default=np.inf))
        exact = int((np.array(missed) < EXACT).sum())
        print(f"planted, {kind}: {exact} of {number} exact; the worst missed by {max(missed):.1e}")


def drawn(shape, rng):
    """Points (N, 2) of a shape at equal steps, turned at random, and whether it is closed."""
    corners, closed, number = SHAPES[shape]
    line = np.append(corners, corners[:1]) if closed else np.asarray(corners)
    at = np.concatenate([[0], np.abs(np.diff(line)).cumsum()])
    z = np.interp(np.linspace(0, at[-1], number, endpoint=not closed), at, line)
    z = z * np.exp(1j * rng.uniform(0, 2 * np.pi))
    return np.column_stack([z.real, z.imag]), closed


def strays(found, points, closed):
    """The greatest distances of the curves of linkages from the path, driven by the witness."""
    z = points @ [1, 1j]
    out = []
    for each in found:
        one = each.driver_first
        curve = np.concatenate(travelled(one.first, one.second, each.error.places, closed))
        out.append(float(np.nanmax(from_path(curve, z, closed))))
    return np.array(out)


def main():
    """Print a line for each shape, and how many linkages stray."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--shape", nargs="*", default=list(SHAPES))
    parser.add_argument("--planted", type=int, default=0)
    given = parser.parse_args()
    if given.planted:
        find_planted(given.planted, given.seed)
        return
    print("shape               s  usable  first: points curve angle  nearest: points curve angle"
          "  most astray")  # fmt: skip
    usable = none = astray = 0
    for shape in given.shape:
        for number in range(given.count):
            rng = np.random.default_rng([given.seed, number])
            points, closed = drawn(shape, rng)
            diameter = float(np.abs((z := points @ [1, 1j])[:, None] - z).max())
            task = Task(Displacement(points, np.zeros(len(points))), path=TracedPath(closed))
            began = time.process_time()
            answer = synthesize(task)
            seconds = time.process_time() - began
            found = answer.usable or answer.linkages[:4]
            if not found:  # a crank alone traces an arc
                print(f"{shape:16} {seconds:5.1f} no linkage: {answer.outcome.code}", flush=True)
                continue
            far = strays(found, points, closed) / diameter
            nearest = min(range(len(found)), key=lambda k: found[k].error.worst)
            parts = []
            for k in (0, nearest):
                missed = found[k].error.worst / diameter
                least = np.degrees(found[k].driven.least_over_range)
                parts.append(f"{100 * missed:6.2f} {100 * far[k]:6.2f} {least:5.1f}")
            usable, none = usable + len(answer.usable), none + (not answer.usable)
            astray += int((far[: len(answer.usable)] > MOST).sum())
            print(
                f"{shape:16} {seconds:5.1f} {len(answer.usable):6}  {parts[0]:>27} {parts[1]:>30}"
                f" {100 * far.max():10.1f}  {answer.outcome.code}",
                flush=True,
            )
    print(f"{usable} usable linkages, of which {astray} stray; {none} shapes without one")


if __name__ == "__main__":
    main()
