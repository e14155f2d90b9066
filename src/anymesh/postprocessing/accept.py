"""What someone else completed joins the asset where it agrees with what is seen of the part."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.sampling import sample_surface
from anymesh.postprocessing.added import with_new_faces
from anymesh.postprocessing.protocol import Finished, PartMesh
from anymesh.postprocessing.visible import seen_from_outside, visible_faces
from anymesh.rendering.raycast_ import RayScene
from anymesh.types import Asset

AGREES = 0.01  # of the object's diagonal: what is seen of a part must lie this near to its completed surface
MAX_OFF_SHARE = 0.05  # share of the points that may lie further off
SAMPLES = 2000  # points a part


def accept(asset: Asset, made: Mapping[str, PartMesh], *, who: str, tolerance: float = AGREES) -> Finished:
    """The asset with the new faces of each part whose completed surface agrees with it.

    It agrees when what is seen of the part lies on it, and when it shows nowhere that the object does not: both within
    `tolerance` diagonals. The part keeps its faces, and gets those of the completed surface that lie further from them.
    `notes` says of each part of `made` whether it was accepted, or why not: the built-in completer is for those, and for the
    parts that are not in `made`. ValueError for a part that the asset does not have.
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
    found = with_new_faces(asset, added, looks)
    return Finished(found.asset, found.source_face, notes)


def accepted(finished: Finished, who: str) -> tuple[str, ...]:
    """Names of the parts that `accept` took from `who`."""
    return tuple(name for name, notes in finished.notes.items() if any(n.startswith(f"{who}: accepted") for n in notes))


def disagreement(asset: Asset, seen: np.ndarray, triangles: Float[np.ndarray, "n 3 3"], limit: float) -> str:
    """Why a completed surface is not that of the part whose faces `seen` are; empty when it is. limit: [m]"""
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
    """Those triangles that do not lie on a surface with all of their corners and their middle."""
    points = np.concatenate([triangles, triangles.mean(1, keepdims=True)], axis=1)
    off = distance_to_triangles(points.reshape(-1, 3), surface).reshape(-1, 4)
    return triangles[(off > limit).any(1)]
