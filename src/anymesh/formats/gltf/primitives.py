"""Meshes of a glTF 2.0 file: primitives as triangles, at the weights of their morph targets and the rest pose of their skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from anymesh.entry_points import DRACO, resolve
from anymesh.errors import InputError
from anymesh.formats.gltf.buffers import Buffers, DataError, item
from anymesh.formats.gltf.materials import GltfMaterial
from anymesh.loading.files import Folder
from anymesh.loading.join import join, rgba, simple_mesh, unit
from anymesh.types import Brief, Mesh
from anymesh.types.mesh import to_srgb

TRIANGLES = 4  # primitive mode
NO_TRIANGLES = {0: "points", 1: "lines", 2: "lines", 3: "lines"}
RIGID = 0.99  # weight of one bone from which a vertex moves with it alone
DRACO_EXTENSION = "KHR_draco_mesh_compression"


@dataclass(frozen=True, eq=False)
class Pose(Brief):
    """A skin at its rest pose. matrices: joint in the scene times inverse bind matrix; nodes: index of each joint's node."""

    matrices: Float[np.ndarray, "n 4 4"]
    nodes: Sequence[int]


@dataclass(frozen=True, eq=False)
class GltfMeshes:
    """The meshes of a file. left_out: what was left out of them, as the start of a sentence, and how often."""

    tree: dict[str, Any]
    buffers: Buffers
    folder: Folder
    looks: Sequence[GltfMaterial]
    labels: Sequence[str]
    left_out: dict[str, int] = field(default_factory=dict)

    def read(self, number: int, weights: Sequence[float], pose: Pose | None) -> tuple[Mesh, Int[np.ndarray, " F"]] | None:
        """Return the triangles of a mesh as one node, and the joint that moves each face rigidly, -1 for none.

        None if it has no triangles.
        """
        made = []
        for k, p in enumerate(item(self.tree["meshes"], number)["primitives"]):
            what = f"primitive {k} of the mesh {self.labels[number]!r}"
            if "targets" in p:
                self.folder.warn(
                    "shapes that blend (morph targets) are read at the weights that the file states, and do not move"
                )
            if p.get("mode", TRIANGLES) in NO_TRIANGLES:
                self._leave_out(f"{NO_TRIANGLES[p['mode']]} (no triangles)")
                continue
            try:
                primitive = self._primitive(what, p, weights, pose)
            except (DataError, LookupError, TypeError, ValueError, AttributeError, OverflowError) as error:
                reason = str(error) if isinstance(error, InputError) else f"{type(error).__name__}: {error}"
                self._leave_out(f"{what}: {' '.join(reason.split())[:200]}")
                continue
            if primitive is None:
                self._leave_out("a primitive without triangles")
            else:
                made.append(primitive)
        if not made:
            return None
        joined = join([mesh for mesh, _ in made])
        mesh = replace(joined, face_node=np.zeros(len(joined.faces), np.int64), nodes=joined.nodes[:1])
        return mesh, _moved_rigidly(mesh, np.concatenate([bone for _, bone in made]))

    def _leave_out(self, what: str, count: int = 1) -> None:
        self.left_out[what] = self.left_out.get(what, 0) + count

    def _primitive(
        self, what: str, p: dict[str, Any], weights: Sequence[float], pose: Pose | None
    ) -> tuple[Mesh, np.ndarray] | None:
        """Return the triangles of a primitive and the joint of each; None if there are none. Raise DataError for its faults."""
        compressed, index = self._decompressed(p)

        vertices = self._attribute(p, compressed, "POSITION")
        if vertices is None:
            raise DataError("it has no positions, which triangles need")
        mode = p.get("mode", TRIANGLES) if index is None else TRIANGLES  # Draco holds triangles also for strips
        if index is None:
            index = self.buffers.array(p["indices"])[:, 0] if "indices" in p else np.arange(len(vertices))
        faces = _faces(mode, index.astype(np.int64))
        if not len(faces):
            return None
        look = self.looks[p["material"]] if 0 <= p.get("material", -1) < len(self.looks) else GltfMaterial(None)

        def corners(key: str) -> np.ndarray | None:
            try:
                values = self._attribute(p, compressed, key)
                if values is not None and len(values) != len(vertices):
                    raise DataError(f"it has {len(values)} elements; valid are {len(vertices)}, as many as positions")
            except (DataError, LookupError, TypeError, ValueError) as error:
                self._leave_out(f"{key} of {what}: {error}")
                return None
            return values

        normal = corners("NORMAL")
        vertices, normal = self._morphed(p, vertices.astype(np.float64), normal, weights)
        bone = np.full(len(vertices), -1)
        if pose is not None:
            bound = [(corners(f"JOINTS_{k}"), corners(f"WEIGHTS_{k}")) for k in (0, 1)]
            vertices, normal, bone, mirrored = _posed(vertices, normal, bound, pose)
            faces = np.where(mirrored[faces[:, :1].clip(0, len(vertices) - 1)], faces[:, ::-1], faces)
        faces = self._usable(vertices, faces)
        uv, more_uv = look.coordinates(corners)
        sets = {key for key in p["attributes"] if key.startswith("TEXCOORD_")}
        if sets and look.material and look.material.textures and not sets >= {f"TEXCOORD_{k}" for k, _ in look.sets}:
            self._leave_out(f"texture coordinates of {what}: it has {', '.join(sorted(sets))}, its pictures name others")
        color = corners("COLOR_0")
        normal = None if normal is None else unit(normal)
        mesh = simple_mesh(what, "mesh", vertices, faces, look.material)
        mesh = replace(
            mesh,
            corner_uv=None if uv is None else uv[faces],
            corner_more_uv=None if more_uv is None else more_uv[faces],
            corner_color=None if color is None else rgba(_display(color))[faces],
            corner_normal=None if normal is None else normal[faces],
        )
        bone = bone[faces]
        return mesh, np.where((bone == bone[:, :1]).all(1), bone[:, 0], -1)

    def _attribute(self, p: dict[str, Any], compressed: dict[str, np.ndarray], key: str) -> np.ndarray | None:
        if key not in p["attributes"]:
            return None
        return compressed[key] if key in compressed else self.buffers.array(p["attributes"][key])

    def _decompressed(self, p: dict[str, Any]) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
        """Return the attributes and the indices of a Draco-compressed primitive; nothing and None for others."""
        draco = p.get("extensions", {}).get(DRACO_EXTENSION)
        if draco is None:
            return {}, None
        ids = {key: number for key, number in draco["attributes"].items() if key in p["attributes"]}
        raw, index = resolve(DRACO)(self.buffers.view(draco["bufferView"]), ids)
        accessors = self.tree["accessors"]
        return {k: self.buffers.normalized(item(accessors, p["attributes"][k]), values) for k, values in raw.items()}, index

    def _morphed(
        self, p: dict[str, Any], vertices: np.ndarray, normal: np.ndarray | None, weights: Sequence[float]
    ) -> tuple[np.ndarray, np.ndarray | None]:
        for weight, target in zip(weights, p.get("targets", []), strict=False):
            if weight and "POSITION" in target:
                vertices = vertices + weight * self.buffers.array(target["POSITION"])
            if weight and "NORMAL" in target and normal is not None:
                normal = normal + weight * self.buffers.array(target["NORMAL"])
        return vertices, normal

    def _usable(self, vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
        """Return the faces whose corners are finite and there. Raise DataError if there are none."""
        if faces.min() >= 0 and faces.max() < len(vertices) and np.isfinite(vertices).all():
            return faces
        inside = np.all((faces >= 0) & (faces < len(vertices)), axis=1)
        usable = np.array(inside)
        usable[inside] = np.isfinite(vertices[faces[inside]]).all((1, 2))
        if not usable.any():
            if not inside.all():
                outside = faces[~inside]
                number = int(outside[(outside < 0) | (outside >= len(vertices))][0])
                raise DataError(f"a face refers to vertex {number}; valid are 0 to {len(vertices) - 1}")
            raise DataError("found a vertex that is not finite (NaN or infinite); valid are finite coordinates")
        if not usable.all():
            self._leave_out("triangles whose positions are missing or not finite", int((~usable).sum()))
        return faces[usable]


def _faces(mode: int, index: np.ndarray) -> np.ndarray:
    match mode:
        case 4:
            return index[: len(index) // 3 * 3].reshape(-1, 3)
        case 5:
            faces = np.stack([index[:-2], index[1:-1], index[2:]], 1)
            faces[1::2] = faces[1::2][:, [0, 2, 1]]
            return faces[(faces != np.roll(faces, 1, axis=1)).all(1)]  # repeated indices only lead to the next strip
        case 6:
            return np.stack([index[1:-1], index[2:], np.full(max(len(index) - 2, 0), index[0])], 1)
        case _:
            raise DataError(f"found the mode {mode}; valid are 4, 5 and 6 (triangles)")


def _display(color: np.ndarray) -> np.ndarray:
    """Convert COLOR_0 from linear to display values 0..1; alpha is unchanged."""
    full = 1.0 if color.dtype.kind == "f" else float(np.iinfo(color.dtype).max)
    values = np.nan_to_num(color.astype(np.float64) / full, nan=1.0)
    return np.c_[to_srgb(values[:, :3]), values[:, 3:]]


def _posed(
    vertices: np.ndarray, normal: np.ndarray | None, bound: list[tuple[np.ndarray | None, np.ndarray | None]], pose: Pose
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray, np.ndarray]:
    """Return vertices and normals at the rest pose, the one joint of each vertex or -1, and whether its pose mirrors.

    Weights are normalized; a vertex without any follows its first joint.
    """
    pairs = [(j, w) for j, w in bound if j is not None and w is not None]
    if not pairs:
        raise DataError("the joints or weights of its skin cannot be read")
    joints = np.hstack([j for j, _ in pairs]).astype(np.int64)
    weights = np.nan_to_num(np.hstack([w for _, w in pairs]).astype(np.float64), posinf=0, neginf=0).clip(0)
    weights[~weights.any(1), 0] = 1
    weights /= weights.sum(1, keepdims=True)
    if joints[weights > 0].max() >= len(pose.matrices):
        raise DataError(f"it refers to joint {joints[weights > 0].max()} of its skin; valid are 0 to {len(pose.matrices) - 1}")
    joints[weights == 0] = 0
    M = np.zeros((len(vertices), 4, 4))
    for j, w in zip(joints.T, weights.T, strict=True):
        M += w[:, None, None] * pose.matrices[j]
    moved = np.einsum("nij,nj->ni", M[:, :3, :3], vertices) + M[:, :3, 3]
    x, y, z = M[:, :3, :3].transpose(1, 0, 2)
    cofactors = np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)], 1)
    mirrored = np.einsum("ni,ni->n", x, cofactors[:, 0]) < 0
    if normal is not None:
        normal = np.einsum("nij,nj->ni", cofactors, normal) * np.where(mirrored, -1.0, 1.0)[:, None]
    strongest = weights.argmax(1)[:, None]
    total = (weights * (joints == np.take_along_axis(joints, strongest, 1))).sum(1)  # one joint may be in several places
    return moved, normal, np.where(total >= RIGID, np.take_along_axis(joints, strongest, 1)[:, 0], -1), mirrored


def _moved_rigidly(mesh: Mesh, bone: Int[np.ndarray, " F"]) -> Int[np.ndarray, " F"]:
    """Return the joint of each face, -1 for the faces of connected surfaces that bend anywhere."""
    if (bone == bone[0]).all() or (bone >= 0).all():
        return bone
    place = np.unique(mesh.vertices, axis=0, return_inverse=True)[1].reshape(-1)[mesh.faces]
    a, b = np.r_[place[:, 0], place[:, 1]], np.r_[place[:, 1], place[:, 2]]
    size = int(place.max()) + 1
    component = connected_components(coo_array((np.ones(len(a), bool), (a, b)), (size, size)), directed=False)[1][place[:, 0]]
    bends = np.zeros(component.max() + 1, bool)
    bends[component[bone < 0]] = True
    return np.where(bends[component], -1, bone)
