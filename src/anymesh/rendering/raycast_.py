"""Ray casting on the CPU, by Embree."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from jaxtyping import Float, Float32, Int

from anymesh.errors import MissingExtraError

FAR = 1e30  # of a ray without an end, in lengths of its direction


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits, so that hit = origin + distance * direction.

    face: (n,) -1 where nothing is hit; distance: (n,) in lengths of the ray's direction, inf where nothing is hit;
    u, v: (n,) barycentric, the corners weigh (1 - u - v, u, v).
    """

    face: Int[np.ndarray, " n"]
    distance: Float[np.ndarray, " n"]
    u: Float[np.ndarray, " n"]
    v: Float[np.ndarray, " n"]


@cache
def _device() -> Any:
    """One for all scenes: each takes a key of the process, of which there are about a thousand."""
    from embreex.rtcore import EmbreeDevice  # ty: ignore[import-not-found]

    return EmbreeDevice()


class RayScene:
    """Triangles to cast rays at. Embree counts in float32, so geometry is centred and scaled to keep its precision."""

    def __init__(self, vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]) -> None:
        try:
            from embreex.mesh_construction import TriangleMesh  # ty: ignore[import-not-found]
            from embreex.rtcore_scene import EmbreeScene  # ty: ignore[import-not-found]
        except ImportError:
            raise MissingExtraError("embreex is missing; it comes with articulate-anymesh, install that again") from None
        low, high = vertices.min(0), vertices.max(0)
        self.center, self.scale = (low + high) / 2, 1.0 / (float((high - low).max()) or 1.0)
        self.unit_half = ((high - low) / 2 * self.scale).astype(np.float32)  # half sides of the bounds in the unit frame
        self._scene = EmbreeScene(_device())
        inside = self.to_unit(vertices)
        self._mesh = TriangleMesh(self._scene, inside, np.ascontiguousarray(faces, np.int32))

    def first_hit(
        self,
        origins: Float[np.ndarray, "n 3"],
        directions: Float[np.ndarray, "n 3"],
        max_distance: float | None = None,
    ) -> Hits:
        """The first triangle that each ray hits within `max_distance` lengths of its direction."""
        if len(origins) == 0:
            nothing = np.zeros(0)
            return Hits(np.zeros(0, np.int64), nothing, nothing, nothing)
        far = np.inf if max_distance is None else max_distance
        found = self.first_hit_unit(self.to_unit(origins), (directions * self.scale).astype(np.float32), far)
        return Hits(found.face, *(v.astype(np.float64) for v in (found.distance, found.u, found.v)))

    def to_unit(self, points: Float[np.ndarray, "n 3"]) -> Float32[np.ndarray, "n 3"]:
        """Points in the frame in which the longest side of the bounds is 1 and their middle 0."""
        return ((points - self.center) * self.scale).astype(np.float32)

    def from_unit(self, points: Float32[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """The inverse of `to_unit`."""
        return points / self.scale + self.center

    def first_hit_unit(
        self, origins: Float32[np.ndarray, "n 3"], directions: Float32[np.ndarray, "n 3"], max_distance: float = 1.0
    ) -> Hits:
        """`first_hit` for rays in the unit frame; distances come as float32."""
        far = np.full(len(origins), min(max_distance, FAR), np.float32)
        out = self._scene.run(origins, directions, dists=far, output=1)
        face = out["primID"].astype(np.int64)
        return Hits(face, np.where(face >= 0, out["tfar"], np.float32(np.inf)), out["u"], out["v"])
