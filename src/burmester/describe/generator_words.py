"""Function generators in sentences and rows of tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from burmester.diagnosis.pair_checks import reversals
from burmester.functions.found_generator import MET, ROUNDING, FoundGenerator
from burmester.synthesis.function_generation import FunctionSynthesis
from burmester.tasks.function_task import FunctionTask
from burmester.wording import count, figure, least_angle, listed, with_article

HEADS: Final = (
    *("", "type", "input", "coupler", "output", "max error", "transm.", "%", "rms", "why not"),
)
WIDE, NARROW = 9, 7  # columns of tables on a terminal
PAIR_HEADS: Final = ("pair", "input", "output", "is made", "error")
MOST_PAIRS = 20  # of which errors are told one by one; of more those that are missed most
LEAST_TIMES, MOST_TIMES = 1.05, 1000.0  # the nearest one's error; prices outside are not told


def best_sentences(synthesis: FunctionSynthesis) -> list[str]:
    """The best usable generator, and what better transmission costs; none without it."""
    return [f"{headline(each)}." for each in synthesis.usable[:1]] + price_note(synthesis)


def price_note(synthesis: FunctionSynthesis) -> list[str]:
    """What better transmission angles cost, in a sentence; none where there is no choice."""
    if len(synthesis.prices) < 2:
        return []
    least = max(synthesis.prices[0].max_error, MET)
    parts = []
    for each in synthesis.prices:
        error, times = each.max_error, each.max_error / least
        price = f" ({figure(times)} times)" if LEAST_TIMES < times < MOST_TIMES else ""
        miss = f"by {figure(math.degrees(error))}°" if error > MET else "by nothing"
        parts.append(f"{each.id} {miss} at {transmission(each)}{price}")
    parts[0] = parts[0].replace(" by", " misses by")
    return [f"What better transmission costs: {'; '.join(parts)}."]


def beside(synthesis: FunctionSynthesis, shown: Sequence[FoundGenerator]) -> list[str]:
    """What is said of all: why some do not work, and what better transmission costs."""
    lacks = ((each.id, listed([why.message for why in each.faults] or [""])) for each in shown)
    if synthesis.method == "judged":
        return []
    return [f"{id} {text}" for id, text in lacks if text] + price_note(synthesis)


def headline(found: FoundGenerator) -> str:
    """What it is, and how near it comes."""
    return f"{found.id}, {with_article(found.type)}, {miss(found)}"


def miss(found: FoundGenerator) -> str:
    """How near it comes, after "it"."""
    if not math.isfinite(found.max_error):
        return "cannot be assembled everywhere"
    if found.is_exact:
        return "meets all pairs exactly"
    where = "over the range" if found.task.function else "at the pairs"
    return (
        f"misses by {angle(found.max_error)} at most {where} ({figure(found.percent)} % of the "
        f"output's range), {angle(found.rms_error)} rms"
    )


def angle(error: float) -> str:
    """An error of the output in degrees, "exact" where it is rounding."""
    if not math.isfinite(error):
        return "–"
    return "exact" if abs(error) < ROUNDING else f"{figure(math.degrees(error))}°"


def transmission(found: FoundGenerator) -> str:
    """The least transmission angle over the range."""
    return least_angle(found.least_transmission).replace("-", "–")


def row(_synthesis: FunctionSynthesis, found: FoundGenerator) -> tuple[str, ...]:
    """The cells of a generator under `HEADS`."""
    _, *lengths = found.lengths.values()
    percent = figure(0.0 if found.is_exact else found.percent).replace("-", "–")
    errors = angle(found.max_error), transmission(found), percent, angle(found.rms_error)
    why = "; ".join(each.message for each in found.faults) or "–"
    return (found.id, found.type, *(f"{each:.4g}" for each in lengths), *errors, why)


def dimension_rows(found: FoundGenerator) -> list[tuple[str, str]]:
    """The links by name: their lengths, and where those with a phase begin."""
    one = found.generator
    at = {
        f"{end} link": f" at {math.degrees(float(phase)) % 360:.4f}° where the {end} is 0"
        for end, phase in (("input", one.input_phase), ("output", one.output_phase))
    }
    return [(name, f"{length:.6g}{at.get(name, '')}") for name, length in found.lengths.items()]


def notes(_synthesis: FunctionSynthesis, found: FoundGenerator) -> list[str]:
    """What else is to be known to build it, and where it falls short."""
    side = "left" if found.generator.side > 0 else "right"
    extent = figure(found.extent * found.task.ground)
    short = [f"It {listed(found.shortcomings)}."] if found.shortcomings else []
    return [
        "Angles are from the ground link, counter-clockwise. Seen from the input link's pin to the "
        f"output's pivot, the coupler's other pin lies on the {side}.",
        f"Least transmission angle over the range: {transmission(found)}. The box of all pivots "
        f"has a diagonal of {extent}.",
        *short,
    ]


def place_table(
    _synthesis: FunctionSynthesis, found: FoundGenerator
) -> tuple[str, tuple[str, ...], list[tuple[str, ...]]]:
    """What it makes of the pairs: a title, heads and rows; of many those that are missed most."""
    rows = pair_rows(found)
    worst = np.argsort(-np.nan_to_num(np.abs(found.errors), nan=np.inf), kind="stable")
    some = sorted(worst[:MOST_PAIRS].tolist())
    title = f"At the pairs{' that are missed most' * (len(some) < len(rows))}"
    return title, PAIR_HEADS, [rows[k] for k in some]


def pair_rows(found: FoundGenerator) -> list[tuple[str, ...]]:
    """The pairs in degrees, what the linkage makes of each, and its error, under `PAIR_HEADS`."""
    task = found.task
    every = zip(task.inputs.tolist(), task.outputs.tolist(), found.errors.tolist(), strict=True)
    return [
        (
            *(str(k), f"{math.degrees(x):.6g}°", f"{math.degrees(y):.6g}°"),
            f"{round(math.degrees(y + error), 4) + 0.0:.4f}°" if math.isfinite(error) else "–",
            angle(error),
        )
        for k, (x, y, error) in enumerate(every, start=1)
    ]


def facts(task: FunctionTask) -> Iterator[tuple[str, str]]:
    """What is to be made, each fact with its name."""
    low, high = task.input_ends
    if (function := task.function) is not None:
        yield "function", f"y = {function.text}, x from {function.x[0]:g} to {function.x[1]:g}"
    yield "input", f"{_range(low, high)}{_phase(task.input_phase)}"
    _, outputs = task.compared()
    turns = reversals(*task.compared())
    back = "" if not turns else f"; it turns round {count(turns, 'time')}"
    least, most = float(outputs.min()), float(outputs.max())
    yield "output", f"{_range(least, most)}{_phase(task.output_phase)}{back}"
    yield "asks", _asked(task)


def _range(low: float, high: float) -> str:
    low, high = math.degrees(low), math.degrees(high)
    return f"{figure(high - low)}°, from {low:.4g}° to {high:.4g}°"


def _phase(phase: float | None) -> str:
    return "" if phase is None else f"; {math.degrees(phase):.6g}° from the ground link at 0"


def _asked(task: FunctionTask) -> str:
    """What is to be found, in words."""
    pairs, needed = len(task.inputs), task.exact_count
    phases = {0: "both phases given", 1: "one phase open", 2: "both phases open"}[task.free_phases]
    head = f"{count(pairs, 'pair')}, {phases}: "
    solutions = task.solutions
    if solutions is None:
        rest = f"; {count(needed, 'pair')} leave finitely many" if pairs >= 3 else ""
        few = "" if pairs >= 3 else ", and three pairs are the fewest that are solved"
        return f"{head}infinitely many linkages{rest}{few}"
    if pairs == needed:
        most = "one linkage" if solutions == 1 else f"{solutions} linkages at most"
        return f"{head}{most} through all of them"
    norm = "least greatest error" if task.minimax else "least squared error"
    return f"{head}the {norm}, from {count(solutions, 'critical point')} of the residual"
