"""The same linkage gives the same bytes: in another process, at another time, by another hash."""

import os
import subprocess
import sys

import pytest

from burmester.export import FORMATS

WRITE = """
import sys, time
now = time.time
time.time = lambda: now() + float(sys.argv[1])
from burmester.export import FORMATS, Options, export
from tests.oracles.handed_over import saved
small = Options(seconds=0.2, frames_per_second=10, width_px=200)
for to in sys.argv[3:]:
    export(saved("crank-rocker, mm"), to, f"{sys.argv[2]}/{to}{FORMATS[to].suffix}", small)
"""
SOLID = [name for name, form in FORMATS.items() if form.extra == "solid"]
PLAIN = [name for name in FORMATS if name not in SOLID]


def written(folder, formats, later, zone, seed):
    """The bytes of a file of each format, written by a process of its own."""
    folder.mkdir()
    env = {**os.environ, "TZ": zone, "PYTHONHASHSEED": str(seed)}
    command = [sys.executable, "-c", WRITE, str(later), str(folder), *formats]
    done = subprocess.run(command, env=env, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return {each.name: each.read_bytes() for each in folder.iterdir()}


@pytest.mark.slow
@pytest.mark.parametrize("formats", [PLAIN, SOLID], ids=["plain", "solid"])
def test_every_format_has_the_same_bytes_whenever_it_is_written(formats, tmp_path):
    first = written(tmp_path / "first", formats, 0, "UTC", 1)
    assert len(first) == len(formats)
    for seed in (2, 4):
        again = written(tmp_path / f"again{seed}", formats, 4e7, "Asia/Tokyo", seed)
        assert [name for name in first if again[name] != first[name]] == []
