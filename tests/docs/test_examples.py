"""README.md and docs/**/*.md show what happens: each of their blocks is run or read here.

The blocks of one document are run in their order, in one folder with a copy of `examples/`.

- ```console: commands behind `$ `, run by bash, and what they print: standard output, then standard
  error.  A line `...` stands for any lines; a command with nothing below it must only succeed.
  What sets up (`pip`, `git`, `cd`, `scripts/...`) is not run; its scripts and extras must exist.
- ```python: a session with `>>>` is run as a doctest, other Python must compile.  One session a
  document.
- ```toml and ```json must be read; a TOML block without poses is read as part of a task.
- ```text: commands and options of `burmester` that stand in it must exist, and so must those that
  prose names.
- ```{code-cell}: cells of notebooks, which `test_notebooks.py` runs.

Three hidden lines help: `<!-- $ COMMAND -->` runs a command that no reader sees (a file that the
next block needs); `<!-- file: NAME -->` before a block puts its text into a file; and
`<!-- not run: REASON -->` before a block leaves it out.
"""

import doctest
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest

import burmester
from tests import command
from tests.oracles.markdown import Block, Command, Document, commands, matches

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]
SETTING_UP = ("pip ", "git ", "cd ", "source ", "python -m venv ", "python -m pip ", "scripts/")
OPTIONAL = (
    "build123d",
    "ezdxf",
    "flint",
    "imageio_ffmpeg",
    "matplotlib",
    "pyarrow",
    "pypdf",
    "PIL",
)
OF_ITS_OWN = {"batch", "reproduce", "studio"}  # commands that start processes, or wait
SHELL = re.compile(r"[|&;<>$`*~\n]")  # what a shell may have to do with
ERROR = re.compile(r"^error(\[|:)", re.MULTILINE)


@pytest.fixture(scope="session")
def shims(tmp_path_factory):
    """A folder whose `burmester` and `python` are those under test."""
    folder = tmp_path_factory.mktemp("bin")
    for name, arguments in (("burmester", "-m burmester "), ("python", "")):
        file = folder / name
        file.write_text(f'#!/bin/sh\nexec "{sys.executable}" {arguments}"$@"\n')
        file.chmod(0o755)
    return folder


def run(text, shims, folder):
    """A line of a shell.  Where it is a command alone, what it solves is solved once for all."""
    words = shlex.shlex(re.sub(r"\s# .*", "", text), posix=True, punctuation_chars=True)
    words.whitespace_split, words.commenters = True, ""
    program, *arguments = words
    if program == "burmester" and arguments[0] not in OF_ITS_OWN and not SHELL.search(text):
        assert Path.cwd() == folder
        return command.run(*arguments)
    environment = {**os.environ, "PATH": f"{shims}{os.pathsep}{os.environ['PATH']}"}
    environment.pop("COLUMNS", None)
    return subprocess.run(
        ["bash", "-c", text],
        cwd=folder,
        env=environment,
        capture_output=True,
        encoding="utf-8",
        stdin=subprocess.DEVNULL,
        timeout=120,
        check=False,
    )


def trouble_of_set_up(text):
    """What a command that sets up names and is not there."""
    word = text.split()[0]
    if word.startswith("scripts/") and not os.access(ROOT / word, os.X_OK):
        return f"{word} is no script"
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = extras["optional-dependencies"]
    for group in re.findall(r"(?:\.|burmester)\[([\w,]+)\]", text):
        if missing := set(group.split(",")) - set(extras):
            return f"no extra {missing}"
    return None


def trouble(each: Command, shims, folder):
    """What is wrong with a command of a document, or None."""
    if each.text.startswith(SETTING_UP):
        return trouble_of_set_up(each.text)
    done = run(each.text, shims, folder)
    printed = [line.rstrip() for line in (done.stdout + done.stderr).rstrip().splitlines()]
    if "pip install" in done.stderr and not all(map(find_spec, OPTIONAL)):
        return None  # an extra that this machine has no wheel for
    shown = list(each.shown)
    while shown and not shown[-1]:
        shown.pop()
    expected = (2,) if ERROR.search("\n".join(shown)) else (0, 1)
    if done.returncode not in expected:
        return f"exit code {done.returncode}:\n{done.stdout}{done.stderr}"
    if shown and not matches(shown, printed):
        return "prints\n" + "\n".join(printed)
    return None


def session_of(block: Block, name, namespace):
    """What a Python block's examples do otherwise than it shows, or None."""
    if ">>>" not in block.text:
        compile(block.text, name, "exec")
        return None
    told: list[str] = []
    test = doctest.DocTestParser().get_doctest(block.text, namespace, name, name, block.line - 1)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(test, out=told.append, clear_globs=False)
    namespace.update(test.globs)  # the parser made a copy
    return "".join(told) or None


def read_toml(block: Block, folder):
    """What a TOML block is refused for, or None."""
    text = block.text
    if "poses" not in tomllib.loads(text):
        rows = (ROOT / "examples" / "poses.csv").read_text().splitlines()[3:]
        poses = ", ".join(f"[{row}]" for row in rows)
        text = f'angle_unit = "deg"\nposes = [{poses}]\n{text}'
    file = folder / f"line-{block.line}.toml"
    file.write_text(text)
    try:
        burmester.read_task(file)
    except burmester.BurmesterError as error:
        return str(error)
    finally:
        file.unlink()
    return None


def troubles(document: Document, shims, folder, monkeypatch):
    """Each block that does otherwise than it says, by its line."""
    monkeypatch.chdir(folder)
    namespace: dict[str, object] = {}
    wrong = []
    for block in document.blocks:
        mark, rest = block.comment or (None, "")
        if mark == "not run":
            assert rest, f"line {block.line}: not run, and no reason is given"
            continue
        if mark == "file":
            (folder / rest).write_text(block.text, encoding="utf-8")
        told = None
        if block.kind == "console":
            for each in commands(block):
                if told := trouble(each, shims, folder):
                    wrong.append(f"line {each.line}: {each.text}\n{told}")
            continue
        if block.kind == "python":
            told = session_of(block, "document", namespace)
        elif block.kind == "toml" and mark != "file":
            told = read_toml(block, folder)
        elif block.kind == "json":
            json.loads(block.text)
        if told:
            wrong.append(f"line {block.line}: {told}")
    return wrong


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    return tmp_path


def shows_something(name):
    """Whether a page has blocks to run or read."""
    read = {"console", "python", "toml", "json"}
    return not read.isdisjoint(block.kind for block in Document.of(ROOT / name).blocks)


@pytest.mark.parametrize("name", list(filter(shows_something, NAMES)))
def test_every_block_does_what_it_shows(name, shims, folder, monkeypatch):
    wrong = troubles(Document.of(ROOT / name), shims, folder, monkeypatch)
    assert not wrong, "\n\n".join([f"{name}:", *wrong])


@pytest.fixture(scope="session")
def helps():
    """The help of each command by its name."""
    listed = command.run("--help").stdout.partition("Commands:")[2]
    names = re.findall(r"^  ([a-z]+) ", listed, re.MULTILINE)
    assert {"synthesize", "check"} <= set(names)
    return {name: command.run(name, "--help").stdout for name in names}


def options_of(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", text))


@pytest.mark.parametrize("name", NAMES)
def test_commands_and_options_that_a_document_names_exist(name, helps):
    document = Document.of(ROOT / name)
    for block in document.blocks:
        for line in block.text.splitlines():
            called = re.match(r"^(?:\$ )?burmester ([a-z]+)(.*?)(?:   .*|#.*)?$", line)
            if block.kind not in {"text", "console"} or not called:
                continue
            assert called[1] in helps, line
            assert options_of(called[2]) <= options_of(helps[called[1]]) | {"--help"}, line
    known = set().union(*map(options_of, helps.values()), {"--help", "--version"})
    for quoted in re.findall(r"`([^`\n]+)`", document.prose):
        if quoted.startswith(("--", "burmester ")):
            assert options_of(quoted) <= known, quoted
        if called := re.match(r"burmester ([a-z]+)\b(?![.=])", quoted):
            assert called[1] in helps, quoted


WRONG = {
    "output": ("```console\n$ echo one\ntwo\n```\n", "line 2: echo one\nprints\none"),
    "lines left out": ("```console\n$ echo one\n...\ntwo\n```\n", "prints\none"),
    "exit code": ("```console\n$ burmester check no-such-file.csv\n```\n", "exit code 2"),
    "no error": ("```console\n$ echo 'error: no'\nerror: no\n```\n", "exit code 0"),
    "hidden": ("<!-- $ false && true || exit 3 -->\n", "line 1: false"),
    "script": ("```console\n$ scripts/no-such-script\n```\n", "is no script"),
    "extra": ('```console\n$ pip install "burmester[none]"\n```\n', "no extra"),
    "continued": ("```console\n$ echo a \\\n> b\na\n```\n", "prints\na b"),
    "session": ("```python\n>>> 1 + 1\n3\n```\n", "Expected:\n    3\nGot:\n    2"),
    "two blocks": ("```python\n>>> x = 2\n```\n```python\n>>> x\n3\n```\n", "Got:\n    2"),
    "task": ("```toml\n[requirements]\nno_such_thing = 1\n```\n", "no_such_thing"),
    "file": (
        "<!-- file: a.txt -->\n```text\nhers\n```\n```console\n$ cat a.txt\nhis\n```\n",
        "prints\nhers",
    ),
}


@pytest.mark.parametrize(("text", "expected"), WRONG.values(), ids=WRONG)
def test_a_block_that_shows_something_else_is_told(text, expected, shims, folder, monkeypatch):
    """The reader itself can fail."""
    wrong = troubles(Document.of_text(text), shims, folder, monkeypatch)
    assert len(wrong) == 1
    assert expected in wrong[0]


RIGHT = """
<!-- file: task.toml -->
```toml
this = "is a task's business"
```

<!-- $ echo hidden > seen.txt -->
```console
$ cat seen.txt task.toml
...
this = "is a task's business"
$ echo one; echo two >&2; exit 1
one
two
```

<!-- not run: it would take a week -->
```console
$ no-such-command
```

```python
>>> import burmester
>>> burmester.__name__
'bur...'
```

```python
x = 1
```
"""


def test_blocks_that_show_what_happens_pass(shims, folder, monkeypatch):
    assert troubles(Document.of_text(RIGHT), shims, folder, monkeypatch) == []
    assert (folder / "seen.txt").read_text() == "hidden\n"


def test_a_line_to_install_an_extra_works_in_every_shell():
    """The Windows command prompt takes single quotes for a part of the name."""
    pages = [*(ROOT / "src").rglob("*.py"), *(ROOT / "src").rglob("*.md"), ROOT / "README.md"]
    pages += (ROOT / "docs").rglob("*.md")
    quoted = [
        (page.name, each)
        for page in pages
        for each in re.findall(r"pip install (\S)\S*\[", page.read_text(encoding="utf-8"))
    ]
    assert len(quoted) > 8
    assert {quote for _, quote in quoted} == {'"'}, quoted
