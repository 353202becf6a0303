"""Function tasks checked, judged and batched by the command, and read from every kind of table."""

import io
import json
import shlex
from pathlib import Path

import click
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner
from scipy.optimize import least_squares

from burmester.batch import run as run_batch
from burmester.batch.options import BatchOptions
from burmester.batch.part_file import Plan, versions, work
from burmester.batch.sources import line_parts
from burmester.cli import burmester as command
from burmester.diagnosis.pair_checks import pair_findings, reversals
from burmester.errors import InputError
from burmester.functions.phase_family import placed_links
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.functions.function_kind import is_function
from burmester.synthesis.function_generation import generate_function
from burmester.tasks.function_task import FunctionTask
from tests.oracles import function_loops
from tests.oracles.generators import drawn
from tests.oracles.workbooks import number, packed, parts, sheet_xml, text

PAIRS = [(0, 0), (15, 10), (30, 25), (45, 45), (60, 75)]
TABLE = "input_deg,output_deg\n" + "".join(f"{a},{b}\n" for a, b in PAIRS)


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("pairs.csv").write_text(TABLE)

    def run(*arguments):
        return CliRunner().invoke(command, arguments, standalone_mode=False)

    return run


# --- tables


def parquet(columns):
    content = io.BytesIO()
    pq.write_table(pa.table(columns), content)
    return content.getvalue()


def workbook(rows):
    head, *below = rows
    cells = [list(map(text, head)), *([number(str(v)) for v in row] for row in below)]
    return packed(parts({"Scale": sheet_xml(cells)}))


def test_pairs_in_a_workbook_and_in_parquet_are_those_of_a_table():
    inputs, outputs = np.array(PAIRS, dtype=float).T
    files = {
        "a.xlsx": workbook([("Input_deg", "output_deg", "weight"), *((a, b, 1) for a, b in PAIRS)]),
        "a.parquet": parquet({"output_deg": outputs, "input_deg": inputs}),
        "b.parquet": parquet({"input_rad": np.radians(inputs), "output_deg": outputs}),
    }
    for name, data in files.items():
        assert is_function(data, name)
        task = read_function(data, name)
        assert np.allclose(np.degrees(task.inputs), inputs)
        assert np.allclose(np.degrees(task.outputs), outputs)


def test_what_is_wrong_in_a_workbook_or_in_parquet_is_shown_where_it_is():
    sheet = [text("input_deg"), text("output_deg")], [number("1"), text("two")]
    with pytest.raises(InputError) as caught:
        read_function(packed(parts({"Scale": sheet_xml(sheet)})), "a.xlsx")
    assert (caught.value.code, "cell B2" in caught.value.where) == ("E104", True)
    with pytest.raises(InputError) as caught:
        read_function(parquet({"input_deg": [0.0, None], "output_deg": [0.0, 1.0]}), "a.parquet")
    assert (caught.value.code, "an empty cell" in caught.value.message) == ("E104", True)
    assert caught.value.where == "a.parquet: row 2, column input_deg"
    assert not is_function(parquet({"x": [0.0], "y": [1.0], "angle_deg": [2.0]}), "a.parquet")


# --- check


def smooth(count, seed):
    return drawn(seed, span=1.4, count=count)[1:]


def test_a_pair_beside_the_curve_is_told_and_no_other():
    told = 0
    for seed in range(30):
        inputs, outputs = smooth(12, seed)
        assert pair_findings(FunctionTask(inputs, outputs)) == ()
        wrong = 1 + seed % 10
        outputs[wrong] += 0.1 * np.ptp(outputs)
        for each in pair_findings(FunctionTask(inputs[::-1], outputs[::-1])):
            if "stands out" in each.message:
                assert each.message.startswith(f"pair {12 - wrong} stands out")
                told += 1
    assert told > 25


def test_outputs_of_four_bars_turn_round_twice_at_most():
    """Cranks that turn fully, each closed at many places by a loop of its own."""
    rng = np.random.default_rng(0)
    seen = set()
    while len(seen) < 2:
        a, r, b = np.exp(rng.uniform(-1, 1, 3))
        diagonal = 1 - a * np.exp(1j * (np.linspace(0, 2 * np.pi, 361) + rng.uniform(0, 6)))
        cosine = (r * r - b * b - abs(diagonal) ** 2) / (2 * b * abs(diagonal))
        if np.abs(cosine).max() < 1:
            outputs = np.unwrap(np.angle(diagonal) + np.arccos(cosine))
            turns = reversals(np.arange(361.0), outputs)
            assert turns <= 2
            seen.add(turns)


def test_check_says_what_pairs_ask_for(run):
    done = run("check", "pairs.csv")
    assert done.return_value == 0
    assert "5 pairs, both phases open: 3 linkages at most" in done.output
    data = json.loads(
        run("function", "pairs.csv", "--check", "--json", "--input-phase", "20").output
    )
    assert data["asks"] == {
        "pairs": 5, "open_phases": 1, "kind": "nearest", "solutions": 6,
    }  # fmt: skip
    waves = ["sin(x)", "--x", "0:20", "--input", "90", "--output", "90"]
    done = run("function", *waves, "--check")
    assert done.return_value == 1
    assert "the output turns round 6 times" in done.output
    Path("small.csv").write_text("input_deg,output_deg\n0,0\n.5,.2\n1,.5\n1.5,1\n")
    assert "input_rad and output_rad" in run("check", "small.csv").output


# --- judge


def lengths(one):
    return [float(v) for v in (one.input_link, one.coupler, one.output_link)]


@pytest.mark.parametrize("known", [(), ("input_phase",), ("output_phase",)])
@pytest.mark.parametrize("seed", range(3))
def test_links_are_placed_where_they_make_their_own_pairs(known, seed):
    one, inputs, outputs = drawn(seed)
    phases = {name: float(getattr(one, name)[0]) for name in known}
    placed = placed_links(*lengths(one[0]), FunctionTask(inputs, outputs, **phases), None)
    made = function_loops.outputs(placed, inputs)
    assert np.abs(np.angle(np.exp(1j * (made - outputs)))).max() < 1e-6


def test_scipy_places_links_no_better():
    one, inputs, outputs = drawn(7, count=9)
    outputs = outputs + 0.05 * np.sin(5 * inputs)
    a, r, b = lengths(one[0])
    placed = placed_links(a, r, b, FunctionTask(inputs, outputs), None)
    least = (placed.error(inputs, outputs) ** 2).sum()

    def errors(phases, side):
        pin = a * np.exp(1j * (phases[0] + inputs))
        reach = np.abs(1 - pin)
        cosine = np.clip((r * r - b * b - reach**2) / (2 * b * reach), -1, 1)
        made = np.angle(1 - pin) + side * np.arccos(cosine) - phases[1]
        return np.angle(np.exp(1j * (made - outputs)))

    rng = np.random.default_rng(0)
    ends = [
        least_squares(errors, rng.uniform(-np.pi, np.pi, 2), args=(side,)).cost * 2
        for side in (1, -1)
        for _ in range(20)
    ]
    assert least < min(ends) + 1e-9
    assert least == pytest.approx(min(ends), rel=1e-6)


def test_judge_takes_lengths(run):
    run("synthesize", "pairs.csv", "-o", "a.json")
    data = json.loads(Path("a.json").read_text())["linkages"][0]
    links = ",".join(f"{100 * v!r}" for v in data["links"].values())
    done = run("function", "pairs.csv", "--links", links, "--json")
    assert done.return_value == 0
    (judged,) = json.loads(done.output)["linkages"]
    assert judged["links"]["ground"] == 100
    assert judged["structural_error_deg"]["max"] < 1e-5
    assert judged["side"] == data["side"]
    for more in ("--ground 3", "--linkage a.json", "--id L1"):
        with pytest.raises(InputError) as caught:
            run_raising(run, "function", "pairs.csv", "--links", links, *more.split())
        assert caught.value.code == "E194"
    for wrong in ("1,2,3", "1,2,3,-4", "1,2,3,x"):
        with pytest.raises(InputError):
            run_raising(run, "function", "pairs.csv", "--links", wrong)


def test_a_result_of_poses_holds_no_generator(run):
    Path("poses.csv").write_text("x,y,angle_deg\n0,0,0\n1.2,0.8,21\n2.1,1.9,38\n2.4,3.1,62\n")
    run("synthesize", "poses.csv", "-o", "poses.json")
    with pytest.raises(InputError) as caught:
        run_raising(run, "function", "pairs.csv", "--linkage", "poses.json")
    assert (caught.value.code, caught.value.where) == ("E150", "poses.json")


def run_raising(run, *arguments):
    done = run(*arguments)
    if done.exception is not None:
        raise done.exception


# --- one command, and the words of those of poses

SQUARE = "--x 0:1 --input 90 --output 60 --pairs 5"
LINKS = "pairs.csv --links 1,2.2,0.7,2"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (f"synthesize --function x**2 {SQUARE}", f"function x**2 {SQUARE}"),
        (f"synthesize {SQUARE} --function=-x**2", f"function {SQUARE} -- -x**2"),
        (f"check --function x**2 {SQUARE}", f"function x**2 {SQUARE} --check"),
        (f"judge {LINKS}", f"function {LINKS}"),
        ("synthesize --ground=50 pairs.csv", "function pairs.csv --ground 50"),
        ("synthesize pairs.csv", "function pairs.csv"),
        ("check pairs.csv", "function pairs.csv --check"),
    ],
)
def test_functions_in_commands_of_poses_go_to_their_own(run, old, new):
    before, after = (
        json.loads(run(name, "--json", *words).output)
        for name, *words in (old.split(), new.split())
    )
    told = [each for each in before["warnings"] if each["code"] == "W245"]
    assert len(told) == (any(word in old for word in ("--function", "--links", "--ground")))
    for each in told:
        _, name, *words = shlex.split(each["help"].split("`")[1])
        assert json.loads(run(name, "--json", *words).output) == after
    before["warnings"] = [each for each in before["warnings"] if each not in told]
    assert before == after


def test_files_of_old_commands_get_the_names_they_had(run):
    run("synthesize", "pairs.csv", "--output", "a.json")
    run("report", "pairs.csv", "--title", "Scale")
    run("report", *f"--function x**2 {SQUARE} -o b.html".split())
    run("function", "pairs.csv", *["-o", "c.json", "--plot", "c.svg", "--report", "c.html"])
    assert Path("a.json").read_bytes() == Path("c.json").read_bytes()
    assert "Scale" in Path("pairs.html").read_text()
    assert {each.name for each in Path().iterdir()} == {
        "pairs.csv", "pairs.html", "a.json", "b.html", "c.json", "c.svg", "c.html",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("synthesize poses.csv --output 60", "E194"),
        ("report poses.csv --output=60", "E194"),
        ("judge pairs.csv", "E194"),
        ("function x**2", "E194"),
        ("function x**2 --x 0:1 --input 90 --output a.json", "E194"),
        ("function x**2 --x 1 --input 90 --output 60", "E194"),
        ("function pairs.csv --output 60", "E194"),
        ("function pairs.csv --check -o a.json", "E194"),
        ("function pairs.csv --side left", "E194"),
        ("function pairs.csv --id L1", "E194"),
        ("function pairs.csv --plot a.bmp", "E161"),
        ("function pairs", "E101"),
        ("function pears.csv", "E101"),
        ("function poses.csv", "E107"),
        ("function pairs.csv -o pairs.csv --force", "E142"),
    ],
)
def test_words_that_make_no_sense_are_refused_before_anything_is_solved(run, words, code):
    Path("poses.csv").write_text("x,y,angle_deg\n0,0,0\n1,2,30\n3,3,50\n")
    with pytest.raises(InputError) as caught:
        run_raising(run, *words.split())
    assert caught.value.code == code
    assert caught.value.help
    assert {each.name for each in Path().iterdir()} == {"pairs.csv", "poses.csv"}


def test_options_of_poses_are_not_those_of_functions(run):
    with pytest.raises(click.UsageError, match="--fixed-pivot"):
        run_raising(run, "synthesize", "pairs.csv", "--fixed-pivot", "0,0")


def test_pairs_come_from_standard_input_too(run):
    whole = run("function", "pairs.csv", "--json").output
    for words in (["function", "-"], ["synthesize", "-"]):
        done = CliRunner().invoke(command, [*words, "--json"], TABLE, standalone_mode=False)
        assert done.output == whole


def test_a_linkage_that_exists_has_a_page_too(run):
    done = run("function", *LINKS.split(), "--report", "a.html")
    assert done.return_value == 0
    assert "double-rocker" in Path("a.html").read_text()


# --- batch


def test_a_batch_of_pairs_holds_what_synthesize_says(tmp_path):
    rows = ["task,input_deg,output_deg"]
    for name in (4, 2):
        rows += [f"{name},{a},{b + (b == 75) * name}" for a, b in PAIRS]
    (tmp_path / "tasks.csv").write_text("\n".join(rows))
    (tmp_path / "options.toml").write_text("[function]\nground = 50\n")
    out = tmp_path / "out"
    run_batch(tmp_path / "tasks.csv", out, options=tmp_path / "options.toml", workers=1)
    found = pq.read_table(out).to_pylist()
    assert [(row["task"], row["pairs"], row["poses"]) for row in found] == [
        (4, 5, None),
        (2, 5, None),
    ]
    for row in found:
        inputs, outputs = np.radians([(a, b + (b == 75) * row["task"]) for a, b in PAIRS]).T
        said = generate_function(FunctionTask(inputs, outputs))
        assert row["code"] == said.outcome.code
        assert [each["type"] for each in row["generators"]] == [e.type for e in said.generators]
        for each, one in zip(row["generators"], said.generators, strict=True):
            assert each["ground"] == 50
            assert each["coupler"] / 50 == pytest.approx(float(one.generator.coupler))
            assert (each["verdict"] == "usable") == one.usable


def test_lines_mix_functions_and_poses_and_other_depths_say_so(tmp_path):
    poses = [{"x": k, "y": k * k, "angle_deg": 9 * k} for k in range(5)]
    lines = [
        {"function": {"pairs": PAIRS}},
        {"poses": poses},
        {"function": {"expression": "sin(y)", "x": [0, 1], "input_deg": 9, "output_deg": 9}},
    ]
    file = tmp_path / "tasks.jsonl"
    file.write_text("\n".join(map(json.dumps, lines)))
    (part,) = line_parts(str(file), 10)
    for depth, outcomes in (
        ("full", ["solved", "solved", "refused"]),
        ("dyads", ["not at this depth", "solved", "refused"]),
    ):
        worked = work(part, Plan(depth, BatchOptions(), "", 600.0, versions()), {})
        rows = pq.read_table(io.BytesIO(worked.data)).to_pylist()
        assert [row["outcome"] for row in rows] == outcomes
        assert [row["pairs"] for row in rows] == [5, None, None]
        assert rows[2]["code"] == "E190"


@pytest.mark.parametrize(
    ("head", "code"),
    [
        ("task,input_deg", "E105"),
        ("task,input_deg,output_rad", "E105"),
        ("task,input_deg,output_deg,input_rad,output_rad", "E108"),
        ("task,input_deg,output_deg,exact", "E107"),
    ],
)
def test_a_table_of_pairs_with_other_columns_is_refused(tmp_path, head, code):
    (tmp_path / "tasks.csv").write_text(head + "\n" + ",".join("1" * len(head.split(","))) + "\n")
    with pytest.raises(InputError) as caught:
        run_batch(tmp_path / "tasks.csv", tmp_path / "out", workers=1)
    assert caught.value.code == code


def test_pairs_without_any_phase_are_no_fault(run):
    """Where no output phase fits the input phase, there is nothing to decompose."""
    words = "x**2 --x 1:2 --input 30.5276 --output 65.3747 --pairs 4"
    done = run("function", *words.split(" "), "--input-phase", "118.42297963372516")
    assert done.return_value == 1
    assert "R361" in done.output
