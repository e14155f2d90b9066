"""Equalities of MJCF: followers, screws, and closed loops."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree import ElementTree

import numpy as np

from anymesh.export.model import Model
from anymesh.export.notation import number, vector
from anymesh.mechanisms.closing import loop_points
from anymesh.types import Asset, Joint, JointType
from anymesh.types.motion import leaders

FIRM = {"solref": "0.004 1", "solimp": "0.9999 0.9999 0.001"}  # else a follower lags behind what it moves, and loops open


def lift_name(joint: Joint) -> str:
    """Return the name of the slide of a screw."""
    return f"{joint.name}_lift"


def lifts(asset: Asset, positions: Mapping[str, float]) -> dict[str, float]:
    """Return how far screws are along their axes [m], by the names of their slides."""
    screws = [j for j in asset.joints if j.type is JointType.SCREW and j.name in positions]
    return {lift_name(j): j.pitch / (2 * np.pi) * positions[j.name] for j in screws}


def add_equalities(root: ElementTree.Element, model: Model) -> None:
    """Add what couples joints and closes loops, if there is anything. A loop that slides has no counterpart."""
    asset, origins = model.asset, {link.name: link.origin for link in model.links}
    screws = {lift_name(j): (j.name, j.pitch / (2 * np.pi), 0.0) for j in asset.joints if j.type is JointType.SCREW}
    ways = screws | {name: (way.joint, way.ratio, way.offset) for name, way in leaders(asset.joints).items()}
    made: list[tuple[str, dict[str, str]]] = [
        ("joint", {"joint1": name, "joint2": leader, "polycoef": f"{number(offset)} {number(ratio)} 0 0 0"})
        for name, (leader, ratio, offset) in ways.items()
    ]
    for loop in asset.loops:
        between = {"body1": loop.first, "body2": loop.second}
        points = [] if loop.kind is JointType.FIXED else loop_points(loop, asset.mesh.diagonal)
        made += [("weld", between)] if loop.kind is JointType.FIXED else []
        made += [("connect", between | {"anchor": vector(point - origins[loop.first])}) for point in points]
    if made:
        equality = ElementTree.SubElement(root, "equality")
        for tag, words in made:
            ElementTree.SubElement(equality, tag, words | FIRM)
