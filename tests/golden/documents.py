"""Scenes played: what their commands print, and the files that they leave."""

import io
import math
import os
import shlex
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest.mock import patch

import pyarrow.parquet as pq

from burmester import cli
from burmester.cli import batch_progress
from tests.golden.commands import Scene
from tests.golden.fingerprint import as_text


def played(scene: Scene, folder: Path) -> Iterator[tuple[str, str]]:
    """The documents of a scene, with their names, from commands that are run in an empty folder."""
    for name, content in scene.files.items():
        text = content.read_text() if isinstance(content, Path) else content
        (folder / name).write_text(text)
    known = set(scene.files)
    with _inside(folder):
        for line in scene.lines:
            yield line, _printed(line)
            new = sorted(each for each in folder.rglob("*") if each.is_file())
            for path in new:
                name = str(path.relative_to(folder))
                if name not in known and not path.name.startswith("_"):
                    yield f"{line} > {name}", _text(path)
                known.add(name)


def _printed(line: str) -> str:
    out, err, code = io.StringIO(), io.StringIO(), None
    # How often a batch says how far it is depends on the load of the machine.
    silent = patch.object(batch_progress, "PERIOD_S", math.inf)
    with redirect_stdout(out), redirect_stderr(err), silent:
        try:
            cli.main(shlex.split(line))
        except SystemExit as end:
            code = end.code
    return f"exit code {code}\n{out.getvalue()}{err.getvalue()}"


def _text(path: Path) -> str:
    if path.suffix == ".parquet":
        return "\n".join(str(row) for row in pq.read_table(path).to_pylist())
    return as_text(path.name, path.read_bytes())


@contextmanager
def _inside(folder: Path) -> Iterator[None]:
    before, width = Path.cwd(), os.environ.get("COLUMNS")
    os.chdir(folder)
    os.environ["COLUMNS"] = "80"
    try:
        yield
    finally:
        os.chdir(before)
        os.environ.pop("COLUMNS")
        if width is not None:
            os.environ["COLUMNS"] = width
