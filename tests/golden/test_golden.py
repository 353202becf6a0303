"""Every document is what it was.

One that changes on purpose is looked at (`python -m tests.golden --write FOLDER`, at both commits)
and kept anew by `python -m tests.golden`; the commit says which changed, and why it is better.
"""

from pathlib import Path

import pytest

from tests.golden.commands import SCENES
from tests.golden.documents import played
from tests.golden.fingerprint import difference, of_text
from tests.golden.record import kept

KNOWN = kept()


@pytest.mark.parametrize("name", SCENES)
def test_documents_are_as_they_were(name: str, tmp_path: Path):
    known, wrong, seen = KNOWN[name], [], set()
    for document, text in played(SCENES[name], tmp_path):
        seen.add(document)
        if document not in known:
            wrong.append(f"{document}: is new")
        elif (other := difference(text, known[document])) is not None:
            wrong.append(f"{document}: {other}")
    wrong += [f"{each}: is gone" for each in known.keys() - seen]
    assert not wrong, "\n".join(wrong)


def test_a_change_in_the_fifth_digit_and_two_numbers_exchanged_are_seen():
    text = "L1 from (1.25, 3.75) turns 31.4159 degrees, 1e-17 off"
    known = of_text(text)
    assert difference(text.replace("1e-17", "-3e-16"), known) is None
    assert difference(text.replace("31.4159", "31.4169"), known) is not None
    assert difference(text.replace("1.25, 3.75", "3.75, 1.25"), known) is not None
    assert difference(text.replace("turns", "turn"), known) is not None
