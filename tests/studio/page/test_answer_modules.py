"""What the panels compute: which linkage goes on as which, order, stages, curves of four poses."""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from burmester import Task, read_task, synthesize
from burmester.dyads.pivot_map import fixed_pivot_map, moving_pivot_map
from burmester.geometry.displacement import Displacement
from burmester.web.data import report_data
from burmester.wording import least_angle
from tests.oracles.page_modules import value

FOUR = np.array([(0, 0, 0), (30, 12, 20), (55, 40, 45), (60, 75, 80)], dtype=float)


@cache
def data_of(name):
    return report_data(synthesize(read_task(name)))


@cache
def four_poses():
    poses = Displacement(FOUR[:, :2], np.radians(FOUR[:, 2]))
    return poses, report_data(synthesize(Task(poses)))


LINKAGES = [
    {"id": "L1", "rank": 1, "worst": 0.3, "least": 40, "type": "a", "usable": True},
    {"id": "L2", "rank": 2, "worst": 0.1, "least": None, "type": "b", "usable": False},
    {"id": "L3", "rank": 3, "worst": None, "least": 70, "type": "a", "usable": True},
    {"id": "L4", "rank": 4, "worst": 0.1, "least": 10, "type": "a", "usable": False},
]


@pytest.mark.parametrize(
    ("wanted", "ids"),
    [
        ({}, "1234"),
        ({"order": "worst"}, "2413"),
        ({"order": "least"}, "3142"),
        ({"filter": "usable"}, "13"),
        ({"type": "a"}, "134"),
        ({"pinned": ["L4"]}, "4123"),
        ({"pinned": ["L4", "L2"], "order": "least"}, "4231"),
        ({"pinned": ["L3"], "filter": "pinned"}, "3"),
    ],
)
def test_cards_are_filtered_and_sorted_pinned_ones_first(wanted, ids):
    wanted = {"order": "rank", "filter": "all", "type": "", "pinned": [], **wanted}
    script = "return m.arranged(all, {...wanted, pinned: new Set(wanted.pinned)}).map((e) => e.id);"
    found = value("ordering.mjs", script, all=LINKAGES, wanted=wanted)
    assert "".join(found) == "".join(f"L{k}" for k in ids)


def test_two_linkages_are_at_the_same_pose_at_the_same_time():
    one, other = data_of("case:ge2012-exact")["linkages"][:2]
    script = """
    return one.pose_errors.map(({way, frame}) => m.frameAtStage(other, m.stageOf(one, way, frame)));
    """
    found = value("together.mjs", script, one=one, other=other)
    for at, row in zip(found, other["pose_errors"], strict=True):
        assert at == {"way": row["way"], "u": pytest.approx(row["frame"], abs=1e-6)}


def test_between_two_poses_the_other_linkage_is_at_the_same_share():
    way = {"round": True, "x": [0] * 101}
    one = {"ways": [way], "pose_errors": [{"way": 0, "frame": f} for f in (10, 20, 60)]}
    # The other one meets the second pose behind the place where its turn is cut open.
    other = {"ways": [way], "pose_errors": [{"way": 0, "frame": f} for f in (90, 6, 50)]}
    script = "return m.frameAtStage(other, m.stageOf(one, 0, u));"

    def at(u):
        return value("together.mjs", script, one=one, other=other, u=u)["u"]

    assert [at(u) for u in (10, 12.5, 15, 20, 40)] == pytest.approx([90, 94, 98, 6, 28])
    apart = {**other, "pose_errors": [{"way": None}, {"way": 0, "frame": 6}, {"way": None}]}
    assert value("together.mjs", script, one=one, other=apart, u=12) == {"way": 0, "u": 6}
    assert value("together.mjs", script, one=one, other={**apart, "pose_errors": []}, u=1) is None


@pytest.mark.parametrize("plane", ["F", "M"])
def test_a_pivot_on_a_burmester_curve_meets_all_four_poses(plane):
    poses, data = four_poses()
    family, best = data["family_map"], {"F": fixed_pivot_map, "M": moving_pivot_map}[plane]
    samples = np.array(family["fixed" if plane == "F" else "moving"])
    rng = np.random.default_rng(3)
    near = samples[np.abs(samples).max(axis=1) < 3 * data["scene"]]
    wanted = near[::9] + rng.normal(scale=0.02 * data["scene"], size=near[::9].shape)
    script = """
    return wanted.map((point) => {
      const near = m.nearestOnCurve(points, loops, point, scene);
      return [near.at, m.ontoCurve(poses, plane, near.at, scene)];
    });
    """
    found = value(
        "burmester_curves.mjs",
        script,
        wanted=wanted.tolist(),
        points=samples.tolist(),
        loops=family["loops"],
        poses=data["poses"],
        plane=plane,
        scene=data["scene"],
    )
    between, onto = np.array(found).swapaxes(0, 1)
    # The nearest place is no farther than the nearest sample.
    away = np.hypot(*(between - wanted).T)
    nearest = np.hypot(*(samples[:, None] - wanted).transpose(2, 0, 1)).min(axis=0)
    assert (away <= nearest + 1e-9).all()
    errors = best(poses, onto).rms_error
    assert np.nanmax(errors) < 1e-7 * data["scene"]
    assert np.nanmax(best(poses, between).rms_error) > 1e-5 * data["scene"]


def test_a_smooth_path_goes_through_its_points_and_closes_smoothly():
    turn = np.linspace(0, 2 * math.pi, 25)
    x, y = (100 * np.cos(turn)).tolist(), (100 * np.sin(turn)).tolist()
    script = "return m.smoothPath(X, Y, true);"
    path = value("../widget/smooth_path.mjs", script, X=x, Y=y)
    pieces = [list(map(float, each.split())) for each in path[1:].split("C")]
    assert [each[-2:] for each in pieces] == [
        pytest.approx([a, b], abs=0.006) for a, b in zip(x, y, strict=True)
    ]
    # Halfway between two points it is on the circle, too, and it leaves where it arrives.
    for start, (a, b, c, d, u, v) in pairwise(pieces):
        p, q = start[-2:]
        middle = (p + 3 * a + 3 * c + u) / 8, (q + 3 * b + 3 * d + v) / 8
        assert math.hypot(*middle) == pytest.approx(100, abs=0.02)
    first, last = pieces[1], pieces[-1]
    leaves = math.atan2(first[1] - pieces[0][1], first[0] - pieces[0][0])
    arrives = math.atan2(last[5] - last[3], last[4] - last[2])
    assert math.remainder(leaves - arrives, 2 * math.pi) == pytest.approx(0, abs=1e-3)


def test_a_followed_angle_is_rounded_down_as_the_road_rounds_it():
    angles = [39.66, 40.0, 0.04, 7.25, 90.0]
    script = "return angles.map((least) => m.leastOf({ followed: true, least }));"
    said = value("answers.mjs", script, angles=angles)
    assert said == [least_angle(math.radians(each)) for each in angles]


def test_a_card_tells_how_far_a_search_moved_its_linkage():
    script = "return cards.map(m.pastOf);"
    cards = [{"shift": 0.015}, {"was": "L3", "shift": 0.015}, {"isNew": True}, {"was": "L2"}, {}]
    said = value("result_card.mjs", script, cards=cards)
    assert said == ["moved 1.5 %", "was L3, moved 1.5 %", "new", "was L2", ""]
