"""Where no linkage works: the limit that is to blame, and how little would do."""

import json
import math
import shlex
from contextlib import suppress

import numpy as np
import pytest
from benchmarks.none_explained import compared, seeds_with_linkage

from burmester import synthesize
from burmester.cli import main
from burmester.fourbar.dyad import RR
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.synthesis.wider_region import region_text, wider, wider_all_around
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from burmester.tasks.stated_limits import StatedLimit, stated_limits, without
from burmester.tasks.surroundings import KeepOut, Surroundings
from tests.oracles.tight_boxes import tight_task
from tests.oracles.witness import misses
from tests.samples import some_of

OPENING = [(0, 0, 0), (30, 77, 45), (95, 110, 95)]
CSV = "x_mm,y_mm,angle_deg\n" + "".join(f"{x},{y},{a}\n" for x, y, a in OPENING)
REGIONS = pytest.mark.parametrize(
    "region",
    [
        box((0, 0), (10, 5)),
        Polygon(np.array([(0.0, 0), (8, 1), (3, 7)])),
        Segment(np.array([0.0, 0]), np.array([5.0, 2])),
        Line(np.array([0.0, 0]), np.array([5.0, 2])),
        Point(np.array([1.0, 2])),
    ],
    ids=["box", "polygon", "segment", "line", "point"],
)
LOW = "--fixed-pivot box:-40,-140:120,-30 --moving-pivot box:-60,-60:60,60 --kinds RR"


def task_of(*limits, **more):
    return Task.from_rows(OPENING, angle_unit="deg", length_unit="mm", limits=limits, **more)


@pytest.fixture
def run(tmp_path, capsys):
    """The command on the three poses, and its answer as data."""
    (tmp_path / "lid.csv").write_text(CSV)

    def answer(line):
        with suppress(SystemExit):
            main(["synthesize", str(tmp_path / "lid.csv"), "--json", *line])
        return json.loads(capsys.readouterr().out)

    return answer


def followed(line, option):
    """A command with an option in the place of what it says of the same thing."""
    words, more = shlex.split(line), shlex.split(option)
    kept = [w for k in range(0, len(words), 2) if words[k] not in more for w in words[k : k + 2]]
    return [*kept, *more]


def usable(data):
    return [each for each in data["linkages"] if each["usable"]]


@pytest.mark.parametrize(
    "line",
    some_of(
        [
            "--length 5:6",
            "--type double-crank --driver crank --fixed-pivot box:-40,-60:120,-50",
            "--kinds RR --footprint box:0,0:60,60",
            LOW + " --min-transmission 60",
        ],
        1,
    ),
)
def test_every_option_that_is_told_works_when_it_is_followed_to_the_letter(line, run):
    data = run(shlex.split(line))
    assert data["outcome"]["code"] == "R309"
    assert not usable(data)
    causes = data["outcome"]["causes"]
    assert causes
    assert "less may be enough" in data["outcome"]["why"]
    for cause in causes:
        assert cause["option"] in data["outcome"]["help"]
        assert usable(run(followed(line, cause["option"])))


def test_a_near_miss_keeps_all_but_the_limit_that_it_names(tmp_path):
    low, high = np.array([-40.0, -60]), np.array([120.0, -50])
    asked = Requirements(types={"double-crank"}, driver="crank")
    synthesis = synthesize(task_of(Limits(box(low, high)), requirements=asked))
    told = {each.limit.kind: each for each in synthesis.causes}
    assert not synthesis.usable
    assert "fixed pivot" in told
    for kind, cause in told.items():
        linkage = cause.found.linkage
        dyads = linkage.first, linkage.second
        fixed = np.array([dyad.fixed_pivot for dyad in dyads])
        outside = max(0.0, (low - fixed).max(), (fixed - high).max())
        assert (outside > 1e-6) == (kind == "fixed pivot")
        assert (linkage.type != "double-crank") == (kind == "type")
        assert misses(linkage, synthesis.task.poses, 145.0).max() < 1e-6
        assert cause.found.id in {each.id for each in synthesis.linkages}
    assert [each.size for each in synthesis.causes] == sorted(e.size for e in synthesis.causes)
    written = tmp_path / "none.json"
    written.write_text(json.dumps(synthesis_data(synthesis)))
    assert len(read_result(written).synthesis.linkages) == len(synthesis.linkages)


def test_two_limits_that_only_together_stop_all_are_told_together(run):
    line = "--kinds RR --fixed-pivot box:-40,-60:-20,-50 --moving-pivot box:-30,-30:0,0"
    data = run(shlex.split(line))
    assert "no one limit" in data["outcome"]["why"]
    options = " ".join(each["option"] for each in data["outcome"]["causes"])
    assert len(data["outcome"]["causes"]) > 1
    assert usable(run(followed(line, options)))


def test_poses_that_nothing_meets_in_order_are_to_blame_themselves():
    rows = [OPENING[0], OPENING[1], (12.5, 40, 20), OPENING[2]]
    limits = (Limits(box((-50, -100), (150, 20)), box((-60, -60), (60, 60)), kinds={"RR"}),)
    synthesis = synthesize(Task.from_rows(rows, angle_unit="deg", limits=limits))
    assert synthesis.outcome.code == "R309"
    assert not synthesis.causes
    assert "the poses are to blame" in synthesis.outcome.why


def test_a_keep_out_region_in_the_way_is_told_and_moved_out_of_it():
    wall = KeepOut(box((-300, 62), (300, 76)), "cabinet top")
    limits = Limits(box((-100, -160), (200, 60)), box((-120, -120), (120, 120)), kinds={"RR"})
    task = task_of(limits, surroundings=Surroundings((wall,), link_width=6))
    synthesis = synthesize(task)
    (weak,) = [each for each in synthesis.warnings if each.code == "W216"]
    (told,) = [each for each in synthesis.causes if each.limit.kind == "keep-out"]
    assert "'cabinet top' moved by" in weak.why
    moved = told.task.surroundings.keep_out[0].polygon.vertices - wall.polygon.vertices
    assert np.abs(moved - moved[0]).max() < 1e-9  # as a whole
    works = synthesize(told.task).usable[0]
    assert np.degrees(works.driven.least_over_range) >= 30 - 1e-6


def test_six_poses_are_told_the_kind_that_is_missing():
    rows = [(0, 0, 0), (12, 5, 20.5), (20, 14, 45), (24, 25, 70), (22, 38, 95), (15, 50, 120)]
    limits, asked = (Limits(kinds={"RP"}),), Requirements(transmission_deg=40)
    synthesis = synthesize(
        Task.from_rows(rows, angle_unit="deg", limits=limits, requirements=asked)
    )
    assert not synthesis.usable
    assert [each.option for each in synthesis.causes] == ["--kinds RR,RP"]
    assert synthesis.outcome.help == "use --kinds RR,RP"
    works = synthesize(synthesis.causes[0].task).usable[0]
    assert np.degrees(works.driven.least_over_range) >= 40 - 1e-6


def test_a_time_limit_ends_the_explanation():
    limits = Limits(box((-40, -60), (-20, -50)), box((-30, -30), (0, 0)), kinds={"RR"})
    short = synthesize(task_of(limits), time_limit=1e-3)
    assert short.outcome.code == "R309"
    assert not short.causes


@REGIONS
def test_a_region_wider_all_around_reaches_as_far_on_every_side(region):
    grown = wider_all_around(region, 2.0)
    if isinstance(region, Line):
        assert grown is None
        return
    corners, turn = region.corners(), np.linspace(0, 2 * np.pi, 24)
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)[:, None]
    assert grown.distance((corners + 1.99 * ring).reshape(-1, 2)).max() <= 1e-9
    assert grown.distance((corners + 6.0 * ring).reshape(-1, 2)).max() > 0


def test_points_beside_a_box_by_less_than_its_digits_need_no_room():
    region = box((0.1, 0.2), (10, 5))
    assert wider(region, np.array([(10 + 3e-14, 2.0)]), 1.0, task_of()) is None
    told = wider(region, np.array([(10.5, 2.0)]), 1.0, task_of())
    assert told.words == "0.5 mm further right, to x = 10.5"


@REGIONS
def test_a_wider_region_holds_the_points_and_the_region_itself(region):
    rng, task = np.random.default_rng(5), task_of()
    one = isinstance(region, Line | Point)
    for _ in range(20):
        points = rng.normal(scale=12, size=(1 if one else 2, 2))
        if region.distance(points).max() <= 0:
            continue
        told = wider(region, points, 1.0, task)
        slack = 0.1 * region.distance(points).max() if one else 1e-9
        assert told.region.distance(points).max() <= slack
        if not one:
            assert told.region.distance(region.corners()).max() <= 1e-9
        assert wider(told.region, told.near[None], 1.0, task) is None or one
        assert region_text(told.region)


def test_a_limit_is_taken_away_alone():
    task = task_of(
        Limits(box((0, 0), (1, 1)), length=(5, 9), kinds={"RR"}),
        requirements=Requirements(transmission_deg=40, footprint=box((0, 0), (2, 2))),
    )
    every = list(stated_limits(task))
    kinds = {each.kind for each in every}
    assert kinds == {"fixed pivot", "length", "kinds", "transmission", "footprint"}
    for each in every:
        rest = {other.kind for other in stated_limits(without(task, each, lambda _: None))}
        assert rest == kinds - {each.kind}
    assert without(task, StatedLimit("length"), lambda _: None).limits[0].length == (0, math.inf)


@pytest.mark.parametrize("case", some_of(list(seeds_with_linkage())[1:61], 1))
def test_what_is_told_of_a_tight_box_holds_against_brute_force(case):
    seed, known = case
    rows, boxes, number = tight_task(seed, known)
    told, answer = compared(rows, boxes, number, seed)
    assert not [each for each in told if each.startswith("option fails")]
    assert "none, and brute force has one" not in told
    for each in answer.causes:
        assert all(isinstance(d, RR) for d in (each.found.linkage.first, each.found.linkage.second))


HARDLY_TURNING = [(0, 0, 0), (6, 22, 2), (14, 43, 4), (25, 60, 6)]


def test_poses_that_hardly_turn_have_their_linkages_far_away():
    # Brute force finds 66 degrees nine spans away, and nothing within eight.
    task = Task.from_rows(HARDLY_TURNING, angle_unit="deg", length_unit="mm")
    best = synthesize(task).best
    assert math.degrees(best.driven.least_over_range) > 60
    assert misses(best.linkage, task.poses, 600.0).max() < 1e-5
    pivots = np.array([best.linkage.first.fixed_pivot, best.linkage.second.fixed_pivot])
    assert np.linalg.norm(pivots, axis=1).min() > 300


def test_what_boxes_near_such_poses_leave_is_told_with_the_boxes_that_are_needed():
    limits = Limits(box((-200, -180), (300, -60)), box((-200, -60), (300, 0)))
    task = Task.from_rows(HARDLY_TURNING, angle_unit="deg", length_unit="mm", limits=(limits,))
    answer = synthesize(task)
    assert answer.outcome.code == "R309"
    assert {cause.limit.kind for cause in answer.causes} == {"fixed pivot", "moving pivot"}
    freed = synthesize(answer.causes[-1].task)
    assert any(not each.shortcomings for each in freed.usable)
