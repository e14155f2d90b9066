"""Handles as formats describe them: faces, the direction from which a hand comes, and how far a gripper must open."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float
from scipy.ndimage import distance_transform_edt, maximum_filter

from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.motion.handle import face_axes, find_handle, outward_axis
from anymesh.names import legal_names
from anymesh.physics.mechanism import HandleFrame
from anymesh.physics.resistance import Resistance
from anymesh.types import Asset, Handle
from anymesh.types.triangles import normals_and_areas, unshared

MAX_HANDLE_FACES = 20_000  # of a part and its parent, for a handle to be looked for
CELLS = 64  # of the grid of rays along the longest side of a handle
# of the fingers that are tried [rad], within half a turn: level and upright ones first
DIRECTIONS = np.deg2rad([0.0, 90.0, *(a for a in np.arange(2.5, 180, 2.5) if a != 90)])
FINE = 200  # rays across a handle
EQUAL = 1.02  # widths, and lengths, within this factor are equal: the first direction counts
FINGER, BESIDE = 0.008, (0.002, 0.010)  # [m] half width of a finger; where one stands beside a handle; estimates
HAND = 0.1  # [m] free length before a handle that a hand needs; an estimate
AWAY = 1e-4  # of the handle's size: where rays begin beside its surface


def find_protrusion(
    part: Float[np.ndarray, "F 3 3"], parent: Float[np.ndarray, "G 3 3"], direction: Float[np.ndarray, " 3"]
) -> tuple[Handle, Float[np.ndarray, " 3"]] | None:
    """Return the handle of a part and its point on the outer face [m], None if it has none or is too fine to look for one.

    part, parent: triangles [m]; direction: in which the face opens, of any length.
    """
    length = float(np.linalg.norm(direction))
    if max(len(part), len(parent)) > MAX_HANDLE_FACES or length < 1e-9:
        return None
    own, other = (TriangleSet(t, normals_and_areas(t)[0], np.zeros(len(t), bool), np.arange(len(t))) for t in (part, parent))
    core, out = body_obb(own), direction / length
    handle = find_handle(own, core, other, core.diagonal, out)
    if handle is None:
        return None
    k, face, local = outward_axis(core, out), face_axes(core, out), np.zeros(3)
    local[k], local[face] = np.sign(core.axes[k] @ out) * core.half[k], np.array(handle.across) * core.half[face]
    return handle, core.world(local[None])[0]


def handle_frames(asset: Asset, resistances: Mapping[str, Resistance]) -> tuple[HandleFrame, ...]:
    """Return a frame for each moving joint whose part has a handle, or is one, in the order of the joints."""
    handles = [(j, r.pull.handle) for j in asset.joints if (r := resistances.get(j.name)) and r.pull.handle is not None]
    taken = [
        *(p.name for p in asset.segmentation.parts),
        *(j.name for j in asset.joints),
        *(p.part.name for p in asset.proposals),
    ]
    names = legal_names([*taken, *(f"{joint.child}_handle" for joint, _ in handles)])[len(taken) :]
    frames, number = [], asset.segmentation.numbers
    for name, (joint, handle) in zip(names, handles, strict=True):
        faces = asset.segmentation.faces(number[handle.part])[handle.faces]
        around = np.isin(asset.segmentation.face_part, [number[n] for n in (handle.part, joint.child, joint.parent)])
        made = _frame(asset.mesh.triangles[faces], handle.way, RayScene(*unshared(asset.mesh.triangles[around])))
        if made is not None:
            frames.append(HandleFrame(name, handle.part, joint.name, *made, faces))
    return tuple(frames)


Placed = tuple[Float[np.ndarray, " 3"], Float[np.ndarray, "3 3"], Float[np.ndarray, " 3"]]


def _frame(triangles: Float[np.ndarray, "k 3 3"], way: Float[np.ndarray, " 3"], scene: RayScene) -> Placed | None:
    """Return place, axes and size of a handle, None if no hand reaches it. scene: its part and what that moves on."""
    seen = _Seen(triangles, way)
    spot = seen.middle()
    if spot is None:
        return None
    across = np.cos(DIRECTIONS)[:, None] * seen.axes[0] + np.sin(DIRECTIONS)[:, None] * seen.axes[1]
    widths = np.diff(seen.run(spot, across), axis=1)[:, 0]
    across = across[widths <= EQUAL * widths.min()]
    lengths = np.diff(seen.run(spot, np.cross(across, -way)), axis=1)[:, 0]
    y = across[int(np.argmax(EQUAL * lengths >= lengths.max()))]
    x = np.cross(y, -way)
    spot = spot + seen.run(spot, y[None]).mean() * y
    low, high = seen.run(spot, x[None])[0]
    spot = spot + (np.clip(0.0, low + FINGER, high - FINGER) if high - low > 2 * FINGER else (low + high) / 2) * x
    ends = seen.run(spot, y[None])[0]
    place = seen.surface(spot)
    if place is None or scene.first_hit((place + AWAY * seen.size * way)[None], way[None]).distance[0] < HAND:
        return None
    beside = place + np.array([[end + side * off] for end, side in zip(ends, (-1, 1), strict=True) for off in BESIDE]) * y
    behind = scene.first_hit(beside + AWAY * seen.size * way, np.tile(-way, (len(beside), 1))).distance
    depth = min(float(behind.min()), float(np.ptp(triangles.reshape(-1, 3) @ way)))
    return place, np.stack([x, y, -way], 1), np.array([high - low, np.ptp(ends), depth])


class _Seen:
    """A handle as a hand sees it that comes against `way`: its outline in a plane of two axes, the first of which is level."""

    def __init__(self, triangles: Float[np.ndarray, "k 3 3"], way: Float[np.ndarray, " 3"]) -> None:
        self.scene, self.way, corners = RayScene(*unshared(triangles)), way, triangles.reshape(-1, 3)
        level = np.cross(way, [0.0, 0, 1])
        level = np.eye(3)[0] if np.linalg.norm(level) < 0.1 else level
        level = level - (level @ way) * way
        level /= np.linalg.norm(level)
        self.axes = np.stack([level, np.cross(way, level)])
        self.low, self.high = (bound(corners @ self.axes.T, axis=0) for bound in (np.min, np.max))
        self.start, self.size = float((corners @ way).max()), float(np.ptp(corners, axis=0).max())

    def hits(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return how far the surface is below the highest level [m], inf beside the handle; only places across count."""
        starts = points + (self.start + AWAY * self.size - points @ self.way)[:, None] * self.way
        return self.scene.first_hit(starts, np.tile(-self.way, (len(points), 1))).distance - AWAY * self.size

    def middle(self) -> Float[np.ndarray, " 3"] | None:
        """Return the place where it is thickest within its outline near its middle, None if it has no outline."""
        cell = float((self.high - self.low).max()) / CELLS
        if not cell > 0:
            return None
        rows, columns = (np.arange(lo - cell, hi + 1.5 * cell, cell) for lo, hi in zip(self.low, self.high, strict=True))
        at = np.stack(np.meshgrid(rows, columns, indexing="ij"), -1)
        inside = np.isfinite(self.hits(at.reshape(-1, 2) @ self.axes)).reshape(at.shape[:2])
        depth = distance_transform_edt(inside) * cell
        ridge = inside & (depth >= maximum_filter(depth, 3))
        if not ridge.any():
            return None
        off = np.linalg.norm(at - (self.low + self.high) / 2, axis=-1) + depth
        return at[np.unravel_index(np.where(ridge, off, np.inf).argmin(), off.shape)] @ self.axes

    def run(self, spot: Float[np.ndarray, " 3"], directions: Float[np.ndarray, "d 3"]) -> Float[np.ndarray, "d 2"]:
        """Return from where to where the outline goes on along directions [m], from a place within it; once finer."""
        ends = np.zeros((len(directions), 2))
        reach = np.tile([-1.0, 1.0], (len(directions), 1)) * float(np.linalg.norm(self.high - self.low))
        for _ in range(2):
            for k in range(2):
                steps = np.linspace(np.zeros(len(directions)), reach[:, k], FINE, axis=1)
                at = spot + steps[:, :, None] * directions[:, None]
                free = ~np.isfinite(self.hits(at.reshape(-1, 3))).reshape(steps.shape)
                free[:, 0] = False
                last = np.where(free.any(1), free.argmax(1), FINE) - 1
                ends[:, k] = steps[np.arange(len(directions)), last]
            reach = ends + np.array([-2.0, 2.0]) * np.abs(reach) / FINE
        return ends

    def surface(self, spot: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"] | None:
        """Return the point of the surface at a place, None if there is none."""
        below = float(self.hits(spot[None])[0])
        return spot + (self.start - below - spot @ self.way) * self.way if np.isfinite(below) else None
