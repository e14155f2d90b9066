"""Interior parts that no view shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.patches import ObjectShape
from anymesh.prompted.grounding.cloud import Cloud
from anymesh.prompted.grounding.faces import MIN_SEEN_SHARE
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.surface_regions import patch_sizes
from anymesh.types import Mesh, Segmentation

MAX_SEEN_SHARE = 0.25  # patches up to this visible share of the surface count as mostly hidden
MIN_INNER_PATCH_RATIO = 0.05  # of the object's diagonal: hidden patches with a smaller diagonal are not shown
# of the object's diagonal: minimum size of a hidden patch for the inside to be shown when the object is recognized
MIN_RECOGNITION_PATCH_RATIO = 0.1


def unseen_patches(
    whole: ObjectShape, cloud: Cloud, shown: Bool[np.ndarray, " n"], share: float = MIN_SEEN_SHARE
) -> Bool[np.ndarray, " P"]:
    """Return the patches whose visible share of the surface is at most `share`."""
    patch = whole.mesh_patch[cloud.faces]
    total = np.bincount(patch, minlength=int(whole.mesh_patch.max()) + 1)
    return np.bincount(patch, shown, len(total)) <= share * total


def inner_faces(
    mesh: Mesh, whole: ObjectShape, cloud: Cloud, shown: Bool[np.ndarray, " n"], min_size: float = MIN_INNER_PATCH_RATIO
) -> Bool[np.ndarray, " F"]:
    """Return the faces of mostly hidden patches that are large enough to be shown and asked about.

    Return no faces if no hidden patch has a diagonal of at least `min_size`, a share of the object's.
    """
    hidden, size = unseen_patches(whole, cloud, shown, MAX_SEEN_SHARE), patch_sizes(mesh, whole) / whole.diagonal
    if not (hidden & (size >= min_size)).any():
        return np.zeros(len(whole.mesh_patch), bool)
    return (hidden & (size >= MIN_INNER_PATCH_RATIO))[whole.mesh_patch]


def add_hidden_parts(
    segmentation: Segmentation, other: Segmentation, unseen: Bool[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> tuple[Segmentation, tuple[str, ...]]:
    """Add parts of another segmentation that no view shows, such as a turntable behind a closed door.

    Return the parts and a warning for each added one.
    """
    face_part = segmentation.face_part.copy()
    parts, warnings = list(segmentation.parts[1:]), []
    for k, part in enumerate(other.parts[1:], start=1):
        mine = other.face_part == k
        if areas[mine & ~unseen].sum() <= MIN_SEEN_SHARE * areas[mine].sum() and not face_part[mine].any():
            parts.append(replace(part, reason=f"no view shows it; found by geometry: {part.reason}"))
            warnings.append(f"no view shows the {part.label} inside; geometry found it")
            face_part[mine] = len(parts)
    whole = named_parts(face_part, [p.label for p in parts], areas, [p.confidence for p in parts], [p.reason for p in parts])
    return whole, tuple(warnings)
