"""A studio and its page on a machine that reaches no other one: run under `unshare -rn`.

    unshare -rn python -m tests.oracles.studio_alone FOLDER

Prints what was seen, as JSON; the task that was saved and the result are in FOLDER.
"""

import errno
import fcntl
import json
import re
import socket
import struct
import sys
from pathlib import Path

from tests.oracles import browser as browsers
from tests.oracles.studio import FIVE, served
from tests.oracles.studio_page import drag, pose, solved, studio_page

SET_FLAGS, UP = 0x8914, 0x41  # ioctl of an interface; up and running


def main(folder):
    """Use the studio as a person does."""
    folder = Path(folder)
    _loopback_up()
    file = folder / "five.csv"
    file.write_text(FIVE, encoding="ascii")
    seen = {"interfaces": [name for _, name in socket.if_nameindex()]}
    with served(str(file), home=folder) as visitor:
        with visitor.live() as tab:
            start = visitor.http.get("/start").json()
            seen["kind"] = tab.ask("solve", document=start["document"], options={})["kind"]
        asked = {key: start[key] for key in ("document", "options", "name")}
        assert visitor.http.post("/export", json={**asked, "format": "svg"}).status_code == 200
        seen["by the server"] = _without_route()  # before there is a browser, which may try
        with browsers.launched() as browser, studio_page(browser, visitor) as page:
            drag(page, '.bs-origin[data-pose="4"]', 9, -6)
            solved(page)
            seen["pose"] = pose(page, 4)
            for name, act in (
                ("task.toml", lambda: page.keyboard.press("Control+s")),
                ("result.json", lambda: _export(page, "result")),
                ("linkage.svg", lambda: _export(page, "svg")),
            ):
                with page.expect_download() as download:
                    act()
                download.value.save_as(folder / name)
            seen["wrong"] = page.wrong
            seen["asked"] = sorted({re.match(r"\w+://[^:/]+", each)[0] for each in page.asked})
    before = _without_route()
    try:
        socket.create_connection(("192.0.2.1", 80), timeout=2)
    except OSError as error:
        seen["elsewhere"] = errno.errorcode[error.errno]
    seen["counted"] = _without_route() - before
    print(json.dumps(seen))


def _export(page, kind):
    page.locator("[data-menu=export] > summary").click()
    page.locator(f"[data-export={kind}]").click()


def _loopback_up():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        fcntl.ioctl(any_socket, SET_FLAGS, struct.pack("16sh14x", b"lo", UP))


def _without_route():
    """How often anybody here wanted to reach another machine."""
    names, values = re.findall(r"^Ip: (.+)$", Path("/proc/net/snmp").read_text(), re.MULTILINE)
    counts = dict(zip(names.split(), map(int, values.split()), strict=True))
    six = Path("/proc/net/snmp6")
    found = re.search(r"Ip6OutNoRoutes\s+(\d+)", six.read_text()) if six.exists() else None
    return counts["OutNoRoutes"] + (int(found[1]) if found else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
