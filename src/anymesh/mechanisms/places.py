"""Places: free boxes above level surfaces, where things can be put: on shelves, in drawers, on top."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import label

from anymesh.export.notation import number
from anymesh.geometry.kinematics import carried_links, link_transforms, posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.names import legal_names
from anymesh.types import Asset, Brief, Mesh

CELLS = 96  # of the grid of rays along the longer side
LAYERS = 48  # most surfaces below one another
MIN_UP = 0.98  # minimum vertical component of the normal of what things stand on; a slope of 11 degrees
SMALLEST = np.array([0.06, 0.06, 0.05])  # [m] a cup; an estimate
OPEN = 0.3  # [m] height of a place with nothing above it; an estimate
STEP = 0.002  # of the diagonal: surfaces whose heights differ less are one
MAX_PLACES = 4  # places on one surface
SIDES = 3  # of four, with something beside the middle, that make a place without a ceiling an inside


@dataclass(frozen=True, eq=False)
class PlaceFrame(Brief):
    """A free box above a level surface of a link, where things can be put, at rest in the asset frame.

    place: middle of its lower side [m]; R: columns x, y, z, where z points away from the surface; size: along these [m];
    inside: whether something is above it, or on most sides of it.
    """

    name: str
    link: str
    place: Float[np.ndarray, " 3"]
    R: Float[np.ndarray, "3 3"]
    size: Float[np.ndarray, " 3"]
    inside: bool

    def record(self) -> dict[str, Any]:
        """Return the place for asset.json."""
        vectors = {"place": self.place, "along": self.R[:, 0], "up": self.R[:, 2], "size": self.size}
        rounded = {key: [float(number(float(v))) + 0.0 for v in values] for key, values in vectors.items()}
        return {"name": self.name, "link": self.link, "inside": self.inside, **rounded}


def find_places(asset: Asset, states: Mapping[str, Mapping[str, float]], taken: Sequence[str] = ()) -> tuple[PlaceFrame, ...]:
    """Return the places of an asset when it is closed that a straight way leads to when it is open, from below upwards.

    A place is a box along the asset's dominant horizontal directions, above surfaces of one part. Faces must be wound outwards.
    taken: names that a place must not have.
    """
    positions = states.get("closed", {})
    mesh = posed(asset, positions)
    yaw = _yaw(mesh)
    c, s = np.cos(yaw), np.sin(yaw)
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    points = mesh.vertices @ R
    scene, used = RayScene(points, mesh.faces), np.unique(mesh.faces)
    low, high = points[used].min(0), points[used].max(0)
    cell = float((high - low)[:2].max()) / CELLS
    if not cell > 0 or ((high - low)[:2] < SMALLEST[:2]).any():
        return ()
    axes = [np.arange(low[k] + cell / 2, high[k], cell) for k in range(2)]
    heights, faces = _layers(scene, axes, low, high)
    up = np.where(faces >= 0, mesh.face_normals[faces][..., 2], 0.0)
    part = np.where(faces >= 0, asset.segmentation.face_part[faces], -1)
    above = np.concatenate([np.full((1, *heights.shape[1:]), np.inf), heights[:-1]])
    below = np.concatenate([np.ones((1, *up.shape[1:]), bool), up[:-1] < 0]) & (faces >= 0)  # nothing, or a ceiling
    free = np.subtract(above, heights, where=below, out=np.zeros(heights.shape))
    stands = (up > MIN_UP) & (free >= SMALLEST[2]) & (part >= 0)
    boxes = []
    for k in np.unique(part[stands]):
        ours = stands & (part == k)
        for z in _levels(heights[ours], STEP * mesh.diagonal):
            at = ours & (np.abs(heights - z) <= STEP * mesh.diagonal)
            room = np.where(at, free, 0.0).max(0)
            boxes += [(int(k), box) for box in _boxes(at.any(0), room, axes, z, cell)]
    boxes.sort(key=lambda at: (*np.round(at[1][0][[2, 0, 1]], 4), at[0]))
    names = [asset.segmentation.parts[k].name for k, _ in boxes]
    taken = [
        *taken,
        *(p.name for p in asset.segmentation.parts),
        *(j.name for j in asset.joints),
        *(p.part.name for p in asset.proposals),
    ]
    named = legal_names([*taken, *(f"{name}_place" for name in names)])[len(taken) :]
    back = {name: np.linalg.inv(T) for name, T in link_transforms(asset, positions).items()}
    places = []
    for name, link, (_, (start, end)) in zip(named, names, boxes, strict=True):
        T, middle, inside = back[link], (start + end) / 2, np.isfinite(end[2]) or _surrounded(scene, start, end)
        size = np.where(np.isfinite(end), end, start + OPEN) - start
        foot = R @ [middle[0], middle[1], start[2]]
        places.append(PlaceFrame(name, link, (T @ [*foot, 1.0])[:3], T[:3, :3] @ R, size, bool(inside)))
    return _reached(asset, places, positions, states.get("open", {}))


def _reached(
    asset: Asset, places: Sequence[PlaceFrame], closed: Mapping[str, float], opened: Mapping[str, float]
) -> tuple[PlaceFrame, ...]:
    """Return the places from whose middle a way to a side or up is free; what is behind a drawer is not.

    All is open, or what carries the place alone, since a drawer may be below another one.
    """
    carrying = {p.link: {j.name for j in asset.joints if p.link in carried_links(asset, j)} for p in places}
    free, scenes = set[str](), dict[frozenset[str], tuple[RayScene, Mapping[str, np.ndarray]]]()
    for p in places:
        for moved in (frozenset(opened), frozenset(carrying[p.link] & set(opened))):
            if moved not in scenes:
                at = {**closed, **{name: opened[name] for name in moved}}
                mesh = posed(asset, at)
                scenes[moved] = RayScene(mesh.vertices, mesh.faces), link_transforms(asset, at)
            scene, transforms = scenes[moved]
            T, (x, y, z) = transforms[p.link], p.R.T
            ways = np.array([z, x, -x, y, -y]) @ T[:3, :3].T
            middle = (T @ [*(p.place + p.size[2] / 2 * z), 1.0])[:3]
            if (scene.first_hit(np.tile(middle, (len(ways), 1)), ways).face < 0).any():
                free.add(p.name)
    return tuple(p for p in places if p.name in free)


def _yaw(mesh: Mesh) -> float:
    """Return the angle within an eighth of a turn by which upright faces are turned about z, by area."""
    normals, areas = mesh.face_normals, mesh.face_areas
    upright = np.abs(normals[:, 2]) < np.sqrt(1 - MIN_UP**2)
    angles = np.arctan2(normals[upright, 1], normals[upright, 0])
    total = (areas[upright] * np.exp(4j * angles)).sum()
    return float(np.angle(total) / 4) if abs(total) > 1e-12 else 0.0


def _layers(
    scene: RayScene, axes: Sequence[np.ndarray], low: np.ndarray, high: np.ndarray
) -> tuple[Float[np.ndarray, "l n m"], Int[np.ndarray, "l n m"]]:
    """Return the heights and faces that rays from above meet one after another over a grid; -1 where there is none left."""
    at = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)
    skip = 1e-5 * float(np.linalg.norm(high - low))
    starts = np.column_stack([at, np.full(len(at), high[2] + skip)])
    heights, faces = [], []
    for _ in range(LAYERS):
        hits = scene.first_hit(starts, np.tile([0.0, 0.0, -1.0], (len(at), 1)))
        met = hits.face >= 0
        z = np.where(met, starts[:, 2] - np.where(met, hits.distance, 0.0), -np.inf)
        heights.append(z)
        faces.append(np.where(met, hits.face, -1))
        if not met.any():
            break
        starts = np.column_stack([at, np.where(met, z - skip, low[2] - 1.0)])
    shape = (-1, len(axes[0]), len(axes[1]))
    return np.stack(heights).reshape(shape), np.stack(faces).reshape(shape)


def _levels(heights: Float[np.ndarray, " n"], step: float) -> list[float]:
    """Return the median of each run of heights without a gap over `step`."""
    ordered = np.sort(heights)
    return [float(np.median(run)) for run in np.split(ordered, np.flatnonzero(np.diff(ordered) > step) + 1)]


def _boxes(
    mask: Bool[np.ndarray, "n m"], room: Float[np.ndarray, "n m"], axes: Sequence[np.ndarray], z: float, cell: float
) -> list[tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]]:
    """Return both corners of each free box above a surface; the largest areas first."""
    boxes, patches = [], label(mask)[0]
    for patch in range(1, int(patches.max()) + 1):
        left = patches == patch
        for _ in range(MAX_PLACES):
            i, j, n, m = _largest_rectangle(left)
            if ((np.array([n, m]) - 1) * cell < SMALLEST[:2]).any():
                break
            start = np.array([axes[0][i], axes[1][j], z])
            end = np.array([axes[0][i + n - 1], axes[1][j + m - 1], z + room[i : i + n, j : j + m].min()])
            boxes.append((start, end))
            left[i : i + n, j : j + m] = False
    return boxes


def _largest_rectangle(mask: Bool[np.ndarray, "n m"]) -> tuple[int, int, int, int]:
    """Return row, column, and numbers of rows and columns of the largest rectangle of true cells."""
    best, runs = (0, 0, 0, 0), np.zeros(mask.shape[1], int)
    for row in range(mask.shape[0]):
        runs = np.where(mask[row], runs + 1, 0)
        stack: list[tuple[int, int]] = []  # column at which a run of this height begins
        for column, run in enumerate([*runs.tolist(), 0]):
            begin = column
            while stack and stack[-1][1] >= run:
                begin, tall = stack.pop()
                if tall * (column - begin) > best[2] * best[3]:
                    best = (row - tall + 1, begin, tall, column - begin)
            stack.append((begin, run))
    return best


def _surrounded(scene: RayScene, start: np.ndarray, end: np.ndarray) -> bool:
    """Return whether most sides of a place without a ceiling have something beside them, as in a drawer."""
    middle = np.array([(start[0] + end[0]) / 2, (start[1] + end[1]) / 2, start[2] + SMALLEST[2] / 2])
    ways = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    return int((scene.first_hit(np.tile(middle, (4, 1)), ways).face >= 0).sum()) >= SIDES
