"""What is answered over HTTP: the page and its parts, and what is done with a task at rest."""

from __future__ import annotations

import asyncio
import json
import traceback
from collections.abc import Awaitable, Callable
from importlib import resources
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from burmester.errors import BurmesterError
from burmester.studio import autosave
from burmester.studio.access import TOKEN_S, Access, refusal
from burmester.studio.commands import commands
from burmester.studio.message import as_json, from_json
from burmester.studio.server_state import ServerState
from burmester.studio.session import Session
from burmester.studio.workers import Message, WorkerEndedError

OF_TASK = ("read", "outline", "drawing", "check", "task", "springs", "linkage")
OF_RESULT = ("export", "result", "report", "improve")
_STATIC = {
    "/": ("studio.html", "text/html; charset=utf-8"),
    "/studio.mjs": ("studio.mjs", "text/javascript; charset=utf-8"),
    "/tools.mjs": ("tools.mjs", "text/javascript; charset=utf-8"),
    "/studio.css": ("studio.css", "text/css; charset=utf-8"),
    "/widget.css": ("widget.css", "text/css; charset=utf-8"),
    "/studio.svg": ("studio.svg", "image/svg+xml"),
}


class _NotTakenError(Exception):
    """A request whose body is not what is asked for: a status, and why."""


def application(state: ServerState, door: Access) -> Starlette:
    """The application behind a door, which has the key for who brings a token."""

    async def session(request: Request) -> Response:
        if (key := door.exchanged((await _given(request)).get("token"))) is None:
            why = f"this address was opened already, or more than {TOKEN_S / 60:g} minutes ago"
            return _refused(401, why, door.help)
        return Response(as_json({"key": key}), media_type="application/json")

    async def start(request: Request) -> Response:
        saved = await asyncio.to_thread(autosave.last)
        told = await state.beginning()
        return Response(as_json({**told, "saved": saved}), media_type="application/json")

    async def template(request: Request) -> Response:
        body = as_json({"name": request.path_params["name"]})
        return await _answer_of_worker(state, {"do": "template"}, body)

    async def command(request: Request) -> Response:
        told = commands(await _given(request))
        return Response(as_json({"commands": told}), media_type="application/json")

    async def save(request: Request) -> Response:
        given = await _given(request)
        if not isinstance(given.get("document"), dict):
            raise _no_object()
        try:
            await asyncio.to_thread(autosave.save, given)
        except (BurmesterError, OSError, ValueError) as error:
            return _refused(422, f"the task could not be kept: {error.args[0]}")
        return Response(status_code=204)

    async def progress(request: Request) -> Response:
        text = state.progress.get(request.path_params["name"], "")
        return Response(as_json({"text": text}), media_type="application/json")

    async def live(socket: WebSocket) -> None:
        await Session(socket, state).run()

    routes = [Route(path, _static(*what)) for path, what in _STATIC.items()]
    routes += [
        Route("/session", session, methods=["POST"]),
        Route("/start", start),
        Route("/template/{name}", template),
        Route("/progress/{name}", progress),
        Route("/command", command, methods=["POST"]),
        Route("/autosave", save, methods=["PUT"]),
        *(Route(f"/{do}", _asks_worker(state, do, False), methods=["POST"]) for do in OF_TASK),
        *(Route(f"/{do}", _asks_worker(state, do, True), methods=["POST"]) for do in OF_RESULT),
    ]
    handlers: dict[Any, Any] = {404: _missing, 405: _missing, Exception: _failed}
    handlers[_NotTakenError] = _not_taken
    made = Starlette(routes=[*routes, WebSocketRoute("/live", live)], exception_handlers=handlers)
    made.router.redirect_slashes = False
    return made


def _static(name: str, kind: str) -> Callable[[Request], Awaitable[Response]]:
    async def sent(request: Request) -> Response:
        file = resources.files("burmester.web") / "assets" / name
        return Response(file.read_bytes(), headers={"content-type": kind})

    return sent


def _asks_worker(
    state: ServerState, do: str, of_result: bool
) -> Callable[[Request], Awaitable[Response]]:
    """What a worker does; of_result: whether with the answer to the task, if it is known."""

    async def done(request: Request) -> Response:
        given = await _given(request)
        key = state.key_of(given) if of_result else None
        body, name = await request.body(), given.get("progress")
        work = asyncio.ensure_future(_answer_of_worker(state, {"do": do}, body, key, name))
        gone = asyncio.ensure_future(request.receive())  # after its body only that the page left
        await asyncio.wait((work, gone), return_when=asyncio.FIRST_COMPLETED)
        gone.cancel()
        if not work.done():
            work.cancel()
            return Response(status_code=204)
        return await work

    return done


async def _answer_of_worker(
    state: ServerState,
    head: dict[str, Any],
    body: bytes,
    key: str | None = None,
    name: object = None,
) -> Response:
    """What a worker answers; name: by which the page asks for the progress meanwhile."""

    def said(message: Message) -> None:
        if isinstance(name, str) and message[0]["kind"] == "progress":
            state.progress[name] = message[1].decode()

    try:
        answer, data = await state.desk(head, body, key, said)
    except TimeoutError:
        return _refused(422, "that took too long", "try it with the command")
    except WorkerEndedError as error:
        body = as_json({"messages": [error.data]})
        return Response(body, 503, media_type="application/json")
    finally:
        state.progress.pop(str(name), None)
    if answer["kind"] == "file":  # named by us, in letters, digits and hyphens
        headers = {"content-disposition": f'attachment; filename="{answer["name"]}"'}
        return Response(data, media_type="application/octet-stream", headers=headers)
    status = 200
    if answer["kind"] == "failed":
        status = 500 if json.loads(data)["messages"][0]["code"] == "E900" else 422
    return Response(data, status, media_type="application/json")


async def _given(request: Request) -> dict[str, Any]:
    """The object in the body of a request."""
    try:
        given = from_json(await request.body())
    except ValueError:
        given = None
    except RecursionError:
        raise _NotTakenError(422, "there are too many brackets inside each other") from None
    if not isinstance(given, dict):
        raise _no_object()
    return given


def _no_object() -> _NotTakenError:
    return _NotTakenError(400, "this is no object in JSON")


async def _not_taken(request: Request, error: Exception) -> Response:
    return _refused(*error.args)


def _refused(status: int, why: str, help: str | None = None) -> Response:
    return Response(refusal(status, why, help), status, media_type="application/json")


async def _missing(request: Request, error: Any) -> Response:
    return _refused(error.status_code, "there is nothing here")


async def _failed(request: Request, error: Exception) -> Response:
    traceback.print_exception(error)
    return _refused(500, f"burmester itself failed: {type(error).__name__}", "please report this")
