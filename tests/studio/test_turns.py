"""Whoever is called off leaves turn and worker to the next one, whenever that happens."""

import asyncio

import pytest

from burmester.studio.workers import Turns, Workers


async def taken(turns, done, name, work):
    """Wait for a turn, keep it for a while, and note it."""
    async with turns.turn(lambda before: None):
        for _ in range(work):
            await asyncio.sleep(0)
        done.append(name)


async def steps(number):
    for _ in range(number):
        await asyncio.sleep(0)


@pytest.mark.parametrize("before", range(6))
@pytest.mark.parametrize("which", [(1,), (2,), (1, 2), (2, 1), (0, 1)])
def test_a_turn_that_is_called_off_goes_to_the_next(which, before):
    """At any step of the loop, also in that in which the turn comes; all others are served."""

    async def play():
        turns, done, wrong = Turns(1), [], []
        asyncio.get_running_loop().set_exception_handler(lambda _, told: wrong.append(told))
        tasks = [asyncio.create_task(taken(turns, done, k, 2)) for k in range(5)]
        await steps(before)
        for k in which:
            tasks[k].cancel()
        told = await asyncio.wait_for(asyncio.gather(*tasks, return_exceptions=True), 10)
        assert [type(each) for each in told if each] == [asyncio.CancelledError] * (5 - len(done))
        assert set(range(5)) - set(which) <= set(done)
        async with asyncio.timeout(10), turns.turn(lambda before: None):
            pass
        assert wrong == []

    asyncio.run(play())


def test_who_waits_is_told_how_many_are_before():
    async def play():
        turns, told = Turns(1), [[] for _ in range(4)]

        async def wait(number):
            async with turns.turn(told[number].append):
                await steps(2)

        tasks = [asyncio.create_task(wait(number)) for number in range(4)]
        await steps(1)
        assert told == [[], [1], [2], [3]]
        tasks[1].cancel()
        await asyncio.wait(tasks)
        assert told == [[], [1], [2, 1], [3, 2, 1]]

    asyncio.run(play())


@pytest.mark.parametrize("before", range(5))
@pytest.mark.parametrize(("off", "on"), [(1, 2), (2, 1)])
def test_a_worker_that_comes_free_goes_to_who_still_waits(before, off, on):
    """One of two who wait is called off when the worker comes back, or a few steps after."""

    async def play():
        workers, got = Workers(1, 0), []
        rests = [asyncio.get_running_loop().create_future() for _ in range(3)]

        async def use(name):
            async with workers.lent():
                got.append(name)
                await rests[name]

        tasks = [asyncio.create_task(use(k)) for k in range(3)]
        try:
            while not got:
                await asyncio.sleep(0.001)
            rests[0].set_result(None)
            await steps(before)
            tasks[off].cancel()
            rests[on].set_result(None)
            await asyncio.wait_for(tasks[on], 10)
            assert on in got
        finally:
            await workers.close()

    asyncio.run(play())
