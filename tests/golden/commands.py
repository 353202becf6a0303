"""The commands whose documents are kept: every kind of task, every format, every page.

A scene is a few commands in one folder.  What they print is a document, and so is each file that
they leave there.
"""

from pathlib import Path
from typing import NamedTuple

import burmester

CASES = Path(burmester.__file__).parent / "cases"
TEMPLATES = Path(burmester.__file__).parent / "templates"
EXAMPLES = Path(__file__).parents[2] / "examples"

FIVE = "x,y,angle_deg\n0,0,0\n1.2,0.8,21\n2.1,1.9,38\n2.4,3.1,62\n2.2,4.4,85\n"
# In-line slider-cranks pass these, to six decimals (a crank of 1, a rod of 3).
SLIDING = "x,y,angle_deg\n" + "".join(
    f"{x},{y},{a}\n"
    for x, y, a in [
        (0.866025, 0.5, -9.594068), (0.5, 0.866025, -16.778655), (0.0, 1.0, -19.471221),
        (-0.5, 0.866025, -16.778655), (-0.866025, 0.5, -9.594068), (-1.0, 0.0, 0.0),
        (-0.866025, -0.5, 9.594068),
    ]
)  # fmt: skip
NOISY = "x,y,angle_deg\n" + "".join(
    f"{10 * k},{3 * k * (8 - k) + (-1) ** k * 0.4},{9 * k + (k % 3) * 0.3}\n" for k in range(9)
)
NINE = "x,y\n0,0\n11,3\n20,9\n27,18\n31,29\n31,41\n26,52\n17,60\n6,63\n"
MIXED = "x,y,angle_deg\n0,0,0\n4,1,\n7,3,30\n9,6,\n10,9,\n9,12,\n"
TIMED = "x,y,crank_deg\n0.5,1.1,0\n0.1,0.9,80\n0,0.4,160\n0.2,0.3,240\n0.5,0.7,300\n"
ARC = "x,y\n" + "".join(f"{4 * k},{0.06 * k * k * (9 - k)}\n" for k in range(13))
HEXAGON = "x,y\n0,0\n30,0\n60,0\n55,14\n30,20\n5,14\n0,0\n"
PAIRS = "input_deg,output_deg\n0,0\n20,28\n45,51\n70,69\n90,90\n"
KEEP = '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="9mm" viewBox="0 0 20 9">\
<rect id="wall" x="6" y="0" width="2" height="2"/></svg>'
DOOR = """length_unit = "mm"
angle_unit = "deg"
poses = [[0, 0, 0], [120, 260, 40], [420, 430, 88]]
tolerance = { x = 4, y = 4, angle = 1 }

[requirements]
transmission_deg = 30

[[limits]]
fixed_pivot = { box = [[-400, -500], [200, 200]] }
"""
MANY = "task,x,y,angle_deg\n" + "".join(
    f"{name},{row}\n"
    for name, table in (("five", FIVE), ("noisy", NOISY), ("sliding", SLIDING))
    for row in table.splitlines()[1:]
)


class Scene(NamedTuple):
    """The files of a folder by name, and the commands that are run there, in their order."""

    files: dict[str, str | Path]
    lines: tuple[str, ...]


def _poses(text: str | Path, *lines: str) -> Scene:
    return Scene({"poses.csv": text}, lines)


def _exports(*formats: str) -> tuple[str, ...]:
    """Exports of result.json into files of these endings."""
    names = {"openscad": "scad", "mjcf": "xml", "pylinkage": "py"}
    return tuple(
        f"export result.json --to {each} -o out-{each}.{names.get(each, each)}"
        + (" --fps 4 --seconds 2 --pixels 240" if each == "gif" else "")
        for each in formats
    )


EVERY = ("dxf", "svg", "pdf", "step", "stl", "openscad", "mjcf", "urdf", "gif", "csv", "json")
SOLVE = "synthesize poses.csv -o result.json"
JUDGE = "judge poses.csv --linkage result.json"
FUNCTION = "function 'log10(x)' --x 1:10 --input 60 --output 60"

SCENES = {
    "five poses": _poses(FIVE, SOLVE, *_exports(*EVERY, "pylinkage"),
                         JUDGE),
    "sliders": _poses(SLIDING, SOLVE, *_exports("dxf", "svg", "step", "openscad", "mjcf", "csv")),
    "ten exact poses": Scene({"poses.json": CASES / "ge2012-exact.json"}, (
        "synthesize poses.json --certify", "synthesize poses.json --method pencil --raw")),
    "ten poses": Scene({"poses.json": CASES / "ge2012-approximate.json"}, (
        "synthesize poses.json -o result.json", "check poses.json",
        "report poses.json -o page.html")),
    "noisy poses": _poses(NOISY, SOLVE + " --norm worst", *_exports("urdf", "pdf")),
    "built amiss": _poses(FIVE, "synthesize poses.csv --tolerance 0.01"),
    "rounded": _poses(NOISY, "synthesize poses.csv --round 1 --stock 20,30,40,60,80"),
    "tolerances": _poses(NOISY, "synthesize poses.csv --pose-tolerance 2,2,1.5 --any-order",
                         "synthesize poses.csv --within 2 --min-transmission 40 --driver crank"),
    "three poses": Scene({"lid.csv": EXAMPLES / "lid.csv"}, (
        "synthesize lid.csv -o result.json", "report lid.csv -o page.html", *_exports("svg"))),
    "limits": Scene({"door.toml": DOOR}, (
        "synthesize door.toml", "judge door.toml --dyad 'fixed:-300,-200 moving:-50,-120' "
        "--dyad 'fixed:0,0 moving:200,-40'")),
    "none within limits": _poses(FIVE, "synthesize poses.csv --fixed-pivot box:0,0:0.1,0.1"),
    "rail": _poses(SLIDING, "synthesize poses.csv --kinds PR,RR --rail 'direction:0+-2'"),
    "keep out": Scene({"poses.csv": FIVE.replace("x,y", "x_mm,y_mm"), "keep.svg": KEEP}, (
        "synthesize poses.csv --keep-out keep.svg:wall --link-width 0.2",)),
    "two poses": _poses("x,y,angle_deg\n0,0,0\n30,20,60\n", SOLVE + " --prefer size"),
    "four lines": Scene({"poses.json": CASES / "motiongen-four-line.json"}, (
        "synthesize poses.json",)),
    "clockwise": _poses(FIVE, "synthesize poses.csv --convention clockwise,y-down --drop 3"),
    "markers": Scene({"body.trc": EXAMPLES / "coupler.trc"}, (
        "synthesize body.trc --points HEEL,TIP --every 20", "check body.trc --points HEEL,TIP")),
    "nine points": _poses(NINE, SOLVE, "report poses.csv -o page.html"),
    "poses and points": _poses(MIXED, "synthesize poses.csv"),
    "leg": Scene({"leg.csv": EXAMPLES / "leg.csv"}, (
        "synthesize leg.csv -o result.json", "report leg.csv -o page.html",
        *_exports("csv", "dxf"))),
    "closed path": _poses(
        HEXAGON, "synthesize poses.csv --within 3 --fixed-pivot box:-90,-90:90,0"),
    "open arc": _poses(ARC, "synthesize poses.csv -o result.json",
                       JUDGE),
    "timed points": _poses(TIMED, "synthesize poses.csv -o result.json"),
    "function": Scene({}, (
        FUNCTION + " -o result.json", *_exports("svg", "openscad", "csv"),
        FUNCTION + " --minimax --min-transmission 30", FUNCTION + " --pairs 3",
        "function 'x**2' --x 0:1 --input 90 --output 90 --report page.html",
        "report --function 'x**2' --x 0:1 --input 90 --output 90 --pairs 4 -o old.html")),
    "pairs of angles": Scene({"pairs.csv": PAIRS}, (
        "synthesize pairs.csv -o result.json", "check pairs.csv",
        "judge pairs.csv --linkage result.json")),
    "six-bars": Scene({"lid.csv": EXAMPLES / "lid.csv"}, (
        'synthesize lid.csv --six-bars --six-bar-kind "Watt I" --chains 2000 -o result.json',
        'report lid.csv --six-bars --six-bar-kind "Watt I" --chains 2000 -o page.html',
        "judge lid.csv --linkage result.json",
        *_exports("svg", "dxf", "openscad", "mjcf", "csv"))),
    "batch": Scene({"tasks.csv": MANY}, (
        "batch tasks.csv -o rows --workers 1", "batch tasks.csv -o dyads --depth dyads --workers 1",
        "batch --sample four-bars --count 3 -o drawn --workers 1 --depth pencil")),
    "words": Scene({}, ("--help", "synthesize --help", "cases", "explain", "explain E103")),
}  # fmt: skip
