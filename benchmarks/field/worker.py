"""One tool on one task, in a process of its own: JSON comes in, JSON goes out."""

from __future__ import annotations

import json
import math
import os
import sys
import time
from importlib import import_module, metadata

from benchmarks.field.task import FieldTask
from benchmarks.field.tools import tool


def spent() -> float:
    """Seconds of processor time of this process and of children that have ended."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def main(name: str, seconds: float) -> None:
    task, chosen = FieldTask.from_json(json.load(sys.stdin)), tool(name)
    import_module(chosen.PACKAGE)  # what it takes to start is not counted
    out = os.dup(1)
    os.dup2(2, 1)  # what a tool prints is no answer
    begun, clock = spent(), time.perf_counter()
    try:
        import resource
    except ImportError:  # Windows has no such limit; the parent's clock remains
        pass
    else:
        most = math.ceil(begun + seconds) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
    answers = chosen.solve(task, seconds)
    report = {
        "cpu": spent() - begun,
        "wall": time.perf_counter() - clock,
        "answers": [answer.to_json() for answer in answers],
    }
    with os.fdopen(out, "w") as stream:
        json.dump(report, stream)


def version(package: str) -> str | None:
    """The installed version of a tool's package; nothing where it is not installed."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        try:
            return str(import_module(package).__version__)
        except ImportError:
            return None


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
