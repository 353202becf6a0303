"""What is handed out: one version, and archives that hold the sources and nothing else."""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest
from hatchling.builders.sdist import SdistBuilder
from hatchling.builders.wheel import WheelBuilder

from burmester import __version__

ROOT = Path(__file__).parents[2]
DATA = (
    "burmester/py.typed",
    "burmester/cases/ge2012-exact.json",
    "burmester/templates/gripper.toml",
    "burmester/io/synthesis.schema.json",
    "burmester/io/function.schema.json",
    "burmester/functions/start_points.npz",
    "burmester/io/messages.md",
    "burmester/polynomials/elimination_templates.npz",
    "burmester/polynomials/start_points.npz",
    "burmester/web/assets/page.html",
    "burmester/web/assets/widget.mjs",
)
# A stranger can set up, check and test with these, and the folders below.
TOP = (
    "ARCHITECTURE.md", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "README.md",
    "hatch_build.py", "pyproject.toml", "requirements.lock", "requirements-dev.lock",
)  # fmt: skip
COMPILED = (".so", ".pyd")
FOLDERS = ("src", "tests", "scripts", "benchmarks", "docs", "examples", ".ci", ".github")


def below(folder):
    """The files of a folder, without what Python, npm and the compiler leave there."""
    files = (each for each in (ROOT / folder).rglob("*") if each.is_file())
    return {
        each.relative_to(ROOT).as_posix()
        for each in files
        if not {"__pycache__", "node_modules"}.intersection(each.parts)
        and each.suffix not in COMPILED
    }


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """(wheel, sdist), as a release builds them."""
    folder = str(tmp_path_factory.mktemp("dist"))
    return [
        Path(next(builder(str(ROOT)).build(directory=folder, versions=["standard"])))
        for builder in (WheelBuilder, SdistBuilder)
    ]


def test_the_wheel_holds_the_package_and_nothing_else(built):
    with zipfile.ZipFile(built[0]) as wheel:
        held = [name for name in wheel.namelist() if ".dist-info/" not in name]
        entry = wheel.read(f"burmester-{__version__}.dist-info/entry_points.txt").decode()
    # The pages have their scripts in it as bundles, not as the modules these are made from.
    package = below("src/burmester") - below("src/burmester/web/widget")
    package -= below("src/burmester/web/studio")
    package -= below("src/burmester/web/notebook")
    kernels = [name for name in held if name.endswith(COMPILED)]
    plain = sorted(set(held).difference(kernels))
    assert plain == sorted(each.removeprefix("src/") for each in package)
    sources = [name for name in plain if name.endswith("_kernel.py")]
    assert [name.partition(".")[0] for name in sorted(kernels)] == [
        name.removesuffix(".py") for name in sources
    ]
    assert set(DATA) <= set(held)
    assert "burmester = burmester.__main__:main" in entry


def test_the_sdist_holds_all_that_tests_and_scripts_need(built):
    with tarfile.open(built[1]) as sdist:
        members = {each.name.partition("/")[2]: each for each in sdist.getmembers()}
    assert set(TOP) | set().union(*map(below, FOLDERS)) <= set(members)
    assert not [name for name in members if name.startswith((".venv", ".git/", "dist"))]
    assert members["scripts/test"].mode & 0o100


def test_the_version_has_one_source(built):
    wheel, sdist = (each.name for each in built)
    assert sdist == f"burmester-{__version__}.tar.gz"
    name, version, python, *_ = wheel.split("-")
    assert (name, version) == ("burmester", __version__)
    assert python == f"cp{sys.version_info.major}{sys.version_info.minor}"  # kernels are compiled
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert "version" not in project
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    assert re.findall(r"(?m)^version: (.*)$", citation) == [__version__]
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    newest = re.search(r"(?m)^## (\S+) \((?:unreleased|\d{4}-\d\d-\d\d)\)$", changes)
    assert newest[1] == __version__


def test_citation_names_the_paper_as_the_program_does():
    """The cases that the package carries say in their own words where they are from."""
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    paper = dict(re.findall(r'(?m)^    (\w+): "?(.*?)"?$', citation))
    case = (ROOT / "src/burmester/cases/ge2012-exact.json").read_text("utf-8")
    source = re.search(r"\((\d+)\), JCISE (\d+)\((\d+)\) (\d+)", case).groups()
    assert source == (paper["year"], paper["volume"], paper["issue"], paper["start"])
    names = re.findall(r"family-names: (\w+)", citation)
    assert f"{', '.join(names)} (2012)" in case
    mathematics = " ".join((ROOT / "docs/mathematics/index.md").read_text("utf-8").split())
    assert paper["title"] in mathematics
    assert paper["journal"] in mathematics


WITHOUT = """
import pathlib, tempfile, hatch_build
kernel = pathlib.Path("src/burmester/numerics/soft_program_kernel.py")
with tempfile.TemporaryDirectory() as folder:
    hatch_build.compiled({"burmester.numerics.soft_program_kernel": kernel}, pathlib.Path(folder))
"""


@pytest.mark.parametrize("compiler", ["/nonexistent/cc", "false"])
def test_without_a_compiler_the_kernels_say_what_is_needed(compiler):
    """Of an installation from source; there is no slower way round."""
    ran = subprocess.run(
        [sys.executable, "-c", WITHOUT],
        cwd=ROOT,
        env=os.environ | {"CC": compiler},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 1
    assert "a C compiler and Python's headers are needed" in ran.stderr
    assert "or else a wheel" in ran.stderr
    assert "Traceback" not in ran.stderr


def test_what_a_release_is_tried_with_passes_here():
    """It reads answers as they are printed now."""
    command = [sys.executable, ROOT / "scripts" / "smoke.py"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_workflows_run_these_scripts_with_pinned_actions_on_every_python():
    """The wheels are for the Pythons that are tested, from the oldest that is allowed."""
    texts = [each.read_text("utf-8") for each in (ROOT / ".github/workflows").glob("*.yml")]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    run = {each for text in texts for each in re.findall(r"run: (\S+)", text)}
    assert {"scripts/check", "scripts/test", "scripts/release"} <= run
    assert all(os.access(ROOT / each, os.X_OK) for each in run)
    used = [each for text in texts for each in re.findall(r"uses: (\S+)", text)]
    assert all(re.fullmatch(r"[\w-]+/[\w-]+@v\d+\.\d+\.\d+", each) for each in used)
    (tested,) = (m for text in texts for m in re.findall(r"python: \[(.*)\]", text))
    minors = re.findall(r'"3\.(\d+)"', tested)
    wheels = project["tool"]["cibuildwheel"]["build"]
    assert wheels == f"cp31[{minors[0][1]}-{minors[-1][1]}]-*"
    assert project["project"]["requires-python"] == f">=3.{minors[0]}"


SCRIPTS = [*filter(Path.is_file, sorted((ROOT / "scripts").iterdir())), ROOT / ".ci" / "run"]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_a_script_can_be_run_and_says_what_it_does(script):
    first, second, *_ = script.read_text("utf-8").splitlines()
    if script.suffix == ".py":
        assert first.startswith('"""')
        return
    assert script.stat().st_mode & 0o111 == 0o111
    assert first == "#!/usr/bin/env bash"
    assert second.startswith("# ")
    checked = subprocess.run(["bash", "-n", script], capture_output=True, text=True, check=False)
    assert (checked.returncode, checked.stderr) == (0, "")
