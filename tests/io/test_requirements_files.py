"""Requirements in files: every key, every refusal with its place."""

import json
import tomllib

import pytest

from burmester.tasks.requirements import Requirements
from tests.oracles.marked import carets, marked
from tests.oracles.stated_requirements import (
    CSV,
    NOTHING,
    POSES,
    SAID,
    reader,
    refused,
    values,
)


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    return reader(tmp_path_factory.mktemp("requirements"))


@pytest.mark.parametrize("name", SAID)
def test_every_key_reaches_the_task(read, name):
    text, _, field, value = SAID[name]
    content = f"{POSES}[requirements]\n{text}\n"
    for source, suffix in ((content, ".toml"), (json.dumps(tomllib.loads(content)), ".json")):
        task = read(source, suffix)
        assert values(task.requirements) == NOTHING | {field: value}
        assert task.limits == ()
    document = {"task": tomllib.loads(content)}
    assert values(read(json.dumps(document), ".json").requirements)[field] == value


@pytest.mark.parametrize("driver", ["first", "second"])
def test_a_driver_by_its_limits(read, driver):
    text = f'{POSES}[requirements]\ndriver = "{driver}"\n[[limits]]\nkinds = ["RR"]\n'
    assert read(f"{text}[[limits]]\n").requirements.driver == driver
    error = refused(lambda: read(text))
    first, second = error.where.split(", and ")
    assert first.endswith("poses.toml:6:1"), "the kinds"
    assert second.endswith("poses.toml:4:1"), "the driver"


def test_without_the_table_nothing_is_asked(read):
    for content in (POSES, f"{POSES}[requirements]\n"):
        assert read(content).requirements == Requirements()
    document = tomllib.loads(POSES) | {"requirements": {"within": None, "types": None}}
    assert read(json.dumps(document), ".json").requirements == Requirements()
    document["requirements"] = None
    assert read(json.dumps(document), ".json").requirements == Requirements()
    assert read(CSV, ".csv").requirements == Requirements()


FAULTS = [  # TOML below [requirements], code, the path that is named, what the message holds
    ("transmission_deg = «inf»", "E103", ".transmission_deg", "finite"),
    ('transmission_deg = «"40"»', "E104", ".transmission_deg", "'40', not a number"),
    ("transmission_deg = «90»", "E134", ".transmission_deg", "90°"),
    ("«transmission» = 1", "E107", ".transmission", "not known"),
    ("types = «[]»", "E134", ".types", "no linkage type is left"),
    ('types = ["grashof", «"crank"»]', "E134", ".types[1]", "no linkage type 'crank'"),
    ('driver = «"motor"»', "E134", ".driver", "no driver 'motor'"),
    ("footprint = «[[0, 0], [1, 1]]»", "E104", ".footprint", "does not fit"),
    ("link_ratio = «0.5»", "E134", ".link_ratio", "0.5"),
    ("within = «0»", "E134", ".within", "at most 0"),
    ('any_order = «"yes"»', "E104", ".any_order", "'yes', neither true nor false"),
    ("«kinds» = ['RR']", "E107", ".kinds", "not known"),
    ("«grashof» = true", "E107", ".grashof", "not known"),
]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault[0])
def test_what_is_no_requirement_is_refused_with_its_path_and_place(read, fault):
    text, code, path, holds = fault
    text, *place = marked(f"{POSES}[requirements]\n{text}\n")
    error = refused(lambda: read(text), code)
    assert error.message.startswith(f"requirements{path}")
    assert holds in error.message
    name, *found = carets(error.where)
    assert name.endswith("poses.toml")
    assert found == place


def test_requirements_are_one_table(read):
    for text, column in (("requirements = 5\n", 16), ("[[requirements]]\nwithin = 1\n", 3)):
        error = refused(lambda: read(POSES + text), "E104")  # noqa: B023
        assert error.message.startswith("requirements does not fit")
        assert carets(error.where)[1:3] == (3, column)
        for key in ("transmission_deg", "types", "driver", "footprint", "any_order"):
            assert key in error.help


def test_help_says_where_a_key_belongs(read):
    error = refused(lambda: read(f"{POSES}[limits]\ndriver = 'crank'\n"), "E107")
    assert error.help.startswith("write driver under requirements")
    error = refused(lambda: read(f"{POSES}[requirements]\nkinds = ['RR']\n"), "E107")
    assert error.help.startswith("write kinds under limits")
    error = refused(lambda: read(f"[requirements]\nwithin = 1\n{POSES}"), "E107")
    assert error.help.startswith("write poses above the head of requirements") or (
        error.help.startswith("write angle_unit above the head of requirements")
    )
    for key, value in (("within", 1), ("types", ["grashof"]), ("requirement", {"within": 1})):
        document = tomllib.loads(POSES) | {key: value}
        error = refused(lambda: read(json.dumps(document), ".json"), "E107")  # noqa: B023
        assert error.message.startswith(f"{key} stands beside")
        column = json.dumps(document).index(f'"{key}"') + 1
        assert carets(error.where)[1:] == (1, column, len(key) + 2)
        assert "has no effect" in error.message
        document = tomllib.loads(POSES)
        document["requirements"] = value if key == "requirement" else {key: value}
        assert read(json.dumps(document), ".json").requirements.has_any


def test_contradictions_in_a_file_say_where(read):
    text = '[requirements]\nwithin = 1\ndriver = "crank"\ntypes = ["triple-rocker"]\n'
    error = refused(lambda: read(POSES + text), "E132")
    name = error.where.split(":")[0]
    assert error.where == f"{name}:6:1, and {name}:5:1"
    text = '[requirements]\nwithin = 1\ntypes = ["grashof"]\n[limits]\nkinds = ["PR"]\n'
    error = refused(lambda: read(POSES + text), "E132")
    assert error.where == f"{name}:7:1, and {name}:5:1"
