"""Assets as scans and generators give them: the outside alone, cut into parts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from assets import QUAD_UV, box, joint, source

from anymesh.geometry.topology import components
from anymesh.types import Asset, Material, Mesh, Node, Part, Segmentation

SIDES = ("-x", "+x", "-y", "+y", "-z", "+z")  # in the order of the faces of `assets.box`
SIZE = np.array([0.6, 0.4, 0.8])  # of the case [m]
FRONT = 0.02  # thickness of what shuts it [m]


def shell(low, high, without: str) -> np.ndarray:
    """Triangles of a box that lacks one side."""
    vertices, faces = box(low, high)
    side = SIDES.index(without)
    return vertices[np.delete(faces, [2 * side, 2 * side + 1], axis=0)]


def plate(low, high) -> np.ndarray:
    """Two triangles that face -y, where the box between two corners ends."""
    vertices, faces = box(low, high)
    return vertices[faces[4:6]]


def asset_of(pieces: dict[str, np.ndarray], joints=(), **changes) -> Asset:
    """Parts of triangles; equal corners share a vertex within a part. Each part has a material of its own."""
    vertices, faces, number = [], [], []
    for k, triangles in enumerate(pieces.values()):
        points, inverse = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
        faces.append(inverse.reshape(-1, 3) + sum(len(v) for v in vertices))
        vertices.append(points)
        number.append(np.full(len(triangles), k))
    part = np.concatenate(number)
    mesh = Mesh(
        np.concatenate(vertices),
        np.concatenate(faces),
        part,
        tuple(Node(name) for name in pieces),
        part,
        tuple(Material(name) for name in pieces),
        corner_uv=np.tile(QUAD_UV, (len(part) // 2, 1, 1)),
    )
    mesh = replace(mesh, corner_normal=np.repeat(mesh.face_normals[:, None], 3, axis=1).astype(np.float32))
    segmentation = Segmentation(part, tuple(Part(name, name) for name in pieces))
    return Asset("thing", source(), mesh, segmentation, tuple(joints), "given", **changes)


def case_with_door() -> Asset:
    """A case of which a door covers the open front: five sides and five sides, no interior."""
    x, _, z = SIZE
    hinge = joint("hinge", "revolute", "case", "door", (x, 0, z / 2), (0, 0, 1), (0.0, 1.9))
    return asset_of({"case": shell((0, 0, 0), SIZE, "-y"), "door": shell((0, -FRONT, 0), (x, 0, z), "+y")}, [hinge])


def case_with_drawer(travel: float = 0.3) -> Asset:
    """The same with a front that slides."""
    x, _, z = SIZE
    slide = joint("slide", "prismatic", "case", "drawer", (x / 2, 0, z / 2), (0, -1, 0), (0.0, travel))
    return asset_of({"case": shell((0, 0, 0), SIZE, "-y"), "drawer": shell((0, -FRONT, 0), (x, 0, z), "+y")}, [slide])


def case_with_controls(door: float) -> Asset:
    """A case whose face is shut by a door from x = 0 to a share of its width, and is its own beyond."""
    x, _, z = SIZE
    hinge = joint("hinge", "revolute", "case", "door", (0, 0, z / 2), (0, 0, -1), (0.0, 1.9))
    body = np.concatenate([shell((0, 0, 0), SIZE, "-y"), plate((door * x, 0, 0), SIZE)])
    return asset_of({"case": body, "door": shell((0, -FRONT, 0), (door * x, 0, z), "+y")}, [hinge])


def volume(asset: Asset, name: str) -> float:
    """Of a part [m^3]; components that overlap count twice."""
    t = part_triangles(asset, name)
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def part_triangles(asset: Asset, name: str) -> np.ndarray:
    names = [p.name for p in asset.segmentation.parts]
    return asset.mesh.triangles[asset.segmentation.faces(names.index(name))]


def is_closed(triangles: np.ndarray) -> bool:
    corners = triangles.reshape(-1, 3)
    found = components(corners, np.arange(len(corners)).reshape(-1, 3))
    return bool((found.solid & found.agree).all())
