"""ARCHITECTURE.md is a map of what is: rooms, modules and floors; and links lead somewhere."""

import re
from collections import Counter
from pathlib import Path

import pytest
from docs.building import GENERATED

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "burmester"
MAP = ROOT / "ARCHITECTURE.md"
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), ROOT / "benchmarks" / "README.md"]
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]
MADE = {ROOT / "docs" / "reference" / f"{name}.md" for name in GENERATED}
ENDINGS = (".py", "", ".npz", ".md", ".json", ".mjs")


def in_rooms(text):
    """How often the map names each module: `room/module`, or one word on the ground."""
    rooms = text.partition("\n## The rooms\n")[2].partition("\n## ")[0]
    parts = re.split(r"^### `([\w/]+)`.*$", rooms, flags=re.MULTILINE)
    named = Counter()
    for room, table in zip(parts[1::2], parts[2::2], strict=True):
        front = "" if room == "burmester" else f"{room}/"
        named.update(front + row for row in re.findall(r"^- `(\w+)`: \S", table, re.MULTILINE))
    return named


def in_tree():
    files = (file.relative_to(SOURCE).with_suffix("") for file in SOURCE.rglob("*.py"))
    return {file.as_posix() for file in files if not file.name.startswith("__")}


def test_the_map_names_each_module_once_and_no_other():
    named = in_rooms(MAP.read_text(encoding="utf-8"))
    assert {name for name, times in named.items() if times > 1} == set()
    assert in_tree() - set(named) == set(), "not on the map"
    assert set(named) - in_tree() == set(), "on the map only"


def unknown_paths(text):
    """What is quoted like a place of the package, `room/module`, and is not there."""
    rooms = {file.name for file in SOURCE.iterdir() if file.is_dir()}
    quoted = set(re.findall(r"`(\w+/[\w./]+)`", text))
    places = {each for each in quoted if each.partition("/")[0] in rooms}
    return {
        place
        for place in places
        if not any((SOURCE / f"{place}{ending}").exists() for ending in ENDINGS)
    }


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_places_that_a_page_names_exist(page):
    text = page.read_text(encoding="utf-8")
    assert unknown_paths(text) == set()
    quoted = re.findall(r"`((?:src|tests|scripts|docs|benchmarks|examples)/[\w./-]+)`", text)
    paths = {each for each in quoted if not re.search(r"\b[A-Z]+\b", each)}  # NAME: any name
    assert {each for each in paths if not (ROOT / each).exists()} == set()
    dotted = re.findall(r"`burmester((?:\.[a-z_]+){2,})`", text)
    places = {each.strip(".").replace(".", "/") for each in dotted}
    assert {each for each in places if not (SOURCE / f"{each}.py").exists()} == set()


def anchors(page):
    """The anchors of a page's headings."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {
        re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in headings
    }


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_links_lead_somewhere(page):
    text = page.read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)\s]+)\)|(?:src|srcset)=\"([^\"]+)\"", text)
    for link in (one or other for one, other in links):
        if "://" in link:
            continue
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if target.resolve() in MADE:
            assert not anchor, link
            continue
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_the_map_reader_can_fail():
    text = "\n## The rooms\n### `io/reading`: x\n\n- `a`: b\n### `burmester`: y\n- `c`: d\n\n"
    assert in_rooms(text) == {"io/reading/a": 1, "c": 1}
    assert unknown_paths("`fourbar/dyad`, `fourbar/no_such_noun`") == {"fourbar/no_such_noun"}
