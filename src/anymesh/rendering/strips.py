"""Motions to choose from: the object at rest and with a part moved by each candidate, in one picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, UInt8
from PIL import Image, ImageDraw

from anymesh.rendering.axes import axis_line, draw_arrow, draw_ring, ring
from anymesh.rendering.labels import PAD, Plate, draw_plate, plate_size
from anymesh.rendering.paint import HIGHLIGHT, blend, lighten, rim
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import lit, shade
from anymesh.rendering.viewpoints import box_of, orbit_camera, zoom
from anymesh.types import Mesh, Motion, MotionKind
from anymesh.types.camera import Camera

PANEL, COLUMNS = 400, 4  # [px] of a panel; panels side by side: 1600 px at most
MARGIN = 0.35  # round what moves, a share of its diagonal: what it moves against is seen too
AIR = 0.04  # round that, a share of the picture on each side
LIGHTEN = 0.5  # of what stands still
GHOST = 0.3  # strength of the part where something hides it
AXIS_LEAST, RING = 3.0, 0.1  # what `axis_line` takes for a diagonal; radius of the ring: shares of the part's diagonal
LEGIBLE = 0.5  # of the picture's side: the axis of a smaller part is drawn as if it were so large
TITLE = 24  # [px] font
SKETCH = 80  # [px] of the pictures that the camera is chosen with
DEPTH = 0.02  # share of the diagonal from which a difference in depth counts
TURNS = {24: 1.0, 55: 0.75, -24: 0.4}  # elevations [deg]; how welcome they are: people know things from a little above
SIDES = {35: 1.0, -35: 1.0, 0: 0.65, 75: 0.9, -75: 0.9, 145: 0.8, -145: 0.8}  # azimuths [deg]; obliquely, all three sizes show

Rays = tuple[np.ndarray, np.ndarray]  # origins and directions, as of `Camera.rays`


def moved(mesh: Mesh, moving: Bool[np.ndarray, " F"], T: Float[np.ndarray, "4 4"]) -> Mesh:
    """The mesh with some faces moved; faces keep their numbers, vertices are no longer shared."""
    triangles = mesh.triangles.copy()
    triangles[moving] = triangles[moving] @ T[:3, :3].T + T[:3, 3]
    faces = np.arange(3 * len(triangles)).reshape(-1, 3)
    return replace(mesh, vertices=triangles.reshape(-1, 3), faces=faces, corner_normal=None)


@dataclass(frozen=True, eq=False)
class _Pose:
    """The object with a part somewhere, to cast rays at; corners: of the faces that move."""

    mesh: Mesh
    moving: Bool[np.ndarray, " F"]

    @cached_property
    def scene(self) -> RayScene:
        return RayScene(self.mesh.vertices, self.mesh.faces)

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        return self.mesh.triangles[self.moving].reshape(-1, 3)


def motion_strip(
    mesh: Mesh,
    moving: Bool[np.ndarray, " F"],
    motions: Sequence[tuple[Motion, float]],
    *,
    numbers: Sequence[int] | None = None,
    camera: Camera | None = None,
) -> UInt8[np.ndarray, "H W 3"]:
    """Panels in rows: the rest pose, then the part moved by each motion, with its axis and the outline of its rest pose.

    moving: the part's faces, and those of whatever it carries; motions: each with the amount [rad or m] that is shown;
    numbers: the panels' titles, 1, 2, ... if None; camera: `strip_camera` if None. Raises ValueError when nothing moves.
    """
    poses = _poses(mesh, moving, motions)
    camera = camera or _best_camera(poses, motions, PANEL)
    fine = replace(camera, width=2 * camera.width, height=2 * camera.height)
    rays = fine.rays()
    shape = silhouette(mesh.triangles[moving], fine, rays)
    panels = [_titled(_half(_painted(poses[0], rays, shape)), "rest")]
    for number, pose, (motion, amount) in zip(numbers or range(1, len(motions) + 1), poses[1:], motions, strict=True):
        picture = _painted(pose, rays, silhouette(pose.mesh.triangles[moving], fine, rays))
        picture = blend(picture, rim(shape, 2), (90, 90, 90), 0.7)
        panels.append(_titled(_half(_with_axis(picture, *_axis(poses[0].corners, motion, amount, fine), fine)), str(number)))
    return grid(panels)


def strip_camera(
    mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]], size: int = PANEL
) -> Camera:
    """The camera in which the least different two of the poses differ most; it frames what moves, in every pose."""
    return _best_camera(_poses(mesh, moving, motions), motions, size)


def _poses(mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]]) -> list[_Pose]:
    """The rest pose and the moved ones."""
    if not moving.any():
        raise ValueError("a motion needs faces that move, found none")
    return [_Pose(mesh, moving), *(_Pose(moved(mesh, moving, m.transform(amount)), moving) for m, amount in motions)]


def _painted(pose: _Pose, rays: Rays, shape: Bool[np.ndarray, "H W"]) -> UInt8[np.ndarray, "H W 3"]:
    """The picture of a pose. shape: the silhouette of what moves; where that is hidden, it shines through."""
    hits = pose.scene.first_hit(*rays)
    color, normal = shade(pose.mesh, hits, rays[1])
    seen = (hits.face >= 0) & pose.moving[hits.face]
    color = lighten(color, LIGHTEN)
    blue = np.tile(np.array(HIGHLIGHT, float), (int(seen.sum()), 1))
    color[seen] = lit(blue, normal[seen])
    return blend(color.reshape(*shape.shape, 3), shape & ~seen.reshape(shape.shape), HIGHLIGHT, GHOST)


def silhouette(triangles: Float[np.ndarray, "n 3 3"], camera: Camera, rays: Rays | None = None) -> Bool[np.ndarray, "H W"]:
    """The pixels that would show these triangles if nothing else were there. rays: the camera's, if they are at hand."""
    scene = RayScene(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    return (scene.first_hit(*(rays or camera.rays())).face >= 0).reshape(camera.height, camera.width)


def _axis(
    corners: Float[np.ndarray, "n 3"], motion: Motion, amount: float, camera: Camera
) -> tuple[Float[np.ndarray, "2 3"], Float[np.ndarray, "k 3"] | None]:
    """The arrow along the axis, the way that this motion goes, and the ring of a turn.

    Their size follows the part at rest, which has these corners, but they can be seen in this camera's picture.
    """
    depth = float(camera.project(corners.mean(0)[None])[1][0])
    size = max(float(np.linalg.norm(np.ptp(corners, axis=0))), LEGIBLE * 2 * depth * float(np.tan(camera.fov / 2)))
    axis, slides = (-motion.axis if amount < 0 else motion.axis), motion.kind is MotionKind.SLIDE
    ends, center = axis_line(corners, motion.origin, axis, slides, AXIS_LEAST * size)
    return ends, None if slides else ring(center, axis, RING * size)


def _with_axis(
    picture: UInt8[np.ndarray, "H W 3"], ends: Float[np.ndarray, "2 3"], circle: Float[np.ndarray, "k 3"] | None, camera: Camera
) -> UInt8[np.ndarray, "H W 3"]:
    drawn = Image.fromarray(picture)
    draw = ImageDraw.Draw(drawn)
    draw_arrow(draw, camera.project(ends)[0], scale=2.0)
    if circle is not None:
        draw_ring(draw, camera.project(circle)[0], scale=2.0)
    return np.asarray(drawn)


def _best_camera(poses: Sequence[_Pose], motions: Sequence[tuple[Motion, float]], size: int) -> Camera:
    total = _bounds([p.mesh.bounds for p in poses])
    focus = _bounds([np.stack([p.corners.min(0), p.corners.max(0)]) for p in poses])
    margin = MARGIN * float(np.linalg.norm(focus[1] - focus[0]))
    focus = np.stack([np.maximum(focus[0] - margin, total[0]), np.minimum(focus[1] + margin, total[1])])
    best, most = None, -1.0
    for azimuth, elevation in ((a, e) for e in TURNS for a in SIDES):
        far = orbit_camera(total, np.deg2rad(azimuth), np.deg2rad(elevation), SKETCH)
        near = _framed(far, _corners(focus))
        rays = near.rays()
        found = _difference([_depths(p, rays) for p in poses], DEPTH * poses[0].mesh.diagonal)
        found *= TURNS[elevation] * SIDES[azimuth]
        if best is None or found > most:
            best, most = near, found
    assert best is not None
    ends = [_axis(poses[0].corners, *m, best)[0] for m in motions]
    return _tightened(best, poses, np.concatenate([np.zeros((0, 3)), *ends]), size)


def _tightened(camera: Camera, poses: Sequence[_Pose], points: Float[np.ndarray, "n 3"], size: int) -> Camera:
    """Turned at what is in the picture in any pose, and at these points."""
    rays = camera.rays()
    seen = np.any([p.scene.first_hit(*rays).face >= 0 for p in poses], axis=0).reshape(camera.height, camera.width)
    box = box_of(seen) if seen.any() else np.array([0.0, 0, camera.width, camera.height])
    ends = camera.project(points)[0]
    low, high = np.minimum(box[:2], ends.min(0, initial=np.inf)), np.maximum(box[2:], ends.max(0, initial=-np.inf))
    return zoom(camera, np.concatenate([low, high]), AIR, size)


def _bounds(boxes: Sequence[np.ndarray]) -> Float[np.ndarray, "2 3"]:
    return np.stack([np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)])


def _corners(bounds: Float[np.ndarray, "2 3"]) -> Float[np.ndarray, "8 3"]:
    return np.stack(np.meshgrid(*bounds.T, indexing="ij"), -1).reshape(-1, 3)


def _framed(camera: Camera, points: Float[np.ndarray, "n 3"]) -> Camera:
    """Turned at some points, with a little air round them."""
    pixel = camera.project(points)[0]
    return zoom(camera, np.concatenate([pixel.min(0), pixel.max(0)]), AIR, camera.height)


def _depths(pose: _Pose, rays: Rays) -> Float[np.ndarray, " n"]:
    """Depth [m] where a picture shows what moves; inf elsewhere."""
    hits = pose.scene.first_hit(*rays)
    return np.where((hits.face >= 0) & pose.moving[hits.face], hits.distance, np.inf)


def _difference(depths: Sequence[Float[np.ndarray, " n"]], least: float) -> float:
    """How different poses look: the least and (weighed less) the mean share of pixels by which two of them differ.

    The rest pose, the first, should show what moves, too.
    """
    clipped = np.minimum(np.array(depths), 1e9)
    pairs = [(np.abs(a - b) > least).mean() for k, a in enumerate(clipped) for b in clipped[:k]]
    shown = np.isfinite(depths[0]).mean()
    return float(min(pairs, default=0.0) + 0.2 * np.mean(pairs or [0.0]) + 0.2 * shown)


def _half(picture: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h w 3"]:
    height, width = picture.shape[:2]
    return np.asarray(Image.fromarray(picture).resize((width // 2, height // 2), Image.Resampling.BOX))


def _titled(panel: UInt8[np.ndarray, "H W 3"], title: str) -> UInt8[np.ndarray, "H W 3"]:
    """The panel with its number in a corner, and a frame."""
    drawn = Image.fromarray(panel)
    draw = ImageDraw.Draw(drawn)
    draw.rectangle([0, 0, panel.shape[1] - 1, panel.shape[0] - 1], outline=(150, 150, 150))
    width, height = plate_size(title, TITLE)
    draw_plate(draw, Plate(title, (4, 4, 4 + width + 2 * PAD, 4 + height), (4 + PAD, 4 + PAD), TITLE), (20, 20, 20))
    return np.asarray(drawn)


def grid(panels: Sequence[UInt8[np.ndarray, "h w 3"]]) -> UInt8[np.ndarray, "H W 3"]:
    """Panels of one size in as few rows as `COLUMNS` allows, the rows as even as can be; empty cells are white."""
    rows = -(-len(panels) // COLUMNS)
    columns = -(-len(panels) // rows)
    cells = [*panels, *[np.full_like(panels[0], 255)] * (rows * columns - len(panels))]
    return np.concatenate([np.concatenate(cells[r * columns : (r + 1) * columns], 1) for r in range(rows)])
