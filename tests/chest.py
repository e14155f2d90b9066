"""A chest of drawers whose fronts are sunk into a closed case, as low-poly packs have them, with its parts found wrong."""

from __future__ import annotations

import numpy as np
from assets import box, joint, mesh_of, source

from anymesh.types import Asset, Part, Segmentation

CASE = box((-0.4, -0.25, 0.0), (0.4, 0.25, 0.9))
FRONTS = [box((-0.37, -0.26, 0.03 + 0.29 * k), (0.37, -0.21, 0.30 + 0.29 * k)) for k in range(3)]
HANDLES = [box((-0.08, -0.29, 0.155 + 0.29 * k), (0.08, -0.26, 0.175 + 0.29 * k)) for k in range(3)]
PIECES = [CASE, *(piece for pair in zip(FRONTS, HANDLES, strict=True) for piece in pair)]
TOP = (5, 6)  # numbers of the pieces of the top drawer


def chest(moving: tuple[int, ...] = (), *, sideways: bool = False) -> Asset:
    """The chest; pieces `moving` are the part drawer, which slides sideways if it is wrong."""
    mesh, piece = mesh_of(PIECES)
    part = np.isin(piece, moving).astype(np.int64)
    axis = (1, 0, 0) if sideways else (0, -1, 0)
    slide = joint("slide", "prismatic", "base", "drawer", (0.0, -0.25, 0.745), axis, (0.0, 0.3))
    parts = (Part("base", "base"), Part("drawer", "drawer", 0.6))
    if not moving:
        return Asset("chest", source("chest.glb"), mesh, Segmentation(part, parts[:1]), (), "geometry")
    warning = ("joint slide: low confidence (0.30), please check",) if sideways else ()
    return Asset("chest", source("chest.glb"), mesh, Segmentation(part, parts), (slide,), "geometry", warning)
