"""The lists beside the tests name what there is: else they would do nothing, unseen."""

import re
import tomllib
from pathlib import Path

import pytest

from tests.planted import faults

TESTS = Path(__file__).parents[1]
FAULTS = faults()


def is_there(name):
    file, _, function = name.partition("::")
    text = (TESTS.parent / file).read_text("utf-8")
    return not function or re.search(rf"(?m)^def {function.partition('[')[0]}\(", text)


def test_campaigns_are_tests():
    layers = tomllib.loads((TESTS / "layers.toml").read_text("utf-8"))
    named = [*layers["campaign"], *layers["sample"], *layers["nightly"], *layers["daily"]]
    assert [name for name in named if not is_there(name)] == []
    assert len(set(named)) == len(named) > 40


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.what)
def test_a_fault_can_be_planted(fault):
    """`python -m tests.planted` does it, and sees the test turn red."""
    assert fault.planted()
    assert all(map(is_there, fault.test.split()))


def test_there_are_faults_in_many_rooms():
    assert len(FAULTS) >= 40
    assert len({fault.room for fault in FAULTS}) >= 15
