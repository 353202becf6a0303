"""Results of every kind written, read, handed over and judged once more.

    python -m benchmarks.read_back --count 400 --seed 0

A result is that of noisy or exact poses, few poses, points, a path, a family, within limits or
tolerances, rounded, of six-bars or of a function; some are in-line slider-cranks and symmetric
four-bars, whose poses hold dead points.  It is saved and read.  What is read has to have every
attribute that was saved, say nothing else of a usable linkage, and be written and read once more;
its best linkage has to pass an export that is read back, and `judge` to say of it what the result
says.  Exit code 1 where one of these fails.
"""

import argparse
import contextlib
import re
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np
from tests.oracles.common_tasks import in_line
from tests.oracles.same_result import differences

import burmester
from benchmarks.judged_alike import noisy_task
from burmester import InputError, Limits, Requirements, Task, box
from burmester.export import FORMATS

QUICK = ("json", "csv", "svg", "dxf", "openscad", "mjcf", "urdf", "sdf", "pylinkage")


def motion(rng, count):
    """Rows x, y, angle of the coupler of a random four-bar, in degrees, some of them rounded."""
    task = noisy_task(int(rng.integers(1 << 30)), 0)
    rows = np.column_stack([task.poses.translation, np.degrees(task.poses.angle)])
    digits = int(rng.integers(2, 7))
    scale = 10.0 ** rng.integers(0, 3)
    return (rows[:count] * [scale, scale, 1]).round(digits)


def symmetric(rng):
    """Poses of a coupler point on the axis of a symmetric four-bar, alike on both sides."""
    while True:
        ground, coupler, arm = rng.uniform((2, 0.7, 1.5), (4, 1.8, 3.5))
        x = rng.uniform(0.05, 0.6, 3) * arm
        first = np.concatenate([-x, x]) + (ground - coupler) / 2
        turn = np.arccos(np.clip(first / arm, -1, 1))
        pin = arm * np.exp(1j * turn)
        gap = ground - pin
        base = (abs(gap) ** 2 + coupler**2 - arm**2) / (2 * abs(gap) * coupler)
        if (abs(base) < 1).all():
            break
    angle = np.angle(gap) + np.arccos(base)
    at = pin + (coupler / 2 + 1j * rng.uniform(0, 2)) * np.exp(1j * angle)
    rows = np.column_stack([20 * at.real, 20 * at.imag, np.degrees(angle)])
    return rows.round(int(rng.integers(2, 7)))


def poses_of(kind, rng):
    """A task of poses of a kind."""
    if kind == "in line":
        digits = int(rng.integers(2, 7))
        start, count = rng.choice((0, 10, rng.uniform(0, 60))), int(rng.integers(5, 9))
        turns = start + np.arange(count) * 360 / count
        return in_line(turns, digits, 30, rng.uniform(60, 150))
    if kind == "symmetric":
        return symmetric(rng)
    return motion(rng, int(rng.integers(2, 5)) if kind == "few" else 9)


def result_of(kind, rng, folder):
    """A result of a kind."""
    if kind == "six-bars":
        rows = motion(rng, int(rng.integers(3, 6)))
        return burmester.synthesize_six_bars(rows, angle_unit="deg", chains=300)
    if kind == "function":
        text = rng.choice(["log10(x)", "x**2", "sqrt(x)", "1/x"])
        pairs = (None, 3, 4, 5)[rng.integers(4)]
        how = {"opposite": bool(rng.integers(2)), "pairs": pairs}
        if pairs in (3, 4):
            how |= {"input_phase_deg": rng.uniform(0, 360)}
            how |= {"output_phase_deg": rng.uniform(0, 360)} if pairs == 3 else {}
        wide = rng.uniform(30, 110, 2)
        return burmester.synthesize_function(
            text, (1, 2), input_deg=wide[0], output_deg=wide[1], **how
        )
    rows = poses_of(kind, rng)
    if kind in ("points", "path"):
        rows = np.array(rows)[:, :2]
        head = "x,y"
        if kind == "points":  # timed by the crank
            rows, head = np.column_stack([rows, 20 * np.arange(len(rows))])[:5], "x,y,crank_deg"
        text = [head, *(",".join(map(str, each)) for each in rows.tolist())]
        (folder / "points.csv").write_text("\n".join(text))
        return burmester.synthesize(burmester.read_task(folder / "points.csv"))
    more, how = {}, {}
    if kind == "within":
        middle, reach = np.mean(rows, axis=0)[:2], 2 * np.ptp(rows, axis=0)[:2].max()
        more["limits"] = (Limits(fixed_pivot=box(middle - reach, middle + reach)),) * int(
            rng.integers(1, 3)
        )
        more["requirements"] = Requirements(transmission_deg=15.0)
    if kind == "made":
        size = np.ptp(rows, axis=0)[:2].max()
        how = {"rounding_step": 0.02 * size, "manufacturing_tolerance": 1e-3 * size}
    if kind == "how":
        how = ({"norm": "worst"}, {"certify": True}, {"length_per_radian": 3.0})[rng.integers(3)]
    unit = ("mm", "in", None)[rng.integers(3)]
    return burmester.synthesize(
        Task.from_rows(rows, angle_unit="deg", length_unit=unit, **more), **how
    )


KINDS = (
    *("plain", "few", "in line", "symmetric", "within", "made", "how"),
    *("points", "path", "six-bars", "function"),
)


def of_all(result):
    """All linkages of a result."""
    return [result[k] for k in range(len(result))]


def size_of(result):
    return float(getattr(result, "length", 1.0))


def _judged(read, best):
    """A linkage judged as the task was solved: an angle may weigh more or less."""
    return burmester.judge(read.task, best, length_per_radian=read.options.length_per_radian)


def faults_of(result, folder, rng, counts):
    """What is wrong with what is read back, in words."""
    read = burmester.read_result(result.save(folder / "r.json", force=True))
    told = [each for each in read.warnings if each.code == "W244"]
    told = [each.message for each in told if each not in result.warnings]
    yield from (f"W244: {each}" for each in told)
    for path, one, other in differences(result, read, size_of(result)):
        number = re.match(r"\.linkages\[(\d+)\]", path)
        if number is not None and not result[int(number[1])].usable:
            counts["figures of linkages that do not work, changed by rounding"] += 1
            continue
        yield f"{path}: {one!s:.60} | {other!s:.60}"
    again = burmester.read_result(read.save(folder / "again.json", force=True))
    told = [(each.id, each.usable) for each in of_all(read)]
    if told != [(each.id, each.usable) for each in of_all(again)]:
        yield "read twice, it is another result"
    if hasattr(read, "report"):
        read.report(folder / "page.html", force=True)
    repr(read)
    if (best := read.best) is None:
        return
    to = str(rng.choice(QUICK))
    if isinstance(read, burmester.Result) and read.six_bars is not None:
        to = "json" if to == "pylinkage" else to
        export, judged = read.export, burmester.judge(read.task, best)
    elif isinstance(read, burmester.Result):
        if to == "pylinkage" and "RP" in (type(each.dyad).__name__ for each in best.dyads):
            to = "json"
        export, judged = read.export, _judged(read, best)
    else:
        export, judged = read.coupler_motion().export, None
    try:
        export(folder / f"out{FORMATS[to].suffix}", to=to, force=True)
    except InputError as error:
        if error.code not in ("E162", "E163"):
            yield f"export to {to}: {error.code} {error.message}"
    if judged is not None and (judged.best is None) == best.usable:
        yield f"judged otherwise: {judged.outcome.message}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    counts, bad, start = Counter(), 0, time.process_time()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(given.count):
            rng, kind = np.random.default_rng((given.seed, number)), KINDS[number % len(KINDS)]
            with contextlib.suppress(InputError):
                result = result_of(kind, rng, folder)
                counts[kind] += 1
                counts["linkages"] += len(result)
                try:
                    faults = list(faults_of(result, folder, rng, counts))
                except Exception as error:
                    faults = [f"{type(error).__name__}: {error!s:.300}"]
                bad += bool(faults)
                for each in faults[:5]:
                    print(f"{number} {kind}: {each}", flush=True)
                continue
            counts[f"{kind}: no result"] += 1
    print(f"{given.count} tasks, {bad} wrong, {time.process_time() - start:.0f} s; {dict(counts)}")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
