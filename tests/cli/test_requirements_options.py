"""Requirements on the command line: every option, every refusal with its caret."""

import math
from dataclasses import fields, replace
from types import SimpleNamespace

import numpy as np
import pytest

from burmester import cli
from burmester.io.reading.specification_text import limits_from_options
from burmester.tasks.limits import Limits
from burmester.tasks.option_table import LIMIT_OPTIONS
from burmester.tasks.option_table import OPTIONS as OPTION_TABLE
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from tests.oracles.stated_requirements import CSV, NOTHING, POSES, SAID, SQUARE, reader, values


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    return reader(tmp_path_factory.mktemp("requirements"))


@pytest.fixture
def run(monkeypatch, tmp_path):
    """What `burmester synthesize FILE ...` hands to the synthesis, and its exit code."""
    calls = []

    def synthesize(*positional, **options):
        calls.append((positional, options))
        return run.found

    monkeypatch.setattr("burmester.synthesis.motion_generation.synthesize", synthesize)
    monkeypatch.setattr("burmester.io.terminal.show_synthesis", lambda *_, **__: None)

    def run(*arguments, text=CSV, suffix=".csv"):
        calls.clear()
        file = tmp_path / f"poses{suffix}"
        file.write_text(text)
        with pytest.raises(SystemExit) as stop:
            cli.main(["synthesize", str(file), *map(str, arguments)])
        if not calls:
            return SimpleNamespace(code=stop.value.code, task=None, options=None)
        (((task, options), rest),) = calls
        assert not rest
        return SimpleNamespace(code=stop.value.code, task=task, options=options)

    run.found = SimpleNamespace(usable=(1,), determined=True, works=True)
    return run


OPTIONS = SynthesisOptions(method="auto", normalise=True, norm="rms", certify=False)


def test_the_table_has_every_option_of_a_synthesis_and_its_default():
    assert {each.name for each in OPTION_TABLE} == {each.name for each in fields(SynthesisOptions)}
    for each in OPTION_TABLE:
        default = getattr(OPTIONS, each.name)
        assert default == (each.known[0] if each.known else each.negated or default)
    assert [each.name for each in LIMIT_OPTIONS] == [each.name for each in fields(Limits)]


@pytest.mark.parametrize("name", SAID)
def test_every_option_reaches_the_task(run, name):
    _, arguments, field, value = SAID[name]
    done = run(*arguments)
    assert done.code == 0
    assert values(done.task.requirements) == NOTHING | {field: value}
    assert done.options == OPTIONS
    assert done.task.limits == ()


def test_the_driver_may_be_that_of_either_limits(run):
    for driver in ("first", "second"):
        done = run("--driver", driver, "--fixed-pivot", "0,0")
        assert done.task.requirements.driver == driver
        assert done.task.limits[0].fixed_pivot.at.tolist() == [0, 0]
    assert run("--driver", "third").code == 2


def test_all_of_them_at_once(run):
    arguments = [
        each for name in ("transmission", "types", "crank", "box") for each in SAID[name][1]
    ]
    arguments += ["--link-ratio", "7", "--within", "2", "--within-angle", "0.5"]
    arguments += ["--any-order", "--kinds", "RR"]
    found = run(*arguments).task
    assert values(found.requirements) == {
        "transmission_deg": 37.5,
        "types": {"crank-rocker", "double slider"},
        "driver": "crank",
        "footprint": SQUARE,
        "link_ratio": 7,
        "within": 2,
        "within_deg": 0.5,
        "any_order": True,
    }
    assert [limits.kinds for limits in found.limits] == [{"RR"}]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ((), {}),
        (("--angle-weight", "12.5"), {"length_per_radian": 12.5}),
        (("--tolerance", "0.05"), {"manufacturing_tolerance": 0.05}),
        (("--round", "1e-1"), {"rounding_step": 0.1}),
        (("--time-limit", "2"), {"time_limit": 2.0}),
        (("--time-limit", "1e-3"), {"time_limit": 0.001}),
        (("--stock", "30, 10,20.5"), {"stock_lengths": (30, 10, 20.5)}),
        (("--stock", "30", "--stock", "10,5"), {"stock_lengths": (30, 10, 5)}),
        (("--require-determined",), {}),
        (
            ("--round", "2", "--stock", "4", "--tolerance", ".5"),
            {"rounding_step": 2, "stock_lengths": (4,), "manufacturing_tolerance": 0.5},
        ),
    ],
)
def test_what_is_made_of_it_reaches_the_synthesis(run, arguments, expected):
    done = run(*arguments)
    assert done.code == 0
    assert done.options == replace(OPTIONS, **expected)
    assert done.task.requirements == Requirements()


def test_a_standard_deviation_replaces_what_the_digits_say(run, read):
    """By the variance of an even spread, which is a third of its half-width squared."""
    fine = CSV.replace("2.5", "2.500")
    assert run(text=fine).task.resolution == (0.0005, math.radians(0.005))
    position, angle = run("--pose-sigma", "0.02,0.3").task.resolution
    rng = np.random.default_rng(1)
    spread = rng.uniform(-1, 1, 200_000).std()
    assert position * spread == pytest.approx(0.02, rel=5e-3)
    assert math.degrees(angle) * spread == pytest.approx(0.3, rel=5e-3)
    assert run("--pose-sigma", "0,1").task.resolution[0] == 0
    task = read(CSV, ".csv", pose_sigma=(1.0, 2.0))
    assert task.resolution == pytest.approx((math.sqrt(3), 2 * math.sqrt(3)))
    radians = CSV.replace("deg", "rad")
    assert read(radians, ".csv", pose_sigma=(1.0, 2.0)).resolution == task.resolution


TEXT_FAULTS = [  # option, text, code, column and width of the caret, what is said
    ("--min-transmission", "40deg", "E134", 1, 5, "'40deg' is not a finite number"),
    ("--min-transmission", "-5", "E134", 1, 2, "-5°"),
    ("--min-transmission", "90", "E134", 1, 2, "90°"),
    ("--min-transmission", "nan", "E134", 1, 3, "not a finite number"),
    ("--type", "grashof, crank-roker", "E134", 10, 11, "no linkage type 'crank-roker'"),
    ("--type", "", "E134", 1, 1, "no linkage type ''"),
    ("--type", "grashof,", "E134", 9, 1, "no linkage type ''"),
    ("--footprint", "3,4", "E134", 1, 3, "not a point"),
    ("--footprint", "line:0,0:1,1", "E134", 1, 12, "not a line"),
    ("--footprint", "segment:0,0:1,1", "E134", 1, 15, "not a segment"),
    ("--footprint", "circle:0,0", "E131", 1, 6, "no region 'circle'"),
    ("--footprint", "box:0,0:a,1", "E131", 9, 1, "'a' is not a finite number"),
    ("--footprint", "box:0,0:1", "E131", 9, 1, "not a point"),
    ("--footprint", "box:1,0:0,1", "E132", 1, 11, "x from 1 to 0"),
    ("--footprint", "box:0,0:0,1", "E134", 1, 11, "not a segment"),
    ("--footprint", "polygon:0,0:1,1:2,2", "E131", 1, 19, "no inside"),
    ("--link-ratio", "0.5", "E134", 1, 3, "0.5"),
    ("--link-ratio", "5:1", "E134", 1, 3, "'5:1' is not a finite number"),
    ("--within", "0", "E134", 1, 1, "at most 0"),
    ("--within", " 1,5", "E134", 2, 3, "'1,5' is not a finite number"),
    ("--pose-sigma", "0.1", "E134", 1, 3, "'0.1' is not LENGTH,DEG"),
    ("--pose-sigma", "0.1,1,2", "E134", 1, 7, "not LENGTH,DEG"),
    ("--pose-sigma", "0.1,x", "E134", 5, 1, "'x' is not a finite number"),
    ("--pose-sigma", "1,-2", "E134", 3, 2, "'-2' is below zero"),
    ("--angle-weight", "0", "E134", 1, 1, "'0' is not above zero"),
    ("--angle-weight", "1,2", "E134", 1, 3, "'1,2' is not a finite number"),
    ("--tolerance", "-0.1", "E134", 1, 4, "'-0.1' is not above zero"),
    ("--tolerance", "inf", "E134", 1, 3, "not a finite number"),
    ("--time-limit", "0", "E134", 1, 1, "'0' is not above zero"),
    ("--time-limit", "-2.5", "E134", 1, 4, "'-2.5' is not above zero"),
    ("--time-limit", "nan", "E134", 1, 3, "'nan' is not a finite number"),
    ("--time-limit", "2s", "E134", 1, 2, "'2s' is not a finite number"),
    ("--round", "0.1mm", "E134", 1, 5, "'0.1mm' is not a finite number"),
    ("--stock", "10,0,20", "E134", 4, 1, "'0' is not above zero"),
    ("--stock", "10;20", "E134", 1, 5, "'10;20' is not a finite number"),
    ("--stock", "10,", "E134", 4, 1, "'' is not a finite number"),
]


@pytest.mark.parametrize("fault", TEXT_FAULTS, ids=lambda fault: f"{fault[0]} {fault[1]}")
def test_text_that_is_no_requirement_is_refused_with_a_caret(run, capsys, fault):
    option, text, code, column, width, said = fault
    done = run(option, text)
    assert done.code == 2
    assert done.task is None
    first, *lines = capsys.readouterr().err.splitlines()
    assert first.startswith(f"error[{code}]: ")
    assert said in first
    assert lines[0] == f"  --> {option}:1:{column}"
    assert lines[1].endswith(f"| {text}")
    assert lines[2].count("^") == width
    if code == "E134" and "finite" in said:
        assert "such as -" not in " ".join(" ".join(lines).split()), "all of them are positive"
    assert lines[2].index("^") == lines[1].index("| ") + 1 + column
    assert any(line.startswith("  help: ") for line in lines)


HELP = {  # what is refused, and what its help says to do, done
    "transmission": (["--min-transmission", "90"], [["--min-transmission", "89.9"]]),
    "ratio": (["--link-ratio", "0"], [["--link-ratio", "5"], ["--link-ratio", "1"]]),
    "within": (["--within", "0"], [["--within", "1e-3"], ["--within", "12.5"]]),
    "number": (["--within", "x"], [["--within", "12.5"], ["--within", "3e-4"]]),
    "sigma": (["--pose-sigma", "1"], [["--pose-sigma", "0.05,0.1"], ["--pose-sigma", "0,0"]]),
    "stock": (["--stock", "0"], [["--stock", "3"], []]),
    "time": (["--time-limit", "0"], [["--time-limit", "2"], []]),
    "footprint": (
        ["--footprint", "1,2"],
        [["--footprint", "box:0,0:1,1"], ["--footprint", "polygon:0,0:1,0:0,1"]],
    ),
    "driver": (
        ["--driver", "first"],
        [["--driver", "first", "--kinds", "RR", "--kinds", "RR"], ["--driver", "any"]],
    ),
    "crank": (
        ["--driver", "crank", "--kinds", "PR"],
        [["--driver", "crank", "--kinds", "PR,RR"], ["--kinds", "PR"]],
    ),
    "no crank": (
        ["--driver", "crank", "--type", "triple-rocker"],
        [["--driver", "crank", "--type", "triple-rocker,crank-rocker"], ["--type", "non-grashof"]],
    ),
    "kinds": (
        ["--type", "slider-crank", "--kinds", "RR"],
        [["--type", "crank-rocker", "--kinds", "RR"], ["--type", "slider-crank"]],
    ),
    "outside": (
        ["--footprint", "box:0,0:1,1", "--fixed-pivot", "2,0"],
        [
            ["--footprint", "box:0,0:1,1", "--fixed-pivot", "1,0"],
            ["--footprint", "box:0,0:2,1", "--fixed-pivot", "2,0"],
            ["--fixed-pivot", "2,0"],
        ],
    ),
}


@pytest.mark.parametrize("name", HELP)
def test_following_the_help_works(run, capsys, name):
    wrong, right = HELP[name]
    done = run(*wrong)
    assert done.code == 2
    assert "  help: " in capsys.readouterr().err
    for arguments in right:
        assert run(*arguments).code == 0


@pytest.mark.parametrize(
    ("text", "meant"),
    [("1,5", 1.5), ("40deg", 40), ("40 °", 40), ("2.5mm", 2.5), ("1_234.5", None)],
)
def test_a_slip_in_a_number_is_told_the_number_meant(run, capsys, text, meant):
    assert run("--within", text).code == 2
    help = capsys.readouterr().err.partition("  help: write ")[2].strip()
    if meant is None:
        assert help.startswith("digits")
    else:
        assert run("--within", help).task.requirements.within == meant


def test_where_of_contradictions_on_the_command_line(run, capsys):
    run("--within", "1", "--footprint", "box:0,0:1,1", "--fixed-pivot", "2,0")
    assert "  --> --fixed-pivot 2,0, and --footprint box:0,0:1,1\n" in capsys.readouterr().err
    run("--within", "1", "--driver", "crank", "--type", "non-grashof")
    assert "  --> --type non-grashof, and --driver crank\n" in capsys.readouterr().err
    run("--driver", "second", "--any-order")
    assert "  --> --driver second\n" in capsys.readouterr().err


TWICE = [
    ("transmission_deg = 30", ["--min-transmission", "30"], "transmission_deg"),
    ('types = ["grashof"]', ["--type", "grashof"], "types"),
    ('driver = "crank"', ["--driver", "any"], "driver"),
    ("footprint.box = [[0, 0], [1, 1]]", ["--footprint", "any"], "footprint"),
    ("link_ratio = 5", ["--link-ratio", "6"], "link_ratio"),
    ("within = 5", ["--within", "6"], "within"),
    ("any_order = false", ["--any-order"], "any_order"),
]


@pytest.mark.parametrize(("text", "arguments", "key"), TWICE)
def test_what_is_said_in_the_file_is_not_said_again(run, capsys, text, arguments, key):
    content = f"{POSES}[requirements]\n{text}\n"
    done = run(*arguments, text=content, suffix=".toml")
    assert done.code == 2
    error = " ".join(capsys.readouterr().err.split())
    assert error.startswith("error[E108]: ")
    assert f"poses.toml:4:1, and {' '.join(arguments)} help: " in error
    assert content.splitlines()[3].startswith(key)
    # following the help: either of the two alone
    assert run(text=content, suffix=".toml").code == 0
    assert run(*arguments, text=POSES, suffix=".toml").code == 0
    # the other keys are no repetition
    other = ["--any-order"] if key != "any_order" else ["--within", "1"]
    both = run(*other, text=content, suffix=".toml").task.requirements
    assert both.any_order == (key != "any_order")


def test_limits_and_requirements_of_file_and_command_line_add_up(run):
    content = f"{POSES}[limits]\nlength.most = 3\n[requirements]\nwithin = 5\n"
    done = run("--fixed-pivot", "0,1", "--driver", "first", text=content, suffix=".toml").task
    assert done.requirements == Requirements(within=5, driver="first")
    assert [limits.length for limits in done.limits] == [(0, 3), (0, 3)]
    assert limits_from_options(length=["1:2"]).requirements == ()


@pytest.mark.parametrize(
    ("usable", "determined", "codes"),
    [((), False, (1, 1)), ((1,), False, (0, 1)), ((1,), True, (0, 0))],
)
def test_exit_code_0_means_a_usable_linkage(run, usable, determined, codes):
    run.found = SimpleNamespace(usable=usable, determined=determined, works=bool(usable))
    assert (run().code, run("--require-determined").code) == codes
