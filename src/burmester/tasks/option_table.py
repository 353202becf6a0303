"""The table of how a synthesis may be told to proceed: what each face calls an option, and help.

Limits and requirements are asked of linkages; requirements have a table of their own.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, Literal, NamedTuple, TypeAlias, get_args

Method: TypeAlias = Literal["auto", "pencil", "exact", "complete"]
Norm: TypeAlias = Literal["rms", "worst"]
Preference: TypeAlias = Literal["transmission", "size", "accuracy"]
Form: TypeAlias = Literal["word", "length", "lengths", "seconds", "flag"]


class Option(NamedTuple):
    """One option of `SynthesisOptions`, by its name there and in a batch's file.

    known: the words that may be given, the first of them where none is.  option: of the command,
    which says no where `negated`.  label: of its field in the studio, words: of those known there.
    """

    name: str
    form: Form
    option: str
    help: str
    metavar: str | None = None
    known: tuple[str, ...] = ()
    negated: bool = False
    manufacturing: bool = False
    label: str = ""
    words: tuple[str, ...] = ()


OPTIONS: Final = (
    Option(
        "method",
        "word",
        "--method",
        "pencil: the paper's two dyads for 6 poses or more; complete: every locally best dyad "
        "for 6 or more; exact: all dyads through 5; auto: complete for 6 or more, exact for 5.",
        "METHOD",
        get_args(Method),
        label="method",
        words=(
            "chosen by the task",
            "pencil: the two dyads of the paper",
            "exact: through five poses",
            "complete: every locally best dyad",
        ),
    ),
    Option(
        "norm",
        "word",
        "--norm",
        "The error to minimise: root mean square, or the largest deviation (worst).",
        known=get_args(Norm),
        label="what is made least",
        words=("the root mean square", "the worst pose"),
    ),
    Option(
        "length_per_radian",
        "length",
        "--angle-weight",
        "The position error that counts as much as one radian of angle error; by default a "
        "third of the travel per radian of turn, or the radius of gyration of the body.",
        "LENGTH",
        label="one radian counts as",
    ),
    Option(
        "prefer",
        "word",
        "--prefer",
        "What the recommended linkage of two to four poses is best at.",
        known=get_args(Preference),
        label="two to four poses: best at",
        words=get_args(Preference),
    ),
    Option(
        "nine_point_starts",
        "flag",
        "--nine-point-starts",
        "Open paths: look from the linkages through nine of the points as well.",
        label="start from nine of the points, too: open paths",
    ),
    Option(
        "certify",
        "flag",
        "--certify",
        "Prove with interval arithmetic what can be proved.",
        label="prove what can be proved",
    ),
    Option(
        "normalise",
        "flag",
        "--raw",
        "Fit the numbers as given, as the paper does: frames and unit are not normalised, and "
        "the result depends on them.",
        negated=True,
        label="fit the numbers as given: only by the pencil",
    ),
    Option(
        "time_limit",
        "seconds",
        "--time-limit",
        "Look no further after so many seconds: the answer is the best until then, and a warning "
        "says what was not finished.  What every answer needs may take longer.",
        "SECONDS",
    ),
    Option(
        "manufacturing_tolerance",
        "length",
        "--tolerance",
        "Manufacturing tolerance of pivots and lengths; report the resulting error.",
        "LENGTH",
        manufacturing=True,
        label="pivots and lengths are made to ±",
    ),
    Option(
        "rounding_step",
        "length",
        "--round",
        "Round lengths and pivots to multiples of STEP, and check the linkage again.",
        "STEP",
        manufacturing=True,
        label="round lengths and pivots to",
    ),
    Option(
        "stock_lengths",
        "lengths",
        "--stock",
        "Available link lengths; the nearest are used, and the linkage is checked again.",
        "L1,L2,...",
        manufacturing=True,
        label="link lengths in stock",
    ),
)


# Those that the studio has, by their long names.
STUDIO_OPTIONS: Final = {each.option.removeprefix("--"): each for each in OPTIONS if each.label}


class LimitOption(NamedTuple):
    """One limit on a dyad, by its name in `Limits` and in files; given once or for each dyad.

    kind: of its value, a region, a range of lengths, kinds of dyads, or the line of a slider.
    label: of its field in the studio, words: of its values there.
    """

    name: str
    kind: Literal["region", "range", "kinds", "line"]
    metavar: str
    help: str
    label: str = ""
    words: Mapping[str, str] = MappingProxyType({})

    @property
    def option(self) -> str:
        """Its option of the command."""
        return f"--{self.name.replace('_', '-')}"


LIMIT_OPTIONS: Final = (
    LimitOption(
        "fixed_pivot",
        "region",
        "REGION",
        "Region of a fixed pivot, on the ground.",
        "Fixed pivot, in the ground",
    ),
    LimitOption(
        "moving_pivot",
        "region",
        "REGION",
        "Region of a moving pivot, on the body.",
        "Moving pivot, in the body",
    ),
    LimitOption(
        "length",
        "range",
        "MIN:MAX",
        "Length of the link of an RR dyad; MIN or MAX may be left out.",
        "length",
    ),
    LimitOption(
        "kinds",
        "kinds",
        "RR,PR,RP",
        "Kinds of dyads allowed: links RR, sliders PR, slots RP.",
        "kinds of dyads",
        {"RR": "a link", "PR": "a slider", "RP": "a slot", "PP": "a carriage"},
    ),
    LimitOption(
        "rail",
        "line",
        "LINE",
        'The rail of a slider on the ground, such as "direction:0+-2 through:0,0 '
        'travel:box:0,-5:400,5"; each part may be left out.',
        "Rail of a slider, in the ground",
    ),
    LimitOption(
        "slot",
        "line",
        "LINE",
        "The same of a slot in the body, on the body.",
        "Slot of a block, in the body",
    ),
)

# The tables at the top of a task in a file, and all keys there.
TABLES: Final = (
    "pose_sigma", "tolerance", "body", "keep_out", "surroundings", "limits", "requirements", "path",
    "crank", "loads", "springs", "drive", "picture",
)  # fmt: skip
TOP_KEYS: Final = ("poses", "angle_unit", "length_unit", *TABLES)
