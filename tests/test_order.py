"""Which tests are taken, and in which order, by names of tests that are there."""

import json
from types import SimpleNamespace

import pytest

from tests import conftest
from tests.samples import EVERY, share

CAMPAIGN = "tests/tasks/test_motion_class.py::test_100_centres_of_rotation"
PAGE, LIGHT = "tests/report/test_report.py::test_page", "tests/test_wording.py::test_words"


class Item:
    def __init__(self, function, case, *fixtures):
        self.nodeid, self.fixturenames, self.marks = f"{function}[{case}]", fixtures, []
        self.path, self.add_marker = function.partition("::")[0], self.marks.append


@pytest.fixture
def taken(monkeypatch):
    """The items that are run, of 50 of each of three functions; and how many are left out."""
    weights = SimpleNamespace(read_text=lambda: json.dumps({LIGHT: 9}))
    monkeypatch.setattr(conftest, "WEIGHTS", weights)
    monkeypatch.delenv(conftest.DAY, raising=False)
    left_out = []
    hook = SimpleNamespace(pytest_deselected=lambda *, items: left_out.extend(items))
    every = [(CAMPAIGN,), (PAGE, "browser"), (LIGHT,)]
    items = [Item(each[0], k, *each[1:]) for k in range(50) for each in every]
    conftest.pytest_collection_modifyitems(SimpleNamespace(hook=hook), items)
    return items, left_out


def test_a_sample_of_a_campaign_is_run_and_all_else(taken):
    items, left_out = taken
    assert len(left_out) == (0 if EVERY else 40)
    assert all(item.marks == ["campaign"] for item in left_out)
    assert [share(count) for count in (1, 3, 10, 50)] == (
        [1, 3, 10, 50] if EVERY else [1, 1, 2, 10]
    )
    assert [item.marks for item in items if item.nodeid.startswith(LIGHT)] == [["cross"]] * 50
    assert [item.marks for item in items if item.nodeid.startswith(PAGE)] == [["unit"]] * 50


def test_files_stay_together_those_in_a_browser_first_and_then_the_heavy_ones(taken):
    files = list(dict.fromkeys(item.path for item in taken[0]))
    assert files == [each.partition("::")[0] for each in (PAGE, LIGHT, CAMPAIGN)]
    places = [files.index(item.path) for item in taken[0]]
    assert places == sorted(places)
