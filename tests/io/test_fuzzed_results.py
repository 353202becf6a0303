"""Saved results with faults: refused in few words, or whole; never taken with a contradiction.

The campaign with thousands of files is `benchmarks/fuzz_results.py`.
"""

import copy
import json
import random
from collections import Counter
from importlib import resources

import jsonschema
import pytest

from burmester import synthesize
from burmester.errors import InputError
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.io.saved_model import written_result
from tests.oracles.fuzzed_results import part, places, with_fault, with_faults
from tests.oracles.result_verdicts import QUICK, judged

SCHEMA = json.loads(resources.files("burmester").joinpath("io/synthesis.schema.json").read_text())


def plain(found):
    return json.loads(json.dumps(synthesis_data(found)))


@pytest.fixture(scope="module")
def trees(tmp_path_factory):
    """Results of a pole, of limits, of sliders, with a spread, rounded and with proofs."""
    gear = tmp_path_factory.mktemp("task") / "gear.toml"
    gear.write_text(templates.text("landing-gear"))
    shoulder = read_task("case:motiongen-shoulder")
    return [
        plain(synthesize(shoulder)),
        plain(synthesize(read_task(gear))),
        plain(synthesize(read_task("case:motiongen-mixed5"))),
        plain(synthesize(shoulder, rounding_step=0.5, manufacturing_tolerance=0.05)),
        plain(synthesize(shoulder, certify=True)),
    ]


def test_what_the_package_writes_passes_schema_model_and_reader(trees, tmp_path):
    for number, tree in enumerate(trees):
        jsonschema.Draft202012Validator(SCHEMA).validate(tree)
        assert written_result(tree, "").linkages
        path = tmp_path / f"{number}.json"
        path.write_text(json.dumps(tree))
        assert len(read_result(path).linkages) == len(tree["linkages"])


def test_what_the_schema_refuses_the_model_refuses(trees):
    validator = jsonschema.Draft202012Validator(SCHEMA)
    rng, refused = random.Random(1), Counter()
    for _ in range(400):
        tree, path = with_fault(rng, rng.choice(trees))
        by_schema = not isinstance(tree, dict) or not validator.is_valid(tree)
        try:
            written_result(tree, "")
            by_model = False
        except InputError as error:
            by_model = error.code == "E150"
        assert by_model or not by_schema, (path, part(tree, path[:-1]))
        refused[by_schema, by_model] += 1
    assert refused[True, True] > 120
    assert refused[False, False] > 50
    assert refused[False, True] < 20  # half characters, and numbers such as 1.0 for whole ones


def test_a_sample_of_the_campaign(trees, tmp_path):
    verdicts = Counter()
    for seed in range(400):
        rng = random.Random(seed)
        verdicts[judged(with_faults(rng, rng.choice(trees)), tmp_path, rng.choice(QUICK))] += 1
    assert verdicts["E150"] > 60
    assert verdicts["exported"] > 5


# What follows from the rest of a linkage: none of it can be changed alone.
DETERMINED = (
    "id",
    "rank",
    "usable",
    "driver",
    "type",
    "possible_types",
    "rms_error",
    "max_error",
    "rms",
    "max",
    "ground",
    "driver",
    "coupler",
    "follower",
    "turns_fully",
    "range",
    "transmission_deg",
    "extent",
    "sensitivity",
    "driver_turn_deg",
    "defects",
    "radius",
)


def test_no_part_that_follows_from_the_others_can_be_changed_alone(trees, tmp_path):
    rng, path, codes = random.Random(2), tmp_path / "result.json", Counter()
    tree = trees[0]
    for place in places(tree["linkages"], ("linkages",)):
        if place[-1] not in DETERMINED or "rounded" in place:
            continue
        changed = copy.deepcopy(tree)
        parent, old = part(changed, place[:-1]), part(changed, place)
        parent[place[-1]] = another(rng, old)
        path.write_text(json.dumps(changed))
        with pytest.raises(InputError) as caught:
            read_result(path)
        assert caught.value.code in ("E150", "E152"), place
        assert "$." in f"{caught.value.message} {caught.value.why}"
        codes[caught.value.code] += 1
    assert codes["E152"] > 100


def another(rng, value):
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value * rng.choice((0.99, 1.01)) + rng.choice((1, 2))
    if isinstance(value, list):
        return [*value, *value] if value and isinstance(value[0], dict) else ["change-point"]
    words = {"first": "second", "second": None, None: 0.125}
    return words.get(value, "crank-rocker" if value != "crank-rocker" else "double-crank")
