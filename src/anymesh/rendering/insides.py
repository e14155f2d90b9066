"""Pictures of faces that no outside view shows, with the rest of the object as a ghost behind them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.paint import lighten
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import shown
from anymesh.types import Mesh
from anymesh.types.camera import Camera

GHOST = 0.75  # share by which the colours of the rest are moved towards white


def inside_views(mesh: Mesh, inside: Bool[np.ndarray, " F"], cameras: Sequence[Camera], scene: RayScene) -> list[View]:
    """Render only the faces `inside` from each camera. scene: of the whole mesh, which is drawn as a ghost."""
    own = np.flatnonzero(inside)
    part = mesh.subset(inside)
    rays = RayScene(part.vertices, part.faces)
    found = []
    for camera in cameras:
        near, whole = shown(part, camera, rays), shown(mesh, camera, scene)
        face = np.where(near.face >= 0, own[np.maximum(near.face, 0)], -1)
        color = np.where((face >= 0)[..., None], near.color, lighten(whole.color, GHOST))
        found.append(replace(near, color=color, face=face))
    return found
