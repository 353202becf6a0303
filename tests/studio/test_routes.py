"""What the page asks over HTTP: files in, files out, and what is wrong in words (W8 to W10)."""

import base64
import json
import os
import time
from contextlib import chdir
from importlib.util import find_spec

import pytest

from burmester import cli
from burmester.export import FORMATS
from burmester.io import templates
from tests.oracles.hostile_texts import PAYLOADS

SQUARE = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h40v20h-40z"/></svg>'


def coded(text):
    return base64.b64encode(text if isinstance(text, bytes) else text.encode()).decode()


def burmester(*arguments, folder):
    """Run the command, in this process: it is started a dozen times."""
    with chdir(folder):
        assert cli.burmester.main(list(arguments), standalone_mode=False) in (0, 1)


@pytest.fixture(scope="module")
def gripper(visitor):
    given = visitor.http.get("/template/gripper").json()
    assert given["name"] == "gripper"
    return given


@pytest.fixture(scope="module")
def commanded(visitor, gripper, tmp_path_factory):
    """What the command makes of the file that the page saves."""
    folder = tmp_path_factory.mktemp("commanded")
    saved = visitor.http.post("/task", json=gripper)
    assert 'filename="gripper.toml"' in saved.headers["content-disposition"]
    (folder / "gripper.toml").write_bytes(saved.content)
    burmester("synthesize", "gripper.toml", "-o", "gripper.json", folder=folder)
    burmester("report", "gripper.toml", folder=folder)
    return folder


def test_the_page_starts_with_a_task_that_moves(visitor, start):
    assert start["name"] == "lid-hinge"
    assert len(start["document"]["poses"]) == 8
    assert [each["name"] for each in start["templates"]] == list(templates.names())
    assert start["templates"][0]["summary"] == templates.summary(templates.names()[0])
    assert start["limit_s"] == 10
    known = {each["format"]: each["suffix"] for each in start["exports"]}
    assert known["svg"] == ".svg"
    assert ("step" in known) == (find_spec("build123d") is not None)
    assert "flat" not in known  # another name of stl


def test_the_result_is_that_of_the_command(visitor, gripper, commanded):
    answer = visitor.http.post("/result", json=gripper)
    assert answer.content == (commanded / "gripper.json").read_bytes()
    assert 'filename="gripper.json"' in answer.headers["content-disposition"]


def test_the_report_is_that_of_the_command(visitor, gripper, commanded):
    answer = visitor.http.post("/report", json=gripper)
    assert answer.content == (commanded / "gripper.html").read_bytes()


# One format of each module that needs a while: stl is written as step is, mp4 as gif.
TRIED = [each for each in FORMATS if each not in ("flat", "stl", "mp4")]


@pytest.mark.parametrize("to", TRIED)
def test_an_export_is_that_of_the_command(visitor, gripper, commanded, to):
    if any(find_spec(library) is None for library in FORMATS[to].libraries):
        pytest.skip(f"no library for {to}")
    settings = {"width": 8.5, "seconds": 0.4, "frames_per_second": 10, "width_px": 200}
    asked = {**gripper, "format": to, "linkage": "L2", "settings": settings}
    answer = visitor.http.post("/export", json=asked)
    assert answer.status_code == 200, answer.text
    name = f"gripper-L2{FORMATS[to].suffix}"
    assert f'filename="{name}"' in answer.headers["content-disposition"]
    more = ["--width", "8.5", "--seconds", "0.4", "--fps", "10", "--pixels", "200"]
    more += ["--linkage", "L2", "--to", to]
    burmester("export", "gripper.json", *more, "-o", name, folder=commanded)
    assert answer.content == (commanded / name).read_bytes()


def test_commands_do_what_they_say(visitor, gripper, commanded):
    """Those that are shown are run, in the folder of the task, and do not ask back."""
    asked = {**gripper, "linkage": "L2"}
    asked["options"] = {"method": "complete", "raw": False, "round": 0.001, "stock": "a b"}
    told = visitor.http.post("/command", json=asked).json()["commands"]
    commands = [each["command"] for each in told]
    how = "--method complete --round 0.001"
    assert f"burmester synthesize gripper.toml {how} -o gripper.json" in commands
    for command in commands:
        words = command.split()
        if words[1] in ("report", "studio"):
            continue
        more = ["--force"] if words[1] in ("synthesize", "export") else []
        burmester(*words[1:], *more, folder=commanded)


def test_a_file_is_read_by_the_readers(visitor):
    rows = "x,y,angle_deg,name\n0,0,0,closed\n5.5,1,20,\n9,4,45,open\n"
    read = visitor.http.post("/read", json={"name": "poses.csv", "base64": coded(rows)}).json()
    poses = read["document"]["poses"]
    assert poses[0] == {"x": 0, "y": 0, "angle": 0, "name": "closed"}
    assert poses[1] == {"x": 5.5, "y": 1, "angle": 20}
    pasted = visitor.http.post(
        "/read", json={"name": "pasted", "text": "x\ty\tangle_rad\n0\t0\t0\n1\t2\t0.5\n"}
    )
    assert pasted.json()["document"]["poses"][1]["angle"] == pytest.approx(28.64788975654116)
    text = {"name": "pasted", "text": "x,y,angle\n0,0,0\n1,2,3\n"}
    wrong = visitor.http.post("/read", json=text)
    assert wrong.status_code == 422
    (message,) = wrong.json()["messages"]
    assert message["code"] == "E110"
    assert message["where"].startswith("pasted:1:5")
    assert visitor.http.post("/read", json={**text, "angle_unit": "rad"}).status_code == 200


def test_an_outline_is_read_from_a_drawing(visitor):
    asked = {"name": "lid.svg", "base64": coded(SQUARE), "length_unit": "mm"}
    read = visitor.http.post("/outline", json=asked).json()
    width = 40 * 25.4 / 96
    xs = [x for x, _ in read["outline"]]
    assert max(xs) - min(xs) == pytest.approx(width)
    wrong = visitor.http.post("/outline", json={"name": "lid.svg", "base64": coded("<svg/>")})
    assert wrong.status_code == 422
    assert wrong.json()["messages"][0]["code"] in ("E170", "E171")


def test_a_better_linkage_is_looked_for_near_one_that_fails(visitor, gripper):
    result = visitor.http.post("/result", json=gripper).json()
    failing = next(each["id"] for each in result["linkages"] if not each["usable"])
    told = visitor.http.post("/improve", json={**gripper, "linkage": failing}).json()
    assert told["outcome"]["code"] == "R331"
    assert not told["linkages"][0]["usable"]
    assert [each["usable"] for each in told["linkages"][1:]]
    assert all(each["usable"] for each in told["linkages"][1:])


NAMES = ["../../etc/passwd", "%2e%2e/%2e%2e/secret", "a\0b", "x" * 5000, "..", ".", "con", "a/b\\c"]


def test_names_lead_nowhere(visitor, gripper, tmp_path_factory):
    """W8: a canary is neither read nor written."""
    canary = tmp_path_factory.mktemp("canary") / "lid.svg"
    canary.write_text(SQUARE, encoding="utf-8")
    before = canary.stat().st_mtime_ns
    ways = [*NAMES, str(canary), os.path.relpath(canary), f"../{canary.name}"]
    for name in ways:
        asked = [("/task", {}), ("/result", {}), ("/export", {"format": "csv"})]
        for path, more in asked if name in NAMES[:2] else asked[:2]:
            answer = visitor.http.post(path, json={**gripper, **more, "name": name})
            said = answer.headers["content-disposition"]
            file = said.removeprefix('attachment; filename="').removesuffix('"')
            stem = file.rpartition(".")[0]
            assert stem.replace("-", "").replace("_", "").isalnum(), said
            assert stem.isascii()
            assert len(stem) < 80
        assert visitor.http.put("/autosave", json={**gripper, "name": name}).status_code == 204
        body = {**gripper["document"], "body": name}
        assert visitor.http.post("/check", json={"document": body}).status_code == 422
        toml = f'angle_unit = "deg"\nposes = [[0,0,0],[1,2,3]]\nbody = {json.dumps(name)}\n'
        file = "../task.toml" if name in NAMES else f"{name}.toml"
        read = visitor.http.post("/read", json={"name": file, "base64": coded(toml)})
        assert read.status_code == 422, (file, read.text)
        for path in ("/template/", "/"):
            answer = visitor.http.get(f"{path}{name}" if "\0" not in name else f"{path}a%00b")
            assert answer.status_code in (200, 404, 422)
            assert SQUARE not in answer.text
        outline = visitor.http.post("/outline", json={"name": name, "base64": coded("none")})
        assert outline.status_code == 422
    assert canary.read_text(encoding="utf-8") == SQUARE
    assert canary.stat().st_mtime_ns == before


def test_files_of_this_machine_are_not_served(visitor):
    """W8: ways out of the folder, as they are and coded."""
    for path in (
        "/../pyproject.toml",
        "/%2e%2e/pyproject.toml",
        "/..%2f..%2fetc/passwd",
        "//etc/passwd",
    ):
        lines = f"GET {path} HTTP/1.1\r\nhost: 127.0.0.1:{visitor.port}\r\n"
        status, answer = visitor.raw(f"{lines}authorization: Bearer {visitor.key}\r\n\r\n".encode())
        assert status in (404, 401)
        assert b"root:" not in answer
        assert b"[project]" not in answer


def test_texts_of_others_are_data(visitor, gripper):
    """W9: markup, formulas, line ends and marks that turn the writing round come back as text."""
    texts = [
        *PAYLOADS.values(),
        "<script>alert(1)</script>",
        "=1+1",
        "a\r\nset-cookie: x=1",
        "\u202eabc",
    ]
    for text in texts:
        document = json.loads(json.dumps(gripper["document"]))
        document["poses"][0]["name"] = text
        given = {"document": document, "options": {}, "name": text}
        headers = {"content-type": "application/json"}
        answer = visitor.http.post("/task", content=json.dumps(given), headers=headers)
        assert "x=1" not in answer.headers.get("set-cookie", "")
        assert "\n" not in answer.headers.get("content-disposition", "")
        if answer.status_code == 422:
            assert answer.headers["content-type"] == "application/json"
            continue
        again = visitor.http.post("/read", json={"name": "t.toml", "base64": coded(answer.content)})
        name = again.json()["document"]["poses"][0].get("name", "")
        assert name.isprintable()
        if text.isprintable():
            assert name == text.strip()
        told = visitor.http.post("/command", content=json.dumps(given), headers=headers)
        told = told.json()["commands"]
        assert all(each["command"].isascii() and each["command"].isprintable() for each in told)


WRONG = [
    *("NaN", "Infinity", "-Infinity", "1e400", "1e308", "-1e999", '"1,5"', '"x"', "null", "true"),
    *("[1]", "[[1]]", "{}", '{"x": 1}', '"\\ud800"', '""', "[" * 50 + "]" * 50),
]


@pytest.mark.parametrize("text", WRONG)
def test_wrong_numbers_are_named_with_their_place(visitor, text):
    """W10."""
    headers = {"content-type": "application/json"}
    for field in ("x", "y", "angle", "weight"):
        pose = f'{{"x": 1, "y": 2, "angle": 20, "weight": 1, "{field}": {text}}}'
        first = {"x": 1, "y": 2, "angle": 20, "weight": 1}[field]
        pose = pose.replace(f'"{field}": {first}, ', "", 1)
        document = (
            f'{{"angle_unit": "deg", "poses": [{{"x": 0, "y": 0, "angle": 0}}, {pose}, '
            '{"x": 3, "y": 1, "angle": 45}]}'
        )
        answer = visitor.http.post("/check", content=f'{{"document": {document}}}', headers=headers)
        assert answer.status_code in (200, 422), answer.text
        if answer.status_code == 200:
            assert (field, text) in [("weight", "null")]
            continue
        (message,) = answer.json()["messages"]
        assert message["code"].startswith("E1")
        assert "task.json" in (message["where"] or ""), message


@pytest.mark.parametrize("depth", [200, 500, 980, 100_000])
def test_what_is_nested_too_deep_is_refused_on_every_route(visitor, depth):
    """Also where a file is nested so that the page sends; and the tab is not closed."""
    lists, objects = "[" * depth + "]" * depth, '{"a":' * depth + "1" + "}" * depth
    documents = [lists, objects, f'{{"poses": {lists}}}', f'{{"poses": [[0, 0, 0]], "a": {lists}}}']
    headers = {"content-type": "application/json"}
    for document in documents:
        for path in ("session", "read", "outline", "check", "task", "export", "result", "report",
                     "improve", "command", "autosave"):  # fmt: skip
            send = visitor.http.put if path == "autosave" else visitor.http.post
            answer = send(f"/{path}", content=f'{{"document": {document}}}', headers=headers)
            assert answer.status_code == 422, path
            assert answer.json()["messages"][0]["code"] != "E900"
        for name in ("a.json", "a.toml", "a.csv"):
            text = f"poses = {document}" if name == "a.toml" else document
            answer = visitor.http.post("/read", json={"name": name, "base64": coded(text)})
            assert answer.status_code == 422, name
            assert answer.json()["messages"][0]["code"] != "E900"
    with visitor.live() as tab:
        for do in ("solve", "follow", "place", "curve", "cognates", "cancel"):
            for document in documents:
                tab.socket.send(f'{{"n": 1, "do": "{do}", "document": {document}}}')
                heard = tab.hear()
                assert heard["kind"] == "refused"
                assert heard["messages"][0]["code"] != "E900"
        assert tab.ask("solve", document=few(5), options={})["kind"] == "solved"


def few(count):
    poses = [{"x": k**2, "y": 3 * k, "angle": 10 * k} for k in range(count)]
    return {"angle_unit": "deg", "poses": poses}


@pytest.mark.parametrize("count", range(10))
def test_any_number_of_poses_is_read_or_refused(visitor, count):
    """W10: 0 to 9 poses."""
    answer = visitor.http.post("/check", json={"document": few(count), "options": {}})
    if count > 1:
        assert answer.json() == {"messages": []}
    else:
        assert answer.status_code == 422
        (message,) = answer.json()["messages"]
        assert message["code"] == "E120"
        assert message["where"].startswith("task.json:")


def test_few_poses_are_solved_or_refused(visitor):
    """W10."""
    with visitor.live() as tab:
        for count in (0, 1, 2, 5):
            heard = tab.ask("solve", document=few(count), options={})
            if count < 2:
                assert heard["kind"] == "refused"
                assert heard["messages"][0]["code"] == "E120"
            else:
                assert heard["kind"] == "solved"
                assert len(heard["result"]["poses"]) == count


def test_what_is_no_request_is_refused_in_words(visitor):
    headers = {"content-type": "application/json"}
    for text in ("", "[]", "1", "nul", '"a"', "{", '{"a": 1'):
        for path in ("/read", "/check", "/export", "/command", "/session"):
            answer = visitor.http.post(path, content=text, headers=headers)
            assert answer.status_code in (400, 401), (path, text)
            assert answer.json()["messages"]
    for path, given in (
        ("/read", {}),
        ("/read", {"name": 1, "base64": "!"}),
        ("/outline", {"name": "a.svg"}),
        ("/check", {}),
        ("/check", {"document": []}),
        ("/task", {"document": {"poses": 1}}),
        ("/export", {"document": None}),
        ("/export", {"format": "exe"}),
        ("/improve", {"linkage": 3}),
        ("/report", {"document": {}}),
    ):
        answer = visitor.http.post(path, json=given)
        assert answer.status_code == 422, (path, given, answer.text)
        assert answer.json()["messages"][0]["message"]
    assert visitor.http.get("/template/none").status_code == 422
    assert visitor.http.get("/none").status_code == 404
    assert visitor.http.post("/start", json={}).status_code == 405
    assert visitor.http.put("/autosave", json={"document": [1]}).status_code == 400


def test_an_export_takes_the_options_of_the_command_only(visitor, gripper):
    for wrong in ({"hole": "5"}, {"pose": 1.5}, {"path": "/elsewhere"}, [1], {"assembled": 1}):
        asked = {**gripper, "format": "svg", "settings": wrong}
        answer = visitor.http.post("/export", json=asked)
        assert answer.status_code == 422
        assert answer.json()["messages"][0]["code"] == "E100"


def test_what_was_there_last_is_there_again(visitor, gripper):
    """W15: a task is kept on this machine, and shown to who opens the page again."""
    document = json.loads(json.dumps(gripper["document"]))
    document["poses"][1]["x"] = 0.75
    given = {"document": document, "options": {"method": "pencil"}, "name": "mine", "tab": "t1"}
    given["settings"] = {"hole": 5}
    assert visitor.http.put("/autosave", json=given).status_code == 204
    saved = visitor.http.get("/start").json()["saved"]
    assert saved["name"] == "mine"
    assert saved["document"] == document
    assert saved["options"] == {"method": "pencil"}
    assert saved["settings"] == {"hole": 5}


def test_two_tabs_do_not_take_each_other_s_place(visitor):
    """W15."""
    for tab in ("one", "two"):
        poses = [{"x": 0, "y": 0, "angle": 0, "name": tab}]
        given = {"document": {"poses": poses}, "name": "same", "tab": tab}
        assert visitor.http.put("/autosave", json=given).status_code == 204
    kept = [json.loads(each.read_bytes()) for each in visitor.saved.glob("*.json")]
    names = [each["document"]["poses"][0].get("name") for each in kept if each["name"] == "same"]
    assert sorted(names) == ["one", "two"]


def test_what_is_damaged_or_not_yet_written_is_passed_over(visitor, gripper, start):
    """W15: a machine lost its power, or another tab writes in this moment."""
    good = {**gripper, "name": "good"}
    assert visitor.http.put("/autosave", json=good).status_code == 204
    newest = time.time() + 1000
    damaged = [b"", b"{", b"\0" * 300, b"[1]", b'{"document": 1}', b'{"document": {}}', b"[" * 9999]
    files = {f"{k:016x}.json": data for k, data in enumerate(damaged)}
    whole = json.dumps({**good, "name": "half written"}).encode()
    files |= {f".burmester-{k:016x}-{k:016x}.json": whole for k in range(30)}
    for name, data in files.items():
        (visitor.saved / name).write_bytes(data)
        newest += 1
        os.utime(visitor.saved / name, (newest, newest))
    try:
        assert visitor.http.get("/start").json()["saved"]["name"] == "good"
        # Nor do they push out what was kept, or are themselves taken away from who writes them.
        assert visitor.http.put("/autosave", json={**good, "tab": "other"}).status_code == 204
        assert visitor.http.get("/start").json()["saved"]["name"] == "good"
        assert len(list(visitor.saved.glob(".burmester-*"))) == 30
    finally:
        for name in files:
            (visitor.saved / name).unlink(missing_ok=True)
