"""Acceptance of externally completed parts that agree with the visible surface of the asset."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from anymesh.finishing.added import with_new_faces
from anymesh.finishing.protocol import Finished, PartMesh
from anymesh.finishing.visible import seen_from_outside, visible_faces
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Asset

AGREES = 0.01  # share of the object's diagonal: maximum distance of a part's visible surface from its completed surface
MAX_OFF_SHARE = 0.05  # share of the points that may lie further away
SAMPLES = 2000  # sample points per part


def accept(asset: Asset, made: Mapping[str, PartMesh], *, who: str, tolerance: float = AGREES) -> Finished:
    """Add the new faces of each part whose completed surface agrees with the asset.

    A surface agrees if the visible surface of the part lies on it, and if none of it is visible where the object has no
    surface, both within `tolerance` diagonals.
    The part keeps its faces, and gets those of the completed surface that lie further away from them.
    `notes` states for each part of `made` whether it was accepted, or why not. The built-in completer handles rejected parts
    and those not in `made`.
    Raise ValueError for a part that the asset does not have.
    """
    names = [part.name for part in asset.segmentation.parts]
    unknown = sorted(set(made) - set(names))
    if unknown:
        raise ValueError(f"completed parts {unknown}, valid are {names}")
    limit = tolerance * asset.mesh.diagonal
    visible = visible_faces(asset.mesh)
    added, looks, notes = {}, {}, {}
    for number, name in enumerate(names):
        if name not in made:
            continue
        faces = asset.segmentation.faces(number)
        seen = faces[visible[faces]]
        seen = seen if len(seen) else faces
        why = disagreement(asset, seen, made[name].triangles, limit)
        if why:
            notes[name] = (f"{who}: not accepted, {why}",)
            continue
        new = _beyond(made[name].triangles, asset.mesh.triangles[faces], limit)
        added[number], looks[number] = new, seen
        notes[name] = (f"{who}: accepted, {len(new)} new faces",)
    finished = with_new_faces(asset, added, looks)
    return Finished(finished.asset, finished.source_face, notes)


def accepted(finished: Finished, who: str) -> tuple[str, ...]:
    """Return the names of the parts that `accept` took from `who`."""
    return tuple(name for name, notes in finished.notes.items() if any(n.startswith(f"{who}: accepted") for n in notes))


def disagreement(asset: Asset, seen: np.ndarray, triangles: Float[np.ndarray, "n 3 3"], limit: float) -> str:
    """Describe why a completed surface is not that of the part with visible faces `seen`; empty if it is. limit: [m]"""
    if len(triangles) == 0:
        return "it is empty"
    there = sample_surface(asset.mesh.triangles[seen], SAMPLES, 0, at_least=1)
    off = float((distance_to_triangles(there.points, triangles) > limit).mean())
    if off > MAX_OFF_SHARE:
        return f"{off:.0%} of what is seen of the part lies further than {limit:.2g} m from it"
    here = sample_surface(triangles, SAMPLES, 0)
    far = here.take(distance_to_triangles(here.points, asset.mesh.triangles) > limit)
    scene = RayScene(asset.mesh.vertices, asset.mesh.faces)
    out = int(seen_from_outside(scene, far.points, far.normals, asset.mesh.diagonal).sum())
    if out > MAX_OFF_SHARE * len(here):
        return f"{out / len(here):.0%} of it shows where the object has no surface within {limit:.2g} m"
    return ""


def _beyond(triangles: np.ndarray, surface: np.ndarray, limit: float) -> np.ndarray:
    """Return the triangles with at least one corner or the centroid off a surface."""
    points = np.concatenate([triangles, triangles.mean(1, keepdims=True)], axis=1)
    off = distance_to_triangles(points.reshape(-1, 3), surface).reshape(-1, 4)
    return triangles[(off > limit).any(1)]
