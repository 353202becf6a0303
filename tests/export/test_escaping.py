"""Hostile ids, types and units in every file that is written: read by parsers that are not ours,
each file has the structure that it has with a harmless name, and nothing runs.
"""

import ast
import csv
import json
import re
import runpy
import warnings
from collections import Counter
from dataclasses import replace
from xml.etree import ElementTree

import ezdxf
import pypdf
import pytest
from matplotlib.cbook import is_math_text

from burmester import KeepOut, Polygon, Surroundings
from burmester.api.table import dimensions_as_html
from burmester.errors import InputError
from burmester.export import FORMATS, Options, export
from burmester.export.description import (
    dxf_text,
    one_line,
    python_docstring,
    step_text,
    xml_attribute,
    xml_comment,
    xml_text,
)
from burmester.plot.style import plain
from burmester.printable import printable
from tests.oracles.bodies import BODY
from tests.oracles.handed_over import saved
from tests.oracles.hostile_texts import PAYLOADS, RAN
from tests.oracles.openscad_tokens import tokens
from tests.samples import some_of

HARMLESS = "a harmless name"
each_payload = pytest.mark.parametrize("text", PAYLOADS.values(), ids=PAYLOADS)


def test_there_are_25_payloads():
    assert len(PAYLOADS) == len({*PAYLOADS.values()}) == 25


# The helpers -------------------------------------------------------------------------------------


@each_payload
def test_a_docstring_of_python_holds_it(text):
    tree = ast.parse(f'"""Linkage {python_docstring(text)}"""\nA = 1\n')
    assert [type(node).__name__ for node in tree.body] == ["Expr", "Assign"]
    told = ast.get_docstring(tree, clean=False)
    assert told == f"Linkage {cut(printable(text))}"


@each_payload
def test_a_comment_of_openscad_holds_it(text):
    assert tokens(f"// {one_line(text)}\ncube(1);") == tokens("// x\ncube(1);")


@each_payload
def test_xml_holds_it(text):
    source = f"<a b={xml_attribute(text)}>{xml_text(text)}<!-- {xml_comment(text)} --><c/></a>"
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    root = ElementTree.fromstring(source.encode(), parser)
    assert [each.tag for each in root] == [ElementTree.Comment, "c"]
    assert list(root.attrib) == ["b"]
    assert root.attrib["b"] == root.text == cut(printable(text))
    assert "--" not in root[0].text[:-1]


@each_payload
def test_a_text_of_dxf_is_shown_as_it_is(text):
    told = dxf_text(text)
    assert told.isprintable()
    assert not re.search(r"%%|\\[UM]\+|\^(?! )", told)
    assert len(told) < 2000
    assert re.sub(r"[ .]", "", told) == re.sub(r"[ .]", "", cut(printable(text)))


@each_payload
def test_a_text_of_step_is_plain(text):
    assert re.fullmatch(r"[ -&(-\[\]-~]*", step_text(text))


@each_payload
def test_a_picture_draws_it_as_it_is(text):
    told = plain(text)
    assert not is_math_text(told)
    assert told.isprintable()
    assert len(told) <= 110


def cut(text):
    return text if len(text) <= 1000 else text[:997] + "..."


# The files ---------------------------------------------------------------------------------------


def xml_structure(path):
    """Tags and attributes of all elements and comments; of the roots' names the keys only."""
    builder = ElementTree.TreeBuilder(insert_comments=True, insert_pis=True)
    root = ElementTree.fromstring(path.read_bytes(), ElementTree.XMLParser(target=builder))
    model = root.attrib.pop("model" if root.tag == "mujoco" else "name", None)
    for each in root.iter() if root.tag == "sdf" else ():  # the world and its model
        model = each.attrib.pop("name", None) if each.tag in ("world", "model") else model
    assert root.tag.endswith("svg") or model is not None
    drawn = [each for each in root.iter() if not str(each.tag).endswith(("}text", "}svg"))]
    return [str(each.tag) for each in root.iter()], [each.attrib for each in drawn]


def script_structure(path):
    """All of a script but its first sentence and the names in it."""
    tree = ast.parse(path.read_bytes())
    tree.body[0].value.value = ""  # the docstring
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg == "name":
            assert isinstance(node.value, ast.Constant)
            node.value.value = node.value.value if node.value.value in KEPT else ""
    return ast.dump(tree)


def drawing_structure(path):
    """Which entities a drawing has, on which layers, with what attributes."""
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    return Counter(
        (each.dxftype(), each.dxfattribs().get("layer"), *sorted(each.dxfattribs()))
        for each in document.entitydb.values()
    )


def data_structure(path):
    """All values but the ids and the type."""
    tree = json.loads(path.read_bytes())
    assert [each.pop("id") for each in tree["dyads"]] == [tree["id"], tree["id"] + "2"]
    return {key: tree[key] for key in tree if key not in ("id", "type")}


def page_structure(path):
    """The keys of a document and what its pages draw, letters left out."""
    document = pypdf.PdfReader(path)
    drawn = [
        [str(operator) for _, operator in page.get_contents().operations if operator in PATHS]
        for page in document.pages
    ]
    return [*document.trailer["/Root"]], [[*page] for page in document.pages], drawn


PATHS = {b"m", b"l", b"c", b"h", b"f", b"S", b"B", b"re"}
STRUCTURES = {
    "pdf": page_structure,
    "svg": xml_structure,
    "mjcf": xml_structure,
    "urdf": xml_structure,
    "sdf": xml_structure,
    "pylinkage": script_structure,
    "openscad": lambda path: tokens(path.read_text("utf-8")),
    "dxf": drawing_structure,
    "json": data_structure,
    "csv": lambda path: list(csv.reader(path.read_text("utf-8").splitlines())),
    "step": lambda path: re.sub(r"\s", "", re.sub(r"'(?:[^']|'')*'", "T", path.read_text("ascii"))),
}
TEXTS = [name for name in STRUCTURES if name not in ("step", "pdf")]


def structure(to, path):
    """What a parser of another program makes of a file, but for its texts."""
    return STRUCTURES[to](path) if to in STRUCTURES else path.stat().st_size > 0


KEPT = {"A", "B", "B1", "B2", "driver", "follower", "body", "body_x"}


def hostile(text, name="crank-rocker, mm"):
    """A linkage whose id and dyads' ids are a text, and that of a region to keep out of."""
    chosen = saved(name, poses=4)
    kept = KeepOut(Polygon([(0, 90), (30, 90), (30, 110)]), printable(text)[:100])
    task = replace(chosen.task, body=Polygon(BODY), surroundings=Surroundings((kept,)))
    dyads = [
        replace(each, id=id) for each, id in zip(chosen.dyads, (text, text + "2"), strict=True)
    ]
    return replace(chosen, id=text, dyads=tuple(dyads), task=task)


@pytest.fixture(scope="module")
def harmless(tmp_path_factory):
    """The structure of a file with a harmless name, by format."""
    folder, known = tmp_path_factory.mktemp("harmless"), {}

    def of(to):
        if to not in known:
            (path,) = export(hostile(HARMLESS), to, folder / f"out{FORMATS[to].suffix}", SMALL)
            known[to] = structure(to, path)
        return known[to]

    return of


SMALL = Options(seconds=0.2, frames_per_second=10, width_px=200)


@each_payload
@pytest.mark.parametrize("to", TEXTS)
def test_a_file_has_the_structure_that_it_has_with_a_harmless_name(
    to, text, tmp_path, harmless, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (path,) = export(hostile(text), to, tmp_path / f"out{FORMATS[to].suffix}")
    assert structure(to, path) == harmless(to)
    assert not (tmp_path / RAN).exists()


# A film is of pictures that are drawn alike: a GIF has some of the names, an MP4 the others.  No
# name is in an STL.
TAKEN = {
    "step": some_of([*PAYLOADS.values()], 8),
    "pdf": some_of([*PAYLOADS.values()], 8),
    "gif": some_of([*PAYLOADS.values()][::2], 3),
    "mp4": some_of([*PAYLOADS.values()][1::2], 3),
    "stl": some_of([*PAYLOADS.values()], 3),
}


@pytest.mark.parametrize("to", TAKEN)
def test_solids_and_pictures_take_any_name(to, tmp_path, harmless, monkeypatch):
    assert harmless(to)
    # Whether parts collide along the motion has nothing to do with a name.
    monkeypatch.setattr("burmester.export.solids.solid.collision", lambda *_: None)
    for text in TAKEN[to]:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Glyph", UserWarning)  # no font has them all
            (path,) = export(
                hostile(text), to, tmp_path / f"out{FORMATS[to].suffix}", SMALL, force=True
            )
        assert structure(to, path) == harmless(to)


def test_a_script_runs_nothing_but_itself(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for text in PAYLOADS.values():
        (path,) = export(hostile(text), "pylinkage", tmp_path / "out.py", force=True)
        runpy.run_path(str(path), run_name="__main__")
        assert capsys.readouterr().out.count("pose ") == 4
    assert [each.name for each in tmp_path.iterdir()] == ["out.py"]


@each_payload
def test_a_unit_is_refused_where_lengths_are_scaled(text, tmp_path):
    chosen = saved("crank-rocker, mm", poses=4)
    if len(text) > 100:
        with pytest.raises(InputError, match="too long"):
            replace(chosen.task, length_unit=text)
        return
    chosen = replace(chosen, task=replace(chosen.task, length_unit=text))
    for to in ("svg", "pylinkage", "csv"):
        with pytest.raises(InputError) as caught:
            export(chosen, to, tmp_path / f"out{FORMATS[to].suffix}")
        assert caught.value.code == "E162"
        assert str(caught.value).replace("\n", "").isprintable()
    assert not list(tmp_path.iterdir())


@each_payload
def test_a_notebook_shows_it_as_a_text(text):
    page = dimensions_as_html(hostile(text))
    assert "<evil" not in page
    assert "<script" not in page
    assert "<include" not in page
