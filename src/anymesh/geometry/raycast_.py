"""Ray casting on the CPU with Embree."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cache
from typing import Any

import numpy as np
from jaxtyping import Float, Float32, Int, Int32, Shaped

from anymesh.errors import MissingExtraError
from anymesh.types import Brief
from anymesh.types.triangles import bounds_of

FAR = 1e30  # distance that stands for infinity, in lengths of the ray's direction


@dataclass(frozen=True, eq=False)
class Hits(Brief):
    """First hits, such that hit = origin + distance * direction.

    face: (n,) -1 where nothing is hit; distance: (n,) in lengths of the ray's direction, inf where nothing is hit;
    u, v: (n,) barycentric coordinates, for corner weights (1 - u - v, u, v).
    """

    face: Int[np.ndarray, " n"]
    distance: Float[np.ndarray, " n"]
    u: Float[np.ndarray, " n"]
    v: Float[np.ndarray, " n"]


@dataclass(frozen=True, eq=False)
class SurfaceHits(Brief):
    """First hits in single precision, with the surface normal, for pictures.

    face, u, v: (n,) as in `Hits`; depth: (n,) in lengths of the ray's direction, inf where nothing is hit;
    normal: (n, 3) unit normal of the face, turned towards the ray's origin, zero where nothing is hit.
    """

    face: Int32[np.ndarray, " n"]
    depth: Float32[np.ndarray, " n"]
    u: Float32[np.ndarray, " n"]
    v: Float32[np.ndarray, " n"]
    normal: Float32[np.ndarray, "n 3"]

    def take(self, rows: Int[np.ndarray, " m"]) -> SurfaceHits:
        """Return the hits of these rows."""
        return SurfaceHits(*(getattr(self, f.name)[rows] for f in fields(self)))

    @staticmethod
    def joined(first: SurfaceHits, second: SurfaceHits) -> SurfaceHits:
        """Concatenate two sets of hits."""
        pairs = ((getattr(first, f.name), getattr(second, f.name)) for f in fields(SurfaceHits))
        return SurfaceHits(*(np.concatenate(pair) for pair in pairs))


@cache
def _device() -> Any:
    """Return the device shared by all scenes: each device takes one of about a thousand keys per process."""
    from embreex.rtcore import EmbreeDevice  # ty: ignore[import-not-found]

    return EmbreeDevice()


MAX_ROWS = 50_000  # faces that are turned into objects for speed, 180 bytes each


def index_rows(faces: Int[np.ndarray, "F 3"]) -> Shaped[np.ndarray, " F"]:
    """Return the three indices of each face as a list.

    Embreex copies vertices and faces in a loop that reads each number as an object. This takes 2.7 times as long if it has to
    be made from an array of numbers first.
    """
    return np.fromiter(faces.tolist(), object, len(faces))


class RayScene:
    """Triangles to cast rays at. Embree uses float32, so geometry is centred and scaled to keep its precision.

    faces: indices, or lists of them from `index_rows`; bounds: of the vertices that the faces have, if there are others.
    """

    def __init__(
        self,
        vertices: Float[np.ndarray, "V 3"],
        faces: Int[np.ndarray, "F 3"] | Shaped[np.ndarray, " F"],
        bounds: Float[np.ndarray, "2 3"] | None = None,
    ) -> None:
        try:
            from embreex.mesh_construction import TriangleMesh  # ty: ignore[import-not-found]
            from embreex.rtcore_scene import EmbreeScene  # ty: ignore[import-not-found]
        except ImportError:
            raise MissingExtraError("embreex is missing; it is a dependency of articulate-anymesh; reinstall that") from None
        low, high = bounds_of(vertices) if bounds is None else bounds
        self.center, self.scale = (low + high) / 2, 1.0 / (float((high - low).max()) or 1.0)
        self.unit_half = ((high - low) / 2 * self.scale).astype(np.float32)  # half extents of the bounds in the unit frame
        self._scene = EmbreeScene(_device())
        inside = self.to_unit(vertices)
        rows = index_rows(faces) if faces.ndim == 2 and len(faces) <= MAX_ROWS else faces
        try:
            self._mesh = TriangleMesh(self._scene, inside.astype(object) if rows.ndim == 1 else inside, rows)
        except (TypeError, ValueError):  # an embreex that reads arrays as such takes no objects
            self._mesh = TriangleMesh(self._scene, inside, np.array(rows.tolist(), np.int32))
        self.first_hit_unit(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))

    def first_hit(
        self, origins: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "n 3"], max_distance: float | None = None
    ) -> Hits:
        """Return the first triangle that each ray hits within `max_distance` lengths of its direction."""
        if len(origins) == 0:
            nothing = np.zeros(0)
            return Hits(np.zeros(0, np.int64), nothing, nothing, nothing)
        far = np.inf if max_distance is None else max_distance
        one = origins.strides[0] == 0  # rays from one point
        starts = np.tile(self.to_unit(origins[:1]), (len(origins), 1)) if one else self.to_unit(origins)
        hits = self.first_hit_unit(starts, (directions * self.scale).astype(np.float32), far)
        return Hits(hits.face, *(v.astype(np.float64) for v in (hits.distance, hits.u, hits.v)))

    def to_unit(self, points: Float[np.ndarray, "n 3"]) -> Float32[np.ndarray, "n 3"]:
        """Transform points to the unit frame, where the longest side of the bounds is 1 and their centre 0."""
        return ((points - self.center) * self.scale).astype(np.float32)

    def first_hit_unit(
        self, origins: Float32[np.ndarray, "n 3"], directions: Float32[np.ndarray, "n 3"], max_distance: float = 1.0
    ) -> Hits:
        """Return the first hits for rays in the unit frame; distances are float32."""
        far = np.full(len(origins), min(max_distance, FAR), np.float32)
        out = self._scene.run(origins, directions, dists=far, output=1)
        face = out["primID"].astype(np.int64)
        return Hits(face, np.where(face >= 0, out["tfar"], np.float32(np.inf)), out["u"], out["v"])

    def surface_hits(self, origin: Float[np.ndarray, " 3"], directions: Float32[np.ndarray, "n 3"]) -> SurfaceHits:
        """Return the first surface that each ray from one origin hits, in single precision, for pictures."""
        count = len(directions)
        if count == 0:
            none = np.zeros(0, np.float32)
            return SurfaceHits(np.zeros(0, np.int32), none, none, none, np.zeros((0, 3), np.float32))
        starts = np.tile(self.to_unit(origin[None]), (count, 1))
        far = np.full(count, FAR, np.float32)
        out = self._scene.run(starts, directions * np.float32(self.scale), dists=far, output=1)
        face, depth, normal = out["primID"], np.full(count, np.inf, np.float32), np.zeros((count, 3), np.float32)
        seen = np.flatnonzero(face >= 0)
        face_normal, toward = out["Ng"][seen], np.einsum("ij,ij->i", out["Ng"][seen], directions[seen])
        length = np.maximum(np.sqrt(np.einsum("ij,ij->i", face_normal, face_normal)), np.finfo(np.float32).tiny)
        normal[seen] = face_normal * (np.where(toward > 0, np.float32(-1), np.float32(1)) / length)[:, None]
        depth[seen] = out["tfar"][seen]
        return SurfaceHits(face, depth, out["u"], out["v"], normal)
