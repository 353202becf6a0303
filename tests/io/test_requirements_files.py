"""Requirements in files: every key, every refusal with its place."""

import json
import tomllib

import numpy as np
import pytest

from burmester.geometry.regions import Polygon
from burmester.io.reading.stated_requirements import requirements_data
from burmester.requirements.types import GROUPS, TYPES
from burmester.tasks.requirements import Requirements
from tests.oracles.marked import carets, marked
from tests.oracles.stated_requirements import (
    CSV,
    INF,
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
    ("transmission_deg = «-1e-3»", "E134", ".transmission_deg", "-0.001°"),
    ("«transmission» = 1", "E107", ".transmission", "not known"),
    ('types = «"grashof"»', "E104", ".types", "'grashof'"),
    ("types = [«3»]", "E104", ".types[0]", "3, not a name of a type in quotes"),
    ("types = «[]»", "E134", ".types", "no linkage type is left"),
    ('types = ["grashof", «"crank"»]', "E134", ".types[1]", "no linkage type 'crank'"),
    ("driver = «1»", "E104", ".driver", "1, not one of its names in quotes"),
    ('driver = «"motor"»', "E134", ".driver", "no driver 'motor'"),
    ("footprint = «[[0, 0], [1, 1]]»", "E104", ".footprint", "does not fit"),
    ("footprint = «{}»", "E105", ".footprint", "no shape"),
    ("footprint.box = «[[0, 0]]»", "E106", ".footprint.box", "1 of 2"),
    ("footprint.polygon = «[[0, 0], [1, 2]]»", "E106", ".footprint.polygon", "2 of 3"),
    ("footprint.polygon = [[0, 0], [1, 2], «[3]»]", "E106", ".footprint.polygon[2]", "1 of 2"),
    ("footprint.«line» = [[0, 0], [1, 1]]", "E107", ".footprint.line", "not known"),
    (
        "footprint = «{ box = [[0, 0], [1, 1]], polygon = [[0, 0], [1, 0], [0, 1]] }»",
        "E108",
        ".footprint",
        "box and polygon",
    ),
    ("footprint.polygon = «[[0, 0], [1, 1], [2, 2]]»", "E131", ".footprint.polygon", "no inside"),
    ("footprint.box = «[[0, 5], [1, 4]]»", "E132", ".footprint.box", "y from 5 to 4"),
    ("link_ratio = «0.5»", "E134", ".link_ratio", "0.5"),
    ("link_ratio = «true»", "E104", ".link_ratio", "true, not a number"),
    ("within = «0»", "E134", ".within", "at most 0"),
    ('any_order = «"yes"»', "E104", ".any_order", "'yes', neither true nor false"),
    ("any_order = «1»", "E104", ".any_order", "1, neither true nor false"),
    ("«kinds» = ['RR']", "E107", ".kinds", "not known"),
    ("«poses» = []", "E107", ".poses", "not known"),
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


def test_what_is_written_for_a_file_is_read_again(read):
    rng = np.random.default_rng(5)
    for _ in range(100):
        given = Requirements(
            transmission_deg=rng.choice([0.0, rng.uniform(0, 89)]),
            types=None if rng.random() < 0.3 else rng.choice([*TYPES, *GROUPS], 3).tolist(),
            driver=str(rng.choice(["any", "first", "second", "crank"])),
            footprint=None if rng.random() < 0.3 else Polygon(rng.normal(size=(3, 2))),
            link_ratio=rng.choice([INF, rng.uniform(1, 20)]),
            within=None if rng.random() < 0.3 else rng.uniform(1e-9, 1e3),
            any_order=bool(rng.integers(2)),
        )
        document = tomllib.loads(POSES) | {"limits": [{"length": {"least": 0.1}}, {}]}
        document["requirements"] = requirements_data(given)
        assert values(read(json.dumps(document), ".json").requirements) == values(given)
    assert requirements_data(Requirements()) == {}
