"""Freedom of a part candidate in the object: what blocks a straight way, what it is exposed to, what is behind it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import ALONG_COSINE, FACING_COSINE, SegmentationConfig
from anymesh.motion.handle import outward_axis
from anymesh.motion.part_context import PartContext

STRIDE = 8  # every how many samples of the part a ray is cast
MIN_WAY = 0.03  # of the diagonal: minimum length of a way; otherwise it is as long as the part itself
MIN_AHEAD_COSINE = 0.2  # minimum cosine between a normal and a direction for surface that is ahead in this direction
BACK_RAYS = 9  # rays along each side of the back
UP = np.array([0.0, 0.0, 1.0])


def blocked_shares(context: PartContext, config: SegmentationConfig) -> dict[str, float]:
    """Return the share of the part's surface that meets the rest when it moves by its own extent, along its box axes.

    Surface that faces along the way counts, on sheets without an inside both sides.
    """
    points, touch = context.part.samples.points[::STRIDE], config.touch * context.diagonal
    axes, extents, opening = context.body_obb.axes, 2 * context.body_obb.half, context.opening_direction
    deep = extents[outward_axis(context.body_obb, opening)]
    ways = [(opening, deep), (-opening, deep), *((sign * axes[k], extents[k]) for k in context.face_axes for sign in (1, -1))]
    starts, rays = list[np.ndarray](), list[np.ndarray]()
    for direction, extent in ways:
        ahead = points[context.facing(direction)[::STRIDE] > MIN_AHEAD_COSINE]
        # start slightly inside, since a ray that starts on a surface would miss it
        starts.append(ahead - 2 * touch * direction)
        rays.append(np.repeat((max(extent, MIN_WAY * context.diagonal) + 2 * touch) * direction[None], len(ahead), 0))
    met = context.rest.scene.first_hit(np.concatenate(starts), np.concatenate(rays), 1.0).face >= 0
    parts = np.split(met, np.cumsum([len(some) for some in starts])[:-1])
    outward, inward, *sideways = (float(some.mean()) if len(some) > 1 else 0.0 for some in parts)
    return {
        "blocked outward": outward,
        "blocked inward": inward,
        "blocked sideways least": min(sideways),
        "blocked sideways most": max(sideways),
    }


def exposure(context: PartContext, config: SegmentationConfig) -> dict[str, float]:
    """Return which shares of the part's surface see the outside along their normal, face outward, and face up.

    Open sheets count with either side.
    """
    samples, off = (
        context.part.samples.take(np.arange(0, len(context.part.samples), STRIDE)),
        2 * config.touch * context.diagonal,
    )
    sheet = ~context.part.solid[samples.faces]

    def sees(points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, " n"]:
        return context.rest.scene.first_hit(points + off * normals, 2 * context.diagonal * normals, 1.0).face < 0

    exposed = sees(samples.points, samples.normals)
    exposed[sheet] |= sees(samples.points[sheet], -samples.normals[sheet])
    return {
        "exposed": float(exposed.mean()),
        "facing outward": float((context.facing(context.opening_direction) > FACING_COSINE).mean()),
        "facing up": float((context.facing(UP) > ALONG_COSINE).mean()),
    }


def space_behind(context: PartContext) -> dict[str, float]:
    """Return what is behind the part's back.

    "space behind": median distance to it relative to the diagonal, which also stands for nothing; "nothing behind": share with
    nothing behind; "open behind": share with an opening, free for three thicknesses and at least MIN_WAY.
    """
    points, direction = points_behind(context, BACK_RAYS), context.opening_direction
    hits = context.rest.scene.first_hit(points, np.repeat(-context.diagonal * direction[None], len(points), 0), 1.0)
    nothing, face = hits.face < 0, np.maximum(hits.face, 0)
    inside = ~nothing & context.rest.solid[face] & (context.rest.normals[face] @ direction < 0)
    thick = 2 * context.body_obb.half[outward_axis(context.body_obb, direction)] / context.diagonal
    return {
        "space behind": float(np.median(np.where(nothing, 1.0, hits.distance))),
        "nothing behind": float(nothing.mean()),
        "open behind": float((nothing | ~inside & (hits.distance > max(3 * thick, MIN_WAY))).mean()),
    }


def points_behind(context: PartContext, count: int) -> Float[np.ndarray, "n 3"]:
    """Return a grid of `count` points a side, just behind the back of the part's box [m]."""
    core, grid = context.body_obb, np.linspace(-0.85, 0.85, count)
    behind = core.half[outward_axis(core, context.opening_direction)] + 1e-4 * context.diagonal
    local = np.zeros((count**2, 3))
    for axis, value in zip(context.face_axes, np.meshgrid(grid, grid), strict=True):
        local[:, axis] = value.reshape(-1) * core.half[axis]
    return core.world(local) - behind * context.opening_direction
