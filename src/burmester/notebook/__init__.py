"""The studio as a widget of a notebook: poses to drag, and Python variables that follow.

E130 anywidget is missing
"""

from __future__ import annotations

from importlib.util import find_spec

from burmester.errors import InputError

if find_spec("anywidget") is None:
    raise InputError(
        "E130",
        "the widget needs anywidget",
        why="it is not installed with burmester, which does without it for everything else",
        help='pip install "burmester[notebook]"',
    )

from burmester.notebook.studio import Studio

__all__ = ["Studio"]
