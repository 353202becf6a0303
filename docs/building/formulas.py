"""Formulas of `docs/mathematics` and the functions that compute them, linked both ways.

A page says below a formula: Formula `name`, computed by `room.module.function`.  The docstring of
that function says: Formula `name` of the theory.  Prose says: formula `name`.
"""

import ast
import re
from importlib import import_module
from pathlib import Path

import burmester

PAGES = Path(__file__).resolve().parents[1] / "mathematics"
ON_PAGE = re.compile(r"(?m)^Formula `([\w-]+)`, computed by ((?:`[\w.]+`(?:, )?)+)\.$")
IN_PROSE = re.compile(r"\bformulas? (`[\w-]+`(?:(?:, | and )`[\w-]+`)*)")
IN_DOCSTRING = re.compile(r"Formulas? ((?:`[\w-]+`,?\s+)+)of the theory\.")
QUOTED = re.compile(r"`([\w.-]+)`")


def theory():
    """The text of all pages of formulas."""
    return "\n".join(page.read_text(encoding="utf-8") for page in sorted(PAGES.glob("*.md")))


def on_page(text):
    """{(formula, function)} of a page, functions by their names below `burmester`."""
    return {
        (name, function)
        for name, functions in ON_PAGE.findall(text)
        for function in QUOTED.findall(functions)
    }


def in_docstrings(source: Path):
    """{(formula, function)} of the docstrings of a package's files."""
    found = set()
    for file in sorted(source.rglob("*.py")):
        text = file.read_text(encoding="utf-8")
        if " of the theory." not in text:
            continue
        module = ".".join(file.relative_to(source).with_suffix("").parts)
        for name, node in named(ast.parse(text), module):
            told = IN_DOCSTRING.search(ast.get_docstring(node) or "")
            found |= {(formula, name) for formula in QUOTED.findall(told[1] if told else "")}
    return found


def named(tree, inside):
    """Functions and classes of a module, and those in its classes, with their dotted names."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            name = f"{inside}.{node.name}"
            yield name, node
            if isinstance(node, ast.ClassDef):
                yield from named(node, name)


def owner(function):
    """The object behind a dotted name below `burmester`.  AttributeError where there is none."""
    room, module, *rest = function.split(".")
    found = import_module(f"burmester.{room}.{module}")
    for name in rest:
        found = getattr(found, name)
    return found


def on_site(function):
    """The full name under which the reference describes it: the short one where there is one."""
    room, module, top, *attribute = function.split(".")
    if top in burmester.__all__ and getattr(burmester, top) is owner(f"{room}.{module}.{top}"):
        return ".".join(["burmester", top, *attribute])
    return f"burmester.{function}"


def functions_apart(text):
    """What pages name and the page of the API does not describe, in order, without repeats."""
    found = []
    for _, functions in ON_PAGE.findall(text):
        for function in QUOTED.findall(functions):
            name = on_site(function)
            short = name.count(".") == 1 or name.split(".")[1][:1].isupper()
            if not short and name not in found:
                found.append(name)
    return found


def linked(text):
    """A page with a target at each formula's name and links to its functions."""

    def line(match):
        links = ", ".join(
            f"{{py:obj}}`{each} <{on_site(each)}>`" for each in QUOTED.findall(match[2])
        )
        return f"(formula-{match[1]})=\nFormula `{match[1]}`, computed by {links}."

    return ON_PAGE.sub(line, text)


def in_prose(text):
    """The formulas that a chapter names, in order."""
    return [name for names in IN_PROSE.findall(text) for name in QUOTED.findall(names)]


def prose_linked(text):
    """The chapter with a link to each formula that it names."""
    return IN_PROSE.sub(
        lambda told: re.sub(r"`([\w-]+)`", r"{ref}`\1 <formula-\1>`", told[0]), text
    )


def as_rst(lines):
    """A docstring, which is plain text with formulas in it, as the markup that Sphinx reads.

    Stars and bars are what they are.  Without sections a line that hangs below another one goes on
    with it.
    """
    flat = not any(re.fullmatch(r"\s*-{3,}", line) for line in lines)
    made: list[str] = []
    for line in lines:
        text = line
        if not re.match(r"\s*(>>>|\.\.\.)", line):
            text = "".join(
                part if part.startswith("`") else re.sub(r"([*|])", r"\\\1", part)
                for part in re.split(r"(`[^`]*`)", line)
            )
        hangs = made and made[-1].strip() and re.match(r"    \S", text) and made[-1][0] != " "
        made.append(text.strip() if flat and hangs else text)
    return made


def link_docstring(*told_by_sphinx):
    """Docstrings as markup, names of formulas as links; Sphinx calls this before numpydoc."""
    lines = told_by_sphinx[-1]
    text = IN_DOCSTRING.sub(
        lambda told: "Theory: " + ", ".join(
            f":ref:`{each} <formula-{each}>`" for each in QUOTED.findall(told[1])
        ) + ".",
        "\n".join(as_rst(lines)),
    )  # fmt: skip
    lines[:] = text.split("\n")


def setup(app):
    """Sphinx calls this."""
    app.connect("autodoc-process-docstring", link_docstring, priority=400)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
