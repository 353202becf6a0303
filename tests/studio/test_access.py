"""The door: who is not the person at this machine gets nothing (W1 to W7, W14)."""

import asyncio
import gzip
import json
import os
import re
import stat
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from urllib.request import url2pathname

import httpx
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from burmester.studio.access import Access
from tests.oracles.studio import SECONDS, served

DATA = ("/start", "/template/lid-hinge", "/live")
POSTS = (
    *("/read", "/outline", "/check", "/task", "/export", "/result", "/report", "/command"),
    *("/improve", "/session"),
)
SHELL = ("/", "/studio.mjs", "/studio.css", "/widget.css")
HEADERS = {"content-type": "application/json"}


def hosts(port):
    return [
        *("evil.com", f"evil.com:{port}", "127.0.0.1.evil.com", f"127.0.0.1.evil.com:{port}"),
        *(f"localhost.evil.com:{port}", "", f"127.0.0.1.:{port}", f"localhost.:{port}"),
        *("127.0.0.1", f"127.0.0.1:{port + 1}", f"0.0.0.0:{port}", f"[::]:{port}"),
        *(f"127.0.0.1:{port}@evil.com", f"127.0.0.1:{port} ", f"evil.com/127.0.0.1:{port}"),
    ]


def request(visitor, method, path, lines, body=b""):
    head = [f"{method} {path} HTTP/1.1", *lines, f"authorization: Bearer {visitor.key}"]
    if method != "GET":
        head += ["content-type: application/json", f"content-length: {len(body)}"]
    return visitor.raw("\r\n".join(head).encode() + b"\r\n\r\n" + body)


def test_every_route_refuses_foreign_hosts(visitor):
    """W1, key and all: it is the host that is wrong."""
    ours = [f"127.0.0.1:{visitor.port}", f"localhost:{visitor.port}", f"[::1]:{visitor.port}"]
    for host in hosts(visitor.port):
        if host.strip() in ours:
            continue  # blanks around a value are no part of it
        for path in (*SHELL, *DATA):
            status, answer = request(visitor, "GET", path, [f"host: {host}"])
            assert status in (400, 403), (host, path)
            assert b"poses" not in answer
            assert b"<main" not in answer
        for path in POSTS:
            status, _ = request(visitor, "POST", path, [f"host: {host}"], b"{}")
            assert status in (400, 403), (host, path)
    for host in ours:
        assert request(visitor, "GET", "/start", [f"host: {host}"])[0] == 200


def test_a_host_given_twice_or_not_at_all_is_refused(visitor):
    """W1."""
    ours = f"host: 127.0.0.1:{visitor.port}"
    for lines in ([ours, ours], [ours, "host: evil.com"], []):
        for path in ("/", "/start"):
            assert request(visitor, "GET", path, lines)[0] in (400, 403)


def test_a_name_that_was_bound_to_this_machine_is_refused(visitor):
    """W2: Host and Origin agree, and prove nothing."""
    evil = f"a.evil.com:{visitor.port}"
    for path in POSTS:
        lines = [f"host: {evil}", f"origin: http://{evil}"]
        assert request(visitor, "POST", path, lines, b"{}")[0] == 403


def origins(port):
    return [
        *("null", "http://evil.com", f"http://evil.com:{port}", f"http://127.0.0.1:{port + 1}"),
        *(f"https://127.0.0.1:{port}", f"http://127.0.0.1:{port}.evil.com", "", "file://"),
    ]


def test_other_sites_cannot_post(visitor):
    """W3."""
    for origin in origins(visitor.port):
        for path in POSTS:
            answer = visitor.http.post(path, json={}, headers={"origin": origin})
            assert answer.status_code == 403, (origin, path)
        kept = visitor.http.put("/autosave", json={"document": {}}, headers={"origin": origin})
        assert kept.status_code == 403
    ours = {"origin": f"http://127.0.0.1:{visitor.port}"}
    assert visitor.http.post("/command", json={"name": "a"}, headers=ours).status_code == 200


def test_other_sites_get_no_websocket(visitor):
    """W4."""
    for origin in origins(visitor.port):
        with pytest.raises(InvalidStatus) as refused, visitor.live(origin=origin):
            pass
        assert refused.value.response.status_code == 403, origin
    evil = f"a.evil.com:{visitor.port}"
    upgrade = ["connection: Upgrade", "upgrade: websocket", "sec-websocket-version: 13"]
    upgrade += ["sec-websocket-key: dGhlIHNhbXBsZSBub25jZQ==", f"host: {evil}"]
    assert request(visitor, "GET", "/live", [*upgrade, f"origin: http://{evil}"])[0] == 403


def test_another_page_of_this_machine_is_told_apart(visitor):
    """Even with the key: the browser says that the page is another one."""
    for path in DATA[:-1]:
        foreign = {"sec-fetch-site": "same-site"}
        assert visitor.http.get(path, headers=foreign).status_code == 403
        assert visitor.http.get(path, headers={"sec-fetch-site": "same-origin"}).status_code == 200
    token = {"token": visitor.address().partition("token=")[2]}
    for site, status in (("same-site", 403), ("same-origin", 200)):
        answer = httpx.post(f"{visitor.base}/session", json=token, headers={"sec-fetch-site": site})
        assert answer.status_code == status


def test_nothing_without_the_token(visitor):
    """W5."""
    with httpx.Client(base_url=visitor.base) as stranger:
        for path in SHELL:
            shell = stranger.get(path)
            assert shell.status_code == 200
            assert "set-cookie" not in shell.headers
        for given in ("", "x", "Bearer", "Bearer x", visitor.key, f"Bearer {visitor.token}"):
            stranger.headers["authorization"] = given
            for path in DATA[:-1]:
                assert stranger.get(path).status_code == 401
            for path in POSTS[:-1]:
                assert stranger.post(path, json={}).status_code == 401
            assert stranger.put("/autosave", json={"document": {}}).status_code == 401
        for token in ("", "x", visitor.token[:-1], visitor.token + "x", None, 1, [visitor.token]):
            answer = stranger.post("/session", json={"token": token})
            assert answer.status_code == 401
            assert "set-cookie" not in answer.headers
            assert visitor.token not in answer.text
    for key in ("none", visitor.token, visitor.key[:-1], f"Bearer.{visitor.key}"):
        with pytest.raises(InvalidStatus) as refused, visitor.live(key):
            pass
        assert refused.value.response.status_code == 401


def test_what_goes_to_other_servers_of_this_machine_opens_nothing(visitor):
    """A browser sends cookies to every port, and addresses may be seen: no answer sets a cookie."""
    token = visitor.address().partition("token=")[2]
    answer = httpx.post(f"{visitor.base}/session", json={"token": token})
    assert answer.json() == {"key": visitor.key}
    for path in ("/", "/start", "/nothing"):
        assert "set-cookie" not in visitor.http.get(path).headers
    assert "set-cookie" not in answer.headers
    for name in ("burmester", f"burmester-{visitor.port}", "key", "authorization"):
        for value in (visitor.key, f"Bearer {visitor.key}"):
            cookie = {"cookie": f"{name}={value}"}
            for path in DATA[:-1]:
                assert httpx.get(f"{visitor.base}{path}", headers=cookie).status_code == 401
            with pytest.raises(InvalidStatus) as refused, visitor.live("none", **cookie):
                pass
            assert refused.value.response.status_code == 401
    for path in DATA[:-1]:
        assert httpx.get(f"{visitor.base}{path}?key={visitor.key}").status_code == 401


def test_an_address_opens_once(visitor):
    token = visitor.address().partition("token=")[2]
    other = visitor.address().partition("token=")[2]
    for k in range(3):
        answer = httpx.post(f"{visitor.base}/session", json={"token": token})
        assert answer.status_code == (401 if k else 200)
    (message,) = answer.json()["messages"]
    assert "opened already" in message["message"]
    assert "press Enter in the terminal" in message["help"]
    assert httpx.post(f"{visitor.base}/session", json={"token": other}).status_code == 200


def test_an_address_opens_for_a_while_only():
    door = Access(port=8000, token_s=0.0)
    assert door.exchanged(door.token()) is None
    door = Access(port=8000)
    tokens = [door.token() for _ in range(2)]
    assert door.exchanged(tokens[1]) == door.exchanged(tokens[0]) is not None
    assert door.exchanged(tokens[0]) is None


def test_every_answer_forbids_what_a_page_does_not_need(visitor):
    for path in ("/", "/start", "/nothing", "/template/none"):
        headers = visitor.http.get(path).headers
        policy = headers["content-security-policy"].split("; ")
        assert {"default-src 'self'", "frame-ancestors 'none'"} <= set(policy)
        assert "unsafe" not in headers["content-security-policy"]
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert not any(name.startswith("access-control") for name in headers)
    refused = httpx.get(f"{visitor.base}/start").headers
    assert refused["x-content-type-options"] == "nosniff"


def test_forms_and_plain_text_are_refused(visitor):
    """W6: what a page of another site can send without being asked first."""
    for path in (*POSTS, "/autosave"):
        send = visitor.http.put if path == "/autosave" else visitor.http.post
        body = json.dumps({"token": visitor.token})
        for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""):
            answer = send(path, content=body, headers={"content-type": kind})
            assert answer.status_code in (403, 415), (path, kind)
        assert send(path, content=body).status_code in (403, 415)


LARGE = 2_000_000


def test_what_is_too_large_is_refused_at_once(visitor):
    """W7: two megabytes and a byte, without a length, packed, deep, and a frame of 100 MB."""
    before = visitor.memory_mb()
    ours = [f"host: 127.0.0.1:{visitor.port}"]

    document = b'{"name": "' + b"x" * (LARGE - 12) + b'"}'
    assert len(document) == LARGE
    assert visitor.http.post("/command", content=document, headers=HEADERS).status_code == 200
    assert (
        visitor.http.post("/command", content=document + b" ", headers=HEADERS).status_code == 413
    )

    bearer = f"authorization: Bearer {visitor.key}"
    head = "\r\n".join(["POST /command HTTP/1.1", *ours, bearer])
    chunked = f"{head}\r\ncontent-type: application/json\r\ntransfer-encoding: chunked\r\n\r\n"
    chunk = b"10000\r\n" + b"x" * 65536 + b"\r\n"
    assert visitor.raw(chunked.encode(), *[chunk] * 1600)[0] in (0, 413)
    claimed = f"{head}\r\ncontent-type: application/json\r\ncontent-length: 99999999999\r\n\r\n"
    assert visitor.raw(claimed.encode())[0] == 413

    bomb = gzip.compress(b"0" * 100_000_000, 1)
    packed = {**HEADERS, "content-encoding": "gzip"}
    assert visitor.http.post("/check", content=bomb, headers=packed).status_code == 415

    for text in ("[" * 10_000 + "]" * 10_000, '{"document":' * 10_000 + "1" + "}" * 10_000):
        answer = visitor.http.post("/check", content=text, headers=HEADERS)
        assert answer.status_code == 422

    with visitor.live() as tab:
        with suppress(ConnectionClosed):  # it may be closed before all is sent
            tab.socket.send("x" * 100_000_000)
        with pytest.raises(ConnectionClosed) as closed:
            tab.socket.recv(timeout=SECONDS)
        assert closed.value.rcvd is None or closed.value.rcvd.code == 1009
    with visitor.live() as tab:
        deep = '{"n": 1, "do": "solve", "document": ' + "[" * 10_000 + "]" * 10_000 + "}"
        tab.socket.send(deep)
        assert tab.hear()["kind"] == "refused"

    assert visitor.memory_mb() - before < 50
    assert visitor.http.get("/start").status_code == 200


def test_other_machines_are_let_in_only_on_purpose(five, tmp_path):
    """W14."""
    command = [sys.executable, "-m", "burmester", "studio", "--no-browser", "--host", "0.0.0.0"]
    refused = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert refused.returncode == 2
    assert refused.stdout == ""
    assert "other machines could connect" in refused.stderr
    assert "--i-know-that-others-can-connect" in refused.stderr
    flags = ("--host", "0.0.0.0", "--i-know-that-others-can-connect")
    with served(five, *flags, home=tmp_path) as visitor:
        assert visitor.http.get("/start").status_code == 200
        assert httpx.get(f"{visitor.base}/start").status_code == 401
        # Under an address of its own, but under no name: names can be bound to any machine.
        for host, status in ((f"10.1.2.3:{visitor.port}", 200), (f"evil.com:{visitor.port}", 403)):
            assert request(visitor, "GET", "/start", [f"host: {host}"])[0] == status


def test_two_hosts_are_refused_whatever_the_server_lets_through():
    """W1: uvicorn refuses them by itself; the door does so, too."""
    door = Access(port=8000)
    door.within(None)
    ours = (b"host", b"127.0.0.1:8000")
    heard = []

    async def send(message):
        heard.append(message)

    for headers in ([ours, ours], [ours, (b"Host", b"evil.com")], []):
        scope = {"type": "http", "method": "GET", "path": "/", "headers": headers}
        asyncio.run(door(scope, None, send))
        assert heard.pop(0)["status"] == 403
        heard.clear()


@pytest.mark.skipif(os.name != "posix", reason="modes of files as POSIX has them")
def test_a_browser_is_led_by_a_file_that_this_user_alone_can_read(five, tmp_path):
    """What a command is started with everybody sees: a token is not there."""
    seen, browser = tmp_path / "seen", tmp_path / "browser"
    browser.write_text(f'#!/bin/sh\nprintf "%s" "$*" > {seen}.part\nmv {seen}.part {seen}\n')
    browser.chmod(0o755)
    environment = {**os.environ, "BROWSER": f"{browser} %s", "XDG_STATE_HOME": str(tmp_path)}
    process = subprocess.Popen(
        [sys.executable, "-m", "burmester", "studio", five],
        stdout=subprocess.PIPE,
        env=environment,
        umask=0,
    )
    try:
        base, printed = process.stdout.readline().decode().strip().split("#token=")
        end = time.monotonic() + SECONDS
        while not seen.exists() and time.monotonic() < end:
            time.sleep(0.02)
        opened = seen.read_text()
        assert "token" not in opened
        file = Path(url2pathname(opened.removeprefix("file://")))
        assert stat.S_IMODE(file.stat().st_mode) == 0o600
        assert stat.S_IMODE(file.parent.stat().st_mode) == 0o700
        page = file.read_text(encoding="utf-8")
        token = re.search(rf"url={re.escape(base)}#token=([\w-]{{40,}})", page)[1]
        assert token != printed
        if os.geteuid() == 0:  # somebody else, by whom even an open folder is looked through
            file.parent.chmod(0o755)
            other = subprocess.run(["cat", str(file)], user=65534, capture_output=True, check=False)
            assert (other.returncode, other.stdout) == (1, b"")
        for status in (200, 401):
            answer = httpx.post(f"{base}session", json={"token": token})
            assert answer.status_code == status
        assert "start it again" in answer.json()["messages"][0]["help"]  # nobody hears Enter
    finally:
        process.terminate()
        process.wait(SECONDS)
        process.stdout.close()
    assert not file.parent.exists()
