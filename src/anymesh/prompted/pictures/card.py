"""A picture that identifies a part: the whole object with the part highlighted, and a close-up if it is small."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.config import REFERENCE_PX, ViewsConfig
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.marks import HIGHLIGHT, font, highlight
from anymesh.rendering.render import View
from anymesh.rendering.strips import silhouette
from anymesh.rendering.viewpoints import best_view, close_up, hidden_points, part_pixels, visible_pixels
from anymesh.types import Mesh

TITLE = 22  # [px] font size in a picture of 640 px
BAR = 34  # [px] height of the title bar
WELL = 0.5  # minimum share of the part's pixels in its best view, for a view to be considered
CONTACT_POINTS = 300  # maximum number of contact points checked in each view
UNDER = 0.02  # share of the contact's extent: points deeper than this below a surface count as hidden


def part_card(
    mesh: Mesh,
    view: View,
    face_part: Int[np.ndarray, " F"],
    part: int,
    title: str,
    config: ViewsConfig,
    scene: RayScene,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the part in a view of this mesh, the close-up (if any) beside it, and the title above.

    scene: the mesh's rays. A hidden part is drawn through what covers it, and the title says so.
    """
    mask = part_pixels(view, face_part, part)
    if not mask.any():
        mask = silhouette(mesh.triangles[face_part == part], view.camera)
        return titled(highlight(view.color, mask), f"{title} (hidden inside)")
    near = close_up(mesh, view, face_part, part, config, scene)
    whole = highlight(view.color, mask)
    if near is None:
        return titled(whole, title)
    close = highlight(near.color, part_pixels(near, face_part, part), alpha=0.2)
    return titled(np.concatenate([_framed(whole, view, near), _edged(close)], 1), title)


def card_view(
    views: Sequence[View],
    face_part: Int[np.ndarray, " F"],
    part: int,
    scene: RayScene,
    contact: Float[np.ndarray, "c 3"] | None = None,
) -> View:
    """Return the view that shows most of the contact, among those that show the part well.

    contact: points where the part meets the rest [m]; without them, the view that shows most of the part is used.
    """
    if contact is None or len(contact) == 0:
        return views[best_view(views, face_part, part)]
    few = contact[:: max(1, len(contact) // CONTACT_POINTS)]
    pixels = np.array([visible_pixels(v, face_part, part) for v in views])
    depth = UNDER * float(np.linalg.norm(np.ptp(contact, axis=0)))
    seen = np.array([(~hidden_points(scene, v.camera, few, depth)).mean() for v in views])
    return views[int(np.where(pixels >= WELL * pixels.max(), pixels / max(pixels.max(), 1) + seen, -1.0).argmax())]


def _framed(image: UInt8[np.ndarray, "H W 3"], view: View, near: View) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a frame in the picture of the whole object around the region of the close-up."""
    size = near.camera.width
    corners = np.array([[0, 0], [size, 0], [size, size], [0, size]]) - size / 2
    T = near.camera.T_world_camera
    rays = np.concatenate([corners / near.camera.focal, np.ones((4, 1))], 1) @ T[:3, :3].T
    pixels = view.camera.project(T[:3, 3] + rays)[0]
    drawn = Image.fromarray(image)
    outline = [tuple(p) for p in (*pixels, pixels[0])]
    draw = ImageDraw.Draw(drawn)
    draw.line(outline, fill=(255, 255, 255), width=5)
    draw.line(outline, fill=(20, 20, 20), width=2)
    return np.asarray(drawn)


def _edged(image: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "H W 3"]:
    drawn = Image.fromarray(image)
    ImageDraw.Draw(drawn).rectangle([0, 0, image.shape[1] - 1, image.shape[0] - 1], outline=(20, 20, 20), width=2)
    return np.asarray(drawn)


def titled(image: UInt8[np.ndarray, "H W 3"], title: str) -> UInt8[np.ndarray, "h W 3"]:
    """Put a bar with a title above the picture; characters that the font lacks become question marks."""
    scale = max(1.0, image.shape[0] / REFERENCE_PX)
    bar = Image.new("RGB", (image.shape[1], round(BAR * scale)), (255, 255, 255))
    text = title.encode("ascii", "replace").decode()
    draw = ImageDraw.Draw(bar)
    draw.rectangle([0, 0, round(10 * scale), bar.height], fill=HIGHLIGHT)
    draw.text((20 * scale, bar.height / 2), text, fill=(20, 20, 20), font=font(round(TITLE * scale)), anchor="lm")
    return np.concatenate([np.asarray(bar), image])
