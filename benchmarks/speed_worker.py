"""How long `synthesize` takes with the burmester of the Python that runs this file.

    python benchmarks/speed_worker.py poses.csv lid.toml case:ge2012-exact

One line of JSON for each file: the CPU seconds of a call, how many calls that is the median of, how
many linkages came back and how many are usable, the least combined error of these, and the peak
memory of the process until then.  It uses what old versions have, too: `read_task` and
`synthesize`.  A first call that takes less than a second warms up and is not counted.
"""

import json
import math
import statistics
import sys
import time

import burmester

LONG_S = 1.0  # CPU seconds; a first call that takes longer is the measurement itself
ENOUGH_S, MOST_CALLS = 0.5, 9  # CPU seconds of further calls, about, and how many at most


def timed(task):
    """The CPU seconds of one call, and its result."""
    begun = time.process_time()
    result = burmester.synthesize(task)
    return time.process_time() - begun, result


def measured(source):
    """The figures of one task; the code of the error where it is refused."""
    task = burmester.read_task(source)
    try:
        first, result = timed(task)
    except burmester.BurmesterError as error:
        return {"error": error.code}
    seconds = [first]
    if first < LONG_S:
        count = max(1, min(MOST_CALLS, round(ENOUGH_S / first)))
        seconds = [timed(task)[0] for _ in range(count)]
    least = min((each.combined_error for each in result.usable), default=math.inf)
    return {
        "seconds": statistics.median(seconds),
        "calls": len(seconds),
        "linkages": len(result.linkages),
        "usable": len(result.usable),
        "least": least,
        "peak_MB": peak_megabytes(),
    }


def peak_megabytes():
    """The most memory that this process has had; nan where nobody tells."""
    try:
        from resource import RUSAGE_SELF, getrusage  # noqa: PLC0415  (Unix only)
    except ImportError:
        return math.nan
    kilo = 1 if sys.platform == "darwin" else 1024  # bytes there, KiB elsewhere
    return getrusage(RUSAGE_SELF).ru_maxrss * kilo / 1e6


if __name__ == "__main__":
    for each in sys.argv[1:]:
        print(json.dumps(measured(each)), flush=True)
