"""Marks drawn over pictures: colours and masks, and joint axes.

A joint axis is an arrow along it, and a ring around it if the joint rotates.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, UInt8
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

from anymesh.geometry.kinematics import link_transforms
from anymesh.types import Asset, Brief, JointType
from anymesh.types.camera import Camera
from anymesh.types.motion import SLIDING
from anymesh.types.triangles import bounds_of, transformed

AXIS_COLOR = (190, 20, 40)
WHITE = (255, 255, 255)
RING_RADIUS = 0.04  # radius of the ring, as a share of the object's diagonal
# diagonals of a part, and the least share of the object's, that arrow and ring of a small part are sized by; estimates
SMALL_AXIS, MIN_AXIS = 10.0, 0.25
HEAD = 12  # [px] margin at scale 1 by which arrow heads and lines extend beyond their points
FINE = 3  # supersampling factor per side with which axes are drawn


def axis_line(
    points: Float[np.ndarray, "n 3"],
    origin: Float[np.ndarray, " 3"],
    axis: Float[np.ndarray, " 3"],
    slides: bool,
    diagonal: float,
) -> tuple[Float[np.ndarray, "2 3"], Float[np.ndarray, " 3"]]:
    """Return both ends of the arrow that shows the axis of a part with these points, and the centre of its ring.

    For a hinge, the arrow lies on its axis and is slightly longer than the part. For a slide, it starts at the centre of the
    part.
    diagonal: diagonal of the object [m].
    """
    along = (points - origin) @ axis
    reach = max(0.6 * float(np.ptp(along)), 0.06 * diagonal)
    start, end = (0.0, reach * 1.3) if slides else (-reach, reach)
    center = points.mean(0) if slides else origin + (along.max() + along.min()) / 2 * axis
    return np.stack([center + start * axis, center + end * axis]), center


def ring(center: Float[np.ndarray, " 3"], axis: Float[np.ndarray, " 3"], radius: float) -> Float[np.ndarray, "40 3"]:
    """Return three quarters of a circle about an axis, in the direction of positive rotation."""
    u = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    t = np.linspace(0, 1.5 * np.pi, 40)[:, None]
    return center + radius * (np.cos(t) * u + np.sin(t) * v)


def draw_arrow(
    draw: ImageDraw.ImageDraw, ends: Float[np.ndarray, "2 2"], color: tuple[int, int, int] = AXIS_COLOR, scale: float = 1.0
) -> None:
    """Draw an arrow with a white rim between two pixels; it is 3 px wide at `scale` 1."""
    (x0, y0), (x1, y1) = ends
    draw.line([x0, y0, x1, y1], fill=WHITE, width=round(6 * scale))
    draw.line([x0, y0, x1, y1], fill=color, width=round(3 * scale))
    length = float(np.hypot(x1 - x0, y1 - y0))
    if length > 4:
        dx, dy = scale * (x1 - x0) / length, scale * (y1 - y0) / length
        tip = [(x1 + 5 * dx, y1 + 5 * dy), (x1 - 9 * dx + 6 * dy, y1 - 9 * dy - 6 * dx),
               (x1 - 9 * dx - 6 * dy, y1 - 9 * dy + 6 * dx)]  # fmt: skip
        draw.polygon(tip, fill=color)


def draw_ring(draw: ImageDraw.ImageDraw, pixels: Float[np.ndarray, "n 2"], scale: float = 1.0) -> None:
    """Draw the projected points of `ring` as a curve that ends in an arrow head."""
    draw.line([tuple(p) for p in pixels], fill=WHITE, width=round(5 * scale), joint="curve")
    draw.line([tuple(p) for p in pixels], fill=AXIS_COLOR, width=round(2 * scale), joint="curve")
    draw_arrow(draw, pixels[[-4, -1]], scale=scale)


@dataclass(frozen=True, eq=False)
class AxisShape(Brief):
    """Geometry drawn for one joint [m].

    arrow: its two ends; ring: a curve about the axis, None if the joint does not rotate.
    """

    arrow: Float[np.ndarray, "2 3"]
    ring: Float[np.ndarray, "40 3"] | None

    @property
    def points(self) -> Float[np.ndarray, "n 3"]:
        """All points of the arrow and the ring."""
        return self.arrow if self.ring is None else np.concatenate([self.arrow, self.ring])


def axis_shapes(asset: Asset, positions: Mapping[str, float], least: float = MIN_AXIS) -> list[AxisShape]:
    """Return arrow and ring of every movable joint, placed in this pose, smaller for small parts. least: as MIN_AXIS."""
    transforms = link_transforms(asset, positions)
    number, whole = asset.segmentation.numbers, asset.mesh.diagonal
    shapes = []
    for joint in asset.joints:
        if joint.type is JointType.FIXED:
            continue
        corners = asset.mesh.triangles[asset.segmentation.face_part == number[joint.child]].reshape(-1, 3)
        slides, T = joint.type in SLIDING, transforms[joint.parent]
        size = min(max(SMALL_AXIS * float(np.linalg.norm(np.ptp(bounds_of(corners), axis=0))), least * whole), whole)
        ends, center = axis_line(corners, joint.origin, joint.axis, slides, size)
        circle = None if slides else transformed(ring(center, joint.axis, RING_RADIUS * size), T)
        shapes.append(AxisShape(transformed(ends, T), circle))
    return shapes


def draw_axes(
    image: UInt8[np.ndarray, "h w 3"],
    shapes: Sequence[AxisShape],
    camera: Camera,
    *,
    corner: tuple[int, int] = (0, 0),
    scale: float = 1.0,
) -> UInt8[np.ndarray, "h w 3"]:
    """Draw axes over the picture, with antialiasing.

    corner: x and y [px] of the picture's top left corner in the camera's picture; scale: factor of the line width.
    """
    if not shapes:
        return image
    height, width = image.shape[:2]
    lines = [
        (camera.project(s.arrow)[0] - corner, None if s.ring is None else camera.project(s.ring)[0] - corner) for s in shapes
    ]
    points = np.concatenate([p for pair in lines for p in pair if p is not None])
    reach = np.ceil(HEAD * scale)
    left, top = (int(v) for v in np.clip(points.min(0) - reach, 0, [width - 1, height - 1]))
    right, bottom = (int(v) for v in np.clip(points.max(0) + reach, [left + 1, top + 1], [width, height]))
    box = (slice(top, bottom), slice(left, right))
    fine = Image.fromarray(image[box]).resize(((right - left) * FINE, (bottom - top) * FINE), Image.Resampling.NEAREST)
    draw = ImageDraw.Draw(fine)
    for arrow, circle in lines:
        draw_arrow(draw, FINE * (arrow - [left, top]), scale=FINE * scale)
        if circle is not None:
            draw_ring(draw, FINE * (circle - [left, top]), scale=FINE * scale)
    drawn = image.copy()
    drawn[box] = np.asarray(fine.reduce(FINE))
    return drawn


Color = tuple[int, int, int]


def blend(
    image: UInt8[np.ndarray, "H W 3"], mask: Bool[np.ndarray, "H W"], color: Color, alpha: float
) -> UInt8[np.ndarray, "H W 3"]:
    """Return a copy with a colour blended over the mask. alpha: 0 leaves it unchanged, 1 is opaque."""
    mixed, chosen = image.copy(), np.flatnonzero(mask)
    pixels = mixed.reshape(-1, 3)
    pixels[chosen] = np.round((1 - alpha) * pixels[chosen] + alpha * np.array(color))
    return mixed


def lighten(image: UInt8[np.ndarray, "*n 3"], share: float) -> UInt8[np.ndarray, "*n 3"]:
    """Blend the image towards white; a share of 1 is white."""
    return np.round(255 - (1 - share) * (255 - image.astype(float))).astype(np.uint8)


def rim(mask: Bool[np.ndarray, "H W"], width: int) -> Bool[np.ndarray, "H W"]:
    """Return the pixels just outside a mask, up to `width` [px] from it."""
    return ndimage.binary_dilation(mask, np.ones((3, 3), bool), iterations=width) & ~mask if mask.any() else mask


@lru_cache(maxsize=16)
def font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """Return Pillow's built-in font, which is the same on every machine."""
    return ImageFont.load_default(size=size)
