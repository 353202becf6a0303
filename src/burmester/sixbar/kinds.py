"""The classes of six-bars, by the name of their skeleton.

A class makes a linkage of the link that carries the body and the joints in the frames of links: so
files hold it, whatever its class.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, TypeAlias

from burmester.sixbar.watt import WattLinkage
from burmester.stephenson.linkage import CLASSES, StephensonClass, StephensonLinkage

SixBar: TypeAlias = WattLinkage | StephensonLinkage

KINDS: Final[Mapping[str, type[WattLinkage] | StephensonClass]] = {
    WattLinkage.skeleton.name: WattLinkage,
    **CLASSES,
}
