"""The same linkage gives the same bytes: again, in another process, later, by another hash."""

import os
import subprocess
import sys

from burmester.export import FORMATS
from tests.samples import EVERY

WRITE = """
import sys, time
from importlib import import_module
from pathlib import Path
now = time.time
time.time = lambda: now() + float(sys.argv[1])
from burmester.export import FORMATS, Options
from tests.oracles.handed_over import saved
chosen = saved("crank-rocker, mm")
small = Options(seconds=0.2, frames_per_second=10, width_px=200)
for to, form in [*FORMATS.items()] * int(sys.argv[3]):  # not read back as `export` does
    module = import_module(f"burmester.export.{form.module}")
    write = getattr(module, f"write_{to}", None) or module.write
    write(chosen, Path(sys.argv[2], f"{to}{form.suffix}"), small)
"""


def written(folder, later, zone, seed, times=1):
    """The bytes of a file of each format, written so many times by a process of its own."""
    folder.mkdir()
    env = {**os.environ, "TZ": zone, "PYTHONHASHSEED": str(seed)}
    command = [sys.executable, "-c", WRITE, str(later), str(folder), str(times)]
    done = subprocess.run(command, env=env, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return {each.name: each.read_bytes() for each in folder.iterdir()}


def test_every_format_has_the_same_bytes_whenever_it_is_written(tmp_path):
    first = written(tmp_path / "first", 0, "UTC", 1)
    assert len(first) == len(FORMATS)
    again = written(tmp_path / "again", 4e7, "Asia/Tokyo", 4, times=2 if EVERY else 1)
    assert [name for name in first if again[name] != first[name]] == []
