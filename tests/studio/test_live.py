"""What a hand and a rest of it bring: follow, solve, cancel, limit, and many at once (W10, W12)."""

import copy
import json
import os
import signal
import time

import numpy as np
import pytest

from burmester import follow, read_task, synthesize
from burmester.io import templates
from tests.oracles.studio import SECONDS, served


@pytest.fixture
def document(start):
    """The task that the studio opens on, to be changed."""
    return copy.deepcopy(start["document"])


@pytest.fixture
def tab(visitor):
    with visitor.live() as one:
        yield one


def python_task(document):
    return read_task("task.json", data=json.dumps(document).encode())


def linkages(data):
    return {each["id"]: each for each in data["linkages"]}


def pivots(led):
    """Fixed and moving pivots of two links, driver first."""
    return np.array([[*each["fixed_pivot"], *each["moving_pivot"]] for each in led])


def test_the_opening_task_is_solved_before_it_is_asked_for(tab, start):
    task = read_task("lid.toml", data=templates.text("lid-hinge").encode())
    expected = synthesize(task)
    solved = tab.ask("solve", document=start["document"], options={})
    assert solved["kind"] == "solved"
    assert solved["was"] == {}
    found = linkages(solved["result"])
    assert list(found) == [each.id for each in expected.linkages]
    for each in expected.linkages:
        assert found[each.id]["usable"] == each.usable
        first = each.driver_first.first
        assert found[each.id]["led"][0]["fixed_pivot"] == pytest.approx(first.fixed_pivot, abs=1e-9)


def test_a_hand_is_followed_as_the_package_follows(tab, document):
    tab.ask("solve", document=document, options={})
    answers = synthesize(python_task(document))
    for step in range(5):
        document["poses"][4]["x"] = round(document["poses"][4]["x"] + 0.1, 4)
        document["poses"][4]["angle"] = round(document["poses"][4]["angle"] - 0.05, 4)
        heard = tab.ask("follow", document=document, shown=["L1"], frames=61, every=True)
        answers = follow(answers, python_task(document))
        assert heard["kind"] == "followed"
        seen = linkages(heard)
        assert list(seen) == [each.id for each in answers.linkages]
        for each in answers.linkages:
            assert seen[each.id]["worst"] == pytest.approx(each.error.worst, rel=1e-6), step
            assert seen[each.id]["usable"] == each.usable
        assert [each["id"] for each in heard["changes"]] == [each.id for each in answers.changes]
        (way,) = [way for way in seen["L1"]["ways"] if way["poses"]]
        assert way["count"] == 61
        assert seen["L2"]["ways"] is None


def test_those_that_are_shown_are_judged_at_every_step(tab, document):
    """The others are judged in turn: after a while all were, and as if they always had been."""
    tab.ask("solve", document=document, options={})
    fresh = set()
    for _ in range(6):
        document["poses"][4]["x"] = round(document["poses"][4]["x"] + 0.1, 4)
        seen = linkages(tab.ask("follow", document=document, shown=["L1"]))
        assert seen["L1"]["fresh"]
        assert len({id for id, each in seen.items() if each["fresh"]}) < len(seen)
        fresh |= {id for id, each in seen.items() if each["fresh"]}
    assert fresh == set(seen)
    answers = synthesize(python_task(document))
    best = answers.linkages[0].error.worst
    every = linkages(tab.ask("follow", document=document, shown=["L1"], every=True))
    assert all(each["fresh"] for each in every.values())
    assert min(each["worst"] for each in every.values()) == pytest.approx(best, rel=0.02)


def test_a_pose_that_is_there_twice_is_drawn_twice(tab):
    """A pose was duplicated: both are met by the same place."""
    poses = [(0, 0, 0), (3, 1, 20), (3, 1, 20), (5, 4, 50), (4, 8, 70), (1, 9, 95), (0, 12, 110)]
    rows = [{"x": x, "y": y, "angle": angle} for x, y, angle in poses]
    document = {"angle_unit": "deg", "poses": rows}
    solved = tab.ask("solve", document=document, options={})
    for each in solved["result"]["linkages"]:
        rows = each["pose_errors"]
        assert len(rows) == 7
        assert rows[1]["transmission_deg"] == rows[2]["transmission_deg"]
    heard = tab.ask("follow", document=document, shown=["L1"], every=True)
    for seen in heard["linkages"]:
        start, count = seen["poses"]["start"], seen["poses"]["count"]
        columns = np.array(heard["numbers"][start : start + 6 * count]).reshape(6, count)
        assert count == 7
        assert np.array_equal(columns[:, 1], columns[:, 2], equal_nan=True)


def test_ways_pass_where_the_linkage_is(tab, document):
    """Each place of a way keeps both links their length: by the numbers of the frame alone."""
    tab.ask("solve", document=document, options={})
    document["poses"][3]["y"] -= 0.25
    heard = tab.ask("follow", document=document, options={}, shown=["L1"], frames=61)
    shown = linkages(heard)["L1"]
    for way in shown["ways"]:
        numbers = np.array(heard["numbers"][way["start"] : way["start"] + 3 * way["count"]])
        x, y, angle = numbers.reshape(3, -1)
        for link in shown["led"]:
            mx, my = link["moving_pivot"]
            px = x + mx * np.cos(angle) - my * np.sin(angle) - link["fixed_pivot"][0]
            py = y + mx * np.sin(angle) + my * np.cos(angle) - link["fixed_pivot"][1]
            assert np.allclose(np.hypot(px, py), link["radius"], rtol=1e-4)


def test_the_newest_of_a_hand_wins(tab, document):
    """Of many messages at once some are passed over, and the last one is answered."""
    tab.ask("solve", document=document, options={})
    for _ in range(30):
        document["poses"][4]["x"] += 0.01
        last = tab.say("follow", document=document, options={}, shown=[])
    heard = [tab.hear()]
    while heard[-1]["n"] != last:
        heard.append(tab.hear())
    followed = [each["n"] for each in heard if each["kind"] == "followed"]
    passed = {each["n"]: each["by"] for each in heard if each["kind"] == "superseded"}
    assert followed == sorted(followed)
    assert sorted([*followed, *passed]) == list(range(2, 32))  # each has one answer
    assert passed
    assert all(by == n + 1 for n, by in passed.items())


def test_a_hand_that_does_two_things_is_answered_in_both(tab, document):
    tab.ask("solve", document=document, options={})
    pivot = {"plane": "F", "at": [12, -17]}
    asked = [
        tab.say("follow", document=document, shown=[]),
        tab.say("place", document=document, pivots=[pivot]),
        tab.say("follow", document=document, shown=[]),
        tab.say("curve", document={**document, "poses": document["poses"][:4]}, judged=False),
    ]
    heard = {each["n"]: each["kind"] for each in (tab.hear() for _ in asked)}
    assert set(heard) == set(asked)
    assert heard[asked[1]] == "placed"
    assert heard[asked[2]] == "followed"
    assert heard[asked[3]] == "curve"


def test_what_cannot_be_followed_says_so(tab, document):
    assert tab.ask("follow", document=document, options={}, shown=[])["solve"] is True
    tab.ask("solve", document=document, options={})
    fewer = {**document, "poses": document["poses"][:-1]}
    heard = tab.ask("follow", document=fewer, options={}, shown=[])
    assert heard["kind"] == "refused"
    assert heard["solve"] is True
    assert "7 poses instead of 8" in heard["messages"][0]["message"]
    wrong = copy.deepcopy(document)
    wrong["poses"][1]["x"] = "1,5"
    heard = tab.ask("follow", document=wrong, options={}, shown=[])
    assert heard["messages"][0]["code"] == "E104"
    assert "solve" not in heard
    assert tab.ask("follow", document=document, options={}, shown=[])["kind"] == "followed"


def test_a_card_keeps_its_linkage(tab, document):
    """After a drag and a new search the same physical linkage is told by its earlier name."""
    tab.ask("solve", document=document, options={})
    for _ in range(8):
        document["poses"][5]["x"] = round(document["poses"][5]["x"] + 0.2, 4)
        document["poses"][5]["y"] = round(document["poses"][5]["y"] - 0.2, 4)
        heard = tab.ask("follow", document=document, shown=[], every=True)
    before = linkages(heard)
    solved = tab.ask("solve", document=document, options={})
    after = linkages(solved["result"])
    was = {new: old["id"] for new, old in solved["was"].items()}
    assert was
    assert len(set(was.values())) == len(was)
    for new, old in was.items():
        a, b = pivots(after[new]["led"]), pivots(before[old]["led"])
        assert min(np.abs(a - b).max(), np.abs(a - b[::-1]).max()) < 4.0  # mm, of 150
    for new in set(after) - set(was):
        for old in set(before) - set(was.values()):
            a, b = pivots(after[new]["led"]), pivots(before[old]["led"])
            assert min(np.abs(a - b).max(), np.abs(a - b[::-1]).max()) > 1.0


def test_a_frame_says_which_answer_it_goes_on_from(tab, document):
    """A frame on its way while a search ends is of the answer before."""
    tab.ask("solve", document=document, options={})
    first = tab.n
    assert tab.ask("follow", document=document)["from"] == first
    document["poses"][4]["x"] += 0.01
    solve = tab.say("solve", document=document, options={})
    while True:
        follow = tab.say("follow", document=document)
        heard, told = {}, None
        while follow not in heard:
            each = tab.hear()
            heard[each["n"]] = each
        told = heard[follow]["from"]
        if solve in heard and heard[solve]["kind"] == "solved":
            assert heard[solve]["was"]["L1"]["id"] == "L1"  # though the hand did not rest
        if told == solve:
            break
        assert told == first


def test_another_tab_has_answers_of_its_own(visitor, tab, document):
    tab.ask("solve", document=document, options={})
    with visitor.live() as other:
        assert other.ask("follow", document=document, options={})["kind"] == "refused"
        far = copy.deepcopy(document)
        far["poses"] = far["poses"][:5]
        del far["limits"]
        other.ask("solve", document=far, options={})
        assert other.ask("follow", document=far, options={})["kind"] == "followed"
        assert tab.ask("follow", document=document, options={})["kind"] == "followed"


def test_a_tab_that_is_opened_again_has_its_answers_at_once(visitor, document):
    """W15: back, and refreshed."""
    document["poses"][2]["x"] += 0.5
    with visitor.live() as tab:
        first = tab.ask("solve", document=document, options={})
        moved = copy.deepcopy(document)
        for _ in range(20):
            moved["poses"][4]["x"] += 0.5
            tab.ask("follow", document=moved, shown=[])
    with visitor.live() as tab:
        tab.say("solve", document=document, options={})
        again = tab.hear()
        assert again["kind"] == "solved"  # at once: no "solving" before it
        assert again["result"] == first["result"]
        # Where the first tab followed it to is forgotten.
        there = linkages(tab.ask("follow", document=document, shown=[], every=True))
        for id, each in linkages(first["result"]).items():
            assert there[id]["worst"] == pytest.approx(each["position_error"]["max"], rel=1e-4)
        assert tab.ask("follow", document=document, options={})["kind"] == "followed"


def test_pivots_that_are_placed_make_a_linkage(tab):
    task = read_task("case:ge2012-exact")
    rows = zip(task.poses.translation.tolist(), np.degrees(task.poses.angle).tolist(), strict=True)
    document = {"angle_unit": "deg", "poses": [{"x": x, "y": y, "angle": a} for (x, y), a in rows]}
    exact = synthesize(task).linkages[0]
    at = [each.dyad.fixed_pivot.tolist() for each in exact.dyads]
    one = tab.ask("place", document=document, options={}, pivots=[{"plane": "F", "at": at[0]}])
    assert one["linkage"] is None
    assert one["dyads"][0]["rms_error"] < 1e-4  # these poses are met as printed, to four digits
    expected = exact.dyads[0].dyad.moving_pivot
    assert one["dyads"][0]["moving_pivot"] == pytest.approx(expected, abs=1e-3)
    both = tab.ask(
        "place", document=document, options={}, pivots=[{"plane": "F", "at": each} for each in at]
    )
    assert both["cost"]["worst"] < 1e-3
    assert both["linkage"]["type"] == exact.type
    assert both["linkage"]["ways"]
    body = {"plane": "M", "at": expected.tolist()}
    again = tab.ask("place", document=document, options={}, pivots=[body])
    assert again["dyads"][0]["fixed_pivot"] == pytest.approx(at[0], abs=1e-3)
    same = tab.ask("place", document=document, options={}, pivots=[body, body])
    assert same["linkage"] is None
    assert same["messages"][0]["code"] == "E154"


@pytest.mark.parametrize("count", [2, 3])
def test_of_few_poses_a_pivot_is_free(tab, count):
    """The link of a placed pivot keeps its length at every pose."""
    poses = [
        {"x": 0, "y": 0, "angle": 0},
        {"x": 4, "y": 1, "angle": 35},
        {"x": 7, "y": 5, "angle": 80},
    ]
    document = {"angle_unit": "deg", "poses": poses[:count]}
    for plane in "FM":
        pivot = {"plane": plane, "at": [1.5, -2]}
        dyad = tab.ask("place", document=document, options={}, pivots=[pivot])["dyads"][0]
        kept = dyad["fixed_pivot" if plane == "F" else "moving_pivot"]
        assert kept == [1.5, -2]
        mx, my = dyad["moving_pivot"]
        for pose in poses[:count]:
            c, s = np.cos(np.radians(pose["angle"])), np.sin(np.radians(pose["angle"]))
            x = pose["x"] + mx * c - my * s - dyad["fixed_pivot"][0]
            y = pose["y"] + mx * s + my * c - dyad["fixed_pivot"][1]
            assert np.hypot(x, y) == pytest.approx(dyad["radius"], rel=1e-9)


@pytest.mark.parametrize("pivots", [[], None, [1], [{"plane": "G", "at": [1, 2]}],
                                    [{"plane": "F", "at": [1]}], [{"plane": "F", "at": ["1", 2]}],
                                    [{"plane": "F", "at": [1, 2]}] * 3])  # fmt: skip
def test_what_is_no_pivot_is_refused(tab, document, pivots):
    heard = tab.ask("place", document=document, options={}, pivots=pivots)
    assert heard["messages"][0]["code"] == "E153"


def test_four_poses_have_a_curve(tab, document):
    """Every dyad of the curve meets the four poses: by the definition of a link."""
    poses = document["poses"][::2]
    four = {"angle_unit": "deg", "poses": poses}
    for judged in (True, False):
        heard = tab.ask("curve", document=four, options={}, judged=judged)
        assert heard["kind"] == "curve"
        for loop in heard["loops"]:
            assert ("class" in loop) == judged
            for fixed, moving, length in zip(
                loop["fixed"], loop["moving"], loop["length"], strict=True
            ):
                if None in (*fixed, *moving, length) or abs(length) > 1e4:
                    continue
                for pose in poses:
                    turn = np.radians(pose["angle"])
                    x = pose["x"] + moving[0] * np.cos(turn) - moving[1] * np.sin(turn)
                    y = pose["y"] + moving[0] * np.sin(turn) + moving[1] * np.cos(turn)
                    away = np.hypot(x - fixed[0], y - fixed[1])
                    assert away == pytest.approx(length, rel=1e-6)
    assert tab.ask("curve", document=document, options={})["messages"][0]["code"] == "E121"


def test_what_is_no_message_is_refused(tab):
    for text in ("", "[]", "{", '{"n": "1"}', '{"n": -1}', '{"n": true}', '{"n": 1e3}', "\0"):
        tab.socket.send(text)
        assert tab.hear()["kind"] == "refused"
    for do in (None, "quit", "open", "stand", 1, ["solve"]):
        assert tab.ask(do)["kind"] == "refused"
    tab.socket.send(b"\0\1\2")
    assert tab.hear()["kind"] == "refused"
    for given in ({}, {"document": None}, {"document": [1]}, {"document": {"poses": 3}}):
        assert tab.ask("solve", **given)["kind"] == "refused"


def endless():
    """A task that takes much longer than a second."""
    t = np.linspace(0, 6, 9000)
    rows = np.stack([50 * np.cos(t) + 9 * np.sin(3 * t), 40 * np.sin(2 * t), 60 * np.sin(t)], -1)
    poses = [{"x": x, "y": y, "angle": a} for x, y, a in rows.round(3).tolist()]
    regions = [
        {"fixed_pivot": {"box": [[0, 0], [9, 9]]}},
        {"fixed_pivot": {"box": [[9, 0], [20, 9]]}},
    ]
    return {"length_unit": "mm", "angle_unit": "deg", "poses": poses, "limits": regions}


@pytest.fixture(scope="module")
def hasty(five, tmp_path_factory):
    """A studio that kills what takes longer than three seconds."""
    with served(five, "--time-limit", "3", home=tmp_path_factory.mktemp("hasty")) as visitor:
        yield visitor


def is_solved(tab, document):
    """Whether a task is solved; on a busy machine three seconds may be over before.

    Each try leaves the worker that takes the place of a killed one more time to begin.
    """
    for tries in range(9):
        time.sleep(tries)
        if tab.ask("solve", document=document, options={})["kind"] == "solved":
            return True
    return False


def test_what_takes_too_long_is_ended_and_told(hasty):
    """W12."""
    with hasty.live() as tab:
        begun = time.monotonic()
        heard = tab.ask("solve", document=endless(), options={"norm": "worst"})
        assert heard["kind"] == "limit"
        assert "3 s" in heard["message"]
        assert time.monotonic() - begun > 2.9
        document = hasty.http.get("/start").json()["document"]
        assert is_solved(tab, document)


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
def test_what_never_ends_is_killed(hasty):
    """W12: a process that hears nothing any more."""
    document = hasty.http.get("/start").json()["document"]
    with hasty.live() as tab:
        tab.ask("solve", document=document, options={})
        before, since = hasty.workers(), time.monotonic()
        while time.monotonic() < since + 3:  # those that take the place of killed ones have begun
            time.sleep(0.1)
            if set(now := hasty.workers()) != set(before):
                before, since = now, time.monotonic()
        for pid in before:
            os.kill(pid, signal.SIGSTOP)
        document["poses"][1]["x"] += 1
        assert tab.ask("solve", document=document, options={})["kind"] == "limit"
        end = time.monotonic() + SECONDS
        while set(before) <= set(hasty.workers()) and time.monotonic() < end:
            time.sleep(0.05)
        gone = set(before) - set(hasty.workers())
        assert len(gone) == 1
        for pid in set(before) - gone:
            os.kill(pid, signal.SIGCONT)
        assert is_solved(tab, document)


def test_fifty_at_once_and_the_page_answers(hasty):
    """W12: each tab wants an answer of its own, and one of them has none."""
    document = hasty.http.get("/start").json()["document"]
    tabs = [hasty.live() for _ in range(50)]
    try:
        opened = [tab.__enter__() for tab in tabs]
        opened[0].say("solve", document=endless(), options={"norm": "worst"})
        for number, tab in enumerate(opened[1:]):
            document["poses"][1]["x"] += number / 1e5
            tab.say("solve", document=document, options={})
        for _ in range(10):
            assert hasty.http.get("/").status_code == 200
            assert hasty.http.get("/start").status_code == 200
        kinds = [tab.until("solved", "limit")["kind"] for tab in opened]
        assert kinds[0] == "limit"
        for tab, kind in zip(opened[1:], kinds[1:], strict=True):
            assert kind == "solved" or is_solved(tab, document)
        assert len(hasty.workers()) <= 10  # not a process for every tab
    finally:
        for tab in tabs:
            tab.__exit__(None, None, None)


def test_a_search_is_called_off(visitor, tab):
    """By the page, by another search, and by a tab that is closed."""
    tab.say("solve", document=endless(), options={})
    tab.until("solving", "progress")
    first = tab.n
    assert tab.ask("cancel")["kind"] == "cancelled"
    tab.say("solve", document=endless(), options={})
    tab.until("solving")
    poses = [{"x": k**2, "y": 3 * k, "angle": 10 * k} for k in range(5)]
    older = tab.n
    tab.say("solve", document={"angle_unit": "deg", "poses": poses}, options={})
    assert tab.until("superseded", n=older)["by"] == tab.n  # each message has one last answer
    assert tab.until("solved")
    with visitor.live() as other:
        other.say("solve", document=endless(), options={})
        other.until("solving")
    end = time.monotonic() + SECONDS
    assert tab.ask("solve", document={"angle_unit": "deg", "poses": poses[:4]}, options={})["kind"]
    assert time.monotonic() < end
    assert first < tab.n
