"""What a time limit ended, in words."""

from __future__ import annotations

from dataclasses import replace

from burmester.errors import Advice
from burmester.progress import Watch
from burmester.synthesis.result import Synthesis
from burmester.wording import listed

__all__ = ["with_time_limit"]

# What is proposed in place of a limit that was too short: so many times it, seconds at least.
LONGER, LEAST_PROPOSED = 10.0, 10.0


def with_time_limit(synthesis: Synthesis, watch: Watch) -> Synthesis:
    """A synthesis with a warning W221 that says what was not finished, if there is such."""
    limit, parts = synthesis.options.time_limit, []
    if limit is None or not (watch.cut or watch.left_out):
        return synthesis
    for texts, fate in ((watch.cut, "ended early"), (watch.left_out, "left out")):
        if texts:
            parts.append(f"{listed(texts)} {'was' if len(texts) == 1 else 'were'} {fate}")
    longer = max(LONGER * limit, LEAST_PROPOSED)
    advice = Advice(
        "W221",
        f"the time limit of {limit:g} s came before the end: {'; '.join(parts)}",
        f"give more time, such as --time-limit {longer:g}, or leave it out",
        "what was found until then is the answer, and may not be the best",
    )
    return replace(synthesis, warnings=(*synthesis.warnings, advice))
