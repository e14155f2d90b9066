"""Textures of new faces, copied from the nearest visible old surface of their part; old faces are unchanged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from anymesh.finishing.protocol import Finished
from anymesh.finishing.scenes import visible_faces
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.topology import edge_pairs, label_connected
from anymesh.rendering.render import face_colors
from anymesh.types import Asset, Brief, Mesh

FINE = 4  # a face is sampled at the centroids of FINE squared similar triangles
MIN_SAME_CHART_COSINE = np.cos(np.deg2rad(20.0))  # new faces that meet at a smaller angle form one patch
ON = 0.002  # share of the diagonal: new faces this near to the old surface continue its texture
ALONG = 0.9  # minimum cosine between their normals


def _probes() -> Float[np.ndarray, "p 3"]:
    """Return the barycentric weights of these centroids."""
    n, ticks = 3 * FINE, range(FINE)
    upright = [(3 * i + 1, 3 * j + 1) for i in ticks for j in ticks if i + j < FINE]
    turned = [(3 * i + 2, 3 * j + 2) for i in ticks for j in ticks if i + j < FINE - 1]
    return np.array([(n - a - b, a, b) for a, b in upright + turned]) / n


PROBES = _probes()


@dataclass(frozen=True, eq=False)
class Spots(Brief):
    """Nearest points on a surface to points of some faces.

    owner: index into the list of these faces; face: of the surface; weights: barycentric weights of its corners; distance: [m];
    area: represented by a point [m2].
    """

    owner: Int[np.ndarray, " n"]
    face: Int[np.ndarray, " n"]
    weights: Float[np.ndarray, "n 3"]
    distance: Float[np.ndarray, " n"]
    area: Float[np.ndarray, " n"]

    def colors(self, mesh: Mesh) -> UInt8[np.ndarray, "n 3"]:
        """Return the sRGB colours of the mesh at the spots."""
        return colors_at(mesh, self.face, self.weights)


def spots_on(mesh: Mesh, faces: Int[np.ndarray, " n"], sources: Int[np.ndarray, " m"]) -> Spots:
    """Return the points on `sources` (face indices) nearest to points spread over `faces`."""
    points = np.einsum("pk,nkd->npd", PROBES, mesh.triangles[faces]).reshape(-1, 3)
    distance, near, closest = distance_to_mesh(points, mesh.vertices, mesh.faces[sources])
    face = sources[near]
    area = np.repeat(mesh.face_areas[faces], len(PROBES)) + 1e-30
    owner = np.repeat(np.arange(len(faces)), len(PROBES))
    return Spots(owner, face, inside(barycentric(closest, mesh.triangles[face])), distance, area)


def barycentric(points: Float[np.ndarray, "n 3"], triangles: Float[np.ndarray, "n 3 3"]) -> Float[np.ndarray, "n 3"]:
    """Compute the barycentric weights of points, projected onto their triangles' planes; 1/3 if a triangle has no area."""
    a, b, c = (triangles[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    flat = square <= 1e-300
    scale = np.where(flat, 1.0, square)
    second = np.einsum("ij,ij->i", np.cross(points - a, c - a), normal) / scale
    third = np.einsum("ij,ij->i", np.cross(b - a, points - a), normal) / scale
    weights = np.stack([1 - second - third, second, third], 1)
    weights[flat] = 1 / 3
    return weights


def inside(weights: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Clip barycentric weights to the triangle, to correct rounding."""
    kept = np.clip(weights, 0, 1)
    return kept / kept.sum(1, keepdims=True)


def colors_at(mesh: Mesh, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> UInt8[np.ndarray, "n 3"]:
    """Return sRGB colours at points on a mesh, as in all rendered pictures."""
    return face_colors(points_mesh(mesh, face, weights))


def points_mesh(mesh: Mesh, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> Mesh:
    """Return a mesh with one face per point, whose attributes are constant over the face."""

    def at(rows: np.ndarray | None) -> np.ndarray | None:
        if rows is None:
            return None
        value = np.einsum("nk,nkd->nd", weights, rows[face].astype(np.float64))
        value = np.rint(value) if rows.dtype == np.uint8 else value
        return np.repeat(value.astype(rows.dtype)[:, None], 3, axis=1)

    return replace(
        mesh,
        vertices=np.zeros((1, 3)),
        faces=np.zeros((len(face), 3), np.int64),
        face_node=mesh.face_node[face],
        face_material=mesh.face_material[face],
        corner_uv=at(mesh.corner_uv),
        corner_color=at(mesh.corner_color),
        corner_normal=None,
        corner_more_uv=at(mesh.corner_more_uv),
    )


@dataclass(frozen=True, eq=False)
class Painted:
    """An asset with new textures; shape, parts and joints are unchanged. notes: what was done and what was not, in words."""

    asset: Asset
    notes: tuple[str, ...] = ()


@runtime_checkable
class Retexturer(Protocol):
    """Protocol of a creator of textures for finished assets."""

    @property
    def name(self) -> str:
        """Name in notes and reports."""
        ...

    def retexture(self, finished: Finished) -> Painted:
        """Return the asset with textures. Raise AnymeshError if a service cannot be used.

        An unusable result leads to a note, and the built-in textures are used.
        """
        ...


@dataclass(frozen=True)
class Carried:
    """Built-in retexturer: old faces keep their textures, new ones take those of their part's nearest visible surface."""

    name: str = "builtin"

    def retexture(self, finished: Finished) -> Painted:
        new = finished.source_face < 0
        if not new.any() or new.all():
            return Painted(finished.asset)
        mesh, patches = paint_new(finished.asset.mesh, finished.asset.segmentation.face_part, new)
        note = f"{int(new.sum())} new faces in {patches} patches look like the nearest visible surface of their part"
        return Painted(replace(finished.asset, mesh=mesh), (note,))


def paint_new(mesh: Mesh, face_part: Int[np.ndarray, " F"], new: Bool[np.ndarray, " F"]) -> tuple[Mesh, int]:
    """Assign materials to the new faces; also return the number of patches.

    Connected, nearly coplanar new faces form a patch with one appearance: the nearest material of most of the patch, at the
    point with the median colour, so that a spot or seam is not spread over a wall.
    New faces on the old surface, such as those of a remeshed part, continue its texture. A part with only new faces takes the
    appearance of the nearest other part.
    """
    visible = np.zeros(len(mesh.faces), bool)
    old = np.flatnonzero(~new)
    visible[old] = visible_faces(mesh.subset(old))
    like, weights = np.zeros(len(new), np.int64), np.zeros((len(new), 3, 3))
    count = 0
    for part in np.unique(face_part[new]):
        faces = np.flatnonzero(new & (face_part == part))
        mine = old[face_part[old] == part]
        sources = next(s for s in (mine[visible[mine]], mine, old[visible[old]], old) if len(s))
        spots = spots_on(mesh, faces, sources)
        patch = _patches(mesh, faces)
        count += int(patch.max()) + 1
        chosen = _chosen(mesh, patch, spots)
        like[faces], weights[faces] = spots.face[chosen], spots.weights[chosen][:, None]
        on = _lies_on(mesh, faces, spots)
        like[faces[on]], weights[faces[on]] = _continued(mesh, faces[on], sources)
    return _with_materials(mesh, new, like[new], weights[new]), count


def _patches(mesh: Mesh, faces: Int[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    pairs = edge_pairs(mesh.vertices, mesh.faces[faces]).faces
    normals = mesh.face_normals[faces]
    level = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]]) > MIN_SAME_CHART_COSINE
    return label_connected(len(faces), pairs[level])


def _chosen(mesh: Mesh, patch: np.ndarray, spots: Spots) -> Int[np.ndarray, " n"]:
    """Return the spot used by each face's patch: of its most common material, nearest to the median colour."""
    group, spot_of_patch = patch[spots.owner], np.zeros(int(patch.max()) + 1, np.int64)
    material, color = mesh.face_material[spots.face], spots.colors(mesh).astype(float)
    order = np.argsort(group, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(group[order])) + 1):
        kinds, kind = np.unique(material[rows], return_inverse=True)
        rows = rows[kind == np.bincount(kind, spots.area[rows], len(kinds)).argmax()]
        middle = _middle(color[rows], spots.area[rows])
        spot_of_patch[group[rows[0]]] = rows[np.abs(color[rows] - middle).sum(1).argmin()]
    return spot_of_patch[patch]


def _middle(colors: Float[np.ndarray, "n 3"], weights: Float[np.ndarray, " n"]) -> Float[np.ndarray, " 3"]:
    """Compute the weighted median of each channel."""
    order = np.argsort(colors, axis=0, kind="stable")
    half = np.cumsum(weights[order], axis=0) >= weights.sum() / 2
    return np.take_along_axis(colors, order, 0)[half.argmax(0), np.arange(3)]


def _lies_on(mesh: Mesh, faces: np.ndarray, spots: Spots) -> Bool[np.ndarray, " n"]:
    """Return which faces lie on the old surface with all their spots, with similar normals."""
    along = np.einsum("ij,ij->i", mesh.face_normals[faces][spots.owner], mesh.face_normals[spots.face])
    off = (spots.distance > ON * mesh.diagonal) | (along < ALONG)
    return np.bincount(spots.owner, off, len(faces)) == 0


def _continued(mesh: Mesh, faces: np.ndarray, sources: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the old face nearest to the centroid of each new one, and the new corners in its barycentric coordinates."""
    triangles = mesh.triangles[faces]
    like = sources[distance_to_mesh(triangles.mean(1), mesh.vertices, mesh.faces[sources])[1]] if len(faces) else faces
    corners = np.repeat(mesh.triangles[like], 3, axis=0)
    return like, barycentric(triangles.reshape(-1, 3), corners).reshape(-1, 3, 3)


def _with_materials(mesh: Mesh, new: np.ndarray, like: np.ndarray, weights: Float[np.ndarray, "n 3 3"]) -> Mesh:
    """Give new face k the attributes of face like[k] at barycentric coordinates of that face."""

    def placed(rows: np.ndarray | None) -> np.ndarray | None:
        if rows is None:
            return None
        grown, inside = rows.copy(), np.einsum("nck,nkd->ncd", weights, rows[like].astype(np.float64))
        grown[new] = np.clip(np.rint(inside), 0, 255) if rows.dtype == np.uint8 else inside
        return grown

    material = mesh.face_material.copy()
    material[new] = mesh.face_material[like]
    return replace(
        mesh,
        face_material=material,
        corner_uv=placed(mesh.corner_uv),
        corner_color=placed(mesh.corner_color),
        corner_more_uv=placed(mesh.corner_more_uv),
    )
