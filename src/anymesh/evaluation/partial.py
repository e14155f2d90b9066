"""Surface visible in one depth image: pixels become points, and neighbouring pixels of one surface are connected."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.rendering.render import View
from anymesh.types import Mesh, Node

# maximum depth difference of neighbours, in pixel widths at that depth, unless the surface continues at the same slant
STEEP = 6.0


def visible_surface(view: View, part: Int[np.ndarray, "H W"]) -> tuple[Mesh, Int[np.ndarray, " F"]]:
    """Return the surface visible in a picture, with its colours, and the part of each face.

    part: per pixel, -1 where nothing is visible. Faces connect pixels of one part only, face the camera, and do not span jumps
    in depth. Raise ValueError if no three pixels can be connected.
    """
    origins, directions = view.camera.rays()
    depth = view.depth.reshape(-1)
    seen = np.isfinite(depth)
    points = origins + np.where(seen, depth, 0.0)[:, None] * directions
    corners = _triangles(view, part)
    if not len(corners):
        raise ValueError("a surface needs three neighbouring pixels of one part, found none")
    used, faces = np.unique(corners, return_inverse=True)
    color = np.concatenate([view.color.reshape(-1, 3), np.full((view.color.size // 3, 1), 255, np.uint8)], 1)
    mesh = Mesh(
        vertices=points[used],
        faces=faces.reshape(-1, 3),
        face_node=np.zeros(len(corners), np.int64),
        nodes=(Node("view"),),
        face_material=np.full(len(corners), -1),
        corner_color=color[corners],
    )
    return mesh, part.reshape(-1)[corners[:, 0]].astype(np.int64)


def _triangles(view: View, part: np.ndarray) -> Int[np.ndarray, "F 3"]:
    """Return the pixel indices of every face.

    Each square of four neighbours is cut along the diagonal that keeps more of it.
    """
    z, focal = view.depth, view.camera.focal
    across, down = joined(z, part, focal), joined(z.T, part.T, focal).T
    number = np.arange(z.size).reshape(z.shape)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
    top, bottom, left, right = across[:-1], across[1:], down[:, :-1], down[:, 1:]
    falling = [(left & bottom, (a, c, d)), (top & right, (a, d, b))]
    rising = [(top & left, (a, c, b)), (bottom & right, (b, c, d))]
    kept = [sum(whole.astype(int) for whole, _ in cut) for cut in (falling, rising)]
    with np.errstate(invalid="ignore"):
        flat = np.abs(z[:-1, :-1] - z[1:, 1:]) <= np.abs(z[:-1, 1:] - z[1:, :-1])
    first = (kept[0] > kept[1]) | ((kept[0] == kept[1]) & flat)
    cuts = [(whole & first, t) for whole, t in falling] + [(whole & ~first, t) for whole, t in rising]
    return np.concatenate([np.stack([corner[whole] for corner in t], 1) for whole, t in cuts])


def joined(z: Float[np.ndarray, "H W"], part: Int[np.ndarray, "H W"], focal: float) -> Bool[np.ndarray, "H w"]:
    """Return whether each pixel and its right neighbour show the same surface: the same part, without a jump in depth.

    The inverse depth of a plane is linear in the picture, so that a plane at any slant continues.
    """
    with np.errstate(invalid="ignore"):
        step = np.abs(np.diff(z, axis=1))
        width = np.minimum(z[:, :-1], z[:, 1:]) / focal
        near = step <= STEEP * width
        bend = np.abs(np.diff(1 / z, 2, axis=1)) * z[:, 1:-1] ** 2 <= z[:, 1:-1] / focal
    bend &= np.isfinite(z[:, :-2]) & np.isfinite(z[:, 1:-1]) & np.isfinite(z[:, 2:])
    same = part[:, 1:] == part[:, :-1]
    of_one = bend & same[:, 1:] & same[:, :-1]
    goes_on = np.zeros_like(near)
    goes_on[:, 1:] |= of_one  # with the previous one
    goes_on[:, :-1] |= of_one  # with the next one
    return (part[:, 1:] >= 0) & same & (near | goes_on)
