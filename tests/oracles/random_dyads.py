"""Random dyads and linkages of every pair of kinds, and places on them from a sweep."""

from itertools import product

import numpy as np
import pytest

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from tests.oracles.tracer import FAR
from tests.oracles.witness import places

PAIRS = list(product((RR, PR, RP), repeat=2))
NAMES = [f"{a.__name__}-{b.__name__}" for a, b in PAIRS]
all_pairs = pytest.mark.parametrize("pair", PAIRS, ids=NAMES)


def random_dyad(kind, rng):
    if kind is RR:
        return RR(rng.normal(size=2), rng.normal(size=2), rng.uniform(0.2, 2.5))
    if kind is PR:
        return PR(rng.uniform(-np.pi, np.pi), rng.normal(), rng.normal(size=2))
    return RP(rng.normal(size=2), rng.uniform(-np.pi, np.pi), rng.normal())


def stacked(dyads):
    names = type(dyads[0]).__slots__
    return type(dyads[0])(*(np.stack([getattr(d, name) for d in dyads]) for name in names))


def random_linkages(pair, rng, count):
    """Linkages (count,); two rails or slots at 23 degrees at least: not to walk for ever."""
    dyads = []
    while len(dyads) < count:
        two = [random_dyad(kind, rng) for kind in pair]
        if pair in ((PR, PR), (RP, RP)):
            angle = two[0].normal_angle - two[1].normal_angle
            if abs(np.sin(angle)) < 0.4:
                continue
        dyads.append(two)
    return Linkage(*(stacked(column) for column in zip(*dyads, strict=True)))


def some_places(first, second, rng):
    """Places (m, 3) from a sweep, at random and one of each run; and if it closes at all."""
    if isinstance(first, RR):
        sweep = np.linspace(-np.pi, np.pi, 720)
    else:
        sweep = 25 * np.linspace(-1, 1, 2161) ** 3
    where, phi = places(first, second, sweep)
    rows = np.stack([where.real, where.imag, phi], axis=-1)
    sound = np.isfinite(phi) & (np.abs(where) < FAR / 2)
    chosen = []
    for way in (0, 1):
        some = np.flatnonzero(sound[way])
        if len(some):
            runs = np.split(some, np.flatnonzero(np.diff(some) > 1) + 1)
            at = [*rng.choice(some, 4), *(run[len(run) // 2] for run in runs)]
            chosen.append(rows[way][at])
    found = rng.permutation(np.concatenate(chosen)) if chosen else np.empty((0, 3))
    return found, bool(np.isfinite(phi).any())


def circuits_of(pair, seed, count=60):
    """Circuits (n,) that exist, of random linkages, the linkages themselves, and parameters."""
    rng = np.random.default_rng([seed, PAIRS.index(pair)])
    linkage = random_linkages(pair, rng, count)
    every = Circuits.of(linkage)
    which, number = np.nonzero(every.exists & (every.loop.margin > 1e-4))
    circuits = every[which, number]
    s = rng.uniform(0.3, 2.8, (len(which), 30))
    s = np.where(circuits.closed[:, None] & (rng.random(s.shape) < 0.5), s + np.pi, s)
    s = np.where((circuits.closed | (circuits.range_type == HALF))[:, None], s, 2 * s - 3)
    return circuits, Linkage(linkage.first[which], linkage.second[which]), s, number


HALF = 6


def rows_of(place):
    return np.concatenate([place.translation, place.angle[..., None]], axis=-1)


def four_bar(ground, crank, coupler, follower):
    """One linkage, or as many as there are lengths."""
    zero = np.zeros_like(np.asarray(crank, dtype=float))
    origin, fixed, moving = (np.stack([x + zero, zero], axis=-1) for x in (0, ground, coupler))
    return Linkage(RR(origin, origin, crank), RR(fixed, moving, follower))


CHANGE = {
    "parallelogram": four_bar(3.0, 1.0, 3.0, 1.0),
    "kite": four_bar(3.0, 3.0, 1.0, 1.0),
    "rhombus": four_bar(1.0, 1.0, 1.0, 1.0),
    "tie": four_bar(0.1 + 0.2, 0.1, 0.3, 0.1),
    "tie of four lengths": four_bar(4.0, 2.0, 5.0, 3.0),
    "stretched": four_bar(4.0, 1.0, 2.0, 1.0),
    "slider-crank": Linkage(RR([0, 0], [0, 0], 1.0), PR(0.5 * np.pi, 0.0, [1.0, 0])),
    "Scott Russell with an offset": Linkage(PR(0.5, 1.0, [0, 0]), RR([0, 0], [3, 0], 2.0)),
    "slot through the crank's end": Linkage(RR([0, 0], [0, 0], 1.0), RP([1.0, 0], 0.0, 0.0)),
    "Rapson slide": Linkage(RP([1.0, 0], 0.0, 2.0), PR(0.0, 3.0, [0.0, 0])),
    "Rapson slide, other way": Linkage(RP([1.0, 0], 0.0, 2.0), PR(0.0, -1.0, [0.0, 0])),
    "rails parallel by rounding": Linkage(PR(0.3, 0.0, [0.0, 0]), PR(0.3 + 1e-11, 1.0, [2.0, 0])),
    "Oldham with parallel slots": Linkage(RP([1.0, 0], 0.3, 2.0), RP([0.0, 0], 0.3, 1.0)),
}
