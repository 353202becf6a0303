"""Inputs that are far too large end at once, within a gigabyte, and say why."""

import sys
from pathlib import Path

import pytest
from benchmarks.bounded import measured, of

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="peaks are counted as Linux does"),
]

PEAK = 1000.0  # megabytes


@pytest.mark.parametrize("name", ["1,000,000 poses", "3,000,000 rows", "a file of 1 GB"])
def test_a_large_input_is_refused_within_a_gigabyte(name):
    found = of(name)
    assert found.code == 2
    assert found.peak < PEAK


def test_a_million_poses_are_checked_within_a_gigabyte():
    found = of("1,000,000 poses, checked")
    assert found.code in (0, 1)
    assert found.peak < PEAK


def test_the_peak_is_that_of_the_command(tmp_path):
    """Held against a process whose memory is known."""
    Path(tmp_path, "burmester").mkdir()
    Path(tmp_path, "burmester", "__init__.py").touch()  # else the one that is installed is run
    Path(tmp_path, "burmester", "__main__.py").write_text("x = bytearray(b'1') * 300_000_000\n")
    assert 300 < measured([], tmp_path).peak < 400
