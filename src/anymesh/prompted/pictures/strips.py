"""Candidate motions in one picture: the object at rest, and with a part moved by each candidate.

The part is drawn in many poses without rebuilding the ray scene: rays are transformed instead of the part. The camera is the
one in which the poses differ most.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.geometry.raycast_ import Hits, RayScene
from anymesh.prompted.pictures.drawing import HIGHLIGHT
from anymesh.prompted.pictures.plates import PAD, Plate, broken, draw_plate, plate_size
from anymesh.prompted.pictures.sides import ANYWHERE, SeenFrom, emptiest_corner, in_corner, with_compass
from anymesh.prompted.pictures.views import box_of, is_beside
from anymesh.rendering.marks import WHITE, axis_line, blend, draw_arrow, draw_ring, lighten, rim, ring
from anymesh.rendering.render import lit, shade, turned
from anymesh.rendering.viewpoints import SKETCH, away, framed, orbit_camera, zoom
from anymesh.types import Brief, JointType, Mesh, Motion
from anymesh.types.camera import Camera
from anymesh.types.triangles import bounds_of, box_corners, transformed, unshared

PANEL, SMALL_PANEL = 400, 320  # [px] size of a panel, and of one of many
FEW_PANELS = 8  # two rows of four; more are three rows of five
MARGIN = 0.35  # margin around the moving part, as a share of its diagonal, so that its neighbours are visible
AIR = 0.04  # further margin on each side, as a share of the picture
AXIS_SCALE, RING = 3.0, 0.1  # shares of the part's diagonal: diagonal passed to `axis_line`; radius of the ring
LEGIBLE = 0.5  # minimum size of the axis, as a share of the picture's side
DEPTH = 0.02  # share of the diagonal above which a difference in depth counts
# elevations and azimuths [deg] with their weights: people see objects from slightly above; oblique views show three dimensions
ELEVATION_WEIGHTS = {24: 1.0, 55: 0.75, -24: 0.4}
AZIMUTH_WEIGHTS = {35: 1.0, -35: 1.0, 0: 0.65, 75: 0.9, -75: 0.9, 145: 0.8, -145: 0.8}
# azimuth [deg] from which a camera is behind the front that was answered, and the weight of such views; an estimate
BEHIND_DEG, BEHIND_WEIGHT = 90, 0.5
LIGHTEN = 0.5  # share by which the colours of static faces are moved towards white
BOX_MARGIN = 2.0  # [px] margin around the part's box within which rays are cast
ONWARD = 1e-5  # share of the diagonal by which a ray continues behind a moving face
MAX_LAYERS = 24  # maximum number of moving faces that a ray passes before it counts as lost
GHOST = 0.3  # opacity of the part where it is hidden
TITLE, WORD, SMALL_WORD = 24, 15, 12  # [px] font size of a panel's number, of its motion's words, and of these in a small one
BLOCKED = (250, 200, 120)  # background of the label of a blocked motion
STILL_LINE, PART_LINE, LINE = (120, 120, 120), (8, 30, 90), 0.55  # colours of lines along creases, and their opacity
ARROW = 1000  # weight of a pixel of an arrow against one of the part, for the place of the compass
CREASE = 0.82  # cosine (of 35 degrees) between normals below which a line is drawn


def moved(mesh: Mesh, moving: Bool[np.ndarray, " F"], T: Float[np.ndarray, "4 4"]) -> Mesh:
    """Return the mesh with some faces moved. Faces keep their indices; vertices are no longer shared."""
    triangles = mesh.triangles.copy()
    triangles[moving] = transformed(triangles[moving], T)
    vertices, faces = unshared(triangles)
    return replace(mesh, vertices=vertices, faces=faces, corner_normal=None)


def motion_strip(
    mesh: Mesh,
    moving: Bool[np.ndarray, " F"],
    motions: Sequence[tuple[Motion, float]],
    *,
    words: Sequence[str] = (),
    camera: Camera | None = None,
    scene: RayScene | None = None,
    seen_from: SeenFrom = ANYWHERE,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw panels in rows: the rest pose, then each motion with its axis and the outline of the rest pose.

    Each panel has a compass. moving: faces of the part and of everything it carries; motions: each with the amount [rad or m]
    that is shown; words: beside their numbers, by default whether they turn or slide; camera: `strip_camera` if None; scene:
    the mesh's ray scene, if it already exists. Raise ValueError if nothing moves.
    """
    posed, poses = strip_poses(mesh, moving, motions, scene)
    camera = camera or best_camera(posed, poses, motions, PANEL if len(poses) <= FEW_PANELS else SMALL_PANEL, seen_from)
    fine = replace(camera, width=2 * camera.width, height=2 * camera.height)
    rays = fine.rays()
    still = posed.still_picture(rays)
    shape = (fine.height, fine.width)
    lines = _lines(still.distance.reshape(shape), still.normal.reshape(*shape, 3), np.zeros(shape, bool))
    rest = posed.part_pixels(poses[0], fine)
    panels = [_half(_painted(still, lines, rest))]
    covered = np.zeros(shape, bool)
    covered.reshape(-1)[rest.pixel] = True
    outline, arrows = rim(covered, 2), [np.zeros(shape, bool)]
    for k, (motion, amount) in enumerate(motions):
        part = posed.part_pixels(poses[k + 1], fine)
        covered.reshape(-1)[part.pixel] = True
        picture = _painted(still, lines, part)
        picture = blend(picture, outline, (90, 90, 90), 0.7)
        drawn = _with_axis(picture, *motion_axis(posed.corners, motion, amount, fine), fine)
        arrows.append((drawn != picture).any(-1))
        panels.append(_half(drawn))
    titles = words or ["slides" if m.kind is JointType.PRISMATIC else "turns" for m, _ in motions]
    compass, usual = seen_from.sides.compass(camera), emptiest_corner(covered[::2, ::2])
    corners = [emptiest_corner(covered + ARROW * arrow) if in_corner(arrow, usual) else usual for arrow in arrows]
    named = zip(panels, corners, [("rest", ""), *((str(k), word) for k, word in enumerate(titles, 1))], strict=True)
    return grid([_titled(with_compass(panel, compass, corner), *title) for panel, corner, title in named])


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
    scene = RayScene(*unshared(triangles))
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
    """Draw the panel's number in a corner, the words beside it, a new line after each comma and at the end, and a frame."""
    drawn = Image.fromarray(panel)
    draw = ImageDraw.Draw(drawn)
    draw.rectangle([0, 0, panel.shape[1] - 1, panel.shape[0] - 1], outline=(150, 150, 150))
    width, height = plate_size(title, TITLE)
    draw_plate(draw, Plate(title, (4, 4, 4 + width + 2 * PAD, 4 + height), (4 + PAD, 4 + PAD), TITLE), (20, 20, 20))
    left, top, font = 12 + width + 2 * PAD, 4, WORD if panel.shape[1] >= PANEL else SMALL_WORD
    for line in broken(word, panel.shape[1] - left - 2 * PAD, font):
        wide, high = plate_size(line, font)
        plate = Plate(line, (left, top, left + wide + 2 * PAD, top + high), (left + PAD, top + PAD), font)
        draw_plate(draw, plate, BLOCKED if "blocked" in word else WHITE)
        top += high + 1
    return np.asarray(drawn)


def grid(panels: Sequence[UInt8[np.ndarray, "h w 3"]]) -> UInt8[np.ndarray, "H W 3"]:
    """Arrange panels of one size in at most four or five columns, with rows as even as possible; empty cells are white."""
    rows = -(-len(panels) // (4 if len(panels) <= FEW_PANELS else 5))
    columns = -(-len(panels) // rows)
    cells = [*panels, *[np.full_like(panels[0], 255)] * (rows * columns - len(panels))]
    return np.concatenate([np.concatenate(cells[r * columns : (r + 1) * columns], 1) for r in range(rows)])


def strip_camera(
    mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]], size: int = PANEL
) -> Camera:
    """Choose the camera that maximizes the smallest difference between any two poses; it frames the part in every pose."""
    posed, poses = strip_poses(mesh, moving, motions)
    return best_camera(posed, poses, motions, size)


def strip_poses(
    mesh: Mesh, moving: Bool[np.ndarray, " F"], motions: Sequence[tuple[Motion, float]], scene: RayScene | None = None
) -> tuple[Posed, list[np.ndarray]]:
    """Return the object, and the transforms of its part: at rest and moved. Raise ValueError if nothing moves."""
    if not moving.any():
        raise ValueError("a motion needs faces that move, found none")
    posed = Posed(mesh, moving, scene or RayScene(mesh.vertices, mesh.faces))
    return posed, [np.eye(4), *(m.transform(amount) for m, amount in motions)]


def best_camera(
    posed: Posed,
    poses: Sequence[np.ndarray],
    motions: Sequence[tuple[Motion, float]],
    size: int,
    seen_from: SeenFrom = ANYWHERE,
) -> Camera:
    """Choose the camera for a part in the poses of `strip_poses`."""
    places = [transformed(posed.corners, T) for T in poses]
    focus = bounds_of(np.concatenate(places))
    total = bounds_of(np.concatenate([posed.mesh.bounds, focus]))
    margin = MARGIN * float(np.linalg.norm(focus[1] - focus[0]))
    focus = np.stack([np.maximum(focus[0] - margin, total[0]), np.minimum(focus[1] + margin, total[1])])
    step = DEPTH * posed.mesh.diagonal
    best, most = None, -1.0
    ways, facing, front = [(a, e) for e in ELEVATION_WEIGHTS for a in AZIMUTH_WEIGHTS], seen_from.facing, seen_from.sides.front
    turned_by = front or 0.0
    before = [(a, e) for a, e in ways if facing is None or is_beside(away(*np.deg2rad([a + turned_by, e])), facing)]
    for azimuth, elevation in before or ways:
        far = orbit_camera(total, *np.deg2rad([azimuth + turned_by, elevation]), SKETCH)
        near = framed(far, box_corners(focus), AIR, far.height)
        rays = near.rays()
        score = _difference(_depths(posed, poses, near, rays), step) * ELEVATION_WEIGHTS[elevation] * AZIMUTH_WEIGHTS[azimuth]
        score *= 1.0 if front is None or abs(azimuth) < BEHIND_DEG else BEHIND_WEIGHT
        if best is None or score > most:
            best, most = near, score
    assert best is not None
    ends = [motion_axis(posed.corners, *m, best)[0] for m in motions]
    return _tightened(best, posed, places, np.concatenate([np.zeros((0, 3)), *ends]), size)


def _tightened(
    camera: Camera, posed: Posed, places: Sequence[Float[np.ndarray, "k 3"]], points: Float[np.ndarray, "n 3"], size: int
) -> Camera:
    """Frame the part in every pose, these points, and a margin of MARGIN where the object fills it."""
    still = np.isfinite(posed.still_hits(camera.rays()).distance).reshape(camera.height, camera.width)
    moving = camera.project(np.concatenate([*places, points]))[0]
    low, high = moving.min(0), moving.max(0)
    air = MARGIN * float((high - low).max()) * np.ones(2)
    box = box_of(still) if still.any() else np.concatenate([low, high])
    low, high = np.minimum(low, np.maximum(low - air, box[:2])), np.maximum(high, np.minimum(high + air, box[2:]))
    return zoom(camera, np.concatenate([low, high]), AIR, size)


def motion_axis(
    corners: Float[np.ndarray, "n 3"],
    motion: Motion,
    amount: float,
    camera: Camera,
    legible: float = LEGIBLE,
    radius: float = RING,
) -> tuple[Float[np.ndarray, "2 3"], Float[np.ndarray, "k 3"] | None]:
    """Return the arrow along the axis in the direction of the motion, and the ring if it rotates.

    corners: vertices of the part at rest, which determine the size; the result is at least large enough to be visible in this
    camera's picture.
    legible: minimum size, as a share of the picture's side; radius: of the ring, as a share of the size.
    """
    depth = float(camera.project(corners.mean(0)[None])[1][0])
    size = max(float(np.linalg.norm(np.ptp(corners, axis=0))), legible * 2 * depth * float(np.tan(camera.fov / 2)))
    axis, slides = (-motion.axis if amount < 0 else motion.axis), motion.kind is JointType.PRISMATIC
    ends, center = axis_line(corners, motion.origin, axis, slides, AXIS_SCALE * size)
    return ends, None if slides else ring(center, axis, radius * size)


def _depths(posed: Posed, poses: Sequence[np.ndarray], camera: Camera, rays: Rays) -> list[Float[np.ndarray, " n"]]:
    """Return the depth of the visible moving part for each pose, in lengths of the rays; inf elsewhere."""
    before = posed.still_hits(rays).distance
    depths = []
    for T in poses:
        part = posed.part_pixels(T, camera)
        depth = np.full(len(before), np.inf)
        depth[part.pixel] = np.where(part.distance < before[part.pixel], part.distance, np.inf)
        depths.append(depth)
    return depths


def _difference(depths: Sequence[Float[np.ndarray, " n"]], min_difference: float) -> float:
    """Score how different the poses look: the minimum plus 0.2 times the mean share of pixels that differ between two poses.

    The share of pixels that show the part in the first pose, at rest, is added with weight 0.2.
    """
    clipped = np.minimum(np.array(depths), 1e9)
    pairs = [(np.abs(a - b) > min_difference).mean() for k, a in enumerate(clipped) for b in clipped[:k]]
    shown = np.isfinite(depths[0]).mean()
    return float(min(pairs, default=0.0) + 0.2 * np.mean(pairs or [0.0]) + 0.2 * shown)


Rays = tuple[np.ndarray, np.ndarray]  # origins and directions, as returned by `Camera.rays`
Pose = Float[np.ndarray, "4 4"]


@dataclass(frozen=True, eq=False)
class PartPixels(Brief):
    """Pixels that the part alone would cover.

    pixel: flat indices in row-major order; distance: in lengths of the pixel's ray; normal: turned towards the camera.
    """

    pixel: Int[np.ndarray, " k"]
    distance: Float[np.ndarray, " k"]
    normal: Float[np.ndarray, "k 3"]


@dataclass(frozen=True, eq=False)
class Still(Brief):
    """Static faces in a picture: shaded and lightened colour, distance (inf: nothing) and normal of each pixel."""

    color: UInt8[np.ndarray, "n 3"]
    distance: Float[np.ndarray, " n"]
    normal: Float[np.ndarray, "n 3"]


@dataclass(frozen=True, eq=False)
class Posed(Brief):
    """The object as modelled, its ray scene, and its moving faces. Poses are rigid transforms of these from their rest pose."""

    mesh: Mesh
    moving: Bool[np.ndarray, " F"]
    scene: RayScene

    @cached_property
    def part(self) -> Mesh:
        """The moving faces, at rest."""
        return self.mesh.subset(self.moving)

    @cached_property
    def _part_scene(self) -> RayScene:
        return RayScene(self.part.vertices, self.part.faces)

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Vertices of the moving faces, at rest."""
        return self.part.vertices

    @cached_property
    def _box(self) -> Float[np.ndarray, "8 3"]:
        """Corners of the bounding box of the moving faces, at rest."""
        return box_corners(bounds_of(self.corners))

    def still_hits(self, rays: Rays) -> Hits:
        """Return the first hits on static faces; rays continue behind moving faces."""
        hits = self.scene.first_hit(*rays)
        face, distance, u, v = (a.copy() for a in (hits.face, hits.distance, hits.u, hits.v))
        step = ONWARD * self.mesh.diagonal / np.linalg.norm(rays[1], axis=1)
        for _ in range(MAX_LAYERS):
            rows = np.flatnonzero(face >= 0)
            rows = rows[self.moving[face[rows]]]
            if len(rows) == 0:
                break
            done = distance[rows] + step[rows]
            onward = self.scene.first_hit(rays[0][rows] + done[:, None] * rays[1][rows], rays[1][rows])
            face[rows], distance[rows], u[rows], v[rows] = onward.face, onward.distance + done, onward.u, onward.v
        lost = (face >= 0) & self.moving[face]
        face[lost], distance[lost] = -1, np.inf
        return Hits(face, distance, u, v)

    def still_picture(self, rays: Rays) -> Still:
        """Render the static faces."""
        hits = self.still_hits(rays)
        color, normal = shade(self.mesh, hits, rays[1])
        return Still(lighten(color, LIGHTEN), hits.distance, normal)

    def part_pixels(self, T: Pose, camera: Camera) -> PartPixels:
        """Return the pixels that the part alone would cover in a pose, by casting rays in the frame of the part."""
        columns, rows = self._box_pixels(T, camera)
        R, t = T[:3, :3], T[:3, 3]
        across, along = (turned(terms, R.astype(np.float32)) for terms in camera.ray_grid(columns + 0.5, rows + 0.5))
        directions = (along[:, None] + across).reshape(-1, 3)
        hits = self._part_scene.surface_hits(turned((camera.T_world_camera[:3, 3] - t)[None], R)[0], directions)
        seen = np.flatnonzero(hits.face >= 0)
        pixel = (rows[:, None] * camera.width + columns).reshape(-1)[seen]
        normal = turned(hits.normal[seen], R.T.astype(np.float32))
        return PartPixels(pixel, hits.depth[seen].astype(float), normal.astype(float))

    def _box_pixels(self, T: Pose, camera: Camera) -> tuple[Int[np.ndarray, " w"], Int[np.ndarray, " h"]]:
        """Return the columns and rows of the bounding box of the part in a pose."""
        pixel, depth = camera.project(transformed(self._box, T))
        if (depth <= 0).any():
            return np.arange(camera.width), np.arange(camera.height)
        limit = np.array([camera.width, camera.height])
        low = np.clip(np.floor(pixel.min(0) - BOX_MARGIN), 0, limit).astype(int)
        high = np.clip(np.ceil(pixel.max(0) + BOX_MARGIN), 0, limit).astype(int)
        return np.arange(low[0], high[0]), np.arange(low[1], high[1])


def part_color(normal: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the shaded colour (0..255) of the highlighted part."""
    return lit(np.tile(np.array(HIGHLIGHT, float), (len(normal), 1)), normal)
