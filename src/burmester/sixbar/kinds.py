"""The classes of six-bars, by the name of their skeleton.

A class makes a linkage of the link that carries the body and the joints in the frames of links: so
files hold it, whatever its class.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from burmester.sixbar.watt import WattLinkage

__all__ = ["KINDS"]

KINDS: Final[Mapping[str, type[WattLinkage]]] = {WattLinkage.skeleton.name: WattLinkage}
