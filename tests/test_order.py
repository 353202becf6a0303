"""Slow tests come last, in the stretch of each worker."""

import pytest

from tests.conftest import pytest_collection_modifyitems


class Item:
    def __init__(self, number, slow):
        self.number, self.slow = number, slow

    def get_closest_marker(self, name):
        return name == "slow" and self.slow


@pytest.mark.parametrize("workers", [1, 2, 3, 8])
@pytest.mark.parametrize(("count", "every"), [(40, 3), (41, 7), (5, 1), (3, 9), (0, 1)])
def test_each_worker_has_its_share_of_both_and_the_slow_ones_last(
    workers, count, every, monkeypatch
):
    monkeypatch.setenv("PYTEST_XDIST_WORKER_COUNT", str(workers))
    items = [Item(k, k % every == 0) for k in range(count)]
    total = sum(item.slow for item in items)
    pytest_collection_modifyitems(items)
    assert sorted(item.number for item in items) == list(range(count))
    left = list(items)
    for idle in range(workers, 0, -1):  # as pytest-xdist deals them out
        stretch = left[: len(left) // idle]
        left = left[len(stretch) :]
        numbers = [(item.slow, item.number) for item in stretch]
        assert numbers == sorted(numbers)
        assert abs(sum(item.slow for item in stretch) - total / workers) < 1
    assert left == []
