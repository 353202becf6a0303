"""There and back: is the linkage that made the poses found again, and judged as it is?

    python -m benchmarks.round_trip --tasks 5000 --seed 0

A task is a random linkage (of every Grashof class, slider-cranks and a few inverted ones, each
driven from either ground link) and 6 to 50 places of its coupler:

- "sound": on one branch of its driver, in the driver's order, so it is usable;
- "circuit": from both circuits; "branch": from both branches of either driver; "order": sound
  but shuffled.  It is not usable, and the defect has to be named, for both drivers.

The generating linkage has to be found within 1e-7 of the poses' span, or flagged: the stated
uncertainty covers what is missing, or a warning says that the poses do not determine it. The best
of those called usable has to meet the poses as it claims, by the witness in
`tests/oracles/witness.py`, and to be without defects by the tracer in `tests/oracles/tracer.py`,
where the generating linkage is not; they share no code with the package.

Everything else is a silent wrong answer, and exit code 1.

    python -m benchmarks.round_trip --check 200 --seed 0

holds the tasks themselves against that tracer.
"""

import argparse
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass
from functools import partial

import numpy as np
from tests.oracles.elsewhere import gap, made_of
from tests.oracles.tracer import driven, met_at, walks
from tests.oracles.witness import misses

from burmester import Task, synthesize
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage, grashof
from burmester.geometry.displacement import Displacement
from burmester.linkages import from_dyads

FOUND = 1e-7  # spans, of every dimension of the generating linkage
MET = 1e-6  # spans, between the witness and what a usable linkage claims
AWAY = 0.02  # from a change point, in shares of all lengths
FEWEST, MOST = 6, 50  # poses
EDGE = 0.03  # of a branch, left out at its ends
SLACK = 0.05  # of a step of the tracer, as far as it tells two places apart
LOOSE = 3.0  # times the greatest miss: places nearer to each other have no order (it says 2)
TRIES = 2000  # at most, until a random linkage suits
SPREAD = 3.0  # times the stated 95 % half width: what it covers

FOUR_BARS = ("crank-rocker", "rocker-crank", "double-crank", "double-rocker", "triple-rocker")
SLIDERS = ("crank-slider", "slider-crank", "rocker-slider", "slider-rocker")
SLOTS = ("crank-slot", "slot-crank")
KINDS = 2 * FOUR_BARS + 2 * SLIDERS + SLOTS  # slots are few
VARIANTS = ("sound",) * 7 + ("circuit", "order", "branch")
WITH_TWO = {  # the kinds that can have a defect at all
    "circuit": (*FOUR_BARS[:4], *SLIDERS[:2], *SLOTS),
    "branch": (*FOUR_BARS[3:], *SLIDERS[2:]),
}


# What the package says; all that depends on its interface --------------------------------------


def solved(poses):
    """What the package makes of poses."""
    return synthesize(Task(poses))


def linkages_of(result):
    """Its linkages, the best first, each with what it says of it."""
    return [(found.linkage, found) for found in result.linkages]


def is_usable(found):
    """Whether it calls a linkage usable."""
    return bool(found.usable)


def defects_of(found, side):
    """The kinds of defect that it names for a driver, 0 (the first dyad) or 1."""
    driven_by = (found.verdict.first, found.verdict.second)[side]
    return {each.kind for each in (*found.verdict.defects, *driven_by.defects)}


def claimed(found):
    """The errors (N,) that it claims, of position and of angle."""
    return found.error.position, found.error.angle


def places_of(found):
    """Where it says that the coupler is for the poses; its driver is the first dyad."""
    return found.error.places


def is_open(found):
    """Whether it leaves its verdict open, as too close to call."""
    verdict = found.verdict
    named = [*verdict.defects, *verdict.first.defects, *verdict.second.defects]
    return not all(each.certain for each in named)


def is_flagged(result, found, missing, reach):
    """Whether it says that the linkage is not determined, or by about as much as `missing`.

    found: what it says of the nearest linkage there is, or None.  reach: how far poses are from
    the origins, where a line turned by its uncertainty moves most.
    """
    if "W209" in {warning.code for warning in result.warnings}:
        return True
    if found is None:
        return False
    stated = found.uncertainty
    covered = stated is not None and SPREAD * uncertain_by(stated, reach) >= missing
    return covered or not found.determined


def uncertain_by(stated, reach):
    """The greatest half width of the 95 % regions of a linkage's two dyads, a length."""
    widths = [0.0]
    for dyad in stated:
        widths += [dyad.half_width, dyad.length or 0.0]
        if dyad.line is not None:
            widths.append(dyad.line.offset + dyad.line.angle * (1 + reach))
    return max(widths)


# The tasks ----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A linkage, driven by its first dyad, its poses, and what there is to say of it."""

    kind: str
    variant: str
    linkage: Linkage
    poses: Displacement

    @property
    def span(self):
        """The diagonal of the box that holds the positions."""
        return float(np.hypot(*np.ptp(self.poses.translation, axis=0)))


def random_case(rng, variant, kind=None):
    """A task of a variant; `kind` None takes one of those that can have it."""
    kinds = [each for each in KINDS if each in WITH_TWO.get(variant, KINDS)]
    kind = kinds[rng.integers(len(kinds))] if kind is None else kind
    for _ in range(TRIES):
        linkage = random_linkage(rng, kind)
        poses = poses_of(linkage, variant, rng, int(rng.integers(FEWEST, MOST + 1)))
        if poses is not None:
            return Case(kind, variant, linkage, poses)
    raise RuntimeError(f"no {kind} for the variant {variant}")


def random_linkage(rng, kind):
    """A linkage of a kind, of sizes of about 1, put anywhere within some lengths of the origins."""
    for _ in range(TRIES):
        linkage = _slotted(rng) if kind in SLOTS else _pinned(rng, kind)
        if kind in ("slider-crank", "slider-rocker", "slot-crank"):
            linkage = Linkage(linkage.second, linkage.first)
        circuits = Circuits.of(linkage)
        if circuits.exists.any() and circuits.loop.margin.flat[0] > AWAY:
            return linkage
    raise RuntimeError(f"no {kind} has a circuit")


def _unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def _pinned(rng, kind):
    """A four-bar or slider-crank whose crank is first."""
    origin, hand = rng.normal(size=(2, 2))
    while True:
        ground, crank, coupler, follower = np.exp(rng.uniform(np.log(0.35), np.log(2.8), 4))
        far = hand + coupler * _unit(rng.uniform(-np.pi, np.pi))
        first = RR(origin, hand, crank)
        if kind in FOUR_BARS:
            fixed = origin + ground * _unit(rng.uniform(-np.pi, np.pi))
            linkage = Linkage(first, RR(fixed, far, follower))
            if grashof(linkage.links) == kind:
                return linkage
            continue
        normal, aside = rng.uniform(-np.pi, np.pi), rng.uniform(-1, 1)
        turns = coupler > crank + abs(aside)
        if turns == kind.startswith(("crank", "slider-crank")):
            return Linkage(first, PR(normal, _unit(normal) @ origin + aside, far))


def _slotted(rng):
    """A crank whose end's body slides through a pin."""
    origin, hand = rng.normal(size=(2, 2))
    ground, crank = np.exp(rng.uniform(np.log(0.35), np.log(2.8), 2))
    normal, aside = rng.uniform(-np.pi, np.pi), rng.uniform(-1, 1)
    fixed = origin + ground * _unit(rng.uniform(-np.pi, np.pi))
    return Linkage(RR(origin, hand, crank), RP(fixed, normal, _unit(normal) @ hand + aside))


def poses_of(linkage, variant, rng, count):
    """So many poses of a variant, or None if the linkage has none."""
    circuits = Circuits.of(linkage)
    assert circuits.closed[circuits.exists].all()
    one = circuits[int(rng.choice(np.flatnonzero(circuits.exists)))]
    if variant == "circuit":
        return _of_both_circuits(circuits, rng, count) if circuits.exists.all() else None
    other = Linkage(linkage.second, linkage.first)
    both_lock = one.branches == Circuits.of(other)[0].branches == 2
    if variant == "branch":
        poses = one.couplers(_spread(rng, 0, 2 * np.pi, count))
        found = [circuit_of(either, poses) for either in (linkage, other)]
        clear = all(each.branch_margin.min() > EDGE for each in found)
        mixed = all(len(set(each.branch)) == 2 for each in found)
        return poses if both_lock and clear and mixed else None
    # A part of a branch, or of a whole turn.
    low = np.pi * rng.integers(2) + EDGE * np.pi
    whole = np.pi * (1 - 2 * EDGE)
    if one.branches < 2:
        low, whole = rng.uniform(0, 2 * np.pi), 0.95 * 2 * np.pi
    width = whole * rng.uniform(0.4, 1)
    low += rng.uniform(0, whole - width)
    s = _spread(rng, low, width, count)
    if rng.random() < 0.5:
        s = s[::-1]
    if variant == "order" and both_lock and rng.random() < 0.5:
        s = np.roll(s, rng.integers(1, count))  # in order on a whole turn only
    elif variant == "order":
        s = rng.permutation(s)
        if in_order(s):
            return None
    return one.couplers(s % (2 * np.pi))


def _of_both_circuits(circuits, rng, count):
    on = rng.integers(2, size=count)
    on[:2] = 0, 1
    both = circuits.couplers(_spread(rng, 0, 2 * np.pi, count))
    return both[rng.permutation(on), np.arange(count)]


def _spread(rng, low, width, count):
    """Random numbers (count,) in order, none nearer to the next than a tenth of the mean gap."""
    gaps = 0.1 / count + 0.9 * rng.dirichlet(np.ones(count))
    return low + width * (np.cumsum(gaps) - gaps * rng.random())


def in_order(along, slack=0.0):
    """Whether places along a loop are met one after the other, either way round."""
    step = np.diff(np.append(along, along[0]))
    return min((step > slack).sum(), (step < -slack).sum()) <= 1


# Keeping account ----------------------------------------------------------------------------------


def judge(case):
    """What came of a case: what the package said, and what of it is wrong, if anything."""
    result = solved(case.poses)
    every = linkages_of(result)
    said, wrong = [], []
    gaps = [apart(case.linkage, linkage) for linkage, _ in every]
    nearest = min(range(len(gaps)), key=lambda k: gaps[k][0], default=None)
    missing, swapped = (np.inf, False) if nearest is None else gaps[nearest]
    found = None if nearest is None else every[nearest][1]
    if missing <= FOUND * case.span:
        said.append("found")
        _judge_verdict(case, found, swapped, said, wrong)
    elif is_flagged(result, found, missing, np.abs(case.poses.translation).max()):
        said.append("flagged as undetermined")
    else:
        wrong.append(f"lost ({missing / case.span:.1e} spans)")
    _judge_usable(case, every, said, wrong)
    return said, wrong


def _judge_verdict(case, found, swapped, said, wrong):
    """Whether the generating linkage is called what it is; `swapped`: its driver is second."""
    if is_open(found):
        said.append("too close to call")
        return
    sound = case.variant == "sound"
    said.append("called usable" if is_usable(found) else "called unusable")
    if is_usable(found) != sound:
        wrong.append(said.pop())
    mine, other = (defects_of(found, side ^ swapped) for side in (0, 1))
    if sound:
        wrong.extend(f"{kind} defect claimed of its driver" for kind in sorted(mine))
        return
    # Shuffled poses may lie beyond the other driver's dead points as well.
    if case.variant in mine and (case.variant in other or (case.variant == "order" and other)):
        said.append("the defect is named")
    else:
        wrong.append(f"{case.variant} defect not named, but {sorted(mine)} and {sorted(other)}")


def _judge_usable(case, every, said, wrong):
    """Whether the best linkage called usable meets the poses as it claims."""
    best = next(((linkage, found) for linkage, found in every if is_usable(found)), None)
    if best is None:
        return
    linkage, found = best
    position, angle = claimed(found)
    claim = np.hypot(position, case.span * angle) + MET * case.span
    if (misses(linkage, case.poses, case.span) <= claim).all():
        said.append("a usable one meets the poses as it claims")
    else:
        wrong.append("a usable linkage does not meet the poses as it claims")
    if case.variant != "sound":  # then it is another linkage than that of the case
        try:
            named = traced(linkage, places_of(found), SLACK, LOOSE * claim.max())[0]
        except AssertionError:
            said.append("a usable one could not be traced")
        else:
            if named:
                wrong.append(f"a usable linkage has a {named.pop()} defect by the tracer")
            else:
                said.append("a usable one is usable by the tracer")


def apart(one, other):
    """How far two linkages are apart in any dimension, and if their dyads change places."""
    pairs = [(one.first, one.second), (one.second, one.first)]
    gaps = [
        max(_dyads_apart(a, b) for a, b in zip(pair, (other.first, other.second), strict=True))
        for pair in pairs
    ]
    return min(gaps), gaps[1] < gaps[0]


def _dyads_apart(one, other):
    if type(one) is not type(other):
        return np.inf
    lengths = (one.radius, other.radius) if isinstance(one, RR) else (0.0, 0.0)
    return max(gap(made_of(one), made_of(other)), abs(float(lengths[0] - lengths[1])))


def case_of(number, seed):
    """The case of a number: kinds and variants take turns."""
    rng = np.random.default_rng([seed, number])
    variant = VARIANTS[number % len(VARIANTS)]
    turn = number // len(VARIANTS) * 7 + number % len(VARIANTS)
    kind = KINDS[turn % len(KINDS)] if variant == "sound" else None
    return random_case(rng, variant, kind)


def _account(number, seed):
    case = case_of(number, seed)
    try:
        said, wrong = judge(case)
    except Exception as error:  # a crash is an answer, too, and a wrong one
        said, wrong = [], [f"{type(error).__name__}: {error}"]
    return case.kind, case.variant, said, wrong


def run(tasks, seed, processes=1, tell=lambda line: None):
    """Judge so many tasks: counts by (kind, variant, what was said), and what is wrong.

    The wrong ones are (number of the task, kind, variant, what); `case_of` gives the task again.
    """
    counts, silent = Counter(), []
    one = partial(_account, seed=seed)
    pool = ProcessPoolExecutor(processes) if processes > 1 else None
    with pool or nullcontext():
        answers = pool.map(one, range(tasks), chunksize=4) if pool else map(one, range(tasks))
        for number, (kind, variant, said, wrong) in enumerate(answers):
            counts[kind, variant, "tasks"] += 1
            counts.update((kind, variant, each) for each in said)
            for each in wrong:
                counts[kind, variant, "WRONG"] += 1
                silent.append((number, kind, variant, each))
                tell(f"task {number}, {kind}, {variant}: {each}")
    return counts, silent


# The tasks held against the tracer ----------------------------------------------------------------


def traced(linkage, places, slack=0.0, loose=0.0):
    """The defects of a linkage for both drivers, by a walk along its coupler's motion.

    slack: how far one place may be behind the one before, in steps of the walk; loose: the same as
    a distance.
    """
    rows = np.column_stack([places.translation, places.angle])
    one = Linkage(linkage.first[None], linkage.second[None])
    (walk,), closed = walks(one, rows[:1], np.ones(1))
    assert closed.all()
    slack += loose / np.median(np.linalg.norm(np.diff(walk[:, :2], axis=0), axis=1))
    far, leg = met_at(walk, rows)
    if (far > 1e-3).any():
        return [{"circuit"}] * 2
    # How far along, beyond the leg's beginning: two poses may share a leg.
    base, step = walk[leg], walk[leg + 1] - walk[leg]
    away = rows - base
    away[:, 2] = (away[:, 2] + np.pi) % (2 * np.pi) - np.pi
    along = leg + (away * step).sum(1) / (step**2).sum(1)
    # Round the loop, a place within the slack of the one before is where that one is.
    loop, whole = along.copy(), len(walk) - 1
    for k in range(1, len(loop)):
        if abs((loop[k] - loop[k - 1] + whole / 2) % whole - whole / 2) <= slack:
            loop[k] = loop[k - 1]
    named = []
    for dyad in (linkage.first, linkage.second):
        sign = np.sign(np.diff(driven(dyad, walk)))
        turns = np.flatnonzero(sign[1:] != sign[:-1]) + 1
        if len(set(np.searchsorted(turns, along) % max(len(turns), 1))) > 1:
            named.append({"branch"})
        elif len(turns):
            step = np.diff((along - turns[0]) % (len(walk) - 1))
            one_way = (step >= -slack).all() or (step <= slack).all()
            named.append(set() if one_way else {"order"})
        else:
            named.append(set() if in_order(loop) else {"order"})
    return named


def check(tasks, seed):
    """How many of the tasks are not what they are called; a line for each."""
    counts, bad = Counter(), 0
    for number in range(tasks):
        case = case_of(number, seed)
        try:
            first, second = traced(case.linkage, case.poses)
        except AssertionError as error:
            counts[case.variant, f"not traced: {error}"] += 1
            continue
        wanted = set() if case.variant == "sound" else {case.variant}
        good = first == wanted and (case.variant in ("sound", "order") or second == wanted)
        good &= case.variant != "order" or bool(second)
        counts[case.variant, "as called" if good else "NOT AS CALLED"] += 1
        if not good:
            bad += 1
            print(f"task {number}, {case.kind}, {case.variant}: traced {first}, {second}")
    for (variant, what), count in sorted(counts.items()):
        print(f"{variant}: {count} {what}")
    return bad


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--tasks", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--processes", type=int, default=2, choices=(1, 2))
    parser.add_argument("--check", type=int, help="check so many tasks themselves, by the tracer")
    parser.add_argument(
        "--without-search",
        action="store_true",
        help="judge only: look for no other linkages where the closest is not usable (3 x faster)",
    )
    given = parser.parse_args()
    if given.without_search:
        from_dyads.defect_free_linkages = lambda *_: None
    if given.check:
        return int(check(given.check, given.seed) > 0)
    begun = time.perf_counter()
    counts, silent = run(
        given.tasks, given.seed, given.processes, lambda line: print(line, flush=True)
    )
    for row in table(counts):
        print(row)
    total = Counter()
    for (_, _, what), count in counts.items():
        total[what] += count
    print("; ".join(f"{count} {what}" for what, count in total.items()))
    print(f"seed {given.seed}, {time.perf_counter() - begun:.0f} s")
    numbers = sorted({number for number, *_ in silent})
    print(f"silent wrong answers: {len(silent)}, in tasks {numbers}")
    return int(bool(silent))


def table(counts):
    """Lines of text: a row for each kind and variant."""
    columns = sorted({what for _, _, what in counts} - {"tasks", "WRONG"})
    for number, what in enumerate(columns, start=1):
        yield f"({number}) {what}"
    yield f"{'kind':16}{'variant':9}{'tasks':>7}{'WRONG':>7}" + "".join(
        f"{f'({n})':>7}" for n in range(1, len(columns) + 1)
    )
    for kind, variant in sorted({key[:2] for key in counts}):
        values = [counts[kind, variant, what] for what in ("tasks", "WRONG", *columns)]
        yield f"{kind:16}{variant:9}" + "".join(f"{value:7}" for value in values)


if __name__ == "__main__":
    sys.exit(main())
