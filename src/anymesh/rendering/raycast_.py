"""Ray casting on the CPU by Embree (temporary stand-in by the lead until the real one lands; same interface)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Hits:
    face: np.ndarray
    distance: np.ndarray
    u: np.ndarray
    v: np.ndarray


class RayScene:
    def __init__(self, vertices, faces):
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        low, high = vertices.min(0), vertices.max(0)
        self._center, self._scale = (low + high) / 2, 1.0 / (float((high - low).max()) or 1.0)
        self._scene = EmbreeScene()
        v = ((vertices - self._center) * self._scale).astype(np.float32)
        self._mesh = TriangleMesh(self._scene, v, faces.astype(np.int32))

    def first_hit(self, origins, directions, max_distance=None):
        o = ((origins - self._center) * self._scale).astype(np.float32)
        d = (directions * self._scale).astype(np.float32)
        far = np.full(len(o), 1e30 if max_distance is None else max_distance, np.float32)
        out = self._scene.run(o, d, dists=far, output=1)
        face = out["primID"].astype(np.int64)
        return Hits(face, np.where(face >= 0, out["tfar"], np.inf).astype(np.float64), out["u"], out["v"])
