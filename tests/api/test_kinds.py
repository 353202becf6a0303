"""Results of every kind: one class, whose linkages know their task and go the same ways."""

import re

import numpy as np
import pytest

import burmester
from burmester.errors import InputError
from burmester.synthesis.result import Synthesis

ROWS = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
SHOULDER = "case:motiongen-shoulder"


@pytest.fixture(scope="module")
def four_bars():
    return burmester.synthesize(burmester.read_task(SHOULDER))


@pytest.fixture(scope="module")
def six_bars():
    return burmester.synthesize_six_bars(ROWS, angle_unit="deg", length_unit="mm", chains=300)


@pytest.fixture(scope="module")
def generators():
    return burmester.synthesize_function("log10(x)", (1, 2), input_deg=60, output_deg=60, pairs=5)


def test_four_bars_and_six_bars_are_one_class_of_result(four_bars, six_bars):
    assert type(four_bars) is type(six_bars) is burmester.Result
    assert isinstance(six_bars, burmester.SixBarResult)
    assert isinstance(six_bars, Synthesis)
    assert isinstance(six_bars.best, burmester.FoundSixBar)
    assert list(six_bars) == list(six_bars.six_bars) == list(six_bars.synthesis.six_bars.found)
    assert len(six_bars.six_bars) == len(six_bars)
    assert six_bars.six_bars[0] is six_bars[0] is six_bars["s1"] is six_bars.best
    assert six_bars.usable == tuple(six_bars)
    assert six_bars.works
    assert not six_bars.determined


@pytest.mark.parametrize("name", ["four_bars", "six_bars"])
def test_a_linkage_knows_the_task_of_its_result(name, request, tmp_path):
    result = request.getfixturevalue(name)
    read = burmester.read_result(result.save(tmp_path / "a.json"))
    judged = burmester.judge(result.task, result[0])
    for every in (result, read, judged):
        assert all(each.task is every.task for each in every)
        assert every[0].unit == every.task.length_unit


def test_a_linkage_that_was_followed_knows_where_it_went(four_bars):
    task = four_bars.task
    rows = np.column_stack([task.poses.translation, np.degrees(task.poses.angle)])
    rows[0, 0] += 1e-3
    moved = burmester.Task.from_rows(rows, angle_unit="deg", length_unit=task.length_unit)
    followed = burmester.follow(four_bars, moved)
    assert followed.linkages
    assert all(each.task is moved for each in followed.linkages)


def test_a_six_bar_goes_where_a_four_bar_goes(six_bars, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    second = six_bars["S2"]
    path = second.export(tmp_path / "a.json")
    assert six_bars.export(tmp_path / "b.json", "S2").read_text() == path.read_text()
    with pytest.raises(InputError) as refused:
        second.export(tmp_path / "a.py")
    assert refused.value.code == "E198"
    figure, ax = pyplot.subplots()
    assert second.plot(ax) is figure
    assert ax.lines
    assert second.animate(seconds=0.4, width_px=120).title == "S2, a Watt I six-bar, and 5 poses"
    page = second._repr_html_()
    for name, length in second.lengths.items():
        if name in ("AC", "GH"):  # the links that have nothing but their length
            numbers = re.findall(rf"{name}</td><td[^>]*>([^<]*)", page)
            assert [float(each) for each in numbers] == [pytest.approx(length, rel=1e-6)]
    shown = six_bars._repr_mimebundle_()
    assert shown["image/svg+xml"] == six_bars[0]._repr_mimebundle_()["image/svg+xml"]
    assert all(each.id in shown["text/html"] for each in six_bars)


def test_generators_are_chosen_saved_and_shown_as_linkages_are(generators, tmp_path):
    assert list(generators) == list(generators.generators) == list(generators.candidates)
    assert generators[0] is generators["l1"] is generators[-len(generators)]
    assert generators.usable[0] is generators.best
    with pytest.raises(InputError) as refused:
        generators["L99"]
    assert refused.value.code == "E151"
    page = generators.report(tmp_path / "log.html").read_text()
    assert "<title>log</title>" in page
    read = burmester.read_result(generators.save(tmp_path / "a.json"))
    assert type(read) is type(generators)
    assert repr(read) == repr(generators)
    assert read.to_json() == generators.to_json()
