"""Preview picture of a result: the object at rest and opened, small parts in close-up, joint axes and a legend."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.entry_points import TOGETHER, resolve
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import (
    Samples,
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
from anymesh.rendering.viewpoints import SKETCH, framed, orbit_camera
from anymesh.types import Asset, Joint, JointType, Mesh
from anymesh.types.camera import Camera
from anymesh.types.motion import extent

PALETTE = np.array(  # distinguishable with colour vision deficiencies (after Okabe and Ito, and lighter mixes)
    [[230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167],
     [130, 200, 120], [150, 120, 220], [120, 90, 60]], np.uint8)  # fmt: skip
PALETTE = np.concatenate([PALETTE, PALETTE * 0.55, PALETTE * 0.45 + 140]).astype(np.uint8)  # dark and light ones follow
BASE = np.array([200, 200, 200], np.uint8)
SIZE = 620  # [px] size of the camera's picture, from which the panels are cut
MARGIN, MIN_WIDTH, MIN_HEIGHT = 18, 500, 240  # [px] margin around the drawing; minimum size of a panel, so that the legend fits
OPEN = 0.75  # share of the range by which joints are opened
LIFT = 0.3  # share of the diagonal by which a part that lies loose is lifted in pictures
LETTERS = 19  # [px] font size of the legend
MAX_LEGEND_JOINTS = 30  # maximum number of joints in the legend
AZIMUTHS = (35, -35, 145, -145, 65, -65)  # [deg] candidate views, in order of preference
ELEVATION = 24  # [deg] elevation of all candidate views
PREFERRED = 1.05  # factor by which a later view must show more of the moving parts than an earlier one
SMALL_SHARE = 0.001  # of SIZE**2: a part of which the opened panel shows less gets a close-up; an estimate
MAX_INSETS, INSET_AIR = 6, 2.0  # number of close-ups; margin around the part on each side, as a share of its box
INSET_SHARE = 0.7  # of its pixels: other small parts of which a close-up shows as much need none of their own; an estimate
EDGE = (120, 120, 120)  # colour of the frame of a close-up
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
    at = opened_positions(asset)
    rest = _Pose(asset.mesh, axis_shapes(asset, {}))
    opened = _Pose(posed(asset, at), axis_shapes(asset, at)) if any(at.values()) else rest
    camera = best_camera(asset, opened.mesh, [rest.scene, opened.scene])
    window = _window(camera, [rest, opened])
    still = _sampled(asset, rest, camera, window)
    moved = still if opened is rest else _sampled(asset, opened, camera, window)
    panels = [draw(still, material_colors(asset.mesh, still), light_on(still), ground(*window.shape))]
    width = 3 * window.shape[1]
    small = dict(_moving(asset, axis_shapes(asset, at, 0.0)))
    insets, alone = _insets(asset, opened, small, camera, moved.first.face, width)
    for pose, samples in ((rest, still), (opened, moved)):
        axes = [axis for part, axis in _moving(asset, pose.axes) if part not in alone]
        panels.append(draw_axes(_colored(asset, samples), axes, camera, corner=(window.left, window.top)))
    return np.concatenate([np.concatenate(panels, 1), *insets, _legend(asset, width)])


def _moving(asset: Asset, axes: Sequence[AxisShape]) -> list[tuple[int, AxisShape]]:
    """Return the index of each part that moves, with its axis."""
    moving = [asset.segmentation.numbers[j.child] for j in asset.joints if j.type is not JointType.FIXED]
    return list(zip(moving, axes, strict=True))


def _sampled(asset: Asset, pose: _Pose, camera: Camera, window: Window) -> Samples:
    """Cast the rays of a window at a pose."""
    return sample(render_target(pose.mesh, pose.scene, asset.segmentation.face_part), camera, window)


def _colored(asset: Asset, samples: Samples) -> UInt8[np.ndarray, "h w 3"]:
    """Draw the parts in colours."""
    return draw(samples, face_colors(part_colors(asset), samples), light_on(samples), ground(*samples.window.shape))


def _insets(
    asset: Asset, pose: _Pose, axes: Mapping[int, AxisShape], camera: Camera, face: Int[np.ndarray, " n"], width: int
) -> tuple[list[UInt8[np.ndarray, "h w 3"]], set[int]]:
    """Return a row of close-ups of moving parts that the panel hardly shows, if there are any, and the parts in them.

    Each is shown from where it is seen best. axes: of each part that moves; face: face that each pixel of the panel shows.
    """
    parts, cells, size, least = asset.segmentation.face_part, [], width // MAX_INSETS, SMALL_SHARE * SIZE**2
    window = Window(0, 0, size, size)
    pixels = np.bincount(parts[face[face >= 0]], minlength=len(asset.segmentation.parts))
    small, done = {k for k in axes if pixels[k] < least}, set[int]()
    for part in sorted(small, key=lambda k: pixels[k]):
        if part in done or len(cells) == MAX_INSETS:
            continue
        corners = pose.mesh.triangles[parts == part].reshape(-1, 3)
        around = [orbit_camera(pose.mesh.bounds, np.deg2rad(a), np.deg2rad(ELEVATION), SKETCH) for a in AZIMUTHS]
        near = _clearest([framed(c, corners, INSET_AIR, SKETCH) for c in (camera, *around)], [pose.scene], parts == part)
        near = replace(near, width=size, height=size)
        samples = _sampled(asset, pose, near, window)
        shown = samples.first.face
        count = np.bincount(parts[shown[shown >= 0]], minlength=len(pixels))
        here = {k for k in small if k == part or count[k] >= INSET_SHARE * count[part]}
        done |= here
        cells.append(draw_axes(_colored(asset, samples), [axes[k] for k in here], near))
        cells[-1][[0, -1]] = cells[-1][:, [0, -1]] = EDGE
    blank = [np.full((size, width - size * len(cells), 3), 255, np.uint8)]
    return ([np.concatenate(cells + blank, 1)] if cells else []), done


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


def opened_positions(asset: Asset) -> Mapping[str, float]:
    """Return the positions of all joints in the opened panel; loops are closed."""
    at = {j.name: shown_position(j, asset.mesh.diagonal) for j in asset.joints}
    return resolve(TOGETHER)(asset, at) if asset.loops else at


def shown_position(joint: Joint, size: float = 1.0) -> float:
    """Return the position of a joint in the opened panel [rad or m]. size: the object's diagonal [m]."""
    if joint.type in (JointType.FIXED, JointType.FREE):
        return LIFT * size if joint.type is JointType.FREE else 0.0
    if joint.limits is None:
        return float(np.pi / 4)
    return OPEN * (joint.limits[1] if joint.limits[1] >= -joint.limits[0] else joint.limits[0])


def part_colors(asset: Asset) -> UInt8[np.ndarray, "F 3"]:
    """Return a colour per face according to its part; the base is light grey."""
    count = len(asset.segmentation.parts)
    table = np.concatenate([BASE[None], PALETTE[np.arange(max(count - 1, 0)) % len(PALETTE)]])
    return table[asset.segmentation.face_part]


def best_camera(asset: Asset, opened: Mesh, scenes: Sequence[RayScene]) -> Camera:
    """Choose the view that shows most of the moving parts, at rest and opened, from the answered front if there is one."""
    bounds = np.array([np.minimum(asset.mesh.bounds[0], opened.bounds[0]), np.maximum(asset.mesh.bounds[1], opened.bounds[1])])
    azimuths = AZIMUTHS if asset.front is None else [asset.front + a for a in AZIMUTHS if abs(a) < 90]
    around = [orbit_camera(bounds, np.deg2rad(a), np.deg2rad(ELEVATION), SKETCH) for a in azimuths]
    return replace(_clearest(around, scenes, asset.segmentation.face_part > 0), width=SIZE, height=SIZE)


def _clearest(cameras: Sequence[Camera], scenes: Sequence[RayScene], wanted: Bool[np.ndarray, " F"]) -> Camera:
    """Return the camera that shows most of the wanted faces; a later one only if it shows clearly more."""
    best, most = cameras[0], -1.0
    for camera in cameras:
        faces = [scene.first_hit(*camera.rays()).face for scene in scenes]
        seen = sum(int(wanted[face[face >= 0]].sum()) for face in faces)
        if seen > PREFERRED * most:
            best, most = camera, float(seen)
    return best


def opened_view(asset: Asset) -> tuple[Mesh, Camera]:
    """Return the mesh with its joints opened as in the preview, and the view that `best_camera` chooses."""
    opened = posed(asset, opened_positions(asset))
    return opened, best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])


def describe(joint: Joint, part: float) -> str:
    """Describe a joint in one line: type, range, confidence. part: confidence that its child is a part, 1 if that is given."""
    sure = f"confidence {joint.confidence:.2f}" if part == 1 else f"part {part:.2f}, joint {joint.confidence:.2f}"
    return f"{joint.child}: {f'{joint.type} {extent(joint)}'.strip()}, {sure}"


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
    number = asset.segmentation.numbers
    for k, line in enumerate(lines):
        x, y = 20 + (k % 3) * (width // 3), 10 + 30 * (k // 3)
        if k < len(asset.joints):
            color = PALETTE[(number[asset.joints[k].child] - 1) % len(PALETTE)]
            draw.rectangle([x, y + 3, x + 16, y + 19], fill=tuple(int(c) for c in color))
        draw.text((x + 24, y), line.encode("ascii", "replace").decode(), fill=(30, 30, 30), font=letters)
    return np.asarray(image)
