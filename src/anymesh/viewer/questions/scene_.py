"""3D scene of a question (viser): clickable marks and points, arrows, playing motions."""

from __future__ import annotations

import colorsys
from itertools import count
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.export.notation import quaternion
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.questions.prompting import ArrowTable, MotionTable, PartShown, PointTable
from anymesh.rendering.marks import axis_line
from anymesh.rendering.viewpoints import away
from anymesh.types import JointType, Mesh
from anymesh.viewer.looks import FROM_Y_UP, has_looks, is_drawable, mesh_glb, with_base_colors
from anymesh.viewer.questions.forms import SPLIT, ArrowsForm, Form, MarksForm, MotionsForm, PartsForm, PointsForm
from anymesh.viewer.scene import Color, color_of, surface

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
REST, PART, AXIS = (205, 205, 210), color_of(1), (190, 20, 40)
POINT, HIDDEN_POINT, CHOSEN = (40, 90, 200), (150, 180, 235), (230, 0, 200)
GHOST, SEE_INTO = 0.15, 0.3  # opacity of the rest of the object, and of the part while its points are chosen
SECONDS = 2.5  # duration of a motion's play, there and back


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


class QuestionScene:
    """Draws a mesh with the contents of a form, the same in every tab."""

    def __init__(self, server: Any) -> None:
        self._server, self._scene = server, server.scene
        self._made = count()
        self._nodes: list[Any] = []
        self._marks: dict[int, Any] = {}
        self._moving: Any = None
        self._mesh: Mesh | None = None
        self._rays: RayScene | None = None
        self._shown: Form | None = None

    def clear(self) -> None:
        """Remove everything from the scene."""
        while self._nodes:
            self._nodes.pop().remove()
        self._marks, self._moving, self._shown = {}, None, None

    def show_mesh(self, mesh: Mesh) -> None:
        """Draw only the mesh, with its materials."""
        self._take(mesh)
        self.clear()
        if is_drawable(mesh) and has_looks(mesh):
            self._keep(self._scene.add_glb(self._name(), mesh_glb(with_base_colors(mesh)), wxyz=FROM_Y_UP, cast_shadow=False))
        else:
            self._add(mesh, np.arange(len(mesh.faces)), REST)

    def _take(self, mesh: Mesh) -> None:
        if self._mesh is not mesh:
            self._mesh, self._rays = mesh, None

    def show(self, form: Form, mesh: Mesh) -> None:
        """Draw the contents of a form."""
        self._take(mesh)
        match form:
            case MarksForm() if form is self._shown:
                self._recolor(form)
            case MarksForm():
                self._show_marks(form, mesh)
            case PointsForm():
                self._show_points(form, mesh)
            case ArrowsForm():
                self._show_arrows(form, mesh)
            case MotionsForm():
                self._show_motion(form, mesh)
            case PartsForm():
                self._show_part(form, mesh)
            case _:
                self.show_mesh(mesh)
        self._shown = form

    def _recolor(self, form: MarksForm) -> None:
        """Update the colours of marks after a change of their groups."""
        hidden = form.hidden()
        with self._server.atomic():
            for mark, node in self._marks.items():
                color, visible = mark_color(form, mark), mark not in hidden
                if tuple(node.color) != color:  # each change is a message
                    node.color = color
                if node.visible != visible:
                    node.visible = visible

    def clicked(self, form: Form, origin: np.ndarray, direction: np.ndarray) -> bool:
        """Apply a click along a ray to a form; return whether it changed."""
        mesh = self._mesh
        if mesh is None:
            return False
        if isinstance(form, PointsForm):
            number = nearest_point(point_places(form.table, mesh), origin, direction)
            if number is not None:
                form.toggle(number)
            return number is not None
        if isinstance(form, MarksForm):
            mark = self._mark_at(form, mesh, origin, direction)
            return mark is not None and form.toggle(mark)
        return False

    def tick(self, form: Form | None, now: float) -> None:
        """Move the playing parts to their pose at a time [s]."""
        if self._moving is None or self._mesh is None or not isinstance(form, MotionsForm):
            return
        chosen = form.chosen[form.step]
        T = motion_pose(form.table, chosen - 1, now / SECONDS % 1, self._mesh) if chosen else np.eye(4)
        with self._server.atomic():
            self._moving.wxyz, self._moving.position = quaternion(T[:3, :3]), T[:3, 3]

    def _mark_at(self, form: MarksForm, mesh: Mesh, origin: np.ndarray, direction: np.ndarray) -> int | None:
        """Return the mark of the first face on a ray, None if there is none; hidden marks are ignored."""
        hidden = form.hidden()
        rays, numbers = self._ray_scene(mesh), np.arange(len(mesh.faces))
        if hidden:
            numbers = np.flatnonzero(~np.isin(form.face_mark, list(hidden)))
            piece = mesh.subset(numbers)
            rays = RayScene(piece.vertices, piece.faces)
        face = int(rays.first_hit(origin[None], direction[None]).face[0])
        mark = int(form.face_mark[numbers[face]]) if face >= 0 else 0
        return mark if mark > 0 else None

    def _ray_scene(self, mesh: Mesh) -> RayScene:
        if self._rays is None:
            self._rays = RayScene(mesh.vertices, mesh.faces)
        return self._rays

    def _show_marks(self, form: MarksForm, mesh: Mesh) -> None:
        self.clear()
        faces = asked_faces(form)
        rest = np.flatnonzero(~np.isin(form.face_mark, list(faces)))
        if len(rest):
            self._add(mesh, rest, NOT_ASKED)
        self._marks = {mark: self._add(mesh, some, mark_color(form, mark)) for mark, some in faces.items()}
        self._recolor(form)

    def _rest_opacity(self, form: PartsForm, mesh: Mesh) -> float | None:
        """Return the opacity of the rest of the object: by default it is transparent if the part is enclosed."""
        if form.step not in form.see_through:
            form.see_through[form.step] = is_enclosed(form.part, mesh, self._ray_scene(mesh))
        return GHOST if form.see_through[form.step] else None

    def _show_part(self, form: PartsForm, mesh: Mesh, part: float | None = None) -> None:
        """Draw the part in question in colour, and the rest."""
        self.clear()
        rest = self._rest_opacity(form, mesh)
        other = np.setdiff1d(np.arange(len(mesh.faces)), form.part.faces)
        if len(other):
            self._add(mesh, other, REST, rest)
        self._add(mesh, form.part.faces, PART, part)

    def _show_points(self, form: PointsForm, mesh: Mesh) -> None:
        form.see_through.setdefault(form.step, True)
        self._show_part(form, mesh, SEE_INTO)
        places = point_places(form.table, mesh)
        radius, hidden = marker_radius(form.table, mesh), hidden_points(form.table)
        for k, place in enumerate(places):
            chosen = k + 1 in form.chosen[form.step]
            color = CHOSEN if chosen else HIDDEN_POINT if hidden[k] else POINT
            self._keep(
                self._scene.add_icosphere(
                    self._name(), radius * (1.4 if chosen else 1.0), color, subdivisions=2, position=place, cast_shadow=False
                )
            )
            self._label(str(k + 1), place)

    def _show_arrows(self, form: ArrowsForm, mesh: Mesh) -> None:
        self._show_part(form, mesh)
        for k, ends in enumerate(arrow_ends(form.tables[form.step], mesh), 1):
            self._arrow(ends, CHOSEN if form.chosen[form.step] == k else POINT, mesh)
            self._label(str(k), ends[1])

    def _show_motion(self, form: MotionsForm, mesh: Mesh) -> None:
        self.clear()
        moving = moving_faces(form.table)
        rest = np.setdiff1d(np.arange(len(mesh.faces)), moving)
        if len(rest):
            self._add(mesh, rest, REST, self._rest_opacity(form, mesh))
        self._moving = self._keep(self._scene.add_frame(self._name(), show_axes=False))
        self._add(mesh, form.part.faces, PART, below=self._moving.name)
        carried = np.setdiff1d(moving, form.part.faces)
        if len(carried):
            self._add(mesh, carried, color_of(2), below=self._moving.name)
        for k, t in enumerate(form.tables if form.leads else ()):
            if k != form.step:
                self._label(str(k + 1), mesh.triangles[t.part.faces].mean((0, 1)))
        if form.chosen[form.step]:
            self._arrow(motion_axis(form.table, form.chosen[form.step] - 1, mesh), AXIS, mesh)

    def _name(self, below: str = "") -> str:
        return f"{below}/ask{next(self._made)}"

    def _keep(self, node: Any) -> Any:
        self._nodes.append(node)
        return node

    def _label(self, text: str, place: np.ndarray) -> None:
        self._keep(self._scene.add_label(self._name(), text, position=place, font_screen_scale=0.9))

    def _arrow(self, ends: np.ndarray, color: Color, mesh: Mesh) -> None:
        size = mesh.diagonal
        self._keep(
            self._scene.add_arrows(
                self._name(), ends[None], color, shaft_radius=0.004 * size, head_radius=0.012 * size, head_length=0.03 * size
            )
        )

    def _add(self, mesh: Mesh, faces: np.ndarray, color: Color, opacity: float | None = None, below: str = "") -> Any:
        drawn = surface(mesh, faces)
        node = self._scene.add_mesh_simple(
            self._name(below), drawn.vertices, drawn.faces, color=color, opacity=opacity, flat_shading=True, side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip
        return node if below else self._keep(node)  # children of a frame are removed with it
