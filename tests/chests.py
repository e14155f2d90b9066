"""A chest with a lid of one material, and a block on it: when it slides."""

from __future__ import annotations

import numpy as np
from assets import box, joint, mesh_of, source

from anymesh.types import Asset, Material, Part, Segmentation

SLIPS = ("oak", "steel", "rubber", "ice")
TILTS = np.radians((-1.0, 1.0))  # from the angle of friction: here the block stays, there it slides
FAR = 0.02  # [m] within a second: at one degree beyond the angle of friction a block slides 8 cm, below it creeps in MuJoCo


def chest(material: str) -> Asset:
    """Return a chest of unknown material, with a lid of 40 x 30 x 2 cm whose top is at .2 m, hinged at the back."""
    pieces = [box((-0.2, -0.15, 0), (0.2, 0.15, 0.18)), box((-0.2, -0.15, 0.18), (0.2, 0.15, 0.2))]
    mesh, number = mesh_of(pieces, np.repeat([0, 1], 12), materials=(Material("paint"), Material(material)))
    lid = joint("hinge", "revolute", "base", "lid", (0, 0.15, 0.18), (-1, 0, 0), (0.0, 1.5))
    parts = (Part("base", "base"), Part("lid", "lid"))
    return Asset("thing", source(), mesh, Segmentation(number, parts), (lid,), "geometry")


def slides(travel: float) -> bool:
    """Return whether a block that travelled so far [m] in a second slides."""
    return travel > FAR
