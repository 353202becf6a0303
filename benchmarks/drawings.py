"""Random linkages of every pair of kinds as drawings: written, read back, and their text looked at.

    python -m benchmarks.drawings --count 200 --seed 0

Counts linkages that plates cannot hold (E162, E163), drawings that did not pass their own check
(E160), text of dimension lines that touches the plate, other text or a line, and sizes of holes,
links and sheets that are in stock.  The exit code is 1 if a drawing failed or text touches a plate.
"""

import argparse
import itertools
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
from tests.oracles.handed_over import saved
from tests.oracles.random_dyads import PAIRS, random_dyad

from burmester.errors import BurmesterError, InputError
from burmester.export import Options, export
from burmester.export.drawings.sheet import laid_lengthwise
from burmester.export.parts.distances import distance
from burmester.export.parts.plates import assembly_of
from burmester.export.parts.stock import stock_for

UNITS = {"mm": 40.0, "cm": 4.0, "in": 2.0, "m": 0.3, "ft": 0.5, None: 30.0}  # median lengths
FORMATS = ("dxf", "svg", "pdf")


def random_linkage(rng):
    """A linkage with a motion of finite places, and with a unit; None where the dyads have none."""
    unit = list(UNITS)[rng.integers(len(UNITS))]
    size = UNITS[unit] * 10 ** rng.uniform(-0.7, 0.7)
    pair = PAIRS[rng.integers(len(PAIRS))]
    dyads = []
    for kind in pair:
        dyad = random_dyad(kind, rng)
        lengths = {"fixed_pivot", "moving_pivot", "radius", "offset"} & set(kind.__slots__)
        values = {
            each: getattr(dyad, each) * (size if each in lengths else 1) for each in kind.__slots__
        }
        dyads.append(kind(**values))
    start = rng.uniform(-2, 2)
    try:
        return saved("", given=(*dyads, unit, (start, start + rng.uniform(0.4, 1.6))))
    except (IndexError, ValueError, InputError):
        return None


def touching(assembly):
    """What text of dimension lines touches, each counted, over all plates."""
    found = Counter()
    letters = 0.35 * assembly.dimensions.width
    for laid in laid_lengthwise(assembly, letters, 3, True):
        corners = laid.place.act(laid.plate.skeleton)
        found["texts"] += len(laid.lines)
        for one in laid.lines:
            found["on a plate"] += distance(one.box, corners) < laid.plate.radius
        for one, two in itertools.permutations(laid.lines, 2):
            found["on text"] += distance(one.box, two.box) <= 0
            found["on a line"] += any(distance(one.box, each) <= 0 for each in two.lines)
    return found


def campaign(count, seed):
    """The counts over a number of linkages."""
    rng = np.random.default_rng(seed)
    found = Counter()
    with tempfile.TemporaryDirectory() as folder:
        while found["linkages"] < count:
            chosen = random_linkage(rng)
            if chosen is None:
                continue
            found["linkages"] += 1
            try:
                assembly = assembly_of(chosen, Options())
            except InputError as error:
                found[error.code] += 1
                continue
            found += touching(assembly)
            stock = stock_for(assembly.unit)
            if not assembly.assumed:
                found["sizes"] += 3
                made = assembly.dimensions
                found["in stock"] += made.hole in stock.holes
                found["in stock"] += made.width in stock.widths
                found["in stock"] += made.thickness in stock.sheets
            for to in FORMATS:
                try:
                    export(chosen, to, Path(folder) / f"a.{to}", force=True)
                    found[to] += 1
                except BurmesterError as error:
                    found[f"{to} {error.code}"] += 1
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    found = campaign(given.count, given.seed)
    for key, number in sorted(found.items()):
        print(f"{number:6d}  {key}")
    failed = any(found[f"{to} E160"] for to in FORMATS) or found["on a plate"]
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
