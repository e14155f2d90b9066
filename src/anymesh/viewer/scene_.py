"""3D scene of the live page (viser): parts, axes, limits, overlays. Nodes are named by number, not by part."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.export.model import ExportConfig, Model, build_model
from anymesh.export.notation import quaternion
from anymesh.export.options import ExportOptions
from anymesh.rendering.viewpoints import away
from anymesh.runtime import cache_folder
from anymesh.types import Asset, JointType, Mesh, Segmentation
from anymesh.types.camera import Camera
from anymesh.types.triangles import unshared
from anymesh.viewer.looks import FROM_Y_UP, Ground, mesh_glb
from anymesh.viewer.scene import (
    RADIUS,
    DisplayMesh,
    GripperMark,
    Surfaces,
    box_lines,
    color_of,
    gripper_lines,
    inertia_box,
    joint_lines,
    shade_of,
    shape_surface,
)
from anymesh.viewer.session import part_poses

AXIS, SENSE, RANGE, SELECTED, CHOSEN = (190, 20, 40), (190, 20, 40), (30, 110, 200), (255, 120, 0), (230, 0, 200)
INERTIA, HANDLE, GRASP = (140, 70, 200), (0, 135, 90), (0, 160, 200)
THIN, THICK = 2.0, 3.0  # [px] line widths
SEE_THROUGH = 0.35  # opacity of overlays
DISTANCE, FOV = 2.3, np.deg2rad(35)  # of the first view: distance in diagonals; vertical field of view
LIFT = 1e-3  # offset of chosen faces from the surface, as a share of the diagonal
PICTURE = 1000  # [px] height of the picture that stands for a tab's


class SceneView:
    """Draws one asset on a viser server, the same in every tab."""

    def __init__(self, server: Any) -> None:
        self._server, self._scene = server, server.scene
        self._surfaces = Surfaces()
        self._asset: Asset | None = None
        self._drawn: tuple[Segmentation, bool] | None = None
        self._frames: dict[str, Any] = {}  # part name -> frame
        self._meshes: dict[str, Any] = {}  # part name -> mesh, if parts are coloured
        self._looks: list[Any] = []  # the same, or their GLBs
        self._axes: list[tuple[str, Any]] = []  # the part that each joint's frame moves with
        self._overlays: list[Any] = []
        self._made = count()  # part of every name: a tab reuses the pose of a removed node for a new one with the same name
        self._built: tuple[Asset, Model] | None = None
        self._marks: list[Any] = []
        self._grippers: list[Any] = []
        self.grippers: tuple[GripperMark, ...] = ()  # that are drawn
        self._ground = Ground(self._scene)
        self.textured, self.axes, self.collision, self.inertia = False, True, False, False
        self._scene.set_up_direction("+z")
        self._scene.configure_default_lights(cast_shadow=False)
        server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="large", brand_color=(190, 60, 20))

    def note(self) -> str:
        """Return a note on the displayed surface."""
        return "" if self._asset is None else self._surfaces.note(self._asset)

    def look_at(self, mesh: Mesh) -> None:
        """Set the initial view, for open and future tabs, and put the ground below the mesh."""
        self._ground.lay(mesh)
        self.look_from(mesh, away(np.deg2rad(35), np.deg2rad(24)), mesh.diagonal)

    def look_from(self, mesh: Mesh, direction: Float[np.ndarray, " 3"], size: float) -> None:
        """Turn every camera to a mesh. direction: unit, from it to the camera; size: of what fills the picture [m]."""
        center, diagonal = mesh.bounds.mean(0), size
        eye = center + DISTANCE * diagonal * direction
        for camera in (self._server.initial_camera, *(c.camera for c in self._server.get_clients().values())):
            camera.position, camera.look_at, camera.fov = eye, center, FOV
            camera.near, camera.far = 0.01 * diagonal, 100 * diagonal

    def show(self, asset: Asset) -> None:
        """Draw an asset; unchanged parts are not redrawn."""
        _remove(self._marks)
        _remove(self._overlays)
        _remove(self._grippers)
        if self._drawn is None or self._drawn[0] is not asset.segmentation or self._drawn[1] != self.textured:
            self._draw_parts(asset)
            self._drawn = (asset.segmentation, self.textured)
        self._asset = asset
        self._ground.lay(asset.mesh, asset.segmentation.face_part)
        self._draw_axes(asset)
        for gripper in self.grippers:
            if gripper.link in self._frames:
                lines, color = gripper_lines(gripper, 2 * RADIUS * asset.mesh.diagonal), GRASP if gripper.grasp else HANDLE
                self._grippers.append(self._lines(self._below(gripper.link), lines, color, 2 * THICK))
        self._draw_overlays(asset)

    def clear(self) -> None:
        """Remove the asset from the scene."""
        for handles in (
            self._marks,
            self._grippers,
            self._overlays,
            [*self._frames.values()],
            [frame for _, frame in self._axes],
        ):
            _remove(handles)
        self._frames, self._meshes, self._looks, self._axes = {}, {}, [], []
        self._asset = self._drawn = self._built = None
        self._ground.clear()

    def _draw_parts(self, asset: Asset) -> None:
        _remove([*self._frames.values()])
        self._frames, self._meshes, self._looks = {}, {}, []
        surfaces = self._surfaces.of(asset)
        textured = self.textured and not self._surfaces.note(asset)
        for number, part in enumerate(asset.segmentation.parts):
            self._frames[part.name] = frame = self._frame()
            if textured:
                glb = mesh_glb(asset.mesh.subset(asset.segmentation.faces(number)), part.name)
                look = self._scene.add_glb(f"{frame.name}/look", glb, wxyz=FROM_Y_UP, cast_shadow=False)
                self._looks.append(look)
                continue
            self._meshes[part.name] = mesh = self._mesh(f"{frame.name}/look", surfaces[part.name], color_of(number), None)
            self._looks.append(mesh)

    def _frame(self) -> Any:
        return self._scene.add_frame(f"/node{next(self._made)}", show_axes=False)

    def _below(self, part: str) -> str:
        """Return the name of a new node that moves with a part."""
        return f"{self._frames[part].name}/node{next(self._made)}"

    def _mesh(self, name: str, surface: DisplayMesh, color: tuple[int, int, int], opacity: float | None) -> Any:
        return self._scene.add_mesh_simple(
            name, surface.vertices, surface.faces, color=color, opacity=opacity, flat_shading=True, side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip

    def _draw_axes(self, asset: Asset) -> None:
        _remove([frame for _, frame in self._axes])
        self._axes = []
        for joint in asset.joints if self.axes else ():
            if joint.type is JointType.FIXED:
                continue
            lines, frame, size = joint_lines(asset, joint), self._frame(), asset.mesh.diagonal
            name = frame.name
            self._axes.append((joint.parent, frame))
            self._scene.add_arrows(
                f"{name}/axis", lines.arrow[None], AXIS, shaft_radius=0.004 * size, head_radius=0.012 * size,
                head_length=0.03 * size,
            )  # fmt: skip
            for kind, segments, color in (("sense", lines.sense, SENSE), ("range", lines.range, RANGE)):
                if len(segments):
                    self._lines(f"{name}/{kind}", segments, color, THIN)

    def _lines(self, name: str, segments: np.ndarray, color: tuple[int, int, int], width: float) -> Any:
        return self._scene.add_line_segments(name, segments, color, thickness=width, thickness_units="screen")

    def pose(self, positions: Mapping[str, float], explode: float) -> None:
        """Place every part according to joint positions [rad or m] and the exploded view (0..1)."""
        if self._asset is None:
            return
        poses = part_poses(self._asset, positions, explode)
        with self._server.atomic():
            for name, frame in (*self._frames.items(), *self._axes):
                frame.wxyz, frame.position = quaternion(poses[name][:3, :3]), poses[name][:3, 3]
        self._ground.cast({k: poses[p.name] for k, p in enumerate(self._asset.segmentation.parts)})

    def follow_shadow(self) -> None:
        """Draw the shadow of the last pose on the ground."""
        self._ground.follow()

    def mark(self, selected: str | None, chosen: np.ndarray) -> None:
        """Highlight the selected part and the chosen faces."""
        _remove(self._marks)
        if self._asset is None:
            return
        asset, names = self._asset, [p.name for p in self._asset.segmentation.parts]
        for number, name in enumerate(names):
            if name in self._meshes:
                self._meshes[name].color = color_of(number, faded=selected not in (None, name))
            mine = chosen[asset.segmentation.face_part[chosen] == number]
            if len(mine):
                # on both sides, since the winding of a file says little
                off = LIFT * asset.mesh.diagonal * asset.mesh.face_normals[mine][:, None]
                lifted = np.concatenate([asset.mesh.triangles[mine] + off, asset.mesh.triangles[mine] - off])
                self._marks.append(self._mesh(self._below(name), DisplayMesh(*unshared(lifted)), CHOSEN, None))
        if selected in names:
            number = names.index(selected)
            corners = asset.mesh.triangles[asset.segmentation.faces(number)].reshape(-1, 3)
            edges = box_lines(corners, 0.005 * asset.mesh.diagonal)
            self._marks.append(self._lines(self._below(names[number]), edges, SELECTED, THICK))

    def _draw_overlays(self, asset: Asset) -> None:
        """Draw collision shapes in place of the parts, and boxes of equal inertia. Building them can take seconds."""
        for look in self._looks:
            look.visible = not self.collision
        if not (self.collision or self.inertia):
            return
        if self._built is None or self._built[0] is not asset:
            self._built = (asset, _model(asset))
        for number, (body, part) in enumerate(zip(self._built[1].bodies, asset.segmentation.parts, strict=True)):
            shapes = body.shapes if self.collision else ()
            drawn = [(shape_surface(s), shade_of(number, k), None) for k, s in enumerate(shapes)]
            drawn += [(inertia_box(body.inertia), INERTIA, SEE_THROUGH)] if self.inertia else []
            for surface, color, opacity in drawn:
                placed = DisplayMesh(surface.vertices + body.link.origin, surface.faces)
                self._overlays.append(self._mesh(self._below(part.name), placed, color, opacity))


def camera_of(camera: Any) -> Camera:
    """Return the camera of a tab, as one of a picture of its shape."""
    w, i, j, k = camera.wxyz
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
        [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
        [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)],
    ]
    T[:3, 3] = camera.position
    return Camera(T, float(camera.fov), max(1, round(PICTURE * camera.aspect)), PICTURE)


def _model(asset: Asset) -> Model:
    return build_model(asset, ExportOptions(), config=ExportConfig(), cache=cache_folder("shapes"))


def _remove(handles: list[Any]) -> None:
    """Remove nodes from the scene and from the list."""
    while handles:
        handles.pop().remove()
