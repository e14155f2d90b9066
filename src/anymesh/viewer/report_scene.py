"""Data for the 3D view of a page besides the GLB: axes, exploded view, initial camera."""

from __future__ import annotations

from typing import Any

import numpy as np

from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.marks import axis_line
from anymesh.rendering.preview import BASE, PALETTE, best_camera, shown_position
from anymesh.types import Asset, Joint, JointType

APART = 0.35  # maximum distance of a part in the exploded view, as a share of the diagonal
RING = 0.04  # radius of the ring around an axis, as a share of the diagonal; as in the preview


def color_class(part: int) -> str:
    """Return the CSS class of a part's colour."""
    return "base" if part == 0 else f"c{(part - 1) % len(PALETTE)}"


def palette() -> dict[str, str]:
    """Return CSS class -> colour, with the colours of the preview."""
    rows = {"base": BASE} | {f"c{k}": color for k, color in enumerate(PALETTE)}
    return {name: "#{:02x}{:02x}{:02x}".format(*(int(v) for v in color)) for name, color in rows.items()}


def scene(asset: Asset, *, looks: bool) -> dict[str, Any]:
    """Return plain values, lengths [m] in the asset frame at rest, parts by index. looks: start with materials."""
    number = {part.name: k for k, part in enumerate(asset.segmentation.parts)}
    carried = {joint.child: joint for joint in asset.joints}
    corners = {name: asset.mesh.triangles[asset.segmentation.face_part == k].reshape(-1, 3) for name, k in number.items()}
    middle = {name: (points.min(0) + points.max(0)) / 2 for name, points in corners.items()}
    links = []
    for name, k in number.items():
        joint = carried.get(name)
        origin = np.zeros(3) if joint is None else joint.origin
        away = np.zeros(3) if joint is None else _away(joint, middle) * APART * asset.mesh.diagonal
        links.append(
            {
                "name": name,
                "color": palette()[color_class(k)],
                "parent": -1 if joint is None else number[joint.parent],
                "origin": _list(origin),
                "away": _list(away),
            }
        )
    joints = [_joint(asset, joint, number, corners[joint.child], middle[joint.child]) for joint in asset.joints]
    return {"links": links, "joints": joints, "looks": looks, "ring": RING * asset.mesh.diagonal, **_view(asset)}


def _joint(asset: Asset, joint: Joint, number: dict[str, int], corners: np.ndarray, middle: np.ndarray) -> dict[str, Any]:
    ends, center = axis_line(corners, joint.origin, joint.axis, joint.type is JointType.PRISMATIC, asset.mesh.diagonal)
    return {
        "name": joint.name,
        "type": str(joint.type),
        "link": number[joint.child],
        "axis": _list(joint.axis),
        "limits": None if joint.limits is None else [float(v) for v in joint.limits],
        "ends": [_list(end) for end in ends],
        "center": _list(center),
        "middle": _list(middle),
    }


def _away(joint: Joint, middle: dict[str, np.ndarray]) -> np.ndarray:
    """Return the direction in which a part leaves its parent: a slide opens, others go from centre to centre."""
    if joint.type is JointType.PRISMATIC:
        assert joint.limits is not None
        return joint.axis if joint.limits[1] >= -joint.limits[0] else -joint.axis
    way = middle[joint.child] - middle[joint.parent]
    length = float(np.linalg.norm(way))
    return way / length if length > 0 else joint.axis


def _view(asset: Asset) -> dict[str, Any]:
    """Return the view of the preview: its direction, and the box of the asset at rest and opened."""
    opened = posed(asset, {joint.name: shown_position(joint) for joint in asset.joints})
    camera = best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])
    return {
        "toward": _list(-camera.T_world_camera[:3, 2]),  # from the object to the eye
        "low": _list(np.minimum(asset.mesh.bounds[0], opened.bounds[0])),
        "high": _list(np.maximum(asset.mesh.bounds[1], opened.bounds[1])),
    }


def _list(values: np.ndarray) -> list[float]:
    return [float(v) for v in values]
