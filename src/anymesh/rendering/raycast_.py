"""Ray casting on the CPU, by Embree."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError


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
        self._center, self._scale = (low + high) / 2, 1.0 / (float((high - low).max()) or 1.0)
        self._scene = EmbreeScene(_device())
        inside = ((vertices - self._center) * self._scale).astype(np.float32)
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
        o = ((origins - self._center) * self._scale).astype(np.float32)
        d = (directions * self._scale).astype(np.float32)
        far = np.full(len(o), 1e30 if max_distance is None else max_distance, np.float32)
        out = self._scene.run(o, d, dists=far, output=1)
        face = out["primID"].astype(np.int64)
        distance = np.where(face >= 0, out["tfar"], np.inf).astype(np.float64)
        return Hits(face, distance, out["u"].astype(np.float64), out["v"].astype(np.float64))
