"""The fixture `measure`, and the table of its figures at the end of a run."""

import pytest

ROWS = {}  # group: its rows, the package's own first, to be compared with


@pytest.fixture
def measure(benchmark):
    """Time a call, note figures beside its time, return the median in seconds (or None).

    rounds: so many after one to warm up, or None to leave it to pytest-benchmark.
    tasks: how many of them one call does; the time is that of one.
    """

    def run(what, call, *args, rounds=None, tasks=1, **notes):
        if rounds is None:
            benchmark(call, *args)
        else:
            benchmark.pedantic(call, args, rounds=rounds, warmup_rounds=1)
        benchmark.extra_info.update(notes)
        if not benchmark.stats:  # --benchmark-disable
            return None
        median = benchmark.stats.stats.median / tasks
        ROWS.setdefault(benchmark.group, []).append((what, median, benchmark.extra_info))
        benchmark.extra_info["microseconds_a_task"] = round(1e6 * median, 2)
        return median

    return run


def pytest_terminal_summary(terminalreporter):
    line = terminalreporter.write_line
    if ROWS:
        line("\n| what | median | ratio | goal | beside it |\n|---|--:|--:|--:|---|")
    for group, rows in ROWS.items():
        line(f"| **{group}** | | | | |")
        for what, seconds, figures in rows:
            notes = {k.replace("_", " "): v for k, v in figures.items() if k != "goal"}
            del notes["microseconds a task"]
            told = ", ".join(f"{key} {value}" for key, value in notes.items())
            goal, ratio = figures.get("goal", ""), seconds / rows[0][1]
            line(f"| {what} | {shown(seconds)} | {ratio:.3g} | {goal} | {told} |")


def shown(seconds):
    scale, unit = (1, "s") if seconds >= 1 else (1e3, "ms") if seconds >= 1e-3 else (1e6, "µs")
    return f"{seconds * scale:.3g} {unit}"
