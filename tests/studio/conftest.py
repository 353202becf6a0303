"""One studio for the tests of this room, and the task that it opens on."""

import pytest

from tests.oracles.studio import FIVE, served


@pytest.fixture(scope="session")
def visitor(tmp_path_factory):
    """Who opened the address of a studio."""
    with served(home=tmp_path_factory.mktemp("state")) as one:
        yield one


@pytest.fixture(scope="session")
def start(visitor):
    """What the page is told first."""
    return visitor.http.get("/start").json()


@pytest.fixture(scope="session")
def five(tmp_path_factory):
    """A file of five poses, whose linkages are found at once."""
    file = tmp_path_factory.mktemp("five") / "five.csv"
    file.write_text(FIVE, encoding="ascii")
    return str(file)
