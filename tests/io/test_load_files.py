"""Loads, springs and a drive in files: every key, every refusal with its place, and back."""

import json
import tomllib
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

import burmester
from burmester import cli, synthesize
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.live.document import document_of, task_file, task_of
from burmester.tasks.load_table import NEEDED, POSSIBLE
from burmester.tasks.loads import Drive, End, Force, Loads, Mass, Plates, Spring
from tests.oracles.marked import carets, marked
from tests.oracles.stated_requirements import reader, refused

POSES = """length_unit = "mm"
angle_unit = "deg"
poses = [[0, 0, 0], [10, 25, 30], [30, 10, 60.25]]
"""
LID = """
[loads]
gravity = [0.5, -9.81]
body = { mass_kg = 4, center = [21, 9], inertia_kgm2 = 0.02 }
links = { driver = 0.3, follower = 0 }
torque_Nm = -0.25
hand = { at = [64, 10] }
temperature_C = -5
[[loads.force]]
at = [62, 0]
force_N = [0, -40]
[[loads.force]]
at = [6, 1]
force_N = [3, 4]
frame = "M"
from_pose = 2
to_pose = 3

[[springs]]
kind = "gas"
ground_point = [-30, -40]
body_point = [18, 20]
force_N = 350
compressed_force_N = 480
stroke = 70
length = 120
friction_N = 30
count = 2
[[springs]]
kind = "extension"
from = { link = "ground", point = [0, -80] }
to = { link = "driver", point = [5, 1.5] }
rate_N_per_mm = 0.5
free_length = 10
initial_N = 3
greatest_length = 200
[[springs]]
kind = "compression"
from = { link = "driver", point = [1, 2] }
to = { link = "body" }
rate_N_per_mm = 0.5
free_length = 90
least_length = 1
[[springs]]
kind = "constant"
ground_point = [0, 80]
to = { link = "follower", point = [1, 1] }
force_N = 12
least_length = 0
greatest_length = 900
[[springs]]
kind = "torsion"
to = { link = "driver" }
rate_Nm_per_deg = 0.01
free_deg = -30
[[springs]]
kind = "counterweight"
to = { link = "driver", point = [-40, 0] }
mass_kg = 1.5

[drive]
duration_s = 2.5
profile = "trapezoid"
"""
ZERO = (0.0, 0.0)
BUILT = Loads(
    gravity=[0.5, -9.81],
    body=Mass(4, [21, 9], 0.02),
    links={"driver": 0.3, "follower": 0},
    forces=(Force([62, 0], [0, -40]), Force([6, 1], [3, 4], "M", 2, 3)),
    torque=-0.25,
    hand=[64, 10],
    celsius=-5,
    springs=(
        Spring(
            "gas",
            (End("ground", (-30, -40)), End("body", (18, 20))),
            {
                "force_N": 350,
                "compressed_force_N": 480,
                "stroke": 70,
                "length": 120,
                "friction_N": 30,
            },
            2,
        ),
        Spring(
            "extension",
            (End("ground", (0, -80)), End("driver", (5, 1.5))),
            {"rate_N_per_mm": 0.5, "free_length": 10, "initial_N": 3, "greatest_length": 200},
        ),
        Spring(
            "compression",
            (End("driver", (1, 2)), End("body", ZERO)),
            {"rate_N_per_mm": 0.5, "free_length": 90, "least_length": 1},
        ),
        Spring(
            "constant",
            (End("ground", (0, 80)), End("follower", (1, 1))),
            {"force_N": 12, "least_length": 0, "greatest_length": 900},
        ),
        Spring(
            "torsion",
            (End("ground", ZERO), End("driver", ZERO)),
            {"rate_Nm_per_deg": 0.01, "free_deg": -30},
        ),
        Spring("counterweight", (End("ground", ZERO), End("driver", (-40, 0))), {"mass_kg": 1.5}),
    ),
    drive=Drive(2.5, "trapezoid"),
)
OTHERS = {
    "nothing but gravity": ("[loads]\n", Loads()),
    "no gravity": ('[loads]\ngravity = "none"\n', Loads(gravity=[0, 0])),
    "down": ('[loads]\ngravity = "down"\n', Loads()),
    "plates": (
        '[loads]\nlinks = { plate = "steel 3", width = 20 }\n',
        Loads(links=Plates("steel", 3, 20)),
    ),
    "plates of a density": (
        '[loads]\nlinks = { plate = "1234.5 0.1", width = 20 }\n',
        Loads(links=Plates(1234.5, 0.1, 20)),
    ),
    "one force": (
        "[loads]\nforce = { at = [1, 2], force_N = [3, 4], to_pose = 2 }\n",
        Loads(forces=(Force([1, 2], [3, 4], to_pose=2),)),
    ),
    "one spring": (
        '[springs]\nkind = "torsion"\nto = { link = "body" }\nrate_Nm_per_deg = 1\n',
        Loads(springs=(Spring("torsion", (End("ground", ZERO), End("body", ZERO)),
                              {"rate_Nm_per_deg": 1}),)),
    ),
    "a table of times": (
        '[drive]\ntimes = [[0, "one"], [1.5, 12.5], [2, "2"]]\n',
        Loads(drive=Drive.through([(0, "one"), (1.5, 12.5), (2, "2")])),
    ),
    "a drive alone": ("[drive]\nduration_s = 2\n", Loads(drive=Drive(2))),
}  # fmt: skip


SCHEMA = Draft202012Validator(
    json.loads((Path(burmester.__file__).parent / "io" / "synthesis.schema.json").read_text())
)


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    return reader(tmp_path_factory.mktemp("loads"))


@pytest.fixture
def refused_command(tmp_path, monkeypatch, capsys):
    """The command ends with 2 and a code, without a traceback."""

    def run(text, code, suffix=".toml"):
        (tmp_path / f"poses{suffix}").write_text(text)
        monkeypatch.chdir(tmp_path)
        with pytest.raises(SystemExit) as ended:
            cli.main(["synthesize", f"poses{suffix}"])
        assert ended.value.code == 2
        told = capsys.readouterr().err
        assert "Traceback" not in told
        if suffix == ".toml" or not any(word in text for word in ("Infinity", "NaN")):
            assert f"error[{code}]" in told  # JSON has no such numbers, which is told before

    return run


def plain(value):
    """Loads, or a part of them, as plain data that can be compared."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    if hasattr(value, "__dataclass_fields__"):
        return {each.name: plain(getattr(value, each.name)) for each in fields(value)
                if each.name != "where"}  # fmt: skip
    return dict(value) if hasattr(value, "items") else value


EVERY = {"all of them": (LID, BUILT)} | OTHERS


@pytest.mark.parametrize("name", EVERY)
def test_a_file_reads_as_what_python_builds(read, name):
    text, built = EVERY[name]
    content = POSES + text
    tree = tomllib.loads(content)
    for source, suffix in (
        (content, ".toml"),
        (json.dumps(tree), ".json"),
        (json.dumps({"task": tree}), ".json"),
    ):
        assert plain(read(source, suffix).loads) == plain(built)


@pytest.mark.parametrize("name", EVERY)
def test_a_live_document_goes_back_into_a_file_that_reads_as_the_same(read, name):
    text, built = EVERY[name]
    task = read(POSES + text)
    document = json.loads(json.dumps(document_of(task)))
    assert plain(task_of(document).loads) == plain(built)
    assert document_of(task_of(document)) == document
    assert plain(read(task_file(document)).loads) == plain(built)


@pytest.mark.parametrize("name", ["all of them", "plates of a density", "one force"])
def test_a_result_keeps_its_loads_and_says_the_same_again(read, name, tmp_path):
    text, built = EVERY[name]
    answer = synthesize(read(POSES + text.replace('"follower"', '"coupler"')
                             .replace("follower = 0", "coupler = 0")))  # fmt: skip
    data = json.loads(json.dumps(synthesis_data(answer)))
    SCHEMA.validate(data)
    file = tmp_path / "result.json"
    file.write_text(json.dumps(data))
    again = read_result(file)
    assert not again.refused
    assert plain(again.synthesis.problem.given.loads) == plain(answer.problem.given.loads)
    assert plain(answer.problem.given.loads.gravity) == plain(built.gravity)
    told = synthesis_data(again.synthesis)["linkages"]
    assert any(each["loads"] for each in data["linkages"])
    for one, other in zip(data["linkages"], told, strict=True):
        assert bool(one["drive"]) == bool(one["loads"] and built.drive)
        for key in ("loads", "drive"):
            assert (one[key] is None) == (other[key] is None)
            if one[key] is not None:
                assert numbers(one[key]) == pytest.approx(numbers(other[key]), rel=1e-6, abs=1e-9)


def numbers(tree):
    """All numbers of a tree, in their order; a driver may come from another turn."""
    if isinstance(tree, dict):
        return [each for key, value in tree.items() if key != "driver_deg"
                for each in numbers(value)]  # fmt: skip
    if isinstance(tree, list):
        return [each for value in tree for each in numbers(value)]
    return [float(tree)] if isinstance(tree, int | float) else []


def test_without_the_tables_there_are_no_loads(read):
    assert read(POSES).loads is None
    document = tomllib.loads(POSES) | {"loads": None, "springs": None, "drive": None}
    assert read(json.dumps(document), ".json").loads is None


GAS = """[[springs]]
kind = "gas"
ground_point = [-30, -40]
body_point = [18, 20]
force_N = 350
compressed_force_N = 480
stroke = 70
length = 120
"""
FAULTS = [  # TOML, code, what the message holds
    # loads
    ("loads = «5»", "E104", "loads does not fit"),
    ("[loads]\n«mass» = 5", "E107", "not known"),
    ('[loads]\ngravity = «"up"»', "E177", "gravity is 'up'"),
    ("[loads]\ngravity = «[1]»", "E106", "1 of 2"),
    ("[loads]\ngravity = [1, «inf»]", "E103", "finite"),
    ("[loads]\ngravity = «true»", "E104", "gravity"),
    ("[loads]\nbody = «4»", "E104", "loads.body"),
    ("[loads]\nbody = «{ center = [1, 2] }»", "E105", "loads.body.mass_kg is missing"),
    ("[loads]\nbody = { mass_kg = «'4'» }", "E104", "not a number"),
    ("[loads]\nbody = «{ mass_kg = -4, center = [0, 0] }»", "E177", "-4"),
    ("[loads]\nbody = { mass_kg = 4, center = «[0]» }", "E106", "center"),
    ("[loads]\nbody = «{ mass_kg = 4, center = [0, 0], inertia_kgm2 = -1 }»", "E177", "-1"),
    ("[loads]\nbody = { mass_kg = 4, «colour» = 1 }", "E107", "colour"),
    ("«[loads]»\nbody = { mass_kg = 4 }", "E177", "where its centre is"),
    ("[loads]\nlinks = «4»", "E104", "loads.links"),
    ('[loads]\nlinks = { driver = «"4"» }', "E104", "driver"),
    ("[loads]\nlinks = { driver = «nan» }", "E103", "finite"),
    ("«[loads]»\nlinks = { driver = -1 }", "E177", "-1"),
    ('[loads]\nlinks = { plate = «"steel"», width = 20 }', "E177", "'steel'"),
    ('[loads]\nlinks = { plate = «"steel thick"», width = 20 }', "E177", "'steel thick'"),
    ('[loads]\nlinks = «{ plate = "cheese 3", width = 20 }»', "E177", "no material 'cheese'"),
    ('[loads]\nlinks = «{ plate = "steel 3" }»', "E105", "width is missing"),
    ('[loads]\nlinks = «{ plate = "steel -3", width = 20 }»', "E177", "-3"),
    ('[loads]\nlinks = «{ plate = "-7850 3", width = 20 }»', "E177", "-7850"),
    ('[loads]\nlinks = «{ plate = "steel nan", width = 20 }»', "E177", "plates"),
    ('[loads]\nlinks = «{ plate = "steel 3", width = 0 }»', "E177", "width of plates is 0"),
    ("[loads]\nlinks = { plate = «3», width = 20 }", "E104", "not a text"),
    ("[loads]\nforce = «4»", "E104", "loads.force"),
    ("[loads]\nforce = «{ at = [1, 2] }»", "E105", "force_N is missing"),
    ("[loads]\nforce = «{ force_N = [1, 2] }»", "E105", "at is missing"),
    ("[loads]\nforce = { at = [1, 2], force_N = «7» }", "E104", "force_N"),
    ("[loads]\nforce = { at = [1, 2], force_N = «[1, 2, 3]» }", "E106", "more than 2"),
    ("[loads]\nforce = «{ at = [1, 2], force_N = [1, 2], frame = 'N' }»", "E177", "frame 'N'"),
    ("[loads]\nforce = { at = [1, 2], force_N = [1, 2], from_pose = «0» }", "E104", "0"),
    ("[loads]\nforce = { at = [1, 2], force_N = [1, 2], from_pose = «1.5» }", "E104", "1.5"),
    ("[loads]\nforce = { at = [1, 2], force_N = [1, 2], to_pose = «inf» }", "E103", "finite"),
    ("[loads]\nforce = { at = [1, 2], force_N = [1, 2], to_pose = «'all'» }", "E104", "'all'"),
    ("«[loads]»\nforce = { at = [1, 2], force_N = [1, 2], to_pose = 4 }", "E177", "pose 4 of 3"),
    ("[loads]\ntorque_Nm = «[1]»", "E104", "torque_Nm"),
    ("[loads]\ntorque_Nm = «inf»", "E103", "finite"),
    ("[loads]\nhand = «[1, 2]»", "E104", "hand"),
    ("[loads]\nhand = «{}»", "E105", "at is missing"),
    ("[loads]\nhand = { at = «1» }", "E104", "at"),
    ("[loads]\ntemperature_C = «'warm'»", "E104", "'warm'"),
    ("«[loads]»\ntemperature_C = -300", "E177", "-300"),
    # springs
    ("springs = «5»", "E104", "springs"),
    ("[[springs]]\nkind = «5»", "E104", "kind"),
    ("[«[springs]»]\nground_point = [0, 0]\nbody_point = [0, 0]", "E105", "kind is missing"),
    (f"{GAS}«colour» = 1", "E107", "colour"),
    (f"{GAS}count = «0»", "E104", "count"),
    (f"{GAS}count = «2.5»", "E104", "count"),
    (f"{GAS}friction_N = «'30'»", "E104", "friction_N"),
    (GAS.replace("[-30, -40]", "«[-30]»"), "E106", "ground_point"),
    (GAS.replace("[18, 20]", "«20»"), "E104", "body_point"),
    (GAS.replace("= 350", "= «nan»"), "E103", "force_N"),
    (f"{GAS}«from» = {{ point = [0, 0] }}", "E108", "ground_point and from"),
    (f"{GAS}«to» = {{ point = [0, 0] }}", "E108", "body_point and to"),
    ('[[springs]]\nkind = "gas"\nfrom = { link = «5» }', "E104", "link"),
    ('[[springs]]\nkind = "gas"\nfrom = { link = "ground", «at» = 5 }', "E107", "at"),
    # drive
    ("drive = «5»", "E104", "drive"),
    ("[drive]\n«time» = 5", "E107", "not known"),
    ("[drive]\nduration_s = «'2'»", "E104", "'2'"),
    ("[drive]\nduration_s = «inf»", "E103", "finite"),
    ("[drive]\nduration_s = 1\nprofile = «5»", "E104", "profile"),
    ("[drive]\ntimes = «5»", "E104", "times"),
    ("[drive]\ntimes = «[[0, '1']]»", "E106", "rows"),
    ("[drive]\ntimes = [[0, '1'], «[2]»]", "E106", "values"),
    ("[drive]\ntimes = [[0, '1'], [«'2'», '3']]", "E104", "not a number"),
    ("[drive]\n«duration_s» = 2\ntimes = [[0, '1'], [2, '3']]", "E108", "times and duration_s"),
]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"{fault[1]} {fault[0][-60:]}")
def test_what_does_not_fit_is_refused_with_its_place(read, fault, refused_command):
    text, code, holds = fault
    text, line, column, width = marked(f"{POSES}{text}\n")
    error = refused(lambda: read(text), code)
    assert holds in error.message
    name, *found = carets(error.where)
    assert name.endswith("poses.toml")
    if text.splitlines()[line - 1][column - 1] != "[":  # the head of a table may be named instead
        assert found == [line, column, width]
    assert found[0] == line
    refused_command(text, code)
    refused_command(json.dumps(tomllib.loads(text)), code, ".json")


WHOLE = [  # tables whose fault is of the whole, or of a task: TOML, code, what the message holds
    (GAS.replace("stroke = 70\n", ""), "E177", "states no stroke"),
    (f"{GAS}rate_N_per_mm = 1\n", "E177", "has no rate_N_per_mm"),
    (GAS.replace("= 350", "= -350"), "E177", "-350"),
    (GAS.replace("stroke = 70", "stroke = 170"), "E177", "shorter than its stroke"),
    (GAS.replace('"gas"', '"rubber"'), "E177", "no spring 'rubber'"),
    (f"{GAS}count = 1001\n", "E177", "1001"),
    (GAS.replace("ground_point = [-30, -40]\n", ""), "E105", "ground_point is missing"),
    (GAS.replace("body_point = [18, 20]\n", ""), "E105", "body_point is missing"),
    (GAS.replace("length = 120", "length = 75"), "E179", "spring 1 does not fit"),
    ("[drive]\n", "E105", "duration_s is missing"),
    ("[drive]\nduration_s = 0\n", "E177", "duration"),
    ("[drive]\nduration_s = 1\nprofile = 'jerk'\n", "E177", "no profile 'jerk'"),
    ("[drive]\ntimes = [[1, '1'], [2, '3']]\n", "E177", "the first time is 1 s"),
    ("[drive]\ntimes = [[0, '1'], [2, '3'], [2, '3']]\n", "E177", "do not grow"),
]


@pytest.mark.parametrize("fault", WHOLE, ids=lambda fault: fault[2])
def test_what_is_wrong_as_a_whole_is_refused_with_its_table(read, fault, refused_command):
    text, code, holds = fault
    error = refused(lambda: read(POSES + text), code)
    assert holds in error.message
    assert carets(error.where)[1] >= 4
    refused_command(POSES + text, code)


@pytest.mark.parametrize("unit", [None, "px", "furlong"])
def test_a_unit_that_is_no_length_is_refused(read, unit, refused_command):
    stated = "" if unit is None else f'length_unit = "{unit}"\n'
    text = POSES.replace('length_unit = "mm"\n', stated) + LID
    error = refused(lambda: read(text), "E178")
    assert (unit or "states no unit") in (error.why or "")
    refused_command(text, "E178")


def test_a_name_of_no_link_is_refused(refused_command):
    text = f"{POSES}[loads]\nlinks = {{ rocker = 1 }}\n"
    refused_command(text, "E177")
    text = f'{POSES}[[springs]]\nkind = "counterweight"\nto = {{ link = "crank" }}\nmass_kg = 1\n'
    refused_command(text, "E177")


def test_each_number_of_each_spring_is_read(read):
    """Whatever a kind may have, one after the other."""
    for kind, needed in NEEDED.items():
        numbers = dict.fromkeys(needed, 10.0) | ({"length": 90.0} if kind == "gas" else {})
        for name in (*needed, *POSSIBLE[kind]):
            given = numbers | {name: 11.5 if name != "length" else 91.5}
            lines = "\n".join(f"{key} = {value}" for key, value in given.items())
            ends = 'from = { link = "driver" }\nto = { link = "coupler", point = [1, 2] }'
            (spring,) = read(
                f'{POSES}[[springs]]\nkind = "{kind}"\n{ends}\n{lines}\n'
            ).loads.springs
            assert dict(spring.numbers) == given


@pytest.mark.parametrize(
    "text",
    [
        "[[springs]]\nkind = 'torsion'\nto = { link = «'lever'» }\nrate_Nm_per_deg = 1\n",
        "[loads]\nlinks = { driver = 1, «lever» = 2 }\n",
    ],
)
def test_a_link_that_no_linkage_has_is_pointed_at(read, text, refused_command):
    text, line, column, width = marked(f"{POSES}{text}")
    error = refused(lambda: synthesize(read(text)), "E177")
    assert "no link 'lever'" in error.message
    name, *found = carets(error.where)
    assert name.endswith("poses.toml")
    assert found == [line, column, width]
    refused_command(text, "E177")
