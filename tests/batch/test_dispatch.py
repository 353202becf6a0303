"""What a task does to its worker ends with that task: the others are done, and it is told."""

import pytest

from burmester.batch.dispatch import Dispatch
from burmester.batch.engines import Processes
from burmester.batch.parts import Part
from tests.oracles.batches import (
    ENDLESS,
    FIRST_ONLY,
    GREEDY,
    HALF,
    KILLS,
    RAISES,
    TOGETHER,
    Numbers,
    squares,
)

KILLED = "its worker ended each time: killed, or out of memory"


@pytest.fixture(scope="module")
def engine():
    processes = Processes(2, memory=3 << 30)
    yield processes
    processes.close()


def dispatched(engine, parts, folder, most=None, **settings):
    """What came of parts of numbers, by their places, and whether that is all.

    most: so many parts done are enough.
    """
    if most is not None:
        settings["stopped"] = lambda: len(kept) >= most
    kept = {}

    def keep(part, worked):
        assert part.number not in kept
        kept[part.number] = worked

    numbered = (Part(k, Numbers(tuple(each)), 1.0) for k, each in enumerate(parts))
    dispatch = Dispatch(engine, squares, str(folder), keep, **settings)
    return kept, dispatch.run(numbered)


def test_tasks_that_harm_their_workers_are_found_and_told(engine, tmp_path):
    parts = [[k, k + 1] for k in range(0, 12, 2)]
    parts[1] = [5, FIRST_ONLY]
    parts[2] = [1, KILLS, 2]
    parts[4] = [7, 8, RAISES]
    parts[5] = [GREEDY, 3]
    kept, whole = dispatched(engine, parts, tmp_path)
    assert whole
    assert kept == {
        0: ([0, 1], {}),
        1: ([25, FIRST_ONLY**2], {}),
        2: ([1, 4], {1: KILLED}),
        3: ([36, 49], {}),
        4: ([49, 64], {2: "burmester itself failed: ValueError: no such number"}),
        5: ([9], {0: "it needs more memory than its worker may have"}),
    }


def test_a_worker_that_is_killed_in_the_midst_of_its_answer_holds_nobody_up(engine, tmp_path):
    kept, whole = dispatched(engine, [[1], [2], [HALF, 3], [4], [5]], tmp_path)
    assert whole
    assert kept.pop(2) == ([9], {0: KILLED})
    assert kept == {0: ([1], {}), 1: ([4], {}), 3: ([16], {}), 4: ([25], {})}


def test_a_task_that_never_ends_is_ended(engine, tmp_path):
    kept, whole = dispatched(engine, [[1], [ENDLESS, 4], [9]], tmp_path, limit=0.5)
    assert whole
    assert kept == {0: ([1], {}), 1: ([16], {0: "it takes longer than 0.5 s"}), 2: ([81], {})}


def test_tasks_that_fail_together_only_fail_together(engine, tmp_path):
    kept, whole = dispatched(engine, [[3, TOGETHER, 4]], tmp_path)
    assert whole
    told = "burmester itself failed: ValueError: too many"
    assert kept == {0: ([], dict.fromkeys(range(3), told))}


def test_a_part_that_stopping_leaves_out_is_not_counted_as_done(engine, tmp_path):
    kept, whole = dispatched(engine, [[k] for k in range(50)], tmp_path, most=3)
    assert not whole
    assert kept == {k: ([k * k], {}) for k in sorted(kept)}
    assert 3 <= len(kept) < 50


def test_all_that_was_done_when_somebody_stops_is_all(engine, tmp_path):
    stopped = []
    kept, whole = dispatched(
        engine, [[2]], tmp_path, stopped=lambda: bool(stopped), tick=lambda: stopped.append(1)
    )
    assert whole
    assert kept == {0: ([4], {})}
