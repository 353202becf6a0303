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
    return synthesize_six_bars(
        task(request.param), SixBarOptions(kind="Watt I", chains=1000, most=4)
    )


@pytest.fixture(scope="module")
def tree(answer):
    return json.loads(json.dumps(synthesis_data(answer)))


def read(tree):
    return read_result("-", json.dumps(tree).encode())


def test_what_is_read_is_what_was_written(answer, tree):
    jsonschema.Draft202012Validator(SCHEMA).validate(tree)
    result = read(tree)
    every = result.synthesis.six_bars.found
    assert len(every) == len(answer.six_bars.found) > 0
    for saved, found in zip(every, answer.six_bars.found, strict=True):
        assert saved.id == found.id
        assert saved.driver == found.driver
        assert saved.drive == pytest.approx(found.drive, abs=1e-9)
        assert saved.transmission == pytest.approx(found.transmission, abs=1e-9)
        places, wanted = (each.body(found.drive) for each in (saved, found))
        assert np.abs(places.translation - wanted.translation).max() < 1e-9
    assert result.choose("s2").id == "S2"
    with pytest.raises(InputError, match="S99") as refused:
        result.choose("S99")
    assert refused.value.code == "E151"


def test_what_a_file_says_was_assumed_cannot_move_the_cursor(tree):
    hostile = copy.deepcopy(tree)
    hostile["six_bars"]["assumed"] = [{"message": "red\x1b[31m", "option": "--x\x1b[2J"}, {}, 3]
    ((message, option),) = read(hostile).synthesis.six_bars.assumed
    assert "red" in message
    assert "--x" in option
    assert "\x1b" not in message + option


def no_length(tree):
    del tree["lengths"]["GH"]


def word(tree):
    tree["body"]["E"] = ["x", 0]


def no_link(tree):
    tree["coupler"]["E"] = [0, 0]


def nowhere(tree):
    tree["lengths"]["GH"] = 1e9


@pytest.mark.parametrize("fault", [no_length, word, no_link, nowhere])
def test_one_that_cannot_be_used_is_left_out(tree, fault):
    wrong = copy.deepcopy(tree)
    fault(wrong["six_bars"]["found"][0])
    if len(wrong["six_bars"]["found"]) > 1:
        result = read(wrong)
        assert [each.id for each in result.synthesis.six_bars.found][:1] == ["S2"]
        assert "S1 cannot be used" in result.synthesis.warnings[-1].message
        with pytest.raises(InputError) as refused:
            result.choose("S1")
        assert refused.value.code == "E150"
    del wrong["six_bars"]["found"][1:]
    with pytest.raises(InputError) as refused:
        read(wrong)
    assert refused.value.code == "E150"
    assert "$.six_bars.found[0]" in refused.value.message


def moved_joint(tree):
    tree["coupler"]["D"][0] *= 1.3
    tree["lengths"] = {key: tree["lengths"][key] for key in ("AC", "GH")}


def worse(tree):
    tree["position_error"]["max"] = 0.1


@pytest.mark.parametrize("change", [moved_joint, worse])
def test_what_a_file_says_otherwise_is_told(tree, change):
    changed = copy.deepcopy(tree)
    change(changed["six_bars"]["found"][0])
    (told,) = [each for each in read(changed).synthesis.warnings if each.code == "W244"]
    assert told.message.startswith("judged anew, S1 ")


@pytest.mark.parametrize("key", ["drive_deg", "extent", "reserve_deg", "joints", "shortcomings"])
def test_what_follows_from_the_dimensions_is_not_read(tree, key):
    changed = copy.deepcopy(tree)
    changed["six_bars"]["found"][0][key] = "x"
    one, other = (synthesis_data(read(each).synthesis) for each in (tree, changed))
    assert one == other
