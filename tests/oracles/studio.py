"""A studio in a process of its own, and a visitor who speaks HTTP and websockets to it."""

import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import httpx
from websockets.sync.client import connect

ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/#token=([\w-]{40,})\n")
SECONDS = 60.0  # that anything may take on a busy machine


class Visitor:
    """Who opened the address: HTTP by `http`, which has the key, and websockets by `live`.

    terminal: where Enter gets another address, if the studio hears one.
    """

    def __init__(self, process, home, terminal=None):
        self.process, self.saved = process, Path(home) / "burmester" / "studio"
        self._terminal = terminal
        line = process.stdout.readline().decode()
        found = ADDRESS.fullmatch(line)
        assert found, line
        self.port, self.token = int(found[1]), found[2]
        if terminal is not None:
            process.stdout.readline()  # how another address is had
        self.base = f"http://127.0.0.1:{self.port}"
        self.http = httpx.Client(base_url=self.base, timeout=SECONDS)
        entered = self.http.post("/session", json={"token": self.token})
        assert entered.status_code == 200, entered.text
        self.key = entered.json()["key"]
        self.http.headers["authorization"] = f"Bearer {self.key}"

    def address(self):
        """Another address, for another browser: as somebody gets it who presses Enter."""
        os.write(self._terminal, b"\n")
        line = self.process.stdout.readline().decode()
        assert ADDRESS.fullmatch(line), line
        return line.strip()

    @contextmanager
    def live(self, key=None, **headers):
        """A tab."""
        with connect(
            f"ws://127.0.0.1:{self.port}/live",
            additional_headers=headers,
            subprotocols=["burmester", key or self.key],
            max_size=None,
            open_timeout=SECONDS,
            compression=None,
        ) as tab:
            yield Tab(tab)

    def raw(self, *pieces, seconds=SECONDS):
        """The status and the whole answer to bytes that are sent as they are."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=seconds) as one:
            answer = b""
            try:
                for piece in pieces:
                    one.sendall(piece)
                while part := one.recv(65536):
                    answer += part
                    if _is_whole(answer):
                        break
            except OSError:  # cut off, or not answered
                pass
            return int(answer[9:12] or 0), answer

    def memory_mb(self):
        """What the server process itself holds in memory."""
        text = Path(f"/proc/{self.process.pid}/status").read_text(encoding="ascii")
        return int(re.search(r"VmRSS:\s+(\d+) kB", text)[1]) / 1000

    def workers(self):
        """The numbers of its worker processes."""
        return children(self.process.pid)


class Tab:
    """A websocket that takes the page's messages and gives the server's."""

    def __init__(self, socket):
        self.socket, self.n = socket, 0

    def say(self, do, **more):
        """Send a message; its number."""
        self.n += 1
        self.socket.send(json.dumps({"n": self.n, "do": do, **more}))
        return self.n

    def hear(self, seconds=SECONDS):
        """The next message: an object, or the header and the numbers of a frame."""
        message = self.socket.recv(timeout=seconds)
        return json.loads(message) if isinstance(message, str) else header_of(message)

    def until(self, *kinds, n=None):
        """The next message of one of some kinds, about the last message sent if not said else."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            heard = self.hear()
            if heard["n"] == (n or self.n) and heard["kind"] in kinds:
                return heard
        raise AssertionError(f"none of {kinds} within {SECONDS} s")

    def ask(self, do, **more):
        """The answer to a message."""
        self.say(do, **more)
        ends = ("solved", "followed", "placed", "curve", "refused", "limit", "cancelled", "ended")
        return self.until(*ends)


def header_of(frame):
    """The header of a frame, with its numbers under "numbers"."""
    (length,) = struct.unpack_from("<I", frame)
    header = json.loads(frame[4 : 4 + length])
    count = (len(frame) - 4 - length) // 4
    header["numbers"] = struct.unpack_from(f"<{count}f", frame, 4 + length)
    return header


def _is_whole(answer):
    head, found, body = answer.partition(b"\r\n\r\n")
    length = re.search(rb"(?i)content-length: (\d+)", head)
    return bool(found) and (length is None or len(body) >= int(length[1]))


# Found at once: a studio that opens on it has nothing left to do.
FIVE = "x,y,angle_deg\n0,0,0\n3,1,20\n5,4,50\n4,8,70\n1,9,95\n"


def children(parent):
    """The numbers of the processes whose parent this is."""
    out = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
        except OSError:
            continue  # it has ended
        if int(fields[1]) == parent and fields[0] != "Z":
            out.append(int(stat.parent.name))
    return out


def gone(pids):
    """Wait until processes have ended; those that have not."""
    end = time.monotonic() + SECONDS
    left = list(pids)
    while left and time.monotonic() < end:
        left = [pid for pid in left if Path(f"/proc/{pid}").exists() and not _zombie(pid)]
        time.sleep(0.02)
    return left


def _zombie(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def killed(visitor):
    """End all workers, and wait until they have."""
    workers = visitor.workers()
    for pid in workers:
        os.kill(pid, signal.SIGKILL)
    assert gone(workers) == []


def started(*arguments, home, **options):
    """The process of `burmester studio`, which opens no browser."""
    command = [sys.executable, "-m", "burmester", "studio", "--no-browser", *arguments]
    environment = {**os.environ, "XDG_STATE_HOME": str(home), "OMP_NUM_THREADS": "1"}
    return subprocess.Popen(command, stdout=subprocess.PIPE, env=environment, **options)


@contextmanager
def served(*arguments, home, **options):
    """A visitor of a studio that ends with the block, and whose terminal is the visitor's."""
    terminal, its = os.openpty()
    process = started(*arguments, home=home, stdin=its, **options)
    os.close(its)
    visitor = None
    try:
        visitor = Visitor(process, home, terminal)
        yield visitor
    finally:
        if visitor is not None:
            visitor.http.close()
        process.send_signal(signal.SIGTERM)
        process.wait(SECONDS)
        process.stdout.close()
        os.close(terminal)
