"""The same linkage gives the same bytes: again, in another process, later, by another hash."""

import os
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

from burmester.export import FORMATS, Options
from tests.oracles.handed_over import saved


def write(folder):
    """A file of each format; it is not read back as `export` does."""
    chosen = saved("crank-rocker, mm")
    small = Options(seconds=0.2, frames_per_second=10, width_px=200)
    for to, form in FORMATS.items():
        module = import_module(f"burmester.export.{form.module}")
        put = getattr(module, f"write_{to}", None) or module.write
        put(chosen, Path(folder, f"{to}{form.suffix}"), small)


LATER = f"import {__name__} as own; own.time.time = lambda: 3e9; own.write('.')"


def test_every_format_has_the_same_bytes_whenever_it_is_written(tmp_path):
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    write(here)
    root = Path(__file__).parents[2]
    env = {**os.environ, "TZ": "Asia/Tokyo", "PYTHONHASHSEED": "4", "PYTHONPATH": str(root)}
    command = [sys.executable, "-c", LATER]
    done = subprocess.run(command, cwd=there, env=env, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert time.time() < 3e9
    names = {each.name for each in here.iterdir()}
    assert len(names) == len(FORMATS)
    assert [n for n in names if (there / n).read_bytes() != (here / n).read_bytes()] == []
