"""Plant known faults, one at a time, and see a test turn red: python -m tests.planted [WORD ...].

`planted.toml` lists them: what is wrong, the room of src/burmester, the text that is there and what
takes its place, and the test that has to notice.  The sources are not touched, as the tests
run on a copy of them.  With words only those faults are planted whose room or text has one.
"""

import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from shutil import copytree
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "burmester"


class Fault(NamedTuple):
    """One fault of the list: a text that one file of a room has once, and what takes its place."""

    what: str
    room: str
    old: str
    new: str
    test: str

    def planted(self) -> tuple[Path, str]:
        """The file, from the package on, and its text with the fault."""
        texts = {file: file.read_text() for file in sorted((PACKAGE / self.room).rglob("*.py"))}
        found = [file for file, text in texts.items() for _ in range(text.count(self.old))]
        if len(found) != 1:
            raise ValueError(f"{self.room} has {len(found)} times: {self.old}")
        (file,) = found
        return file.relative_to(PACKAGE), texts[file].replace(self.old, self.new)


def faults() -> list[Fault]:
    """The list."""
    listed = tomllib.loads(Path(__file__).with_suffix(".toml").read_text())["fault"]
    return [Fault(**each) for each in listed]


def run(fault: Fault) -> tuple[int, str]:
    """The exit code of pytest with a fault in the package, and the first test that failed."""
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder, "burmester")
        copytree(PACKAGE, package, copy_function=os.link)
        file, text = fault.planted()
        (package / file).unlink()
        (package / file).write_text(text)
        words = ("-q", "-x", "--tb=no", "-p", "no:cacheprovider", "--color=no")
        done = subprocess.run(
            [sys.executable, "-m", "pytest", *words, *fault.test.split()],
            cwd=ROOT,
            env={**os.environ, "PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
    failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
    return done.returncode, failed[0] if failed else done.stdout[-500:] + done.stderr[-500:]


def main() -> int:
    """Print each fault with what came of it; 1 where a test stayed green."""
    words, missed = sys.argv[1:], 0
    for fault in faults():
        if words and not any(word in f"{fault.room}/ {fault.what}" for word in words):
            continue
        code, told = run(fault)
        missed += code != 1
        print(f"{'red ' if code == 1 else 'MISS'}  {fault.room}: {fault.what}", flush=True)
        if code != 1:
            print(told)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
