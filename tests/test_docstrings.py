"""The examples in docstrings are run: each prints what its docstring says."""

import doctest
from importlib import import_module
from pathlib import Path

import pytest

import burmester

ROOT = Path(burmester.__file__).parent
MODULES = [
    ".".join(("burmester", *file.relative_to(ROOT).with_suffix("").parts)).removesuffix(".__init__")
    for file in sorted(ROOT.rglob("*.py"))
    if ">>> " in file.read_text("utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_a_module(name):
    done = doctest.testmod(import_module(name), optionflags=doctest.ELLIPSIS)
    assert done.attempted > 0
    assert done.failed == 0
