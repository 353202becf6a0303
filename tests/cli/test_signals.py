"""Commands that are stopped: their exit code says by what, and nothing of them is left."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from benchmarks.stopped import CODES, INTERNAL, campaign, commands, run

from burmester import signals
from burmester.export import FORMATS
from tests.oracles.ten_poses import TEN
from tests.samples import some_of

pty = pytest.importorskip("pty", reason="terminals as POSIX has them")
pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("poses.csv").write_text(TEN)
    return tmp_path


# Writes, says so, and waits for the signal: the moment is not left to chance.
WAITING = """
import os, sys, time
from burmester.__main__ import main
from burmester.cli import burmester
from burmester.io.files import atomic_file

@burmester.command("wait")
def wait():
    with atomic_file("a.json") as temporary:
        temporary.write_bytes(b"half")
        try:
            os.write(1, b"ready")
            time.sleep(SECONDS)
        finally:
            os.write(1, b"again")
            time.sleep(AGAIN)

sys.argv[1:] = ["wait"]
main()
"""


def waiting(seconds=60, again=0, first=""):
    """A process that writes."""
    text = first + WAITING.replace("SECONDS", str(seconds)).replace("AGAIN", str(again))
    process = subprocess.Popen(
        [sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout.read(5) == b"ready"
    assert len(list(Path().glob(".burmester-*"))) == 1
    return process


@pytest.mark.parametrize("number", CODES)
def test_a_signal_takes_the_unfinished_file_away(folder, number):
    process = waiting()
    process.send_signal(number)
    out, err = process.communicate(timeout=120)
    assert process.returncode == CODES[number]
    assert out == b"again"
    told = "interrupted; no unfinished file is left" if number == signal.SIGINT else ""
    assert err.decode().strip() == told
    assert os.listdir() == ["poses.csv"]


@pytest.mark.parametrize("number", CODES)
def test_a_second_signal_ends_it_at_once(folder, number):
    process = waiting(again=60)
    process.send_signal(number)
    assert process.stdout.read(5) == b"again"
    begun = time.monotonic()
    process.send_signal(number)
    _, err = process.communicate(timeout=120)
    assert time.monotonic() - begun < 20  # not the minute that it would sleep
    assert process.returncode == CODES[number]
    assert err == b""
    assert os.listdir() == ["poses.csv"]


def test_a_signal_that_is_ignored_stays_ignored(folder):
    """`nohup` has it so, and what it started must not end with its terminal."""
    process = waiting(
        seconds=1, first="import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN)\n"
    )
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=120)
    assert process.returncode == 0
    assert Path("a.json").read_bytes() == b"half"


def test_who_imports_burmester_keeps_the_handlers():
    text = """if True:
        import signal
        before = [signal.getsignal(number) for number in (2, 15, 1)]
        import burmester.__main__, burmester.cli, burmester.export, burmester.io.files
        try:
            burmester.cli.main(["cases"])
        except SystemExit:
            pass
        assert [signal.getsignal(number) for number in (2, 15, 1)] == before
    """
    subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, timeout=60)


# A signal while this module is imported, as by a hand that is quicker than the import.
DURING = """
import os, signal, sys

module, number, way = sys.argv[1], int(sys.argv[2]), sys.argv[3]

def come():
    os.kill(os.getpid(), number)

class Lost:
    def __del__(self):
        come()

class Quick:
    def find_spec(self, name, path=None, target=None):
        if name == module and way == "dropped":
            Lost()
        elif name == module:
            try:
                come()
            except BaseException:
                if way == "raised":
                    raise
                raise ImportError("broken by the signal") from None

sys.meta_path.insert(0, Quick())
from burmester.__main__ import main
sys.argv[1:] = ["synthesize", "case:ge2012-exact"]
main()
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("way", ["raised", "hidden", "dropped"])
@pytest.mark.parametrize("module", ["click.core", "numpy.linalg"])
def test_a_signal_during_an_import_is_told_by_the_exit_code(module, way, number):
    """hidden: an import that fails in another way then; dropped: raised where Python drops it."""
    done = subprocess.run(
        [sys.executable, "-c", DURING, module, str(int(number)), way],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == CODES[number]
    assert not INTERNAL.search(done.stderr), done.stderr
    assert done.stdout == ""


def test_ctrl_c_on_a_terminal():
    """The terminal sends it to the whole group, and the line that tells the work goes."""
    process, terminal = pty.fork()
    if not process:
        os.environ["TERM"] = "xterm"
        os.execv(sys.executable, [sys.executable, "-m", "burmester", "synthesize", "-"])
    time.sleep(2.0)
    os.write(terminal, b"\x03")
    said = b""
    while True:
        try:
            said += os.read(terminal, 4096)
        except OSError:
            break
    _, status = os.waitpid(process, 0)
    assert os.waitstatus_to_exitcode(status) == 130
    assert b"reading the poses" in said
    assert said.rstrip().endswith(b"interrupted; no unfinished file is left")
    assert b"Traceback" not in said


def test_exports_that_are_stopped_leave_nothing():
    """A sample of `benchmarks/stopped.py`; the slow formats are in the campaign."""
    names = some_of(["svg", "csv", "mjcf", "dxf", "synthesize"], 2)
    done = list(campaign(len(names), 20261122, names))
    assert [each.faults for each in done] == [()] * len(done)
    assert sum(each.in_time for each in done) >= len(done) // 2


def test_the_campaign_knows_every_format_and_a_leftover(folder):
    more = {"synthesize", "report", "limits", "family", "surroundings", "tolerance"}
    assert commands("result.json").keys() == {*FORMATS, *more}
    process = run(["--version"], stdout=subprocess.DEVNULL)
    assert process.wait() == 0
    assert INTERNAL.search("No such file: .burmester-0123-x.svg")


def stop():
    with signals.handled():
        os.kill(os.getpid(), signal.SIGTERM)
    raise AssertionError


def test_a_signal_is_forgotten_by_the_next_command():
    """In one process, as tests and notebooks call it."""
    with pytest.raises(SystemExit) as caught:
        stop()
    assert caught.value.code == signals.exit_code() == 143
    with signals.handled():
        assert signals.exit_code() is None
