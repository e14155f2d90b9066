"""Unwrapping of a surface into flat charts in a square (box unwrapping, shelf packing)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import OptionError
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import edge_pairs, label_connected
from anymesh.types import Mesh

ACROSS = np.array([[1, 2], [2, 0], [0, 1]])  # axes of the plane normal to each axis
ROUNDS = 8  # iterations of cutting charts that overlap themselves; then each covered face becomes a chart
STEPS = 24  # iterations of the search for the scale


@dataclass(frozen=True, eq=False)
class Layout:
    """Position of every face corner in a square picture. corners: (F, 3, 2) [px], right and down; scale: [px/m]."""

    size: int
    corners: Float[np.ndarray, "F 3 2"]
    scale: float
    charts: int


def lay_out(mesh: Mesh, size: int, padding: int) -> Layout:
    """Lay out the faces without overlap; charts are `padding` px from each other and from the border.

    A chart is a connected set of faces with the same dominant axis, projected along that axis, so no length shrinks by more
    than a factor of 1.8. Raise OptionError if the charts do not fit.
    """
    direction = 2 * np.abs(mesh.face_cross).argmax(1)
    direction += np.take_along_axis(mesh.face_cross, direction[:, None] // 2, 1)[:, 0] < 0
    flat, depth = _flattened(mesh, direction)
    pairs = edge_pairs(mesh.vertices, mesh.faces).faces
    pairs = pairs[direction[pairs[:, 0]] == direction[pairs[:, 1]]]
    layer = np.zeros(len(flat), np.int64)
    for turn in range(ROUNDS + 1):
        chart = label_connected(len(flat), pairs[layer[pairs[:, 0]] == layer[pairs[:, 1]]])
        layout = _packed(flat, chart, size, padding)
        covered = _covered(layout, depth, chart)
        if not covered.any():
            break
        layer[covered] = turn + 1 if turn < ROUNDS - 1 else len(flat) + np.flatnonzero(covered)
    return layout


def _flattened(mesh: Mesh, direction: np.ndarray) -> tuple[Float[np.ndarray, "F 3 2"], Float[np.ndarray, "F 3"]]:
    """Project corners [m] along each face's direction, without mirroring; also return their height towards the viewer."""
    axis, back = direction // 2, direction % 2 == 1
    rows = np.arange(len(direction))[:, None]
    right, up = (mesh.triangles[rows, np.arange(3), ACROSS[axis, k][:, None]] for k in (0, 1))
    height = mesh.triangles[rows, np.arange(3), axis[:, None]]
    flip = np.where(back, -1.0, 1.0)[:, None]
    return np.stack([flip * right, -up], 2), flip * height


def _packed(flat: np.ndarray, chart: np.ndarray, size: int, padding: int) -> Layout:
    """Find the largest scale at which the charts fit, by bisection."""
    count = int(chart.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, chart, flat.min(1))
    np.maximum.at(high, chart, flat.max(1))
    extent = high - low
    least, most = 0.0, size / max(float(np.sqrt((extent[:, 0] * extent[:, 1]).sum())), float(extent.max()) / 2, 1e-300)
    at = _shelves(_pixels(extent, least, padding), size)
    if at is None:
        raise OptionError(f"an atlas of {size} px has no room for {count} charts; a larger one has")
    for _ in range(STEPS):
        middle = (least + most) / 2
        tried = _shelves(_pixels(extent, middle, padding), size)
        least, most, at = (middle, most, tried) if tried is not None else (least, middle, at)
    corners = (flat - low[chart][:, None]) * least + at[chart][:, None] + padding + 0.5
    return Layout(size, corners, least, count)


def _pixels(extent: np.ndarray, scale: float, padding: int) -> Int[np.ndarray, "c 2"]:
    return np.ceil(extent * scale).astype(np.int64) + 1 + 2 * padding


def _shelves(boxes: Int[np.ndarray, "c 2"], size: int) -> Int[np.ndarray, "c 2"] | None:
    """Place boxes side by side on shelves, tallest first, and return their corners; None if they do not fit."""
    if (boxes > size).any() or boxes.prod(1).sum() > size * size:
        return None
    at = np.zeros_like(boxes)
    x = y = shelf = 0
    for k in np.lexsort((-boxes[:, 0], -boxes[:, 1])).tolist():
        width, height = boxes[k].tolist()
        if x + width > size:
            x, y, shelf = 0, y + shelf, 0
        if y + height > size:
            return None
        at[k] = x, y
        x, shelf = x + width, max(shelf, height)
    return at


def _covered(layout: Layout, depth: np.ndarray, chart: np.ndarray) -> np.ndarray:
    """Return which faces have their centroid below another face of their chart."""
    corners = np.concatenate([layout.corners, (depth * layout.scale)[:, :, None]], axis=2)
    scene = RayScene(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
    middle = corners.mean(1)
    middle[:, 2] = corners[:, :, 2].max() + 1
    hit = scene.first_hit(middle, np.repeat([[0.0, 0.0, -1.0]], len(middle), 0)).face
    own = np.arange(len(hit))
    above = depth[hit].mean(1) - depth.mean(1) > 1e-9 * max(1.0, float(np.abs(depth).max()))
    return (hit >= 0) & (hit != own) & (chart[hit] == chart) & above
