"""Quick tests first; Hypothesis without a clock, and the same examples every time.

`pytest -m "not slow"` is the quick round.  `pytest --hypothesis-profile=search` looks for new
examples.
"""

import os

import pytest
from hypothesis import settings

settings.register_profile("search", deadline=None, print_blob=True, max_examples=300)
settings.register_profile("house", deadline=None, derandomize=True)
settings.load_profile("house")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put tests marked slow last, for each of several workers.

    pytest-xdist gives every worker one stretch of the list, all of the same length but for one
    test, and lets workers without work steal from the end of another's.  So each stretch has its
    share of quick tests, then its share of slow ones.
    """
    items[:] = _together(items)
    slow = [item for item in items if item.get_closest_marker("slow")]
    quick = [item for item in items if not item.get_closest_marker("slow")]
    left = int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    ordered: list[pytest.Item] = []
    while left:
        length, last = (len(quick) + len(slow)) // left, len(slow) // left
        ordered += quick[: length - last] + slow[:last]
        quick, slow, left = quick[length - last :], slow[last:], left - 1
    items[:] = ordered


def _together(items: list[pytest.Item]) -> list[pytest.Item]:
    """The items, those of one case one after the other in modules that are marked `together`."""
    first: dict[object, int] = {}
    keys = []
    for place, item in enumerate(items):
        case = getattr(item, "callspec", None)
        shared = case is not None and item.get_closest_marker("together") is not None
        keys.append(first.setdefault((item.path, case.id) if shared and case else place, place))
    return [item for _, item in sorted(zip(keys, items, strict=True), key=lambda each: each[0])]
