"""Pictures of what no view from outside shows, the rest of the object as a ghost behind it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool

from anymesh.rendering.paint import lighten
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import shown
from anymesh.types import Mesh
from anymesh.types.camera import Camera

GHOST = 0.75  # how much nearer to white the rest is drawn


def inside_views(mesh: Mesh, inside: Bool[np.ndarray, " F"], cameras: Sequence[Camera], scene: RayScene) -> list[View]:
    """What each camera sees when only the faces `inside` are there. scene: of the whole mesh, which is drawn as a ghost."""
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
