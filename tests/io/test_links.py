"""Tasks in links: read as they were written, by whatever reads a task, or refused."""

import base64
import json
import zlib

import pytest

import burmester
from burmester.cli import main
from burmester.errors import InputError
from burmester.io import templates
from burmester.io.reading.link import LinkedTask, read_link, write_link
from burmester.io.reading.poses import read_task
from burmester.live.document import document_of, read_file
from burmester.studio.opening import opening
from tests.oracles.refusals import refusal


def code(text):
    """The code of a text, written without what is tested."""
    packer = zlib.compressobj(wbits=-15)
    packed = packer.compress(text.encode() if isinstance(text, str) else text) + packer.flush()
    return base64.urlsafe_b64encode(packed).decode().rstrip("=")


TASK = {"angle_unit": "deg", "poses": [[0, 0, 0], [5, 1, 10], [9, 4, 30], [11, 9, 50], [9, 9, 60]]}
LINK = f"t1={code(json.dumps([TASK, {'norm': 'worst'}, 'lid', 'L2']))}"


def test_every_template_goes_through_a_link_of_less_than_a_thousand_characters():
    for name in templates.of_poses():
        document = document_of(read_file(f"{name}.toml", templates.text(name).encode()))
        link = write_link(LinkedTask(document, {}, name))
        assert len(link) < 1000
        assert document_of(read_task(f"https://example.org/a?b=1#{link}")) == document, name
        text = zlib.decompress(base64.urlsafe_b64decode(link[3:] + "=="), wbits=-15)
        assert json.loads(text) == [document, {}, name, None]


def test_a_link_opens_the_studio_with_its_options_name_and_choice():
    told = opening({"path": f"#{LINK}"}, b"")
    assert (told["options"], told["name"], told["choice"]) == ({"norm": "worst"}, "lid", "L2")
    assert [pose["x"] for pose in told["document"]["poses"]] == [0, 5, 9, 11, 9]
    function = {"function": {"expression": "x**2", "x": [0, 1], "input_deg": 90, "output_deg": 60}}
    assert opening({"path": f"t1={code(json.dumps([function]))}"}, b"")["function"]
    with pytest.raises(InputError, match="no option 'colour'"):
        opening({"path": f"t1={code(json.dumps([TASK, {'colour': 1}]))}"}, b"")


def test_the_command_keeps_the_options_of_a_link_but_for_those_typed(capsys, tmp_path):
    file = tmp_path / "task.json"
    file.write_text(json.dumps(TASK), encoding="utf-8")

    def said(*words):
        with pytest.raises(SystemExit):
            main(["synthesize", "--json", *words])
        return json.loads(capsys.readouterr().out)

    for typed in ("worst", "rms"):
        by_file = said(str(file), "--norm", typed)
        by_link = said(LINK, *(["--norm", typed] if typed == "rms" else []))
        assert by_link["options"]["norm"] == typed
        assert by_link["linkages"] == by_file["linkages"]


def test_a_result_gives_the_link_of_its_task():
    result = burmester.synthesize(read_task(LINK))
    link = result.link("https://example.org/")
    assert link.startswith("https://example.org/#t1=")
    assert document_of(read_task(link)) == document_of(result.task)


@pytest.mark.parametrize(
    ("link", "message"),
    [
        (f"t1={code('[' + ' ' * 5_000_000)}", "is too large"),
        (f"t1={'A' * 20_001}", "is too long"),
        (LINK[:-9], "is damaged"),
        (LINK + "AAAA", "is damaged"),
        (LINK.replace("=", "=é"), "is damaged"),
        ("t1=", "is damaged"),
        (f"t1={code('[' * 100_000)}", "is damaged"),
        (f"t1={code('[{}, NaN]')}", "is damaged"),
        (f"t1={code('[[], {}]')}", "holds no task"),
        (f"t1={code('7')}", "holds no task"),
        (f"t2={code('[{}]')}", "has version 2"),
        ("t" + "9" * 5000 + "=", "has version 9"),
    ],
)
def test_what_is_hostile_damaged_or_newer_is_refused(link, message):
    error = refusal(lambda: read_link(link))
    assert error.code == "E117"
    with pytest.raises(InputError, match=message):
        read_task(link)


def test_a_document_is_refused_as_a_file_is_with_its_place():
    poses = [*TASK["poses"], [1, 2, "x"]]
    error = refusal(lambda: read_task(f"t1={code(json.dumps([{**TASK, 'poses': poses}]))}"))
    assert error.code == "E104"
    assert error.where.startswith("<link>:")


def test_what_is_too_large_makes_no_link():
    with pytest.raises(InputError, match="too large for a link"):
        write_link(LinkedTask({"poses": [[k, k, 0] for k in range(30_000)]}))
