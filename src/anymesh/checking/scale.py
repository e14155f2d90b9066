"""Check "scale": the object is as large as a thing can be, in metres."""

from __future__ import annotations

from collections.abc import Iterator

from anymesh.checking.content import Content
from anymesh.checking.report import Finding, failure, warning

CHECK = "scale"
MIN_DIAGONAL, MAX_DIAGONAL = 0.01, 20.0  # [m] diagonal of things with joints, from a clasp to a gate
BEYOND = 10.0  # times that is other units


def check_scale(content: Content) -> Iterator[Finding]:
    """The diagonal at rest is plausible in metres."""
    diagonal = content.diagonal
    if diagonal == 0:
        yield failure(CHECK, "", "the object has no shape at all; links need visual or collision shapes")
    elif not MIN_DIAGONAL <= diagonal <= MAX_DIAGONAL:
        far = not MIN_DIAGONAL / BEYOND <= diagonal <= MAX_DIAGONAL * BEYOND
        told = f"the object's diagonal is {diagonal:.4g} m; plausible is {MIN_DIAGONAL:g} to {MAX_DIAGONAL:g} m"
        yield failure(CHECK, "", f"{told}; are the units metres?") if far else warning(CHECK, "", told)
