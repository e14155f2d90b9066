"""What no view shows: interior parts, which nobody can point at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.pieces import ObjectShape
from anymesh.segmentation.cloud import Cloud
from anymesh.segmentation.faces import SLIVER
from anymesh.segmentation.fuse import Counts
from anymesh.segmentation.naming import named_parts
from anymesh.types import Segmentation


def unseen_faces(whole: ObjectShape, cloud: Cloud, counts: Sequence[Counts]) -> Bool[np.ndarray, " F"]:
    """Faces of pieces that no view shows, or so little of them that nobody could name them."""
    shown = np.zeros(len(cloud), bool)
    for c in counts:
        shown[c.points] = True
    piece = whole.mesh_piece[cloud.faces]
    total = np.bincount(piece, minlength=int(whole.mesh_piece.max()) + 1)
    return (np.bincount(piece, shown, len(total)) <= SLIVER * total)[whole.mesh_piece]


def with_hidden(
    found: Segmentation, other: Segmentation, unseen: Bool[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> tuple[Segmentation, tuple[str, ...]]:
    """The parts found and those of another segmentation that no view shows (a turntable behind a closed door), with a
    warning for each of these."""
    face_part = found.face_part.copy()
    parts, warnings = list(found.parts[1:]), []
    for k, part in enumerate(other.parts[1:], start=1):
        mine = other.face_part == k
        if areas[mine & ~unseen].sum() <= SLIVER * areas[mine].sum() and not face_part[mine].any():
            parts.append(replace(part, reason=f"no view shows it; found by geometry: {part.reason}"))
            warnings.append(f"no view shows the {part.label} inside; geometry found it")
            face_part[mine] = len(parts)
    whole = named_parts(face_part, [p.label for p in parts], areas, [p.confidence for p in parts], [p.reason for p in parts])
    return whole, tuple(warnings)
