"""ARCHITECTURE.md is a map of what is: rooms and floors; and links lead somewhere."""

import re
from collections import Counter
from pathlib import Path

import pytest
from docs.building import GENERATED
from docs.building.modules import modules

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "burmester"
MAP = ROOT / "ARCHITECTURE.md"
PAGES = [
    *ROOT.glob("*.md"),
    *(ROOT / "docs").rglob("*.md"),
    ROOT / "benchmarks" / "README.md",
    *(ROOT / "benchmarks" / "measured").glob("*.md"),
]
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]
MADE = {ROOT / "docs" / "reference" / f"{name}.md" for name in (*GENERATED, "messages/index")}
ENDINGS = (".py", "", ".npz", ".md", ".json", ".mjs")


def in_rooms(text):
    """How often the map names each room."""
    rooms = text.partition("\n## The rooms\n")[2].partition("\n## ")[0]
    return Counter(re.findall(r"^- `([\w/]+)`: \S", rooms, re.MULTILINE))


def test_the_map_names_each_room_once_and_no_other():
    """The modules on the ground are rooms of their own there."""
    named = in_rooms(MAP.read_text(encoding="utf-8"))
    there = modules()
    assert {name for name, times in named.items() if times > 1} == set()
    assert set(named) == {room for room in there if room} | set(there[""])


def test_the_map_is_short():
    assert len(MAP.read_text(encoding="utf-8").splitlines()) <= 200


def test_each_module_says_in_one_line_what_it_is():
    rooms = modules()
    wrong = [
        f"{room}/{name}: {says}"
        for room, names in rooms.items()
        for name, says in names.items()
        if not 10 < len(says) <= 100 or not says.endswith(".")
    ]
    assert wrong == []


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
        path, _, anchor = link.partition("#")
        if "://" in link or f'.report("{path}"' in text:  # a cell of the page writes it
            continue
        target = page.parent / path if path else page
        if target.resolve() in MADE:
            assert not anchor, link
            continue
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_the_map_reader_can_fail():
    text = "\n## The rooms\n\n- `io/reading`: x\n- `c`: d\n- `c`: e\n\n## Tests\n- `f`: g\n"
    assert in_rooms(text) == {"io/reading": 1, "c": 2}
    assert unknown_paths("`fourbar/dyad`, `fourbar/no_such_noun`") == {"fourbar/no_such_noun"}
