"""Play all scenes and keep their fingerprints: python -m tests.golden [--write FOLDER] [SCENE ...].

With --write the documents themselves are left in a folder, to be compared by `diff -r` with those
of another commit; nothing is kept then.
"""

import argparse
import tempfile
import time
from pathlib import Path

from tests.golden.commands import SCENES
from tests.golden.documents import played
from tests.golden.fingerprint import of_text
from tests.golden.record import keep, kept


def main() -> None:
    """Print the seconds of each scene and which of its documents changed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--write", type=Path)
    asked = parser.parse_args()
    known = kept()
    for name in asked.scenes or SCENES:
        began = time.process_time()
        with tempfile.TemporaryDirectory() as folder:
            documents = dict(played(SCENES[name], Path(folder)))
        print(f"{time.process_time() - began:6.1f} s  {name}: {len(documents)} documents")
        if asked.write:
            for number, text in enumerate(documents.values()):
                path = asked.write / name / f"{number:02}.txt"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            continue
        own = {each: of_text(text) for each, text in documents.items()}
        for each in own.keys() | known.get(name, {}).keys():
            if own.get(each) != known.get(name, {}).get(each):
                print(f"          other: {each}")
        known[name] = own
    if not asked.write:
        keep({name: known[name] for name in SCENES if name in known})


if __name__ == "__main__":
    main()
