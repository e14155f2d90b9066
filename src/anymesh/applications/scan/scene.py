"""Location of the object in a recording: its supporting plane, the upward direction, and the box to fuse."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from anymesh.applications.scan.agreement import Glimpse
from anymesh.applications.scan.frames import Frames
from anymesh.errors import InputError, OptionError
from anymesh.types import Brief
from anymesh.types.triangles import about_z, face_cross

TRIES = 600  # planes through three points tried as floor
LEVEL_KNOWN, LEVEL_GUESSED = 20.0, 50.0  # [deg] largest tilt of a floor against the layout's up, or the cameras' mean up
THICK = 0.006  # share of the depth; largest distance of a plane's points
SUPPORT = 0.05  # minimum share of all points that lie on the floor
BELOW = 0.1  # largest ratio of points below a floor to points on it
CELL = 0.02  # share of the depth; approximate distance within which points are connected
MARGIN = 0.04  # margin around the object, share of its diagonal
MIDDLE = 0.35  # tangent of the angle from the optical axis within which points count as the camera's subject
QUANTILES = (0.005, 0.995)  # of the object's points, between which its extent is measured for alignment
COUNTED = 20_000  # points used to evaluate planes


@dataclass(frozen=True, eq=False)
class Scene(Brief):
    """Frame and region of the scan.

    T_scan_world: (4, 4) rigid, z up, floor (if any) at z = 0, object at x = y = 0; low, high: corners of the region in the
    scan's frame [m]; diagonal: of the object's box [m]; pixel: size of a pixel on the object [m]; noise: standard deviation of
    depth there [m]; has_floor: whether a floor was found.
    """

    T_scan_world: Float[np.ndarray, "4 4"]
    low: Float[np.ndarray, " 3"]
    high: Float[np.ndarray, " 3"]
    diagonal: float
    pixel: float
    noise: float
    has_floor: bool


@dataclass(frozen=True, eq=False)
class _Cloud(Brief):
    """Point cloud. points: (n, 3) world [m]; central: (n,) weight, 1 on the optical axis; depth, usual [m]; pixel: (n,) [m]."""

    points: Float[np.ndarray, "n 3"]
    central: Float[np.ndarray, " n"]
    pixel: Float[np.ndarray, " n"]
    usual: float

    def take(self, kept: Bool[np.ndarray, " n"]) -> _Cloud:
        return _Cloud(self.points[kept], self.central[kept], self.pixel[kept], self.usual)


def find_scene(
    frames: Frames, glimpses: list[Glimpse], *, crop: tuple[float, ...] | None = None, floor: bool = True, seed: int = 0
) -> Scene:
    """Find the object that most cameras look at.

    crop: x0, y0, z0, x1, y1, z1 [m] in the recording's world; floor: whether to look for a floor. Raise InputError if no points
    remain.
    """
    cloud = _cloud(glimpses)
    if crop is not None:
        cloud = _cropped(cloud, crop)
    up, lean = _up(frames)
    tolerance = THICK * cloud.usual
    plane = _floor(cloud.points, up, lean, tolerance, np.random.default_rng(seed)) if floor else None
    T = np.eye(4)
    T[:3, :3] = _upright(up if plane is None else plane[:3])
    noise = THICK * cloud.usual / 4
    if plane is not None:
        T[2, 3] = plane[3]
        height = cloud.points @ plane[:3] + plane[3]
        flat = np.abs(height) < tolerance
        noise = max(1.48 * float(np.median(np.abs(height[flat]))), 1e-5)
        cloud = cloud.take(height > 2 * tolerance)
    body = _body(cloud)
    T = _square(body.points @ T[:3, :3].T + T[:3, 3]) @ T
    p = body.points @ T[:3, :3].T + T[:3, 3]
    low, high = np.quantile(p, 0.001, axis=0), np.quantile(p, 0.999, axis=0)
    if plane is not None:
        low[2] = 0.0
    diagonal = float(np.linalg.norm(high - low))
    margin = max(MARGIN * diagonal, 3 * tolerance)
    middle = np.array([*(low + high)[:2] / 2, 0.0])
    T[:3, 3] -= middle
    return Scene(
        T, low - middle - margin, high - middle + margin, diagonal, float(np.median(body.pixel)), noise, plane is not None
    )


def _cloud(glimpses: list[Glimpse]) -> _Cloud:
    points = np.concatenate([g.points @ g.T[:3, :3].T + g.T[:3, 3] for g in glimpses])
    local = np.concatenate([g.points for g in glimpses])
    focal = np.concatenate([np.full(len(g.points), g.focal) for g in glimpses])
    aside = np.hypot(local[:, 0], local[:, 1]) / local[:, 2]
    return _Cloud(points, np.exp(-((aside / MIDDLE) ** 2)), local[:, 2] / focal, float(np.median(local[:, 2])))


def _cropped(cloud: _Cloud, crop: tuple[float, ...]) -> _Cloud:
    low, high = np.array(crop[:3]), np.array(crop[3:])
    if len(crop) != 6 or not (low < high).all():
        raise OptionError(
            f"--crop: found {','.join(f'{v:g}' for v in crop)}; valid are x0,y0,z0,x1,y1,z1 [m], each 0 below its 1"
        )
    inside = np.all((cloud.points >= low) & (cloud.points <= high), axis=1)
    if not inside.any():
        a, b = cloud.points.min(0), cloud.points.max(0)
        raise InputError(f"--crop leaves nothing: the recording reaches from {np.round(a, 2)} to {np.round(b, 2)} m")
    return cloud.take(inside)


def _up(frames: Frames) -> tuple[np.ndarray, float]:
    """Return the upward direction of the world and the largest angle of a floor's normal to it [deg]."""
    if frames.up is not None:
        return np.array(frames.up), LEVEL_KNOWN
    mean = -np.mean([f.T_world_camera[:3, 1] for f in frames.frames], axis=0)
    length = float(np.linalg.norm(mean))
    return (mean / length if length > 1e-3 else np.array([0, 0, 1.0])), LEVEL_GUESSED


def _floor(points: np.ndarray, up: np.ndarray, lean: float, tolerance: float, rng: np.random.Generator) -> np.ndarray | None:
    """Return the plane (unit normal up, offset) with the most points that can be a floor; None if there is none.

    A floor has hardly any points directly below it, in contrast to a top face of the object, which has the object's sides.
    """
    some = points[rng.permutation(len(points))[:COUNTED]]
    corners = some[rng.integers(len(some), size=(TRIES, 3))]
    normal = face_cross(corners)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    normal *= np.where(normal @ up < 0, -1.0, 1.0)[:, None]
    planes = np.c_[normal, -np.einsum("ij,ij->i", normal, corners[:, 0])][normal @ up > np.cos(np.deg2rad(lean))]
    count = np.array([(np.abs(some @ p[:3] + p[3]) < tolerance).sum() for p in planes])
    for k in np.argsort(-count, kind="stable")[:40] if len(count) else ():
        if count[k] < SUPPORT * len(some):
            break
        plane = planes[k]
        for _ in range(3):
            on = np.abs(some @ plane[:3] + plane[3]) < tolerance
            plane = _fitted(some[on], plane[:3])
        if _bears(some, plane, tolerance):
            return plane
    return None


def _fitted(points: np.ndarray, toward: np.ndarray) -> np.ndarray:
    middle = points.mean(0)
    normal = np.linalg.svd(points - middle, full_matrices=False)[2][2]
    normal = normal * (-1.0 if normal @ toward < 0 else 1.0)
    return np.r_[normal, -normal @ middle]


def _bears(points: np.ndarray, plane: np.ndarray, tolerance: float) -> bool:
    height = points @ plane[:3] + plane[3]
    on, under = np.abs(height) < tolerance, height < -3 * tolerance
    R = _upright(plane[:3])
    flat = points @ R[:2].T
    low = flat.min(0)
    cell = np.floor((flat - low) / (6 * tolerance)).astype(int)
    there = np.zeros(cell.max(0) + 1, bool)
    there[tuple(cell[on].T)] = True
    there = ndimage.binary_dilation(there)
    return bool(there[tuple(cell[under].T)].sum() <= BELOW * on.sum())


def _body(cloud: _Cloud) -> _Cloud:
    """Return the connected points at which cameras look most."""
    if len(cloud.points) < 50:
        raise InputError(
            f"found {len(cloud.points)} points above the floor; the object is missing, or --depth-max or --crop leaves it out"
        )
    size = CELL * cloud.usual
    low = cloud.points.min(0)
    size = max(size, float((cloud.points.max(0) - low).max()) / 400)
    cell = np.floor((cloud.points - low) / size).astype(int) + 1
    count = np.zeros(cell.max(0) + 2, np.int32)
    np.add.at(count, tuple(cell.T), 1)
    label = ndimage.label(ndimage.binary_dilation(count > 1, np.ones((3, 3, 3))), np.ones((3, 3, 3)))[0]
    mine = label[tuple(cell.T)]
    weight = np.bincount(mine, cloud.central)
    weight[0] = 0
    if len(weight) < 2:
        raise InputError("found only scattered points above the floor, and no object")
    return cloud.take((mine == int(weight.argmax())) & (count[tuple(cell.T)] > 1))


def _upright(up: np.ndarray) -> Float[np.ndarray, "3 3"]:
    """Return a rotation whose third row is `up`."""
    z = up / np.linalg.norm(up)
    x = np.eye(3)[int(np.abs(z).argmin())]
    x = x - (x @ z) * z
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z])


def _square(points: np.ndarray) -> Float[np.ndarray, "4 4"]:
    """Return the rotation about z that minimizes the bounding box, so that walls are aligned with the fusion grid."""
    best, least = 0.0, np.inf
    for angle in np.deg2rad(np.arange(0, 90, 1.0)):
        area = _area(points, angle)
        if area < least * (1 - 1e-6):
            best, least = angle, area
    for angle in best + np.deg2rad(np.arange(-1, 1.01, 0.1)):
        area = _area(points, angle)
        if area < least * (1 - 1e-6):
            best, least = angle, area
    return about_z(best)


def _area(points: np.ndarray, angle: float) -> float:
    flat = points[:, :2] @ about_z(angle)[:2, :2].T
    return float(np.prod(np.quantile(flat, QUANTILES[1], axis=0) - np.quantile(flat, QUANTILES[0], axis=0)))
