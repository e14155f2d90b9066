"""Preview picture of a result: the object at rest and opened, with parts in colours, joint axes and a legend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw

from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import (
    Window,
    draw,
    face_colors,
    ground,
    light_on,
    material_colors,
    render_target,
    sample,
    smoothed,
)
from anymesh.rendering.marks import AxisShape, axis_shapes, draw_axes, font
from anymesh.rendering.viewpoints import SKETCH, orbit_camera
from anymesh.types import Asset, Joint, JointType, Mesh
from anymesh.types.camera import Camera
from anymesh.types.motion import extent

PALETTE = np.array(  # distinguishable with colour vision deficiencies (after Okabe and Ito, and lighter mixes)
    [[230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167],
     [130, 200, 120], [150, 120, 220], [120, 90, 60]], np.uint8)  # fmt: skip
BASE = np.array([200, 200, 200], np.uint8)
SIZE = 620  # [px] size of the camera's picture, from which the panels are cut
MARGIN, MIN_WIDTH, MIN_HEIGHT = 18, 500, 240  # [px] margin around the drawing; minimum size of a panel, so that the legend fits
OPEN = 0.75  # share of the range by which joints are opened
LETTERS = 19  # [px] font size of the legend
MAX_LEGEND_JOINTS = 18  # maximum number of joints in the legend
AZIMUTHS = (35, -35, 145, -145, 65, -65)  # [deg] candidate views, in order of preference
ELEVATION = 24  # [deg] elevation of all candidate views
PREFERRED = 1.05  # factor by which a later view must show more of the moving parts than an earlier one
COMPRESSION = 3  # zlib level, 0..9: higher levels take twice the time for 7 % less


@dataclass(frozen=True, eq=False)
class _Pose:
    """The object with its joints at given positions."""

    mesh: Mesh
    axes: list[AxisShape]

    @cached_property
    def scene(self) -> RayScene:
        return RayScene(self.mesh.vertices, self.mesh.faces)


def write_preview(asset: Asset, path: Path) -> None:
    """Write the preview picture as PNG."""
    Image.fromarray(render_preview(asset)).save(path, "PNG", compress_level=COMPRESSION)


def write_legend(asset: Asset, path: Path) -> None:
    """Write a preview picture without drawings, only with the list of joints. It takes the same time for any mesh."""
    Image.fromarray(_legend(asset, 3 * MIN_WIDTH)).save(path, "PNG", compress_level=COMPRESSION)


def render_preview(asset: Asset) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the object with its materials, with coloured parts at rest, and opened, side by side; the legend is below."""
    asset = replace(asset, mesh=smoothed(asset.mesh))
    at = {j.name: shown_position(j) for j in asset.joints}
    rest = _Pose(asset.mesh, axis_shapes(asset, {}))
    opened = _Pose(posed(asset, at), axis_shapes(asset, at)) if any(at.values()) else rest
    camera = best_camera(asset, opened.mesh, [rest.scene, opened.scene])
    window = _window(camera, [rest, opened])
    colors, parts = part_colors(asset), asset.segmentation.face_part
    behind = ground(*window.shape)
    panels = []
    for pose in (rest, opened):
        samples = sample(render_target(pose.mesh, pose.scene, parts), camera, window)
        light = light_on(samples)
        if not panels:
            panels.append(draw(samples, material_colors(pose.mesh, samples), light, behind))
        picture = draw(samples, face_colors(colors, samples), light, behind)
        panels.append(draw_axes(picture, pose.axes, camera, corner=(window.left, window.top)))
    return np.concatenate([np.concatenate(panels, 1), _legend(asset, 3 * panels[0].shape[1])])


def _window(camera: Camera, poses: Sequence[_Pose]) -> Window:
    """Return the region of the camera's picture that contains all poses with their axes, and a margin."""
    boxes = [camera.project(points)[0] for pose in poses for points in (pose.mesh.vertices, *(a.points for a in pose.axes))]
    low, high = np.min([b.min(0) for b in boxes], 0), np.max([b.max(0) for b in boxes], 0)
    sides = []
    for k, least in enumerate((MIN_WIDTH, MIN_HEIGHT)):
        first, last = max(0, int(np.floor(low[k]))), min(SIZE, int(np.ceil(high[k])))
        spare = max(2 * MARGIN, least - (last - first))
        first = max(0, min(first - spare // 2, SIZE - (last - first) - spare))
        sides.append((first, min(SIZE, last + spare - spare // 2)))
    return Window(sides[0][0], sides[1][0], sides[0][1], sides[1][1])


def shown_position(joint: Joint) -> float:
    """Return the position of a joint in the opened panel [rad or m]."""
    if joint.type is JointType.FIXED:
        return 0.0
    if joint.limits is None:
        return float(np.pi / 4)
    return OPEN * (joint.limits[1] if joint.limits[1] >= -joint.limits[0] else joint.limits[0])


def part_colors(asset: Asset) -> UInt8[np.ndarray, "F 3"]:
    """Return a colour per face according to its part; the base is light grey."""
    count = len(asset.segmentation.parts)
    table = np.concatenate([BASE[None], PALETTE[np.arange(max(count - 1, 0)) % len(PALETTE)]])
    return table[asset.segmentation.face_part]


def best_camera(asset: Asset, opened: Mesh, scenes: Sequence[RayScene]) -> Camera:
    """Choose the view that shows most of the moving parts, at rest and opened together."""
    bounds = np.array([np.minimum(asset.mesh.bounds[0], opened.bounds[0]), np.maximum(asset.mesh.bounds[1], opened.bounds[1])])
    moving = asset.segmentation.face_part > 0
    best, most = AZIMUTHS[0], -1.0
    for azimuth in AZIMUTHS:
        small = orbit_camera(bounds, np.deg2rad(azimuth), np.deg2rad(ELEVATION), SKETCH)
        origins, directions = small.rays()
        faces = [scene.first_hit(origins, directions).face for scene in scenes]
        seen = sum(int(moving[face[face >= 0]].sum()) for face in faces)
        if seen > PREFERRED * most:
            best, most = azimuth, float(seen)
    return orbit_camera(bounds, np.deg2rad(best), np.deg2rad(ELEVATION), SIZE)


def opened_view(asset: Asset) -> tuple[Mesh, Camera]:
    """Return the mesh with its joints opened as in the preview, and the view that `best_camera` chooses."""
    opened = posed(asset, {j.name: shown_position(j) for j in asset.joints})
    return opened, best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])


def describe(joint: Joint, part: float) -> str:
    """Describe a joint in one line: type, range, confidence. part: confidence that its child is a part, 1 if that is given."""
    sure = f"confidence {joint.confidence:.2f}" if part == 1 else f"part {part:.2f}, joint {joint.confidence:.2f}"
    return f"{joint.child}: {joint.type.value} {extent(joint)}, {sure}"


def _legend(asset: Asset, width: int) -> UInt8[np.ndarray, "h W 3"]:
    letters = font(LETTERS)
    part = {p.name: p.confidence for p in asset.segmentation.parts}
    lines = [describe(j, part[j.child]) for j in asset.joints[:MAX_LEGEND_JOINTS]]
    if len(asset.joints) > MAX_LEGEND_JOINTS:
        lines.append(f"and {len(asset.joints) - MAX_LEGEND_JOINTS} more")
    rows = (max(len(lines), 1) + 2) // 3
    image = Image.new("RGB", (width, 20 + 30 * rows), (255, 255, 255))
    draw = ImageDraw.Draw(image)
    if not lines:
        draw.text((20, 10), "nothing moves", fill=(60, 60, 60), font=letters)
    number = {part.name: k for k, part in enumerate(asset.segmentation.parts)}
    for k, line in enumerate(lines):
        x, y = 20 + (k % 3) * (width // 3), 10 + 30 * (k // 3)
        if k < len(asset.joints):
            color = PALETTE[(number[asset.joints[k].child] - 1) % len(PALETTE)]
            draw.rectangle([x, y + 3, x + 16, y + 19], fill=tuple(int(c) for c in color))
        draw.text((x + 24, y), line.encode("ascii", "replace").decode(), fill=(30, 30, 30), font=letters)
    return np.asarray(image)
