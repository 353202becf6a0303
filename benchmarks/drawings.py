"""Random linkages of every pair of kinds as drawings: written, read back, and their text looked at.

    python -m benchmarks.drawings --count 200 --seed 0
    python -m benchmarks.drawings --every-format 200 --seed 0

The second line hands linkages of all kinds over in every format: random ones of every pair, some of
them far from the origin, in-line slider-cranks that were synthesized from printed poses, six-bars
and function generators.  Solids and films are made of every 25th.

The first line counts linkages that plates cannot hold (E162, E163), drawings that did not pass
their own check (E160), text of dimension lines that touches the plate, other text or a line, and
sizes of holes, links and sheets that are in stock.  The exit code is 1 if a drawing failed or text
touches a plate.
"""

import argparse
import itertools
import sys
import tempfile
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
from tests.oracles.common_tasks import in_line
from tests.oracles.handed_over import saved
from tests.oracles.random_dyads import PAIRS, random_dyad

import burmester
from benchmarks.read_back import motion
from burmester.errors import BurmesterError, InputError
from burmester.export import FORMATS as EVERY
from burmester.export import Options, export
from burmester.export.drawings.sheet import laid_lengthwise
from burmester.export.parts.plate import distances
from burmester.export.parts.plates import assembly_of
from burmester.export.parts.stock import stock_for
from burmester.fourbar.dyad import PR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement

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
            found["on a plate"] += distances(one.box, corners) < laid.plate.radius
        for one, two in itertools.permutations(laid.lines, 2):
            found["on text"] += distances(one.box, two.box) <= 0
            found["on a line"] += any(distances(one.box, each) <= 0 for each in two.lines)
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


def far_away(chosen, rng):
    """The same linkage, the frame of the ground somewhere else."""
    task = chosen.task
    size = float(np.ptp(task.poses.translation, axis=0).max())
    way = rng.normal(size=2) * size * 10 ** rng.uniform(0, 5)
    rows = np.column_stack([task.poses.translation + way, task.poses.angle])
    there = burmester.Task.from_rows(rows, angle_unit="rad", length_unit=task.length_unit)
    both = []
    for dyad in (chosen.linkage.first, chosen.linkage.second):
        if isinstance(dyad, PR):
            aside = [np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)] @ way
            both.append(PR(dyad.normal_angle, dyad.offset + aside, dyad.moving_pivot))
        else:
            both.append(replace(dyad, fixed_pivot=dyad.fixed_pivot + way))
    places = chosen.error.places
    error = PoseError.at(Displacement(places.translation + way, places.angle), there.poses)
    return replace(chosen, linkage=Linkage(*both), task=there, error=error)


def linkage_of(kind, rng):
    """A linkage of a kind as it is handed over, or None."""
    if kind == "in line":
        turns = rng.uniform(0, 60) + np.arange(int(rng.integers(5, 9))) * 45
        rows = in_line(turns, int(rng.integers(2, 7)), 30, rng.uniform(45, 150))
        every = burmester.synthesize(rows, angle_unit="deg", length_unit="mm").usable
        return every[rng.integers(len(every))] if every else None
    if kind == "six-bar":
        rows = motion(rng, int(rng.integers(3, 6)))
        found = burmester.synthesize_six_bars(rows, angle_unit="deg", chains=300)
        return found.best
    if kind == "function":
        wide = rng.uniform(30, 110, 2)
        found = burmester.synthesize_function(
            "log10(x)", (1, 2), input_deg=wide[0], output_deg=wide[1], pairs=5
        )
        return found.coupler_motion()[0] if found.best else None
    if (chosen := random_linkage(rng)) is None:
        return None
    chosen = far_away(chosen, rng) if kind == "far away" else chosen
    return burmester.judge(chosen.task, chosen)[0]


KINDS = ("any", "far away", "in line", "any", "six-bar", "far away", "any", "function")
SLOW = ("step", "stl", "gif", "mp4")


def every_format(count, seed):
    """How many linkages were written in each format, and what was refused."""
    rng, found, number = np.random.default_rng(seed), Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        while number < count:
            kind = KINDS[number % len(KINDS)]
            try:
                chosen = linkage_of(kind, rng)
            except InputError:
                continue
            if chosen is None:
                continue
            number += 1
            found[f"linkages: {kind}"] += 1
            for to, form in EVERY.items():
                if to == "flat" or (to in SLOW and number % 25):
                    continue
                options = Options(seconds=0.5, width_px=200)
                try:
                    export(chosen, to, Path(folder) / f"a{form.suffix}", options, force=True)
                    found[to] += 1
                except BurmesterError as error:
                    found[f"{to} {error.code}"] += 1
                    if error.code not in ("E162", "E163", "E198"):
                        print(number, kind, to, f"{error.code}: {error.why}", flush=True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--every-format", type=int, metavar="COUNT")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    if given.every_format is not None:
        found = every_format(given.every_format, given.seed)
    else:
        found = campaign(given.count, given.seed)
    for key, number in sorted(found.items()):
        print(f"{number:6d}  {key}")
    failed = any(found[f"{to} E160"] for to in EVERY) or found["on a plate"]
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
