"""The picture of a result: at rest and opened, parts in colours, joint axes drawn, a legend."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw, ImageFont

from anymesh.geometry.kinematics import posed
from anymesh.rendering.axes import draw_axes
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Asset, Joint, JointType, Mesh
from anymesh.types.camera import Camera

PALETTE = np.array(  # distinct for colour-blind eyes too (after Okabe and Ito, and lighter mixes)
    [[230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167],
     [130, 200, 120], [150, 120, 220], [120, 90, 60]], np.uint8)  # fmt: skip
BASE = np.array([200, 200, 200], np.uint8)
SIZE = 620  # [px] of a panel
MARGIN, LEAST_WIDTH, LEAST_HEIGHT = 18, 500, 240  # [px] round what is drawn; of a panel, so that the legend fits
OPEN = 0.75  # share of the range that is shown opened
MOST_NAMED = 18  # joints in the legend


def write_preview(asset: Asset, path: Path) -> None:
    """Writes the picture as PNG."""
    buffer = io.BytesIO()
    Image.fromarray(render_preview(asset)).save(buffer, "PNG", optimize=False)
    path.write_bytes(buffer.getvalue())


def render_preview(asset: Asset) -> UInt8[np.ndarray, "H W 3"]:
    """Panels: the object as it looks, its parts at rest, its parts opened; below them the legend."""
    opened = {j.name: shown_position(j) for j in asset.joints}
    colors = part_colors(asset)
    poses = [asset.mesh, posed(asset, opened)]
    scenes = [RayScene(m.vertices, m.faces) for m in poses]
    camera = best_camera(asset, poses[1], scenes)
    panels = []
    for k in range(3):
        pose = k // 2
        view = render(poses[pose], camera, face_color=None if k == 0 else colors, scene=scenes[pose])
        half = Image.fromarray(view.color).resize((SIZE, SIZE), Image.Resampling.BOX)
        if k > 0:
            draw_axes(ImageDraw.Draw(half), asset, opened if k == 2 else {}, camera, fine=2)
        panels.append(np.asarray(half))
    panels = _trimmed(panels)
    return np.concatenate([np.concatenate(panels, 1), _legend(asset, 3 * panels[0].shape[1])])


def _trimmed(panels: list[np.ndarray]) -> list[np.ndarray]:
    """The panels without the bands that are white in all of them, all of one size."""
    drawn = np.stack(panels) < 250
    bands = (drawn.any((0, 2, 3)), drawn.any((0, 1, 3)))
    found = []
    for band, least in zip(bands, (LEAST_HEIGHT, LEAST_WIDTH), strict=True):
        used = np.flatnonzero(band)
        first, last = (used[0], used[-1] + 1) if len(used) else (0, SIZE)
        spare = max(2 * MARGIN, least - (last - first))
        first = max(0, min(first - spare // 2, SIZE - (last - first) - spare))
        found.append(slice(first, min(SIZE, last + spare - spare // 2)))
    return [panel[found[0], found[1]] for panel in panels]


def shown_position(joint: Joint) -> float:
    """Where a joint is in the opened panel [rad or m]."""
    if joint.type is JointType.FIXED:
        return 0.0
    if joint.limits is None:
        return float(np.pi / 4)
    return OPEN * (joint.limits[1] if joint.limits[1] >= -joint.limits[0] else joint.limits[0])


def part_colors(asset: Asset) -> UInt8[np.ndarray, "F 3"]:
    """A colour a face by its part; the base is light grey."""
    count = len(asset.segmentation.parts)
    table = np.concatenate([BASE[None], PALETTE[np.arange(max(count - 1, 0)) % len(PALETTE)]])
    return table[asset.segmentation.face_part]


def best_camera(asset: Asset, opened: Mesh, scenes: list[RayScene]) -> Camera:
    """The view in which the moving parts show most, at rest and opened alike."""
    bounds = np.array([np.minimum(asset.mesh.bounds[0], opened.bounds[0]), np.maximum(asset.mesh.bounds[1], opened.bounds[1])])
    moving = asset.segmentation.face_part > 0
    best, most = orbit_camera(bounds, np.deg2rad(35), np.deg2rad(24), 2 * SIZE), -1.0
    for azimuth in (35, -35, 145, -145, 90, -90):
        small = orbit_camera(bounds, np.deg2rad(azimuth), np.deg2rad(24), 96)
        origins, directions = small.rays()
        seen = 0
        for scene in scenes:
            face = scene.first_hit(origins, directions).face
            seen += int(moving[face[face >= 0]].sum())
        if seen > 1.05 * most:
            best, most = orbit_camera(bounds, np.deg2rad(azimuth), np.deg2rad(24), 2 * SIZE), float(seen)
    return best


def extent(joint: Joint) -> str:
    """The range of a joint in degrees or centimetres."""
    if joint.limits is None:
        return "" if joint.type is JointType.FIXED else "endless"
    if joint.type is JointType.PRISMATIC:
        return f"{100 * joint.limits[0]:.1f}..{100 * joint.limits[1]:.1f} cm"
    return f"{np.degrees(joint.limits[0]):.0f}..{np.degrees(joint.limits[1]):.0f} deg"


def describe(joint: Joint) -> str:
    """A joint in a line: type, range, confidence."""
    return f"{joint.child}: {joint.type.value} {extent(joint)}, confidence {joint.confidence:.2f}"


def _legend(asset: Asset, width: int) -> UInt8[np.ndarray, "h W 3"]:
    font = ImageFont.load_default(size=19)
    lines = [describe(j) for j in asset.joints[:MOST_NAMED]]
    if len(asset.joints) > MOST_NAMED:
        lines.append(f"and {len(asset.joints) - MOST_NAMED} more")
    rows = (max(len(lines), 1) + 2) // 3
    image = Image.new("RGB", (width, 20 + 30 * rows), (255, 255, 255))
    draw = ImageDraw.Draw(image)
    if not lines:
        draw.text((20, 10), "nothing moves", fill=(60, 60, 60), font=font)
    for k, line in enumerate(lines):
        x, y = 20 + (k % 3) * (width // 3), 10 + 30 * (k // 3)
        if k < len(asset.joints):
            draw.rectangle([x, y + 3, x + 16, y + 19], fill=tuple(int(c) for c in PALETTE[k % len(PALETTE)]))
        draw.text((x + 24, y), line.encode("ascii", "replace").decode(), fill=(30, 30, 30), font=font)
    return np.asarray(image)
