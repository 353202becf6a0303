"""Every tool on every task, each in a process of its own with the same limit of processor time."""

from __future__ import annotations

import datetime
import json
import math
import os
import platform
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmarks.field.drawn import drawn
from benchmarks.field.generated import MAKERS, generated
from benchmarks.field.linkage import FourBar
from benchmarks.field.published import published
from benchmarks.field.scores import scores
from benchmarks.field.task import FieldTask
from benchmarks.field.tools import tool
from benchmarks.field.worker import version

ROOT = Path(__file__).parents[2]
RESULTS = Path(__file__).with_name("results.json")
LIMIT = 15.0  # seconds of processor time for a tool on a task
WALL = 10.0  # times that by the clock, for a tool that waits
LAST_WORDS = 300  # characters of the last line of a tool that crashed
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def tasks(seed: int, count: int, *, one_of_each: bool = False) -> list[FieldTask]:
    """Published tasks, drawn ones, so many generated ones of each kind; or one of every kind."""
    if not one_of_each:
        return [*published(), *drawn(), *generated(seed, count)]
    first: dict[str, FieldTask] = {}
    for task in [*published(), *drawn()]:
        first.setdefault(task.kind, task)
    more = [make(seed, 0) for kind, make in MAKERS.items() if kind not in first]
    return [*first.values(), *more]


def run(
    every: Sequence[FieldTask],
    names: Sequence[str],
    limit: float,
    tell: Callable[[str], None] = lambda _: None,
    keep: Callable[[list[dict[str, Any]]], None] = lambda _: None,
) -> list[dict[str, Any]]:
    """A record for each tool on each task; `keep` is handed those so far after every task."""
    out: list[dict[str, Any]] = []
    for number, task in enumerate(every, 1):
        for name in names:
            today = datetime.date.today().isoformat()
            record = {"task": task.name, "tool": name, "date": today, **_record(task, name, limit)}
            out.append(record)
            words = "solved" if record.get("solved") else record["status"]
            tell(f"{number}/{len(every)} {task.name}: {name} {words} {record.get('cpu', '')}")
        keep(out)
    return out


def _record(task: FieldTask, name: str, limit: float) -> dict[str, Any]:
    """What a tool made of a task: does not apply, answered, no answer, out of time, or crashed."""
    if reason := tool(name).refuses(task):
        return {"status": "does not apply", "reason": reason}
    environment = os.environ | dict.fromkeys(ONE_THREAD, "1") | {"PYTHONHASHSEED": "0"}
    command = [sys.executable, "-W", "ignore", "-m", "benchmarks.field.worker", name, str(limit)]
    try:
        done = subprocess.run(
            command,
            input=json.dumps(task.to_json()),
            capture_output=True,
            text=True,
            cwd=ROOT,
            env=environment,
            timeout=WALL * limit + 60,
            check=False,
        )
    except subprocess.TimeoutExpired:
        reason = f"it did not end within {WALL * limit:g} s by the clock"
        return {"status": "out of time", "reason": reason}
    killed = [-number for number in _signals("SIGXCPU", "SIGKILL")]
    if done.returncode in killed:
        return {"status": "out of time", "reason": f"stopped at {limit:g} s of processor time"}
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if line[:1].strip()]
        said = lines[-1] if lines else f"exit code {done.returncode}"
        return {"status": "crashed", "reason": said[:LAST_WORDS]}
    report = json.loads(done.stdout)
    spent = {"cpu": round(report["cpu"], 4), "wall": round(report["wall"], 4)}
    if report["cpu"] > limit:
        reason = f"it took {report['cpu']:.1f} s of processor time"
        return {"status": "out of time", "reason": reason, **spent}
    answers = [FourBar.from_json(rows) for rows in report["answers"] if _finite(rows)]
    status = "answered" if answers else "no answer"
    return {"status": status, **spent, **scores(task, answers)}


def _signals(*names: str) -> Iterator[int]:
    """The numbers of signals that this system has."""
    return (int(getattr(signal, name)) for name in names if hasattr(signal, name))


def _finite(rows: Iterable[list[Any]]) -> bool:
    return all(math.isfinite(number) for row in rows for number in row[1:])


def machine() -> dict[str, Any]:
    """Where the figures come from, in words."""
    packages = ("numpy", "scipy")
    return {
        "system": f"{platform.system()}, {platform.machine()}",
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        **{package: version(package) for package in packages},
    }


def results(
    every: Sequence[FieldTask],
    names: Sequence[str],
    records: list[dict[str, Any]],
    limit: float,
    seed: int,
) -> dict[str, Any]:
    """All that the page is made of."""
    about = {}
    for name in names:
        chosen = tool(name)
        about[name] = {
            "title": chosen.TITLE,
            "package": chosen.PACKAGE,
            "version": version(chosen.PACKAGE),
            "called": list(chosen.CALLED),
        }
    heads = [
        {
            "name": task.name,
            "kind": task.kind,
            "source": task.source,
            "poses": len(task.rows),
            "tolerance": task.tolerance,
            "known": len(task.known),
        }
        for task in every
    ]
    return {
        "machine": machine(),
        "limit": limit,
        "seed": seed,
        "tools": about,
        "tasks": heads,
        "records": records,
    }


def merged(old: dict[str, Any], new: dict[str, Any]) -> dict[str, Any]:
    """New figures in place of the old ones of the same tools and tasks, the others kept."""
    if (old["tasks"], old["limit"], old["seed"]) != (new["tasks"], new["limit"], new["seed"]):
        raise ValueError("these results are of other tasks or limits: run every tool again")
    fresh = {(record["tool"], record["task"]) for record in new["records"]}
    kept = [each for each in old["records"] if (each["tool"], each["task"]) not in fresh]
    return new | {"tools": old["tools"] | new["tools"], "records": kept + new["records"]}


def save(data: dict[str, Any], path: Path) -> None:
    """As JSON, a line for each task and each record."""
    lines = []
    for key, value in data.items():
        if isinstance(value, list):
            rows = ",\n".join("  " + json.dumps(each) for each in value)
            lines.append(f" {json.dumps(key)}: [\n{rows}\n ]")
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(value)}")
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
