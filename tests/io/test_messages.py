"""Every message: triggered, drawn, told in JSON, and its help followed literally.

`CASES` has one entry a message.  Its files are written to an empty folder, a command is run there
(or a function called), and the code is expected.  Then somebody does what the help says, which
`follow` holds, and runs the command again: the code must be gone and the input usable.

The golden messages are in `__snapshots__`; `EVERY_SAMPLE=1 pytest tests/io/test_messages.py
--snapshot-update` writes them anew, and with them the examples of `io/messages.md`, which are these
messages.
"""

import io
import json
import os
import re
import shlex
import sys
import tempfile
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from functools import cache
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from rich.cells import cell_len
from rich.console import Console

import burmester
from burmester import cli, synthesize
from burmester.certificates.ball_arithmetic import flint
from burmester.dyads.five_poses import dyads_of_five
from burmester.errors import BurmesterError, InputError
from burmester.export import Options, pylinkage
from burmester.fourbar.dyad import PP, RR
from burmester.geometry.displacement import Displacement
from burmester.io.explain import pages
from burmester.io.message import location_lines, note, show
from burmester.io.reading.link import LinkedTask, write_link
from burmester.io.reading.poses import read_task
from burmester.io.result import failure, synthesis_data
from burmester.io.saved import read_result
from burmester.progress import limited
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.traced_path import TracedPath
from tests.oracles.conventions import crank_rocker, table, written
from tests.oracles.coupler_curves import CABRERA, CABRERA_TURNS
from tests.oracles.drawings import svg
from tests.oracles.measured import as_csv, measured
from tests.oracles.recordings import nexus, recording
from tests.oracles.ten_poses import ROWS, TEN
from tests.samples import EVERY

NARROW, WIDE_ENOUGH = 60, 10_000  # columns
ROOT = Path(burmester.__file__).parent
SCHEMAS = [
    json.loads((ROOT / "io" / f"{name}.schema.json").read_text())
    for name in ("synthesis", "function")
]
SCHEMA_OF = {each["properties"]["schema"]["const"]: Draft202012Validator(each) for each in SCHEMAS}


class Args(NamedTuple):
    """Follow the help with another command."""

    line: str


class Edit(NamedTuple):
    """Follow it with an edit of a file; the command stays."""

    file: str
    old: str
    new: str


class Write(NamedTuple):
    """Follow it with a new file, and with another command if one is given."""

    file: str
    text: str | bytes
    line: str | None = None


class Call(NamedTuple):
    """Follow it with another call."""

    call: Callable[[], object]


class Case(NamedTuple):
    """One message.

    files: what lies in the folder; run: the command, or a call; follow: what its help says, or
    None where there is no help (or none to follow: a success, a bug).
    """

    code: str
    run: str | Callable[[], object]
    follow: Args | Edit | Write | Call | Callable[[str], object] | None
    files: Mapping[str, str | bytes | Callable[[], str]] = MappingProxyType({})
    exit: int = 2


FIVE = "x,y,angle_deg\n" + "".join(ROWS.splitlines(keepends=True)[:5])
SWAPPED = "\n".join(FIVE.splitlines()[k] for k in (0, 1, 3, 2, 4, 5))
FOUR = "\n".join(FIVE.splitlines()[:5])
TWO_ANGLES = "0.2,2.4,10 2,-4.4,50 1.2,9.4,50 -6.7,-5.2,10 -2.7,-10.5,50 0,5.9,10 3.3,4,50"
POINTS = "px,py,qx,qy\n0,0,5,0\n3,1,7,4\n4,3,7,7\n5,3,5,8\n6,2,3,6\n"
GOOD = {"poses.csv": FIVE}
OPENING = "0,0,0 30,77,45 95,110,95"
LOG = 'function "log10(x)" --x 1:2 --input 60 --output 60'
SQUARE = 'function "x**2" --x=-1:1 --input 90 --output 60'
PAIRS = "input_deg,output_deg\n0,0\n15,10\n30,25\n45,45\n60,75\n"
ODD_PAIR = (
    "input_deg,output_deg\n0,0\n10,15.63\n20,30.78\n30,45\n40,57.85\n50,69.94\n60,77.94\n"
    "70,84.57\n80,88.63\n90,90\n"
)
LOCKED = "input_deg,output_deg\n0,0\n40,80\n80,20\n120,90\n160,10\n"
TOLERANT = "x,y,angle_deg,tol_{},tol_{}\n" + ROWS.replace("\n", ",0.1,0.2\n")
DIRECTIONS = table(written(crank_rocker(), "directions"), "x,y,cos,sin")
DIRECTION_ROWS = DIRECTIONS.partition("\n")[2]
BOXES = "--fixed-pivot box:-50,-100:150,20 --moving-pivot box:-60,-60:60,60"
WIDE = "--fixed-pivot box:-200,-200:250,250 --moving-pivot box:-150,-150:150,150"
FEW = {"poses.csv": "\n".join(FIVE.splitlines()[:4])}
ALL = {"poses.csv": TEN}
MIXED = (
    "0.973329,1.841643,51.84518 1.013217,2.219586,38.83281 "
    "0.643693,2.389129, 0.092623,2.243994,29.85902 "
    "-0.450987,1.760176, -0.716342,1.141258,44.56691"
)
CROSS = (
    "-6,-6 -4,-4.667 -2,-3.333 0,-2 2,-3.333 4,-4.667 6,-6 4.667,-4 3.333,-2 2,0 3.333,2 4.667,4 "
    "6,6 4,4.667 2,3.333 0,2 -2,3.333 -4,4.667 -6,6 -4.667,4 -3.333,2 -2,0 -3.333,-2 -4.667,-4 "
    "-6,-6"
)
CIRCLE = "x,y\n3,4\n4,3\n5,0\n0,5\n-3,4\n-4,3\n-5,0\n0,-5\n3,-4\n"


def timed(*numbers):
    """Some of Cabrera's points with their crank angles."""
    crank = np.degrees(CABRERA_TURNS)[list(numbers)].round(9).tolist()
    data = {"angle_unit": "deg", "path": {"crank_deg": crank}}
    data["tolerance"] = {"x": 0, "y": 0, "angle": "free"}
    return json.dumps(data | {"poses": [[x, y, 0] for x, y in CABRERA[list(numbers)].tolist()]})


BOW = "M 0 40 C 10 0 50 0 80 30"
BOWS = {"path.svg": svg(f'<path d="{BOW}"/>')}
LID_PATH = '<path id="lid" d="M 0 0 L 4 0 L 4 2 L 0 2 z"/>'


def with_z(heights):
    """Five poses with a third coordinate."""
    head, *lines = FIVE.splitlines()
    parts = [line.split(",") for line in lines]
    rows = [f"{x},{y},{z},{angle}" for (x, y, angle), z in zip(parts, heights, strict=True)]
    return "\n".join([head.replace("x,y,", "x,y,z,"), *rows, ""])


def tilted():
    """A recording from cameras that stand askew."""
    names, places = recording(30, noise=0.05)
    tilt = np.radians(25)
    turn = [[1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]]
    return names, places @ np.array(turn)


def sliding():
    """A recording in which M2 slips along the body."""
    names, places = recording(100, noise=0.05)
    places[:, 1, 0] += np.linspace(0, 6, 100)
    return names, places


# Poses of a four-bar of 12, 22 and 30 mm that turn by 1.8 degrees.
SMALL_TURN = """\
x_mm,y_mm,angle_deg
6.4836277,10.0976518,273.9448003
6.1649618,10.2953021,274.0479477
5.8402760,10.4828992,274.1895231
5.5098873,10.6602600,274.3680357
5.1741182,10.8272111,274.5820078
4.8332967,10.9835897,274.8299795
4.4877556,11.1292430,275.1105137
4.1378322,11.2640288,275.4221993
3.7838683,11.3878154,275.7636543
"""


def rows(text):
    """A CSV file of rows with blanks between them."""
    return "x,y,angle_deg\n" + "\n".join(text.split()) + "\n"


def exchanged(text, *numbers):
    """The rows of a text, two of them in each other's place."""
    rows = text.splitlines()
    first, second = (number - 1 for number in numbers)
    rows[first], rows[second] = rows[second], rows[first]
    return "\n".join(rows) + "\n"


@cache
def doubled():
    """Five poses between some with two real dyads and some with four: two are one, to rounding."""
    rng = np.random.default_rng(0)
    for _ in range(6):
        two, four = (
            np.column_stack([rng.uniform(-5, 5, (5, 2)), rng.uniform(0, 120, 5)]) for _ in "ab"
        )

    def real(poses):
        found = dyads_of_five(Displacement(poses[:, :2], np.radians(poses[:, 2])))
        return int(found.real.sum())

    two, four = sorted((two, four), key=real)
    assert (real(two), real(four)) == (2, 4)
    for _ in range(70):
        middle = (two + four) / 2
        two, four = (two, middle) if real(middle) == 4 else (middle, four)
    return "x,y,angle_deg\n" + "".join(",".join(map(repr, row)) + "\n" for row in four.tolist())


def json_poses(extra="", rows="[0, 0, 0], [3, 1, 40], [4, 3, 70]"):
    return f'{{"angle_unit": "deg", {extra}"poses": [{rows}]}}'


def toml_poses(extra=""):
    rows = ", ".join(f"[{row}]" for row in ROWS.splitlines()[:5])
    return f'angle_unit = "deg"\nposes = [{rows}]\n{extra}'


def loaded(tables, unit='length_unit = "mm"\n'):
    """Three poses under loads."""
    rows = "[[0, 0, 0], [-20, -10, 25], [-60, -5, 60]]"
    return f'angle_unit = "deg"\n{unit}poses = {rows}\n{tables}'


def poses(count, turn=0.3):
    """So many poses in general position."""
    k = np.arange(count)
    return Displacement(np.stack([np.cos(1.7 * k) + k, np.sin(2.3 * k)], axis=-1), turn * k**1.5)


START = RR(np.array([1.0, 2.0]), np.array([0.5, 0.0]), np.array(3.0))


def api(name):
    """A function of the package by its full name."""
    module, _, function = name.rpartition(".")
    return getattr(import_module(f"burmester.{module}"), function)


def made(command, file):
    """Make the folder that a help wants made, and write into it."""
    *_, folder = shlex.split(command)
    os.makedirs(folder)
    api("io.files.write")(file, "new")


def parquet():
    """Three poses as a Parquet file."""
    arrow, written = import_module("pyarrow"), io.BytesIO()
    columns = {"x": [0.0, 3.0, 4.0], "y": [0.0, 1.0, 3.0], "angle_deg": [0.0, 40.0, 70.0]}
    import_module("pyarrow.parquet").write_table(arrow.table(columns), written)
    return written.getvalue()


def batch(out="out", **given):
    """A batch of two tasks."""
    lines = [f"{task},{row}" for task in "ab" for row in ROWS.splitlines()]
    Path("tasks.csv").write_text("\n".join(["task,x,y,angle_deg", *lines, ""]))
    return api("batch.job.run")("tasks.csv", out, **{"depth": "pencil", "workers": 1, **given})


def another_batch():
    """One in a folder that holds another."""
    with suppress(InputError):
        batch(depth="dyads", part_tasks=10, dask="nowhere://host")
    batch(part_tasks=10)


def second_run():
    """One while another works on its folder."""
    with api("batch.out_folder.OutFolder")("out").held():
        batch()


def other_version(version):
    """What a worker does with a part that comes from another version."""
    plan = api("batch.part_file.Plan")
    texts = api("batch.parts.TextTasks")((), (), ())
    options, here = api("batch.options.BatchOptions")(), api("batch.part_file.versions")()
    api("batch.part_file.work")(
        api("batch.parts.Part")(0, texts, 1.0),
        plan("pencil", options, "", 60, {**here, "burmester": version}),
        {},
    )


def in_help(option, help):
    """An option with its value, as a help proposes it."""
    return re.search(rf"{option} \d+", help)[0]


def in_backticks(help):
    """What a help puts in backticks, first."""
    return re.search(r"`(.+?)`", help)[1]


S = "synthesize poses.csv"
SIX = "--six-bars --chains"
J = "judge poses.csv"
LINK = write_link(
    LinkedTask(
        {
            "angle_unit": "deg",
            "poses": [[0, 0, 0], [5, 1, 10], [9, 4, 30], [11, 9, 50], [12, 12, 60]],
        }
    )
)
FIRST, SECOND = "--dyad -2.2,0.1:1.24,0.1", "--dyad 1.14,0.39:4.58,1.31"
SIX_BAR = """\
ground = {A = [-2.2, 0.1], B = [1.1, 0.4]}
coupler = {D = [1, 1], E = [3, 0]}
second_crank = {D = [2, 0], G = [2, 2]}
body = {E = [0, 1], H = [2, 1]}
lengths = {AC = 2.5, GH = 4}
"""
CRANK = """\
[[dyads]]
fixed_pivot = [-2.2, 0.1]
moving_pivot = [1.24, 0.1]

[[dyads]]
fixed_pivot = [1.14, 0.39]
moving_pivot = [4.58, 1.31]
"""
CASES: dict[str, Case] = {
    # --- usage
    "argument missing": Case("E100", "synthesize", Args("synthesize --help")),
    "code unknown": Case(
        "E100", "explain E1O3", lambda help: Args(in_backticks(help).split(" ", 1)[1])
    ),
    # --- files
    "file missing": Case("E101", "synthesize pose.csv", Args(S), GOOD),
    "case without its head": Case(
        "E101",
        "synthesize motiongen-mixed5",
        lambda help: Args("synthesize " + re.search(r"case:[\w-]+", help)[0]),
    ),
    "case unknown": Case(
        "E101",
        "synthesize case:motiongen",
        lambda help: Args("synthesize " + re.search(r"case:[\w-]+", help)[0]),
    ),
    "not text": Case(
        "E101",
        S,
        Write("poses.csv", FIVE.replace("unit", "Grö\xdfe").encode()),
        {"poses.csv": "# Größe\n".encode("shift-jis", "replace") + b"\x81\n" + FIVE.encode()},
    ),
    "empty": Case("E102", S, Write("poses.csv", FIVE), {"poses.csv": ""}),
    "only a header": Case("E102", S, Write("poses.csv", FIVE), {"poses.csv": "x,y,angle_deg\n"}),
    # --- numbers
    "not finite": Case(
        "E103",
        S,
        Edit("poses.csv", "-2.6392,0.2920,inf\n", ""),
        {"poses.csv": TEN.replace("49.90", "inf")},
    ),
    "too large": Case(
        "E103",
        S,
        Edit("poses.csv", "1e400", "-12.5"),
        {"poses.csv": FIVE.replace("-3.5027", "1e400")},
    ),
    "not finite in JSON": Case(
        "E103",
        "synthesize poses.json",
        Edit("poses.json", "NaN", "70"),
        {"poses.json": json_poses().replace("70", "NaN")},
    ),
    "not finite in Python": Case(
        "E103",
        lambda: api("dyads.pencil.fit_pencil")(Displacement(np.full((6, 2), np.inf), np.zeros(6))),
        Call(lambda: api("dyads.pencil.fit_pencil")(poses(6))),
    ),
    "text for a number": Case(
        "E104",
        S,
        Edit("poses.csv", "about 3", "3"),
        {"poses.csv": FIVE.replace("-3.5027", "about 3")},
    ),
    "ambiguous comma": Case(
        "E104",
        S,
        Write("poses.csv", "x;y;angle_deg\n1.250;0;0\n3000;1000;40\n4000;3000;70\n"),
        {"poses.csv": "x;y;angle_deg\n1,250;0;0\n3000;1000;40\n4000;3000;70\n"},
    ),
    "text for a mark": Case(
        "E104",
        S,
        Edit("poses.csv", "maybe", "yes"),
        {"poses.csv": "x,y,angle_deg,exact\n0,0,0,maybe\n3,1,40,\n4,3,70,\n"},
    ),
    "quotes in JSON": Case(
        "E104",
        "synthesize poses.json",
        Edit("poses.json", '"40"', "40"),
        {"poses.json": json_poses().replace("40", '"40"')},
    ),
    "no header": Case(
        "E105",
        S,
        lambda help: Write("poses.csv", f"{in_backticks(help)}\n{ROWS}"),
        {"poses.csv": ROWS},
    ),
    "no header above cosine and sine": Case(
        "E105",
        S,
        lambda help: Write("poses.csv", f"{in_backticks(help)}\n{DIRECTION_ROWS}"),
        {"poses.csv": DIRECTION_ROWS},
    ),
    "no header above five columns": Case(
        "E105",
        S,
        Args(f"{S} --columns x,y,angle_deg,weight,#mark"),
        {"poses.csv": ROWS.replace("\n", ",1,7\n")},
    ),
    "no such convention": Case(
        "E115", f"{S} --convention ydown", Args(f"{S} --convention y-down"), {"poses.csv": FIVE}
    ),
    "a convention of points": Case(
        "E115", f"{S} --convention clockwise", Args(S), {"poses.csv": POINTS}
    ),
    "a convention of tolerances": Case(
        "E115",
        f"{S} --convention swap-xy",
        lambda _: Write(
            "poses.csv", TOLERANT.format("x", "y").replace("x,y,angle", "y,x,angle"), S
        ),
        {"poses.csv": TOLERANT.format("x", "y")},
    ),
    "no direction": Case(
        "E116",
        S,
        Edit("poses.csv", "0.8,0.2", "0.8,0.6"),
        {"poses.csv": "x,y,cos,sin\n0,0,1,0\n3,1,0.8,0.2\n4,3,0.3420,0.9397\n"},
    ),
    "a link cut off": Case("E117", f"synthesize {LINK[:-9]}", Args(f"synthesize {LINK}")),
    "no column y": Case(
        "E105",
        S,
        Edit("poses.csv", "x,z,angle_deg", "x,y,angle_deg"),
        {"poses.csv": FIVE.replace("x,y,", "x,z,")},
    ),
    "no angle in JSON": Case(
        "E105",
        "synthesize poses.json",
        Edit("poses.json", '{"x": 3, "y": 1}', '{"x": 3, "y": 1, "angle_deg": 40}'),
        {"poses.json": json_poses().replace("[3, 1, 40]", '{"x": 3, "y": 1}')},
    ),
    "short row": Case(
        "E106",
        S,
        Edit("poses.csv", "0.3088\n", "0.3088,43.94\n"),
        {"poses.csv": FIVE.replace("0.3088,43.94", "0.3088")},
    ),
    "decimal commas between commas": Case(
        "E106",
        S,
        Edit("poses.csv", "-0,8253,-1,0329,91,91", "-0.8253,-1.0329,91.91"),
        {"poses.csv": FIVE.replace("-0.8253,-1.0329,91.91", "-0,8253,-1,0329,91,91")},
    ),
    "decimal comma and a blank weight": Case(
        "E106",
        S,
        Edit("poses.csv", "2,0008,1.7,30.2,", "2.0008,1.7,30.2,1"),
        {"poses.csv": "x,y,angle_deg,weight\n0,0,0,1\n3,1,40,1\n4,3,70,1\n2,0008,1.7,30.2,\n"},
    ),
    "a separator too many": Case(
        "E106",
        S,
        Edit("poses.csv", "3;1;40;", "3;1;40"),
        {"poses.csv": "x;y;angle_deg\n0;0;0\n3;1;40;\n4;3;70\n"},
    ),
    "rows without the blank cells of the header": Case(
        "E106",
        S,
        Edit("poses.csv", "angle_deg;;", "angle_deg"),
        {"poses.csv": "x;y;angle_deg;;\n0;0;0\n3;1;40\n4;3;70\n"},
    ),
    "three limits": Case(
        "E106",
        "synthesize poses.toml",
        Edit("poses.toml", '[[limits]]\nkinds = ["RP"]\n', ""),
        {
            "poses.toml": toml_poses(
                '[[limits]]\nkinds = ["RR"]\n[[limits]]\nkinds = ["RR"]\n'
                '[[limits]]\nkinds = ["RP"]\n'
            )
        },
    ),
    "column unknown": Case(
        "E107",
        S,
        lambda help: Edit("poses.csv", "notes", re.search(r'"#.+?"', help)[0]),
        {"poses.csv": "x,y,angle_deg,notes\n0,0,0,start\n3,1,40,\n4,3,70,end\n"},
    ),
    "limits beside the poses": Case(
        "E107",
        "synthesize poses.toml",
        Edit("poses.toml", 'kinds = ["RR"]', '[limits]\nkinds = ["RR"]'),
        {"poses.toml": toml_poses('kinds = ["RR"]\n')},
    ),
    "column twice": Case(
        "E108",
        S,
        Write("poses.csv", "x,y,angle_deg\n0,0,0\n3,1,40\n4,3,70\n"),
        {"poses.csv": "x,y,angle_deg,angle_rad\n0,0,0,0\n3,1,40,0.7\n4,3,70,1.2\n"},
    ),
    "two units": Case(
        "E108",
        S,
        Edit("poses.csv", "y_in", "y_mm"),
        {"poses.csv": FIVE.replace("x,y", "x_mm,y_in")},
    ),
    "key twice": Case(
        "E108",
        "synthesize poses.json",
        Edit("poses.json", '"angle_unit": "rad", ', ""),
        {"poses.json": json_poses('"angle_unit": "rad", ')},
    ),
    "limited twice": Case(
        "E108",
        "synthesize poses.toml --kinds RR",
        Args("synthesize poses.toml"),
        {"poses.toml": toml_poses('[limits]\nkinds = ["RR"]\n')},
    ),
    "exact twice": Case(
        "E108",
        f"{S} --exact 1",
        Args(S),
        {"poses.csv": "x,y,angle_deg,exact\n0,0,0,x\n3,1,40,\n4,3,70,\n"},
    ),
    "not JSON": Case(
        "E109",
        "synthesize poses.json",
        Edit("poses.json", '"poses": [[0, 0, 0] [3', '"poses": [[0, 0, 0], [3'),
        {"poses.json": json_poses().replace("0], [3", "0] [3")},
    ),
    "not TOML": Case(
        "E109",
        "synthesize poses.toml",
        Edit("poses.toml", "45.58]", "45.58]]"),
        {"poses.toml": toml_poses().replace("]]", "]")},
    ),
    "no angle unit": Case(
        "E110",
        S,
        Args(f"{S} --angle-unit deg"),
        {"poses.csv": FIVE.replace("angle_deg", "angle")},
    ),
    "two angle units": Case("E110", f"{S} --angle-unit rad", Args(S), GOOD),
    # --- tasks
    "one pose": Case(
        "E120",
        S,
        Write("poses.csv", "\n".join(TEN.splitlines()[:3])),
        {"poses.csv": "\n".join(TEN.splitlines()[:2])},
    ),
    "exact method for ten": Case("E121", f"{S} --method exact", Args(S), ALL),
    "pencil for five": Case("E121", f"{S} --method pencil", Args(S), GOOD),
    "curve of five": Case(
        "E121",
        lambda: api("dyads.burmester_curve.dyad_curve")(poses(5)),
        Call(lambda: api("dyads.five_poses.dyads_of_five")(poses(5))),
    ),
    "five of four": Case(
        "E121",
        lambda: api("dyads.five_poses.dyads_of_five")(poses(4)),
        Call(lambda: api("dyads.five_poses.dyads_of_five")(poses(5))),
    ),
    "best dyads of four": Case(
        "E121",
        lambda: api("dyads.critical_points.critical_dyads")(poses(4)),
        Call(lambda: api("dyads.burmester_curve.dyad_curve")(poses(4))),
    ),
    "distances of four": Case(
        "E121",
        lambda: api("dyads.image_space_fits.algebraic_fit")(poses(4), START),
        Call(lambda: api("dyads.image_space_fits.algebraic_fit")(poses(5), START)),
    ),
    "pencil of four": Case(
        "E121",
        lambda: api("dyads.pencil.fit_pencil")(poses(4)),
        Call(lambda: api("dyads.burmester_curve.dyad_curve")(poses(4))),
    ),
    "quadric of none": Case(
        "E121",
        lambda: api("geometry.quadric.fit_quadric")(np.empty((0, 4))),
        Call(lambda: api("geometry.quadric.fit_quadric")(poses(9).as_image_point())),
    ),
    "pose unknown": Case("E122", f"{S} --exact 11", Args(f"{S} --exact 1,5"), GOOD),
    "weight of zero": Case(
        "E122",
        S,
        Edit("poses.csv", "4,3,70,0\n", ""),
        {"poses.csv": "x,y,angle_deg,weight\n0,0,0,1\n3,1,40,1\n4,3,70,0\n5,3,90,1\n"},
    ),
    "names that do not fit": Case(
        "E122",
        lambda: burmester.Task(poses(3), names=("open", "closed")),
        Call(lambda: burmester.Task(poses(3), names=("open", "half", "closed"))),
    ),
    "raw, but not the pencil": Case(
        "E123", f"{S} --raw --method complete", Args(f"{S} --raw --method pencil"), ALL
    ),
    "pencil with limits": Case(
        "E123",
        f"{S} --method pencil --kinds RR",
        Args(f"{S} --method complete --kinds RR"),
        ALL,
    ),
    "certificate with limits": Case(
        "E123", f"{S} --certify --kinds RR", Args(f"{S} --kinds RR"), ALL
    ),
    "four poses of one turn": Case(
        "E124",
        lambda: api("dyads.burmester_curve.dyad_curve")(
            Displacement(np.zeros((4, 2)), 0.4 * np.arange(4))
        ),
        Call(
            lambda: api("dyads.burmester_curve.dyad_curve")(
                Displacement([(0, 0), (0, 0), (3, -1), (1, 2)], 0.4 * np.arange(4))
            )
        ),
    ),
    "two columns in Python": Case(
        "E125",
        lambda: api("values.real_numbers")([[0, 0], [3, 1]], (None, 3), "poses"),
        Call(lambda: api("values.real_numbers")([[0, 0, 0], [3, 1, 40]], (None, 3), "poses")),
    ),
    "followed to fewer poses": Case(
        "E157",
        lambda: api("following.follow.follow")(synthesize(poses(5)), burmester.Task(poses(4))),
        Call(lambda: synthesize(burmester.Task(poses(4)))),
    ),
    "no python-flint": Case("E130", f"{S} --certify", Args(f"{S} --certify"), GOOD),
    # --- limits
    "region unknown": Case(
        "E131",
        f"{S} --fixed-pivot disc:0,0:1",
        Args(f"{S} --fixed-pivot box:-3,-1:3,1"),
        FEW,
    ),
    "region with text": Case(
        "E131", f"{S} --fixed-pivot line:0,0:one,0", Args(f"{S} --fixed-pivot line:0,0:1,0"), FEW
    ),
    "no range of lengths": Case("E131", f"{S} --length 5", Args(f"{S} --length :5"), FEW),
    "limits for three dyads": Case(
        "E131", f"{S} --kinds RR --kinds PR --kinds RP", Args(f"{S} --kinds RR --kinds PR"), FEW
    ),
    "polygon without inside": Case(
        "E131",
        f"{S} --fixed-pivot polygon:0,0:1,1:2,2",
        Args(f"{S} --fixed-pivot polygon:0,0:1,1:2,0"),
        FEW,
    ),
    "polygon that crosses itself": Case(
        "E131",
        f"{S} --fixed-pivot polygon:-3,-3:3,3:3,-3:-3,3",
        Args(f"{S} --fixed-pivot polygon:-3,-3:3,-3:3,3:-3,3"),
        FEW,
    ),
    "segment of one point": Case(
        "E131",
        f"{S} --moving-pivot segment:1,1:1,1",
        Args(f"{S} --moving-pivot 1,1"),
        FEW,
    ),
    "empty box": Case(
        "E132", f"{S} --fixed-pivot box:3,1:-3,-1", Args(f"{S} --fixed-pivot box:-3,-1:3,1"), FEW
    ),
    "length backwards": Case("E132", f"{S} --length 5:2", Args(f"{S} --length 2:5"), FEW),
    "slider with a pivot": Case(
        "E132",
        f"{S} --kinds PR --fixed-pivot 1,2",
        Args(f"{S} --kinds PR,RR --fixed-pivot 1,2"),
        FEW,
    ),
    "one pivot for both": Case(
        "E132",
        f"{S} --fixed-pivot 1,2 --fixed-pivot 1,2",
        Args(f"{S} --fixed-pivot 1,2 --fixed-pivot any"),
        FEW,
    ),
    "link too short": Case(
        "E132",
        f"{S} --fixed-pivot 0,0 --moving-pivot box:0,0:0.1,0.1 --length :0.3",
        Args(f"{S} --fixed-pivot 0,0 --moving-pivot box:0,0:0.1,0.1 --length :5"),
        FEW,
    ),
    "type without a crank": Case(
        "E132",
        f"{S} --type triple-rocker --driver crank",
        Args(f"{S} --type triple-rocker,crank-rocker --driver crank"),
        FEW,
    ),
    "type of other dyads": Case(
        "E132",
        f"{S} --kinds RR --type slider-crank",
        Args(f"{S} --kinds RR,PR --type slider-crank"),
        FEW,
    ),
    "pivot off the footprint": Case(
        "E132",
        f"{S} --fixed-pivot 9,9 --footprint box:-5,-5:5,5",
        Args(f"{S} --fixed-pivot 9,9 --footprint box:-15,-15:15,15"),
        FEW,
    ),
    "six conditions": Case(
        "E133",
        f"{S} --exact 1,2,3,4 --fixed-pivot 1,2",
        Args(f"{S} --exact 1,2,3 --fixed-pivot 1,2"),
        ALL,
    ),
    # --- requirements
    "angle too large": Case(
        "E134", f"{S} --min-transmission 95", Args(f"{S} --min-transmission 40"), FEW
    ),
    "type unknown": Case(
        "E134",
        f"{S} --type crank-roker",
        lambda help: Args(f"{S} --type " + re.search(r"mean ([\w-]+)", help)[1]),
        FEW,
    ),
    "first dyad of two alike": Case("E134", f"{S} --driver first", Args(f"{S} --driver any"), FEW),
    "ratio below one": Case("E134", f"{S} --link-ratio 0.5", Args(f"{S} --link-ratio 5"), FEW),
    "no error allowed": Case(
        "E134",
        f"{S} --within 0",
        Args(f"{S} --within 0.5 --exact 1,2,3"),
        FEW,
    ),
    "step of zero": Case("E134", f"{S} --round 0", Args(S), FEW),
    "sigma without angle": Case(
        "E134", f"{S} --pose-sigma 0.05", Args(f"{S} --pose-sigma 0.05,0.1"), FEW
    ),
    "rail of any direction": Case(
        "E137",
        f'{S} --rail "direction:0+-95"',
        Args(f'{S} --rail "direction:0+-20"'),
        ALL,
    ),
    "line of a rail given twice": Case(
        "E137",
        f'{S} --rail "direction:0 travel:segment:0,0:5,0"',
        Args(f'{S} --rail "direction:0 travel:box:-20,-9:20,9"'),
        ALL,
    ),
    "rail beside its travel": Case(
        "E138",
        f'{S} --rail "direction:0 through:0,0 travel:box:-9,1:9,2"',
        Args(f'{S} --rail "direction:0 through:0,0 travel:box:-9,-1:9,2"'),
        ALL,
    ),
    "rail of a link": Case(
        "E132",
        f"{S} --rail direction:0 --kinds RR --kinds any",
        Args(f"{S} --rail direction:0 --kinds any --kinds RR"),
        ALL,
    ),
    # --- tolerances of poses
    "tolerance below zero": Case(
        "E135",
        f"{S} --pose-tolerance 0.1,-0.1,2",
        Args(f"{S} --pose-tolerance 0.1,0.1,2"),
        FEW,
    ),
    "tolerance blank": Case(
        "E135",
        S,
        Edit("poses.csv", "4,3,70,\n", "4,3,70,0\n"),
        {"poses.csv": "x,y,angle_deg,tol_x\n0,0,0,1\n3,1,40,1\n4,3,70,\n"},
    ),
    "free in everything": Case(
        "E136",
        S,
        Edit("poses.csv", "4,3,70,x y angle", "4,3,70,angle"),
        {"poses.csv": "x,y,angle_deg,free\n0,0,0,\n3,1,40,\n4,3,70,x y angle\n"},
    ),
    "exact and a tolerance": Case(
        "E136",
        S,
        Edit("poses.csv", "3,1,40,yes,1", "3,1,40,no,1"),
        {"poses.csv": "x,y,angle_deg,exact,tol_x\n0,0,0,,1\n3,1,40,yes,1\n4,3,70,,1\n"},
    ),
    "outside the tolerances": Case(
        "R304",
        f"{S} --pose-tolerance 0.00001,0.00001,0.0001",
        Args(f"{S} --pose-tolerance 0.01,0.01,0.1"),
        ALL,
        exit=1,
    ),
    # --- tracked points, libraries, files, linkages, bugs
    "points not on one body": Case(
        "E111",
        S,
        lambda help: Args(f"{S} " + re.search(r"--drop \d+", help)[0]),
        {"poses.csv": POINTS.replace("5,3,5,8", "5,3,5,13")},
    ),
    "two points in one place": Case(
        "E111",
        S,
        Edit("poses.csv", "5,3,5,3\n", ""),
        {"poses.csv": POINTS.replace("5,3,5,8", "5,3,5,3")},
    ),
    "too many poses": Case(
        "E126",
        S,
        Args(f"{S} --every 2"),
        {"poses.csv": lambda: "x,y,angle_deg\n" + 20_001 * ROWS},
    ),
    "too many lines": Case(
        "E101",
        S,
        Write("poses.csv", TEN),
        {"poses.csv": lambda: "x,y,angle_deg\n" + 1_100_001 * "\n" + TEN},
    ),
    "z that changes": Case(
        "E113",
        S,
        Edit("poses.csv", "x,y,z,", 'x,y,"#z",'),
        {"poses.csv": with_z(range(5))},
    ),
    "markers in no plane": Case(
        "E113",
        f"{S} --points M1,M2",
        lambda help: Args(f"{S} --points M1,M2 " + re.search(r"--plane \w+", help)[0]),
        {"poses.csv": lambda: nexus(*tilted())},
    ),
    "markers not chosen": Case(
        "E114",
        S,
        lambda help: Args(re.search(r"`burmester (.*)`", help)[1]),
        {"poses.csv": lambda: nexus(*recording(30))},
    ),
    "no such marker": Case(
        "E114",
        f"{S} --points M1,M7",
        lambda help: Args(f"{S} " + re.search(r"--points \S+", help)[0]),
        {"poses.csv": lambda: nexus(*recording(30))},
    ),
    "too large to square": Case(
        "E112", S, Edit("poses.csv", "3e200", "3"), {"poses.csv": rows("0,0,0 3e200,1,40 4,3,70")}
    ),
    "standard deviation too large": Case(
        "E112", f"{S} --pose-sigma 1e300,1", Args(f"{S} --pose-sigma 0.01,0.1"), GOOD
    ),
    "angle weight too large": Case(
        "E112", f"{S} --angle-weight 1e300", Args(f"{S} --angle-weight 10"), GOOD
    ),
    "too many turns": Case(
        "E112",
        S,
        Edit("poses.csv", "4e10", "40"),
        {"poses.csv": "x,y,angle_rad\n0,0,0\n3,1,4e10\n4,3,70\n"},
    ),
    "no pyarrow": Case(
        "E130",
        "synthesize poses.parquet",
        lambda help: Write("poses.parquet", parquet(), "synthesize poses.parquet"),
        {"poses.parquet": b"PAR1"},
    ),
    "no header, said in an option": Case(
        "E105", S, Args(f"{S} --columns x,y,angle_deg"), {"poses.csv": ROWS.replace(",", ";")}
    ),
    "file there already": Case(
        "E140",
        lambda: api("io.files.write")("lid.toml", "new"),
        Call(lambda: api("io.files.write")("lid.toml", "new", force=True)),
        {"lid.toml": "old"},
    ),
    "folder not there": Case(
        "E141",
        lambda: api("io.files.write")("results/lid.toml", "new"),
        lambda help: Call(lambda: made(in_backticks(help), "results/lid.toml")),
    ),
    "output is the input": Case(
        "E142",
        "synthesize poses.csv -o poses.csv --force",
        Args("synthesize poses.csv -o result.json --force"),
        ALL,
    ),
    "a template there already": Case(
        "E140", "new gripper", Args("new gripper --force"), {"gripper.toml": "old"}
    ),
    "no result": Case(
        "E150",
        "export poses.json -o a.csv",
        lambda help: Write("poses.json", result(TEN)),
        {"poses.json": json_poses()},
    ),
    "no such linkage": Case(
        "E151",
        "export result.json -o a.csv --linkage L99",
        lambda help: Args("export result.json -o a.csv " + re.search(r"--linkage \w+", help)[0]),
        {"result.json": lambda: result(TEN)},
    ),
    "a result changed by hand": Case(
        "W244",
        "export result.json -o a.csv --force",
        lambda help: Write("result.json", result(TEN)),
        {"result.json": lambda: with_longer_link(result(TEN))},
        exit=0,
    ),
    "a result with another id": Case(
        "E150",
        "export result.json -o a.csv",
        lambda help: Write("result.json", result(TEN)),
        {"result.json": lambda: result(TEN).replace('"id": "D1"', '"id": "D1; import os"', 1)},
    ),
    "a dyad twice in a linkage": Case(
        "E150",
        "export result.json -o a.csv --linkage L1",
        lambda help: Write("result.json", result(TEN)),
        {"result.json": lambda: with_dyad_twice(result(TEN))},
    ),
    "one dyad": Case(
        "E153",
        f"{J} --dyad 3.1,1.89:5.02,-7.45",
        lambda help: Args(f"{J} {re.search('--dyad.*', help)[0]}"),
        GOOD,
    ),
    "a dyad of five numbers": Case(
        "E153", f"{J} --dyad -2.2,0.1,3:1.24,0.1 {SECOND}", Args(f"{J} {FIRST} {SECOND}"), GOOD
    ),
    "one length for two links": Case(
        "E153",
        f"{J} {FIRST} {SECOND} --length 1.24",
        Args(f"{J} {FIRST} {SECOND} --length 1.24 --length any"),
        GOOD,
    ),
    "the same fixed pivot": Case(
        "E154", f"{J} {FIRST} --dyad -2.2,0.1:4.58,1.31", Args(f"{J} {FIRST} {SECOND}"), GOOD
    ),
    "a linkage that does not close": Case(
        "E155",
        f"{J} {FIRST} {SECOND} --length 9 --length 1",
        Args(f"{J} {FIRST} {SECOND}"),
        GOOD,
    ),
    "pivots alone at points": Case(
        "E158",
        f"{J} {FIRST} {SECOND}",
        Args(f"{J} {FIRST} {SECOND} --length 3.44 --length 3.56"),
        {"poses.csv": "x,y\n" + "".join(f"{t},{t * t}\n" for t in range(12))},
    ),
    "better ones at timed points": Case(
        "E159",
        f"judge path.json {FIRST} {SECOND} --length 3.44 --length 3.56 --improve",
        Args(f"judge path.json {FIRST} {SECOND} --length 3.44 --length 3.56"),
        {"path.json": timed(0, 4, 8, 12, 15)},
    ),
    "poses in place of a linkage": Case(
        "E156",
        f"{J} --linkage poses.csv",
        lambda help: Write("crank.toml", CRANK, f"{J} --linkage crank.toml"),
        GOOD,
    ),
    "a misspelt key of a dyad": Case(
        "E156",
        f"{J} --linkage crank.toml",
        Write("crank.toml", CRANK),
        {**GOOD, "crank.toml": CRANK.replace("moving_pivot", "movingpivot", 1)},
    ),
    # --- many tasks
    "a folder with another batch": Case("E180", another_batch, Call(lambda: batch("other"))),
    "two runs on a folder": Case("E181", second_run, Call(batch)),
    "a worker of another version": Case(
        "E182",
        lambda: other_version("0.0.9"),
        Call(lambda: other_version(burmester.__version__)),
    ),
    "no such format": Case(
        "E161",
        "export result.json -o a.xyz",
        lambda help: Args("export result.json -o a.xyz " + re.search(r"--to \w+", help)[0]),
        {"result.json": lambda: result(TEN)},
    ),
    "holes too wide": Case(
        "E162",
        "export result.json -o a.svg --hole 9",
        lambda help: Args("export result.json -o a.svg " + re.search(r"--hole \S+", help)[0]),
        {"result.json": lambda: result(TEN)},
    ),
    "lengths in px": Case(
        "E162",
        "export result.json -o a.svg",
        lambda help: Args(
            "export result.json -o a.svg " + re.search(r"--length-unit \S+", help)[0]
        ),
        {"result.json": lambda: result(TEN.replace("x,y", "x_px,y_px", 1))},
    ),
    "a file that went wrong": Case(
        "E160",
        lambda: checked(lambda text: text.replace("CRANK = 1", "CRANK = 2")),
        Call(lambda: checked(lambda text: text)),
        exit=3,
    ),
    "a slot for pylinkage": Case(
        "E163",
        "export result.json -o a.py --linkage L2",
        Args("export result.json -o a.csv --linkage L2 --to csv"),
        {"result.json": lambda: result(TEN)},
    ),
    # --- outlines and surroundings
    "a drawing of another kind": Case(
        "E170",
        f"{S} --body lid.png",
        Args(f"{S} --body lid.svg"),
        {**ALL, "lid.svg": svg(LID_PATH, "")},
    ),
    "a drawing with a gap": Case(
        "E171",
        f"{S} --body lid.svg",
        Edit("lid.svg", "L 0 2.1", "L 0 2 z"),
        {**ALL, "lid.svg": svg('<path d="M 0 0 L 4 0 L 4 2 L 0 2.1"/>', "")},
    ),
    "a drawing with a hole": Case(
        "E172",
        f"{S} --body lid.svg",
        Args(f"{S} --body lid.svg:lid"),
        {**ALL, "lid.svg": svg(f'{LID_PATH}<circle id="hole" cx="2" cy="1" r="0.5"/>', "")},
    ),
    "no such layer": Case(
        "E173",
        f"{S} --body lid.svg:outline",
        Args(f"{S} --body lid.svg:lid"),
        {**ALL, "lid.svg": svg(LID_PATH, "")},
    ),
    "millimetres for poses without a unit": Case(
        "E174",
        f"{S} --body lid.svg",
        Edit("poses.csv", "x,y", "x_mm,y_mm"),
        {**ALL, "lid.svg": svg(LID_PATH, 'width="4mm" height="2mm" viewBox="0 0 4 2"')},
    ),
    "a region over the body": Case(
        "E175",
        "synthesize task.toml",
        Edit("task.toml", "[[-3, 0], [-1, 3]]", "[[30, 0], [39, 9]]"),
        {
            "task.toml": toml_poses()
            + "body = [[-1, -1], [1, -1], [1, 1], [-1, 1]]\n"
            + '[[keep_out]]\nname = "bumper"\nbox = [[-3, 0], [-1, 3]]\n'
        },
    ),
    "links of less than no width": Case(
        "E176", f"{S} --link-width -3", Args(f"{S} --link-width 3"), ALL
    ),
    "a mass without a centre": Case(
        "E177",
        "synthesize lid.toml",
        Edit("lid.toml", "mass_kg = 4", "mass_kg = 4, center = [1, 2]"),
        {"lid.toml": loaded("[loads]\nbody = { mass_kg = 4 }\n")},
    ),
    "loads without a unit": Case(
        "E178",
        "synthesize lid.toml",
        Edit("lid.toml", 'angle_unit = "deg"', 'angle_unit = "deg"\nlength_unit = "mm"'),
        {"lid.toml": loaded("[loads]\ntorque_Nm = 4\n", unit="")},
    ),
    "a spring that is too long": Case(
        "E179",
        "synthesize lid.toml",
        Edit("lid.toml", "[0, 170]", "[0, 200]"),
        {
            "lid.toml": loaded(
                '[[springs]]\nkind = "gas"\nground_point = [0, 0]\nbody_point = [0, 170]\n'
                "force_N = 350\ncompressed_force_N = 480\nstroke = 100\nlength = 280\n"
            )
        },
    ),
    "an outline from a drawing": Case(
        "W218",
        f"{S} --body lid.svg",
        Write(
            "task.toml",
            toml_poses() + "body = [[0, 0], [4, 0], [4, -2], [0, -2]]\n",
            "synthesize task.toml",
        ),
        {**ALL, "lid.svg": svg(LID_PATH, "")},
        exit=0,
    ),
    "driver without a joint": Case(
        "E401",
        lambda: api("fourbar.loop_closure.DrivenLoop").of(
            burmester.Linkage(PP(np.array(0.0)), START)
        ),
        Call(
            lambda: api("fourbar.loop_closure.DrivenLoop").of(
                burmester.Linkage(START, PP(np.array(0.0)))
            )
        ),
    ),
    "speed without a joint": Case(
        "E401",
        lambda: api("fourbar.instantaneous.velocity")(
            burmester.Linkage(PP(np.array(0.0)), START), poses(3)
        ),
        Call(
            lambda: api("fourbar.instantaneous.velocity")(
                burmester.Linkage(START, PP(np.array(0.0))), poses(3)
            )
        ),
    ),
    "bug": Case("E900", S, None, GOOD, exit=3),
    # --- outcomes
    "usable linkages": Case("R300", S, None, GOOD, exit=0),
    "none usable": Case(
        "R301",
        f"{S} --type double-crank",
        lambda help: Args(f"{S} " + re.search(r"with (--.+?) L\d+ would do", help)[1]),
        GOOD,
        exit=1,
    ),
    "one dyad only": Case(
        "R302",
        f"{S} --fixed-pivot box:-1,-1:1,1 --kinds RR --length 1:2",
        Args(f"{S} --fixed-pivot box:-1,-1:1,1 --kinds RR,PR,RP --length 1:2"),
        {
            "poses.csv": rows(
                "0.2,-9.9,-9.3 -1.3,4.8,-47.3 3.7,-5.5,-13.3 "
                "-4.2,7.2,22.7 12.2,3.2,33.8 4.2,-3,-2.8"
            )
        },
        exit=1,
    ),
    "four poses and a pivot at a point": Case(
        "R303",
        f"{S} --fixed-pivot=3,-2",
        Write("poses.csv", FIVE, S),
        {"poses.csv": FOUR},
        exit=1,
    ),
    "four poses": Case("R308", S, None, {"poses.csv": FOUR}, exit=0),
    "four poses in boxes": Case(
        "R309",
        f"{S} {BOXES}",
        lambda help: Args(f"{S} " + re.search(r"use (--.+)", help)[1].replace(" and ", " ")),
        {"poses.csv": rows(OPENING.replace(" ", " 12.5,40,20 ", 1))},
        exit=1,
    ),
    "poses and points": Case("R340", S, None, {"poses.csv": rows(MIXED)}, exit=0),
    "poses and points, none works": Case(
        "R341",
        S,
        Write("poses.csv", rows(MIXED)),
        {"poses.csv": rows("76,6,0 57,1,12 46,15,56 24,73,27 27,58, 3,82,")},
        exit=1,
    ),
    "poses and points, none real": Case(
        "R342",
        S,
        Write("poses.csv", rows(MIXED)),
        {"poses.csv": rows("65,87,15 84,7,36 79,40,9 46,54,-40 84,25, 87,33,")},
        exit=1,
    ),
    "points on a circle": Case(
        "R343",
        S,
        Write("poses.csv", FIVE),
        {"poses.csv": CIRCLE},
        exit=1,
    ),
    "points on a circle, and poses": Case(
        "W222",
        S,
        Write("poses.csv", rows(MIXED)),
        {"poses.csv": rows("0,0,0 20,5,10 30,20,20 30,40, 40,30, 50,0, 0,50,")},
        exit=1,
    ),
    "solutions that are not there": Case(
        "W223",
        S,
        Write("poses.csv", rows(MIXED)),
        {"poses.csv": rows("0,0,10 20,5,10 30,22,10 33,41,35 44,63, 71,51,")},
        exit=1,
    ),
    "a family in the place of solutions": Case(
        "W223",
        S,
        Write("poses.csv", rows(MIXED)),
        {"poses.csv": rows("0,0,0 20,5,10 10,30, 30,22,10 10,30, 33,41,35")},
        exit=1,
    ),
    "little rotation": Case(
        "R305",
        S,
        Write("poses.csv", SMALL_TURN),
        {"poses.csv": re.sub(r"[\d.]{6,}", lambda each: f"{float(each[0]):.3f}", SMALL_TURN)},
        exit=0,
    ),
    "none within the limits": Case("R306", f"{S} --kinds PP", Args(f"{S} --kinds PP,RR"), GOOD, 1),
    "approximate ones": Case(
        "R307", S, None, {"poses.csv": rows("0,0,30 1,1,36 2,4,43 3,9,55 4,16,70")}, exit=0
    ),
    "an expression with another name": Case("E190", f"{LOG.replace('x)', 'y)')}", Args(LOG)),
    "a function without a value": Case("E191", LOG.replace("1:2", "0:2"), Args(LOG)),
    "two pairs of a function": Case(
        "E192", S, Write("poses.csv", PAIRS), {"poses.csv": "\n".join(PAIRS.split("\n")[:3])}
    ),
    "a function where poses are needed": Case(
        "E193", f"{J} {FIRST} {SECOND}", Args(S), {"poses.csv": PAIRS}
    ),
    "a function without its range": Case("E194", LOG.replace("--input 60 ", ""), Args(LOG)),
    "a file named as an angle is": Case("E194", f"{S} --output 60", Args(f"{S} -o 60"), GOOD),
    "a function of another command": Case(
        "W245",
        f"{LOG} --pairs 5".replace("function", "synthesize --function"),
        Args(f"{LOG} --pairs 5"),
        exit=0,
    ),
    "function generators": Case("R360", LOG, None, exit=0),
    "no function generator that works": Case(
        "R361", S, Write("poses.csv", PAIRS), {"poses.csv": LOCKED}, exit=1
    ),
    "critical points that are not reached": Case("W230", LOG, Args(f"{LOG} --pairs 5"), exit=0),
    "phases from a grid": Case(
        "W231",
        f"{LOG} --pairs 3",
        Args(f"{LOG} --pairs 3 --input-phase 50 --output-phase 60"),
        exit=0,
    ),
    "a pair that stands out": Case(
        "W241",
        "check poses.csv",
        Write("poses.csv", ODD_PAIR.replace("69.94", "68.94")),
        {"poses.csv": ODD_PAIR},
        exit=1,
    ),
    "a link without end": Case("W232", S, None, {"poses.csv": PAIRS}, exit=0),
    "a link at its bound": Case("W233", SQUARE, Args(LOG), exit=0),
    "a given linkage that works": Case("R330", f"{J} {FIRST} {SECOND}", None, GOOD, exit=0),
    "a given linkage that does not": Case(
        "R331",
        f"{J} {FIRST} --dyad 3.1,1.89:5.02,-7.45",
        Args(f"{J} {FIRST} {SECOND}"),
        GOOD,
        exit=1,
    ),
    "no motion": Case(
        "R310",
        S,
        Write("poses.csv", rows("1,2,30 2,2,35 4,3,70")),
        {"poses.csv": rows("1,2,30 1,2,30 1,2,30")},
        exit=1,
    ),
    "two poses differ": Case(
        "R311",
        S,
        Write("poses.csv", rows("1,2,30 4,3,70")),
        {"poses.csv": rows("1.0000,2.0000,30.000 1.0001,2.0000,30.000 4.0000,3.0000,70.000")},
        exit=1,
    ),
    "along a line": Case(
        "R312",
        S,
        Write("poses.csv", rows("0,0,30 1,2,35 2,4,42 3,6,50")),
        {"poses.csv": rows("0,0,30 1,2,30 2,4,30 3,6,30")},
        exit=1,
    ),
    "along a circle": Case(
        "R313",
        S,
        Write("poses.csv", rows("5,0,30 3,4,35 0,5,45 -3,4,60 -5,0,80")),
        {"poses.csv": rows("5,0,30 3,4,30 0,5,30 -3,4,30 -5,0,30")},
        exit=1,
    ),
    "along a curve": Case(
        "R314",
        S,
        Write("poses.csv", rows("0,0,30 1,1,36 2,4,43 3,9,55")),
        {"poses.csv": rows("0,0,30 1,1,30 2,4,30 3,9,30 4,16,30")},
        exit=1,
    ),
    "about a point": Case(
        "R315",
        S,
        Write("poses.csv", rows("2,3,0 2,3,20 2,3,45 3,5,80 1,6,100")),
        {"poses.csv": rows("2,3,0 2,3,20 2,3,45 2,3,80 2,3,100")},
        exit=1,
    ),
    "about a point but for scatter": Case(
        "R315",
        S,
        Write("poses.csv", rows("0,0,0 0.3,0.1,20 0.8,0.4,45 1.4,1.3,80 1.5,1.9,100")),
        {"poses.csv": rows("2,-1,0 -1,3,18 1,2,36 -3,1,54 0,-2,72 2,1,90")},
        exit=1,
    ),
    "two sliders": Case(
        "R316",
        S,
        Edit("poses.csv", "1.0,0,120", "1.5,0.5,120"),
        {"poses.csv": rows("-2.0,0,0 -1.931852,0,15 -1.532089,0,40 -1.0,0,60 0.0,0,90 1.0,0,120")},
        exit=0,
    ),
    "two angles and few digits": Case(
        "R318",
        f"{S} --pose-sigma 0.03,0",
        Write("poses.csv", rows("0,-0.4,10 -1,6.4,50 -0.9,5.8,10 0.5,4.3,20 -5.8,5.3,35")),
        {"poses.csv": rows("0.0,-0.4,10 -1.0,6.4,50 -0.9,5.8,10 0.5,4.3,10 -5.8,5.3,10")},
        exit=1,
    ),
    "two angles": Case(
        "R320",
        S,
        Write("poses.csv", rows(TWO_ANGLES.replace("3.3,4,50", "3.3,4,40"))),
        {"poses.csv": rows(TWO_ANGLES)},
        exit=1,
    ),
    "a general motion": Case("R321", S, None, GOOD, exit=0),
    # --- warnings
    "a pose that does not agree": Case(
        "W201",
        S,
        lambda help: Args(f"{S} " + re.search(r"--drop \d+", help)[0]),
        {"poses.csv": TEN.replace("52.87", "52.67")},
        exit=0,
    ),
    "angles that count clockwise": Case(
        "W242",
        "check poses.csv",
        lambda help: Args(f"check poses.csv {re.search('--convention clockwise', help)[0]}"),
        {"poses.csv": table(written(crank_rocker(), "clockwise"))},
        exit=1,
    ),
    "radians for degrees": Case(
        "W242",
        "check poses.csv",
        lambda help: Args(f"check poses.csv {re.search('--convention radians$', help)[0]}"),
        {"poses.csv": table(written(crank_rocker(), "radians"))},
        exit=1,
    ),
    "a cosine for an angle": Case(
        "W243",
        "check poses.csv",
        lambda help: Args(f"check poses.csv --columns {re.search('x,y,cos,sin', help)[0]}"),
        {"poses.csv": DIRECTIONS.replace("cos,sin", "angle_deg,#4")},
        exit=1,
    ),
    "two poses exchanged": Case(
        "W202",
        S,
        Write("poses.csv", TEN),
        {"poses.csv": "x,y,angle_deg\n" + exchanged(ROWS, 3, 7)},
        exit=1,
    ),
    "not determined": Case(
        "W203",
        f"{S} --fixed-pivot=3,-2",
        Write("poses.csv", FIVE, S),
        {"poses.csv": FOUR},
        exit=1,
    ),
    "three poses alone": Case(
        "W215",
        S,
        Args(f"{S} {WIDE} --min-transmission 40 --link-ratio 4"),
        {"poses.csv": rows(OPENING)},
        exit=0,
    ),
    "three poses and a rail": Case(
        "W256",
        f'{S} --rail "direction:0 through:0,20"',
        Args(f'{S} --rail "direction:0+-2 through:segment:0,0:0,30"'),
        {"poses.csv": rows("0,0,0 65.25,-8.39,30 214.60,-8.41,88")},
        exit=0,
    ),
    "three poses in boxes": Case(
        "W216", f"{S} {BOXES}", Args(f"{S} {WIDE}"), {"poses.csv": rows(OPENING)}, exit=0
    ),
    "a very long link": Case(
        "W204",
        S,
        Args(f"{S} --kinds PR,RP"),
        {
            "poses.csv": rows(
                "-5.3,-5.1,0.0 2.2,-2.7,0.2 3.6,1.5,2.6 2.3,2.4,5.5 3.1,0.6,2.1 -4.6,-1.7,2.4"
            )
        },
        exit=1,
    ),
    "the same dyad twice": Case(
        "W205", S, Write("poses.csv", FIVE), {"poses.csv": doubled}, exit=1
    ),
    "solutions left out": Case(
        "W206",
        S,
        Write("poses.csv", rows("4.7,1.4,10 -5.9,-3.1,50 8.1,4.7,70 -1.7,0.9,25 1,4.5,50")),
        {"poses.csv": rows("4.7,1.4,10 -5.9,-3.1,50 8.1,4.7,50 -1.7,0.9,10 1.0,4.5,50")},
        exit=1,
    ),
    "critical points missing": Case(
        "W207", S, Args(f"{S} --method pencil"), {"poses.csv": rows(TWO_ANGLES)}, exit=1
    ),
    "a pose twice": Case(
        "W208",
        S,
        Write("poses.csv", FIVE),
        {"poses.csv": FIVE + FIVE.splitlines()[2] + "\n"},
        exit=0,
    ),
    "pivots hardly determined": Case(
        "W209", S, Write("poses.csv", re.sub(r"(\d\.\d+)", r"\g<1>0000", FIVE)), GOOD, exit=0
    ),
    "a sample of many poses": Case(
        "W220", S, Args(f"{S} --every 2"), {"poses.csv": lambda: as_csv(measured(400))}, exit=0
    ),
    "transmits badly": Case(
        "W210",
        S,
        lambda help: Args(f"{S} " + re.search(r"--min-transmission \d+", help)[0]),
        ALL,
        exit=0,
    ),
    "far from the origin": Case(
        "W211",
        S,
        Write("poses.csv", rows("0,0,0 3,1,40 4,3,70")),
        {"poses.csv": rows("7e9,0,0 7000000003,1,40 7000000004,3,70")},
        exit=0,
    ),
    "a box thinner than rounding": Case(
        "W212",
        f"{S} --fixed-pivot box:-3,1:3,1.00000000001",
        Args(f"{S} --fixed-pivot segment:-3,1:3,1"),
        {"poses.csv": TEN},
        exit=0,
    ),
    # --- notes of reading
    "columns passed over": Case(
        "W213",
        S,
        Edit("poses.csv", "angle_deg,Bemerkung", 'angle_deg,"#Bemerkung"'),
        {"poses.csv": TEN.replace("\n", ",\n").replace("_deg,", "_deg,Bemerkung")},
        exit=0,
    ),
    "an ANSI text": Case(
        "W213",
        S,
        Write("poses.csv", TEN.replace("angle_deg", "Winkel [°]")),
        {"poses.csv": TEN.replace("angle_deg", "Winkel [°]").encode("cp1252")},
        exit=0,
    ),
    "titles": Case(
        "W213",
        S,
        Edit("poses.csv", "Lid, 12 May", "# Lid, 12 May"),
        {"poses.csv": f"Lid, 12 May\n{TEN}"},
        exit=0,
    ),
    "units below the header": Case(
        "W213",
        S,
        Write("poses.csv", TEN.replace("x,y", "x_mm,y_mm")),
        {"poses.csv": TEN.replace("angle_deg\n", "angle\nmm,mm,deg\n")},
        exit=0,
    ),
    "units in cells": Case(
        "W213",
        S,
        Write("poses.csv", TEN),
        {"poses.csv": TEN.replace("_deg", "").replace("\n", "°\n").replace("angle°", "angle")},
        exit=0,
    ),
    "separated thousands": Case(
        "W213",
        f"{S} --drop 11",
        Edit("poses.csv", "1'234", "1234"),
        {"poses.csv": f"{TEN}1'234,0,0\n"},
        exit=0,
    ),
    "a constant z": Case(
        "W213",
        S,
        Edit("poses.csv", "x,y,z,", 'x,y,"#z",'),
        {"poses.csv": with_z([2.5] * 5)},
        exit=0,
    ),
    "pivots at no one distance": Case(
        "W219", f"{J} {FIRST} --dyad 1.14,0.39:1.31,4.58", Args(f"{J} {FIRST} {SECOND}"), GOOD, 1
    ),
    "crank angles that are few": Case(
        "E186",
        lambda: TracedPath(crank_angles=np.radians([0, 30, 60])),
        Call(lambda: TracedPath(crank_angles=np.radians([0, 30, 60, 90, 120]))),
    ),
    "poses that are no path": Case("E187", f"{S} --closed", Args(S), GOOD),
    "pieces of a path": Case(
        "E188",
        "synthesize path.svg",
        Args("synthesize path.svg:one"),
        {"path.svg": svg(f'<path id="one" d="{BOW}"/><path d="M 0 60 L 9 60"/>')},
    ),
    "a path to trace": Case(
        "R350", "synthesize path.json", None, {"path.json": timed(0, 4, 8, 12, 15)}, exit=0
    ),
    "a path too near": Case(
        "R351",
        "synthesize path.json --within 0.001",
        Args("synthesize path.json --within 0.2"),
        {"path.json": timed(*range(0, 18, 2))},
        exit=1,
    ),
    "a path that no four-bar stays on": Case(
        "R352",
        "synthesize path.csv",
        Args("synthesize path.csv --any-order"),
        {"path.csv": "x,y\n" + CROSS.replace(" ", "\n")},
        exit=1,
    ),
    "a tolerance of a path": Case(
        "W226",
        "synthesize path.json",
        Args("synthesize path.json --within 0.2"),
        {"path.json": timed(*range(0, 18, 2))},
        exit=0,
    ),
    "a drawing of a path": Case("W227", "synthesize path.svg", Args(S), BOWS | GOOD, exit=0),
    "no time": Case("W221", f"{S} --time-limit 0.001", Args(f"{S} --time-limit 10"), ALL, exit=0),
    # --- six-bars
    "six-bars through ten poses": Case(
        "E195", f"{S} {SIX} 50", Args(f"{S} {SIX} 50 --every 2"), {"poses.csv": TEN}
    ),
    "a type for six-bars": Case(
        "E196", f"{S} {SIX} 50 --type double-crank", Args(f"{S} {SIX} 50"), GOOD
    ),
    "chains of four-bars": Case("E197", f"{S} --chains 50", Args(f"{S} {SIX} 50"), GOOD),
    "a six-bar as a script": Case(
        "E198",
        "export six.json -o a.py",
        lambda help: Args("export six.json -o a.csv " + re.search(r"--to \w+", help)[0]),
        {"six.json": lambda: six_bars(FIVE)},
    ),
    "a six-bar without a joint": Case(
        "E156",
        f"{J} --linkage six.toml",
        Write("six.toml", SIX_BAR),
        {**GOOD, "six.toml": SIX_BAR.replace("G =", "g =")},
    ),
    "better ones near a six-bar": Case(
        "E197",
        f"{J} --linkage six.json --improve",
        Args(f"{J} --linkage six.json"),
        {**GOOD, "six.json": lambda: six_bars(FIVE)},
    ),
    "a given six-bar that meets the poses in another order": Case(
        "R331",
        "judge other.csv --linkage six.json",
        Args("judge other.csv --linkage six.json --any-order"),
        {"other.csv": SWAPPED, "six.json": lambda: six_bars(FIVE)},
        exit=1,
    ),
    "six-bars": Case("R370", f"{S} {SIX} 100", None, GOOD, exit=0),
    "no six-bar": Case(
        "R371",
        f"{S} {SIX} 10 --min-transmission 30",
        lambda help: Args(f"{S} --six-bars --min-transmission 30 {in_help('--chains', help)}"),
        GOOD,
        exit=1,
    ),
    "assumed of six-bars": Case(
        "W234",
        f"{S} {SIX} 100",
        Args(f"{S} {SIX} 100 --fixed-pivot box:-20,-20:20,20 --moving-pivot box:-9,-9:9,9"),
        GOOD,
        exit=0,
    ),
    "four poses of a six-bar": Case(
        "W235", f"{S} {SIX} 1000", Write("poses.csv", FIVE), {"poses.csv": FOUR}, exit=0
    ),
    "no sound six-bar": Case(
        "W236",
        f"{S} {SIX} 10",
        lambda help: Args(f"{S} --six-bars {in_help('--chains', help)}"),
        GOOD,
        exit=0,
    ),
    "markers on two bodies": Case(
        "W214",
        f"{S} --points M1,M2 --every 5",
        Args(f"{S} --points M1,M3 --every 5"),
        {"poses.csv": lambda: nexus(*sliding())},
        exit=0,
    ),
}

# --- running them


class Done(NamedTuple):
    """What a command printed, and how it ended."""

    exit: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("NO_COLOR", "FORCE_COLOR", "CLICOLOR_FORCE", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


@pytest.fixture
def run(folder, monkeypatch, capsys):
    """Run a command line in the folder."""

    def run(line, width=80, **environment):
        with monkeypatch.context() as patch:
            patch.setenv("COLUMNS", str(width))
            for name, value in environment.items():
                patch.setenv(name, value)
            with pytest.raises(SystemExit) as stop:
                cli.main(shlex.split(line))
        out, err = capsys.readouterr()
        return Done(stop.value.code, out, err)

    return run


def no_search(*_):
    """Of a search: nothing was found."""


def no_further(*_):
    """Of a list of finds: none."""
    return []


@pytest.fixture
def hurried(monkeypatch):
    """Leave out the last search, a long one, for linkages that work where those found do not.

    Families hardly evolve where the message comes before any search.  Paths end early for the
    message on paths that were lost.
    """

    def hurried(case):
        if case.exit > 1:
            for name in ("GENERATIONS", "MOST_GENERATIONS", "SLIDER_GENERATIONS"):
                few = {} if name == "GENERATIONS" else 2
                monkeypatch.setattr(f"burmester.families.family.{name}", few)
        if case.code == "W230":
            monkeypatch.setattr("burmester.functions.critical_generators.MAX_STEPS", 40)
        if case.code not in ("R301", "R305", "R307", "W256"):
            monkeypatch.setattr("burmester.linkages.from_dyads.defect_free_linkages", no_search)
            monkeypatch.setattr("burmester.linkages.further_pairs.links_of_pivot_map", no_further)

    return hurried


@cache
def result(text):
    """What `synthesize -o` writes for a pose file."""
    with tempfile.TemporaryDirectory() as folder:
        poses = Path(folder, "poses.csv")
        poses.write_text(text)
        return json.dumps(synthesis_data(synthesize(read_task(poses))))


def six_bars(text):
    """What `synthesize --six-bars -o` writes for a pose file."""
    with tempfile.TemporaryDirectory() as folder:
        poses = Path(folder, "poses.csv")
        poses.write_text(text)
        return burmester.synthesize_six_bars(read_task(poses), chains=50).to_json()


def with_longer_link(text):
    """A result whose first linkage has a link that is a little longer."""
    tree = json.loads(text)
    tree["linkages"][0]["dyads"][1]["radius"] *= 1.001
    return json.dumps(tree)


def with_dyad_twice(text):
    """A result whose first linkage has its second dyad twice."""
    tree = json.loads(text)
    tree["linkages"][0]["dyads"][0] = tree["linkages"][0]["dyads"][1]
    return json.dumps(tree)


def checked(change):
    """Export a script, change it, and read it back."""
    Path("result.json").write_text(result(TEN))
    chosen = read_result("result.json").choose()
    pylinkage.write(chosen, Path("a.py"), Options())
    Path("a.py").write_text(change(Path("a.py").read_text()))
    pylinkage.check(chosen, Path("a.py"), Options())


def lay(case):
    for name, content in case.files.items():
        data = content() if callable(content) else content
        Path(name).write_bytes(data if isinstance(data, bytes) else data.encode())


@pytest.fixture
def broken():
    """Make what a few of the messages need, a missing library or a bug; `broken(None)` mends it."""
    patch = pytest.MonkeyPatch()

    def broken(name):
        patch.undo()
        flint.cache_clear()
        if name == "no python-flint":
            patch.setitem(sys.modules, "flint", None)
        if name == "no pyarrow":
            patch.setitem(sys.modules, "pyarrow", None)
            patch.setitem(sys.modules, "pyarrow.parquet", None)
        if name == "bug":
            space = {}
            text = "def synthesize(*given, **more):\n    return 1 / 0\n"
            exec(compile(text, "synthesis.py", "exec"), space)
            patch.setattr("burmester.synthesis.motion_generation.synthesize", space["synthesize"])
            # With the name of a file it would be another message every time.
            patch.setattr(tempfile, "mkstemp", no_room)

    yield broken
    broken(None)


@pytest.fixture
def ready(folder, hurried, broken):
    """Lay the files of a case in the folder, and make what else it needs.

    What a long search finds has nothing to do with a message that comes before any search.
    """
    time = ExitStack()

    def ready(name):
        case = CASES[name]
        lay(case)
        hurried(case)
        broken(name)
        if case.code in BEFORE_SEARCH:
            time.enter_context(limited(0))
        return case

    with time:
        yield ready


def no_room(**_):
    raise OSError


def raised(call):
    with pytest.raises(BurmesterError) as caught:
        call()
    return caught.value


def drawn(error, width):
    console = Console(file=io.StringIO(), width=width, highlight=False)
    show("error", error, console)
    return console.file.getvalue()


def said(case, done, code=None):
    """Of what a command printed, the message with the code."""
    code = code or case.code
    if case.exit > 1:
        assert done.out == ""
        return done.err
    assert done.err == ""
    out = re.sub(r"(?m) +$", "", done.out)  # tables are filled with blanks
    if code in TOLD:  # by what was found, without a code
        kinds = "four-bar|pose|six-bar|function generator"
        counted = re.search(rf"(?m)^\d+ (?:of \d+ )?(?:{kinds})s? (?:.*\n)+?(?=\n|\Z)", out)
        in_full = re.search("Dimensions|L1 in full|L1 +fixed pivot", out)
        return f"{out[: in_full.start()]}{counted[0]}"
    found = re.search(rf"(?m)^(warning|result)\[{code}\]: .*\n(?:  .*\n|L\d+ .*\n)*", out)
    return found[0] if found else ""


def codes(data):
    """All codes in what --json prints."""
    found = {data.get("outcome", {}).get("code"), *(each["code"] for each in data["warnings"])}
    if data.get("motion"):
        found.add(data["motion"]["code"])
    return found


def field(case, data):
    """The message in what --json prints."""
    if "outcome" in data and data["outcome"]["code"] == case.code:  # a check has none
        return data["outcome"]
    if case.code.startswith("W"):
        return next(each for each in data["warnings"] if each["code"] == case.code)
    return data["motion"]


def whole(text):
    """A drawn message without its line breaks, its place left out."""
    lines = text.split("\n")
    kept = [line for line in lines if not re.match(r"  --> | *\d* \|", line)]
    return " ".join(" ".join(kept).split())


TOLD = ("R300", "R305", "R307", "R308", "R340", "R360", "R370")
BEFORE_SEARCH = ("R312", "R314", "R320", "R352", "W211", "W214", "W215", "W220", "W227", "W235")
ONLY_JSON = ("R320", "R321")  # kinds of motion that say no outcome


EXAMPLES = {case.code: name for name, case in reversed(CASES.items())}
AT_NIGHT = pytest.mark.skipif(not EVERY, reason="of its code another case is run by day")
NAMES = [pytest.param(name, marks=() if name in EXAMPLES.values() else AT_NIGHT) for name in CASES]


@pytest.mark.parametrize("name", NAMES)
def test_a_message_is_drawn_told_and_its_help_followed(name, run, ready, broken, snapshot):
    case = ready(name)
    if callable(case.run):
        error = raised(case.run)
        assert (error.code, error.exit_code) == (case.code, case.exit)
        data, line = json.loads(json.dumps(failure(error), allow_nan=False)), name
        text, wide = drawn(error, NARROW), drawn(error, WIDE_ENOUGH)
    else:
        line = f"burmester {case.run}"
        narrow, done = run(case.run, NARROW), run(case.run, WIDE_ENOUGH)
        assert narrow.exit == done.exit == case.exit, done
        data, text, wide = in_json(case, run, done), said(case, narrow), said(case, done)
    if case.code not in ONLY_JSON:
        require_drawn(case, text, wide)
        require_on_its_page(name, wide.rstrip(), update=snapshot.session.update_snapshots)
        assert f"{line}\n{text}" == snapshot
    if data is not None:
        assert case.code in codes(data)
        if case.code not in (*TOLD, *ONLY_JSON):
            require_told(case, data, wide)
    if case.follow:
        follow(case, help_of(case, data, wide), run, broken)


def in_json(case, run, done):
    """What a command prints in JSON; None where it has none."""
    if case.run.startswith(("new", "export", "explain")):
        return None
    told = run(f"{case.run} --json", WIDE_ENOUGH)
    assert told.exit == case.exit
    assert len(told.out.splitlines()) == 1 or not case.run.startswith(SOLVED_BY)
    assert case.exit < 2 or told.err == done.err
    data = json.loads(told.out)
    if case.run.startswith(SOLVED_BY):
        SCHEMA_OF[data["schema"]].validate(data)
    return data


def require_drawn(case, text, wide):
    """A width changes nothing but the line breaks."""
    head = "error" if case.exit > 1 else "warning" if case.code[0] == "W" else "result"
    assert case.code in TOLD or text.startswith(f"{head}[{case.code}]: "), text
    assert case.exit < 2 or text.count("error[") == 1
    assert "Traceback" not in text
    assert "\x1b" not in text
    for line in text.splitlines():
        # Only what cannot be broken is wider: one word behind an indentation.
        assert cell_len(line) <= NARROW or " " not in line.strip(), line
    assert whole(text) == whole(wide)


def require_told(case, data, wide):
    """A message in JSON says what is printed."""
    told = field(case, data)
    if case.exit > 1:
        found = parts(wide.rstrip("\n"))
        assert set(told) == {"code", "message", "where", "why", "help"}
        assert {**told, "kind": "error"} == {"where": None, "why": None, "help": None, **found}
    else:
        flat = " ".join(wide.split())
        for key in ("code", "message", "help"):
            assert not told.get(key) or " ".join(told[key].split()) in flat


SOLVED_BY = ("synthesize", "function", "judge")
WAY_ON = {"R303": "W203"}  # an outcome whose help is that of a warning beside it


def parts(text):
    """A printed message taken apart: kind, code, message, where, why and help."""
    head, *lines = text.split("\n")
    kind, code, said = re.fullmatch(r"(\w+)\[(\w+)\]: (.*)", head).groups()
    found, key = {"kind": kind, "code": code, "message": said}, None
    for line in lines:
        if start := re.match(r"  (-->|why:|help:) ", line):
            key = {"-->": "where"}.get(start[1], start[1].rstrip(":"))
            found[key] = line[start.end() :]
        else:
            found[key] += f"\n{line}"
    return found


def help_of(case, data, wide):
    if data is None:
        return parts(wide.rstrip("\n"))["help"]
    if case.code in ONLY_JSON:
        return classify_motion(read_task("poses.csv")).kind.help
    return field(case._replace(code=WAY_ON.get(case.code, case.code)), data).get("help")


def follow(case, help, run, broken):
    """Do what a help says, and run the command again: the code is gone and the input usable."""
    assert help
    broken(None)
    way, line = case.follow, case.run
    if not isinstance(way, Args | Edit | Write | Call):
        way = way(help)
    match way:
        case Args():
            line = way.line
        case Edit():
            text = Path(way.file).read_text("utf-8")
            assert way.old in text
            Path(way.file).write_text(text.replace(way.old, way.new), "utf-8")
        case Write():
            data = way.text
            Path(way.file).write_bytes(data if isinstance(data, bytes) else data.encode())
            line = way.line or line
        case Call():
            way.call()
            return
    if not line.startswith(SOLVED_BY) or "--help" in line:
        done = run(line)
        assert (done.exit, done.err) == (0, "")
        assert f"[{case.code}]" not in done.out
        return
    # Once the input is usable, what a long search of it finds has nothing to do with an error.
    with limited(0 if case.exit > 1 and case.files not in (GOOD, ALL) else None):
        done = run(f"{line} --json")
    assert done.exit in (0, 1), done.err
    data = json.loads(done.out)
    assert case.code not in codes(data), done.out[:500]
    # From one special motion nobody is led into another.
    assert not data["outcome"]["code"].startswith("R31"), done.out[:500]


COLOURED = ("not finite", "transmits badly", "none usable")


@pytest.mark.skipif(sys.platform == "win32", reason="its consoles colour in their own way")
@pytest.mark.parametrize("name", COLOURED)
def test_a_message_in_colour(name, run, ready, snapshot):
    case = ready(name)
    done = run(case.run, FORCE_COLOR="1", TERM="xterm", COLORTERM="")
    text = done.err or done.out
    plain = re.sub(r"\x1b\[[0-9;]*m", "", text)
    assert plain != text
    bare = run(case.run, FORCE_COLOR="1", TERM="xterm", NO_COLOR="1")
    assert plain == (bare.err or bare.out)
    found = re.search(rf"(?m)^.*{case.code}.*\n(?:.*  .*\n)*?.*help: .*\n", text)
    assert found[0].replace("\x1b", "ESC") == snapshot
    if case.exit > 1:
        assert run(case.run).err == bare.err


def test_a_message_is_drawn_in_the_same_way_on_a_terminal_without_colour():
    error = InputError("E103", "what", where="a:1:2\n   1 | abc\n     |  ^ b", why="so", help="do")
    console = Console(file=io.StringIO(), width=60, force_terminal=True, no_color=True)
    show("error", error, console)
    assert console.file.getvalue() == f"{error}\n"


def under(lines):
    """What stands above the carets of a drawn place, a character for every column that it takes."""
    line, carets = (each.partition(" | ")[2] for each in lines)
    start = len(carets) - len(carets.lstrip())
    count = len(re.match(r" *(\^+)", carets)[1])
    return [char for char in line for _ in range(cell_len(char))][start : start + count]


@pytest.mark.parametrize("alphabet", ["abcdefghijklmnopqrstuvwxyz0123456789,.-", "aé長さ,1"])
def test_carets_stay_below_what_they_mark(alphabet):
    rng = np.random.default_rng(len(alphabet))
    cut = 0
    for _ in range(400):
        length = int(rng.integers(1, 160))
        text = "".join(rng.choice(list(alphabet), length))
        at = int(rng.integers(0, length))
        count = int(rng.integers(1, min(12, length - at) + 1))
        remark = str(rng.choice(["", " angle", " a note that is longer than most"]))
        width = int(rng.choice([40, 60, 80, 200]))
        where = f"file.csv:7:{at + 1}\n   7 | {text}\n     | {'':>{at}}{'^' * count}{remark}"
        name, *lines = (line.plain for line in location_lines(where, width, "red"))
        assert name == f"  --> file.csv:7:{at + 1}"
        assert len(lines) == 2
        assert max(map(cell_len, lines)) <= width
        marked = [char for char in text[at : at + count] for _ in range(cell_len(char))]
        assert under(lines) == marked
        shown = lines[0].partition(" | ")[2]
        if shown != text:
            cut += 1
            assert "..." in (shown[:3], shown[-3:])
        assert remark.rstrip() in lines[1] or cell_len(remark) > (width - 7) // 2
    assert cut > 50


def test_commands_and_options_are_not_broken_where_they_fit():
    help = (
        "give it a name, or run `burmester synthesize poses.csv --fixed-pivot box:0,0:10,10` or "
        "ask for more with --min-transmission 40, or for less"
    )
    for width in range(70, 120):
        lines = [line.plain for line in note("help", help, width)]
        assert max(map(cell_len, lines)) <= width
        assert (
            sum("`burmester synthesize poses.csv --fixed-pivot box" in each for each in lines) == 1
        )
        assert sum("--min-transmission 40," in each for each in lines) == 1
        assert all(line.startswith("        ") for line in lines[1:])
        assert " ".join(" ".join(lines).split()) == f"help: {help}"


def test_a_path_is_never_broken():
    path = "/".join(["a-folder-with-a-long-name"] * 6) + "/poses.csv:4:16"
    error = InputError("E103", "what", where=path, help=f"look into {path}")
    lines = drawn(error, 60).splitlines()
    assert lines[1] == f"  --> {path}"
    assert lines[-1].strip() == path


def require_on_its_page(name, text, *, update):
    """Compare what is printed with the example of its code's page, or write it there."""
    code = CASES[name].code
    if EXAMPLES[code] != name:
        return
    if update:
        pages_of = ROOT / "io" / "messages.md"
        page = rf"(?s)(\n## {code} (?:(?!\n## ).)*?\n```)\n.*?(```)"
        source = pages_of.read_text("utf-8")
        pages_of.write_text(re.sub(page, lambda at: f"{at[1]}\n{text}\n{at[2]}", source), "utf-8")
        pages.cache_clear()
    assert pages()[code].example() == text


def test_every_code_has_a_message_here():
    source = "".join(file.read_text("utf-8") for file in sorted(ROOT.rglob("*.py")))
    known = set(re.findall(r"[\"'`]([EWR][0-9]{3})[\"'`]", source))
    assert known == {case.code for case in CASES.values()}
    assert len(CASES) >= 40
