"""What may stand in a result: every key of `synthesis.schema.json`, its type and its bounds.

Stricter than the schema and never laxer: a test holds both against each other.  Keys that are not
known here may stand in a result and are not looked at.  Imported on first use, as pydantic is slow
to import.

E150 anything else
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from burmester.errors import InputError
from burmester.fourbar.defects import DefectKind
from burmester.tasks.limits import KINDS
from burmester.tasks.motion_task import MOST_NAME, MOST_UNIT
from burmester.tasks.pose_tolerances import Component, ToleranceAxes
from burmester.tasks.requirements import TYPES
from burmester.values import shown
from burmester.verdicts.found_linkage import Side
from burmester.verdicts.requirement_check import ViolationKind

__all__ = [
    "WrittenClearance",
    "WrittenDrive",
    "WrittenDyad",
    "WrittenLinkage",
    "WrittenQuality",
    "WrittenResult",
    "WrittenSixBar",
    "WrittenSixBars",
    "path_of",
    "written_result",
]

MOST = 1e100  # the greatest number of a result; poses and dyads are far below
MOST_TEXT = 10_000  # characters of a sentence
MOST_ITEMS = 10_000  # dyads, linkages, warnings, and what each of them lists
MOST_POSES = 10_000_000
MOST_UNMET = 20  # requirements and limits that a linkage misses, each once for a dyad


def _known(name: str) -> str:
    """A type that a linkage may have."""
    if name not in TYPES:
        raise PydanticCustomError("unknown_name", "unknown")
    return name


def _once(names: list[str]) -> list[str]:
    """Names of which none stands twice."""
    if len(set(names)) < len(names):
        raise PydanticCustomError("twice", "twice")
    return names


def _without_null(given: Any, *keys: str) -> Any:
    """The object; refused where one of these keys is null."""
    for key in keys:
        if isinstance(given, dict) and key in given and given[key] is None:
            raise PydanticCustomError("null", "{key}", {"key": key})
    return given


_Number = Annotated[float, Field(ge=-MOST, le=MOST, allow_inf_nan=False)]
_Size = Annotated[float, Field(ge=0, le=MOST, allow_inf_nan=False)]
_Count = Annotated[int, Field(ge=0, le=MOST_POSES)]
_Text = Annotated[str, Field(max_length=MOST_TEXT)]
_Name = Annotated[str, Field(max_length=MOST_NAME)]
_Texts = Annotated[list[_Text], Field(max_length=MOST_ITEMS)]
_Pair = Annotated[list[_Number], Field(min_length=2, max_length=2)]
_Range = Annotated[list[_Number | None], Field(min_length=2, max_length=2)]
_OutcomeCode = Annotated[str, Field(pattern="^[ER][0-9]{3}$")]
_LinkageId = Annotated[str, Field(pattern="^L[1-9][0-9]{0,6}$")]
_SixBarId = Annotated[str, Field(pattern="^S[1-9][0-9]{0,6}$")]
_DyadId = Annotated[str, Field(pattern="^[A-Z]{1,3}[1-9][0-9]{0,6}$")]
_Type = Annotated[str, AfterValidator(_known)]


class _Part(BaseModel):
    """An object that may have further keys."""

    model_config = ConfigDict(strict=True, extra="ignore")


class _Outcome(_Part):
    code: _OutcomeCode
    message: _Text
    why: _Text | None = None
    help: _Text | None = None


class _Warning(_Part):
    code: Annotated[str, Field(pattern="^W[0-9]{3}$")]
    message: _Text
    why: _Text | None = None
    help: _Text


class _Motion(_Part):
    code: _OutcomeCode
    name: _Text
    message: _Text
    distinct_poses: _Count
    rotation_deg: _Number
    nullity: _Count


class _Place(_Part):
    x: _Number
    y: _Number
    angle_deg: _Number


class _PoseTolerance(_Part):
    x: _Size | None = None
    y: _Size | None = None
    angle_deg: _Size | None = None
    axes: ToleranceAxes | None = None


class _Pose(_Place):
    name: _Name | None = None
    tolerance: _PoseTolerance | None = None
    free: Annotated[list[Component], Field(max_length=2)] | None = None


class _Sigma(_Part):
    position: _Size
    angle_deg: _Size


class _Task(_Part):
    """The poses' own reader looks at the rest."""

    poses: Annotated[list[_Pose], Field(max_length=MOST_POSES)]
    length_unit: Annotated[str, Field(max_length=MOST_UNIT)] | None
    requirements: dict[str, Any] = {}
    pose_sigma: _Sigma | None = None

    @model_validator(mode="before")
    @classmethod
    def _stated(cls, given: Any) -> Any:
        """No null for what is either an object or left out."""
        return _without_null(given, "requirements", "pose_sigma")


class _Line(_Part):
    normal_deg: _Number
    offset: _Number
    point: _Pair | None = None
    direction_deg: Annotated[float, Field(gt=-90, le=90)] | None = None

    @model_validator(mode="before")
    @classmethod
    def _stated(cls, given: Any) -> Any:
        """No null for what is either there or left out."""
        return _without_null(given, "point", "direction_deg")


class _AnyDyad(_Part):
    id: _DyadId
    rms_error: _Size
    max_error: _Size


class _RR(_AnyDyad):
    kind: Literal["RR"]
    fixed_pivot: _Pair
    moving_pivot: _Pair
    radius: Annotated[float, Field(gt=0, le=MOST)]


class _PR(_AnyDyad):
    kind: Literal["PR"]
    line: _Line
    moving_pivot: _Pair


class _RP(_AnyDyad):
    kind: Literal["RP"]
    fixed_pivot: _Pair
    line: _Line


class _PP(_AnyDyad):
    kind: Literal["PP"]
    angle_deg: _Number


_LinkageDyad = Annotated[_RR | _PR | _RP, Field(discriminator="kind")]
_TaskDyad = Annotated[_RR | _PR | _RP | _PP, Field(discriminator="kind")]
WrittenDyad = _RR | _PR | _RP | _PP


class _Errors(_Part):
    rms: _Size | None
    max: _Size | None


class _Defect(_Part):
    kind: DefectKind
    message: _Text
    poses: Annotated[list[Annotated[int, Field(ge=1)]], Field(max_length=MOST_POSES)]
    certain: bool


_Defects = Annotated[list[_Defect], Field(max_length=MOST_ITEMS)]


class _Transmission(_Part):
    poses: Annotated[float, Field(ge=0, le=90)] | None
    range: Annotated[float, Field(ge=0, le=90)] | None


_Sizes = Annotated[list[_Size | None], Field(min_length=2, max_length=2)]


class WrittenQuality(_Part):
    """The figures of quality of one linkage."""

    transmission_deg: Annotated[float, Field(ge=0, le=90)] | None
    extent: _Size | None
    sensitivity: _Size | None
    driver_turn_deg: _Size | None = None
    driver_travel: _Size | None = None
    mechanical_advantage: _Sizes
    reserve_deg: _Sizes | None = None
    reserve: _Sizes | None = None

    @model_validator(mode="before")
    @classmethod
    def _one_driver(cls, given: Any) -> Any:
        turns, slides = ("driver_turn_deg", "reserve_deg"), ("driver_travel", "reserve")
        if isinstance(given, dict) and [key in given for key in turns + slides] not in (
            [True, True, False, False],
            [False, False, True, True],
        ):
            raise PydanticCustomError("driver", "driver")
        return _without_null(given, "reserve_deg", "reserve")


class WrittenDrive(_Part):
    """The verdicts with one dyad as the driver."""

    defects: _Defects
    turns_fully: bool
    min_transmission_angle_deg: _Transmission
    circuit: Annotated[int, Field(ge=0, le=1)] | None
    travel: _Range | None = None
    travel_deg: _Range | None = None

    @model_validator(mode="before")
    @classmethod
    def _one_travel(cls, given: Any) -> Any:
        if isinstance(given, dict) and ("travel" in given) == ("travel_deg" in given):
            raise PydanticCustomError("travel", "travel or travel_deg")
        return _without_null(given, "travel", "travel_deg")


class _Drives(_Part):
    first: WrittenDrive
    second: WrittenDrive


class _Region(_Part):
    half_width: _Size | None
    major: _Size | None
    minor: _Size | None
    direction_deg: _Number | None
    determined: bool


class _LineRegion(_Part):
    normal_deg: _Size | None
    offset_at_mid_travel: _Size | None
    determined: bool


class _DyadRegions(_Part):
    dyad: _DyadId
    fixed_pivot: _Region | None
    moving_pivot: _Region | None
    line: _LineRegion | None
    length: _Size | None
    length_determined: bool = True


class _Uncertainty(_Part):
    confidence: Annotated[float, Field(ge=0.95, le=0.95)]
    determined: bool
    dyads: Annotated[list[_DyadRegions], Field(min_length=2, max_length=2)]


class _Unmet(_Part):
    kind: ViolationKind
    message: _Text


class _Tolerance(_Part):
    tolerance: _Size | None
    rms: _Size | None
    max_95: _Size | None
    bound: _Size | None
    deviation_at_poses: Annotated[list[_Size | None], Field(max_length=MOST_POSES)]
    bound_at_poses: Annotated[list[_Size | None], Field(max_length=MOST_POSES)]
    method: Literal["first_order", "monte_carlo"] = "first_order"
    lost: Annotated[float, Field(ge=0, le=1)] | None = None


class _Shares(_Part):
    x: _Size | None
    y: _Size | None
    angle: _Size | None


class _Rounded(_Part):
    position_error_before: _Errors
    angle_error_before_deg: _Errors


class WrittenClearance(_Part):
    """The least clearance of a linkage as it stands in the file."""

    least: _Size
    error: _Size
    part: Literal["the body", "the driver", "the follower", "the coupler"]
    obstacle: Annotated[str, Field(max_length=MOST_NAME)]
    poses: Annotated[
        list[Annotated[int, Field(ge=1, le=MOST_POSES)]], Field(min_length=2, max_length=2)
    ]
    input: _Number | None = None
    input_deg: _Number | None = None
    place: _Place
    points: Annotated[list[_Pair], Field(min_length=2, max_length=2)]

    @model_validator(mode="before")
    @classmethod
    def _stated(cls, given: Any) -> Any:
        """No null for what is either there or left out."""
        return _without_null(given, "input", "input_deg")


class _Links(_Part):
    ground: _Size
    driver: _Size
    coupler: _Size
    follower: _Size


_Types = Annotated[list[_Type], Field(min_length=1, max_length=8), AfterValidator(_once)]


class _Move(_Part):
    dyad: _DyadId
    fixed_pivot: _Size = 0.0
    moving_pivot: _Size = 0.0
    length: _Number = 0.0
    line: _Size = 0.0
    turn_deg: _Size = 0.0


class _Moved(_Part):
    message: _Text
    greatest: _Size
    dyads: Annotated[list[_Move], Field(min_length=2, max_length=2)]


class WrittenLinkage(_Part):
    """A linkage as it stands in the file."""

    id: _LinkageId
    rank: Annotated[int, Field(ge=1, le=MOST_ITEMS)]
    dyads: Annotated[list[_LinkageDyad], Field(min_length=2, max_length=2)]
    type: _Type
    possible_types: _Types | None = None
    position_error: _Errors
    angle_error_deg: _Errors
    combined_error: _Size | None = None
    shortcomings: _Texts = []
    quality: WrittenQuality | None = None
    usable: bool
    defects: _Defects
    driver: Side | None
    min_transmission_angle_deg: _Transmission
    unmet: Annotated[list[_Unmet], Field(max_length=MOST_UNMET)]
    sought: bool
    drives: _Drives
    pivot_uncertainty: _Uncertainty | None
    clearance: WrittenClearance | None = None
    links: _Links | None = None
    coupler: Annotated[list[_Place], Field(max_length=MOST_POSES)] | None = None
    within_tolerance: Annotated[list[_Shares], Field(max_length=MOST_POSES)] | None = None
    tolerance: _Tolerance | None = None
    rounded: _Rounded | None = None
    given: bool = False
    moved: _Moved | None = None

    @model_validator(mode="before")
    @classmethod
    def _stated(cls, given: Any) -> Any:
        """No null for what is either an object or left out."""
        optional = (
            "possible_types",
            "clearance",
            "links",
            "coupler",
            "within_tolerance",
            "tolerance",
            "rounded",
            "moved",
        )
        return _without_null(given, *optional)


class _CertifiedDyad(_Part):
    id: _DyadId
    proved: bool
    radius: _Size | None
    angle_radius_deg: _Size | None
    minimum: bool | None


class _Certificate(_Part):
    complete: bool
    proved: _Texts
    numerical: _Texts
    dyads: Annotated[list[_CertifiedDyad], Field(max_length=MOST_ITEMS)]


class _Search(_Part):
    kind: Literal["pencil", "five poses", "critical points", "faces", "poses and points"]
    classes: Annotated[int, Field(ge=0)] = 0
    found: Annotated[int | None, Field(ge=0)] = None
    real: Annotated[int, Field(ge=0)] = 0
    lost: Annotated[int, Field(ge=0)] = 0


class _Assumed(_Part):
    message: _Text
    option: _Text


class _Family(_Part):
    rule: _Text
    assumed: Annotated[list[_Assumed], Field(max_length=MOST_ITEMS)]
    given_up: bool
    dyads: Annotated[int, Field(ge=0)]
    pairs: Annotated[int, Field(ge=0)]


class _SixBarGround(_Part):
    A: _Pair
    B: _Pair


class _SixBarCoupler(_Part):
    D: _Pair
    E: _Pair


class _SixBarCrank(_Part):
    D: _Pair
    G: _Pair


class _SixBarBody(_Part):
    E: _Pair
    H: _Pair


class _SixBarLengths(_Part):
    AC: _Size
    GH: _Size


class WrittenSixBar(_Part):
    """A six-bar as it stands in the file: its dimensions, and the drive at the poses."""

    id: _SixBarId
    driver: Side
    ground: _SixBarGround
    coupler: _SixBarCoupler
    second_crank: _SixBarCrank
    body: _SixBarBody
    lengths: _SixBarLengths
    drive_deg: Annotated[list[_Number], Field(min_length=2, max_length=MOST_POSES)]
    extent: _Size
    shortcomings: _Texts
    usable: bool = True
    given: bool = False
    defects: _Defects = []
    unmet: Annotated[list[_Unmet], Field(max_length=MOST_UNMET)] = []


class WrittenSixBars(_Part):
    """The answer of a search for six-bars."""

    chains: Annotated[int, Field(ge=0)]
    designs: Annotated[int, Field(ge=0)]
    working: Annotated[int, Field(ge=0)]
    found: Annotated[list[WrittenSixBar], Field(max_length=MOST_ITEMS)]


class WrittenResult(_Part):
    """A result as it stands in the file."""

    schema_: Literal["burmester.synthesis/1"] = Field(alias="schema")
    outcome: _Outcome
    task: _Task
    dyads: Annotated[list[_TaskDyad], Field(max_length=MOST_ITEMS)]
    linkages: Annotated[list[WrittenLinkage], Field(max_length=MOST_ITEMS)]
    warnings: Annotated[list[_Warning], Field(max_length=MOST_ITEMS)]
    motion: _Motion | None = None
    search: Annotated[list[_Search], Field(max_length=2)] = []
    family: _Family | None = None
    certificate: _Certificate | None = None
    characteristic_length: _Size | None = None
    length_per_radian: _Size | None = None
    six_bars: WrittenSixBars | None = None


def written_result(tree: dict[str, Any], help: str) -> WrittenResult:
    """The result in a tree of JSON; E150 with the JSON path of the first fault."""
    try:
        return WrittenResult.model_validate(tree)
    except ValidationError as error:
        fault: Any = error.errors(include_url=False)[0]
    path, kind, context = fault["loc"], fault["type"], fault.get("ctx") or {}
    if kind == "null":
        path, kind = (*path, context["key"]), "none"
    given = shown(fault.get("input"))
    why = {
        "missing": "it is missing",
        "none": "it is null",
        "travel": "it has travel and travel_deg, or neither of them",
        "driver": "it has figures of a driver that turns and of one that slides, or not all",
        "union_tag_not_found": "its kind is missing",
        "string_unicode": "there is half a character in it",
        "string_pattern_mismatch": f"it is {given}, and burmester writes {_example(path)}",
        "twice": f"one of {given} stands twice",
        "unknown_name": f"it is {given}, which burmester does not write",
        "literal_error": f"it is {given}, not {context.get('expected')}",
        "union_tag_invalid": f"its kind is {context.get('tag')!r:.40}, not one of the kinds",
        "too_long": f"it has more than {context.get('max_length')} items",
        "too_short": f"it has less than {context.get('min_length')} items",
        "string_too_long": f"it has more than {context.get('max_length')} characters",
    }.get(kind)
    if why is None:
        word = next((name for start, name in _WANTED.items() if kind.startswith(start)), None)
        why = f"it is {given}, not {word}" if word else f"it is {given}: {fault['msg']}"
    message = f"{path_of(*path)} of this result cannot be used"
    raise InputError("E150", message, why=why, help=help)


_WANTED = {
    "finite": "a number that is finite",
    "greater": "a number in its range",
    "less": "a number in its range",
    "float": "a number",
    "int": "a whole number",
    "bool": "true or false",
    "string": "a text",
    "list": "a list",
    "dict": "an object",
    "model": "an object",
}


def _example(path: tuple[str | int, ...]) -> str:
    if path[-1] == "code":
        return "codes such as R300"
    kind = "D" if "dyads" in path else "S" if "six_bars" in path else "L"
    return f"ids such as {kind}1"


def path_of(*keys: str | int) -> str:
    """The JSON path of a place in a result: "$.linkages[0].dyads[1].id"."""
    steps = (f"[{key}]" if isinstance(key, int) else f".{key}" for key in keys if key not in KINDS)
    return "$" + "".join(steps)
