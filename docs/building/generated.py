"""Pages made of what the program says of itself.

The command, messages, modules, the JSON schema, the functions of the theory, the paper's tables.
"""

import json
import math
import re
from importlib.resources import files
from pathlib import Path

import click
from docs.building import GENERATED
from docs.building.asked import asked_page
from docs.building.modules import modules_page
from PIL import Image

from burmester.cli import burmester as command
from burmester.paper.five_methods import side_by_side
from burmester.paper.reproduction import reproduce
from burmester.plot import write_figures
from burmester.plot.paper import NAMES

CODE = re.compile(r"## ([A-Z]\d{3}) (.*)")
MOST_WORDS = 2800  # of a page of messages
COLOURS = 256  # of a picture: more show no difference, and fill the file


def write_pages(folder: Path, functions):
    """All generated pages; functions: what the page of functions describes."""
    reference = folder / "reference"
    pages = {
        "asked": asked_page(cell),
        "command": command_page(),
        "functions": functions_page(functions),
        "modules": modules_page(),
        "paper-tables": paper_page(folder / "reference" / "paper"),
        "schema": schema_page(),
    }
    assert tuple(pages) == GENERATED
    for name, text in pages.items():
        reference.joinpath(f"{name}.md").write_text(text, encoding="utf-8")
    messages = reference / "messages"
    messages.mkdir()
    for name, text in message_pages().items():
        messages.joinpath(f"{name}.md").write_text(text, encoding="utf-8")


def command_page():
    """`burmester` and its commands, from click itself."""
    parts = [
        "# The command",
        "What `burmester --help` says, for every command. "
        "[Commands](../commands.md) tells what they are for.",
        f"```text\n{help_of(command, 'burmester')}\n```",
    ]
    for name, each in command.commands.items():
        whole = f"burmester {name}"
        parts += [f"## {whole}", f"```text\n{help_of(each, whole)}\n```"]
    return "\n\n".join(parts) + "\n"


def help_of(each, name):
    """What a command says with --help, 84 characters wide."""
    context = click.Context(each, info_name=name, terminal_width=84, max_content_width=84)
    return each.get_help(context).rstrip()


def methods_table(task):
    """One of the paper's tasks by five methods; times are no part of it."""
    rows = [
        "| method | fixed pivot | moving pivot | length | rms | worst | starts |",
        "|---|---|---|--:|--:|--:|---|",
    ]
    for answer in task.answers:
        for k in range(len(answer.rms_error)):
            fixed, moving = (
                ", ".join(f"{value:.3f}" for value in pivots[k])
                for pivots in (answer.dyads.fixed_pivot, answer.dyads.moving_pivot)
            )
            reached = answer.reached
            starts = "none needed" if reached is None else f"{reached[min(k, len(reached) - 1)]}"
            rows.append(
                f"| {answer.method} | ({fixed}) | ({moving}) | {answer.dyads.radius[k]:.3f} "
                f"| {answer.rms_error[k]:.1e} | {answer.max_error[k]:.1e} | {starts} |"
            )
    words = "rms, worst: the misses of the circle. Starts: how many of 100 random ones lead there."
    return f"### {task.title}\n\n" + "\n".join(rows) + f"\n\n{words}"


def cell(text):
    """A text in a cell of a table."""
    return re.sub(r"([|<>*_])", r"\\\1", " ".join(text.split()))


def message_pages():
    """Pages of messages by name, an anchor for each code; a family of many fills several."""
    text = files("burmester.io").joinpath("messages.md").read_text(encoding="utf-8")
    text = re.sub(r"(?ms)^```\n(.*?)^```$", r"```text\n\1```", text)
    pages, rows = {}, ["| code | what it says |", "|---|---|"]
    for family in re.split(r"(?m)^(?=# )", text)[1:]:
        head, *messages = re.split(r"(?m)^(?=## [A-Z]\d{3} )", family)
        title = head.strip().removeprefix("# ")
        rows.append(f"| **{title}** | |")
        for part in parts_of(messages, MOST_WORDS):
            codes = [CODE.match(each) for each in part]
            first, last = codes[0][1], codes[-1][1]
            span = first if first == last else f"{first} to {last}"
            anchored = "".join(
                f"({code[1]})=\n{each}" for code, each in zip(codes, part, strict=True)
            )
            pages[first.lower()] = f"# {title}, {span}\n\n{anchored}"
            rows += [f"| [{code[1]}](#{code[1]}) | {cell(code[2])} |" for code in codes]
    pages["index"] = (
        "# Every message\n\n"
        "Errors begin with E, warnings with W, results with R. `burmester explain CODE` prints "
        "the same.\n\n" + "\n".join(rows) + "\n\n"
        "```{toctree}\n:hidden:\n\n" + "\n".join(pages) + "\n```\n"
    )
    return pages


def parts_of(texts, most):
    """Texts in order, in parts of at most so many words, about as long as each other."""
    sizes = [len(each.split()) for each in texts]
    even = sum(sizes) / math.ceil(sum(sizes) / most)
    parts, words = [[]], 0
    for size, each in zip(sizes, texts, strict=True):
        if parts[-1] and words + size / 2 > even * len(parts):
            parts.append([])
        parts[-1].append(each)
        words += size
    return parts


def schema_page():
    """The JSON schema as tables: each key with its type and what it holds."""
    schema = json.loads(
        files("burmester.io").joinpath("synthesis.schema.json").read_text(encoding="utf-8")
    )
    parts = [
        "# The JSON schema",
        "What `burmester synthesize POSES --json` prints. Keys may be added, none goes away. "
        "The schema itself: [synthesis.schema.json](synthesis.schema.json). "
        "`!`: the key is always there.",
        "## The object",
        table_of(schema),
    ]
    for name, part in schema["$defs"].items():
        if "properties" in part:
            parts += [f"## {name}", table_of(part)]
    return "\n\n".join(parts) + "\n"


def table_of(part):
    """The keys of an object."""
    rows = ["| key | type | |", "|---|---|---|"]
    for key, each in part["properties"].items():
        always = "!" if key in part.get("required", ()) else ""
        rows.append(f"| `{key}` {always} | {type_of(each)} | {cell(each.get('$comment', ''))} |")
    return "\n".join(rows)


def type_of(part):
    """A type in words, with a link where the page describes it."""
    if "$ref" in part:
        name = part["$ref"].rpartition("/")[2]
        return f"{name}" if name in PLAIN else f"[{name}](#{name})"
    if "enum" in part:
        return ", ".join(f"`{json.dumps(each)}`" for each in part["enum"])
    if "const" in part:
        return f"`{json.dumps(part['const'])}`"
    if "anyOf" in part or "oneOf" in part:
        return " or ".join(map(type_of, part.get("anyOf", part.get("oneOf"))))
    kinds = part.get("type", "any")
    kinds = [kinds] if isinstance(kinds, str) else kinds
    text = " or ".join(kinds)
    if "array" in kinds and "items" in part:
        text = text.replace("array", f"array of {type_of(part['items'])}")
    if "object" in kinds and "properties" in part:
        text += ": " + ", ".join(f"`{key}`" for key in part["properties"])
    return text


SCHEMA = json.loads(files("burmester.io").joinpath("synthesis.schema.json").read_text("utf-8"))
PLAIN = {name for name, part in SCHEMA["$defs"].items() if "properties" not in part}


def functions_page(functions):
    """The functions of formulas and methods that have no short name."""
    head = (
        "# Functions behind the theory\n\n"
        "The functions that compute the formulas of [the theory](../mathematics/index.md), and the "
        "solvers. What is imported with `import burmester` alone stands on "
        "[its own page](api.md).\n"
    )
    by_module = {}
    for each in functions:
        _, room, module, *_ = each.split(".")
        by_module.setdefault(f"burmester.{room}.{module}", []).append(each)
    for module, names in sorted(by_module.items()):
        head += f"\n## {module.removeprefix('burmester.')}\n\n```{{eval-rst}}\n"
        for each in sorted(names):
            rest = each.removeprefix(module + ".")
            word = (
                "automethod"
                if "." in rest
                else "autoclass"
                if rest[0].isupper()
                else "autofunction"
            )
            head += f".. {word}:: {each}\n"
        head += "```\n"
    return head


def paper_page(pictures: Path):
    """The paper's numbers beside ours, and its figures drawn again."""
    pictures.mkdir(parents=True)
    for path in write_figures(pictures, formats=("png",)):
        Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)
    parts = [
        "# The paper, number by number",
        "Each printed number of Ge, Zhao, Purwar and Li (2012) beside the computed one, as "
        "`burmester reproduce` prints them. *Spread*: the least and the greatest value over copies "
        "of the poses drawn within the rounding of the print. [The paper, checked](../paper.md) "
        "says what comes of it.",
        "## Its figures, drawn again",
    ]
    for name in NAMES:
        title = name.replace("-", " ").capitalize()
        parts.append(f'### {title}\n\n<img src="paper/{name}.png" width="460" alt="{title}">')
    parts.append("## Its numbers")
    for section in reproduce():
        rows = ["| | print | computed | spread | |", "|---|--:|--:|--:|---|"]
        for row in section.rows:
            cells = [cell(each) for each in row.cells()]
            rows.append("| " + " | ".join(cells) + " |")
        notes = [f"- {row.item}: {cell(row.note)}" for row in section.rows if row.note]
        parts += [f"### {section.title}", "\n".join(rows) if section.rows else ""]
        parts += ["\n".join(notes), *section.remarks]
    parts += ["## Five methods", *map(methods_table, side_by_side())]
    return "\n\n".join(part for part in parts if part) + "\n"
