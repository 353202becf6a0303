"""From pairs of angles, or a function, to its four-bars: the whole road of a function generator.

As many pairs as unknowns are met exactly, by all linkages that there are; fewer leave phases open,
and a grid of them is searched; more are met by all critical points of Freudenstein's residual,
refined by the true error of the output angle.

E192 too few pairs, or pairs that infinitely many linkages meet
W230 critical points that were not reached      W231 phases chosen from a grid
W232 solutions without end                      W233 a linkage at the bound of its sizes
R360 function generators that work              R361 none that does
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final, Literal, TypeAlias

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import Advice, InputError
from burmester.functions.critical_generators import critical_generators
from burmester.functions.exact_pairs import exact_generators, generators_of_phases
from burmester.functions.found_generator import MET, FoundGenerator, found_generators, price_list
from burmester.functions.generator import Generator
from burmester.functions.nearest_generators import nearest_generators
from burmester.functions.phase_family import best_of_phases, placed_links
from burmester.functions.refinement import at_bounds
from burmester.geometry.regions import Point
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import one_thread
from burmester.progress import step
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.result import Answer, Outcome, Synthesis
from burmester.tasks.function_task import FunctionTask
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import count, figure, listed

LEAST_PAIRS: Final = 3
SAME_ANGLE: Final = 1e-9  # radians; outputs that turn with the input but for less do so exactly
_HELP: Final = Help.of(
    "change the range of the input or of the output, turn the output the other way ({} for a "
    "function), or leave the phases open",
    Cure("opposite", True),
)
COUPLER_PLACES: Final = 13  # of the coupler over the range of a function, for export and report
FunctionMethod: TypeAlias = Literal["exact", "phases", "least squares", "minimax", "judged"]


@dataclass(frozen=True, slots=True, eq=False)
class FunctionSynthesis(Answer[FoundGenerator]):
    """All that came of a function task.

    method: how it was solved.  generators: by rank.
    solutions: how many solutions or critical points generic pairs have, real or not; found: how
        many of them were reached; real: how many of these are linkages.  None for a grid.
    """

    task: FunctionTask
    method: FunctionMethod
    outcome: Outcome
    generators: tuple[FoundGenerator, ...]
    warnings: tuple[Advice, ...] = ()
    solutions: int | None = None
    found: int | None = None
    real: int | None = None

    @property
    def candidates(self) -> tuple[FoundGenerator, ...]:
        """All linkages by rank."""
        return self.generators

    def exported(self, found: FoundGenerator) -> FoundLinkage:
        """A generator as the linkage that guides its coupler."""
        (judged,) = coupler_synthesis(found).linkages
        return replace(judged, id=found.id, usable=found.usable)

    @property
    def prices(self) -> tuple[FoundGenerator, ...]:
        """Of those that work: the nearest one, and what each better transmission angle costs."""
        return price_list(self.usable)

    def leading(self, most: int) -> list[FoundGenerator]:
        """At most so many, by rank: those of the price list, and the first of the others."""
        every = self.generators
        wanted = list(dict.fromkeys([*every[:1], *self.prices, *every]))
        return sorted(wanted[:most], key=lambda each: each.rank)


AnySynthesis: TypeAlias = Synthesis | FunctionSynthesis


def generate_function(task: FunctionTask) -> FunctionSynthesis:
    """The four-bars of a function task, judged and ranked; raises E192."""
    with one_thread():
        pairs = len(task.inputs)
        if pairs < LEAST_PAIRS:
            raise InputError(
                "E192",
                f"{count(pairs, 'pair')} of angles leave infinitely many linkages",
                why="three lengths are to be found even where both phases are given",
                help=f"give {LEAST_PAIRS} pairs or more",
            )
        _require_no_parallelogram(task)
        more = pairs - task.exact_count
        found = _by_phases(task) if more < 0 else _nearly(task) if more else _exactly(task)
        return replace(found, warnings=(*task.notes, *found.warnings))


def judge_links(
    task: FunctionTask, links: tuple[float, float, float], side: float | None = None
) -> FunctionSynthesis:
    """Links that exist, judged at the phases of a task or, where it gives none, at the best.

    links: of the input link, the coupler and the output link, in the unit of the ground link.
    side: 1 or -1, of the output pin, seen from the input pin to the output's pivot; None: the
        better one.
    """
    a, r, b = (each / task.ground for each in links)
    placed = " at the phases that fit best" if task.free_phases else ""
    return judge_generator(task, placed_links(a, r, b, task, side), placed)


def judge_generator(
    task: FunctionTask, generator: Generator, placed: str = ""
) -> FunctionSynthesis:
    """One generator that exists, judged by the pairs or the function of a task.

    placed: what is said of its phases.
    """
    found = found_generators(generator[None], task, exact=False)
    (one,) = found
    if one.usable:
        outcome = Outcome("R360", f"the function generator works{placed}")
    else:
        reasons = listed([each.message for each in one.faults])
        outcome = Outcome(
            "R361", f"the function generator does not work{placed}", _HELP, f"it {reasons}"
        )
    return FunctionSynthesis(task, "judged", outcome, found, task.notes)


def _require_no_parallelogram(task: FunctionTask) -> None:
    """Refuse an output that turns as the input does: every parallelogram does that."""
    if np.ptp(task.outputs - task.inputs) < SAME_ANGLE:
        raise InputError(
            "E192",
            "infinitely many linkages meet these pairs",
            why="the output turns as the input does, and so it does in every parallelogram",
            help="take a coupler as long as the ground link, and two other links of one length; or "
            "give outputs that differ",
        )


def _exactly(task: FunctionTask) -> FunctionSynthesis:
    step("solving for the exact pairs")
    every = exact_generators(task)
    if not every.determined:
        raise InputError(
            "E192",
            "infinitely many linkages meet these pairs",
            why="the equations of the pairs depend on each other",
            help="give other pairs, or one more",
        )
    found = found_generators(every.generators, task, exact=True)
    warnings = []
    if every.sliders:
        warnings.append(
            Advice(
                "W232",
                f"{count(every.sliders, 'solution')} with a link without end "
                f"{'is' if every.sliders == 1 else 'are'} left out",
                "change an angle a little if such a long link may stand for the slider",
                "a link without end is a slider, and a function generator with one is not made",
            )
        )
    head = f"{_number(found)} of the {task.solutions} that such pairs have"
    return FunctionSynthesis(
        task,
        "exact",
        _outcome(found, task, head),
        found,
        tuple(warnings),
        task.solutions,
        task.solutions,
        len(found) + every.sliders,
    )


def _by_phases(task: FunctionTask) -> FunctionSynthesis:
    step("looking through the phases")
    family = best_of_phases(task)
    found = found_generators(family.generators, task, exact=True)
    best = "the structural error is least" if task.function else "transmission is best"
    needed = task.exact_count - len(task.inputs)
    note = Advice(
        "W231",
        f"phases were chosen from a grid, where {best}",
        Help.of(
            f"give {count(needed, 'pair')} more, or phases with {{}} and {{}}",
            Cure("input_phase_deg", option="--input-phase"),
            Cure("output_phase_deg", option="--output-phase"),
        ),
        f"{count(len(task.inputs), 'pair')} and {count(task.free_phases, 'open phase')} leave "
        f"infinitely many linkages; {family.tried} were tried, and {family.working} work",
    )
    head = f"{_number(found)} of infinitely many"
    return FunctionSynthesis(task, "phases", _outcome(found, task, head), found, (note,))


def _nearly(task: FunctionTask) -> FunctionSynthesis:
    warnings: list[Advice] = []
    solutions, reached, real = task.solutions or 1, 1, 1
    if task.free_phases:
        step("following paths to all critical points")
        points = critical_generators(task)
        phases = points.input_phase, points.output_phase
        reached, real = points.found, int(points.real.sum())
        if reached < solutions:
            warnings.append(
                Advice(
                    "W230",
                    f"{reached} of {solutions} critical points of the residual were reached",
                    Help.of(
                        "change a range a little and compare, or ask for five pairs ({}), of "
                        "which no solution is missing",
                        Cure("pairs", 5),
                    ),
                    "the others lie at infinity, or too close together to be told apart",
                )
            )
    else:
        phases = (np.array([task.input_phase]), np.array([task.output_phase]))
    start, _ = generators_of_phases(task, *phases)
    start = start[np.isfinite(start.sizes).all(axis=-1)]
    start = start.with_better_side(task.inputs, task.outputs, task.weights)
    step("refining the output angle")
    found = found_generators(nearest_generators(start, task), task, exact=False)
    nearest = next(iter(price_list([each for each in found if each.usable])), None)
    if nearest and bool(at_bounds(nearest.generator)):
        warnings.append(
            Advice(
                "W233",
                f"{nearest.id} would be closer still with a link beyond the bound",
                "take another range of the input or of the output",
                "no link is longer than 10 ground links, or shorter than a tenth of one",
            )
        )
    norm = "the least greatest error" if task.minimax else "the least squared error"
    head = f"{_number(found)} with {norm}, from {count(reached, 'critical point')} ({real} real)"
    return FunctionSynthesis(
        task,
        "minimax" if task.minimax else "least squares",
        _outcome(found, task, head),
        found,
        tuple(warnings),
        solutions,
        reached,
        real,
    )


def _number(found: tuple[FoundGenerator, ...]) -> str:
    return count(len(found), "function generator")


def _outcome(found: tuple[FoundGenerator, ...], task: FunctionTask, head: str) -> Outcome:
    usable = sum(each.usable for each in found)
    if usable:
        return Outcome("R360", f"{head}, {usable} of them usable")
    if not found:
        return Outcome("R361", head, _HELP, "no real linkage meets the pairs")
    reasons = [f"{each.id} {each.faults[0].message}" for each in found[:3]]
    help = _loosened(found, task) or _HELP
    return Outcome("R361", f"{head}, none of them usable", help, listed(reasons))


def _loosened(found: tuple[FoundGenerator, ...], task: FunctionTask) -> str:
    """Which one requirement to ask less of, as little as may be, and what comes of it; or empty."""
    ways = []
    for each, bound in task.requirements.bounds.items():
        some = [one for one in found if [why.code for why in one.faults] == [each.code]]
        if some:
            best = min(some, key=lambda one: float(each.excess(one.figures, bound)))
            error = figure(math.degrees(best.max_error)) if best.max_error > MET else 0
            cure = each.cure(bound, best.figures) or each.option
            ways.append(Help.of(f"{{}} ({best.id}, {error}°)", cure))
    return Help.of("ask for less: {}", Help.listed(ways, "or")) if ways else ""


def coupler_synthesis(found: FoundGenerator, inputs: FloatArray | None = None) -> Synthesis:
    """A function generator as a linkage that guides its coupler: the judgement of that motion.

    The places of the coupler at the pairs are the poses; of a function, places at even distances
    over the range.  So reports and exports show and write it like every other linkage.
    inputs: (N,), those of the poses, radians, rising; None: as said.
    """
    task = found.task
    if inputs is None:
        inputs = np.sort(task.inputs)
        if task.function is not None or len(inputs) > COUPLER_PLACES:
            inputs = np.linspace(*task.input_ends, COUPLER_PLACES)
    poses = found.generator.coupler_poses(inputs, task.ground)
    poses = poses[np.isfinite(poses).all(axis=-1)]
    # Each pivot where it is: so the input link is the first, and drives.
    pivots = np.array([[0.0, 0.0], [task.ground, 0.0]])
    motion = Task.from_rows(
        poses,
        angle_unit="rad",
        limits=tuple(Limits(fixed_pivot=Point(each)) for each in pivots),
        requirements=Requirements(driver="first"),
    )
    return judge_linkage(motion, found.linkage)
