"""The datasheet of a sample of random linkages: how they were drawn, and what they are not."""

from __future__ import annotations

import math
from textwrap import fill

from burmester.stacked.random_linkages import (
    FAR_POINT,
    JITTER,
    LEAST_ARC,
    SHORTEST,
    WIDEST,
    SampleOptions,
)
from burmester.wording import listed

WIDTH = 100  # characters of a line of the page


def datasheet(options: SampleOptions, count: int, version: str) -> str:
    """What a sample of linkages is, as Markdown; version: of the program that draws it."""
    angle = f"{options.transmission_deg:g}°"
    head = [
        f"# {count:,} random four-bar linkages",
        f"Drawn by burmester {version}, `--sample four-bars`, seed {options.seed}.",
        "## What they are for",
        "Examples for methods that learn or look up linkages: a linkage, the poses that it leads a "
        "body through, its coupler curve. Every linkage works: its coupler meets its "
        "exact poses on "
        "one circuit, on one branch of its driver, in their order, and its transmission "
        "angle stays "
        f"at {angle} or more from the first pose to the last.",
        "## How they were drawn",
    ]
    number = (
        "Linkage number i is a function of the seed and of i alone. Its numbers are SplitMix64 "
        "hashes of seed, number and draw: it is the same in any part of the sample, drawn in any "
        "order."
    )
    rest = [
        number,
        "## The distribution",
        "What is kept is not what was drawn first: links of another type, or that "
        "transmit over too "
        "short an arc, are drawn again. So of each type extreme proportions are rarer than they "
        "were drawn, the more so the greater the transmission angle that is asked for. Types have "
        "the shares above, whatever share of all linkages they would have. Assemblies, directions "
        "and places are even.",
        "## What is not covered",
        "Linkages with slots (inverted slider-cranks and others) or with two sliders; change "
        "points; linkages that are moved through a dead point by hand or by inertia; links shorter "
        f"than {SHORTEST:g} of the longest; bodies whose origin is far from their coupler; forces, "
        "the thickness of links, collisions.",
        "## Known limits",
        "- Poses determine a linkage badly where the body turns little. Such examples are in the "
        "sample, and with noise another linkage may fit them better than the one that is told.",
        "- A coupler curve belongs to three four-bars (Roberts and Chebyshev): the one told is not "
        "the only answer to it. Five poses or fewer have other linkages that meet them as well.",
        "- Linkages are drawn independently: there is no care for an even cover, and two may be "
        "nearly alike.",
    ]
    blocks = [*map(_wrapped, head), "\n".join(map(_wrapped, _items(options, angle)))]
    blocks += map(_wrapped, rest[: rest.index("## Known limits") + 1])
    blocks.append("\n".join(map(_wrapped, rest[rest.index("## Known limits") + 1 :])))
    return "\n\n".join(blocks) + "\n"


def _wrapped(text: str) -> str:
    indent = "  " if text.startswith("- ") else ""
    return fill(text, WIDTH, subsequent_indent=indent, break_on_hyphens=False)


def _items(options: SampleOptions, angle: str) -> list[str]:
    """How a linkage was drawn, step by step."""
    types, least = options.types, f"{math.degrees(LEAST_ARC):g}°"
    noise = "None: the poses are exact to the rounding of a double."
    if options.noise:
        noise = (
            f"Each pose has errors of a normal distribution: {options.noise:g} rad in the angle, "
            f"and {options.noise:g} times the span of the linkage's exact poses (the diagonal of "
            "the box around their origins) in x and in y, all independent. The exact poses are "
            "told as well."
        )
    curve = "None is told."
    if options.curve:
        curve = (
            f"Told at {options.curve} places, at even steps of the driver's angle over the whole "
            f"arc in which the linkage transmits by {angle} or more; over a full turn "
            f"where that is "
            "all of it. It is the curve of the body's origin, with the body's angle."
        )
    return [
        f"- **Type.** One of {listed(list(types), 'or')}, each in {100 / len(types):.3g} % of the "
        "linkages. The type is drawn first; links are drawn until they are of it, and usable.",
        f"- **Links.** The longest is 1. The others are spread evenly in their logarithm from "
        f"{SHORTEST:g} to 1. Any of the four is the longest with the same chance; of a "
        f"slider-crank "
        "the driver or the coupler. Its line is up to 1 off the driver's pivot, spread evenly.",
        "- **Assembly.** Either of the two, with the same chance.",
        f"- **Arc.** The arcs of the driver in which the linkage transmits by {angle} or more are "
        "known in closed form. Where there are two alike, one is drawn. Linkages of which "
        f"{100 * WIDEST:g} % of the arc are less than {least} are left out.",
        f"- **Poses.** {options.poses} of each. The driver's way from the first to the last is "
        f"spread evenly from {least} to {100 * WIDEST:g} % of the arc, and its place in the arc "
        "evenly. In between the driver's angles are even, but for "
        f"{100 * JITTER:g} % of a step at most.",
        f"- **Turn.** A body that turns by less than {options.turn_deg:g}° from the first pose to "
        "the last is left out: little can be told from its poses.",
        f"- **Body.** Its origin is spread evenly over the disc with radius {FAR_POINT:g} "
        f"about the "
        "middle of the coupler, its angle over a full turn.",
        "- **Frame.** The driver's pivot is spread evenly over the square from -1 to 1, the "
        "direction of the ground link over a full turn.",
        f"- **Noise.** {noise}",
        f"- **Coupler curve.** {curve}",
    ]
