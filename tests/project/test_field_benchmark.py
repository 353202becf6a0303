"""The benchmark of the field judges rightly: motions that are known on paper, and records."""

import json
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from benchmarks.field import page
from benchmarks.field.drawn import drawn
from benchmarks.field.known import dyads_of_five, solving
from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.published import CASES, published
from benchmarks.field.run import RESULTS, merged, results, run
from benchmarks.field.scores import scores
from benchmarks.field.task import DISC, EXACT, FieldTask, Pivots
from benchmarks.field.tools import generators, tool
from benchmarks.field.tools.closure import Scaled
from benchmarks.field.tools.coupler_curves import Laid, curves, fitted, of_shape
from benchmarks.field.tracer import trace

NEAR = 1e-6
SAME = 1e-8


@pytest.fixture(scope="module")
def shelf():
    return {task.name: task for task in published()}


def task_of(d, phi, **more):
    rows = np.column_stack([np.real(d), np.imag(d), np.broadcast_to(phi, np.shape(d))])
    return FieldTask("", "", "", rows, EXACT, **more)


# A parallelogram carries the body round without turning it.
PARALLEL = FourBar(Dyad("RR", 0j, 1 + 0j, 2.0), Dyad("RR", 5 + 1j, 6 + 1j, 2.0))


def carried(degrees):
    return task_of(2 * np.exp(1j * np.radians(degrees)) - 1, 0.0)


# A rod of length 2 with its ends on the axes: its middle runs round, as the rod turns back.
TRAMMEL = FourBar(Dyad("PR", 0j, 1 + 0j, 0.0, np.pi / 2), Dyad("PR", 0j, -1 + 0j, 0.0, 0.0))


def on_axes(phi):
    return task_of(np.exp(-1j * np.array(phi)), phi)


# A crank about the origin holds M's origin; M's x axis slides through a pin at 3 + 1i.
SLOT = FourBar(Dyad("RR", 0j, 0j, 1.0), Dyad("RP", 3 + 1j, 0j, 0.0, np.pi / 2))


def through_pin(angles, pin=3 + 1j):
    d = np.exp(1j * np.array(angles))
    return task_of(d, np.unwrap(np.angle(pin - d)))


@pytest.mark.parametrize(
    ("linkage", "task"),
    [
        (PARALLEL, carried([20, 50, 90, 160])),
        (TRAMMEL, on_axes([0.3, 0.7, 1.2])),
        (TRAMMEL, on_axes([-0.5, 0.1, 0.6])),
        (SLOT, through_pin([0.2, 1.0, 2.5, 4.0])),
        (SLOT, through_pin([5.0, 5.9, 7.0, 9.0])),
        (FourBar(SLOT.second, SLOT.first), through_pin([2.0, 1.5, 1.0])),
    ],
)
def test_a_motion_that_is_known_is_met(linkage, task):
    met = trace(linkage, task)
    assert met.in_order < NEAR
    assert met.anywhere <= met.one_branch <= met.in_order


def test_poses_out_of_order_are_told():
    mixed = trace(SLOT, through_pin([0.2, 2.5, 1.0, 4.0]))
    assert mixed.one_branch < NEAR
    assert mixed.in_order > 0.1


def test_a_crank_may_begin_anywhere_but_turns_once():
    assert trace(SLOT, through_pin([6.0, 0.5 + 2 * np.pi, 2 + 2 * np.pi])).in_order < NEAR
    twice = trace(SLOT, through_pin([0.0, 2.5, 5.0, 7.5]))
    assert twice.one_branch < NEAR
    assert twice.in_order > 0.1


def test_a_dead_point_between_poses_is_told():
    # At 0 one slider turns back, at a quarter turn the other: over both no slider drives.
    over = trace(TRAMMEL, on_axes([-0.4, 0.4, 1.2, 2.0]))
    assert over.anywhere < NEAR
    assert over.one_branch > 0.1


# The crank, 2, swings on either side of the ground, 3, and passes it on neither: two circuits.
SWINGING = FourBar(Dyad("RR", 0j, 0j, 2.0), Dyad("RR", 3 + 0j, 2.6 + 0j, 1.4))


def swung(angles):
    """By the law of cosines, the coupler always to the left of the way to the other ground pin."""
    d = 2 * np.exp(1j * np.array(angles))
    length = abs(3 - d)
    corner = np.arccos((length**2 + 2.6**2 - 1.4**2) / (2 * length * 2.6))
    return task_of(d, np.angle(3 - d) + corner)


def test_poses_on_two_circuits_are_told():
    assert trace(SWINGING, swung([0.8, 1.1, 1.4])).in_order < NEAR
    both = trace(SWINGING, swung([-0.8, 0.8, 1.1]))
    assert both.anywhere < NEAR
    assert both.one_branch > 0.1


def test_an_error_is_that_of_the_worst_pose():
    task = through_pin([0.2, 1.0, 2.5, 4.0])
    for column, weight in ((0, 1.0), (2, DISC * task.span)):
        rows = task.rows.copy()
        rows[1, column] += 1e-4
        off = trace(SLOT, replace(task, rows=rows)).in_order * task.span
        assert 0.2e-4 * weight < off <= 1.001e-4 * weight


def test_a_path_has_no_angles():
    task = through_pin([0.2, 1.0, 2.5, 4.0])
    points = replace(task, rows=task.rows[:, :2])
    turned = FourBar(SLOT.first, replace(SLOT.second, normal=1.0))  # another frame of the body
    assert trace(turned, points).in_order < NEAR
    assert trace(turned, task).in_order > 0.1


@pytest.mark.parametrize(
    ("degrees", "follows"),
    [
        ([20, 40, 60, 80], True),
        ([80, 60, 40, 20], True),
        ([340, 0, 20, 40], True),  # over the place where the turn begins
        ([0, 10, 20, 350], False),  # all the way round between the last two
        ([0, 10, 180, 190], True),  # an arc of 170 degrees: a bulge of 0.92 half chords
        ([0, 10, 200, 210], False),  # of 190 degrees: of 1.09
    ],
)
def test_a_path_is_followed_between_its_points_or_not(degrees, follows):
    """A point of a crank draws a circle: which arc joins two of its points is known."""
    poses = through_pin(np.radians(degrees))
    points = replace(poses, rows=poses.rows[:, :2])
    met = trace(SLOT, points)
    assert met.in_order < NEAR
    assert met.follows == follows
    counted = scores(points, [SLOT, SLOT])
    assert (counted["meets_points"], counted["solving"]) == (2, 2 * follows)
    assert counted["solved"] == counted["solved_first"] == follows
    assert "meets_points" not in scores(poses, [SLOT])


def circle(degrees, size=1, **more):
    d = size * np.exp(1j * np.radians(degrees))
    return FieldTask("", "", "", np.column_stack([d.real, d.imag]), EXACT, **more)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_closed_path_takes_a_full_turn_and_leads_back(sense):
    round_ = sense * np.arange(100, 460, 30)
    met = trace(SLOT, circle(round_, closed=True))
    assert met.in_order < NEAR
    assert met.follows
    most = trace(SLOT, circle(round_[:6], closed=True))  # the longer way back, not straight
    assert most.in_order < NEAR
    assert not most.follows
    mixed = trace(SLOT, circle(round_[[0, 1, 3, 2, *range(4, 12)]], closed=True))
    assert mixed.one_branch < NEAR
    assert mixed.in_order > 0.09  # half a step back, over the span


def test_a_closed_path_is_none_of_a_crank_that_swings():
    """The ground, 3, and the shortest link, 1.4, are longer than the other two: none turns."""
    rocking = FourBar(Dyad("RR", 0j, 0j, 2.0), Dyad("RR", 3 + 0j, 2 + 0j, 1.4))
    degrees = np.array([30, 40, 50, 60, 50, 40])
    assert trace(rocking, circle(degrees[:4], size=2)).in_order < NEAR
    closed = trace(rocking, circle(degrees, size=2, closed=True))
    assert closed.in_order == np.inf
    assert not closed.follows


def test_a_timed_path_is_met_at_its_crank_angles():
    degrees = np.array([20, 30, 60, 80])
    for begin in (0, 70):
        met = trace(SLOT, circle(degrees, crank=np.radians(degrees - begin)))
        assert met.in_order < NEAR
        assert met.follows
    for turned in (-degrees, 2 * degrees, degrees**2 / 50):
        assert trace(SLOT, circle(degrees, crank=np.radians(turned))).in_order > 0.03
    around = circle(degrees, crank=np.radians([20, 30, 60, 440]))
    assert trace(SLOT, around).in_order < NEAR
    assert not trace(SLOT, around).follows  # once round between the last two points


def test_the_error_of_a_function_is_that_of_the_output_angle():
    turned = np.linspace(0, 1.2, 13)

    def task(outputs):
        return FieldTask("", "", "", np.column_stack([turned, outputs]), 0.01, is_function=True)

    # The links of a parallelogram turn alike, wherever their zeros are.
    assert trace(PARALLEL, task(turned + 0.4)).in_order < NEAR
    off = turned.copy()
    off[6] += 0.06
    assert trace(PARALLEL, task(off)).in_order == pytest.approx(0.03 / 1.2, rel=1e-3)
    assert trace(PARALLEL, task(np.sin(9 * turned))).in_order > 0.3
    # One whose input link swings, and passes the ground on neither side.
    wide = np.column_stack([2 * np.pi * turned / 1.2, turned])
    assert trace(SWINGING, replace(task(turned), rows=wide)).in_order == np.inf
    assert scores(task(turned), [PARALLEL])["solved_first"]
    assert not scores(task(2 * turned), [PARALLEL])["solved"]


def test_every_task_goes_to_a_tool_and_back_as_it_is():
    for task in (*published(), *drawn()):
        again = FieldTask.from_json(json.loads(json.dumps(task.to_json())))
        assert np.array_equal(again.rows, task.rows)
        assert (again.closed, again.is_function) == (task.closed, task.is_function)
        assert (again.crank is None) == (task.crank is None)
        assert (tool("pencil").refuses(task) is None) <= (task.rows.shape[1] == 3)
        assert tool("fourbarhinge_fit").refuses(task) or not task.is_function


def test_the_derivatives_that_scipy_gets_are_right():
    """Central differences say so: of a coupler point, of an opening linkage, of a generator."""
    rng, step = np.random.default_rng(0), 1e-6
    pairs = np.column_stack([np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 2])
    side = 1.0
    v = generators.start(rng, side, pairs)
    slope = generators.by_parameters(v, side, pairs)
    for k, h in enumerate(step * np.eye(5)):
        ahead, back = (generators.errors(v + sign * h, side, pairs) for sign in (1, -1))
        assert slope[:, k] == pytest.approx((ahead - back) / (2 * step), abs=1e-6)
    shape = closed_shape()
    laid = Laid(shape, Scaled(shape))
    known = np.array([-0.4, 0.1, 0.0, 0.3, -0.2])
    start = of_shape(known, side, np.empty(0), laid)
    assert fitted(start, laid).error < NEAR


def closed_shape():
    """Points of the curve of a crank, turned, stretched and shifted."""
    shapes, side = np.array([[-0.4, 0.1, 0.0, 0.3, -0.2]]), np.ones(1)
    turned = np.linspace(0, 2 * np.pi, 24, endpoint=False) + 0.3
    z = 3 * np.exp(0.7j) * curves(shapes, side, turned[None])[0] + 2 - 1j
    return FieldTask("", "", "", np.column_stack([z.real, z.imag]), EXACT, closed=True)


def test_five_published_poses_have_the_published_dyads_and_one_circuit_defect(shelf):
    """The presets say four dyads, and that links of 5.534 and 8.043 need two circuits."""
    task = shelf["motiongen-shoulder"]
    rows = json.loads((CASES / "motiongen-shoulder.json").read_text())["exact_dyads"]
    dyads = dyads_of_five(task)
    assert len(dyads) == len(rows) == 4
    for dyad, (xc, yc, r, x, y) in zip(dyads, rows, strict=True):
        assert abs(dyad.fixed - complex(xc, yc)) < SAME * task.span
        assert abs(dyad.moving - complex(x, y)) < SAME * task.span
        assert abs(dyad.size - r) < SAME * task.span
    apart = {
        tuple(round(dyad.size, 3) for dyad in pair): trace(FourBar(*pair), task).anywhere
        for pair in combinations(dyads, 2)
    }
    assert max(apart.values()) < NEAR
    ends = {round(dyad.size, 3): dyad for dyad in dyads}
    assert trace(FourBar(ends[5.534], ends[8.043]), task).one_branch > 0.01
    assert {
        round(d.size, 3) for pair in solving(task, dyads) for d in (pair.first, pair.second)
    } == (set(ends))


def test_a_score_counts_pivots_order_and_known_linkages():
    task = replace(through_pin([0.2, 1.0, 2.5, 4.0]), known=(SLOT,))
    turned = replace(SLOT.second, normal=SLOT.second.normal + np.pi)  # the same line
    good, bad = FourBar(turned, SLOT.first), FourBar(SLOT.first, replace(SLOT.second, size=0.5))
    first = scores(task, [bad, good])
    assert (first["solved"], first["solved_first"], first["solving"]) == (True, False, 1)
    assert first["known_found"] == 1
    assert scores(task, [bad])["known_found"] == 0
    here = Pivots("points", (0j, 3 + 1j))
    assert scores(replace(task, pivots=here), [good])["solved"]
    for elsewhere in (
        Pivots("points", (0j, 0j)),
        Pivots("box", (-1 - 1j, 2 + 2j)),
        Pivots("line", (0j, 3 + 2j)),
    ):
        wrong = scores(replace(task, pivots=elsewhere), [good])
        assert not wrong["solved"]
    assert scores(replace(task, pivots=Pivots("box", (-1 - 1j, 4 + 2j))), [good])["solved"]
    assert scores(replace(task, pivots=Pivots("line", (0j, 6 + 2j))), [good])["solved"]


def test_two_tools_on_two_tasks_and_the_table(shelf):
    every, names = [shelf["ge2012-exact"], shelf["motiongen-shoulder"]], [page.OURS, "pencil"]
    data = results(every, names, run(every, names, 60.0), 60.0, 0)
    by = {(each["tool"], each["task"]): each for each in data["records"]}
    assert by[page.OURS, "motiongen-shoulder"]["known_found"] == 3
    assert by["pencil", "motiongen-shoulder"]["status"] == "does not apply"
    for name in names:
        record = by[name, "ge2012-exact"]
        assert record["solved"]
        assert 0 < record["cpu"] < 60
    assert data["tools"]["pencil"]["version"]
    rows = page.table(data).splitlines()
    assert rows[2].startswith("| five poses, exact | **1 of 1**<br>exact<br>")
    assert rows[2].endswith("| – |")
    assert rows[4].count("**2 of 2**") == rows[4].count("**1 of 1**") == 1


def test_what_crashes_or_takes_too_long_is_recorded(shelf):
    task = shelf["motiongen-shoulder"]
    (late,) = run([task], [page.OURS], 0.01)
    assert late["status"] == "out of time"
    assert "solved" not in late
    broken = replace(task, rows=task.rows * np.nan)
    (crash,) = run([broken], [page.OURS], 60.0)
    assert crash["status"] == "crashed"
    assert "E103" in crash["reason"]


def record(tool, task, status="answered", **more):
    return {"tool": tool, "task": task, "status": status, "date": "2026-02-02", **more}


def test_where_another_tool_is_better_the_page_says_so():
    kinds = {"a": "noisy poses", "b": "noisy poses", "c": "sliders", "d": page.PATH}
    about = {name: {"title": name.title()} for name in (page.OURS, "scipy_starts", "pencil")}
    tasks = [{"name": name, "kind": kind} for name, kind in kinds.items()]
    won = {"solved": True, "best_error": 1e-3, "cpu": 1.0}
    records = [
        record(page.OURS, "a", **won),
        record(page.OURS, "b", **won),
        record(page.OURS, "c", **won | {"solved": False}),
        record("pencil", "c", **won | {"solved": False, "best_error": 5e-4}),
        record("scipy_starts", "a", **won | {"best_error": 5e-4, "cpu": 3.0}),
        record("scipy_starts", "b", **won | {"best_error": 2e-3, "cpu": 3.0}),
        record("scipy_starts", "c", **won),
        record(page.OURS, "d", **won),
        record("pencil", "d", **won, solved_first=True),
        record("pencil", "a", **won | {"cpu": 0.1}),
        record("pencil", "b", **won | {"solved": False, "cpu": 0.1, "best_error": 1e-9}),
    ]
    lines = page.better({"tools": about, "tasks": tasks, "records": records})
    assert lines == [
        "**Pencil** solves by its first answer what burmester solves by a later one: d.",
        "**Pencil** comes nearer, neither solving: c (0.0005 beside 0.001).",
        "**Pencil** is faster in the median: noisy poses (0.1 s beside 1 s, 1 task).",
        "**Scipy_Starts** solves what burmester does not: c.",
        "**Scipy_Starts** comes nearer, both solving: a (0.0005 beside 0.001).",
    ]


def test_figures_that_are_not_measured_again_are_kept():
    old = {"tasks": [1], "limit": 5, "seed": 0, "tools": {"a": 1, "b": 1}}
    new = old | {"tools": {"b": 2}, "records": [{"tool": "b", "task": "x", "n": 2}]}
    old["records"] = [{"tool": tool, "task": task, "n": 1} for tool, task in ("ax", "bx", "by")]
    both = merged(old, new)
    assert both["tools"] == {"a": 1, "b": 2}
    told = [(each["tool"], each["task"], each["n"]) for each in both["records"]]
    assert told == [("a", "x", 1), ("b", "y", 1), ("b", "x", 2)]
    with pytest.raises(ValueError, match="other tasks"):
        merged(old | {"limit": 9}, new)


def test_the_page_says_which_paths_were_followed_and_when_each_tool_ran():
    data = json.loads(RESULTS.read_text(encoding="utf-8"))
    about = {"title": "x", "package": "x", "version": "1", "called": ["x"]}
    data["tools"] = {page.OURS: about, "pencil": about}
    data["tasks"] = [{"name": name, "kind": page.PATH, "source": "generated"} for name in "ab"]
    won = {"solved": True, "best_error": 1e-3, "cpu": 1.0, "meets_points": 2}
    data["records"] = [
        record(page.OURS, "a", **won),
        record(page.OURS, "b", **won | {"solved": False}),
        record("pencil", "a", **won | {"solved": False, "meets_points": 0}),
    ]
    text = page.text(data)
    assert "| burmester | 2 of 2 | 1 of 2 |" in text
    assert "| pencil of the paper | 0 of 1 | 0 of 1 |" in text
    assert "All figures are of 2026-02-02." in text
    data["records"][2]["date"] = "2026-01-01"
    text = page.text(data)
    assert text.index("- 2026-02-02: burmester (2 tasks).") < text.index("- 2026-01-01: pencil")


def test_the_page_is_that_of_the_results():
    data = json.loads(RESULTS.read_text(encoding="utf-8"))
    for file, template in page.PAGES.items():
        assert file.read_text(encoding="utf-8") == page.text(data, template)
