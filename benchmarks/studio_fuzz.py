"""The studio's server under thousands of strange requests, and under a flood of them.

    python -m benchmarks.studio_fuzz --requests 5000 --tabs 500 --seed 0 --flood 60

The requests are those of `tests/oracles/strange_requests.py`.  The flood is so many seconds of 200
requests of rubbish a second, beside which the page is asked for again and again.  Printed are what
was wrong, the memory of the server before and after, and the slowest page.  Exit code 1 if anything
was wrong.
"""

import argparse
import random
import sys
import tempfile
import threading
import time
from collections import Counter

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from tests.oracles import strange_requests as strange
from tests.oracles.studio import served

A_SECOND = 200  # requests of the flood
THREADS = 32
PAGE_S = 1.0  # within which the page has to answer


def examples(number, start):
    """So many examples from a seed, without looking for smaller ones."""
    quiet = settings(
        max_examples=number,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    return lambda test: quiet(seed(start)(test))


def requests(visitor, number, start):
    """What is wrong with the answers to so many requests, and how often each status came."""
    wrong, statuses = [], Counter()

    @examples(number, start)
    @given(request=strange.requests())
    def one(request):
        status, answer = strange.sent(visitor, request)
        statuses[status] += 1
        if (fault := strange.fault(request, status, answer)) is not None:
            wrong.append(f"{request}: {fault}")

    one()
    return wrong, statuses


def tabs(visitor, number, start):
    """What is wrong with so many tabs that send strange messages."""
    wrong = []

    @examples(number, start)
    @given(said=st.lists(strange.messages(), min_size=1, max_size=4))
    def one(said):
        if (fault := strange.fault_of_messages(visitor, said)) is not None:
            wrong.append(f"{said}: {fault}")

    one()
    return wrong


def flood(visitor, seconds, start):
    """The slowest page beside so many seconds of rubbish, and how much rubbish was sent."""
    begun = time.monotonic()
    stop, sent, generator = begun + seconds, Counter(), random.Random(start)
    lines = [b"GET / HTTP/1.1\r\n", b"POST /check HTTP/1.1\r\n", b"host: a\r\n", b"\r\n", b"{" * 99]

    def rubbish(number):
        while time.monotonic() < stop:
            kind = generator.randrange(3)
            data = (
                generator.randbytes(200) if kind == 0 else b"".join(generator.choices(lines, k=4))
            )
            visitor.raw(data, seconds=0.1)
            sent[number] += 1
            due = begun + sent[number] * THREADS / A_SECOND
            time.sleep(max(0.0, due - time.monotonic()))

    threads = [threading.Thread(target=rubbish, args=(k,), daemon=True) for k in range(THREADS)]
    for each in threads:
        each.start()
    slowest = 0.0
    while time.monotonic() < stop:
        asked = time.monotonic()
        for path in ("/", "/start"):
            assert visitor.http.get(path).status_code == 200
        slowest = max(slowest, time.monotonic() - asked)
        time.sleep(0.05)
    return slowest, sum(sent.values())


def main():
    """Send them all, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    for name, default in (("requests", 5000), ("tabs", 500), ("seed", 0), ("flood", 60)):
        parser.add_argument(f"--{name}", type=int, default=default)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as home, served(home=home) as visitor:
        visitor.http.get("/start")
        before = visitor.memory_mb()
        begun = time.monotonic()
        wrong, statuses = requests(visitor, asked.requests, asked.seed)
        wrong += tabs(visitor, asked.tabs, asked.seed)
        print(f"{asked.requests} requests and {asked.tabs} tabs: {len(wrong)} wrong")
        print(f"statuses: {dict(sorted(statuses.items()))}, {time.monotonic() - begun:.0f} s")
        if asked.flood:
            slowest, number = flood(visitor, asked.flood, asked.seed)
            print(f"flood: {number} in {asked.flood} s; the slowest page took {slowest:.3f} s")
            if slowest > PAGE_S:
                wrong.append("the page was too slow")
        print(f"memory of the server: {before:.0f} MB, then {visitor.memory_mb():.0f} MB")
        for each in wrong[:20]:
            print(each[:2000])
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
