"""Thousands of saved results with faults: no crash, no contradiction taken, no name that runs.

    python -m benchmarks.fuzz_results --files 5000 --seed 0 --commands 300 --sound 100

The faults are those of `tests/oracles/fuzzed_results.py`: parts of the tree exchanged, doubled or
dropped, bytes mangled.  Each file is read and, where it is taken, written in a format by random;
`tests/oracles/result_verdicts.py` judges.  A share goes through the command, whose exit code has to
be 0 or 2.  Sound results, of tasks and options by random, have to be taken.  Exit code 1 if
anything was wrong.
"""

import argparse
import contextlib
import faulthandler
import io
import json
import pathlib
import random
import sys
import tempfile
import time
from collections import Counter

import numpy as np
from tests.oracles.fuzzed_results import with_faults
from tests.oracles.result_verdicts import QUICK, judged

from burmester import Limits, Requirements, Task, read_task, synthesize
from burmester.cli import main as command
from burmester.errors import InputError
from burmester.export import FORMATS
from burmester.geometry.displacement import Displacement
from burmester.io import templates
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result

CASES = ("case:motiongen-shoulder", "case:motiongen-mixed5", "case:motiongen-prpr")


def text_of(found):
    return json.dumps(synthesis_data(found))


def sources(folder):
    """Sound results to put faults into: of links and sliders, limits, rounding, proofs, repeats."""
    shoulder = read_task(CASES[0])
    yield from (text_of(synthesize(read_task(case))) for case in CASES)
    for name in ("landing-gear", "tailgate"):
        path = folder / f"{name}.toml"
        path.write_text(templates.text(name))
        yield text_of(synthesize(read_task(path)))
    yield text_of(synthesize(shoulder, rounding_step=0.5, manufacturing_tolerance=0.05))
    yield text_of(synthesize(shoulder, stock_lengths=(1, 2, 3, 4, 5), certify=True))
    twice = Displacement(*(np.concatenate([each, each[:2]]) for each in parts(shoulder.poses)))
    yield text_of(synthesize(Task(twice, names=tuple("ABCDEFG"), resolution=shoulder.resolution)))


def parts(poses):
    return poses.translation, poses.angle


def files(given, folder, texts):
    """Read results with faults; print what is wrong."""
    verdicts, bad, slowest = Counter(), 0, (0.0, 0)
    for seed in range(given.seed, given.seed + given.files):
        rng = random.Random(seed)
        data = with_faults(rng, json.loads(rng.choice(texts)))
        begun = time.perf_counter()
        try:
            verdict = judged(data, folder, rng.choice(QUICK))
        except Exception as error:  # whatever it is, it is told
            bad, verdict = bad + 1, "WRONG"
            print(f"{seed}: {type(error).__name__}: {str(error)[:400]}", flush=True)
        slowest = max(slowest, (time.perf_counter() - begun, seed))
        verdicts[verdict] += 1
    print(f"{given.files} files from seed {given.seed}: {bad} wrong; slowest {slowest[0]:.2f} s")
    print("  " + ", ".join(f"{what} {count}" for what, count in verdicts.most_common()))
    return bad


def commands(given, folder, texts):
    """Run `burmester export` on results with faults; print what is wrong."""
    codes, bad, path = Counter(), 0, folder / "result.json"
    for seed in range(given.seed, given.seed + given.commands):
        rng = random.Random(f"command {seed}")
        path.write_bytes(with_faults(rng, json.loads(rng.choice(texts))))
        to = rng.choice(QUICK)
        output = str(folder / f"out{FORMATS[to].suffix}")
        arguments = ["export", str(path), "--to", to, "-o", output, "--force"]
        out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in "12")
        code = None
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                command(arguments)
        except SystemExit as stop:
            code = stop.code
        codes[code] += 1
        told = (out.buffer.getvalue() + err.buffer.getvalue()).decode()
        plain = told.replace("\n", "").isprintable()
        if code not in (0, 2) or "Traceback" in told or "Warning" in told or not plain:
            bad += 1
            print(f"command {seed}: exit code {code}: {told[:500]!r}", flush=True)
    kinds = ", ".join(f"exit code {code} {count}" for code, count in codes.most_common())
    print(f"{given.commands} commands: {bad} wrong; {kinds}")
    return bad


def task_by_random(rng):
    """A task of 4 to 12 poses: on a path, noisy, repeated, or with limits; and its options."""
    count = int(rng.integers(5, 13))
    t = np.sort(rng.uniform(0, 1, count))
    a, b, turn = rng.normal(size=3)
    x = np.cos(3 * t + a) + 0.3 * np.cos(5 * t) * b
    y = 0.6 * np.sin(3 * t + a) + 0.2 * b * t
    angle = turn * np.sin(2 * t + b)
    scale = 10.0 ** rng.integers(-3, 5)
    digits = int(rng.integers(2, 7))
    rows = np.column_stack([scale * x.round(digits), scale * y.round(digits), angle.round(digits)])
    if rng.random() < 0.2:
        rows = rows[[*range(count), 0]]
    step = 0.5 * 10.0**-digits
    more = {}
    if rng.random() < 0.3:
        more["limits"] = (Limits(kinds=frozenset({"RR", "PR"})),) * int(rng.integers(1, 3))
    if rng.random() < 0.3:
        more["requirements"] = Requirements(transmission_deg=20.0, link_ratio=8.0)
    task = Task(Displacement.from_poses(rows), resolution=(scale * step, step), **more)
    options = {}
    if rng.random() < 0.3:
        options["rounding_step"] = 0.05 * scale
    if rng.random() < 0.2 and not more.get("limits"):
        options["norm"] = "worst"
    return task, options


def sound(given, folder):
    """Read back what is written for tasks by random; print what is refused."""
    counts, path, bad = Counter(), folder / "sound.json", 0
    for seed in range(given.seed, given.seed + given.sound):
        try:
            task, options = task_by_random(np.random.default_rng(seed))
            found = synthesize(task, **options)
        except InputError as error:
            counts[f"no task ({error.code})"] += 1
            continue
        path.write_text(text_of(found))
        try:
            counts["linkages"] += len(read_result(path).synthesis.linkages)
            counts["taken"] += 1
        except Exception as error:
            bad += 1
            print(f"sound {seed}: {error}", flush=True)
    print(f"{given.sound} sound results: {bad} refused; {dict(counts)}")
    return bad


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--files", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--commands", type=int, default=0, help="runs of the command")
    parser.add_argument("--sound", type=int, default=0, help="results that have to be taken")
    given = parser.parse_args()
    faulthandler.enable()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        texts = list(sources(folder))
        bad = files(given, folder, texts) + commands(given, folder, texts) + sound(given, folder)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
