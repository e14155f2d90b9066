"""Textures by an external service: the asset is sent with an atlas, and its result is transferred back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Int

from anymesh.errors import InputError
from anymesh.finishing.bake import Baked, Place, atlas_materials, atlas_uv, check_layout
from anymesh.finishing.protocol import Finished
from anymesh.finishing.scene_glb import Y_UP, read_scene, scene_glb
from anymesh.finishing.texture import Painted, barycentric, inside
from anymesh.geometry.distance_ import distance_to_mesh, distance_to_triangles
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Asset, Mesh

SAME = 1e-3  # share of the diagonal: tolerance between corners of the same faces
AGREES = 0.01  # share of the diagonal: tolerance between surfaces
MAX_OFF_SHARE = 0.02  # share of either surface that may lie further away
SAMPLES = 4000
T_SCENE = np.block([[Y_UP, np.zeros((3, 1))], [np.zeros((1, 3)), np.ones((1, 1))]])


def aligned(mesh: Mesh, ours: Mesh) -> Mesh:
    """Move and scale the mesh so that its box has the centre and diagonal of ours, since services centre their input."""
    scale = ours.diagonal / max(mesh.diagonal, 1e-300)
    return replace(mesh, vertices=(mesh.vertices - mesh.bounds.mean(0)) * scale + ours.bounds.mean(0))


def same_faces(mesh: Mesh, ours: Mesh) -> bool:
    """Return whether both have the same corners in the same order."""
    if len(mesh.faces) != len(ours.faces):
        return False
    return bool(np.abs(mesh.triangles - ours.triangles).max() <= SAME * ours.diagonal)


def surface_gap(mesh: Mesh, ours: Mesh) -> float:
    """Compute the larger share of either surface that lies further than AGREES diagonals from the other."""
    shares = []
    for here, there in ((mesh, ours), (ours, mesh)):
        points = sample_surface(here.triangles, SAMPLES, 0).points
        shares.append(float((distance_to_triangles(points, there.triangles) > AGREES * ours.diagonal).mean()))
    return max(shares)


def nearest(mesh: Mesh, ours: Mesh, face_part: Int[np.ndarray, " F"]) -> Place:
    """Return a map from points on our surface to the nearest ones of another mesh, on the same part if it has that part.

    face_part: of our faces. A face of the other mesh belongs to the part of ours that is nearest to its centroid.
    """
    part_there = face_part[distance_to_mesh(mesh.triangles.mean(1), ours.vertices, ours.faces)[1]]

    def place(face: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        points = np.einsum("nk,nkd->nd", weights, ours.triangles[face])
        nearest_faces, there = np.zeros(len(face), np.int64), np.zeros((len(face), 3))
        for part in np.unique(face_part[face]):
            rows = np.flatnonzero(face_part[face] == part)
            of_part = np.flatnonzero(part_there == part)
            faces = of_part if len(of_part) else np.arange(len(mesh.faces))
            _, near, closest = distance_to_mesh(points[rows], mesh.vertices, mesh.faces[faces])
            nearest_faces[rows] = faces[near]
            there[rows] = inside(barycentric(closest, mesh.triangles[nearest_faces[rows]]))
        return nearest_faces, there

    return place


def has_picture(mesh: Mesh) -> bool:
    """Return whether every face has a base colour texture."""
    pictured = np.array([*("base_color" in m.textures for m in mesh.materials), False])
    return mesh.corner_uv is not None and bool(pictured[mesh.face_material].all())


@runtime_checkable
class TextureService(Protocol):
    """Protocol of a texture service, such as `models.meshy.Meshy`."""

    name: str

    def retexture(self, glb: bytes, prompt: str) -> bytes:
        """Return the GLB with new textures, on its texture coordinates."""
        ...


@dataclass(frozen=True)
class Remote:
    """Retexturer by a service.

    prompt: desired appearance, None to name the object and its parts; size: [px] of the atlas.
    The result is used if its surface is the one that was sent. If it has the same faces, its textures are used directly, else
    their colours are transferred part by part from the nearest point. Otherwise the baked built-in textures stay, with a note.
    Transparent faces always keep theirs, since the service does not support glass.
    """

    service: TextureService
    prompt: str | None = None
    size: int = 2048
    padding: int = 4

    @property
    def name(self) -> str:
        return self.service.name

    def retexture(self, finished: Finished) -> Painted:
        baked = Baked(self.size, self.padding).retexture(finished)
        asset, ours = baked.asset, baked.asset.mesh
        glb = self.service.retexture(scene_glb({asset.name: ours}, T_SCENE), self.prompt or described(asset))
        try:
            back = read_scene(glb, f"{self.name}.glb")
        except InputError as error:
            return self._refused(baked, str(error))
        back = aligned(back.transformed(T_SCENE.T), ours)
        if not has_picture(back):
            return self._refused(baked, "it has faces without a picture")
        if same_faces(back, ours):
            return Painted(replace(asset, mesh=_taken_over(back, ours)), (*baked.notes, f"{self.name}: its pictures are used"))
        gap = surface_gap(back, ours)
        if gap > MAX_OFF_SHARE:
            return self._refused(baked, f"{gap:.0%} of its surface is not that of the object")
        note = f"{self.name}: it has other faces, its colours are used from the nearest place of the same part"
        return Painted(replace(asset, mesh=self._transferred(back, asset)), (*baked.notes, note))

    def _refused(self, baked: Painted, why: str) -> Painted:
        return replace(baked, notes=(*baked.notes, f"{self.name}: not accepted, {why}; the built-in textures are kept"))

    def _transferred(self, back: Mesh, asset: Asset) -> Mesh:
        ours = asset.mesh
        layout = check_layout(ours, self.size, self.padding)
        material = atlas_materials(layout, back, "retextured", place=nearest(back, ours, asset.segmentation.face_part))[0]
        return replace(ours, materials=(material, *ours.materials[1:]), corner_uv=atlas_uv(layout))


def described(asset: Asset) -> str:
    """Return a prompt with the object's name and the labels of its parts."""
    labels = dict.fromkeys(part.label for part in asset.segmentation.parts[1:] if part.label)
    what = asset.name.replace("_", " ")
    subject = f"a {what} with {', '.join(labels)}" if labels else f"a {what}"
    return f"{subject}, realistic materials"[:600]


def _taken_over(back: Mesh, ours: Mesh) -> Mesh:
    """Return our mesh with the materials and texture coordinates of the result, except for transparent faces."""
    clear, count = ours.face_material > 0, len(back.materials)
    uv = np.zeros((len(clear), 3, 2), np.float32)
    for mesh, rows in ((ours, clear), (back, ~clear)):
        if mesh.corner_uv is not None:
            uv[rows] = mesh.corner_uv[rows]
    return replace(
        ours,
        materials=(*back.materials, *ours.materials[1:]),
        face_material=np.where(clear, count + ours.face_material - 1, back.face_material),
        corner_uv=uv,
    )
