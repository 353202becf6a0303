"""scripts/release on a small project with the description of this one: what it makes and refuses.

Nothing is compiled, installed or fetched: pip, auditwheel and the trial only note what they do.
"""

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COPIED = ("LICENSE", "README.md", ".gitignore", "scripts/release", "src/burmester/__init__.py")
HOOK = "[tool.hatch.build.targets.wheel.hooks.custom]"
FOLDERS = ("widget", "studio", "notebook", "assets")  # of the page; the last one is handed out

PYTHON = f"""#!/usr/bin/env bash
case "$1 $2" in
  "-m venv") mkdir -p "$3/bin" && cp "$0" "$3/bin/python" ;;
  "-m pip") echo "pip ${{*: -1}}" >> calls ;;
  "scripts/smoke.py ") echo "tried" >> calls; [ "$FAULT" != trial ] ;;
  *) exec {sys.executable} "$@" ;;
esac
"""
HATCHLING = f"""#!/usr/bin/env bash
[ "$FAULT" != more ] || echo > src/burmester/more.py
{sys.executable} -m hatchling "$@" || exit
[ "$FAULT" != bytes ] || ! [ -f dist/*.tar.gz ] || echo more >> dist/*.tar.gz
"""
AUDITWHEEL = """#!/usr/bin/env bash
[ "$1 $2" = "repair --wheel-dir" ] && [ "$FAULT" != audit ] || exit 1
mkdir -p "$3" && cp "$4" "$3/$(basename "$4" any.whl)manylinux_2_28_x86_64.whl"
"""


@pytest.fixture
def project(tmp_path):
    """A committed project that can be released."""
    folder = tmp_path / "a project"
    description = (ROOT / "pyproject.toml").read_text("utf-8")
    assert HOOK in description
    files = {
        "pyproject.toml": description.replace(HOOK, "[tool.of-no-use]"),
        "CHANGELOG.md": "## 0.1.0 (unreleased)\n",
        "requirements.lock": "",
        "scripts/smoke.py": "",
        "scripts/setup": "#!/bin/sh\n",
        ".venv/bin/python": PYTHON,
        ".venv/bin/hatchling": HATCHLING,
        ".venv/bin/auditwheel": AUDITWHEEL,
        **{f"src/burmester/web/{each}/a.mjs": "" for each in FOLDERS},
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
        if text.startswith("#!"):
            (folder / name).chmod(0o755)
    for name in COPIED:
        shutil.copy(ROOT / name, folder / name)
    git(folder, "init", "--quiet")
    commit(folder)
    return folder


def git(folder, *words):
    who = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *who, *words], cwd=folder, check=True)


def commit(folder):
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--message", "as it is")


def release(folder, fault=""):
    """What came of scripts/release, and what it had done by pip and in trials."""
    calls = folder / "calls"
    calls.unlink(missing_ok=True)
    (folder / ".git/info/exclude").write_text("calls\n")
    done = subprocess.run(
        [folder / "scripts/release"],
        env=os.environ | {"FAULT": fault},
        capture_output=True,
        text=True,
        check=False,
    )
    return done, calls.read_text().splitlines() if calls.exists() else []


def test_what_is_committed_is_built_compared_and_tried(project):
    done, calls = release(project)
    assert done.returncode == 0, done.stderr
    assert "A rehearsal, and all is well" in done.stdout
    sdist, wheel = project / "dist" / "burmester-0.1.0.tar.gz", next(project.glob("dist/*.whl"))
    assert len(list((project / "dist").iterdir())) == 2
    assert ("manylinux" in wheel.name) == (sys.platform == "linux")
    assert calls == [f"pip {wheel}", "tried", "pip requirements.lock", f"pip {sdist}", "tried"]
    with zipfile.ZipFile(wheel) as held, tarfile.open(sdist) as all_held:
        pages = [name for name in held.namelist() if name.endswith(".mjs")]
        every = [name for name in all_held.getnames() if name.endswith(".mjs")]
    assert pages == ["burmester/web/assets/a.mjs"]  # bundles; their sources are in the sdist
    assert len(every) == len(FOLDERS)
    first = sdist.read_bytes()
    assert release(project)[0].returncode == 0
    assert sdist.read_bytes() == first


@pytest.mark.parametrize(
    ("fault", "told", "tries"),
    [
        ("bytes", "the sdist is another one", 0),
        ("more", "the wheel (>) is not what is committed (<)", 0),
        ("trial", "what was installed from the wheel does not work", 1),
        pytest.param(
            "audit",
            "no wheel for other machines",
            0,
            marks=pytest.mark.skipif(sys.platform != "linux", reason="of Linux"),
        ),
    ],
)
def test_what_is_not_as_it_should_be_is_refused(project, fault, told, tries):
    done, calls = release(project, fault)
    assert done.returncode == 2
    assert told in done.stderr
    assert calls.count("tried") == tries


def test_what_is_not_ready_is_refused(project):
    (project / "CHANGELOG.md").write_text("## 0.0.9 (2026-01-31)\n")
    assert "not committed" in release(project)[0].stderr
    commit(project)
    done, _ = release(project)
    assert (done.returncode, done.stdout) == (2, "")
    assert 'no entry "## 0.1.0 (date)"' in done.stderr
    (project / "CHANGELOG.md").write_text("## 0.1.0 (2026-01-31)\n")
    commit(project)
    assert "git tag -a v0.1.0" in release(project)[0].stdout
