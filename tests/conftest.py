"""Which tests run, how much of them, and in which order.

Every test is in one of three layers, and has its name as a marker.  `campaign` is a search of many
cases, each much like the next: they differ by a `seed` or `number`, or tests/layers.toml names the
test.  By default a sample of them is run, and all of them with `scripts/test --all`.  Where
the sample is no fifth, layers.toml says what it is.  The others are `unit` where they are light,
and else `cross`: whole runs and comparisons with oracles.  What is light is measured: `--weigh`
keeps the seconds of each test in tests/weights.json.

A run of everything is one of a series.  The date says which sample it takes, and tests that are
not light take turns: each case is run on every third to seventh day by the weight of its test
(`TURNS`), except what layers.toml lists as `daily`.  The sample of a campaign that is not light
takes two days.
`SAMPLE_DAY=NUMBER`, which the head of a run shows, repeats it.  A run of named tests has no turns,
and always the same sample.

A worker takes whole files, so that what is set up for a file is set up once: first those that need
a browser, then the heaviest, so that all workers end together.
"""

import json
import os
import sys
import tomllib
import zlib
from collections import defaultdict
from contextlib import ExitStack
from datetime import date
from pathlib import Path

import pytest
from _pytest.doctest import DoctestModule
from hypothesis import settings

from tests import solved
from tests.oracles import browser as browsers
from tests.samples import EVERY, share

solved.install()
# jsonschema checks no format of ours by it, and its grammars take a second to build.
sys.modules.setdefault("rfc3987_syntax", None)

FOLDER = Path(__file__).parent
WEIGHTS = FOLDER / "weights.json"
DRAWN = {"seed", "number"}  # what a test is given to draw its case by
# The seconds of a test function, with all its cases, above which each case has its turn on every
# so-manieth day; what has none is `unit`.
TURNS = {0.5: 3, 1.0: 4, 3.0: 5, 8.0: 7}
LIGHT_S = min(TURNS)
DAY = (
    "SAMPLE_DAY"  # a variable with the day of a run of everything; with 0, or none, of named files
)

settings.register_profile("house", deadline=None, derandomize=True, max_examples=share(100))
settings.register_profile("search", deadline=None, print_blob=True, max_examples=300)
settings.load_profile("house")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--weigh", action="store_true", help="keep how long each test takes")


def pytest_configure(config: pytest.Config) -> None:
    config.option.loadscopereorder = False  # files are handed out in the order that is set below
    everything = config.args_source is pytest.Config.ArgsSource.TESTPATHS
    if everything and not (config.option.keyword or config.option.weigh):
        os.environ.setdefault(DAY, str(date.today().toordinal()))  # for all workers


def pytest_report_header() -> str | None:
    return f"{DAY}={os.environ[DAY]}" if DAY in os.environ else None


@pytest.hookimpl(wrapper=True)
def pytest_collect_file():
    """Tests have no doctests; to look for some takes longer than to find their functions."""
    return [each for each in (yield) if not isinstance(each, DoctestModule)]


@pytest.hookimpl(tryfirst=True)  # before pytest leaves out those without an asked marker
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the layers, leave out all but a sample of each campaign, and put heavy files first."""
    weights = json.loads(WEIGHTS.read_text())
    layers = tomllib.loads((FOLDER / "layers.toml").read_text())
    samples: dict[str, int | list[str]] = layers["sample"]
    nightly: dict[str, list[str]] = layers["nightly"]
    campaigns = {*layers["campaign"], *samples}
    day = int(os.environ.get(DAY, "0"))
    files: dict[str, float] = defaultdict(float)
    for name, seconds in weights.items():
        files[name.partition("::")[0]] += seconds
    heaviest = sorted(files, key=files.__getitem__, reverse=True)
    cross: dict[str, list[pytest.Item]] = defaultdict(list)
    drawn: dict[tuple[str, ...], list[pytest.Item]] = defaultdict(list)
    left_out: set[pytest.Item] = set()
    for item in items:
        name, by = _function(item), getattr(item, "callspec", None)
        if not EVERY and by is not None and by.id in nightly.get(name, ()):
            left_out.add(item)
        params = {} if by is None else by.params
        if name in campaigns or not DRAWN.isdisjoint(params):
            item.add_marker("campaign")
            others = () if name in campaigns else [str(params[k]) for k in params.keys() - DRAWN]
            drawn[name, *sorted(others)].append(item)
        elif weights.get(name, 0.0) > LIGHT_S:
            item.add_marker("cross")
            cross[name].append(item)
        else:
            item.add_marker("unit")
    heavy = {name for name, seconds in weights.items() if day and seconds > LIGHT_S}
    for name in cross.keys() & heavy - {*layers["daily"]} if not EVERY else ():
        turns = max(days for least, days in TURNS.items() if weights[name] > least)
        # Tests of one file have the same days, so that what they share is set up on those alone,
        # and files that are about as heavy have different ones.
        first = day + heaviest.index(name.partition("::")[0])
        left_out.update(each for k, each in enumerate(cross[name]) if (first + k) % turns)
    for (name, *_), cases in drawn.items() if not EVERY else ():
        cases.sort(key=lambda item: zlib.crc32(item.nodeid.encode()))
        kept = samples.get(name, share(len(cases)))
        days, today = (
            (2, day + heaviest.index(name.partition("::")[0])) if name in heavy else (1, day)
        )
        if isinstance(kept, int):
            taken = range(today * kept // days, (today + 1) * kept // days)
            numbers = {number % len(cases) for number in taken}
            left_out.update(each for k, each in enumerate(cases) if k not in numbers)
        else:
            kept = [each for k, each in enumerate(kept) if (today + k) % days == 0]
            left_out.update(item for item in cases if item.callspec.id not in kept)
    if left_out:
        config.hook.pytest_deselected(items=list(left_out))
    taken = [item for item in items if item not in left_out]
    _in_browser.update(
        each.path for each in taken if "browser" in getattr(each, "fixturenames", ())
    )

    def order(item: pytest.Item) -> tuple[bool, float, str]:
        return item.path not in _in_browser, -files[_file(item)], _file(item)

    items[:] = sorted(taken, key=order)


def _file(item: pytest.Item) -> str:
    return item.nodeid.partition("::")[0]


def _function(item: pytest.Item | pytest.TestReport) -> str:
    """A test function without the brackets of its case."""
    return item.nodeid.partition("[")[0]


# --- the one browser of a worker

_open = ExitStack()
_browsers: list[object] = []
_in_browser: set[Path] = set()  # files with tests that need it


@pytest.fixture(scope="module")
def browser():
    """The browser, in which each test opens pages of its own."""
    if not _browsers:
        _browsers.append(_open.enter_context(browsers.launched()))
    return _browsers[0]


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(nextitem: pytest.Item | None) -> None:
    """Close it before files without it, as its driver keeps this thread's event loop."""
    if _browsers and (nextitem is None or nextitem.path not in _in_browser):
        _open.close()
        _browsers.clear()


# --- how long each test takes

_measured: dict[str, float] = defaultdict(float)
_before = [0.0]  # of processor time, with that of children that have ended


def pytest_runtest_logstart() -> None:
    _before[0] = sum(os.times()[:4])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item):
    """Tell the processor time: the clock goes on where the machine does other things, or sleeps.

    Of a test in a browser, which ends long after it, the clock says more.
    """
    report, now = (yield), sum(os.times()[:4])
    report.weight = report.duration if item.path in _in_browser else now - _before[0]
    _before[0] = now
    return report


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    _measured[_function(report)] += getattr(report, "weight", 0.0)  # none of a worker that died


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Of the files that were run, put what was measured in the place of what was known."""
    if not session.config.getoption("weigh", False) or hasattr(session.config, "workerinput"):
        return
    files = {name.partition("::")[0] for name in _measured}
    known = json.loads(WEIGHTS.read_text())
    weights = {name: s for name, s in known.items() if name.partition("::")[0] not in files}
    weights |= {name: round(s, 1) for name, s in _measured.items() if s >= 0.05}
    WEIGHTS.write_text(json.dumps(dict(sorted(weights.items())), indent=0) + "\n")
