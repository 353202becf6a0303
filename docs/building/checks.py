"""What holds of the built pages.

Links lead somewhere, nothing is loaded from elsewhere, and all of it is small.
"""

import re
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from docs.building import formulas

MOST_MEGABYTES = 40
LOADED = {
    "img": "src",
    "script": "src",
    "link": "href",
    "source": "src",
    "video": "src",
    "iframe": "src",
}
ELSEWHERE = re.compile(r"^(?:https?:)?//", re.IGNORECASE)
IN_STYLE = re.compile(r"(?:url\(|@import)\s*[\"']?((?:https?:)?//[^\"')]+)", re.IGNORECASE)


class Page(HTMLParser):
    """The places that a page has, the links that it makes and what it loads."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.ids, self.links, self.loads = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Notes ids, links and what is loaded."""
        given = {name: value or "" for name, value in attrs}
        self.ids |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if given.get("rel") in ("canonical", "prev", "next", "index", "search"):
            return
        if (where := given.get(LOADED.get(tag, ""))) is not None:
            self.loads.append(where)


def troubles(folder: Path):
    """What is wrong with the pages in a folder, a line each."""
    pages = {path.resolve(): Page(path.read_text("utf-8")) for path in folder.rglob("*.html")}
    told = []
    for path, page in pages.items():
        at = path.relative_to(folder.resolve())
        told += [f"{at}: loads {each}" for each in page.loads if ELSEWHERE.match(each)]
        local = [each for each in page.loads if not ELSEWHERE.match(each)]
        for link in [*page.links, *local]:
            if re.match(r"^[a-z]+:", link) or ELSEWHERE.match(link):
                continue
            address, _, anchor = link.partition("#")
            target = (
                (path.parent / unquote(address.partition("?")[0])).resolve() if address else path
            )
            if not target.is_file():
                told.append(f"{at}: {link} leads nowhere")
            elif anchor and target in pages and unquote(anchor) not in pages[target].ids | {""}:
                told.append(f"{at}: {link} names no place of that page")
    for path in folder.rglob("*.css"):
        told += [f"{path.name}: loads {each}" for each in IN_STYLE.findall(path.read_text("utf-8"))]
    if (size := megabytes(folder)) > MOST_MEGABYTES:
        told.append(f"{size:.1f} MB are more than {MOST_MEGABYTES}")
    return sorted(set(told))


def formulas_without_links(folder: Path):
    """Formulas that lead to no function, functions that lead back to no formula, a line each."""
    told = []
    for page in sorted(formulas.PAGES.glob("*.md")):
        name = f"mathematics/{page.stem}.html"
        for formula, function in sorted(formulas.on_page(page.read_text("utf-8"))):
            there, back = f"#{formulas.on_site(function)}", f"{name}#formula-{formula}"
            to = [link for link in links_of(folder / name) if link.endswith(there)]
            if not to:
                told.append(f"{name}: {formula} does not lead to {function}")
            elif not any(
                link.endswith(back)
                for link in links_of((folder / name).parent / to[0].partition("#")[0])
            ):
                told.append(f"{to[0]} does not lead back to the formula {formula}")
    return told


@cache
def links_of(page: Path):
    """The links of a page."""
    return Page(page.read_text("utf-8")).links


def megabytes(folder: Path):
    """The size of all files."""
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6
