"""`python -m benchmarks.field`: every tool on every task, results as JSON, then the page."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from benchmarks.field import page
from benchmarks.field.run import LIMIT, RESULTS, merged, results, run, save, tasks
from benchmarks.field.tools import NAMES, tool
from benchmarks.field.worker import version

QUICK = 5.0


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="benchmarks.field", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="one task of every kind, 5 s each")
    parser.add_argument("--tools", nargs="+", choices=NAMES, default=list(NAMES))
    parser.add_argument("--tasks", nargs="+", metavar="NAME", help="of these names or kinds only")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=3, help="generated tasks of each kind")
    parser.add_argument("--limit", type=float, help="seconds of processor time, 15 if not given")
    parser.add_argument("--out", type=Path, help="results.json beside this module if not given")
    parser.add_argument("--page", action="store_true", help="only make the page from the results")
    given = parser.parse_args(arguments)
    out = given.out or (None if given.quick else RESULTS)
    if given.page:
        page.write(json.loads((out or RESULTS).read_text(encoding="utf-8")))
        return 0
    names = [name for name in given.tools if version(tool(name).PACKAGE) is not None]
    for name in sorted(set(given.tools) - set(names)):
        print(f"{tool(name).PACKAGE} is not installed: {name} is left out", file=sys.stderr)
    every = tasks(given.seed, given.count, one_of_each=given.quick)
    chosen = every
    if given.tasks:
        chosen = [task for task in every if {task.name, task.kind} & {*given.tasks}]
    limit = given.limit or (QUICK if given.quick else LIMIT)
    before = None
    if out is not None and out.exists() and (given.tasks or len(names) < len(NAMES)):
        before = json.loads(out.read_text(encoding="utf-8"))

    def kept(records: list[dict[str, Any]]) -> dict[str, Any]:
        data = results(every, names, records, limit, given.seed)
        data = data if before is None else merged(before, data)
        if out is not None:
            save(data, out)
        return data

    records = run(chosen, names, limit, lambda line: print(line, file=sys.stderr, flush=True), kept)
    data = kept(records)
    print(page.table(data))
    if out == RESULTS:
        page.write(data)
    return 0


if __name__ == "__main__":
    sys.exit(main())
