"""Extraction of one object from a fused surface: cut off the floor, drop small components, close small holes, report others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.applications.scan.smoothing import neighbours
from anymesh.geometry.topology import label_connected
from anymesh.types.triangles import face_cross

CUT = 2.5  # [voxels] above the floor where the surface is cut, since the fused crease between floor and object is rounded
BIT = 0.01  # share of the largest component's area; smaller components are dropped
ON_FLOOR = 0.8  # share of a hole's vertices at z = 0 from which it counts as the object's footprint
CLOSED = 40.0  # [voxels] perimeter; shorter holes are closed whatever their shape
FLAT, FLAT_VOXELS = 0.01, 1.5  # larger holes are closed if nearer to a plane: share of the perimeter, [voxels]


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangle mesh. vertices: (V, 3) [m]; faces: (F, 3), oriented outward."""

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]

    def keeping(self, faces: Bool[np.ndarray, " F"] | Int[np.ndarray, " n"]) -> Surface:
        """Return the surface of some of the faces, without unused vertices."""
        chosen = self.faces[faces]
        used, inverse = np.unique(chosen, return_inverse=True)
        return Surface(self.vertices[used], inverse.reshape(-1, 3))

    @property
    def areas(self) -> Float[np.ndarray, " F"]:
        """Areas of the faces [m2]."""
        return 0.5 * np.linalg.norm(face_cross(self.vertices[self.faces]), axis=1)


@dataclass(frozen=True)
class Hole:
    """Loop of border edges.

    middle: [m]; area: of a fan across it [m2]; length: of the loop [m]; on_floor: whether it lies on the floor, where nothing
    can be seen; closed: whether it was filled with a flat fan.
    """

    middle: tuple[float, float, float]
    area: float
    length: float
    on_floor: bool
    closed: bool


def cut_floor(surface: Surface, voxel: float) -> Surface:
    """Cut off the floor at z = 0, and extend faces that cross the cut down to z = 0."""
    height = surface.vertices[:, 2]
    low = height < CUT * voxel
    kept = surface.keeping(~low[surface.faces].all(1))
    vertices = kept.vertices.copy()
    vertices[vertices[:, 2] < CUT * voxel, 2] = 0.0
    return Surface(vertices, kept.faces)


def drop_bits(surface: Surface) -> tuple[Surface, int]:
    """Return the largest component and others that are not tiny beside it, and the number of dropped components."""
    label = label_connected(len(surface.faces), neighbours(surface.faces))
    area = np.bincount(label, surface.areas)
    kept = area >= BIT * area.max()
    return surface.keeping(kept[label]), int(((area > 0) & ~kept).sum())


def loops(faces: Int[np.ndarray, "F 3"]) -> list[Int[np.ndarray, " _"]]:
    """Return the border loops, each as vertices in the orientation of a face that fills the hole."""
    ends = faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    base = int(faces.max()) + 1
    there = set((ends[:, 0] * base + ends[:, 1]).tolist())
    lone = ends[[(b * base + a) not in there for a, b in ends.tolist()]]
    after: dict[int, list[int]] = {}
    for a, b in lone[:, ::-1].tolist():
        after.setdefault(a, []).append(b)
    border_loops = []
    for start in sorted(after):
        while after[start]:
            walk, at = [start], after[start].pop()
            while at != start and after.get(at):
                walk.append(at)
                at = after[at].pop()
            if at == start and len(walk) > 2:
                border_loops.append(np.array(walk))
    return border_loops


def close_small(surface: Surface, voxel: float, most: float = CLOSED) -> tuple[Surface, tuple[Hole, ...], int]:
    """Close holes that are flat or have a perimeter below `most` voxels with a fan.

    Also return the larger holes, both closed flat ones and open ones, and the number of closed small ones.
    """
    vertices, faces, holes, closed = [surface.vertices], [surface.faces], [], 0
    count = len(surface.vertices)
    for loop in loops(surface.faces):
        p = surface.vertices[loop]
        length = float(np.linalg.norm(p - np.roll(p, -1, 0), axis=1).sum())
        middle = p.mean(0)
        large = length > most * voxel
        flat = large and _off_plane(p) < max(FLAT * length, FLAT_VOXELS * voxel)
        if large:
            fan = np.stack([p, np.roll(p, -1, 0), np.broadcast_to(middle, p.shape)], 1)
            area = float(0.5 * np.linalg.norm(face_cross(fan).sum(0)))
            at = (float(middle[0]), float(middle[1]), float(middle[2]))
            holes.append(Hole(at, area, length, bool((p[:, 2] <= 1e-9).mean() > ON_FLOOR), flat))
        if large and not flat:
            continue
        faces.append(np.stack([loop, np.roll(loop, -1), np.full(len(loop), count)], 1))
        vertices.append(middle[None])
        count += 1
        closed += not large
    holes.sort(key=lambda h: -h.area)
    return Surface(np.concatenate(vertices), np.concatenate(faces)), tuple(holes), closed


def _off_plane(points: Float[np.ndarray, "n 3"]) -> float:
    """Return the root mean square distance of points from their best-fitting plane [m]."""
    return float(np.linalg.svd(points - points.mean(0), compute_uv=False)[2]) / float(np.sqrt(len(points)))
