"""One object from a fused surface: cut off the floor, drop small components, close small holes, smooth, simplify.

Simplification is by fast-simplification (quadric error).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.topology import label_connected
from anymesh.types import Brief
from anymesh.types.triangles import face_cross

NORMAL_ROUNDS, VERTEX_ROUNDS = 20, 12
SIGMA = 0.35  # difference of unit normals at which a neighbour has weight 0.6
STEP = 0.9  # share of a vertex update that is applied per iteration
CUT = 2.5  # [voxels] above the floor where the surface is cut, since the fused crease between floor and object is rounded
BIT = 0.01  # share of the largest component's area; smaller components are dropped
ON_FLOOR = 0.8  # share of a hole's vertices at z = 0 from which it counts as the object's footprint
CLOSED = 40.0  # [voxels] perimeter; shorter holes are closed whatever their shape
FLAT, FLAT_VOXELS = 0.01, 1.5  # larger holes are closed if nearer to a plane: share of the perimeter, [voxels]
ROUNDS = 6  # iterations of removing folded faces and closing the holes that result
ROUND_HOLE = 40.0  # [edges] perimeter of holes that are closed


@dataclass(frozen=True, eq=False)
class Surface(Brief):
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


def smooth(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], most: float,
    rounds: tuple[int, int] = (NORMAL_ROUNDS, VERTEX_ROUNDS),
) -> Float[np.ndarray, "V 3"]:  # fmt: skip
    """Return the vertices of the denoised surface; border vertices are fixed. most: largest displacement of a vertex [m].

    Bilateral filtering of face normals (Zheng, Fu, Au and Tai 2011: local, iterative), then vertex updates (Sun, Rosin, Martin
    and Langbein 2007). Creases are preserved.
    """
    pairs = neighbours(faces)
    cross = face_cross(vertices[faces])
    double = np.linalg.norm(cross, axis=1)
    normal = cross / np.maximum(double, 1e-30)[:, None]
    a, b = pairs.T
    for _ in range(rounds[0]):
        gap = np.einsum("ij,ij->i", normal[a] - normal[b], normal[a] - normal[b])
        weight = np.exp(-gap / (2 * SIGMA**2))
        summed = normal * double[:, None]
        for k in range(3):
            summed[:, k] += np.bincount(a, weight * double[b] * normal[b, k], len(faces))
            summed[:, k] += np.bincount(b, weight * double[a] * normal[a, k], len(faces))
        normal = summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-30)
    count = np.maximum(np.bincount(faces.reshape(-1), minlength=len(vertices)), 1)
    free = ~border_vertices(faces, len(vertices))
    moved = vertices.copy()
    for _ in range(rounds[1]):
        corners = moved[faces]
        toward = np.einsum("fk,fck->fc", normal, corners.mean(1, keepdims=True) - corners)
        step = np.stack(
            [np.bincount(faces.reshape(-1), (toward * normal[:, k, None]).reshape(-1), len(vertices)) for k in range(3)], 1
        )
        moved[free] += STEP * (step / count[:, None])[free]
    shift = moved - vertices
    length = np.linalg.norm(shift, axis=1, keepdims=True)
    return vertices + shift * np.minimum(1, most / np.maximum(length, 1e-30))


def neighbours(faces: Int[np.ndarray, "F 3"]) -> Int[np.ndarray, "m 2"]:
    """Return pairs of faces that share an edge, ignoring edges of more than two faces."""
    key, owner = edge_keys(faces)
    order = np.argsort(key, kind="stable")
    key, owner = key[order], owner[order]
    first = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    two = first[np.diff(np.r_[first, len(key)]) == 2]
    return np.stack([owner[two], owner[two + 1]], 1)


def border_vertices(faces: Int[np.ndarray, "F 3"], count: int) -> np.ndarray:
    """Return whether each vertex lies on an edge of only one face."""
    key, _ = edge_keys(faces)
    unique, times = np.unique(key, return_counts=True)
    lone = unique[times == 1]
    on_border = np.zeros(count, bool)
    base = int(faces.max()) + 1
    on_border[lone // base] = on_border[lone % base] = True
    return on_border


def edge_keys(faces: Int[np.ndarray, "F 3"]) -> tuple[np.ndarray, np.ndarray]:
    """Return a key for each side of each face, equal for shared edges, and the face of each."""
    ends = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1).astype(np.int64)
    return ends[:, 0] * (int(faces.max()) + 1) + ends[:, 1], np.repeat(np.arange(len(faces)), 3)


def decimate(surface: Surface, most: int) -> Surface:
    """Simplify the surface to about `most` faces, without non-manifold edges and folded faces.

    `geometry.simplify_` is not used: it is meant for rendering and may tear a surface, and tears later become part boundaries.
    """
    if len(surface.faces) > most:
        from fast_simplification import simplify

        center = surface.vertices.mean(0)  # simplify computes in float32, which is most precise near the origin
        vertices, faces = simplify(
            (surface.vertices - center).astype(np.float32), surface.faces.astype(np.int32), target_count=most
        )
        surface = Surface(vertices.astype(np.float64) + center, faces.astype(np.int64))
    for _ in range(ROUNDS):
        surface, bad = _without_folds(surface)
        if not bad:
            break
        edge = float(np.sqrt(np.median(surface.areas)))
        surface = close_small(drop_bits(surface)[0], edge, ROUND_HOLE)[0]
    return drop_bits(surface)[0]


def _without_folds(surface: Surface) -> tuple[Surface, int]:
    """Remove degenerate, duplicate and non-manifold faces and all faces that touch them; return the number of removed faces.

    Faces that touch them are removed too, so that the hole is simple and can be closed with a fan.
    """
    faces = surface.faces
    flat = (faces == np.roll(faces, 1, axis=1)).any(1) | (surface.areas <= 0)
    _, inverse, count = np.unique(np.sort(faces, 1), axis=0, return_inverse=True, return_counts=True)
    twice = count[inverse.reshape(-1)] > 1
    key, owner = edge_keys(faces)
    crowded = np.zeros(len(faces), bool)
    _, where, sides = np.unique(key, return_inverse=True, return_counts=True)
    crowded[owner[sides[where.reshape(-1)] > 2]] = True
    bad = np.unique(faces[flat | twice | crowded])
    gone = np.any(np.isin(faces, bad), axis=1)
    return surface.keeping(~gone), int(gone.sum())
