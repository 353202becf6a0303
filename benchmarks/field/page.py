"""The pages of the results, `docs/field.md` and `docs/field-tasks.md`, and their two pictures."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from statistics import median
from string import Template
from typing import Any

from benchmarks.field.drawn import FUNCTION_TASKS, HAND
from benchmarks.field.generated import CLOSED, FUNCTIONS, KINDS, OPEN, PATH, TIMED

DOCS = Path(__file__).parents[2] / "docs"
PAGES = {DOCS / "field.md": "page.md", DOCS / "field-tasks.md": "tasks.md"}  # and their templates
SHARES, TIMES = DOCS / "field-solved.png", DOCS / "field-time.png"
OURS = "burmester_synthesize"
SHORT = {
    "burmester_synthesize": "burmester",
    "pencil": "pencil of the paper",
    "scipy_starts": "SciPy, many starts",
    "evolution": "SciPy, evolution",
    "fourbarhinge_fit": "fourbarhinge",
    "pylinkage_motion": "pylinkage",
}
PATHS = (PATH, CLOSED, OPEN, TIMED)
NEARER = 0.8  # of our error: what counts as a smaller one
ROUNDING = 1e-8  # of the span: errors below it are alike

Record = dict[str, Any]


class Results:
    """Records by tool and kind of task."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.names = [name for name in SHORT if name in data["tools"]]
        self.tasks = {task["name"]: task for task in data["tasks"]}
        self.kinds = list(dict.fromkeys(_in_order(task["kind"] for task in data["tasks"])))
        self.records = {(each["tool"], each["task"]): each for each in data["records"]}

    def of(self, name: str, kind: str | None = None) -> list[Record]:
        """What a tool made of the tasks of a kind, or of all, that it takes."""
        out = []
        for task in self.tasks.values():
            record = self.records.get((name, task["name"]))
            if record and record["status"] != "does not apply" and kind in (None, task["kind"]):
                out.append(record)
        return out


def _in_order(kinds: Any) -> list[str]:
    there = set(kinds)
    return [kind for kind in KINDS if kind in there]


def table(data: dict[str, Any]) -> str:
    """A row for each kind of task: solved, median error and median time of every tool."""
    results = Results(data)
    lines = [
        "| tasks | " + " | ".join(SHORT[name] for name in results.names) + " |",
        "|---|" + "--:|" * len(results.names),
    ]
    for kind in results.kinds:
        cells = [_cell(results.of(name, kind)) for name in results.names]
        lines.append(f"| {kind} | " + " | ".join(cells) + " |")
    whole = [results.of(name) for name in results.names]
    lines.append("| **all that it takes** | " + " | ".join(map(_total, whole)) + " |")
    firsts = [f"{sum(_first(each) for each in part)} of {len(part)}" for part in whole]
    lines.append("| **by its first answer** | " + " | ".join(firsts) + " |")
    known = [_known(part) for part in whole]
    lines.append("| **known linkages found** | " + " | ".join(known) + " |")
    return "\n".join(lines)


def _solved(record: Record) -> bool:
    return bool(record.get("solved"))


def _first(record: Record) -> bool:
    return bool(record.get("solved_first"))


def _cell(part: list[Record]) -> str:
    if not part:
        return "–"
    return f"**{sum(map(_solved, part))} of {len(part)}**<br>{_error(part)}<br>{_time(part)}"


def _total(part: list[Record]) -> str:
    return f"**{sum(map(_solved, part))} of {len(part)}**<br>{_time(part)}" if part else "–"


def _known(part: list[Record]) -> str:
    there = sum(record.get("known", 0) for record in part)
    found = sum(record.get("known_found", 0) for record in part)
    return f"{found} of {there}" if there else "–"


def _median_error(part: list[Record]) -> float:
    errors = [record.get("best_error") for record in part]
    return median(float("inf") if error is None else error for error in errors)


def _error(part: list[Record]) -> str:
    error = _median_error(part)
    if error == float("inf"):
        return "none near"
    return "exact" if error < ROUNDING else f"{error:.1g}"


def _seconds(part: list[Record], limit: float | None = None) -> float:
    return median(record.get("cpu", limit or float("inf")) for record in part)


def _time(part: list[Record]) -> str:
    seconds = _seconds(part)
    if seconds == float("inf"):
        return "out of time"
    return f"{seconds:.2g} s" if seconds >= 0.01 else "0.01 s or less"


def better(data: dict[str, Any]) -> list[str]:
    """Sentences, one for each way in which another tool is ahead of ours."""
    results = Results(data)
    lines = []
    for name in results.names:
        if name == OURS:
            continue
        title = data["tools"][name]["title"]
        more = [
            task
            for task in results.tasks
            if _solved(results.records.get((name, task), {}))
            and not _solved(results.records.get((OURS, task), {}))
        ]
        if more:
            lines.append(f"**{title}** solves what burmester does not: {'; '.join(more)}.")
        first = [
            task
            for task in results.tasks
            if _first(results.records.get((name, task), {}))
            and not _first(ours := results.records.get((OURS, task), {}))
            and _solved(ours)
        ]
        if first:
            lines.append(
                f"**{title}** solves by its first answer what burmester solves by a later one: "
                f"{'; '.join(first)}."
            )
        for words, both in (("both solving", True), ("neither solving", False)):
            nearer = _nearer(results, name, both)
            if nearer:
                lines.append(f"**{title}** comes nearer, {words}: {'; '.join(nearer)}.")
        quicker = _quicker(results, name)
        if quicker:
            lines.append(f"**{title}** is faster in the median: {'; '.join(quicker)}.")
    return lines


def _nearer(results: Results, name: str, solving: bool) -> list[str]:
    """Tasks that a tool and ours both solve, or both do not, and in which its error is smaller."""
    out = []
    for task in results.tasks:
        theirs, ours = (results.records.get((each, task), {}) for each in (name, OURS))
        a, b = theirs.get("best_error"), ours.get("best_error")
        if a is None or b is None or {_solved(theirs), _solved(ours)} != {solving}:
            continue
        if b > ROUNDING and a < NEARER * b:
            out.append(f"{task} ({a:.2g} beside {b:.2g})")
    return out


def _tasks(count: int) -> str:
    return f"{count} task{'' if count == 1 else 's'}"


def _quicker(results: Results, name: str) -> list[str]:
    """Kinds in which a tool needs less time than ours on tasks that both solve."""
    out = []
    for kind in results.kinds:
        both = []
        for task in results.tasks.values():
            pair = [results.records.get((each, task["name"]), {}) for each in (name, OURS)]
            if task["kind"] == kind and all(map(_solved, pair)):
                both.append([record["cpu"] for record in pair])
        if both:
            theirs, ours = (median(column) for column in zip(*both, strict=True))
            if theirs < ours:
                out.append(f"{kind} ({theirs:.2g} s beside {ours:.2g} s, {_tasks(len(both))})")
    return out


def troubles(data: dict[str, Any]) -> list[str]:
    """What crashed or ran out of time."""
    lines = []
    for record in data["records"]:
        if record["status"] in ("crashed", "out of time"):
            title = SHORT[record["tool"]]
            lines.append(f"{title}, {record['task']}: {record['status']} ({record['reason']})")
    return lines


def write(data: dict[str, Any]) -> None:
    """The pages and their pictures."""
    for page, template in PAGES.items():
        page.write_text(text(data, template), encoding="utf-8")
    pictures(data)


def text(data: dict[str, Any], template: str = "page.md") -> str:
    """A page: its template with what the results say."""
    results = Results(data)
    asked = [
        "\n  - ".join(
            [f"**{about['title']}**, {about['package']} {about['version']}:", *about["called"]]
        )
        for about in (data["tools"][name] for name in results.names)
    ]
    sources = [
        f"- `{task['name']}`: {task['source']}."
        for task in data["tasks"]
        if task["source"] not in ("generated", HAND) and task["kind"] != FUNCTIONS
    ]
    trouble = "\n".join(f"- {line}" for line in troubles(data))
    page = Template(Path(__file__).with_name(template).read_text(encoding="utf-8"))
    return page.substitute(
        answer=_answer(results),
        table=table(data),
        shares=SHARES.name,
        times=TIMES.name,
        count=len(data["tasks"]),
        counts=_counts(results),
        asked="\n".join(f"- {lines}" for lines in asked),
        sources="\n".join(sources),
        functions=_functions(results),
        limit=f"{data['limit']:g}",
        ahead="\n".join(map(_as_list, better(data))) or "Nowhere in these results.",
        trouble=f"\nWhat crashed or ran out of time:\n\n{trouble}\n" if trouble else "",
        paths=_paths(results),
        dates=_dates(results),
        **data["machine"],
    )


def _as_list(line: str) -> str:
    """What stands behind the colon of a sentence, as items below it."""
    head, _, items = line.removesuffix(".").partition(": ")
    return "\n".join([f"- {head}:", *(f"  - {each}" for each in items.split("; "))])


def _answer(results: Results) -> str:
    """The outcome in a few sentences, from the figures."""
    parts = {name: results.of(name) for name in results.names}
    ours = parts.pop(OURS)
    ranked = sorted(parts, key=lambda name: -sum(map(_solved, parts[name])) / len(parts[name]))
    rest = [f"{SHORT[name]}: {_share(parts[name])}" for name in ranked]
    return (
        f"burmester solves {_share(ours)} tasks. The median task takes {_seconds(ours):.2g} s of "
        "processor time. The authors of burmester wrote this page, and the same script lists "
        "[where other tools are better](#where-other-tools-are-better). A judge that shares no "
        "code with any tool decides what is solved. Of the tasks that they take, the others "
        "solve:\n\n" + "\n".join(f"- {each}" for each in rest)
    )


def _paths(results: Results) -> str:
    """A row for each tool: how many paths it meets at the points, and follows between them."""
    lines = ["| tool | meets the points | follows the path, too |", "|---|--:|--:|"]
    for name in results.names:
        part = [each for kind in PATHS for each in results.of(name, kind)]
        if part:
            met, number = sum(each.get("meets_points", 0) > 0 for each in part), len(part)
            solved = sum(map(_solved, part))
            lines.append(f"| {SHORT[name]} | {met} of {number} | {solved} of {number} |")
    return "\n".join(lines)


def _dates(results: Results) -> str:
    """When tools were run: of every day those whose figures are of that day."""
    by_date: dict[str, dict[str, int]] = {}
    for name in results.names:
        for record in results.of(name):
            day = by_date.setdefault(record["date"], {})
            day[name] = day.get(name, 0) + 1
    if len(by_date) == 1:
        return f"All figures are of {next(iter(by_date))}."
    lines = []
    for date, numbers in sorted(by_date.items(), reverse=True):
        tools = [f"{SHORT[name]} ({_tasks(number)})" for name, number in numbers.items()]
        lines.append(f"- {date}: {'; '.join(tools)}.")
    return "Figures are of these days:\n\n" + "\n".join(lines)


def _counts(results: Results) -> str:
    """How many tasks there are, by where they are from."""
    tasks = results.tasks.values()
    random = sum(task["source"] == "generated" for task in tasks)
    shapes = sum(task["source"] == HAND for task in tasks)
    functions = sum(task["kind"] == FUNCTIONS for task in tasks)
    published = len(tasks) - random - shapes - functions
    return (
        f"There are {len(tasks)} tasks: {published} from papers and programs, {shapes} paths drawn "
        f"by hand, {functions} functions, and {random} drawn at random from seed "
        f"{results.data['seed']}."
    )


def _functions(results: Results) -> str:
    """A row for each function: its ranges, and where it is from."""
    lines = ["| function of x | input | output | from |", "|---|--:|--:|---|"]
    for name, (_, _, _, turn, swing, source) in FUNCTION_TASKS.items():
        if name in results.tasks:
            lines.append(f"| {name} | {turn}° | {swing}° | {source} |")
    return "\n".join(lines)


def _share(part: list[Record]) -> str:
    return f"{sum(map(_solved, part))} of {len(part)}"


def pictures(data: dict[str, Any]) -> None:
    """The share of tasks solved by kind, and over time."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    results = Results(data)
    share = np.full((len(results.kinds), len(results.names)), np.nan)
    for i, kind in enumerate(results.kinds):
        for j, name in enumerate(results.names):
            part = results.of(name, kind)
            if part:
                share[i, j] = sum(map(_solved, part)) / len(part)
    figure, axes = plt.subplots(figsize=(8.2, 6.2), layout="constrained")
    colours = mpl.colormaps["YlGn"].with_extremes(bad="#eeeeee")
    axes.imshow(share, cmap=colours, vmin=0, vmax=1.25, aspect="auto")
    for i, kind in enumerate(results.kinds):
        for j, name in enumerate(results.names):
            part = results.of(name, kind)
            words = f"{sum(map(_solved, part))} of {len(part)}" if part else "–"
            colour = "white" if share[i, j] > 0.6 else "black"
            axes.text(j, i, words, ha="center", va="center", fontsize=9, color=colour)
    axes.set_xticks(range(len(results.names)), [SHORT[name] for name in results.names], fontsize=9)
    axes.set_yticks(range(len(results.kinds)), results.kinds, fontsize=9)
    axes.xaxis.tick_top()
    plt.setp(axes.get_xticklabels(), rotation=18, ha="left")
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    _save(figure, SHARES)

    figure, axes = plt.subplots(figsize=(6.2, 3.8), layout="constrained")
    count = len(results.tasks)
    for name, style in zip(
        results.names, ("-", ":", "--", "-.", (0, (5, 1)), (0, (1, 1))), strict=False
    ):
        seconds = sorted(record["cpu"] for record in results.of(name) if _solved(record))
        x = [1e-3, *(max(each, 1e-3) for each in seconds), data["limit"]]
        y = [0, *range(1, len(seconds) + 1), len(seconds)]
        wide = 2.4 if name == OURS else 1.6
        axes.step(
            x,
            [100 * each / count for each in y],
            where="post",
            linestyle=style,
            linewidth=wide,
            label=SHORT[name],
        )
    axes.set_xscale("log")
    axes.set_xlim(5e-3, data["limit"])
    axes.set_ylim(0, 100)
    axes.set_xlabel("processor time for a task, s")
    axes.set_ylabel(f"solved, % of all {count} tasks")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="upper left")
    _save(figure, TIMES)


def _save(figure: Any, path: Path) -> None:
    """In 64 colours: a third of the bytes."""
    import matplotlib.pyplot as plt
    from PIL import Image

    with BytesIO() as whole:
        figure.savefig(whole, dpi=130, format="png")
        whole.seek(0)
        picture = Image.open(whole).convert("P", palette=Image.Palette.ADAPTIVE, colors=64)
    picture.save(path, optimize=True)
    plt.close(figure)
