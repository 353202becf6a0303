"""What readers refuse, with a place and a help in each case."""

from collections.abc import Callable

import pytest

from burmester.errors import InputError
from burmester.tasks.motion_task import Task


def refusal(attempt: Callable[[], object]) -> InputError:
    with pytest.raises(InputError) as caught:
        attempt()
    assert caught.value.where
    assert caught.value.help
    return caught.value


def outcome(attempt: Callable[[], Task]) -> Task | InputError:
    try:
        return attempt()
    except InputError as error:
        return error
