"""Six-bars in a result: written, read back, judged again."""

import copy
import json
from importlib import resources

import jsonschema
import numpy as np
import pytest

from burmester.errors import InputError
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from tests.sixbar.tasks import REACH, TURNING, task

SCHEMA = json.loads(resources.files("burmester").joinpath("io/synthesis.schema.json").read_text())


@pytest.fixture(scope="module", params=[TURNING, REACH[::2], REACH[::4]], ids=["5", "3", "2"])
def answer(request):
    return synthesize_six_bars(task(request.param), SixBarOptions(chains=1000, most=4))


@pytest.fixture(scope="module")
def tree(answer):
    return json.loads(json.dumps(synthesis_data(answer)))


def read(tree):
    return read_result("-", json.dumps(tree).encode())


def test_what_is_read_is_what_was_written(answer, tree):
    jsonschema.Draft202012Validator(SCHEMA).validate(tree)
    result = read(tree)
    assert len(result.six_bars) == len(answer.six_bars.found) > 0
    for saved, found in zip(result.six_bars, answer.six_bars.found, strict=True):
        assert saved.id == found.id
        assert saved.found.drive == pytest.approx(found.drive, abs=1e-9)
        assert saved.found.transmission == pytest.approx(found.transmission, abs=1e-9)
        places, wanted = (each.body(found.drive) for each in (saved.found, found))
        assert np.abs(places.translation - wanted.translation).max() < 1e-9
    assert result.choose_six_bar("s2").id == "S2"
    with pytest.raises(InputError, match="S99") as refused:
        result.choose_six_bar("S99")
    assert refused.value.code == "E151"


def moved_joint(tree):
    tree["coupler"]["D"][0] *= 1.01


def other_way(tree):
    tree["drive_deg"] = tree["drive_deg"][::-1]


def missing_drive(tree):
    tree["drive_deg"] = [*tree["drive_deg"], 0.0][:5][1:]


def no_length(tree):
    del tree["lengths"]["GH"]


def word(tree):
    tree["body"]["E"] = ["x", 0]


def other_id(tree):
    tree["id"] = "L1"


@pytest.mark.parametrize(
    "fault", [moved_joint, other_way, missing_drive, no_length, word, other_id]
)
def test_a_six_bar_that_does_not_do_it_is_refused(tree, fault):
    wrong = copy.deepcopy(tree)
    fault(wrong["six_bars"]["found"][0])
    with pytest.raises(InputError) as refused:
        read(wrong)
    assert refused.value.code == "E150"
    assert "$.six_bars.found[0]" in refused.value.message


def test_where_a_four_bar_is_needed_six_bars_are_told(tree):
    with pytest.raises(InputError, match="this result has six-bars") as at:
        read(tree).choose()
    assert at.value.code == "E151"
    assert "export" in at.value.help
