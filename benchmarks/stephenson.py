"""Stephenson's six-bars beside Watt's, and their circuits against brute force.

    python -m benchmarks.stephenson circuits --count 300
    python -m benchmarks.stephenson tasks --count 20 --chains 2000
    python -m benchmarks.stephenson cures --count 60 --chains 2500

circuits: random linkages of the third class; dead points of F against a scan of its angle on every
circuit, and at random angles of F the branches against all real assemblies.
tasks: five random poses each; for how many Watt I alone has a sound six-bar, and for how many all.
cures: of the same tasks, how many have a four-bar of two cranks that locks between the poses and
that a dyad drives past it, as the exact verdict says of the best four.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from tests.oracles.stephenson import drawn, held_at_f
from tests.sixbar.tasks import wandering
from tests.stephenson.made import linkage

from burmester.mechanisms.branches import branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.mechanisms.contract import drive_of
from burmester.sixbar.chain_search import search
from burmester.sixbar.judged import judged_six_bar
from burmester.sixbar.search_space import SearchSpace
from burmester.sixbar.six_bars import CHOICES, SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem

STEPS = 20_000  # of a scan, on a piece of a circuit


def circuits(count: int, seed: int) -> None:
    """Print how often what is computed is what brute force finds."""
    random = np.random.default_rng(seed)
    found = seen = open_ = uncertain = cells = wrong = wide = every = 0
    for _ in range(count):
        own = drawn(random)
        made = linkage(own)
        whole = circuits_of(made)
        open_ += int((~whole.closed).sum())
        found += len(made.still("F"))
        branches = branches_of(made, whole, "F")
        every += len(branches)
        uncertain += sum(not each.certain for each in branches)
        wide += sum(not each.turns and np.ptp(each.drives) > 2 * np.pi for each in branches)
        for number, length in enumerate(whole.length.tolist()):
            shares = np.arange(length * STEPS) / STEPS
            there = whole.joints(made, number, shares)
            drives = np.unwrap(drive_of(made.skeleton, there, "F"))
            steps = np.append(np.diff(drives), drives[0] - drives[-1])
            steps[-1] = np.angle(np.exp(1j * steps[-1]))
            seen += int((np.sign(steps) != np.sign(np.roll(steps, 1))).sum())
        for drive in random.uniform(-np.pi, np.pi, 3):
            mine = 0
            for each in branches:
                low, high = each.drives.min(), each.drives.max()
                first = np.ceil((low - drive) / (2 * np.pi))
                mine += len(np.arange(first, (high - drive) / (2 * np.pi)))
            cells += 1
            wrong += mine != len(held_at_f(own, drive))
    print(f"{count} linkages, seed {seed}: {every} branches of F, {wide} wider than a turn")
    print(f"dead points of F: {found} computed, {seen} by a scan")
    print(f"circuits left open: {open_}; branches without certificate: {uncertain}")
    print(f"angles of F with another number of assemblies than branches: {wrong} of {cells}")


def tasks(count: int, chains: int) -> None:
    """Print for how many tasks a sound six-bar is found, and the best transmission angles."""
    sound = dict.fromkeys(CHOICES, 0)
    seconds = dict.fromkeys(CHOICES, 0.0)
    works = dict.fromkeys(CHOICES, 0)
    for seed in range(count):
        angles = []
        for kind in CHOICES:
            begun = time.process_time()
            options = SixBarOptions(chains, kind=kind, most=4)
            answer = synthesize_six_bars(wandering(seed), options).six_bars
            seconds[kind] += time.process_time() - begun
            assert answer is not None
            best = next(iter(answer.found), None)
            works[kind] += best is not None
            sound[kind] += best is not None and not best.shortcomings
            angles.append("-" if best is None else f"{np.degrees(best.transmission):.0f}")
        print(f"{seed:3}  {'  '.join(angles)}", flush=True)
    for kind in CHOICES:
        print(
            f"{kind}: works in {works[kind]} of {count} tasks, sound in {sound[kind]}; "
            f"{1e3 * seconds[kind] / count / chains:.2f} ms a chain"
        )


def cures(count: int, chains: int) -> None:
    """Print for how many tasks a dyad drives a four-bar that goes through the poses."""
    has = driven = sound = refused = seen = 0
    for seed in range(count):
        problem = SynthesisProblem.of(wandering(seed), None, SynthesisOptions())
        space = SearchSpace.of(problem)
        found = search(space, ["Stephenson III six-bar"], chains, 0, 4)[1]
        best = found.best.linkages
        judged = [judged_six_bar(best[k], problem) for k in range(len(found.best.chain))]
        has += found.designs > 0
        driven += any(each.usable for each in judged)
        sound += any(each.usable and not each.shortcomings for each in judged)
        refused += sum(not each.usable for each in judged)
        seen += len(judged)
    print(f"{count} tasks: {has} have a four-bar on one circuit and in order; a dyad drives")
    print(f"one in {driven}, a sound one in {sound}; of {seen} judged {refused} were refused")


def main() -> None:
    """Read the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["circuits", "tasks", "cures"])
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--chains", type=int, default=2000)
    given = parser.parse_args()
    if given.what == "circuits":
        circuits(given.count, given.seed)
    else:
        {"tasks": tasks, "cures": cures}[given.what](given.count, given.chains)


if __name__ == "__main__":
    main()
