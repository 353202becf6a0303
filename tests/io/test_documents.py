"""Tasks in JSON and TOML: read exactly, or refused with the place and a help that works."""

from __future__ import annotations

import json
import math
import random
import re
import tomllib
from decimal import Decimal

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment
from burmester.io import cases
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.poses import read_task
from burmester.io.reading.trees.documents import syntax_fault
from burmester.io.result import task_data
from burmester.requirements.types import DRIVERS, GROUPS, TYPES
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from tests.oracles.marked import carets, marked


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    """Read text as if it were the file `task.SUFFIX`."""
    folder = tmp_path_factory.mktemp("documents")

    def read(content, suffix, **options):
        path = folder / f"task{suffix}"
        path.write_text(content, encoding="utf-8")
        return read_task(path, **options)

    return read


def refused(attempt):
    with pytest.raises(InputError) as caught:
        attempt()
    assert caught.value.help
    assert str(caught.value).encode(), "it can be printed"
    return caught.value


# Slips, and what the help says done to the text ------------------------------------------------

JSON = '{"title": "t", "angle_unit": "deg",\n "poses": [[0.5, 2, 30],\n  [1, 2, 45.5], [3, 1, 60]]}'
TOML = 'angle_unit = "deg"\nposes = [[0.5, 2, 30],\n  [1, 2, 45.5], [3, 1, 60]]\nwithin.x = 1\n'
TOML = TOML.replace("within.x = 1\n", 'title = "t"\n[limits]\nlength.most = 5\n')

SLIPS = [  # suffix, what is replaced in the sound text, by what (with the mark), what is said
    (".json", "60]]}", "60]«,»]}", "nothing follows this comma"),
    (".json", "60]]}", "60]]«,»}", "nothing follows this comma"),
    (".json", '"deg"', "«'deg'»", "double quotes"),
    (".json", '"poses"', "«'poses'»", "double quotes"),
    (".json", '"poses"', "«poses»", "no quotes"),
    (".json", '"deg"', "«deg»", "quotes around it"),
    (".json", '"deg"', "«“deg”»", "double quotes"),
    (".json", "[1, 2", "[1 «2»", "no comma"),
    (".json", "30],\n  [", "30]\n  «[»", "no comma"),
    (".json", '"deg",\n "', '"deg"\n «"»', "no comma"),
    (".json", '{"title', '«# no»\n{"title', "no comments"),
    (".json", "\n  [1", " «/* no */»\n  [1", "no comments"),
    (".json", "60]]}", "60«]»", "is still open"),
    (".json", '"t"', '"«\t»t"', "a tab"),
    (".toml", '"deg"', "«deg»", "quotes around it"),
    (".toml", '"deg"', "«“deg”»", "double quotes"),
    (".toml", "= 5", "= 5«,25»", "no decimal mark"),
    (".toml", "title = ", "title «:» ", "= between them"),
    (".toml", "30],\n  [", "30]\n  «[»", "no comma"),
    (".toml", "[1, 2", "[1 «2»", "no comma"),
    (".toml", 'title = "t"', "«//» a title", "begins with #"),
    (".toml", 'title = "t"', '«angle_unit» = "rad"', "stands twice"),
    (".toml", "length.most = 5", "length = { least = 1 «most» = 5 }", "no comma"),
]


def followed(text, error):
    """The text after the help is done to what the carets are under."""
    _, line, column, width = carets(error.where)
    start = sum(len(each) + 1 for each in text.split("\n")[: line - 1]) + column - 1
    end, help = start + width, error.help
    if help == "delete one of the two":
        return text[:start] + text[text.find("\n", start) + 1 :]
    if help.startswith("delete"):
        return text[:start] + text[end:]
    what = re.match(r"write (a comma|\S+?),? ?(?:in|before|behind|or|for|$)", help)[1]
    what = {"a comma": ","}.get(what, what)
    start, end = (end, end) if " behind " in help else (start, start if " before " in help else end)
    return text[:start] + what + text[end:]


@pytest.mark.parametrize("slip", SLIPS, ids=lambda slip: f"{slip[0]}-{slip[2]}")
def test_a_slip_is_told_and_following_the_help_mends_it(read, slip):
    suffix, old, new, holds = slip
    sound = JSON if suffix == ".json" else TOML
    assert sound.count(old) >= 1
    text, *place = marked(sound.replace(old, new, 1))
    error = refused(lambda: read(text, suffix))
    assert error.code == "E109"
    assert holds in error.why
    name, *found = carets(error.where)
    assert name.endswith(f"task{suffix}")
    assert found == place
    assert read(followed(text, error), suffix).poses.angle[0] == np.radians(30)


@pytest.mark.parametrize(
    ("text", "suffix", "line"),
    [
        ('{"poses": [[.5, 1, 2]]}', ".json", 1),
        ("[[1, 2, 3],\n [4, 5, +6]]", ".json", 2),
        ("a = 1\nposes = [[1, 2, 3]]\nb = 'x\n", ".toml", 3),
        ("a = 1\n[limits\nb = 1", ".toml", 2),
    ],
)
def test_any_other_is_told_as_the_parser_tells_it(read, text, suffix, line):
    error = refused(lambda: read(text, suffix))
    assert error.code == "E109"
    assert carets(error.where)[1] == line
    assert error.help.startswith(f"correct the {suffix[1:].upper()} there")


@pytest.mark.parametrize(
    ("text", "at", "said", "newer_at", "newer"),
    [
        ("[1, 2,\n ]", 8, "Expecting value", 5, "Illegal trailing comma before end of array"),
        (
            '{"a": 1,}',
            8,
            "Expecting property name enclosed in double quotes",
            7,
            "Illegal trailing comma before end of object",
        ),
    ],
)
def test_parsers_of_other_versions_lead_to_the_same_place(text, at, said, newer_at, newer):
    assert syntax_fault("JSON", text, at, said) == syntax_fault("JSON", text, newer_at, newer)
    assert text[syntax_fault("JSON", text, at, said).start] == ","


def test_a_table_that_stands_twice(read):
    poses = "x = 1\ny = 2\nangle_deg = 3\n"
    text, *place = marked(f"[poses]\n{poses}«[poses]»\n{poses}[poses]\n{poses}")
    error = refused(lambda: read(text, ".toml"))
    assert list(carets(error.where)[1:]) == place
    assert "stands twice: cannot declare" in error.why


@pytest.mark.parametrize("suffix", [".json", ".toml"])
@pytest.mark.parametrize("depth", [300, 5000, 200_000])
def test_many_brackets(read, suffix, depth):
    inside = "[" * depth + "]" * depth
    for text in (inside, f'{{"poses": {inside}}}', f'{{"a": {inside}, "poses": [[1,2,3]]}}'):
        content = text
        if suffix == ".toml":
            content = text.strip("{}").replace('"', "").replace(": ", " = ").replace(", p", "\np")
            content = content if "=" in content else f"poses = {content}"
        error = refused(lambda: read(content, suffix))  # noqa: B023
        assert error.code in ("E104", "E106", "E109", "E110")
        assert error.code != "E109" or "inside each other" in error.why


def test_a_key_of_toml_with_hundreds_of_parts_is_refused(read):
    poses = "angle_unit = 'deg'\nposes = [[1, 2, 3], [2, 3, 4], [3, 4, 6]]\n"
    sound = f"t = '{'a ' * 150}'\nw = [{'1.5,' * 150}]\n"
    assert read(poses + sound, ".toml").poses.shape == (3,)
    for parts in ("«a{}» = 1", "[«a{}»]", "q = {{«a{}» = 1}}"):
        text, line, column, _ = marked(sound + parts.format(" . b" * 50 + ".'c'" * 50_000))
        error = refused(lambda: read(text, ".toml"))  # noqa: B023
        assert error.code == "E109"
        assert carets(error.where)[1:3] == (line, column)
        assert "100 parts" in error.message


def test_the_first_bad_pose_of_many_is_told(read):
    text, line, column, _ = marked("[[1, 2, 3],\n [1, «true», 3], [null], {}]")
    error = refused(lambda: read(text, ".json"))
    assert error.message.startswith("poses[1].y")
    assert carets(error.where)[1:3] == (line, column)


# What stands at the wrong place or is misspelt --------------------------------------------------

POSES = 'angle_unit = "deg"\nposes = [[0, 0, 0], [1, 2, 30], [3, 1, 60.5]]\n'
FAULTS = [  # suffix, text with a mark, code, what the message begins with
    (".toml", "a = 1\n[[poses]]\nx = «'1'»\ny = 1\nangle_deg = 1", "E104", "poses[0].x is '1'"),
    (".toml", "[[poses]]\nx=1\ny=2\nangle_deg=3\n«[[poses]]»\nx=2\n", "E105", "poses[1].y is mi"),
    (".toml", "poses = [[1, 2, 3],\n # [\n [4, «5.5e400», 6]]", "E103", "poses[1].y is not"),
    (".toml", f"poses = [[1, 2, «{10**400}»]]", "E103", "poses[0].angle is not a finite"),
    (".toml", f'a = "{"8" * 5000}"\nposes = [[1, «-{"9" * 5000}»]]', "E103", "a number of 50"),
    (".toml", "poses = [[1, «2020-01-01 10:00:00», 3]]", "E104", "poses[0].y is 2020-01-01 1"),
    (".toml", "poses = [«[1, 2]»]", "E106", "poses[0] has 2 numbers, not 3"),
    (".toml", "poses = [[1, 2, 3], «[0,5, 1, 3]»]", "E106", "poses[1] has 4 numbers, not 3"),
    (".toml", "poses = «'x'»", "E104", "poses does not fit: 'x'"),
    (".toml", POSES.replace('"deg"', "«'grad'»"), "E110", "angle_unit is 'grad'"),
    (".toml", POSES + "[pose_sigma]\nposition = «'1'»\n", "E104", "pose_sigma.position is '1'"),
    (".toml", POSES + "[«pose_sigma»]\nposition = 1\n", "E105", "pose_sigma.angle_deg is missing"),
    (".toml", POSES + "pose_sigma.position = «-1»\n", "E104", "pose_sigma.position is below"),
    (".toml", POSES + "«lenght_unit» = 'mm'", "E107", "lenght_unit is not known"),
    (".toml", POSES + "[«requirment»]\nwithin = 1", "E107", "requirment is not known"),
    (".toml", POSES + "body = [[0, 0], [4, 0], [0, «'1'»]]", "E104", "body[2][1] is '1', not a"),
    (".toml", POSES + "body = «[[0, 0], [4, 0]]»", "E106", "body has 2 of 3"),
    (".toml", POSES + "body = «[[0, 0], [4, 0], [8, 0]]»", "E131", "body: a polygon has no inside"),
    (
        ".toml",
        POSES + "body = «[[0, 0], [1, 1], [1, 0], [0, 1]]»",
        "E131",
        "body: a polygon crosses itself",
    ),
    (".toml", POSES + "body = {«box» = [[0, 0], [1, 1]]}", "E107", "body.box is not known"),
    (".toml", POSES + "body = «{}»", "E105", "body names no file"),
    (".toml", POSES + "body = «'lid.png'»", "E170", "body: lid.png: the drawing cannot be read"),
    (
        ".toml",
        POSES + "body = {file = 'lid.dxf', layer = 'A', «id» = 'b'}",
        "E108",
        "body has layer and id",
    ),
    (".toml", POSES + "«margin» = 2", "E107", "margin stands beside the poses"),
    (".toml", POSES + "[surroundings]\nlink_width = «-1»", "E176", "surroundings.link_width: the"),
    (".toml", POSES + "«[[keep_out]]»\nname = 'a'", "E105", "keep_out[0] has no shape"),
    (".toml", POSES + "keep_out = [«3»]", "E104", "keep_out[0] does not fit"),
    (
        ".toml",
        POSES + "keep_out = [{box = «[[0, 0], [1, 0]]»}]",
        "E176",
        "keep_out[0].box: a keep-out box has no inside",
    ),
    (
        ".toml",
        POSES + "keep_out = [«{file = 'a.dxf', box = [[0, 0], [1, 1]]}»]",
        "E108",
        "keep_out[0] has box and file",
    ),
    (
        ".toml",
        POSES + "keep_out = [{«layer» = 'a', box = [[0, 0], [1, 1]]}]",
        "E108",
        "keep_out[0].layer is for a drawing",
    ),
    (
        ".json",
        '{"angle_unit": "deg", "poses": [[0, 0, 0], [1, 2, 30], [3, 1, 60]], '
        '"keep_out": {"box": «[[5, 5], [1, 1]]»}}',
        "E132",
        "keep_out.box: a box is empty",
    ),
    (".toml", "[[poses]]\nx=1\ny=2\n«angel_deg»=3", "E107", "poses[0].angel_deg is not known"),
    (".toml", "[[poses]]\nx=1\ny=2\nangle_deg=3\n«angle_rad»=3", "E108", "pose 1 has angle_deg"),
    (".json", '{"poses": [], "limits": {"kinds": «5»}}', "E104", "limits.kinds does not fit: 5"),
    (".json", '{"poses": [[1, 2, 3]], "a": [{"b": 1, «"b"»: 2}]}', "E108", "the key 'b' stands"),
    (".json", '{"a": 1, "\\u0062": {"c": 1}, «"b"»: 2}', "E108", "the key 'b' stands twice"),
    (".json", '[[1, 2, 3], [4, «"5"», 6]]', "E104", "poses[1].y is '5', not a number"),
    (".json", "[[1, 2, 3], «[4, 5]»]", "E106", "poses[1] has 2 numbers"),
    (
        ".json",
        '[[1, 2, 3], {"x": 1, "y": 2, "angle": 1, "name": «"\\ud800"»}]',
        "E104",
        "poses[1].n",
    ),
    (".json", '[{"x": 1, "y": 2, "angle": 1, «"\\ud800"»: 1}]', "E107", "poses[0].'\\ud800' is"),
    (".json", '{"poses": [], "limits": {«"\\ud800"»: 1}}', "E107", "limits.'\\ud800' is not"),
    (".json", '{"schema": "s", "task": {"poses": [[1, «null», 3]]}}', "E104", "task.poses[0].y is"),
    (
        ".json",
        '{"pose_sigmas": 1, "poses": []}'.replace('"pose_s', '«"pose_s').replace('s":', 's"»:', 1),
        "E107",
        "pose_sigmas is not known",
    ),
    (
        ".json",
        '[{"p": [1, 2]}, {"p": [1, 2], "q": [2, 3]}]'.replace('{"p": [1, 2]}', '«{"p": [1, 2]}»'),
        "E105",
        "poses[0].q is missing",
    ),
    (".json", '[{"p": [1, 2], "q": [2, 3], «"px"»: 3}]', "E108", "pose 1 has p and px"),
    (".json", '[{"p": [1, 2], "q": [2, «1e999»]}]', "E103", "poses[0].q[1] is not a finite"),
    (".json", '[{"p": [1, 2], "q": «[2, 3, 4]»}]', "E106", "poses[0].q has more than 2 numbers"),
    (".json", '[{"p": [1, 2], "q": [3, 4]}, «[1, 2, 3]»]', "E108", "pose 1 is two points, pose 2"),
    (".json", '[[1, 2, 3], «{"p": [1, 2], "q": [3, 4]}»]', "E108", "pose 1 is x, y and an angle"),
    (".json", '[{"px": 1, «"angle_deg"»: 2}]', "E108", "pose 1 has px and angle_deg"),
    (".json", '[{"px": 1, "py": 2, "qx": 2, "qy": 3, «"speed"»: 2}]', "E107", "poses[0].speed is"),
]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"{fault[2]}-{fault[1][-40:]}")
def test_what_is_wrong_is_pointed_at(read, fault):
    suffix, text, code, begins = fault
    text, *place = marked(text)
    error = refused(lambda: read(text, suffix))
    assert error.code == code
    assert error.message.startswith(begins)
    line, column, width = place
    shown = 100 - min(column - 1, 60)  # characters of the line from there on
    assert carets(error.where)[1:] == (line, column, min(width, shown))


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("pose", "poses"),
        ("Poses", "poses"),
        ("angel_unit", "angle_unit"),
        ("angle-unit", "angle_unit"),
        ("lenght_unit", "length_unit"),
        ("pose_sigmas", "pose_sigma"),
        ("requirment", "requirements"),
        ("limit", "limits"),
        ("requirement", "requirements"),
    ],
)
def test_a_key_that_is_nearly_known_is_told_the_known_one(read, said, meant):
    tree = {
        "poses": [[0, 0, 0], [1, 2, 30], [3, 1, 60.5]],
        "angle_unit": "deg",
        "length_unit": "mm",
        "pose_sigma": {"position": 1, "angle_deg": 1},
        "limits": {"length": {"most": 5}},
        "requirements": {"within": 1},
    }
    expected = task_data(read(json.dumps(tree), ".json"))
    text = json.dumps({said if key == meant else key: value for key, value in tree.items()})
    error = refused(lambda: read(text, ".json"))
    assert error.code == "E107"
    assert error.help.startswith(f"write {meant} in its place")
    assert text[carets(error.where)[2] :].startswith(f'{said}"')
    assert task_data(read(text.replace(f'"{said}"', f'"{meant}"'), ".json")) == expected


def test_other_keys_at_the_top_are_ignored(read):
    notes = 'title = "a"\nname = "n"\nnote = 1\nnotes = []\nauthor = "a"\ndescription = "limit"\n'
    notes += "poses_old = 3\nsource = 2020-01-01\n'' = 1\n"
    assert task_data(read(notes + POSES, ".toml")) == task_data(read(POSES, ".toml"))


@pytest.mark.parametrize(
    ("table", "near"),
    [
        ("«[»foo]\na = 1", None),
        ("«[»[foo]]\na = 1", None),
        ("«foo» = { a = nan }", None),
        ("«foo».a.b = 1", None),
        ("«[»require]\ntransmission_deg = 30", "requirements"),
        ("«[»limitations]\nlength = {least = 1}", "limits"),
    ],
)
def test_an_unknown_table_is_refused_and_the_nearest_known_one_told(read, table, near):
    text, line, _, _ = marked(POSES + table)
    error = refused(lambda: read(text, ".toml"))
    assert error.code == "E107"
    assert re.search(r"the table \w+ is not known", error.message)
    assert carets(error.where)[1] == line
    assert (f"write {near} if" in error.help) == (near is not None)
    assert "the tables of a task are pose_sigma, tolerance, body" in error.help or near
    if near:
        read(re.sub(r"\[\w+\]", f"[{near}]", text), ".toml")


def test_more_values_than_there_is_memory_for_are_refused(read, monkeypatch):
    monkeypatch.setattr("burmester.io.reading.file_content.MAX_VALUES", 50)
    corners = ", ".join("[0, 1]" for _ in range(20))
    error = refused(lambda: read(f"{POSES}body = [{corners}]", ".toml"))
    assert (error.code, error.message) == ("E101", "the file is too large")
    assert "50 are the most" in error.why


@pytest.mark.parametrize("name", cases.names())
def test_the_keys_of_the_cases_are_ignored(name):
    assert len(read_task(f"case:{name}").poses.angle) == len(cases.load(name)["poses"])


# Numbers ---------------------------------------------------------------------------------------

NUMBERS = ["1_000", "0x1F", "0b101", "0o17", "-0", "+3", "-0.0", "1e-3", "6.022_140e23", "0.1"]


@pytest.mark.parametrize("number", NUMBERS)
def test_every_way_to_write_a_number_in_toml(read, number):
    text = f"angle_unit = 'rad'\nposes = [[{number}, 0, 0], [1, 2, 1], [2, 2, 2]]"
    value = read(text, ".toml").poses.translation[0, 0]
    plain = number.replace("_", "")
    expected = int(plain, 0) if re.match(r"0[xbo]", plain) else float(Decimal(plain))
    assert value == expected
    assert math.copysign(1, value) == math.copysign(1, tomllib.loads(f"v = {number}")["v"])


@pytest.mark.parametrize("number", ["3e-324", "5e-324", "9.999999999999999e49", "1E2", "-0"])
def test_extreme_numbers_in_json(read, number):
    text = f'{{"angle_unit": "rad", "poses": [[0, {number}, 0], [1, 2, 1], [2, 2, 2]]}}'
    assert read(text, ".json").poses.translation[0, 1] == float(number)


TINY = f"0.{'0' * 400}1"
SMALL = [  # where a number stands that is not 0 and would become 0
    ("x,y,angle_deg\n0,0,0\n1,1,9\n2,«{}»,20\n", ".csv"),
    ("x;y;angle_deg\n0;0;0\n1;1;9\n2;«{}»;20\n", ".csv"),
    ('{"angle_unit": "deg", "poses": [[0, «{}», 0], [1, 2, 1], [2, 2, 2]]}', ".json"),
    (POSES + "[limits]\nfixed_pivot = { point = [«{}», 1] }\n", ".toml"),
    (POSES + "tolerance = { x = «{}» }\n", ".toml"),
    (POSES + "body = [[0, 0], [1, 0], [«{}», 1]]\n", ".toml"),
    (POSES + "note = «{}»\n", ".toml"),
    ("[function]\npairs = [[0, 0], [9, {}], [20, 9]]\n", ".toml"),
    ('{"function": {"pairs": [[0, 0], [9, {}], [20, 9]]}}', ".json"),
    ("[function]\nexpression = 'x + {}'\nx = [1, 2]\ninput_deg = 9\noutput_deg = 9\n", ".toml"),
    ("input_deg,output_deg\n0,0\n9,{}\n20,9\n", ".csv"),
]


@pytest.mark.parametrize("number", ["1e-400", "-2.4E-0324", TINY])
@pytest.mark.parametrize(("text", "suffix"), SMALL)
def test_a_number_that_would_become_0_is_refused_and_0_is_read(text, suffix, number):
    name, (small, line, _, _) = f"a{suffix}", marked(text.replace("{}", number))
    zero = marked(text.replace("{}", "0")).text
    if "«" not in text:
        error = refused(lambda: read_function(small.encode(), name))
        assert error.code in ("E103", "E104", "E190")
        read_function(zero.encode(), name)
        return
    error = refused(lambda: read_task(name, data=small.encode()))
    assert error.code == "E103"
    assert "nearer to 0 than 4.9e-324" in error.why
    assert carets(error.where)[1] == line
    read_task(name, data=zero.encode())


def test_a_long_text_is_no_trouble(read):
    long = "a" * 9_000_000
    task = read(json.dumps({"angle_unit": "deg", "note": long, "poses": [[1, 2, 3]] * 3}), ".json")
    assert task.poses.shape == (3,)
    error = refused(lambda: read(json.dumps({"note": long, "poses": [[1, 2, long]]}), ".json"))
    assert error.code == "E104"
    assert len(str(error)) < 1000


# Two tracked points ----------------------------------------------------------------------------


def test_two_points_are_a_pose_however_they_are_written(read):
    rng = np.random.default_rng(8)
    angles, shift = rng.uniform(-3, 3, 5), rng.uniform(-9, 9, (5, 2))
    turn = np.exp(1j * angles)
    body = np.array([1 + 2j, -2 + 0.5j])
    p, q = (turn * each + shift @ [1, 1j] for each in body)
    rows = np.transpose([p.real, p.imag, q.real, q.imag]).tolist()
    keyed = [dict(zip(("px", "py", "qx", "qy"), row, strict=True)) for row in rows]
    paired = [{"p": row[:2], "q": row[2:], "weight": i} for i, row in enumerate(rows, 1)]
    mixed = [{"p": row[:2], "qx": row[2], "qy": row[3], "name": "n"} for row in rows]
    toml = "".join(f"[[poses]]\np = [{a!r}, {b!r}]\nq = [{c!r},\n{d!r}]\n" for a, b, c, d in rows)
    texts = [(json.dumps(each), ".json") for each in (keyed, {"poses": paired}, mixed)]
    for text, suffix in [*texts, (toml, ".toml")]:
        task = read(text, suffix)
        # a body point is where it was measured, up to one fixed change of the body's frame
        place = task.poses.translation @ [1, 1j]
        for measured in (p, q):
            in_body = (measured - place) / np.exp(1j * task.poses.angle)
            assert np.abs(in_body - in_body[0]).max() < 1e-12
        if "weight" in text:
            assert task.weights.tolist() == [1, 2, 3, 4, 5]
    points = "poses = [{p=[1_0, 0x1], q=[2, 3]}, {p=[1, 2], q=[1, 10]}, {p=[5, 5], q=[13, 5.0]}]"
    task = read(points.replace("1_0, 0x1", "10, 1"), ".toml")
    again = read(points, ".toml")
    assert task_data(task) == task_data(again)


# Written and read again ------------------------------------------------------------------------


def region(rng, both):
    kind = rng.choice(["none", "none" if both else "point", "line", "segment", "polygon"])
    points = [[rng.gauss(0, 5), rng.gauss(0, 5)] for _ in range(3)]
    match kind:
        case "none":
            return None
        case "point":
            return Point(np.array(points[0]))
        case "line" | "segment":
            return (Line if kind == "line" else Segment)(*map(np.array, points[:2]))
    return Polygon(np.array(points))


def limits(rng, both):
    """Limits that contradict nothing, or None; a point is for one of the dyads."""
    low = rng.choice([0.0, rng.uniform(0, 2)])
    try:
        return Limits(
            fixed_pivot=region(rng, both),
            moving_pivot=region(rng, both),
            length=(low, rng.choice([math.inf, low + rng.uniform(0.1, 9)])),
            kinds=frozenset(rng.sample(KINDS, rng.randint(1, 4))),
        )
    except InputError:
        return None


def some_limits(rng):
    count = rng.randint(0, 2)
    found = [limits(rng, count == 1) for _ in range(count)]
    return () if None in found else tuple(found)


def some_task(rng):
    count = rng.randint(5, 9)
    try:
        return Task(
            Displacement(
                np.array([[rng.gauss(0, 9), rng.gauss(0, 9)] for _ in range(count)]),
                np.array([rng.uniform(-7, 7) for _ in range(count)]),
            ),
            weights=rng.choice([None, np.array([rng.uniform(0.1, 3) for _ in range(count)])]),
            names=rng.choice([None, tuple(f"pose, \"{i}\" 'ä' \\" for i in range(count))]),
            length_unit=rng.choice([None, "mm", "in"]),
            resolution=(rng.choice([0.0, 0.05]), rng.choice([0.0, 1e-4])),
            exact=rng.choice([None, np.array([i == 2 for i in range(count)])]),
            limits=some_limits(rng),
            requirements=Requirements(
                transmission_deg=rng.choice([0.0, rng.uniform(0, 89)]),
                types=rng.choice([None, frozenset(rng.sample([*TYPES, *GROUPS], 3))]),
                driver=rng.choice(DRIVERS),
                footprint=rng.choice([None, Polygon(np.array([[0, 0], [90, 0], [0, 90.5]]))]),
                link_ratio=rng.choice([math.inf, rng.uniform(1, 20)]),
                within=rng.choice([None, rng.uniform(1e-9, 1e3)]),
                within_deg=rng.choice([None, rng.uniform(1e-9, 180)]),
                any_order=rng.random() < 0.5,
            ),
            body=rng.choice([None, Polygon(np.array([[0, -3], [90, 0], [0, 90.5], [-7, 12]]))]),
        )
    except InputError:
        return None


def as_toml(tree):
    """The same as TOML, with everything inline below the first keys."""

    def value(item):
        if isinstance(item, dict):
            inside = (f"{key} = {value(v)}" for key, v in item.items() if v is not None)
            return "{" + ", ".join(inside) + "}"
        if isinstance(item, list):
            return "[" + ", ".join(map(value, item)) + "]"
        return json.dumps(item)

    return "\n".join(f"{key} = {value(item)}" for key, item in tree.items() if item is not None)


def close(a, b):
    """Equal, but for the rounding of angles, which are written in degrees, and of their spread."""
    if isinstance(a, float) and isinstance(b, float):
        return a == b or math.isclose(a, b, rel_tol=1e-14)
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(close(a[key], b[key]) for key in a)
    if isinstance(a, list):
        return len(a) == len(b) and all(map(close, a, b))
    return a == b


def limits_by_dyad(tree):
    """What is said once, for both dyads, as it is for each."""
    given = tree.get("limits", [])
    return {**tree, "limits": given * 2 if len(given) == 1 else given}


def check_round_trip(read, task):
    tree = task_data(task)
    for text, suffix in (
        (json.dumps({"schema": "burmester.synthesis/1", "task": tree}), ".json"),
        (json.dumps(tree), ".json"),
        (as_toml(tree), ".toml"),
    ):
        again = read(text, suffix)
        assert close(limits_by_dyad(task_data(again)), limits_by_dyad(tree))
        assert (again.poses.translation == task.poses.translation).all()
        assert again.poses.angle == pytest.approx(task.poses.angle, rel=1e-15, abs=1e-300)
        assert again.resolution == pytest.approx(task.resolution, rel=1e-14)


@pytest.mark.parametrize("name", cases.names())
def test_what_is_printed_of_a_case_is_read_again(read, name):
    check_round_trip(read, read_task(f"case:{name}"))


def test_what_is_printed_of_any_task_is_read_again(read):
    rng = random.Random(4)
    seen = 0
    while seen < 80:
        task = some_task(rng)
        if task is not None:
            seen += 1
            check_round_trip(read, task)
