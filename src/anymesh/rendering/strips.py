"""Candidate motions in one picture: the object at rest, and with a part moved by each candidate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, UInt8
from PIL import Image, ImageDraw

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.axes import draw_arrow, draw_ring
from anymesh.rendering.labels import PAD, Plate, draw_plate, plate_size
from anymesh.rendering.paint import HIGHLIGHT, blend, rim
from anymesh.rendering.posed import PartPixels, Rays, Still, part_color
from anymesh.rendering.strip_camera import PANEL, best_camera, motion_axis, strip_poses
from anymesh.types import JointType, Mesh, Motion
from anymesh.types.camera import Camera

COLUMNS = 4  # number of panels side by side (1600 px at most)
GHOST = 0.3  # opacity of the part where it is hidden
TITLE, WORD = 24, 18  # [px] font size of a panel's number, and of its motion label
WHITE, BLOCKED = (255, 255, 255), (250, 200, 120)  # background of the motion label, and of that of a blocked motion
STILL_LINE, PART_LINE, LINE = (120, 120, 120), (8, 30, 90), 0.55  # colours of lines along creases, and their opacity
CREASE = 0.82  # cosine (of 35 degrees) between normals below which a line is drawn


def moved(mesh: Mesh, moving: Bool[np.ndarray, " F"], T: Float[np.ndarray, "4 4"]) -> Mesh:
    """Return the mesh with some faces moved. Faces keep their indices; vertices are no longer shared."""
    triangles = mesh.triangles.copy()
    triangles[moving] = triangles[moving] @ T[:3, :3].T + T[:3, 3]
    faces = np.arange(3 * len(triangles)).reshape(-1, 3)
    return replace(mesh, vertices=triangles.reshape(-1, 3), faces=faces, corner_normal=None)


def motion_strip(
    mesh: Mesh,
    moving: Bool[np.ndarray, " F"],
    motions: Sequence[tuple[Motion, float]],
    *,
    numbers: Sequence[int] | None = None,
    blocked: Sequence[bool] = (),
    camera: Camera | None = None,
    scene: RayScene | None = None,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw panels in rows: the rest pose, then each motion with its axis and the outline of the rest pose.

    moving: faces of the part and of everything it carries; motions: each with the amount [rad or m] that is shown;
    numbers: titles of the panels, 1, 2, ... if None; blocked: motions that are labelled as blocked; camera: `strip_camera` if
    None;
    scene: the mesh's ray scene, if it already exists. Raise ValueError if nothing moves.
    """
    posed, poses = strip_poses(mesh, moving, motions, scene)
    camera = camera or best_camera(posed, poses, motions, PANEL)
    fine = replace(camera, width=2 * camera.width, height=2 * camera.height)
    rays = fine.rays()
    still = posed.still_picture(rays)
    shape = (fine.height, fine.width)
    lines = _lines(still.distance.reshape(shape), still.normal.reshape(*shape, 3), np.zeros(shape, bool))
    rest = posed.part_pixels(poses[0], fine)
    panels = [_titled(_half(_painted(still, lines, rest)), "rest")]
    covered = np.zeros(shape, bool)
    covered.reshape(-1)[rest.pixel] = True
    outline = rim(covered, 2)
    names = numbers or range(1, len(motions) + 1)
    for k, (number, (motion, amount)) in enumerate(zip(names, motions, strict=True)):
        picture = _painted(still, lines, posed.part_pixels(poses[k + 1], fine))
        picture = blend(picture, outline, (90, 90, 90), 0.7)
        drawn = _with_axis(picture, *motion_axis(posed.corners, motion, amount, fine), fine)
        word = "slides" if motion.kind is JointType.PRISMATIC else "turns"
        panels.append(_titled(_half(drawn), str(number), f"{word}, blocked" if k < len(blocked) and blocked[k] else word))
    return grid(panels)


def _painted(still: Still, lines: Bool[np.ndarray, "H W"], part: PartPixels) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a pose with lines along creases and borders; the part is blended over what hides it.

    lines: those of the static faces.
    """
    shape = lines.shape
    before = part.distance < still.distance[part.pixel]
    color, seen, drawn = still.color.copy(), np.zeros(len(still.distance), bool), lines.copy()
    color[part.pixel[before]] = part_color(part.normal[before])
    seen[part.pixel[before]] = True
    visible = seen.reshape(shape)
    if len(part.pixel):
        rows, columns = np.divmod(part.pixel, shape[1])
        box = (slice(max(rows.min() - 1, 0), rows.max() + 2), slice(max(columns.min() - 1, 0), columns.max() + 2))
        depth, facing = still.distance.reshape(shape)[box].copy(), still.normal.reshape(*shape, 3)[box].copy()
        at = rows[before] - box[0].start, columns[before] - box[1].start
        depth[at], facing[at] = part.distance[before], part.normal[before]
        drawn[box] = _lines(depth, facing, visible[box])
    picture = blend(color.reshape(*shape, 3), drawn & ~visible, STILL_LINE, LINE)
    picture = blend(picture, drawn & visible, PART_LINE, LINE)
    hidden = np.zeros(len(seen), bool)
    hidden[part.pixel[~before]] = True
    return blend(picture, hidden.reshape(shape), HIGHLIGHT, GHOST)


def _lines(
    depth: Float[np.ndarray, "H W"], normal: Float[np.ndarray, "H W 3"], seen: Bool[np.ndarray, "H W"]
) -> Bool[np.ndarray, "H W"]:
    """Mark pixels whose right or lower neighbour is background, another part, or differs sharply in its normal."""
    mask = np.zeros(depth.shape, bool)
    for axis in (0, 1):
        before, after = ((slice(None),) * axis + (s,) for s in (slice(None, -1), slice(1, None)))
        bends = np.einsum("hwc,hwc->hw", normal[before], normal[after]) < CREASE
        ends = np.isfinite(depth[before]) != np.isfinite(depth[after])
        both = np.isfinite(depth[before]) & np.isfinite(depth[after])
        mask[before] |= (bends & both) | ends | (seen[before] != seen[after])
    return mask


def silhouette(triangles: Float[np.ndarray, "n 3 3"], camera: Camera, rays: Rays | None = None) -> Bool[np.ndarray, "H W"]:
    """Return the pixels that would show these triangles alone. rays: the camera's, if already computed."""
    scene = RayScene(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    return (scene.first_hit(*(rays or camera.rays())).face >= 0).reshape(camera.height, camera.width)


def _with_axis(
    picture: UInt8[np.ndarray, "H W 3"], ends: Float[np.ndarray, "2 3"], circle: Float[np.ndarray, "k 3"] | None, camera: Camera
) -> UInt8[np.ndarray, "H W 3"]:
    drawn = Image.fromarray(picture)
    draw = ImageDraw.Draw(drawn)
    draw_arrow(draw, camera.project(ends)[0], scale=2.0)
    if circle is not None:
        draw_ring(draw, camera.project(circle)[0], scale=2.0)
    return np.asarray(drawn)


def _half(picture: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h w 3"]:
    height, width = picture.shape[:2]
    return np.asarray(Image.fromarray(picture).resize((width // 2, height // 2), Image.Resampling.BOX))


def _titled(panel: UInt8[np.ndarray, "H W 3"], title: str, word: str = "") -> UInt8[np.ndarray, "H W 3"]:
    """Draw the panel's number in a corner, its motion label beside it, and a frame."""
    drawn = Image.fromarray(panel)
    draw = ImageDraw.Draw(drawn)
    draw.rectangle([0, 0, panel.shape[1] - 1, panel.shape[0] - 1], outline=(150, 150, 150))
    width, height = plate_size(title, TITLE)
    draw_plate(draw, Plate(title, (4, 4, 4 + width + 2 * PAD, 4 + height), (4 + PAD, 4 + PAD), TITLE), (20, 20, 20))
    if word:
        wide, high = plate_size(word, WORD)
        left = 12 + width + 2 * PAD
        plate = Plate(word, (left, 4, left + wide + 2 * PAD, 4 + high), (left + PAD, 4 + PAD), WORD)
        draw_plate(draw, plate, BLOCKED if "blocked" in word else WHITE)
    return np.asarray(drawn)


def grid(panels: Sequence[UInt8[np.ndarray, "h w 3"]]) -> UInt8[np.ndarray, "H W 3"]:
    """Arrange panels of one size in at most `COLUMNS` columns, with rows as even as possible; empty cells are white."""
    rows = -(-len(panels) // COLUMNS)
    columns = -(-len(panels) // rows)
    cells = [*panels, *[np.full_like(panels[0], 255)] * (rows * columns - len(panels))]
    return np.concatenate([np.concatenate(cells[r * columns : (r + 1) * columns], 1) for r in range(rows)])
