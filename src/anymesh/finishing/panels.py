"""Panels: parts that close a cavity of the body that carries them, and the depth of that cavity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.scenes import Growing, Scenes, scene_of, widest
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.kinematics import joint_transform
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.types import JointType

FACING = 0.9  # minimum cosine between a face's normal and its panel's
FILLED = 0.6  # minimum share of its bounding rectangle that a panel's face fills
CELLS = 64  # rays along each side of a panel
SMALL = 4.0  # in wall thicknesses: minimum size of a panel and of the cavity behind it
DEEP = 0.5  # share of the maximum depth above which a cell of the panel lies over the cavity
MOVES = 2.0  # in wall thicknesses: minimum distance that a panel moves


@dataclass(frozen=True, eq=False)
class PanelBox:
    """A part that closes a cavity.

    axes: rows, right-handed: along the panel (2), and into the body; low, high: corners of the cavity along them [m, asset
    frame], from the back of the panel to the first surface behind it.
    """

    part: int
    axes: Float[np.ndarray, "3 3"]
    low: Float[np.ndarray, " 3"]
    high: Float[np.ndarray, " 3"]

    @property
    def inward(self) -> Float[np.ndarray, " 3"]:
        return self.axes[2]


def find_panel(part: int, growing: Growing, config: ShapeConfig) -> PanelBox | None:
    """Find the cavity behind a part that moves away from it; None if there is none, or if it is too small."""
    scenes, joint = growing.scenes, growing.scenes.joint.get(part)
    if joint is None or joint.type in (JointType.FIXED, JointType.CONTINUOUS):
        return None
    face = _face(part, scenes)
    if face is None:
        return None
    axes, low, high = face
    least = SMALL * config.wall * scenes.diagonal
    middle = (low + high) / 2 @ axes
    away = joint_transform(joint, widest(joint))
    goes = float(np.linalg.norm(away[:3, :3] @ middle + away[:3, 3] - middle))
    if (high - low)[:2].min() < least or goes < MOVES * config.wall * scenes.diagonal:
        return None
    return _hollow(part, axes, low, high, growing, least)


def _face(part: int, scenes: Scenes) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Return axes and bounds of a part's visible face: the side of its box that most of its visible surface faces."""
    mesh, faces = scenes.asset.mesh, scenes.asset.segmentation.faces(part)
    shape = TriangleSet(mesh.triangles[faces], mesh.face_normals[faces], np.zeros(len(faces), bool), faces)
    box, s = body_obb(shape), shape.samples
    seen = scenes.seen(s.points, s.normals)
    best, most = None, 0
    for axis in np.concatenate([box.axes, -box.axes]):
        facing = (seen[:, 0] & (s.normals @ axis > FACING)) | (seen[:, 1] & (s.normals @ axis < -FACING))
        if facing.sum() > most:
            best, most, points = axis, int(facing.sum()), s.points[facing]
    if best is None:
        return None
    axes = _upright(box, -best)
    local = points @ axes.T
    low, high = np.percentile(local, 0.5, axis=0), np.percentile(local, 99.5, axis=0)
    filled = most / len(s.points) * shape.area
    return (axes, low, high) if filled > FILLED * (high - low)[0] * (high - low)[1] else None


def _upright(box: OrientedBox, inward: np.ndarray) -> Float[np.ndarray, "3 3"]:
    """Return a box's axes with the last one inward, and the second as vertical as possible, pointing up."""
    others = [a for a in box.axes if abs(a @ inward) < 0.5]
    up = max(others, key=lambda a: (round(abs(float(a[2])), 9), round(abs(float(a[1])), 9), round(abs(float(a[0])), 9)))
    up = up if tuple(np.round(up, 9)[::-1]) > (0.0, 0.0, 0.0) else -up
    return np.stack([np.cross(up, inward), up, inward])


def _hollow(
    part: int, axes: np.ndarray, low: np.ndarray, high: np.ndarray, growing: Growing, min_depth: float
) -> PanelBox | None:
    """Return the panel with the bounds of the cavity behind its face."""
    body, own = scene_of(growing.triangles(*growing.scenes.carriers(part))), scene_of(growing.triangles(part))
    if body is None or own is None:
        return None
    far = 2 * growing.scenes.diagonal
    share = (np.arange(CELLS) + 0.5) / CELLS
    u, v = (low[k] + share * (high - low)[k] for k in (0, 1))
    at = np.stack(np.meshgrid(u, v, indexing="ij"), -1).reshape(-1, 2)
    start = np.column_stack([at, np.full(len(at), low[2])]) @ axes
    ways = np.repeat(axes[2][None], len(start), 0)
    depth = body.first_hit(start, ways, far).distance.reshape(CELLS, CELLS)
    deepest = np.median(np.where(np.isfinite(depth), depth, 0.0))
    if not np.isfinite(depth).mean() > FILLED or deepest < min_depth:
        return None
    deep = depth > DEEP * deepest
    rows, columns = (np.flatnonzero(deep.mean(k) > 0.5) for k in (1, 0))
    if len(rows) == 0 or len(columns) == 0:
        return None
    inner_low, inner_high = low.copy(), high.copy()
    for k, cells in ((0, rows), (1, columns)):
        step = (high - low)[k] / CELLS
        inner_low[k], inner_high[k] = low[k] + cells[0] * step, low[k] + (cells[-1] + 1) * step
    inner_high[2] = low[2] + np.percentile(depth[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], 10)
    inner_low[2] = _back(own, axes, inner_low, inner_high)
    if (inner_high - inner_low).min() < min_depth:
        return None
    return PanelBox(part, axes, inner_low, inner_high)


def _back(own, axes: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Return how far a part extends inward at its centre, measured from within the cavity."""
    middle = (low + high) / 2
    start = np.array([[middle[0], middle[1], high[2]]]) @ axes
    hit = own.first_hit(start, -axes[2][None], float(high[2] - low[2]))
    return float(high[2] - hit.distance[0]) if np.isfinite(hit.distance[0]) else float(low[2])
