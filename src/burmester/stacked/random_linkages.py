"""Random usable four-bars with the poses that they lead through, for sets of examples.

What is drawn for a number is a function of seed and number alone: a set may be drawn in parts of
any size, in any order, on any number of machines.

All is in closed form.  With the driver's angle t and the distance e of its pin from the ground
pivot of the other link, the angle at the coupler's other pin tells the transmission angle; so a
bound on it bounds e, and that bounds cos t.  The arcs of the driver in which the linkage transmits
by a given angle are known exactly: there it neither locks nor changes its circuit, and poses on one
of them, in the order of the driver, are met on one branch in their order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.linkage import TYPES, Links, grashof_numbers
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.numerics.arrays import ComplexArray, FloatArray, put, take
from burmester.numerics.counted_draws import normal_draws, uniform_draws
from burmester.stacked.task_stack import TaskStack
from burmester.wording import listed

MAX_ATTEMPTS = 2000  # for each linkage; one in some ten is usable
LEAST_ARC = math.radians(40)  # of the driver, from the first pose to the last
SHORTEST = 0.15  # of the longest link
FAR_POINT = 1.0  # lengths of the longest link; the body's origin is no farther from the coupler
TURN_PLACES = 9  # evenly from the first pose to the last, at which the turn of a body is looked at
JITTER = 0.3  # of the step between two poses; so much a pose is off an even spacing
SLIDER_CRANK = "slider-crank"
DRAWN_TYPES: Final = (
    "crank-rocker",
    "rocker-crank",
    "double-crank",
    "double-rocker",
    "triple-rocker",
    SLIDER_CRANK,
)

# The draws of one attempt: links (3), which one is longest, offset of the line; arc, its width, its
# place; sides (2); body (3); ground (3).
DRAWS_OF_ATTEMPT, DRAWS_OF_LINKAGE = 16, 4

Numbers = NDArray[np.int64]


@final
@dataclass(frozen=True, slots=True)
class SampleOptions:
    """What linkages are drawn, and what is told of each.

    Attributes
    ----------
    seed : int
        Of all that is drawn.
    poses : int
        How many poses a linkage leads through, 2 or more.
    noise : float
        The standard deviation of the errors that are added to the poses: of angles in radians, of
        positions as a share of the span of the poses.
    types : tuple of str
        Of `TYPES_DRAWN`; each has the same share.
    transmission_deg : float
        The least transmission angle between the first and the last pose, in degrees.
    turn_deg : float
        How far the body turns at least from the first pose to the last, in degrees.
    curve : int
        At how many places of the coupler's motion its curve is told; 0 for none.

    Raises
    ------
    InputError
        E134.
    """

    TYPES_DRAWN: ClassVar[tuple[str, ...]] = DRAWN_TYPES

    seed: int = 0
    poses: int = 10
    noise: float = 0.0
    types: tuple[str, ...] = DRAWN_TYPES
    transmission_deg: float = 30.0
    turn_deg: float = 15.0
    curve: int = 64

    def __post_init__(self) -> None:
        _require(isinstance(self.seed, int), "the seed", self.seed, "a whole number")
        _require(_whole(self.poses, 2), "the number of poses", self.poses, "2 or more")
        _require(_whole(self.curve, 0), "the number of places", self.curve, "0 or more")
        number = isinstance(self.noise, int | float) and 0 <= self.noise < 1
        _require(number, "the noise", self.noise, "a number from 0 to 1, such as 1e-3")
        angle = self.transmission_deg
        number = isinstance(angle, int | float) and 0 < angle <= MOST_TRANSMISSION
        most = f"degrees above 0, at most {MOST_TRANSMISSION:g}"
        _require(number, "the transmission angle", angle, most)
        turn = isinstance(self.turn_deg, int | float) and 0 <= self.turn_deg <= MOST_TURN
        _require(turn, "the turn of the body", self.turn_deg, f"degrees from 0 to {MOST_TURN:g}")
        known = bool(self.types) and set(self.types) <= set(DRAWN_TYPES)
        _require(known, "the types", self.types, listed(list(DRAWN_TYPES), "or"))


MOST_TURN = 90.0  # degrees; there are couplers enough that turn as much
MOST_TRANSMISSION = 60.0  # degrees; hardly any linkage keeps more over a wide arc


def _whole(value: object, least: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= least


def _require(good: bool, what: str, value: object, wanted: str) -> None:
    if not good:
        raise InputError("E134", f"{what} of a sample is {value!r}", help=f"give {wanted}")


@final
class RandomLinkages(NamedTuple):
    """Linkages (T,) and the poses (T, N) that they lead through, in the order of the driver.

    number: (T,), by which they were drawn; type: (T,), in `TYPES` of `fourbar.linkage`.
    linkages: the driver first.  poses, exact_poses: (T, N, 3), x, y and angle in radians, with
    noise and without.  transmission_deg: (T,), the least from the first pose to the last.
    inputs: (T, N), angles of the driver at the poses, radians.
    curve: (T, C, 3), places of the coupler at even steps of the driver's angle over the whole arc
    in which it transmits by the angle asked for, `arc` (T, 2): a full turn where that is all of it.
    """

    number: Numbers
    type: NDArray[np.int8]
    linkages: LinkageBatch
    exact_poses: FloatArray
    poses: FloatArray
    transmission_deg: FloatArray
    inputs: FloatArray
    curve: FloatArray
    arc: FloatArray

    @property
    def stack(self) -> TaskStack:
        """The poses as tasks."""
        return TaskStack(self.poses)


def random_linkages(options: SampleOptions, number: NDArray[np.integer]) -> RandomLinkages:
    """The linkages with the given numbers (T,), from 0, of the sample that options describe.

    Examples
    --------
    >>> sample = SampleOptions(seed=7, poses=5)
    >>> some = random_linkages(sample, np.arange(100, 104))
    >>> one = random_linkages(sample, np.array([102]))
    >>> bool((some.poses[2] == one.poses[0]).all())
    True
    """
    choice = uniform_draws(options.seed, number, 0, DRAWS_OF_LINKAGE)
    share = len(options.types)
    wanted = np.minimum((choice[:, 0] * share).astype(np.intp), share - 1)
    kind = np.array([TYPES.index(name) for name in options.types])[wanted]
    drawn = _Drawn.none(len(number))
    rest = np.arange(len(number))
    for attempt in range(MAX_ATTEMPTS):
        if not len(rest):
            break
        first = DRAWS_OF_LINKAGE + attempt * DRAWS_OF_ATTEMPT
        draws = uniform_draws(options.seed, number[rest], first, DRAWS_OF_ATTEMPT)
        found, good = _attempt(draws, kind[rest], options)
        put(drawn, rest[good], take(found, good))
        rest = rest[~good]
    if len(rest):
        raise InputError(
            "E134",
            f"no usable linkage was drawn for number {number[rest[0]]}",
            why=f"{MAX_ATTEMPTS} attempts had none with the transmission angle asked for",
            help="ask for a smaller transmission angle",
        )
    return _told(drawn, number.astype(np.int64), kind.astype(np.int8), options)


class _Drawn(NamedTuple):
    """Linkages (k,) in their own frame: the driver's ground pivot at 0.

    links: (k, 4), ground, driver, coupler and follower; of a slider-crank the first is how far the
    line is from the driver's pivot, and the last is not in use.  sign: of the two assemblies.
    arc, travel: (k, 2), where they begin and how wide they are: all that transmits, and from the
    first pose to the last.  body: (k, 4), the coupler's first pin in M, as x and y, the angle of
    the coupler in M, and that of the frame in F; origin: (k, 2), in F.
    """

    slides: NDArray[np.bool_]
    links: FloatArray
    sign: FloatArray
    arc: FloatArray
    travel: FloatArray
    least: FloatArray
    body: FloatArray
    origin: FloatArray

    @classmethod
    def none(cls, count: int) -> _Drawn:
        """Room for linkages."""
        shapes = (count, 4), count, (count, 2), (count, 2), count, (count, 4), (count, 2)
        return cls(np.zeros(count, dtype=bool), *(np.zeros(shape) for shape in shapes))

    def pins(self, angle: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """The coupler's pins (k, n) for the driver's angles (k, n), in their own frame."""
        ground, driver, coupler, follower = (each[:, None] for each in self.links.T)
        one = driver * np.exp(1j * angle)
        along = ground - one
        far = np.abs(along)
        at_pin = (coupler**2 + far**2 - follower**2) / (2 * coupler * np.where(far > 0, far, 1.0))
        slope = np.clip((ground - one.imag) / coupler, -1.0, 1.0)
        sign = self.sign[:, None]
        turned = np.angle(along) + sign * np.arccos(np.clip(at_pin, -1.0, 1.0))
        slid = np.where(sign > 0, np.arcsin(slope), np.pi - np.arcsin(slope))
        direction = np.where(self.slides[:, None], slid, turned)
        return one, one + coupler * np.exp(1j * direction)

    def places(self, angle: FloatArray) -> FloatArray:
        """The places (k, n, 3) of the coupler in F for the driver's angles (k, n)."""
        one, two = self.pins(angle)
        x, y, own, turn = (each[:, None] for each in self.body.T)
        place = np.unwrap(np.angle(two - one), axis=1) - own + turn
        origin = (self.origin[:, 0] + 1j * self.origin[:, 1])[:, None]
        d = origin + one * np.exp(1j * turn) - (x + 1j * y) * np.exp(1j * place)
        return np.stack([d.real, d.imag, place], axis=-1)

    @property
    def batch(self) -> LinkageBatch:
        """The linkages in F, the driver first."""
        ground, driver, coupler, follower = self.links.T
        x, y, own, turn = self.body.T
        z = np.zeros((len(self.links), 2, DIMENSIONS))
        z[:, 0, :2], z[:, 0, 2], z[:, 0, 3], z[:, 0, 4] = self.origin, x, y, driver
        z[:, 1, 2], z[:, 1, 3] = x + coupler * np.cos(own), y + coupler * np.sin(own)
        away = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        z[:, 1, :2] = self.origin + ground[:, None] * away
        z[:, 1, 4] = follower
        # The line of a slider-crank is square to the way from the driver's pivot to it.
        normal = turn[self.slides] + np.pi / 2
        n = np.stack([np.cos(normal), np.sin(normal)], axis=-1)
        z[self.slides, 1, 0] = normal
        z[self.slides, 1, 1] = (n * self.origin[self.slides]).sum(axis=1) + ground[self.slides]
        z[self.slides, 1, 4] = 0.0
        kinds = np.zeros((len(z), 2), dtype=np.int8)
        kinds[:, 1] = self.slides
        return LinkageBatch(kinds, z)


def _attempt(
    draws: FloatArray, kind: NDArray[np.intp], options: SampleOptions
) -> tuple[_Drawn, NDArray[np.bool_]]:
    """One linkage from each row of draws (k, 16), and whether it is of its type, and usable."""
    every, slides = np.arange(len(draws)), kind == TYPES.index(SLIDER_CRANK)
    links = np.empty((len(draws), 4))
    links[:, :3] = SHORTEST ** (1 - draws[:, :3])
    # The longest is 1; any of the four may be the longest, of a slider-crank driver or coupler.
    links[:, 3] = 1.0
    longest = np.where(slides, 1 + (draws[:, 3] < 0.5), (draws[:, 3] * 4).astype(np.intp))
    links[every, 3], links[every, longest] = links[every, longest], 1.0
    links[slides, 0] = 2 * draws[slides, 4] - 1
    ground, driver, coupler, follower = links.T
    low, high, offset = _cosines(links, slides, math.radians(options.transmission_deg))
    arc = _arc(low, high, draws[:, 5], draws[:, 6])
    arc[:, 0] += offset
    most = np.maximum(WIDEST * arc[:, 1], LEAST_ARC)
    width = LEAST_ARC + draws[:, 7] * (most - LEAST_ARC)
    travel = np.stack([arc[:, 0] + draws[:, 8] * (arc[:, 1] - width), width], axis=-1)
    good = WIDEST * arc[:, 1] >= LEAST_ARC
    of_type = grashof_numbers(Links(ground, driver, coupler, follower)) == kind
    point = coupler / 2 + FAR_POINT * np.sqrt(draws[:, 9]) * np.exp(2j * np.pi * draws[:, 10])
    own = 2 * np.pi * draws[:, 11]
    pin = -point * np.exp(1j * own)
    body = np.stack([pin.real, pin.imag, own, 2 * np.pi * draws[:, 12]], axis=-1)
    sign = np.where(draws[:, 13] < 0.5, 1.0, -1.0)
    least = _least_transmission(links, slides, travel, offset)
    drawn = _Drawn(slides, links, sign, arc, travel, least, body, 2 * draws[:, 14:16] - 1)
    good &= slides | of_type
    at = np.flatnonzero(good)
    some = take(drawn, at)
    places = some.places(some.travel[:, :1] + np.linspace(0, 1, TURN_PLACES) * some.travel[:, 1:])
    good[at] = np.ptp(places[..., 2], axis=1) >= math.radians(options.turn_deg)
    return drawn, good


WIDEST = 0.95  # of an arc; as wide is the way from the first pose to the last at most


def _cosines(
    links: FloatArray, slides: NDArray[np.bool_], least: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Between which cosines linkages (k,) transmit by an angle, and from where the angle counts."""
    ground, driver, coupler, follower = links.T
    both, twice = ground**2 + driver**2, 2 * ground * driver
    square, most = coupler**2 + follower**2, 2 * coupler * follower * math.cos(least)
    reach = coupler * math.cos(least)
    safe = np.where(slides, 1.0, twice)
    low = np.where(slides, (ground - reach) / driver, (both - square - most) / safe)
    high = np.where(slides, (ground + reach) / driver, (both - square + most) / safe)
    return low, high, np.where(slides, np.pi / 2, 0.0)


def _arc(low: FloatArray, high: FloatArray, place: FloatArray, side: FloatArray) -> FloatArray:
    """The begins and widths (k, 2) of arcs of such cosines, 0 for none; place, side: draws (k,)."""
    first, last = (np.arccos(np.clip(each, -1.0, 1.0)) for each in (high, low))
    start, width = first, last - first
    other = (side < 0.5) & (high < 1) & (low > -1)
    start = np.where(other, -last, start)
    round_zero, round_half = high >= 1, low <= -1
    start, width = np.where(round_zero, -last, start), np.where(round_zero, 2 * last, width)
    width = np.where(round_half & ~round_zero, 2 * (np.pi - first), width)
    full = round_zero & round_half
    start = np.where(full, 2 * np.pi * place, start)
    width = np.where(full, 2 * np.pi, width)
    none = (low >= high) | (high <= -1) | (low >= 1)
    return np.stack([start, np.where(none, 0.0, width)], axis=-1)


def _least_transmission(
    links: FloatArray, slides: NDArray[np.bool_], travel: FloatArray, offset: FloatArray
) -> FloatArray:
    """The least transmission angles (k,), radians, on the way from the first pose to the last."""
    ground, driver, coupler, follower = links.T
    start = travel[:, 0] - offset
    end = start + travel[:, 1]
    turns = np.ceil(start / np.pi) * np.pi
    at = np.stack([start, end, turns, turns + np.pi], axis=-1)
    cosine = np.cos(np.where(at <= end[:, None], at, end[:, None]))
    square = ground**2 + driver**2 - coupler**2 - follower**2
    linked = 2 * ground * driver * cosine.T - square
    linked = linked / np.where(slides, 1.0, 2 * coupler * follower)
    slid = (ground - driver * cosine.T) / coupler
    most = np.abs(np.where(slides, slid, linked)).max(axis=0)
    return np.asarray(np.arccos(np.clip(most, 0.0, 1.0)))


def _told(
    drawn: _Drawn, number: Numbers, kind: NDArray[np.int8], options: SampleOptions
) -> RandomLinkages:
    """What is told of linkages that were drawn."""
    first, count = DRAWS_OF_LINKAGE + MAX_ATTEMPTS * DRAWS_OF_ATTEMPT, options.poses
    off = JITTER * (2 * uniform_draws(options.seed, number, first, count) - 1)
    off[:, [0, -1]] = 0.0
    share = (np.arange(count) + off) / (count - 1)
    inputs = drawn.travel[:, :1] + share * drawn.travel[:, 1:]
    exact = drawn.places(inputs)
    errors = normal_draws(options.seed, number, first + count, 3 * count).reshape(-1, count, 3)
    span = np.hypot(*(np.ptp(exact[..., k], axis=1) for k in (0, 1)))
    size = np.stack([span, span, np.ones_like(span)], axis=-1)
    poses = exact + options.noise * size[:, None] * errors if options.noise else exact
    full = drawn.arc[:, 1:] >= 2 * np.pi
    steps = np.where(full, options.curve, max(1, options.curve - 1))
    along = drawn.arc[:, :1] + np.arange(options.curve) / np.maximum(steps, 1) * drawn.arc[:, 1:]
    return RandomLinkages(
        number,
        kind,
        drawn.batch,
        exact,
        poses,
        np.degrees(drawn.least),
        inputs,
        drawn.places(along),
        drawn.arc,
    )
