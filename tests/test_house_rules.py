"""Rules for tests and benchmarks, read from their sources: each could be broken unseen.

No test imports another test: what two of them need stands in `tests/oracles`.  Nobody outside the
package uses a private name of it: private behaviour is tested through the public door.
"""

import ast
import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILES = [
    file for folder in ("tests", "benchmarks") for file in sorted((ROOT / folder).rglob("*.py"))
]


def private(name):
    return name.startswith("_") and not (name.startswith("__") and name.endswith("__"))


def imported(tree):
    """Each imported name as (module, name, what it is called here); name "" for whole modules."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for each in node.names:
                yield each.name, "", each.asname or each.name.partition(".")[0]
        elif isinstance(node, ast.ImportFrom):
            for each in node.names:
                yield "." * node.level + (node.module or ""), each.name, each.asname or each.name


def offences(source):
    """What a source does against the rules, as text."""
    tree, wrong, ours = ast.parse(source), [], set()
    for module, name, called in imported(tree):
        whole = f"{module}.{name}" if name else module
        if module.startswith(".") or any(part.startswith("test_") for part in whole.split(".")):
            wrong.append(f"imports {whole}")
        if whole.partition(".")[0] == "burmester":
            ours.add(called)
            if any(map(private, whole.split("."))):
                wrong.append(f"imports {whole}")
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and private(node.attr):
            owner = node.value
            while isinstance(owner, ast.Attribute):
                owner = owner.value
            if isinstance(owner, ast.Name) and owner.id in ours:
                wrong.append(f"uses {ast.unparse(node)}")
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            # The address of a name, as monkeypatch takes it.
            parts = node.value.split(".")
            address = parts[0] == "burmester" and all(map(str.isidentifier, parts))
            if address and any(map(private, parts)):
                wrong.append(f"names {node.value}")
    return wrong


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_a_test_keeps_to_the_rules(file):
    assert offences(file.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("from tests.dyads.test_pencil import span", "imports tests.dyads.test_pencil.span"),
        ("from tests.dyads import test_pencil", "imports tests.dyads.test_pencil"),
        ("import tests.test_wording as words", "imports tests.test_wording"),
        ("from .test_wording import words", "imports .test_wording.words"),
        ("from burmester.dyads.pencil import _design", "imports burmester.dyads.pencil._design"),
        ("from burmester.dyads import pencil\npencil._design()", "uses pencil._design"),
        ("import burmester\nburmester.plot._used(1)", "uses burmester.plot._used"),
        ("import burmester as b\nb._ROOMS", "uses b._ROOMS"),
        ("patch('burmester.dyads.pencil._design', 1)", "names burmester.dyads.pencil._design"),
    ],
)
def test_what_breaks_a_rule_is_told(source, told):
    assert offences(source) == [told]


def test_what_keeps_to_the_rules_is_not():
    source = """
from tests.oracles.witness import misses
from burmester.dyads import pencil
import burmester
pencil.fit_pencil
burmester.__version__
self._own = case._replace(code=1)
text = "burmester._ is no address"
"""
    assert offences(source) == []


def test_all_files_are_read():
    names = {str(file.relative_to(ROOT)) for file in FILES}
    assert {"tests/conftest.py", "tests/oracles/witness.py", "benchmarks/odd_pose.py"} <= names


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_every_imported_name_of_the_package_exists(file):
    """Also those that are imported only when they are needed, which nothing else would notice."""
    for module, name, _ in imported(ast.parse(file.read_text())):
        if module.partition(".")[0] == "burmester" and name:
            owner = importlib.import_module(module)
            assert hasattr(owner, name) or importlib.util.find_spec(f"{module}.{name}")
