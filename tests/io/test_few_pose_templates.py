"""Templates of two and three poses: solved to linkages that work, as an oracle drives them."""

from __future__ import annotations

import functools
import math
import re
import tempfile
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

from burmester import synthesize
from burmester.io import templates
from burmester.io.reading.poses import read_task
from tests.oracles import witness
from tests.oracles.few_poses import FINE, Bounds, FewPoses

NAMES = ("chest-lid", "derailleur", "monitor-arm", "robot-intake", "tilting-window")
TWO = ("robot-intake",)
LEVEL = ("derailleur", "monitor-arm")  # parallelograms
PAIR = r"\((-?\d+), (-?\d+)\)"
FRAMES = 400  # of a motion, in which clearance is looked at


@functools.cache
def solved(name):
    """The tree of a template, its task, and what comes of it."""
    text = templates.text(name)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "task.toml")
        path.write_text(text, encoding="utf-8")
        task = read_task(path)
    return tomllib.loads(text), task, synthesize(task)


def flat(name):
    """The comments of a template in one line."""
    return re.sub(r"\n#? ?", " ", templates.text(name))


def rows_of(task):
    return np.column_stack([task.poses.translation, task.poses.angle])


def boxes_of(tree):
    tables = tree["limits"] if isinstance(tree["limits"], list) else [tree["limits"]]
    return tuple((each["fixed_pivot"]["box"], each["moving_pivot"]["box"]) for each in tables)


def points(linkage):
    """Fixed and moving pivots (4,) as complex numbers."""
    dyads = (linkage.first, linkage.second)
    pairs = [(dyad.fixed_pivot, dyad.moving_pivot) for dyad in dyads]
    return np.array(pairs).reshape(4, 2) @ [1, 1j]


def judged(search, z):
    """The least transmission angle of a linkage (4,), degrees; dyads swapped; the sense."""
    z = (z - [search.middle, 0, search.middle, 0]) / search.unit
    angle, _, swap, sense = search.judged(z[None], FINE)
    return float(angle[0]), bool(swap[0]), int(sense[0])


def motion(search, rows, z):
    """Bodies' places (n,), angles (n,), and both links' ends (n, 2) each, by circles that meet."""
    _, swap, sense = judged(search, z)
    c1, m1, c2, m2 = z[[2, 3, 0, 1]] if swap else z
    at, turn = rows[:, :2] @ [1, 1j], np.exp(1j * rows[:, 2])
    p1, p2 = at + turn * m1, at + turn * m2
    crank = np.angle(p1 - c1)
    way = np.mod(sense * np.diff(crank), 2 * np.pi).sum()
    a = c1 + abs(p1[0] - c1) * np.exp(1j * (crank[0] + sense * way * np.linspace(0, 1, FRAMES)))
    far, arm, radius = abs(c2 - a), abs(m2 - m1), abs(p2[0] - c2)
    along = (arm**2 - radius**2 + far**2) / (2 * far)
    side = np.sign((np.conj(c2 - p1[0]) * (p2[0] - p1[0])).imag)
    b = a + (along + 1j * side * np.sqrt(arm**2 - along**2)) * (c2 - a) / far
    phi = np.angle((b - a) / (m2 - m1))
    links = [np.stack([np.full(FRAMES, c), p], axis=1) for c, p in ((c1, a), (c2, b))]
    return a - m1 * np.exp(1j * phi), phi, [*links, np.stack([a, b], axis=1)]


def outline(region):
    if "polygon" in region:
        return shapely.Polygon(region["polygon"])
    return shapely.box(*region["box"][0], *region["box"][1])


def pairs_of_numbers(z):
    return np.stack([z.real, z.imag], axis=-1)


def test_each_is_tried_here():
    assert set(NAMES) < set(templates.names())


@pytest.mark.parametrize("name", NAMES)
def test_what_its_comments_say(name):
    """Where its numbers come from, what its first line says, its outline and regions."""
    tree, task, _ = solved(name)
    rows, text = rows_of(task), flat(name)
    assert len(rows) == (2 if name in TWO else 3)
    degrees = np.degrees(rows[:, 2])
    if name in LEVEL:
        assert (degrees == 0).all()
        near = re.search(rf"circle of (\d+) mm about the point {PAIR}", text)
        centre = complex(float(near[2]), float(near[3]))
        assert abs(rows[:, :2] @ [1, 1j] - centre) == pytest.approx(float(near[1]), abs=0.6)
    else:
        told = re.search(r"by (\d+) degrees", templates.summary(name))
        assert abs(degrees[-1] - degrees[0]) == pytest.approx(float(told[1]))
    found = re.search(
        f"fixed pivots {PAIR} and {PAIR} in F and moving pivots {PAIR} and {PAIR}", text
    )
    assert (found is not None) == (name in {"chest-lid", "tilting-window"})
    if found:
        c1, c2, m1, m2 = np.array(found.groups(), float).reshape(4, 2) @ [1, 1j]
        at, turn = rows[:, :2] @ [1, 1j], np.exp(1j * rows[:, 2])
        for c, m in ((c1, m1), (c2, m2)):
            assert np.ptp(abs(at + turn * m - c)) < 0.015  # written to 0.01 mm
    names = [region["name"] for region in tree["keep_out"]]
    assert len(names) == 2
    assert tuple(f"'{each}'" for each in names) == task.surroundings.names
    assert shapely.Polygon(tree["body"]).is_valid
    assert (task.body.vertices == tree["body"]).all()


@pytest.mark.parametrize("name", NAMES)
def test_it_is_solved_as_its_file_asks(name):
    """The first linkage meets the poses, in its boxes, with sane links, driven by an oracle."""
    tree, task, synthesis = solved(name)
    rows, best = rows_of(task), synthesis.usable[0]
    search, z = FewPoses(rows, boxes_of(tree)), points(best.linkage)
    misses = witness.misses(best.linkage, task.poses, synthesis.length_per_radian)
    assert misses.max() < 1e-6 * synthesis.length
    for pivots, boxes in zip(z.reshape(2, 2), (boxes_of(tree) * 2)[:2], strict=True):
        for pivot, corners in zip(pairs_of_numbers(pivots), np.array(boxes), strict=True):
            assert (corners[0] - 1e-6 <= pivot).all()
            assert (pivot <= corners[1] + 1e-6).all()
    links = [float(each) for each in best.linkage.links]
    most = tree["requirements"].get("link_ratio", 5)
    assert max(links) <= (most + 1e-6) * min(links)
    angle = judged(search, z)[0]
    assert angle == pytest.approx(math.degrees(best.driven.least_over_range), abs=0.1)
    assert angle >= tree["requirements"]["transmission_deg"]


@pytest.mark.parametrize("name", NAMES)
def test_nothing_that_moves_comes_near_what_is_kept_out(name):
    """All linkages called usable, frame by frame: not nearer than the margin of the file."""
    tree, task, synthesis = solved(name)
    assert synthesis.usable
    rows = rows_of(task)
    search = FewPoses(rows, boxes_of(tree))
    width, margin = (tree["surroundings"][key] for key in ("link_width", "margin"))
    kept_out = [outline(region) for region in tree["keep_out"]]
    body = np.array(tree["body"]) @ [1, 1j]
    for found in synthesis.usable:
        at, phi, links = motion(search, rows, points(found.linkage))
        assert abs(at[-1] - complex(*rows[-1, :2])) < 1e-6 * synthesis.length
        placed = at[:, None] + np.exp(1j * phi)[:, None] * body
        bodies = shapely.polygons(pairs_of_numbers(placed))
        bars = [shapely.linestrings(pairs_of_numbers(each)) for each in links]
        least = min(
            float(shapely.distance(parts, region).min()) - half
            for region in kept_out
            for parts, half in ((bodies, 0.0), *((bar, width / 2) for bar in bars))
        )
        assert least > margin - 1e-3
        assert found.clearance.least == pytest.approx(least, abs=2e-3 * synthesis.length)


@pytest.mark.parametrize("name", NAMES)
def test_brute_force_finds_no_much_better_one(name):
    """Not even without the surroundings, which may cost some degrees."""
    tree, task, _ = solved(name)
    rows = rows_of(task)
    ratio = tree["requirements"].get("link_ratio", 5)
    search = FewPoses(rows, boxes_of(tree), Bounds(ratio))
    found = search.best(np.random.default_rng(3), starts=8)
    # What a task asks for is enough: asked for nothing, the first one transmits best.
    asked = replace(task.requirements, transmission_deg=0.0)
    first = synthesize(replace(task, requirements=asked)).usable[0]
    ours = judged(search, points(first.linkage))[0]
    assert ours > min(found.angle, 60) - 5
