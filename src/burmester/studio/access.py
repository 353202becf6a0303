"""Who may ask, and what: the studio answers the person at this machine and nobody else.

A page of another site that this person visits can make the browser ask any address: so every
request has to name a host that is ours, an origin that is ours where it names one, and to bring a
key in its head.  The page gets it for the token of the opened address, which opens once and not for
long, and keeps it where a browser tells ports apart: a cookie would go to every server here.
"""

from __future__ import annotations

import ipaddress
import secrets
import time
from collections.abc import Iterable
from contextlib import suppress
from typing import Any, Final, TypeAlias

from burmester.errors import BurmesterError
from burmester.studio.message import as_json

Headers: TypeAlias = list[tuple[bytes, bytes]]

TOKEN_S: Final = 300.0  # that an address opens the page
PROTOCOL: Final = "burmester"  # of the websocket; a browser sends a key only as another of these
MOST_BYTES: Final = 2_000_000  # of what the page sends at once
PASSED_OVER: Final = 16_000_000  # bytes that are heard before they are refused
SHELL: Final = ("/", "/studio.mjs", "/tools.mjs", "/studio.css", "/widget.css", "/studio.svg")
OPEN: Final = (*SHELL, "/session")  # without the key

_HEADERS: Final = (
    (b"content-security-policy", b"default-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
     b"form-action 'none'; object-src 'none'; "
     b"img-src 'self' blob:; media-src blob:"),  # pictures and films that the page itself opened
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
)  # fmt: skip


class _RefusedError(Exception):
    """A request that is not let in: status, why, and what to do."""

    def __init__(self, status: int, why: str, help: str | None = None) -> None:
        super().__init__(why)
        self.status, self.why, self.help = status, why, help


class Access:
    """The application behind its door.

    token_s: seconds that a token opens.  help: how somebody who is not let in gets a token.
    """

    def __init__(
        self,
        *,
        port: int,
        host: str = "127.0.0.1",
        token_s: float = TOKEN_S,
        help: str | None = None,
    ) -> None:
        self._application: Any = None
        self._port, self._host = port, host.lower()
        self._everywhere = not is_loopback(host)
        self._token_s, self.help = token_s, help
        self._tokens: dict[str, float] = {}  # that were not used, and when each ends
        self._key = secrets.token_urlsafe(32)

    def within(self, application: Any) -> None:
        """Put the application behind the door."""
        self._application = application

    def token(self) -> str:
        """A token for one address: it opens once, and not for long."""
        token, now = secrets.token_urlsafe(32), time.monotonic()
        self._tokens = {each: end for each, end in self._tokens.items() if end > now}
        self._tokens[token] = now + self._token_s
        return token

    def exchanged(self, token: object) -> str | None:
        """The key for a token, which opens nothing any more; None where there is no such token."""
        for each in self._tokens:
            if isinstance(token, str) and _same(token, each):
                return self._key if self._tokens.pop(each) > time.monotonic() else None
        return None

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        """Let a request in, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            return

        async def sent(message: Any) -> None:
            if message["type"].endswith("response.start"):
                message = {**message, "headers": [*message["headers"], *_HEADERS]}
            await send(message)

        try:
            self._require_allowed(scope)
            whole = receive if scope["type"] == "websocket" else await _whole(receive)
        except _RefusedError as error:
            await _refuse(scope, sent, error)
            return
        await self._application(scope, whole, sent)

    def _require_allowed(self, scope: Any) -> None:
        headers: Headers = scope["headers"]
        hosts = _values(headers, b"host")
        if len(hosts) != 1 or not self._is_ours(hosts[0]):
            raise _RefusedError(403, "this host is not served here")
        for origin in _values(headers, b"origin"):
            if origin.lower() != f"http://{hosts[0].lower()}":
                raise _RefusedError(403, "another site may not ask here")
        path = scope["path"] if scope["type"] == "http" else None
        sites = _values(headers, b"sec-fetch-site")
        if path not in SHELL and any(each not in ("same-origin", "none") for each in sites):
            raise _RefusedError(403, "another site may not ask here")
        if path not in OPEN and not self._is_known(scope):
            raise _RefusedError(401, "this page has no key to this studio", self.help)
        if scope["type"] == "http" and scope["method"] not in ("GET", "HEAD"):
            _require_json(headers)

    def _is_ours(self, host: str) -> bool:
        name, _, port = host.lower().rpartition(":")
        if port != str(self._port):
            return False
        if name in ("127.0.0.1", "localhost", "[::1]"):
            return True
        if not self._everywhere:
            return False
        # Under a name of its own anybody could lead here (DNS rebinding); not so under an address.
        return name == self._host or _address(name) is not None

    def _is_known(self, scope: Any) -> bool:
        if scope["type"] == "websocket":
            return any(_same(each, self._key) for each in scope["subprotocols"])
        given = _values(scope["headers"], b"authorization")
        return any(_same(each, f"Bearer {self._key}") for each in given)


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach a host."""
    address = _address(host)
    return host.lower() == "localhost" if address is None else address.is_loopback


def refusal(status: int, why: str, help: str | None = None) -> bytes:
    """Why something is refused, as messages are told."""
    return as_json({"messages": [BurmesterError(str(status), why, help=help).to_dict()]})


def _require_json(headers: Headers) -> None:
    if _values(headers, b"content-encoding"):
        raise _RefusedError(415, "what is packed is not read")
    kinds = _values(headers, b"content-type")
    if len(kinds) != 1 or kinds[0].partition(";")[0].strip().lower() != "application/json":
        raise _RefusedError(415, "only JSON is read")
    for length in _values(headers, b"content-length"):
        if not length.isdecimal() or int(length) > PASSED_OVER:
            raise _too_large()


async def _whole(receive: Any) -> Any:
    """The body of a request in one piece, if it is not too large."""
    parts: list[bytes] = []
    size, more = 0, True
    while more:
        message = await receive()
        more = message.get("more_body", False)
        size += len(message.get("body", b""))
        if size > PASSED_OVER:
            raise _too_large()
        # A little too much is heard to its end, and dropped: who is cut off hears no reason.
        parts.append(message.get("body", b""))
        if size > MOST_BYTES:
            parts.clear()
    if size > MOST_BYTES:
        raise _too_large()
    left = [{"type": "http.request", "body": b"".join(parts)}]

    async def received() -> Any:
        return left.pop() if left else await receive()

    return received


def _too_large() -> _RefusedError:
    return _RefusedError(413, f"more than {MOST_BYTES / 1e6:.0f} MB at once")


async def _refuse(scope: Any, send: Any, error: _RefusedError) -> None:
    kind = "http.response"
    if scope["type"] == "websocket":
        if "websocket.http.response" not in scope.get("extensions", {}):
            await send({"type": "websocket.close", "code": 1008})
            return
        kind = "websocket.http.response"
    body = refusal(error.status, error.why, error.help)
    headers = [
        (b"content-type", b"application/json"),
        (b"content-length", str(len(body)).encode()),
        (b"connection", b"close"),  # what may still come is not waited for
    ]
    await send({"type": f"{kind}.start", "status": error.status, "headers": headers})
    await send({"type": f"{kind}.body", "body": body})


def _values(headers: Iterable[tuple[bytes, bytes]], name: bytes) -> list[str]:
    return [value.decode("latin-1") for key, value in headers if key.lower() == name]


def _same(one: str, other: str) -> bool:
    return secrets.compare_digest(one.encode(errors="replace"), other.encode())


def _address(name: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    with suppress(ValueError):
        return ipaddress.ip_address(name.removeprefix("[").removesuffix("]"))
    return None
