"""Outlines and surroundings on the command line: --body, --keep-out and --link-width.

Regions of file and command line are taken together; every other value is stated once.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import NamedTuple

from burmester.errors import Advice, InputError
from burmester.geometry.regions import Polygon
from burmester.io.reading.option_text import number_from_text, option_text
from burmester.io.reading.pose_table import Source
from burmester.io.reading.specification import StatedSurroundings
from burmester.tasks.surroundings import KeepOut, Surroundings


class OutlineOptions(NamedTuple):
    """--body, --keep-out and --link-width as given."""

    body: str | None = None
    keep_out: Sequence[str] = ()
    link_width: str | None = None

    def body_beside(
        self, stated: Polygon | None, length_unit: str | None
    ) -> tuple[Polygon | None, tuple[Advice, ...]]:
        """The outline of the body, that of the file or that of --body; E108 for both."""
        if self.body is None:
            return stated, ()
        if stated is not None:
            message = "the outline of the body is given in the file and by --body"
            raise InputError("E108", message, help="leave --body out, or body in the file")
        outline, note, _ = _outline("--body", self.body, length_unit)
        return outline, (note,)

    def surroundings_beside(
        self, stated: StatedSurroundings, length_unit: str | None
    ) -> tuple[StatedSurroundings, tuple[Advice, ...]]:
        """The surroundings of file and options together; E108 for two widths of the links."""
        regions, notes = list(stated.keep_out), []
        for text in self.keep_out:
            outline, note, name = _outline("--keep-out", text, length_unit)
            regions.append(KeepOut(outline, name))
            notes.append(note)
        values = dict(stated.values)
        if self.link_width is not None:
            if "link_width" in values:
                message = "the width of the links is given in the file and by --link-width"
                help = "leave --link-width out, or link_width in the file"
                raise InputError("E108", message, help=help)
            source = Source("--link-width", self.link_width)
            values["link_width"] = number_from_text(source, self.link_width, 0, "E176")
            try:
                Surroundings(link_width=values["link_width"])
            except InputError as error:
                error.where = source.where(0, len(self.link_width))
                raise
        return StatedSurroundings(tuple(regions), values, stated.where), tuple(notes)


def _outline(option: str, text: str, length_unit: str | None) -> tuple[Polygon, Advice, str]:
    """The outline in FILE or FILE:PART, how it was read, and a name for it."""
    from burmester.io.reading.outlines.outline_file import outline_named, read_outline

    file = outline_named(text)
    name = file.part or os.path.splitext(os.path.basename(file.path))[0]
    try:
        return *read_outline(file, "", length_unit), name
    except InputError as error:
        error.where = option_text(option, [text])
        raise
