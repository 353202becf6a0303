"""scripts/setup with a Python that only notes what it is told: when it installs, repairs, goes on.

Nothing is installed, nothing fetched.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
KERNEL = "src/burmester/numerics/soft_program_kernel.py"
NEEDED = (
    "pyproject.toml", "hatch_build.py", "requirements.lock", "requirements-dev.lock",
    "src/burmester/__init__.py", KERNEL,
)  # fmt: skip

# Makes a .venv with itself as Python, and notes every call of pip; FAILS: names that a file of
# requirements must not have; KILLED: the call of pip by which the script is killed.
PYTHON = f"""\
#!/usr/bin/env bash
case "$1 $2" in
  "-c "*) [ -z "$OLD" ] || exit 1
    echo "3 ${{MINOR:-11}} $(cd "$(dirname "$0")/.." && pwd)" ;;
  "-m venv") [ -z "$NO_VENV" ] || exit 1
    mkdir -p .venv/bin && cp "$0" .venv/bin/python && echo venv >> calls ;;
  "-m pip") echo "${{@:$#}}" >> calls
    [ -z "$KILLED" ] || kill -KILL $PPID
    [ -z "$FAILS" ] || ! grep -qE "^($FAILS)==" "${{@:$#}}" ;;
  *) exec {sys.executable} "$@" ;;
esac
"""

MAIN = ["venv", "requirements.lock", "."]
PART = ".venv/part.txt"


@pytest.fixture
def setup(tmp_path):
    """Run scripts/setup; what came of it, and the calls since the last time."""
    folder = tmp_path / "a project"
    (folder / KERNEL).parent.mkdir(parents=True)
    for name in NEEDED:
        shutil.copy(ROOT / name, folder / name)
    shutil.copytree(ROOT / "scripts", folder / "scripts")
    python = tmp_path / "python3"
    python.write_text(PYTHON)
    python.chmod(0o755)

    def setup(*arguments, **environment):
        calls = setup.folder / "calls"
        calls.unlink(missing_ok=True)
        path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
        kept = {name: os.environ[name] for name in os.environ if name != "PYTHON"}
        done = subprocess.run(
            [setup.folder / "scripts" / "setup", *arguments],
            env=kept | {"PATH": path} | environment,
            capture_output=True,
            text=True,
            check=False,
        )
        return done, calls.read_text().splitlines() if calls.exists() else []

    setup.folder = folder
    return setup


def test_once_and_no_more(setup):
    assert setup()[1] == MAIN
    done, calls = setup()
    assert (done.returncode, done.stderr, calls) == (0, "", [])


def test_the_rest_comes_on_top(setup):
    setup()
    assert setup("dev")[1] == [PART, PART]
    assert setup("dev")[1] == setup()[1] == []
    assert setup("docs")[1] == [PART]
    assert setup("docs")[1] == []


def test_a_changed_lock_is_installed_into_the_same_place(setup):
    setup("dev")
    with open(setup.folder / "requirements-dev.lock", "a") as lock:
        lock.write("# more\n")
    assert setup()[1] == []
    assert setup("dev")[1] == [PART, PART]


def test_a_changed_version_is_installed(setup):
    setup()
    (setup.folder / "src/burmester/__init__.py").write_text('__version__ = "9.9.9"\n')
    assert setup()[1] == MAIN[1:]


def test_a_changed_kernel_is_compiled(setup):
    setup()
    with open(setup.folder / KERNEL, "a") as kernel:
        kernel.write("# more\n")
    assert setup()[1] == MAIN[1:]
    assert setup()[1] == []


@pytest.mark.parametrize("part", ["", "dev"])
def test_half_an_installation_is_made_anew(setup, part):
    setup()
    with open(setup.folder / "requirements-dev.lock", "a") as lock:
        lock.write("# more\n")
    if not part:
        (setup.folder / ".venv/main").unlink()
    done, calls = setup(*part.split(), KILLED="1")
    assert done.returncode == -9
    assert len(calls) == 1
    assert setup()[1] == MAIN


def test_a_moved_folder_and_a_lost_python_are_made_anew(setup):
    setup()
    setup.folder = setup.folder.rename(setup.folder.parent / "elsewhere")
    assert setup()[1] == MAIN
    (setup.folder / ".venv/bin/python").unlink()
    assert setup()[1] == MAIN


def test_another_python_makes_it_anew_only_if_asked_for(setup, tmp_path):
    setup()
    other = tmp_path / "other"
    other.write_text(PYTHON.replace("MINOR:-11", "MINOR:-12"))
    other.chmod(0o755)
    assert setup(PYTHON=str(other))[1] == MAIN
    assert setup(PYTHON=str(other))[1] == setup()[1] == []


def test_a_python_that_is_too_old_is_refused(setup, tmp_path):
    done, calls = setup(OLD="1")
    assert (done.returncode, calls) == (2, [])
    assert "Python 3.11 or newer is needed" in done.stderr


def test_no_venv_module(setup):
    done, calls = setup(NO_VENV="1")
    assert (done.returncode, calls) == (2, [])
    assert "apt-get install python3-venv" in done.stderr
    assert not (setup.folder / ".venv").exists()


def test_what_cannot_be_had_is_left_out_and_told(setup):
    done, calls = setup("dev", FAILS="mujoco|atheris")
    # One by one after all at once.
    assert calls == [*MAIN, *[PART] * 8]
    assert done.returncode == 0
    assert "not installed: atheris mujoco (" in done.stderr
    assert setup("dev")[1] == []


def test_what_is_required_is_required(setup):
    done, calls = setup("dev", FAILS="pytest")
    assert done.returncode == 1
    assert calls == [*MAIN, PART]
    # The demo needs none of it.
    assert setup(FAILS="pytest")[0].returncode == 0
