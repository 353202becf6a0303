"""Linkages as lines of a table: for a prompt as text, for a notebook as HTML."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from html import escape

from burmester.describe.decimals import decimals_of_linkage
from burmester.describe.dimensions import angle_error, degrees, dimensions_of
from burmester.describe.quality_words import in_short
from burmester.numerics.arrays import ROUNDING
from burmester.tasks.length_per_radian import default_length_per_radian
from burmester.tasks.motion_task import characteristic_length
from burmester.tasks.notation import length_of
from burmester.verdicts.explanation import nearness
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import least_angle, listed

HEADS = ("", "type", "dyads", "worst", "angle", "transm.", "ext.", "sens.", "")
NUMBERS = range(3, 8)  # columns of numbers, set to the right


def as_line(linkage: FoundLinkage) -> str:
    """A linkage in one line: "L1: crank-rocker of D1 and D2, misses by ..."."""
    first, second = linkage.ids
    how = nearness(linkage, linkage.task, characteristic_length(linkage.task))
    least = least_angle(linkage.least_transmission)
    sure = f", transmission angle {least} or more" if linkage.usable else ", not usable"
    kind = linkage.type
    if linkage.other_types:
        kind += f" (or {listed(linkage.other_types, 'or')} within ±)"
    return f"{linkage.id}: {kind} of {first} and {second}, {how}{sure}"


def as_text(
    heads: Sequence[str], rows: Sequence[Sequence[str]], numbers: Container[int], most: int
) -> list[str]:
    """A line of heads and at most `most` lines of linkages, the last one a count of the rest."""
    shown = rows if len(rows) <= most else rows[: most - 1]
    if not shown:
        return []
    every = [heads, *shown]
    widths = [max(len(row[k]) for row in every) for k in range(len(heads))]
    lines = [
        "  ".join(
            cell.rjust(width) if k in numbers else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in every
    ]
    if len(shown) < len(rows):
        lines.append(f"and {len(rows) - len(shown)} more")
    return lines


def plain_html(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    numbers: Container[int],
    faint: Container[int] = (),
) -> str:
    """A table element of texts; numbers: the columns set to the right; faint: the paler rows."""

    def row(cells: Sequence[str], tag: str, style: str = "") -> str:
        inner = ""
        for k, cell in enumerate(cells):
            side = "right" if k in numbers else "left"
            inner += f'<{tag} style="text-align:{side}">{escape(cell)}</{tag}>'
        return f"<tr{style}>{inner}</tr>"

    pale = ' style="opacity:.6"'
    body = "".join(row(each, "td", pale if k in faint else "") for k, each in enumerate(rows))
    head = f"<thead>{row(heads, 'th')}</thead>" if heads else ""
    return f"<table>{head}<tbody>{body}</tbody></table>"


def dimensions_as_html(linkage: FoundLinkage) -> str:
    """A table element of a linkage's dimensions, with the decimals that keep its error."""
    task, own = linkage.task, linkage.driver_first
    decimals = decimals_of_linkage(
        own,
        task.poses,
        linkage.error,
        default_length_per_radian(task),
        characteristic_length(task),
        free_angles=task.free_angles,
    )
    rows = "".join(
        f"<tr><td>{escape(each.dyad)}</td><td>{each.what}</td>"
        f'<td style="text-align:right">{each.value}</td></tr>'
        for each in dimensions_of((own.first, own.second), linkage.ids, decimals)
    )
    return f"<table><tbody>{rows}</tbody></table>"


def cells(linkage: FoundLinkage) -> tuple[str, ...]:
    """One linkage by columns."""
    error, task = linkage.error, linkage.task
    exact = error.worst < ROUNDING * characteristic_length(task)
    angle = "free" if task.angles_are_free else angle_error(float(error.angle.max()))
    return (
        linkage.id,
        linkage.type,
        " ".join(linkage.ids),
        "exact" if exact else length_of(error.worst, task),
        angle if math.isfinite(error.worst) else degrees(math.nan),
        least_angle(linkage.least_transmission),
        *in_short(linkage.quality),
        "" if linkage.usable else "not usable",
    )
