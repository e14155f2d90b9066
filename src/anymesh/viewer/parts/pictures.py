"""Small pictures of a part moved by each of several motions, all from one side that shows the part."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.geometry.kinematics import carried_links, joint_transform
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.marks import axis_line
from anymesh.rendering.preview import AZIMUTHS, ELEVATION, shown_position
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Asset, Brief, Joint, JointType
from anymesh.types.camera import Camera
from anymesh.types.triangles import normals_and_areas
from anymesh.viewer.scene import DisplayMesh, surface

SIZE = (132, 104)  # [px] width and height of a picture
FINE = 2  # rays per pixel and direction
SKETCH = 40  # [px] size of the pictures by which the side is chosen
AROUND = 1.5  # width of what is shown, relative to the part and its ways
FAR = 0.8  # maximum travel that is shown, as a share of the part's size
PART, CARRIED, REST, GROUND, LINE, AXIS = (236, 126, 20), (240, 190, 120), (214, 214, 218), (255, 255, 255), 90, (190, 20, 40)
LIGHT = np.array([0.3, 0.5, 0.9])  # on surfaces across x, y and z


@dataclass(frozen=True, eq=False)
class _Shot(Brief):
    """What rays hit. kind: 0 nothing, 1 the rest, 2 what the part carries, 3 the part."""

    kind: Int[np.ndarray, " n"]
    light: Float[np.ndarray, " n"]
    depth: Float[np.ndarray, " n"]


class MotionPictures:
    """Draws motions of one part of an asset."""

    def __init__(self, asset: Asset, part: str) -> None:
        names = [p.name for p in asset.segmentation.parts]
        joint = next(j for j in asset.joints if j.child == part)
        number, carried = names.index(part), [names.index(n) for n in carried_links(asset, joint)]
        label = asset.segmentation.face_part
        self._asset, self._part = asset, asset.segmentation.faces(number)
        moving = np.isin(label, [number, *carried])
        self._kinds = [
            (kind, _Rays(surface(asset.mesh, faces)))
            for kind, faces in ((1, np.flatnonzero(~moving)), (2, np.flatnonzero(moving & (label != number))), (3, self._part))
            if len(faces)
        ]
        self._corners = asset.mesh.triangles[self._part].reshape(-1, 3)

    def of(self, joints: Sequence[Joint]) -> list[str]:
        """Return a picture of each motion as a data URL."""
        poses = [joint_transform(j, self._position(j)) for j in joints]
        places = np.concatenate([self._corners, *(self._corners @ T[:3, :3].T + T[:3, 3] for T in poses)])
        camera = self._camera(places, poses)
        return [_url(self._drawn(camera, joint, T)) for joint, T in zip(joints, poses, strict=True)]

    def _position(self, joint: Joint) -> float:
        """Return the position that is shown: opened, a slide by no more than lets the part be recognized."""
        at = shown_position(joint, self._asset.mesh.diagonal)
        if joint.type is not JointType.PRISMATIC:
            return at
        most = FAR * float(np.ptp(self._corners, axis=0).max())
        return float(np.clip(at, -most, most))

    def _camera(self, places: np.ndarray, poses: Sequence[np.ndarray]) -> Camera:
        """Return the view that shows most of the part, at rest and moved. places: of its corners."""
        seen, bounds = [], np.stack([places.min(0), places.max(0)])
        for azimuth in AZIMUTHS:
            camera = orbit_camera(bounds, np.deg2rad(azimuth), np.deg2rad(ELEVATION), SKETCH)
            seen.append(sum(int((self._shot(camera, T).kind == 3).sum()) for T in (np.eye(4), *poses)))
        best = next(a for a, count in zip(AZIMUTHS, seen, strict=True) if count >= 0.8 * max(seen))
        width, height = (FINE * v for v in SIZE)
        T = orbit_camera(bounds, np.deg2rad(best), np.deg2rad(ELEVATION), height).T_world_camera
        for _ in range(2):  # moving the camera sideways changes what it sees slightly
            local = (places - T[:3, 3]) @ T[:3, :3]
            slopes = local[:, :2] / local[:, 2:]
            middle = (slopes.min(0) + slopes.max(0)) / 2
            T[:3, 3] += T[:3, :2] @ middle * float(local[:, 2].mean())
        across, down = np.ptp(slopes, axis=0) / 2
        return Camera(T, float(2 * np.arctan(AROUND * max(down, across * height / width))), width, height)

    def _shot(self, camera: Camera, T: np.ndarray) -> _Shot:
        origins, directions = camera.rays()
        shot = _Shot(np.zeros(len(origins), np.int64), np.zeros(len(origins)), np.full(len(origins), np.inf))
        for kind, rays in self._kinds:
            depth, light = rays.cast(origins[0], directions, T if kind > 1 else np.eye(4))
            nearer = depth < shot.depth
            shot.kind[nearer], shot.light[nearer], shot.depth[nearer] = kind, light[nearer], depth[nearer]
        return shot

    def _drawn(self, camera: Camera, joint: Joint, T: np.ndarray) -> UInt8[np.ndarray, "H W 3"]:
        shot, shape = self._shot(camera, T), (camera.height, camera.width)
        table = np.array([GROUND, REST, CARRIED, PART], float)
        color = table[shot.kind] * np.where(shot.kind > 0, 0.55 + 0.45 * shot.light, 1)[:, None]
        color[_outlines(shot, shape).reshape(-1)] *= LINE / 255
        large = Image.fromarray(color.reshape(*shape, 3).astype(np.uint8))
        self._draw_axis(large, camera, joint)
        return np.asarray(large.resize(SIZE, Image.Resampling.BOX))

    def _draw_axis(self, image: Image.Image, camera: Camera, joint: Joint) -> None:
        """Draw the axis of a hinge as a line, the way of a slide as an arrow."""
        if joint.type is JointType.FIXED:
            return
        slides, diagonal = joint.type is JointType.PRISMATIC, float(np.linalg.norm(np.ptp(self._corners, axis=0)))
        way = joint.axis if self._position(joint) >= 0 else -joint.axis
        ends, _ = axis_line(self._corners, joint.origin, way, slides, diagonal)
        (a, b), _ = camera.project(ends)
        draw = ImageDraw.Draw(image)
        draw.line([tuple(a), tuple(b)], fill=AXIS, width=2 * FINE)
        if slides and np.linalg.norm(b - a) > 1:
            along = (b - a) / np.linalg.norm(b - a) * 5 * FINE
            across = np.array([-along[1], along[0]]) * 0.6
            draw.polygon([tuple(b + along), tuple(b + across), tuple(b - across)], fill=AXIS)


class _Rays:
    """A surface that rays are cast at, at rest or moved."""

    def __init__(self, shown: DisplayMesh) -> None:
        self._scene = RayScene(shown.vertices, shown.faces)
        self._normals = normals_and_areas(shown.vertices[shown.faces])[0]

    def cast(self, eye: np.ndarray, directions: np.ndarray, T: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the depth (inf where nothing is hit) and the light of what rays from one point hit."""
        R = T[:3, :3]
        origins = np.broadcast_to((eye - T[:3, 3]) @ R, directions.shape)
        hits = self._scene.first_hit(origins, directions if np.array_equal(R, np.eye(3)) else directions @ R)
        return hits.distance, (np.abs(self._normals @ R.T) @ LIGHT)[hits.face]


def _outlines(shot: _Shot, shape: tuple[int, int]) -> np.ndarray:
    """Return where the kind of what is seen, its depth or its light changes."""
    kind, light = shot.kind.reshape(shape), shot.light.reshape(shape)
    depth = np.where(np.isfinite(shot.depth), shot.depth, 0).reshape(shape)
    lines = np.zeros(shape, bool)
    for axis in (0, 1):
        step = (np.diff(kind, axis=axis) != 0) | (np.abs(np.diff(light, axis=axis)) > 0.12)
        step |= np.abs(np.diff(depth, axis=axis)) > 0.03 * max(float(depth.max()), 1e-300)
        lines |= np.pad(step, [(1, 0) if k == axis else (0, 0) for k in (0, 1)])
    return lines


def _url(picture: np.ndarray) -> str:
    file = io.BytesIO()
    Image.fromarray(picture).quantize(48).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"
