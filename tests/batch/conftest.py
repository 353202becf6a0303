"""Batches of these tests share their workers: starting a process costs more than its few tasks."""

import pytest

from burmester.batch import job
from burmester.batch.engines import Processes


class Lasting:
    """Processes of the machine that a run leaves to the next one."""

    lost, tries = Processes.lost, Processes.tries

    def __init__(self, processes):
        self._processes = processes
        self.size, self.submit = processes.size, processes.submit

    def close(self):
        """They are ended with the session."""


@pytest.fixture(scope="session")
def lasting():
    """Processes by their number."""
    started = {}
    yield started
    for each in started.values():
        each.close()


@pytest.fixture(autouse=True, scope="session")
def shared_workers(lasting):
    """Runs in this process share workers; commands start their own, as do those with a limit."""

    def engine(workers, memory=None):
        if memory is not None:
            return Processes(workers, memory)
        if workers not in lasting:
            lasting[workers] = Processes(workers)
        return Lasting(lasting[workers])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(job, "Processes", engine)
        yield
