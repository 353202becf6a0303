"""Requests and messages as no page sends them, and what a studio may answer.

Whatever comes: no fault of the server (500), no answer without the key or from another site, and
no task taken whose poses are not numbers.
"""

import copy
import json
import math
from http.client import HTTPConnection
from urllib.parse import quote

from hypothesis import strategies as st

ROUTES = {
    **dict.fromkeys(("/", "/studio.mjs", "/studio.css", "/widget.css", "/start"), "GET"),
    **dict.fromkeys(("/template/gripper", "/template/none"), "GET"),
    **dict.fromkeys(("/session", "/read", "/outline", "/check", "/task", "/command"), "POST"),
    **dict.fromkeys(("/export", "/result", "/report", "/improve"), "POST"),
    "/autosave": "PUT",
}
SHELL = ("/", "/studio.mjs", "/studio.css", "/widget.css")
# Its linkages are found at once, so that a thousand requests for results take no hour.
SMALL = {
    "length_unit": "mm",
    "angle_unit": "deg",
    "poses": [
        {"x": 0, "y": 0, "angle": 0, "name": "closed", "exact": True},
        {"x": 4.5, "y": 1, "angle": 20, "weight": 2},
        {"x": 8, "y": 4, "angle": 45},
        {"x": 9, "y": 9, "angle": 80, "tolerance": {"x": 0.1, "y": 0.1, "angle_deg": 1}},
    ],
    "limits": [{"fixed_pivot": {"box": [[-50, -50], [50, 50]]}}],
    "keep_out": [{"name": "wall", "box": [[90, 90], [95, 99]]}],
    "body": [[0, 0], [5, 0], [5, 2]],
    "requirements": {"transmission_deg": 20},
}
TEXTS = st.text(max_size=20) | st.sampled_from(
    ["../../etc/passwd", "a\0b", "\ud800", "<b>", "=1+1", "x" * 5000, "line@1,2:3", "__proto__"]
)
NUMBERS = (
    st.integers(-(10**20), 10**20)
    | st.floats()
    | st.sampled_from([0, -0.0, 1e308, -1e308, 5e-324, math.inf, -math.inf, math.nan])
)
SCALARS = st.none() | st.booleans() | NUMBERS | TEXTS
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=4),
    max_leaves=8,
)
KEYS = ("poses", "x", "body", "limits", "box", "method", "name", "free", "file", "document")


@st.composite
def documents(draw):
    """The small task with up to three things in it exchanged, taken away or put in."""
    whole = copy.deepcopy(SMALL)
    for _ in range(draw(st.integers(0, 3))):
        place, here = whole, whole
        while isinstance(here, dict | list) and here and draw(st.integers(0, 3)):
            place = here
            keys = sorted(here) if isinstance(here, dict) else range(len(here))
            key = draw(st.sampled_from(list(keys)))
            here = here[key]
        if place is here or draw(st.integers(0, 5)) == 0:
            if isinstance(place, dict):
                place[draw(st.sampled_from(KEYS) | TEXTS)] = draw(VALUES)
        elif draw(st.booleans()):
            place[key] = draw(VALUES)
        else:
            del place[key]
    return whole


def bodies():
    """What is sent: objects with a document, other values, and bytes of any kind."""
    options = st.just({}) | st.dictionaries(st.sampled_from(["method", "norm"]) | TEXTS, VALUES)
    given = st.fixed_dictionaries(
        {"document": documents() | VALUES, "options": options},
        optional={
            "name": TEXTS | VALUES,
            "linkage": st.sampled_from(["L1", "L9"]) | VALUES,
            "format": st.sampled_from(["csv", "svg", "json", "none"]) | VALUES,
            "settings": st.dictionaries(st.sampled_from(["hole", "pose", "up"]) | TEXTS, VALUES),
            "base64": TEXTS | st.binary(max_size=30),
            "text": TEXTS,
            "token": TEXTS,
        },
    )
    as_json = (given | VALUES).map(lambda value: json.dumps(value, default=repr).encode())
    return as_json | st.binary(max_size=60)


@st.composite
def requests(draw):
    """(method, path, headers, body), six in ten as the page would send them but for the body."""
    path = draw(st.sampled_from(sorted(ROUTES)))
    method, kind, host, origin, key = ROUTES[path], "application/json", None, None, True
    if draw(st.integers(0, 9)) >= 6:
        method = draw(st.sampled_from(["GET", "POST", "PUT", "DELETE", "HEAD", "OPTIONS", "PATCH"]))
        path = draw(st.sampled_from([path, path + "/", "/" + quote(draw(TEXTS), errors="replace")]))
        kind = draw(st.sampled_from(["application/json", "text/plain", "", "application/jsonx"]))
        host = draw(st.sampled_from([None, None, "evil.com", "127.0.0.1", ""]))
        origin = draw(st.sampled_from([None, None, "null", "http://evil.com"]))
        key = draw(st.booleans())
    body = b"" if method in ("GET", "HEAD") else draw(bodies())
    return method, path, kind, host, origin, key, body


def sent(visitor, request):
    """The status and the body of the answer."""
    method, path, kind, host, origin, key, body = request
    connection = HTTPConnection("127.0.0.1", visitor.port, timeout=60)
    try:
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        connection.putheader("host", f"127.0.0.1:{visitor.port}" if host is None else host)
        if origin is not None:
            connection.putheader("origin", origin)
        if key:
            connection.putheader("authorization", f"Bearer {visitor.key}")
        if kind:
            connection.putheader("content-type", kind)
        connection.putheader("content-length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def fault(request, status, answer):
    """What is wrong with an answer; None if nothing is."""
    method, path, kind, host, origin, key, body = request
    if status >= 500:
        return f"status {status}: {answer[:300]!r}"
    stranger = host is not None or origin is not None
    if stranger and status not in (400, 403):
        return f"status {status} for another site"
    if not stranger and not key and path not in (*SHELL, "/session") and status != 401:
        return f"status {status} without the key"
    if status >= 400:
        told = stranger or method == "HEAD" or json.loads(answer)["messages"][0]["message"]
        return None if told else "refused without a reason"
    return _fault_of_taken(method, path, kind, body, status)


def _fault_of_taken(method, path, kind, body, status):
    """What is wrong with taking a request; None if nothing is."""
    if method not in ("GET", "HEAD") and kind != "application/json":
        return f"status {status} for {kind!r}"
    if path in ("/check", "/task", "/result", "/report", "/export", "/improve"):
        document = json.loads(body)["document"]
        return None if has_poses(document) else f"taken: {document!r}"
    return None


def has_poses(document):
    """Whether a document has two poses or more, all numbers, but for what is free."""
    if "poses" not in document and isinstance(document.get("task"), dict):
        document = document["task"]
    poses = document["poses"]
    return len(poses) > 1 and all(map(is_pose, poses))


def is_pose(pose):
    """Whether a pose has its numbers: a list of three, or those of x, y and angle not free."""
    if isinstance(pose, list):
        return len(pose) == 3 and all(map(is_number, pose))
    numbers = [value for key, value in pose.items() if key in ("x", "y", "angle", "weight")]
    return all(is_number(value) or value is None for value in numbers)


def is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def messages():
    """What a tab sends: objects with a number, other values, and bytes of any kind."""
    given = st.fixed_dictionaries(
        {
            "n": st.integers(1, 2**53 - 1) | NUMBERS,
            "do": st.sampled_from(["follow", "place", "curve", "cancel", "solve"]) | TEXTS,
            "document": documents() | VALUES,
        },
        optional={
            "options": VALUES,
            "shown": VALUES,
            "frames": VALUES,
            "judged": VALUES,
            "pivots": st.lists(
                st.fixed_dictionaries({"plane": st.sampled_from("FM") | TEXTS, "at": VALUES}),
                max_size=3,
            )
            | VALUES,
        },
    )
    return (given | VALUES).map(json.dumps) | st.binary(max_size=40) | TEXTS.filter(_is_text)


def _is_text(text):
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def fault_of_messages(visitor, said):
    """What is wrong with the answers of a tab to messages; None if nothing is.

    After them all a sound one is answered, and no answer told of a fault of burmester.
    """
    with visitor.live() as tab:
        for message in said:
            tab.socket.send(message)
        last = tab.n = 2**53 - 1
        tab.socket.send(json.dumps({"n": last, "do": "nothing"}))
        while True:
            heard = tab.hear()
            codes = [each["code"] for each in heard.get("messages", ())]
            if "E900" in codes:
                return str(heard["messages"])
            if heard["n"] == last and heard["kind"] == "refused":
                break
        if any("curve" in str(each) or "place" in str(each) for each in said):
            tab.n = last
            tab.socket.send(json.dumps({"n": last, "do": "place", "document": SMALL, "pivots": []}))
            while (heard := tab.hear())["n"] != last:
                if any(each["code"] == "E900" for each in heard.get("messages", ())):
                    return str(heard["messages"])
    return None
