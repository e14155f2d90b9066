"""Pictures of faces that no outside view shows, with the rest of the object as a ghost behind them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from jaxtyping import Bool, UInt8

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.marks import lighten
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
    views = []
    for camera in cameras:
        near, whole = shown(part, camera, rays), shown(mesh, camera, scene)
        face = np.where(near.face >= 0, own[np.maximum(near.face, 0)], -1)
        views.append(replace(near, face=face, paint=partial(_over_ghost, near, whole)))
    return views


def _over_ghost(near: View, whole: View) -> UInt8[np.ndarray, "H W 3"]:
    """Return the picture of some faces over the lightened picture of all."""
    return np.where((near.face >= 0)[..., None], near.color, lighten(whole.color, GHOST))
