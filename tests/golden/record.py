"""The fingerprints that are kept, by scene and document."""

import json
from pathlib import Path

from tests.golden.fingerprint import Fingerprint

RECORD = Path(__file__).with_name("record.json")

Record = dict[str, dict[str, Fingerprint]]


def kept() -> Record:
    """Those of the record."""
    if not RECORD.exists():
        return {}
    return {
        scene: {
            name: Fingerprint(words, count, tuple(sums))
            for name, (words, count, sums) in documents.items()
        }
        for scene, documents in json.loads(RECORD.read_text()).items()
    }


def keep(record: Record) -> None:
    """Write the record, a line for each document."""
    scenes = []
    for scene, documents in record.items():
        lines = [f"  {json.dumps(name)}: {json.dumps(each)}" for name, each in documents.items()]
        scenes.append(f"{json.dumps(scene)}: {{\n" + ",\n".join(lines) + "\n}")
    RECORD.write_text("{\n" + ",\n".join(scenes) + "\n}\n")
