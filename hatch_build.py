"""Compile the kernels when burmester is installed: every module whose name ends in `_kernel`."""

import os
import tempfile
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from Cython.Build import cythonize
from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from setuptools import Distribution, Extension
from setuptools.errors import BaseError, CCompilerError

SOURCES = Path("src")
# The same roundings on every machine: a product and a sum are not made one operation.
FLAGS = [] if os.name == "nt" else ["-O3", "-ffp-contract=off"]
# Complex numbers are multiplied as they are written, without a look for infinite ones.
MACROS = [("CYTHON_CCOMPLEX", "0")]
HELP = (
    "burmester's kernels cannot be compiled: a C compiler and Python's headers are needed"
    " (on Debian: apt-get install build-essential python3-dev; on macOS: xcode-select --install;"
    " on Windows: the build tools of Visual Studio), or else a wheel: there is one for Python 3.11"
    " to 3.14 on Linux (glibc), macOS and Windows, and needs none"
)


class KernelsHook(BuildHookInterface):
    """Kernels go into the wheel; in an editable installation they lie beside their sources."""

    def initialize(self, version, build_data):
        """Compile, and say where the results go."""
        root = Path(self.root)
        build_data.update(pure_python=False, infer_tag=True)
        work = self.work = tempfile.TemporaryDirectory()
        kernels = {
            ".".join(kernel.relative_to(root / SOURCES).with_suffix("").parts): kernel
            for kernel in sorted((root / SOURCES).rglob("*_kernel.py"))
        }
        places = {
            name: kernel.with_name(kernel.stem + EXTENSION_SUFFIXES[0])
            for name, kernel in kernels.items()
        }
        old = {name: each for name, each in kernels.items() if not is_newer(places[name], each)}
        new = compiled(old, Path(work.name))
        for name, kernel in kernels.items():
            beside = places[name]
            made = new.get(name, beside)
            if version != "editable":
                inside = kernel.relative_to(root / SOURCES).with_name(made.name)
                build_data["force_include"][str(made)] = str(inside)
            elif made != beside:
                beside.unlink(missing_ok=True)  # one that is loaded is left as it is
                beside.write_bytes(made.read_bytes())

    def finalize(self, version, build_data, artifact_path):
        """Nothing is left behind."""
        self.work.cleanup()


def is_newer(made, source):
    """Whether a file was made after its source and this script."""
    made_at = made.stat().st_mtime if made.exists() else 0
    return made_at > max(source.stat().st_mtime, Path(__file__).stat().st_mtime)


def compiled(sources, work):
    """The paths of modules' extensions by their names, made in a folder side by side."""
    if not sources:
        return {}
    extensions = [
        Extension(name, [str(source)], extra_compile_args=FLAGS, define_macros=MACROS)
        for name, source in sources.items()
    ]
    extensions = cythonize(extensions, build_dir=str(work / "c"), quiet=True)
    distribution = Distribution({"name": "kernels", "ext_modules": extensions})
    command = distribution.get_command_obj("build_ext")
    command.build_lib, command.build_temp = str(work / "lib"), str(work / "o")
    command.parallel = len(sources)
    try:
        command.ensure_finalized()
        command.run()
    except (BaseError, CCompilerError) as error:
        raise SystemExit(f"{HELP}\n{error}") from None
    return {name: Path(command.get_ext_fullpath(name)) for name in sources}
