"""Does the 95 % region of a pivot hold the true pivot?  Random four-bars, poses with known noise.

    python -m benchmarks.coverage --draws 1000 --seed 0 [--second PR] [--fit refine] [--stretch 0.1]

Each draw is another linkage, met on one assembly by 8 to 20 poses; their coordinates err by a
normal distribution of 1e-5, 1e-4 and 1e-3 of their span, their angles by as many radians.
`synthesize` gets the noisy poses and how exactly they are known; of its linkages the one nearest
to the truth counts, with the regions that it has there.  `--fit refine` only refines all pairs of
dyads, without verdicts and ranks (far quicker); `--fit scipy` is SciPy's fit from the truth, with a
driver's position for each pose among the unknowns.  The regions come from the fitted linkage,
never from the true one.
A region is printed where first order is trusted (`uncertainties`).  The others count apart, as "not
determined".  `--stretch` takes all poses from such a part of a turn of the first crank, where few
pivots are determined.
The goal is 90 to 99 % of the printed ones.
"""

import argparse
import sys
import time
from itertools import combinations

import numpy as np
from scipy.optimize import least_squares
from tests.oracles.witness import places, random_four_bar, random_poses, span

from burmester import synthesize
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.selection import characteristic_length, found_dyads
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import nearest, on_circuits
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.linkages import from_dyads
from burmester.refinement.least_error import refine
from burmester.tasks.motion_task import Task
from burmester.verdicts.uncertainty import covariance, uncertainties

LEVELS = 1e-5, 1e-4, 1e-3  # of the span, and in radians


def problem(rng, second, stretch=None):
    """Dyads, the poses (N, 3) that they meet, and the assembly; span 0.3, less on a stretch."""
    while True:
        dyads, side = random_four_bar(rng, second), int(rng.integers(2))
        count = int(rng.integers(8, 21))
        if stretch is None:
            rows = random_poses(dyads, rng, count, side)
        else:
            drive = rng.uniform(-np.pi, np.pi) + 2 * np.pi * stretch * np.linspace(0, 1, count)
            where, phi = places(*dyads, drive)
            rows = np.column_stack([where[side].real, where[side].imag, phi[side]])
        if span(rows) > 0.3 * min(1, 2 * (stretch or 1)):  # nan, where it is open, is not
            return dyads, rows, side


def numbers(dyad):
    """The dimensions of a dyad in one row."""
    return np.concatenate([np.ravel(getattr(dyad, name)) for name in dyad.__slots__])


def dyad_of(kind, z):
    """What `numbers` undoes."""
    if kind is RR:
        return RR(z[:2], z[2:4], z[4])
    return PR(z[0], z[1], z[2:4]) if kind is PR else RP(z[:2], z[2], z[3])


def by_scipy(dyads, true, side, rows, length):
    """The fitted dyads and their places (N, 3)."""
    kinds, start = [type(d) for d in dyads], [numbers(d) for d in dyads]
    parts = np.cumsum([len(z) for z in start])
    turn = np.exp(1j * true[:, 2])
    pin = true[:, 0] + 1j * true[:, 1] + complex(*dyads[0].moving_pivot) * turn
    drive = np.angle(pin - complex(*dyads[0].fixed_pivot))

    def at(v):
        first, second, turned = np.split(v, parts)
        where, phi = places(dyad_of(kinds[0], first), dyad_of(kinds[1], second), turned)
        angle = rows[:, 2] + np.angle(np.exp(1j * (phi[side] - rows[:, 2])))
        return np.column_stack([where[side].real, where[side].imag, angle])

    def miss(v):
        gap = (at(v) - rows) * [1, 1, length]
        return np.where(np.isfinite(gap), gap, 1e3).ravel()

    end = least_squares(miss, np.concatenate([*start, drive]), method="lm", xtol=1e-14).x
    first, second, _ = np.split(end, parts)
    return [dyad_of(kinds[0], first), dyad_of(kinds[1], second)], at(end)


def hits(true, found, told):
    """For each pivot and line of a dyad its name, whether its region holds the truth, and whether
    the region is printed.
    """
    for name in ("fixed", "moving"):
        if (region := getattr(told, name)) is not None:
            off = getattr(true, f"{name}_pivot") - getattr(found, f"{name}_pivot")
            yield f"{name} pivot", bool(region.contains(off)), region.determined
    if told.line is not None:
        turned = np.angle(np.exp(2j * (true.normal_angle - found.normal_angle))) / 2
        hit = bool(abs(turned) < told.line.angle)
        yield "angle of a line", hit, told.line.angle_determined
    if told.length is not None:
        hit = bool(abs(true.radius - found.radius) < told.length)
        yield "link length", hit, told.length_determined


def by_refining(dyads, rows, length):
    """The linkage nearest to the truth of all pairs of dyads, refined, or None."""
    poses = Displacement.from_poses(rows)
    found, _ = found_dyads(best_dyads(poses), Task(poses))
    linkages = [Linkage(*pair) for pair in combinations([each.dyad for each in found], 2)]
    if not linkages:
        return None
    frames = error_frames(poses, length)
    seen, unit = frames.to_canonical(poses), length / float(frames.length)
    batch = LinkageBatch.of(linkages).to_canonical(frames)
    refined = refine(batch, nearest(on_circuits(batch, seen, unit), seen, unit), seen, unit)
    fitted, best, least = refined.batch.from_canonical(frames), None, np.inf
    for k in np.flatnonzero(np.isfinite(refined.cost)):
        linkage, there = fitted.linkage(k), refined.rows[k]
        here = frames.from_canonical(Displacement(there[:, :2], there[:, 2] / unit))
        for pair in ((linkage.first, linkage.second), (linkage.second, linkage.first)):
            if (away := apart(pair, dyads)) < least:
                best, least = (list(pair), np.column_stack([here.translation, here.angle])), away
    return best


def by_package(dyads, rows, sigma):
    """The same of what `synthesize` finds: the dyads and their regions, or None."""
    # A digit that is rounded errs evenly within the resolution.
    task = Task(Displacement.from_poses(rows), resolution=(sigma[0] * 3**0.5, sigma[1] * 3**0.5))
    best, least = None, np.inf
    for each in synthesize(task).linkages:
        if each.uncertainty is None:
            continue
        for way in (1, -1):
            pair = [each.linkage.first, each.linkage.second][::way]
            if (away := apart(pair, dyads)) < least:
                best, least = (pair, each.uncertainty[::way]), away
    return best


def apart(pair, true):
    """How far two dyads are from the true ones, infinite if they are of other kinds."""
    if [type(d) for d in pair] != [type(d) for d in true]:
        return np.inf
    return max(distance(a, b) for a, b in zip(pair, true, strict=True))


def distance(dyad, true):
    """Between the pivots of two dyads of a kind, the greatest."""
    names = [name for name in dyad.__slots__ if name.endswith("pivot")]
    return max(np.hypot(*(getattr(dyad, name) - getattr(true, name))) for name in names)


def fitted(how, dyads, true, side, rows, sigma):  # noqa: PLR0917
    """The dyads of the fitted linkage and their regions, or None."""
    if how == "package":
        return by_package(dyads, rows, sigma)
    length = characteristic_length(Task(Displacement.from_poses(rows)))
    if how == "scipy":
        found = by_scipy(dyads, true, side, rows, length)
    else:
        found = by_refining(dyads, rows, length)
    if found is None or not np.isfinite(found[1]).all():
        return None
    return found[0], judged(*found, rows, sigma, length)


def judged(found, at, rows, sigma, length):
    """Of a fitted linkage the regions of both dyads, in the frames where errors are looked at."""
    frames = error_frames(Displacement.from_poses(rows), length)
    unit = float(frames.length)
    batch = LinkageBatch.of([Linkage(*found)]).to_canonical(frames)
    there = frames.to_canonical(Displacement.from_poses(at))[None]
    spread = covariance(batch, there, length / unit, (sigma[0] / unit, sigma[1]))
    return uncertainties(spread, batch, there, unit, span(rows))[0]


def counted(draws, seed, number, second=RR, stretch=None, fit="refine"):  # noqa: PLR0917
    """Of so many draws with noise LEVELS[number]: which printed regions hold the truth, by names.

    With them which others of pivots do, how many draws have no linkage near the truth, and the
    greatest half-width of each dyad, in spans.
    """
    level, counts, open_hits, missing, widths = LEVELS[number], {}, [], 0, []
    for draw in range(draws):
        rng = np.random.default_rng([seed, number, draw])
        dyads, true, side = problem(rng, second, stretch)
        size = span(true)
        rows = true + rng.normal(size=true.shape) * [level * size, level * size, level]
        sigma = level * size, level
        if (answer := fitted(fit, dyads, true, side, rows, sigma)) is None:
            missing += 1
            continue
        for parts in zip(dyads, *answer, strict=True):
            widths.append(parts[2].half_width / size)
            for name, hit, printed in hits(*parts):
                if printed:
                    counts.setdefault(name, []).append(hit)
                elif name.endswith("pivot"):
                    open_hits.append(hit)
    return counts, open_hits, missing, widths


def main():
    """Run the campaign and print what came of it; exit code 1 beyond the goal."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--draws", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--second", choices=["RR", "PR", "RP"], default="RR")
    parser.add_argument("--stretch", type=float)
    parser.add_argument("--fit", choices=["package", "refine", "scipy"], default="package")
    given = parser.parse_args()
    from_dyads.defect_free_linkages = lambda *_: (
        None
    )  # only the linkage behind the poses is asked for
    second, bad = {"RR": RR, "PR": PR, "RP": RP}[given.second], False
    for number, level in enumerate(LEVELS):
        begun = time.perf_counter()
        counts, open_hits, missing, widths = counted(
            given.draws, given.seed, number, second, given.stretch, given.fit
        )
        pivots = counts.get("fixed pivot", []) + counts.get("moving pivot", [])
        share = np.mean(pivots) if pivots else np.nan
        bad |= not 0.9 <= share <= 0.99
        print(
            f"noise {level:g}: {given.draws} draws, {missing} without such a linkage; true pivots "
            f"held by printed regions: {share:.2%} of {len(pivots)}; not determined: "
            f"{len(open_hits)}" + (f" ({np.mean(open_hits):.2%} held)" if open_hits else "")
        )
        each = ", ".join(f"{name} {np.mean(hit):.2%}" for name, hit in sorted(counts.items()))
        print(
            f"    {each}; half-width: median {np.median(widths):.1e} spans; "
            f"{(time.perf_counter() - begun) / given.draws * 1e3:.0f} ms a draw",
            flush=True,
        )
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
