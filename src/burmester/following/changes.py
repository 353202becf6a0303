"""What became of dyads and linkages, in sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from burmester.dyads.selection import FoundDyad
from burmester.following.followed import Change
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.verdicts.explanation import reasons
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import listed

__all__ = ["dyad_changes", "linkage_changes"]


def dyad_changes(
    before: Sequence[FoundDyad], after: Sequence[FoundDyad], task: Task
) -> list[Change]:
    """The dyads that vanished and that appeared."""
    old, new = {each.id for each in before}, {each.id for each in after}
    gone = [
        Change(each.id, "vanished", f"{each.id} vanished: no dyad is left near where it was")
        for each in before
        if each.id not in new
    ]
    come = [
        Change(
            each.id,
            "appeared",
            f"{each.id} appeared; it misses the poses by {length_of(each.max_error, task)} at most",
        )
        for each in after
        if each.id not in old
    ]
    return gone + come


def linkage_changes(
    before: Mapping[str, FoundLinkage],
    after: Sequence[FoundLinkage],
    vanished: Sequence[str],
    task: Task,
) -> list[Change]:
    """The linkages that vanished or appeared, and those that crossed a verdict."""
    out = [
        Change(id, "vanished", f"{id} vanished with {_pair(before[id])}")
        for id in vanished
        if id in before
    ]
    for each in after:
        old = before.get(each.id)
        if old is None:
            out.append(Change(each.id, "appeared", f"{each.id} appeared, of {_pair(each)}"))
        elif each.usable and not old.usable:
            out.append(Change(each.id, "works", f"{each.id} works now"))
        elif not each.usable and _why(each) != _why(old):
            why = "; ".join(reasons(each, task))
            if old.usable:
                out.append(Change(each.id, "fails", f"{each.id} no longer works: {why}"))
            else:
                out.append(Change(each.id, "other defects", f"{each.id} fails: {why}"))
    return out


def _pair(found: FoundLinkage) -> str:
    return listed([each.id for each in found.dyads])


def _why(found: FoundLinkage) -> tuple[str, ...]:
    """The kinds of defects and violations, which are a verdict's name."""
    kinds: set[str] = {each.kind for each in found.defects}
    return tuple(sorted(kinds | {each.kind for each in found.violations}))
