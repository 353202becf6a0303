"""What takes long is told on a terminal, on one line that goes; nowhere else."""

import os
import re
import subprocess
import sys

import pytest

from burmester.io.reading.poses import read_task
from burmester.progress import shown, step
from burmester.synthesis.motion_generation import synthesize

pty = pytest.importorskip("pty", reason="terminals as POSIX has them")

SLOW = """
import sys, time
from burmester.cli.progress_line import working
from burmester.progress import goes_on, step

with working("reading the poses"):
    time.sleep(float(sys.argv[1]))
    step("refining 12 linkages")
    goes_on(8, 60)
    time.sleep(float(sys.argv[2]) / 2)
    step("refining 12 linkages, " + "one after the other, " * 9)
    time.sleep(float(sys.argv[2]) / 2)
print("done")
"""


def on_terminal(command, columns=60, **environment):
    """What a terminal of these columns is sent, and what is written to a pipe meanwhile."""
    reader, writer = os.pipe()
    process, terminal = pty.fork()
    if not process:
        os.dup2(writer, 1)
        os.system(f"stty cols {columns} <&2")
        os.execve(sys.executable, [sys.executable, *command], {**os.environ, **environment})
    os.close(writer)
    said = b""
    while True:
        try:
            said += os.read(terminal, 4096)
        except OSError:
            break
    with open(reader, "rb") as file:
        out = file.read()
    assert os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) in (0, 1)
    os.close(terminal)
    return said.decode(), out.decode()


def screen(said):
    """What stands on a line after all this, where a carriage return leads to its start."""
    line = []
    at = 0
    for char in said:
        if char == "\r":
            at = 0
        else:
            line[at : at + 1] = char
            at += 1
    return "".join(line).rstrip()


def test_the_line_comes_after_half_a_second_and_goes():
    said, out = on_terminal(["-c", SLOW, "1.0", "1.2"], TERM="xterm")
    assert out == "done\n"
    assert said.startswith("\rreading the poses ...\r")
    assert "refining 12 linkages, step 8 of 60 ... 1 s" in said
    assert "refining 12 linkages, one after" in said
    assert "1 s" in said
    assert screen(said) == ""
    assert not re.search(r"[^\x20-\x7e\r]", said)  # no escape codes, no second line
    assert max(map(len, said.split("\r"))) <= 59


def test_what_is_quick_is_not_told():
    assert on_terminal(["-c", SLOW, "0.1", "0.1"], TERM="xterm") == ("", "done\n")


@pytest.mark.parametrize("terminal", ["dumb", "unknown"])
def test_a_terminal_that_cannot_erase_is_told_nothing(terminal):
    assert on_terminal(["-c", SLOW, "0.6", "0.3"], TERM=terminal) == ("", "done\n")


def test_a_pipe_is_told_nothing():
    done = subprocess.run(
        [sys.executable, "-c", SLOW, "0.6", "0.3"], capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("done\n", "")


def test_a_synthesis_tells_its_steps_and_its_object_stays_clean():
    command = ["-m", "burmester", "synthesize", "case:ge2012-exact", "--json"]
    said, out = on_terminal(command, TERM="xterm", NO_COLOR="1")
    assert out.startswith('{"schema"')
    assert out.count("\n") == 1
    assert "\x1b" not in said + out
    assert screen(said) == ""


def test_the_steps_of_a_synthesis_in_plain_words():
    told = []
    with shown(told.append):
        result = synthesize(read_task("case:ge2012-exact"))
    texts = list(dict.fromkeys(each.text for each in told))
    assert texts == [
        "looking at 10 poses",
        "looking for dyads",
        "refining 10 linkages",
        "judging 10 linkages",
        "comparing each pose with the others",
    ]
    assert len(result.dyads) == 5
    step("nobody listens")
    assert told[-1].text != "nobody listens"


def test_an_error_stands_where_the_line_was():
    """The line has gone before anything else is written to the terminal."""
    text = SLOW.replace('step("refining', 'raise SystemExit("no poses")\n    step("refining')
    said, out = on_terminal(["-c", text, "0.8", "0"], TERM="xterm")
    line, _, error = said.rstrip().rpartition("\r")
    assert "reading the poses" in line
    assert screen(line + "\r") == ""
    assert error == "no poses"
    assert out == ""
