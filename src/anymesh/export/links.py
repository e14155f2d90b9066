"""Links: the mesh cut by part, placed in link frames, with corners merged if all their attributes agree."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Float32, Int, UInt8

from anymesh.names import legal_name, legal_names
from anymesh.types import Asset, Brief, Joint, Mesh, Part
from anymesh.types.triangles import corners_of, unique_rows


@dataclass(frozen=True, eq=False)
class Primitive(Brief):
    """Triangles of one link with one material.

    material: into the mesh's materials, -1 = none; positions: (n, 3) in the link frame [m]; triangles: (m, 3) into them; uv: v
    up; normals: unit; colors: RGBA 0..255; more_uv: further sets, side by side.
    """

    material: int
    positions: Float[np.ndarray, "n 3"]
    triangles: Int[np.ndarray, "m 3"]
    uv: Float32[np.ndarray, "n 2"] | None
    normals: Float32[np.ndarray, "n 3"] | None
    colors: UInt8[np.ndarray, "n 4"] | None
    more_uv: Float32[np.ndarray, "n k"] | None = None


@dataclass(frozen=True, eq=False)
class Link(Brief):
    """A part as a rigid body, with its frame at `origin` [m, asset frame] and axes parallel to the asset's.

    joint: the one that carries it, None for the root; faces: (F',) of the source mesh.
    """

    part: Part
    joint: Joint | None
    origin: Float[np.ndarray, " 3"]
    faces: Int[np.ndarray, " m"]
    primitives: tuple[Primitive, ...]

    @property
    def name(self) -> str:
        return self.part.name

    @property
    def triangles(self) -> Float[np.ndarray, "m 3 3"]:
        """Return the corner positions of all faces in the link frame [m]."""
        return np.concatenate([corners_of(p.positions, p.triangles) for p in self.primitives])


def with_legal_names(asset: Asset) -> Asset:
    """Return the asset with names that are legal in every format and file system; it is returned unchanged if they are."""
    parts = asset.segmentation.parts
    renamed = dict(zip((p.name for p in parts), legal_names([p.name for p in parts]), strict=True))
    named = [*(j.name for j in asset.joints), *(loop.name for loop in asset.loops)]
    joints = legal_names(named, fallback="joint")
    name = legal_name(asset.name, fallback="asset")
    if name == asset.name and list(renamed) == list(renamed.values()) and joints == named:
        return asset
    new = dict(zip(named, joints, strict=True))
    return replace(
        asset,
        name=name,
        segmentation=replace(asset.segmentation, parts=tuple(replace(p, name=renamed[p.name]) for p in parts)),
        joints=tuple(
            replace(
                j,
                name=new[j.name],
                parent=renamed[j.parent],
                child=renamed[j.child],
                mimic=j.mimic and replace(j.mimic, joint=new[j.mimic.joint]),
            )
            for j in asset.joints
        ),
        loops=tuple(
            replace(loop, name=new[loop.name], first=renamed[loop.first], second=renamed[loop.second]) for loop in asset.loops
        ),
    )


def split_links(asset: Asset) -> tuple[Link, ...]:
    """Return one link per part, in the order of the parts (the root first)."""
    mesh, face_part = asset.mesh, asset.segmentation.face_part
    carried = {j.child: j for j in asset.joints}
    order = np.lexsort((mesh.face_material, face_part))
    part, material = face_part[order], mesh.face_material[order]
    cuts = np.flatnonzero((np.diff(part) != 0) | (np.diff(material) != 0)) + 1
    groups: dict[int, list[np.ndarray]] = {}
    for run in np.split(order, cuts):
        groups.setdefault(int(face_part[run[0]]), []).append(run)
    links = []
    for index, piece in enumerate(asset.segmentation.parts):
        joint = carried.get(piece.name)
        origin = np.zeros(3) if joint is None else np.asarray(joint.origin, float)
        primitives = tuple(_primitive(mesh, faces, origin) for faces in groups[index])
        links.append(Link(piece, joint, origin, np.flatnonzero(face_part == index), primitives))
    return tuple(links)


def _primitive(mesh: Mesh, faces: np.ndarray, origin: np.ndarray) -> Primitive:
    """Return the faces, all of one material, with equal corners merged."""
    corner = mesh.faces[faces].reshape(-1)
    positions = mesh.vertices.take(corner, axis=0) + 0.0  # -0.0 becomes 0.0, so that the two are equal

    def rows(attribute: np.ndarray | None, width: int) -> np.ndarray | None:
        return None if attribute is None else attribute[faces].reshape(-1, width)

    uv, normals, colors = rows(mesh.corner_uv, 2), rows(mesh.corner_normal, 3), rows(mesh.corner_color, 4)
    more_uv = None if mesh.corner_more_uv is None else rows(mesh.corner_more_uv, mesh.corner_more_uv.shape[2])
    if uv is not None:
        uv = np.nan_to_num(uv, posinf=0.0, neginf=0.0)
    if normals is not None:
        normals = _unit(normals, np.repeat(mesh.face_normals[faces], 3, axis=0))
    if colors is not None and (colors == 255).all():
        colors = None
    columns = [np.ascontiguousarray(positions).view(np.uint64)]
    columns += [np.ascontiguousarray(a).view(np.uint32) for a in (uv, normals, colors, more_uv) if a is not None]
    first, inverse = unique_rows([c[:, i].astype(np.uint64) for c in columns for i in range(c.shape[1])])
    return Primitive(
        material=int(mesh.face_material[faces[0]]),
        positions=positions[first] - origin,
        triangles=inverse.reshape(-1, 3),
        uv=None if uv is None else uv[first],
        normals=None if normals is None else normals[first],
        colors=None if colors is None else colors[first],
        more_uv=None if more_uv is None else more_uv[first],
    )


def _unit(normals: np.ndarray, fallback: np.ndarray) -> np.ndarray:
    """Return unit normals; a zero or non-finite one becomes that of the face (or up, if the face has no area)."""
    exact = normals.astype(np.float64)
    length = np.linalg.norm(exact, axis=1, keepdims=True)
    bad = ~(np.isfinite(length) & (length > 1e-6))[:, 0]
    exact[bad] = fallback[bad]
    length[bad] = 1
    exact[bad & ~exact.any(1)] = (0, 0, 1)
    return (exact / length).astype(np.float32) + np.float32(0)
