"""Geometry of a question's numbers on the displayed mesh: faces of marks, positions of points, poses of motions."""

from __future__ import annotations

import colorsys

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.simplify_ import simplify
from anymesh.prompted.questions.prompting import ArrowTable, MotionTable, PartShown, PointTable
from anymesh.rendering.marks import axis_line
from anymesh.rendering.viewpoints import away
from anymesh.types import JointType, Mesh
from anymesh.viewer.ask_marks import SPLIT, MarksForm
from anymesh.viewer.scene import MAX_DISPLAY_FACES, MIN_PART_FACES, Color, DisplayMesh, color_of

SAME_SIZE = 0.05  # tolerance of the ratio of sizes, below which a part has the scale of the mesh
REACH = 0.03  # maximum distance of a clicked point from the ray, as a share of its distance from the eye
MARKER, ON_PART = 0.014, 0.05  # maximum radius of a point's marker, as shares of the object's diagonal and of the part's
CROWDED = 0.4  # the same, as a share of the distance to the nearest point
ARROW = 0.6  # length of an arrow, as a share of the part's size
# points sampled on a part; their offset from the surface (share of the diagonal); minimum visible share
SAMPLES, LIFT, IN_SIGHT = 200, 1e-4, 0.1
CLOSEST = 0.12  # minimum size that fills the picture, as a share of the diagonal
# minimum horizontal component of a direction that has a side; [deg] offsets of the camera to the side and upwards
ASLANT, ASIDE, RAISED = 0.3, 20.0, 24.0
TINT, GOLDEN = (0.24, 0.92), 0.618034  # saturation and value of unassigned marks, and the step between their hues
NOT_ASKED, DIVIDED = (150, 150, 150), (134, 46, 156)


def surface(mesh: Mesh, faces: Int[np.ndarray, " f"], most: int = MAX_DISPLAY_FACES) -> DisplayMesh:
    """Return some faces as a surface, decimated if the mesh has more than `most` faces."""
    if len(mesh.faces) <= most:
        piece = mesh.subset(faces)
        return DisplayMesh(piece.vertices, piece.faces)
    few = simplify(mesh.triangles[faces], max(MIN_PART_FACES, most * len(faces) // len(mesh.faces)))
    return DisplayMesh(few.reshape(-1, 3), np.arange(3 * len(few)).reshape(-1, 3))


def scale_of(part: PartShown, mesh: Mesh) -> float:
    """Return the length [m] in a question of one unit of the displayed mesh; an answer may have changed its scale."""
    if part.diagonal is None:
        return 1.0
    scale = part.diagonal / mesh.diagonal
    return 1.0 if abs(scale - 1) < SAME_SIZE else scale


def is_enclosed(part: PartShown, mesh: Mesh, rays: RayScene) -> bool:
    """Return whether a part is hardly visible from outside, from any side."""
    points = part.points[:: max(1, len(part.points) // SAMPLES)] / scale_of(part, mesh)
    ways = np.array([away(np.deg2rad(a), np.deg2rad(e)) for e in (20, 60) for a in range(0, 360, 45)])
    origins, directions = np.repeat(points, len(ways), 0), np.tile(ways, (len(points), 1))
    free = rays.first_hit(origins + LIFT * mesh.diagonal * directions, directions).face < 0
    return float(free.reshape(len(points), len(ways)).mean(0).max()) < IN_SIGHT


def closer_view(part: PartShown, mesh: Mesh) -> tuple[Float[np.ndarray, " 3"], float]:
    """Return the direction to the camera (unit) for a part, and the size that fills the picture [m]."""
    corners = mesh.triangles[part.faces].reshape(-1, 3)
    size = max(float(np.linalg.norm(np.ptp(corners, axis=0))), CLOSEST * mesh.diagonal)
    level = np.array([*part.outward[:2], 0.0])
    azimuth = np.arctan2(level[0], -level[1]) if np.linalg.norm(level) > ASLANT else np.deg2rad(ASIDE)
    return away(float(azimuth) + np.deg2rad(ASIDE), np.deg2rad(RAISED)), size


def asked_faces(form: MarksForm) -> dict[int, Int[np.ndarray, " f"]]:
    """Return the faces of each mark of the question."""
    return {mark: faces for mark in sorted(form.asked) if len(faces := np.flatnonzero(form.face_mark == mark))}


def mark_color(form: MarksForm, mark: int) -> Color:
    """Return the colour of a mark: that of its part, else a tint that differs from its neighbours."""
    group = form.group_of(mark)
    if group is None:
        r, g, b = colorsys.hsv_to_rgb(mark * GOLDEN % 1, *TINT)
        return round(255 * r), round(255 * g), round(255 * b)
    return group_color(form, group)


def group_color(form: MarksForm, group: tuple[str, int]) -> Color:
    """Return the colour of a group of marks."""
    return DIVIDED if group == SPLIT else color_of(1 + list(form.groups).index(group))


def point_places(table: PointTable, mesh: Mesh) -> Float[np.ndarray, "k 3"]:
    """Return the positions of a part's points on the displayed mesh."""
    return table.points / scale_of(table.part, mesh)


def marker_radius(table: PointTable, mesh: Mesh) -> float:
    """Return the radius of the points' markers, small enough for their part and to separate neighbours."""
    places, size = point_places(table, mesh), np.ptp(mesh.triangles[table.part.faces].reshape(-1, 3), axis=0)
    radius = min(MARKER * mesh.diagonal, ON_PART * float(np.linalg.norm(size)))
    if len(places) < 2:
        return radius
    gaps = np.linalg.norm(places[:, None] - places[None], axis=2) + np.diag(np.full(len(places), np.inf))
    return float(np.clip(CROWDED * np.median(gaps.min(1)), 0.3 * radius, radius))


def nearest_point(
    places: Float[np.ndarray, "k 3"], origin: Float[np.ndarray, " 3"], direction: Float[np.ndarray, " 3"]
) -> int | None:
    """Return the number (from 1) of the point nearest to a click's ray; None if none is near."""
    if len(places) == 0:
        return None
    way = direction / np.linalg.norm(direction)
    along = (places - origin) @ way
    off = np.linalg.norm(places - origin - along[:, None] * way, axis=1) / np.maximum(along, 1e-9)
    off[along <= 0] = np.inf
    best = int(off.argmin())
    return best + 1 if off[best] < REACH else None


def hidden_points(table: PointTable) -> Bool[np.ndarray, " k"]:
    """Return which points lie below a surface."""
    return np.zeros(len(table.points), bool) if table.hidden is None else table.hidden


def arrow_ends(table: ArrowTable, mesh: Mesh) -> Float[np.ndarray, "k 2 3"]:
    """Return the ends of a part's arrows on the displayed mesh."""
    corners = mesh.triangles[table.part.faces].reshape(-1, 3)
    middle, length = (corners.min(0) + corners.max(0)) / 2, ARROW * float(np.linalg.norm(np.ptp(corners, axis=0)))
    return np.stack([np.tile(middle, (len(table.directions), 1)), middle + length * table.directions], 1)


def moving_faces(table: MotionTable) -> Int[np.ndarray, " f"]:
    """Return the faces that move: those of the part and of everything it carries."""
    return table.part.faces if table.moving is None else table.moving


def motion_axis(table: MotionTable, row: int, mesh: Mesh) -> Float[np.ndarray, "2 3"]:
    """Return the ends of the arrow along a motion's axis, on the displayed mesh."""
    motion, corners = table.motions[row], mesh.triangles[table.part.faces].reshape(-1, 3)
    origin = motion.origin / scale_of(table.part, mesh)
    slides = motion.kind is JointType.PRISMATIC
    sign = -1.0 if table.amounts[row] < 0 else 1.0
    return axis_line(corners, origin, sign * motion.axis, slides, mesh.diagonal)[0]


def motion_pose(table: MotionTable, row: int, phase: float, mesh: Mesh) -> Float[np.ndarray, "4 4"]:
    """Return the pose of the moving faces at a phase 0..1 of a motion's play, there and back, on the displayed mesh."""
    T = table.motions[row].transform(table.amounts[row] * (1 - np.cos(2 * np.pi * phase)) / 2)
    T[:3, 3] /= scale_of(table.part, mesh)
    return T
