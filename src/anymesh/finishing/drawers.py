"""Boxes for sliding drawer fronts, which fit the cavity that they slide in."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.finishing.blocks import tray
from anymesh.finishing.free import moves_freely
from anymesh.finishing.panels import PanelBox
from anymesh.finishing.scenes import Growing, scene_of
from anymesh.finishing.settings import ShapeConfig
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import JointType

STRAIGHT = 0.95  # minimum cosine between the slide and the cavity's direction
UPRIGHT = 0.5  # minimum vertical component of a box's up direction
PROBES = 12  # rays along each direction
THIN = 0.08  # maximum thickness of a box's wall, as a share of its smallest side
THERE = 0.6  # minimum share of the rays that hit a side of an existing box
TRIES = (1.0, 2.0, 4.0)  # multiples of the clearance on each side, tried until the box moves freely


def add_box(panel: PanelBox, growing: Growing, config: ShapeConfig) -> None:
    """Add a box to a panel that slides straight out and has none, unless it would collide on its way."""
    joint = growing.scenes.joint[panel.part]
    if joint.type is not JointType.PRISMATIC or joint.limits is None or panel.axes[1][2] < UPRIGHT:
        return
    travel = -panel.inward @ joint.axis * (joint.limits[1] if panel.inward @ joint.axis < 0 else joint.limits[0])
    if abs(panel.inward @ joint.axis) < STRAIGHT or travel <= 0:
        return
    own, others = scene_of(growing.triangles(panel.part)), scene_of(growing.others(panel.part))
    if own is None or others is None or _has_box(panel, own):
        return
    for more in TRIES:
        clear = more * config.clearance * growing.scenes.diagonal
        low, high = _inside(panel, others, own, clear)
        high[2] = min(high[2], low[2] + max(travel / (1 - config.drawer_keep), 0.0))
        high[1] = low[1] + config.drawer_height * (high[1] - low[1])
        wall = min(config.wall * growing.scenes.diagonal, THIN * float((high - low).min()))
        if wall <= config.sheet * growing.scenes.diagonal:
            continue
        box = _upwards(low, high, panel.axes, wall)
        if moves_freely(panel.part, growing, growing, added=box):
            reach = high[2] - low[2]
            growing.add(
                panel.part, box, [f"drawer box added behind its front, {reach:.2g} m deep for a travel of {travel:.2g} m"]
            )
            return
    growing.add(panel.part, np.zeros((0, 3, 3)), ["no drawer box added: none moves without collision"])


def _upwards(low: np.ndarray, high: np.ndarray, axes: np.ndarray, wall: float) -> Float[np.ndarray, "n 3 3"]:
    """Return a tray that is open along the second of the axes."""
    order = [2, 0, 1]
    return tray(low[order], high[order], axes[order], wall)


def _inside(panel: PanelBox, others: RayScene, own: RayScene, clear: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of the space behind a panel that is free at rest, less the clearance on all sides but the panel's."""
    low, high = panel.low.copy(), panel.high.copy()
    low[:2] += clear
    high -= clear
    scenes = (others, own)
    middle = (low + high) / 2
    core = (middle + (low - middle) / 2, middle + (high - middle) / 2)
    high[2] = min(high[2], low[2] + _way(panel.axes, 2, 1.0, low[2], *core, scenes) - clear)
    for axis in (0, 1):
        down = _way(panel.axes, axis, -1.0, middle[axis], low, high, scenes)
        up = _way(panel.axes, axis, 1.0, middle[axis], low, high, scenes)
        low[axis], high[axis] = max(low[axis], middle[axis] - down + clear), min(high[axis], middle[axis] + up - clear)
    high[2] = min(high[2], low[2] + _way(panel.axes, 2, 1.0, low[2], low, high, scenes) - clear)
    return low, high


def _grid(axes: np.ndarray, axis: int, level: float, low: np.ndarray, high: np.ndarray) -> Float[np.ndarray, "n 3"]:
    """Return points over a section of a box, at a level along one of its axes, away from its edges."""
    share = (np.arange(PROBES) + 0.5) / PROBES
    share[0], share[-1] = 0.02, 0.98
    at = np.stack(np.meshgrid(share, share, indexing="ij"), -1).reshape(-1, 2)
    local = np.full((len(at), 3), level)
    for column, k in enumerate(a for a in range(3) if a != axis):
        local[:, k] = low[k] + at[:, column] * (high[k] - low[k])
    return local @ axes


def _way(
    axes: np.ndarray, axis: int, sign: float, level: float, low: np.ndarray, high: np.ndarray, scenes: tuple[RayScene, ...]
) -> float:
    """Compute the distance from a section of a box to the first surface along one of its axes [m]."""
    skip = 1e-3 * float((high - low)[axis])
    start = _grid(axes, axis, level + sign * skip, low, high)
    ways = np.repeat(sign * axes[axis][None], len(start), 0)
    far = 2 * float(np.abs(high - low).max())
    return min(float(np.minimum(s.first_hit(start, ways, far).distance, far).min()) for s in scenes) + skip


def _has_box(panel: PanelBox, own: RayScene) -> bool:
    """Return whether the part has its own bottom, two sides and back in the cavity, by rays from its centre."""
    middle, size = (panel.low + panel.high) / 2, panel.high - panel.low
    for axis, sign in ((0, -1.0), (0, 1.0), (1, -1.0), (2, 1.0)):
        low, high = middle - size / 4, middle + size / 4
        low[1] = high[1] = panel.low[1] + 0.3 * size[1]
        start = _grid(panel.axes, axis, float(low[1] if axis == 1 else middle[axis]), low, high)
        hits = own.first_hit(start, np.repeat(sign * panel.axes[axis][None], len(start), 0), float(size[axis]))
        if (hits.face >= 0).mean() < THERE:
            return False
    return True
