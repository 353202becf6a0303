"""Limits and exact poses from files and from the command line's text: read exactly, or refused."""

import json
import tomllib

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Segment
from burmester.io.reading.specification_text import limits_from_options
from burmester.io.reading.tables import pose_rows
from burmester.tasks.limits import Limits
from tests.oracles.marked import carets, marked

H = "x,y,angle_deg,exact\n"
POSES = 'angle_unit = "deg"\nposes = [[0, 0, 0], [1, 2, 30], [3, 1, 60.5]]\n'  # above [limits]


def refused(attempt):
    with pytest.raises(InputError) as caught:
        attempt()
    error = caught.value
    assert error.exit_code == 2
    assert error.where
    assert error.help
    return error


def region(shape):
    """A region as plain numbers."""
    match shape:
        case None:
            return None
        case Point():
            return ("point", *shape.at.tolist())
        case Line() | Segment():
            return (type(shape).__name__.lower(), *shape.start.tolist(), *shape.end.tolist())
        case Polygon():
            return ("polygon", *shape.vertices.ravel().tolist())


def plain(limits):
    """Limits as plain data, so that two of them can be compared."""
    return (
        region(limits.fixed_pivot),
        region(limits.moving_pivot),
        limits.length,
        limits.kinds,
    )


FREE = plain(Limits())
INF = float("inf")
BOX = ("polygon", 0, 0, 4, 0, 4, 2.5, 0, 2.5)


# Exact poses ----------------------------------------------------------------------------------


@pytest.mark.parametrize("block", [1, 30, 1 << 20])
@pytest.mark.parametrize(
    "marks",
    ["yes,no,x,", "TRUE,False,True,FALSE", "1,0,1,0", "X,,x,", " x ,, yes,no ", '"x","","1","0"'],
)
def test_every_way_to_mark_an_exact_pose_in_csv(read, monkeypatch, block, marks):
    monkeypatch.setattr(pose_rows, "BLOCK", block)
    rows = "".join(f"{i},{-i}.5,{10 * i},{mark}\n" for i, mark in enumerate(marks.split(",")))
    task = read(H + rows)
    assert task.exact.tolist() == [True, False, True, False]
    assert task.poses.translation[:, 1].tolist() == [0.5, -1.5, -2.5, -3.5]


def test_marks_beside_names_weights_and_decimal_commas(read):
    task = read("exact;x;name;y;angle_deg;weight\nx;0,5;yes;1;2;1\n;1,5;no;1;2;2\n;2;x;1;3;1\n")
    assert task.exact.tolist() == [True, False, False]
    assert task.names == ("yes", "no", "x")
    assert task.weights.tolist() == [1, 2, 1]
    assert task.poses.translation[:, 0].tolist() == [0.5, 1.5, 2]


def test_no_mark_is_no_column(read):
    assert read(H + "1,2,3,\n4,5,6,no\n7,8,9,0\n").exact is None
    assert read("x,y,angle_deg\n1,2,3\n4,5,6\n7,8,9\n").exact is None


@pytest.mark.parametrize("suffix", [".json", ".toml"])
def test_marks_in_documents(read, suffix):
    if suffix == ".json":
        poses = [{"x": i, "y": i, "angle_deg": i} for i in range(3)]
        poses[1]["exact"], poses[2]["exact"] = True, None
        task = read(json.dumps(poses), suffix)
    else:
        tables = "".join(f"[[poses]]\nx = {i}\ny = 0\nangle_deg = 3\n" for i in range(3))
        text = tables.replace("x = 1\n", "x = 1\nexact = true\n") + "exact = false\n"
        task = read(text, suffix)
    assert task.exact.tolist() == [False, True, False]


@pytest.mark.parametrize("mark", ["maybe", "2", "y", "-", "yes no", "nan"])
def test_other_words_for_exact_are_refused_with_a_caret(read, mark):
    error = refused(lambda: read(H + f"1,2,3,x\n1,2,4,{mark}\n1,2,5,\n"))
    assert error.code == "E104"
    place, line, caret = error.where.splitlines()
    assert place.endswith("poses.csv:3:7")
    assert line[caret.index("^") :] == mark
    assert caret.rstrip().endswith("^" * len(mark) + " exact")
    assert f"'{mark}'" in error.message
    assert read(H + "1,2,3,x\n1,2,4,yes\n1,2,5,\n").exact.tolist() == [True, True, False]


@pytest.mark.parametrize("value", ["1", '"yes"', "[]"])
def test_exact_in_documents_is_true_or_false(read, value):
    text = f'[[0,0,0],[1,1,1],{{"x":1,"y":2,"angle_deg":3,"exact":«{value}»}}]'
    text, *place = marked(text)
    error = refused(lambda: read(text, ".json", angle_unit="deg"))
    assert error.code == "E104"
    assert error.message.startswith("poses[2].exact is ")
    assert list(carets(error.where)[1:]) == place
    assert error.help == "write true or false"


FIVE = "x,y,angle_deg,name\n0,0,0,shut\n1,0,1,2\n2,0,2,half, open\n3,0,3,open\n4,0,4,open\n"
FIVE = FIVE.replace("half, open", '"half, open"')


@pytest.mark.parametrize(
    ("texts", "marked"),
    [
        (["1"], [0]),
        (["1,5"], [0, 4]),
        ([" 3 , 1 "], [0, 2]),
        (["1", "5"], [0, 4]),
        (["shut,3"], [0, 2]),
        (["half, open"], [2]),
        (["2"], [1]),  # a name and a number, both of pose 2
    ],
)
def test_exact_by_number_or_name(read, texts, marked):
    task = read(FIVE, exact=texts)
    assert np.flatnonzero(task.exact).tolist() == marked


@pytest.mark.parametrize(
    ("text", "said", "column"),
    [
        ("6", "no pose '6'", 1),
        ("0", "no pose '0'", 1),
        ("0000000001", "no pose", 1),
        ("-1", "no pose '-1'", 1),
        ("1, ajar", "no pose 'ajar'", 4),
        ("1,,2", "no pose ''", 3),
        ("", "no pose ''", 1),
        ("3,open", "pose 4 and 5", 3),
        ("²", "no pose", 1),
    ],
)
def test_exact_poses_that_do_not_exist_or_are_not_one(read, text, said, column):
    error = refused(lambda: read(FIVE, exact=[text]))
    assert error.code == "E122"
    assert said in error.message
    assert error.where.startswith(f"--exact:1:{column}")


def test_a_number_that_is_the_name_of_another_pose_is_not_guessed(read):
    rows = "x,y,angle_deg,name\n0,0,0,3\n1,0,1,b\n2,0,2,c\n"
    error = refused(lambda: read(rows, exact=["3"]))
    assert error.code == "E122"
    assert "may be pose 1 and 3" in error.message


def test_exact_poses_in_the_file_and_in_the_option_are_refused(read):
    error = refused(lambda: read(H + "1,2,3,x\n4,5,6,\n7,8,9,\n", exact=["2"]))
    assert error.code == "E108"
    task = read(H + "1,2,3,\n4,5,6,\n7,8,9,\n", exact=["2"])
    assert task.exact.tolist() == [False, True, False]


def test_too_many_exact_conditions_are_refused(read):
    rows = "x,y,angle_deg\n" + "".join(f"{i},0,{i}\n" for i in range(7))
    assert refused(lambda: read(rows, exact=["1,2,3,4,5,6"])).code == "E133"
    at = limits_from_options(fixed_pivot=["0,0"])
    assert refused(lambda: read(rows, exact=["1,2,3,4"], specification=at)).code == "E133"
    assert read(rows, exact=["1,2,3"], specification=at).exact.sum() == 3


# Limits in a file -----------------------------------------------------------------------------

SAID = {  # TOML, and the limits that it comes to
    "nothing": ("", []),
    "an empty table": ("[limits]\n", []),
    "a box for both": (
        "[limits]\nfixed_pivot = { box = [[0, 0], [4, 2.5]] }\n",
        [(BOX, None, (0, INF), FREE[3])],
    ),
    "a line and a segment": (
        "[limits]\nfixed_pivot = { line = [[0, 0], [1, 1e-3]] }\n"
        "moving_pivot.segment = [[-1, 2], [3, 4]]\n",
        [(("line", 0, 0, 1, 1e-3), ("segment", -1, 2, 3, 4), (0, INF), FREE[3])],
    ),
    "a polygon": (
        "[limits]\nmoving_pivot.polygon = [[0, 0], [1, 0], [1, 1.25]]\n",
        [(None, ("polygon", 0, 0, 1, 0, 1, 1.25), (0, INF), FREE[3])],
    ),
    "a point is for one dyad": (
        "[limits]\nfixed_pivot.point = [1, 2]\nlength = { most = 200 }\n",
        [(("point", 1, 2), None, (0, 200), FREE[3]), (None, None, (0, 200), FREE[3])],
    ),
    "lengths": (
        "[limits]\nlength = { least = 10, most = 0.2e2 }\n",
        [(None, None, (10, 20), FREE[3])],
    ),
    "least alone": ("[limits]\nlength.least = 10\n", [(None, None, (10, INF), FREE[3])]),
    "kinds": (
        '[limits]\nkinds = ["RR", "PR"]\n',
        [(None, None, (0, INF), frozenset({"RR", "PR"}))],
    ),
    "one table in a list": (
        "[[limits]]\nlength.least = 10\n",
        [(None, None, (10, INF), FREE[3])],
    ),
    "each dyad": (
        '[[limits]]\nfixed_pivot.point = [1, 2]\n[[limits]]\nkinds = ["PR"]\n',
        [(("point", 1, 2), None, (0, INF), FREE[3]), (None, None, (0, INF), frozenset({"PR"}))],
    ),
    "the second alone": (
        "[[limits]]\n[[limits]]\nlength.most = 3\n",
        [FREE, (None, None, (0, 3), FREE[3])],
    ),
}


def as_json(toml):
    """The same document in JSON; its numbers keep their digits well enough here."""
    return json.dumps(tomllib.loads(POSES + toml))


@pytest.mark.parametrize("name", SAID)
def test_limits_in_toml_and_json(read, name):
    text, expected = SAID[name]
    for content, suffix in ((POSES + text, ".toml"), (as_json(text), ".json")):
        task = read(content, suffix)
        assert [plain(limits) for limits in task.limits] == expected
        assert task.resolution[0] == 0, "digits of limits are none of the poses'"


def test_limits_under_task_as_the_command_prints_it(read):
    document = json.loads(as_json("[limits]\nlength.most = 3\n"))
    assert read(json.dumps({"task": document}), ".json").limits[0].length == (0, 3)
    document["limits"]["length"] = 3
    text = json.dumps({"task": document}, indent=1)
    error = refused(lambda: read(text, ".json"))
    assert error.message == "task.limits.length does not fit: 3"
    _, line, column, width = carets(error.where)
    assert text.splitlines()[line - 1].strip() == '"length": 3'
    assert (text.splitlines()[line - 1][column - 1 :], width) == ("3", 1)


def test_numbers_of_limits_come_back_bit_by_bit(read):
    rng = np.random.default_rng(2)
    for _ in range(50):
        x, y = (rng.normal(size=2) * 10.0 ** rng.integers(-9, 9)).tolist()
        tree = json.loads(as_json(""))
        tree["limits"] = {"fixed_pivot": {"point": [x, y]}}
        assert read(json.dumps(tree), ".json").limits[0].fixed_pivot.at.tolist() == [x, y]
        text = limits_from_options(fixed_pivot=[f"{x!r},{y!r}"])
        assert text.fixed_pivot[0].at.tolist() == [x, y]


FAULTS = [  # TOML, code, the path that is named, what the message holds
    ("[limits]\nfixed_pivot.point = [1, «inf»]\n", "E103", "limits.fixed_pivot.point[1]", "finite"),
    ('[limits]\nfixed_pivot.point = [1, «"2"»]\n', "E104", "limits.fixed_pivot.point[1]", "'2'"),
    ("[limits]\nfixed_pivot = «[1, 2]»\n", "E104", "limits.fixed_pivot", "does not fit"),
    ('[limits]\nkinds = «"RR"»\n', "E104", "limits.kinds", "'RR'"),
    ("[limits]\nkinds = [«1»]\n", "E104", "limits.kinds[0]", "1"),
    ("[[limits]]\n[[limits]]\nfixed_pivot = «{}»\n", "E105", "limits[1].fixed_pivot", "no shape"),
    ("[limits]\nfixed_pivot.point = «[1, 2, 3]»\n", "E106", "limits.fixed_pivot.point", "than 2"),
    (
        "[limits]\nfixed_pivot.box = [[1, 2], «[3]»]\n",
        "E106",
        "limits.fixed_pivot.box[1]",
        "1 of 2",
    ),
    ("limits = «[]»\n", "E106", "limits", "0 tables"),
    ("[[limits]]\n[[limits]]\n«[[limits]]»\n", "E106", "limits", "3 tables"),
    ("[limits]\n«fixed» = 1\n", "E107", "limits.fixed", "not known"),
    ("[«limit»]\nlength.most = 2\n", "E107", "limit ", "has no effect"),
    ("«fixed_pivot» = { point = [1, 2] }\n", "E107", "fixed_pivot", "has no effect"),
    ("«exact» = [1, 5]\n", "E107", "exact", "has no effect"),
    (
        "[limits]\nfixed_pivot = «{ point = [1, 2], box = [[0, 0], [1, 1]] }»\n",
        "E108",
        "limits.fixed_pivot",
        "point and box",
    ),
    (
        "[limits]\nfixed_pivot.line = «[[1, 2], [1, 2]]»\n",
        "E131",
        "limits.fixed_pivot.line",
        "twice",
    ),
    ('[limits]\nkinds = [«"RRR"»]\n', "E131", "limits.kinds[0]", "no dyad kind RRR"),
    ("[limits]\nkinds = «[]»\n", "E131", "limits.kinds", "no dyad kind is left"),
    (
        "[[limits]]\n[[limits]]\nfixed_pivot.box = «[[0, 5], [1, 4]]»\n",
        "E132",
        "limits[1].fixed_pivot.box",
        "y from 5 to 4",
    ),
    ("[limits]\nlength = «{ least = 5, most = 4 }»\n", "E132", "limits.length", "at least 5 long"),
    (
        '[[limits]]\n«[[limits]]»\nfixed_pivot.point = [0, 0]\nkinds = ["PR"]\n',
        "E132",
        "limits[1]",
        "fixed pivot at (0, 0)",
    ),
]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"{fault[1]}-{fault[2]}")
def test_what_is_no_limit_is_refused_with_its_path_and_place(read, fault):
    text, code, path, holds = fault
    text, *place = marked(POSES + text)
    error = refused(lambda: read(text, ".toml"))
    assert error.code == code
    assert error.message.startswith(path)
    assert holds in error.message
    name, *found = carets(error.where)
    assert name.endswith("poses.toml")
    assert found == place


@pytest.mark.parametrize("key", ["poses", "angle_unit"])
def test_poses_below_the_head_of_limits_belong_to_it(read, key):
    lines = {"poses": "poses = [[0, 0, 0]]\n", "angle_unit": 'angle_unit = "deg"\n'}
    error = refused(lambda: read("[limits]\n" + lines[key], ".toml"))
    assert error.code == "E107"
    assert error.message.startswith(f"limits.{key} ")
    assert carets(error.where)[1:] == (2, 1, len(key))
    assert f"write {key} above" in error.help


def test_the_help_on_regions_and_lengths_can_be_followed(read):
    error = refused(lambda: read(POSES + "[limits]\nfixed_pivot = [1, 2]\n", ".toml"))
    for shape in ("point", "line", "segment", "box", "polygon"):
        assert shape in error.help
    error = refused(lambda: read(POSES + "[limits]\nlength = [1, 2]\n", ".toml"))
    assert "least and most" in error.help
    text = POSES + "[limits]\nlength = { least = 1, most = 2 }\n"
    assert read(text, ".toml").limits[0].length == (1, 2)


# Limits on the command line -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1,2", ("point", 1, 2)),
        ("-2,1", ("point", -2, 1)),
        (" -.5 , +1e1 ", ("point", -0.5, 10)),
        ("point:1,2", ("point", 1, 2)),
        ("line:0,0:1,-1", ("line", 0, 0, 1, -1)),
        ("segment:0,0:1,1", ("segment", 0, 0, 1, 1)),
        ("box:0,0:4,2.5", BOX),
        ("polygon:0,0:1,0:1,1.25:0.5,2", ("polygon", 0, 0, 1, 0, 1, 1.25, 0.5, 2)),
        ("any", None),
    ],
)
def test_regions_as_text(text, expected):
    (found,) = limits_from_options(fixed_pivot=[text]).fixed_pivot
    assert region(found) == expected
    (found,) = limits_from_options(moving_pivot=[text]).moving_pivot
    assert region(found) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [("10:200", (10, 200)), ("10:", (10, INF)), (":2e2", (0, 200)), ("5:5", (5, 5))],
)
def test_lengths_as_text(text, expected):
    assert limits_from_options(length=[text]).length == (expected,)


def test_kinds_as_text():
    assert limits_from_options(kinds=["RR, pr"]).kinds == (frozenset({"RR", "PR"}),)
    assert limits_from_options(kinds=["any", "RP"]).kinds == (None, frozenset({"RP"}))


TEXT_FAULTS = [  # option, text, column and width of the caret, what is said
    ("fixed_pivot", "", 1, 1, "not a point"),
    ("fixed_pivot", "1,2,3", 1, 5, "not a point X,Y"),
    ("fixed_pivot", "1,x", 3, 1, "'x' is not a finite number"),
    ("fixed_pivot", "1, nan", 4, 3, "'nan' is not a finite number"),
    ("fixed_pivot", "1_0,2", 1, 3, "not a finite number"),
    ("moving_pivot", "circle:1,2", 1, 6, "no region 'circle'"),
    ("moving_pivot", "line:1,2", 1, 8, "a line takes 2 points, not 1"),
    ("moving_pivot", "box:0,0:1", 9, 1, "not a point"),
    ("moving_pivot", "line:1,2:1,2", 1, 12, "two different points"),
    ("length", "10", 1, 2, "not a range"),
    ("length", "1:b", 3, 1, "'b'"),
    ("length", "1,5:2", 1, 3, "'1,5'"),
    ("kinds", "RR,RX", 4, 2, "no dyad kind 'RX'"),
]


@pytest.mark.parametrize("fault", TEXT_FAULTS, ids=lambda fault: f"{fault[0]}-{fault[1]}")
def test_text_that_is_no_limit_is_refused_with_a_caret(fault):
    option, text, column, width, said = fault
    error = refused(lambda: limits_from_options(**{option: [text]}))
    assert error.code == "E131"
    assert said in error.message
    place, *lines = error.where.splitlines()
    assert place == f"--{option.replace('_', '-')}:1:{column}"
    if lines:
        assert lines[0].endswith(text)
        assert lines[1].count("^") == width


def test_an_empty_box_is_e132():
    assert refused(lambda: limits_from_options(fixed_pivot=["box:0,0:-1,2"])).code == "E132"


@pytest.mark.parametrize("option", ["fixed_pivot", "moving_pivot", "length", "kinds"])
def test_a_linkage_has_two_dyads(option):
    error = refused(lambda: limits_from_options(**{option: ["any"] * 3}))
    assert error.code == "E131"
    assert "3 times" in error.message


def limits_of(**options):
    return [plain(limits) for limits in limits_from_options(**options).limits()]


def test_once_is_for_both_and_twice_for_each():
    line = ("line", 0, 0, 1, 0)
    assert limits_of() == []
    assert limits_of(fixed_pivot=["any"]) == []
    assert limits_of(fixed_pivot=["line:0,0:1,0"]) == [(line, None, (0, INF), FREE[3])]
    assert limits_of(fixed_pivot=["line:0,0:1,0", "any"]) == [(line, None, (0, INF), FREE[3]), FREE]
    assert limits_of(fixed_pivot=["any", "1,2"], length=["1:2"]) == [
        (None, None, (1, 2), FREE[3]),
        (("point", 1, 2), None, (1, 2), FREE[3]),
    ]
    assert limits_of(length=["1:2", ":3"], kinds=["RR"]) == [
        (None, None, (1, 2), frozenset({"RR"})),
        (None, None, (0, 3), frozenset({"RR"})),
    ]


def test_a_point_given_once_is_for_the_first_dyad():
    point = ("point", 1, 2)
    assert limits_of(fixed_pivot=["1,2"]) == [(point, None, (0, INF), FREE[3]), FREE]
    assert limits_of(fixed_pivot=["1,2"], moving_pivot=["any", "1,2"]) == [
        (point, None, (0, INF), FREE[3]),
        (None, point, (0, INF), FREE[3]),
    ]
    assert limits_of(fixed_pivot=["1,2"], moving_pivot=["1,2"]) == [
        (point, point, (0, INF), FREE[3]),
        FREE,
    ]


def test_contradictions_on_the_command_line_say_so():
    error = refused(limits_from_options(fixed_pivot=["1,2"], kinds=["PR"]).limits)
    assert error.code == "E132"
    assert error.where == "--fixed-pivot 1,2, and --kinds PR"


def test_file_and_command_line_add_up_but_not_on_the_same_thing(read):
    text = POSES + "[limits]\nlength.most = 3\n"
    task = read(text, ".toml", specification=limits_from_options(fixed_pivot=["1,2"]))
    assert [plain(limits) for limits in task.limits] == [
        (("point", 1, 2), None, (0, 3), FREE[3]),
        (None, None, (0, 3), FREE[3]),
    ]
    for again in ("1:2", "any"):
        twice = limits_from_options(length=[again])
        error = refused(lambda: read(text, ".toml", specification=twice))  # noqa: B023
        assert error.code == "E108"
        assert "length" in error.message
        assert error.where.endswith(f"poses.toml:4:1, and --length {again}")
    error = refused(lambda: read(text, ".toml", specification=limits_from_options(kinds=["PR"])))
    assert error.code == "E132"
    assert error.where.endswith("poses.toml:4:1, and --kinds PR")
