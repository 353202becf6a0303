"""Files of the tests of readers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Task]:
    """Read text or bytes as if they were the file `poses.SUFFIX`."""
    folder = tmp_path_factory.mktemp("read")

    def read(content: str | bytes, suffix: str = ".csv", **options: Any) -> Task:
        path = folder / f"poses{suffix}"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_task(path, **options)

    return read
