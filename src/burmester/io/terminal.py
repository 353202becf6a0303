"""A synthesis, the reproduction of the paper and errors, as a terminal shows them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from burmester.candidates import ROUNDING
from burmester.comparison import Section, Verdict
from burmester.dyad import PP, PR, RP, RR, Dyad
from burmester.errors import BurmesterError
from burmester.synthesis import FoundLinkage, Synthesis

if TYPE_CHECKING:
    from burmester.methods import Answer
    from burmester.side_by_side import SideBySide

__all__ = ["show_error", "show_reproduction", "show_synthesis"]

DIGITS = 1e-4  # of the characteristic length: what pivots are shown to, errors permitting


def show_synthesis(synthesis: Synthesis, console: Console) -> None:
    """What was found, first in a sentence, then as tables of dyads and linkages."""
    code, message = synthesis.outcome.code, synthesis.outcome.message
    if synthesis.linkages:
        best = synthesis.linkages[0]
        console.print(Text(f"{message}.", style="bold"))
        kind = best.linkage.type.replace("change-point", "change-point linkage")
        article = "an" if kind[0] in "aeiouAEIOU" else "a"
        console.print(f"Best: {best.id}, {article} {kind}, {_meets(synthesis, best)}.")
    else:
        console.print(Text(f"result[{code}]: {message}", style="bold"))
    if synthesis.outcome.help:
        console.print(Text(f"  help: {synthesis.outcome.help}"))
    if synthesis.dyads:
        console.print(_dyads(synthesis))
    if synthesis.linkages:
        console.print(_linkages(synthesis))
        unit = synthesis.task.length_unit
        console.print(
            f"\nLengths in {unit or 'the unit of the poses'}; F is the ground, M the body. Not "
            "judged yet: whether a linkage meets the poses in one assembly, without locking and "
            "in their order.",
            style="dim",
        )
    if synthesis.certificate is not None:
        for head, sentences in (
            ("Proved, for the poses as given", synthesis.certificate.proved),
            ("Computed, not proved", synthesis.certificate.numerical),
        ):
            if sentences:
                console.print(Text(f"\n{head}:", style="bold"))
                console.print(_bullets(sentences))
    for warning in synthesis.warnings:
        console.print(Text(f"warning[{warning.code}]: {warning.message}", style="yellow"))
        console.print(Text(f"  help: {warning.help}"))


def show_reproduction(
    sections: Sequence[Section], tasks: Sequence[SideBySide], console: Console
) -> None:
    """The paper's numbers beside the computed ones, its tasks by five methods, and a count."""
    for section in sections:
        console.print(Text(f"\n{section.title}", style="bold"))
        if section.rows:
            console.print(_comparisons(section))
        for row in section.rows:
            if row.note:
                console.print(Text(f"{row.item}: {row.note}", style="dim"))
        for remark in section.remarks:
            console.print(Text(remark))
    if tasks:
        console.print(Text("\nThe same tasks by other methods", style="bold"))
        console.print(
            "rms and worst: the misses of the circle. starts: how many random ones lead to the "
            "dyad, the same for all; pencil (normalised) and complete method need none."
        )
    for task in tasks:
        console.print(Text(f"\n{task.title} by five methods", style="bold"))
        console.print(_methods(task))
        for remark in _of_starts(task.answers):
            console.print(Text(remark))
    counts = Counter(row.verdict for section in sections for row in section.rows)
    said = ", ".join(f"{counts[verdict]} {verdict}" for verdict in Verdict)
    console.print(Text(f"\n{sum(counts.values())} printed numbers: {said}", style="bold"))


def show_error(error: BurmesterError, console: Console) -> None:
    """An error as it stands, its code in colour where there is colour."""
    head, _, rest = str(error).partition(": ")
    console.print(Text(head, style="bold red") + Text(": " + rest), soft_wrap=True)


def _methods(task: SideBySide) -> Table:
    starts = max(answer.starts or 0 for answer in task.answers)
    table = _table()
    table.add_column("", no_wrap=True)
    for name in ("fixed pivot", "moving pivot", "length", "rms", "worst", f"starts\nof {starts}"):
        table.add_column(name, justify="right", no_wrap=True)
    for answer in task.answers:
        counts = ["none"] if answer.reached is None else [str(n) for n in answer.reached]
        if answer.reached and len(answer.rms_error) > len(counts):
            counts.append("both")  # found at once
        rows = [_circle(answer, k) for k in range(len(answer.rms_error))] or [["-"] * 5]
        for name, row, count in zip_longest([answer.method], rows, counts, fillvalue=""):
            table.add_row(name, *row, count)
    return table


def _circle(answer: Answer, k: int) -> list[str]:
    dyad = answer.dyads[k]
    pivots = [f"({x:.3f}, {y:.3f})" for x, y in (dyad.fixed_pivot, dyad.moving_pivot)]
    errors = [f"{error[k]:.1e}" for error in (answer.rms_error, answer.max_error)]
    return [*pivots, f"{dyad.radius:.3f}", *errors]


def _of_starts(answers: Sequence[Answer]) -> list[str]:
    needed = [f"{a.method} {_short(a.needed)}" for a in answers if a.needed is not None]
    settled = [f"{a.method} {a.settled} of {a.starts}" for a in answers if a.starts is not None]
    seconds = [
        f"{a.method} {_short(a.seconds)} s"
        if a.seconds >= 0.1
        else f"{a.method} {_short(1e3 * a.seconds)} ms"
        for a in answers
    ]
    return [
        f"Random starts until both dyads are found, on average: {', '.join(needed)}.",
        f"Starts that come to rest in a minimum at all: {', '.join(settled)}.",
        f"Time on this machine, all starts together: {', '.join(seconds)}.",
    ]


_STYLE = {Verdict.MISPRINT: "yellow", Verdict.DIFFERS: "bold red", Verdict.AGREES: "green"}


def _comparisons(section: Section) -> Table:
    places = {row.item.partition(", ")[0] for row in section.rows}
    table = _table()
    table.add_column("", no_wrap=True)
    for name in ("print", "computed", "spread by rounding"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("verdict", no_wrap=True)
    for row in section.rows:
        item, *numbers, verdict = row.cells()
        shown = item if len(places) > 1 else item.partition(", ")[2]
        table.add_row(shown, *numbers, Text(verdict, style=_STYLE.get(row.verdict, "")))
    return table


def _dyads(synthesis: Synthesis) -> Table:
    table = _table("Dyads")
    table.add_column("", no_wrap=True)
    table.add_column("kind", no_wrap=True)
    table.add_column("on the ground (F)")
    table.add_column("on the body (M)")
    table.add_column("length", justify="right", no_wrap=True)
    table.add_column("rms miss", justify="right", no_wrap=True)
    table.add_column("worst", justify="right", no_wrap=True)
    for found in synthesis.dyads:
        ground, body, length = _sides(found.dyad, _decimals(synthesis, found.rms_error))
        errors = _error(synthesis, found.rms_error), _error(synthesis, found.max_error)
        table.add_row(found.id, type(found.dyad).__name__, ground, body, length, *errors)
    return table


def _linkages(synthesis: Synthesis) -> Table:
    table = _table("Linkages, by worst miss")
    table.add_column("", no_wrap=True)
    table.add_column("type")
    table.add_column("dyads", no_wrap=True)
    all_pins = any(found.linkage.links is not None for found in synthesis.linkages)
    for link in ("ground", "driver", "coupler", "follower") if all_pins else ():
        table.add_column(link, justify="right", no_wrap=True)
    table.add_column("worst", justify="right", no_wrap=True)
    table.add_column("angle", justify="right", no_wrap=True)
    for found in synthesis.linkages:
        angle = float(found.error.angle.max())
        table.add_row(
            found.id,
            found.linkage.type,
            " ".join(dyad.id for dyad in found.dyads),
            *(_links(synthesis, found) if all_pins else ()),
            _error(synthesis, float(found.error.position.max())),
            "exact" if angle < ROUNDING else f"{_short(math.degrees(angle))}°",
        )
    return table


def _bullets(sentences: Sequence[str]) -> Table:
    grid = Table.grid(padding=(0, 1))
    for sentence in sentences:
        grid.add_row("-", Text(sentence))
    return grid


def _table(title: str | None = None) -> Table:
    return Table(
        title=title and f"\n{title}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        pad_edge=False,
        show_edge=False,
    )


def _meets(synthesis: Synthesis, best: FoundLinkage) -> str:
    if not math.isfinite(best.error.worst):
        return "cannot be assembled near all of the poses"
    if best.error.worst < ROUNDING * (synthesis.length or 1.0):
        return "passes every pose exactly, up to rounding"
    angle = math.degrees(float(best.error.angle.max()))
    unit = f" {synthesis.task.length_unit}" if synthesis.task.length_unit else ""
    return f"passes every pose within {_short(best.error.worst)}{unit} and {_short(angle)}°"


def _sides(dyad: Dyad, digits: int) -> tuple[str, str, str]:
    """A dyad's pivots or lines on the ground and on the body, and its link's length or "slider"."""

    def point(pivot: np.ndarray) -> str:
        return f"({pivot[0]:.{digits}f}, {pivot[1]:.{digits}f})"

    def line(side: PR | RP) -> str:
        angle = math.degrees(side.normal_angle)
        return f"normal {angle:.2f}°,\noffset {side.offset:.{digits}f}"

    match dyad:
        case RR():
            return point(dyad.fixed_pivot), point(dyad.moving_pivot), f"{dyad.radius:.{digits}f}"
        case PR():
            return line(dyad), point(dyad.moving_pivot), "slider"
        case RP():
            return point(dyad.fixed_pivot), line(dyad), "slider"
        case PP():
            return f"angle {math.degrees(dyad.angle):.2f}°", "-", "slider"


def _links(synthesis: Synthesis, found: FoundLinkage) -> list[str]:
    digits = _decimals(synthesis, max(dyad.rms_error for dyad in found.dyads))
    links = found.linkage.links
    return ["-"] * 4 if links is None else [f"{length:.{digits}f}" for length in links]


def _decimals(synthesis: Synthesis, error: float) -> int:
    """Decimals down to a dyad's error; the poses can tell no more, and JSON keeps them all."""
    size = max(error if math.isfinite(error) else 0.0, DIGITS * (synthesis.length or 1.0))
    return int(np.clip(-math.floor(math.log10(size)), 0, 12))


def _error(synthesis: Synthesis, value: float) -> str:
    return "exact" if value < ROUNDING * (synthesis.length or 1.0) else _short(value)


def _short(value: float) -> str:
    return f"{value:.2g}" if math.isfinite(value) else "never"
