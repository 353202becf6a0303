"""A function generator with all that is known of it: errors, verdict, transmission, room."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Finding
from burmester.fourbar.linkage import Linkage
from burmester.functions.generator import Generator
from burmester.functions.kept_requirements import MOST_SIZE
from burmester.functions.refinement import at_bounds
from burmester.mechanisms.four_bar_loop import FourBarLoop
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.requirements.figures import Figures
from burmester.requirements.table import NOT_ASKED, shortcomings, standard
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.notation import MOST_NAMES
from burmester.verdicts.judged_linkage import JudgedLinkage
from burmester.verdicts.ranking import ERROR_RATIO
from burmester.verdicts.requirement_check import figures_of
from burmester.wording import figure, in_runs

ROUNDING: Final = 1e-9  # radians; an output error below is none
MET: Final = 1e-7  # radians; a pair missed by less is met exactly
SAME_EXACT: Final = 1e-6  # of the logarithm of a link, and radians, through exact pairs
SAME_VALLEY: Final = 0.25  # the same of linkages downhill of starts
MORE_TRANSMISSION: Final = math.radians(1)  # what makes a linkage of one valley another one
STEP_OF_PRICES: Final = math.radians(3)  # of transmission, between members of it
MORE_ERROR: Final = 1.03  # times the error; the same


@final
@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class FoundGenerator(JudgedLinkage):
    """A function generator of a task, with all of `JudgedLinkage`.

    generator: one, without leading axes.
    errors: (N,), of the output at the pairs, radians; nan where the linkage is open.
    range_errors: (M,), at the inputs of `FunctionTask.compared`.
    least_transmission: over the range of the input, radians; nan where it does not go through it.
    extent: the diagonal of the box around all four pivots over the range, in ground links.
    defects: why it does not go through the whole range of the input on one branch, without a dead
        point, and meet the pairs there.
    """

    generator: Generator
    errors: FloatArray
    range_errors: FloatArray
    least_transmission: float
    extent: float
    rank: int = 0
    defects: tuple[Finding, ...] = ()
    task: FunctionTask

    @property
    def usable(self) -> bool:
        """Whether it goes through range and pairs, and keeps what the task asks."""
        return not self.faults

    @property
    def type(self) -> str:
        """Grashof's type, its input link driving."""
        return self.generator.linkage().type

    @property
    def linkage(self) -> Linkage:
        """The four-bar: its input link is the first dyad, its coupler the body."""
        return self.generator.linkage(self.task.ground)

    @property
    def figures(self) -> Figures:
        """What it measures and does."""
        return figures_of(self.generator.linkage(), self.least_transmission, True)

    @property
    def lengths(self) -> dict[str, float]:
        """The lengths of the links by name, in the unit of the ground link's."""
        names = "ground link", "input link", "coupler", "output link"
        return dict(zip(names, (self.task.ground * self.generator.sizes).tolist(), strict=True))

    @property
    def is_exact(self) -> bool:
        """Whether the output is nowhere off by more than rounding."""
        return self.max_error < ROUNDING

    @property
    def max_error(self) -> float:
        """The greatest structural error, radians; nan where the linkage is open somewhere."""
        return float(np.abs(self.range_errors).max())

    @property
    def rms_error(self) -> float:
        """The root of the mean squared structural error, radians."""
        return float(np.sqrt((self.range_errors**2).mean()))

    @property
    def percent(self) -> float:
        """The greatest structural error in percent of the outputs' range."""
        return 100 * self.max_error / self.task.output_span


def found_generators(
    generators: Generator, task: FunctionTask, *, exact: bool
) -> tuple[FoundGenerator, ...]:
    """Generators (k,), judged and ranked: usable ones first, then sound ones, then by error.

    One that is nearly an earlier one, or its mirror image with both senses reversed, is left out.
    exact: whether all pairs have to be met.
    """
    every = [_found(generators[k], task, exact=exact) for k in range(len(generators))]
    errors = [each.max_error for each in every if each.usable]
    least = max(min(errors, default=math.inf), MET)

    def order(each: FoundGenerator) -> tuple[bool, bool, float, float]:
        sound = not each.shortcomings and each.max_error <= ERROR_RATIO * least
        error = each.max_error if each.max_error > MET else 0.0
        transmission = each.least_transmission
        return (
            not each.usable,
            not sound,
            error if math.isfinite(error) else math.inf,
            -transmission if math.isfinite(transmission) else 0.0,
        )

    every.sort(key=order)
    kept: list[FoundGenerator] = []
    others: list[tuple[FoundGenerator, Generator]] = []  # they and their mirror images
    for each in every:
        if not any(_repeats(each, *before, exact=exact) for before in others):
            kept.append(each)
            images = [each.generator, *_mirror_images(each.generator, task)]
            others += [(each, image) for image in images]
    return tuple(replace(one, id=f"L{rank}", rank=rank) for rank, one in enumerate(kept, start=1))


def _mirror_images(generator: Generator, task: FunctionTask) -> list[Generator]:
    """The mirror image about the ground link, driven the other way, if the task is symmetric."""
    order = np.argsort(task.inputs)
    ends = []
    for angles in (task.inputs[order], task.outputs[order]):
        both = angles + angles[::-1]
        if np.ptp(both) > MET:
            return []
        ends.append(both.mean())
    phases = (-generator.input_phase - ends[0], -generator.output_phase - ends[1])
    return [replace(generator, input_phase=phases[0], output_phase=phases[1], side=-generator.side)]


def _repeats(one: FoundGenerator, before: FoundGenerator, image: Generator, *, exact: bool) -> bool:
    """Whether a linkage is an earlier one or its mirror image again, or no better in one valley."""
    if (one.usable, not one.shortcomings) != (before.usable, not before.shortcomings):
        return False
    if one.least_transmission > before.least_transmission + MORE_TRANSMISSION:
        return False
    g = one.generator
    phases = (g.input_phase - image.input_phase, g.output_phase - image.output_phase)
    turned = max(float(np.abs(wrapped_angle(each))) for each in phases)
    apart = max(turned, float(np.abs(np.log(g.sizes / image.sizes)).max()))
    return bool(g.side == image.side) and apart < (SAME_EXACT if exact else SAME_VALLEY)


def price_list(usable: Sequence[FoundGenerator]) -> tuple[FoundGenerator, ...]:
    """Of usable generators those than which none is as near and transmits as well, nearest first.

    One that costs hardly more error than one before it stands for that one, unless that is the
    nearest of all.
    """
    front: list[FoundGenerator] = []
    best = -math.inf
    for each in sorted(usable, key=lambda one: (one.max_error, -one.least_transmission)):
        if each.least_transmission > best + STEP_OF_PRICES:
            if len(front) > 1 and each.max_error < MORE_ERROR * front[-1].max_error:
                front.pop()
            front.append(each)
            best = each.least_transmission
    return tuple(front)


def _found(generator: Generator, task: FunctionTask, *, exact: bool) -> FoundGenerator:
    inputs, outputs = task.compared()
    low, high = task.input_ends
    errors = generator.error(task.inputs, task.outputs)
    found = FoundGenerator(
        generator=generator,
        errors=errors,
        range_errors=generator.error(inputs, outputs),
        least_transmission=float(generator.least_transmission(low, high)),
        extent=_extent(generator, np.linspace(low, high, len(inputs) if task.function else 181)),
        defects=_defects(generator, task, errors, exact=exact),
        id="",
        task=task,
    )
    asked = task.requirements.bounds
    usual = standard(asked, 0.0, NOT_ASKED)
    below = [each.message for each in shortcomings(usual, found.figures, figure)]
    if not exact and bool(at_bounds(generator)):
        below.append(f"has a link at the bound of {figure(MOST_SIZE)} ground links, or its inverse")
    violations = shortcomings(asked, found.figures, figure)
    return replace(found, violations=violations, shortcomings=tuple(below))


def _defects(
    generator: Generator, task: FunctionTask, errors: FloatArray, *, exact: bool
) -> tuple[Finding, ...]:
    """Why the linkage does not go through the range and the pairs; kinds as codes."""
    out = []
    low, high = task.input_ends
    open_at = np.flatnonzero(np.isnan(errors))
    if len(open_at):
        out.append(Finding("assembly", f"cannot be assembled at {_pairs(open_at)}"))
    missed = np.flatnonzero(exact & (np.abs(errors) > MET))
    if len(missed):
        out.append(Finding("branch", f"meets {_pairs(missed)} on another branch"))
    if not bool(generator.runs_through(low, high)):
        locks = _dead_inputs(generator, low, high)
        angles = np.degrees(locks)
        where = " and ".join(f"{a:.1f} deg" if np.isfinite(a) else "no angle" for a in angles)
        message = f"locks at an input of {where}" if locks else "cannot be assembled over the range"
        out.append(Finding("dead-point", message))
    return tuple(out)


def _dead_inputs(generator: Generator, low: float, high: float) -> list[float]:
    """The inputs between low and high at which coupler and output link are in line, radians."""
    a, b = np.array([0j, 1.0])
    loop = FourBarLoop.of(a, b, generator.input_link, generator.coupler, generator.output_link)
    locked = loop.locked(first=True)
    at = low + np.mod(locked - generator.input_phase - low, 2 * math.pi)
    return list(np.unique(at[at <= high]).tolist())


def _extent(generator: Generator, inputs: FloatArray) -> float:
    """The diagonal of the box around all four pivots at inputs (M,), in ground links."""
    pin = 1 - generator.diagonal(inputs)
    phi = generator.output_phase + generator.outputs(inputs)
    other = 1 + generator.output_link * np.exp(1j * phi)
    points = np.concatenate([[0, 1], pin, other[np.isfinite(other)]])
    return float(np.hypot(np.ptp(points.real), np.ptp(points.imag)))


def _pairs(at: NDArray[np.intp]) -> str:
    return f"pair{'s' * (len(at) > 1)} {in_runs([str(k + 1) for k in at.tolist()], MOST_NAMES)}"
