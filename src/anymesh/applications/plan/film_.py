"""Pictures of a replay by the project's ray caster: an MP4 or a contact sheet."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image

from anymesh.applications.plan.asset_ import ArticulatedObject, geom_triangles
from anymesh.applications.plan.hand_ import Hand
from anymesh.applications.plan.plans import BasePose, Trajectory
from anymesh.applications.plan.replay_ import Physics, moved
from anymesh.applications.plan.robot_ import RobotArm, positions_of
from anymesh.applications.plan.scene_ import OBJECT, ROBOT, compose
from anymesh.errors import MissingExtraError, OptionError
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.simplify_ import simplify
from anymesh.mujoco_ import load_mujoco
from anymesh.rendering.drawing import Window, draw, face_colors, ground, render_target, sample
from anymesh.types import Mesh
from anymesh.types.camera import Camera
from anymesh.types.mesh import Node
from anymesh.types.triangles import unshared

WIDTH, HEIGHT = 640, 480  # [px] of a frame
RATE = 10.0  # [1/s] frames
FLOOR = 2.5  # [m] side of the ground square that is drawn
FOV = np.deg2rad(35)
GRAY = (0.7, 0.7, 0.72)
SUN = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
MOST_FACES = 2000  # per geom; visual meshes of robots have up to a hundred times as many
SHOULDER = 0.5  # [m] above the base; the part of the arm that must be visible
SHEET_COLUMNS, SHEET_ROWS = 3, 3


class Film:
    """Renderer of the object and the robot in given states."""

    def __init__(
        self,
        thing: ArticulatedObject,
        robot: RobotArm,
        hand: Hand,
        base: BasePose,
        physics: Physics = Physics(),  # noqa: B008
    ) -> None:
        self.mujoco = load_mujoco()
        self.model = model = compose(thing, robot, base=base, T_world_asset=moved(physics), visuals=True).compile()
        self.data = self.mujoco.MjData(model)
        self.robot, self.hand, self.thing = robot, hand, thing
        self._shapes = [(g, *geom_surface(self.mujoco, model, self.data, g)) for g in drawn_geoms(model)]
        self._colors = np.concatenate([np.tile(color, (len(own), 1)) for _, own, color in self._shapes])

    def state(self, trajectory: Trajectory, row: int) -> Float[np.ndarray, " q"]:
        """Return the positions that a trajectory prescribes at one of its samples."""
        q = self.model.qpos0.copy()
        q[positions_of(self.model, trajectory.joints, ROBOT)] = trajectory.position[row]
        q[positions_of(self.model, self.robot.fingers, ROBOT)] = self.hand.posture_at(float(trajectory.gap[row]))
        q[positions_of(self.model, [self.thing.joint], OBJECT)] = trajectory.value[row]
        return q

    def camera(
        self, states: Float[np.ndarray, "k q"], *, close: bool = False, width: int = WIDTH, height: int = HEIGHT
    ) -> Camera:
        """Return a camera at the side that sees the whole scene in all states; close: only the hand and the part."""
        wrist = int(self.model.body(ROBOT + self.robot.wrist).id)
        root = int(self.model.body(ROBOT + self.robot.root).id)
        places = []
        for q in states:
            self._pose(q)
            places.append(self.data.xpos[wrist].copy())
        tool = np.array(places)
        corners = np.concatenate([self.thing.part_triangles, self.thing.other_triangles]).reshape(-1, 3)
        box = [corners.min(0), corners.max(0)]
        points = np.concatenate([tool, self.thing.part_triangles.reshape(-1, 3)] if close else [tool, np.array(box)])
        foot = self.data.xpos[root].copy()
        if not close:
            points = np.concatenate([points, [foot, foot + np.array([0, 0, SHOULDER])]])
        center = (points.min(0) + points.max(0)) / 2
        radius = float(np.linalg.norm(points - center, axis=1).max()) + 0.05
        along = center[:2] - foot[:2] if close else corners.mean(0)[:2] - foot[:2]
        along = along / max(float(np.linalg.norm(along)), 1e-9)
        aside = np.array([along[1], -along[0]]) - 0.35 * along
        way = np.array([*aside, 0.55])
        eye = center + way / np.linalg.norm(way) * radius / np.sin(FOV / 2) * 0.9
        return Camera.looking_at(eye, center, FOV, width, height)

    def _pose(self, q: Float[np.ndarray, " q"]) -> None:
        self.data.qpos[:] = q
        self.mujoco.mj_kinematics(self.model, self.data)

    def frame(self, q: Float[np.ndarray, " q"], camera: Camera) -> UInt8[np.ndarray, "H W 3"]:
        """Render one picture."""
        self._pose(q)
        data = self.data
        parts = [own @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g] for g, own, _ in self._shapes]
        return draw_surfaces(parts, self._colors, camera)


def geom_surface(mujoco: Any, model: Any, data: Any, geom: int) -> tuple[Float[np.ndarray, "n 3 3"], UInt8[np.ndarray, " 3"]]:
    """Return the surface of a geom in its own frame, and its colour; ground is cut to a square."""
    mujoco.mj_kinematics(model, data)
    world = geom_triangles(mujoco, model, data, geom)
    own = (world - data.geom_xpos[geom]) @ data.geom_xmat[geom].reshape(3, 3)
    look = int(model.geom_matid[geom])
    rgba = model.geom_rgba[geom] if look < 0 else model.mat_rgba[look]
    if int(model.geom_bodyid[geom]) == 0:
        half = FLOOR / 2
        own = np.clip(own, -half, half)
    own = simplify(own, MOST_FACES)
    plain = look < 0 and np.allclose(rgba[:3], 0.5)  # MuJoCo's default colour, used where a file states none
    return own, np.round(255 * np.clip(GRAY if plain else rgba[:3], 0, 1)).astype(np.uint8)


def draw_surfaces(
    surfaces: list[Float[np.ndarray, "_ 3 3"]], colors: UInt8[np.ndarray, "F 3"], camera: Camera
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw surfaces with a colour per face, with outlines between them."""
    corners, faces = unshared(np.concatenate(surfaces))
    none = np.zeros(len(faces), np.int64)
    mesh = Mesh(corners, faces, none, (Node("scene"),), none - 1)
    scene = RayScene(mesh.vertices, mesh.faces)
    groups = np.repeat(np.arange(len(surfaces)), [len(p) for p in surfaces])
    samples = sample(render_target(mesh, scene, groups), camera, Window(0, 0, camera.width, camera.height))
    light = 0.55 + 0.45 * np.maximum(samples.normal @ SUN.astype(np.float32), 0)
    return draw(samples, face_colors(colors, samples), light, ground(camera.height, camera.width))


def drawn_geoms(model: Any) -> list[int]:
    """Return the visual geoms, the ground, and the collision geoms of links without visual ones."""
    seen = {g for g in range(model.ngeom) if not (model.geom_contype[g] or model.geom_conaffinity[g])}
    covered = {int(model.geom_bodyid[g]) for g in seen}
    return [g for g in range(model.ngeom) if g in seen or int(model.geom_bodyid[g]) not in covered]


def write_film(film: Film, states: Float[np.ndarray, "k q"], path: Path, rate: float = RATE) -> Path:
    """Write an MP4; write a PNG contact sheet if `path` ends in .png or the extra `video` is missing.

    Return the path written. Raise OptionError for another suffix.
    """
    if path.suffix.lower() not in (".mp4", ".png"):
        raise OptionError(f"--video: found {path.name}; valid are files that end in .mp4 or .png")
    sheet = path.suffix.lower() == ".png"
    size = (WIDTH // SHEET_COLUMNS * 2, HEIGHT // SHEET_COLUMNS * 2) if sheet else (WIDTH, HEIGHT)
    camera = film.camera(states[:: max(1, len(states) // 20)], width=size[0], height=size[1])
    if not sheet:
        from anymesh.viewer.pictures_ import write_mp4

        part = path.with_name(f".{path.name}.part.mp4")
        try:
            write_mp4(_frames(film, states, camera), part, rate)
            part.replace(path)
            return path
        except MissingExtraError:
            path = path.with_suffix(".png")
        finally:
            part.unlink(missing_ok=True)
    chosen = states[np.round(np.linspace(0, len(states) - 1, SHEET_COLUMNS * SHEET_ROWS)).astype(int)]
    part = path.with_name(f".{path.name}.part.png")
    Image.fromarray(tiled(list(_frames(film, chosen, camera)), SHEET_COLUMNS)).save(part)
    part.replace(path)
    return path


def _frames(film: Film, states: Float[np.ndarray, "k q"], camera: Camera) -> Iterator[UInt8[np.ndarray, "H W 3"]]:
    return (film.frame(q, camera) for q in states)


def tiled(frames: list[UInt8[np.ndarray, "H W 3"]], columns: int) -> UInt8[np.ndarray, "h w 3"]:
    """Arrange pictures of equal size in rows."""
    rows = [frames[k : k + columns] for k in range(0, len(frames), columns)]
    rows[-1] += [np.full_like(frames[0], 255)] * (columns - len(rows[-1]))
    return np.concatenate([np.concatenate(row, 1) for row in rows])
