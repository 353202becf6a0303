"""Is every dyad of a small turn found, and is it told where one is not?

    python -m benchmarks.small_turns --count 2000 --seed 0

Planted four-bars (`tests/oracles/small_turns.py`): a crank that sweeps 0.01 to 0.5 radian, or a
near-parallelogram, 0.1 to 10 % off; 5 to 30 poses of 3 to 16 decimals.  Each of the two planted
dyads is listed, or as good ones are listed in its place, or it is lost; and where one is lost,
that is told (W207, or an outcome which says that the poses do not determine the dyads) or not.
Linkages are not made.  Exit code 1 if a loss is not told.
"""

import argparse
import sys
import time
from collections import Counter

import numpy as np
from tests.oracles.small_turns import moved_by_rounding, small_turn, verdicts

from burmester import Displacement, Task
from burmester.diagnosis.checks import diagnose
from burmester.fourbar.dyad import RR
from burmester.synthesis.dyad_search import search_dyads, with_method
from burmester.synthesis.outcome import dyad_advice
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem

CARRIED = 1e-4  # a dyad that one unit in the last place moves by less is one that doubles carry


def found_dyads_of(task):
    """The dyads (k, 6) of a task, c, m, r and rms, the codes that were said, and the seconds.

    A slider has nothing but its rms.
    """
    given = Task(Displacement.from_poses(task.rows), resolution=(task.resolution,) * 2)
    motion = diagnose(given).motion
    start = time.process_time()
    problem = SynthesisProblem.of(given, motion, SynthesisOptions())
    if problem.is_special:
        return np.empty((0, 6)), {motion.kind.code}, 0.0
    problem = with_method(problem)
    search = search_dyads(problem)
    codes = {advice.code for advice in dyad_advice(problem, search)}
    rows = []
    for each in search.dyads:
        dyad, at = each.dyad, [np.nan] * 5
        if isinstance(dyad, RR):
            at = [*dyad.fixed_pivot, *dyad.moving_pivot, float(dyad.radius)]
        rows.append([*at, each.rms_error])
    return np.array(rows).reshape(-1, 6), codes, time.process_time() - start


def judged(task):
    """What became of a task: its words, whether all digits were there and carry it, the seconds."""
    listed, codes, seconds = found_dyads_of(task)
    told = any(code == "W207" or code.startswith("R3") for code in codes)
    words = [
        word if word != "lost" else "told" if told else "SILENT" for word in verdicts(task, listed)
    ]
    carried = not task.resolution and bool(moved_by_rounding(task).max() < CARRIED)
    return words, carried, told, seconds


def band(task):
    """The row of the table in which a task counts."""
    if task.apart:
        low = 10.0 ** np.floor(np.log10(task.apart))
        return f"near-parallelogram, {100 * low:g} to {1000 * low:g} %"
    edges = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5]
    k = int(np.clip(np.searchsorted(edges, task.sweep) - 1, 0, 4))
    return f"sweep {edges[k]} to {edges[k + 1]} rad"


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--show", action="store_true", help="print the tasks with a loss")
    given = parser.parse_args()
    table, seconds, warned = {}, [], 0
    for k in range(given.count):
        task = small_turn(np.random.default_rng([given.seed, k]))
        words, carried, told, took = judged(task)
        for row in (band(task), "all", *["all digits that carry it"] * carried):
            table.setdefault(row, Counter()).update([*words, "tasks"])
        seconds.append(took)
        warned += told
        if given.show and {"told", "SILENT"} & set(words):
            digits = "all" if not task.resolution else f"{task.resolution:.0e}"
            print(
                f"{k}: {band(task)}, {len(task.rows)} poses, digits {digits}, "
                f"carried {carried}, {words}",
                flush=True,
            )
    heads = ("tasks", "listed", "as good", "told", "SILENT")
    print("|".join(("", *heads)))
    for row in sorted(table):
        print("|".join((row, *(str(table[row][head]) for head in heads))))
    seconds = np.array(seconds)
    print(
        f"{given.count} tasks, seed {given.seed}; warned of in {warned}; the search for dyads "
        f"takes {1e3 * np.median(seconds):.0f} ms (median), {1e3 * seconds.max():.0f} ms at worst"
    )
    return int(table["all"]["SILENT"] > 0)


if __name__ == "__main__":
    sys.exit(main())
