"""The studio as a server: its socket, its address, and its end.

E100 a port or a host that cannot be had        E130 a library is missing
"""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import sys
import tempfile
import threading
import time
import webbrowser
from collections.abc import Callable
from contextlib import ExitStack, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from burmester import __version__
from burmester.errors import InputError
from burmester.io import templates
from burmester.studio.server_state import ServerState

# The task of a studio that is given none.  The lid hinge and the chest lid are solved equally fast;
# the hinge has eight poses, and its answers follow a hand in half the time.
TEMPLATE = "lid-hinge"
# How to get another address.
ENTER = (
    "press Enter in the terminal where burmester studio runs, and open the address that it prints"
)
AGAIN = "end burmester studio, start it again, and open the address that it prints"
LEADING = """<!doctype html>
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url={address}">
<title>burmester studio</title>
<p><a href="{address}">Open the studio</a></p>
"""


@dataclass(frozen=True)
class Opening:
    """How the studio opens.

    path: of a task file; None for a template.  data: its bytes, if it is standard input ("-").
    limit_s: seconds after which a search is stopped.  browser: whether to open one.
    page: the address of a studio that others reach; links to tasks lead there.
    """

    path: str | None = None
    data: bytes = b""
    host: str = "127.0.0.1"
    port: int = 0
    limit_s: float = 10.0
    browser: bool = True
    page: str | None = None


def serve(opening: Opening, say: Callable[[str], None] = print) -> None:
    """Serve the page until a signal comes; say: gets the address, before anything else.

    Raises InputError of the task, before anything is opened, and E100 of the socket.
    """
    with _bound(opening.host, opening.port) as bound:
        asyncio.run(_serve(opening, bound, say))


def _bound(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    bound = socket.socket(family)
    try:
        if os.name != "nt":  # where it would share the port with anybody
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind((host, port))
        bound.listen(128)  # who is quick waits, and is not turned away
    except (OSError, OverflowError) as error:
        bound.close()
        why = getattr(error, "strerror", None) or str(error)
        raise InputError(
            "E100",
            f"the studio cannot listen at {host}, port {port}",
            why=why,
            help="leave --port out, so that a free one is taken",
        ) from None
    return bound


async def _serve(opening: Opening, bound: socket.socket, say: Callable[[str], None]) -> None:
    host, limit_s = opening.host, opening.limit_s
    state = ServerState(limit_s)
    await state.begin()
    try:
        import uvicorn  # noqa: PLC0415

        from burmester.studio.access import MOST_BYTES, TOKEN_S, Access  # noqa: PLC0415
        from burmester.studio.application import application  # noqa: PLC0415

        await state.open({"path": opening.path, "template": TEMPLATE}, opening.data)
        names = templates.names()
        state.start |= {
            "version": __version__,
            "templates": [{"name": each, "summary": templates.summary(each)} for each in names],
            "limit_s": limit_s,
            "page": opening.page,
        }
        port = bound.getsockname()[1]
        is_heard = opening.path != "-" and sys.stdin is not None and sys.stdin.isatty()
        door = Access(port=port, host=host, help=ENTER if is_heard else AGAIN)
        door.within(application(state, door))
        server = uvicorn.Server(
            uvicorn.Config(
                door,
                http="h11",
                ws="websockets-sansio",
                ws_max_size=MOST_BYTES,
                ws_per_message_deflate=False,
                lifespan="off",
                log_config=None,
                log_level="critical",  # no request is written down
                access_log=False,
                server_header=False,
                timeout_graceful_shutdown=1,
            )
        )
        shown = f"[{host}]" if ":" in host else host
        shown = {"0.0.0.0": "127.0.0.1", "[::]": "[::1]"}.get(shown, shown)

        def address() -> str:
            return f"http://{shown}:{port}/#token={door.token()}"

        say(address())
        if is_heard:
            say(f"It opens once, within {TOKEN_S / 60:g} minutes.  Enter prints another address.")
            if hasattr(signal, "SIGTTIN"):  # in the background it goes on, and hears no Enter
                signal.signal(signal.SIGTTIN, signal.SIG_IGN)
            heard = asyncio.get_running_loop(), lambda: say(address())
            threading.Thread(target=_hear_enter, args=heard, daemon=True).start()
        with ExitStack() as ending:
            if opening.browser:
                with suppress(OSError):  # where nothing can be written, the address is to be read
                    file = _leading_to(address(), ending)
                    state.later(asyncio.to_thread(webbrowser.open, file.as_uri()))
            await _until_stopped(server, bound)
    finally:
        await state.workers.close()


def _leading_to(address: str, ending: ExitStack) -> Path:
    """A file that leads a browser to an address; it is there until `ending` closes.

    Whoever is at work on this machine sees what a browser is told to open.  Only this user can read
    the file.
    """
    folder = tempfile.TemporaryDirectory(prefix="burmester-", ignore_cleanup_errors=True)
    file = Path(ending.enter_context(folder)) / "studio.html"
    with open(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as page:
        page.write(LEADING.format(address=address))
    return file


def _hear_enter(loop: asyncio.AbstractEventLoop, do: Callable[[], None]) -> None:
    """Do something in the loop whenever somebody presses Enter in the terminal."""
    with suppress(RuntimeError):  # the loop has ended
        while True:
            try:
                # Not by sys.stdin, whose lock the end of Python would wait for.
                if not os.read(0, 4096):
                    return
            except OSError:  # a program in the background hears nothing
                time.sleep(1)
            else:
                loop.call_soon_threadsafe(do)


async def _until_stopped(server: Any, bound: socket.socket) -> None:
    """Serve until SIGINT or SIGTERM: a second one does not wait for what is under way."""

    def stop(number: int, frame: object) -> None:
        server.force_exit = server.should_exit
        server.should_exit = True

    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
               if hasattr(signal, name)]  # fmt: skip
    before = {number: signal.signal(number, stop) for number in numbers}
    try:
        server.capture_signals = nullcontext  # ours are above
        await server.serve([bound])
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
