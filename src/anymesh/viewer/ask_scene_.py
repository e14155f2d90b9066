"""3D scene of a question (viser): clickable marks and points, arrows, playing motions."""

from __future__ import annotations

from itertools import count
from typing import Any

import numpy as np

from anymesh.export.notation import quaternion
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import Mesh
from anymesh.viewer.ask_forms import ArrowsForm, Form, MotionsForm, PartsForm, PointsForm
from anymesh.viewer.ask_marks import MarksForm
from anymesh.viewer.ask_shapes import (
    NOT_ASKED,
    arrow_ends,
    asked_faces,
    hidden_points,
    is_enclosed,
    mark_color,
    marker_radius,
    motion_axis,
    motion_pose,
    moving_faces,
    nearest_point,
    point_places,
    surface,
)
from anymesh.viewer.scene import Color, color_of

REST, PART, AXIS = (205, 205, 210), color_of(1), (190, 20, 40)
POINT, HIDDEN_POINT, CHOSEN = (40, 90, 200), (150, 180, 235), (230, 0, 200)
GHOST, SEE_INTO = 0.15, 0.3  # opacity of the rest of the object, and of the part while its points are chosen
SECONDS = 2.5  # duration of a motion's play, there and back


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
        """Draw only the mesh."""
        self._take(mesh)
        self.clear()
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
