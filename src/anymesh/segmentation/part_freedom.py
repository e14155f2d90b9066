"""Freedom of a part candidate in the object: what blocks a straight way, what it is exposed to, what is behind it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.config import ALONG_COSINE, FACING_COSINE, SegmentationConfig
from anymesh.motion.handle import outward_axis
from anymesh.motion.part_context import PartContext

STRIDE = 8  # every how many samples of the part a ray is cast
MIN_WAY = 0.03  # of the diagonal: minimum length of a way; otherwise it is as long as the part itself
MIN_AHEAD_COSINE = 0.2  # minimum cosine between a normal and a direction for surface that is ahead in this direction
BACK_RAYS = 7  # rays along each side of the back


def blocked_shares(around: PartContext, config: SegmentationConfig) -> dict[str, float]:
    """Return the share of the part's surface that meets the rest when it moves by its own extent, along its box axes.

    Surface that faces along the way counts, on sheets without an inside both sides.
    """
    samples, touch = around.part.samples, config.touch * around.diagonal
    points, normals = samples.points[::STRIDE], samples.normals[::STRIDE]
    solid = around.part.solid[samples.faces[::STRIDE]]

    def blocked(direction: Float[np.ndarray, " 3"], extent: float) -> float:
        facing = normals @ direction
        ahead = points[np.where(solid, facing, np.abs(facing)) > MIN_AHEAD_COSINE]
        if len(ahead) < 2:
            return 0.0
        way = max(extent, MIN_WAY * around.diagonal) + 2 * touch
        # start slightly inside, since a ray that starts on a surface would miss it
        hits = around.rest.scene.first_hit(ahead - 2 * touch * direction, np.repeat(way * direction[None], len(ahead), 0), 1.0)
        return float((hits.face >= 0).mean())

    axes, extents = around.body_obb.axes, 2 * around.body_obb.half
    sideways = [blocked(sign * axes[k], extents[k]) for k in around.face_axes for sign in (1.0, -1.0)]
    deep = extents[outward_axis(around.body_obb, around.opening_direction)]
    return {
        "blocked outward": blocked(around.opening_direction, deep),
        "blocked inward": blocked(-around.opening_direction, deep),
        "blocked sideways least": min(sideways),
        "blocked sideways most": max(sideways),
    }


def exposure(around: PartContext, config: SegmentationConfig) -> dict[str, float]:
    """Return which shares of the part's surface see the outside along their normal, face outward, and face up."""
    samples, touch = around.part.samples, config.touch * around.diagonal
    points, normals = samples.points, samples.normals
    start, rays = points[::STRIDE] + 2 * touch * normals[::STRIDE], 2 * around.diagonal * normals[::STRIDE]
    return {
        "exposed": float((around.rest.scene.first_hit(start, rays, 1.0).face < 0).mean()),
        "facing outward": float((normals @ around.opening_direction > FACING_COSINE).mean()),
        "facing up": float((normals[:, 2] > ALONG_COSINE).mean()),
    }


def space_behind(around: PartContext) -> dict[str, float]:
    """Return the median distance from the part's back to what is behind it, and the share behind which is nothing.

    The distance is relative to the diagonal, which also stands for nothing behind.
    """
    points = points_behind(around, BACK_RAYS)
    hits = around.rest.scene.first_hit(
        points, np.repeat(-around.diagonal * around.opening_direction[None], len(points), 0), 1.0
    )
    return {
        "space behind": float(np.median(np.where(hits.face >= 0, hits.distance, 1.0))),
        "nothing behind": float((hits.face < 0).mean()),
    }


def points_behind(around: PartContext, count: int) -> Float[np.ndarray, "n 3"]:
    """Return a grid of `count` points a side, just behind the back of the part's box [m]."""
    core, grid = around.body_obb, np.linspace(-0.85, 0.85, count)
    behind = core.half[outward_axis(core, around.opening_direction)] + 1e-4 * around.diagonal
    local = np.zeros((count**2, 3))
    for axis, value in zip(around.face_axes, np.meshgrid(grid, grid), strict=True):
        local[:, axis] = value.reshape(-1) * core.half[axis]
    return core.world(local) - behind * around.opening_direction
