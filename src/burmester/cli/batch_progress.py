"""How far a batch is: a bar on a terminal, a line now and then where there is none."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burmester.batch.job import BatchProgress

PERIOD_S = 10.0  # between two plain lines
SHOWN = 3  # outcomes on a line


@contextmanager
def watching() -> Iterator[Callable[[BatchProgress], object]]:
    """Who is told how far a batch is, on standard error."""
    if sys.stderr.isatty() and os.environ.get("TERM") not in ("dumb", "unknown"):
        with _bar() as told:
            yield told
    else:
        yield _Lines().say


class _Lines:
    """Plain lines, one every ten seconds."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def say(self, progress: BatchProgress) -> None:
        now = time.monotonic()
        if now - self._last < PERIOD_S:
            return
        self._last = now
        left = progress.seconds_left
        told = [f"{progress.tasks + progress.before} tasks"]
        if left is not None:
            told += [f"{progress.rate:.3g} a second", f"{duration(left)} left"]
        told += [outcomes_line(progress.outcomes)] if progress.outcomes else []
        sys.stderr.write(", ".join(told) + "\n")
        sys.stderr.flush()


@contextmanager
def _bar() -> Iterator[Callable[[BatchProgress], object]]:
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

    from burmester.cli.output import console

    text = TextColumn("{task.fields[told]}", markup=False)
    with Progress(
        BarColumn(20), TaskProgressColumn(), text, console=console(stderr=True), transient=True
    ) as bar:
        line: Any = bar.add_task("", total=1.0, told="reading the tasks")

        def say(progress: BatchProgress) -> None:
            done = progress.tasks + progress.before
            left = progress.seconds_left
            told = f"{done:,} tasks".replace(",", " ")
            if progress.tasks:
                told += f", {progress.rate:.3g}/s"
            if left is not None:
                told += f", {duration(left)} left"
            if progress.outcomes:
                told += f" ({outcomes_line(progress.outcomes)})"
            share = done / progress.total if progress.total else 0.0
            bar.update(line, completed=min(1.0, share), told=told)

        yield say


def outcomes_line(outcomes: Mapping[str, int]) -> str:
    """The most frequent outcomes in one line: "912 solved, 80 none usable, 8 others"."""
    ranked = sorted(outcomes.items(), key=lambda each: (-each[1], each[0]))
    parts = [f"{count} {name}" for name, count in ranked[:SHOWN]]
    if rest := sum(count for _, count in ranked[SHOWN:]):
        parts.append(f"{rest} others")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """A time in words: "40 s", "3 min 20 s", "5 h 12 min"."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
