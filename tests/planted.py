"""Plant known faults, one at a time, and see a test turn red: python -m tests.planted [WORD ...].

`planted.toml` lists them: what is wrong, the file below src/burmester, the text that is there and
what takes its place, and the test that has to notice.  The sources are not touched, as the tests
run on a copy of them.  With words only those faults are planted whose file or text has one.
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
    """One fault of the list."""

    what: str
    file: str
    old: str
    new: str
    test: str

    def planted(self) -> str:
        """The text of the file with the fault."""
        text = (PACKAGE / self.file).read_text()
        if text.count(self.old) != 1:
            raise ValueError(f"{self.file} has {text.count(self.old)} times: {self.old}")
        return text.replace(self.old, self.new)


def faults() -> list[Fault]:
    """The list."""
    listed = tomllib.loads(Path(__file__).with_suffix(".toml").read_text())["fault"]
    return [Fault(**each) for each in listed]


def run(fault: Fault) -> tuple[int, str]:
    """The exit code of pytest with a fault in the package, and the first test that failed."""
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder, "burmester")
        copytree(PACKAGE, package, copy_function=os.link)
        (package / fault.file).unlink()
        (package / fault.file).write_text(fault.planted())
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
        if words and not any(word in f"{fault.file} {fault.what}" for word in words):
            continue
        code, told = run(fault)
        missed += code != 1
        print(f"{'red ' if code == 1 else 'MISS'}  {fault.file}: {fault.what}", flush=True)
        if code != 1:
            print(told)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
