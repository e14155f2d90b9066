"""Oriented boxes, and the rotation about the vertical that turns the upright faces of a shape along x and y."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.types import Brief, Joint, Mesh
from anymesh.types.triangles import about_z, bounds_of, boxes_meet, cross

BLOCK = 100_000  # points times frames that are transformed at once
MIN_BOXY_SHARE = 0.6  # share of the surface along the axes of a frame above which the box is aligned with the surface
MAX_ALIGNED_LOSS = 0.1  # by how much less of the surface may lie along the axes of the frame that is taken
# maximum volume of an aligned box over the smallest; 1.9 in a cross of plates, 3.8 and more along the slats of a blind
MAX_ALIGNED_VOLUME_RATIO = 2.5
MIN_ALIGNED_SHARE = 0.3  # minimum length of the mean direction of upright faces, modulo a quarter turn; 1 if all agree
MIN_YAW_RAD = float(np.deg2rad(0.5))  # [rad] smaller angles are left, so that files that are nearly straight stay as they are


@dataclass(frozen=True, eq=False)
class OrientedBox(Brief):
    """An oriented box. axes: rows are unit, right-handed, longest side first; half: half side lengths in that order [m]."""

    center: Float[np.ndarray, " 3"]
    axes: Float[np.ndarray, "3 3"]
    half: Float[np.ndarray, " 3"]

    @property
    def diagonal(self) -> float:
        return 2 * float(np.linalg.norm(self.half))

    def local(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """Transform points into the box frame [m], with the center at 0."""
        return (points - self.center) @ self.axes.T

    def world(self, local: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
        """Transform points from the box frame [m]."""
        return local @ self.axes + self.center


def _frame(first: np.ndarray, second: np.ndarray) -> np.ndarray | None:
    second = second - (second @ first) * first
    length = np.linalg.norm(second)
    if length < 1e-6:
        return None
    second = second / length
    return np.array([first, second, cross(first, second)])


def dominant_normals(
    normals: Float[np.ndarray, "n 3"], weights: Float[np.ndarray, " n"], count: int = 4
) -> Float[np.ndarray, "k 3"]:
    """Return the sign-free directions that most of the surface faces, by weight, each averaged over its cone."""
    n = normals[weights > 0]
    w = weights[weights > 0].copy()
    flip = np.where(np.abs(n) > 0.5 * np.abs(n).max(1, keepdims=True), np.sign(n), 0)
    first = np.take_along_axis(flip, (flip != 0).argmax(1)[:, None], 1)[:, 0]
    n = n * np.where(first == 0, 1, first)[:, None]
    directions: list[np.ndarray] = []
    steps = np.round(n * 50).astype(np.int64)
    cell = np.unique((steps[:, 0] * 128 + steps[:, 1]) * 128 + steps[:, 2], return_inverse=True)[1].reshape(-1)
    while len(n) and len(directions) < count:
        heavy = np.bincount(cell, w).argmax()
        seed = n[np.flatnonzero(cell == heavy)[0]]
        along = n @ seed
        cone = np.abs(along) > np.cos(np.deg2rad(5))
        mean = (n[cone] * (w[cone] * np.sign(along[cone]))[:, None]).sum(0)
        directions.append(mean / np.linalg.norm(mean))
        n, w, cell = n[~cone], w[~cone], cell[~cone]
    return np.array(directions).reshape(-1, 3)


def fit_box(
    points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "m 3"], weights: Float[np.ndarray, " m"]
) -> OrientedBox:
    """Fit the smallest box along the asset axes, the dominant normals, or the principal directions.

    A box must be 3 % smaller to be preferred to the axis-aligned one. The box of a surface that mostly lies along three axes is
    aligned with it, since a smaller one may be tilted by a protrusion or by missing surface; unless the aligned one is far
    larger, as along the slats of a blind and not along its frame.
    """
    frames = [np.eye(3)]
    directions = dominant_normals(normals, weights)
    spread = points - points.mean(0)
    principal = np.linalg.svd(spread.T @ spread / max(len(points), 1))[2]
    flat = [spread - np.outer(spread @ first, first) for first in directions]
    longest = np.linalg.svd(np.array([f.T @ f for f in flat]).reshape(-1, 3, 3))[2][:, 0]
    for i, first in enumerate(directions):
        rest = [directions[j] for j in range(len(directions)) if j != i and abs(directions[j] @ first) < 0.1]
        others = {second.tobytes(): second for second in (*rest, longest[i], *np.eye(3))}  # one frame of equal ones
        frames.extend(f for second in others.values() if (f := _frame(first, second)) is not None)
    frames.append(_frame(principal[0], principal[1]) if len(points) > 2 else None)
    tried = np.array([f for f in frames if f is not None])
    step = max(1, BLOCK // max(len(points), len(normals), 1))
    blocks = [tried[k : k + step] for k in range(0, len(tried), step)]
    aligned = np.concatenate([_aligned(normals, weights, some) for some in blocks]) / max(weights.sum(), 1e-300)
    sides = np.concatenate([_sides(points, some) for some in blocks])
    tolerance = 1e-3 * float(np.linalg.norm(np.diff(bounds_of(points), axis=0)))
    volumes = (sides + tolerance).prod(1)
    volumes = np.where(volumes > MAX_ALIGNED_VOLUME_RATIO * volumes.min(), np.inf, volumes)
    aligned[np.isinf(volumes)] = 0
    if aligned.max() > MIN_BOXY_SHARE:
        volumes[aligned <= aligned.max() - MAX_ALIGNED_LOSS] = np.inf
    best, best_volume = 0, np.inf
    for k, volume in enumerate(volumes):
        if volume < best_volume * 0.97:
            best, best_volume = k, volume
    return box_in_frame(points, tried[best])


def _aligned(
    normals: Float[np.ndarray, "n 3"], weights: Float[np.ndarray, " n"], frames: Float[np.ndarray, "k 3 3"]
) -> Float[np.ndarray, " k"]:
    """Return the weight of the faces that lie along axes of each frame, by cosine: .87 of one at 3 degrees, .22 at 10."""
    cosine = np.abs(frames.reshape(-1, 3) @ normals.T).reshape(len(frames), 3, -1)
    nearest = np.maximum(np.maximum(cosine[:, 0], cosine[:, 1]), cosine[:, 2])
    fourth = (nearest**2) ** 2
    once = ((fourth**2) ** 2) ** 2  # to the power of 32; np.power takes four times as long
    return np.array([weights @ row for row in once**2 * once * fourth])


def _sides(points: Float[np.ndarray, "n 3"], frames: Float[np.ndarray, "k 3 3"]) -> Float[np.ndarray, "k 3"]:
    """Return the sides of the tight box of points in each frame [m]."""
    local = frames.reshape(-1, 3) @ points.T
    return (local.max(1) - local.min(1)).reshape(-1, 3)


def box_in_frame(points: Float[np.ndarray, "n 3"], axes: Float[np.ndarray, "3 3"]) -> OrientedBox:
    """Return the tight box of points in a frame (rows of `axes`), longest side first."""
    local = points @ axes.T
    low, high = bounds_of(local)
    order = np.argsort(-(high - low), kind="stable")
    sorted_axes = axes[order]
    for row in sorted_axes:  # fix the sign: the largest component is positive
        if row[np.abs(row).argmax()] < 0:
            row *= -1
    center = ((low + high) / 2) @ axes
    if np.linalg.det(sorted_axes) < 0:
        sorted_axes[2] *= -1
    return OrientedBox(center, sorted_axes, ((high - low) / 2)[order])


def within(
    points: Float[np.ndarray, "n 3"], low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"]
) -> Bool[np.ndarray, " n"]:
    """Return which points lie in an axis-aligned box."""
    x, y, z = points.T
    inside = (x >= low[0]) & (x <= high[0])
    for values, a, b in ((y, low[1], high[1]), (z, low[2], high[2])):
        inside &= values >= a
        inside &= values <= b
    return inside


def box_pairs(low: Float[np.ndarray, "n 3"], high: Float[np.ndarray, "n 3"], reach: float) -> list[tuple[int, int]]:
    """Return the pairs (i < j) of axis-aligned boxes that are at most `reach` apart along every axis, in order.

    Sorts and sweeps along the axis on which the fewest boxes overlap.
    """
    low, high = low - reach / 2, high + reach / 2
    order, end = min((_sorted_overlaps(low[:, k], high[:, k]) for k in range(3)), key=lambda overlaps: int(overlaps[1].sum()))
    pairs_per_box = [np.zeros((0, 2), np.int64)]
    for at, (i, stop) in enumerate(zip(order, end, strict=True)):
        later = order[at + 1 : stop]
        meets = later[boxes_meet(low[later], high[later], low[i], high[i])]
        pairs_per_box.append(np.stack([np.minimum(meets, i), np.maximum(meets, i)], 1))
    pairs = np.concatenate(pairs_per_box)
    return [(int(i), int(j)) for i, j in pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]]


def _sorted_overlaps(low: Float[np.ndarray, " n"], high: Float[np.ndarray, " n"]) -> tuple[np.ndarray, Int[np.ndarray, " n"]]:
    """Return the intervals in the order of their lower ends, and for each the position in that order where overlaps end."""
    order = np.argsort(low, kind="stable")
    return order, np.searchsorted(low[order], high[order], side="right")


def straightening(normals: Float[np.ndarray, "F 3"], areas: Float[np.ndarray, " F"]) -> Float[np.ndarray, "4 4"]:
    """Return the rotation about z, by 45 degrees at most, after which most upright faces face along x or y.

    The identity if no direction prevails. areas: of the faces [m^2].
    """
    upright = areas * np.hypot(normals[:, 0], normals[:, 1]) ** 4  # a level face has no direction, and a sloping one hardly any
    mean = np.sum(upright * np.exp(4j * np.arctan2(normals[:, 1], normals[:, 0]))) / max(float(upright.sum()), 1e-300)
    yaw = -float(np.angle(mean)) / 4
    return about_z(yaw) if abs(mean) >= MIN_ALIGNED_SHARE and abs(yaw) >= MIN_YAW_RAD else np.eye(4)


def straight_mesh(mesh: Mesh) -> tuple[Mesh, Float[np.ndarray, "4 4"]]:
    """Return the mesh turned straight, and the rotation; the mesh itself if it is straight."""
    T = straightening(mesh.face_normals, mesh.face_areas)
    return (mesh if (np.eye(4) == T).all() else mesh.transformed(T)), T


def turned_back(joint: Joint, T: Float[np.ndarray, "4 4"]) -> Joint:
    """Return a joint of the turned mesh in the frame from which T turned it."""
    if (np.eye(4) == T).all():
        return joint
    others = tuple(turned_back(other, T) for other in joint.others)
    return replace(joint, origin=joint.origin @ T[:3, :3], axis=joint.axis @ T[:3, :3], others=others)
