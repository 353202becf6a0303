"""Saved results with faults: refused in few words, or read with what their dimensions do.

The campaign with thousands of files is `benchmarks/fuzz_results.py`.
"""

import copy
import itertools
import json
import random
from collections import Counter
from importlib import resources

import jsonschema
import pytest

from burmester import synthesize
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from tests.oracles.fuzzed_results import with_faults
from tests.oracles.result_verdicts import QUICK, judged
from tests.samples import samples

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


def test_what_the_package_writes_passes_schema_and_reader(trees, tmp_path):
    for number, tree in enumerate(trees):
        jsonschema.Draft202012Validator(SCHEMA).validate(tree)
        path = tmp_path / f"{number}.json"
        path.write_text(json.dumps(tree))
        synthesis = read_result(path).synthesis
        assert len(synthesis.linkages) == len(tree["linkages"])
        jsonschema.Draft202012Validator(SCHEMA).validate(plain(synthesis))


def test_a_sample_of_the_campaign(trees, tmp_path):
    verdicts = Counter()
    seeds = samples(90, 30)
    for seed in seeds:
        rng = random.Random(seed)
        verdicts[judged(with_faults(rng, rng.choice(trees)), tmp_path, rng.choice(QUICK))] += 1
    assert verdicts["E150"] > 0.05 * len(seeds)
    assert verdicts["exported"] > 0.2 * len(seeds)


MADE = ("id", "dyads", "sought")  # what a linkage is; all else follows, and is judged anew
COMPARED = ("usable", "position_error")  # of that, what a warning tells


def test_no_part_that_follows_from_the_dimensions_shuts_a_result_out(trees):
    rng, tree = random.Random(2), trees[0]
    sound = plain(read_result("-", json.dumps(tree).encode()).synthesis)["linkages"]
    keys = [key for key in tree["linkages"][0] if key not in MADE]
    assert {"quality", "coupler", "drives", *COMPARED} <= set(keys)
    for k, key in zip(itertools.cycle(range(len(sound))), keys, strict=False):
        for fault in (
            another(rng, tree["linkages"][k].get(key)),
            rng.choice(("x", -1e300, [], {})),
        ):
            changed = copy.deepcopy(tree)
            changed["linkages"][k][key] = fault
            read = read_result("-", json.dumps(changed).encode()).synthesis
            assert plain(read)["linkages"] == sound, (k, key, fault)
            told = [each.message for each in read.warnings if each.code == "W244"]
            assert not told or key in COMPARED
            assert bool(told) or key != "usable" or not isinstance(fault, bool)
            assert all(f"L{k + 1} " in each for each in told)


def another(rng, value):
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value * rng.choice((0.99, 1.01)) + rng.choice((1, 2))
    if isinstance(value, dict):
        key = rng.choice(list(value))
        return {**value, key: another(rng, value[key])}
    if isinstance(value, list):
        return [another(rng, each) for each in value] or ["change-point"]
    return {None: 0.125, "first": "second"}.get(value, "crank-rocker at a change point")
