"""Check "scale": the size of the object is plausible in metres."""

from __future__ import annotations

from collections.abc import Iterator

from anymesh.checking.content import Content
from anymesh.checking.report import Finding, failure, warning

CHECK = "scale"
MIN_DIAGONAL, MAX_DIAGONAL = 0.01, 20.0  # [m] diagonal of articulated objects, from a clasp to a gate
BEYOND = 10.0  # factor beyond these that indicates other units


def check_scale(content: Content) -> Iterator[Finding]:
    """Check that the diagonal at rest is plausible in metres."""
    diagonal = content.diagonal
    if diagonal == 0:
        yield failure(CHECK, "", "the object has no shape; links need visual or collision shapes")
    elif not MIN_DIAGONAL <= diagonal <= MAX_DIAGONAL:
        far = not MIN_DIAGONAL / BEYOND <= diagonal <= MAX_DIAGONAL * BEYOND
        problem = f"the object's diagonal is {diagonal:.4g} m; plausible is {MIN_DIAGONAL:g} to {MAX_DIAGONAL:g} m"
        yield failure(CHECK, "", f"{problem}; are the units metres?") if far else warning(CHECK, "", problem)
