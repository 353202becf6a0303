"""Thousands of pose files made at random: no crash, no hang beyond 5 s, no wrong number.

    python -m benchmarks.fuzz_readers --files 5000 --seed 0 --commands 200

The files are those of `tests/oracles/fuzzed_files.py`, four in ten sound, three with a fault of a
known kind, three mangled byte by byte; `dialects` are sound CSV files with headers in seven
languages, titles, units below the header or in cells, and separated thousands; `shapes` are CSV
files with one row that is wider or narrower than its header, none of which may be taken;
`workbooks` are sound sheets of numbers, formulas with their values and numbers stored as text.
Each is held against what its maker knows and against `tests/oracles/plain_reader.py`.  A share of
the files that are taken goes through the command, and so do options with random texts.  Exit code 1
if anything was wrong.
"""

import argparse
import contextlib
import faulthandler
import io
import json
import pathlib
import random
import signal
import sys
import tempfile
import time
from collections import Counter

from tests.oracles.file_verdicts import judged
from tests.oracles.fuzzed_files import any_file
from tests.oracles.plain_reader import read

from burmester.cli import main as command

LANGUAGES = ["csv", "dialects", "shapes", "workbooks", "json", "toml", "parquet"]
LIMIT = 5.0  # seconds for a file


class TooSlowError(BaseException):
    """A file took longer than the limit."""


def _late(*_):
    raise TooSlowError


def readers(language, given, folder):
    """Read the files of one language; print what is wrong and what is not sure."""
    verdicts, bad, slowest = Counter(), 0, (0.0, 0)
    unsure, taken, refused = [], [], []
    for seed in range(given.seed, given.seed + given.files):
        file = any_file(language, seed)
        signal.setitimer(signal.ITIMER_REAL, LIMIT)
        begun = time.perf_counter()
        try:
            verdict = judged(file, folder / "poses")
        except (Exception, TooSlowError) as error:
            bad += 1
            verdict = "WRONG"
            print(f"{language} {seed} ({file.maker}): {type(error).__name__}: {str(error)[:300]}")
            print(f"   {file.suffix} {file.options} {file.data[:600]!r}", flush=True)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
        slowest = max(slowest, (time.perf_counter() - begun, seed))
        if file.maker == "sound" and verdict != "exact":
            verdict = f"{verdict} (sound)"
            refused.append((seed, file))
        verdicts[verdict] += 1
        if verdict == "unsure":
            unsure.append((seed, file))
        if verdict in ("exact", "unsure") and len(file.data) < 2000:
            taken.append(file)
    print(
        f"{language}: {given.files} files from seed {given.seed}; {bad} wrong; "
        f"slowest {slowest[0]:.3f} s (seed {slowest[1]})"
    )
    print("  " + ", ".join(f"{what} {count}" for what, count in sorted(verdicts.items())))
    for seed, file in unsure[: given.show]:
        print(
            f"  taken, not sure: {seed} ({file.maker}) {file.suffix} {file.options}\n"
            f"    {file.data[:300]!r}"
        )
    for seed, file in refused[: given.show]:
        print(f"  sound, not taken: {seed} {file.suffix} {file.options} {file.data[:300]!r}")
    return bad, taken


def end_to_end(arguments):
    """Exit code, seconds and what is wrong with a run of the command in this process."""
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in "12")
    begun, code = time.perf_counter(), None
    signal.setitimer(signal.ITIMER_REAL, 60)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            command(arguments)
    except SystemExit as stop:
        code = stop.code
    except (Exception, TooSlowError) as error:
        return 3, time.perf_counter() - begun, f"{type(error).__name__}: {error}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    took = time.perf_counter() - begun
    said, told = out.buffer.getvalue().decode(), err.buffer.getvalue().decode()
    if code not in (0, 1, 2) or "Traceback" in told:
        return code, took, told[:600]
    try:
        if isinstance(json.loads(said), dict) and said.count("\n") == 1:
            return code, took, ""
    except ValueError as error:
        return code, took, f"no JSON: {error}: {said[:100]!r}"
    return code, took, f"not one JSON object on one line: {said[:100]!r}"


POSES = "x,y,angle_deg,name\n0,0,0,A\n2,1,20,B\n3,3,45,C\n3,5,80,4\n3,6,95,\n2,7,120,F\n"
OPTIONS = {
    "--fixed-pivot": ("1,2", "box:-9,-9:9,9", "line:0,0:1,1", "any"),
    "--moving-pivot": ("0.5,0.5", "polygon:0,0:5,0:5,5", "segment:0,0:2,0", "any"),
    "--length": ("1:10", ":8", "0.5:", "any"),
    "--kinds": ("RR", "RR,PR", "RP"),
    "--exact": ("1", "1,4", "A", "A,B"),
    "--min-transmission": ("30", "0.5"),
    "--type": ("grashof", "crank-rocker,double-rocker", "slider-crank"),
    "--driver": ("any", "first", "crank"),
    "--footprint": ("box:-20,-20:20,20", "any"),
    "--link-ratio": ("5", "1.5"),
    "--within": ("0.5", "1e-3"),
    "--method": ("auto", "pencil", "complete", "exact"),
    "--norm": ("rms", "worst"),
    "--pose-sigma": ("0.05,0.1", "0,0"),
    "--angle-weight": ("3", "1e-9"),
    "--tolerance": ("0.01", "1e9"),
    "--round": ("0.5", "1e-9", "1e9"),
    "--stock": ("1,2,3,4,5", "2", "1e300"),
    "--angle-unit": ("deg", "rad"),
}
_HOSTILE = (
    "1e400 -1 0 1e-400 5e-324 1e308 nan , : :: ,, 1: :1 1:2:3 5:1 1,2,3 0x1 1_0 \u0661 \ud800 \0 "
    "\u2028 ' \" # % {} [red]x[/red] -- --json - 1,1 box: box:1,1:1,1 line:0,0:0,0 polygon:0,0 "
    "polygon:0,0:1,1:2,2 polygon:0,0:1,1:1,0:0,1 point:1,2 1e200,1e200 line:1e300,0:0,1e300 "
    "box:-1e308,-1e308:1e308,1e308 BOX:0,0:1,1 RR,RR PP rr RR, 99999999999999999999 -0 1,1,1,1,1,1 "
    "any,any ANY double\u00a0slider"
)
HOSTILE = _HOSTILE.split(" ")


def hostile_options(rng):
    """One to three options, each with a text of its own or with one that does not belong."""
    arguments = []
    for option in rng.sample([*OPTIONS], rng.choice((1, 1, 2, 3))):
        text = rng.choice(OPTIONS[option])
        how = rng.randrange(5)
        if how == 0:
            text = rng.choice(HOSTILE)
        elif how == 1:
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(HOSTILE) + text[at + rng.randrange(2) :]
        elif how == 2:
            text = rng.choice(OPTIONS[rng.choice([*OPTIONS])])
        elif how == 3:
            text = "".join(rng.choice("0123456789.,:-+eEnxRP ") for _ in range(rng.randrange(12)))
        else:
            text = text.replace(rng.choice("0123456789"), rng.choice(("", "e308", "-", "0", " ")))
        arguments.append(f"{option}={text}")
    return arguments


def usual(file):
    """Whether all the poses' numbers are such as lengths and angles have."""
    plain = read(file.data, file.suffix)
    sizes = [abs(number) for pose in plain.poses for number in pose] if plain else []
    return bool(sizes) and all(size == 0 or 1e-6 < size < 1e9 for size in sizes)


def commands(given, folder, taken):
    """Run the command on files that were taken and on options; print what is wrong."""
    rng = random.Random(f"commands {given.seed}")
    poses = folder / "poses.csv"
    poses.write_text(POSES)
    pools = {"usual file": [file for file in taken if usual(file)], "any file": taken}
    kinds = ["usual file", "any file", "options", "options"]
    codes, bad, slowest, places = Counter(), 0, (0.0, ""), Counter()
    for k in range(given.commands):
        kind, options, content = kinds[k % 4], [], b""
        if pool := pools.get(kind):
            file = rng.choice(pool)
            path, content = (folder / "fuzzed").with_suffix(file.suffix), file.data
            path.write_bytes(file.data)
            unit = file.options.get("angle_unit")
            options = [f"--angle-unit={unit}"] if unit else []
        else:
            path, options = poses, hostile_options(rng)
        arguments = ["synthesize", str(path), *options, "--json"]
        code, took, wrong = end_to_end(arguments)
        codes[kind, code] += 1
        slowest = max(slowest, (took, str((*arguments[1:], content))))
        if wrong:
            bad += 1
            place = " ".join(wrong.partition("error[")[2].split())[:160] or wrong[:200]
            places[kind, place] += 1
            if places[kind, place] == 1:
                print(f"command {k} ({kind}): {arguments[1:]} exit code {code}: {wrong}")
                print(f"   {content!r}", flush=True)
    print(f"commands: {given.commands} from seed {given.seed}, {bad} wrong")
    for (kind, code), count in sorted(codes.items(), key=str):
        print(f"  {kind}, exit code {code}: {count}")
    for (kind, place), count in places.most_common():
        print(f"  {count} times, {kind}: {place}")
    print(f"  slowest {slowest[0]:.1f} s: {slowest[1][:600]}")
    return bad


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--files", type=int, default=5000, help="of each language")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--languages", nargs="*", default=LANGUAGES)
    parser.add_argument("--commands", type=int, default=0, help="runs of the command")
    parser.add_argument("--show", type=int, default=20, help="files taken and not sure, to show")
    given = parser.parse_args()
    faulthandler.enable()
    signal.signal(signal.SIGALRM, _late)
    bad, taken = 0, []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for language in given.languages:
            wrong, some = readers(language, given, folder)
            bad, taken = bad + wrong, taken + some
        if given.commands:
            bad += commands(given, folder, taken)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
