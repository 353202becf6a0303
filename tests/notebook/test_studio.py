"""The widget without a page: what Python sets, and what a page would ask, by its messages."""

import asyncio
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import burmester
from burmester import Displacement, InputError, Limits, Point
from burmester.live.document import task_of
from burmester.notebook import Studio
from tests.oracles.studio import header_of

SHOULDER, TEN = "case:motiongen-shoulder", "case:ge2012-exact"


NO_LINK = Limits(fixed_pivot=Point((0, 0)))  # of two dyads: E132 comes from the search


class Page:
    """Who asks a widget what a page would ask, and keeps what it is told."""

    def __init__(self, widget, view="a"):
        self.widget, self.view, self.n, self.told = widget, view, 0, []
        widget.send = self.take
        self.ask("open")
        self.document = self.last("opened")["document"]

    def take(self, message, buffers=None):
        if message["view"] in (None, self.view):
            self.told.append({**message, "buffers": buffers})

    def ask(self, do, **more):
        self.n += 1
        message = {"view": self.view, "n": self.n, "do": do, **more}
        self.widget._handle_custom_msg(message, [])
        return self.n

    def last(self, kind):
        return next(each for each in reversed(self.told) if each["kind"] == kind)

    def kinds(self, n):
        return [each["kind"] for each in self.told if each.get("n") == n]

    def moved(self, by, pose=1):
        """The document with a pose moved along x."""
        poses = [dict(each) for each in self.document["poses"]]
        poses[pose]["x"] += by
        return {**self.document, "poses": poses}


@pytest.fixture
def widget():
    return Studio(burmester.read_task(SHOULDER))


def numbers(result):
    """All that a result says, as text; times are no part of it."""
    return result.to_json()


def places(task):
    return np.column_stack([task.poses.translation, task.poses.angle])


def changes(widget):
    """The names of what changes from now on, in their order, with the new values."""
    seen = []
    for name in ("task", "result", "selected"):
        widget.observe(lambda change: seen.append((change["name"], change["new"])), name)
    return seen


def test_it_opens_on_what_synthesize_says(widget):
    task = burmester.read_task(SHOULDER)
    assert numbers(widget.result) == numbers(burmester.synthesize(task))
    assert np.array_equal(places(widget.task), places(task))
    assert (widget.selected, widget.linkage) == ("L1", widget.result["L1"])


def test_it_takes_rows_and_options_and_opens_on_a_lid():
    rows = [(-3.97, -2.63, 37.2), (-0.22, -0.32, 27.5), (3.33, 3.96, 8.2), (7.72, 10.0, -14.9)]
    options = {"angle_unit": "deg", "length_unit": "mm", "prefer": "size"}
    widget = Studio(rows, **options)
    assert numbers(widget.result) == numbers(burmester.synthesize(rows, **options))
    assert Studio().result.usable


def test_a_task_that_is_set_has_its_result_at_once_and_observers_hear(widget):
    seen, task = changes(widget), burmester.read_task(TEN)
    widget.observe(lambda change: seen.append(("met", widget.result.task is change["new"])), "task")
    widget.selected = "L2"
    widget.task = task
    assert numbers(widget.result) == numbers(burmester.synthesize(task))
    assert widget.selected in [each.id for each in widget.result]
    assert [name for name, _ in seen].count("result") == 1
    assert ("task", widget.task) in seen
    assert ("met", True) in seen


@pytest.mark.parametrize(
    ("task", "code"),
    [
        ([(0, 0, 0), (1, 0, 10)], "E110"),
        (replace(burmester.read_task(TEN), limits=(NO_LINK,)), "E132"),
        ("no task", "E110"),
        (None, "E110"),
        ([(np.nan, 0, 0)], "E110"),
    ],
)
def test_a_bad_task_is_refused_and_all_stays(widget, task, code):
    before = widget.task, widget.result, widget.selected
    seen = changes(widget)
    with pytest.raises(InputError) as raised:
        widget.task = task
    assert raised.value.code == code
    assert (widget.task, widget.result, widget.selected) == before
    assert seen == []


def test_a_linkage_is_selected_by_id_or_rank(widget):
    seen = changes(widget)
    widget.selected = "l3"
    widget.selected = 1
    assert seen == [("selected", "L3"), ("selected", "L2")]
    for wrong, code in (("L99", "E151"), (77, "E151"), (None, "E125"), (1.5, "E125")):
        with pytest.raises(InputError) as raised:
            widget.selected = wrong
        assert (raised.value.code, widget.selected) == (code, "L2")


def test_a_result_that_is_there_is_shown(widget):
    page = Page(widget)
    result = burmester.synthesize(burmester.read_task(TEN))
    widget.result = result
    assert widget.result is result
    assert widget.task is result.task
    page.ask("solve", document=page.last("task")["document"])
    assert len(page.last("solved")["result"]["linkages"]) == len(result)
    with pytest.raises(InputError, match="result"):
        widget.result = "L1"


def test_a_closed_widget_goes_on(widget):
    widget.close()
    widget.task = burmester.read_task(TEN)
    widget.selected = "L2"
    assert widget.linkage.id == "L2"
    assert len(widget.result.task.poses.angle) == 10


def test_what_a_page_drags_python_has(widget):
    widget.selected = "L2"
    page, seen = Page(widget), changes(widget)
    page.ask("solve", document=page.document)
    moved = page.moved(0.01)
    n = page.ask("follow", document=moved, shown=["L1"])
    header = header_of(page.last("followed")["buffers"][0])
    assert (header["n"], header["from"]) == (n, 2)
    assert [name for name, _ in seen] == ["task"]
    assert widget.task.poses.translation[1, 0] == pytest.approx(
        page.document["poses"][1]["x"] + 0.01
    )
    again = burmester.follow(widget.result, widget.task)
    worst = {each.id: each.error.worst for each in again.linkages}
    assert header["linkages"][0]["worst"] == pytest.approx(worst["L1"], abs=1e-9)
    page.ask("solve", document=moved)
    assert numbers(widget.result) == numbers(burmester.synthesize(task_of(moved)))
    assert widget.result.task is widget.task
    # The linkage that was shown is shown, whatever its id is by now.
    assert page.last("solved")["was"][widget.selected]["id"] == "L2"


def test_what_a_page_picks_python_has(widget):
    page = Page(widget)
    basis = page.ask("solve", document=page.document)
    page.ask("choose", id="L3", basis=basis)
    assert widget.selected == "L3"
    page.ask("choose", id="L2", basis=basis - 1)  # of an older answer
    page.ask("choose", id="L99", basis=basis)
    assert widget.selected == "L3"


def test_what_python_sets_every_page_is_told(widget):
    page = Page(widget)
    page.ask("solve", document=page.document)
    widget.selected = "L2"
    assert page.last("chosen")["id"] == "L2"
    moved = widget.task.poses.translation + np.array([0.02, 0])
    widget.task = replace(widget.task, poses=Displacement(moved, widget.task.poses.angle))
    document = page.last("task")["document"]
    assert document["poses"][0]["x"] == pytest.approx(moved[0, 0])
    n = page.ask("solve", document=document)
    assert page.kinds(n) == ["solved"]  # nothing is looked for twice


def test_a_task_of_a_page_that_cannot_be_solved_is_told(widget):
    page = Page(widget)
    one = {**page.document, "poses": page.document["poses"][:1]}
    n = page.ask("solve", document=one)
    assert page.kinds(n) == ["solving", "refused"]
    assert page.last("refused")["messages"][0]["code"] == "E120"
    n = page.ask("follow", document=one, shown=[])
    assert page.kinds(n) == ["refused"]
    assert len(widget.result.task.poses.angle) == 5


def test_of_follows_that_wait_the_newest_is_answered(widget):
    page = Page(widget)
    page.ask("solve", document=page.document)

    async def four():
        asked = [page.ask("follow", document=page.moved(k / 1000), shown=["L1"]) for k in range(4)]
        await asyncio.sleep(0)
        while widget._pages._under_way:
            await asyncio.sleep(0.001)
        return asked

    asked = asyncio.run(four())
    assert [page.kinds(n) for n in asked[:3]] == [["superseded"]] * 3
    assert header_of(page.last("followed")["buffers"][0])["n"] == asked[3]
    assert widget.task.poses.translation[1, 0] == pytest.approx(page.moved(0.003)["poses"][1]["x"])


def test_where_a_hand_comes_back_linkages_are_there_again(widget):
    page = Page(widget)
    page.ask("solve", document=page.document)
    page.ask("follow", document=page.moved(5), shown=["L1"])
    gone = {each["id"] for each in header_of(page.last("followed")["buffers"][0])["vanished"]}
    page.ask("solve", document=page.document)
    page.ask("follow", document=page.moved(0.001), shown=["L1"])
    there = {each["id"] for each in header_of(page.last("followed")["buffers"][0])["linkages"]}
    assert "L1" in gone & there


@pytest.mark.parametrize("back", ["solve", "follow"])
def test_where_a_hand_comes_back_python_has_the_task_of_the_result_again(widget, back):
    page = Page(widget)
    page.ask("solve", document=page.document)
    page.ask("follow", document=page.moved(0.003), shown=["L1"])
    assert widget.task is not widget.result.task
    page.ask(back, document=page.document, shown=["L1"])
    assert widget.task is widget.result.task


def test_a_search_that_ends_while_a_hand_goes_on_leaves_the_task_to_the_hand(widget):
    page = Page(widget)
    page.ask("solve", document=page.document)
    solved, last = page.moved(0.01), page.moved(0.02)

    async def both():
        page.ask("solve", document=solved)
        page.ask("follow", document=last, shown=[])
        while widget._pages._under_way:
            await asyncio.sleep(0.001)

    asyncio.run(both())
    assert np.array_equal(places(widget.result.task), places(task_of(solved)))
    assert np.array_equal(places(widget.task), places(task_of(last)))


@pytest.mark.parametrize("hears", [True, False], ids=["at once", "too late"])
def test_a_newer_search_calls_off_the_one_before(widget, hears):
    page, seen, begun, found = Page(widget), changes(widget), [], []
    page.ask("solve", document=page.document)
    last, solved = page.moved(0.02), widget.solved

    def kept(task, progress):
        begun.append(task)
        found.append(solved(task, progress=progress if hears else None))
        return found[-1]

    widget.solved = kept

    async def two():
        first = page.ask("solve", document=page.moved(0.01))
        while not (hears or begun):
            await asyncio.sleep(0.001)
        followed = page.ask("follow", document=last, shown=[])
        second = page.ask("solve", document=last)
        while widget._pages._under_way:
            await asyncio.sleep(0.001)
        return first, followed, second

    first, followed, second = asyncio.run(two())
    assert "solved" not in page.kinds(first)
    assert page.kinds(second)[-1] == "solved"
    kinds = [each["kind"] for each in page.told if each.get("n") in (followed, second)]
    assert kinds.index("followed") < kinds.index("solved")  # a hand need not wait for a search
    assert len(found) == (1 if hears else 2)
    assert [name for name, _ in seen].count("result") == 1
    assert numbers(widget.result) == numbers(burmester.synthesize(task_of(last)))


def test_what_an_observer_raises_ends_nothing(widget, capsys):
    page = Page(widget)
    page.ask("solve", document=page.document)

    def fail(change):
        raise RuntimeError("an observer's own fault")

    widget.observe(fail, "task")
    n = page.ask("follow", document=page.moved(0.01), shown=[])
    assert page.kinds(n) == ["followed"]
    assert "an observer's own fault" in capsys.readouterr().err


def test_it_shows_itself_where_no_widget_is_shown(widget):
    widget.selected = "L2"
    whole = widget._repr_mimebundle_()
    bundle = whole[0] if isinstance(whole, tuple) else whole
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert "selected L2: crank-rocker" in bundle["text/plain"]
    assert "<svg" in bundle["text/html"]
    assert "<script" not in bundle["text/html"]
    assert bundle["text/html"] == widget.still == widget.linkage._repr_html_()


def test_without_anywidget_it_says_what_to_install():
    code = "import sys; sys.modules['anywidget'] = None; import burmester; burmester.notebook"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert ran.returncode != 0
    assert "E130" in ran.stderr
    assert 'pip install "burmester[notebook]"' in ran.stderr
