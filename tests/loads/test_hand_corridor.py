"""The least and the greatest force of a hand that a task allows, against free bodies."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.loads.load_figures import loaded
from burmester.requirements.figures import Figures
from burmester.requirements.loads import HAND_FORCE
from burmester.tasks.requirements import Requirements
from tests.oracles.loaded_linkages import (
    KINDS,
    balanced,
    differences,
    loaded_linkage,
    moved,
    random_loads,
    wrenches,
)


def with_hand(rng, names, metre):
    """Some of everything, with a hand on the body."""
    return replace(random_loads(rng, names, metre), hand=rng.normal(size=2))


def hand_of(model, linkage, way):
    """The force (n,) of a hand that moves the linkage on (way 1) or back (-1): free bodies.

    The motor is idle, the hand pulls along its path, and gas springs rub against their motion.
    """
    at = linkage.at(2001)
    place, unit = moved(model, at), 1.0 if at.rates.turns else linkage.metre
    places, loads, h = place(0.0), linkage.loads, 1e-3 * unit
    onwards = 1.0 if at.drive[-1] > at.drive[0] else -1.0
    acting = wrenches(model, places, loads, linkage.metre)
    for spring in loads.springs:
        if spring.kind != "gas":
            continue
        links = [model.body if end.link == "body" else end.link for end in spring.ends]

        def apart(step, links=links, spring=spring):
            there = place(step)
            one, two = (
                there[link][0] + there[link][1] * complex(*end.point) * linkage.metre
                for link, end in zip(links, spring.ends, strict=True)
            )
            return two - one, one, two

        grows, _ = differences(lambda step, apart=apart: abs(apart(step)[0]), h)
        gap, one, two = apart(0.0)
        rub = spring.count * spring["friction_N"] * np.sign(grows * onwards * way) * gap / abs(gap)
        acting[links[0]].append((rub, one, 0.0))
        acting[links[1]].append((-rub, two, 0.0))

    def hand(step):
        here, turn = place(step)[model.body]
        return here + turn * complex(*loads.hand) * linkage.metre

    path, _ = differences(hand, h)
    push = onwards * path / abs(path), hand(0.0), 0.0
    idle, _ = balanced(model, places, acting, linkage.metre)
    acting[model.body].append(push)
    helped, _ = balanced(model, places, acting, linkage.metre)
    return idle / (idle - helped)


def judged(linkage, bound):
    """The kinds of what the linkage misses under a bound on its hand."""
    task = linkage.found.task
    task = replace(task, requirements=Requirements(hand_force_N=bound))
    one = replace(linkage.found, task=task, violations=(), loads=None)
    return [each.kind for each in loaded(one).violations if each.kind == "hand force"]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", KINDS)
def test_a_corridor_holds_what_the_hand_does_on_its_way(kind, seed):
    model, linkage = loaded_linkage(kind, seed, with_hand)
    on, back = (hand_of(model, linkage, way) for way in (1, -1))
    low, high = on.min(), on.max()
    slack = 1e-3 * max(abs(low), abs(high))  # as closely as extremes are told
    figures = loaded(linkage.found).loads.measures
    assert figures["hand_least"] == pytest.approx(low, abs=slack)
    assert figures["hand_greatest"] == pytest.approx(high, abs=slack)
    most = max(np.abs(on).max(), np.abs(back).max())  # one number bounds both ways
    assert figures["hand_force"] == pytest.approx(most, abs=slack)
    wide, tight = 2 * slack, 0.02 * (high - low)
    assert not judged(linkage, (low - wide, high + wide))
    assert judged(linkage, (low + tight, high + wide))
    assert judged(linkage, (low - wide, high - tight))


def test_what_is_missed_is_told_and_the_wider_corridor_is_kept():
    figures = Figures(hand_force=31.0, hand_least=-3.333, hand_greatest=30.126)
    for bound, wider in (((5, 40), (-3.4, 40)), ((-5, 20), (-5, 30.2)), ((0, 30), (-3.4, 30.2))):
        assert HAND_FORCE.excess(figures, bound) > 0
        cure = HAND_FORCE.cure(bound, figures)
        assert cure.value == pytest.approx(wider)
        assert not HAND_FORCE.excess(figures, cure.value) > 0
        halfway = HAND_FORCE.looser(bound, figures, 0.5).bound
        assert HAND_FORCE.excess(figures, bound) > HAND_FORCE.excess(figures, halfway) > 0
    told = HAND_FORCE.said(figures, (0, 40), "mm")
    assert told == (
        "the hand moves it, holding the body back, with -3.33 to 30.1 N; 0 to 40 N is allowed"
    )
    assert HAND_FORCE.excess(figures, (-4, 31)) == 0
    assert HAND_FORCE.excess(Figures(), (0, 1)) == 0  # of a linkage that is not loaded


@pytest.mark.parametrize("bound", [(5, 5), (5, 1), [1], [1, 2, 3], (0, np.inf), "5:6", (0, "x")])
def test_corridors_that_are_none_are_refused(bound):
    with pytest.raises(InputError) as caught:
        Requirements(hand_force_N=bound)
    assert caught.value.code == "E134"
