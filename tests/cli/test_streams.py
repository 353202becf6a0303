"""The verdict of a command is its exit code, whatever its standard streams are."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.oracles.ten_poses import TEN
from tests.samples import some_of

posix = pytest.mark.skipif(os.name != "posix", reason="streams as a POSIX shell closes them")
pytestmark = posix

COMMAND = f"{sys.executable} -m burmester"
NEVER = ("Traceback", "Exception ignored", "E900", "BrokenPipe")
# Not usable: the second and the third pose are exchanged, and the order is asked for.
UNUSABLE = TEN.splitlines()
UNUSABLE[2], UNUSABLE[3] = UNUSABLE[3], UNUSABLE[2]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("poses.csv").write_text(TEN)
    Path("unusable.csv").write_text("\n".join(UNUSABLE))
    return tmp_path


def shell(line, **more):
    """A line for bash, whose last word is the exit code of the command in it."""
    done = subprocess.run(
        ["bash", "-c", line],
        capture_output=True,
        text=True,
        errors="surrogateescape",
        timeout=120,
        check=False,
        **more,
    )
    for word in NEVER:
        assert word not in done.stderr, done.stderr
    return done


def piped(arguments, *rest):
    return shell(f"{COMMAND} {arguments} | {' '.join(rest)}; exit ${{PIPESTATUS[0]}}")


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ("synthesize poses.csv", 0),
        ("synthesize poses.csv --json", 0),
        ("synthesize unusable.csv --type double-crank", 1),
        ("synthesize nothing.csv --json", 2),
        ("explain", 0),
        ("--help", 0),
    ],
)
def test_a_reader_that_goes_does_not_change_the_verdict(arguments, code):
    """`head` reads a line and goes; `true` reads nothing at all."""
    assert piped(arguments, "head -n 1").returncode == code
    assert piped(arguments, "true").returncode == code


CLOSED = ("<&-", ">&-", "2>&-", "<&- >&- 2>&-")


@pytest.mark.parametrize("closed", CLOSED)
def test_closed_streams_do_not_change_the_verdict(closed):
    assert shell(f"{COMMAND} synthesize poses.csv --json {closed}").returncode == 0
    assert shell(f"{COMMAND} check nothing.csv {closed}").returncode == 2


@pytest.mark.parametrize("closed", CLOSED)
def test_a_file_never_takes_the_place_of_a_closed_stream(closed):
    """A descriptor that is free is the next file's: what is printed would be written into it."""
    done = shell(f"{COMMAND} synthesize poses.csv -o result.json {closed}")
    assert done.returncode == 0
    assert json.loads(Path("result.json").read_text())["outcome"]["code"] == "R300"
    assert shell(f"{COMMAND} export result.json -o a.csv {closed}").returncode == 0
    assert Path("a.csv").read_text().startswith("drive_deg,")


def test_standard_input_that_is_closed_is_said():
    done = shell(f"{COMMAND} synthesize - <&-")
    assert done.returncode == 2
    assert "error[E101]: standard input is closed" in done.stderr


def test_input_without_an_end_is_refused():
    done = shell(f"ulimit -v 4000000; {COMMAND} check - < /dev/zero")
    assert done.returncode == 2
    assert "more than 50 MB" in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
@pytest.mark.parametrize(
    "arguments", ["synthesize poses.csv", "synthesize poses.csv --json", "explain", "--version"]
)
def test_output_that_has_no_room_is_an_error(arguments):
    done = shell(f"{COMMAND} {arguments} > /dev/full")
    assert done.returncode == 2
    assert "error[E141]: standard output cannot be written" in done.stderr
    assert "No space left on device" in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_errors_that_have_no_room_keep_their_code():
    assert shell(f"{COMMAND} synthesize nothing.csv 2> /dev/full").returncode == 2
    assert shell(f"{COMMAND} synthesize poses.csv > /dev/full 2> /dev/full").returncode == 2


def test_a_slow_reader_that_does_not_wait_gets_everything():
    """Standard output may be a pipe that refuses to block, as some programs leave theirs."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    process = subprocess.Popen(
        [sys.executable, "-m", "burmester", "synthesize", "poses.csv", "--json"],
        stdout=writer,
        stderr=subprocess.PIPE,
    )
    os.close(writer)
    with open(reader, "rb") as file:
        data = json.loads(file.read())
    assert process.wait() == 0
    assert process.stderr.read() == b""
    process.stderr.close()
    assert data["outcome"]["code"] == "R300"


def test_a_name_of_any_bytes_is_read_and_written_and_shown_escaped():
    given = b"p\xff\xfe\x1b[31m\nq\r.csv"
    with open(given, "w") as file:
        file.write(TEN)
    out = given.replace(b".csv", b".json")
    command = [sys.executable, "-m", "burmester"]
    done = subprocess.run(
        [*command, "synthesize", given, "-o", out], capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.startswith(b"wrote p\\")
    page = given.replace(b".csv", b".html")
    every = [
        ["report", given, "-o", page, "--title", given],
        ["check", given],
        ["export", out, "-o", given.replace(b".csv", b".svg")],
        ["synthesize", given + b"x"],
        ["synthesize", given, "-o", out],
        ["export", out, "-o", given.replace(b".csv", b".") + b"\x1b"],
        ["synthesize", given, "--drop", given],
        ["synthesize", given, "--type", given],
        ["synthesize", given, "--fixed-pivot", given],
        ["explain", given],
        ["cases", given],
        ["new", given],
        [given],
    ]
    for arguments in some_of(every, 5):
        done = subprocess.run([*command, *arguments], capture_output=True, check=False)
        assert done.returncode in (0, 2), (arguments, done.stderr)
        for text in (done.stdout, done.stderr):
            assert not set(text) & (set(range(32)) - {10}) - {9}, (arguments, text)
            assert b"\xff" not in text
            assert b"m\nq" not in text
    assert os.stat(page).st_size > 10_000


@pytest.mark.parametrize("way", ["name", "link", "hard link", "dots", "standard input"])
@pytest.mark.parametrize("command", ["synthesize", "report"])
def test_the_file_that_is_read_is_not_replaced(folder, command, way):
    os.symlink("poses.csv", "link.csv")
    os.link("poses.csv", "hard.csv")
    source, output = {
        "name": ("poses.csv", "poses.csv"),
        "link": ("poses.csv", "link.csv"),
        "hard link": ("hard.csv", "poses.csv"),
        "dots": ("poses.csv", f"{folder}/./poses.csv"),
        "standard input": ("- < poses.csv", "poses.csv"),
    }[way]
    for force in ("", "--force"):
        done = shell(f"{COMMAND} {command} -o {output} {force} {source}")
        assert done.returncode == 2
        assert "error[E142]" in done.stderr
        assert Path("poses.csv").read_text() == TEN
    assert sorted(os.listdir()) == ["hard.csv", "link.csv", "poses.csv", "unusable.csv"]


def test_the_result_that_is_exported_is_not_replaced():
    shell(f"{COMMAND} synthesize poses.csv -o result.json")
    before = Path("result.json").read_bytes()
    done = shell(f"{COMMAND} export result.json -o result.json --force")
    assert done.returncode == 2
    assert "error[E142]: result.json is the file that is read" in done.stderr
    assert Path("result.json").read_bytes() == before


def test_warnings_of_numpy_are_not_for_the_screen():
    """Numbers near the end of what a double holds overflow on the way; the end is judged."""
    text = """if True:
        import sys
        import numpy as np
        import burmester.synthesis.motion_generation as road
        from burmester.__main__ import main
        real = road.synthesize
        def loud(*given):
            np.float64(1e300) * np.float64(1e300)
            np.log(np.zeros(1))
            return real(*given)
        road.synthesize = loud
        sys.argv[1:] = ["synthesize", "poses.csv"]
        main()
    """
    done = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stderr) == (0, "")
    asked = [sys.executable, "-W", "always", "-c", text]  # but who asks for them gets them
    done = subprocess.run(asked, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0
    assert "RuntimeWarning: overflow" in done.stderr
