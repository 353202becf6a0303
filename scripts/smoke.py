"""Try the burmester that is installed for this Python, in an empty folder: python scripts/smoke.py

It answers to a table of poses, and runs one of each command that reads data carried in the package.
"""

import os
import subprocess
import sys
import tempfile
from contextlib import chdir
from importlib import metadata, resources
from pathlib import Path

import burmester
from burmester.io.saved import read_result

POSES = (Path(__file__).parents[1] / "examples" / "poses.csv").read_bytes()
COMMAND = Path(sys.executable).with_name("burmester" + ".exe" * (os.name == "nt"))


def run(*words, codes=(0,)):
    """What a command prints; it has to end with one of some codes."""
    done = subprocess.run([COMMAND, *words], capture_output=True, check=False)
    if done.returncode not in codes:
        told = (done.stdout + done.stderr).decode(errors="replace")
        sys.exit(f"smoke: burmester {' '.join(words)} ended with {done.returncode}\n{told}")
    return done.stdout.decode(errors="replace")


def main():
    """Try the commands, and look at what is installed."""
    Path("poses.csv").write_bytes(POSES)
    print(run("--version").strip())
    answer = run("synthesize", "poses.csv")
    assert answer.startswith("L1, a crank-rocker"), answer
    print(answer.partition("\n")[0])
    run("synthesize", "poses.csv", "--fixed-pivot", "box:-4,-2:4,4")  # start_points.npz
    run("check", "poses.csv", codes=(0, 1))
    run("cases", "ge2012-exact")
    run("explain", "E103")
    run("new", "gripper", "-o", "gripper.toml")
    run("synthesize", "gripper.toml", "-o", "result.json")
    run("export", "result.json", "-o", "one.json")
    run("report", "poses.csv", "-o", "page.html")

    files = resources.files("burmester")
    assert metadata.version("burmester") == burmester.__version__
    assert (files / "io" / "synthesis.schema.json").is_file()
    assert (files / "py.typed").is_file()
    assert read_result("result.json").choose().usable


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        main()
