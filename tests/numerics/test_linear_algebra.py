"""BLAS keeps to one thread for as long as anybody asks for it, and no longer."""

from threading import Event, Thread

import pytest
from threadpoolctl import ThreadpoolController

from burmester.numerics.linear_algebra import one_thread


@pytest.fixture
def threads():
    """How many threads BLAS has now, on a machine that gave it two."""
    blas = ThreadpoolController().select(user_api="blas")
    with blas.limit(limits=2):

        def counted():
            return {each["num_threads"] for each in blas.info()}

        if counted() != {2}:
            pytest.skip("this BLAS takes no number of threads")
        yield counted


def test_uses_that_overlap_leave_what_they_met(threads):
    """The first ends while the second goes on, in another thread."""
    inside, first_is_over = Event(), Event()
    seen = []

    def second():
        with one_thread():
            inside.set()
            first_is_over.wait(10)
            seen.append(threads())

    other = Thread(target=second)
    with one_thread():
        other.start()
        inside.wait(10)
        with one_thread():
            assert threads() == {1}
        assert threads() == {1}
    first_is_over.set()
    other.join()
    assert seen == [{1}]
    assert threads() == {2}


def test_an_error_ends_a_use(threads):
    with pytest.raises(ZeroDivisionError), one_thread():
        1 / 0  # noqa: B018
    assert threads() == {2}
