"""How the studio begins and ends: its address, what it refuses to start with, signals."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.oracles.studio import FIVE, SECONDS, Visitor, children, gone, killed, served, started

posix = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
TASK = 'angle_unit = "deg"\nposes = [[0, 0, 0], [3, 1, 20], [5, 4, 50], [4, 8, 70], [1, 9, 95]]\n'


@posix
def test_ctrl_c_ends_it_and_its_workers(tmp_path):
    """Also in the midst of a search.  The task comes from standard input."""
    pipe = subprocess.PIPE
    process = started("-", home=tmp_path, stdin=pipe, stderr=pipe)
    process.stdin.write(FIVE.encode())
    process.stdin.close()
    visitor = Visitor(process, tmp_path)
    document = visitor.http.get("/start").json()["document"]
    assert [pose["x"] for pose in document["poses"]] == [0, 3, 5, 4, 1]
    with visitor.live() as tab:
        many = [{"x": k % 997, "y": k * k % 991, "angle": k % 83} for k in range(9000)]
        tab.say("solve", document={**document, "poses": many}, options={})
        assert tab.hear()["kind"] == "solving"
        workers = visitor.workers()
        assert workers
        process.send_signal(signal.SIGINT)
        process.wait(SECONDS)
    visitor.http.close()
    with process.stdout, process.stderr:
        rest, err = process.stdout.read(), process.stderr.read()
    assert process.returncode == 0
    assert rest == err == b""  # the address was the only line
    assert gone(workers) == []


@posix
def test_no_token_is_written_down_and_no_science_is_loaded(five, tmp_path):
    """W5: the token is neither on standard error nor in a file, whatever is asked.

    And the server's own process has no NumPy when it has answered everything.
    """
    process = started(five, home=tmp_path, stderr=subprocess.PIPE)
    visitor = Visitor(process, tmp_path)
    token = visitor.token
    visitor.raw(f"GET /#token={token} HTTP/1.1\r\n\r\n".encode())
    visitor.raw(b"rubbish\r\n\r\n")
    for path in (f"/?token={token}", f"/{token}", f"/start/{token}"):
        page = visitor.http.get(path, headers={"referer": f"{visitor.base}/#token={token}"})
        assert token not in page.text
    document = visitor.http.get("/start").json()["document"]
    given = {"document": document, "options": {}, "name": "a", "format": "csv"}
    assert visitor.http.post("/export", json=given).status_code == 200
    assert visitor.http.put("/autosave", json=given).status_code == 204
    maps = Path(f"/proc/{process.pid}/maps").read_text(encoding="utf-8")
    assert "numpy" not in maps
    workers = visitor.workers()
    assert any("numpy" in Path(f"/proc/{pid}/maps").read_text() for pid in workers)
    visitor.http.close()
    process.terminate()
    _, err = process.communicate(timeout=SECONDS)
    assert (process.returncode, err) == (0, b"")
    assert gone(workers) == []
    files = [each for each in tmp_path.rglob("*") if each.is_file()]
    assert files
    assert all(token.encode() not in each.read_bytes() for each in files)


@posix
def test_workers_end_where_the_server_is_killed(five, tmp_path):
    process = started(five, home=tmp_path)
    process.stdout.readline()
    workers = children(process.pid)
    assert workers
    process.kill()
    process.wait(SECONDS)
    process.stdout.close()
    assert gone(workers) == []


@posix
def test_a_worker_that_is_killed_is_told_and_replaced(five, tmp_path):
    """At rest, and in the midst of a search."""
    with served(five, home=tmp_path) as visitor, visitor.live() as tab:
        document = visitor.http.get("/start").json()["document"]
        assert tab.ask("solve", document=document, options={})["kind"] == "solved"
        killed(visitor)
        heard = [tab.ask("follow", document=document, options={}, shown=[]) for _ in range(2)]
        many = [{"x": k % 997, "y": k * k % 991, "angle": k % 83} for k in range(9000)]
        tab.say("solve", document={**document, "poses": many}, options={})
        tab.until("solving")
        time.sleep(0.2)  # its worker has begun
        killed(visitor)
        told = [heard[0], tab.until("ended")]
        assert [each["kind"] for each in told] == ["ended", "ended"]
        assert all("signal 9" in each["messages"][0]["why"] for each in told)
        assert heard[1]["solve"] is True
        assert tab.ask("solve", document=document, options={})["kind"] == "solved"
        assert tab.ask("follow", document=document, options={}, shown=[])["kind"] == "followed"
        assert visitor.http.post("/check", json={"document": document}).status_code == 200


def test_a_task_is_read_before_anything_is_opened(tmp_path):
    (tmp_path / "poses.csv").write_text("x,y,angle\n0,0,0\n1,2,3\n")
    for file, code in (("poses.csv", "E110"), ("none.toml", "E101")):
        process = started(file, home=tmp_path, cwd=tmp_path, stderr=subprocess.PIPE)
        out, err = process.communicate(timeout=SECONDS)
        assert (process.returncode, out) == (2, b"")
        assert f"error[{code}]" in err.decode()
        assert file in err.decode()


def test_a_port_that_is_taken_is_told(visitor, tmp_path):
    process = started("--port", str(visitor.port), home=tmp_path, stderr=subprocess.PIPE)
    out, err = process.communicate(timeout=SECONDS)
    assert (process.returncode, out) == (2, b"")
    assert f"port {visitor.port}" in err.decode()
    assert "--port" in err.decode()


WITHOUT = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "starlette":
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, Missing())
sys.modules["starlette"] = None
from burmester.cli import main
main(["studio", "--no-browser"])
"""


def test_without_its_libraries_it_says_what_to_install():
    command = [sys.executable, "-c", WITHOUT]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert "error[E130]: the studio needs starlette, which is not installed" in ran.stderr
    assert 'pip install "burmester[studio]"' in ran.stderr


SERVER = """
import sys
import burmester.cli.studio, burmester.studio.serve, burmester.studio.application
import burmester.studio.access, burmester.studio.session, burmester.studio.autosave, uvicorn
print(sorted({"numpy", "shapely", "rich"} & set(sys.modules)))
"""


def test_the_server_imports_no_science():
    """Its event loop is never held up: what computes is in another process."""
    ran = subprocess.run([sys.executable, "-c", SERVER], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_who_comes_back_after_a_restart_finds_the_task(visitor, tmp_path):
    """W15: the old key and the old token open nothing, and no pose is lost."""
    (tmp_path / "lid.toml").write_text(TASK)
    kept = {"document": {"poses": [{"x": -3.5, "y": 0, "angle": 0}]}, "options": {}, "name": "lid"}
    assert visitor.http.put("/autosave", json=kept).status_code == 204
    home = visitor.saved.parent.parent
    with served("lid.toml", home=home, cwd=tmp_path) as second:
        assert second.http.post("/session", json={"token": visitor.token}).status_code == 401
        stale = second.http.get("/start", headers={"authorization": f"Bearer {visitor.key}"})
        assert stale.status_code == 401
        assert "open the address" in stale.json()["messages"][0]["help"]
        start = second.http.get("/start").json()
        assert start["saved"]["document"] == kept["document"]
        assert start["name"] == "lid"
        assert [pose["x"] for pose in start["document"]["poses"]] == [0, 3, 5, 4, 1]
