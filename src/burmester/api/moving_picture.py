"""A linkage that moves, as a notebook shows it."""

from __future__ import annotations

import base64
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import final

from burmester.api.python_words import in_python_words
from burmester.io import files


@final
@dataclass(frozen=True, slots=True)
class MovingPicture:
    """A GIF of a linkage that goes through its poses.

    gif: the bytes of the file; title: a sentence in place of the picture.
    """

    gif: bytes = field(repr=False)
    title: str

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the picture; raises InputError E140 (the file exists) and E141 (no writing)."""
        with in_python_words():
            files.write(path, self.gif, force=force)
        return Path(path)

    def _repr_html_(self) -> str:
        data = base64.b64encode(self.gif).decode()
        return f'<img alt="{self.title}" src="data:image/gif;base64,{data}">'
