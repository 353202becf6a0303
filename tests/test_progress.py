"""A time limit ends searching, never the truth of what is told; a callback hears how far it is."""

import json
from itertools import pairwise

import numpy as np
import pytest

import burmester
from burmester import progress
from burmester.errors import InputError
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.progress import Progress, goes_on, limited, shown, step, time_for
from burmester.tasks.options import SynthesisOptions
from tests.oracles.hard_tasks import comes_by, noisy_task
from tests.oracles.witness import misses


class Clock:
    """A clock that goes on by one second whenever it is looked at: the same on every machine."""

    def __init__(self):
        self.now = -1

    def __call__(self):
        self.now += 1
        return self.now


@pytest.fixture
def clock(monkeypatch):
    monkeypatch.setattr(progress, "monotonic", ticking := Clock())
    return ticking


def unfinished(result):
    """The warnings that say what was not finished."""
    return [each.message for each in result.warnings if each.code == "W221"]


def hard():
    rows, _ = noisy_task(np.random.default_rng(3), 5)
    return rows


TASKS = {
    "ten poses": lambda: burmester.read_task("case:ge2012-exact"),
    "search": hard,
    "family": lambda: [(0, 0, 0), (0.3, 0.77, 0.785), (0.95, 1.1, 1.658)],
    "tolerances": lambda: burmester.read_task("case:ge2012-exact"),
}
OPTIONS = {"tolerances": {"manufacturing_tolerance": 0.05, "rounding_step": 0.1}}


def solved(name, **how):
    given = TASKS[name]()
    if not isinstance(given, burmester.Task):
        how["angle_unit"] = "rad"
    return burmester.synthesize(given, **how, **OPTIONS.get(name, {}))


@pytest.mark.parametrize(
    ("name", "looks"),
    [
        *(("ten poses", looks) for looks in (1, 4, 7)),
        *(("search", looks) for looks in (1, 10, 30)),
        *(("family", looks) for looks in (1, 9)),
        *(("tolerances", looks) for looks in (4, 12)),
    ],
)
def test_wherever_the_time_ends_what_is_told_is_true(name, looks, clock):
    """looks: how often the clock is looked at until the time is over."""
    result = solved(name, time_limit=looks)
    (message,) = unfinished(result)
    assert f"the time limit of {looks} s came before the end: " in message
    assert len(result)
    for found in result:
        if found.usable:
            assert comes_by(found), found.id
    best, length = result[0], result.length_per_radian
    told = best.error.combined(length)  # the witness looks at places along a sweep
    missed = misses(best.linkage, result.task.poses, length)
    assert (missed <= told + 1e-6 * np.ptp(result.task.poses.translation)).all()
    assert [each.rank for each in result] == list(range(1, len(result) + 1))


@pytest.mark.parametrize("name", ["ten poses", "family"])
def test_time_enough_changes_nothing(name):
    without, within = (solved(name, time_limit=limit) for limit in (None, 1e6))
    assert within.to_json() == without.to_json()
    assert not unfinished(within)


def test_less_time_never_makes_the_closest_linkage_closer(clock):
    """What is refined longer is nearer, and in the end it is the answer without a limit."""
    errors = []
    for looks in (1, 8, 20, 1000):
        clock.now = -1
        result = solved("ten poses", time_limit=looks)
        errors.append(min(each.combined_error for each in result))
    assert not unfinished(result)
    rounding = 1 + 1e-9  # of nearest places, which depends on where they are looked for from
    assert all(after <= before * rounding for before, after in pairwise(errors))
    assert errors[0] > errors[-1]
    assert errors[-1] == min(each.combined_error for each in solved("ten poses"))


def test_a_limit_that_has_passed_names_all_that_is_left_out(clock):
    (message,) = unfinished(solved("ten poses", time_limit=0.5))
    assert message == (
        "the time limit of 0.5 s came before the end: refining 10 linkages and comparing each "
        "pose with the others were left out"
    )


def test_what_was_made_in_a_hurry_can_be_saved_read_and_exported(clock, tmp_path):
    result = solved("ten poses", time_limit=6)
    (message,) = unfinished(result)
    path = result.save(tmp_path / "hurried.json")
    assert message in [each["message"] for each in json.loads(path.read_text())["warnings"]]
    again = read_result(str(path))
    assert [each.id for each in again.synthesis.linkages] == [each.id for each in result]
    assert result.export(tmp_path / "hurried.svg").stat().st_size


def test_improving_a_given_linkage_ends_too(clock):
    task = burmester.read_task("case:motiongen-shoulder")
    pivots = [((16.53, -5.91), (21.72, -6.41)), ((24.2, -8.7), (23.3, -18.7))]
    one = burmester.judge(task, pivots, improve=True, time_limit=0.5)
    assert len(one) == 1
    assert one.outcome.code == "R330"
    (message,) = unfinished(one)
    assert message.endswith("looking for better linkages near it was left out")
    clock.now = -1
    some = burmester.judge(task, pivots, improve=True, time_limit=12)
    assert "looking for better linkages near it was ended early" in unfinished(some)[0]
    assert some[0].combined_error == one[0].combined_error
    assert all(comes_by(found) for found in some)


@pytest.mark.parametrize("limit", [0, -1.0, np.nan, np.inf, "2", True, [1]])
def test_a_limit_that_is_no_time_is_refused(limit):
    with pytest.raises(InputError) as caught:
        SynthesisOptions(time_limit=limit)
    assert caught.value.code == "E134"
    assert "not a number of seconds above zero" in caught.value.message
    assert SynthesisOptions(time_limit=np.float32(2)).time_limit == 2.0


def test_a_callback_hears_what_begins_and_every_step():
    heard = []
    solved("search", progress=heard.append)
    texts = list(dict.fromkeys(each.text for each in heard))
    assert texts[:3] == ["looking at 5 poses", "looking for dyads", "refining 6 linkages"]
    assert "looking for linkages that work" in texts
    for each in heard:
        assert 0 <= each.number <= each.total
    text = "looking for linkages that work"
    numbers = [each.number for each in heard if each.text == text]
    assert numbers[0] == 0
    assert numbers[1:4] == [1, 2, 3]
    assert str(heard[0]) == "looking at 5 poses"
    assert Progress("drawing", 3, 9, "film") == ("drawing", 3, 9, "film")
    assert str(Progress("drawing", 3, 9, "film")) == "drawing, film 3 of 9"


class TooLongError(Exception):
    pass


def test_what_a_callback_raises_stops_it_and_comes_through():
    heard = []

    def stop(doing):
        heard.append(doing)
        if doing.number == 5 and doing.text.startswith("refining"):
            raise TooLongError

    with pytest.raises(TooLongError):
        solved("ten poses", progress=stop)
    assert heard[-1] == ("refining 10 linkages", 5, 8, "step")
    before = len(heard)
    solved("ten poses")
    assert len(heard) == before


def test_something_that_cannot_be_called_is_refused():
    with pytest.raises(InputError) as caught:
        solved("ten poses", progress=3)
    assert caught.value.code == "E134"
    assert "progress is 3" in caught.value.message


def test_only_what_may_be_ended_is(clock):
    """What has to be done is done; whole things are done or left out."""
    with limited(3) as watch:
        step("first")
        assert all(goes_on(k, 9) for k in range(1, 10))
        assert time_for("whole", whole=True)
        assert all(goes_on(k, 9) for k in range(1, 10))
        assert time_for("second")
        assert not goes_on(1, 9)
        step("a part at least", whole=False)
        assert not goes_on(1, 9)
        assert not time_for("third", whole=True)
        step("last")
        assert goes_on(1, 9)
    assert watch.cut == ["second", "a part at least"]
    assert watch.left_out == ["third"]
    assert goes_on(1, 1)  # nobody watches any more


def test_parts_with_steps_of_their_own_are_told_together():
    heard = []
    with shown(heard.append):
        assert time_for("looking around")
        assert goes_on(2, 4, "round", has_steps=True)
        goes_on(3, 60)
        step("writing")
        goes_on(1, 2, "page")
    assert list(map(str, heard)) == [
        "looking around",
        "looking around, round 2 of 4, step 3 of 60",
        "writing",
        "writing, page 1 of 2",
    ]


def test_the_object_for_machines_is_the_same_but_for_the_warning(clock):
    result = solved("ten poses", time_limit=1)
    data = synthesis_data(result)
    codes = [each["code"] for each in data["warnings"]]
    assert codes.count("W221") == 1
    assert data.keys() == synthesis_data(solved("ten poses")).keys()
