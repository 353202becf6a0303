"""The two locks agree, and a part cut from one holds all that it needs."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PINNED = re.compile(r"(?m)^([a-z0-9][a-z0-9._-]*)==(.*?) \\\n((?: +--hash=\S+(?: \\)?\n)+)")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
GROUPS = PROJECT["dependency-groups"]

SMALL = """\
# By uv.
alone==1.0 \\
    --hash=sha256:aa
    # via burmester (pyproject.toml:optional)
big==2.0 ; python_full_version < '3.12' \\
    --hash=sha256:bb
    # via
    #   burmester (pyproject.toml:dev)
    #   wide
big==3.0 ; python_full_version >= '3.12' \\
    --hash=sha256:cc
    # via
    #   burmester (pyproject.toml:dev)
    #   wide
deep==1.0 \\
    --hash=sha256:dd
    # via under
under==1.0 \\
    --hash=sha256:ee
    # via wide
wide==1.0 \\
    --hash=sha256:ff
    # via burmester (pyproject.toml:optional)
"""

WIDE = ["big==2.0", "big==3.0", "deep==1.0", "under==1.0", "wide==1.0"]


def pins(lock):
    """{(name, version with its marker): hashes} of a lock."""
    text = (ROOT / lock).read_text("utf-8")
    return {
        (name, version): frozenset(re.findall(r"sha256:[0-9a-f]{64}", hashes))
        for name, version, hashes in PINNED.findall(text)
    }


def entries(lock, *arguments):
    """What scripts/lock_entries.py prints, or its complaint."""
    command = [sys.executable, ROOT / "scripts" / "lock_entries.py", lock, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else done.stdout


def named(requirements):
    return {re.match(r"[\w-]+", each)[0] for each in requirements if isinstance(each, str)}


def test_every_pin_of_the_main_job_stands_in_the_full_lock():
    main, full = pins("requirements.lock"), pins("requirements-dev.lock")
    assert named(PROJECT["project"]["dependencies"]) <= {name for name, _ in main}
    assert {pin: full.get(pin) for pin in main} == main


@pytest.mark.parametrize("lock", ["requirements.lock", "requirements-dev.lock"])
def test_every_entry_has_its_hashes_and_no_address(lock):
    text = (ROOT / lock).read_text("utf-8")
    assert len(pins(lock)) == len(re.findall(r"(?m)^[a-z0-9]", text))
    assert all(pins(lock).values())
    assert "://" not in text


def test_the_main_job_waits_for_nothing_large():
    """Of all that is asked for beside the dependencies, the light lock has the builder alone."""
    main = {name for name, _ in pins("requirements.lock")}
    asked = set().union(*map(named, GROUPS.values()))
    assert main & asked == named(GROUPS["build"])


@pytest.mark.parametrize(
    ("arguments", "versions"),
    [
        (["dev"], ["big==2.0", "big==3.0"]),
        (["optional"], ["alone==1.0", *WIDE]),
        (["alone"], ["alone==1.0"]),
        (["wide"], WIDE),
    ],
)
def test_a_part_holds_what_it_needs(arguments, versions, tmp_path):
    lock = tmp_path / "small.lock"
    lock.write_text(SMALL)
    part = entries(lock, *arguments)
    assert re.findall(r"(?m)^\w+==[0-9.]+", part) == versions
    # Entries are whole, in the words of the lock.
    assert part.count("--hash") == len(versions)
    assert all(each in SMALL for each in re.split(r"(?m)^(?=\w)", part))


def test_names_of_a_group_and_a_name_that_is_none(tmp_path):
    lock = tmp_path / "small.lock"
    lock.write_text(SMALL)
    assert entries(lock, "optional", "--names").split() == ["alone", "wide"]
    assert "neither a group nor a package 'none'" in entries(lock, "none")


def test_the_parts_are_the_full_lock():
    """What setup installs in parts is all of it, and nothing optional is in the required part."""
    lock = ROOT / "requirements-dev.lock"
    dev, optional, docs = (entries(lock, group) for group in ("dev", "optional", "docs"))
    names = {name for name, _ in pins("requirements-dev.lock")}
    in_dev = set(re.findall(r"(?m)^([a-z0-9][\w.-]*)==", dev))
    in_optional = set(re.findall(r"(?m)^([a-z0-9][\w.-]*)==", optional))
    in_docs = set(re.findall(r"(?m)^([a-z0-9][\w.-]*)==", docs))
    main = {name for name, _ in pins("requirements.lock")}
    assert in_dev | in_optional | in_docs | main == names
    assert named(GROUPS["docs"]) <= in_docs
    assert named(GROUPS["optional"]) <= in_optional
    assert not named(GROUPS["optional"]) & in_dev
