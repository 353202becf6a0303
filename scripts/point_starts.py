"""Make src/burmester/points/start_systems.npz: all linkages of generic Alt-Burmester problems.

Monodromy: one solution is easy, for the positions can be chosen to fit it.  Carried around loops in
the space of complex positions it turns into others; when three loops bring no new one, they are
taken to be all.  Two problems of each case, from seeds of their own, have to agree on the count.

    .venv/bin/python scripts/point_starts.py [--case 3-4 1-8] [--seed 0]
"""

import argparse
from itertools import pairwise
from time import perf_counter

import numpy as np

from burmester.points.alt_burmester import Positions, distinct
from burmester.points.path_tracking import polished, tracked
from burmester.points.start_systems import CASES

QUIET = 3  # loops without a new solution
SAME_RESIDUAL = 1e-10  # relative; Newton's last step on a solution


def draw(rng, *size):
    """Complex normal numbers."""
    return rng.normal(size=size) + 1j * rng.normal(size=size)


def generic(case, rng):
    """Positions of a case, complex."""
    near_circle = np.exp(2j * np.pi * rng.random(case.poses - 1))
    T = near_circle * np.exp(0.3 * rng.normal(size=case.poses - 1))
    P, Pb = draw(rng, 2, case.positions)
    G, Gb = draw(rng, 2, case.pivots)
    return Positions(P[None], Pb[None], T[None], G[None], Gb[None])


def solved(case, rng):
    """One linkage, and positions that it meets: each from the quadratic that is left of P."""
    x, p = draw(rng, 8), generic(case, rng)
    u, ub, z, zb = x.reshape(2, 4).T
    turns = np.exp(2j * np.pi * rng.random(case.positions)) * np.exp(
        0.3 * rng.normal(size=case.positions)
    )
    turns[: case.poses - 1] = p.T[0]
    P, Pb = np.empty((2, 1, case.positions), dtype=complex)
    for j, turn in enumerate(turns):
        g, c = turn - 1, 1 / turn - 1
        a, b = c * zb - ub, g * z - u  # P Pb + a P + b Pb + e = 0
        e = g * z * (c * zb - ub) - c * zb * u
        slope, shift = -(a[0] - a[1]) / (b[0] - b[1]), -(e[0] - e[1]) / (b[0] - b[1])
        # Pb = slope P + shift
        root = np.roots([slope, shift + a[0] + b[0] * slope, b[0] * shift + e[0]])
        P[0, j] = root[0]
        Pb[0, j] = slope * root[0] + shift
    k = case.pivots
    return x[None], turns[None], p._replace(P=P, Pb=Pb, G=(u + z)[None, :k], Gb=(ub + zb)[None, :k])


def all_solutions(case, seed):
    """Generic positions, and one linkage (k, 8) of each class."""
    rng = np.random.default_rng(seed)
    x, turns, p = solved(case, rng)
    quiet = 0
    while quiet < QUIET:
        ends, end_turns = x, turns
        for a, b in pairwise([p, generic(case, rng), generic(case, rng), p]):
            path = tracked(ends, end_turns, a, b)
            ends, end_turns, miss = polished(path.x, path.turns, b)
            sound = path.arrived & (miss < SAME_RESIDUAL)
            ends, end_turns = ends[sound], end_turns[sound]
        before = len(x)
        every, every_turns = np.concatenate([x, ends]), np.concatenate([turns, end_turns])
        index = distinct(every, p)
        x, turns = every[index], every_turns[index]
        quiet = quiet + 1 if len(x) == before else 0
    return p, x


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--case", nargs="*", help="names of cases; without, all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", default="src/burmester/points/start_systems.npz")
    asked = parser.parse_args()
    table = {}
    for case in CASES:
        if asked.case and case.name not in asked.case:
            continue
        counts = []
        for number in range(2):
            began = perf_counter()
            p, x = all_solutions(
                case, [asked.seed, number, case.poses, case.positions, case.pivots]
            )
            counts.append(len(x))
            if len(x) != CASES[case]:
                print(f"{case.name}: {CASES[case]} were found before")
            print(f"{case.name:8} {len(x):5} {perf_counter() - began:6.1f} s", flush=True)
            if number >= case.systems:
                continue
            for part, value in zip(Positions._fields, p, strict=True):
                table[f"{case.name}/{number}/{part}"] = value[0]
            table[f"{case.name}/{number}/x"] = x.astype(np.complex64)
        if counts[0] != counts[1]:
            raise SystemExit(f"{case.name}: the two problems do not agree")
    np.savez_compressed(asked.out, **table)
