"""Coverage-guided fuzzing of a reader's bytes with atheris; run by `scripts/fuzz`.

    python -m benchmarks.fuzz_bytes csv -max_total_time=180 [CORPUS FOLDER]

Each input is read as a file of that kind: it must be refused well (`tests.oracles.file_verdicts`),
or be taken with every number as `tests/oracles/plain_reader.py` reads it, where that one is sure.
"""

import pathlib
import sys
import tempfile

import atheris

with atheris.instrument_imports(include=["burmester.io", "tomllib", "json"]):
    import burmester.io.reading.poses
    import burmester.io.reading.tables.parquet
    import burmester.io.reading.tables.pose_rows
    import burmester.io.reading.trees.documents
    import burmester.io.reading.trees.specification_tree  # noqa: F401

from tests.oracles.file_verdicts import judged
from tests.oracles.fuzzed_files import STRANGE_WORDS, File, any_file

SUFFIXES = {"csv": ".csv", "json": ".json", "toml": ".toml", "parquet": ".parquet"}
UNITS = ({}, {"angle_unit": "deg"}, {"angle_unit": "rad"})


def main():
    """Fuzz one reader until libFuzzer's limits end it; the exit code is libFuzzer's."""
    language = sys.argv.pop(1)
    suffix, options = SUFFIXES[language], [*UNITS]
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"fuzz-{language}-"))
    corpus, words = folder / "corpus", folder / "words"
    corpus.mkdir()
    for seed in range(60):
        data = any_file(language, seed).data
        if len(data) < 4000:
            (corpus / str(seed)).write_bytes(data)
    hexes = ["".join(f"\\x{byte:02x}" for byte in word.encode()) for word in STRANGE_WORDS]
    words.write_text("".join(f'"{word}"\n' for word in hexes if word))

    def one(data):
        judged(File(data, suffix, options[len(data) % 3], None, "bytes"), folder / "poses")

    atheris.Setup(
        [
            *sys.argv,
            f"-dict={words}",
            "-timeout=5",
            "-print_final_stats=1",
            f"-artifact_prefix={folder}/",
            str(corpus),
        ],
        one,
    )
    atheris.Fuzz()


if __name__ == "__main__":
    main()
