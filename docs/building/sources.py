"""The sources that Sphinx reads: `docs/`, pages beside it, and pages made of what the program says.

In the project pages link to files anywhere in it, as a code host shows them.  Here everything lies
in one folder, so links that leave `docs/` are bent to where their target lies.
"""

import re
import shutil
from pathlib import Path

import nbformat
from docs.building import formulas, generated
from myst_nb.core.read import is_myst_markdown_notebook, read_myst_markdown_notebook

BESIDE = {  # files outside docs/ that are pages, or files, of the site
    "ARCHITECTURE.md": "project/architecture.md",
    "CHANGELOG.md": "project/changelog.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "benchmarks/README.md": "project/benchmarks/index.md",
    "CITATION.cff": "project/CITATION.cff",
    "README.md": "index.md",
    "docs/README.md": "index.md",
    "src/burmester/io/synthesis.schema.json": "reference/synthesis.schema.json",
    "src/burmester/io/function.schema.json": "reference/function.schema.json",
    "src/burmester/io/family_map.schema.json": "reference/family_map.schema.json",
}
MEASURED = "benchmarks/measured"  # its pages stand beside that of benchmarks/README.md
NOT_COPIED = ("building", "__pycache__", "*.py", "README.md", "*.ipynb")
CODE = re.compile(r"\(([EWR]\d{3})\)")  # of a message, which has its place on the page of messages
DOWNLOAD = re.compile(r"\{download\}`([^`<]+?)(?: <[^>]+>)?`")
OFFER = re.compile(r"\{download\}`This page as a notebook <[^>]+>`, with what it shows\.")
LINK = re.compile(r"(\]\(|(?:src|srcset|href)=\")([^)\s\"#]+)(#[^)\s\"]*)?(?=[)\"])")


def lay_out(root: Path, folder: Path):
    """Everything that Sphinx needs, into an empty folder."""
    shutil.copytree(root / "docs", folder, ignore=shutil.ignore_patterns(*NOT_COPIED))
    for name in ("tutorials", "gallery", "teaching"):
        for file in given_files(root):
            shutil.copy(file, folder / name)
    for source, place in BESIDE.items():
        if place != "index.md":
            target = folder / place
            target.parent.mkdir(exist_ok=True, parents=True)
            shutil.copy(root / source, target)
    for source in sorted((root / MEASURED).glob("*.md")):
        shutil.copy(source, folder / "project" / "benchmarks")
    for page in folder.rglob("*.md"):
        at = page.relative_to(folder).as_posix()
        origin = origin_of(at)
        text = bent(page.read_text(encoding="utf-8"), origin, root)
        page.write_text(text, encoding="utf-8")
    for page in (folder / "mathematics").glob("*.md"):
        page.write_text(formulas.linked(page.read_text(encoding="utf-8")), encoding="utf-8")
    chapter = folder / "theory.md"
    chapter.write_text(
        without_code(chapter.read_text(encoding="utf-8"), formulas.prose_linked), encoding="utf-8"
    )
    generated.write_pages(folder, formulas.functions_apart(formulas.theory()))
    for page in folder.rglob("*.md"):
        if is_myst_markdown_notebook(page.read_text(encoding="utf-8")):
            write_notebook(page)


def given_files(root: Path):
    """Files that notebooks read beside themselves: those of `burmester new`, and the examples."""
    yield from sorted((root / "src" / "burmester" / "templates").glob("*.toml"))
    yield from sorted(file for file in (root / "examples").iterdir() if file.is_file())


def bent(text, origin, root):
    """The text of the file `origin` of the project with links that hold in the folder."""

    def link(match):
        address, anchor = match[2], match[3] or ""
        if "://" in address or address.startswith("mailto:"):
            return match[0]
        target = (root / origin).parent.joinpath(address).resolve().relative_to(root).as_posix()
        there = place_of(target)
        if there is None:
            return match[0]
        here = Path(place_of(origin) or origin)
        steps = "../" * (len(here.parts) - 1)
        return f"{match[1]}{steps}{there}{anchor}"

    return without_code(text, lambda prose: CODE.sub(r"([\1](#\1))", LINK.sub(link, prose)))


def origin_of(place):
    """The file of the project that lies at a place of the folder."""
    beside = next((one for one, other in BESIDE.items() if other == place), None)
    if beside is None and place.startswith("project/benchmarks/"):
        return f"{MEASURED}/{Path(place).name}"
    return beside or f"docs/{place}"


def place_of(target):
    """Where a file of the project lies in the folder; None if it is not of the site."""
    if target in BESIDE:
        return BESIDE[target]
    if target.startswith(f"{MEASURED}/"):
        return f"project/benchmarks/{Path(target).name}"
    if target in ("docs", "docs/"):
        return "index.md"
    return target.removeprefix("docs/") if target.startswith("docs/") else None


def without_code(text, change):
    """The text with its prose changed and its fenced blocks as they are."""
    parts = re.split(r"(?ms)^(```.*?^```$)", text)
    return "".join(part if part.startswith("```") else change(part) for part in parts)


def write_notebook(page: Path):
    """The page as a notebook that Jupyter opens, beside it; what it shows comes after the build."""
    text = page.read_text(encoding="utf-8")
    notebook = read_myst_markdown_notebook(text, add_source_map=False)
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            plain = cell.source.replace(
                f"{{download}}`This page as a notebook <{page.stem}.ipynb>`, with what it shows.",
                "",
            )
            cell.source = DOWNLOAD.sub(r"`\1`", plain).rstrip()
    nbformat.write(notebook, page.with_suffix(".ipynb"))
