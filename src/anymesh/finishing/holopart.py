"""Completion of parts by HoloPart: the parts are scaled, thickened and sent, and matched in the result (paper, 3.4)."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError, ModelError
from anymesh.finishing.holopart_service import CrashError, PartService
from anymesh.finishing.protocol import PartMesh
from anymesh.finishing.scene_glb import Y_UP, read_scene, scene_glb
from anymesh.finishing.thicken import Thickened, thicken
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Asset, Mesh, Node

log = logging.getLogger("anymesh")
BOX = 0.95  # half the longest side of the whole object as it is sent; the model was trained in -1..1
MIN_THICKNESS_RATIO = (
    0.04  # minimum thickness of a part as it is sent, over its longest side; the decoder's first grid has cells of .025
)
SAMPLES = 400  # sample points per part for matching


@dataclass(frozen=True)
class HoloPart:
    """Completer by HoloPart. Closed parts are sent as context for the others, but stay unchanged.

    After a crash it is called once more with twice the thickness, since thin parts are a known cause of crashes.
    """

    service: PartService
    name: str = "holopart"

    def complete(self, asset: Asset) -> Mapping[str, PartMesh]:
        """Return the surface of each open part. Raise ModelError if the result cannot be matched to the parts."""
        try:
            return self._complete(asset, MIN_THICKNESS_RATIO)
        except CrashError as error:
            log.warning("%s; once more with parts twice as thick", error)
        return self._complete(asset, 2 * MIN_THICKNESS_RATIO)

    def _complete(self, asset: Asset, least: float) -> Mapping[str, PartMesh]:
        parts = {
            part.name: thicken(asset.mesh.triangles[asset.segmentation.faces(number)], least)
            for number, part in enumerate(asset.segmentation.parts)
        }
        for name, part in parts.items():
            if part.added:
                log.info("%s: %s is sent %.3g m thicker than it is", self.name, name, part.added)
        if all(part.closed for part in parts.values()):
            return {}
        T = box_transform(asset.mesh)
        glb = self.service.complete(scene_glb({name: _mesh(name, part) for name, part in parts.items()}, T))
        pieces = {name: _moved(mesh, np.linalg.inv(T)) for name, mesh in read_pieces(glb).items()}
        matched = match_pieces(pieces, {name: part.mesh for name, part in parts.items()})
        return {name: matched[name] for name, part in parts.items() if not part.closed and name in matched}


def box_transform(mesh: Mesh) -> Float[np.ndarray, "4 4"]:
    """Return T_box_asset: centred, Y up, with a longest side of 2 * BOX."""
    T = np.eye(4)
    T[:3, :3] = Y_UP * (2 * BOX / mesh.extents.max())
    T[:3, 3] = -T[:3, :3] @ mesh.bounds.mean(0)
    return T


def read_pieces(glb: bytes) -> dict[str, Mesh]:
    """Return the nodes of a GLB by the names of their geometries. Raise ModelError if it cannot be read."""
    try:
        mesh = read_scene(glb, "output.glb")
    except InputError as error:
        raise ModelError(f"HoloPart's result cannot be used: {error}") from None
    names = [node.geometry for node in mesh.nodes]
    names = names if len(set(names)) == len(names) else [node.name for node in mesh.nodes]
    return {name: mesh.subset(mesh.face_node == number) for number, name in enumerate(names)}


def match_pieces(pieces: Mapping[str, PartMesh], parts: Mapping[str, PartMesh]) -> dict[str, PartMesh]:
    """Match pieces to parts: by name if all names are known, else by distance to the parts that were sent.

    Raise ModelError if names are unknown and the counts differ.
    """
    if set(pieces) <= set(parts):
        return {name: piece for name, piece in pieces.items() if len(piece.faces)}
    if len(pieces) != len(parts):
        raise ModelError(
            f"HoloPart returned {len(pieces)} parts for {len(parts)}, under names that were not sent: {sorted(pieces)[:5]}"
        )
    off = np.empty((len(parts), len(pieces)))
    for row, part in enumerate(parts.values()):
        points = sample_surface(part.triangles, SAMPLES, 0).points
        off[row] = [np.median(distance_to_triangles(points, piece.triangles)) for piece in pieces.values()]
    from scipy.optimize import linear_sum_assignment  # 0.1 s to import, and only this completer needs it

    rows, columns = linear_sum_assignment(off)
    names, meshes = list(parts), list(pieces.values())
    return {names[row]: meshes[column] for row, column in zip(rows, columns, strict=True)}


def _mesh(name: str, part: Thickened) -> Mesh:
    faces = part.mesh.faces
    return Mesh(part.mesh.vertices, faces, np.zeros(len(faces), int), (Node(name, name),), np.full(len(faces), -1))


def _moved(mesh: Mesh, T: Float[np.ndarray, "4 4"]) -> PartMesh:
    """Transform the mesh to the asset frame, wound outwards."""
    moved = mesh.transformed(T)
    t = moved.triangles - moved.triangles.mean((0, 1))
    inward = np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() < 0
    return PartMesh(moved.vertices, moved.faces[:, ::-1] if inward else moved.faces)
