"""Numbers of the page's script, made in a browser, as the terminal writes them."""

import base64
from importlib import resources

import numpy as np
import pytest

from burmester.wording import figure

# Two digits, at both ends of each way to write a number, and carried over by rounding.
EDGES = [
    0.0,
    1.0,
    0.995,
    9.95,
    9.94999,
    99.4,
    99.5,
    100.4,
    999999.4,
    1e6,
    1e-4,
    9.96e-5,
    1e-12,
    3e15,
]


@pytest.fixture(scope="module")
def run(browser):
    """Calls of functions of numbers.mjs, which imports nothing."""
    module = (resources.files("burmester.web") / "widget" / "numbers.mjs").read_bytes()
    address = f"data:text/javascript;base64,{base64.b64encode(module).decode()}"
    page = browser.new_page()
    yield lambda name, calls: page.evaluate(
        "async ([address, name, calls]) => {"
        " const module = await import(address);"
        " return calls.map((each) => module[name](...each)); }",
        [address, name, calls],
    )
    page.close()


def test_figures_are_those_of_the_terminal(run):
    rng = np.random.default_rng(1)
    spread = 10 ** rng.uniform(-12, 9, 2000) * rng.choice([-1, 1], 2000)
    values = [*EDGES, *spread.tolist()]
    assert run("figure", [[value] for value in values]) == [figure(value) for value in values]


def test_ticks_are_round_numbers_between_the_ends(run):
    rng = np.random.default_rng(2)
    low = rng.normal(size=200) * 10 ** rng.uniform(-3, 4, 200)
    high = low + 10 ** rng.uniform(-2, 4, 200)
    calls = [[a, b, 5] for a, b in zip(low.tolist(), high.tolist(), strict=True)]
    for (a, b, _), marks in zip(calls, run("ticks", calls), strict=True):
        at = np.array([mark["at"] for mark in marks])
        size = b - a
        assert 2 <= len(at) <= 11
        assert (at >= a - 1e-6 * size).all()
        assert (at <= b + 1e-6 * size).all()
        step = at[1] - at[0]
        assert np.diff(at) == pytest.approx(step, rel=1e-6)
        assert step / 10 ** np.floor(np.log10(step * 1.001)) == pytest.approx(
            min(
                (1, 2, 5),
                key=lambda lead: abs(step / 10 ** np.floor(np.log10(step * 1.001)) - lead),
            )
        )
        # Another tick on either side would be outside.
        assert at[0] - step < a
        assert at[-1] + step > b
        for mark in marks:
            assert float(mark["text"]) == pytest.approx(mark["at"], abs=1e-6 * step)


def test_runs_of_poses_are_drawn_together(run):
    names = list("abcdefgh")
    calls = [[[1, 2, 3, 4, 7], names], [[1, 2], names], [[5], names], [[1, 3, 4, 6, 7, 8], names]]
    assert run("runs", calls) == ["a–d and g", "a and b", "e", "a, c, d and f–h"]
