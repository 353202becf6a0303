"""Function tasks from expressions and files, results written and read back, and the commands."""

import json
import string
from contextlib import suppress
from importlib import resources
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner

import burmester
from burmester.cli import burmester as command
from burmester.errors import InputError
from burmester.io import templates
from burmester.io.reading.functions.expression import read_expression
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.pose_table import Source
from burmester.io.reading.poses import read_task
from burmester.io.saved import read_result
from burmester.synthesis.function_generation import generate_function

SCHEMA = json.loads(resources.files("burmester").joinpath("io/function.schema.json").read_text())
PAIRS = "input_deg,output_deg\n0,0\n15,10\n30,25\n45,45\n60,75\n"
SINE = ["function", "sin(x)", "--x", "0:pi/2", "--input", "90", "--output", "90"]


def values(text, x):
    return read_expression(Source("expression", text))(np.asarray(x, dtype=float))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x**2 - 3*x + 1", lambda x: x**2 - 3 * x + 1),
        ("-x**2", lambda x: -(x**2)),
        ("2**-x", lambda x: 2**-x),
        ("log10(x) / log(x)", lambda x: np.log10(x) / np.log(x)),
        ("sin(pi*x/180) + e", lambda x: np.sin(np.pi * x / 180) + np.e),
        ("abs(-x) + sqrt(exp(x)) + atan(x)", lambda x: x + np.sqrt(np.exp(x)) + np.arctan(x)),
        (" ( x ) ", lambda x: x),
        ("7", lambda x: np.full_like(x, 7)),
    ],
)
def test_an_expression_has_the_values_of_its_mathematics(text, expected):
    x = np.array([0.3, 1.7, 2.5])
    assert np.allclose(values(text, x), expected(x))


@pytest.mark.parametrize(
    ("text", "at"),
    [
        ("log10(y)", "y"),
        ("2 + foo(x)", "foo(x)"),
        ("x^2", "x^2"),
        ("x.real", "x.real"),
        ("x if x else 1", "x if x else 1"),
        ("[x for x in x]", "[x for x in x]"),
        ("sin(x, 2)", "sin(x, 2)"),
        ("sin", "sin"),
        ("2(x+1)", "2(x+1)"),
        ("1 + 'a'", "'a'"),
        ("lambda: 1", "lambda: 1"),
        ("__import__('os')", "__import__('os')"),
        ("x + 1j", "1j"),
        ("x // 2", "x // 2"),
        ("x < 2", "x < 2"),
    ],
)
def test_the_caret_is_below_what_is_refused(text, at):
    with pytest.raises(InputError) as caught:
        values(text, [1.0])
    assert caught.value.code == "E190"
    _, line, carets = caught.value.where.split("\n")
    start, size = carets.index("^"), carets.count("^")
    assert line[start : start + size] == at


def test_no_text_raises_anything_but_an_input_error():
    rng = np.random.default_rng(0)
    words = "x pi e sin log10( ( ) ** * / + - 1e999 0x1f 1_0 . , [ { lambda é ' # = := await ~ ^"
    pieces = [*words.split(), "9" * 400, "x\u2212", "\0", "\n", "10**10**10", "0/0", " "]
    alphabet = [*pieces, *string.printable]
    read = 0
    for _ in range(500):
        text = "".join(rng.choice(alphabet, int(rng.integers(0, 12))))
        with suppress(InputError):
            read += values(text, [1.0, 2.0]).shape == (2,)
    assert read > 5
    for text in ("(" * 400 + "x", "-" * 450 + "x", "x" + "+x" * 200, "x" * 600):
        with pytest.raises(InputError):
            values(text, [1.0])


def test_no_file_raises_anything_but_an_input_error():
    rng = np.random.default_rng(1)
    for _ in range(300):
        text = list(PAIRS)
        for _ in range(int(rng.integers(1, 5))):
            text[int(rng.integers(len(text)))] = str(
                rng.choice([*string.printable, "nan", "1e400"])
            )
        with suppress(InputError):
            task = read_function("".join(text).encode(), "pairs.csv")
            assert np.isfinite(task.inputs).all()


def test_forms_of_a_table_are_one_task():
    task = read_function(PAIRS.encode(), "pairs.csv")
    radians = "\n".join(
        ["output_rad;input_rad"]
        + [f"{np.radians(b)!r};{np.radians(a)!r}".replace("np.float64(", "").replace(")", "")
           for a, b in ((0, 0), (15, 10), (30, 25), (45, 45), (60, 75))]
    )  # fmt: skip
    toml = "[function]\npairs = [[0, 0], [15, 10], [30, 25], [45, 45], [60, 75]]\n"
    tree = json.dumps({"function": {"pairs": [[0, 0], [15, 10], [30, 25], [45, 45], [60, 75]]}})
    for text, name in ((radians, "a.csv"), (toml, "a.toml"), (tree, "a.json")):
        other = read_function(text.encode(), name)
        assert np.allclose(other.inputs, task.inputs)
        assert np.allclose(other.outputs, task.outputs)


def test_a_table_of_pairs_is_read_as_one_of_poses_is():
    """Titles, names, units, decimal commas and columns that are passed over."""
    text = "Scale 7\nInput [°];Abtrieb (rad);t\n0;0;1\n15,5;0,25;2\n30;0,5;3\n"
    task = read_function(text.encode(), "a.csv")
    assert np.degrees(task.inputs).tolist() == pytest.approx([0, 15.5, 30])
    assert task.outputs.tolist() == pytest.approx([0, 0.25, 0.5])
    assert [each.code for each in task.notes] == ["W213", "W213"]
    assert generate_function(read_function(text.encode(), "a.csv")).warnings[:2] == task.notes


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("input_deg\n1\n", "E105"),
        ("output_deg\n1\n", "E105"),
        ("input_deg,output_deg,exact\n1,2,yes\n", "E107"),
        ("input,output_deg\n1,2\n", "E107"),
        ("input_deg,input_rad,output_deg\n1,2,3\n", "E108"),
        ("input_deg,output_deg\n1,2,3\n", "E106"),
        ("input_deg,output_deg\n1,\n", "E104"),
        ("# nothing\n", "E102"),
    ],
)
def test_a_table_of_pairs_that_is_wrong_is_refused(text, code):
    with pytest.raises(InputError) as caught:
        read_function(text.encode(), "a.csv")
    assert caught.value.code == code
    assert caught.value.where.startswith("a.csv")


def test_poses_have_no_output():
    """The column is one of pairs, and is not passed over in silence."""
    with pytest.raises(InputError, match="'output_deg' is not known") as caught:
        read_task("-", data=b"x,y,angle_deg,output_deg\n0,0,0,1\n1,2,30,2\n3,3,50,3\n")
    assert caught.value.code == "E107"
    timed = read_task("-", data=b"x,y,input_deg\n0,0,0\n5,1,20\n9,4,50\n11,8,80\n12,13,100\n")
    assert np.degrees(timed.path.crank_angles).tolist() == pytest.approx([0, 20, 50, 80, 100])


def test_weights_count():
    weighted = PAIRS.replace("deg\n", "deg,weight\n", 1)
    head, *rows = weighted.split("\n")[0], *PAIRS.split("\n")[1:-1], "75,99"
    text = "\n".join([head, *(f"{row},{1 + 99 * (k == 2)}" for k, row in enumerate(rows))])
    task = read_function(text.encode(), "a.csv")
    best = generate_function(task).generators[0]
    assert abs(best.errors[2]) == np.abs(best.errors).min()


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("pairs.csv").write_text(PAIRS)

    def run(*arguments):
        return CliRunner().invoke(command, arguments, standalone_mode=False)

    return run


def test_a_result_is_exported_as_the_linkage_that_it_holds(run):
    done = run("synthesize", "pairs.csv", "-o", "a.json", "--json")
    assert done.return_value == 0
    data = json.loads(Path("a.json").read_text())
    jsonschema.validate(data, SCHEMA)
    assert json.loads(done.stdout.splitlines()[-1]) == data
    assert run("export", "a.json", "-o", "b.json").exception is None
    exported = json.loads(Path("b.json").read_text())
    links = data["linkages"][0]["links"]
    first, second = exported["dyads"]
    assert first["radius"] == pytest.approx(links["input"])
    assert second["radius"] == pytest.approx(links["output"])
    assert np.hypot(*np.subtract(second["fixed_pivot"], first["fixed_pivot"])) == pytest.approx(1)
    again = run("judge", "pairs.csv", "--linkage", "a.json", "--json")
    assert again.return_value == 0
    judged = json.loads(again.stdout)
    assert judged["linkages"][0]["structural_error_deg"]["max"] < 1e-6
    jsonschema.validate(judged, SCHEMA)


def test_a_changed_result_is_judged_again(run):
    """No number is taken on trust: a link made longer loses its verdict and its error."""
    run(*SINE, "--pairs", "5", "-o", "a.json")
    data = json.loads(Path("a.json").read_text())
    data["linkages"][0]["links"]["coupler"] *= 3
    Path("a.json").write_text(json.dumps(data))
    read = read_result("a.json").synthesis
    (found,) = read.generators
    assert not found.usable
    (told,) = [each for each in read.warnings if each.code == "W244"]
    assert told.message.startswith("judged anew, L1 is not usable")
    for change in ({"links": {}}, {"side": 0}, {"input_phase_deg": "a"}, {"id": 3}):
        broken = {**data, "linkages": [{**data["linkages"][0], **change}]}
        with pytest.raises(InputError) as caught:
            read_result("a.json", json.dumps(broken).encode())
        assert caught.value.code == "E150"
    beside = {**data, "linkages": [data["linkages"][0], {"id": "L2"}]}
    read = read_result("a.json", json.dumps(beside).encode())
    assert [each.id for each in read.synthesis.generators] == ["L1"]
    with pytest.raises(InputError, match="lacks a dimension"):
        read.choose("L2")


def test_every_task_says_itself_in_its_result(run):
    run(*SINE, "--pairs", "4", "--input-phase", "100", "--opposite", "-o", "a.json")
    data = json.loads(Path("a.json").read_text())
    jsonschema.validate(data, SCHEMA)
    task = read_function(Path("a.json").read_bytes(), "a.json")
    assert [round(np.degrees(v), 9) for v in task.inputs] == [
        round(pair["input_deg"], 9) for pair in data["task"]["pairs"]
    ]
    assert np.degrees(task.input_phase) == pytest.approx(100)
    assert (task.outputs[1:] < 0).all()


@pytest.mark.parametrize("name", ["log-generator", "sine-generator"])
def test_a_template_has_a_usable_generator(name):
    text = templates.text(name)
    assert "\n# Constructed for burmester; not taken from a product" in text
    task = read_function(text.encode(), f"{name}.toml")
    best = generate_function(task).usable[0]
    assert np.degrees(best.max_error) < 0.3
    assert task.ground == 100


def test_a_report_is_written_for_pairs(run):
    done = run("report", "pairs.csv")
    assert done.return_value == 0
    assert "pairs.csv" in Path("pairs.html").read_text(encoding="utf-8")


def test_a_figure_is_drawn(run):
    assert run("synthesize", "pairs.csv", "--plot", "a.svg").return_value == 0
    assert "structural error" in Path("a.svg").read_text()


def test_python_gives_what_the_command_gives(run):
    found = burmester.synthesize_function(
        [(0, 0), (15, 10), (30, 25), (45, 45), (60, 75)], angle_unit="deg"
    )
    run("synthesize", "pairs.csv", "-o", "a.json")
    assert json.loads(json.dumps(found.to_dict())) == json.loads(Path("a.json").read_text())
    motion = found.coupler_motion()
    assert motion.best.type == found.best.type
    with pytest.raises(InputError, match="no linkage L9"):
        found["L9"]
    with pytest.raises(InputError, match="angle unit is not stated"):
        burmester.synthesize_function([(0, 0), (1, 1), (2, 3)])
    with pytest.raises(InputError, match="needs x, input_deg and output_deg"):
        burmester.synthesize_function("x")
